//! Programs for controllers: G-code.
//!
//! **Needs** moves that begin with a rapid; every arc at most half a circle.
//! **Guarantees** text that grbl, LinuxCNC, Mach and Fanuc all read the same: ASCII, at most 80
//! characters in a line, no exponents, no canned cycles, every arc with X, Y, I and J and with the
//! same radius at both of its written ends to 0.002 mm; no written arc is a full circle by accident.
//! **Does not** know the machine: no tool change, no tool length offset, no path blending.
//!
//! **Method.** Places are rounded first. An arc keeps its swept angle on the chord between its
//! rounded ends, so that a center with two equal radii exists, and only rounding of that center is
//! left; where the radii still differ, or the angle does, the arc is halved. An arc that is as good
//! as straight in written digits is written as a line.

mod arc;
mod comment;
mod line;
mod number;
mod parts;
mod program;
mod setup;
mod write;

pub use program::{Stats, Written};
pub use setup::{ArcWords, Coolant, Setup};
pub use write::{write, write_to};
