//! Crossings of a ray with one element, for winding numbers.

use crate::geom::{Element, Point, Vector, vector};
use std::f64::consts::PI;

/// How the ray from `p` to the right crosses the element: the number of upward crossings less the
/// downward ones.
///
/// Ends count by the half-open rule (a place at the height of `p` counts as below it), so that a
/// chain of elements that share their ends to the last bit is counted without gap or overlap.
pub(super) fn winding(e: &Element, p: Point) -> i32 {
    let n0 = if e.chord().length_squared() == 0.0 { return 0 } else { e.normals().0 };
    let k = e.curvature();
    let mut turns = 0;
    let mut from = e.start;
    for to in quadrant_ends(e, n0) {
        turns += piece(e.start, n0, k, from, to, p);
        from = to;
    }
    turns
}

/// The crossing with the part of a line or circle between `a` and `b` along which x and y are
/// monotone. The curve passes `start` with left normal `n0` and curvature `k`.
fn piece(start: Point, n0: Vector, k: f64, a: Point, b: Point, p: Point) -> i32 {
    if (a.y > p.y) == (b.y > p.y) || p.x > a.x.max(b.x) {
        return 0;
    }
    let up = b.y > a.y;
    let sign = if up { 1 } else { -1 };
    if p.x < a.x.min(b.x) {
        return sign;
    }
    let w = p - start;
    let on_the_left = 2.0 * w.dot(n0) - k * w.length_squared() > 0.0;
    if on_the_left == up { sign } else { 0 }
}

/// Ends of the parts along which both coordinates are monotone, in order of travel.
fn quadrant_ends(e: &Element, n0: Vector) -> impl Iterator<Item = Point> {
    let sweep = e.sweep();
    let mut turns = [f64::INFINITY; 4];
    if sweep != 0.0 {
        let axes = [vector(1.0, 0.0), vector(0.0, 1.0), vector(-1.0, 0.0), vector(0.0, -1.0)];
        for (turn, axis) in turns.iter_mut().zip(axes) {
            let angle = n0.angle_to(axis);
            let ahead = if sweep > 0.0 { angle.rem_euclid(2.0 * PI) } else { (-angle).rem_euclid(2.0 * PI) };
            *turn = ahead / sweep.abs();
        }
        turns.sort_by(f64::total_cmp);
    }
    let e = *e;
    turns
        .into_iter()
        .filter(|t| *t > 0.0 && *t < 1.0)
        .map(move |t| e.point_at(t))
        .chain(std::iter::once(e.end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn count(e: Element, x: f64, y: f64) -> i32 {
        winding(&e, point(x, y))
    }

    #[test]
    fn a_segment_is_crossed_by_rays_from_its_left_side_only() {
        let e = Element::segment(point(0.0, 0.0), point(1.0, 2.0));
        assert_eq!((count(e, 0.4, 1.0), count(e, 0.6, 1.0), count(e, -5.0, 2.5)), (1, 0, 0));
        assert_eq!(count(e.reversed(), 0.4, 1.0), -1);
    }

    #[test]
    fn a_half_circle_that_bulges_right_is_met_behind_its_chord() {
        let e = Element::arc(point(0.0, -1.0), point(0.0, 1.0), 1.0);
        assert_eq!((count(e, 0.9, 0.1), count(e, 1.1, 0.1), count(e, -3.0, 0.1)), (1, 0, 1));
    }

    #[test]
    fn an_arc_that_turns_back_cancels_out() {
        let e = Element::arc(point(1.0, 0.0), point(-1.0, 0.0), 1.0);
        assert_eq!((count(e, 0.0, 0.5), count(e, -2.0, 0.5), count(e, 2.0, 0.5)), (1, 0, 0));
        let most = Element::arc(point(0.1, -1.0), point(-0.1, -1.0), 6.0);
        assert_eq!((count(most, 0.0, -0.7), count(most, -9.0, -0.7), count(most, 9.0, -0.7)), (1, 0, 0));
    }
}
