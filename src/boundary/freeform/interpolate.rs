//! Cubic splines through given places.
//!
//! **Method.** Piecewise cubics in Hermite form whose parameter is the length of the chords.
//! Continuity of the second derivative is a diagonally dominant tridiagonal system for the
//! derivatives at the places, solved without pivoting; closed, it is cyclic and solved by the formula
//! of Sherman and Morrison (de Boor, *A Practical Guide to Splines*, chapter IV).

use super::error::CurveError;
use super::nurbs::Nurbs;
use super::pieces::is_usable;
use crate::geom::{Point, Vector};

/// The cubic through `places`; see [`Nurbs::through`].
pub(super) fn interpolate(
    places: &[Point],
    tangents: [Option<Vector>; 2],
    closed: bool,
) -> Result<Nurbs, CurveError> {
    let finite = |t: &Option<Vector>| t.is_none_or(|t| t.x.is_finite() && t.y.is_finite());
    if !places.iter().all(|&p| is_usable(p)) || !tangents.iter().all(finite) {
        return Err(CurveError::Number);
    }
    let mut places = places.to_vec();
    places.dedup();
    if closed && places.len() > 2 && places.first() != places.last() {
        places.push(places[0]);
    }
    if places.len() < 2 {
        return Err(CurveError::TooFewPoints { count: places.len(), needed: 2 });
    }
    let steps: Vec<f64> = places.windows(2).map(|w| w[0].distance(w[1])).collect();
    let cyclic = closed && places.len() > 3 && places.first() == places.last();
    let slopes = if cyclic { cyclic_slopes(&places, &steps) } else { open_slopes(&places, &steps, tangents) };
    hermite(&places, &steps, &slopes, closed)
}

/// Row of the system at an inner place: coefficients before, at and after it, and the right side.
fn row(before: f64, after: f64, chords: [Vector; 2]) -> ([f64; 3], Vector) {
    let right = chords[0] * (3.0 * after / before) + chords[1] * (3.0 * before / after);
    ([after, 2.0 * (before + after), before], right)
}

fn open_slopes(places: &[Point], steps: &[f64], tangents: [Option<Vector>; 2]) -> Vec<Vector> {
    let last = steps.len();
    let chord = |i: usize| places[i + 1] - places[i];
    let mut rows = vec![([0.0; 3], Vector::default()); last + 1];
    for i in 1..last {
        rows[i] = row(steps[i - 1], steps[i], [chord(i - 1), chord(i)]);
    }
    // The parameter is nearly arc length, so a given tangent counts with length 1. A free end has no
    // second derivative.
    let given = |t: Option<Vector>| t.filter(|t| t.length() > 0.0).map(Vector::unit);
    rows[0] = match given(tangents[0]) {
        Some(t) => ([0.0, 1.0, 0.0], t),
        None => ([0.0, 2.0, 1.0], chord(0) * (3.0 / steps[0])),
    };
    rows[last] = match given(tangents[1]) {
        Some(t) => ([0.0, 1.0, 0.0], t),
        None => ([1.0, 2.0, 0.0], chord(last - 1) * (3.0 / steps[last - 1])),
    };
    solve(rows)
}

fn cyclic_slopes(places: &[Point], steps: &[f64]) -> Vec<Vector> {
    let n = steps.len();
    let chord = |i: usize| places[i % n + 1] - places[i % n];
    let mut rows: Vec<_> =
        (0..n).map(|i| row(steps[(i + n - 1) % n], steps[i], [chord(i + n - 1), chord(i)])).collect();
    // The corners of the cyclic matrix are a change of rank one.
    let (first, last) = (rows[0].0[0], rows[n - 1].0[2]);
    let gamma = -rows[0].0[1];
    rows[0].0[1] -= gamma;
    rows[n - 1].0[1] -= first * last / gamma;
    let mut change: Vec<_> = rows.iter().map(|r| (r.0, Vector::default())).collect();
    change[0].1.x = gamma;
    change[n - 1].1.x = last;
    let (mut slopes, change) = (solve(rows), solve(change));
    let ratio = first / gamma;
    let denominator = 1.0 + change[0].x + ratio * change[n - 1].x;
    let factor = (slopes[0] + slopes[n - 1] * ratio) / denominator;
    for (slope, z) in slopes.iter_mut().zip(&change) {
        *slope = *slope - factor * z.x;
    }
    slopes.push(slopes[0]);
    slopes
}

/// A tridiagonal system, row by row.
fn solve(mut rows: Vec<([f64; 3], Vector)>) -> Vec<Vector> {
    for i in 1..rows.len() {
        let ([_, pivot, next], right) = rows[i - 1];
        let factor = rows[i].0[0] / pivot;
        rows[i].0[1] -= factor * next;
        rows[i].1 = rows[i].1 - right * factor;
    }
    let mut solution = vec![Vector::default(); rows.len()];
    for i in (0..rows.len()).rev() {
        let after = solution.get(i + 1).copied().unwrap_or_default();
        solution[i] = (rows[i].1 - after * rows[i].0[2]) / rows[i].0[1];
    }
    solution
}

/// The Hermite cubics as one spline whose inner knots are triple.
fn hermite(places: &[Point], steps: &[f64], slopes: &[Vector], closed: bool) -> Result<Nurbs, CurveError> {
    let mut points = vec![places[0]];
    let mut knots = vec![0.0; 4];
    let mut at = 0.0;
    for (i, &step) in steps.iter().enumerate() {
        let third = step / 3.0;
        points.extend([places[i] + slopes[i] * third, places[i + 1] - slopes[i + 1] * third, places[i + 1]]);
        at += step;
        knots.extend([at; 3]);
    }
    knots.push(at);
    Nurbs::new(3, knots, points, Vec::new(), closed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{point, vector};

    fn places() -> Vec<Point> {
        [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.0), (2.0, -1.0)].map(|(x, y)| point(x, y)).to_vec()
    }

    #[test]
    fn the_curve_is_smooth_through_all_places() {
        for closed in [false, true] {
            let spline = interpolate(&places(), [None, None], closed).unwrap();
            let pieces = spline.pieces().unwrap();
            let count = pieces.pieces.len();
            assert_eq!(count, if closed { 5 } else { 4 });
            for i in 0..count {
                assert!((pieces.origin + pieces.pieces[i].start()).distance(places()[i]) < 1e-14);
                if i + 1 == count && !closed {
                    continue;
                }
                let next = pieces.pieces[(i + 1) % count].jet(0.0);
                let this = pieces.pieces[i].jet(1.0);
                assert!((this.d1.unit() - next.d1.unit()).length() < 1e-13);
                assert!((this.curvature() - next.curvature()).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn free_ends_are_straight_and_given_tangents_are_kept() {
        let spline = interpolate(&places(), [None, Some(vector(0.0, -3.0))], false).unwrap();
        let pieces = spline.pieces().unwrap().pieces;
        assert!(pieces[0].jet(0.0).curvature().abs() < 1e-13);
        assert!((pieces[3].jet(1.0).d1.unit() - vector(0.0, -1.0)).length() < 1e-13);
    }

    #[test]
    fn two_places_make_a_segment() {
        let spline = interpolate(&places()[..2], [None, None], false).unwrap();
        let piece = spline.pieces().unwrap().pieces[0];
        assert!((piece.at(0.5) - (piece.start() + piece.end()) * 0.5).length() < 1e-15);
        assert!(interpolate(&[point(1.0, 1.0); 3], [None, None], false).is_err());
    }
}
