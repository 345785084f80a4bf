//! Contours that cross by less than the reach of joining.
//!
//! **Needs** contours whose common places are common vertices. **Guarantees** that of two contours that
//! cross, one takes the course of the other from one common place to the next wherever both courses lie
//! within the reach of each other. **Does not** move a contour by more than the reach, nor
//! by more than a small part of its size; nor look at contours that do not cross, or pass a common
//! place twice.
//!
//! **Method.** Between two common places that follow each other on a contour there is no third one, so a
//! course along it meets the rest of the other contour nowhere else. All its vertices are those of that
//! contour, and what meets that one there has them too.

use super::chain::Contour;
use crate::geom::{ArcSpline, Point, Vertex};
use std::collections::HashMap;

/// Contours differ by more than this part of their size, however far the reach: what is small is not
/// rough for that.
const ROUGHNESS: f64 = 1.0 / 16.0;

/// Pairs of elements of two stretches that are compared: limit on effort; beyond it they differ.
const COMPARED: usize = 10_000;

/// Vertices that are looked at: limit on effort; the crossings beyond it stay.
const VISITED: usize = 2_000_000;

/// Common places that a contour may pass on its way from one to the next of the other contour: round a
/// corner that reaches over by a hair there are two or three.
const AHEAD: usize = 4;

/// Gives contours that cross, as the pairs say, a common course where they differ by less than `reach`.
/// Answers where.
pub(super) fn unite_courses(contours: &mut [Contour], pairs: &[(usize, usize)], reach: f64) -> Vec<Point> {
    let (mut places, mut visited) = (Vec::new(), 0);
    for &(a, b) in pairs {
        for (from, onto) in [(b, a), (a, b)] {
            let (path, other) = (&contours[from].path, &contours[onto].path);
            visited += path.len() + other.len();
            if visited > VISITED {
                return places;
            }
            let size = path.bounds().diagonal().min(other.bounds().diagonal());
            if let Some((path, moved)) = on_course(path, other, reach.min(ROUGHNESS * size)) {
                contours[from].path = path;
                places.extend(moved);
            }
        }
    }
    places
}

/// A contour on the course of another one where they differ by less than `within`, and where that is.
/// `None` where nothing changes.
fn on_course(path: &ArcSpline, other: &ArcSpline, within: f64) -> Option<(ArcSpline, Vec<Point>)> {
    let common = common_places(path, other);
    let mut in_order: Vec<usize> = common.iter().map(|c| c.1).collect();
    in_order.sort_unstable();
    let after = |of: usize| in_order.get(in_order.partition_point(|&i| i <= of)).unwrap_or(&in_order[0]);
    let course = |(from, from_other): (usize, usize), (to, to_other): (usize, usize)| {
        let forward = (*after(from_other) == to_other).then(|| stretch(other, from_other, to_other));
        let backward =
            (*after(to_other) == from_other).then(|| stretch(other, to_other, from_other).reversed());
        let ways = || forward.iter().chain(&backward);
        ways().next()?;
        let own = stretch(path, from, to);
        let found = ways().find(|way| is_alike(&own, way, within))?;
        (found.vertices[..found.len()] != own.vertices[..own.len()]).then(|| found.clone())
    };
    let (mut vertices, mut places) = (Vec::with_capacity(path.len()), Vec::new());
    let (n, mut k) = (common.len(), 0);
    while k < n {
        let steps = (1..=AHEAD.min(n - k)).rev();
        let next = steps.map(|step| (step, course(common[k], common[(k + step) % n])));
        let (step, taken) = next.into_iter().find(|(_, course)| course.is_some()).unwrap_or((1, None));
        places.extend(taken.as_ref().map(|_| path.vertices[common[k].0].point));
        let taken = taken.unwrap_or_else(|| stretch(path, common[k].0, common[(k + step) % n].0));
        vertices.extend_from_slice(&taken.vertices[..taken.len()]);
        k += step;
    }
    (!places.is_empty()).then_some((ArcSpline { vertices, closed: true }, places))
}

/// The vertices of a contour that are vertices of another one, which passes them once: both numbers.
fn common_places(path: &ArcSpline, other: &ArcSpline) -> Vec<(usize, usize)> {
    let bits = |v: &Vertex| (v.point.x.to_bits(), v.point.y.to_bits());
    let mut passed: HashMap<_, Option<usize>> = HashMap::with_capacity(other.len());
    for (i, v) in other.vertices.iter().enumerate() {
        passed.entry(bits(v)).and_modify(|known| *known = None).or_insert(Some(i));
    }
    let found = path.vertices.iter().enumerate();
    found.filter_map(|(i, v)| passed.get(&bits(v)).copied().flatten().map(|j| (i, j))).collect()
}

