//! The arc spline that stands for a free-form curve.

use super::biarc::{Arc, Node};
use super::bound::Distance;
use super::cuts::{CutKind, Stretch, StretchKind, stretches};
use super::error::CurveError;
use super::pieces::Pieces;
use super::run::{Run, fit_run};
use super::spiral::{Cell, Fitter, MAX_BIARCS, Scheme};
use super::track::{Side, Track};
use super::{EllipseArc, Nurbs};
use crate::geom::{ArcSpline, Vector, Vertex};

/// An arc spline with what is known of its distance from the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The arcs and segments. Closed when the curve is.
    pub path: ArcSpline,
    /// For every vertex of the path, whether the drawn curve is smooth there. The tangents of both
    /// elements agree to round-off then.
    pub smooth: Vec<bool>,
    /// No place of the path is farther from the curve than this, and none of the curve farther from
    /// the path. In job units.
    pub bound: f64,
    /// Some place is at least this far; the bound is not much larger.
    pub found: f64,
    /// Where the curve was cut.
    pub cuts: Cuts,
}

/// How many cuts of each kind a curve has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cuts {
    /// Corners.
    pub corners: usize,
    /// Cusps.
    pub cusps: usize,
    /// Jumps of the curvature.
    pub jumps: usize,
    /// Extrema of the curvature.
    pub apices: usize,
    /// Changes of its sign.
    pub inflections: usize,
}

/// Noise of control points that stays between the path and the true curve: of the curve itself, of
/// nodes as stored, and of places computed on the way to a bound.
const FIT_ROUNDINGS: f64 = 4.0;

/// The tolerance must be this many times the round-off for bounds to mean something.
const LEAST_TOLERANCE: f64 = 16.0;

impl Nurbs {
    /// Arcs and segments within `tolerance` of the curve, in job units.
    ///
    /// # Errors
    ///
    /// A tolerance that is none or below round-off, a curve that is not connected, or a limit on
    /// effort.
    pub fn to_arcs(&self, tolerance: f64) -> Result<Fit, CurveError> {
        self.to_arcs_by(Scheme::default(), tolerance)
    }

    /// Arcs and segments by a scheme of choice; else as [`Nurbs::to_arcs`].
    ///
    /// # Errors
    ///
    /// As [`Nurbs::to_arcs`].
    pub fn to_arcs_by(&self, scheme: Scheme, tolerance: f64) -> Result<Fit, CurveError> {
        fit(&self.pieces()?, tolerance, scheme)
    }
}

impl EllipseArc {
    /// Arcs and segments within `tolerance` of the curve, in job units.
    ///
    /// # Errors
    ///
    /// A tolerance that is none or below round-off, or a limit on effort.
    pub fn to_arcs(&self, tolerance: f64) -> Result<Fit, CurveError> {
        self.to_arcs_by(Scheme::default(), tolerance)
    }

    /// Arcs and segments by a scheme of choice; else as [`EllipseArc::to_arcs`].
    ///
    /// # Errors
    ///
    /// As [`EllipseArc::to_arcs`].
    pub fn to_arcs_by(&self, scheme: Scheme, tolerance: f64) -> Result<Fit, CurveError> {
        fit(&self.pieces()?, tolerance, scheme)
    }
}

/// Fits a connected curve.
fn fit(curve: &Pieces, tolerance: f64, scheme: Scheme) -> Result<Fit, CurveError> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(CurveError::Tolerance { tolerance });
    }
    if tolerance < LEAST_TOLERANCE * curve.noise {
        return Err(CurveError::TooFine { tolerance, round_off: LEAST_TOLERANCE * curve.noise });
    }
    let mut path = Path { curve, elements: Vec::new(), distance: Distance::ZERO };
    let mut cuts = Cuts::default();
    if curve.pieces.is_empty() {
        return Ok(path.finished(cuts));
    }
    let track = Track::new(curve);
    let track = if scheme == Scheme::Published { track.sampled() } else { track };
    let mut fitter = Fitter::default();
    let goal = tolerance - FIT_ROUNDINGS * curve.noise;
    let stretches = stretches(curve, tolerance);
    stretches.iter().for_each(|s| cuts.count(s.from.kind));
    let goes_on = |a: &Stretch, b: &Stretch| {
        b.from.kind.is_soft() && a.kind == StretchKind::Spiral && b.kind == StretchKind::Spiral
    };
    let mut cells = Vec::new();
    for run in stretches.chunk_by(goes_on) {
        let (from, to) = (run[0].from.u, run[run.len() - 1].to.u);
        let ends = [track.cut_node(from, Side::After), track.cut_node(to, Side::Before)];
        if path.push_exact(&track, &run[0], ends) {
            continue;
        }
        cells.clear();
        let ring = curve.closed && run.len() == stretches.len() && run[0].from.kind.is_soft();
        let run = Run { stretches: run, ring };
        if fit_run(&mut fitter, &track, (goal, scheme), run, &mut cells).is_none() {
            return Err(CurveError::Effort { at: curve.origin + ends[0].place, limit: MAX_BIARCS });
        }
        tighten(&track, &mut cells);
        path.push_cells(&cells, run.stretches[0].from.kind);
    }
    Ok(path.finished(cuts))
}

/// Bounds this much above the largest distance found in a run are made tight.
const LOOSE: f64 = 1.0625;

