//! The merge tree: how the parts of a pocket come, unite and close round islands as the distance falls.
//!
//! **Needs** a finished [`Mat`]. **Guarantees** for every distance the number of parts and of loops
//! that [`Mat::level`] has there, radii that differ by round-off being equal; no level is made.
//! **Does not** list ridges, which bound no part.
//!
//! **Method.** What is farther than `d` from the boundary shrinks onto what of the axis has a larger
//! radius: both have the same parts and as many holes as that has cycles. So vertices, united to
//! plateaus of one radius, are taken from the largest radius down. A plateau from which no way leads
//! up is a peak, and a *part* of the pocket begins there; one that several parts reach down to is a
//! neck, and they unite; every further way up closes a cycle round an island. Each step is a search
//! for two sets: `n log n` for the order and no more than that.
//!
//! Source: H. Carr, J. Snoeyink, U. Axen, *Computing contour trees in all dimensions* (Computational
//! Geometry 24, 2003), section 4, the join tree, here of the radius on the graph of the axis.

use crate::mat::{Disk, Mat, Sets};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// A connected part of what is farther than `d` from the boundary, for all `d` from [`from`](Part::from)
/// up to [`to`](Part::to): over that range its loops change their shape and not their number, but for
/// those that [`holes`](Part::holes) tells of. Lengths are in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The distance at which it unites with others; 0 when it is the whole pocket in the end.
    pub from: f64,
    /// The distance above which there is none of it (a peak), or more than one (a neck).
    pub to: f64,
    /// A largest disk in it, whose center is a point to begin at.
    pub peak: Disk,
    /// The neck that joins what it is made of; `None` when it begins at a peak.
    pub neck: Option<Disk>,
    /// Index of the part that it becomes a portion of at `from`.
    pub parent: Option<usize>,
    /// Indices of the parts that it falls into above `to`; none when it begins at a peak.
    pub children: Vec<usize>,
    /// Distances at which it closes round an island, falling: below each it has one more hole. Those of
    /// its children come on top.
    pub holes: Vec<f64>,
}

/// What becomes of a pocket, level by level; [`Mat::levels`] makes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MergeTree {
    /// The parts; children before their parents, the whole pocket last (or what islands divide it into).
    pub parts: Vec<Part>,
    /// Distances at which the number of loops changes, falling, and the number below each.
    loops: Vec<(f64, usize)>,
    /// The disks that a way between larger ones must pass: where parts unite, or a cycle round an island
    /// closes. Falling.
    passages: Vec<Disk>,
    /// Distances closer than this are equal.
    error: f64,
}

impl Mat {
    /// What level sets there are at all distances, how they hang together and where they split,
    /// without making one of them. Takes `n log n` for `n` vertices of the axis.
    pub fn levels(&self) -> MergeTree {
        Sweep::new(self).run()
    }
}

impl MergeTree {
    /// How many loops [`Mat::level`] has at `d`, in job units above 0.
    pub fn loops_at(&self, d: f64) -> usize {
        let at = self.loops.partition_point(|&(radius, _)| radius > d + self.error);
        at.checked_sub(1).map_or(0, |i| self.loops[i].1)
    }

    /// Indices of the parts that the pocket consists of at `d`, in job units above 0, growing.
    pub fn parts_at(&self, d: f64) -> Vec<usize> {
        let is_there = |p: &Part| p.to > d + self.error && p.from <= d + self.error;
        (0..self.parts.len()).filter(|&i| is_there(&self.parts[i])).collect()
    }

    /// How many holes a part has at `d`, in job units: its loops there are one more.
    pub fn holes_of(&self, part: usize, d: f64) -> usize {
        let mut count = 0;
        let mut open = vec![part];
        while let Some(i) = open.pop() {
            let part = &self.parts[i];
            count += part.holes.partition_point(|&radius| radius > d + self.error);
            open.extend(&part.children);
        }
        count
    }

    /// The necks at which the pocket falls into more parts, widest last: what a tool of that radius
    /// does not get through.
    pub fn splits(&self) -> Vec<Disk> {
        let mut necks: Vec<Disk> = self.parts.iter().filter_map(|p| p.neck).collect();
        necks.sort_by(|a, b| a.radius.total_cmp(&b.radius));
        necks
    }

