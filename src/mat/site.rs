//! Sites: the boundary elements that own a part of the pocket.
//!
//! A site is a segment, an arc of a quarter turn at most, or a reflex vertex with (a part of at most
//! a quarter of) its normal cone. Sites lie in boundary order, the interior on their left, so `next`
//! and `prev` are neighbors on the boundary. The place where a site ends is a *joint*, and joint `i`
//! is the end of site `i`.

use super::SiteRef;
use crate::geom::{Bounds, Point, Vector};

/// No vertex, site, piece or edge.
pub(crate) const NONE: u32 = u32::MAX;

/// A place on the boundary with the unit normal that points to the center of the disk there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foot {
    pub point: Point,
    pub normal: Vector,
}

/// How the boundary goes on where a site ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Joint {
    /// Into a corner of the pocket: the maximal disk has radius 0.
    Convex,
    /// Straight on; `same_circle` between two parts of one arc.
    Smooth { same_circle: bool },
    /// Between an element and the normal cone of a reflex vertex, or inside that cone.
    Cone,
}

/// A boundary element in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    /// Where it begins and ends, with the inward normals there.
    pub start: Foot,
    pub end: Foot,
    /// Signed curvature: positive when the center lies on the side of the interior.
    pub curvature: f64,
    /// Round-off of its places across the boundary.
    pub error: f64,
    /// Whether it is a reflex vertex.
    pub is_vertex: bool,
    /// How the boundary goes on at its end.
    pub joint: Joint,
    /// Neighbors on the boundary.
    pub prev: u32,
    pub next: u32,
    /// Ids of the boundary vertices where it begins and ends.
    pub vertices: [u32; 2],
    /// What it is in the drawing.
    pub source: SiteRef,
}

impl Site {
    /// Largest curvature that bounds the disks tangent to it: `1 / k`, infinite unless concave.
    #[inline]
    pub fn own_limit(&self) -> f64 {
        if self.curvature > 0.0 && !self.is_vertex { self.curvature.recip() } else { f64::INFINITY }
    }

    /// The center of an arc.
    pub fn center(&self) -> Option<Point> {
        let center = || self.start.point + self.start.normal / self.curvature;
        (!self.is_vertex && self.curvature != 0.0).then(center).filter(|c| c.is_finite())
    }

    /// Whether it is a segment.
    #[inline]
    pub fn is_straight(&self) -> bool {
        self.curvature == 0.0 && !self.is_vertex
    }

    /// More than how far it is from its chord: `k c^2 / (4 + 4 cos(sweep / 2))`, with the chord `c`.
    pub fn sagitta(&self) -> f64 {
        let square = (self.end.point - self.start.point).length_squared();
        if self.is_vertex { 0.0 } else { 0.25 * self.curvature.abs() * square }
    }

    /// A box around it, at most twice as deep as its sagitta: around ends and tangents' meet.
    pub fn bounds(&self) -> Bounds {
        let ends = Bounds::around([self.start.point, self.end.point]);
        if self.curvature == 0.0 || self.is_vertex {
            return ends;
        }
        let chord = self.end.point - self.start.point;
        let half = 0.5 * chord.length() * self.curvature;
        let apex = chord.right() * (0.5 * half / (1.0 - half * half).max(f64::EPSILON).sqrt());
        ends.including(self.start.point.midpoint(self.end.point) + apex)
    }

    /// Signed distance of a place from the line, circle or vertex that carries the site, positive on
    /// the side of the interior, and the unit normal of that distance there.
    ///
    /// Curvature form: with `w = c - A`, `s = (2 w.n - k |w|^2) / (1 + |n - k w|)`.
    #[inline]
    pub fn carrier_distance(&self, c: Point) -> (f64, Vector) {
        if self.is_vertex {
            let w = c - self.start.point;
            let d = w.length();
            return (d, if d > 0.0 { w / d } else { self.start.normal });
        }
        let foot = self.nearer_end(c);
        let w = c - foot.point;
        let g = foot.normal - w * self.curvature;
        let length = g.length();
        let s = (2.0 * w.dot(foot.normal) - self.curvature * w.length_squared()) / (1.0 + length);
        (s, if length > 0.0 { g / length } else { foot.normal })
    }

    /// The end of the site nearer to a place.
    #[inline]
    pub fn nearer_end(&self, c: Point) -> Foot {
        let to_start = (c - self.start.point).length_squared();
        if to_start <= (c - self.end.point).length_squared() { self.start } else { self.end }
    }

    /// The place on the carrier of the site nearest to a place.
    pub fn nearest_on_carrier(&self, c: Point) -> Point {
        let (s, normal) = self.carrier_distance(c);
        c - normal * s
    }

    /// The place on the site nearest to a place.
    pub fn nearest(&self, c: Point) -> Point {
        let foot = self.nearest_on_carrier(c);
        if self.is_vertex || self.spans(foot) { foot } else { self.nearer_end(c).point }
    }

    /// Distance of a place to the site itself.
    pub fn distance(&self, c: Point) -> f64 {
        let (s, normal) = self.carrier_distance(c);
        if self.is_vertex || self.spans(c - normal * s) {
            return s.abs();
        }
        c.distance(self.start.point).min(c.distance(self.end.point))
    }

    /// Whether a disk inside of the pocket does not reach the site for sure, nor would one whose radius is larger by
    /// its round-off: both ends lie outside, and the center either beside the sector between their normals, or too
    /// far from the carrier. The carrier is at the distance `s` where `2 s - k s^2 = 2 w.n - k |w|^2`; the left side
    /// grows with `s` up to the center.
    #[inline]
    pub fn is_beyond(&self, c: Point, radius: f64) -> bool {
        /// Roundings of either side, and of radii, relative to their terms.
        const ROUNDINGS: f64 = 256.0 * f64::EPSILON;
        let (w, from_end, k) = (c - self.start.point, c - self.end.point, self.curvature);
        let (square, reach) = (w.length_squared(), radius * (radius + ROUNDINGS * (1.0 + radius)));
        if square <= reach || from_end.length_squared() <= reach {
            return false;
        }
        if w.dot(self.start.normal.right()) < 0.0
            || from_end.dot(self.end.normal.right()) > 0.0
            || self.is_vertex
        {
            return true;
        }
        let power = 2.0 * w.dot(self.start.normal) - k * square;
        let reached = radius * (2.0 - k * radius);
        k * radius < 1.0 && power > reached + ROUNDINGS * (1.0 + (k * square).abs())
    }

    /// Whether a place of the carrier lies between the ends.
    #[inline]
    pub fn spans(&self, q: Point) -> bool {
        (q - self.start.point).dot(self.start.normal.right()) >= 0.0
            && (q - self.end.point).dot(self.end.normal.right()) <= 0.0
    }

    /// Where a foot lies between start and end, growing from 0 to 1 along the boundary.
    #[inline]
    pub fn position(&self, foot: &Foot) -> f64 {
        let (along, whole) = if self.is_vertex {
            (foot.normal - self.start.normal, self.end.normal - self.start.normal)
        } else {
            (foot.point - self.start.point, self.end.point - self.start.point)
        };
        let t = along.dot(whole) / whole.length_squared();
        if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
    }
}
