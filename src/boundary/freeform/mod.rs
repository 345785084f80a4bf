//! Free-form curves and the arc splines that stand for them.

mod bernstein;
mod ellipse;
mod error;
mod features;
mod interpolate;
mod nurbs;
mod piece;
mod pieces;
mod roots;

pub use ellipse::EllipseArc;
pub use error::CurveError;
pub use nurbs::Nurbs;
