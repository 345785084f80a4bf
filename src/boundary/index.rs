//! A tree of boxes: finds what lies near in logarithmic time.
//!
//! The items are halved at the median of their centers along the longer side until few remain;
//! as the halves are equal the tree is complete, so it is stored without pointers: the children
//! of node `n` are `2 n + 1` and `2 n + 2`, and ranges of items follow from halving.

use crate::geom::Bounds;
use rayon::prelude::*;

/// Items of a leaf at most: below it, looking at them is cheaper than more tree.
const LEAF: usize = 6;

/// Room for the way down: one open node for each level, and items are numbered in 32 bits.
const STACK: usize = 34;

/// Nodes still to be looked at, without asking for memory: trees are walked millions of times.
struct Stack {
    nodes: [Node; STACK],
    len: usize,
}

impl Stack {
    fn push(&mut self, node: Node) {
        self.nodes[self.len] = node;
        self.len += 1;
    }

    fn pop(&mut self) -> Option<Node> {
        self.len = self.len.checked_sub(1)?;
        Some(self.nodes[self.len])
    }
}

/// A static tree over boxes.
#[derive(Debug)]
pub(super) struct Index {
    /// Item ids in order of leaves.
    items: Vec<u32>,
    /// Boxes of the items, in the same order.
    boxes: Vec<Bounds>,
    /// Boxes of the nodes.
    nodes: Vec<Bounds>,
    /// Number of the first leaf.
    first_leaf: usize,
}

/// A node with the range of its items.
#[derive(Clone, Copy)]
struct Node {
    id: usize,
    from: usize,
    to: usize,
}

impl Node {
    fn children(self) -> [Node; 2] {
        let middle = self.from.midpoint(self.to);
        [
            Node { id: 2 * self.id + 1, from: self.from, to: middle },
            Node { id: 2 * self.id + 2, from: middle, to: self.to },
        ]
    }
}

impl Index {
    /// The tree over some boxes; items are numbered in their order.
    pub fn new(boxes: &[Bounds]) -> Index {
        Index::of(boxes.len(), |item| boxes[item])
    }

    /// The tree over so many boxes, each of which is asked for twice.
    pub fn of(count: usize, of_item: impl Fn(usize) -> Bounds) -> Index {
        let leaves = count.div_ceil(LEAF).max(1).next_power_of_two();
        let center = |item: u32| Center { at: of_item(item as usize).center().into(), item };
        let mut centers: Vec<Center> = (0..count as u32).map(center).collect();
        halve(&mut centers, leaves);
        let items: Vec<u32> = centers.iter().map(|c| c.item).collect();
        drop(centers);
        let mut index = Index {
            boxes: items.iter().map(|&i| of_item(i as usize)).collect(),
            items,
            nodes: vec![Bounds::EMPTY; 2 * leaves - 1],
            first_leaf: leaves - 1,
        };
        index.enclose(index.root());
        index
    }

    fn root(&self) -> Node {
        Node { id: 0, from: 0, to: self.items.len() }
    }

    fn enclose(&mut self, node: Node) -> Bounds {
        let bounds = if node.id >= self.first_leaf {
            self.boxes[node.from..node.to].iter().fold(Bounds::EMPTY, |a, b| a.union(*b))
        } else {
            let [low, high] = node.children();
            self.enclose(low).union(self.enclose(high))
        };
        self.nodes[node.id] = bounds;
        bounds
    }

