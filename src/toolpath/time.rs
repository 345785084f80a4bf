//! How long moves take on a machine that must speed up and slow down.
//!
//! **Needs** moves and the largest acceleration. **Guarantees** the time of a machine that runs through
//! where one feed move goes on in the direction of the one before, stops at corners, reaches every
//! rate as fast as may be, and takes arcs no faster than their curvature allows.
//! **Does not** know the jerk, the look-ahead or the corner speed of a controller.
//!
//! **Method.** Feed moves that run on into each other are one run: the time at their rates, and what
//! starting and stopping adds, half of rate over acceleration each; a run too short for its rate takes
//! twice the root of length over acceleration. What each move is on its own is found side by side, stretch by
//! stretch; the times are added up in order, so that the sum is the same to the last bit. A pass that is held
//! once for all heights is looked at once (`flow`).

use super::cutter::rapid_minutes;
use super::flow::{Flow, Leg, Run, runs_on};
use super::stretch::Stretch;
use super::{Job, Move, Moves, Point3};
use crate::geom::Element;
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// Seconds in a minute.
const SECONDS: f64 = 60.0;

/// Moves that are worth a thread.
const STRETCH: usize = 1 << 11;

/// Stretches at once to a thread, as not all take the same time.
const PER_THREAD: usize = 4;

/// What a move is to the time of all.
struct Step {
    length: f64,
    /// `None` for a rapid.
    rate: Option<f64>,
    /// Whether it goes on in the direction of the one before.
    runs_on: bool,
}

/// Tells the time of some of the moves of a path.
pub(super) struct Timer<'a> {
    job: &'a Job,
    moves: &'a Moves,
    /// Those along long passes.
    flows: HashMap<Key, Option<Flow>>,
}

/// What tells the moves along long passes apart: the place where the elements are held, and the rate.
type Key = (usize, u64);

impl<'a> Timer<'a> {
    /// For the moves of a job.
    pub fn new(moves: &'a Moves, job: &'a Job) -> Timer<'a> {
        let along = moves.stretches(0..moves.len()).filter_map(|stretch| match stretch {
            Stretch::Along(elements, _, rate) => Some((key(elements, rate), (elements, rate))),
            Stretch::Loose(_) => None,
        });
        let all: HashMap<Key, _> = along.collect();
        let acceleration = job.acceleration * SECONDS * SECONDS;
        let flow =
            |(key, (elements, rate)): (_, (&Arc<Vec<_>>, _))| (key, Flow::of(elements, rate, acceleration));
        Timer { job, moves, flows: all.into_par_iter().map(flow).collect() }
    }

    /// Minutes of some moves that begin where the tool is, if anywhere yet, and stands.
    pub fn minutes(&self, range: Range<usize>) -> f64 {
        let at = range.start.checked_sub(1).and_then(|last| self.moves.get(last)).map(|m| m.to());
        let acceleration = self.job.acceleration * SECONDS * SECONDS;
        let mut clock = Clock { job: self.job, acceleration, at, ahead: None, run: None, total: 0.0 };
        for stretch in self.moves.stretches(range) {
            match stretch {
                Stretch::Loose(moves) => clock.moves(moves),
                Stretch::Along(elements, z, rate) => {
                    if let (Some(Some(flow)), Some(last)) =
                        (self.flows.get(&key(elements, rate)), elements.last())
                    {
                        clock.flow(flow, Point3::new(last.end, z));
                    }
                }
            }
        }
        clock.stop();
        clock.total
    }
}

fn key(elements: &Arc<Vec<Element>>, rate: f64) -> Key {
    (Arc::as_ptr(elements).addr(), rate.to_bits())
}

/// Adds up times.
struct Clock<'a> {
    job: &'a Job,
    acceleration: f64,
    at: Option<Point3>,
    /// Direction of the last move, if that was a feed.
    ahead: Option<[f64; 3]>,
    run: Option<Run>,
    total: f64,
}

