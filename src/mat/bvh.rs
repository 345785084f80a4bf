//! A hierarchy of boxes over the sites.
//!
//! The tree is implicit, eight children to a node, without pointers; boxes are `f32`, rounded outward,
//! eight side by side so that they are tested in one go. The pieces of a face stand in boundary order,
//! so that a part of the boundary is a range of leaves. The sites of a pocket stand along a Hilbert
//! curve: in a spiral of many turns boundary order would put whole turns into boxes that all overlap
//! (28 microseconds per site at 100,000 sites on 780 turns).

use crate::geom::{Bounds, Point};
use rayon::prelude::*;
use wide::f32x8;

const WIDTH: usize = 8;

/// Boxes of eight children.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Boxes {
    min_x: f32x8,
    max_x: f32x8,
    min_y: f32x8,
    max_y: f32x8,
}

/// The hierarchy; leaves are numbered like the boxes it was built from.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    /// Lowest level first; each level packs the one below.
    levels: Vec<Vec<Boxes>>,
    /// The leaves, where they do not stand in the order of their numbers.
    order: Vec<u32>,
}

/// A disk that shrinks while the hierarchy is searched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SearchDisk {
    pub center: Point,
    pub radius: f64,
}

/// Largest number of open nodes: seven siblings on each of the levels that `u32` leaves can fill.
const STACK: usize = 80;

impl Bvh {
    /// The hierarchy over some boxes, its leaves along a Hilbert curve.
    pub fn sorted(boxes: &[Bounds]) -> Bvh {
        // Place and number in one word, which sorts twice as fast as the pair.
        let key = |(i, b): (u64, &Bounds)| u64::from(hilbert(b.center())) << 32 | i;
        let mut order: Vec<u64> = (0..).zip(boxes).map(key).collect();
        order.par_sort_unstable();
        let order: Vec<u32> = order.into_iter().map(|key| key as u32).collect();
        let tree = Bvh::build(order.iter().map(|&i| boxes[i as usize]));
        Bvh { order, ..tree }
    }

    /// The hierarchy over some boxes in the order given.
    pub fn build(boxes: impl ExactSizeIterator<Item = Bounds>) -> Bvh {
        let count = boxes.len();
        let mut level = vec![Boxes::EMPTY; count.div_ceil(WIDTH).max(1)];
        for (i, b) in boxes.enumerate() {
            level[i / WIDTH].set(i % WIDTH, &b);
        }
        let mut levels = Vec::new();
        while level.len() > 1 {
            let mut above = vec![Boxes::EMPTY; level.len().div_ceil(WIDTH)];
            for (i, boxes) in level.iter().enumerate() {
                above[i / WIDTH].set_around(i % WIDTH, boxes);
            }
            levels.push(std::mem::replace(&mut level, above));
        }
        levels.push(level);
        Bvh { levels, order: Vec::new() }
    }

    /// The leaf that stands for each box.
    pub fn leaves(&self) -> Vec<u32> {
        let mut leaves = vec![0; self.order.len()];
        (0..).zip(&self.order).for_each(|(leaf, &i)| leaves[i as usize] = leaf);
        leaves
    }

    /// Whether the box of a leaf meets a disk, as in a search.
    #[inline]
    pub fn meets(&self, leaf: u32, reach: &Reach) -> bool {
        let (boxes, j) = (&self.levels[0][leaf as usize / WIDTH], leaf as usize % WIDTH);
        let at = |side: &f32x8| side.as_array()[j];
        let dx = (at(&boxes.min_x) - reach.x).max(reach.x - at(&boxes.max_x)).max(0.0);
        let dy = (at(&boxes.min_y) - reach.y).max(reach.y - at(&boxes.max_y)).max(0.0);
        dx * dx + dy * dy <= reach.squared
    }

    /// Calls `visit` for every leaf whose box meets the disk, near boxes first. Whenever `visit`
    /// answers with a disk, the search goes on with that one, which must lie in the last.
    #[inline]
    pub fn search(&self, disk: SearchDisk, visit: impl FnMut(u32) -> Option<SearchDisk>) {
        let all = |_, _| ALL;
        if self.order.is_empty() {
            self.search_where(disk, all, visit);
        } else {
            let mut visit = visit;
            self.search_where(disk, all, |at| visit(self.order[at as usize]));
        }
    }

