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

/// One thing that is wrong with the loops.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fault {
    /// What it is.
    pub kind: FaultKind,
    /// Where.
    pub at: Point,
    /// By how much, in job units; 0 where that means nothing.
    pub by: f64,
}

/// What can be wrong with a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FaultKind {
    /// A place of the loop is not at the distance: a wrong or a phantom part.
    Distance,
    /// A place at the distance that no loop passes.
    Missing,
    /// The loop lies outside the boundary.
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
            FaultKind::Outside => "outside the boundary",
            FaultKind::Reversed => "runs the wrong way round",
            FaultKind::Overlapping => "there more than once",
            FaultKind::Open => "does not close",
            FaultKind::NotANumber => "has a coordinate that is not a number",
        })
    }
}
