//! The disk that touches the boundary in one place and a site in another.
//!
//! All sites share one formula in *curvature form* (no centers, no case for straight lines). The
//! disk tangent at `P` with inward normal `N` has its center at `P + r N`; it touches the carrier of
//! a site that passes through `A` with inward normal `n` and curvature `k` when, with `w = P - A`,
//!
//! ```text
//! r = (2 w.n - k |w|^2) / (|N - n|^2 + 2 k N.w)
//! ```
//!
//! (`|N - n|^2` stands for `2 (1 - N.n)`, which cancels). `A` is the end of the site nearer to `P`,
//! and `P` is given from a vertex of the boundary, so that `w` is small and exact where it matters:
//! in narrow corners. Where the contact lies off the site, an end of the site takes its place; the
//! disk found is then never larger than the one that touches the closed site.

use super::site::{Foot, Site};
use super::sites::PLACE_ROUNDINGS;
use crate::boundary::TOUCHING_ULPS;
use crate::geom::{Point, Vector};

/// A place of the boundary and the normal along which a disk grows there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe {
    /// The nearer end of the piece that is probed.
    pub base: Point,
    /// From there to the place.
    pub offset: Vector,
    /// Unit normal.
    pub normal: Vector,
    /// Vertex of the boundary at the place, or at an end of the probed piece where it goes on
    /// smoothly: sites that meet it there are touched at their other ends only.
    pub vertices: [u32; 2],
}

impl Probe {
    #[inline]
    pub fn point(&self) -> Point {
        self.base + self.offset
    }

    #[inline]
    pub fn center(&self, radius: f64) -> Point {
        self.point() + self.normal * radius
    }
}

/// Where on a site a disk touches it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    /// Between its ends, tangentially.
    Inside,
    Start,
    End,
    /// Along the whole arc, to which the disk is tangent where it is probed.
    Whole,
}

/// A site, or a part of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span<'a> {
    pub site: &'a Site,
    pub from: &'a Foot,
    pub to: &'a Foot,
    /// Vertices of the boundary at its ends, if it reaches them.
    pub vertices: [u32; 2],
}

