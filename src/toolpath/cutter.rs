//! The tool in the machine: appends moves, knows where it is, and adds up lengths and time.

use super::course::Course;
use super::{Job, Move, Moves, Point3};
use crate::geom::{Element, Point};
use crate::tolerance::Units;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// What a path amounts to. Lengths in job units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Length of all feed moves.
    pub cut_length: f64,
    /// Length of all rapid moves.
    pub rapid_length: f64,
    /// How often the tool leaves the stock for the next place, the end of the path included.
    pub retracts: usize,
    /// Circular moves.
    pub arcs: usize,
    /// Straight feed moves.
    pub lines: usize,
    /// Time, with rapids at 5000 mm (200 inch) per minute, and the acceleration of the job: the tool stops
    /// at corners.
    pub minutes: f64,
}

impl Totals {
    /// Both together.
    pub(super) fn and(&self, more: &Totals) -> Totals {
        Totals {
            cut_length: self.cut_length + more.cut_length,
            rapid_length: self.rapid_length + more.rapid_length,
            retracts: self.retracts + more.retracts,
            arcs: self.arcs + more.arcs,
            lines: self.lines + more.lines,
            minutes: self.minutes + more.minutes,
        }
    }

    /// What came on top of earlier totals.
    pub(super) fn since(&self, before: &Totals) -> Totals {
        Totals {
            cut_length: self.cut_length - before.cut_length,
            rapid_length: self.rapid_length - before.rapid_length,
            retracts: self.retracts - before.retracts,
            arcs: self.arcs - before.arcs,
            lines: self.lines - before.lines,
            minutes: self.minutes - before.minutes,
        }
    }
}

/// Minutes of a rapid, which starts and stops: at most 5000 mm (200 inch) per minute, a light machine.
/// The decision between a link and a way over depends on it.
pub(super) fn rapid_minutes(length: f64, job: &Job) -> f64 {
    const SECONDS: f64 = 60.0;
    let acceleration = job.acceleration * SECONDS * SECONDS;
    let rate = match job.units {
        Units::Mm => 5000.0,
        Units::Inch => 200.0,
    };
    if length * acceleration < rate * rate {
        2.0 * (length / acceleration).sqrt()
    } else {
        length / rate + rate / acceleration
    }
}

/// Appends moves.
pub(super) struct Cutter<'a> {
    job: &'a Job,
    at: Option<Point3>,
    pub moves: Moves,
    pub totals: Totals,
}

