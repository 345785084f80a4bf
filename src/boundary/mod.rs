//! From drawn curves to pockets.

mod clean;
mod curve;
mod duplicate;
mod grain;
mod index;
mod pocket;

pub use curve::{Curve, Source};
pub use pocket::{Pocket, Pockets};
