//! One piece of an arc spline: a straight segment or a circular arc.
//!
//! Everything is computed from chord and bulge, or from one end with its normal and the
//! curvature, never from the center: an arc may be as good as straight, and a center far away
//! would cost all digits.

use super::{Bounds, Point, Vector, vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A segment (`bulge` 0) or a circular arc from `start` to `end`.
///
/// `bulge = tan(sweep / 4)`, positive when the arc turns counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Element {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// Tangent of a quarter of the swept angle.
    pub bulge: f64,
}

/// Place on an element nearest to some other place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The place on the element.
    pub point: Point,
    /// How far it is.
    pub distance: f64,
}

impl Element {
    /// The straight segment between two places.
    pub const fn segment(start: Point, end: Point) -> Element {
        Element { start, end, bulge: 0.0 }
    }

    /// The arc of a given bulge.
    pub const fn arc(start: Point, end: Point, bulge: f64) -> Element {
        Element { start, end, bulge }
    }

    /// Whether it is straight.
    #[inline]
    pub fn is_segment(&self) -> bool {
        self.bulge == 0.0
    }

    /// From start to end.
    #[inline]
    pub fn chord(&self) -> Vector {
        self.end - self.start
    }

    /// Swept angle in radians, counter-clockwise positive.
    #[inline]
    pub fn sweep(&self) -> f64 {
        4.0 * self.bulge.atan()
    }

    /// Signed curvature, left turn positive: `sin(sweep / 2) / (chord / 2)`.
    pub fn curvature(&self) -> f64 {
        if self.bulge == 0.0 {
            return 0.0;
        }
        let b = self.bulge;
        4.0 * b / ((1.0 + b * b) * self.chord().length())
    }

    /// Unit tangents in direction of travel at start and end.
    pub fn tangents(&self) -> (Vector, Vector) {
        let u = self.chord().unit();
        if self.bulge == 0.0 {
            return (u, u);
        }
        let (cos, sin) = self.half_turn();
        (u.rotated(cos, -sin), u.rotated(cos, sin))
    }

    /// Unit normals to the left of the direction of travel at start and end.
    pub fn normals(&self) -> (Vector, Vector) {
        let (t0, t1) = self.tangents();
        (t0.left(), t1.left())
    }

    /// Cosine and sine of half the sweep.
    fn half_turn(&self) -> (f64, f64) {
        let b2 = self.bulge * self.bulge;
        ((1.0 - b2) * (1.0 + b2).recip(), 2.0 * self.bulge / (1.0 + b2))
    }

    /// Center and radius of an arc; `None` for a segment.
    pub fn center(&self) -> Option<(Point, f64)> {
        if self.bulge == 0.0 {
            return None;
        }
        let b = self.bulge;
        let to_center = self.chord().left() * ((1.0 - b * b) / (4.0 * b));
        let radius = self.chord().length() * (1.0 + b * b) / (4.0 * b.abs());
        Some((self.start.midpoint(self.end) + to_center, radius))
    }

    /// Length along the curve.
    pub fn length(&self) -> f64 {
        let (b, chord) = (self.bulge, self.chord().length());
        if b == 0.0 { chord } else { chord * (b.atan() / b) * (1.0 + b * b) }
    }

    /// Place at parameter `t` in 0..=1, proportional to length.
    pub fn point_at(&self, t: f64) -> Point {
        if t <= 0.0 {
            return self.start;
        }
        if t >= 1.0 {
            return self.end;
        }
        let chord = self.chord();
        let half = 0.5 * self.sweep();
        if half == 0.0 {
            return self.start + chord * t;
        }
        // From the nearer end, so that the ends are met without cancellation.
        let (base, t, sign) = if t <= 0.5 { (self.start, t, 1.0) } else { (self.end, 1.0 - t, -1.0) };
        let (sin, cos) = (sign * (1.0 - t) * half).sin_cos();
        base + chord.rotated(cos, -sin) * (sign * (half * t).sin() / half.sin())
    }

    /// Place halfway along.
    pub fn midpoint(&self) -> Point {
        self.start.midpoint(self.end) + self.chord().right() * (0.5 * self.bulge)
    }

    /// Unit normal to the left of the direction of travel at parameter `t`.
    pub fn normal_at(&self, t: f64) -> Vector {
        let (sin, cos) = (self.sweep() * t).sin_cos();
        self.normals().0.rotated(cos, sin)
    }

    /// The part between two parameters.
    pub fn part(&self, from: f64, to: f64) -> Element {
        let bulge = if self.bulge == 0.0 { 0.0 } else { (self.bulge.atan() * (to - from)).tan() };
        Element { start: self.point_at(from), end: self.point_at(to), bulge }
    }

