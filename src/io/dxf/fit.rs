//! Ellipses, splines and runs of chords of a drawing become arcs and segments.

use super::{Drawing, FitTolerance};
use crate::boundary::freeform::{CurveError, Fit};
use crate::boundary::{Curve, FreeCurve, FreeShape};
use crate::geom::{ArcSpline, Point};
use crate::io::Warning;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;

impl Drawing {
    /// Adds the arcs of free-form curves; what cannot be fitted stays as drawn, with a warning.
    pub(super) fn fit(&mut self, free: Vec<FreeCurve>, tolerance: FitTolerance) {
        if free.is_empty() {
            return;
        }
        let begin = Instant::now();
        let tolerance = tolerance.of(self.units);
        let fits: Vec<Result<Fit, CurveError>> = free.par_iter().map(|c| c.to_arcs(tolerance)).collect();
        let mut faults: BTreeMap<(String, String), (usize, FreeCurve)> = BTreeMap::new();
        for (curve, fit) in free.into_iter().zip(fits) {
            let fit = fit.map_err(|e| e.to_string()).and_then(|fit| {
                if fit.path.vertices.len() > 1 { Ok(fit) } else { Err("it has no length".to_owned()) }
            });
            match fit {
                Ok(fit) => self.take(fit, curve),
                Err(reason) => {
                    let key = (curve.source.kind.to_string(), reason);
                    faults.entry(key).or_insert_with(|| (0, curve.clone())).0 += 1;
                    self.free.push(curve);
                }
            }
        }
        self.warnings.extend(faults.into_iter().map(|((entity, reason), (count, first))| {
            let (handle, at) = (first.source.handle, place(&first));
            Warning::NotFitted { entity, handle, reason, count, at }
        }));
        self.fitted.time += begin.elapsed();
    }

    /// Puts arcs in the place of runs of chords.
    pub(super) fn fit_chords(&mut self, tolerance: FitTolerance) {
        let begin = Instant::now();
        let tolerance = tolerance.of(self.units);
        let fits: Vec<Option<ArcSpline>> =
            self.curves.par_iter().map(|c| c.path.with_arcs_for_chords(tolerance)).collect();
        for (curve, fit) in self.curves.iter_mut().zip(fits) {
            if let Some(path) = fit {
                self.fitted.chords += curve.path.len();
                self.fitted.arcs_of_chords += path.len();
                curve.path = path;
            }
        }
        self.fitted.time += begin.elapsed();
    }

    fn take(&mut self, fit: Fit, curve: FreeCurve) {
        self.fitted.curves += 1;
        self.fitted.elements += fit.path.elements().count();
        self.fitted.bound = self.fitted.bound.max(fit.bound);
        self.curves.push(Curve { path: fit.path, source: curve.source });
    }
}

/// A place of a curve.
fn place(curve: &FreeCurve) -> Option<Point> {
    match &curve.shape {
        FreeShape::Ellipse(ellipse) => Some(ellipse.point_at(ellipse.start)),
        FreeShape::Spline(spline) => spline.fit.first().or(spline.control.first()).copied(),
    }
}
