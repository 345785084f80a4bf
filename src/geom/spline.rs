//! Rational B-splines as drawings hold them.

use super::{Point, Vector};
use serde::{Deserialize, Serialize};

/// A B-spline, by control points or by points to run through.
///
/// With control points, there are `control.len() + degree + 1` knots that never fall, and it
/// covers the parameters from knot `degree` to knot `control.len()`, which differ. Without, there
/// are at least two fit points.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spline {
    /// Degree of its polynomials, at least 1.
    pub degree: usize,
    /// Parameters where polynomials meet.
    pub knots: Vec<f64>,
    /// Control points.
    pub control: Vec<Point>,
    /// Weights of the control points, above 0; none if all are equal.
    pub weights: Vec<f64>,
    /// Points that it runs through.
    pub fit: Vec<Point>,
    /// Directions at the first and the last fit point, where they are given.
    pub tangents: [Option<Vector>; 2],
    /// Whether it is drawn as closed.
    pub closed: bool,
}
