//! Drawings in, programs and pictures out. Formats only: no geometry is decided here.

mod advice;
pub mod atomic;
#[cfg(feature = "dxf")]
pub mod dxf;
pub mod gcode;
pub mod json;
pub mod svg;
mod units;
mod warning;

pub use units::{DrawingUnit, Scale};
pub use warning::{Place, Warning};
