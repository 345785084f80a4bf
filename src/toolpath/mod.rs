//! Motions of the tool.

mod moves;

pub use moves::{Move, Point3};
