//! From drawn curves to pockets.

mod curve;
mod pocket;

pub use curve::{Curve, Source};
pub use pocket::{Pocket, Pockets};
