//! Search for parts of a level that no loop passes.
//!
//! **Method.** The boundary pushed inward by `d` (each element along its normals, each reflex
//! vertex as an arc of radius `d`) holds every place at distance `d`. Along a pushed element the
//! distance to the boundary is at most `d`, and changes no faster than the place moves. So a
//! stretch with `d - distance > length / 2` in its middle holds no place of the level; other
//! stretches are halved, widest first, until one element of a loop covers them, they are shorter
//! than the resolution, or the effort for one element is spent. Every place of the level found must lie
//! on a loop, except where nothing farther lies beside it: such ridges bound no area. Where none does,
//! the stretch is followed to both sides; stretches that follow each other are one part.

use super::gaps::{Gap, parts};
use super::level::Judge;
use super::phantom::change;
use super::report::LevelReport;
use crate::geom::{ArcSpline, Element};
use rayon::prelude::*;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// Most places looked at along one pushed element.
const EFFORT: usize = 128;

/// A stretch whose middle lies on a loop, as did that of those it is part of, is halved this often.
const COVERED_HALVINGS: u32 = 4;

/// A stretch whose middle no loop passes, nor that of those it is part of, is halved this often.
const MISSING_HALVINGS: u32 = 2;

/// A stretch shorter than this share of its element is not halved.
const SHARE: f64 = 1.0 / 16384.0;

/// A stretch shorter than this many times `within` is not halved.
const RESOLUTION: f64 = 16.0;

/// Turns closer than this to a half turn may have either sign by round-off: half the digits.
const CUSP: f64 = 1.0 / (1u64 << 26) as f64;

/// Adds what is missing to the report.
pub(super) fn search(judge: &Judge, report: &mut LevelReport) {
    let side = |l: ArcSpline| if judge.outward { l.reversed() } else { l };
    let oriented = judge.boundary.oriented().into_iter().map(side);
    let pushed: Vec<Element> = oriented.flat_map(|spline| pushed(&spline, judge.distance)).collect();
    let findings: Vec<(usize, Vec<Gap>)> = pushed.par_iter().map(|e| along(judge, e)).collect();
    report.places += findings.iter().map(|f| f.0).sum::<usize>();
    let gaps: Vec<Gap> = findings.into_iter().flat_map(|f| f.1).collect();
    parts(judge, &gaps).into_iter().for_each(|fault| report.add(fault));
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

/// Looks along one pushed element: number of places, and the stretches that are missing.
fn along(judge: &Judge, e: &Element) -> (usize, Vec<Gap>) {
    let length = e.length();
    let shortest = (SHARE * length).max(RESOLUTION * judge.within);
    let mut places = 0;
    let mut missing: Vec<(f64, f64)> = Vec::new();
    let mut stretches = VecDeque::from([(0.0, 1.0, 0)]);
    while let Some((from, to, halvings)) = stretches.pop_front() {
        if places >= EFFORT || !length.is_finite() {
            break;
        }
        let middle = 0.5 * (from + to);
        let short_by = judge.distance - judge.boundary.distance(e.point_at(middle));
        places += 1;
        let width = length * (to - from);
        if short_by - judge.within > 0.5 * width {
            continue;
        }
        let on_level = short_by <= judge.within;
        let is_missing = on_level && is_missing(judge, e, middle);
        if is_missing && (halvings >= MISSING_HALVINGS || width <= shortest || places >= EFFORT / 2) {
            missing.push((from, to));
            continue;
        }
        if on_level
            && !is_missing
            && (halvings >= COVERED_HALVINGS || is_covered(judge, e, [from, middle, to]))
        {
            continue;
        }
        if width > shortest {
            let halvings = if on_level { halvings + 1 } else { 0 };
            stretches.push_back((from, middle, halvings));
            stretches.push_back((middle, to, halvings));
        }
    }
    missing.sort_by(|a, b| a.0.total_cmp(&b.0));
    let gaps = missing.chunk_by(|a, b| a.1 == b.0).map(|run| gap(judge, e, run)).collect();
    (places, gaps)
}

/// The gap that some stretches in a row make, followed as far as it goes.
fn gap(judge: &Judge, e: &Element, run: &[(f64, f64)]) -> Gap {
    let is_gap = |t: f64| {
        judge.distance - judge.boundary.distance(e.point_at(t)) <= judge.within && is_missing(judge, e, t)
    };
    let middle = |stretch: (f64, f64)| 0.5 * (stretch.0 + stretch.1);
    let end = |from: f64, step: f64, last: f64| {
        let mut inside = from;
        for _ in 0..EFFORT {
            let next = (inside + step).clamp(0.0, 1.0);
            if !is_gap(next) {
                return change(inside, next, is_gap);
            }
            if next == last {
                return last;
            }
            inside = next;
        }
        inside
    };
    let (first, last) = (run[0], run[run.len() - 1]);
    let from = end(middle(first), first.0 - first.1, 0.0);
    let to = end(middle(last), last.1 - last.0, 1.0);
    let places = run.iter().map(|&stretch| e.point_at(middle(stretch)));
    let far = |p: &crate::geom::Point| judge.offsets.distance(*p);
    let at = places.max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(e.midpoint());
    Gap { element: e.part(from, to), at, by: judge.offsets.distance(at) }
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
    judge.is_on_side(at) && judge.boundary.distance(beyond) > judge.distance + 2.0 * judge.within
}