    /// The two parts before and after parameter `t`, which share a place.
    pub fn split(&self, t: f64) -> (Element, Element) {
        (self.part(0.0, t), self.part(t, 1.0))
    }

    /// The same curve run backwards.
    pub fn reversed(&self) -> Element {
        Element { start: self.end, end: self.start, bulge: 0.0 - self.bulge }
    }

    /// Largest distance of a place of the element from `p`.
    pub fn farthest(&self, p: Point) -> f64 {
        let ends = self.start.distance(p).max(self.end.distance(p));
        // On a circle the farthest place lies beyond the center.
        let beyond = self.center().map(|(center, radius)| (center + (center - p), radius));
        let through = beyond.filter(|(opposite, _)| (0.0..=1.0).contains(&self.parameter(*opposite)));
        through.map_or(ends, |(opposite, radius)| ends.max(0.5 * opposite.distance(p) + radius))
    }

    /// Parameter of the place on the full circle or line nearest to `p`: in 0..=1 on the element.
    /// Outside, an arc answers the parameter of the turn that is the shorter way from the element.
    pub fn parameter(&self, p: Point) -> f64 {
        let chord = self.chord();
        if self.bulge == 0.0 {
            return (p - self.start).dot(chord) / chord.length_squared();
        }
        // The turn from the normal at the nearer end, in curvature form: exact also for flat arcs.
        let (k, sweep) = (self.curvature(), self.sweep());
        let turn_from = |end: Point, normal: Vector| {
            let w = p - end;
            (k * w.cross(normal)).atan2(1.0 - k * w.dot(normal))
        };
        let (n0, n1) = self.normals();
        if (p - self.start).length_squared() <= (p - self.end).length_squared() {
            turn_from(self.start, n0) / sweep
        } else {
            1.0 + turn_from(self.end, n1) / sweep
        }
    }

    /// The place of the element nearest to `p`.
    pub fn nearest(&self, p: Point) -> Nearest {
        let ends = || {
            let (a, b) = (p.distance(self.start), p.distance(self.end));
            if a <= b {
                Nearest { point: self.start, distance: a }
            } else {
                Nearest { point: self.end, distance: b }
            }
        };
        let chord = self.chord();
        if chord.length_squared() == 0.0 {
            return ends();
        }
        if self.bulge == 0.0 {
            let t = self.parameter(p);
            if !(t > 0.0 && t < 1.0) {
                return ends();
            }
            let q = self.start + chord * t;
            return Nearest { point: q, distance: (p - self.start).cross(chord).abs() / chord.length() };
        }
        let t = self.parameter(p);
        if !(0.0..=1.0).contains(&t) {
            return ends();
        }
        let (n, k) = (self.normals().0, self.curvature());
        let w = p - self.start;
        let g = n - w * k;
        let length = g.length();
        // Signed distance to the circle in curvature form: no radius, no cancellation.
        let s = (2.0 * w.dot(n) - k * w.length_squared()) / (1.0 + length);
        if length == 0.0 {
            return Nearest { point: self.start, distance: s.abs() };
        }
        Nearest { point: p - g * (s / length), distance: s.abs() }
    }

    /// Distance from `p` to the element.
    pub fn distance(&self, p: Point) -> f64 {
        self.nearest(p).distance
    }

