//! DXF drawings: reading them, text and binary, any version from release 2 to 2018, and [`Sheet`] to write
//! them.
//!
//! [`read`] answers the curves of the model space in the unit of the job, seen from above: LINE,
//! ARC, CIRCLE, LWPOLYLINE and POLYLINE as arc splines; ELLIPSE and SPLINE as arcs within a
//! tolerance that is proven ([`freeform`](crate::boundary::freeform)); boundaries of HATCH on request; and all of them again where
//! INSERT puts a block, at any depth, moved, turned, scaled, mirrored, in rows and columns.
//! Whatever else a drawing holds is a warning with its count, and so is everything that was mended
//! or made simpler; one broken entity does not cost the others.
//!
//! **Guarantees** finite coordinates, curves with a length, and ends that meet to the last bit
//! where the drawing writes the same numbers. A file is never held as a whole: what is read takes
//! the memory of its curves. **Does not** join, nest or check contours, which is the work of
//! [`Pockets::from_curves`](crate::Pockets::from_curves).
//!
//! **Method.** Bytes become tags, of either form of the format; tags become records, one entity at
//! a time, of the dozen kinds that matter; a record becomes curves at once, unless it lies in a
//! block. Groups, tables and sections that a pocket does not need are passed over.

mod binary;
mod buffer;
mod collect;
mod color;
mod drawing;
mod fit;
mod hatch;
mod insert;
mod inventory;
mod layers;
mod magic;
mod mend;
mod names;
mod number;
mod placement;
mod polyline;
mod read;
mod record;
mod round;
mod scan;
mod select;
mod shape;
mod skipped;
mod spline;
mod tags;
mod unit;
mod writer;

pub use color::Color;
pub use drawing::{Drawing, FitTolerance, Fitted, Origin, ReadOptions};
pub use inventory::{BrokenEntity, Inventory, KindCount, LayerContent, UnitReason};
pub use read::{read, read_bytes, read_from};
pub use writer::Sheet;
