//! Runs of spirals: stretches that meet smoothly at apices and inflections.
//!
//! **Needs** the cuts of the run, which are certain. **Guarantees** that the curvatures of the arcs
//! have their extrema where the curve has its apices, and no others, as far as round-off of stored
//! arcs lets curvatures be told apart.
//!
//! **Method.** A node at every apex and inflection would cost an arc or two at each. So the whole run
//! is divided by equal errors first, and an arc may run over an apex: having the mean curvature of
//! its part, it is the extremum itself. Where the curvatures show another picture than the cuts, the
//! run is divided at the apices concerned, in the end at every cut.

use super::biarc::{Arc, Node};
use super::cuts::{CutKind, Stretch};
use super::spiral::{Cell, Fitter, Scheme};
use super::track::{Side, Track};

/// Largest depth of division before a run is cut at all its cuts.
const MAX_DEPTH: u32 = 4;

/// Fits a run; the biarcs are appended to `out`. `None` when the limit on effort is reached.
pub(super) fn fit_run(
    fitter: &mut Fitter,
    track: &Track,
    goal: (f64, Scheme),
    stretches: &[Stretch],
    out: &mut Vec<Cell>,
) -> Option<()> {
    let whole = matches!(goal.1, Scheme::Fewest | Scheme::Tilted);
    let depth = if whole { MAX_DEPTH } else { 0 };
    Divided { fitter, track, goal, out }.fit(stretches, depth)
}

struct Divided<'a, 'b> {
    fitter: &'a mut Fitter,
    track: &'a Track<'b>,
    goal: (f64, Scheme),
    out: &'a mut Vec<Cell>,
}

impl Divided<'_, '_> {
    fn fit(&mut self, stretches: &[Stretch], depth: u32) -> Option<()> {
        if stretches.len() == 1 {
            return self.fit_one(stretches);
        }
        if depth == 0 {
            return stretches.chunks(1).try_for_each(|s| self.fit_one(s));
        }
        let wrong = self.attempt(stretches, self.goal.1)?;
        if wrong.is_empty() {
            return Some(());
        }
        let mut from = 0;
        for to in wrong.into_iter().chain([stretches.len()]) {
            if to > from {
                self.fit(&stretches[from..to], depth - 1)?;
            }
            from = to;
        }
        Some(())
    }

    /// One stretch, by another scheme where curvatures are not monotone.
    fn fit_one(&mut self, stretch: &[Stretch]) -> Option<()> {
        let scheme = self.goal.1;
        let others = [Scheme::Osculating, Scheme::Bisection];
        let whole = matches!(scheme, Scheme::Fewest | Scheme::Tilted);
        for scheme in [scheme].into_iter().chain(others.into_iter().take(if whole { 2 } else { 0 })) {
            if self.attempt(stretch, scheme)?.is_empty() {
                return Some(());
            }
        }
        let ends = self.ends(stretch);
        self.fitter.fit(self.track, ends, self.goal, self.out)
    }

    /// Appends biarcs for a run if their curvatures are right; answers the cuts where they are not.
    fn attempt(&mut self, stretches: &[Stretch], scheme: Scheme) -> Option<Vec<usize>> {
        let (begin, ends) = (self.out.len(), self.ends(stretches));
        self.fitter.fit(self.track, ends, (self.goal.0, scheme), self.out)?;
        let wrong = wrong_cuts(&self.out[begin..], stretches, self.track.noise());
        if !wrong.is_empty() {
            self.out.truncate(begin);
        }
        Some(wrong)
    }

    fn ends(&self, stretches: &[Stretch]) -> [Node; 2] {
        let (from, to) = (stretches[0].from.u, stretches[stretches.len() - 1].to.u);
        [self.track.cut_node(from, Side::After), self.track.cut_node(to, Side::Before)]
    }
}

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

/// The cuts of a run (as numbers of the stretches that begin there) near which the curvatures of the
/// arcs do not rise and fall as those of the curve; ascending. For a run without inner cuts, 0 says so.
fn wrong_cuts(cells: &[Cell], stretches: &[Stretch], noise: f64) -> Vec<usize> {
    let spans: Vec<Span> = cells
        .iter()
        .flat_map(|c| {
            let [a, b] = &c.arcs;
            [Span::of(a, c.from, c.joint, noise), Span::of(b, c.joint, c.to, noise)]
        })
        .collect();
    let apices: Vec<usize> =
        (1..stretches.len()).filter(|&i| stretches[i].from.kind == CutKind::Apex).collect();
    let at = |i: usize| stretches[apices[i]].from.u;
    // Number of apices before a parameter.
    let before = |u: f64| apices.partition_point(|&i| stretches[i].from.u < u);
    let inside = |s: &Span| before(s.to) - before(s.from);
    let mut wrong = Vec::new();
    let mut changes = Vec::new();
    let mut note = |i: usize| {
        let nearest = i.min(apices.len().saturating_sub(1));
        wrong.extend(apices.get(nearest).copied());
        wrong.extend(i.checked_sub(1).and_then(|i| apices.get(i)).copied());
        if apices.is_empty() {
            wrong.push(stretches.len() / 2);
        }
    };
    for (i, w) in spans.windows(2).enumerate() {
        let step = w[1].curvature - w[0].curvature;
        let hidden = step.abs() <= w[0].error + w[1].error;
        if !hidden {
            changes.push(step > 0.0);
        }
        let rising = stretches[0].rises != (before(w[0].to) % 2 == 1);
        let certain = inside(&w[0]) == inside(&w[1]);
        let too_many = inside(&w[0]) > 1 || inside(&w[1]) > 1;
        if too_many || certain && (step > 0.0) != rising && (!hidden || inside(&w[0]) > 0) {
            note(before(w[0].to));
        }
        // A dent in the extremum: down and up again around the arc that runs over an apex.
        if let Some(next) = spans.get(i + 2)
            && inside(&w[1]) == 1
            && !hidden
        {
            let a = before(w[1].from);
            let rising = stretches[0].rises != (a % 2 == 1);
            debug_assert!(at(a) >= w[1].from);
            if (step > 0.0) != rising && (next.curvature > w[1].curvature) == rising {
                note(a);
            }
        }
    }
    changes.dedup();
    if wrong.is_empty() && changes.len().saturating_sub(1) != apices.len() && !apices.is_empty() {
        wrong = apices;
    }
    wrong.sort_unstable();
    wrong.dedup();
    wrong
}