impl<'a> Span<'a> {
    #[inline]
    pub fn whole(site: &'a Site) -> Span<'a> {
        Span { site, from: &site.start, to: &site.end, vertices: site.vertices }
    }
}

/// Radius of the disk that touches the span, and where; infinite when none does.
#[inline]
pub(crate) fn touch(span: Span<'_>, probe: &Probe) -> (f64, Contact) {
    /// No disk is held back by this span.
    const NEVER: (f64, Contact) = (f64::INFINITY, Contact::Inside);
    let [v0, v1] = span.vertices;
    let meets = |v: u32| v != super::site::NONE && (v == probe.vertices[0] || v == probe.vertices[1]);
    let (at_start, at_end) = (meets(v0), meets(v1));
    if span.site.is_vertex {
        return if at_start {
            NEVER
        } else {
            (to_point(span.site.start.point, probe, span.site.error), Contact::Inside)
        };
    }
    if !at_start
        && !at_end
        && let Some(radius) = tangent(&span, probe)
    {
        return (radius, Contact::Inside);
    }
    let start = if at_start { f64::INFINITY } else { to_point(span.from.point, probe, span.site.error) };
    let end = if at_end { f64::INFINITY } else { to_point(span.to.point, probe, span.site.error) };
    if start <= end { (start, Contact::Start) } else { (end, Contact::End) }
}

/// Radius of the disk through a point: `|w|^2 / (-2 N.w)`. A point that lies beyond the tangent of the
/// disk by round-off holds back none: no disk there can reach over it by more than that.
#[inline]
fn to_point(q: Point, probe: &Probe, error: f64) -> f64 {
    let w = (probe.base - q) + probe.offset;
    let depth = -probe.normal.dot(w);
    if depth > error { 0.5 * w.length_squared() / depth } else { f64::INFINITY }
}

/// Radius of the disk tangent to the span between its ends.
#[inline]
fn tangent(span: &Span<'_>, probe: &Probe) -> Option<f64> {
    let k = span.site.curvature;
    let w0 = (probe.base - span.from.point) + probe.offset;
    let w1 = (probe.base - span.to.point) + probe.offset;
    let near_start = w0.length_squared() <= w1.length_squared();
    let (w, end) = if near_start { (w0, span.from) } else { (w1, span.to) };
    let n = end.normal;
    let overlap = OVERLAP * span.site.error;
    // Where loops touch, walls of different sectors turn their backs on each other.
    let may_overlap = probe.base != end.point;
    let (r, f) = tangent_to_carrier(w, n, k, probe.normal).or_else(|| {
        (may_overlap && overlaps(w, n, k, probe.normal, overlap)).then_some((span.site.error, 1.0))
    })?;
    if f <= DIRECTION_ERROR {
        return Some(r);
    }
    // The contact, seen from the nearer end: c - A = w + r N, its normal is (n - k (c - A)) / f.
    let to_center = w + probe.normal * r;
    let q = to_center - (n - to_center * k) * (r / f);
    let chord = span.to.point - span.from.point;
    let (q0, q1) = if near_start { (q, q - chord) } else { (q + chord, q) };
    let inside = q0.dot(span.from.normal.right()) >= 0.0 && q1.dot(span.to.normal.right()) <= 0.0;
    inside.then_some(r)
}

/// Loops that touch may overlap by this many times the round-off of a place; see [`Pocket`](crate::Pocket).
const OVERLAP: f64 = TOUCHING_ULPS / PLACE_ROUNDINGS;

/// Whether a place lies on the far side of a carrier that faces it, by no more than loops may overlap: the
/// disk there is as good as none.
#[inline]
fn overlaps(w: Vector, n: Vector, k: f64, normal: Vector, overlap: f64) -> bool {
    let twice = 2.0 * w.dot(n) - k * w.length_squared();
    twice <= 0.0 && twice >= -2.0 * overlap && normal.dot(n - w * k) < 0.0
}

/// Share of the radius of an arc, the rest of which a disk takes up, below which `1 - k r` is computed
/// apart: two bits are lost where it is a quarter.
const NEARLY_FULL: f64 = 0.25;

/// Round-off of sums and products of a few unit vectors: eight roundings. Shorter differences of normals
/// have no direction, and the disk touches all of the arc.
const DIRECTION_ERROR: f64 = 8.0 * f64::EPSILON;

/// Radius `r` of the disk tangent to a carrier, as the head of this file has it, and `f = 1 - k r`.
///
/// A disk nearly as large as a hollow arc hangs on `f`, the distance of their centers over the radius of the
/// arc: it touches to round-off divided by `f`, if `f` is what cancellation leaves. With `g = N - n + k w`
/// (`1 / k` times that is the way between the centers of the arc and of a disk as large) it is `|g|^2` over
/// the same denominator, which is `2 g.N`. Where that is round-off of its terms, the disk may be as large as
/// the arc.
#[inline]
fn tangent_to_carrier(w: Vector, n: Vector, k: f64, normal: Vector) -> Option<(f64, f64)> {
    let between = normal - n;
    let denominator = between.length_squared() + 2.0 * k * normal.dot(w);
    if denominator <= 0.0 {
        return None;
    }
    if k > 0.0 {
        let apart = (between + w * k).length_squared();
        if apart < NEARLY_FULL * (denominator + DIRECTION_ERROR) {
            let terms = (between.length_squared() + k * k * w.length_squared()).sqrt();
            let f = apart / (denominator + DIRECTION_ERROR * terms);
            if f < NEARLY_FULL {
                return Some(((1.0 - f) / k, f));
            }
        }
    }
    let r = (2.0 * w.dot(n) - k * w.length_squared()) / denominator;
    let f = 1.0 - k * r;
    (r > 0.0 && f > 0.0).then_some((r, f))
}

/// Where a disk touches a site, held between two feet of it.
pub(crate) fn foot_of(site: &Site, center: Point, from: &Foot, to: &Foot) -> Foot {
    let (distance, normal) = site.carrier_distance(center);
    if site.is_vertex {
        // The cone turns right from `from` to `to`.
        let normal = if from.normal.cross(normal) > 0.0 {
            from.normal
        } else if normal.cross(to.normal) > 0.0 {
            to.normal
        } else {
            normal
        };
        return Foot { point: site.start.point, normal };
    }
    let point = center - normal * distance;
    if (point - from.point).dot(from.normal.right()) < 0.0 {
        *from
    } else if (point - to.point).dot(to.normal.right()) > 0.0 {
        *to
    } else if normal.dot(from.normal + to.normal) < 0.0 {
        // The far side of the circle lies between the ends of a part without length, too.
        *from
    } else {
        Foot { point, normal }
    }
}

#[cfg(test)]
mod tests {
    use super::super::site::Joint;
    use super::super::{SiteKind, SiteRef};
    use super::*;
    use crate::geom::{point, vector};

    #[test]
    fn the_foot_on_a_part_without_length_is_its_end() {
        let start = Foot { point: point(0.0, -1.0), normal: vector(0.0, 1.0) };
        let end = Foot { point: point(1.0, 0.0), normal: vector(-1.0, 0.0) };
        let source = SiteRef { loop_index: 0, element: 0, kind: SiteKind::Arc };
        let (joint, error) = (Joint::Smooth { same_circle: false }, f64::EPSILON);
        let site = Site {
            start,
            end,
            curvature: 1.0,
            error,
            is_vertex: false,
            joint,
            prev: 0,
            next: 0,
            vertices: [0; 2],
            source,
        };
        assert_eq!(foot_of(&site, point(0.0, 0.0), &end, &end), end);
        assert_eq!(foot_of(&site, point(0.0, 0.0), &start, &start), start);
    }
}
