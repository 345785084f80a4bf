//! A few arcs between two arcs over apices, or nodes, by a search for the least error.
//!
//! **Needs** so short a part of the curve that a handful of arcs may do, of monotone curvature.
//! **Guarantees** arcs within the tolerance, proven, whose curvatures are monotone with those of the arcs over
//! apices. These become longer or shorter: their ends slide along their circles. The same curve run
//! backwards, or mirrored, has the same arcs. **Does not** promise to find arcs where there are any.
//!
//! **Method.** Each arc leaves the one before to a knot beside the curve; the last two are a biarc, and one arc
//! alone touches both circles. So tangents agree whatever the parameters are: the slides, the places of knots
//! along the curve and beside it, and the joint of the biarc. Those are corrected by the method of Gauss and
//! Newton for distances of samples of the curve from the arcs; samples that are far weigh more and more
//! (Lawson), which leads to the least largest distance.

use super::biarc::Arc;
use super::bound::Distance;
use super::chain::{Chain, Links, MOST_ARCS};
use super::changes::Seen;
use super::density::{Cursor, Density};
use super::layout::Ends;
use super::spiral::Cell;
use super::squares::{MOST_ERRORS, Parameters, Squares};
use super::track::Track;
use crate::geom::Vector;
use std::ops::Range;

/// Samples of the curve for each arc, and beyond each end.
const SAMPLES: usize = 8;
const BEYOND: usize = 3;

/// Corrections at most.
const MAX_STEPS: usize = 8;

/// Samples may be off by this part of the tolerance, as places between them are a little farther.
const GOAL: f64 = 0.9375;

/// After some steps, an error by so many tolerances will not come down.
const HOPELESS: [f64; MAX_STEPS] = [64.0, 6.0, 2.5, 1.625, 1.375, 1.25, 1.125, 1.0625];

/// A parameter is corrected by so many of its units at most.
const STRIDE: f64 = 0.5;

/// After steps as short as this, errors go on to change as before.
const STRAIGHT: f64 = 1.0 / 16.0;

/// Round-off between a normal and where the curve crosses it, in that of a place.
const CROSSING_ROUNDINGS: f64 = 4.0;

/// Samples that are taken first, in case they are hopeless already: of so many one.
const GLANCE: usize = 4;

/// A sample of the curve.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    place: Vector,
    /// Whether it is where an arc over an apex was.
    beyond: bool,
}

/// The search for a number of arcs.
struct Search<'a, 'b> {
    track: &'a Track<'b>,
    links: Links<'a, 'b>,
    /// In the order of the arcs; `range` says which there are.
    samples: [Sample; MOST_ERRORS],
    range: Range<usize>,
}

/// Appends a number of arcs for a part whose density is known; answers whether it can.
pub(super) fn few(
    track: &Track,
    (ends, density): (&Ends, &Density),
    (arcs, tolerance): (usize, f64),
    out: &mut Vec<Cell>,
) -> bool {
    if arcs == 1 && ends.circles == [None; 2] || !(1..=MOST_ARCS).contains(&arcs) {
        return false;
    }
    let links = Links::new(track, (ends, density), (arcs, tolerance));
    let range = BEYOND..BEYOND + arcs * SAMPLES;
    let mut search = Search { track, links, samples: [Sample::default(); MOST_ERRORS], range };
    let Some(chain) = search.begin(ends, density).and_then(|chain| search.run(chain)) else { return false };
    let begin = out.len();
    let proven = search.is_in_order(&chain) && search.prove(&chain, ends, out).is_some();
    if !proven {
        out.truncate(begin);
    }
    proven
}

impl<'a, 'b> Search<'a, 'b> {
    /// Takes samples; answers the chain to begin with, unless some are too far from it.
    fn begin(&mut self, ends: &Ends, density: &Density) -> Option<Chain> {
        let chain = self.links.chain(&Parameters::default())?;
        let inner = self.range.clone();
        let all = |i: usize| i % GLANCE == GLANCE / 2;
        self.take_shares(density, all);
        let glanced = inner.clone().filter(|i| all(i - BEYOND)).map(|i| self.samples[i].place);
        let mut near = 0;
        for place in glanced {
            let (error, next) = self.error(&chain, &Sample { place, beyond: false }, near);
            near = next;
            if error.abs() > HOPELESS[0] || error.is_nan() {
                return None;
            }
        }
        self.take_shares(density, |i| !all(i));
        for end in 0..2 {
            self.take_beyond(ends, end);
        }
        Some(chain)
    }

