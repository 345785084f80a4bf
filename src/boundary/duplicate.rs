//! Curves that are drawn more than once.
//!
//! Equal curves have equal boxes, so curves are filed under their rounded boxes and compared only
//! with those filed under the same. A box near the border of a file is looked up in both. Curves
//! that are large against the reach of joining are filed a second time, to find near copies.

use super::grain::Grain;
use crate::geom::{ArcSpline, Point, Vertex};
use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

/// Width of a file in round-offs: wide enough that hardly any box is near a border.
const FILE_WIDTH: f64 = 1024.0;

/// Width of a file for near copies, in reaches: more than a few copies of different curves in one
/// file would cost more than looking up two.
const NEAR_WIDTH: f64 = 16.0;

/// Curves smaller than this many reaches are told apart by round-off alone: what is small is not
/// rough for that.
const LARGE: f64 = 16.0;

/// Counts the copies of curves that were seen before. The curves themselves stay where they are: they
/// are numbered in the order in which they are found to be new.
#[derive(Debug)]
pub(super) struct Seen {
    grain: Grain,
    reach: f64,
    count: u32,
    /// The newest entry of every file, by its key.
    newest: HashMap<u64, u32>,
    entries: Vec<Entry>,
    keys: RandomState,
    /// How many copies there were so far, and the place of the first.
    pub copies: Option<(usize, Point)>,
}

/// A curve in a file, and the entry before it in the same file.
#[derive(Clone, Copy, Debug)]
struct Entry {
    curve: u32,
    before: Option<u32>,
}

/// Files of one width, and how far apart copies in them may be.
#[derive(Clone, Copy)]
struct Files {
    width: f64,
    margin: f64,
    within: f64,
}

impl Seen {
    /// Nothing seen so far; copies of large curves may be off by `reach`.
    pub fn new(grain: Grain, reach: f64) -> Seen {
        let (newest, keys) = (HashMap::new(), RandomState::new());
        Seen { grain, reach, count: 0, newest, entries: Vec::new(), keys, copies: None }
    }

    /// Whether a clean path is new, and not the copy of an earlier one in either direction or,
    /// closed, from another first vertex. `earlier` answers the path that was new as the n-th.
    pub fn is_new<'a>(&mut self, path: &ArcSpline, earlier: impl Fn(usize) -> &'a ArcSpline) -> bool {
        let bounds = path.bounds();
        let sides = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y];
        let kinds = self.files_for(bounds.diagonal());
        for files in kinds.into_iter().flatten() {
            let mut is_copy = false;
            files.each(sides, |file| is_copy |= self.holds(file, files.within, path, &earlier));
            if is_copy {
                self.copies.get_or_insert((0, path.vertices[0].point)).0 += 1;
                return false;
            }
        }
        for files in kinds.into_iter().flatten() {
            let number = self.entries.len() as u32;
            let before = self.newest.insert(self.key(files.of(sides), files.within), number);
            self.entries.push(Entry { curve: self.count, before });
        }
        self.count += 1;
        true
    }

    /// The files for curves of a size. Copies of one differ in size by less than four round-offs, so
    /// that a curve about as large as the limit is filed twice.
    fn files_for(&self, size: f64) -> [Option<Files>; 2] {
        let (same, reach) = (self.grain.same, self.reach);
        let limit = if reach > same { LARGE * reach } else { f64::INFINITY };
        // The box of an arc is as good as its ends, up to the same round-off.
        let exact = Files { width: FILE_WIDTH * same, margin: 2.0 * same, within: same };
        let near = Files { width: NEAR_WIDTH * reach, margin: reach, within: reach };
        [(size <= limit + 4.0 * same).then_some(exact), (size > limit).then_some(near)]
    }

    fn key(&self, file: [i64; 4], within: f64) -> u64 {
        self.keys.hash_one((file, within.to_bits()))
    }

    /// Whether a copy of a path is in a file.
    fn holds<'a>(
        &self,
        file: [i64; 4],
        within: f64,
        path: &ArcSpline,
        earlier: &impl Fn(usize) -> &'a ArcSpline,
    ) -> bool {
        let mut at = self.newest.get(&self.key(file, within)).copied();
        while let Some(entry) = at.map(|at| self.entries[at as usize]) {
            let other = earlier(entry.curve as usize);
            if equal(other, path, within) || (within > self.grain.same && runs_alike(other, path, within)) {
                return true;
            }
            at = entry.before;
        }
        false
    }
}

impl Files {
    /// The file of a box.
    fn of(&self, sides: [f64; 4]) -> [i64; 4] {
        sides.map(|c| if self.width > 0.0 { (c / self.width).floor() as i64 } else { 0 })
    }

    /// Visits all files in which a curve with an equal box may be.
    fn each(&self, sides: [f64; 4], mut visit: impl FnMut([i64; 4])) {
        // The margin is less than half a file, so there are two files for a side at most.
        let (from, to) = (self.of(sides.map(|c| c - self.margin)), self.of(sides.map(|c| c + self.margin)));
        for choice in 0..16 {
            let is_upper = |side: usize| choice >> side & 1 == 1;
            if (0..4).all(|side| !is_upper(side) || from[side] != to[side]) {
                visit([0, 1, 2, 3].map(|side| if is_upper(side) { to[side] } else { from[side] }));
            }
        }
    }
}

fn equal(a: &ArcSpline, b: &ArcSpline, within: f64) -> bool {
    if a.closed != b.closed || a.vertices.len() != b.vertices.len() {
        return false;
    }
    let reversed = b.reversed();
    [b, &reversed].into_iter().any(|b| {
        let starts = if b.closed { b.vertices.len() } else { 1 };
        (0..starts).any(|start| equal_from(a, b, start, within))
    })
}

