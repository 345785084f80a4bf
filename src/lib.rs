//! Exact medial axes, offsets and tool paths for CNC pockets.
//!
//! Units are those of the job (millimeters or inches), angles are radians, counter-clockwise; y
//! points up; the interior of a pocket lies on the left of its boundary; curvature is positive on a
//! left turn.

pub mod boundary;
pub mod error;
pub mod geom;
pub mod io;
pub mod mat;
pub mod offset;
pub mod tolerance;
pub mod toolpath;
pub mod verify;

pub use boundary::{Curve, Pocket, Pockets, Source};
pub use error::{Defect, Error};
pub use geom::{ArcSpline, Bounds, Element, Point, Vector, Vertex, point, vector};
pub use mat::{Disk, Mat};
pub use offset::Level;
pub use tolerance::{Tolerance, Units};
