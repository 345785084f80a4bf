//! One rational Bezier piece of a curve.
//!
//! Coordinates are relative to an origin near the curve, so that its round-off is that of its own
//! extent. Everything has a fixed size: no piece, no part of one and no derivative allocates.

use crate::geom::{Vector, vector};

/// Largest degree of a curve.
pub(super) const MAX_CURVE_DEGREE: usize = 10;

const LEN: usize = MAX_CURVE_DEGREE + 1;

/// Where a weight is less than this part of the largest, powers of the parameter cost digits.
const LEAST_WEIGHT: f64 = 1.0 / 16.0;

/// A rational Bezier curve on 0..=1 with positive weights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    degree: usize,
    /// Whether the weights differ; otherwise all are 1.
    rational: bool,
    points: [Vector; LEN],
    weights: [f64; LEN],
    /// Whether those are noted: of a piece of degree 3 at most with weights near to each other.
    has_powers: bool,
    /// Coefficients of both numerators and the denominator by powers of
    /// the parameter.
    cubics: [[f64; 4]; 3],
}

/// Place and derivatives by the parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    /// The place.
    pub q: Vector,
    /// First derivative.
    pub d1: Vector,
    /// Second derivative.
    pub d2: Vector,
    /// Third derivative.
    pub d3: Vector,
}

impl Jet {
    /// Signed curvature, left turn positive.
    pub fn curvature(&self) -> f64 {
        let speed2 = self.d1.length_squared();
        self.d1.cross(self.d2) / (speed2 * speed2.sqrt())
    }

    /// Derivative of the curvature by arc length.
    pub fn curvature_slope(&self) -> f64 {
        let [speed2, _, turn] = self.turn();
        turn / (speed2 * speed2 * speed2)
    }

    /// The squared speed, the curvature times its cube, and the derivative of the curvature by arc length times the
    /// sixth power of the speed.
    #[inline]
    pub fn turn(&self) -> [f64; 3] {
        let (speed2, cross) = (self.d1.length_squared(), self.d1.cross(self.d2));
        let turn = self.d1.cross(self.d3) * speed2 - 3.0 * cross * self.d1.dot(self.d2);
        [speed2, cross, turn]
    }
}

impl Piece {
    /// From control points and positive weights, at most [`MAX_CURVE_DEGREE`] + 1 of them.
    pub fn new(points: &[Vector], weights: &[f64]) -> Piece {
        let mut piece = Piece {
            degree: points.len() - 1,
            rational: weights.iter().any(|&w| w != weights[0]),
            points: [Vector::default(); LEN],
            weights: [1.0; LEN],
            has_powers: false,
            cubics: [[0.0; 4]; 3],
        };
        piece.points[..points.len()].copy_from_slice(points);
        if piece.rational {
            // Only ratios matter; the largest weight is made 1.
            let largest = weights.iter().fold(0.0, |m: f64, &w| m.max(w));
            for (to, from) in piece.weights.iter_mut().zip(weights) {
                *to = from / largest;
            }
        }
        piece.expand();
        piece
    }

    /// Degree of numerator and denominator.
    #[inline]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Whether it has a denominator.
    #[inline]
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// Control points.
    #[inline]
    pub fn points(&self) -> &[Vector] {
        &self.points[..=self.degree]
    }

    /// Weights, all 1 without a denominator.
    #[inline]
    pub fn weights(&self) -> &[f64] {
        &self.weights[..=self.degree]
    }

    /// First control point.
    #[inline]
    pub fn start(&self) -> Vector {
        self.points[0]
    }

    /// Last control point.
    #[inline]
    pub fn end(&self) -> Vector {
        self.points[self.degree]
    }

    /// The same piece beginning exactly at a place that its start equals to round-off.
    pub fn starting_at(mut self, start: Vector) -> Piece {
        self.points[0] = start;
        self.expand();
        self
    }

    /// Moves every control point by an affine map, which maps the curve.
    pub fn map(&mut self, map: impl Fn(Vector) -> Vector) {
        for p in &mut self.points[..=self.degree] {
            *p = map(*p);
        }
        self.expand();
    }

    /// Place at `t`.
    pub fn at(&self, t: f64) -> Vector {
        if self.rational || self.has_powers {
            return self.motion(t).0;
        }
        let (mut p, n) = (self.points, self.degree);
        for level in (0..n).rev() {
            for i in 0..=level {
                p[i] = p[i] * (1.0 - t) + p[i + 1] * t;
            }
        }
        p[0]
    }

