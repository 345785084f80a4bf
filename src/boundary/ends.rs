//! Which ends of open curves meet.
//!
//! **Needs** clean open paths. **Guarantees** that every curve that is kept has both its ends at
//! places where an even number of kept ends meet, so that chains of kept curves close. **Does
//! not** decide which of more than two ends follow each other.
//!
//! **Method.** Ends at the same place to round-off are a spot. Spots are merged into nodes only
//! where an odd number of ends meets, in pairs, nearest first, so that what fits exactly is never
//! disturbed by what is near. First, curves that lead nowhere are dropped, and those that only
//! lead to them, for else they would take the place of a curve that closes. In the end, an odd
//! node without a partner drops one of its curves, which may set free an end elsewhere that has a
//! partner. Each step merges nodes or drops a curve, so this ends.

use super::cluster::cluster;
use super::fan::Fan;
use super::grain::Grain;
use super::index::Index;
use super::lists::Lists;
use crate::geom::{ArcSpline, Bounds, Element, Point};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// The end of curve `e / 2`: its start when `e` is even.
pub(super) type End = u32;

/// The curve of an end.
pub(super) fn curve_of(end: End) -> usize {
    end as usize / 2
}

/// The last element at an end, running away from it.
pub(super) fn leaving(path: &ArcSpline, end: End) -> Element {
    if end.is_multiple_of(2) { path.element(0) } else { path.element(path.len() - 1).reversed() }
}

/// Nodes where ends meet, and the curves that are kept.
pub(super) struct Ends<'a> {
    paths: &'a [ArcSpline],
    grain: Grain,
    join: f64,
    /// The spot of every end.
    spot_of: Vec<u32>,
    /// The place of every spot.
    spots: Vec<Point>,
    /// The node of every spot: one of its spots.
    node_of: Vec<u32>,
    /// The ends at every node.
    members: Lists,
    /// The spots of every node.
    parts: Lists,
    /// Number of kept ends at every node.
    degree: Vec<u32>,
    /// Number of kept ends at every spot.
    spot_degree: Vec<u32>,
    /// Whether a curve is kept.
    pub kept: Vec<bool>,
    tree: Index,
    leaf_of: Vec<u32>,
    /// Number of spots below every node of the tree that look for a partner.
    looking: Vec<u32>,
    is_looking: Vec<bool>,
}

/// A possible merger of two spots; ordered by gap.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Merger {
    gap: f64,
    from: u32,
    to: u32,
}

impl Eq for Merger {}

