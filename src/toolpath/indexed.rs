//! Elements of passes in an index of places.

use crate::geom::{Bounds, Element};
use rstar::{AABB, PointDistance, RTreeObject};

/// An element of a loop or ridge.
pub(super) struct Indexed {
    pub element: Element,
    /// Index of the loop in its level; ridges follow the loops.
    pub index: usize,
    bounds: Bounds,
}

impl Indexed {
    pub fn new(element: Element, index: usize) -> Indexed {
        Indexed { element, index, bounds: element.bounds() }
    }
}

impl RTreeObject for Indexed {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.bounds.min.into(), self.bounds.max.into())
    }
}

impl PointDistance for Indexed {
    fn distance_2(&self, p: &[f64; 2]) -> f64 {
        let distance = self.element.distance((*p).into());
        distance * distance
    }
}
