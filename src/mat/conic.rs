//! Edges of the axis as rational quadratic Bezier curves.
//!
//! The bisector of two sites is a line or an arc of a conic, and its tangent bisects the two
//! normals. Both normals turn by a quarter at most along an edge, and so does the tangent: one
//! Bezier with end weights 1 and a positive middle weight holds the whole edge. Its control points
//! are the ends and the meet of the end tangents; its weight follows from one more point `S` of the
//! edge, whose barycentric coordinates obey `l1^2 = 4 w^2 l0 l2`.

use super::graph::{Graph, GraphEdge};
use super::piece::{Piece, UnitDisk};
use super::site::Site;
use super::track::inner_disk;
use crate::geom::{Point, Vector};

/// Control points and middle weight, in the unit frame.
pub(super) fn bezier(sites: &[Site], graph: &Graph, edge: &GraphEdge) -> ([Point; 3], f64) {
    let [u, v] = edge.disks.map(|d| graph.disks[d as usize].center);
    let straight = ([u, u.midpoint(v), v], 1.0);
    let [a, b] = edge.pieces.map(|p| graph.piece(sites, p));
    let is_straight = |p: &Piece| sites[p.site as usize].is_straight();
    if is_straight(&a) && is_straight(&b) || both_vertices(sites, &a, &b) {
        return straight;
    }
    let tangent = |n_a: Vector, n_b: Vector| (n_a - n_b).right();
    let (tu, tv) = (tangent(a.from.normal, b.to.normal), tangent(a.to.normal, b.from.normal));
    let chord = v - u;
    let along = chord.cross(tv) / tu.cross(tv);
    let middle = u + tu * along;
    // The tangent turns by a quarter at most, so the control point lies between the ends. Where it
    // does not, or where the triangle is as flat as a disk is uncertain, round-off bent a straight
    // edge: the bisector of two equal circles, say.
    let between = (middle - u).dot(chord) / chord.length_squared();
    let height = (middle - u).cross(chord).abs() / chord.length();
    if !(between > 0.0 && between < 1.0 && height > graph.error) {
        return straight;
    }
    let Some(UnitDisk { center: s, .. }) = inner_disk(sites, [&a, &b], graph.error) else { return straight };
    // Barycentric coordinates of S in the control triangle, each a ratio of areas.
    let (p0, p2) = (u - middle, v - middle);
    let area = p0.cross(p2);
    let q = s - middle;
    let (l0, l2) = (q.cross(p2) / area, p0.cross(q) / area);
    let l1 = 1.0 - l0 - l2;
    let weight = l1 / (2.0 * (l0 * l2).sqrt());
    let good = l0 > 0.0 && l1 > 0.0 && l2 > 0.0 && weight.is_finite();
    if good { ([u, middle, v], weight) } else { straight }
}

fn both_vertices(sites: &[Site], a: &Piece, b: &Piece) -> bool {
    sites[a.site as usize].is_vertex && sites[b.site as usize].is_vertex
}
