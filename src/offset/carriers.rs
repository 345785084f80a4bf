//! How far a place is from the carriers on both sides of an edge.
//!
//! **Guarantees** what [`Site::carrier_distance`] gives for each, to the last bit.
//!
//! **Method.** The two sides lie in the two lanes of vectors, and what is asked of a vertex, a segment and an
//! arc is the same but for a choice at the end. So nothing hangs on a guess of the processor, which goes on
//! with the next place before it has finished one: roots and quotients are most of the work.

use crate::geom::{Point, Vector, vector};
use crate::mat::{Foot, Site};
use wide::f64x2;

/// The lines, circles or vertices on both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carriers {
    /// Where the sites begin and end; a vertex begins twice.
    ends: [Feet; 2],
    curvature: f64x2,
    /// All bits are set in the lane of a vertex.
    is_vertex: f64x2,
}

/// A foot on either side.
#[derive(Clone, Copy, Debug)]
struct Feet {
    point: [f64x2; 2],
    normal: [f64x2; 2],
}

/// Signed distances and unit normals to both carriers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Below {
    pub distances: [f64; 2],
    pub normals: [Vector; 2],
}

impl Carriers {
    #[inline]
    pub fn of([a, b]: [&Site; 2]) -> Carriers {
        let end = |site: &Site| if site.is_vertex { site.start } else { site.end };
        let curvature = |site: &Site| if site.is_vertex { 0.0 } else { site.curvature };
        let bits = |site: &Site| f64::from_bits(u64::from(site.is_vertex).wrapping_neg());
        Carriers {
            ends: [Feet::of([a.start, b.start]), Feet::of([end(a), end(b)])],
            curvature: f64x2::new([curvature(a), curvature(b)]),
            is_vertex: f64x2::new([bits(a), bits(b)]),
        }
    }

    /// The sides of a place.
    #[inline]
    pub fn below(&self, c: Point) -> Below {
        let [cx, cy] = [c.x, c.y].map(f64x2::splat);
        let [start, end] = &self.ends;
        let [to_start, to_end] = [start, end].map(|f| [cx - f.point[0], cy - f.point[1]]);
        let squared = |[x, y]: [f64x2; 2]| x * x + y * y;
        let is_start = squared(to_start).simd_le(squared(to_end));
        let nearer = |a: [f64x2; 2], b: [f64x2; 2]| [0, 1].map(|i| is_start.bitselect(a[i], b[i]));
        let w = nearer(to_start, to_end);
        let n = nearer(start.normal, end.normal);
        let k = self.curvature;
        let g = [0, 1].map(|i| self.is_vertex.bitselect(w[i], n[i] - w[i] * k));
        let length = squared(g).sqrt();
        let dot = w[0] * n[0] + w[1] * n[1];
        let distance = (dot * 2.0 - k * squared(w)) / (length + 1.0);
        let is_long = length.simd_gt(f64x2::ZERO);
        let [x, y] = [0, 1].map(|i| is_long.bitselect(g[i] / length, n[i]).to_array());
        let distances = self.is_vertex.bitselect(length, distance).to_array();
        Below { distances, normals: [vector(x[0], y[0]), vector(x[1], y[1])] }
    }
}

impl Feet {
    #[inline]
    fn of([a, b]: [Foot; 2]) -> Feet {
        let lanes = |a: [f64; 2], b: [f64; 2]| [f64x2::new([a[0], b[0]]), f64x2::new([a[1], b[1]])];
        Feet { point: lanes(a.point.into(), b.point.into()), normal: lanes(a.normal.into(), b.normal.into()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::{Pocket, Tolerance};

    #[test]
    fn both_sides_are_what_each_site_tells_alone() {
        let outer = ArcSpline::closed([(0.0, 0.0, 0.0), (8.0, 0.0, 0.3), (9.0, 7.0, -0.2), (1.0, 6.0, 0.0)]);
        let island = ArcSpline::closed([(3.0, 2.0, 0.0), (3.0, 4.0, 0.5), (5.0, 3.0, 0.0)]);
        let mat = Pocket::from_loops(vec![outer, island], Tolerance::MM).unwrap().medial_axis().unwrap();
        let places =
            (-4..=4).flat_map(|i| (-4..=4).map(move |j| point(0.1 * f64::from(i), 0.1 * f64::from(j))));
        let places: Vec<Point> = places.chain(mat.sites.iter().map(|s| s.start.point)).collect();
        for (a, b) in mat.sites.iter().flat_map(|a| mat.sites.iter().map(move |b| (a, b))) {
            for &c in &places {
                let below = Carriers::of([a, b]).below(c);
                for (i, site) in [a, b].into_iter().enumerate() {
                    assert_eq!((below.distances[i], below.normals[i]), site.carrier_distance(c), "{site:?}");
                }
            }
        }
    }
}
