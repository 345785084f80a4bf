//! What the judge found.

use crate::geom::Point;
use serde::{Deserialize, Serialize};

/// Most faults of one report that are listed with their places; all are counted.
pub(super) const MAX_FAULTS: usize = 64;

/// What offset loops are worth. Lengths and areas are in job units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LevelReport {
    /// The distance that the loops should have.
    pub distance: f64,
    /// Whether they should lie outside of the boundary.
    #[serde(default)]
    pub outward: bool,
    /// Number of closed loops and open ridges judged.
    pub loops: usize,
    /// Number of places looked at.
    pub places: usize,
    /// Largest difference from the distance along the loops.
    pub max_deviation: f64,
    /// Where that is.
    pub max_deviation_at: Option<Point>,
    /// Largest difference that counts as none.
    pub within: f64,
    /// Enclosed area: that of the outer loops less that of the inner ones.
    pub area: f64,
    /// Number of faults.
    pub fault_count: usize,
    /// The faults with their places; no more than 64.
    pub faults: Vec<Fault>,
}

/// One thing that is wrong with the loops, as long as it goes on. Lengths and areas are in job units, 0
/// where they mean nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fault {
    /// What it is.
    pub kind: FaultKind,
    /// Where it is worst.
    pub at: Point,
    /// By how much there: the difference from the distance, or how far the nearest curve is from what
    /// is missing.
    pub by: f64,
    /// How long it is along the curve.
    pub length: f64,
    /// The area within it where it is a whole loop.
    pub area: f64,
}

/// What can be wrong with a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FaultKind {
    /// A part of a loop that is not at the distance: misplaced, or a phantom.
    Distance,
    /// A part of the level that no loop passes.
    Missing,
    /// The loop lies outside the boundary; inside of it, where it should be outside.
    Outside,
    /// The side farther from the boundary is not on the left.
    Reversed,
    /// The loop is there more than once, or lies in another one.
    Overlapping,
    /// An open curve with something farther away beside it: part of a loop that does not close.
    Open,
    /// A coordinate that is not a number.
    NotANumber,
}

impl Fault {
    /// At a place, where a length means nothing.
    pub(super) fn at(kind: FaultKind, at: Point) -> Fault {
        Fault { kind, at, by: 0.0, length: 0.0, area: 0.0 }
    }
}

impl LevelReport {
    /// Whether no fault was found.
    pub fn is_right(&self) -> bool {
        self.fault_count == 0
    }

    /// Counts a fault and lists it while there is room.
    pub(super) fn add(&mut self, fault: Fault) {
        self.fault_count += 1;
        if self.faults.len() < MAX_FAULTS {
            self.faults.push(fault);
        }
    }

    /// Takes note of a distance from the boundary measured at a place of a loop.
    pub(super) fn measure(&mut self, at: Point, deviation: f64) {
        if deviation > self.max_deviation || self.max_deviation_at.is_none() {
            self.max_deviation = deviation;
            self.max_deviation_at = Some(at);
        }
    }
}

impl std::fmt::Display for FaultKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            FaultKind::Distance => "not at the distance",
            FaultKind::Missing => "a part is missing",
            FaultKind::Outside => "on the wrong side of the boundary",
            FaultKind::Reversed => "runs the wrong way round",
            FaultKind::Overlapping => "there more than once",
            FaultKind::Open => "does not close",
            FaultKind::NotANumber => "has a coordinate that is not a number",
        })
    }
}
