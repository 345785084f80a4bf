//! The tool in the machine: appends moves, knows where it is, and adds up lengths and time.

use super::{Job, Move, Point3};
use crate::geom::{Element, Point};
use crate::tolerance::Units;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Moves that are worth a thread.
const LEAST: usize = 1 << 10;

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
    pub moves: Vec<Move>,
    pub totals: Totals,
    /// Lengths of moves that were made side by side.
    lengths: Vec<f64>,
}

impl<'a> Cutter<'a> {
    /// A tool that is nobody knows where.
    pub fn new(job: &'a Job) -> Cutter<'a> {
        Cutter { job, at: None, moves: Vec::new(), totals: Totals::default(), lengths: Vec::new() }
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

    /// Along elements one after the other as if each were [cut](Cutter::cut). Of many, the moves are made side
    /// by side; what they amount to is added up in their order, so that it is the same to the last bit.
    pub fn cut_all(&mut self, elements: &[Element]) {
        let Some(at) = self.at.filter(|at| elements.len() >= 2 * LEAST && are_moves(*at, elements)) else {
            return elements.iter().for_each(|e| self.cut(e));
        };
        let (z, rate) = (at.z, self.job.feed);
        let before = |i: usize| i.checked_sub(1).map_or(at, |last| Point3::new(elements[last].end, z));
        let motions = elements.par_iter().enumerate().with_min_len(LEAST);
        self.lengths.clear();
        let mut all = (std::mem::take(&mut self.moves), std::mem::take(&mut self.lengths));
        let first = all.0.len();
        all.par_extend(motions.map(|(i, e)| motion(Some(before(i)), e, z, rate)));
        let (moves, lengths) = all;
        moves[first..].iter().zip(&lengths).for_each(|(m, length)| self.count(m, *length));
        (self.moves, self.lengths) = (moves, lengths);
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
        let (m, length) = straight(self.at, Point3::new(p, z), rate);
        self.go(m, length);
    }

    /// A feed move, unless it is a line to where the tool is.
    fn go(&mut self, m: Move, length: f64) {
        if matches!(m, Move::Feed { .. }) && self.at == Some(m.to()) {
            return;
        }
        self.count(&m, length);
        self.moves.push(m);
    }

    /// Adds up a feed move, and is where it ends.
    fn count(&mut self, m: &Move, length: f64) {
        match m {
            Move::Arc { .. } => self.totals.arcs += 1,
            _ => self.totals.lines += 1,
        }
        self.totals.cut_length += length;
        self.totals.minutes += m.rate().map_or(0.0, |rate| length / rate);
        self.at = Some(m.to());
    }
}

/// The move along an element of half a circle at most, and its length.
fn motion(at: Option<Point3>, e: &Element, z: f64, rate: f64) -> (Move, f64) {
    let to = Point3::new(e.end, z);
    let center = if is_flat(e) { None } else { e.center() };
    let Some((center, radius)) = center else { return straight(at, to, rate) };
    let length = (radius * e.sweep().abs()).hypot(at.map_or(0.0, |at| z - at.z));
    (Move::Arc { to, center, ccw: e.bulge > 0.0, rate }, length)
}

fn straight(at: Option<Point3>, to: Point3, rate: f64) -> (Move, f64) {
    (Move::Feed { to, rate }, at.map_or(0.0, |at| at.distance(to)))
}

/// Whether each of some elements is one move.
fn are_moves(at: Point3, elements: &[Element]) -> bool {
    let mut last = at.xy();
    elements.iter().all(|e| e.bulge.abs() <= 1.0 && std::mem::replace(&mut last, e.end) != e.end)
}

/// Whether an arc is no different from its chord, its center beyond reach.
fn is_flat(arc: &Element) -> bool {
    /// Round-off of the four coordinates that chord and bulge come from, one rounding each.
    const COORDINATE_ERROR: f64 = 2.0 * f64::EPSILON;
    let sagitta = 0.5 * arc.chord().length() * arc.bulge.abs();
    let magnitude =
        [arc.start.x, arc.start.y, arc.end.x, arc.end.y].into_iter().fold(0.0, |m, c| c.abs().max(m));
    sagitta <= COORDINATE_ERROR * magnitude
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
        assert_eq!(cutter.moves[0].to(), Point3 { x: 1.0, y: 0.0, z: 5.0 });
        assert_eq!(cutter.moves[1].to().z, 1.0);
        assert_eq!((cutter.totals.arcs, cutter.totals.lines, cutter.totals.retracts), (2, 1, 1));
        assert_eq!(cutter.moves[3].to().z, -1.5);
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
    fn many_moves_at_once_are_those_one_by_one() {
        let job = Job::new(Units::Mm, 2.0, 1.0);
        let vertex = |i: u32| {
            let angle = 0.002 * f64::from(i);
            (50.0 * angle.cos(), 50.0 * angle.sin(), [0.0, 1e-18, 0.4][i as usize % 3])
        };
        let course = crate::geom::ArcSpline::closed((0..3100).map(vertex));
        let cut = |elements: &[Element], at_once: bool| {
            let mut cutter = Cutter::new(&job);
            cutter.over(point(50.0, 0.0), 0.0);
            cutter.plunge(-1.0);
            match at_once {
                true => cutter.cut_all(elements),
                false => elements.iter().for_each(|e| cutter.cut(e)),
            }
            (cutter.moves, cutter.totals)
        };
        let mut elements: Vec<Element> = course.elements().collect();
        assert!(are_moves(Point3::new(point(50.0, 0.0), -1.0), &elements));
        assert_eq!(cut(&elements, true), cut(&elements, false));
        elements[7].bulge = 3.0;
        elements[9].end = elements[8].end;
        assert_eq!(cut(&elements, true), cut(&elements, false));
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
