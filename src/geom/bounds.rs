//! Axis-parallel boxes.

use super::{Point, Vector, point};
use serde::{Deserialize, Serialize};

/// The smallest axis-parallel box around something; [`Bounds::EMPTY`] around nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Bounds {
    /// The box around nothing: the neutral element of [`Bounds::union`].
    pub const EMPTY: Bounds =
        Bounds { min: point(f64::INFINITY, f64::INFINITY), max: point(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// The box around some places.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, Bounds::including)
    }

    /// Grown to hold one more place.
    #[inline]
    pub fn including(self, p: Point) -> Bounds {
        Bounds {
            min: point(self.min.x.min(p.x), self.min.y.min(p.y)),
            max: point(self.max.x.max(p.x), self.max.y.max(p.y)),
        }
    }

    /// The box around both.
    #[inline]
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds {
            min: point(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: point(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }

    /// Grown by a margin on every side.
    #[inline]
    pub fn grown(self, margin: f64) -> Bounds {
        Bounds {
            min: point(self.min.x - margin, self.min.y - margin),
            max: point(self.max.x + margin, self.max.y + margin),
        }
    }

    /// Whether the two boxes share a place.
    #[inline]
    pub fn meets(&self, other: &Bounds) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Whether the box holds a place, its rim included.
    #[inline]
    pub fn contains(&self, p: Point) -> bool {
        self.min.x <= p.x && p.x <= self.max.x && self.min.y <= p.y && p.y <= self.max.y
    }

    /// The place in the box nearest to `p`; infinitely far when the box is around nothing.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        point(p.x.max(self.min.x).min(self.max.x), p.y.max(self.min.y).min(self.max.y))
    }

    /// Whether the box is around nothing.
    pub fn is_empty(&self) -> bool {
        self.min.x > self.max.x
    }

    /// Middle of the box.
    pub fn center(&self) -> Point {
        self.min.midpoint(self.max)
    }

    /// From corner to corner.
    pub fn extent(&self) -> Vector {
        self.max - self.min
    }

    /// Length of the diagonal; 0 around nothing.
    pub fn diagonal(&self) -> f64 {
        if self.is_empty() { 0.0 } else { self.extent().length() }
    }

    /// Largest absolute coordinate, the magnitude that round-off of stored places is relative to.
    pub fn magnitude(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        [self.min.x, self.min.y, self.max.x, self.max.y].into_iter().fold(0.0, |m, c| c.abs().max(m))
    }
}
