//! The way that a pass takes: a chain of elements that may begin anywhere on a loop.

use super::tally::Tally;
use crate::geom::{ArcSpline, Element, Point};
use std::cell::OnceCell;
use std::sync::Arc;

/// Elements from which on a course is worth to be known again at the next height.
pub(super) const LONG: usize = 1 << 10;

/// Turn between two elements, in radians, from which on their joint counts as a corner: joints of arc
/// splines turn by round-off, corners that are seen on a part by degrees.
const CORNER: f64 = 0.01;

/// Round-off of a difference of two distances, against the distance that it is held against.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// Of so many elements the start of one tells how near a course comes at least.
const SOME: usize = 64;

/// Elements in order of travel; closed when the last ends where the first begins.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub elements: Arc<Vec<Element>>,
    pub closed: bool,
    /// Where it begins; the only place of a course without elements.
    pub start: Point,
    /// No chord is longer, nor one over what is left out between elements.
    longest: f64,
    tally: OnceCell<Option<Tally>>,
}

/// A place on a course, for beginning there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub element: usize,
    pub point: Point,
    pub distance: f64,
}

impl Course {
    /// Along a spline, in its sense or against it. `None` where it has no vertex.
    pub fn along(spline: &ArcSpline, backwards: bool) -> Option<Course> {
        let start = spline.vertices.first()?.point;
        let n = spline.len();
        // One more than there are, as the course may begin within one.
        let mut elements = Vec::with_capacity(n + 1);
        if backwards {
            elements.extend((0..n).rev().map(|i| spline.element(i).reversed()));
        } else {
            elements.extend(spline.elements());
        }
        let is_useful = |e: &Element| e.is_finite() && (e.start != e.end);
        let longest = if elements.iter().all(is_useful) { longest_chord(&elements) } else { f64::INFINITY };
        if longest == f64::INFINITY {
            elements.retain(is_useful);
        }
        let start = elements.first().map_or(start, |e| e.start);
        let elements = Arc::new(elements);
        Some(Course { elements, closed: spline.closed, start, longest, tally: OnceCell::new() })
    }

    /// The same course along other elements.
    fn with(&self, elements: Vec<Element>) -> Course {
        let start = elements.first().map_or(self.start, |e| e.start);
        let (elements, tally) = (Arc::new(elements), OnceCell::new());
        Course { elements, start, tally, closed: self.closed, longest: self.longest }
    }

    /// What the moves along it amount to, if it is long and each of its elements one move. Copies that are made
    /// later know it.
    pub fn tally(&self) -> Option<Tally> {
        let tally = || if self.elements.len() >= LONG { Tally::of(&self.elements) } else { None };
        *self.tally.get_or_init(tally)
    }

    /// Whether another course along the same spline is this one.
    pub fn is_same(&self, other: &Course) -> bool {
        let ends = |c: &Course| (c.elements.len(), c.elements.first().copied(), c.elements.last().copied());
        ends(self) == ends(other)
    }

    /// A closed course begun at another of its elements.
    pub fn rotated(&self, first: usize) -> Course {
        let mut elements = self.elements.to_vec();
        elements.rotate_left(first);
        self.with(elements)
    }

    /// Length along the course.
    pub fn length(&self) -> f64 {
        self.elements.iter().map(Element::length).sum()
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        self.elements.last().map_or(self.start, |e| e.end)
    }

    /// The place nearest to `p` where the course can begin: anywhere when closed, else an end.
    pub fn nearest(&self, p: Point) -> Place {
        if !self.closed || self.elements.is_empty() {
            let (a, b) = (self.start.distance(p), self.end().distance(p));
            let last = self.elements.len();
            return if a <= b {
                Place { element: 0, point: self.start, distance: a }
            } else {
                Place { element: last, point: self.end(), distance: b }
            };
        }
        let mut best = Place { element: 0, point: self.start, distance: f64::INFINITY };
        let some = self.elements.iter().step_by(SOME).map(|e| e.start.distance(p));
        let nearest_start = some.fold(f64::INFINITY, f64::min);
        let mut element = 0;
        while let Some(e) = self.elements.get(element) {
            // No place of an arc up to a half circle is farther from its start than its end is.
            let beside = e.start.distance(p) - e.chord().length();
            let beyond = beside - best.distance.min(nearest_start) * (1.0 + ROUNDINGS);
            if e.bulge.abs() <= 1.0 && beyond > 0.0 {
                // Nor can the next ones come nearer than by the longest chord each.
                element = element.saturating_add((beyond / self.longest) as usize).max(element + 1);
                continue;
            }
            let near = e.nearest(p);
            if near.distance < best.distance {
                best = Place { element, point: near.point, distance: near.distance };
            }
            element += 1;
        }
        best
    }

    /// The middle of the longest element: away from corners.
    pub fn calm_place(&self) -> Point {
        let mut longest = (0.0, self.start);
        for e in self.elements.iter() {
            let length = e.length();
            if length > longest.0 {
                longest = (length, e.midpoint());
            }
        }
        longest.1
    }

    /// The same course begun at a place of it; an open one is turned round where that is its end.
    /// Parts shorter than `slack` are not split off.
    pub fn begun_at(&self, place: Place, slack: f64) -> Course {
        self.clone().begin_at(place, slack)
    }

