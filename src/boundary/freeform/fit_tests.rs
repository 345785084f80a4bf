//! Whole curves.

use super::*;
use crate::geom::{point, vector};

fn ellipse() -> EllipseArc {
    EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.0, 0.0).unwrap()
}

#[test]
fn an_ellipse_is_within_its_bound() {
    for scheme in [Scheme::Tilted, Scheme::Osculating, Scheme::Bisection, Scheme::Fewest] {
        for tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
            let e = ellipse();
            let fit = e.to_arcs_by(scheme, tolerance).unwrap();
            assert!(fit.bound <= tolerance && fit.path.closed);
            let far = (0..2000).map(|i| fit.path.distance(e.at(f64::from(i) * 0.003_141_6)));
            let far = far.fold(0.0, f64::max);
            assert!(far <= fit.bound);
        }
    }
}