impl Clock<'_> {
    /// The tool stands: what ran until now is a run.
    fn stop(&mut self) {
        self.total += self.run.take().map_or(0.0, |run| run.minutes(self.acceleration));
    }

    /// Moves one after the other.
    fn moves(&mut self, moves: &[Move]) {
        let stretches: Vec<Range<usize>> =
            (0..moves.len()).step_by(STRETCH).map(|begin| begin..moves.len().min(begin + STRETCH)).collect();
        for some in stretches.chunks(PER_THREAD * rayon::current_num_threads()) {
            let all: Vec<Vec<Step>> =
                some.par_iter().map(|stretch| self.steps(moves, stretch.clone())).collect();
            all.into_iter().flatten().for_each(|step| self.add(&step));
        }
        self.ahead = self.leg_before(moves, moves.len()).map(|leg| leg.ends[1]);
        self.at = moves.last().map(Move::to).or(self.at);
    }

    fn add(&mut self, step: &Step) {
        if !step.runs_on {
            self.stop();
        }
        match step.rate {
            Some(rate) => self.run = Some(Run::on(self.run, step.length, rate)),
            None => self.total += rapid_minutes(step.length, self.job),
        }
    }

    /// The moves along a long pass, which ends here.
    fn flow(&mut self, flow: &Flow, to: Point3) {
        if !self.ahead.is_some_and(|ahead| runs_on(ahead, flow.ends[0])) {
            self.stop();
        }
        self.run = Some(Run::joined(self.run, flow.first));
        if let Some((between, last)) = flow.rest {
            self.stop();
            self.total += between;
            self.run = Some(last);
        }
        (self.at, self.ahead) = (Some(to), Some(flow.ends[1]));
    }

    /// Some of the moves as steps.
    fn steps(&self, moves: &[Move], stretch: Range<usize>) -> Vec<Step> {
        let mut at = self.before(moves, stretch.start);
        let mut ahead = match stretch.start {
            0 => self.ahead,
            start => self.leg_before(moves, start).map(|leg| leg.ends[1]),
        };
        let step = |m: &Move| {
            let from = std::mem::replace(&mut at, m.to());
            let Some(Leg { ends, length, rate }) = Leg::of(from, m, self.acceleration) else {
                ahead = None;
                return Step { length: from.distance(at), rate: None, runs_on: false };
            };
            let runs_on = ahead.replace(ends[1]).is_some_and(|ahead| runs_on(ahead, ends[0]));
            Step { length, rate: Some(rate), runs_on }
        };
        moves[stretch].iter().map(step).collect()
    }

    /// Where the tool is before a move; the first of all may begin nowhere.
    fn before(&self, moves: &[Move], i: usize) -> Point3 {
        i.checked_sub(1).map_or(self.at.unwrap_or(moves[i].to()), |last| moves[last].to())
    }

    /// The move before one, if it is a feed.
    fn leg_before(&self, moves: &[Move], i: usize) -> Option<Leg> {
        let last = i.checked_sub(1)?;
        Leg::of(self.before(moves, last), &moves[last], self.acceleration)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::tolerance::Units;

    fn job(acceleration: f64) -> Job {
        Job { acceleration, ..Job::new(Units::Mm, 6.0, 2.4) }
    }

    fn feed(x: f64, y: f64) -> Move {
        Move::Feed { to: [x, y, 0.0].into(), rate: 600.0 }
    }

    fn minutes(from: Option<Point3>, moves: &[Move], job: &Job) -> f64 {
        let before = from.map(|to| Move::Rapid { to });
        let all: Moves = before.into_iter().chain(moves.iter().copied()).collect();
        Timer::new(&all, job).minutes(all.len() - moves.len()..all.len())
    }

    fn seconds(moves: &[Move], acceleration: f64) -> f64 {
        60.0 * minutes(Some([0.0, 0.0, 0.0].into()), moves, &job(acceleration))
    }

    #[test]
    fn a_straight_line_takes_its_time_and_what_start_and_stop_add() {
        // 100 mm at 10 mm/s, and 10 mm/s over 20 mm/s2.
        assert!((seconds(&[feed(100.0, 0.0)], 20.0) - 10.5).abs() < 1e-9);
        assert!((seconds(&[feed(40.0, 0.0), feed(100.0, 0.0)], 20.0) - 10.5).abs() < 1e-9);
        assert!((seconds(&[feed(60.0, 0.0), feed(60.0, 40.0)], 20.0) - 11.0).abs() < 1e-9);
    }

    #[test]
    fn many_moves_take_as_long_as_one_after_the_other() {
        let place =
            |i: usize| (0.01 * (i as f64), if i % 1500 < 1490 { 0.0 } else { 0.004 * (i % 2) as f64 });
        let mut moves: Vec<Move> = (0..5 * STRETCH).map(|i| feed(place(i).0, place(i).1)).collect();
        for i in [7, STRETCH - 1, 2 * STRETCH, 3 * STRETCH + 9] {
            moves[i] = Move::Rapid { to: moves[i].to() };
        }
        let all = minutes(None, &moves, &job(20.0));
        // Runs end at rapids, so that what lies between these is timed apart.
        let (mut apart, mut before) = (0.0, None);
        for part in moves.split_inclusive(|m| m.rate().is_none()) {
            apart += minutes(before, part, &job(20.0));
            before = part.last().map(Move::to);
        }
        assert!((all - apart).abs() < 1e-9 * all && all > 0.1, "{all} {apart}");
    }

    #[test]
    fn a_short_move_never_reaches_its_rate() {
        assert!((seconds(&[feed(0.2, 0.0)], 20.0) - 0.2).abs() < 1e-9);
    }

    #[test]
    fn a_small_arc_is_slow_and_met_without_a_stop_where_it_touches() {
        let arc = Move::Arc { to: [10.0, 1.0, 0.0].into(), center: point(10.0, 0.5), ccw: true, rate: 600.0 };
        let moves = [feed(10.0, 0.0), arc, feed(0.0, 1.0)];
        let fastest = (20.0f64 * 0.5).sqrt();
        let expected = 2.0 + 0.5 + 0.5 * std::f64::consts::PI / fastest;
        assert!((seconds(&moves, 20.0) - expected).abs() < 1e-9);
    }

    #[test]
    fn moves_along_a_pass_take_as_long_as_one_by_one() {
        let square = [(0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (4.0, 4.0, 0.0), (0.0, 4.0, 0.0), (0.0, 3.0, 0.0)];
        let gentle = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (8.0, 0.001, 0.0), (12.0, 0.0, 0.0)];
        for spline in [ArcSpline::closed(square), ArcSpline::open(gentle)] {
            let elements = Arc::new(spline.elements().collect::<Vec<_>>());
            let mut moves = Moves::from(vec![Move::Rapid { to: [-3.0, 0.0, 1.0].into() }, feed(-2.0, 0.0)]);
            for z in [0.0, -1.0] {
                let to = Point3::new(elements[0].start, z);
                moves.push(Move::Feed { to, rate: 600.0 });
                moves.push_along(elements.clone(), z, 600.0);
            }
            let plain = Moves::from(moves.to_vec());
            let [held, plain] =
                [&moves, &plain].map(|moves| Timer::new(moves, &job(20.0)).minutes(0..moves.len()));
            assert!((held - plain).abs() < 1e-12, "{held} {plain}");
        }
    }
}
