//! Spiral biarcs along a stretch of monotone curvature.
//!
//! **Needs** a stretch without apices and corners inside. **Guarantees** biarcs within the tolerance
//! of the stretch, each proven. **Does not** reach the least possible number: for short stretches
//! one biarc more than needed may come out.
//!
//! **Method.** An arc of length `g` errs by `C |k'| g^3`, where `k'` is the derivative of the curvature
//! by arc length, so arcs of one error divide the integral of `|k'|^(1/3)` evenly. With tangents of
//! the curve at all nodes `C` is 1/40.5. Turned by `-k' h^2 / 48`, `h` the length of a biarc, they make
//! every arc take the mean curvature of its part with all joints on the curve: `C` is `sqrt(3) / 216`,
//! the best for arcs with common tangents, and curvatures stay monotone. The first division follows
//! the integral; the next ones the cube roots of the measured errors, until all are within the
//! tolerance and one biarc less would not do.

use super::biarc::{Arc, Joint, Node, biarc};
use super::bound::Distance;
use super::cuts::Stretch;
use super::measure::Measure;
use super::track::{Side, Track};

/// How nodes and joints are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Scheme {
    /// Whichever of the others needs fewer arcs, stretch by stretch.
    #[default]
    Fewest,
    /// Tangents turned a little between nodes of equal error.
    Tilted,
    /// Osculating arcs between nodes of equal error.
    Osculating,
    /// Osculating arcs and halving (S0, Algorithm 1 and section 2.3).
    Bisection,
}

/// Largest number of biarcs in one stretch.
pub(super) const MAX_BIARCS: usize = 1 << 20;

/// Divisions of a stretch by equal error that are tried before halving takes over.
const MAX_SWEEPS: usize = 12;

/// Divisions by measured errors that are tried with one number of biarcs.
const MAX_TRIES: usize = 2;

/// Part of the cells given away, so that errors need not be equal to the last percent.
const SLACK: f64 = 1.0 / 256.0;

/// Part of a cell given away for each unlikeness to its neighbors, and the most of it.
const ROUGH_SLACK: f64 = 0.5;
const MAX_SLACK: f64 = 0.125;

/// A cell counts at least this part of the largest error when errors are made equal, so that cells
/// of no error keep a length.
const LEAST_ERROR: f64 = 1.0 / 512.0;

/// A run on its way to biarcs; kept from run to run for its buffers.
#[derive(Debug, Default)]
pub(super) struct Fitter {
    nodes: Vec<Node>,
    /// The measure at the nodes.
    at: Vec<f64>,
    cells: Vec<Cell>,
    measure: Measure,
    /// What each cell counts.
    counts: Vec<f64>,
    best: Vec<Cell>,
}

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
    /// How far they are from the curve.
    pub distance: Distance,
}

impl Fitter {
    /// Biarcs along a run within `tolerance`; `None` when the limit on effort is reached.
    pub fn fit(&mut self, track: &Track, run: &[Stretch], tolerance: f64, scheme: Scheme) -> Option<&[Cell]> {
        self.best.clear();
        let (from, to) = (run[0].from.u, run[run.len() - 1].to.u);
        let ends = [track.cut_node(from, Side::After), track.cut_node(to, Side::Before)];
        let joint = match scheme {
            Scheme::Tilted | Scheme::Fewest => Joint::Middle,
            Scheme::Osculating | Scheme::Bisection => Joint::Osculating,
        };
        if scheme != Scheme::Bisection {
            self.measure.begin(track, run);
            self.equal_errors(track, ends, tolerance, joint);
        }
        if self.best.is_empty() {
            self.halve(track, ends, tolerance, joint)?;
        }
        Some(&self.best)
    }

    /// Nodes of equal error; the best division found goes to `best`.
    fn equal_errors(&mut self, track: &Track, ends: [Node; 2], tolerance: f64, joint: Joint) {
        let constant = if joint == Joint::Middle { 3f64.sqrt() / 216.0 } else { 1.0 / 12.0 };
        let wanted = (0.5 * self.measure.total() * (constant / tolerance).cbrt()).ceil();
        let mut count = if wanted < MAX_BIARCS as f64 { (wanted as usize).max(1) } else { return };
        let mut tries = 0;
        for _ in 0..MAX_SWEEPS {
            self.divide(track, ends, count, joint == Joint::Middle);
            self.build(track, joint);
            let worst = self.cells.iter().fold(0.0, |m: f64, c| m.max(c.distance.bound));
            let needed = if worst.is_finite() { self.correct(worst, tolerance) } else { 2 * count };
            let fits = worst <= tolerance;
            if std::env::var("DBG").is_ok() { let e: Vec<String> = self.cells.iter().take(40).map(|c| format!("{:.2}", c.distance.bound/tolerance)).collect(); eprintln!("count {count} needed {needed} worst {:.3} {}", worst/tolerance, e.join(" ")); }
            if fits {
                std::mem::swap(&mut self.cells, &mut self.best);
            }
            let enough = !self.best.is_empty();
            if fits && needed >= count || enough && (needed >= self.best.len() || tries == MAX_TRIES) {
                return;
            }
            if needed == count || !fits && needed < count {
                // Errors are not equal yet: once more with the same number, then with some more.
                tries += 1;
                if tries > MAX_TRIES {
                    (count, tries) = (count + 1 + (count as f64 * 4.0 * SLACK) as usize, 0);
                }
            } else {
                (count, tries) = (needed, 0);
            }
            if count > MAX_BIARCS {
                return;
            }
        }
    }

