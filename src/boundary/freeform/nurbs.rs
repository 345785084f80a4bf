//! Non-uniform rational B-splines.

use super::error::CurveError;
use super::piece::{MAX_CURVE_DEGREE, Piece};
use super::pieces::{Pieces, is_usable};
use crate::geom::{Bounds, Point, Vector};

/// Smallest weight; the largest is its inverse. Beyond, control points lose all digits.
const LEAST_WEIGHT: f64 = 1e-9;

/// A non-uniform rational B-spline of degree 1 to 10: clamped, unclamped or periodic.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<Point>,
    /// As many as points.
    weights: Vec<f64>,
    closed: bool,
}

impl Nurbs {
    /// From a degree, knots and control points in job units. Weights may be empty, which means all
    /// equal. `points + degree + 1` knots are usual; a `closed` spline may have `points + 1`, those
    /// of one period, and goes on with its first points behind the last.
    ///
    /// # Errors
    ///
    /// A [`CurveError`] that says which number is wrong.
    pub fn new(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<Point>,
        weights: Vec<f64>,
        closed: bool,
    ) -> Result<Nurbs, CurveError> {
        if !(1..=MAX_CURVE_DEGREE).contains(&degree) {
            return Err(CurveError::Degree { degree });
        }
        if points.len() < 2 {
            return Err(CurveError::TooFewPoints { count: points.len(), needed: degree + 1 });
        }
        check_weights(&weights, points.len())?;
        if let Some(index) =
            (0..knots.len()).find(|&i| !knots[i].is_finite() || i > 0 && knots[i] < knots[i - 1])
        {
            return Err(CurveError::KnotOrder { index });
        }
        if !points.iter().all(|&p| is_usable(p)) {
            return Err(CurveError::Number);
        }
        let weights = if weights.is_empty() { vec![1.0; points.len()] } else { weights };
        let mut spline = Nurbs { degree, knots, points, weights, closed };
        if closed && spline.knots.len() == spline.points.len() + 1 {
            spline.unroll();
        }
        spline.check_knots()?;
        Ok(spline)
    }

    /// Through places in order, as CAD systems draw it: a cubic with continuous curvature whose
    /// parameter is the length of the chords. The tangents at the ends are kept where they are given;
    /// a free end has no curvature. Closed, it returns to the first place smoothly.
    ///
    /// # Errors
    ///
    /// Fewer than two different places, or numbers that cannot be calculated with.
    pub fn through(
        places: &[Point],
        tangents: [Option<Vector>; 2],
        closed: bool,
    ) -> Result<Nurbs, CurveError> {
        super::interpolate::interpolate(places, tangents, closed)
    }

    /// Degree of its pieces.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The control points, in job units.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The weights, one for each control point.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Whether it was drawn as closed.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Every control point mapped by an affine map, which maps the curve.
    #[must_use]
    pub fn transformed(&self, map: impl Fn(Point) -> Point) -> Nurbs {
        Nurbs { points: self.points.iter().map(|&p| map(p)).collect(), ..self.clone() }
    }

    /// The same curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> Nurbs {
        let ends = self.knots[0] + self.knots[self.knots.len() - 1];
        Nurbs {
            degree: self.degree,
            knots: self.knots.iter().rev().map(|k| ends - k).collect(),
            points: self.points.iter().rev().copied().collect(),
            weights: self.weights.iter().rev().copied().collect(),
            closed: self.closed,
        }
    }

    /// One period of a closed spline, written out with its first points repeated.
    fn unroll(&mut self) {
        let (n, d) = (self.points.len(), self.degree);
        let period = self.knots[n] - self.knots[0];
        let knot = |i: isize| {
            let turns = i.div_euclid(n as isize);
            self.knots[i.rem_euclid(n as isize) as usize] + turns as f64 * period
        };
        self.knots = (-(d as isize)..=(n + d) as isize).map(knot).collect();
        self.points = (0..n + d).map(|i| self.points[i % n]).collect();
        self.weights = (0..n + d).map(|i| self.weights[i % n]).collect();
    }

    fn check_knots(&self) -> Result<(), CurveError> {
        let (n, d) = (self.points.len(), self.degree);
        if n < d + 1 {
            return Err(CurveError::TooFewPoints { count: n, needed: d + 1 });
        }
        if self.knots.len() != n + d + 1 {
            return Err(CurveError::KnotCount { count: self.knots.len(), expected: n + d + 1 });
        }
        let span = self.knots[n] - self.knots[d];
        if !span.is_finite() {
            return Err(CurveError::Number);
        }
        if span <= 0.0 { Err(CurveError::NoSpan) } else { Ok(()) }
    }

    /// The Bezier pieces between different knots.
    ///
    /// # Errors
    ///
    /// [`CurveError::Jump`] where the curve is not connected.
    pub(super) fn pieces(&self) -> Result<Pieces, CurveError> {
        let d = self.degree;
        let mut pieces = Pieces::around(&Bounds::around(self.points.iter().copied()));
        let origin = pieces.origin;
        let local: Vec<Vector> = self.points.iter().map(|&p| p - origin).collect();
        for i in d..self.points.len() {
            if self.knots[i] < self.knots[i + 1] {
                pieces.push(self.piece(i, &local))?;
            }
        }
        pieces.close();
        Ok(pieces)
    }

    /// The Bezier piece between knots `i` and `i + 1`, by blossoms: its control point `j` is the
    /// polar form with `d - j` arguments at the first knot and `j` at the second.
    fn piece(&self, i: usize, local: &[Vector]) -> Piece {
        let d = self.degree;
        let first = i - d;
        let (mut points, mut weights) =
            ([Vector::default(); MAX_CURVE_DEGREE + 1], [0.0; MAX_CURVE_DEGREE + 1]);
        for j in 0..=d {
            let (mut p, mut w) = ([Vector::default(); MAX_CURVE_DEGREE + 1], [0.0; MAX_CURVE_DEGREE + 1]);
            p[..=d].copy_from_slice(&local[first..=i]);
            w[..=d].copy_from_slice(&self.weights[first..=i]);
            for level in 1..=d {
                let u = if level <= j { self.knots[i + 1] } else { self.knots[i] };
                for k in 0..=d - level {
                    let (low, high) = (self.knots[first + k + level], self.knots[i + 1 + k]);
                    let b = (u - low) / (high - low);
                    let (wa, wb) = ((1.0 - b) * w[k], b * w[k + 1]);
                    p[k] = if wa + wb > 0.0 { (p[k] * wa + p[k + 1] * wb) / (wa + wb) } else { p[k] };
                    w[k] = wa + wb;
                }
            }
            (points[j], weights[j]) = (p[0], w[0]);
        }
        Piece::new(&points[..=d], &weights[..=d])
    }
}

