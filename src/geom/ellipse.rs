//! Ellipses and their arcs.

use super::{Point, Vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, TAU};

/// An arc of an ellipse, or all of it: `center + major cos t + minor sin t`, where `minor` is
/// `major` turned to the left and shortened by `ratio`, for `t` from `start` over `sweep`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ellipse {
    /// Its center.
    pub center: Point,
    /// From the center to the vertex at parameter 0.
    pub major: Vector,
    /// Length of the minor axis in parts of the major one, at most 1.
    pub ratio: f64,
    /// Parameter where it begins, in `[0, 2 pi)`.
    pub start: f64,
    /// Range of parameters that it covers, counter-clockwise, in `(0, 2 pi]`.
    pub sweep: f64,
}

impl Ellipse {
    /// The curve `center + a cos t + b sin t`, for `t` from `start` over `sweep`, which may be
    /// negative. `a` and `b` need not be perpendicular: what an affine map makes of a circle is
    /// such a curve.
    pub fn from_conjugate(center: Point, a: Vector, b: Vector, start: f64, sweep: f64) -> Ellipse {
        let (start, sweep) = if sweep < 0.0 { (start + sweep, -sweep) } else { (start, sweep) };
        let (major, minor, shift) = axes(a, b);
        // A minor axis to the right of the major one runs through the parameters the other way.
        let start = if major.cross(minor) < 0.0 { shift - start - sweep } else { start - shift };
        let ratio = (minor.length() / major.length()).min(1.0);
        Ellipse { center, major, ratio, start: start.rem_euclid(TAU), sweep: sweep.min(TAU) }
    }

    /// Whether it is the whole ellipse.
    pub fn is_full(&self) -> bool {
        self.sweep == TAU
    }

    /// The place at a parameter.
    pub fn point_at(&self, t: f64) -> Point {
        let (sin, cos) = t.sin_cos();
        self.center + self.major * cos + self.major.left() * (self.ratio * sin)
    }

    /// The two ends; the same place twice for a whole ellipse.
    pub fn ends(&self) -> [Point; 2] {
        let end = if self.is_full() { self.start } else { self.start + self.sweep };
        [self.point_at(self.start), self.point_at(end)]
    }
}

/// Perpendicular axes of `a cos t + b sin t`, the longer one first, and the parameter of its
/// vertex. Exact where `a` and `b` are perpendicular already.
fn axes(a: Vector, b: Vector) -> (Vector, Vector, f64) {
    let product = a.dot(b);
    if product == 0.0 {
        return if a.length() >= b.length() { (a, b, 0.0) } else { (b, -a, FRAC_PI_2) };
    }
    let shift = 0.5 * (2.0 * product).atan2(a.length_squared() - b.length_squared());
    let (sin, cos) = shift.sin_cos();
    (a * cos + b * sin, b * cos - a * sin, shift)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{point, vector};

    #[test]
    fn a_circle_stretched_along_an_axis_has_round_axes() {
        let center = point(1.0, 2.0);
        let wide = Ellipse::from_conjugate(center, vector(6.0, 0.0), vector(0.0, 3.0), 0.0, TAU);
        assert_eq!((wide.major, wide.ratio, wide.is_full()), (vector(6.0, 0.0), 0.5, true));
        let high = Ellipse::from_conjugate(center, vector(3.0, 0.0), vector(0.0, 6.0), 0.0, TAU);
        assert_eq!((high.major, high.ratio), (vector(0.0, 6.0), 0.5));
    }

    #[test]
    fn the_curve_stays_the_same_whatever_spans_it() {
        let center = point(-3.0, 7.0);
        for (a, b) in [
            (vector(2.0, 1.0), vector(0.5, 3.0)),
            (vector(2.0, 1.0), vector(0.5, -3.0)),
            (vector(1.0, 4.0), vector(4.0, 1.0)),
            (vector(0.0, 2.0), vector(-5.0, 0.0)),
        ] {
            for (start, sweep) in [(0.3, 2.0), (5.0, 4.0), (1.0, -2.5)] {
                let e = Ellipse::from_conjugate(center, a, b, start, sweep);
                let at = |t: f64| center + a * t.cos() + b * t.sin();
                let mut wanted = [at(start), at(start + sweep)];
                if (a.cross(b) < 0.0) != (sweep < 0.0) {
                    wanted.reverse();
                }
                let found = e.ends();
                assert!(found[0].distance(wanted[0]) < 1e-14 && found[1].distance(wanted[1]) < 1e-14);
                let middle = e.point_at(e.start + 0.5 * e.sweep);
                assert!(middle.distance(at(start + 0.5 * sweep)) < 1e-14);
                assert!(e.ratio < 1.0);
            }
        }
    }
}