    /// Every disk that a way between larger ones must pass, narrowest first: [`splits`](MergeTree::splits),
    /// and those beside islands, which a tool may get round on the other side.
    pub fn passages(&self) -> impl ExactSizeIterator<Item = Disk> + '_ {
        self.passages.iter().rev().copied()
    }

    /// The narrowest passage: a tool of no more than its radius gets everywhere that it fits.
    pub fn narrowest_passage(&self) -> Option<Disk> {
        self.passages().next()
    }

    /// The disk that stops a tool on its way between two parts, given by their indices: the largest tool
    /// that gets from the one to the other. `None` when there is no such part.
    pub fn passage_between(&self, a: usize, b: usize) -> Option<Disk> {
        let (mut a, mut b) = (a, b);
        // Parents come after their children: the smaller index is not the common portion yet.
        while a != b {
            let low = a.min(b);
            let parent = self.parts.get(low)?.parent?;
            if low == a { a = parent } else { b = parent }
        }
        let common = self.parts.get(a)?;
        Some(common.neck.unwrap_or(common.peak))
    }

    /// A largest disk in the pocket: the largest tool that fits.
    pub fn largest_disk(&self) -> Disk {
        let whole = self.parts.iter().filter(|p| p.parent.is_none()).map(|p| p.peak);
        // Of equal ones the last, that of the part which begins last.
        whole.max_by(|a, b| a.radius.total_cmp(&b.radius)).expect("a pocket is a part")
    }
}

/// The sweep over plateaus from the largest radius down.
struct Sweep<'a> {
    mat: &'a Mat,
    /// Whether a vertex is the smallest of its plateau, which goes by that number.
    is_plateau: Vec<bool>,
    /// Ways up of each plateau: plateaus that edges lead up to, sorted by the lower end.
    up: Vec<(u32, u32)>,
    /// Cycles within each plateau.
    cycles: Vec<usize>,
    /// Plateaus that hang together so far, and the part of each set.
    sets: Sets,
    part: Vec<usize>,
    tree: MergeTree,
}