    /// Place and first derivative at `t`.
    pub fn motion(&self, t: f64) -> (Vector, Vector) {
        if self.has_powers {
            let [x, y, w] = &self.cubics;
            let (x, y) = (risen(x, t), risen(y, t));
            if !self.rational {
                return (vector(x.0, y.0), vector(x.1, y.1));
            }
            let w = risen(w, t);
            let part = w.0.recip();
            let q = vector(x.0, y.0) * part;
            return (q, (vector(x.1, y.1) - q * w.1) * part);
        }
        if self.rational {
            let jet = self.jet(t);
            return (jet.q, jet.d1);
        }
        let (mut p, n) = (self.points, self.degree);
        for level in (1..n).rev() {
            for i in 0..=level {
                p[i] = p[i] * (1.0 - t) + p[i + 1] * t;
            }
        }
        (p[0] * (1.0 - t) + p[1] * t, (p[1] - p[0]) * n as f64)
    }

    /// Place and derivatives at `t`.
    pub fn jet(&self, t: f64) -> Jet {
        let [x, y, w] = if self.has_powers {
            self.powers(t).map(|c| [c[0], c[1], 2.0 * c[2], 6.0 * c[3]])
        } else {
            let Homogeneous { x, y, w } = self.homogeneous();
            [x, y, w].map(|c| taylor(c, self.degree, t))
        };
        let d = |i: usize| vector(x[i], y[i]);
        if !self.rational {
            return Jet { q: d(0), d1: d(1), d2: d(2), d3: d(3) };
        }
        let part = w[0].recip();
        let q = d(0) * part;
        let d1 = (d(1) - q * w[1]) * part;
        let d2 = (d(2) - d1 * (2.0 * w[1]) - q * w[2]) * part;
        let d3 = (d(3) - d2 * (3.0 * w[1]) - d1 * (3.0 * w[2]) - q * w[3]) * part;
        Jet { q, d1, d2, d3 }
    }

    /// Whether [`Piece::powers`] may be asked for.
    #[inline]
    pub fn has_powers(&self) -> bool {
        self.has_powers
    }

    /// The coefficients of both numerators and the denominator, of degree 3 at most, by powers of the
    /// distance from parameter `t`.
    #[inline]
    pub fn powers(&self, t: f64) -> [[f64; 4]; 3] {
        debug_assert!(self.has_powers);
        let [x, y, w] = &self.cubics;
        [shifted(x, t), shifted(y, t), if self.rational { shifted(w, t) } else { *w }]
    }

    /// Notes the coefficients by powers of the parameter.
    fn expand(&mut self) {
        self.has_powers = self.degree <= 3 && self.weights().iter().all(|&w| w >= LEAST_WEIGHT);
        if self.has_powers {
            let n = self.degree;
            let [x, y] = [self.four(|p, w| p.x * w), self.four(|p, w| p.y * w)];
            let w = if self.rational { powers_of(self.four(|_, w| w), n) } else { [1.0, 0.0, 0.0, 0.0] };
            self.cubics = [powers_of(x, n), powers_of(y, n), w];
        }
    }

    /// Something of the first four control points and weights.
    #[inline]
    fn four(&self, of: impl Fn(Vector, f64) -> f64) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| of(self.points[i], self.weights[i]))
    }

    fn homogeneous(&self) -> Homogeneous {
        let (mut x, mut y) = ([0.0; LEN], [0.0; LEN]);
        for i in 0..=self.degree {
            (x[i], y[i]) = (self.points[i].x * self.weights[i], self.points[i].y * self.weights[i]);
        }
        Homogeneous { x, y, w: self.weights }
    }

    /// The part between two parameters, `from < to`, again on 0..=1.
    pub fn part(&self, from: f64, to: f64) -> Piece {
        let mut part = *self;
        if to < 1.0 {
            part.cut(to, false);
        }
        if from > 0.0 {
            part.cut(from / to, true);
        }
        part.expand();
        part
    }

    /// Keeps what lies before `t`, or what lies `after` it.
    fn cut(&mut self, t: f64, after: bool) {
        let n = self.degree;
        let s = 1.0 - t;
        for level in 1..=n {
            // Running in place, one end of the triangle stays behind level by level.
            for j in 0..=n - level {
                let (i, keep, other) = if after { (j, j, j + 1) } else { (n - j, n - j, n - j - 1) };
                let (a, b) = if after { (s, t) } else { (t, s) };
                if self.rational {
                    let (wa, wb) = (a * self.weights[keep], b * self.weights[other]);
                    let w = wa + wb;
                    self.points[i] = (self.points[keep] * wa + self.points[other] * wb) / w;
                    self.weights[i] = w;
                } else {
                    self.points[i] = self.points[keep] * a + self.points[other] * b;
                }
            }
        }
    }
}

