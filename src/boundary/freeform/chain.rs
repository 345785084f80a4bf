//! Chains of a few arcs with common tangents between two ends that may slide.
//!
//! **Guarantees** that tangents agree at all joints, whatever the parameters are, and that these have units in
//! which they matter about as much: parts of an arc, and tolerances. How chains change with them is in
//! [`super::changes`].

use super::biarc::{Arc, Joint, Node, biarc};
use super::density::{Cursor, Density};
use super::layout::Ends;
use super::squares::{MOST_PARAMETERS, Parameters};
use super::track::Track;
use crate::geom::Vector;

/// So many arcs at most: there are two slides, two parameters for each knot but the last, and the joint.
pub(super) const MOST_ARCS: usize = MOST_PARAMETERS.div_ceil(2);

/// A place with a tangent, where an arc of some curvature begins.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Joined {
    pub place: Vector,
    pub tangent: Vector,
    pub curvature: f64,
}

impl Joined {
    /// The same circle after some length.
    fn after(&self, length: f64) -> Joined {
        let angle = self.curvature * length;
        let (half, cos_half) = (0.5 * angle).sin_cos();
        let (sin, cos) = (2.0 * half * cos_half, 1.0 - 2.0 * half * half);
        let (along, aside) = if angle == 0.0 {
            (length, 0.0)
        } else {
            (sin / self.curvature, 2.0 * half * half / self.curvature)
        };
        let place = self.place + self.tangent * along + self.tangent.left() * aside;
        Joined { place, tangent: self.tangent.rotated(cos, sin), ..*self }
    }

    /// How far a place is to the left of the circle, about.
    pub fn left_of(&self, p: Vector) -> f64 {
        let w = p - self.place;
        w.dot(self.tangent.left()) - 0.5 * self.curvature * w.length_squared()
    }

    /// Whether a place is ahead.
    pub fn is_before(&self, p: Vector) -> bool {
        (p - self.place).dot(self.tangent) > 0.0
    }
}

/// An end of the part, as the search runs.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The node, with the circle that it slides along.
    pub joined: Joined,
    /// Whether it may slide along an arc over an apex.
    pub slides: bool,
}

/// Arcs one behind the other, and the circles at both ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    /// The arcs; those that are too many are of no use.
    pub arcs: [Arc; MOST_ARCS],
    /// Where arcs begin, and where the last one ends.
    pub joints: [Joined; MOST_ARCS + 1],
}

/// What chains of a number of arcs are made of.
#[derive(Debug)]
pub(super) struct Links<'a, 'b> {
    track: &'a Track<'b>,
    /// The ends, as chains run.
    pub ends: [End; 2],
    /// Whether chains run against the curve.
    pub backwards: bool,
    /// Whether the curvature falls along chains.
    falls: bool,
    /// The number of arcs.
    pub arcs: usize,
    /// The unit of distances from the curve.
    pub tolerance: f64,
    /// Length of an arc, about.
    pub length: f64,
    /// Where knots are to begin with: at equal shares of the density, with the curvature of the curve.
    knots: [Joined; MOST_ARCS],
}

impl<'a, 'b> Links<'a, 'b> {
    /// For a number of arcs along a part whose density is known. They run from the end that bends more, so that
    /// it does not matter which way the curve is run; one arc alone leaves an end that does not slide.
    pub fn new(
        track: &'a Track<'b>,
        (ends, density): (&Ends, &Density),
        (arcs, tolerance): (usize, f64),
    ) -> Links<'a, 'b> {
        let [a, b] = ends.nodes;
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
        let ends = if backwards { [end(1), end(0)] } else { [end(0), end(1)] };
        let length = (b.place - a.place).length() / arcs as f64;
        let falls = ends[1].joined.curvature < ends[0].joined.curvature;
        let (mut knots, mut cursor) = ([Joined::default(); MOST_ARCS], Cursor::default());
        let sign = if backwards { -1.0 } else { 1.0 };
        for i in 1..(arcs - 1).max(1) {
            let part = if backwards { i + 1 } else { i };
            let node = track.node(density.beyond(density.total() * part as f64 / arcs as f64, &mut cursor));
            let knot = if backwards { arcs - 1 - i } else { i };
            let (tangent, curvature) = (node.tangent * sign, node.curvature * sign);
            knots[knot] = Joined { place: node.place, tangent, curvature };
        }
        Links { track, ends, backwards, falls, arcs, tolerance, length, knots }
    }

    /// The number of parameters: those of knots, the slides, and the joint of the last two arcs.
    pub fn parameters(&self) -> usize {
        if self.arcs == 1 {
            return usize::from(self.ends[0].slides);
        }
        2 * (self.arcs - 2) + 1 + self.ends.iter().filter(|e| e.slides).count()
    }

    /// The arcs for some parameters.
    pub fn chain(&self, parameters: &Parameters) -> Option<Chain> {
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

    /// A knot moved by a part of an arc along a parabola that bends as the curve does, and from there by some
    /// tolerances: to the side that the circle at the far end is on, so that mirrored curves have mirrored knots.
    fn knot(&self, i: usize, along: f64, aside: f64) -> Vector {
        let (knot, length) = (&self.knots[i], self.length * along);
        let rise = 0.5 * knot.curvature * length * length + self.aside() * aside;
        self.track.grid.snap(knot.place + knot.tangent * length + knot.tangent.left() * rise)
    }

    /// How a knot, moved along by a part of an arc, moves with both of its parameters.
    pub fn moves(&self, i: usize, along: f64) -> [Vector; 2] {
        let (knot, length) = (&self.knots[i], self.length * along);
        let left = knot.tangent.left();
        [(knot.tangent + left * (knot.curvature * length)) * self.length, left * self.aside()]
    }

    /// The unit of moves to the left.
    fn aside(&self) -> f64 {
        if self.falls { -self.tolerance } else { self.tolerance }
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector;

    #[test]
    fn a_circle_goes_on_as_far_as_it_is_long() {
        let from = Joined { place: vector(2.0, 0.0), tangent: vector(0.0, 1.0), curvature: 0.5 };
        let quarter = from.after(std::f64::consts::PI);
        assert!((quarter.place - vector(0.0, 2.0)).length() < 1e-15);
        assert!((quarter.tangent - vector(-1.0, 0.0)).length() < 1e-15);
        assert!(from.left_of(quarter.place).abs() < 1e-15 && from.is_before(quarter.place));
        let line = Joined { curvature: 0.0, ..from }.after(3.0);
        assert_eq!((line.place, line.tangent), (vector(2.0, 3.0), vector(0.0, 1.0)));
    }
}
