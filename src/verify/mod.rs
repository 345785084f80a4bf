//! The judge: holds offsets of any origin against the boundary they belong to.
//!
//! It knows points, segments and arcs and nothing else of this crate: no medial axis, no level
//! sets. What it calls right has been found right by distances alone.
//!
//! [`Boundary::compare`] holds two offsets against each other and decides who is wrong where they differ.

mod boundary;
mod compare;
mod crossing;
mod level;
mod missing;
mod report;

pub use boundary::{Boundary, Hit};
pub use compare::{Comparison, Disagreement, DisagreementKind, Party};
pub use level::level;
pub use report::{Fault, FaultKind, LevelReport};
