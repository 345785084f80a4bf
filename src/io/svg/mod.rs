//! Pictures: pockets with their axes, level sets and tool paths.
//!
//! Shapes are in job units with y up; arcs are SVG arcs and axes are quadratic curves, so a picture
//! may be enlarged at will. Colors read on white paper and on a dark screen.

mod frame;
mod free;
mod label;
mod picture;
mod shape;
mod style;

pub use picture::Picture;
