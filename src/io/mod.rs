//! Drawings in, programs and pictures out. Formats only: no geometry is decided here.

pub mod atomic;
pub mod gcode;
pub mod json;
pub mod svg;