impl<'a> Cutter<'a> {
    /// A tool that is nobody knows where.
    pub fn new(job: &'a Job) -> Cutter<'a> {
        Cutter { job, at: None, moves: Moves::default(), totals: Totals::default() }
    }

    /// Where the tool is in the drawing, once it has moved.
    pub fn at(&self) -> Option<Point> {
        self.at.map(Point3::xy)
    }

    /// The height at which the tool is, once it has moved.
    pub fn height(&self) -> Option<f64> {
        self.at.map(|at| at.z)
    }

    /// Height of rapids across.
    fn clearance(&self) -> f64 {
        self.job.top + self.job.clearance
    }

    /// Up to the clearance, across to `p`, and down through air to `retract` above the surface.
    pub fn over(&mut self, p: Point, surface: f64) {
        self.leave();
        let clearance = self.clearance();
        self.rapid(Point3::new(p, clearance));
        let near = surface + self.job.retract;
        if near < clearance {
            self.rapid(Point3::new(p, near));
        }
    }

    /// Up to the clearance, if the tool is anywhere yet.
    pub fn leave(&mut self) {
        let clearance = self.clearance();
        if let Some(at) = self.at
            && at.z < clearance
        {
            self.totals.retracts += 1;
            self.rapid(Point3 { z: clearance, ..at });
        }
    }

    /// Minutes that it takes to be over a place and from there down to `surface`.
    pub fn minutes_over(&self, p: Point, surface: f64) -> f64 {
        let Some(at) = self.at else { return f64::INFINITY };
        let clearance = self.clearance();
        let near = (surface + self.job.retract).min(clearance);
        let rapids = [clearance - at.z, at.xy().distance(p), clearance - near];
        let rapids: f64 = rapids.into_iter().map(|length| rapid_minutes(length, self.job)).sum();
        rapids + (near - surface) / self.job.plunge_feed
    }

    /// Straight down to a height, at the plunge feed.
    pub fn plunge(&mut self, z: f64) {
        if let Some(at) = self.at {
            self.line(at.xy(), z, self.job.plunge_feed);
        }
    }

    /// Along an element at the feed rate, at the height where the tool is.
    pub fn cut(&mut self, e: &Element) {
        let z = self.at.map_or(self.clearance(), |at| at.z);
        self.follow(e, z, self.job.feed);
    }

    /// Along a course as if each of its elements were [cut](Cutter::cut). The moves along a long one are held as
    /// its elements; their lengths are added up apart, and so differ by round-off.
    pub fn cut_all(&mut self, course: &Course) {
        let at = self.at.filter(|at| at.xy() == course.start);
        let (Some(at), Some(tally)) = (at, course.tally()) else {
            return course.elements.iter().for_each(|e| self.cut(e));
        };
        let rate = self.job.feed;
        self.totals.arcs += tally.arcs;
        self.totals.lines += course.elements.len() - tally.arcs;
        self.totals.cut_length += tally.length;
        self.totals.minutes += tally.length / rate;
        self.moves.push_along(course.elements.clone(), at.z, rate);
        self.at = Some(Point3::new(course.end(), at.z));
    }

    /// The same at a share of the feed rate.
    pub fn cut_at(&mut self, e: &Element, share: f64) {
        let z = self.at.map_or(self.clearance(), |at| at.z);
        self.follow(e, z, share * self.job.feed);
    }

    /// Along an element to a height, evenly.
    pub fn follow(&mut self, e: &Element, z: f64, rate: f64) {
        let from = self.at.map_or(z, |at| at.z);
        let parts = half_circles(e);
        for i in 1..=parts {
            let t = |i: usize| i as f64 / parts as f64;
            let part = if parts == 1 { *e } else { e.part(t(i - 1), t(i)) };
            let z = if i == parts { z } else { from + (z - from) * t(i) };
            let (m, length) = motion(self.at, &part, z, rate);
            self.go(m, length);
        }
    }

    fn rapid(&mut self, to: Point3) {
        if self.at == Some(to) {
            return;
        }
        let length = self.at.map_or(0.0, |at| at.distance(to));
        self.totals.rapid_length += length;
        self.totals.minutes += rapid_minutes(length, self.job);
        self.moves.push(Move::Rapid { to });
        self.at = Some(to);
    }

    /// Straight at a rate.
    pub fn line(&mut self, p: Point, z: f64, rate: f64) {
        let to = Point3::new(p, z);
        self.go(Move::Feed { to, rate }, self.at.map_or(0.0, |at| at.distance(to)));
    }

    /// A feed move, unless it is a line to where the tool is.
    fn go(&mut self, m: Move, length: f64) {
        match m {
            Move::Arc { .. } => self.totals.arcs += 1,
            _ if self.at == Some(m.to()) => return,
            _ => self.totals.lines += 1,
        }
        self.totals.cut_length += length;
        self.totals.minutes += m.rate().map_or(0.0, |rate| length / rate);
        self.moves.push(m);
        self.at = Some(m.to());
    }
}

/// The move along an element of half a circle at most, and its length.
fn motion(at: Option<Point3>, e: &Element, z: f64, rate: f64) -> (Move, f64) {
    let m = Move::along(e, z, rate);
    let length = match (m, e.center()) {
        (Move::Arc { .. }, Some((_, radius))) => {
            (radius * e.sweep().abs()).hypot(at.map_or(0.0, |at| z - at.z))
        }
        _ => at.map_or(0.0, |at| at.distance(m.to())),
    };
    (m, length)
}

/// In how many equal parts of at most a half circle an element goes.
fn half_circles(e: &Element) -> usize {
    /// Round-off of `4 atan(bulge) / pi` at a bulge of 1.
    const QUOTIENT_ERROR: f64 = 4.0 * f64::EPSILON;
    if e.bulge.abs() <= 1.0 {
        return 1;
    }
    (e.sweep().abs() / PI * (1.0 - QUOTIENT_ERROR)).ceil().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn the_first_motion_is_up_and_over_and_no_arc_exceeds_a_half_circle() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let mut cutter = Cutter::new(&job);
        cutter.over(point(1.0, 0.0), 0.0);
        cutter.plunge(-1.0);
        let most = Element::arc(point(1.0, 0.0), point(0.0, -1.0), (3.0 * PI / 8.0).tan());
        cutter.follow(&most, -2.0, 100.0);
        cutter.leave();
        let places: Vec<Point3> = cutter.moves.iter().map(|m| m.to()).collect();
        assert_eq!(places[0], Point3 { x: 1.0, y: 0.0, z: 5.0 });
        assert_eq!(places[1].z, 1.0);
        assert_eq!((cutter.totals.arcs, cutter.totals.lines, cutter.totals.retracts), (2, 1, 1));
        assert_eq!(places[3].z, -1.5);
        assert!((cutter.totals.rapid_length - (4.0 + 7.0)).abs() < 1e-12);
        let arc = (1.5 * PI).hypot(1.0);
        assert!((cutter.totals.cut_length - (2.0 + arc)).abs() < 1e-3);
    }

