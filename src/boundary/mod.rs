//! From drawn curves to pockets.
#![doc = ""]
#![doc = include_str!("../../docs/nested.svg")]
#![doc = ""]
//! *Outermost contours are pockets, contours in them islands, contours in islands pockets again. The
//! drawing holds seven contours and makes four pockets of them.*

mod arrange;
mod assemble;
mod chain;
mod clean;
mod crossing;
mod curve;
mod duplicate;
mod ends;
mod fan;
pub mod freeform;
mod grain;
mod index;
mod intersect;
mod nest;
mod pocket;
mod ray;
mod simple;

pub use curve::{Curve, Source};
pub use pocket::{Pocket, Pockets};

#[cfg(test)]
mod tests;
