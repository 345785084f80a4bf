//! Arcs that follow each other on one circle with corners that nobody drew, taken as one.
//!
//! The center of an arc is known to the round-off of its places over the square of the angle that it turns
//! by. A circle that somebody drew in two hundred arcs has two hundred centers that have lost four digits;
//! if its places are off by more than a few roundings, it has as many corners and notches as well, and
//! disks that touch several of them would be told from digits that the drawing does not have. So where
//! all places of a run of arcs lie on one arc, to within the round-off by which elements of a pocket may
//! overlap, but their directions do not fit, that arc stands for them if it turns far enough to have a center
//! as good as its places. Runs without corners stay as they are drawn, and so does a circle in quarters: no
//! site turns farther.

use super::joints::{angle_error, sliver};
use super::splice::Drawn;
use crate::boundary::TOUCHING_ULPS;
use crate::geom::{Element, Point};
use std::f64::consts::FRAC_PI_4;

/// Elements of a loop that are one as far as anybody can tell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// The first of them, with the arc that stands for all.
    pub drawn: Drawn,
    /// Length of the shorter chord at its ends, which says how well its directions are known there.
    pub shorter: f64,
    /// By what angle it leaves the directions of the elements at its ends.
    pub turned: f64,
}

impl Run {
    fn single(drawn: Drawn) -> Run {
        Run { drawn, shorter: drawn.element.chord().length(), turned: 0.0 }
    }
}

/// How far a run turns to be one arc, an eighth: the center of an arc that turns by `a` is off by `8 / a^2` times
/// as much as its places, which is a digit there, and more for less.
const ENOUGH: f64 = FRAC_PI_4 * (1.0 - 8.0 * f64::EPSILON);

/// Shows the elements of a row in runs. Those of more than one sweep as much as an arc of the bulge `whole` at most.
pub(super) fn each_run(row: &[Drawn], whole: f64, noise: f64, mut show: impl FnMut(Run)) {
    // A place of the run is off by that much, and so is the arc through three of its places.
    let unite = Unite { noise, off: 2.0 * TOUCHING_ULPS * noise, farthest: 4.0 * whole.atan() };
    let mut first = 0;
    for end in 1..=row.len() {
        if end == row.len() || !unite.goes_on(&row[end - 1], &row[end]) {
            unite.show(&row[first..end], &mut show);
            first = end;
        }
    }
}

struct Unite {
    /// Round-off of a drawn coordinate.
    noise: f64,
    /// By how much places may be off an arc.
    off: f64,
    /// The largest sweep of a run.
    farthest: f64,
}

impl Unite {
    /// Whether two arcs follow each other on their loop and may be of one circle: the height of the shorter
    /// over its chord is that of the other circle's arc, as far as it is known.
    fn goes_on(&self, a: &Drawn, b: &Drawn) -> bool {
        let (e, f) = (&a.element, &b.element);
        if !(e.bulge * f.bulge > 0.0 && a.loop_index == b.loop_index && a.index + 1 == b.index) {
            return false;
        }
        let shorter = e.chord().length_squared().min(f.chord().length_squared());
        let apart = 0.125 * shorter * (e.curvature() - f.curvature()).abs();
        let sliver = sliver(self.noise);
        // Heights count the place in the middle of either twice.
        apart <= 4.0 * self.off && shorter > sliver * sliver
    }

    /// Shows elements as one arc, or in halves where they do not lie on one or turn too far for one.
    fn show(&self, run: &[Drawn], show: &mut impl FnMut(Run)) {
        if let &[one] = run {
            return show(Run::single(one));
        }
        let sweep = run.iter().map(|d| d.element.sweep().abs()).sum::<f64>();
        if sweep < ENOUGH || !run.windows(2).any(|w| self.is_corner(&w[0].element, &w[1].element)) {
            run.iter().for_each(|&one| show(Run::single(one)));
        } else if let Some(united) = self.one_arc(run, sweep) {
            show(united);
        } else {
            let (before, after) = run.split_at(run.len() / 2);
            self.show(before, show);
            self.show(after, show);
        }
    }

