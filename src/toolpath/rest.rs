//! Where material remains that the tool cannot reach.
//!
//! **Needs** the axis of a pocket and the distance of the wall passes.
//! **Guarantees** one place for each connected part of the axis that is nearer to the wall than the
//! tool can come, and how far from it the tool stays.
//! **Does not** tell areas; `Mat::unreachable_area` has their sum.
//!
//! **Method.** Such a part hangs on the rest of the axis where the radius is that distance: there the
//! tool stands as it comes nearest. From all those spots at once breadth first over the part, each
//! vertex goes by the spot it is reached from; the place is the vertex whose disk ends farthest from it.

use super::roads::Roads;
use crate::geom::Point;
use crate::mat::Sets;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// As many places as are told of.
const MAX_PLACES: usize = 1000;

/// A place that the tool cannot reach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// The place on the axis: a corner of the wall, or the end of a narrow part.
    pub at: Point,
    /// How far the material there reaches beyond the tool, in job units.
    pub height: f64,
}

/// The places where material remains, the highest first; only those higher than `least`.
pub(super) fn rest(roads: &Roads, distance: f64, least: f64) -> Vec<Rest> {
    let n = roads.vertices.len();
    let is_low = |v: u32| roads.vertices[v as usize].1 < distance;
    let edges = (0..roads.edge_count()).into_par_iter().map(|edge| (edge, roads.ends(edge)));
    let crossed: Vec<(u32, Point)> = edges
        .filter(|(_, [a, b])| is_low(*a) != is_low(*b))
        .map(|(edge, [a, b])| {
            let low = if is_low(a) { a } else { b };
            (low, roads.place(roads.spot_of_radius(edge, distance)))
        })
        .collect();
    let (mut nearest, mut queue, mut parts) = (vec![None; n], VecDeque::new(), Sets::singles(n));
    for [a, b] in (0..roads.edge_count()).map(|edge| roads.ends(edge)) {
        if is_low(a) && is_low(b) {
            parts.unite(a, b);
        }
    }
    for (low, spot) in crossed {
        nearest[low as usize] = Some(spot);
        queue.push_back(low);
    }
    let mut highest: Vec<Option<Rest>> = vec![None; n];
    while let Some(v) = queue.pop_front() {
        let Some(spot) = nearest[v as usize] else { continue };
        let (at, radius) = roads.vertices[v as usize];
        let height = at.distance(spot) + radius - distance;
        let highest = &mut highest[parts.find(v) as usize];
        if highest.is_none_or(|known| known.height < height) {
            *highest = Some(Rest { at, height });
        }
        for other in roads.at(v).iter().flat_map(|&edge| roads.ends(edge)).filter(|&other| is_low(other)) {
            if nearest[other as usize].is_none() {
                nearest[other as usize] = Some(spot);
                queue.push_back(other);
            }
        }
    }
    let mut found: Vec<Rest> = highest.into_iter().flatten().filter(|r| r.height > least).collect();
    found.sort_by(|a, b| b.height.total_cmp(&a.height));
    found.truncate(MAX_PLACES);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::{Pocket, Tolerance};

    fn found(outline: ArcSpline, distance: f64) -> Vec<Rest> {
        let mat = Pocket::from_loops(vec![outline], Tolerance::MM).unwrap().medial_axis().unwrap();
        rest(&Roads::new(&mat), distance, 1e-6)
    }

    #[test]
    fn a_square_has_its_four_corners() {
        let square =
            ArcSpline::closed([(0.0, 0.0, 0.0), (20.0, 0.0, 0.0), (20.0, 20.0, 0.0), (0.0, 20.0, 0.0)]);
        let rest = found(square, 3.0);
        assert_eq!(rest.len(), 4);
        let height = 3.0 * (2f64.sqrt() - 1.0);
        assert!(rest.iter().all(|r| (r.height - height).abs() < 1e-9));
        assert!(rest.iter().any(|r| r.at.distance(point(20.0, 20.0)) < 1e-9));
    }

    #[test]
    fn a_round_hole_has_none_and_a_narrow_bay_one() {
        assert!(found(ArcSpline::circle(point(0.0, 0.0), 9.0), 3.0).is_empty());
        // A bay 4 wide and 10 deep in the side of a square with a corner at its end, for a tool of 6.
        let outline = ArcSpline::closed([
            (0.0, 0.0, 0.0),
            (30.0, 0.0, 0.0),
            (30.0, 13.0, 0.0),
            (40.0, 13.0, 0.0),
            (40.0, 17.0, 0.0),
            (30.0, 17.0, 0.0),
            (30.0, 30.0, 0.0),
            (0.0, 30.0, 0.0),
        ]);
        let rest = found(outline, 3.0);
        assert_eq!(rest.len(), 5);
        assert!(rest[0].at.x > 39.9 && rest[0].height > 9.0, "{:?}", rest[0]);
    }
}
