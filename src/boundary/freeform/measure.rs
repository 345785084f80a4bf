//! The measure along a curve that arcs of one error divide evenly.
//!
//! **Method.** Its density is the cube root of the derivative of the curvature by arc length. That
//! vanishes like a cube root at an apex and jumps at knots, so each interval between cuts and knots
//! has a variable of its own that runs slowly at both ends: in it the density is smooth, and a few
//! samples with the trapezoid rule and its end correction are accurate. Errors measured on arcs give
//! a correction, linear between the middles of the arcs.

use super::cuts::Stretch;
use super::track::Track;

/// Samples in one interval between cuts and knots.
const SAMPLES: usize = 8;

/// Steps of Newton's method in the inversion of one cubic.
const STEPS: usize = 3;

/// The measure up to a sample.
#[derive(Clone, Copy, Debug)]
struct Sample {
    /// Interval that begins here or holds the sample.
    from: f64,
    width: f64,
    /// Variable in the interval, 0..=1.
    x: f64,
    sum: f64,
    /// Derivative of the measure by `x`.
    density: f64,
}

/// A correction at a place of the measure.
#[derive(Clone, Copy, Debug)]
struct Knot {
    at: f64,
    factor: f64,
    /// Corrected measure up to here.
    sum: f64,
}

/// A growing function along a curve, to be divided evenly.
#[derive(Debug, Default)]
pub(super) struct Measure {
    samples: Vec<Sample>,
    knots: Vec<Knot>,
}

impl Measure {
    /// Begins anew, for a run of stretches.
    pub fn begin(&mut self, track: &Track, stretches: &[Stretch]) {
        self.samples.clear();
        self.knots.clear();
        let mut sum = 0.0;
        for stretch in stretches {
            let mut from = stretch.from.u;
            while from < stretch.to.u {
                let to = (from.floor() + 1.0).min(stretch.to.u);
                sum = self.add_interval(track, from, to, sum);
                from = to;
            }
        }
    }

    fn add_interval(&mut self, track: &Track, from: f64, to: f64, sum: f64) -> f64 {
        let (width, whole) = (to - from, from.floor());
        let piece = track.piece(whole as usize);
        let step = 1.0 / SAMPLES as f64;
        // Outside of 1..SAMPLES the density in the slow variable is zero, and odd about its ends.
        let mut density = [0.0; SAMPLES + 3];
        for i in 1..SAMPLES {
            let (u, slope) = slow(i as f64 * step);
            let d = piece.jet(from - whole + u * width).arc_density() * slope * width;
            density[i + 1] = if d.is_finite() { d } else { 0.0 };
        }
        (density[0], density[SAMPLES + 2]) = (-density[2], -density[SAMPLES]);
        let mut sum = sum;
        self.samples.push(Sample { from, width, x: 0.0, sum, density: 0.0 });
        for i in 1..=SAMPLES {
            let (before, here) = (density[i], density[i + 1]);
            let bend = (density[i + 2] - before) - (here - density[i - 1]);
            sum += step * (0.5 * (before + here) - bend / 24.0).max(0.0);
            self.samples.push(Sample { from, width, x: i as f64 * step, sum, density: here });
        }
        sum
    }

    /// The whole measure without corrections.
    pub fn total(&self) -> f64 {
        self.samples.last().map_or(0.0, |s| s.sum)
    }

    /// The whole corrected measure.
    fn corrected_total(&self) -> f64 {
        self.knots.last().map_or(self.total(), |k| k.sum)
    }

    /// Takes corrections from cells: the measure at the ends of each, ascending, and what the cell
    /// should count.
    pub fn correct(&mut self, cells: impl Iterator<Item = ([f64; 2], f64)>) {
        self.knots.clear();
        let mut end = 0.0;
        for ([from, to], count) in cells {
            let factor = count / (to - from);
            if !factor.is_finite() {
                continue;
            }
            if self.knots.is_empty() {
                self.knots.push(Knot { at: 0.0, factor, sum: 0.0 });
            }
            self.add_knot(0.5 * (from + to), factor);
            end = factor;
        }
        if !self.knots.is_empty() {
            self.add_knot(self.total(), end);
        }
    }

    fn add_knot(&mut self, at: f64, factor: f64) {
        let last = self.knots[self.knots.len() - 1];
        let sum = last.sum + 0.5 * (last.factor + factor) * (at - last.at);
        self.knots.push(Knot { at, factor, sum });
    }

    /// Calls `place` with parameter and measure of the inner ends of `count` equal parts.
    pub fn divide(&self, count: usize, mut place: impl FnMut(f64, f64)) {
        let total = self.corrected_total();
        let (mut knot, mut sample) = (0, 0);
        for i in 1..count {
            let goal = total * (i as f64 / count as f64);
            let mut m = goal;
            if !self.knots.is_empty() {
                while knot + 2 < self.knots.len() && self.knots[knot + 1].sum < goal {
                    knot += 1;
                }
                m = between(self.knots[knot], self.knots[knot + 1], goal);
            }
            while sample + 2 < self.samples.len() && self.samples[sample + 1].sum < m {
                sample += 1;
            }
            place(parameter(self.samples[sample], self.samples[sample + 1], m), m);
        }
    }
}

/// A variable that runs slowly at both ends of 0..=1, with its derivative.
fn slow(x: f64) -> (f64, f64) {
    let x2 = x * x;
    (x * x2 * (10.0 - 15.0 * x + 6.0 * x2), 30.0 * x2 * (1.0 - x) * (1.0 - x))
}

/// Where the corrected measure between two knots, whose factor is linear, has the value `goal`.
fn between(a: Knot, b: Knot, goal: f64) -> f64 {
    let width = b.at - a.at;
    if width <= 0.0 {
        return a.at;
    }
    let (rest, slope) = (goal - a.sum, (b.factor - a.factor) / width);
    let root = (a.factor * a.factor + 2.0 * slope * rest).max(0.0).sqrt();
    a.at + (2.0 * rest / (a.factor + root)).clamp(0.0, width)
}

/// Parameter of the curve where the measure between two samples has the value `goal`.
fn parameter(a: Sample, b: Sample, goal: f64) -> f64 {
    let (width, rise) = (b.x - a.x, b.sum - a.sum);
    if width <= 0.0 || rise <= 0.0 {
        return b.from + b.width * slow(a.x.min(b.x)).0;
    }
    // Hermite's cubic in 0..=1, slopes limited so that it grows.
    let (p, q) = ((a.density * width / rise).min(3.0), (b.density * width / rise).min(3.0));
    let goal = ((goal - a.sum) / rise).clamp(0.0, 1.0);
    let (c2, c3) = (3.0 - 2.0 * p - q, p + q - 2.0);
    let mut s = goal;
    for _ in 0..STEPS {
        let value = s * (p + s * (c2 + s * c3)) - goal;
        let slope = p + s * (2.0 * c2 + 3.0 * s * c3);
        let next = s - value / slope;
        s = if next.is_finite() { next.clamp(0.0, 1.0) } else { s };
    }
    b.from + b.width * slow(a.x + s * width).0
}
