//! Loops with the inside on their left, sorted into regions.
//!
//! **Needs** loops that do not cross: counter-clockwise round a region, clockwise round a hole in one,
//! as those of a level set. They may touch. **Guarantees** that each hole goes to the smallest
//! counter-clockwise loop around it.
//!
//! **Method.** A ray from the hole to the left hits a loop an odd number of times if that is around
//! the hole. It starts within an element of the hole, at no end and no middle of it, as that is
//! where loops touch; the work is in proportion to the loops that it meets.

use crate::boundary::{Rays, turned};
use crate::error::{Defect, Error};
use crate::geom::ArcSpline;

/// Where in its element the ray starts, a share of the length that no drawing prefers.
const START: f64 = 0.381_966;

/// A counter-clockwise loop and the holes in what it bounds, as indices.
pub(super) struct Region {
    pub outer: usize,
    pub holes: Vec<usize>,
}

/// Sorts loops into regions, in the order of their outer loops.
///
/// # Errors
/// [`Error::Defects`] when a loop is open, encloses nothing, or is a hole in nothing.
pub(super) fn regions(loops: &[ArcSpline]) -> Result<Vec<Region>, Error> {
    let areas: Vec<f64> = loops.iter().map(ArcSpline::area).collect();
    let mut defects: Vec<Defect> = loops.iter().zip(&areas).filter_map(|(l, a)| unusable(l, *a)).collect();
    let outers = (0..loops.len()).filter(|&i| areas[i] > 0.0);
    let mut regions: Vec<Region> = outers.map(|outer| Region { outer, holes: Vec::new() }).collect();
    let rays = Rays::new(loops.iter().enumerate().filter(|(i, _)| areas[*i] > 0.0));
    for hole in (0..loops.len()).filter(|&i| areas[i] < 0.0) {
        match around(&loops[hole], &rays, &areas) {
            Some(outer) => {
                let at = regions.binary_search_by_key(&outer, |r| r.outer);
                regions[at.expect("every outer loop has its region")].holes.push(hole);
            }
            None => {
                let at = loops[hole].vertices[0].point;
                defects.push(Defect::NotOnePocket { count: 0, at });
            }
        }
    }
    if defects.is_empty() { Ok(regions) } else { Err(Error::Defects(defects)) }
}

/// What is wrong with a loop by itself.
fn unusable(spline: &ArcSpline, area: f64) -> Option<Defect> {
    let at = |v: Option<&crate::geom::Vertex>| v.map(|v| v.point).unwrap_or_default();
    let (start, end) = (at(spline.vertices.first()), at(spline.vertices.last()));
    if !spline.closed {
        return Some(Defect::OpenContour { start, end, gap: start.distance(end), inside: false });
    }
    if !area.is_finite() {
        return Some(Defect::Coordinate { at: start });
    }
    (area == 0.0).then_some(Defect::NoArea { at: start })
}

/// The smallest loop around a hole.
fn around(hole: &ArcSpline, rays: &Rays, areas: &[f64]) -> Option<usize> {
    let length = |e: &crate::geom::Element| e.chord().length_squared();
    let widest = hole.elements().max_by(|a, b| length(a).total_cmp(&length(b)))?;
    let mut hits = Vec::new();
    rays.all(turned(widest.point_at(START)), |hit| hits.push(hit.owner));
    hits.sort_unstable();
    let odd = hits.chunk_by(|a, b| a == b).filter(|hits| hits.len() % 2 == 1).map(|hits| hits[0]);
    odd.min_by(|&a, &b| areas[a].total_cmp(&areas[b]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn circle(x: f64, radius: f64) -> ArcSpline {
        ArcSpline::circle(point(x, 0.0), radius)
    }

    fn sorted(loops: &[ArcSpline]) -> Vec<(usize, Vec<usize>)> {
        regions(loops).unwrap().into_iter().map(|r| (r.outer, r.holes)).collect()
    }

    #[test]
    fn holes_go_to_the_region_directly_around_them() {
        let loops =
            [circle(0.0, 2.0).reversed(), circle(0.0, 9.0), circle(0.0, 1.5), circle(0.0, 0.5).reversed()];
        assert_eq!(sorted(&loops), [(1, vec![0]), (2, vec![3])]);
        let beside = [circle(0.0, 2.0), circle(9.0, 3.0), circle(8.0, 1.0).reversed()];
        assert_eq!(sorted(&beside), [(0, vec![]), (1, vec![2])]);
    }

    #[test]
    fn a_hole_that_touches_its_region_is_in_it() {
        let loops = [circle(0.0, 5.0), circle(3.0, 2.0).reversed(), circle(-4.0, 1.0).reversed()];
        assert_eq!(sorted(&loops), [(0, vec![1, 2])]);
    }

    #[test]
    fn faults_are_errors_with_their_places() {
        let defects = |l: ArcSpline| match regions(&[l]) {
            Err(Error::Defects(defects)) => defects,
            _ => panic!("no defect"),
        };
        assert!(matches!(defects(circle(1.0, 1.0).reversed())[..], [Defect::NotOnePocket { count: 0, .. }]));
        assert!(matches!(
            defects(ArcSpline::open([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]))[..],
            [Defect::OpenContour { .. }]
        ));
        assert!(matches!(defects(ArcSpline::closed([(0.0, 0.0, 0.0)]))[..], [Defect::NoArea { .. }]));
        let broken = ArcSpline::closed([(0.0, f64::NAN, 0.0), (1.0, 0.0, 1.0)]);
        assert!(matches!(defects(broken)[..], [Defect::Coordinate { .. }]));
        assert!(regions(&[]).unwrap().is_empty());
    }
}
