//! A few arcs between two arcs over apices, or nodes, by a search for the least error.
//!
//! **Needs** so short a part of the curve that a handful of arcs may do, of monotone curvature.
//! **Guarantees** arcs within the tolerance, proven, whose curvatures are monotone with those of the arcs over
//! apices. These become longer or shorter: their ends slide along their circles. The same curve run
//! backwards has the same arcs. **Does not** promise to find arcs where there are any.
//!
//! **Method.** Each arc leaves the one before to a knot beside the curve; the last two are a biarc, and one arc
//! alone touches both circles. So tangents agree whatever the parameters are: the slides, the places of knots
//! along the curve and beside it, and the joint of the biarc. Those are corrected by the method of Gauss and
//! Newton for distances of samples of the curve from the arcs; samples that are far weigh more and more
//! (Lawson), which leads to the least largest distance.

use super::biarc::{Arc, Joint, Node, biarc};
use super::bound::Distance;
use super::density::{Cursor, Density};
use super::layout::Ends;
use super::spiral::Cell;
use super::track::Track;
use crate::geom::Vector;

/// So many arcs at most.
pub(super) const MOST_ARCS: usize = 5;

/// Parameters at most: two slides, two for each knot but the last, and the joint.
const MOST_PARAMETERS: usize = 2 * MOST_ARCS - 1;

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
/// the tolerance.
const DIFFERENCE: f64 = 1.0 / 1024.0;

/// A parameter is corrected by so many of its units at most.
const STRIDE: f64 = 0.5;

/// After steps as short as this, errors go on to change as before.
const STRAIGHT: f64 = 1.0 / 16.0;

/// Keeps corrections finite where a parameter does nothing.
const DAMPING: f64 = 1e-9;

/// A place with a tangent, where an arc of some curvature begins.
#[derive(Clone, Copy, Debug, Default)]
struct Joined {
    place: Vector,
    tangent: Vector,
    curvature: f64,
}

impl Joined {
    /// The same circle after some length.
    fn after(&self, length: f64) -> Joined {
        let angle = self.curvature * length;
        let (sin, cos) = angle.sin_cos();
        let half = (0.5 * angle).sin();
        let (along, aside) = if angle == 0.0 {
            (length, 0.0)
        } else {
            (sin / self.curvature, 2.0 * half * half / self.curvature)
        };
        let place = self.place + self.tangent * along + self.tangent.left() * aside;
        Joined { place, tangent: self.tangent.rotated(cos, sin), ..*self }
    }

    /// How far a place is to the left of the circle, about.
    fn left_of(&self, p: Vector) -> f64 {
        let w = p - self.place;
        w.dot(self.tangent.left()) - 0.5 * self.curvature * w.length_squared()
    }

    fn is_before(&self, p: Vector) -> bool {
        (p - self.place).dot(self.tangent) > 0.0
    }
}

/// An end of the part, as the search runs.
#[derive(Clone, Copy, Debug)]
struct End {
    joined: Joined,
    /// Whether it may slide along an arc over an apex.
    slides: bool,
}

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
    density: &'a Density,
    ends: [End; 2],
    /// Whether it runs against the curve.
    backwards: bool,
    arcs: usize,
    tolerance: f64,
    samples: Vec<Sample>,
    /// Length of an arc, about.
    length: f64,
}

/// Parameters, in their units.
type Parameters = [f64; MOST_PARAMETERS];

/// Arcs one behind the other, and the circles at both ends.
#[derive(Clone, Copy, Debug)]
struct Chain {
    arcs: [Arc; MOST_ARCS],
    /// Where arcs begin, and where the last one ends.
    joints: [Joined; MOST_ARCS + 1],
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
    let search = Search::new(track, (ends, density), (arcs, tolerance));
    let Some(chain) = search.run() else { return false };
    let begin = out.len();
    let proven = search.is_in_order(&chain) && search.prove(&chain, ends, out).is_some();
    if !proven {
        out.truncate(begin);
    }
    proven
}