/// Numerators and denominator.
struct Homogeneous {
    x: [f64; LEN],
    y: [f64; LEN],
    w: [f64; LEN],
}

/// Coefficients by powers of a polynomial in Bernstein form of degree 3 at most.
fn powers_of([a, b, c, d]: [f64; 4], n: usize) -> [f64; 4] {
    match n {
        3 => [a, 3.0 * (b - a), 3.0 * ((c - b) - (b - a)), (d - c) - 2.0 * (c - b) + (b - a)],
        2 => [a, 2.0 * (b - a), (c - b) - (b - a), 0.0],
        1 => [a, b - a, 0.0, 0.0],
        _ => [a, 0.0, 0.0, 0.0],
    }
}

/// Value and derivative at `t` of a cubic by powers.
#[inline]
fn risen([a, b, c, d]: &[f64; 4], t: f64) -> (f64, f64) {
    let e = d * t;
    let h = b + (c + e) * t;
    (a + h * t, h + (c + 2.0 * e) * t)
}

/// The same cubic by powers of the distance from `t`.
#[inline]
fn shifted([a, b, c, d]: &[f64; 4], t: f64) -> [f64; 4] {
    let e = d * t;
    let (f, g) = (c + e, c + 2.0 * e);
    let h = b + f * t;
    [a + h * t, h + g * t, g + e, *d]
}

/// Value and first three derivatives at `t` of a polynomial in Bernstein form.
fn taylor(mut c: [f64; LEN], n: usize, t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    for level in (n.min(3)..n).rev() {
        for i in 0..=level {
            c[i] = s * c[i] + t * c[i + 1];
        }
    }
    // Four coefficients are left: the form of the last three levels gives the derivatives.
    let nf = n as f64;
    let d3 =
        if n >= 3 { nf * (nf - 1.0) * (nf - 2.0) * (c[3] - 3.0 * c[2] + 3.0 * c[1] - c[0]) } else { 0.0 };
    if n >= 3 {
        (c[0], c[1], c[2]) = (s * c[0] + t * c[1], s * c[1] + t * c[2], s * c[2] + t * c[3]);
    }
    let d2 = if n >= 2 { nf * (nf - 1.0) * (c[2] - 2.0 * c[1] + c[0]) } else { 0.0 };
    if n >= 2 {
        (c[0], c[1]) = (s * c[0] + t * c[1], s * c[1] + t * c[2]);
    }
    let d1 = if n >= 1 { nf * (c[1] - c[0]) } else { 0.0 };
    let value = if n >= 1 { s * c[0] + t * c[1] } else { c[0] };
    [value, d1, d2, d3]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wild() -> Piece {
        let points =
            [vector(0.0, 0.0), vector(1.0, 2.0), vector(3.0, -1.0), vector(4.0, 1.0), vector(5.0, 0.5)];
        Piece::new(&points, &[1.0, 2.0, 0.5, 3.0, 1.5])
    }

    #[test]
    fn a_part_is_the_same_curve() {
        let plain = Piece::new(wild().points(), &[1.0; 5]);
        for whole in [wild(), plain] {
            let part = whole.part(0.2, 0.7);
            for i in 0..=10 {
                // A rational part keeps its parameter, as weights are divided and not rescaled.
                let t = f64::from(i) / 10.0;
                assert!((part.at(t) - whole.at(0.2 + 0.5 * t)).length() < 1e-14);
            }
        }
    }

    #[test]
    fn derivatives_are_limits_of_differences() {
        const STEP: f64 = 1e-5;
        for piece in [wild(), Piece::new(wild().points(), &[1.0; 5])] {
            let (a, b, jet) = (piece.jet(0.4 - STEP), piece.jet(0.4 + STEP), piece.jet(0.4));
            for (x, y, d) in [(a.q, b.q, jet.d1), (a.d1, b.d1, jet.d2), (a.d2, b.d2, jet.d3)] {
                assert!(((y - x) / (2.0 * STEP) - d).length() < 1e-6 * d.length().max(1.0));
            }
            let slope = (b.curvature() - a.curvature()) / (2.0 * STEP * jet.d1.length());
            assert!((slope - jet.curvature_slope()).abs() < 1e-6 * slope.abs());
        }
    }

    #[test]
    fn low_degrees_have_vanishing_derivatives() {
        let line = Piece::new(&[vector(1.0, 2.0), vector(3.0, 2.0)], &[1.0; 2]).jet(0.25);
        assert_eq!((line.q, line.d1), (vector(1.5, 2.0), vector(2.0, 0.0)));
        assert_eq!((line.d2, line.d3), (vector(0.0, 0.0), vector(0.0, 0.0)));
    }
}