    /// The same, in the room of this one unless that is held elsewhere too.
    pub fn begin_at(self, place: Place, slack: f64) -> Course {
        if !self.closed && place.element > 0 {
            return self.turned();
        }
        if !self.closed || self.elements.is_empty() {
            return self;
        }
        let e = self.elements[place.element];
        let (before, after) = e.split(e.parameter(place.point));
        // A place next to a vertex is the vertex: no element of round-off length.
        let is_start = before.length() <= slack;
        let is_end = !is_start && after.length() <= slack;
        let mut elements = self.elements;
        let begun = Arc::make_mut(&mut elements);
        begun.rotate_left(place.element + usize::from(is_end));
        if !(is_start || is_end) {
            begun[0] = after;
            begun.push(before);
        }
        Course { start: begun[0].start, elements, tally: OnceCell::new(), ..self }
    }

    /// The same course from its end to its start.
    pub fn turned(&self) -> Course {
        self.with(self.elements.iter().rev().map(Element::reversed).collect())
    }

    /// The last stretch of a given length of a closed course, run round as often as it takes.
    pub fn tail(&self, length: f64) -> Vec<Element> {
        let mut parts = Vec::new();
        let mut left = length;
        while left > 0.0 {
            for e in self.elements.iter().rev() {
                let own = e.length();
                if own >= left {
                    parts.push(if own > left { e.part(1.0 - left / own, 1.0) } else { *e });
                    left = 0.0;
                    break;
                }
                parts.push(*e);
                left -= own;
            }
        }
        parts.reverse();
        parts
    }
}

/// Length of the longest chord; beyond any where an element is more than half a circle.
fn longest_chord(elements: &[Element]) -> f64 {
    let squared = elements
        .iter()
        .map(|e| if e.bulge.abs() <= 1.0 { e.chord().length_squared() } else { f64::INFINITY });
    squared.fold(0.0, f64::max).sqrt()
}

/// Whether there is a corner between an element and the next.
pub(super) fn turns(a: &Element, b: &Element) -> bool {
    a.tangents().1.angle_to(b.tangents().0).abs() > CORNER
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn square() -> Course {
        let s = ArcSpline::closed([(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 4.0, 0.0), (0.0, 4.0, 0.0)]);
        Course::along(&s, false).unwrap()
    }

    #[test]
    fn a_closed_course_begins_at_the_nearest_place() {
        let s = square();
        let at = s.nearest(point(3.0, 1.5));
        assert_eq!((at.distance, at.point), (1.0, point(4.0, 1.5)));
        let c = s.begun_at(at, 1e-12);
        assert_eq!(c.start, c.end());
        assert_eq!(c.start, at.point);
        assert_eq!((c.elements.len(), c.length()), (5, 16.0));
    }

    #[test]
    fn nothing_nearer_is_passed_over() {
        let vertex = |i: u32| {
            let (angle, r) = (0.02 * f64::from(i), 5.0 + f64::from(i % 7));
            (r * angle.cos(), r * angle.sin(), [0.3, 0.0, 0.0, 0.0, 0.0][i as usize % 5])
        };
        let star = Course::along(&ArcSpline::closed((0..314).map(vertex)), false).unwrap();
        for i in 0..400 {
            let angle = 0.7 * f64::from(i);
            let p = point(0.04 * f64::from(i) * angle.cos(), 0.04 * f64::from(i) * angle.sin());
            let nearest = star.elements.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
            assert_eq!(star.nearest(p).distance, nearest);
        }
    }

    #[test]
    fn a_place_at_a_vertex_splits_nothing() {
        let s = square();
        let c = s.begun_at(s.nearest(point(5.0, 5.0)), 1e-12);
        assert_eq!((c.start, c.elements.len()), (point(4.0, 4.0), 4));
    }

    #[test]
    fn an_open_course_begins_at_its_nearer_end() {
        let o = ArcSpline::open([(0.0, 0.0, 0.5), (2.0, 0.0, 0.0), (5.0, 0.0, 0.0)]);
        let c = Course::along(&o, false).unwrap();
        let c = c.begun_at(c.nearest(point(6.0, 0.0)), 1e-12);
        assert_eq!((c.start, c.end()), (point(5.0, 0.0), point(0.0, 0.0)));
        assert_eq!(c.elements[1].bulge, -0.5);
    }

    #[test]
    fn a_tail_ends_where_the_course_ends_and_goes_round() {
        let t = square().tail(18.0);
        assert_eq!(t.first().unwrap().start, point(0.0, 2.0));
        assert_eq!(t.last().unwrap().end, point(0.0, 0.0));
        assert!((t.iter().map(Element::length).sum::<f64>() - 18.0).abs() < 1e-12);
    }

    #[test]
    fn running_backwards_turns_every_element() {
        let c = ArcSpline::circle(point(0.0, 0.0), 1.0);
        let back = Course::along(&c, true).unwrap();
        assert_eq!((back.start, back.end()), (point(1.0, 0.0), point(1.0, 0.0)));
        assert!(back.elements.iter().all(|e| e.bulge == -1.0));
    }
}
