//! Level sets of the distance to the boundary, read off the axis.
//!
//! **Needs** a finished [`Mat`](crate::Mat). **Guarantees** loops that are closed to the last bit,
//! simple, with the inner side on the left, made of true arcs, at the distance to round-off; ridges
//! where the distance is attained and no area remains. **Does not** look at the drawing again.
//!
//! **Method.** Every piece of the boundary owns the part of the pocket between itself and its edge of
//! the axis, and the radius is monotone along the edge. So the level set at `d` crosses an edge in
//! one point or not at all; between crossings it follows the boundary, piece by piece, moved inward
//! by `d`: an arc of curvature `k` becomes one of `k / (1 - k d)`, a reflex vertex an arc of radius
//! `d`. The order of walking is that of the axis; nothing is intersected or clipped.

mod carriers;
mod crossing;
mod level;
mod merge;
mod outward;
mod reach;
mod ridge;
mod runs;
mod sets;
mod trace;
mod united;

pub use level::Level;
pub use merge::{MergeTree, Part};
pub use outward::Exterior;
pub(crate) use ridge::parallel_bulge;
pub use sets::LevelSets;