impl<'a, 'b> Search<'a, 'b> {
    fn new(
        track: &'a Track<'b>,
        (ends, density): (&Ends, &'a Density),
        (arcs, tolerance): (usize, f64),
    ) -> Search<'a, 'b> {
        let [a, b] = ends.nodes;
        // From the end that bends more, so that it does not matter which way the curve is run; one arc alone
        // leaves an end that does not slide.
        let backwards = match ends.circles {
            [None, Some(_)] if arcs == 1 => false,
            [Some(_), None] if arcs == 1 => true,
            _ => b.curvature.abs() > a.curvature.abs(),
        };
        let end = |i: usize| {
            let (node, sign) = (&ends.nodes[i], if backwards { -1.0 } else { 1.0 });
            let curvature = sign * ends.circles[i].unwrap_or(node.curvature);
            let joined = Joined { place: node.place, tangent: node.tangent * sign, curvature };
            End { joined, slides: ends.circles[i].is_some() }
        };
        let ends_here = if backwards { [end(1), end(0)] } else { [end(0), end(1)] };
        let length = (b.place - a.place).length() / arcs as f64;
        let mut search = Search {
            track,
            density,
            ends: ends_here,
            backwards,
            arcs,
            tolerance,
            samples: Vec::with_capacity(arcs * SAMPLES + 2 * BEYOND),
            length,
        };
        search.take_samples(ends);
        search
    }

    /// Samples in the middles of equal shares of the density, and as far apart beyond the ends.
    fn take_samples(&mut self, ends: &Ends) {
        let (track, count) = (self.track, self.arcs * SAMPLES);
        let share = self.density.total() / count as f64;
        let mut cursor = Cursor::default();
        let shares = (0..count).map(|i| self.density.beyond((i as f64 + 0.5) * share, &mut cursor));
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
        if self.backwards {
            self.samples.reverse();
        }
    }

    /// The number of parameters: those of knots, the slides, and the joint of the last two arcs.
    fn parameters(&self) -> usize {
        if self.arcs == 1 {
            return usize::from(self.ends[0].slides);
        }
        2 * (self.arcs - 2) + 1 + self.ends.iter().filter(|e| e.slides).count()
    }

    /// The arcs for some parameters.
    fn chain(&self, parameters: &Parameters) -> Option<Chain> {
        let mut next = parameters.iter();
        let mut slid = |end: &End, sign: f64| {
            if !end.slides {
                return Some(end.joined);
            }
            let joined = end.joined.after(sign * self.length * next.next()?);
            Some(Joined { place: self.track.grid.snap(joined.place), ..joined })
        };
        let first = slid(&self.ends[0], 1.0)?;
        if self.arcs == 1 {
            return self.touching(&first);
        }
        let last = slid(&self.ends[1], -1.0)?;
        let none = Arc { start: first.place, end: first.place, bulge: 0.0 };
        let mut chain = Chain { arcs: [none; MOST_ARCS], joints: [first; MOST_ARCS + 1] };
        let mut at = first;
        for i in 0..self.arcs - 2 {
            let knot = self.knot(i + 1, *next.next()?, *next.next()?);
            let arc = Arc::leaving(at.place, at.tangent, knot);
            chain.arcs[i] = arc;
            chain.joints[i] = Joined { curvature: arc.curvature(), ..at };
            at = Joined { place: knot, tangent: arc.end_tangent(), curvature: 0.0 };
        }
        let [a, b] = [at, last].map(|j| Node { u: 0.0, place: j.place, tangent: j.tangent, curvature: 0.0 });
        let shift = *next.next()?;
        if shift.abs() >= 1.0 {
            return None;
        }
        let pair = biarc(&a, &b, Joint::Shifted(shift), self.track.grid)?;
        let n = self.arcs;
        (chain.arcs[n - 2], chain.arcs[n - 1]) = (pair[0], pair[1]);
        chain.joints[n - 2] = Joined { curvature: pair[0].curvature(), ..at };
        let (place, tangent) = (pair[1].start, pair[0].end_tangent());
        chain.joints[n - 1] = Joined { place, tangent, curvature: pair[1].curvature() };
        chain.joints[n] = last;
        chain.arcs[..n].iter().all(|arc| arc.bulge.is_finite() && arc.bulge.abs() < 1.0).then_some(chain)
    }

    /// The place at a share of the density, moved from its own share by a part of one, beside the curve by
    /// some tolerances.
    fn knot(&self, i: usize, along: f64, aside: f64) -> Vector {
        let part = (i as f64 + along) / self.arcs as f64;
        let share = self.density.total() * if self.backwards { 1.0 - part } else { part };
        let share = share.clamp(0.0, self.density.total());
        let node = self.track.node(self.density.beyond(share, &mut Cursor::default()));
        let aside = if self.backwards { -aside } else { aside };
        self.track.grid.snap(node.place + node.tangent.left() * (aside * self.tolerance))
    }

    /// The arc that leaves a place along its tangent and touches the circle at the other end.
    fn touching(&self, from: &Joined) -> Option<Chain> {
        let circle = &self.ends[1].joined;
        let w = from.place - circle.place;
        let (n, m) = (from.tangent.left(), circle.tangent.left());
        let turn = 0.5 * (m - n).length_squared();
        let power = w.dot(m) - 0.5 * circle.curvature * w.length_squared();
        let k = (circle.curvature * w.dot(n) + turn) / power;
        let difference = k - circle.curvature;
        let at = ((m * k - n * circle.curvature - w * (k * circle.curvature)) / difference).unit();
        let end = if k.abs() > circle.curvature.abs() {
            from.place + (n - at) / k
        } else {
            circle.place + (m - at) / circle.curvature
        };
        let arc = Arc::leaving(from.place, from.tangent, self.track.grid.snap(end));
        let mut chain = Chain { arcs: [arc; MOST_ARCS], joints: [*from; MOST_ARCS + 1] };
        chain.joints[0].curvature = k;
        chain.joints[1] = Joined { place: arc.end, tangent: arc.end_tangent(), curvature: circle.curvature };
        let fits = arc.bulge.abs() < 1.0 && (at.dot(m) > 0.0) && arc.end != arc.start;
        fits.then_some(chain)
    }

    /// How far samples are to the left of the arcs, in tolerances.
    fn errors(&self, chain: &Chain, errors: &mut Vec<f64>) {
        errors.clear();
        let mut i = 0;
        for sample in &self.samples {
            while i <= self.arcs && chain.joints[i].is_before(sample.place) {
                i += 1;
            }
            let inside = i > 0 && i <= self.arcs;
            let error = match i {
                _ if !inside && sample.beyond => 0.0,
                0 => self.ends[0].joined.left_of(sample.place),
                i if i > self.arcs => self.ends[1].joined.left_of(sample.place),
                i => chain.joints[i - 1].left_of(sample.place),
            };
            errors.push(error / self.tolerance);
        }
    }

    /// Corrects parameters until the arcs are near enough, if they become so.
    fn run(&self) -> Option<Chain> {
        let mut parameters = Parameters::default();
        let mut chain = self.chain(&parameters)?;
        let mut fit = Squares::new(self.samples.len(), self.parameters());
        let mut moved = f64::INFINITY;
        for hopeless in HOPELESS {
            self.errors(&chain, &mut fit.errors);
            let worst = fit.errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
            if worst <= GOAL {
                return Some(chain);
            }
            let in_vain = moved <= STRAIGHT && fit.least() > 1.0;
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
                self.chain(&other).map(|chain| (part, other, chain))
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
            self.errors(&self.chain(&other)?, slope);
            slope.iter_mut().zip(&fit.errors).for_each(|(c, e)| *c = (*c - e) / DIFFERENCE);
        }
        Some(())
    }

    /// Whether curvatures rise or fall all along, those of arcs over apices included.
    fn is_in_order(&self, chain: &Chain) -> bool {
        let mut bends: Vec<f64> = chain.joints[..self.arcs].iter().map(|j| j.curvature).collect();
        if self.ends[0].slides {
            bends.insert(0, self.ends[0].joined.curvature);
        }
        if self.ends[1].slides {
            bends.push(self.ends[1].joined.curvature);
        }
        bends.windows(2).all(|w| w[1] > w[0]) || bends.windows(2).all(|w| w[1] < w[0])
    }

    /// Appends the arcs, if all are proven.
    fn prove(&self, chain: &Chain, ends: &Ends, out: &mut Vec<Cell>) -> Option<()> {
        let n = self.arcs;
        let mut arcs = chain.arcs[..n].to_vec();
        if self.backwards {
            arcs.reverse();
            arcs.iter_mut().for_each(|a| *a = Arc { start: a.end, end: a.start, bulge: -a.bulge });
        }
        let [from, to] = ends.nodes.map(|node| node.u);
        let (low, high) = (ends.reach[0], ends.reach[1]);
        let mut at = if ends.circles[0].is_some() {
            self.track.beyond(arcs[0].start, arcs[0].start_tangent(), [low, from, high])
        } else {
            from
        };
        let last = if ends.circles[1].is_some() {
            self.track.beyond(arcs[n - 1].end, arcs[n - 1].end_tangent(), [at, to, high])
        } else {
            to
        };
        for pair in arcs.chunks(2) {
            let mut cell = Cell::alone(pair[0], [at, at], Distance::ZERO);
            for (i, arc) in pair.iter().enumerate() {
                let is_last = arc.end == arcs[n - 1].end;
                let near = at + (last - at) * 0.5;
                let next = if is_last {
                    last
                } else {
                    self.track.beyond(arc.end, arc.end_tangent(), [at, near, last])
                };
                if next <= at {
                    return None;
                }
                let distance = self.track.prove_arc(arc, at, next, self.tolerance);
                if distance.bound > self.tolerance || distance.bound.is_nan() {
                    return None;
                }
                cell.distance = cell.distance.max(distance);
                (cell.arcs[i], cell.to) = (*arc, next);
                cell.joint = if i == 0 { next } else { cell.joint };
                at = next;
            }
            out.push(cell);
        }
        Some(())
    }
}

/// Errors, how they change with each parameter, and how much they weigh.
struct Squares {
    errors: Vec<f64>,
    slopes: Vec<Vec<f64>>,
    weights: Vec<f64>,
}

impl Squares {
    fn new(samples: usize, parameters: usize) -> Squares {
        let slopes = (0..parameters).map(|_| Vec::with_capacity(samples)).collect();
        Squares { errors: Vec::with_capacity(samples), slopes, weights: vec![1.0; samples] }
    }