/// The part of a closed path from one vertex to another; all of it if they are the same.
fn stretch(path: &ArcSpline, from: usize, to: usize) -> ArcSpline {
    let n = path.vertices.len();
    let count = (to + n - from - 1) % n + 1;
    let vertices = (from..=from + count).map(|i| path.vertices[i % n]).collect();
    ArcSpline { vertices, closed: false }
}

/// Whether two stretches with the same ends lie within a distance of each other.
fn is_alike(a: &ArcSpline, b: &ArcSpline, within: f64) -> bool {
    let lies_along = |a: &ArcSpline, b: &ArcSpline| {
        a.elements().all(|e| b.distance(e.midpoint()) <= within && b.distance(e.end) <= within)
    };
    let ends = |p: &ArcSpline| (p.vertices[0].point, p.vertices[p.len()].point);
    let is_cheap = a.len().saturating_mul(b.len()) <= COMPARED;
    ends(a) == ends(b) && is_cheap && lies_along(a, b) && lies_along(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: [f64; 2], y: [f64; 2]) -> ArcSpline {
        ArcSpline::closed([(x[0], y[0], 0.0), (x[1], y[0], 0.0), (x[1], y[1], 0.0), (x[0], y[1], 0.0)])
    }

    /// A square and a bar that reaches into its right side by `depth`, with their common vertices.
    fn square_and_bar(depth: f64) -> [ArcSpline; 2] {
        let mut square = rectangle([0.0, 4.0], [0.0, 4.0]);
        let at = |y: f64| Vertex { point: crate::geom::point(4.0, y), bulge: 0.0 };
        square.vertices.splice(2..2, [at(1.0), at(3.0)]);
        let mut bar = rectangle([4.0 - depth, 9.0], [1.0, 3.0]);
        bar.vertices.insert(1, at(1.0));
        bar.vertices.insert(4, at(3.0));
        [square, bar]
    }

    fn united([a, b]: [ArcSpline; 2], reach: f64) -> (ArcSpline, usize) {
        let mut contours = [a, b].map(|path| Contour { path, rank: 0, loose: false });
        let count = unite_courses(&mut contours, &[(0, 1)], reach).len();
        (contours[1].path.clone(), count)
    }

    #[test]
    fn a_bar_that_reaches_in_by_less_than_the_reach_ends_on_the_side() {
        for turned in [false, true] {
            let [square, bar] = square_and_bar(0.004);
            let bar = if turned { bar.reversed() } else { bar };
            let (bar, count) = united([square, bar], 0.01);
            assert_eq!((count, bar.len(), bar.area().abs()), (1, 4, 10.0));
        }
    }

    #[test]
    fn a_bar_that_reaches_in_farther_stays() {
        let [square, bar] = square_and_bar(0.02);
        assert_eq!(united([square, bar.clone()], 0.01), (bar, 0));
    }

    #[test]
    fn a_corner_that_reaches_over_by_a_hair_is_trimmed() {
        // From below along the side, over it, back over it on the way out and in again, and out.
        let at = |x: f64, y: f64| (x, y, 0.0);
        let places = [at(4.0, 1.0), at(4.0, 2.996), at(4.0, 2.998), at(4.0, 3.0)];
        let [p, c, b, a] = places;
        let square = ArcSpline::closed([at(0.0, 0.0), at(4.0, 0.0), p, c, b, a, at(4.0, 5.0), at(0.0, 5.0)]);
        let bar = ArcSpline::closed([p, at(3.999, 2.0), a, at(4.001, 3.0), b, c, at(9.0, 3.0), at(9.0, 1.0)]);
        let (bar, count) = united([square, bar], 0.01);
        assert_eq!((count, bar.vertices.len()), (1, 4));
        assert_eq!(bar.vertices[1].point, crate::geom::point(c.0, c.1));
    }

    #[test]
    fn what_is_small_against_the_reach_is_not_rough_for_that() {
        let small =
            square_and_bar(1.0).map(|p| p.mapped(false, |q| crate::geom::point(q.x * 1e-3, q.y * 1e-3)));
        assert_eq!(united(small.clone(), 0.01), (small[1].clone(), 0));
    }
}
