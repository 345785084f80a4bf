//! Ellipses and elliptic arcs.

use super::error::CurveError;
use super::piece::Piece;
use super::pieces::{Pieces, is_usable};
use crate::geom::{Bounds, Point, Vector};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Angles nearer than this are one: roundings of a difference of angles of up to some turns.
const SAME_ANGLE: f64 = 32.0 * f64::EPSILON;

/// Largest absolute parameter: angles of more turns have lost their digits.
const ANGLE_LIMIT: f64 = 1e6;

/// The curve `center + u cos t + v sin t` for `t` from `start` to `end`, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseArc {
    center: Point,
    u: Vector,
    v: Vector,
    start: f64,
    sweep: f64,
}

impl EllipseArc {
    /// The arc of an ellipse with half axis `major`, the other half axis `ratio` times as long to its
    /// left (to its right when negative), from parameter `start` counter-clockwise to `end`. Equal
    /// parameters mean the whole ellipse.
    ///
    /// # Errors
    ///
    /// Numbers that cannot be calculated with.
    pub fn new(
        center: Point,
        major: Vector,
        ratio: f64,
        start: f64,
        end: f64,
    ) -> Result<EllipseArc, CurveError> {
        let (u, v) = (major, major.left() * ratio);
        let usable = [center + u + v, center - u - v, center].into_iter().all(is_usable);
        if !usable || ![start, end].iter().all(|a| a.abs() <= ANGLE_LIMIT) {
            return Err(CurveError::Number);
        }
        let sweep = (end - start).rem_euclid(TAU);
        let same = SAME_ANGLE * (1.0 + start.abs() + end.abs());
        let sweep = if sweep <= same || sweep >= TAU - same { TAU } else { sweep };
        Ok(EllipseArc { center, u, v, start, sweep })
    }

    /// The curve mapped by an affine map; which half axes it has then is found out.
    #[must_use]
    pub fn transformed(&self, map: impl Fn(Point) -> Point) -> EllipseArc {
        let center = map(self.center);
        EllipseArc {
            center,
            u: map(self.center + self.u) - center,
            v: map(self.center + self.v) - center,
            ..*self
        }
    }

    /// The same curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> EllipseArc {
        EllipseArc { v: -self.v, start: -(self.start + self.sweep), ..*self }
    }

    /// Place at a parameter in radians.
    pub fn at(&self, t: f64) -> Point {
        let (sin, cos) = t.sin_cos();
        self.center + self.u * cos + self.v * sin
    }

    /// The parameters of start and end, in radians.
    pub fn range(&self) -> (f64, f64) {
        (self.start, self.start + self.sweep)
    }

    /// Half axes, perpendicular, and the parameter of the first one.
    fn axes(&self) -> (Vector, Vector, f64) {
        let (u, v) = (self.u, self.v);
        let at = 0.5 * (2.0 * u.dot(v)).atan2(u.length_squared() - v.length_squared());
        let (sin, cos) = at.sin_cos();
        (u * cos + v * sin, v * cos - u * sin, at)
    }

    /// Rational quadratics between the four vertices and the ends.
    pub(super) fn pieces(&self) -> Result<Pieces, CurveError> {
        let corners = [self.u + self.v, self.u - self.v];
        let around = corners.iter().flat_map(|&c| [self.center + c, self.center - c]);
        let mut pieces = Pieces::around(&Bounds::around(around));
        let (a, b, at) = self.axes();
        let center = self.center - pieces.origin;
        let place = |t: f64| center + a * t.cos() + b * t.sin();
        let (from, to) = (self.start - at, self.start - at + self.sweep);
        let mut stops = vec![from];
        let mut quarter = (from / FRAC_PI_2).floor() + 1.0;
        while quarter * FRAC_PI_2 < to - SAME_ANGLE {
            if quarter * FRAC_PI_2 > from + SAME_ANGLE {
                stops.push(quarter * FRAC_PI_2);
            }
            quarter += 1.0;
        }
        stops.push(to);
        for w in stops.windows(2) {
            let (half, middle) = (0.5 * (w[1] - w[0]), 0.5 * (w[0] + w[1]));
            let weight = half.cos();
            let top = center + (a * middle.cos() + b * middle.sin()) / weight;
            pieces.push(Piece::new(&[place(w[0]), top, place(w[1])], &[1.0, weight, 1.0]))?;
        }
        pieces.close();
        Ok(pieces)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{point, vector};

    #[test]
    fn pieces_lie_on_the_ellipse() {
        let e = EllipseArc::new(point(3.0, 1.0), vector(4.0, 3.0), 0.4, 0.3, 5.0).unwrap();
        let pieces = e.pieces().unwrap();
        assert_eq!(pieces.pieces.len(), 4);
        for piece in &pieces.pieces {
            for i in 0..=6 {
                let w = pieces.origin + piece.at(f64::from(i) / 6.0) - point(3.0, 1.0);
                let (x, y) = (w.dot(vector(0.8, 0.6)) / 5.0, w.dot(vector(-0.6, 0.8)) / 2.0);
                assert!((x * x + y * y - 1.0).abs() < 1e-14);
            }
        }
        assert!((pieces.origin + pieces.pieces[0].start()).distance(e.at(0.3)) < 1e-14);
        assert!((pieces.origin + pieces.pieces[3].end()).distance(e.at(5.0)) < 1e-14);
    }

    #[test]
    fn equal_parameters_mean_all_of_it() {
        for (start, end) in [(0.0, TAU), (1.0, 1.0), (0.0, 0.0), (-1.0, TAU - 1.0)] {
            let e = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, start, end).unwrap();
            let pieces = e.pieces().unwrap();
            assert!(pieces.closed, "{start} {end}");
            assert!(pieces.pieces.len() <= 5);
        }
    }

    #[test]
    fn a_shear_is_an_ellipse_again() {
        let e = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 1.0, 0.0, 0.0).unwrap();
        let sheared = e.transformed(|p| point(p.x + p.y, p.y));
        let (a, b, _) = sheared.axes();
        assert!(a.dot(b).abs() < 1e-15);
        assert!((a.cross(b) - 4.0).abs() < 1e-14);
        let back = e.reversed();
        assert!(back.at(back.range().0).distance(e.at(e.range().1)) < 1e-15);
    }
}
