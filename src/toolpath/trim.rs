//! The least of a crest that clears all of it.
//!
//! **Needs** the parts of the axis where something stands beside a level. **Guarantees** that disks of
//! the tool along what is kept, and on the next level, hold all that stands. **Does not** look beyond
//! the ends of a crest: where parts meet, they meet.
//!
//! **Method.** What stands beside a stretch of an edge is bounded by the stretch, by the offset of the
//! wall on either side as far as the passes reach, and by two spokes. A disk holds it when it holds the
//! control points of the stretch and both offsets, as it is convex. Round the end of the axis spokes
//! stand like a fan: a disk holds it when it holds the disk that they fill. From an end
//! where a pass of the next level meets the axis, the stretch that its disk holds is dropped. Then
//! each end that leads nowhere is moved inward as far as the disk at the new end holds what is given
//! up. Both are found by bisection, as a shorter stretch bounds less.

use super::roads::{Roads, Spot, bisect};
use crate::geom::Point;

/// What stands beside an edge, within a band of radii.
pub(super) struct Standing<'a> {
    pub roads: &'a Roads<'a>,
    pub edge: u32,
    /// The parameters between which it stands, and what lies there.
    pub t: [f64; 2],
    pub ends: [End; 2],
    /// How far from the wall the passes outside of it reach.
    pub reach: f64,
    /// Radius of the tool, less round-off.
    pub tool_radius: f64,
}

/// An end of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Where a pass of the next level meets the axis.
    Cut,
    /// Where nothing follows that stands.
    Free,
    /// The end of the axis.
    Leaf,
    /// A vertex of the axis, where other parts may follow.
    Joint(u32),
}

impl Standing<'_> {
    /// Between which parameters to run along it; both are equal if one place does. `None` if nothing is
    /// left to cut.
    pub fn trimmed(&self) -> Option<[f64; 2]> {
        let (t, ends) = (self.t, self.ends);
        let mut needed = t;
        for end in 0..2 {
            if ends[end] == End::Cut {
                let other = t[1 - end];
                let v = self.place(t[end]);
                needed[end] = self.farthest(t[end], other, |at| self.is_held(v, t[end], at));
                if needed[end] == other {
                    return None;
                }
            }
        }
        let mut kept = needed;
        for end in 0..2 {
            if !matches!(ends[end], End::Joint(_)) {
                let (from, other) = (needed[end], needed[1 - end]);
                kept[end] = self.farthest(from, other, |at| self.is_held(self.place(at), from, at));
            }
        }
        let crossed = (kept[1] - kept[0]) * (t[1] - t[0]) < 0.0;
        if !crossed {
            return Some(kept);
        }
        // One place holds both sides; that nearer to the wall is the shorter way.
        let radius = |at: f64| self.roads.radius(Spot { edge: self.edge, t: at });
        let place = if radius(kept[0]) < radius(kept[1]) { kept[0] } else { kept[1] };
        let holds = |at: f64| needed.iter().all(|&n| self.is_held(self.place(at), n, at));
        [place, kept[0], kept[1]].into_iter().find(|&at| holds(at)).map_or(Some(needed), |at| Some([at, at]))
    }

    fn place(&self, t: f64) -> Point {
        self.roads.place(Spot { edge: self.edge, t })
    }

    /// How far from one parameter toward another a predicate holds.
    fn farthest(&self, from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
        let at = |share: f64| if share == 1.0 { to } else { from + share * (to - from) };
        at(bisect(|share| holds(at(share))))
    }

    /// Whether the disk of the tool about a place holds what stands beside a stretch.
    fn is_held(&self, center: Point, from: f64, to: f64) -> bool {
        let near = |p: Point| p.distance(center) <= self.tool_radius;
        let is_leaf = |end: &usize| self.ends[*end] == End::Leaf && [from, to].contains(&self.t[*end]);
        self.roads.hull(self.edge, from, to).into_iter().all(near)
            && [0, 1].into_iter().filter(is_leaf).all(|end| self.is_fan_held(center, self.t[end]))
            && [0, 1].into_iter().all(|side| {
                let offset = self.roads.offset(self.edge, side, [from, to], self.reach);
                offset.farthest(center) <= self.tool_radius
            })
    }

    /// The same for what stands round the end of the axis.
    fn is_fan_held(&self, center: Point, leaf: f64) -> bool {
        let radius = self.roads.radius(Spot { edge: self.edge, t: leaf });
        self.place(leaf).distance(center) + radius - self.reach <= self.tool_radius
    }
}
