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
    /// the boundary itself is not a level set, so `d` must be above 0 to give any. Below the [radius from which on
    /// the axis is whole](Mat::least_radius) something may be missing.
    pub fn level(&self, d: f64) -> Level {
        self.level_of(d, None)
    }

    /// The level set at distance `d` without the loops that follow one loop of the boundary.
    pub(super) fn level_beside(&self, d: f64, loop_index: u32) -> Level {
        self.level_of(d, Some(loop_index))
    }

    fn level_of(&self, d: f64, unwanted: Option<u32>) -> Level {
        let mut level = Level { distance: d, ..Level::default() };
        let unit = self.frame.length_in(d);
        if !(unit > 0.0 && unit <= 1.0) {
            return level;
        }
        let tracer = Tracer::new(self, unit);
        level.loops = tracer.walks(|walk| {
            let follows = |loop_index| walk.iter().any(|s| tracer.loop_index(s) == loop_index);
            if unwanted.is_some_and(follows) { None } else { tracer.offset_loop(walk) }
        });
        level.ridges = tracer.ridges().into_iter().map(|ridge| ridge.spline).collect();
        level
    }
}

impl Tracer<'_> {
    /// Index of the loop of the boundary that a stretch lies on.
    fn loop_index(&self, stretch: &Stretch) -> u32 {
        self.site(self.stop(stretch.first)).source.loop_index
    }

    /// The offset of a walk, in job units; `None` if it is as short as round-off.
    fn offset_loop(&self, walk: &[Stretch]) -> Option<ArcSpline> {
        let mut vertices: Vec<Vertex> = Vec::with_capacity(walk.len());
        let ends = walk[1..].iter().chain(&walk[..1]).map(|next| next.start);
        for (stretch, end) in walk.iter().zip(ends) {
            // An element as short as round-off has no direction; its neighbors meet without it.
            if stretch.start.distance(end) > self.mat.graph.error {
                let point = self.mat.frame.leave(stretch.start);
                vertices.push(Vertex { point, bulge: stretch.bulge });
            }
        }
        (vertices.len() >= 2).then_some(ArcSpline { vertices, closed: true })
    }
}