/// Makes the bounds of a run tight that are above all distances found in it.
fn tighten(track: &Track, cells: &mut [Cell]) {
    let found = cells.iter().map(|c| c.distance.found).fold(0.0, f64::max);
    for cell in cells.iter_mut().filter(|c| !c.sharp && c.distance.bound > LOOSE * found) {
        let distances = cell.spans().map(|(arc, from, to)| track.measure_arc(&arc, from, to, 0.0));
        let tight = distances.fold(Distance::ZERO, Distance::max);
        // Both bounds hold; without a limit the second may be the larger one.
        cell.distance = Distance { bound: tight.bound.min(cell.distance.bound), ..tight };
    }
}

impl Cuts {
    fn count(&mut self, kind: CutKind) {
        match kind {
            CutKind::End | CutKind::Kink => {}
            CutKind::Corner => self.corners += 1,
            CutKind::Cusp => self.cusps += 1,
            CutKind::Jump => self.jumps += 1,
            CutKind::Apex => self.apices += 1,
            CutKind::Inflection => self.inflections += 1,
        }
    }
}

/// An element of the path in the making.
#[derive(Clone, Copy, Debug)]
struct Piecewise {
    arc: Arc,
    /// Whether the curve is smooth where it begins.
    smooth: bool,
    /// Whether the curve itself is this segment or arc.
    exact: bool,
}

struct Path<'a> {
    curve: &'a Pieces,
    elements: Vec<Piecewise>,
    distance: Distance,
}

impl Path<'_> {
    /// Appends a stretch that is a segment or an arc to round-off; answers whether it is.
    fn push_exact(&mut self, track: &Track, stretch: &Stretch, ends: [Node; 2]) -> bool {
        let [a, b] = ends;
        let bulge = match stretch.kind {
            StretchKind::Spiral => return false,
            StretchKind::Straight => 0.0,
            StretchKind::Round => bulge_between(&a, &b),
        };
        if a.place == b.place {
            return stretch.kind == StretchKind::Straight;
        }
        let arc = Arc { start: a.place, end: b.place, bulge };
        let (from, to) = (stretch.from.u, stretch.to.u);
        let small = FIT_ROUNDINGS * self.curve.noise;
        let off = match stretch.kind {
            StretchKind::Straight => track.overrun(&arc, from, to, small),
            _ => track.measure_arc(&arc, from, to, 0.0).bound,
        };
        if off > small || off.is_nan() {
            return false;
        }
        let next = Piecewise { arc, smooth: stretch.from.kind.is_smooth(), exact: true };
        let last = self.elements.last_mut().filter(|last| next.smooth && last.exact);
        if !last.is_some_and(|last| last.merge(&next.arc, self.curve.noise)) {
            self.elements.push(next);
        }
        true
    }

    fn push_cells(&mut self, cells: &[Cell], begin: CutKind) {
        let mut smooth = begin.is_smooth();
        for cell in cells {
            self.distance = self.distance.max(cell.distance);
            for arc in cell.arcs.into_iter().filter(|arc| arc.start != arc.end) {
                self.elements.push(Piecewise { arc, smooth: smooth && !cell.sharp, exact: false });
                smooth = !cell.sharp;
            }
        }
    }

    fn finished(self, cuts: Cuts) -> Fit {
        let place = |v: Vector| self.curve.origin + v;
        let mut vertices: Vec<Vertex> =
            self.elements.iter().map(|e| Vertex { point: place(e.arc.start), bulge: e.arc.bulge }).collect();
        let mut smooth: Vec<bool> = self.elements.iter().map(|e| e.smooth).collect();
        if let (false, Some(last)) = (self.curve.closed, self.elements.last()) {
            vertices.push(Vertex { point: place(last.arc.end), bulge: 0.0 });
            smooth.push(false);
        }
        let path = ArcSpline { vertices, closed: self.curve.closed };
        let bound = self.distance.bound + FIT_ROUNDINGS * self.curve.noise;
        Fit { path, smooth, bound, found: self.distance.found, cuts }
    }
}

impl Piecewise {
    /// Goes on over the next element if both are on one line or one circle to round-off, up to a half
    /// circle; answers whether it does.
    fn merge(&mut self, next: &Arc, noise: f64) -> bool {
        let (b, c) = (self.arc.bulge, next.bulge);
        let bulge = (b + c) / (1.0 - b * c);
        // Arcs of a half circle together give 1, but for round-off.
        let whole = Arc {
            start: self.arc.start,
            end: next.end,
            bulge: if (bulge.abs() - 1.0).abs() <= 8.0 * f64::EPSILON { bulge.signum() } else { bulge },
        };
        let chord = (whole.end - whole.start).length();
        let turns_back = self.arc.end_tangent().dot(next.start_tangent()) < 0.0;
        if whole.bulge.abs() > 1.0 || whole.bulge.is_nan() || b * c < 0.0 || chord <= noise || turns_back {
            return false;
        }
        // Middles too, as a short arc says little about the circle of a long one.
        let places = [next.start, self.arc.middle(), next.middle()];
        let off = places.iter().map(|&p| whole.distance(p)).fold(0.0, f64::max);
        let fits = off <= FIT_ROUNDINGS * noise;
        if fits {
            self.arc = whole;
        }
        fits
    }
}

/// Bulge of the arc with the given tangents at its ends.
fn bulge_between(a: &Node, b: &Node) -> f64 {
    let half = a.tangent.angle_to(b.tangent);
    (0.25 * half).tan()
}

#[cfg(test)]
#[path = "fit_tests.rs"]
mod tests;
