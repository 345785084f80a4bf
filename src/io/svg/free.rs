//! Ellipses and splines as chains of segments, fine enough to look at.

use crate::boundary::{FreeCurve, FreeShape};
use crate::geom::{Ellipse, Point, Spline};

/// Segments of a whole ellipse.
const ROUND: f64 = 128.0;

/// Segments between two knots.
const BETWEEN_KNOTS: usize = 16;

/// As many polynomials of one spline are drawn; of the rest their ends are.
const MAX_FINE: usize = 4096;

/// Places along a curve, in its order.
pub(super) fn samples(curve: &FreeCurve) -> Vec<Point> {
    let mut places = match &curve.shape {
        FreeShape::Ellipse(ellipse) => along_ellipse(ellipse),
        FreeShape::Spline(spline) if spline.control.is_empty() => spline.fit.clone(),
        FreeShape::Spline(spline) => along_spline(spline),
    };
    places.retain(|p| p.is_finite());
    places
}

fn along_ellipse(ellipse: &Ellipse) -> Vec<Point> {
    let count = (ROUND * ellipse.sweep / std::f64::consts::TAU).ceil().max(2.0);
    (0..=count as usize).map(|i| ellipse.point_at(ellipse.start + ellipse.sweep * i as f64 / count)).collect()
}

fn along_spline(spline: &Spline) -> Vec<Point> {
    let last = spline.control.len();
    let is_usable = spline.degree > 0 && last > spline.degree && spline.knots.len() > last + spline.degree;
    if !is_usable {
        return spline.control.clone();
    }
    let steps = if last <= MAX_FINE { BETWEEN_KNOTS } else { 1 };
    let mut places = Vec::new();
    for span in spline.degree..last {
        let (from, to) = (spline.knots[span], spline.knots[span + 1]);
        if from < to {
            let step = |i: usize| from + (to - from) * i as f64 / steps as f64;
            places
                .extend((usize::from(!places.is_empty())..=steps).filter_map(|i| at(spline, span, step(i))));
        }
    }
    places
}

/// The place at parameter `t` between knots `span` and `span + 1`, by de Boor's algorithm.
fn at(spline: &Spline, span: usize, t: f64) -> Option<Point> {
    let degree = spline.degree;
    let first = span - degree;
    let weight = |i: usize| spline.weights.get(i).copied().unwrap_or(1.0);
    let homogeneous = |i: usize| {
        let (p, w) = (spline.control[i], weight(i));
        [p.x * w, p.y * w, w]
    };
    let mut row: Vec<[f64; 3]> = (first..=span).map(homogeneous).collect();
    for level in 1..=degree {
        for j in (level..=degree).rev() {
            let (low, high) = (spline.knots[first + j], spline.knots[first + j + degree + 1 - level]);
            let share = if high > low { (t - low) / (high - low) } else { 0.0 };
            row[j] = std::array::from_fn(|c| row[j - 1][c] + (row[j][c] - row[j - 1][c]) * share);
        }
    }
    let [x, y, w] = row[degree];
    Some(crate::geom::point(x / w, y / w)).filter(|p| p.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Source;
    use crate::geom::{point, vector};

    fn places(shape: FreeShape) -> Vec<Point> {
        samples(&FreeCurve { shape, source: Source::default() })
    }

    #[test]
    fn a_rational_quarter_of_a_circle_is_round() {
        let quarter = Spline {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            control: vec![point(2.0, 0.0), point(2.0, 2.0), point(0.0, 2.0)],
            weights: vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0],
            ..Spline::default()
        };
        let places = places(FreeShape::Spline(quarter));
        assert_eq!((places.len(), places[0]), (BETWEEN_KNOTS + 1, point(2.0, 0.0)));
        assert!(places.iter().all(|p| (p.distance(point(0.0, 0.0)) - 2.0).abs() < 1e-14));
    }

    #[test]
    fn an_ellipse_is_drawn_from_its_start_to_its_end() {
        let half = Ellipse {
            center: point(1.0, 1.0),
            major: vector(4.0, 0.0),
            ratio: 0.5,
            start: 0.0,
            sweep: std::f64::consts::PI,
        };
        let places = places(FreeShape::Ellipse(half));
        assert_eq!((places.len(), places[0]), (65, point(5.0, 1.0)));
        assert!(
            places[64].distance(point(-3.0, 1.0)) < 1e-14 && places[32].distance(point(1.0, 3.0)) < 1e-14
        );
    }

    #[test]
    fn a_spline_that_makes_no_sense_is_its_control_points() {
        let odd = Spline { degree: 9, control: vec![point(0.0, 0.0), point(1.0, 0.0)], ..Spline::default() };
        assert_eq!(places(FreeShape::Spline(odd)).len(), 2);
    }
}
