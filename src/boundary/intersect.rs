//! Where two elements meet.
//!
//! **Needs** elements of at most a half circle, longer than the round-off, whose ends are equal to
//! the last bit where they are the same place. **Guarantees** every place where the elements
//! cross, touch to round-off, or where a common stretch begins or ends. **Does not** tell these
//! cases apart: that is decided around the place, by the order of what leaves it.
//!
//! **Method.** Ends that lie on the other element come first. Then the common places of the full
//! curves: with `u` the way from the start of an element, its curve is the zero set of
//! `f(u) = 2 n.u - k u.u`, `n` the normal and `k` the curvature there. A combination of two such
//! functions is linear, and its line meets the rounder curve where the curves meet each other. A
//! place that is joined to one of the ends by a stretch on which the curves cannot be told apart
//! is that end, found again with less accuracy.

use super::grain::SLACK;
use crate::geom::{Element, Point, Vector};
use robust::{Coord, orient2d};

/// Appends the places where two elements meet, shared ends included; `same` is the round-off of
/// places.
pub(super) fn meet(a: &Element, b: &Element, same: f64, places: &mut Vec<Point>) {
    let from = places.len();
    for (end, other) in [(a.start, b), (a.end, b), (b.start, a), (b.end, a)] {
        let shared = end == other.start || end == other.end;
        if (shared || is_near(other, end, same)) && !places[from..].contains(&end) {
            places.push(end);
        }
    }
    if a.is_segment() && b.is_segment() {
        // Segments with a common end have no other common place, unless their ends say so.
        if places.len() == from {
            places.extend(segments_cross(a, b));
        }
        return;
    }
    let ends = places.len();
    for p in curves_meet(a, b, same).into_iter().flatten() {
        let on_both = [a, b].iter().all(|e| is_near(e, p, SLACK * same));
        let known = places[from..ends].iter().any(|&end| is_joined(a, b, p, end, same));
        if on_both && !known {
            places.push(p);
        }
    }
}

/// Whether a place is nearer to an element than `within`.
fn is_near(e: &Element, p: Point, within: f64) -> bool {
    // Seen from an arc of at most a half circle, the chord spans a right angle or more: the arc lies
    // in the circle around the chord.
    let radius = 0.5 * e.chord().length();
    p.distance(e.start.midpoint(e.end)) <= radius + within && e.distance(p) <= within
}

/// The place where two segments cross in their inner parts.
fn segments_cross(a: &Element, b: &Element) -> Option<Point> {
    let side = |e: &Element, p: Point| orient2d(coord(e.start), coord(e.end), coord(p));
    let (s, t) = (side(b, a.start), side(b, a.end));
    if s * t >= 0.0 || side(a, b.start) * side(a, b.end) >= 0.0 {
        return None;
    }
    Some(a.start + a.chord() * (s / (s - t)))
}

fn coord(p: Point) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// The common places of the full curves of two elements, one of them an arc. Curves that touch to
/// round-off have one; equal curves have none.
fn curves_meet(a: &Element, b: &Element, same: f64) -> [Option<Point>; 2] {
    let (round, other) = if a.curvature().abs() >= b.curvature().abs() { (a, b) } else { (b, a) };
    let (k, n) = (round.curvature(), round.normals().0);
    let (h, m) = (other.curvature(), other.normals().0);
    // The other curve seen from the start of the round one: -h u.u + 2 (m + h d).u - c.
    let d = other.start - round.start;
    let c = 2.0 * m.dot(d) + h * d.length_squared();
    let normal = n * h - (m + d * h) * k;
    let distance = -0.5 * k * c;
    let steepness = normal.length();
    let alike =
        [0.0, 0.5, 1.0].iter().all(|&t| super::fan::offset(round, other.point_at(t)).abs() <= SLACK * same);
    if alike || steepness == 0.0 {
        return [None, None];
    }
    let along = (normal / steepness).left();
    let foot = normal * (distance / (steepness * steepness));
    // Start from the place on the line next to the arc, to keep the numbers small.
    let q = foot + along * along.dot(round.midpoint() - round.start);
    // Penetration of the line into the round curve is larger than that of the curves into each
    // other by the factor |k| / |k - h|, and |k - h| is the steepness where they touch.
    let touch = same * k.abs() / steepness;
    roots(k, n, q, along, touch).map(|t| t.map(|t| round.start + q + along * t))
}