    /// Smallest axis-parallel box around the element, wider than exact by round-off at most.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::around([self.start, self.end]);
        if self.bulge != 0.0 && !self.turns_within_a_quadrant() {
            let (n0, _) = self.normals();
            let (sweep, curvature) = (self.sweep(), self.curvature());
            for out in [vector(1.0, 0.0), vector(0.0, 1.0), vector(-1.0, 0.0), vector(0.0, -1.0)] {
                // The extreme place in direction `out` has the normal -out on a left turn.
                let normal = if sweep > 0.0 { -out } else { out };
                let turn = n0.angle_to(normal);
                let turn =
                    if sweep > 0.0 { turn.rem_euclid(2.0 * PI) } else { -(-turn).rem_euclid(2.0 * PI) };
                if turn / sweep < 1.0 {
                    // From the start: the center of a flat arc is far away, and so are its digits.
                    bounds = bounds.including(self.start + out * (versine(n0, normal) / curvature.abs()));
                }
            }
        }
        bounds
    }

    /// Whether the element stays in a box around its ends, by far: not told of what comes near to its sides. An arc
    /// of half a turn at most is nowhere farther from its chord than `|bulge|` times half its length.
    pub(crate) fn stays_in(&self, bounds: &Bounds) -> bool {
        let chord = self.chord();
        let twice = self.bulge.abs() * (chord.x.abs() + chord.y.abs());
        let grown = Bounds::around([self.start, self.end]).grown(twice);
        self.is_segment()
            || self.bulge.abs() <= 1.0 && bounds.contains(grown.min) && bounds.contains(grown.max)
    }

    /// Whether the direction of travel is nowhere that of an axis, so that the ends are corners of
    /// the box; not told of arcs beyond a half circle.
    pub fn turns_within_a_quadrant(&self) -> bool {
        let (from, to) = self.tangents();
        self.bulge.abs() <= 1.0 && from.x * to.x > 0.0 && from.y * to.y > 0.0
    }

    /// Area between the element and its chord plus that of the triangle `origin, start, end`,
    /// signed: summed over a closed spline it is the enclosed area, counter-clockwise positive.
    pub fn area(&self, origin: Point) -> f64 {
        let triangle = 0.5 * (self.start - origin).cross(self.end - origin);
        triangle + self.area_beside_chord()
    }

    /// Area between arc and chord, positive for a left turn: `(sweep - sin(sweep)) / (2 k^2)`.
    fn area_beside_chord(&self) -> f64 {
        /// Below this sweep the series `sweep^3 / 6` of `sweep - sin(sweep)` is exact to
        /// `sweep^2 / 20 < 2^-52`.
        const SERIES: f64 = 6.6e-8;
        let s = self.sweep();
        let c2 = self.chord().length_squared();
        if s == 0.0 {
            0.0
        } else if s.abs() < SERIES {
            c2 * s / 12.0
        } else {
            let h = (0.5 * s).sin();
            c2 * (s - s.sin()) / (8.0 * h * h)
        }
    }

    /// Whether places and bulge are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.start.is_finite() && self.end.is_finite() && self.bulge.is_finite()
    }
}

/// One less the cosine of the angle between two unit vectors; small ones keep their digits.
fn versine(a: Vector, b: Vector) -> f64 {
    let (sin, cos) = (a.cross(b), a.dot(b));
    if cos > 0.0 { sin * sin / (1.0 + cos) } else { 1.0 - cos }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use std::f64::consts::SQRT_2;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 16.0 * f64::EPSILON * (1.0 + a.abs().max(b.abs()))
    }

    #[test]
    fn the_farthest_place_of_an_arc_may_lie_beyond_its_center() {
        let half = Element::arc(point(-1.0, 0.0), point(1.0, 0.0), 1.0);
        assert!((half.farthest(point(0.0, 3.0)) - 4.0).abs() < 1e-15);
        assert!((half.farthest(point(0.0, -3.0)) - 10f64.sqrt()).abs() < 1e-15);
        assert_eq!(Element::segment(point(0.0, 0.0), point(3.0, 4.0)).farthest(point(3.0, 4.0)), 5.0);
    }

    #[test]
    fn a_half_circle_knows_its_measures() {
        let half = Element::arc(point(1.0, 0.0), point(-1.0, 0.0), 1.0);
        assert!(near(half.length(), PI) && near(half.curvature(), 1.0) && near(half.sweep(), PI));
        assert!(half.midpoint().distance(point(0.0, 1.0)) < 1e-15);
        assert!(half.point_at(0.25).distance(point(SQRT_2 / 2.0, SQRT_2 / 2.0)) < 1e-15);
        assert!(near(half.area(point(0.0, 0.0)), PI / 2.0));
        let b = half.bounds();
        assert!(near(b.max.y, 1.0) && near(b.min.y, 0.0) && near(b.max.x, 1.0));
    }

    #[test]
    fn the_box_of_a_flat_arc_is_as_deep_as_its_bow() {
        let flat = Element::arc(point(12.0, 6.0), point(4.0, 6.0), 6e-9);
        let b = flat.bounds();
        assert!((b.max.y - 6.000000024).abs() <= 4.0 * f64::EPSILON);
        assert_eq!((b.min, b.max.x), (point(4.0, 6.0), 12.0));
    }

    #[test]
    fn nearest_place_on_an_arc_beyond_a_half_circle() {
        let most = Element::arc(point(0.0, -1.0), point(-1.0, 0.0), (3.0 * PI / 8.0).tan());
        assert!(near(most.distance(point(3.0, 0.0)), 2.0));
        assert!(near(most.distance(point(0.0, 0.25)), 0.75));
        assert!(near(most.distance(point(-1.0, -1.0)), 1.0));
    }

    #[test]
    fn parts_of_an_arc_join_to_the_whole() {
        let arc = Element::arc(point(3.0, 4.0), point(-2.0, 7.5), -0.7);
        let (a, b) = arc.split(0.3);
        assert_eq!(a.end, b.start);
        assert!(near(a.length() + b.length(), arc.length()));
        assert!(near(a.curvature(), arc.curvature()) && near(b.curvature(), arc.curvature()));
        assert!(near(arc.parameter(a.end), 0.3));
    }
}
