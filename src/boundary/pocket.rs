//! A region to clear with the islands left standing in it.

use super::Curve;
use super::assemble::assemble;
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Bounds, Point, Vertex};
use crate::tolerance::Tolerance;
use serde::{Deserialize, Serialize};

/// A region to clear: an outer loop, counter-clockwise, and islands, clockwise, so that the
/// interior lies on the left of every element.
///
/// Loops are simple and disjoint, but may touch in points; where they touch, both have a vertex,
/// equal to the last bit. No element has length 0 and no element is a full circle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pocket {
    outer: ArcSpline,
    islands: Vec<ArcSpline>,
}

/// The pockets of a drawing and everything that is wrong with it.
#[derive(Clone, Debug, Default)]
pub struct Pockets {
    /// In the order of their outer loops in the drawing.
    pub pockets: Vec<Pocket>,
    /// All defects, each with its place.
    pub defects: Vec<Defect>,
}

/// Part of the other loops that an outline holds, at least: a stray contour beside the part does
/// not hide that it is one.
const NEARLY_ALL: f64 = 0.9;

impl Pockets {
    /// Chains, checks and nests drawn curves. The outermost contours are pockets, contours in
    /// them islands, contours in islands pockets again.
    ///
    /// # Errors
    /// When `tolerance.join` is no length, or so many elements lie upon each other that crossings
    /// cannot be looked for. Faults of the drawing are no errors but [`Pockets::defects`].
    pub fn from_curves(curves: &[Curve], tolerance: Tolerance) -> Result<Pockets, Error> {
        Pockets::from_curves_at_depth(curves, tolerance, 0)
    }

    /// The same, where pockets begin inside `from_depth` contours: at 1 the outermost contour is
    /// the outline of a part and the contours in it are the pockets.
    ///
    /// # Errors
    /// As [`Pockets::from_curves`].
    pub fn from_curves_at_depth(
        curves: &[Curve],
        tolerance: Tolerance,
        from_depth: usize,
    ) -> Result<Pockets, Error> {
        assemble(curves.iter().map(|c| &c.path), tolerance.join, from_depth)
    }

    /// A vertex of the one outermost contour that holds nearly everything else, if there is such
    /// a contour: it may be the outline of the part and no pocket at all. For pockets from depth 0.
    pub fn lone_outline(&self) -> Option<Point> {
        let size = |p: &Pocket| p.bounds().diagonal();
        let largest = self.pockets.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let all = self.pockets.iter().map(|p| p.loops().len()).sum::<usize>() - 1;
        let around = largest.bounds();
        let within = |p: &&Pocket| around.contains(p.bounds().min) && around.contains(p.bounds().max);
        let held: usize = self.pockets.iter().filter(within).map(|p| p.loops().len()).sum::<usize>() - 1;
        let first = largest.outer.vertices.first()?.point;
        (held > 0 && held as f64 >= NEARLY_ALL * all as f64).then_some(first)
    }
}

/// Whether a defect leaves the loops what they were drawn for.
fn is_harmless(defect: &Defect) -> bool {
    matches!(defect, Defect::Duplicates { .. } | Defect::Overlaps { .. } | Defect::Healed { .. })
}

impl Pocket {
    /// The pocket that closed loops in any order and orientation bound. Equal loops count once.
    ///
    /// # Errors
    /// [`Error::Defects`] with every reason why the loops do not bound exactly one pocket.
    pub fn from_loops(loops: Vec<ArcSpline>, tolerance: Tolerance) -> Result<Pocket, Error> {
        let open = loops.iter().filter(|l| !l.closed).map(|l| {
            let at = |v: Option<&Vertex>| v.map_or(Point::default(), |v| v.point);
            let (start, end) = (at(l.vertices.first()), at(l.vertices.last()));
            Defect::OpenContour { start, end, gap: start.distance(end), inside: false }
        });
        let mut defects: Vec<Defect> = open.collect();
        let closed = loops.iter().filter(|l| l.closed);
        let found = assemble(closed, tolerance.join, 0)?;
        defects.extend(found.defects.into_iter().filter(|d| !is_harmless(d)));
        let count = found.pockets.len();
        let last = found.pockets.into_iter().next_back();
        match last {
            Some(pocket) if count == 1 && defects.is_empty() => Ok(pocket),
            last => {
                if count != 1 && (count > 1 || defects.is_empty()) {
                    let at = last.and_then(|p| p.outer.vertices.first().map(|v| v.point));
                    defects.push(Defect::NotOnePocket { count, at: at.unwrap_or_default() });
                }
                Err(Error::Defects(defects))
            }
        }
    }

    /// From loops that are known to meet the description of the type; used where they were checked.
    pub(crate) fn from_checked(outer: ArcSpline, islands: Vec<ArcSpline>) -> Pocket {
        Pocket { outer, islands }
    }

    /// The outer loop, counter-clockwise.
    pub fn outer(&self) -> &ArcSpline {
        &self.outer
    }

    /// The islands, clockwise.
    pub fn islands(&self) -> &[ArcSpline] {
        &self.islands
    }

    /// All loops: the outer one first.
    pub fn loops(&self) -> impl ExactSizeIterator<Item = &ArcSpline> + Clone {
        let count = 1 + self.islands.len();
        (0..count).map(move |i| if i == 0 { &self.outer } else { &self.islands[i - 1] })
    }

    /// Area to clear.
    pub fn area(&self) -> f64 {
        self.loops().map(ArcSpline::area).sum()
    }

    /// Box around the pocket.
    pub fn bounds(&self) -> Bounds {
        self.outer.bounds()
    }
}
