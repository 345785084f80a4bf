//! Biarcs along a run of the curve, by a scheme of choice.
//!
//! **Needs** a run without corners inside. **Guarantees** biarcs within the tolerance of the run, each
//! proven. **Does not** look at the order of curvatures; see [`super::run`].

use super::biarc::{Arc, Joint, Node, biarc};
use super::bound::Distance;
use super::density::Density;
use super::layout::{Ends, Goal, Lost};
use super::spread::Spread;
use super::track::Track;

/// How nodes and joints are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Scheme {
    /// Whichever of the others needs fewer arcs.
    #[default]
    Fewest,
    /// Tangents turned a little, between nodes of equal error.
    Tilted,
    /// Tangents of the curve and joints in the middle, between nodes of equal error.
    Plain,
    /// Osculating arcs between nodes of equal error.
    Osculating,
    /// Osculating arcs and halving (S0, Algorithm 1 and section 2.3).
    Bisection,
    /// The same with errors estimated by samples and not proven, as published (S0, Algorithm 2). For
    /// comparison only: what it calls a bound is the largest error found.
    Published,
}

/// Largest number of biarcs in one run.
pub(super) const MAX_BIARCS: usize = 1 << 20;

/// So many biarcs may be a rumor: where control points nearly coincide the density is noise.
const TRUSTED: f64 = 4096.0;

/// One biarc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Its arcs.
    pub arcs: [Arc; 2],
    /// Parameter of the curve at its start.
    pub from: f64,
    /// Parameter beyond its joint.
    pub joint: f64,
    /// Parameter at its end.
    pub to: f64,
    /// How far the arcs are from the curve.
    pub distance: Distance,
    /// Whether it is one segment for a part with turns too small for arcs. Its second arc is empty.
    pub sharp: bool,
}

/// Fits runs; keeps its buffers from one to the next.
#[derive(Debug, Default)]
pub(super) struct Fitter {
    spread: Spread,
    /// Ends of the parts that wait to be halved.
    waiting: Vec<Node>,
}

impl Fitter {
    /// The density of the part checked last.
    pub fn density(&mut self) -> Density {
        self.spread.density()
    }

    /// Takes the density of the part that is fitted next.
    pub fn take(&mut self, density: Option<Density>) {
        self.spread.take(density);
    }

    /// Whether biarcs may fit, as far as that can be told before they are laid; their density may be known between
    /// ends nearer to each other.
    pub fn check(
        &mut self,
        track: &Track,
        ends: &Ends,
        ((tolerance, scheme), inner): ((f64, Scheme), Option<Density>),
    ) -> Result<(), Lost> {
        self.spread.check(track, ends, (&Goal::of(scheme, tolerance), inner))
    }

    /// Appends biarcs from one node to another, unless the limit on effort is reached, or nothing fits
    /// beside arcs over apices.
    pub fn fit(
        &mut self,
        track: &Track,
        ends: &Ends,
        (tolerance, scheme): (f64, Scheme),
        out: &mut Vec<Cell>,
    ) -> Result<(), Lost> {
        let goal = Goal::of(scheme, tolerance);
        let halves = matches!(scheme, Scheme::Bisection | Scheme::Published);
        if !halves {
            match self.spread(track, ends, &goal, out) {
                Err(lost) if lost.ends != [false; 2] => return Err(lost),
                Err(_) => {}
                Ok(()) => return Ok(()),
            }
        }
        let halved = self.halve(track, ends.nodes, (&goal, MAX_BIARCS), out);
        halved.ok_or(Lost { ends: [false; 2] })
    }

    /// Appends biarcs of equal errors, or halves where these need far fewer.
    fn spread(&mut self, track: &Track, ends: &Ends, goal: &Goal, out: &mut Vec<Cell>) -> Result<(), Lost> {
        let number = self.spread.number(track, ends, goal)?;
        if number > TRUSTED {
            let begin = out.len();
            if self.halve(track, ends.nodes, (goal, (0.5 * number) as usize), out).is_some() {
                return Ok(());
            }
            out.truncate(begin);
        }
        self.spread.run(track, ends, (goal, number), out)
    }

