//! Places, segments, arcs and arc splines; ellipses and splines as drawn. Knows nothing of pockets or tools.
//!
//! Angles are radians, counter-clockwise; y points up; curvature is positive on a left turn.

mod arc_spline;
mod bounds;
mod element;
mod ellipse;
mod point;
mod spline;

pub use arc_spline::{ArcSpline, Vertex};
pub use bounds::Bounds;
pub use element::{Element, Nearest};
pub use ellipse::Ellipse;
pub use point::{Point, Vector, point, vector};
pub use spline::Spline;
