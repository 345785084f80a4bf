//! Whether the curvatures of arcs rise and fall as those of the curve do.
//!
//! **Needs** the cuts of a run, which are certain. **Guarantees** that nothing is found wrong where the
//! curvatures of the arcs have their extrema at the apices and nowhere else, as far as the round-off of
//! stored arcs lets curvatures be told apart.

use super::biarc::Arc;
use super::run::Run;
use super::spiral::Cell;

/// An arc with the parameters between which it stands for the curve.
#[derive(Clone, Copy)]
struct Span {
    from: f64,
    to: f64,
    curvature: f64,
    /// Round-off of the curvature.
    error: f64,
}

impl Span {
    fn of(arc: &Arc, from: f64, to: f64, noise: f64) -> Span {
        let error = noise / (arc.end - arc.start).length_squared();
        Span { from, to, curvature: arc.curvature(), error }
    }
}

/// The parameters where the curvatures of the arcs do not rise and fall as those of the curve.
pub(super) fn wrong_places(cells: &[Cell], run: Run, noise: f64) -> Vec<f64> {
    let mut spans: Vec<Span> =
        cells.iter().flat_map(Cell::spans).map(|(arc, from, to)| Span::of(&arc, from, to, noise)).collect();
    let stretches = run.stretches;
    if run.ring {
        // On around the ring, so that both sides of the seam are seen.
        let turn = run.end() - run.at(0);
        let first: Vec<Span> = spans.iter().take(2).copied().collect();
        spans.extend(first.iter().map(|s| Span { from: s.from + turn, to: s.to + turn, ..*s }));
    }
    let apices: Vec<f64> = (1..=stretches.len()).filter(|&i| run.is_apex(i)).map(|i| run.at(i)).collect();
    let at = |i: usize| apices[i];
    // Number of apices before a parameter, and of those that are not behind it.
    let before = |u: f64| apices.partition_point(|&a| a < u);
    let up_to = |u: f64| apices.partition_point(|&a| a <= u);
    let inside = |s: &Span| before(s.to).saturating_sub(up_to(s.from));
    let mut wrong = Vec::new();
    let mut changes = Vec::new();
    for (i, w) in spans.windows(2).enumerate() {
        let step = w[1].curvature - w[0].curvature;
        let hidden = step.abs() <= w[0].error + w[1].error;
        if !hidden {
            changes.push(step > 0.0);
        }
        let rising = stretches[0].rises != (before(w[0].to) % 2 == 1);
        let certain = inside(&w[0]) == inside(&w[1]) && up_to(w[0].to) == before(w[0].to);
        let too_many = inside(&w[0]) > 1 || inside(&w[1]) > 1;
        if too_many || certain && (step > 0.0) != rising && (!hidden || inside(&w[0]) > 0) {
            wrong.push(w[0].to);
        }
        // A dent in the extremum: down and up again around the arc that runs over an apex.
        if let Some(next) = spans.get(i + 2)
            && inside(&w[1]) == 1
            && !hidden
        {
            let a = up_to(w[1].from);
            let rising = stretches[0].rises != (a % 2 == 1);
            debug_assert!(at(a) >= w[1].from);
            if (step > 0.0) != rising && (next.curvature > w[1].curvature) == rising {
                wrong.push(at(a));
            }
        }
    }
    changes.dedup();
    if wrong.is_empty() && changes.len().saturating_sub(1) != apices.len() && !apices.is_empty() {
        wrong.extend((0..apices.len()).map(at));
    }
    wrong
}
