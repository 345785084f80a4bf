//! Which pocket lies in an island of which.
//!
//! **Needs** pockets that do not overlap; they may touch. **Guarantees** for each pocket the one that
//! it lies in, as near as can be. **Does not** compare pockets two by two.
//!
//! **Method.** A ray to the left from a wall meets, of the loops of larger pockets, the nearest one. If
//! that is an island, the pocket lies in it; if it is a wall, the two pockets lie side by side in the
//! same island.

use super::ray::{Rays, turned};
use super::simple::inner_place;
use super::{Pocket, Pockets};

impl Pockets {
    /// For each pocket the number of the pocket in one of whose islands it lies; `None` for those that
    /// lie in no other.
    pub fn parents(&self) -> Vec<Option<usize>> {
        let pockets = &self.pockets;
        let mut order: Vec<(f64, usize)> = pockets.iter().map(|p| p.outer().area()).zip(0..).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut rank = vec![0; pockets.len()];
        for (place, &(_, pocket)) in order.iter().enumerate() {
            rank[pocket] = place;
        }
        let loops: Vec<(usize, bool)> = pockets
            .iter()
            .enumerate()
            .flat_map(|(i, p)| (0..p.loops().len()).map(move |l| (i, l > 0)))
            .collect();
        let rays = Rays::new(pockets.iter().flat_map(Pocket::loops).enumerate());
        let mut parents = vec![None; pockets.len()];
        for &(_, pocket) in &order {
            let place = turned(inner_place(pockets[pocket].outer()));
            let is_smaller = |l: usize| rank[loops[l].0] >= rank[pocket];
            let Some(hit) = rays.first(place, is_smaller) else { continue };
            let (other, is_island) = loops[hit.owner];
            // Seen from within the other pocket, the wall is a common one of the two.
            let in_island =
                is_island || (hit.from_left && has_island_around(&pockets[other], &pockets[pocket]));
            parents[pocket] = if in_island { Some(other) } else { parents[other] };
        }
        parents
    }
}

fn has_island_around(pocket: &Pocket, inner: &Pocket) -> bool {
    let inner = inner.bounds();
    let around = |island: &crate::geom::ArcSpline| {
        let bounds = island.bounds();
        bounds.contains(inner.min) && bounds.contains(inner.max)
    };
    pocket.islands().iter().any(around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Curve;
    use crate::geom::{ArcSpline, point};
    use crate::tolerance::Tolerance;

    fn parents(paths: Vec<ArcSpline>) -> Vec<Option<usize>> {
        let curves: Vec<Curve> = paths.into_iter().map(Curve::from).collect();
        Pockets::from_curves(&curves, Tolerance::MM).unwrap().parents()
    }

    #[test]
    fn circles_in_circles_are_a_chain_of_pockets() {
        let circles = [1.0, 3.0, 2.0, 6.0, 5.0].map(|r| ArcSpline::circle(point(0.0, 0.0), r));
        // The pockets are those between 6 and 5, 3 and 2, and the innermost disk.
        assert_eq!(parents(circles.to_vec()), [Some(1), Some(2), None]);
    }

    #[test]
    fn pockets_side_by_side_in_an_island_have_one_parent() {
        let square = |x: f64, y: f64, a: f64| {
            ArcSpline::closed([(x, y, 0.0), (x + a, y, 0.0), (x + a, y + a, 0.0), (x, y + a, 0.0)])
        };
        let all = vec![
            square(0.0, 0.0, 100.0),
            square(10.0, 10.0, 80.0),
            square(20.0, 20.0, 20.0),
            square(40.0, 20.0, 20.0),
            square(70.0, 70.0, 5.0),
            square(200.0, 0.0, 10.0),
        ];
        assert_eq!(parents(all), [None, Some(0), Some(0), Some(0), None]);
    }
}
