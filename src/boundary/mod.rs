//! From drawn curves to pockets.

mod chain;
mod clean;
mod curve;
mod duplicate;
mod ends;
mod fan;
mod grain;
mod index;
mod pocket;

pub use curve::{Curve, Source};
pub use pocket::{Pocket, Pockets};