/// Parameters `t` at which `q + t d` meets the curve `2 n.u = k u.u`, `d` of unit length; the two
/// are one where the line comes nearer than `touch` to touching.
fn roots(k: f64, n: Vector, q: Vector, d: Vector, touch: f64) -> [Option<f64>; 2] {
    // -k t^2 + 2 slope t + value = 0
    let slope = n.dot(d) - k * q.dot(d);
    let value = 2.0 * n.dot(q) - k * q.length_squared();
    let discriminant = slope * slope + k * value;
    if k != 0.0 && discriminant.abs() <= 2.0 * k.abs() * touch {
        return [Some(slope / k), None];
    }
    if discriminant < 0.0 {
        return [None, None];
    }
    let z = slope + discriminant.sqrt().copysign(slope);
    [(k != 0.0).then(|| z / k), (z != 0.0).then(|| -value / z)]
}

/// Whether the elements cannot be told apart between two of their common places, the first of them
/// found from the full curves. The measure is that by which it was found to be on both: a stricter
/// one would leave an element of round-off length between the two.
fn is_joined(a: &Element, b: &Element, p: Point, q: Point, same: f64) -> bool {
    if p.distance(q) <= SLACK * same {
        return true;
    }
    let halfway = a.point_at(0.5 * (a.parameter(p).clamp(0.0, 1.0) + a.parameter(q).clamp(0.0, 1.0)));
    b.distance(halfway) <= SLACK * same
}

