//! The judge: holds offsets of any origin against the boundary they belong to.
//!
//! It knows points, segments and arcs and nothing else of this crate: no medial axis, no level
//! sets. What it calls right has been found right by distances alone.
//!
//! Offsets of other programs come as they are: curves in any order and direction, perhaps flattened,
//! perhaps not closed. [`chained`] makes loops of them, [`Boundary::turned`] turns these,
//! [`Boundary::judge`] tells the worst deviation and every part that is missing or should not be there,
//! with place, length and area. `pocket check` is that on the command line.
//!
//! With the feature `verify` there is a second judge, `SecondJudge`, that asks cavalier_contours for
//! the same offset. Where the two differ the exact distance decides who is wrong
//! ([`Boundary::compare`], for offsets of any two libraries).

mod boundary;
mod chain;
mod compare;
mod crossing;
mod gaps;
mod level;
mod missing;
mod phantom;
mod report;
#[cfg(feature = "verify")]
mod second;
mod turned;

pub use boundary::{Boundary, Hit};
pub use chain::chained;
pub use compare::{Comparison, Disagreement, DisagreementKind, Party};
pub use level::{level, outward};
pub use report::{Fault, FaultKind, LevelReport};
#[cfg(feature = "verify")]
pub use second::SecondJudge;
