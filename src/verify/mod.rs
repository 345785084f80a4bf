//! The judge: holds offsets of any origin against the boundary they belong to.
//!
//! It knows points, segments and arcs and nothing else of this crate: no medial axis, no level
//! sets. What it calls right has been found right by distances alone.
//!
//! With the feature `verify` there is a second judge, `SecondJudge`, that asks cavalier_contours for
//! the same offset. Where the two differ the exact distance decides who is wrong
//! ([`Boundary::compare`], for offsets of any two libraries).

mod boundary;
mod compare;
mod crossing;
mod level;
mod missing;
mod report;
#[cfg(feature = "verify")]
mod second;

pub use boundary::{Boundary, Hit};
pub use compare::{Comparison, Disagreement, DisagreementKind, Party};
pub use level::level;
pub use report::{Fault, FaultKind, LevelReport};
#[cfg(feature = "verify")]
pub use second::SecondJudge;