    /// The weighted mean of errors that are as small as they can be: no largest one can be smaller.
    fn least(&self) -> f64 {
        let sum: f64 = self.weights.iter().zip(&self.errors).map(|(w, e)| w * e * e).sum();
        (sum / self.weights.iter().sum::<f64>()).sqrt()
    }

    /// The step that makes the weighted squares least.
    fn step(&mut self) -> Option<Parameters> {
        let n = self.slopes.len();
        let mut matrix = [[0.0; MOST_PARAMETERS + 1]; MOST_PARAMETERS];
        let mut weighted = vec![0.0; self.weights.len()];
        for (i, slope) in self.slopes.iter().enumerate() {
            for ((to, w), a) in weighted.iter_mut().zip(&self.weights).zip(slope) {
                *to = w * a;
            }
            let with = |other: &[f64]| weighted.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
            for (j, other) in self.slopes.iter().enumerate().skip(i) {
                let sum = with(other);
                (matrix[i][j], matrix[j][i]) = (sum, sum);
            }
            matrix[i][n] = -with(&self.errors);
        }
        let most = (0..n).map(|i| matrix[i][i]).fold(0.0, f64::max);
        (0..n).for_each(|i| matrix[i][i] += DAMPING * most);
        solved(&mut matrix, n)
    }

    /// What is far weighs more.
    fn weigh(&mut self, worst: f64) {
        for (weight, error) in self.weights.iter_mut().zip(&self.errors) {
            *weight *= error.abs() / worst + DAMPING;
        }
    }
}

/// Solves a symmetric system with positive pivots.
fn solved(matrix: &mut [[f64; MOST_PARAMETERS + 1]; MOST_PARAMETERS], n: usize) -> Option<Parameters> {
    for i in 0..n {
        let row = matrix[i];
        if row[i] <= 0.0 || row[i].is_nan() {
            return None;
        }
        for other in &mut matrix[i + 1..n] {
            let factor = other[i] / row[i];
            other.iter_mut().zip(&row).for_each(|(a, b)| *a -= factor * b);
        }
    }
    let mut step = Parameters::default();
    for i in (0..n).rev() {
        let row = &matrix[i];
        let rest: f64 = row[i + 1..n].iter().zip(&step[i + 1..n]).map(|(a, b)| a * b).sum();
        step[i] = (row[n] - rest) / row[i];
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}