    /// All items with their boxes, neighbors mostly one after the other.
    pub fn in_order(&self) -> impl IndexedParallelIterator<Item = (u32, &Bounds)> {
        self.items.par_iter().copied().zip(&self.boxes)
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// For each item the leaf that holds it.
    pub fn leaves(&self) -> Vec<u32> {
        let mut leaf_of = vec![0; self.items.len()];
        let mut open = vec![self.root()];
        while let Some(node) = open.pop() {
            if node.id >= self.first_leaf {
                for &item in &self.items[node.from..node.to] {
                    leaf_of[item as usize] = node.id as u32;
                }
            } else {
                open.extend(node.children());
            }
        }
        leaf_of
    }

    /// Walks down the tree. `cost` is asked for each node and each item: `None` leaves it out,
    /// otherwise the cheaper child comes first. `state` is what both closures share.
    pub fn walk<S>(
        &self,
        state: &mut S,
        cost: impl Fn(&S, Option<usize>, &Bounds) -> Option<f64>,
        mut visit: impl FnMut(&mut S, u32),
    ) {
        let mut open = Stack { nodes: [self.root(); STACK], len: 1 };
        while let Some(node) = open.pop() {
            if cost(state, Some(node.id), &self.nodes[node.id]).is_none() {
                continue;
            }
            if node.id >= self.first_leaf {
                for at in node.from..node.to {
                    if cost(state, None, &self.boxes[at]).is_some() {
                        visit(state, self.items[at]);
                    }
                }
                continue;
            }
            let [low, high] = node.children();
            let of = |n: Node| cost(state, Some(n.id), &self.nodes[n.id]);
            match (of(low), of(high)) {
                (Some(a), Some(b)) if a <= b => {
                    open.push(high);
                    open.push(low);
                }
                (Some(_), Some(_)) => {
                    open.push(low);
                    open.push(high);
                }
                (Some(_), None) => open.push(low),
                (None, Some(_)) => open.push(high),
                (None, None) => {}
            }
        }
    }

    /// Visits all items whose box meets another box, in no useful order.
    pub fn meeting(&self, query: &Bounds, mut visit: impl FnMut(u32)) {
        self.walk(&mut (), |(), _, b| b.meets(query).then_some(0.0), |(), item| visit(item));
    }
}

/// The center of the box of an item. Side by side in memory, they are sorted without looking elsewhere.
struct Center {
    at: [f64; 2],
    item: u32,
}

/// Items from which on halves are sorted at the same time.
const PARALLEL: usize = 20_000;

/// Puts items in the order of their leaves.
fn halve(centers: &mut [Center], leaves: usize) {
    if leaves == 1 {
        return;
    }
    let extent = Bounds::around(centers.iter().map(|c| c.at.into())).extent();
    let axis = if extent.x >= extent.y { 0 } else { 1 };
    let middle = centers.len() / 2;
    if middle < centers.len() {
        centers.select_nth_unstable_by(middle, |a, b| {
            a.at[axis].total_cmp(&b.at[axis]).then(a.item.cmp(&b.item))
        });
    }
    let (low, high) = centers.split_at_mut(middle);
    if low.len() > PARALLEL {
        rayon::join(|| halve(low, leaves / 2), || halve(high, leaves / 2));
    } else {
        halve(low, leaves / 2);
        halve(high, leaves / 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn some_boxes(n: usize) -> Vec<Bounds> {
        let mut seed = 1_u64;
        let mut next = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / 1e4
        };
        (0..n)
            .map(|_| {
                let p = point(next(), next());
                Bounds::around([p, point(p.x + next() / 50.0, p.y + next() / 50.0)])
            })
            .collect()
    }

    #[test]
    fn it_finds_what_looking_at_all_finds() {
        for n in [0, 1, 2, 6, 7, 13, 100, 1000] {
            let boxes = some_boxes(n);
            let index = Index::new(&boxes);
            for query in some_boxes(20) {
                let mut found = Vec::new();
                index.meeting(&query, |i| found.push(i));
                found.sort_unstable();
                let all: Vec<u32> = (0..n as u32).filter(|&i| boxes[i as usize].meets(&query)).collect();
                assert_eq!(found, all);
            }
        }
    }

    #[test]
    fn every_item_has_its_leaf() {
        let index = Index::new(&some_boxes(100));
        assert!(index.leaves().iter().all(|&leaf| (leaf as usize) < index.node_count() && leaf > 0));
    }
}
