//! Offset loops held against their boundary by exact distance.
//!
//! **Needs** the loops of a region in any orientation, and offsets with the inner side on the left.
//! **Guarantees** that the loops of a report without faults keep the distance at every place looked
//! at, bound what lies farther, each once, and that no loop is missing that is wider than the
//! resolution of the search ([`missing`](super::missing)).
//! **Does not** look at every place: along an element it looks at ends, quarters, and wherever the
//! distance to an element of the boundary that is nearest there has an extremum.
//!
//! **Method.** The distance to an element is that to a segment, a circle or an end; along a segment
//! or an arc it is extremal where a line through the center (or the end) meets the curve at a right
//! angle. On the left of the loop the distance must grow, on its right it must fall. One winding
//! number beside each loop tells whether it is there once.

use super::boundary::{Boundary, widest};
use super::report::{Fault, FaultKind, LevelReport};
use super::{missing, phantom};
use crate::geom::{ArcSpline, Element, Point};
use rayon::prelude::*;

/// Round-off of a distance between stored curves, relative to the largest coordinate: an offset
/// takes a few thousand roundings at worst from the boundary to its loops, each at most `eps / 2`.
pub(super) const ROUND_OFF: f64 = 4096.0 * f64::EPSILON;

/// How far the judge steps aside of a loop, relative to the largest coordinate: well beyond
/// round-off, and no farther, as in a small drawing far from the origin that is far enough.
pub(super) const ASIDE: f64 = 8.0 * ROUND_OFF;

/// Parameters at which every element is looked at; the ends belong to its neighbors as well.
const PLACES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Judges offset loops, whoever made them, against the boundary (outer loop and islands) that they
/// should keep `distance` from. Differences up to round-off count as none.
///
/// Open splines are taken for ridges: places at the distance with nothing farther beside them.
pub fn level<'a>(
    boundary: impl IntoIterator<Item = &'a ArcSpline>,
    distance: f64,
    offsets: &[ArcSpline],
) -> LevelReport {
    Boundary::new(boundary).judge(distance, offsets, 0.0)
}

/// Judges offset loops on the other side of the boundary: outside of a part, and in its holes. The part
/// that is farther away is on the left of them here, too: the loop around a part runs clockwise.
pub fn outward<'a>(
    boundary: impl IntoIterator<Item = &'a ArcSpline>,
    distance: f64,
    offsets: &[ArcSpline],
) -> LevelReport {
    Boundary::new(boundary).judge_outward(distance, offsets, 0.0)
}

impl Boundary {
    /// Judges offset loops as [`level`] does, with differences up to `within` counted as none.
    ///
    /// The boundary may be that of many pockets. Offsets of unknown origin are made fit for it by
    /// [`chained`](super::chained) and [`Boundary::turned`].
    ///
    /// ```
    /// use medial::{ArcSpline, FaultKind, point, verify::Boundary};
    ///
    /// let plate = ArcSpline::closed([(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)]);
    /// let bore = ArcSpline::circle(point(20.0, 20.0), 8.0).reversed();
    /// let boundary = Boundary::new([&plate, &bore]);
    ///
    /// // Some program offsets the wall to 3, a little off, and forgets the bore.
    /// let wall = ArcSpline::closed([(3.0, 3.0, 0.0), (57.0, 3.0, 0.0), (57.0, 36.998, 0.0), (3.0, 36.998, 0.0)]);
    /// let report = boundary.judge(3.0, &[wall], 0.01);
    /// assert!((report.max_deviation - 0.002).abs() < 1e-12);
    /// let [fault] = report.faults[..] else { panic!() };
    /// assert_eq!(fault.kind, FaultKind::Missing);
    /// assert!((fault.length - 22.0 * std::f64::consts::PI).abs() < 1e-3);
    /// ```
    pub fn judge(&self, distance: f64, offsets: &[ArcSpline], within: f64) -> LevelReport {
        self.judge_on(false, distance, offsets, within)
    }

