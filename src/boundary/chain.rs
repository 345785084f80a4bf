//! Open curves, shuffled and reversed as they may be, become closed contours.
//!
//! **Needs** clean paths. **Guarantees** contours whose consecutive elements share their ends to
//! the last bit; the ends that were joined moved to their middle, arcs kept their bulge; where
//! more than two ends meet, contours do not cross. **Does not** join what is farther apart than
//! the reach, nor look whether contours meet elsewhere.

use super::ends::{End, Ends, curve_of};
use super::grain::Grain;
use super::index::Index;
use crate::error::Defect;
use crate::geom::{ArcSpline, Bounds, Point, Vertex};
use std::collections::HashMap;

/// A closed contour and its place in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    /// Its closed path.
    pub path: ArcSpline,
    /// The first curve that it is made of.
    pub rank: usize,
    /// Whether it was drawn as loose curves, and so has no identity where others meet it.
    pub loose: bool,
}

/// A chain that does not close.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OpenChain {
    /// Its two ends.
    pub ends: [Point; 2],
    /// A place on it that is not an end.
    pub middle: Point,
    /// The reach that would close it.
    pub gap: f64,
    /// Its curves, with their ends where they were joined.
    pub curves: Vec<ArcSpline>,
}

impl OpenChain {
    /// The defect that it is.
    pub fn defect(&self, inside: bool) -> Defect {
        Defect::OpenContour { start: self.ends[0], end: self.ends[1], gap: self.gap, inside }
    }
}

/// Chains clean open paths with their ranks, joining gaps of up to `join`.
pub(super) fn chain(
    paths: &[ArcSpline],
    ranks: &[usize],
    join: f64,
    grain: Grain,
) -> (Vec<Contour>, Vec<OpenChain>) {
    let links = Links::new(paths, &Ends::new(paths, join, grain));
    let mut walked = vec![false; paths.len()];
    let (mut contours, mut open) = (Vec::new(), Vec::new());
    for loose in 0..2 * paths.len() as End {
        if links.next[loose as usize].is_none() && !walked[curve_of(loose)] {
            let ends = links.walk(loose, &mut walked);
            open.push(links.open_chain(&ends));
        }
    }
    for curve in 0..paths.len() {
        if !walked[curve] {
            let ends = links.walk(2 * curve as End, &mut walked);
            let loose = ends.len() > 1;
            contours.push(Contour { path: links.contour(&ends), rank: ranks[curve], loose });
        }
    }
    measure_gaps(&mut open, join);
    (contours, open)
}

/// Which end follows which.
struct Links<'a> {
    paths: &'a [ArcSpline],
    next: Vec<Option<End>>,
    /// Where every end comes to lie.
    place: Vec<Point>,
}

