//! From drawn curves to pockets.

mod curve;
mod pocket;

pub use curve::{Curve, Source};
pub use pocket::{Pocket, Pockets};
#[doc(hidden)]
pub fn checked(mut v: Vec<crate::ArcSpline>) -> Pocket {
    let outer = v.remove(0);
    Pocket::from_checked(outer, v)
}