    /// Judges offset loops as [`outward`] does, with differences up to `within` counted as none.
    pub fn judge_outward(&self, distance: f64, offsets: &[ArcSpline], within: f64) -> LevelReport {
        self.judge_on(true, distance, offsets, within)
    }

    fn judge_on(&self, outward: bool, distance: f64, offsets: &[ArcSpline], within: f64) -> LevelReport {
        let magnitude = self.bounds().magnitude() + distance.abs();
        let judge = Judge {
            boundary: self,
            offsets: Boundary::new(offsets),
            distance,
            outward,
            within: within.max(ROUND_OFF * magnitude),
            aside: ASIDE * magnitude,
        };
        let mut report = LevelReport {
            distance,
            outward,
            loops: offsets.len(),
            within: judge.within,
            area: offsets.iter().filter(|o| o.closed).map(ArcSpline::area).sum(),
            ..LevelReport::default()
        };
        for spline in judge.offsets.loops() {
            judge.spline(spline, &mut report);
        }
        missing::search(&judge, &mut report);
        report
    }
}

/// One boundary, one distance, one set of loops.
pub(super) struct Judge<'a> {
    pub boundary: &'a Boundary,
    pub offsets: Boundary,
    pub distance: f64,
    pub outward: bool,
    pub within: f64,
    pub aside: f64,
}

/// What was found along one element of a loop.
#[derive(Default)]
pub(super) struct Finding {
    places: usize,
    /// Largest difference from the distance, and where.
    pub deviation: f64,
    pub at: Point,
    grows: f64,
    falls: f64,
    beside: Point,
}

