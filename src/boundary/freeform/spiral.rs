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

/// One biarc in so many is given away when errors do not become equal any further.
const SLACK: usize = 64;

/// Samples of the density of arcs in one piece.
const SAMPLES: usize = 8;

/// A cell counts at least this part of the largest error when errors are made equal, so that cells
/// of no error keep a length.
const LEAST_ERROR: f64 = 1.0 / 512.0;

/// A stretch on its way to biarcs; kept from stretch to stretch for its buffers.
#[derive(Debug, Default)]
pub(super) struct Fitter {
    nodes: Vec<Node>,
    cells: Vec<Cell>,
    /// Parameters and a growing measure at them, to be divided evenly.
    measure: Vec<(f64, f64)>,
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
    /// Biarcs from one cut to another within `tolerance`; `None` when the limit on effort is reached.
    pub fn fit(&mut self, track: &Track, ends: [Node; 2], tolerance: f64, scheme: Scheme) -> Option<&[Cell]> {
        self.best.clear();
        match scheme {
            Scheme::Bisection => {}
            Scheme::Osculating => self.equal_errors(track, ends, tolerance, Joint::Osculating),
            Scheme::Tilted | Scheme::Fewest => self.equal_errors(track, ends, tolerance, Joint::Middle),
        }
        if self.best.is_empty() {
            let joint = if scheme == Scheme::Tilted { Joint::Middle } else { Joint::Osculating };
            self.halve(track, ends, tolerance, joint)?;
        }
        Some(&self.best)
    }

    /// Nodes of equal error; the best division found goes to `best`.
    fn equal_errors(&mut self, track: &Track, ends: [Node; 2], tolerance: f64, joint: Joint) {
        let total = self.measure_density(track, ends);
        let constant = if joint == Joint::Middle { 3f64.sqrt() / 216.0 } else { 1.0 / 12.0 };
        let wanted = (0.5 * total * (constant / tolerance).cbrt()).ceil();
        let mut count = if wanted < MAX_BIARCS as f64 { (wanted as usize).max(1) } else { return };
        let mut tries = 0;
        for _ in 0..MAX_SWEEPS {
            self.divide(track, ends, count, joint == Joint::Middle);
            self.build(track, joint);
            let worst = self.cells.iter().fold(0.0, |m: f64, c| m.max(c.distance.bound));
            let needed = if worst.is_finite() { self.measure_errors(worst, tolerance) } else { 2 * count };
            let fits = worst <= tolerance;
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
                    (count, tries) = (count + 1 + count / SLACK, 0);
                }
            } else {
                (count, tries) = (needed, 0);
            }
            if count > MAX_BIARCS {
                return;
            }
        }
    }

    /// Integral of the density of arcs over the stretch.
    fn measure_density(&mut self, track: &Track, [from, to]: [Node; 2]) -> f64 {
        self.measure.clear();
        self.measure.push((from.u, 0.0));
        let mut sum = 0.0;
        let mut whole = from.u.floor();
        while whole < to.u {
            let (a, b) = ((from.u - whole).max(0.0), (to.u - whole).min(1.0));
            let step = (b - a) / SAMPLES as f64;
            let piece = track.piece(whole as usize);
            for i in 0..SAMPLES {
                let density = piece.jet(a + (i as f64 + 0.5) * step).arc_density();
                if density.is_finite() {
                    sum += density * step;
                }
                self.measure.push((whole + a + (i + 1) as f64 * step, sum));
            }
            whole += 1.0;
        }
        if let Some(last) = self.measure.last_mut() {
            last.0 = to.u;
        }
        sum
    }

    /// The measure that makes measured errors equal; answers how many cells it should take then.
    fn measure_errors(&mut self, worst: f64, tolerance: f64) -> usize {
        self.measure.clear();
        self.measure.push((self.nodes[0].u, 0.0));
        let mut sum = 0.0;
        for (cell, node) in self.cells.iter().zip(&self.nodes[1..]) {
            sum += (cell.distance.bound.max(LEAST_ERROR * worst) / tolerance).cbrt();
            self.measure.push((node.u, sum));
        }
        (sum.ceil() as usize).max(1)
    }

    /// Nodes that divide the measure in `count` equal parts.
    fn divide(&mut self, track: &Track, [from, to]: [Node; 2], count: usize, tilted: bool) {
        self.nodes.clear();
        self.nodes.push(from);
        let total = self.measure[self.measure.len() - 1].1;
        let mut at = 0;
        for i in 1..count {
            let goal = total * i as f64 / count as f64;
            while at + 2 < self.measure.len() && self.measure[at + 1].1 < goal {
                at += 1;
            }
            let ((u0, m0), (u1, m1)) = (self.measure[at], self.measure[at + 1]);
            let share = if m1 > m0 { ((goal - m0) / (m1 - m0)).clamp(0.0, 1.0) } else { 0.5 };
            self.nodes.push(node(track, u0 + share * (u1 - u0)));
        }
        self.nodes.push(to);
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
