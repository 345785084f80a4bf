//! Where the spoke of a place meets the axis.
//!
//! **Needs** the roads of an axis. **Guarantees** the spot in which the straight way from the wall through
//! a place ends, and the side of its edge that the place lies on. **Does not** decide where round-off
//! hides it.
//!
//! **Method.** The wall nearest to the place knows the pieces of the axis along it, in its order; the spoke
//! meets the edge of the piece that holds its foot.

use super::roads::{Roads, Spot};
use crate::geom::{Point, Vector};
use crate::mat::{NONE, falling_root};

/// Round-off of a place on the axis, relative to the coordinates: vertices are solved to about this
/// accuracy.
const PLACE_ERROR: f64 = 16384.0 * f64::EPSILON;

impl Roads<'_> {
    /// Where the spoke of a place meets the axis, and on which side of that edge the place lies.
    /// `None` where round-off hides it.
    pub fn foot(&self, p: Point) -> Option<(Spot, usize)> {
        let c = self.mat.frame.enter(p);
        let site = self.mat.nearest_site(c);
        let s = &self.mat.sites[site as usize];
        // At a joint neighbors are as near, and a corner may be more than one site.
        let around = [site, s.prev, s.next];
        let sites = &self.mat.sites;
        let farther = [sites[s.prev as usize].prev, sites[s.next as usize].next];
        let near = around.into_iter().chain(farther);
        let mut feet = near.flat_map(|site| self.feet_beside(site, p)).peekable();
        // At a seam of the boundary there may be pieces without length that lead elsewhere; at the end of
        // the axis every direction is that of a spoke.
        let first = feet.peek().copied();
        feet.find(|&(spot, side)| self.is_foot(spot, side, p)).or(first)
    }

    /// Whether the spoke that ends in a spot passes through a place.
    fn is_foot(&self, spot: Spot, side: usize, p: Point) -> bool {
        let d = self.distance(spot.edge, side, p);
        let through = self.on_spoke(spot.edge, side, self.place(spot), d);
        through.distance(p) <= PLACE_ERROR * p.x.abs().max(p.y.abs())
    }

    /// The same for places whose foot is on this site.
    fn feet_beside(&self, site: u32, p: Point) -> Vec<(Spot, usize)> {
        let s = &self.mat.sites[site as usize];
        let c = self.mat.frame.enter(p);
        let (distance, normal) = s.carrier_distance(c);
        let position = s.position(&crate::mat::Foot { point: c - normal * distance, normal });
        let after = self.by_site.partition_point(|&(of, at, _)| (of, at) <= (site, position));
        let range = after.saturating_sub(2)..(after + 1).min(self.by_site.len());
        let near = self.by_site[range].iter().filter(|(of, ..)| *of == site);
        near.filter_map(|&(_, _, piece)| self.meet(piece, p, normal)).collect()
    }

    /// Where the ray from a place along a normal meets the edge of a piece.
    fn meet(&self, piece: u32, p: Point, normal: Vector) -> Option<(Spot, usize)> {
        let edge = self.mat.graph.pieces[piece as usize].edge;
        if edge == NONE {
            return self.leaf_of(piece);
        }
        let aside = |t: f64| (self.place(Spot { edge, t }) - p).cross(normal);
        let (start, end) = (aside(0.0), aside(1.0));
        // At a joint the sign is round-off, or there is none; the ray behind the place does not count.
        let slack = PLACE_ERROR * p.x.abs().max(p.y.abs());
        let is_ahead = |t: f64| (self.place(Spot { edge, t }) - p).dot(normal) >= -slack;
        let joint = [(0.0, start), (1.0, end)].into_iter().find(|&(t, a)| a.abs() <= slack && is_ahead(t));
        let t = match joint {
            Some((t, _)) => t,
            None if start * end < 0.0 => falling_root(0.0, 1.0, |t| aside(t) / start),
            None => return None,
        };
        if !is_ahead(t) {
            return None;
        }
        let side = usize::from(self.mat.graph.edges[edge as usize].pieces[1] == piece);
        Some((Spot { edge, t }, side))
    }

    /// The end of the axis round which a piece is a contact arc.
    fn leaf_of(&self, piece: u32) -> Option<(Spot, usize)> {
        let pieces = &self.mat.graph.pieces;
        if pieces[piece as usize].left_out {
            return None;
        }
        let mut at = pieces[piece as usize].next;
        while at != piece && at != NONE && pieces[at as usize].edge == NONE {
            at = pieces[at as usize].next;
        }
        let edge = pieces.get(at as usize).map_or(NONE, |p| p.edge);
        if edge == NONE {
            return None;
        }
        // The piece starts in the disk of the leaf: the first one runs with the edge, the other against.
        let side = usize::from(self.mat.graph.edges[edge as usize].pieces[1] == at);
        Some((Spot { edge, t: side as f64 }, side))
    }
}

#[cfg(test)]
mod tests {
    use super::super::roads::tests::plate;
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::{Pocket, Tolerance};

    #[test]
    fn a_spoke_ends_on_the_axis_at_the_distance_of_its_radius() {
        let mat = plate();
        let roads = Roads::new(&mat);
        let mut found = 0;
        for i in 0..60 {
            for j in 0..40 {
                let p = point(f64::from(i) + 0.37, f64::from(j) + 0.59);
                let d = mat.distance(p);
                // Inside of an island the distance is one to the wall as well.
                let Some((spot, side)) = roads.foot(p).filter(|_| d > 0.1) else { continue };
                let (center, r) = (roads.place(spot), roads.radius(spot));
                if r < d || !mat.is_clear(&crate::Element::segment(p, center), d) {
                    continue;
                }
                assert!((center.distance(p) - (r - d)).abs() < 1e-9, "{p} {center}");
                assert!(roads.on_spoke(spot.edge, side, center, d).distance(p) < 1e-9);
                assert!((mat.distance(center) - r).abs() < 1e-9);
                found += 1;
            }
        }
        assert!(found > 1800, "{found}");
    }

    #[test]
    fn the_spoke_of_a_joint_ends_at_the_joint() {
        // Joints of the axis at 8.5 from the center, on the spokes of the ends of the arcs drawn.
        let outer = ArcSpline::closed([
            (24.0, 37.0, 0.414_213_562_373_095_1),
            (12.0, 25.0, 1.0),
            (36.0, 25.0, 0.414_213_562_373_095_1),
        ]);
        let hole = ArcSpline::circle(point(24.0, 25.0), 5.0).reversed();
        let mat = Pocket::from_loops(vec![outer, hole], Tolerance::MM).unwrap().medial_axis().unwrap();
        let roads = Roads::new(&mat);
        for (x, y) in [(0.0, 1.0), (-1.0, 0.0), (1.0, 0.0), (0.0, -1.0)] {
            for d in [3.0, 3.25] {
                let at = |r: f64| point(24.0 + r * x, 25.0 + r * y);
                for p in [at(12.0 - d), at(5.0 + d)] {
                    let (spot, _) = roads.foot(p).unwrap();
                    let place = roads.place(spot);
                    assert!(place.distance(at(8.5)) < 1e-9, "{p}: {place} {spot:?} {:?}", roads.vertices);
                }
            }
        }
    }
}
