//! Why a free-form curve is none, or cannot be fitted.

use crate::geom::Point;

/// A fault of a free-form curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// The degree is out of range.
    #[error("the spline has degree {degree}, but 1 to 10 are known")]
    Degree {
        /// The degree.
        degree: usize,
    },
    /// Too few control or fit points.
    #[error("the spline has {count} points, but needs {needed}")]
    TooFewPoints {
        /// How many there are.
        count: usize,
        /// How many there must be.
        needed: usize,
    },
    /// The number of knots does not fit the points and the degree.
    #[error("the spline has {count} knots, but {expected} belong to its points and degree")]
    KnotCount {
        /// How many there are.
        count: usize,
        /// How many there must be.
        expected: usize,
    },
    /// A knot is smaller than the one before it, or not a number.
    #[error("knot {index} of the spline is out of order")]
    KnotOrder {
        /// Which one, from 0.
        index: usize,
    },
    /// All knots are equal: the curve has no extent.
    #[error("the knots of the spline span nothing")]
    NoSpan,
    /// The number of weights is not that of the points.
    #[error("the spline has {count} weights for {expected} points")]
    WeightCount {
        /// How many there are.
        count: usize,
        /// How many there must be.
        expected: usize,
    },
    /// A weight is zero, negative, not a number, or beyond all use.
    #[error("weight {index} of the spline is {value}, but must be from 1e-9 to 1e9")]
    Weight {
        /// Which one, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A coordinate, angle or tangent is not a number, or too large to calculate with.
    #[error("a number of the curve cannot be calculated with")]
    Number,
    /// The curve jumps at a knot.
    #[error("the spline jumps by {gap:.4} at {at}")]
    Jump {
        /// Where it jumps.
        at: Point,
        /// How far, in job units.
        gap: f64,
    },
    /// The tolerance is not a positive number.
    #[error("the tolerance is {tolerance}, but must be above 0")]
    Tolerance {
        /// What was asked for, in job units.
        tolerance: f64,
    },
    /// The tolerance is below what coordinates of this size can hold.
    #[error("the tolerance of {tolerance:e} is below the round-off of {round_off:e} of these coordinates")]
    TooFine {
        /// What was asked for, in job units.
        tolerance: f64,
        /// What the coordinates can hold, in job units.
        round_off: f64,
    },
    /// A limit on effort was reached.
    #[error("the curve near {at} needs more than {limit} arcs")]
    Effort {
        /// Where it was given up.
        at: Point,
        /// The limit.
        limit: usize,
    },
}