fn equal_from(a: &ArcSpline, b: &ArcSpline, start: usize, within: f64) -> bool {
    let n = b.vertices.len();
    let same = |a: &Vertex, b: &Vertex| a.point.distance(b.point) <= within;
    let places = (0..n).all(|i| same(&a.vertices[i], &b.vertices[(start + i) % n]));
    places
        && (0..a.len()).all(|i| {
            let (e, f) = (a.element(i), b.element((start + i) % n));
            e.midpoint().distance(f.midpoint()) <= 2.0 * within
        })
}

/// Pairs of elements that are held against each other, at most, to find copies with other vertices.
const MAX_PAIRS: usize = 4096;

/// Whether closed curves lie within a distance of each other although their vertices differ: a circle
/// that is drawn once more, begun elsewhere or of more arcs.
fn runs_alike(a: &ArcSpline, b: &ArcSpline, within: f64) -> bool {
    let is_near = |p: Point, other: &ArcSpline| other.elements().any(|e| e.distance(p) <= within);
    let runs_along = |one: &ArcSpline, other: &ArcSpline| {
        one.elements().all(|e| is_near(e.start, other) && is_near(e.midpoint(), other))
    };
    let is_cheap = a.len().saturating_mul(b.len()) <= MAX_PAIRS;
    a.closed && b.closed && is_cheap && runs_along(a, b) && runs_along(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(closed: bool) -> ArcSpline {
        let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, -0.25), (0.0, 3.0, 0.0)];
        ArcSpline { closed, ..ArcSpline::closed(vertices) }
    }

    /// What was seen, with the curves that were new.
    struct Known(Seen, Vec<ArcSpline>);

    impl Known {
        fn within(reach: f64, of: &ArcSpline) -> Known {
            Known(Seen::new(Grain::of(&of.bounds()), reach), Vec::new())
        }

        fn is_new(&mut self, path: &ArcSpline) -> bool {
            let is_new = self.0.is_new(path, |i| &self.1[i]);
            self.1.extend(is_new.then(|| path.clone()));
            is_new
        }
    }

    fn seen() -> Known {
        Known::within(0.0, &path(true))
    }

    #[test]
    fn a_reversed_or_turned_round_copy_is_a_copy() {
        let mut seen = seen();
        assert!(seen.is_new(&path(true)) && seen.is_new(&path(false)));
        assert!(!seen.is_new(&path(false).reversed()) && !seen.is_new(&path(true).reversed()));
        let mut turned = path(true);
        turned.vertices.rotate_left(3);
        assert!(!seen.is_new(&turned) && !seen.is_new(&turned.reversed()));
        assert!(matches!(seen.0.copies, Some((4, _))));
    }

    #[test]
    fn round_off_makes_no_new_curve_and_a_hair_does() {
        let moved = |by: f64| path(true).mapped(false, |p| p + crate::geom::vector(by, -by));
        let mut seen = seen();
        assert!(seen.is_new(&path(true)));
        assert!(!seen.is_new(&moved(1e-15)) && !seen.is_new(&moved(-1e-15)));
        assert!(seen.is_new(&moved(1e-12)));
    }

    #[test]
    fn a_circle_begun_elsewhere_is_a_copy_up_to_the_reach() {
        let circle = |x: f64| ArcSpline::circle(crate::geom::point(x, 0.0), 2.0);
        let turned = |x: f64| {
            let [a, b] = [(1.2, 1.6), (-1.2, -1.6)].map(|(u, v)| (u + x, v, 1.0));
            ArcSpline::closed([a, b])
        };
        let mut seen = Known::within(0.01, &circle(0.0));
        assert!(seen.is_new(&circle(0.0)) && !seen.is_new(&turned(0.0)) && !seen.is_new(&turned(0.006)));
        assert!(seen.is_new(&turned(0.02)));
        let diamond = [(2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (-2.0, 0.0, 0.0), (0.0, -2.0, 0.0)];
        assert!(seen.is_new(&ArcSpline::closed(diamond)));
    }

    #[test]
    fn a_curve_about_as_large_as_the_limit_finds_its_copy() {
        let line = |length: f64| ArcSpline::open([(0.0, 0.0, 0.0), (length, 0.0, 0.0)]);
        let hair = 4.0 * f64::EPSILON;
        for (a, b) in [(0.16 - hair, 0.16 + hair), (0.16 + hair, 0.16 - hair)] {
            let mut seen = Known::within(0.01, &line(1.0));
            assert!(seen.is_new(&line(a)) && !seen.is_new(&line(b)));
        }
    }

    #[test]
    fn another_bulge_is_another_curve() {
        let mut seen = seen();
        let mut other = path(true);
        other.vertices[1].bulge = 0.4;
        assert!(seen.is_new(&path(true)) && seen.is_new(&other));
        other.vertices[1].bulge = -0.4;
        assert!(seen.is_new(&other));
    }

    #[test]
    fn a_copy_within_reach_is_a_copy_unless_the_curve_is_as_small() {
        let scaled =
            |by: f64, off: f64| path(true).mapped(false, |p| crate::geom::point(by * p.x + off, by * p.y));
        let mut seen = Known::within(0.01, &path(true));
        assert!(seen.is_new(&scaled(1.0, 0.0)) && !seen.is_new(&scaled(1.0, 0.006).reversed()));
        assert!(seen.is_new(&scaled(1.0, 0.02)));
        assert!(seen.is_new(&scaled(0.01, 0.0)) && seen.is_new(&scaled(0.01, 0.006)));
    }
}
