//! The second judge: cavalier_contours makes the same offset, and the two are compared.
//!
//! **Needs** closed loops of a pocket. **Guarantees** that its answer is the same at any size and
//! place of the drawing, though the tolerances of cavalier_contours are lengths.
//! **Does not** trust it: where the two differ the exact distance decides, see
//! [`Boundary::compare`]. Of ridges and of what is narrower than its tolerances it knows nothing.
//!
//! **Method.** The loops go to cavalier_contours about the origin and scaled to one size, by a power
//! of two so that no digit is lost. Arcs of more than a half circle, which it does not take, are cut
//! in their middle. With one loop its offset of a polyline is asked, with islands that of a shape.

use super::boundary::Boundary;
use super::compare::Comparison;
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Element, Point, Vertex, point};
use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource, PlineSourceMut, PlineVertex, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Diagonal to which a pocket is scaled, up to a factor of `sqrt(2)`. cavalier_contours compares with
/// `1e-8` wherever it asks for no tolerance, which is relative `1e-11` here; a drawing of size 1 would
/// lose three digits more, and one a thousand times larger would near round-off.
const SIZE: f64 = 1000.0;

/// Places closer than this are one place to cavalier_contours. With its default of `1e-5` short elements
/// of random convex polygons upset it; with a hundredth of that 1,520 offsets of ten kinds of random
/// shapes were right.
const SAME_PLACE: f64 = 1e-7;

/// What an offset may be nearer to the boundary than it should, and how far apart ends of its parts
/// may be that it joins: ten times as much, as in its defaults.
const SLACK: f64 = 10.0 * SAME_PLACE;

/// Deviation that counts as none: every end of an offset may be moved by the sum of the tolerances,
/// and an element as short as that may be gone on either side of it.
const AGREEMENT: f64 = 2.0 * (SAME_PLACE + 2.0 * SLACK);

/// Most pairs of elements of a pocket: 31,600 elements. An offset took 0.7 ns per pair on plates with
/// many islands and 1.4 ns inside noisy outlines, at most 1.5 seconds.
const MAX_PAIRS: u64 = 1_000_000_000;

/// Name of that effort in the error.
const EFFORT: &str = "an offset by cavalier_contours, in pairs of elements,";

/// A pocket that cavalier_contours offsets, too.
#[derive(Debug)]
pub struct SecondJudge {
    boundary: Boundary,
    polylines: Vec<Polyline<f64>>,
    center: Point,
    scale: f64,
}

impl SecondJudge {
    /// Prepares the loops of a pocket, in any order and orientation.
    ///
    /// # Errors
    /// [`Error::Defects`] when a coordinate is not a number, [`Error::Effort`] when there are more
    /// elements than cavalier_contours offsets in a second or two.
    pub fn new<'a>(loops: impl IntoIterator<Item = &'a ArcSpline>) -> Result<SecondJudge, Error> {
        let boundary = Boundary::new(loops.into_iter().filter(|l| l.closed));
        let mut vertices = boundary.loops().iter().flat_map(|l| &l.vertices);
        if let Some(v) = vertices.find(|v| !v.point.is_finite() || !v.bulge.is_finite()) {
            return Err(Error::Defects(vec![Defect::Coordinate { at: v.point }]));
        }
        let bounds = boundary.bounds();
        let mut judge = SecondJudge { boundary, polylines: Vec::new(), center: Point::default(), scale: 1.0 };
        let needed = judge.pairs();
        if needed > MAX_PAIRS {
            return Err(Error::Effort { what: EFFORT, needed, limit: MAX_PAIRS });
        }
        let scale = (SIZE / bounds.diagonal()).log2().round().exp2();
        if scale.is_normal() {
            (judge.center, judge.scale) = (bounds.center(), scale);
            judge.polylines = judge.boundary.oriented().iter().map(|l| judge.polyline(l)).collect();
        }
        Ok(judge)
    }

    /// Pairs of elements, the measure of the effort for one offset.
    pub fn pairs(&self) -> u64 {
        let elements: u64 = self.boundary.loops().iter().map(|l| l.len() as u64).sum();
        elements.saturating_mul(elements)
    }

    /// Compares an offset with that of cavalier_contours.
    ///
    /// # Errors
    /// As [`SecondJudge::offset`].
    pub fn level(&self, distance: f64, ours: &[ArcSpline]) -> Result<Comparison, Error> {
        let theirs = self.offset(distance)?;
        Ok(self.boundary.compare(distance, ours, &theirs, AGREEMENT / self.scale))
    }

    /// The offset by cavalier_contours, in job units.
    ///
    /// # Errors
    /// [`Error::Parameter`] when the distance is no positive number, [`Error::OtherLibrary`] when
    /// cavalier_contours gives up.
    pub fn offset(&self, distance: f64) -> Result<Vec<ArcSpline>, Error> {
        if !(distance > 0.0 && distance.is_finite()) {
            return Err(Error::Parameter { name: "distance", value: distance, range: "above 0" });
        }
        let scaled = distance * self.scale;
        // Nothing is as far from the boundary as it is wide.
        if scaled > 2.0 * SIZE {
            return Ok(Vec::new());
        }
        let polylines = guarded(|| self.scaled_offset(scaled))?;
        Ok(polylines.iter().map(|p| self.spline(p)).collect())
    }

    /// The offset in the coordinates of cavalier_contours.
    fn scaled_offset(&self, distance: f64) -> Vec<Polyline<f64>> {
        if let [only] = &self.polylines[..] {
            let options = PlineOffsetOptions {
                pos_equal_eps: SAME_PLACE,
                offset_dist_eps: SLACK,
                ..PlineOffsetOptions::default()
            };
            return only.parallel_offset_opt(distance, &options);
        }
        let options =
            ShapeOffsetOptions { pos_equal_eps: SAME_PLACE, offset_dist_eps: SLACK, slice_join_eps: SLACK };
        let shape = Shape::from_plines(self.polylines.iter().cloned()).parallel_offset(distance, &options);
        shape.ccw_plines.into_iter().chain(shape.cw_plines).map(|p| p.polyline).collect()
    }

    /// To the coordinates of cavalier_contours.
    fn polyline(&self, spline: &ArcSpline) -> Polyline<f64> {
        let mut polyline = Polyline::new_closed();
        let mut add = |e: Element| {
            let p = (e.start - self.center) * self.scale;
            polyline.add_vertex(PlineVertex::new(p.x, p.y, e.bulge));
        };
        for e in spline.elements() {
            if e.bulge.abs() > 1.0 {
                let (first, second) = e.split(0.5);
                add(first);
                add(second);
            } else {
                add(e);
            }
        }
        polyline
    }

    /// And back.
    fn spline(&self, polyline: &Polyline<f64>) -> ArcSpline {
        let place = |v: &PlineVertex<f64>| self.center + point(v.x, v.y).to_vector() * (1.0 / self.scale);
        let vertices = polyline.vertex_data.iter().map(|v| Vertex { point: place(v), bulge: v.bulge });
        ArcSpline { vertices: vertices.collect(), closed: polyline.is_closed }
    }
}

/// Calls cavalier_contours so that a panic in it is an error here.
///
/// With debug assertions it panics on valid loops now and then: for convex polygons and near necks,
/// and at two levels of the samples here. It keeps no state beyond the call, and what it borrows is
/// only read, so nothing is left half done.
fn guarded<T>(call: impl FnOnce() -> T) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(call)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        let what = text.split_whitespace().collect::<Vec<_>>().join(" ");
        Error::OtherLibrary { library: "cavalier_contours", what }
    })
}

#[cfg(test)]
#[path = "second_tests.rs"]
mod tests;