    /// Corrects the measure by errors; answers how many cells it should take then.
    ///
    /// Where neighbors differ, at apices, knots and ends, errors depend on how the nodes happen to lie:
    /// cells there count a little more.
    fn correct(&mut self, worst: f64, tolerance: f64) -> usize {
        let (at, counts) = (&self.at, &mut self.counts);
        counts.clear();
        counts.extend(self.cells.iter().map(|c| (c.distance.bound.max(LEAST_ERROR * worst) / tolerance).cbrt()));
        let factor = |i: usize| counts[i] / (at[i + 1] - at[i]);
        let rough = |i: usize| {
            let unlike = |j: usize| (factor(j) / factor(i)).ln().abs();
            unlike(i.saturating_sub(1)).max(unlike((i + 1).min(counts.len() - 1)))
        };
        let boosted =
            |i: usize| counts[i] * (1.0 + SLACK + (ROUGH_SLACK * rough(i)).min(MAX_SLACK));
        let n = counts.len();
        let sum: f64 = (0..n).map(boosted).sum();
        self.measure.correct((0..n).map(|i| ([at[i], at[i + 1]], boosted(i))));
        (sum.ceil() as usize).max(1)
    }

    /// Nodes that divide the measure in `count` equal parts.
    fn divide(&mut self, track: &Track, [from, to]: [Node; 2], count: usize, tilted: bool) {
        self.nodes.clear();
        self.at.clear();
        self.nodes.push(from);
        self.at.push(0.0);
        let (nodes, at) = (&mut self.nodes, &mut self.at);
        self.measure.divide(count, |u, m| {
            nodes.push(node(track, u));
            at.push(m);
        });
        self.nodes.push(to);
        self.at.push(self.measure.total());
        if tilted {
            self.tilt(track);
        }
    }

    /// Turns the tangents of inner nodes.
    fn tilt(&mut self, track: &Track) {
        for i in 1..self.nodes.len() - 1 {
            let [before, this, after] = [self.nodes[i - 1], self.nodes[i], self.nodes[i + 1]];
            let h = 0.5 * ((this.place - before.place).length() + (after.place - this.place).length());
            let (piece, t) = track.locate(this.u, Side::Before);
            let angle = -piece.jet(t).curvature_slope() * h * h / 48.0;
            if angle.abs() < 0.25 {
                let scale = (1.0 + angle * angle).sqrt().recip();
                self.nodes[i].tangent = this.tangent.rotated(scale, angle * scale);
            }
        }
    }

    /// A biarc in every cell.
    fn build(&mut self, track: &Track, joint: Joint) {
        self.cells.clear();
        for w in self.nodes.windows(2) {
            let cell = cell(track, &w[0], &w[1], joint);
            self.cells.push(cell);
            if cell.distance.bound.is_infinite() {
                return;
            }
        }
    }

    /// Halves the stretch until every biarc fits.
    fn halve(&mut self, track: &Track, [from, to]: [Node; 2], tolerance: f64, joint: Joint) -> Option<()> {
        self.best.clear();
        self.nodes.clear();
        self.nodes.push(to);
        let mut a = from;
        while let Some(&b) = self.nodes.last() {
            let mut found = cell(track, &a, &b, joint);
            if found.distance.bound > tolerance && joint == Joint::Osculating {
                let middle = cell(track, &a, &b, Joint::Middle);
                if found.distance.bound.is_infinite() || middle.distance.bound <= tolerance {
                    found = middle;
                }
            }
            if found.distance.bound <= tolerance {
                self.best.push(found);
                self.nodes.pop();
                a = b;
                continue;
            }
            let u = 0.5 * (a.u + b.u);
            if u <= a.u || u >= b.u || self.best.len() + self.nodes.len() > MAX_BIARCS {
                return None;
            }
            self.nodes.push(node(track, u));
        }
        Some(())
    }
}

/// The node on the curve at a parameter inside a stretch.
fn node(track: &Track, u: f64) -> Node {
    let (piece, t) = track.locate(u, Side::Before);
    let jet = piece.jet(t);
    Node { u, place: track.grid.snap(jet.q), tangent: jet.d1.unit(), curvature: jet.curvature() }
}

/// The biarc between two nodes with its distance from the curve.
fn cell(track: &Track, a: &Node, b: &Node, joint: Joint) -> Cell {
    let none = Arc { start: a.place, end: b.place, bulge: 0.0 };
    let (from, to) = (a.u, b.u);
    match biarc(a, b, joint, track.grid) {
        Some(arcs) => {
            let (distance, joint) = track.measure(&arcs, from, to);
            Cell { arcs, from, joint, to, distance }
        }
        None => Cell { arcs: [none; 2], from, joint: to, to, distance: Distance::UNKNOWN },
    }
}
