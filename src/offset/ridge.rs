//! Ridges: where the distance is attained and no area remains.

use super::trace::Tracer;
use crate::geom::{ArcSpline, Vertex};
use crate::mat::Mat;
use std::collections::BTreeMap;

/// A ridge, in job units.
pub(super) struct Ridge {
    pub spline: ArcSpline,
    /// How many of its ends lead nowhere: neither to a loop nor to another ridge.
    pub free_ends: u32,
}

/// A way along a ridge: an edge of the axis, and whether it is run from its end to its start.
#[derive(Clone, Copy)]
struct Way {
    edge: u32,
    backward: bool,
    to: u32,
}

impl Tracer<'_> {
    fn is_at(&self, vertex: u32) -> bool {
        self.is_equal(self.mat.graph.disks[vertex as usize].radius)
    }

    /// The ridges: paths between their branchings and ends, rings, single places.
    pub fn ridges(&self) -> Vec<Ridge> {
        let mut ways: BTreeMap<u32, Vec<Way>> = BTreeMap::new();
        let mut beside: Vec<u32> = Vec::new();
        for &edge in &self.edges_at {
            let [a, b] = self.mat.graph.edges[edge as usize].disks;
            match [a, b].map(|v| self.is_at(v)) {
                [true, true] => {
                    ways.entry(a).or_default().push(Way { edge, backward: false, to: b });
                    ways.entry(b).or_default().push(Way { edge, backward: true, to: a });
                }
                [true, false] if self.is_inside(b) => beside.push(a),
                [false, true] if self.is_inside(a) => beside.push(b),
                _ => {}
            }
        }
        beside.sort_unstable();
        let mut ridges = self.chains(&ways, &beside);
        for peak in self.mat.radii().peaks_at(self.d) {
            if !ways.contains_key(&peak) && beside.binary_search(&peak).is_err() {
                let point = self.mat.frame.leave(self.mat.graph.disks[peak as usize].center);
                let spline = ArcSpline { vertices: vec![Vertex { point, bulge: 0.0 }], closed: false };
                ridges.push(Ridge { spline, free_ends: 2 });
            }
        }
        ridges
    }

    fn chains(&self, ways: &BTreeMap<u32, Vec<Way>>, beside: &[u32]) -> Vec<Ridge> {
        let is_free = |end: u32| ways[&end].len() == 1 && beside.binary_search(&end).is_err();
        let mut done = std::collections::HashSet::new();
        let mut ridges = Vec::new();
        // From ends and branchings first; what is left over are rings.
        let ends = ways.iter().filter(|(_, w)| w.len() != 2);
        for (&start, from) in ends.chain(ways.iter()) {
            for &first in from {
                if !done.insert(first.edge) {
                    continue;
                }
                let mut vertices = vec![self.vertex(start, first)];
                let mut way = first;
                while way.to != start && ways[&way.to].len() == 2 {
                    let here = way.to;
                    let Some(&onward) = ways[&here].iter().find(|w| !done.contains(&w.edge)) else { break };
                    done.insert(onward.edge);
                    vertices.push(self.vertex(here, onward));
                    way = onward;
                }
                let closed = way.to == start;
                if !closed {
                    let point = self.mat.frame.leave(self.mat.graph.disks[way.to as usize].center);
                    vertices.push(Vertex { point, bulge: 0.0 });
                }
                let free_ends = u32::from(is_free(start)) + u32::from(is_free(way.to));
                ridges.push(Ridge { spline: ArcSpline { vertices, closed }, free_ends });
            }
        }
        ridges
    }

    /// A vertex of a ridge with the bulge of the way that leaves it.
    fn vertex(&self, at: u32, way: Way) -> Vertex {
        let here = self.mat.graph.disks[at as usize].center;
        let bulge = parallel_bulge(self.mat, way.edge, way.backward).unwrap_or(0.0);
        Vertex { point: self.mat.frame.leave(here), bulge }
    }
}

/// The bulge of an edge of the axis along which the radius is constant, as it is between parallel
/// walls; `None` where it is not. There the axis is the offset of its sites, and turns with their
/// normals.
pub(crate) fn parallel_bulge(mat: &Mat, edge: u32, backward: bool) -> Option<f64> {
    let edge = &mat.graph.edges[edge as usize];
    let [here, there] = edge.disks.map(|d| &mat.graph.disks[d as usize]);
    if (here.radius - there.radius).abs() > 2.0 * mat.graph.error {
        return None;
    }
    let piece = mat.graph.piece(&mat.sites, edge.pieces[usize::from(backward)]);
    let site = &mat.sites[piece.site as usize];
    let turn = piece.from.normal.angle_to(piece.to.normal);
    let radius = if site.is_vertex { here.radius } else { (site.curvature.recip() - here.radius).abs() };
    let arc_chord = (2.0 * radius * (0.5 * turn).sin()).abs();
    // Edges as short as round-off may have any normals; only what is an arc is made one.
    let is_arc = (arc_chord - here.center.distance(there.center)).abs() <= 0.5 * arc_chord;
    Some(if is_arc && radius.is_finite() { (0.25 * turn).tan() } else { 0.0 })
}
