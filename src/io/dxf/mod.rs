//! DXF drawings, text and binary, any version, and [`Sheet`] to write them.
//!
//! [`read`] answers the curves of the model space in the unit of the job: LINE, ARC, CIRCLE,
//! LWPOLYLINE and flat POLYLINE with bulges. Whatever else a drawing holds is a warning with its
//! count; one broken entity does not cost the others.
//!
//! **Guarantees** finite coordinates, curves with a length, and ends that meet to the last bit
//! where the drawing writes the same numbers. **Does not** join, nest or check contours, which
//! is the work of [`Pockets::from_curves`](crate::Pockets::from_curves), and does not yet read
//! blocks, splines, ellipses and what lies in a mirrored coordinate system.

mod binary;
mod drawing;
mod read;
mod records;
mod select;
mod shape;
mod skipped;
mod tags;
mod writer;

pub use drawing::{Drawing, ReadOptions};
pub use read::{read, read_bytes};
pub use writer::Sheet;
