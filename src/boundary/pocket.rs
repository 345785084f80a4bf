//! A region to clear with the islands left standing in it.

use super::Curve;
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Bounds};
use crate::tolerance::Tolerance;
use serde::{Deserialize, Serialize};

/// A region to clear: an outer loop, counter-clockwise, and islands, clockwise, so that the
/// interior lies on the left of every element.
///
/// Loops are simple and disjoint, but may touch in points; where they touch, both have a vertex,
/// equal to the last bit. No element has length 0 and no element is a full circle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pocket {
    outer: ArcSpline,
    islands: Vec<ArcSpline>,
}

/// The pockets of a drawing and everything that is wrong with it.
#[derive(Clone, Debug, Default)]
pub struct Pockets {
    /// In the order of their outer loops in the drawing.
    pub pockets: Vec<Pocket>,
    /// All defects, each with its place.
    pub defects: Vec<Defect>,
}

impl Pockets {
    /// Chains, checks and nests drawn curves.
    pub fn from_curves(_curves: &[Curve], _tolerance: Tolerance) -> Result<Pockets, Error> {
        unimplemented!("helper A")
    }
}

impl Pocket {
    /// The pocket that loops in any order and orientation bound.
    pub fn from_loops(_loops: Vec<ArcSpline>, _tolerance: Tolerance) -> Result<Pocket, Error> {
        unimplemented!("helper A")
    }

    /// From loops that are known to meet the description of the type; used where they were checked.
    pub(crate) fn from_checked(outer: ArcSpline, islands: Vec<ArcSpline>) -> Pocket {
        Pocket { outer, islands }
    }

    /// The outer loop, counter-clockwise.
    pub fn outer(&self) -> &ArcSpline {
        &self.outer
    }

    /// The islands, clockwise.
    pub fn islands(&self) -> &[ArcSpline] {
        &self.islands
    }

    /// All loops: the outer one first.
    pub fn loops(&self) -> impl ExactSizeIterator<Item = &ArcSpline> + Clone {
        let count = 1 + self.islands.len();
        (0..count).map(move |i| if i == 0 { &self.outer } else { &self.islands[i - 1] })
    }

    /// Area to clear.
    pub fn area(&self) -> f64 {
        self.loops().map(ArcSpline::area).sum()
    }

    /// Box around the pocket.
    pub fn bounds(&self) -> Bounds {
        self.outer.bounds()
    }
}
