//! How densely biarcs must lie along a part of the curve, its integral, and places at shares of it.
//!
//! **Guarantees** integrals to [`PRECISION`] of a biarc, so that places do not depend on the parameter
//! of the curve. **Method.** Boole's rule on halves of halves, until a whole and its halves say the same;
//! between, the quartic through five values, integrated, is solved for the parameter.

use super::biarc::Node;
use super::piece::Bend;
use super::track::Track;

/// Precision of the integral over a leaf, in biarcs.
const PRECISION: f64 = 1.0 / 4_194_304.0;

/// How many times better Boole's rule is on two halves than on the whole.
const BETTER: f64 = 63.0;

/// Halvings of a piece at most; a root of the density, like that at an apex, takes most of them.
const MAX_HALVINGS: u32 = 24;

/// With so many leaves already, none is halved: the density is noise.
const MAX_LEAVES: usize = 1 << 16;

/// Steps of the search within a leaf.
const MAX_STEPS: usize = 60;

/// A step of Newton's method as short as this, in quarters of a leaf, is the last: it squares to less than
/// round-off of a parameter.
const CLOSE_ENOUGH: f64 = 1e-7;

/// A stretch of parameters in one piece with the quartic that is the density there.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    from: f64,
    /// A quarter of its width.
    quarter: f64,
    /// Of the quartic, in quarters from `from`.
    coefficients: [f64; 5],
    /// Integral before it.
    before: f64,
    /// Integral over it.
    integral: f64,
}

/// The density along a part of a curve; kept for its buffer.
#[derive(Debug, Default)]
pub(super) struct Density {
    leaves: Vec<Leaf>,
    total: f64,
    end: f64,
}

/// Where the search for a share of the integral goes on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cursor(usize);

impl Density {
    /// Takes the density between two nodes.
    pub fn fill(&mut self, track: &Track, ends: &[Node; 2], density: impl Fn(&Bend) -> f64) {
        let (from, to) = (ends[0].u, ends[1].u);
        self.leaves.clear();
        (self.total, self.end) = (0.0, to);
        let mut whole = from.floor();
        while whole < to {
            let (a, b) = ((from - whole).max(0.0), (to - whole).min(1.0));
            if a < b {
                let piece = track.piece(whole as usize);
                let at = |t: f64| density(&piece.jet(t).bend());
                let quarter = 0.25 * (b - a);
                let values = [0.0, 1.0, 2.0, 3.0, 4.0].map(|i| at(a + i * quarter));
                self.halve(whole, (a, b), values, 0, &at);
            }
            whole += 1.0;
        }
    }

    /// The integral, which is not finite where the density is not.
    pub fn total(&self) -> f64 {
        self.total
    }

    fn halve(
        &mut self,
        whole: f64,
        (a, b): (f64, f64),
        values: [f64; 5],
        halvings: u32,
        at: &impl Fn(f64) -> f64,
    ) {
        let (center, eighth) = (0.5 * (a + b), 0.125 * (b - a));
        let [v0, v2, v4, v6, v8] = values;
        let [v1, v3, v5, v7] = [1.0, 3.0, 5.0, 7.0].map(|i| at(a + i * eighth));
        let halves = [[v0, v1, v2, v3, v4], [v4, v5, v6, v7, v8]];
        let fine = eighth * (boole(&halves[0]) + boole(&halves[1]));
        let unsure = (fine - 2.0 * eighth * boole(&values)).abs() > BETTER * PRECISION;
        if unsure && halvings < MAX_HALVINGS && self.leaves.len() < MAX_LEAVES {
            self.halve(whole, (a, center), halves[0], halvings + 1, at);
            self.halve(whole, (center, b), halves[1], halvings + 1, at);
        } else {
            self.push(whole + a, eighth, &halves[0]);
            self.push(whole + center, eighth, &halves[1]);
        }
    }

    /// Appends a leaf with the values at its quarters.
    fn push(&mut self, from: f64, quarter: f64, values: &[f64; 5]) {
        let [v0, v1, v2, v3, v4] = *values;
        let (d1, d2) = (v1 - v0, v2 - 2.0 * v1 + v0);
        let (d3, d4) = (v3 - 3.0 * v2 + 3.0 * v1 - v0, v4 - 4.0 * v3 + 6.0 * v2 - 4.0 * v1 + v0);
        let coefficients = [
            v0,
            d1 - d2 / 2.0 + d3 / 3.0 - d4 / 4.0,
            d2 / 2.0 - d3 / 2.0 + 11.0 * d4 / 24.0,
            d3 / 6.0 - d4 / 4.0,
            d4 / 24.0,
        ];
        let integral = quarter * boole(values);
        self.leaves.push(Leaf { from, quarter, coefficients, before: self.total, integral });
        self.total += integral;
    }

    /// The parameter up to which the integral is `share`; shares must not fall from call to call with
    /// one cursor.
    pub fn beyond(&self, share: f64, cursor: &mut Cursor) -> f64 {
        let ends = |leaf: &Leaf| leaf.before + leaf.integral;
        while cursor.0 < self.leaves.len() && ends(&self.leaves[cursor.0]) < share {
            cursor.0 += 1;
        }
        self.leaves.get(cursor.0).map_or(self.end, |leaf| leaf.from + leaf.quarter * leaf.solve(share))
    }
}

/// The integral of the quartic through five values a unit apart.
fn boole([a, b, c, d, e]: &[f64; 5]) -> f64 {
    (14.0 * (a + e) + 64.0 * (b + d) + 24.0 * c) / 45.0
}

impl Leaf {
    /// Quarters from its start up to which the integral of the whole is `share`.
    fn solve(&self, share: f64) -> f64 {
        let [a, b, c, d, e] = self.coefficients;
        let wanted = (share - self.before) / self.quarter;
        let (mut low, mut high) = (0.0, 4.0);
        let mut y = 4.0 * (share - self.before) / self.integral;
        for _ in 0..MAX_STEPS {
            let value = y * (a + y * (b / 2.0 + y * (c / 3.0 + y * (d / 4.0 + y * e / 5.0)))) - wanted;
            if value > 0.0 {
                high = y;
            } else {
                low = y;
            }
            let next = y - value / (a + y * (b + y * (c + y * (d + y * e))));
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - y).abs() <= CLOSE_ENOUGH {
                return next;
            }
            y = next;
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::geom::{point, vector};
    use std::f64::consts::TAU;

    #[test]
    fn shares_of_the_length_of_a_circle_are_angles() {
        let circle = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 1.0, 0.0, 0.0).unwrap();
        let pieces = circle.pieces().unwrap();
        let track = Track::new(&pieces);
        let ends = [Node { u: 0.0, ..Node::default() }, Node { u: 4.0, ..Node::default() }];
        let mut density = Density::default();
        density.fill(&track, &ends, |bend| bend.speed);
        let total = density.total();
        assert!((total - 2.0 * TAU).abs() < 64.0 * PRECISION);
        let mut cursor = Cursor::default();
        for i in 1..10 {
            let angle = TAU * f64::from(i) / 10.0;
            let place = track.place(density.beyond(2.0 * angle, &mut cursor));
            assert!((place - vector(angle.cos(), angle.sin()) * 2.0).length() < 1e-6);
        }
    }
}
