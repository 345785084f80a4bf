//! From drawn curves to pockets.

mod arrange;
mod assemble;
mod chain;
mod clean;
mod crossing;
mod curve;
mod duplicate;
mod ends;
mod fan;
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
