//! Free-form curves and the arc splines that stand for them.

mod bernstein;
mod biarc;
mod bound;
mod cuts;
mod ellipse;
mod error;
mod features;
mod fit;
mod interpolate;
mod march;
mod nurbs;
mod piece;
mod pieces;
mod roots;
mod run;
mod spiral;
mod track;

pub use ellipse::EllipseArc;
pub use error::CurveError;
pub use fit::{Cuts, Fit};
pub use nurbs::Nurbs;
pub use spiral::Scheme;
