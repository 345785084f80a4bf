//! What the stages of an axis take.

use std::time::{Duration, Instant};

/// Time that each stage of a medial axis took, of all threads together from begin to end.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stages {
    /// From loops to sites: arcs in quarters, cones of reflex vertices, normals at smooth joints.
    pub sites: Duration,
    /// The hierarchy of boxes over the sites.
    pub boxes: Duration,
    /// Maximal disks at all joints.
    pub shots: Duration,
    /// The map of their chords.
    pub map: Duration,
    /// Branch disks and edges in the faces of the map.
    pub faces: Duration,
    /// Edges without length contracted, others split at extrema of the radius.
    pub graph: Duration,
}

impl Stages {
    /// All of them in their order, by name.
    pub fn named(&self) -> [(&'static str, Duration); 6] {
        [
            ("sites", self.sites),
            ("boxes", self.boxes),
            ("shots", self.shots),
            ("map", self.map),
            ("faces", self.faces),
            ("graph", self.graph),
        ]
    }
}

/// Tells how long it is since it was asked last.
pub(super) struct Laps(Instant);

impl Laps {
    pub fn start() -> Laps {
        Laps(Instant::now())
    }

    pub fn lap(&mut self) -> Duration {
        let now = Instant::now();
        now - std::mem::replace(&mut self.0, now)
    }
}
