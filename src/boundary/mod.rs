//! From drawn curves to pockets.
#![doc = ""]
#![doc = include_str!("../../docs/nested.svg")]
#![doc = ""]
//! *Outermost contours are pockets, contours in them islands, contours in islands pockets again. The
//! drawing holds seven contours and makes four pockets of them.*
//!
//! # What curves mean that meet
//!
//! - Ends are chained first, nearest first, up to the reach of joining. What closes is a contour.
//! - An end that has no partner but lies on another curve, up to the reach, is moved onto it. An open
//!   curve of which both ends lie on contours or on other such curves divides them: each closed part
//!   is a pocket of its own. One that sticks out by more, or that crosses a contour, divides nothing:
//!   a center line does no harm. Dividing curves may cross each other, as in a grid.
//! - What is drawn as loose curves that meet in threes has no contours of its own: its outermost
//!   course is one contour, with parts in it. In a pocket, all of it is an island.
//! - Contours may touch in places and share sides, each staying on its side of the other. A common
//!   side separates two pockets side by side, and vanishes between islands or where an island lies
//!   on the wall.
//! - Contours that change sides, in a place or along a common stretch, cross. That is a defect, with
//!   its places, and leaves out the nest. Loops of one contour that are smaller than the reach are
//!   cut off, and of two contours that overlap by less than the reach one ends on the other.

mod arrange;
mod assemble;
mod chain;
mod clean;
mod cluster;
mod crossing;
mod curve;
mod duplicate;
mod ends;
mod faces;
mod fan;
pub mod freeform;
mod gather;
mod grain;
mod index;
mod intersect;
mod junction;
mod lists;
mod loose;
mod nesting;
mod overlap;
mod pieces;
mod pocket;
mod ray;
mod regions;
mod sieve;
mod simple;
mod strands;
mod tee;

pub use curve::{Curve, FreeCurve, FreeShape, Source};
pub(crate) use grain::TOUCHING_ULPS;
pub use pocket::{Pocket, Pockets};
#[cfg(feature = "geo-types")]
pub(crate) use ray::{Rays, turned};

#[cfg(test)]
mod tests;
