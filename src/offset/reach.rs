//! What a round tool can reach.

use super::crossing::Entry;
use super::ridge::Ridge;
use super::trace::{Stretch, Tracer};
use super::united::{Facing, overlap};
use crate::geom::{ArcSpline, Element, Point, Vector, Vertex};
use crate::mat::{Mat, Sets};
use std::f64::consts::{PI, TAU};

impl Mat {
    /// Area of the pocket that a disk of this radius, moved inside, cannot reach, in square job units.
    /// Exact to round-off; NaN where the axis is not whole, which does not tell.
    pub fn unreachable_area(&self, radius: f64) -> f64 {
        if self.least_radius() > 0.0 {
            return f64::NAN;
        }
        let whole = self.area();
        let unit = self.frame.length_in(radius);
        if unit.is_nan() || unit <= 0.0 {
            return 0.0;
        }
        if unit > 1.0 {
            return whole;
        }
        let tracer = Tracer::new(self, unit);
        let loops: f64 = tracer.walks(|walk| Some(tracer.outline(walk).area())).iter().sum();
        let scale = self.frame.length_out(1.0);
        let overlap = tracer.overlap();
        let ridges: f64 = tracer.ridges().iter().map(|ridge| ridge_area(ridge, radius)).sum();
        (whole - (loops - overlap) * scale * scale - ridges).clamp(0.0, whole)
    }

    /// Area of the pocket.
    fn area(&self) -> f64 {
        let sites = self.sites.iter().filter(|s| !s.is_vertex);
        let origin = Point::default();
        let unit: f64 = sites
            .map(|s| {
                let half = 0.25 * s.start.normal.angle_to(s.end.normal);
                Element::arc(s.start.point, s.end.point, if s.curvature == 0.0 { 0.0 } else { half.tan() })
                    .area(origin)
            })
            .sum();
        let scale = self.frame.length_out(1.0);
        unit * scale * scale
    }
}

/// Area swept by a disk along a ridge: twice the radius times the length, and half a disk at each end
/// that leads nowhere. (At an end on a loop, what the loop reaches covers as much of the slot.)
fn ridge_area(ridge: &Ridge, radius: f64) -> f64 {
    2.0 * radius * ridge.spline.length() + 0.5 * PI * radius * radius * f64::from(ridge.free_ends)
}

impl Tracer<'_> {
    /// The outline of what a disk of radius `d` sweeps with its center inside of a walk: the stretches
    /// of the boundary, joined by arcs of the disk about the crossings.
    fn outline(&self, walk: &[Stretch]) -> ArcSpline {
        let mut vertices = Vec::with_capacity(2 * walk.len());
        let nexts = walk[1..].iter().chain(&walk[..1]);
        for (stretch, next) in walk.iter().zip(nexts) {
            if !self.site(self.stop(stretch.last)).is_vertex {
                let point = self.from(stretch).point;
                vertices.push(Vertex { point, bulge: stretch.bulge });
            }
            if next.at_crossing {
                let to = self.to(stretch, next);
                let turn = facing_turn(to.normal, self.from(next).normal);
                vertices.push(Vertex { point: to.point, bulge: (0.25 * turn).tan() });
            }
        }
        ArcSpline { vertices, closed: true }
    }

    /// Area that is reached more than once where the ends of an unreachable place face each other.
    fn overlap(&self) -> f64 {
        let mut place_of: std::collections::BTreeMap<u32, Vec<Facing>> = std::collections::BTreeMap::new();
        let outside = self.outside_components();
        let mut entries: Vec<&Entry> = self.entries.iter().collect();
        entries.sort_unstable_by_key(|entry| entry.edge);
        for &Entry { stop, edge, center, .. } in entries {
            let (entering, way) = (self.stop(stop), self.way(stop));
            let leaving = self.stop(way.across);
            let [to, from] = [leaving, entering].map(|stop| self.foot_below(stop, center).normal);
            let arc = Facing { center, from: (-to.y).atan2(-to.x), sweep: facing_turn(to, from) };
            let lower = self.mat.graph.edges[edge as usize].disks[usize::from(way.backward)];
            place_of.entry(outside[lower as usize]).or_default().push(arc);
        }
        place_of.values().map(|arcs| overlap(arcs, self.d, self.mat.graph.error)).sum()
    }

    /// Component of the axis with radius up to `d` that each vertex lies in.
    fn outside_components(&self) -> Vec<u32> {
        let graph = &self.mat.graph;
        let mut outside = Sets::singles(graph.disks.len());
        for edge in &graph.edges {
            let [a, b] = edge.disks;
            if !self.is_inside(a) && !self.is_inside(b) {
                outside.unite(a, b);
            }
        }
        (0..graph.disks.len() as u32).map(|i| outside.find(i)).collect()
    }
}

/// Angle of the arc about a crossing, on the side where the radius falls: a half turn at most, as both
/// feet lie ahead. Round-off may have made it a little less than nothing, or more than a half turn.
fn facing_turn(from: Vector, to: Vector) -> f64 {
    let turn = from.angle_to(to);
    if turn < -0.5 * PI { turn + TAU } else { turn.max(0.0) }
}
