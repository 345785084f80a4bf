//! Curves as another program writes them, made into loops.
//!
//! **Guarantees** that an end is joined to one other at most, the nearest pairs first; both ends move to
//! their middle. **Does not** mend anything else: what does not close stays open, what is drawn twice
//! is there twice, for the judge to say so.

use crate::geom::{ArcSpline, Point, Vertex};
use rstar::primitives::GeomWithData;
use rstar::{PointDistance, RTree};

/// An end of a curve: twice its index, and one more for the end where it stops.
type End = usize;

/// Joins open curves whose ends are no more than `join` apart, in any order and direction, and closes
/// what returns to its start. Closed curves and lone vertices stay as they are. Lengths are in job units.
pub fn chained(curves: &[ArcSpline], join: f64) -> Vec<ArcSpline> {
    let partner = partners(curves, join);
    let mut walked = vec![false; curves.len()];
    let mut chains = Vec::new();
    // From loose ends first; what is left over returns to its start.
    let loose = (0..2 * curves.len()).filter(|&end| partner[end].is_none());
    for first in loose.chain((0..curves.len()).map(|i| 2 * i)) {
        if !walked[first / 2] {
            chains.push(walk(curves, &partner, first, &mut walked));
        }
    }
    chains
}

/// Where a curve begins or stops.
fn place(curves: &[ArcSpline], end: End) -> Option<Point> {
    let vertices = &curves[end / 2].vertices;
    let vertex = if end.is_multiple_of(2) { vertices.first() } else { vertices.last() };
    vertex.map(|v| v.point)
}

/// Which end each is joined to.
fn partners(curves: &[ArcSpline], join: f64) -> Vec<Option<End>> {
    let open = |end: &End| !(curves[end / 2].closed || curves[end / 2].is_empty());
    let ends: Vec<(End, Point)> = (0..2 * curves.len())
        .filter(open)
        .filter_map(|end| Some((end, place(curves, end)?)))
        .filter(|(_, p)| p.is_finite())
        .collect();
    let tree = RTree::bulk_load(ends.iter().map(|&(end, p)| GeomWithData::new([p.x, p.y], end)).collect());
    let mut pairs: Vec<(f64, End, End)> = Vec::new();
    for &(end, p) in &ends {
        let p = [p.x, p.y];
        let near = tree.locate_within_distance(p, join * join);
        pairs.extend(near.filter(|o| o.data > end).map(|o| (o.distance_2(&p), end, o.data)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut partner = vec![None; 2 * curves.len()];
    for (_, a, b) in pairs {
        // A single short curve is no loop.
        let is_dot = a / 2 == b / 2 && curves[a / 2].length() <= join;
        if partner[a].is_none() && partner[b].is_none() && !is_dot {
            (partner[a], partner[b]) = (Some(b), Some(a));
        }
    }
    partner
}

/// The chain that begins with an end.
fn walk(curves: &[ArcSpline], partner: &[Option<End>], first: End, walked: &mut [bool]) -> ArcSpline {
    let mut chain = ArcSpline::default();
    let mut from = first;
    loop {
        walked[from / 2] = true;
        let curve = &curves[from / 2];
        let run = if from.is_multiple_of(2) { curve.clone() } else { curve.reversed() };
        let to = from ^ 1;
        if run.closed {
            return run;
        }
        chain.vertices.pop();
        chain.vertices.extend(run.vertices);
        let middle = |end: End| Some(place(curves, end)?.midpoint(place(curves, partner[end]?)?));
        if let (Some(last), Some(point)) = (chain.vertices.last_mut(), middle(to)) {
            *last = Vertex { point, bulge: 0.0 };
        }
        let start = chain.vertices.len() - curve.vertices.len();
        if let Some(point) = middle(from) {
            chain.vertices[start].point = point;
        }
        match partner[to] {
            Some(next) if next == first => {
                chain.vertices.pop();
                chain.closed = true;
                return chain;
            }
            Some(next) => from = next,
            None => return chain,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn loose_curves_close_in_any_order_and_direction() {
        let curves = [
            ArcSpline::open([(0.0, 0.0, 0.0), (4.0, 0.0, 0.0)]),
            ArcSpline::open([(0.0, 2.0, 0.0), (4.0, 2.004, 0.0)]),
            ArcSpline::open([(4.0, 0.0, 1.0), (4.0, 2.0, 0.0)]),
            ArcSpline::open([(0.0, 0.0, -1.0), (0.0, 2.0, 0.0)]),
        ];
        let [only] = &chained(&curves, 0.01)[..] else { panic!() };
        assert!(only.closed && only.len() == 4);
        assert!((only.area().abs() - (8.004 + std::f64::consts::PI)).abs() < 0.01, "{only:?}");
        let open = chained(&curves, 0.001);
        assert_eq!((open.len(), open[0].closed), (1, false));
        assert_eq!(open[0].len(), 4);
    }

    #[test]
    fn closed_curves_dots_and_nothing_stay() {
        let circle = ArcSpline::circle(point(1.0, 1.0), 2.0);
        let dot = ArcSpline::open([(1.0, 1.0, 0.0)]);
        let curves = [circle, dot, ArcSpline::default()];
        assert_eq!(chained(&curves, 0.01), curves);
        let round = ArcSpline::open([(0.0, 0.0, 1.0), (2.0, 0.0, 1.0), (0.0, 0.0, 0.0)]);
        let [closed] = &chained(&[round], 0.01)[..] else { panic!() };
        assert!(closed.closed && closed.len() == 2);
    }
}
