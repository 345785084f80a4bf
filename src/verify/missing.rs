//! Search for parts of a level that no loop passes.
//!
//! **Method.** The boundary pushed inward by `d` (each element along its normals, each reflex
//! vertex as an arc of radius `d`) holds every place at distance `d`. Along a pushed element the
//! distance to the boundary is at most `d`, and changes no faster than the place moves. So a
//! stretch with `d - distance > length / 2` in its middle holds no place of the level; other
//! stretches are halved, widest first, until one element of a loop covers them, they are shorter
//! than the resolution, or the effort for one element is spent. Every place of the level found must lie on a loop, except where
//! nothing farther lies beside it: such ridges bound no area.

use super::level::Judge;
use super::report::{Fault, FaultKind, LevelReport};
use crate::geom::{ArcSpline, Element, Point};
use rayon::prelude::*;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// Most places looked at along one pushed element.
const EFFORT: usize = 128;

/// A stretch whose middle lies on a loop, as did that of those it is part of, is halved this often.
const COVERED_HALVINGS: u32 = 4;

/// A stretch shorter than this share of its element is not halved.
const SHARE: f64 = 1.0 / 16384.0;

/// A stretch shorter than this many times `within` is not halved.
const RESOLUTION: f64 = 16.0;

/// Turns closer than this to a half turn may have either sign by round-off: half the digits.
const CUSP: f64 = 1.0 / (1u64 << 26) as f64;

/// Adds what is missing to the report: at most one place per element of the boundary.
pub(super) fn search(judge: &Judge, report: &mut LevelReport) {
    let pushed: Vec<Element> =
        judge.boundary.oriented().iter().flat_map(|spline| pushed(spline, judge.distance)).collect();
    let findings: Vec<(usize, Option<Point>)> = pushed.par_iter().map(|e| along(judge, e)).collect();
    for (places, missing) in findings {
        report.places += places;
        if let Some(at) = missing {
            let by = judge.offsets.distance(at);
            report.add(Fault { kind: FaultKind::Missing, at, by });
        }
    }
}

/// The places at distance `d` to the left of each element, and round each reflex vertex.
fn pushed(spline: &ArcSpline, d: f64) -> Vec<Element> {
    let elements: Vec<Element> = spline.elements().filter(|e| e.chord().length_squared() > 0.0).collect();
    let mut all = Vec::with_capacity(elements.len());
    for (i, e) in elements.iter().enumerate() {
        let (n0, n1) = e.normals();
        // Beyond the center of a left turn the other side of the arc is nearer.
        if d * e.curvature() < 1.0 {
            all.push(Element { start: e.start + n0 * d, end: e.end + n1 * d, bulge: e.bulge });
        }
        let next = elements[(i + 1) % elements.len()].normals().0;
        let turn = n1.angle_to(next);
        // At a cusp the arc is looked at whichever side the material is on; it can do no harm,
        // as no place of it is farther than `d`.
        let turn = if turn.abs() > PI - CUSP { -turn.abs() } else { turn };
        if turn < 0.0 {
            let bulge = (0.25 * turn).tan();
            all.push(Element { start: e.end + n1 * d, end: e.end + next * d, bulge });
        }
    }
    // An arc without length, at a joint that round-off bent, has no normal to look along.
    all.retain(|e| e.chord().length_squared() > 0.0);
    all
}

/// Looks along one pushed element: number of places, and one that is missing.
fn along(judge: &Judge, e: &Element) -> (usize, Option<Point>) {
    let length = e.length();
    let shortest = (SHARE * length).max(RESOLUTION * judge.within);
    let mut places = 0;
    let mut stretches = VecDeque::from([(0.0, 1.0, 0)]);
    while let Some((from, to, halvings)) = stretches.pop_front() {
        if places >= EFFORT || !length.is_finite() {
            break;
        }
        let middle = 0.5 * (from + to);
        let at = e.point_at(middle);
        let short_by = judge.distance - judge.boundary.distance(at);
        places += 1;
        let width = length * (to - from);
        if short_by - judge.within > 0.5 * width {
            continue;
        }
        let on_level = short_by <= judge.within;
        if on_level {
            if is_missing(judge, e, middle) {
                return (places, Some(at));
            }
            if halvings >= COVERED_HALVINGS || is_covered(judge, e, [from, middle, to]) {
                continue;
            }
        }
        if width > shortest {
            let halvings = if on_level { halvings + 1 } else { 0 };
            stretches.push_back((from, middle, halvings));
            stretches.push_back((middle, to, halvings));
        }
    }
    (places, None)
}

/// Whether one element of a loop passes all three places, and so, being a circle or a line just
/// as the pushed element, everything between them.
fn is_covered(judge: &Judge, e: &Element, [from, middle, to]: [f64; 3]) -> bool {
    let Some(hit) = judge.offsets.nearest(e.point_at(middle)) else { return false };
    [from, middle, to].iter().all(|t| hit.element.distance(e.point_at(*t)) <= 2.0 * judge.within)
}

/// Whether no loop passes a place of the level, though there is something farther beside it.
fn is_missing(judge: &Judge, e: &Element, t: f64) -> bool {
    let at = e.point_at(t);
    // Twice: the place and the loop may be off by as much each.
    if judge.offsets.distance(at) <= 2.0 * judge.within {
        return false;
    }
    let beyond = at + e.normal_at(t) * judge.aside.max(RESOLUTION * judge.within);
    judge.boundary.contains(at) && judge.boundary.distance(beyond) > judge.distance + 2.0 * judge.within
}