impl Judge<'_> {
    /// Judges one loop or ridge.
    fn spline(&self, spline: &ArcSpline, report: &mut LevelReport) {
        if let Some(v) = spline.vertices.iter().find(|v| !v.point.is_finite() || !v.bulge.is_finite()) {
            report.add(Fault::at(FaultKind::NotANumber, v.point));
            return;
        }
        let elements: Vec<Element> = spline.elements().collect();
        let findings: Vec<Finding> = elements.par_iter().map(|e| self.element(e)).collect();
        let mut ends = Finding::default();
        if let (false, Some(last)) = (spline.closed, spline.vertices.last()) {
            self.look(last.point, &mut ends);
        }
        for finding in findings.iter().chain([&ends]).filter(|f| f.places > 0) {
            report.places += finding.places;
            report.measure(finding.at, finding.deviation);
        }
        let parts = phantom::parts(self, spline, &findings);
        if parts.is_empty() && ends.deviation <= self.within {
            self.sides(spline, &findings, report);
        } else if parts.is_empty() {
            report.add(Fault { by: ends.deviation, ..Fault::at(FaultKind::Distance, ends.at) });
        }
        for part in parts {
            report.measure(part.at, part.by);
            report.add(part);
        }
    }

    /// How far a place is from being at the distance.
    pub fn deviation(&self, at: Point) -> f64 {
        (self.boundary.distance(at) - self.distance).abs()
    }

    /// Whether a place is on the side of the boundary where the offsets should be.
    pub fn is_on_side(&self, at: Point) -> bool {
        self.boundary.contains(at) != self.outward
    }

    /// Judges the two sides of a loop that keeps the distance.
    fn sides(&self, spline: &ArcSpline, findings: &[Finding], report: &mut LevelReport) {
        let add = |kind, at, report: &mut LevelReport| report.add(Fault::at(kind, at));
        if !spline.closed {
            let inner = findings.iter().find(|f| f.grows.max(f.falls) > 0.5);
            if let Some(f) = inner {
                add(FaultKind::Open, f.beside, report);
            }
            return;
        }
        let Some(widest) = widest(spline).filter(|e| e.chord().length_squared() > 0.0) else { return };
        let at = widest.midpoint();
        if !self.is_on_side(at) {
            add(FaultKind::Outside, at, report);
        }
        // A closed ridge has nothing farther on either side.
        if findings.iter().all(|f| f.grows <= 0.0 && f.falls <= 0.0) {
            return;
        }
        let is_reversed = |(e, f): &(Element, &Finding)| {
            // Where circles hardly cross, round-off of the crossing folds the loop: what it passes three
            // times it passes once, in the other direction.
            f.grows < 0.0 && f.falls > 0.0 && self.passes(e) != -1
        };
        if let Some((_, f)) = spline.elements().zip(findings).find(is_reversed) {
            add(FaultKind::Reversed, f.beside, report);
            return;
        }
        // Beside a pinch narrower than a step aside nothing can be told; look elsewhere then.
        let clear = |f: &Finding| f.grows > 0.5 && f.falls < -0.5;
        let places = spline.elements().zip(findings).filter(|(_, f)| clear(f));
        let place =
            places.max_by(|a, b| a.0.chord().length_squared().total_cmp(&b.0.chord().length_squared()));
        if let Some((e, _)) = place
            && self.passes(&e) != 1
        {
            add(FaultKind::Overlapping, e.midpoint(), report);
        }
    }

    /// How often loops pass the middle of an element, those that run against it counted negative. How many
    /// others are around does not matter, as one may be missing.
    fn passes(&self, e: &Element) -> i32 {
        let (at, n) = (e.midpoint(), e.normal_at(0.5) * self.aside);
        self.offsets.winding(at + n) - self.offsets.winding(at - n)
    }

    /// Looks at the places of one element.
    fn element(&self, e: &Element) -> Finding {
        let mut finding = Finding::default();
        for t in PLACES {
            let nearest = self.look(e.point_at(t), &mut finding);
            for t in nearest.map_or([None; 6], |b| extrema(e, &b)).into_iter().flatten() {
                self.look(e.point_at(t), &mut finding);
            }
        }
        if e.chord().length() > 4.0 * self.aside {
            let (at, n) = (e.midpoint(), e.normal_at(0.5) * self.aside);
            let here = self.boundary.distance(at);
            finding.beside = at;
            finding.grows = (self.boundary.distance(at + n) - here) / self.aside;
            finding.falls = (self.boundary.distance(at - n) - here) / self.aside;
            finding.places += 2;
        }
        finding
    }

    /// Measures one place; answers the element of the boundary that is nearest there.
    fn look(&self, at: Point, finding: &mut Finding) -> Option<Element> {
        let hit = self.boundary.nearest(at);
        let deviation = hit.map_or(f64::INFINITY, |h| (h.nearest.distance - self.distance).abs());
        if finding.places == 0 || deviation > finding.deviation {
            (finding.deviation, finding.at) = (deviation, at);
        }
        finding.places += 1;
        hit.map(|h| h.element)
    }
}

/// Parameters inside the element `e` where its distance to `b` may be extremal.
fn extrema(e: &Element, b: &Element) -> [Option<f64>; 6] {
    let centers = [b.center().map(|c| c.0), Some(b.start), Some(b.end)];
    let mut found = [None; 6];
    for (i, center) in centers.into_iter().enumerate() {
        let Some(center) = center.filter(|c| c.is_finite()) else { continue };
        found[2 * i] = Some(e.parameter(center));
        // The far side of an arc faces the center as well.
        found[2 * i + 1] = e.center().map(|(own, _)| e.parameter(own + (own - center)));
    }
    if let (None, Some((own, radius))) = (b.center(), e.center()) {
        let across = b.normals().0 * radius;
        (found[0], found[1]) = (Some(e.parameter(own + across)), Some(e.parameter(own - across)));
    }
    found.map(|t| t.filter(|t| *t > 0.0 && *t < 1.0))
}

#[cfg(test)]
#[path = "level_tests.rs"]
mod tests;