fn check_weights(weights: &[f64], count: usize) -> Result<(), CurveError> {
    if !weights.is_empty() && weights.len() != count {
        return Err(CurveError::WeightCount { count: weights.len(), expected: count });
    }
    match weights.iter().position(|w| !(LEAST_WEIGHT..=LEAST_WEIGHT.recip()).contains(w)) {
        Some(index) => Err(CurveError::Weight { index, value: weights[index] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn square() -> Vec<Point> {
        [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| point(x, y)).to_vec()
    }

    #[test]
    fn a_clamped_spline_begins_and_ends_in_its_points() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let pieces = Nurbs::new(3, knots, square(), vec![], false).unwrap().pieces().unwrap();
        assert_eq!(pieces.pieces.len(), 1);
        let ends = [pieces.pieces[0].start(), pieces.pieces[0].end()].map(|v| pieces.origin + v);
        assert_eq!(ends, [point(0.0, 0.0), point(0.0, 4.0)]);
        assert!(!pieces.closed);
    }

    #[test]
    fn one_period_of_knots_makes_a_closed_curve() {
        let knots = (0..=4).map(f64::from).collect();
        let pieces = Nurbs::new(3, knots, square(), vec![], true).unwrap().pieces().unwrap();
        assert!(pieces.closed && pieces.pieces.len() == 4);
        let long = Nurbs::new(
            2,
            (0..9).map(f64::from).collect(),
            [square(), square()[..2].to_vec()].concat(),
            vec![],
            true,
        );
        assert!(long.unwrap().pieces().unwrap().closed);
    }

    #[test]
    fn weights_draw_a_circle() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let points = vec![point(1.0, 0.0), point(1.0, 1.0), point(0.0, 1.0)];
        let pieces =
            Nurbs::new(2, knots, points, vec![3.0, 3.0 * half, 3.0], false).unwrap().pieces().unwrap();
        for i in 0..=8 {
            let p = pieces.origin + pieces.pieces[0].at(f64::from(i) / 8.0);
            assert!((p.to_vector().length() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn wrong_numbers_are_told() {
        let knots = |n: usize| (0..n).map(|i| i as f64).collect::<Vec<_>>();
        let new = |degree, knots, weights| Nurbs::new(degree, knots, square(), weights, false).unwrap_err();
        assert_eq!(new(11, knots(16), vec![]), CurveError::Degree { degree: 11 });
        assert_eq!(new(4, knots(9), vec![]), CurveError::TooFewPoints { count: 4, needed: 5 });
        assert_eq!(new(3, knots(9), vec![]), CurveError::KnotCount { count: 9, expected: 8 });
        assert_eq!(new(3, vec![1.0, 0.0], vec![]), CurveError::KnotOrder { index: 1 });
        assert_eq!(new(3, vec![1.0; 8], vec![]), CurveError::NoSpan);
        assert_eq!(new(3, knots(8), vec![1.0]), CurveError::WeightCount { count: 1, expected: 4 });
        assert!(matches!(new(3, knots(8), vec![1.0, 1.0, -1.0, 1.0]), CurveError::Weight { index: 2, .. }));
        let torn = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
        let torn = Nurbs::new(1, torn, square(), vec![], false).unwrap();
        assert!(matches!(torn.pieces(), Err(CurveError::Jump { .. })));
        // A piece of no extent does not hide a jump behind it.
        let still = [square()[0], square()[0], square()[1], square()[2]].to_vec();
        let torn = Nurbs::new(1, vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0], still, vec![], false).unwrap();
        assert!(matches!(torn.pieces(), Err(CurveError::Jump { .. })));
    }
}
