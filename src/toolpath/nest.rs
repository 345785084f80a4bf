//! Which loop lies next to which on the neighboring levels, and the order of cutting that follows.
//!
//! **Needs** levels at increasing distances, none empty but perhaps the last ones.
//! **Guarantees** that every pass stands after all its neighbors on the inner side (or before them,
//! with [`Start::Outside`]) and that chains of neighbors follow one another.
//!
//! **Method.** A level set is the parallel curve of the next one: the middle of each element of a
//! loop has its foot on one loop of the level outside it, a neighbor, and every neighbor is found
//! so. Ridges have a foot on either side. Depth first from the outermost loops inward, the deepest
//! branch first, gives the order: neighbors come in a chain unless loops branch.

use super::Start;
use super::indexed::Indexed;
use crate::geom::{ArcSpline, Point};
use crate::offset::Level;
use rayon::prelude::*;
use rstar::RTree;

/// One loop or ridge of one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pass {
    /// Index of its level.
    pub level: usize,
    /// Index among the loops of the level; ridges follow the loops.
    pub index: usize,
}

/// Where two passes on neighboring levels lie next to each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Door {
    /// The pass on the other level.
    pub pass: usize,
    /// A place on the inner pass of the two whose foot lies on the outer one.
    pub at: Point,
    /// How long both run side by side, as far as known.
    pub length: f64,
}

/// The passes of a pocket and their neighbors. Passes are counted from the outermost level.
pub(super) struct Nest {
    pub passes: Vec<Pass>,
    /// Neighbors of each pass on the level inside it.
    pub inner: Vec<Vec<Door>>,
    /// Neighbors of each pass on the level outside it.
    pub outer: Vec<Vec<Door>>,
}

impl Nest {
    /// Finds the neighbors. `slack` is the round-off of a place of a level.
    pub fn new(levels: &[Level], slack: f64) -> Nest {
        let mut passes = Vec::new();
        let mut first = Vec::new();
        for (level, set) in levels.iter().enumerate() {
            first.push(passes.len());
            passes.extend((0..set.loops.len() + set.ridges.len()).map(|index| Pass { level, index }));
        }
        let doors: Vec<Vec<Vec<Door>>> = (1..levels.len())
            .into_par_iter()
            .map(|k| doors_outward(&levels[k], &levels[k - 1], first[k - 1], slack))
            .collect();
        let mut outer = vec![Vec::new(); passes.len()];
        let mut inner = vec![Vec::new(); passes.len()];
        for (i, doors) in doors.into_iter().enumerate() {
            for (index, doors) in doors.into_iter().enumerate() {
                let own = first[i + 1] + index;
                for door in &doors {
                    inner[door.pass].push(Door { pass: own, ..*door });
                }
                outer[own] = doors;
            }
        }
        Nest { passes, inner, outer }
    }

    /// The pass of a loop or ridge of a level.
    pub fn pass(&self, level: usize, index: usize) -> Option<usize> {
        self.passes.binary_search_by_key(&(level, index), |pass| (pass.level, pass.index)).ok()
    }

    /// The loop or ridge of a pass.
    pub fn spline<'a>(&self, levels: &'a [Level], pass: usize) -> &'a ArcSpline {
        let Pass { level, index } = self.passes[pass];
        let level = &levels[level];
        level.loops.get(index).unwrap_or_else(|| &level.ridges[index - level.loops.len()])
    }

    /// The passes in the order of cutting.
    pub fn order(&self, start: Start) -> Vec<usize> {
        let mut order = self.inside_out();
        if start == Start::Outside {
            order.reverse();
        }
        order
    }

    fn inside_out(&self) -> Vec<usize> {
        let n = self.passes.len();
        // How many levels lie inside each pass; inner passes have the larger numbers.
        let mut height = vec![0usize; n];
        for i in (0..n).rev() {
            height[i] = self.inner[i].iter().map(|d| height[d.pass] + 1).max().unwrap_or(0);
        }
        let mut order = Vec::with_capacity(n);
        let mut seen = vec![false; n];
        let mut stack: Vec<(usize, Vec<usize>)> = Vec::new();
        for root in (0..n).filter(|&i| self.outer[i].is_empty()) {
            if std::mem::replace(&mut seen[root], true) {
                continue;
            }
            stack.push((root, self.inward(root, &height)));
            while let Some((pass, children)) = stack.last_mut() {
                match children.pop() {
                    Some(child) if seen[child] => {}
                    Some(child) => {
                        seen[child] = true;
                        let children = self.inward(child, &height);
                        stack.push((child, children));
                    }
                    None => {
                        order.push(*pass);
                        stack.pop();
                    }
                }
            }
        }
        order
    }

    /// Inner neighbors, the one to visit first at the end.
    fn inward(&self, pass: usize, height: &[usize]) -> Vec<usize> {
        let mut children: Vec<usize> = self.inner[pass].iter().map(|d| d.pass).collect();
        children.sort_by_key(|&c| (height[c], std::cmp::Reverse(c)));
        children
    }
}

