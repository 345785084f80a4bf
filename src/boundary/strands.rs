//! Which strands of contours cross at a junction, or along what they share from there on.
//!
//! **Method.** Around a junction with several strands the ends of strands that do not cross nest like
//! brackets. Two strands that leave it along the same element are followed to where they part: they
//! cross if they have changed sides.

use super::junction::{Junction, Junctions, Strand};
use crate::geom::ArcSpline;

impl Junction {
    /// Pairs of strands that cross here, where no two branches are in one slot.
    pub(super) fn crossings(&self) -> Vec<(usize, usize)> {
        let mut strand_of = vec![None; self.rank.len()];
        for (i, s) in self.strands.iter().enumerate() {
            if let (Some(from), Some(to)) = (s.from, s.to) {
                (strand_of[from], strand_of[to]) = (Some(i), Some(i));
            }
        }
        let mut found = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        for strand in self.fan.order.iter().filter_map(|&slot| strand_of[slot]) {
            let Some(at) = open.iter().rposition(|&s| s == strand) else {
                open.push(strand);
                continue;
            };
            // Strands opened since and not yet closed have their other ends beyond this one.
            found.extend(open[at + 1..].iter().map(|&other| (strand, other)));
            open.remove(at);
        }
        found
    }

    /// Whether the slots `a` and `b` alternate with `c` and `d` around the place.
    fn alternate(&self, [a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
        self.is_before(a, c, b) != self.is_before(a, d, b)
    }

    /// Whether slot `a` comes before slot `b` counter-clockwise from slot `from`.
    fn is_before(&self, from: usize, a: usize, b: usize) -> bool {
        let n = self.rank.len();
        let turn = |slot: usize| (self.rank[slot] + n - self.rank[from]) % n;
        turn(a) < turn(b)
    }
}

/// A path followed from one of its vertices.
#[derive(Clone, Copy)]
struct Walk<'a> {
    path: usize,
    curve: &'a ArcSpline,
    vertex: usize,
    forward: bool,
}

impl Walk<'_> {
    /// The element ahead.
    fn ahead(&self) -> (usize, usize) {
        let n = self.curve.vertices.len();
        (self.path, if self.forward { self.vertex } else { (self.vertex + n - 1) % n })
    }

    fn step(&mut self) {
        let n = self.curve.vertices.len();
        self.vertex = if self.forward { (self.vertex + 1) % n } else { (self.vertex + n - 1) % n };
    }

    /// Slots behind and ahead of a strand.
    fn slots(&self, strand: &Strand) -> (Option<usize>, Option<usize>) {
        if self.forward { (strand.from, strand.to) } else { (strand.to, strand.from) }
    }
}

impl Junctions {
    /// Pairs of strands that cross at a junction or along what they share from there on.
    pub(super) fn crossings_along(&self, junction: &Junction, paths: &[&ArcSpline]) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        for (i, s) in junction.strands.iter().enumerate() {
            for (j, t) in junction.strands.iter().enumerate().skip(i + 1) {
                let ((Some(a), Some(b)), (Some(c), Some(d))) = ((s.from, s.to), (t.from, t.to)) else {
                    continue;
                };
                let meet = [a, b].iter().filter(|slot| [c, d].contains(slot)).count();
                let crosses = match meet {
                    0 => junction.alternate([a, b], [c, d]),
                    1 => self.part_across(junction, paths, s, t),
                    _ => false,
                };
                if crosses {
                    found.push((i, j));
                }
            }
        }
        found
    }

    /// Whether two strands that share one slot of a junction, by which the first leaves, part on
    /// other sides of each other than they have met.
    fn part_across(&self, junction: &Junction, paths: &[&ArcSpline], s: &Strand, t: &Strand) -> bool {
        if s.from == s.to || t.from == t.to || (s.to != t.to && s.to != t.from) {
            return false;
        }
        let mut a = Walk { path: s.path, curve: paths[s.path], vertex: s.vertex, forward: true };
        let forward = s.to == t.to;
        let mut b = Walk { path: t.path, curve: paths[t.path], vertex: t.vertex, forward };
        let ((Some(behind_a), Some(shared)), (Some(behind_b), _)) = (a.slots(s), b.slots(t)) else {
            return false;
        };
        let a_first = junction.is_before(shared, behind_a, behind_b);
        for _ in 0..a.curve.len() {
            a.step();
            b.step();
            if (a.path, a.vertex) == (b.path, b.vertex) {
                return false;
            }
            let ahead = [a, b].map(|w| self.course.get(&w.ahead()));
            if ahead[0].is_some() && ahead[0] == ahead[1] {
                continue;
            }
            let (Some(&(end, i)), Some(&(_, j))) =
                (self.at.get(&(a.path, a.vertex)), self.at.get(&(b.path, b.vertex)))
            else {
                return false;
            };
            let end = &self.all[end];
            let ((Some(back), Some(ahead_a)), (_, Some(ahead_b))) =
                (a.slots(&end.strands[i]), b.slots(&end.strands[j]))
            else {
                return false;
            };
            return a_first == end.is_before(back, ahead_a, ahead_b);
        }
        false
    }
}
