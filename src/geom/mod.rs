//! Places, segments, arcs and arc splines. Knows nothing of pockets or tools.
//!
//! Angles are radians, counter-clockwise; y points up; curvature is positive on a left turn.

mod arc_spline;
mod bounds;
mod element;
mod point;

pub use arc_spline::{ArcSpline, Vertex};
pub use bounds::Bounds;
pub use element::{Element, Nearest};
pub use point::{Point, Vector, point, vector};