impl<'a> Sweep<'a> {
    fn new(mat: &'a Mat) -> Sweep<'a> {
        let graph = &mat.graph;
        let radius = |v: u32| graph.disks[v as usize].radius;
        let n = graph.disks.len();
        let mut same = Sets::singles(n);
        let mut cycles = vec![0; n];
        let mut closing = Vec::new();
        let mut up = Vec::new();
        for edge in &graph.edges {
            let [a, b] = edge.disks;
            if (radius(a) - radius(b)).abs() > graph.error {
                up.push(if radius(a) < radius(b) { (a, b) } else { (b, a) });
            } else if !same.unite(a, b) {
                closing.push(a);
            }
        }
        unite_against_the_order(&mut same, &mut up, &mut closing, radius);
        closing.iter().for_each(|&v| cycles[same.find(v) as usize] += 1);
        let plateau: Vec<u32> = (0..n as u32).map(|v| same.find(v)).collect();
        for (low, high) in &mut up {
            (*low, *high) = (plateau[*low as usize], plateau[*high as usize]);
        }
        up.sort_unstable();
        let is_plateau = plateau.iter().zip(0..).map(|(&p, v)| p == v).collect();
        let error = mat.frame.length_out(graph.error);
        let tree = MergeTree { parts: Vec::new(), loops: Vec::new(), passages: Vec::new(), error };
        Sweep { mat, is_plateau, up, cycles, sets: Sets::singles(n), part: vec![usize::MAX; n], tree }
    }

    fn run(mut self) -> MergeTree {
        let radius = |v: u32| self.mat.graph.disks[v as usize].radius;
        let mut order: Vec<u32> =
            (0..self.part.len() as u32).filter(|&v| self.is_plateau[v as usize]).collect();
        order.sort_by(|&a, &b| sweep_order(radius, a, b));
        let mut loops = 0;
        for v in order {
            let before = loops;
            loops = self.pass(v, loops);
            if loops != before {
                self.tree.loops.push((self.mat.disk(v).radius, loops));
            }
        }
        self.tree
    }

    /// Takes in a plateau; how many loops there are below it.
    fn pass(&mut self, v: u32, loops: usize) -> usize {
        let disk = self.mat.disk(v);
        let first = self.up.partition_point(|&(low, _)| low < v);
        let ways = self.up[first..].partition_point(|&(low, _)| low == v);
        let highs = &self.up[first..first + ways];
        let mut above: Vec<u32> = highs.iter().map(|&(_, high)| self.sets.find(high)).collect();
        above.sort_unstable();
        above.dedup();
        let cycles = self.cycles[v as usize] + ways - above.len();
        // A ring of one radius all around is a peak, and no passage.
        if ways > 1 {
            self.tree.passages.push(disk);
        }
        let children: Vec<usize> = above.iter().map(|&set| self.part[set as usize]).collect();
        let part = match children[..] {
            [only] => only,
            _ => self.begin(disk, children),
        };
        let holes = &mut self.tree.parts[part].holes;
        holes.resize(holes.len() + cycles, disk.radius);
        for &set in &above {
            self.sets.unite(set, v);
        }
        let set = self.sets.find(v);
        self.part[set as usize] = part;
        loops + cycles + 1 - above.len()
    }

    /// A part that begins at a peak, or where others unite.
    fn begin(&mut self, disk: Disk, children: Vec<usize>) -> usize {
        let index = self.tree.parts.len();
        let mut peak = disk;
        for &child in &children {
            let part = &mut self.tree.parts[child];
            (part.from, part.parent) = (disk.radius, Some(index));
            if part.peak.radius > peak.radius {
                peak = part.peak;
            }
        }
        let neck = (!children.is_empty()).then_some(disk);
        let (to, holes) = (disk.radius, Vec::new());
        self.tree.parts.push(Part { from: 0.0, to, peak, neck, parent: None, children, holes });
        index
    }
}

/// Order of the sweep: the larger radius first.
fn sweep_order(radius: impl Fn(u32) -> f64, a: u32, b: u32) -> Ordering {
    radius(b).total_cmp(&radius(a)).then(a.cmp(&b))
}

/// Makes plateaus one where an edge leads up from one that comes before the other in the sweep. The radii
/// of a plateau differ by round-off from vertex to vertex, and in a sliver as thin as that from end to end.
fn unite_against_the_order(
    same: &mut Sets,
    up: &mut Vec<(u32, u32)>,
    closing: &mut Vec<u32>,
    radius: impl Fn(u32) -> f64,
) {
    let mut changed = true;
    while changed {
        let count = up.len();
        up.retain(|&(low, high)| {
            let (a, b) = (same.find(low), same.find(high));
            let is_up = a != b && sweep_order(&radius, b, a).is_lt();
            if !is_up && !same.unite(a, b) {
                closing.push(low);
            }
            is_up
        });
        changed = up.len() < count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::{Pocket, Tolerance};

    fn tree(loops: Vec<ArcSpline>) -> MergeTree {
        Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap().levels()
    }

    fn polygon(corners: &[(f64, f64)]) -> ArcSpline {
        ArcSpline::closed(corners.iter().map(|&(x, y)| (x, y, 0.0)))
    }

    /// Two squares, of 20 and of 12, with a passage of 4 between them.
    fn dumbbell() -> ArcSpline {
        polygon(&[
            (0.0, 0.0),
            (20.0, 0.0),
            (20.0, 8.0),
            (30.0, 8.0),
            (30.0, 4.0),
            (42.0, 4.0),
            (42.0, 16.0),
            (30.0, 16.0),
            (30.0, 12.0),
            (20.0, 12.0),
            (20.0, 20.0),
            (0.0, 20.0),
        ])
    }

    #[test]
    fn a_pocket_falls_in_two_at_its_neck() {
        let tree = tree(vec![dumbbell()]);
        let counts = [0.5, 1.9, 2.0, 3.0, 6.5, 9.9, 10.0].map(|d| tree.loops_at(d));
        assert_eq!(counts, [1, 1, 2, 2, 1, 1, 0]);
        let [large, small, whole] = &tree.parts[..] else { panic!("{:?}", tree.parts) };
        let ranges = [large, small, whole].map(|p| [p.from, p.to]);
        for (range, known) in ranges.iter().flatten().zip([2.0, 10.0, 2.0, 6.0, 0.0, 2.0]) {
            assert!((range - known).abs() < 1e-13, "{ranges:?}");
        }
        assert_eq!((large.parent, small.parent, &whole.children), (Some(2), Some(2), &vec![0, 1]));
        assert_eq!((whole.peak, tree.largest_disk()), (large.peak, large.peak));
        assert_eq!(tree.splits().len(), 1);
        assert_eq!(
            (tree.parts_at(1.0), tree.parts_at(2.0), tree.parts_at(7.0)),
            (vec![2], vec![0, 1], vec![0])
        );
    }

    #[test]
    fn islands_are_holes_up_to_the_necks_beside_them() {
        let plate = polygon(&[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]);
        let tree = tree(vec![plate, ArcSpline::circle(point(22.0, 20.0), 8.0).reversed()]);
        // Beside the island: 6 above and below, where first two parts unite and then the cycle closes.
        let whole = tree.parts.len() - 1;
        assert_eq!((tree.holes_of(whole, 5.9), tree.loops_at(5.9)), (1, 2));
        assert_eq!((tree.parts_at(6.0).len(), tree.loops_at(6.0)), (2, 2));
        assert_eq!(tree.parts_at(5.9), [whole]);
    }

    #[test]
    fn a_ring_is_one_part_with_a_hole_at_once() {
        let ring =
            [ArcSpline::circle(point(5.0, 5.0), 9.0), ArcSpline::circle(point(5.0, 5.0), 4.0).reversed()];
        let tree = tree(ring.to_vec());
        assert_eq!(tree.parts.len(), 1);
        assert_eq!((tree.loops_at(2.4), tree.holes_of(0, 2.4), tree.loops_at(2.5)), (2, 1, 0));
    }

    #[test]
    fn passages_are_where_a_tool_gets_through_and_no_larger_one() {
        let split = tree(vec![dumbbell()]);
        let neck = split.narrowest_passage().unwrap();
        assert!((neck.radius - 2.0).abs() < 1e-13 && split.passages().len() == 1);
        assert_eq!(split.passage_between(0, 1), Some(neck));
        assert_eq!(split.passage_between(1, 1).map(|d| d.radius > 5.9), Some(true));
        assert_eq!(split.passage_between(0, 9), None);
        let plate = polygon(&[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]);
        let around = tree(vec![plate, ArcSpline::circle(point(22.0, 18.0), 8.0).reversed()]);
        // 5 below the island, 7 above it: the wider one splits the pocket.
        let radii: Vec<f64> = around.passages().map(|d| d.radius).collect();
        assert!((radii[0] - 5.0).abs() < 1e-13, "{radii:?}");
        let splits = around.splits();
        assert!(splits.iter().any(|d| (d.radius - 7.0).abs() < 1e-13), "{splits:?}");
    }

    #[test]
    fn a_disk_is_one_part_without_necks() {
        let tree = tree(vec![ArcSpline::circle(point(-3.0, 7.0), 2.5)]);
        assert_eq!((tree.parts.len(), tree.splits().len(), tree.loops_at(2.4)), (1, 0, 1));
        assert_eq!(tree.largest_disk().radius, 2.5);
    }

    #[test]
    fn plateaus_that_lead_up_to_smaller_ones_are_one() {
        let radii = [3.0, 2.0, 2.5, 4.0];
        let mut same = Sets::singles(4);
        same.unite(0, 1);
        // The plateau of 0 and 1 is known by the larger radius, and 2 is above its other end.
        let (mut up, mut closing) = (vec![(1, 2), (0, 3), (2, 3)], Vec::new());
        unite_against_the_order(&mut same, &mut up, &mut closing, |v| radii[v as usize]);
        assert_eq!((same.find(2), same.find(3)), (0, 3));
        assert_eq!((up, closing), (vec![(0, 3), (2, 3)], vec![]));
    }
}