    /// Whether two elements meet at an angle that a few roundings do not explain.
    fn is_corner(&self, e: &Element, f: &Element) -> bool {
        let tilts = [e, f].map(|e| e.chord().length().recip());
        e.normals().1.cross(f.normals().0).abs() > angle_error(tilts, self.noise)
    }

    /// The arc that all elements of a run lie on, if there is one.
    fn one_arc(&self, run: &[Drawn], sweep: f64) -> Option<Run> {
        let (first, last) = (run[0].element, run[run.len() - 1].element);
        if sweep > self.farthest {
            return None;
        }
        let arc = arc_through(first.start, run[run.len() / 2].element.start, last.end);
        let is_on = |p: Point| arc.distance(p) <= self.off;
        if !run.iter().all(|d| is_on(d.element.midpoint()) && is_on(d.element.end)) {
            return None;
        }
        let shorter = first.chord().length().min(last.chord().length());
        let (normals, begin, end) = (arc.normals(), first.normals().0, last.normals().1);
        let turned = normals.0.cross(begin).abs().max(normals.1.cross(end).abs());
        Some(Run { drawn: Drawn { element: arc, ..run[0] }, shorter, turned })
    }
}

/// The arc from one place through a second to a third, of less than half a turn.
fn arc_through(start: Point, middle: Point, end: Point) -> Element {
    let (to, from) = (middle - start, end - middle);
    let bulge = to.cross(from) / (to.length() * from.length() + to.dot(from));
    Element { start, end, bulge }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use std::f64::consts::{PI, TAU};

    const NOISE: f64 = f64::EPSILON;
    const QUARTER: f64 = 0.42;

    fn runs(row: &[Drawn]) -> Vec<Run> {
        let mut runs = Vec::new();
        each_run(row, QUARTER, NOISE, |run| runs.push(run));
        runs
    }

    /// A circle in so many arcs, every place of it moved outward by what `off` says of its number.
    fn circle(count: usize, off: impl Fn(usize) -> f64) -> Vec<Drawn> {
        let place = |i: usize| {
            let (sin, cos) = (TAU * (i % count) as f64 / count as f64).sin_cos();
            let radius = 0.5 + off(i % count);
            point(radius * cos, radius * sin)
        };
        let bulge = (0.25 * TAU / count as f64).tan();
        let arc = |i: usize| Element::arc(place(i), place(i + 1), bulge);
        (0..count).map(|i| Drawn { element: arc(i), loop_index: 0, index: i as u32 }).collect()
    }

    #[test]
    fn a_circle_in_many_arcs_is_one_in_quarters() {
        let row = circle(200, |i| [0.0, 30.0, -30.0][i % 3] * NOISE);
        let runs = runs(&row);
        assert_eq!(runs.len(), 4);
        let sweep: f64 = runs.iter().map(|run| run.drawn.element.sweep()).sum();
        assert!((sweep - 2.0 * PI).abs() < 1e-12);
        assert!(runs.windows(2).all(|w| w[0].drawn.element.end == w[1].drawn.element.start));
        assert_eq!(runs[1].drawn.index, 50);
    }

    #[test]
    fn arcs_that_can_be_told_apart_stay_and_so_do_smooth_ones() {
        assert_eq!(runs(&circle(200, |i| [0.0, 1e-12][i % 2])).len(), 200);
        assert_eq!(runs(&circle(200, |_| 0.0)).len(), 200);
        assert_eq!(runs(&circle(4, |i| [30.0, -30.0][i % 2] * NOISE)).len(), 4);
    }

    #[test]
    fn one_place_that_is_off_divides_a_run() {
        let off = |i| if i == 5 { 1e-10 } else { [30.0, -30.0][i % 2] * NOISE };
        let runs = runs(&circle(64, off));
        let is_alone = |index| runs.iter().any(|r| r.drawn.index == index && r.turned == 0.0);
        assert!(is_alone(4) && is_alone(5) && runs.len() < 32, "{}", runs.len());
    }

    #[test]
    fn loops_that_touch_are_not_united_across_the_place() {
        let mut row = circle(16, |i| [30.0, -30.0][i % 2] * NOISE);
        row[7..].iter_mut().for_each(|d| d.loop_index = 1);
        let runs = runs(&row);
        assert!(runs.len() < 16 && runs.iter().any(|run| run.drawn.index == 7));
    }
}
