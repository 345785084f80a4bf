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
//! stretch; the times are added up in order, so that the sum is the same to the last bit.

use super::cutter::rapid_minutes;
use super::{Job, Move, Point3};
use rayon::prelude::*;
use std::ops::Range;

/// Largest turn, in radians, that a machine runs through.
const CORNER: f64 = 0.01;

/// Seconds in a minute.
const SECONDS: f64 = 60.0;

/// Moves that are worth a thread.
const STRETCH: usize = 1 << 11;

/// Stretches at once to a thread, as not all take the same time.
const PER_THREAD: usize = 4;

/// A feed move in space: unit directions at its ends, length, and the rate that it is taken at.
struct Leg {
    ends: [[f64; 3]; 2],
    length: f64,
    rate: f64,
}

/// What a move is to the time of all.
struct Step {
    length: f64,
    /// `None` for a rapid.
    rate: Option<f64>,
    /// Whether it goes on in the direction of the one before.
    runs_on: bool,
}

/// Feed moves that run on into each other.
struct Run {
    length: f64,
    /// Time at their rates.
    at_rates: f64,
    first_rate: f64,
    last_rate: f64,
}

/// Minutes of moves that begin where the tool is, if anywhere yet.
pub(super) fn minutes(from: Option<Point3>, moves: &[Move], job: &Job) -> f64 {
    let acceleration = job.acceleration * SECONDS * SECONDS;
    let (mut total, mut run) = (0.0, None);
    let time = |run: Option<Run>| run.map_or(0.0, |run| run.minutes(acceleration));
    let stretches: Vec<Range<usize>> =
        (0..moves.len()).step_by(STRETCH).map(|begin| begin..moves.len().min(begin + STRETCH)).collect();
    for some in stretches.chunks(PER_THREAD * rayon::current_num_threads()) {
        let steps = |stretch: &Range<usize>| steps(from, moves, stretch.clone(), acceleration);
        let all: Vec<Vec<Step>> = some.par_iter().map(steps).collect();
        for steps in all {
            for Step { length, rate, runs_on } in steps {
                if !runs_on {
                    total += time(run.take());
                }
                match rate {
                    Some(rate) => run = Some(Run::on(run, length, rate)),
                    None => total += rapid_minutes(length, job),
                }
            }
        }
    }
    total + time(run)
}

/// Some of the moves as steps.
fn steps(from: Option<Point3>, moves: &[Move], stretch: Range<usize>, acceleration: f64) -> Vec<Step> {
    // The first move of all may begin nowhere.
    let before = |i: usize| i.checked_sub(1).map_or(from.unwrap_or(moves[i].to()), |last| moves[last].to());
    let last = stretch.start.checked_sub(1).and_then(|last| leg(before(last), &moves[last], acceleration));
    let (mut at, mut ahead) = (before(stretch.start), last.map(|leg| leg.ends[1]));
    let step = |m: &Move| {
        let from = std::mem::replace(&mut at, m.to());
        let Some(Leg { ends, length, rate }) = leg(from, m, acceleration) else {
            ahead = None;
            return Step { length: from.distance(at), rate: None, runs_on: false };
        };
        let runs_on = ahead.replace(ends[1]).is_some_and(|ahead| turns_by(ahead, ends[0]) <= CORNER);
        Step { length, rate: Some(rate), runs_on }
    };
    moves[stretch].iter().map(step).collect()
}

impl Run {
    /// A run that goes on by a move, or begins with it.
    fn on(run: Option<Run>, length: f64, rate: f64) -> Run {
        let (before, at_rates, first_rate) =
            run.map_or((0.0, 0.0, rate), |run| (run.length, run.at_rates, run.first_rate));
        Run { length: before + length, at_rates: at_rates + length / rate, first_rate, last_rate: rate }
    }

    fn minutes(&self, acceleration: f64) -> f64 {
        let [v, w] = [self.first_rate, self.last_rate];
        if self.length >= 0.5 * (v * v + w * w) / acceleration {
            self.at_rates + 0.5 * (v + w) / acceleration
        } else {
            self.at_rates.max(2.0 * (self.length / acceleration).sqrt())
        }
    }
}

/// `None` for a rapid.
#[inline]
fn leg(from: Point3, m: &Move, acceleration: f64) -> Option<Leg> {
    match *m {
        Move::Rapid { .. } => None,
        Move::Feed { to, rate } => {
            let length = from.distance(to);
            let ahead = [to.x - from.x, to.y - from.y, to.z - from.z].map(|c| c / length);
            Some(Leg { ends: [ahead; 2], length, rate })
        }
        Move::Arc { to, center, ccw, rate } => {
            let [a, b] = [from.xy() - center, to.xy() - center];
            let flat = a.angle_to(b).abs() * b.length();
            let length = flat.hypot(to.z - from.z);
            let ends = [a, b].map(|spoke| {
                let ahead = if ccw { spoke.left() } else { spoke.right() }.unit() * (flat / length);
                [ahead.x, ahead.y, (to.z - from.z) / length]
            });
            // On a helix of this slope the centripetal part is that of the plane.
            let fastest = (acceleration * b.length()).sqrt() * (length / flat);
            Some(Leg { ends, length, rate: rate.min(fastest) })
        }
    }
}

/// How far unit vectors lie apart, for small angles the angle; 0 where one is none.
fn turns_by(a: [f64; 3], b: [f64; 3]) -> f64 {
    let apart: f64 = (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum();
    if apart.is_nan() { 0.0 } else { apart.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use crate::tolerance::Units;

    fn job(acceleration: f64) -> Job {
        Job { acceleration, ..Job::new(Units::Mm, 6.0, 2.4) }
    }

    fn feed(x: f64, y: f64) -> Move {
        Move::Feed { to: [x, y, 0.0].into(), rate: 600.0 }
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
}
