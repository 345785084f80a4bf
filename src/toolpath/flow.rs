//! Feed moves that run on into each other, and what a long pass is made of in such runs.

use super::{Move, Point3};
use crate::geom::Element;

/// Largest turn, in radians, that a machine runs through.
const CORNER: f64 = 0.01;

/// A feed move in space: unit directions at its ends, length, and the rate that it is taken at.
pub(super) struct Leg {
    pub ends: [[f64; 3]; 2],
    pub length: f64,
    pub rate: f64,
}

/// Feed moves that run on into each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    length: f64,
    /// Time at their rates.
    at_rates: f64,
    first_rate: f64,
    last_rate: f64,
}

/// The moves along a long pass: runs, and the directions at its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flow {
    pub ends: [[f64; 3]; 2],
    pub first: Run,
    /// Where there is a corner: the minutes of all runs between, and the last one.
    pub rest: Option<(f64, Run)>,
}

impl Leg {
    /// `None` for a rapid.
    #[inline]
    pub fn of(from: Point3, m: &Move, acceleration: f64) -> Option<Leg> {
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
}

impl Run {
    /// A run that goes on by a move, or begins with it.
    pub fn on(run: Option<Run>, length: f64, rate: f64) -> Run {
        Run::joined(run, Run { length, at_rates: length / rate, first_rate: rate, last_rate: rate })
    }

    /// A run that goes on by another one, or is that.
    pub fn joined(run: Option<Run>, next: Run) -> Run {
        run.map_or(next, |run| Run {
            length: run.length + next.length,
            at_rates: run.at_rates + next.at_rates,
            first_rate: run.first_rate,
            last_rate: next.last_rate,
        })
    }

    /// How long it takes.
    pub fn minutes(&self, acceleration: f64) -> f64 {
        let [v, w] = [self.first_rate, self.last_rate];
        if self.length >= 0.5 * (v * v + w * w) / acceleration {
            self.at_rates + 0.5 * (v + w) / acceleration
        } else {
            self.at_rates.max(2.0 * (self.length / acceleration).sqrt())
        }
    }
}

impl Flow {
    /// Of moves along elements at one height.
    pub fn of(elements: &[Element], rate: f64, acceleration: f64) -> Option<Flow> {
        let legs = elements
            .iter()
            .filter_map(|e| Leg::of(Point3::new(e.start, 0.0), &Move::along(e, 0.0, rate), acceleration));
        let mut flow: Option<Flow> = None;
        for Leg { ends, length, rate } in legs {
            let Some(flow) = &mut flow else {
                flow = Some(Flow { ends, first: Run::on(None, length, rate), rest: None });
                continue;
            };
            let runs_on = runs_on(flow.ends[1], ends[0]);
            flow.ends[1] = ends[1];
            match &mut flow.rest {
                Some((_, run)) if runs_on => *run = Run::on(Some(*run), length, rate),
                Some((between, run)) => {
                    *between += run.minutes(acceleration);
                    *run = Run::on(None, length, rate);
                }
                None if runs_on => flow.first = Run::on(Some(flow.first), length, rate),
                None => flow.rest = Some((0.0, Run::on(None, length, rate))),
            }
        }
        flow
    }
}

/// Whether a move that begins in a direction goes on in that of the one before.
#[inline]
pub(super) fn runs_on(ahead: [f64; 3], begin: [f64; 3]) -> bool {
    turns_by(ahead, begin) <= CORNER
}

/// How far unit vectors lie apart, for small angles the angle; 0 where one is none.
fn turns_by(a: [f64; 3], b: [f64; 3]) -> f64 {
    let apart: f64 = (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum();
    if apart.is_nan() { 0.0 } else { apart.sqrt() }
}
