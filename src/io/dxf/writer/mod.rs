//! Drawings out: R2000 text DXF, one layer for each kind of result.
//!
//! **Guarantees** that every number reads back to the same `f64`; that nothing is flattened but
//! helices, as boundary, offsets and cuts are polylines with bulges and conic arcs of the axis are
//! rational splines of degree 2; handles, owners and tables as drawing programs ask for them.
//! **Does not** keep the drawing in memory: entities are made as they are written, once to know their
//! extents and handles (both stand at the head of the file) and once to write them.

mod entity;
mod layer;
mod pen;
mod sheet;
mod skeleton;
mod strokes;

pub use sheet::Sheet;