impl<'a> Links<'a> {
    fn new(paths: &'a [ArcSpline], ends: &Ends) -> Links<'a> {
        let place = (0..2 * paths.len() as End).map(|e| ends.place(e)).collect();
        let mut links = Links { paths, next: vec![None; 2 * paths.len()], place };
        ends.meetings(|kept, dropped| {
            let first = if kept.is_empty() { dropped } else { kept };
            let node = middle(first.iter().map(|&e| ends.place(e)));
            kept.iter().chain(dropped).for_each(|&e| links.place[e as usize] = node);
            if kept.len() > 2 {
                links.join_fan(kept, ends);
            } else {
                links.join_in_order(kept);
            }
            // Dropped curves form chains of their own, for the report.
            links.join_in_order(dropped);
        });
        links
    }

    fn join(&mut self, a: End, b: End) {
        self.next[a as usize] = Some(b);
        self.next[b as usize] = Some(a);
    }

    fn join_in_order(&mut self, ends: &[End]) {
        ends.chunks_exact(2).for_each(|pair| self.join(pair[0], pair[1]));
    }

    /// Joins neighbors around a node, so that chains do not cross there: of the two ways to do
    /// so the one that closes the smaller gaps.
    fn join_fan(&mut self, ends: &[End], all: &Ends) {
        let order = all.fan(ends).order;
        let n = order.len();
        let pair = |i: usize, shift: usize| (ends[order[(i + shift) % n]], ends[order[(i + shift + 1) % n]]);
        let gaps = |shift: usize| -> f64 {
            let pairs = (0..n).step_by(2).map(|i| pair(i, shift));
            pairs.map(|(a, b)| all.place(a).distance(all.place(b))).sum()
        };
        let shift = usize::from(gaps(1) < gaps(0));
        (0..n).step_by(2).map(|i| pair(i, shift)).for_each(|(a, b)| self.join(a, b));
    }

    /// Follows the chain that begins with an end; answers the ends where its curves are entered.
    fn walk(&self, first: End, walked: &mut [bool]) -> Vec<End> {
        let mut entered = Vec::new();
        let mut at = first;
        while !walked[curve_of(at)] {
            walked[curve_of(at)] = true;
            entered.push(at);
            match self.next[(at ^ 1) as usize] {
                Some(next) => at = next,
                None => break,
            }
        }
        entered
    }

    fn contour(&self, entered: &[End]) -> ArcSpline {
        let mut vertices = Vec::new();
        for &end in entered {
            let path = &self.paths[curve_of(end)];
            let (from, n) = (vertices.len(), path.len());
            if end % 2 == 0 {
                vertices.extend_from_slice(&path.vertices[..n]);
            } else {
                // Not `-bulge`, so that the bulge of a segment stays +0.
                let turned =
                    |i: usize| Vertex { bulge: 0.0 - path.vertices[i - 1].bulge, ..path.vertices[i] };
                vertices.extend((1..=n).rev().map(turned));
            }
            vertices[from] = Vertex { point: self.place[end as usize], ..vertices[from] };
        }
        ArcSpline { vertices, closed: true }
    }

    fn open_chain(&self, entered: &[End]) -> OpenChain {
        let (first, last) = (entered[0], entered[entered.len() - 1] ^ 1);
        let halfway = &self.paths[curve_of(entered[entered.len() / 2])];
        OpenChain {
            ends: [self.place[first as usize], self.place[last as usize]],
            middle: halfway.element(halfway.len() / 2).midpoint(),
            gap: 0.0,
            curves: entered.iter().map(|&end| self.curve(curve_of(end))).collect(),
        }
    }

    /// A curve with its ends where they were joined.
    fn curve(&self, curve: usize) -> ArcSpline {
        let mut path = self.paths[curve].clone();
        let last = path.vertices.len() - 1;
        path.vertices[0].point = self.place[2 * curve];
        path.vertices[last].point = self.place[2 * curve + 1];
        path
    }
}

/// The mean of the distinct places among some.
fn middle(places: impl Iterator<Item = Point> + Clone) -> Point {
    let mut rest = places.clone();
    let one = rest.next().unwrap_or_default();
    if rest.all(|p| p == one) {
        return one;
    }
    let mut distinct: Vec<Point> = Vec::new();
    let mut known = HashMap::new();
    for p in places {
        known.entry((p.x.to_bits(), p.y.to_bits())).or_insert_with(|| distinct.push(p));
    }
    match distinct[..] {
        [] => one,
        [a, b] => a.midpoint(b),
        [first, ..] => {
            let sum = distinct.iter().fold(crate::geom::vector(0.0, 0.0), |s, &p| s + (p - first));
            first + sum / distinct.len() as f64
        }
    }
}

/// Finds for each open chain the reach that would join both its ends to some other loose end,
/// which may be its own.
fn measure_gaps(open: &mut [OpenChain], join: f64) {
    let loose: Vec<Point> = open.iter().flat_map(|c| c.ends).collect();
    let tree = Index::new(&loose.iter().map(|&p| Bounds { min: p, max: p }).collect::<Vec<_>>());
    for (i, chain) in open.iter_mut().enumerate() {
        let gaps = [2 * i, 2 * i + 1].map(|end| nearest_other(&tree, &loose, end));
        chain.gap = gaps[0].max(gaps[1]);
        if chain.gap <= join {
            // The ends within reach belong to others already.
            chain.gap = chain.ends[0].distance(chain.ends[1]);
        }
    }
}

fn nearest_other(tree: &Index, places: &[Point], of: usize) -> f64 {
    let p = places[of];
    let mut best = f64::INFINITY;
    tree.walk(
        &mut best,
        |best, _, b| Some(b.nearest(p).distance(p)).filter(|gap| gap < best),
        |best, other| {
            if other as usize != of {
                *best = best.min(places[other as usize].distance(p));
            }
        },
    );
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    const JOIN: f64 = 0.01;

    fn segment(a: (f64, f64), b: (f64, f64)) -> ArcSpline {
        ArcSpline::open([(a.0, a.1, 0.0), (b.0, b.1, 0.0)])
    }

    fn chained(paths: &[ArcSpline]) -> (Vec<Contour>, Vec<OpenChain>) {
        let bounds = paths.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        chain(paths, &(0..paths.len()).collect::<Vec<_>>(), JOIN, Grain::of(&bounds))
    }

    fn square(x: f64, y: f64, side: f64) -> Vec<ArcSpline> {
        let c = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)];
        (0..4)
            .map(|i| if i % 2 == 0 { segment(c[i], c[(i + 1) % 4]) } else { segment(c[(i + 1) % 4], c[i]) })
            .collect()
    }

    #[test]
    fn loose_sides_become_a_square() {
        let (contours, open) = chained(&square(0.0, 0.0, 1.0));
        assert!(open.is_empty());
        assert_eq!(contours.len(), 1);
        assert_eq!(contours[0].path.area().abs(), 1.0);
    }

    #[test]
    fn ends_that_are_joined_meet_in_the_middle() {
        let paths = [
            ArcSpline::open([(1.0, 0.0, 1.0), (-1.0, 0.0, 0.0)]),
            ArcSpline::open([(-1.004, 0.0, 1.0), (1.004, 0.0, 0.0)]),
        ];
        let (contours, open) = chained(&paths);
        assert!(open.is_empty());
        assert_eq!(contours[0].path, ArcSpline::closed([(1.002, 0.0, 1.0), (-1.002, 0.0, 1.0)]));
    }

    #[test]
    fn a_gap_beyond_the_reach_is_reported_with_its_width() {
        let mut paths = square(0.0, 0.0, 1.0);
        paths[3] = segment((0.0, 1.0), (0.0, 0.02));
        let (contours, open) = chained(&paths);
        assert!(contours.is_empty());
        assert_eq!(open.len(), 1);
        assert!((open[0].gap - 0.02).abs() < 1e-12);
    }

    #[test]
    fn a_gap_just_as_wide_as_the_reach_is_closed() {
        let sides = [
            segment((0.0, 0.0), (100.0, 0.0)),
            segment((100.0, 0.01), (100.0, 60.0)),
            segment((99.99, 60.0), (0.0, 60.0)),
            segment((0.0, 59.99), (0.0, 0.01)),
        ];
        let (contours, open) = chained(&sides);
        assert_eq!((contours.len(), open.len()), (1, 0));
    }

    #[test]
    fn a_contour_broken_twice_names_the_wider_gap() {
        let paths = [
            ArcSpline::open([(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 1.0, 0.0)]),
            ArcSpline::open([(2.0, 1.3, 0.0), (2.0, 2.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.5, 0.0)]),
        ];
        let (_, open) = chained(&paths);
        assert_eq!(open.len(), 2);
        assert!(open.iter().all(|c| (c.gap - 0.5).abs() < 1e-12));
    }

    #[test]
    fn a_whisker_at_a_corner_does_not_open_the_contour() {
        for whisker in [segment((1.0, 1.0), (2.0, 2.0)), segment((2.0, 2.0), (1.001, 1.001))] {
            let mut paths = square(0.0, 0.0, 1.0);
            paths[1] = segment((1.0, 0.0), (1.0, 0.995));
            paths.insert(0, whisker);
            let (contours, open) = chained(&paths);
            assert_eq!((contours.len(), open.len()), (1, 1));
        }
    }

    #[test]
    fn a_diagonal_is_left_out_and_the_square_stays() {
        for bend in [0.0, 0.003] {
            let mut paths = square(0.0, 0.0, 1.0);
            paths.push(segment((bend, 0.0), (1.0, 1.0 - bend)));
            let (contours, open) = chained(&paths);
            assert_eq!((contours.len(), open.len()), (1, 1), "bend {bend}");
            assert!((contours[0].path.area().abs() - 1.0).abs() < 0.01);
        }
    }

    #[test]
    fn squares_that_share_a_corner_stay_apart_or_touch() {
        let mut paths = square(0.0, 0.0, 1.0);
        paths.extend(square(1.0, 1.0, 1.0));
        let (contours, open) = chained(&paths);
        assert!(open.is_empty());
        assert_eq!(contours.iter().map(|c| c.path.area().abs()).sum::<f64>(), 2.0);
    }

    #[test]
    fn tiny_pieces_do_not_close_on_themselves() {
        let n = 400;
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * (i % n) as f64 / n as f64;
            (0.3 * angle.cos(), 0.3 * angle.sin())
        };
        let paths: Vec<ArcSpline> = (0..n).map(|i| segment(at(i), at(i + 1))).collect();
        let (contours, open) = chained(&paths);
        assert_eq!((contours.len(), open.len()), (1, 0));
        assert_eq!(contours[0].path.len(), n);
        let (contours, open) = chained(&paths[..1]);
        assert_eq!((contours.len(), open.len()), (0, 1));
    }

    #[test]
    fn a_reach_wider_than_the_drawing_still_takes_the_nearest() {
        let paths: Vec<ArcSpline> = square(0.0, 0.0, 0.004).into_iter().collect();
        let apart: Vec<ArcSpline> = paths
            .iter()
            .enumerate()
            .map(|(i, p)| p.mapped(false, |q| point(q.x + 1e-6 * i as f64, q.y)))
            .collect();
        let (contours, open) = chained(&apart);
        assert_eq!((contours.len(), open.len()), (1, 0));
    }
}