    /// Samples in the middles of equal shares of the density, or some of them.
    fn take_shares(&mut self, density: &Density, taken: impl Fn(usize) -> bool) {
        let count = self.links.arcs * SAMPLES;
        let share = density.total() / count as f64;
        let mut cursor = Cursor::default();
        for i in 0..count {
            let at = if self.links.backwards { count - 1 - i } else { i };
            if taken(at) {
                let u = density.beyond((i as f64 + 0.5) * share, &mut cursor);
                self.samples[BEYOND + at].place = self.track.place(u);
            }
        }
    }

    /// Samples as far apart beyond an end that slides.
    fn take_beyond(&mut self, ends: &Ends, end: usize) {
        if ends.circles[end].is_none() {
            return;
        }
        let (node, limit) = (ends.nodes[end], ends.reach[end]);
        let behind = self.links.backwards != (end == 1);
        let nearest =
            self.samples[if behind { BEYOND + self.links.arcs * SAMPLES - 1 } else { BEYOND }].place;
        let stride = 2.0 * (nearest - node.place).length();
        let mut near = limit;
        for i in 0..BEYOND {
            let u = self.track.beyond_distance(&node, (i as f64 + 0.5) * stride, (near, limit));
            if (limit - u) * (limit - node.u) <= 0.0 {
                break;
            }
            // The next one is about as far as this one from the one before.
            near = node.u + (u - node.u) * (i as f64 + 1.5) / (i as f64 + 0.5);
            let at = if behind { self.range.end } else { self.range.start - 1 };
            self.samples[at] = Sample { place: self.track.place(u), beyond: true };
            self.range = self.range.start.min(at)..self.range.end.max(at + 1);
        }
    }

    /// How far a sample is to the left of the arcs, in tolerances, and the first joint that it is not before; those
    /// up to `i` it is not.
    fn error(&self, chain: &Chain, sample: &Sample, mut i: usize) -> (f64, usize) {
        let arcs = self.links.arcs;
        while i <= arcs && chain.joints[i].is_before(sample.place) {
            i += 1;
        }
        let error = match i {
            0 if sample.beyond => 0.0,
            0 => self.links.ends[0].joined.left_of(sample.place),
            i if i > arcs && sample.beyond => 0.0,
            i if i > arcs => self.links.ends[1].joined.left_of(sample.place),
            i => chain.joints[i - 1].left_of(sample.place),
        };
        (error / self.links.tolerance, i)
    }

    /// Errors of all samples; answers on which arcs they are, 0 and one too many for none.
    fn take_errors(&self, chain: &Chain, fit: &mut Squares) -> [usize; MOST_ERRORS] {
        let (mut on, mut near) = ([0; MOST_ERRORS], 0);
        for (i, sample) in self.samples[self.range.clone()].iter().enumerate() {
            (fit.errors[i], near) = self.error(chain, sample, near);
            on[i] = near;
        }
        on
    }

    /// Corrects parameters until the arcs are near enough, if they become so.
    fn run(&self, mut chain: Chain) -> Option<Chain> {
        let mut parameters = Parameters::default();
        let mut fit = Squares::new(self.range.len(), self.links.parameters());
        let mut moved = f64::INFINITY;
        for hopeless in HOPELESS {
            let on = self.take_errors(&chain, &mut fit);
            let worst = fit.worst();
            if worst <= GOAL {
                return Some(chain);
            }
            let in_vain = moved <= STRAIGHT && fit.least() > GOAL;
            if worst > hopeless || worst.is_nan() || self.links.parameters() == 0 || in_vain {
                return None;
            }
            if moved.is_finite() {
                fit.weigh(worst);
            }
            if moved > STRAIGHT {
                self.take_slopes((&parameters, &chain), &on, &mut fit);
            }
            let step = fit.step()?;
            let longest = step.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
            let part = (STRIDE / longest).min(1.0);
            // A step too far is taken in halves.
            let (part, next, further) = [part, 0.5 * part, 0.25 * part].into_iter().find_map(|part| {
                let mut other = parameters;
                other.iter_mut().zip(&step).for_each(|(p, s)| *p += part * s);
                self.links.chain(&other).map(|chain| (part, other, chain))
            })?;
            (parameters, chain, moved) = (next, further, part * longest);
        }
        None
    }

    /// How errors change with each parameter; those of samples that are on no arc do not.
    fn take_slopes(
        &self,
        (parameters, chain): (&Parameters, &Chain),
        on: &[usize; MOST_ERRORS],
        fit: &mut Squares,
    ) {
        let (arcs, count) = (self.links.arcs, self.links.parameters());
        let changes = self.links.changes(parameters, chain);
        for (i, sample) in self.samples[self.range.clone()].iter().enumerate() {
            if !(1..=arcs).contains(&on[i]) {
                (0..count).for_each(|j| fit.slopes[j][i] = 0.0);
                continue;
            }
            let seen = Seen::from(&chain.joints[on[i] - 1], sample.place);
            for (j, change) in changes[on[i] - 1][..count].iter().enumerate() {
                fit.slopes[j][i] = seen.change(change) / self.links.tolerance;
            }
        }
    }

