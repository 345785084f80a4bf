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
use super::density::{Cursor, Density};
use super::layout::Ends;
use super::spiral::Cell;
use super::squares::{Parameters, Squares};
use super::track::Track;
use crate::geom::Vector;

/// Samples of the curve for each arc, and beyond each end.
const SAMPLES: usize = 8;
const BEYOND: usize = 3;

/// Corrections at most.
const MAX_STEPS: usize = 8;

/// Samples may be off by this part of the tolerance, as places between them are a little farther.
const GOAL: f64 = 0.9375;

/// After some steps, an error by so many tolerances will not come down.
const HOPELESS: [f64; MAX_STEPS] = [64.0, 6.0, 2.5, 1.625, 1.375, 1.25, 1.125, 1.0625];

/// Difference of a parameter that tells a derivative, in the unit of that parameter: a part of an arc or
/// the tolerance. Round-off of errors becomes larger by its inverse.
const DIFFERENCE: f64 = 1.0 / 16.0;

/// A parameter is corrected by so many of its units at most.
const STRIDE: f64 = 0.5;

/// After steps as short as this, errors go on to change as before.
const STRAIGHT: f64 = 1.0 / 16.0;

/// Round-off between a normal and where the curve crosses it, in that of a place.
const CROSSING_ROUNDINGS: f64 = 4.0;

/// A sample of the curve.
#[derive(Clone, Copy, Debug)]
struct Sample {
    place: Vector,
    /// Whether it is where an arc over an apex was.
    beyond: bool,
}

/// The search for a number of arcs.
struct Search<'a, 'b> {
    track: &'a Track<'b>,
    links: Links<'a, 'b>,
    samples: Vec<Sample>,
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
    let mut search = Search { track, links, samples: Vec::with_capacity(arcs * SAMPLES + 2 * BEYOND) };
    search.take_samples(ends, density);
    let Some(chain) = search.run() else { return false };
    let begin = out.len();
    let proven = search.is_in_order(&chain) && search.prove(&chain, ends, out).is_some();
    if !proven {
        out.truncate(begin);
    }
    proven
}

impl<'a, 'b> Search<'a, 'b> {
    /// Samples in the middles of equal shares of the density, and as far apart beyond the ends.
    fn take_samples(&mut self, ends: &Ends, density: &Density) {
        let (track, count) = (self.track, self.links.arcs * SAMPLES);
        let share = density.total() / count as f64;
        let mut cursor = Cursor::default();
        let shares = (0..count).map(|i| density.beyond((i as f64 + 0.5) * share, &mut cursor));
        let inner: Vec<Vector> = shares.map(|u| track.place(u)).collect();
        let beyond = |end: usize, nearest: Vector| {
            let (node, limit) = (ends.nodes[end], ends.reach[end]);
            let stride = 2.0 * (nearest - node.place).length();
            let count = if ends.circles[end].is_some() { BEYOND } else { 0 };
            let parameter = move |i| track.beyond_distance(&node, (i as f64 + 0.5) * stride, (limit, limit));
            (0..count).map(parameter).take_while(move |&u| u != limit).map(move |u| track.place(u))
        };
        self.samples.extend(beyond(0, inner[0]).map(|place| Sample { place, beyond: true }));
        self.samples.reverse();
        self.samples.extend(inner.iter().map(|&place| Sample { place, beyond: false }));
        self.samples.extend(beyond(1, inner[count - 1]).map(|place| Sample { place, beyond: true }));
        if self.links.backwards {
            self.samples.reverse();
        }
    }

    /// How far samples are to the left of the arcs, in tolerances.
    fn errors(&self, chain: &Chain, errors: &mut Vec<f64>) {
        errors.clear();
        let mut i = 0;
        for sample in &self.samples {
            while i <= self.links.arcs && chain.joints[i].is_before(sample.place) {
                i += 1;
            }
            let inside = i > 0 && i <= self.links.arcs;
            let error = match i {
                _ if !inside && sample.beyond => 0.0,
                0 => self.links.ends[0].joined.left_of(sample.place),
                i if i > self.links.arcs => self.links.ends[1].joined.left_of(sample.place),
                i => chain.joints[i - 1].left_of(sample.place),
            };
            errors.push(error / self.links.tolerance);
        }
    }

    /// Corrects parameters until the arcs are near enough, if they become so.
    fn run(&self) -> Option<Chain> {
        let mut parameters = Parameters::default();
        let mut chain = self.links.chain(&parameters)?;
        let mut fit = Squares::new(self.samples.len(), self.links.parameters());
        let mut moved = f64::INFINITY;
        for hopeless in HOPELESS {
            self.errors(&chain, &mut fit.errors);
            let worst = fit.errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
            if worst <= GOAL {
                return Some(chain);
            }
            let in_vain = moved <= STRAIGHT && fit.least() > GOAL;
            if worst > hopeless || worst.is_nan() || fit.slopes.is_empty() || in_vain {
                return None;
            }
            if moved.is_finite() {
                fit.weigh(worst);
            }
            if moved > STRAIGHT {
                self.take_slopes(&parameters, &mut fit)?;
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

    /// How errors change with each parameter.
    fn take_slopes(&self, parameters: &Parameters, fit: &mut Squares) -> Option<()> {
        for (i, slope) in fit.slopes.iter_mut().enumerate() {
            let mut other = *parameters;
            other[i] += DIFFERENCE;
            self.errors(&self.links.chain(&other)?, slope);
            slope.iter_mut().zip(&fit.errors).for_each(|(c, e)| *c = (*c - e) / DIFFERENCE);
        }
        Some(())
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