/// Where a curve of curvature `k` with normal `n` at its start `at` meets the horizontal line at
/// height `y`: both abscissas.
pub(super) fn at_height(element: &Element, y: f64) -> [Option<f64>; 2] {
    let (k, n) = (element.curvature(), element.normals().0);
    let q = Vector { x: element.midpoint().x - element.start.x, y: y - element.start.y };
    roots(k, n, q, Vector { x: 1.0, y: 0.0 }, 0.0).map(|t| t.map(|t| element.start.x + q.x + t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    const SAME: f64 = 16.0 * f64::EPSILON;

    fn arc(from: (f64, f64), to: (f64, f64), bulge: f64) -> Element {
        Element::arc(point(from.0, from.1), point(to.0, to.1), bulge)
    }

    fn meets(a: Element, b: Element, expected: &[(f64, f64)]) {
        for (a, b) in [(a, b), (b, a), (a.reversed(), b), (b, a.reversed()), (a, b.reversed())] {
            let mut found = Vec::new();
            meet(&a, &b, SAME, &mut found);
            assert_eq!(found.len(), expected.len(), "{a:?} {b:?} {found:?}");
            for &(x, y) in expected {
                assert!(found.iter().any(|p| p.distance(point(x, y)) < 1e-14), "{found:?}");
            }
        }
    }

    #[test]
    fn segments_cross_touch_overlap_and_miss() {
        let a = arc((0.0, 0.0), (2.0, 0.0), 0.0);
        meets(a, arc((1.0, -1.0), (1.0, 1.0), 0.0), &[(1.0, 0.0)]);
        meets(a, arc((1.0, 1e-15), (1.0, 1.0), 0.0), &[(1.0, 0.0)]);
        meets(a, arc((2.0, 0.0), (3.0, 1.0), 0.0), &[(2.0, 0.0)]);
        meets(a, arc((1.0, 0.0), (3.0, 0.0), 0.0), &[(1.0, 0.0), (2.0, 0.0)]);
        meets(a, arc((1.0, 0.1), (3.0, 0.1), 0.0), &[]);
        meets(a, arc((3.0, -1.0), (3.0, 1.0), 0.0), &[]);
    }

    #[test]
    fn a_line_cuts_touches_or_misses_a_half_circle() {
        let half = arc((1.0, 0.0), (-1.0, 0.0), 1.0);
        meets(half, arc((-2.0, 0.6), (2.0, 0.6), 0.0), &[(-0.8, 0.6), (0.8, 0.6)]);
        meets(half, arc((0.0, 0.6), (2.0, 0.6), 0.0), &[(0.8, 0.6)]);
        meets(half, arc((-2.0, 1.0), (2.0, 1.0), 0.0), &[(0.0, 1.0)]);
        meets(half, arc((-2.0, 1.0 + 1e-15), (2.0, 1.0), 0.0), &[(0.0, 1.0)]);
        meets(half, arc((-2.0, -0.6), (2.0, -0.6), 0.0), &[]);
        meets(half, arc((1.0, -1.0), (1.0, 1.0), 0.0), &[(1.0, 0.0)]);
        meets(half, arc((1.0, 0.0), (-1.0, 0.0), 0.0), &[(1.0, 0.0), (-1.0, 0.0)]);
    }

    #[test]
    fn circles_cut_touch_and_coincide() {
        let upper = arc((5.0, 0.0), (-5.0, 0.0), 1.0);
        meets(upper, arc((11.0, 0.0), (1.0, 0.0), 1.0), &[(3.0, 4.0)]);
        meets(upper, arc((-5.0, 10.0), (5.0, 10.0), 1.0), &[(0.0, 5.0)]);
        meets(upper, arc((3.0, 2.0), (-3.0, 2.0), 1.0), &[(0.0, 5.0)]);
        meets(upper, arc((4.0, 0.0), (-4.0, 0.0), 1.0), &[]);
        let quarter = (std::f64::consts::PI / 8.0).tan();
        meets(upper, arc((0.0, 5.0), (-5.0, 0.0), quarter), &[(0.0, 5.0), (-5.0, 0.0)]);
    }

    #[test]
    fn a_smooth_joint_is_one_place() {
        let quarter = (std::f64::consts::PI / 8.0).tan();
        meets(arc((0.0, 0.0), (5.0, 0.0), 0.0), arc((5.0, 0.0), (6.0, 1.0), quarter), &[(5.0, 0.0)]);
        let turn = Vector::from_angle(0.3);
        let line = Element::segment(point(5.0, 0.0) + turn * -7.0, point(5.0, 0.0));
        let end = point(5.0, 0.0) + turn + turn.left();
        meets(line, Element::arc(point(5.0, 0.0), end, quarter), &[(5.0, 0.0)]);
    }

    #[test]
    fn flat_arcs_that_meet_at_a_small_angle_have_one_common_place() {
        // Found from the full curves, the joint is farther off than the round-off of places.
        let joint = (26.842_002_312_049_328, -34.011_001_582_397_924);
        let a = arc((30.918_139_195_155_106, -36.818_550_187_84), joint, -0.000_993_878_069_796_763);
        let b = arc(joint, (25.702_687_769_722_46, -33.230_187_640_786_48), 0.002_215_891_098_417_007_4);
        for (a, b) in [(a, b), (b, a), (a.reversed(), b.reversed())] {
            let mut found = Vec::new();
            meet(&a, &b, 150.0 * SAME, &mut found);
            assert_eq!(found, [point(joint.0, joint.1)]);
        }
    }

    #[test]
    fn an_arc_that_is_almost_straight_is_cut_like_a_segment() {
        let flat = arc((-1.0, 0.0), (1.0, 0.0), 1e-12);
        meets(flat, arc((0.5, -1.0), (0.5, 1.0), 0.0), &[(0.5, -7.5e-13)]);
        meets(flat, arc((0.5, -1.0), (0.5, 1.0), -1e-11), &[(0.5 - 1e-11, -7.5e-13)]);
    }
}