    /// The same for the leaves of a range.
    #[inline]
    pub fn search_range(
        &self,
        disk: SearchDisk,
        range: std::ops::Range<usize>,
        visit: impl FnMut(u32) -> Option<SearchDisk>,
    ) {
        if !range.is_empty() {
            self.search_where(disk, |first, level| inside(&range, first, level), visit);
        }
    }

    /// The same for some children of each node, told by the number of the first one on its level: a bit for each.
    #[inline]
    fn search_where(
        &self,
        disk: SearchDisk,
        children: impl Fn(usize, u32) -> u32,
        mut visit: impl FnMut(u32) -> Option<SearchDisk>,
    ) {
        let mut reach = Reach::of(&disk);
        let mut stack = [(0u32, 0u32); STACK];
        stack[0] = (self.levels.len() as u32 - 1, 0);
        let mut open = 1;
        while open > 0 {
            open -= 1;
            let (level, index) = stack[open];
            let boxes = &self.levels[level as usize][index as usize];
            let distances = boxes.squared_distances(&reach);
            let first = index as usize * WIDTH;
            let mut bits = distances.simd_le(f32x8::splat(reach.squared)).to_bitmask();
            bits &= children(first, level);
            if level == 0 {
                while bits != 0 {
                    let j = bits.trailing_zeros();
                    bits &= bits - 1;
                    if let Some(smaller) = visit(first as u32 + j) {
                        reach = Reach::of(&smaller);
                        bits &=
                            boxes.squared_distances(&reach).simd_le(f32x8::splat(reach.squared)).to_bitmask();
                    }
                }
                continue;
            }
            // The nearest child is opened first, so it is pushed last.
            let distances = distances.to_array();
            let (mut nearest, mut at) = (f32::INFINITY, open);
            while bits != 0 {
                let j = bits.trailing_zeros();
                bits &= bits - 1;
                stack[open] = (level - 1, first as u32 + j);
                if distances[j as usize] < nearest {
                    (nearest, at) = (distances[j as usize], open);
                }
                open += 1;
            }
            if at < open {
                stack.swap(at, open - 1);
            }
        }
    }
}

/// A bit for each child of a node.
const ALL: u32 = (1 << WIDTH) - 1;

/// The children of a node whose leaves lie in a range, one bit each; `first` is the number of the first
/// child on its level.
#[inline]
fn inside(range: &std::ops::Range<usize>, first: usize, level: u32) -> u32 {
    /// A node has as many leaves as this to the power of its level.
    const BITS: u32 = WIDTH.ilog2();
    let begin = (range.start >> (BITS * level)).saturating_sub(first).min(WIDTH);
    let last = ((range.end - 1) >> (BITS * level)) + 1;
    (ALL << begin) & !(ALL << last.saturating_sub(first).min(WIDTH))
}

/// Steps of the Hilbert curve along a side of the unit frame.
const SIDE: u32 = 1 << 16;

/// Place of a point of the unit frame along a Hilbert curve.
pub(super) fn hilbert(p: Point) -> u32 {
    let cell = |c: f64| (((c + 1.0) * 0.5 * f64::from(SIDE)) as u32).min(SIDE - 1);
    hilbert_place(cell(p.x), cell(p.y))
}

/// Place of a cell along the curve. At every bit the curve turns by one of four symmetries, and these are
/// composed for all bits at once, by distances 1, 2, 4 and 8 between bits, as a parallel prefix sum.
fn hilbert_place(x: u32, y: u32) -> u32 {
    const ALL: u32 = SIDE - 1;
    let (a, b, c, d) = (x ^ y, ALL ^ x ^ y, ALL ^ (x | y), x & (y ^ ALL));
    // The symmetry so far (`swap`, `turn`) and what it makes of the bits (`even`, `odd`).
    let mut swap = a | (b >> 1);
    let mut turn = (a >> 1) ^ a;
    let mut even = ((c >> 1) ^ (b & (d >> 1))) ^ c;
    let mut odd = ((a & (c >> 1)) ^ (d >> 1)) ^ d;
    for step in [2, 4, 8] {
        let (a, b, c, d) = (swap, turn, even, odd);
        swap = (a & (a >> step)) ^ (b & (b >> step));
        turn = (a & (b >> step)) ^ (b & ((a ^ b) >> step));
        even ^= (a & (c >> step)) ^ (b & (d >> step));
        odd ^= (b & (c >> step)) ^ ((a ^ b) & (d >> step));
    }
    let (a, b) = (even ^ (even >> 1), odd ^ (odd >> 1));
    let low = x ^ y;
    let high = b | (ALL ^ (low | a));
    spread(high) << 1 | spread(low)
}