/// For each pass of `level` its doors to the passes of the level outside it, which are numbered
/// from `first`.
fn doors_outward(level: &Level, outside: &Level, first: usize, slack: f64) -> Vec<Vec<Door>> {
    let only = outside.loops.len() == 1 && outside.ridges.is_empty();
    let tree = if only { RTree::new() } else { index(outside) };
    let splines = level.loops.iter().chain(&level.ridges);
    splines
        .map(|spline| {
            let mut doors: Vec<Door> = Vec::new();
            let mut meet = |at: Point, length: f64| {
                if only {
                    widen(&mut doors, Door { pass: first, at, length });
                    return;
                }
                let mut nearest = f64::INFINITY;
                for (found, squared) in tree.nearest_neighbor_iter_with_distance_2(&[at.x, at.y]) {
                    let distance = squared.sqrt();
                    nearest = nearest.min(distance);
                    if distance > nearest + slack {
                        break;
                    }
                    widen(&mut doors, Door { pass: first + found.index, at, length });
                }
            };
            for e in spline.elements() {
                meet(e.midpoint(), e.length());
            }
            if let (true, Some(v)) = (spline.is_empty(), spline.vertices.first()) {
                meet(v.point, 0.0);
            }
            widest(doors)
        })
        .collect()
}

/// Adds a door, unless it leads where the last one does: of these two the longer stays.
fn widen(doors: &mut Vec<Door>, door: Door) {
    match doors.last_mut().filter(|last| last.pass == door.pass) {
        Some(last) if last.length < door.length => *last = door,
        Some(_) => {}
        None => doors.push(door),
    }
}

/// One door for each pass: that on the longest stretch.
fn widest(mut doors: Vec<Door>) -> Vec<Door> {
    doors.sort_by(|a, b| a.pass.cmp(&b.pass).then(b.length.total_cmp(&a.length)));
    doors.dedup_by_key(|d| d.pass);
    doors
}

/// The loops of a level, for finding the nearest.
pub(super) fn index(level: &Level) -> RTree<Indexed> {
    let loops = level
        .loops
        .iter()
        .enumerate()
        .flat_map(|(pass, spline)| spline.elements().map(move |element| Indexed::new(element, pass)));
    RTree::bulk_load(loops.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn square(x: f64, half: f64) -> ArcSpline {
        ArcSpline::closed([
            (x - half, -half, 0.0),
            (x + half, -half, 0.0),
            (x + half, half, 0.0),
            (x - half, half, 0.0),
        ])
    }

    fn level(distance: f64, loops: Vec<ArcSpline>) -> Level {
        Level { distance, loops, ridges: Vec::new() }
    }

    #[test]
    fn concentric_loops_follow_one_another_from_the_inside() {
        let levels: Vec<Level> =
            (0..4).map(|k| level(f64::from(k), vec![square(0.0, 5.0 - f64::from(k))])).collect();
        let nest = Nest::new(&levels, 1e-12);
        assert_eq!(nest.order(Start::Inside), [3, 2, 1, 0]);
        assert_eq!(nest.order(Start::Outside), [0, 1, 2, 3]);
    }

    #[test]
    fn two_lobes_come_one_after_the_other_the_deeper_one_first() {
        let both =
            ArcSpline::closed([(-8.0, -4.0, 0.0), (8.0, -4.0, 0.0), (8.0, 4.0, 0.0), (-8.0, 4.0, 0.0)]);
        let levels = [
            level(1.0, vec![both]),
            level(2.0, vec![square(-4.0, 3.0), square(4.0, 3.0)]),
            level(3.0, vec![square(4.0, 2.0)]),
        ];
        let nest = Nest::new(&levels, 1e-12);
        assert_eq!(nest.order(Start::Inside), [3, 2, 1, 0]);
        assert_eq!(nest.inner[0].len(), 2);
    }

    #[test]
    fn both_sides_of_an_annulus_are_followed_to_the_end() {
        let ring = |r: f64| ArcSpline::circle(point(0.0, 0.0), r);
        let levels: Vec<Level> = (0..3)
            .map(|k| {
                level(f64::from(k), vec![ring(20.0 - f64::from(k)), ring(10.0 + f64::from(k)).reversed()])
            })
            .collect();
        let nest = Nest::new(&levels, 1e-12);
        assert_eq!(nest.order(Start::Inside), [4, 2, 0, 5, 3, 1]);
    }

    #[test]
    fn a_ridge_has_a_neighbor_on_either_side() {
        let ring = |r: f64| ArcSpline::circle(point(0.0, 0.0), r);
        let levels = [
            level(1.0, vec![ring(16.0), ring(14.0).reversed()]),
            Level { distance: 2.0, loops: vec![], ridges: vec![ring(15.0)] },
        ];
        let nest = Nest::new(&levels, 1e-12);
        assert_eq!(nest.outer[2].len(), 2);
        assert_eq!(nest.order(Start::Inside), [2, 0, 1]);
    }

    #[test]
    fn thousands_of_loops_beside_each_other_are_paired_by_the_index() {
        let row = |half: f64| (0..2000).map(|i| square(10.0 * f64::from(i), half)).collect::<Vec<_>>();
        let nest = Nest::new(&[level(1.0, row(3.0)), level(2.0, row(2.0))], 1e-9);
        assert!((0..2000).all(|i| nest.inner[i].len() == 1 && nest.inner[i][0].pass == 2000 + i));
        assert_eq!(nest.order(Start::Inside)[..3], [2000, 0, 2001]);
    }
}