    /// Whether curvatures rise or fall all along, those of arcs over apices included.
    fn is_in_order(&self, chain: &Chain) -> bool {
        let mut bends: Vec<f64> = chain.joints[..self.links.arcs].iter().map(|j| j.curvature).collect();
        if self.links.ends[0].slides {
            bends.insert(0, self.links.ends[0].joined.curvature);
        }
        if self.links.ends[1].slides {
            bends.push(self.links.ends[1].joined.curvature);
        }
        bends.windows(2).all(|w| w[1] > w[0]) || bends.windows(2).all(|w| w[1] < w[0])
    }

    /// Appends the arcs, if all are proven.
    fn prove(&self, chain: &Chain, ends: &Ends, out: &mut Vec<Cell>) -> Option<()> {
        let n = self.links.arcs;
        let mut arcs = chain.arcs[..n].to_vec();
        if self.links.backwards {
            arcs.reverse();
            arcs.iter_mut().for_each(|a| *a = Arc { start: a.end, end: a.start, bulge: -a.bulge });
        }
        let ([from, to], [low, high]) = (ends.nodes.map(|node| node.u), ends.reach);
        let (first, last) = (arcs[0], arcs[n - 1]);
        let mut at = match ends.circles[0] {
            Some(_) => self.crossing((first.start, first.start_tangent()), [low, from, high])?,
            None => from,
        };
        let end = match ends.circles[1] {
            Some(_) => self.crossing((last.end, last.end_tangent()), [at, to, high])?,
            None => to,
        };
        for (i, pair) in arcs.chunks(2).enumerate() {
            let mut cell = Cell::alone(pair[0], [at, at], Distance::ZERO);
            for (j, arc) in pair.iter().enumerate() {
                let next = match 2 * i + j + 1 == n {
                    true => end,
                    false => self.crossing((arc.end, arc.end_tangent()), [at, 0.5 * (at + end), end])?,
                };
                let distance = self.track.prove_arc(arc, at, next, self.links.tolerance);
                if next <= at || distance.bound.is_nan() || distance.bound > self.links.tolerance {
                    return None;
                }
                cell.distance = cell.distance.max(distance);
                (cell.arcs[j], cell.to) = (*arc, next);
                cell.joint = if j == 0 { next } else { cell.joint };
                at = next;
            }
            out.push(cell);
        }
        Some(())
    }

    /// The parameter between two others where the curve crosses the normal at a place, if it does.
    fn crossing(&self, (place, tangent): (Vector, Vector), between: [f64; 3]) -> Option<f64> {
        let u = self.track.beyond(place, tangent, between);
        let off = (self.track.place(u) - place).dot(tangent).abs();
        (off <= CROSSING_ROUNDINGS * self.track.noise()).then_some(u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::boundary::freeform::track::Side;
    use crate::geom::{point, vector};

    #[test]
    fn a_few_arcs_are_within_the_tolerance_or_none() {
        let quarter = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.2, 1.3).unwrap();
        let pieces = quarter.pieces().unwrap();
        let track = Track::new(&pieces);
        let ends = Ends::of([track.cut_node(0.0, Side::After), track.cut_node(1.0, Side::Before)]);
        let mut density = Density::default();
        // The finest tolerance of those below.
        let finest = 0.5f64.powi(24);
        density
            .fill(&track, (&ends.nodes, finest), |jet| jet.d1.length() * jet.curvature_slope().abs().cbrt());
        let mut found = Vec::new();
        for arcs in 1..=MOST_ARCS {
            let mut cells = Vec::new();
            // The finest tolerance within which so many arcs are found.
            let mut fits = |e: &i32| few(&track, (&ends, &density), (arcs, 0.5f64.powi(*e)), &mut cells);
            let finest = (4..24).take_while(|e| fits(e)).last();
            let ends_meet = cells.iter().flat_map(Cell::spans).map(|(arc, ..)| arc).collect::<Vec<Arc>>();
            assert!(
                ends_meet.windows(2).all(|w| w[0].end == w[1].start || w[1].start == ends.nodes[0].place)
            );
            assert!(cells.iter().flat_map(Cell::spans).all(|(arc, from, to)| {
                let at = |i: i32| track.place(from + (to - from) * f64::from(i) / 64.0);
                (0..=64).all(|i| arc.distance(at(i)) <= 0.5f64.powi(4))
            }));
            found.extend(finest);
        }
        assert!(found.len() == MOST_ARCS - 1 && found.is_sorted() && found[3] >= found[0] + 3, "{found:?}");
    }
}