/// The sixteen low bits at the even places.
fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x00FF_00FF;
    let x = (x | x << 4) & 0x0F0F_0F0F;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

/// A search disk in `f32`, its radius rounded up by the round-off of center and boxes.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    x: f32,
    y: f32,
    squared: f32,
}

impl Reach {
    #[inline]
    pub fn of(disk: &SearchDisk) -> Reach {
        /// Center, radius and squared distance are each rounded to `f32` once or twice; eight
        /// roundings relative to all that is involved hold them.
        const ROUNDINGS: f64 = 8.0 * f32::EPSILON as f64;
        let magnitude = disk.center.x.abs() + disk.center.y.abs();
        let radius =
            disk.radius * (1.0 + ROUNDINGS) + magnitude * ROUNDINGS + f64::from(f32::MIN_POSITIVE).sqrt();
        let radius = radius as f32;
        // Boxes around nothing, which fill the last nodes, are infinitely far and meet no disk.
        let squared = (radius * radius).min(f32::MAX);
        Reach { x: disk.center.x as f32, y: disk.center.y as f32, squared }
    }
}

impl Boxes {
    const EMPTY: Boxes = Boxes {
        min_x: f32x8::splat(f32::INFINITY),
        max_x: f32x8::splat(f32::NEG_INFINITY),
        min_y: f32x8::splat(f32::INFINITY),
        max_y: f32x8::splat(f32::NEG_INFINITY),
    };

    fn set(&mut self, j: usize, b: &Bounds) {
        self.min_x.as_mut_array()[j] = (b.min.x as f32).next_down();
        self.min_y.as_mut_array()[j] = (b.min.y as f32).next_down();
        self.max_x.as_mut_array()[j] = (b.max.x as f32).next_up();
        self.max_y.as_mut_array()[j] = (b.max.y as f32).next_up();
    }

    fn set_around(&mut self, j: usize, child: &Boxes) {
        let least = |of: f32x8| of.to_array().into_iter().fold(f32::INFINITY, f32::min);
        let greatest = |of: f32x8| of.to_array().into_iter().fold(f32::NEG_INFINITY, f32::max);
        self.min_x.as_mut_array()[j] = least(child.min_x);
        self.min_y.as_mut_array()[j] = least(child.min_y);
        self.max_x.as_mut_array()[j] = greatest(child.max_x);
        self.max_y.as_mut_array()[j] = greatest(child.max_y);
    }

    /// Squared distance of each box from the center.
    #[inline]
    fn squared_distances(&self, reach: &Reach) -> f32x8 {
        let (x, y) = (f32x8::splat(reach.x), f32x8::splat(reach.y));
        let dx = (self.min_x - x).fast_max(x - self.max_x).fast_max(f32x8::ZERO);
        let dy = (self.min_y - y).fast_max(y - self.max_y).fast_max(f32x8::ZERO);
        dx * dx + dy * dy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn the_hilbert_curve_goes_from_cell_to_neighboring_cell() {
        let mut cells: Vec<(u32, u32, u32)> =
            (0..64 * 64).map(|i| (hilbert_place(i / 64, i % 64), i / 64, i % 64)).collect();
        cells.sort_unstable();
        for (i, w) in (0..).zip(cells.windows(2)) {
            assert_eq!(w[0].0, i);
            assert_eq!(w[0].1.abs_diff(w[1].1) + w[0].2.abs_diff(w[1].2), 1, "{w:?}");
        }
    }

    #[test]
    fn a_search_meets_exactly_the_boxes_in_reach() {
        let places: Vec<_> =
            (0..1000).map(|i| point(f64::from(i % 37) / 37.0, f64::from(i % 101) / 101.0)).collect();
        let bvh = Bvh::build(places.iter().map(|&p| Bounds::around([p])));
        let disk = SearchDisk { center: point(0.4, 0.6), radius: 0.2 };
        let mut found = Vec::new();
        bvh.search_range(disk, 100..900, |i| {
            found.push(i);
            None
        });
        found.sort_unstable();
        let expected: Vec<u32> =
            (100..900).filter(|&i| places[i as usize].distance(disk.center) <= disk.radius).collect();
        assert_eq!(found, expected);
    }
}
