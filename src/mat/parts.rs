//! From the elements of a loop to the parts that are to be sites.
//!
//! Arcs are divided so that none sweeps more than a quarter turn, and where a hole has its extreme place.

use super::cocircular::Run;
use super::site::Foot;
use super::sites::PLACE_ROUNDINGS;
use super::{SiteKind, SiteRef};
use crate::geom::{Point, Vector};
use std::f64::consts::FRAC_PI_2;

/// Sweeps up to a quarter turn and this fraction of one more stay whole: a drawn quarter may be
/// longer by round-off, and all that is needed is a sweep below a half turn.
pub(super) const QUARTER_SLACK: f64 = 0.01;

/// An element, or a part of one, on its way to be a site.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub start: Foot,
    pub end: Foot,
    pub curvature: f64,
    pub source: SiteRef,
    /// Length of the chord that its normals come from, for their round-off: that of the element it is a
    /// part of, or of a longer one that lent it its direction.
    pub chord: f64,
    /// Length of the chord of its own element.
    pub own_chord: f64,
    /// Angle that it may turn by unseen: near the round-off, an arc is drawn straight, and one arc may stand
    /// for many.
    pub unseen: f64,
    /// Whether it is the last part of its element.
    pub last: bool,
}

/// Directions that round-off turns by this angle are none: places of the boundary would come in another order than
/// their normals.
const NO_DIRECTION: f64 = 1.0 / 64.0;

impl Part {
    /// Whether it is a reflex arc so small that its places do not tell its directions. Then it is a vertex that has
    /// these, and which is off by round-off.
    pub fn is_as_good_as_a_vertex(&self, noise: f64) -> bool {
        -self.curvature * PLACE_ROUNDINGS * noise > NO_DIRECTION
    }
}

/// Adds the element of a run in parts that sweep a quarter at most; parts share places and normals. An element
/// whose bulge is at most `whole` is one part.
pub(super) fn add_parts(run: &Run, whole: f64, parts: &mut Vec<Part>) {
    let Run { drawn, shorter, turned } = run;
    let e = &drawn.element;
    let kind = if e.is_segment() { SiteKind::Segment } else { SiteKind::Arc };
    let source = SiteRef { loop_index: drawn.loop_index, element: drawn.index, kind };
    let (n0, n1) = e.normals();
    let (curvature, own_chord) = (e.curvature(), e.chord().length());
    let start = Foot { point: e.start, normal: n0 };
    let end = Foot { point: e.end, normal: n1 };
    let (chord, unseen) = (*shorter, *turned);
    let mut part = Part { start, end, curvature, source, chord, own_chord, unseen, last: true };
    let count = if e.bulge.abs() <= whole {
        1
    } else {
        (e.sweep().abs() / FRAC_PI_2 - QUARTER_SLACK).ceil().max(1.0) as usize
    };
    for i in 1..count {
        let t = i as f64 / count as f64;
        let point = if 2 * i == count { e.midpoint() } else { e.point_at(t) };
        let foot = Foot { point, normal: e.normal_at(t) };
        parts.push(Part { end: foot, last: false, ..part });
        part.start = foot;
    }
    parts.push(part);
}

/// Splits the arc that holds the extreme place of the hole in its inside, if one does.
pub(super) fn split_at_extreme(parts: &mut Vec<Part>, direction: Vector) {
    let corner = |p: &Part| p.end.point.to_vector().dot(direction);
    let farthest = parts.iter().map(corner).fold(f64::NEG_INFINITY, f64::max);
    let extreme = |p: &Part| -> Option<Point> {
        let inside = p.start.normal.cross(direction) < 0.0 && direction.cross(p.end.normal) < 0.0;
        // Holes run clockwise, so only arcs that turn right reach out between their ends.
        (p.curvature < 0.0 && inside && p.start.normal.dot(direction) > 0.0)
            .then(|| p.start.point + (p.start.normal - direction) / p.curvature)
    };
    let best = (0..parts.len())
        .filter_map(|i| Some((i, extreme(&parts[i])?)))
        .max_by(|a, b| a.1.to_vector().dot(direction).total_cmp(&b.1.to_vector().dot(direction)));
    if let Some((i, point)) = best.filter(|(_, p)| p.to_vector().dot(direction) > farthest) {
        let foot = Foot { point, normal: direction };
        let whole = parts[i];
        parts[i] = Part { end: foot, last: false, ..whole };
        parts.insert(i + 1, Part { start: foot, ..whole });
    }
}
