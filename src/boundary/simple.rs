//! Contours that touch themselves become simple loops.

use super::grain::Grain;
use crate::geom::{ArcSpline, Element, Point, Vertex};
use std::collections::{HashMap, HashSet};

/// Cuts a closed path in which strands touch but do not cross wherever it comes back to a vertex.
/// The loops bound the same region by the even-odd rule.
pub(super) fn simple_loops(path: ArcSpline) -> Vec<ArcSpline> {
    let mut places: Vec<_> = path.vertices.iter().map(bits_of).collect();
    places.sort_unstable();
    if places.windows(2).all(|pair| pair[0] != pair[1]) {
        return vec![path];
    }
    let mut loops = Vec::new();
    let mut open = Vec::new();
    let mut passed: HashMap<(u64, u64), usize> = HashMap::new();
    for &vertex in &path.vertices {
        let bits = bits_of(&vertex);
        if let Some(&since) = passed.get(&bits) {
            let vertices: Vec<_> = open.drain(since..).collect();
            for v in &vertices {
                passed.remove(&bits_of(v));
            }
            loops.push(ArcSpline { vertices, closed: true });
        }
        passed.insert(bits, open.len());
        open.push(vertex);
    }
    loops.push(ArcSpline { vertices: open, closed: true });
    loops.reverse();
    loops
}

/// Cuts small loops off a closed path at vertices that it passes again: loops that reach no farther
/// than `reach` from there, while the rest does. Answers where.
pub(super) fn cut_small_loops(path: &mut ArcSpline, crossed: &[usize], reach: f64) -> Vec<Point> {
    let is_small = |vertices: &[Vertex], at: Point| {
        let open = ArcSpline { vertices: vertices.to_vec(), closed: false };
        let far = |p: Point| p.distance(at) > reach;
        !open.elements().any(|e| far(e.midpoint()) || far(e.end)) && !vertices.iter().any(|v| far(v.point))
    };
    let at_crossing: HashSet<(u64, u64)> = crossed.iter().map(|&v| bits_of(&path.vertices[v])).collect();
    let start = (0..path.vertices.len()).max_by(|&i, &j| {
        let from = path.vertices[crossed[0]].point;
        let distance = |k: usize| path.vertices[k].point.distance(from);
        distance(i).total_cmp(&distance(j))
    });
    // From the vertex farthest away, small loops do not run over the start.
    path.vertices.rotate_left(start.unwrap_or(0));
    let mut kept: Vec<Vertex> = Vec::new();
    let mut passed: HashMap<(u64, u64), usize> = HashMap::new();
    let mut places = Vec::new();
    for &vertex in &path.vertices {
        let bits = bits_of(&vertex);
        let since = passed.get(&bits).copied().filter(|&i| kept.get(i).is_some_and(|v| bits_of(v) == bits));
        if let Some(since) = since
            && at_crossing.contains(&bits)
            && is_small(&kept[since..], vertex.point)
        {
            kept.truncate(since);
            places.push(vertex.point);
        }
        passed.insert(bits, kept.len());
        kept.push(vertex);
    }
    path.vertices = kept;
    places
}

fn bits_of(v: &Vertex) -> (u64, u64) {
    (v.point.x.to_bits(), v.point.y.to_bits())
}

/// Whether a closed path lies on one line, or runs there and back, to round-off.
pub(super) fn is_flat(path: &ArcSpline, grain: Grain) -> bool {
    match path.len() {
        0 | 1 => true,
        2 => path.element(0).midpoint().distance(path.element(1).midpoint()) <= 2.0 * grain.same,
        _ => {
            let first = path.vertices[0].point;
            let far = path.vertices.iter().map(|v| v.point);
            let far = far.max_by(|a, b| a.distance(first).total_cmp(&b.distance(first)));
            let line = Element::segment(first, far.unwrap_or(first));
            path.elements().all(|e| e.is_segment() && line.distance(e.start) <= grain.same)
        }
    }
}

/// Whether the area of a simple loop is more than the round-off of its vertices.
pub(super) fn has_area(path: &ArcSpline, grain: Grain) -> bool {
    path.area().abs() > grain.same * path.length()
}

/// A place on a closed path that is well inside of an element.
pub(super) fn inner_place(path: &ArcSpline) -> Point {
    let longest = path.elements().max_by(|a, b| a.chord().length().total_cmp(&b.chord().length()));
    longest.map_or(Point::default(), |e| e.midpoint())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAIN: Grain = Grain { same: 1e-14, ulp: 1e-16 };

    #[test]
    fn a_figure_eight_is_two_loops() {
        let eight = ArcSpline::closed([
            (0.0, 0.0, 0.0),
            (2.0, -1.0, 0.0),
            (2.0, 1.0, 0.0),
            (0.0, 0.0, 0.0),
            (-2.0, -1.0, 0.0),
            (-2.0, 1.0, 0.5),
        ]);
        let loops = simple_loops(eight.clone());
        assert_eq!(loops.iter().map(ArcSpline::len).collect::<Vec<_>>(), [3, 3]);
        let area: f64 = loops.iter().map(ArcSpline::area).sum();
        assert!((area - eight.area()).abs() < 1e-14);
    }

    #[test]
    fn a_flower_falls_apart_into_its_petals() {
        let mut vertices = Vec::new();
        for i in 0..5 {
            let at = |d: f64| crate::geom::Vector::from_angle(f64::from(i) + d);
            vertices.extend([(0.0, 0.0, 0.0), (at(0.0).x, at(0.0).y, 0.3), (at(0.5).x, at(0.5).y, 0.0)]);
        }
        assert_eq!(simple_loops(ArcSpline::closed(vertices)).len(), 5);
    }

    #[test]
    fn there_and_back_is_flat() {
        assert!(is_flat(&ArcSpline::closed([(0.0, 0.0, 0.0), (1.0, 1.0, 0.0)]), GRAIN));
        assert!(is_flat(&ArcSpline::closed([(0.0, 0.0, 0.4), (1.0, 1.0, -0.4)]), GRAIN));
        assert!(is_flat(&ArcSpline::closed([(0.0, 0.0, 0.0), (3.0, 3.0, 0.0), (1.0, 1.0, 0.0)]), GRAIN));
        assert!(!is_flat(&ArcSpline::closed([(0.0, 0.0, 0.4), (1.0, 1.0, 0.0)]), GRAIN));
        assert!(!is_flat(&ArcSpline::circle(Point::default(), 1.0), GRAIN));
    }

    #[test]
    fn only_small_loops_are_cut_off() {
        let path = |size: f64| {
            ArcSpline::closed([
                (9.0, 0.0, 0.0),
                (9.0 + size, 0.0, 0.0),
                (9.0, -size, 0.0),
                (9.0, 0.0, 0.0),
                (9.0, 3.0, 0.0),
                (0.0, 3.0, 0.0),
                (0.0, 0.0, 0.0),
            ])
        };
        let (mut small, mut large) = (path(0.005), path(0.02));
        assert_eq!(cut_small_loops(&mut small, &[0, 3], 0.01).len(), 1);
        assert_eq!((small.len(), small.area()), (4, 27.0));
        assert!(cut_small_loops(&mut large, &[0, 3], 0.01).is_empty());
        assert_eq!(large.len(), 7);
    }
}
