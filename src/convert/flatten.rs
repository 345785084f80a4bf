//! Arcs as chords within a tolerance.
//!
//! **Guarantees** vertices on the curve, ends of elements among them to the last bit, chords of an
//! arc of equal length and no farther from it than the tolerance, and that no loop flattens to
//! nothing. **Does not** look at neighbors: curves closer to each other than twice the tolerance may
//! touch or cross when flattened.

use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Element, Point};
use std::f64::consts::{FRAC_PI_2, PI};

/// Most vertices of one conversion: 160 MB of coordinates.
const MAX_VERTICES: u64 = 10_000_000;

/// Flattens splines; of closed ones the first vertex is not repeated.
///
/// # Errors
/// [`Error::Parameter`] when the tolerance is no positive number, [`Error::Defects`] when a
/// coordinate is none, [`Error::Effort`] when there would be too many vertices.
pub(super) fn flatten<'a>(
    splines: impl Iterator<Item = &'a ArcSpline> + Clone,
    tolerance: f64,
) -> Result<Vec<Vec<Point>>, Error> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(Error::Parameter { name: "tolerance", value: tolerance, range: "above 0" });
    }
    let mut vertices = splines.clone().flat_map(|s| &s.vertices);
    if let Some(v) = vertices.find(|v| !v.point.is_finite() || !v.bulge.is_finite()) {
        return Err(Error::Defects(vec![Defect::Coordinate { at: v.point }]));
    }
    let count = |s: &ArcSpline| s.elements().map(|e| chords(s, &e, tolerance)).sum::<f64>();
    let needed = splines.clone().map(count).sum::<f64>() as u64;
    if needed > MAX_VERTICES {
        return Err(Error::Effort { what: "a polygon within this tolerance", needed, limit: MAX_VERTICES });
    }
    Ok(splines.map(|s| ring(s, tolerance)).collect())
}

/// The vertices of one spline.
fn ring(spline: &ArcSpline, tolerance: f64) -> Vec<Point> {
    let mut ring = Vec::with_capacity(spline.vertices.len());
    for e in spline.elements() {
        let n = chords(spline, &e, tolerance);
        ring.extend((0..n as u32).map(|i| e.point_at(f64::from(i) / n)));
    }
    ring.extend(spline.vertices.last().filter(|_| !spline.closed).map(|v| v.point));
    ring
}

/// Number of chords for an element. A chord over the angle `a` is `2 r sin(a / 4)^2` from its arc;
/// none is over more than a quarter turn. In a loop of two elements one chord is not enough.
fn chords(spline: &ArcSpline, e: &Element, tolerance: f64) -> f64 {
    if e.is_segment() {
        return 1.0;
    }
    let sine = (0.5 * tolerance * e.curvature().abs()).sqrt().min((PI / 8.0).sin());
    let angle = (4.0 * sine.asin()).min(FRAC_PI_2);
    let fewest = if spline.closed && spline.len() < 3 { 2.0 } else { 1.0 };
    (e.sweep().abs() / angle).ceil().max(fewest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn flat(spline: &ArcSpline, tolerance: f64) -> Vec<Point> {
        flatten([spline].into_iter(), tolerance).unwrap().remove(0)
    }

    /// Largest distance of the chords from the curve, taken at their middles.
    fn gap(spline: &ArcSpline, ring: &[Point]) -> f64 {
        let n = ring.len();
        let middles = (0..n).map(|i| ring[i].midpoint(ring[(i + 1) % n]));
        middles.map(|p| spline.distance(p)).fold(0.0, f64::max)
    }

    #[test]
    fn a_circle_becomes_a_regular_polygon_just_within_the_tolerance() {
        let circle = ArcSpline::circle(point(3.0, -2.0), 10.0);
        let ring = flat(&circle, 0.01);
        // acos(1 - 0.001) is 0.0447 radians, half the angle of a chord: 70.3 chords.
        assert_eq!(ring.len(), 72);
        let gap = gap(&circle, &ring);
        assert!(gap <= 0.01 && gap > 0.009, "{gap}");
        assert!(ring.iter().all(|p| circle.distance(*p) < 1e-14));
    }

    #[test]
    fn however_coarse_a_loop_keeps_an_inside() {
        assert_eq!(flat(&ArcSpline::circle(point(0.0, 0.0), 1.0), 1e9).len(), 4);
        let lens = ArcSpline::closed([(0.0, 0.0, 0.1), (1.0, 0.0, 0.1)]);
        assert_eq!(flat(&lens, 1e9).len(), 4);
        let sail = ArcSpline::closed([(0.0, 0.0, 0.1), (1.0, 0.0, 0.0)]);
        assert_eq!(flat(&sail, 1e9).len(), 3);
    }

    #[test]
    fn ends_are_kept_to_the_last_bit_and_open_splines_stay_open() {
        let open = ArcSpline::open([(0.1, 0.2, 0.3), (7.7, 1.0 / 3.0, 0.0), (-1e-300, 9.0, -0.9)]);
        let ring = flat(&open, 0.5);
        assert_eq!((ring[0], ring[ring.len() - 1]), (open.vertices[0].point, open.vertices[2].point));
        assert!(ring.contains(&open.vertices[1].point));
        assert!(flat(&ArcSpline::default(), 1.0).is_empty());
    }

    #[test]
    fn what_cannot_be_done_is_an_error() {
        let circle = ArcSpline::circle(point(0.0, 0.0), 1.0);
        let error = |s: &ArcSpline, tolerance| flatten([s].into_iter(), tolerance).unwrap_err();
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(error(&circle, bad), Error::Parameter { .. }));
        }
        assert!(matches!(error(&circle, 1e-16), Error::Effort { .. }));
        let broken = ArcSpline::closed([(0.0, 0.0, f64::NAN), (1.0, 0.0, 0.0)]);
        assert!(matches!(error(&broken, 1.0), Error::Defects(_)));
    }
}
