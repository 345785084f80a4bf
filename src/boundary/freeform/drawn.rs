//! From the curves of a drawing to their fits.

use super::{CurveError, EllipseArc, Fit, Nurbs};
use crate::boundary::{FreeCurve, FreeShape};
use crate::geom::{Ellipse, Spline};

impl FreeCurve {
    /// Arcs and segments within `tolerance` of the curve, in job units.
    ///
    /// # Errors
    ///
    /// A [`CurveError`] when the numbers make no curve, or none that can be fitted.
    pub fn to_arcs(&self, tolerance: f64) -> Result<Fit, CurveError> {
        match &self.shape {
            FreeShape::Ellipse(ellipse) => EllipseArc::try_from(ellipse)?.to_arcs(tolerance),
            FreeShape::Spline(spline) => Nurbs::try_from(spline)?.to_arcs(tolerance),
        }
    }
}

impl TryFrom<&Ellipse> for EllipseArc {
    type Error = CurveError;

    fn try_from(e: &Ellipse) -> Result<EllipseArc, CurveError> {
        EllipseArc::new(e.center, e.major, e.ratio, e.start, e.start + e.sweep)
    }
}

impl TryFrom<&Spline> for Nurbs {
    type Error = CurveError;

    /// By its control points where it has some: fit points are what it was made of.
    fn try_from(s: &Spline) -> Result<Nurbs, CurveError> {
        if s.control.is_empty() {
            return Nurbs::through(&s.fit, s.tangents, s.closed);
        }
        Nurbs::new(s.degree, s.knots.clone(), s.control.clone(), s.weights.clone(), s.closed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Source;
    use crate::geom::{point, vector};
    use std::f64::consts::TAU;

    fn arcs(shape: FreeShape) -> Fit {
        FreeCurve { shape, source: Source::default() }.to_arcs(0.001).unwrap()
    }

    #[test]
    fn a_whole_ellipse_becomes_a_closed_path_of_its_area() {
        let major = vector(20.0, 0.0);
        let whole = Ellipse { center: point(3.0, 4.0), major, ratio: 0.5, start: 0.0, sweep: TAU };
        let fit = arcs(FreeShape::Ellipse(whole));
        assert!(fit.path.closed && fit.bound <= 0.001);
        let off = (fit.path.area() - 0.5 * TAU * 20.0 * 10.0).abs();
        assert!(off < 0.001 * fit.path.length(), "{off}");
    }

    #[test]
    fn a_spline_without_control_points_runs_through_its_fit_points() {
        let places = vec![point(0.0, 0.0), point(10.0, 5.0), point(20.0, 0.0)];
        let spline = Spline { degree: 3, fit: places.clone(), ..Spline::default() };
        let path = arcs(FreeShape::Spline(spline)).path;
        for place in places {
            let nearest = path.elements().map(|e| e.distance(place)).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 0.001, "{nearest}");
        }
    }
}