    #[test]
    fn the_time_of_a_way_over_is_known_before_it_is_taken() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let mut cutter = Cutter::new(&job);
        cutter.over(point(1.0, 0.0), 0.0);
        cutter.plunge(-1.0);
        let (before, expected) = (cutter.totals.minutes, cutter.minutes_over(point(40.0, 3.0), -1.0));
        cutter.over(point(40.0, 3.0), -1.0);
        cutter.plunge(-1.0);
        assert!((cutter.totals.minutes - before - expected).abs() < 1e-12);
    }

    #[test]
    fn moves_along_a_long_course_are_those_one_by_one() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let vertex = |i: u32| {
            let angle = 0.002 * f64::from(i);
            (50.0 * angle.cos(), 50.0 * angle.sin(), [0.0, 1e-18, 0.4][i as usize % 3])
        };
        let cut = |bulge: f64, at_once: bool| {
            let mut spline = crate::geom::ArcSpline::closed((0..3100).map(vertex));
            spline.vertices[7].bulge = bulge;
            let course = Course::along(&spline, false).unwrap();
            let mut cutter = Cutter::new(&job);
            cutter.over(course.start, 0.0);
            cutter.plunge(-1.0);
            match at_once {
                true => cutter.cut_all(&course),
                false => course.elements.iter().for_each(|e| cutter.cut(e)),
            }
            assert_eq!(course.tally().is_some(), bulge <= 1.0);
            (cutter.at, cutter.moves, cutter.totals)
        };
        for bulge in [0.0, 1.0, 3.0] {
            let (one_by_one, at_once) = (cut(bulge, false), cut(bulge, true));
            assert_eq!((one_by_one.0, &one_by_one.1), (at_once.0, &at_once.1));
            let [a, b] = [one_by_one.2, at_once.2];
            assert_eq!((a.arcs, a.lines, a.rapid_length), (b.arcs, b.lines, b.rapid_length));
            assert!((a.cut_length - b.cut_length).abs() < 1e-10 * a.cut_length);
            assert!((a.minutes - b.minutes).abs() < 1e-10 * a.minutes);
        }
    }

    #[test]
    fn an_arc_as_good_as_straight_is_a_line() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let mut cutter = Cutter::new(&job);
        cutter.over(point(100.0, 0.0), 0.0);
        cutter.cut(&Element::arc(point(100.0, 0.0), point(101.0, 0.0), 1e-15));
        cutter.cut(&Element::arc(point(101.0, 0.0), point(102.0, 0.0), 1e-9));
        assert_eq!((cutter.totals.lines, cutter.totals.arcs), (1, 1));
    }

    #[test]
    fn a_circle_of_two_halves_stays_two_moves() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let mut cutter = Cutter::new(&job);
        cutter.over(point(1.0, 0.0), 0.0);
        for e in crate::geom::ArcSpline::circle(point(0.0, 0.0), 1.0).elements() {
            cutter.cut(&e);
        }
        assert_eq!(cutter.totals.arcs, 2);
        assert!((cutter.totals.cut_length - 2.0 * PI).abs() < 1e-12);
    }
}