    /// Halves a run until every biarc fits, unless that takes more than a number of them.
    fn halve(
        &mut self,
        track: &Track,
        [from, to]: [Node; 2],
        (goal, most): (&Goal, usize),
        out: &mut Vec<Cell>,
    ) -> Option<()> {
        let (tolerance, joint, limit) = (goal.tolerance, goal.joint, out.len() + most);
        self.waiting.clear();
        self.waiting.push(to);
        let mut a = from;
        while let Some(&b) = self.waiting.last() {
            let mut found = cell(track, [&a, &b], 0.5 * (a.u + b.u), joint, tolerance);
            if found.distance.bound > tolerance && joint == Joint::Osculating {
                // At a curvature of zero and where it jumps there may be no osculating biarc.
                let middle = cell(track, [&a, &b], 0.5 * (a.u + b.u), Joint::MIDDLE, tolerance);
                if found.distance.bound.is_infinite() || middle.distance.bound <= tolerance {
                    found = middle;
                }
            }
            if found.distance.bound <= tolerance {
                out.push(found);
                self.waiting.pop();
                a = b;
                continue;
            }
            let reach = track.reach(a.place, a.u, b.u);
            if reach <= SMALL * tolerance {
                out.push(blunt(&a, &b, reach));
                self.waiting.pop();
                a = b;
                continue;
            }
            let u = 0.5 * (a.u + b.u);
            if u <= a.u || u >= b.u || out.len() + self.waiting.len() > limit {
                return None;
            }
            self.waiting.push(track.node(u));
        }
        Some(())
    }
}

/// A part of the curve within this part of the tolerance is as good as a segment.
const SMALL: f64 = 0.25;

/// A segment for a part of the curve within `reach` of its start.
fn blunt(a: &Node, b: &Node, reach: f64) -> Cell {
    let arcs = [(a.place, b.place), (b.place, b.place)].map(|(start, end)| Arc { start, end, bulge: 0.0 });
    let distance = Distance { bound: 2.0 * reach, found: 0.0 };
    Cell { arcs, from: a.u, joint: b.u, to: b.u, distance, sharp: true }
}

impl Cell {
    /// One arc alone for the curve between two parameters.
    pub fn of_one(track: &Track, arc: Arc, [from, to]: [f64; 2], limit: f64) -> Cell {
        Cell::alone(arc, [from, to], track.measure_arc(&arc, from, to, limit))
    }

    /// The same where it is enough that the distance is within a limit.
    pub fn proven(track: &Track, arc: Arc, [from, to]: [f64; 2], limit: f64) -> Cell {
        Cell::alone(arc, [from, to], track.prove_arc(&arc, from, to, limit))
    }

    /// One arc alone at a distance.
    pub fn alone(arc: Arc, [from, to]: [f64; 2], distance: Distance) -> Cell {
        let none = Arc { start: arc.end, end: arc.end, bulge: 0.0 };
        Cell { arcs: [arc, none], from, joint: to, to, distance, sharp: false }
    }

    /// Its arcs that are any, with the parameters between which they stand for the curve.
    pub fn spans(&self) -> impl Iterator<Item = (Arc, f64, f64)> + use<> {
        let [a, b] = self.arcs;
        let both = [(a, self.from, self.joint), (b, self.joint, self.to)];
        both.into_iter().filter(|(arc, _, _)| arc.start != arc.end)
    }
}

/// The biarc between two nodes with its distance from the curve, as precise as [`Frame::measure`]
/// says; `middle` is a parameter near the joint.
///
/// [`Frame::measure`]: super::bound::Frame::measure
pub(super) fn cell(track: &Track, [a, b]: [&Node; 2], middle: f64, joint: Joint, limit: f64) -> Cell {
    let none = Arc { start: a.place, end: b.place, bulge: 0.0 };
    let (from, to) = (a.u, b.u);
    match biarc(a, b, joint, track.grid) {
        Some(arcs) => {
            let (distance, joint) = track.measure(&arcs, [from, middle, to], limit);
            Cell { arcs, from, joint, to, distance, sharp: false }
        }
        None => Cell { arcs: [none; 2], from, joint: to, to, distance: Distance::UNKNOWN, sharp: false },
    }
}
