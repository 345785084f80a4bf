//! Level sets of the distance to the boundary.

use crate::geom::ArcSpline;
use crate::mat::Mat;
use serde::{Deserialize, Serialize};

/// The level set at a distance: the boundary of everything farther away, and what is left of the
/// axis where nothing is farther.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// The distance, in job units.
    pub distance: f64,
    /// Closed loops with the inner side (farther from the boundary) on the left: counter-clockwise
    /// round a remaining area, clockwise round what surrounds an island.
    pub loops: Vec<ArcSpline>,
    /// Open arc splines on which the distance is attained and that bound no area: a slot exactly as
    /// wide as the tool. One vertex alone is a place where the tool just fits. A ridge that returns
    /// to its start (a ring groove) is a closed spline.
    pub ridges: Vec<ArcSpline>,
}

impl Level {
    /// Whether nothing is that far from the boundary.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty() && self.ridges.is_empty()
    }
}

impl Mat {
    /// The level set at distance `d`, in job units; empty when nothing is that far away.
    pub fn level(&self, _d: f64) -> Level {
        unimplemented!("offset")
    }
}
