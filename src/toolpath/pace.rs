//! Where a pass is fed more slowly, because more is cut there than the step.
//!
//! **Needs** the stretches of a pass that have no neighbor inside: what the axis tells (`width`).
//! **Guarantees** that all of them are slow, and the pass before each by the radius of the tool, as its
//! front meets there first what its center comes to later.
//! **Does not** slow down more where more is cut.

use super::course::Course;
use super::indexed::Indexed;
use crate::geom::Element;
use rstar::RTree;

/// Stretches of a course, as lengths along it.
#[derive(Clone, Debug, Default)]
pub(super) struct Pace {
    /// From where to where it is slow, in order and apart from each other.
    slow: Vec<[f64; 2]>,
}

impl Pace {
    /// All of a course is slow.
    pub fn slow() -> Pace {
        Pace { slow: vec![[0.0, f64::INFINITY]] }
    }

    /// Whether nothing is slow.
    pub fn is_even(&self) -> bool {
        self.slow.is_empty()
    }

    /// Slow on stretches of a course, and `before` them by that length.
    pub fn new(course: &Course, stretches: &[Element], before: f64, slack: f64) -> Pace {
        let mut starts = vec![0.0];
        for e in course.elements.iter() {
            starts.push(starts[starts.len() - 1] + e.length());
        }
        let elements = course.elements.iter().enumerate().map(|(i, e)| Indexed::new(*e, i));
        let tree = RTree::bulk_load(elements.collect());
        let mut slow = Vec::new();
        for stretch in stretches {
            for on in [stretch.start, stretch.midpoint(), stretch.end] {
                let near = tree.locate_within_distance([on.x, on.y], slack * slack);
                slow.extend(near.map(|found| {
                    let at = |p| found.element.parameter(p).clamp(0.0, 1.0) * found.element.length();
                    let (a, b) = (at(stretch.start), at(stretch.end));
                    [a.min(b), a.max(b)].map(|s| starts[found.index] + s)
                }));
            }
        }
        let whole = starts[starts.len() - 1];
        let early: Vec<[f64; 2]> = slow.iter().map(|[a, b]| [a - before, *b]).collect();
        // What begins before the start of a loop is at its end.
        let over = early.iter().filter(|[a, _]| course.closed && *a < 0.0).map(|[a, _]| [whole + a, whole]);
        Pace::merged(over.chain(early.iter().copied()).collect())
    }

    fn merged(mut slow: Vec<[f64; 2]>) -> Pace {
        slow.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut merged: Vec<[f64; 2]> = Vec::new();
        for [a, b] in slow.into_iter().filter(|[a, b]| b > a) {
            match merged.last_mut() {
                Some(last) if a <= last[1] => last[1] = last[1].max(b),
                _ => merged.push([a.max(0.0), b]),
            }
        }
        Pace { slow: merged }
    }

    /// The parts of a stretch of the course, and whether each is slow; none is shorter than `slack` but
    /// the whole.
    pub fn parts(&self, from: f64, to: f64, slack: f64) -> Vec<([f64; 2], bool)> {
        let mut parts: Vec<([f64; 2], bool)> = Vec::new();
        let mut at = from;
        let first = self.slow.partition_point(|[_, b]| *b <= from + slack);
        for &[a, b] in self.slow[first..].iter().take_while(|[a, _]| *a < to - slack) {
            if a > at + slack {
                parts.push(([at, a], false));
                at = a;
            }
            let end = if b < to - slack { b } else { to };
            parts.push(([at, end], true));
            at = end;
        }
        if at < to {
            parts.push(([at, to], false));
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};

    fn square() -> Course {
        let s = ArcSpline::closed([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0)]);
        Course::along(&s, false).unwrap()
    }

    #[test]
    fn a_stretch_is_slow_and_what_comes_before_it() {
        let stretch = Element::segment(point(10.0, 2.0), point(10.0, 4.0));
        let pace = Pace::new(&square(), &[stretch], 3.0, 1e-9);
        assert_eq!(pace.slow, [[9.0, 14.0]]);
        assert_eq!(pace.parts(0.0, 10.0, 1e-9), [([0.0, 9.0], false), ([9.0, 10.0], true)]);
        assert_eq!(pace.parts(10.0, 20.0, 1e-9), [([10.0, 14.0], true), ([14.0, 20.0], false)]);
        assert_eq!(pace.parts(20.0, 30.0, 1e-9), [([20.0, 30.0], false)]);
    }

    #[test]
    fn a_stretch_at_the_start_reaches_back_over_the_end() {
        let stretch = Element::segment(point(1.0, 0.0), point(2.0, 0.0));
        assert_eq!(Pace::new(&square(), &[stretch], 3.0, 1e-9).slow, [[0.0, 2.0], [38.0, 40.0]]);
    }

    #[test]
    fn a_stretch_over_the_start_is_found_on_both_sides_of_it() {
        let begun = square().begun_at(square().nearest(point(5.0, -1.0)), 1e-9);
        let stretch = Element::segment(point(4.0, 0.0), point(7.0, 0.0));
        assert_eq!(Pace::new(&begun, &[stretch], 0.0, 1e-9).slow, [[0.0, 2.0], [39.0, 40.0]]);
        assert_eq!(Pace::slow().parts(3.0, 5.0, 1e-9), [([3.0, 5.0], true)]);
    }
}
