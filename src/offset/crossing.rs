//! Where a level crosses an edge of the axis.
//!
//! **Guarantees** the place on the edge that is at the distance from the elements on both sides, to
//! round-off: the same to the last bit for both.
//!
//! **Method.** The radius is monotone along the edge, so there is one such place. Newton's method finds it
//! in three or four steps from where a straight edge with a steady radius would have it; what it finds is
//! taken if its feet lie on the pieces of the boundary that the edge stands for, as nothing else is as far
//! from both. Otherwise, beside ends of edges and between walls nearly parallel, halving along the longer
//! piece does not fail.

use super::trace::Tracer;
use crate::geom::{Point, Vector, vector};
use crate::mat::{GraphEdge, Piece, Site, Track, falling_root};

/// Round-off of the distance to an element in the unit frame: eight roundings of numbers up to 1.
const RESIDUAL: f64 = 8.0 * f64::EPSILON;

impl Tracer<'_> {
    /// Where on an edge the radius is `d`: the same place for both sides.
    pub fn crossing(&self, edge: u32) -> Point {
        let e = self.edge(edge);
        let [a, b] = e.pieces.map(|p| self.piece(p).piece);
        if let Some(c) = self.between_vertices(e, [&a, &b]).or_else(|| self.by_newton(e, [&a, &b])) {
            return c;
        }
        let extent = |p: &Piece| p.from.point.distance(p.to.point);
        let swap = extent(&b) > extent(&a);
        let (along, across) = if swap { (&b, &a) } else { (&a, &b) };
        let radius_at = |end: usize| self.mat.graph.disks[e.disks[end] as usize].radius;
        let falls = (radius_at(0) > radius_at(1)) != swap;
        let track = Track::of(&self.mat.sites, along);
        let radius = |t: f64| track.reach(&self.mat.sites, across, &track.at(t)).0;
        let sign = if falls { 1.0 } else { -1.0 };
        let t = falling_root(0.0, 1.0, |t| {
            sign * if radius(t).is_finite() { radius(t) - self.d } else { self.d }
        });
        // The place at this distance from the one side is exact; the other's is made so as well.
        let start = track.at(t).center(self.d);
        self.polished(e, [self.site(&a), self.site(&b)], start)
    }

    /// The crossing between two vertices, on the line halfway between them. They may be the sides of a
    /// hair-thin neck, seen from afar in nearly one direction, which tells nothing of the place across it.
    fn between_vertices(&self, edge: &GraphEdge, pieces: [&Piece; 2]) -> Option<Point> {
        let sites = pieces.map(|p| self.site(p));
        if !sites.iter().all(|s| s.is_vertex) {
            return None;
        }
        let [v, w] = sites.map(|s| s.start.point);
        let half = 0.5 * v.distance(w);
        let away = (w - v).left() * (((self.d - half) * (self.d + half)).max(0.0).sqrt() / (2.0 * half));
        let [a, b] = edge.disks.map(|d| &self.mat.graph.disks[d as usize]);
        let toward = (if a.radius > b.radius { a } else { b }).center - v.midpoint(w);
        let c = v.midpoint(w) + if toward.dot(away) < 0.0 { -away } else { away };
        c.is_finite().then_some(c)
    }

    /// The crossing by Newton's method, if it is certain to be that.
    fn by_newton(&self, edge: &GraphEdge, pieces: [&Piece; 2]) -> Option<Point> {
        let [from, to] = edge.disks.map(|d| &self.mat.graph.disks[d as usize]);
        let share = (self.d - from.radius) / (to.radius - from.radius);
        let sites = pieces.map(|p| self.site(p));
        let c = self.polished(edge, sites, from.center + (to.center - from.center) * share);
        let is_on = |(piece, site): (&Piece, &Site)| {
            let (distance, normal) = site.carrier_distance(c);
            (distance - self.d).abs() <= RESIDUAL && spans(piece, site, c - normal * distance, normal)
        };
        pieces.into_iter().zip(sites).all(is_on).then_some(c)
    }

    /// Whether a place can lie on an edge, but for round-off. The edge turns by a quarter at most, so it
    /// is nowhere farther from one end than the other end is; and `s` beyond the end of a wall the
    /// distance to it is no more than `s^2 / 2d` larger.
    fn may_hold(&self, edge: &GraphEdge, c: Point) -> bool {
        let ends = edge.disks.map(|d| self.mat.graph.disks[d as usize].center);
        let longest = ends[0].distance(ends[1]) + (2.0 * self.d * self.mat.graph.error).sqrt();
        ends.iter().all(|end| end.distance(c) <= longest)
    }

    /// Newton's step for a place at distance `d` from two carriers, while it helps. Between walls that
    /// are parallel but for round-off it may lead anywhere along them, and must not leave the edge.
    fn polished(&self, edge: &GraphEdge, sites: [&Site; 2], mut c: Point) -> Point {
        let residuals = |c: Point| sites.map(|s| s.carrier_distance(c)).map(|(s, n)| (self.d - s, n));
        let worst = |r: &[(f64, Vector); 2]| r[0].0.abs().max(r[1].0.abs());
        let mut now = residuals(c);
        while worst(&now) > f64::EPSILON * self.d {
            let [(e0, n0), (e1, n1)] = now;
            let det = n0.cross(n1);
            let step = vector((e0 * n1.y - e1 * n0.y) / det, (e1 * n0.x - e0 * n1.x) / det);
            let mut next = c + step;
            if step.length_squared() > self.d * worst(&now) {
                // A step so long, between circles that hardly cross, leads away from both by more than they
                // are off: back to one of them.
                let (distance, normal) = sites[0].carrier_distance(next);
                next += normal * (self.d - distance);
            }
            let after = residuals(next);
            let converges = worst(&after) < 0.5 * worst(&now) && self.may_hold(edge, next);
            if !converges {
                break;
            }
            (c, now) = (next, after);
        }
        c
    }
}

/// Whether a foot with its normal lies between the ends of a piece.
fn spans(piece: &Piece, site: &Site, foot: Point, normal: Vector) -> bool {
    let (from, to) = (&piece.from, &piece.to);
    if site.is_vertex {
        // The normals round a reflex vertex turn clockwise.
        return from.normal.cross(normal) < 0.0 && normal.cross(to.normal) < 0.0;
    }
    (foot - from.point).dot(from.normal.right()) > 0.0 && (foot - to.point).dot(to.normal.right()) < 0.0
}
