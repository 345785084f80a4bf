//! How far it is along the axis from a place between two levels to the inner one.
//!
//! **Needs** the axis and the levels. **Guarantees** a length that is never too short; infinite where
//! every way that rises ends before. **Does not** look for ways that fall before they rise.
//!
//! **Method.** The radius is monotone along each edge, so vertices from the highest down know the way from
//! the other ends of the edges that rise from them. An edge is no longer than its control polygon.

use super::crest::{Part, Reach};
use super::roads::Roads;
use crate::mat::NONE;
use rayon::prelude::*;

/// The ways up to the next level from the vertices of an axis.
pub(super) struct Ascents<'a> {
    roads: &'a Roads<'a>,
    reach: &'a Reach<'a>,
    from: Vec<f64>,
}

/// From where an edge rises, how far, and the vertex at which the way goes on if it is not at the next level
/// before.
struct Way {
    from: u32,
    length: f64,
    on: Option<u32>,
}

impl<'a> Ascents<'a> {
    /// From all vertices.
    pub fn new(roads: &'a Roads, reach: &'a Reach) -> Ascents<'a> {
        let radius = |v: u32| roads.vertices[v as usize].1;
        let mut from_the_highest: Vec<u32> = (0..roads.vertices.len() as u32).collect();
        from_the_highest.sort_unstable_by(|a, b| radius(*b).total_cmp(&radius(*a)).then(a.cmp(b)));
        let mut ascents = Ascents { roads, reach, from: vec![f64::INFINITY; roads.vertices.len()] };
        let edges = (0..roads.edge_count()).into_par_iter();
        let ways: Vec<Way> = edges.map(|edge| ascents.along(edge)).collect();
        for v in from_the_highest {
            let rising = roads.at(v).iter().map(|&edge| &ways[edge as usize]).filter(|way| way.from == v);
            let lengths = rising.map(|way| way.length + way.on.map_or(0.0, |on| ascents.from[on as usize]));
            ascents.from[v as usize] = lengths.fold(f64::INFINITY, f64::min);
        }
        ascents
    }

    /// From the lower end of an edge, if there is one, to the next level or the other end.
    fn along(&self, edge: u32) -> Way {
        let (ends, radii) = (self.roads.ends(edge), self.roads.radii(edge));
        let end = usize::from(radii[1] < radii[0]);
        let from = if radii[0] == radii[1] { NONE } else { ends[end] };
        let top = self.reach.top(self.reach.first_level(radii[end]));
        if radii[1 - end] < top {
            return Way { from, length: self.polygon(edge, [0.0, 1.0]), on: Some(ends[1 - end]) };
        }
        let t = self.roads.spot_of_radius(edge, top).t;
        Way { from, length: self.polygon(edge, if end == 0 { [0.0, t] } else { [t, 1.0] }), on: None }
    }

    /// From any place of a part between two levels.
    pub fn of(&self, part: &Part) -> f64 {
        let radii = self.roads.radii(part.edge);
        let end = usize::from(radii[1] > radii[0]);
        let rest = if radii[end] >= self.reach.top(part.level) {
            0.0
        } else {
            self.from[self.roads.ends(part.edge)[end] as usize]
        };
        self.polygon(part.edge, part.t) + rest
    }

    /// Length of the control polygon of a stretch.
    fn polygon(&self, edge: u32, [from, to]: [f64; 2]) -> f64 {
        let [a, b, c] = self.roads.hull(edge, from, to);
        a.distance(b) + b.distance(c)
    }
}

#[cfg(test)]
mod tests {
    use super::super::nest::Nest;
    use super::*;
    use crate::geom::ArcSpline;
    use crate::{Pocket, Tolerance};

    #[test]
    fn in_a_rectangle_the_way_from_a_corner_is_that_along_the_diagonal() {
        let outline = [(0.0, 0.0, 0.0), (40.0, 0.0, 0.0), (40.0, 20.0, 0.0), (0.0, 20.0, 0.0)];
        let pocket = Pocket::from_loops(vec![ArcSpline::closed(outline)], Tolerance::MM).unwrap();
        let mat = pocket.medial_axis().unwrap();
        let roads = Roads::new(&mat);
        let levels = [4.0, 8.0].map(|d| mat.level(d));
        let nest = Nest::new(&levels, 1e-9);
        let reach = Reach { levels: &levels, nest: &nest, tool_radius: 5.0, flat: 1e-3, slack: 1e-9 };
        let ascents = Ascents::new(&roads, &reach);
        // From the corners to 8 from the wall; from inside of the last level there is no way up.
        for (&(_, radius), way) in roads.vertices.iter().zip(&ascents.from) {
            let diagonal = 8.0 * 2f64.sqrt();
            assert!(if radius == 0.0 { (way - diagonal).abs() < 1e-9 } else { *way == f64::INFINITY });
        }
        let parts = reach.between_levels(&roads, |_, _| false);
        let of_level = |k| parts.iter().filter(move |p: &&Part| p.level == k);
        assert!(of_level(0).all(|p| (ascents.of(p) - 4.0 * 2f64.sqrt()).abs() < 1e-9));
        assert!(of_level(1).count() > 0 && of_level(1).all(|p| ascents.of(p) == f64::INFINITY));
    }
}
