//! Several ends that nearly meet in one place.
//!
//! **Needs** clean open paths. **Guarantees** that where three or more ends lie within the reach of
//! joining, and not all of them exactly in one place or in pairs, they lie in one place. **Does
//! not** touch ends that have an exact partner, nor short curves, whose ends are near each other
//! anyway, nor crowds wider than twice the reach.
//!
//! Left to the chaining, such ends would be joined two by two, and chains would cross by less than
//! the reach.

use super::grain::Grain;
use super::index::Index;
use crate::geom::{ArcSpline, Bounds, Point, vector};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Curves shorter than this many reaches have ends that are near each other anyway.
const LONG: f64 = 4.0;

fn bits(p: Point) -> (u64, u64) {
    (p.x.to_bits(), p.y.to_bits())
}

/// Whether every end is exactly in one place with another one.
pub(super) fn all_ends_meet(paths: &[ArcSpline]) -> bool {
    let ends = paths.iter().flat_map(|p| [p.vertices[0].point, p.vertices[p.len()].point]);
    let mut places: Vec<(u64, u64)> = ends.map(bits).collect();
    places.sort_unstable();
    places.chunk_by(|a, b| a == b).all(|group| group.len() > 1)
}

/// Moves the ends of crowds to one place.
pub(super) fn gather(paths: &mut [ArcSpline], join: f64, grain: Grain) {
    let ends: Vec<Point> =
        paths.iter().flat_map(|p| [p.vertices[0].point, p.vertices[p.len()].point]).collect();
    let mut count: HashMap<(u64, u64), usize> = HashMap::with_capacity(ends.len());
    ends.iter().for_each(|&p| *count.entry(bits(p)).or_default() += 1);
    let is_single = |end: usize| count[&bits(ends[end])] == 1 && paths[end / 2].length() > LONG * join;
    let single: Vec<usize> = (0..ends.len()).filter(|&end| is_single(end)).collect();
    if single.is_empty() {
        return;
    }
    let tree = Index::new(&ends.iter().map(|&p| Bounds { min: p, max: p }).collect::<Vec<_>>());
    let mut moved: Vec<(usize, Point)> = Vec::new();
    let mut known: BTreeSet<usize> = BTreeSet::new();
    for &first in &single {
        if !known.contains(&first) {
            let crowd = crowd(first, &ends, &tree, join + grain.same, &is_single, &count);
            known.extend(&crowd);
            let place = meeting_place(&crowd, &ends, join, &count);
            moved.extend(place.into_iter().flat_map(|p| crowd.iter().map(move |&end| (end, p))));
        }
    }
    for (end, place) in moved {
        let path = &mut paths[end / 2];
        let vertex = if end % 2 == 0 { 0 } else { path.len() };
        path.vertices[vertex].point = place;
    }
}

/// All ends that are within reach of an end, or of a single one that is.
fn crowd(
    first: usize,
    ends: &[Point],
    tree: &Index,
    reach: f64,
    is_single: &impl Fn(usize) -> bool,
    count: &HashMap<(u64, u64), usize>,
) -> BTreeSet<usize> {
    let mut crowd = BTreeSet::from([first]);
    let mut open = vec![first];
    while let Some(end) = open.pop() {
        let p = ends[end];
        tree.meeting(&Bounds { min: p, max: p }.grown(reach), |other| {
            let other = other as usize;
            let is_exact = bits(ends[other]) != bits(p) && count[&bits(ends[other])] > 1;
            let takes_part = is_single(other) || is_exact;
            if takes_part && ends[other].distance(p) <= reach && crowd.insert(other) && !is_exact {
                open.push(other);
            }
        });
        if ends[first].distance(p) > 2.0 * reach {
            break;
        }
    }
    crowd
}

/// Where a crowd meets: where some meet exactly already, or in the mean of all. `None` if two
/// are left to be joined, or it is too wide, or exact meetings are apart.
fn meeting_place(
    crowd: &BTreeSet<usize>,
    ends: &[Point],
    join: f64,
    count: &HashMap<(u64, u64), usize>,
) -> Option<Point> {
    let places: BTreeMap<(u64, u64), Point> = crowd.iter().map(|&end| (bits(ends[end]), ends[end])).collect();
    let bounds = Bounds::around(places.values().copied());
    if crowd.len() < 3 || places.len() < 2 || bounds.diagonal() > 2.0 * join {
        return None;
    }
    let mut exact = places.iter().filter(|(bits, _)| count[bits] > 1).map(|(_, &p)| p);
    match (exact.next(), exact.next()) {
        (None, _) => {
            let from = bounds.min;
            let sum = places.values().fold(vector(0.0, 0.0), |sum, &p| sum + (p - from));
            Some(from + sum / places.len() as f64)
        }
        (Some(p), None) => Some(p),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gathered(ends: &[(f64, f64)]) -> Vec<Point> {
        let mut paths: Vec<ArcSpline> = ends
            .iter()
            .enumerate()
            .map(|(i, &(x, y))| ArcSpline::open([(x, y, 0.0), (10.0 * i as f64, 50.0, 0.0)]))
            .collect();
        let bounds = paths.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        gather(&mut paths, 0.01, Grain::of(&bounds));
        paths.iter().map(|p| p.vertices[0].point).collect()
    }

    #[test]
    fn three_ends_that_nearly_meet_meet_in_their_mean() {
        let ends = gathered(&[(0.0, 0.0), (0.006, 0.0), (0.003, 0.003)]);
        assert!(ends.iter().all(|&p| p == ends[0]));
        assert!(ends[0].distance(crate::geom::point(0.003, 0.001)) < 1e-15);
    }

    #[test]
    fn two_ends_a_row_of_ends_and_exact_pairs_stay() {
        for ends in [
            vec![(0.0, 0.0), (0.006, 0.0)],
            (0..9).map(|i| (0.009 * f64::from(i), 0.0)).collect(),
            vec![(0.0, 0.0), (0.0, 0.0), (0.006, 0.0), (0.006, 0.0)],
        ] {
            let found: Vec<(f64, f64)> = gathered(&ends).into_iter().map(|p| (p.x, p.y)).collect();
            assert_eq!(found, ends);
        }
        let joined = gathered(&[(0.0, 0.0), (0.0, 0.0), (0.006, 0.0)]);
        assert!(joined.iter().all(|p| p.x == 0.0));
    }
}
