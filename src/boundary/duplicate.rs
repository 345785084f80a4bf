//! Curves that are drawn more than once.
//!
//! Equal curves have equal boxes, so curves are filed under their rounded boxes and compared only
//! with those filed under the same. A box near the border of a file is looked up in both.

use super::grain::Grain;
use crate::error::Defect;
use crate::geom::{ArcSpline, Vertex};
use std::collections::HashMap;

/// Width of a file in round-offs: wide enough that hardly any box is near a border.
const FILE_WIDTH: f64 = 1024.0;

/// Counts the copies of curves that were seen before.
#[derive(Debug)]
pub(super) struct Seen {
    grain: Grain,
    files: HashMap<[i64; 4], Vec<ArcSpline>>,
    /// Copies so far, with the place of the first, as one defect.
    pub duplicates: Option<Defect>,
}

impl Seen {
    /// Nothing seen so far.
    pub fn new(grain: Grain) -> Seen {
        Seen { grain, files: HashMap::new(), duplicates: None }
    }

    /// Whether a clean path is new, and not the copy of an earlier one in either direction or,
    /// closed, from another first vertex.
    pub fn is_new(&mut self, path: &ArcSpline) -> bool {
        let files = self.files_of(path);
        let known = |file| self.files.get(file).is_some_and(|l| l.iter().any(|p| self.equal(p, path)));
        if files.iter().any(known) {
            self.count(path);
            return false;
        }
        self.files.entry(files[0]).or_default().push(path.clone());
        true
    }

    fn count(&mut self, path: &ArcSpline) {
        let place = path.vertices[0].point;
        match &mut self.duplicates {
            Some(Defect::Duplicates { count, .. }) => *count += 1,
            other => *other = Some(Defect::Duplicates { count: 1, at: place }),
        }
    }

    /// All files in which an equal path may be; its own one first.
    fn files_of(&self, path: &ArcSpline) -> Vec<[i64; 4]> {
        let b = path.bounds();
        let sides = [b.min.x, b.min.y, b.max.x, b.max.y];
        // The box of an arc is as good as its ends, up to the same round-off.
        let (width, margin) = (FILE_WIDTH * self.grain.same, 2.0 * self.grain.same);
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

    fn equal(&self, a: &ArcSpline, b: &ArcSpline) -> bool {
        if a.closed != b.closed || a.vertices.len() != b.vertices.len() {
            return false;
        }
        let reversed = b.reversed();
        [b, &reversed].into_iter().any(|b| {
            let starts = if b.closed { b.vertices.len() } else { 1 };
            (0..starts).any(|start| self.equal_from(a, b, start))
        })
    }

    fn equal_from(&self, a: &ArcSpline, b: &ArcSpline, start: usize) -> bool {
        let n = b.vertices.len();
        let same = |a: &Vertex, b: &Vertex| a.point.distance(b.point) <= self.grain.same;
        let places = (0..n).all(|i| same(&a.vertices[i], &b.vertices[(start + i) % n]));
        places
            && (0..a.len()).all(|i| {
                let (e, f) = (a.element(i), b.element((start + i) % n));
                e.midpoint().distance(f.midpoint()) <= 2.0 * self.grain.same
            })
    }
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
        Seen::new(Grain::of(&path(true).bounds()))
    }

    #[test]
    fn a_reversed_or_turned_round_copy_is_a_copy() {
        let mut seen = seen();
        assert!(seen.is_new(&path(true)) && seen.is_new(&path(false)));
        assert!(!seen.is_new(&path(false).reversed()) && !seen.is_new(&path(true).reversed()));
        let mut turned = path(true);
        turned.vertices.rotate_left(3);
        assert!(!seen.is_new(&turned) && !seen.is_new(&turned.reversed()));
        assert!(matches!(seen.duplicates, Some(Defect::Duplicates { count: 4, .. })));
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
    fn another_bulge_is_another_curve() {
        let mut seen = seen();
        let mut other = path(true);
        other.vertices[1].bulge = 0.4;
        assert!(seen.is_new(&path(true)) && seen.is_new(&other));
        other.vertices[1].bulge = -0.4;
        assert!(seen.is_new(&other));
    }
}