impl PartialOrd for Merger {
    fn partial_cmp(&self, other: &Merger) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Merger {
    fn cmp(&self, other: &Merger) -> std::cmp::Ordering {
        self.gap.total_cmp(&other.gap).then((self.from, self.to).cmp(&(other.from, other.to)))
    }
}

impl<'a> Ends<'a> {
    /// Finds out which ends of clean open paths meet, up to gaps of `join`.
    pub fn new(paths: &'a [ArcSpline], join: f64, grain: Grain) -> Ends<'a> {
        let places: Vec<Point> = paths
            .iter()
            .flat_map(|p| [p.vertices[0].point, p.vertices[p.vertices.len() - 1].point])
            .collect();
        let (spot_of, spots) = cluster(&places, grain);
        drop(places);
        let members = Lists::of(spots.len(), spot_of.iter().copied());
        let degree: Vec<u32> = (0..spots.len()).map(|spot| members.len(spot)).collect();
        // Nobody looks around where all fits.
        let fits = degree.iter().all(|d| d.is_multiple_of(2));
        let looked_at = if fits { &[] } else { &spots[..] };
        let tree = Index::new(&looked_at.iter().map(|&p| Bounds { min: p, max: p }).collect::<Vec<_>>());
        let mut ends = Ends {
            paths,
            grain,
            // A gap drawn as wide as the reach is not wider for the round-off of its two ends.
            join: join + grain.same,
            node_of: (0..spots.len() as u32).collect(),
            spot_degree: degree.clone(),
            parts: Lists::of(spots.len(), 0..spots.len() as u32),
            degree,
            members,
            kept: vec![true; paths.len()],
            leaf_of: tree.leaves(),
            looking: vec![0; tree.node_count()],
            is_looking: vec![false; spots.len()],
            tree,
            spot_of,
            spots,
        };
        if !fits {
            (0..ends.spots.len()).for_each(|spot| ends.look(spot));
            ends.drop_dead_ends();
            ends.merge_nearest_first();
            ends.settle();
        }
        ends
    }

    /// Whether an end at a node has no other to go on with.
    fn is_odd(&self, node: usize) -> bool {
        self.degree[node] % 2 == 1
    }

    fn node(&self, end: End) -> usize {
        self.node_of[self.spot_of[end as usize] as usize] as usize
    }

    /// Notes whether a spot looks for a partner.
    fn look(&mut self, spot: usize) {
        let looks = self.spot_degree[spot] > 0 && self.is_odd(self.node_of[spot] as usize);
        if looks == self.is_looking[spot] {
            return;
        }
        self.is_looking[spot] = looks;
        let mut at = self.leaf_of[spot] as usize;
        loop {
            self.looking[at] = if looks { self.looking[at] + 1 } else { self.looking[at] - 1 };
            if at == 0 {
                return;
            }
            at = (at - 1) / 2;
        }
    }

    fn look_around(&mut self, node: usize) {
        let parts: Vec<u32> = self.parts.items(node).collect();
        parts.into_iter().for_each(|spot| self.look(spot as usize));
    }

    /// The nearest spot within reach that a spot may be merged with.
    fn partner(&self, from: usize) -> Option<Merger> {
        let (p, node) = (self.spots[from], self.node_of[from]);
        let mut best = (self.join, None);
        self.tree.walk(
            &mut best,
            |best, id, b| {
                let gap = b.nearest(p).distance(p);
                let any = id.is_none_or(|id| self.looking[id] > 0);
                (any && (gap < best.0 || (gap == best.0 && best.1.is_none()))).then_some(gap)
            },
            |best, spot| {
                let to = spot as usize;
                if self.is_looking[to] && self.node_of[to] != node && self.may_meet(from, to) {
                    *best = (self.spots[to].distance(p), Some(spot));
                }
            },
        );
        best.1.map(|to| Merger { gap: best.0, from: from as u32, to })
    }

    /// The two ends of a curve no longer than the reach must not meet: it would vanish.
    fn may_meet(&self, a: usize, b: usize) -> bool {
        let only = |spot: usize| self.only_curve(self.node_of[spot] as usize);
        match (only(a), only(b)) {
            (Some(a), Some(b)) if a == b => self.paths[a].length() > self.join,
            _ => true,
        }
    }

    fn partner_of_node(&self, node: usize) -> Option<Merger> {
        let spots = self.parts.items(node).map(|s| s as usize);
        spots.filter(|&s| self.is_looking[s]).filter_map(|s| self.partner(s)).min()
    }

    /// Drops a curve; answers the nodes of its ends.
    fn drop_curve(&mut self, curve: usize) -> [usize; 2] {
        self.kept[curve] = false;
        [0, 1].map(|side| {
            let end = (2 * curve + side) as End;
            let node = self.node(end);
            self.degree[node] -= 1;
            self.spot_degree[self.spot_of[end as usize] as usize] -= 1;
            self.look_around(node);
            node
        })
    }

    /// The kept curve of a node that only one reaches.
    fn only_curve(&self, node: usize) -> Option<usize> {
        if self.degree[node] != 1 {
            return None;
        }
        self.members.items(node).map(curve_of).find(|&c| self.kept[c])
    }

    /// Whether no other kept end is within reach of a node, even one that has its partner.
    fn is_alone(&self, node: usize) -> bool {
        self.parts.items(node).filter(|&s| self.spot_degree[s as usize] > 0).all(|spot| {
            let p = self.spots[spot as usize];
            let mut alone = true;
            self.tree.walk(
                &mut alone,
                |alone, _, b| (*alone && b.nearest(p).distance(p) <= self.join).then_some(0.0),
                |alone, to| {
                    let other = self.node_of[to as usize] as usize != node;
                    let kept = self.spot_degree[to as usize] > 0;
                    *alone &= !(other && kept && self.may_meet(spot as usize, to as usize));
                },
            );
            alone
        })
    }

    /// Drops curves with an end that has no other within reach, and what hangs on them alone.
    fn drop_dead_ends(&mut self) {
        let mut open: Vec<usize> = (0..self.spots.len()).filter(|&n| self.degree[n] == 1).collect();
        while let Some(node) = open.pop() {
            let Some(curve) = self.only_curve(node) else { continue };
            if self.is_alone(node) {
                open.extend(self.drop_curve(curve));
            }
        }
    }

    fn merge_nearest_first(&mut self) {
        let mut heap: BinaryHeap<Reverse<Merger>> = (0..self.spots.len())
            .filter(|&s| self.is_looking[s])
            .filter_map(|s| self.partner(s))
            .map(Reverse)
            .collect();
        while let Some(Reverse(next)) = heap.pop() {
            if !self.is_looking[next.from as usize] {
                continue;
            }
            if self.is_looking[next.to as usize] {
                self.merge(next);
            } else {
                heap.extend(self.partner(next.from as usize).map(Reverse));
            }
        }
    }

    fn merge(&mut self, merger: Merger) {
        let [a, b] = [merger.from, merger.to].map(|s| self.node_of[s as usize] as usize);
        let (into, from) = if self.members.len(a) >= self.members.len(b) { (a, b) } else { (b, a) };
        self.parts.items(from).for_each(|spot| self.node_of[spot as usize] = into as u32);
        self.members.append(into, from);
        self.parts.append(into, from);
        self.degree[into] += self.degree[from];
        self.degree[from] = 0;
        self.look_around(into);
    }

    /// Drops curves until an even number of ends meets everywhere. Busy nodes come last, as
    /// dropping curves elsewhere may settle them.
    fn settle(&mut self) {
        let odd = |ends: &Ends, n: usize| ends.is_odd(n).then(|| (ends.degree[n], n));
        let mut open: BTreeSet<(u32, usize)> = (0..self.spots.len()).filter_map(|n| odd(self, n)).collect();
        while let Some((degree, node)) = open.pop_first() {
            if odd(self, node) != Some((degree, node)) {
                open.extend(odd(self, node));
            } else if let Some(merger) = self.partner_of_node(node) {
                self.merge(merger);
            } else {
                let curve = self.odd_one_out(node);
                let touched = self.drop_curve(curve);
                open.extend(touched.into_iter().filter_map(|n| odd(self, n)));
            }
        }
    }

    /// The curve to drop at a node where an odd number of ends meets: seen from the widest gap
    /// between them the one in the middle, so that the outermost contour stays.
    fn odd_one_out(&self, node: usize) -> usize {
        let kept = self.kept_ends(node);
        let order = self.fan(&kept).order;
        curve_of(kept[order[order.len() / 2]])
    }

    /// The kept ends at a node.
    fn kept_ends(&self, node: usize) -> Vec<End> {
        self.members.items(node).filter(|&e| self.kept[curve_of(e)]).collect()
    }

    /// The cyclic order of the curves at some ends that meet.
    pub fn fan(&self, ends: &[End]) -> Fan {
        let elements: Vec<Element> = ends.iter().map(|&e| leaving(&self.paths[curve_of(e)], e)).collect();
        Fan::new(&elements, self.grain.same)
    }

    /// Visits all nodes as the ends that meet there, in order of their first ends; dropped ones apart.
    pub fn meetings(&self, mut visit: impl FnMut(&[End], &[End])) {
        let (mut kept, mut dropped) = (Vec::new(), Vec::new());
        for node in (0..self.members.count()).filter(|&n| self.members.len(n) > 0) {
            kept.clear();
            dropped.clear();
            for end in self.members.items(node) {
                if self.kept[curve_of(end)] { kept.push(end) } else { dropped.push(end) }
            }
            visit(&kept, &dropped);
        }
    }

    /// Place of an end as drawn, to round-off.
    pub fn place(&self, end: End) -> Point {
        self.spots[self.spot_of[end as usize] as usize]
    }
}
