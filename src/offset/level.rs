//! The level set at one distance.

use super::trace::{Stretch, Tracer};
use crate::geom::{ArcSpline, Vertex};
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
    /// Arc splines on which the distance is attained and that bound no area: a slot exactly as wide
    /// as the tool. One vertex alone is a place where the tool just fits; a ridge that returns to
    /// its start (a ring groove) is closed, all others are open.
    pub ridges: Vec<ArcSpline>,
}

impl Level {
    /// Whether nothing is that far from the boundary.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty() && self.ridges.is_empty()
    }
}

impl Mat {
    /// The level set at distance `d`, in job units: the boundary of {distance > d}, and ridges where
    /// the distance is `d` (to round-off) and no area remains. Empty when nothing is that far away;
    /// the boundary itself is not a level set, so `d` must be above 0 to give any.
    pub fn level(&self, d: f64) -> Level {
        self.level_of(d, |_| true)
    }

    /// The level set at distance `d` without the loops that follow one loop of the boundary.
    pub(super) fn level_beside(&self, d: f64, loop_index: u32) -> Level {
        self.level_of(d, |walk| {
            walk.iter().all(|s| self.sites[s.site as usize].source.loop_index != loop_index)
        })
    }

    fn level_of(&self, d: f64, wanted: impl Fn(&[Stretch]) -> bool) -> Level {
        let mut level = Level { distance: d, ..Level::default() };
        let unit = self.frame.length_in(d);
        if !(unit > 0.0 && unit <= 1.0) {
            return level;
        }
        let tracer = Tracer::new(self, unit);
        let walks = tracer.walks();
        let walks = walks.iter().filter(|walk| wanted(walk));
        level.loops = walks.filter_map(|walk| tracer.offset_loop(walk)).collect();
        level.ridges = tracer.ridges().into_iter().map(|ridge| ridge.spline).collect();
        level
    }
}

impl Tracer<'_> {
    /// The offset of a walk, in job units; `None` if it is as short as round-off.
    fn offset_loop(&self, walk: &[Stretch]) -> Option<ArcSpline> {
        let mut vertices: Vec<Vertex> = Vec::with_capacity(walk.len());
        for (i, stretch) in walk.iter().enumerate() {
            let end = walk[(i + 1) % walk.len()].start;
            // An element as short as round-off has no direction; its neighbors meet without it.
            if stretch.start.distance(end) > self.mat.graph.error {
                let bulge = (0.25 * stretch.turn).tan();
                vertices.push(Vertex { point: self.mat.frame.leave(stretch.start), bulge });
            }
        }
        (vertices.len() >= 2).then_some(ArcSpline { vertices, closed: true })
    }
}
