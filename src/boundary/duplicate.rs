//! Curves that are drawn more than once.
//!
//! Equal curves have equal boxes, so curves are filed under their rounded boxes and compared only
//! with those filed under the same. A box near the border of a file is looked up in both. Curves
//! that are large against the reach of joining are filed a second time, to find near copies.

use super::grain::Grain;
use crate::error::Defect;
use crate::geom::{ArcSpline, Point, Vertex};
use std::collections::HashMap;

/// Width of a file in round-offs: wide enough that hardly any box is near a border.
const FILE_WIDTH: f64 = 1024.0;

/// Width of a file for near copies, in reaches: more than a few copies of different curves in one
/// file would cost more than looking up two.
const NEAR_WIDTH: f64 = 16.0;

/// Curves smaller than this many reaches are told apart by round-off alone: what is small is not
/// rough for that.
const LARGE: f64 = 16.0;

/// Counts the copies of curves that were seen before.
#[derive(Debug)]
pub(super) struct Seen {
    grain: Grain,
    reach: f64,
    curves: Vec<ArcSpline>,
    files: HashMap<[i64; 4], Vec<u32>>,
    near_files: HashMap<[i64; 4], Vec<u32>>,
    /// How many copies there were so far, and the place of the first.
    pub copies: Option<(usize, Point)>,
}

impl Seen {
    /// Nothing seen so far; copies of large curves may be off by `reach`.
    pub fn new(grain: Grain, reach: f64) -> Seen {
        let (files, near_files) = (HashMap::new(), HashMap::new());
        Seen { grain, reach, curves: Vec::new(), files, near_files, copies: None }
    }

    /// Whether a clean path is new, and not the copy of an earlier one in either direction or,
    /// closed, from another first vertex.
    pub fn is_new(&mut self, path: &ArcSpline) -> bool {
        let bounds = path.bounds();
        let sides = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y];
        let same = self.grain.same;
        // The box of an arc is as good as its ends, up to the same round-off.
        let files = files_of(sides, FILE_WIDTH * same, 2.0 * same);
        let is_large = self.reach > same && bounds.diagonal() > LARGE * self.reach;
        let near_files = if is_large { files_of(sides, NEAR_WIDTH * self.reach, self.reach) } else { vec![] };
        let candidates = |known: &HashMap<[i64; 4], Vec<u32>>, files: &[[i64; 4]]| {
            let numbers: Vec<u32> = files.iter().filter_map(|f| known.get(f)).flatten().copied().collect();
            numbers.into_iter().map(|c| &self.curves[c as usize])
        };
        let is_copy = |c: &ArcSpline| equal(c, path, same);
        let is_near = |c: &ArcSpline| equal(c, path, self.reach) || runs_alike(c, path, self.reach);
        if candidates(&self.files, &files).any(is_copy)
            || candidates(&self.near_files, &near_files).any(is_near)
        {
            self.copies.get_or_insert((0, path.vertices[0].point)).0 += 1;
            return false;
        }
        let number = self.curves.len() as u32;
        self.files.entry(files[0]).or_default().push(number);
        if let Some(&file) = near_files.first() {
            self.near_files.entry(file).or_default().push(number);
        }
        self.curves.push(path.clone());
        true
    }

    /// All copies so far as one defect.
    pub fn defect(&self) -> Option<Defect> {
        self.copies.map(|(count, at)| Defect::Duplicates { count, at })
    }
}

/// All files in which a curve with an equal box may be; that of the box itself first.
fn files_of(sides: [f64; 4], width: f64, margin: f64) -> Vec<[i64; 4]> {
    let number = |c: f64| if width > 0.0 { (c / width).floor() as i64 } else { 0 };
    let mut files = vec![sides.map(number)];
    for side in 0..4 {
        for shifted in [number(sides[side] - margin), number(sides[side] + margin)] {
            if shifted != files[0][side] {
                let copies: Vec<_> = files.iter().map(|f| with(*f, side, shifted)).collect();
                files.extend(copies);
            }
        }
    }
    files
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

fn with(mut file: [i64; 4], side: usize, number: i64) -> [i64; 4] {
    file[side] = number;
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(closed: bool) -> ArcSpline {
        let vertices = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, -0.25), (0.0, 3.0, 0.0)];
        ArcSpline { closed, ..ArcSpline::closed(vertices) }
    }

    fn seen() -> Seen {
        Seen::new(Grain::of(&path(true).bounds()), 0.0)
    }

    #[test]
    fn a_reversed_or_turned_round_copy_is_a_copy() {
        let mut seen = seen();
        assert!(seen.is_new(&path(true)) && seen.is_new(&path(false)));
        assert!(!seen.is_new(&path(false).reversed()) && !seen.is_new(&path(true).reversed()));
        let mut turned = path(true);
        turned.vertices.rotate_left(3);
        assert!(!seen.is_new(&turned) && !seen.is_new(&turned.reversed()));
        assert!(matches!(seen.defect(), Some(Defect::Duplicates { count: 4, .. })));
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
        let mut seen = Seen::new(Grain::of(&circle(0.0).bounds()), 0.01);
        assert!(seen.is_new(&circle(0.0)) && !seen.is_new(&turned(0.0)) && !seen.is_new(&turned(0.006)));
        assert!(seen.is_new(&turned(0.02)));
        let diamond = [(2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (-2.0, 0.0, 0.0), (0.0, -2.0, 0.0)];
        assert!(seen.is_new(&ArcSpline::closed(diamond)));
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
        let mut seen = Seen::new(Grain::of(&path(true).bounds()), 0.01);
        assert!(seen.is_new(&scaled(1.0, 0.0)) && !seen.is_new(&scaled(1.0, 0.006).reversed()));
        assert!(seen.is_new(&scaled(1.0, 0.02)));
        assert!(seen.is_new(&scaled(0.01, 0.0)) && seen.is_new(&scaled(0.01, 0.006)));
    }
}
