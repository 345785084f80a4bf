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
    /// Numbers of apices up to its start, before its end, and up to its end.
    up_to_start: usize,
    before_end: usize,
    up_to_end: usize,
}

impl Span {
    fn of(arc: &Arc, from: f64, to: f64, noise: f64) -> Span {
        let error = noise / (arc.end - arc.start).length_squared();
        Span { from, to, curvature: arc.curvature(), error, up_to_start: 0, before_end: 0, up_to_end: 0 }
    }

    /// Number of apices inside.
    fn inside(&self) -> usize {
        self.before_end.saturating_sub(self.up_to_start)
    }
}

/// The parameters where the curvatures of the arcs do not rise and fall as those of the curve.
pub(super) fn wrong_places(cells: &[Cell], run: Run, noise: f64) -> Vec<f64> {
    let apices: Vec<f64> = (1..=run.stretches.len()).filter(|&i| run.is_apex(i)).map(|i| run.at(i)).collect();
    let spans = spans(cells, run, noise, &apices);
    // Whether the curvature rises behind so many apices.
    let rises = |count: usize| run.stretches[0].rises != (count % 2 == 1);
    let mut wrong = Vec::new();
    for (i, w) in spans.windows(2).enumerate() {
        let up = w[1].curvature > w[0].curvature;
        let hidden = (w[1].curvature - w[0].curvature).abs() <= w[0].error + w[1].error;
        // The pair behind the seam is the first one again, where apices are not known.
        if run.ring && i + 2 == spans.len() {
            continue;
        }
        let (inside, next) = (w[0].inside(), w[1].inside());
        let certain = inside == next && w[0].up_to_end == w[0].before_end;
        let too_many = inside > 1 || next > 1;
        if too_many || certain && up != rises(w[0].before_end) && (!hidden || inside > 0) {
            wrong.push(w[0].to);
        }
        // A dent in the extremum: down and up again around the arc that runs over an apex.
        if next == 1
            && !hidden
            && let Some(third) = spans.get(i + 2)
        {
            let rising = rises(w[1].up_to_start);
            if up != rising && (third.curvature > w[1].curvature) == rising {
                wrong.push(apices[w[1].up_to_start]);
            }
        }
    }
    if wrong.is_empty() {
        let extrema = extrema(&spans);
        if extrema.len() != apices.len() {
            let turn = if run.ring { run.end() - run.at(0) } else { f64::INFINITY };
            wrong = unmatched(&extrema, (&apices, turn), rises);
            if wrong.is_empty() {
                wrong = apices;
            }
        }
    }
    // What is seen behind the seam of a ring is where the ring begins.
    let (end, turn) = (run.end(), run.end() - run.at(0));
    wrong.iter_mut().filter(|u| **u > end).for_each(|u| *u -= turn);
    wrong
}

/// An arc, or several of one curvature, between lower ones or between higher ones.
struct Extremum {
    is_top: bool,
    /// From the arc before to the arc behind.
    from: f64,
    to: f64,
}

/// The extrema of the curvatures of arcs in order.
fn extrema(spans: &[Span]) -> Vec<Extremum> {
    let (mut found, mut last) = (Vec::new(), None);
    for (i, w) in spans.windows(2).enumerate() {
        let up = w[1].curvature > w[0].curvature;
        if (w[1].curvature - w[0].curvature).abs() <= w[0].error + w[1].error {
            continue;
        }
        if let Some((before, was_up)) = last.replace((i, up))
            && was_up != up
        {
            let (from, to): (&Span, &Span) = (&spans[before], &w[1]);
            found.push(Extremum { is_top: was_up, from: from.from, to: to.to });
        }
    }
    found
}

/// Middles of extrema of the arcs that have no apex of their kind near, and apices that have no extremum of
/// theirs. A ring goes on behind `turn`.
fn unmatched(
    extrema: &[Extremum],
    (apices, turn): (&[f64], f64),
    is_top: impl Fn(usize) -> bool,
) -> Vec<f64> {
    let mut served = vec![false; apices.len()];
    let mut wrong = Vec::new();
    for e in extrema {
        let mut is_matched = false;
        for begin in [0.0, turn] {
            let first = apices.partition_point(|&a| a + begin < e.from);
            let near = (first..apices.len()).take_while(|&i| apices[i] + begin <= e.to);
            for i in near.filter(|&i| is_top(i) == e.is_top) {
                (served[i], is_matched) = (true, true);
            }
        }
        if !is_matched {
            wrong.push(0.5 * (e.from + e.to));
        }
    }
    wrong.extend(served.iter().zip(apices).filter(|(served, _)| !**served).map(|(_, &apex)| apex));
    wrong
}

/// All arcs in order; in a ring the first ones again behind the last, so that both sides of the seam are
/// seen.
fn spans(cells: &[Cell], run: Run, noise: f64, apices: &[f64]) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::with_capacity(2 * cells.len() + 2);
    spans.extend(cells.iter().flat_map(Cell::spans).map(|(arc, from, to)| Span::of(&arc, from, to, noise)));
    if run.ring {
        let turn = run.end() - run.at(0);
        let first: Vec<Span> = spans.iter().take(2).copied().collect();
        spans.extend(first.iter().map(|s| Span { from: s.from + turn, to: s.to + turn, ..*s }));
    }
    let mut count = 0;
    for span in &mut spans {
        let beyond = |mut count: usize, is_beyond: &dyn Fn(f64) -> bool| {
            while count < apices.len() && is_beyond(apices[count]) {
                count += 1;
            }
            count
        };
        count = beyond(count, &|a| a <= span.from);
        span.up_to_start = count;
        span.before_end = beyond(count, &|a| a < span.to);
        span.up_to_end = beyond(span.before_end, &|a| a <= span.to);
    }
    spans
}
