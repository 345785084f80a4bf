//! How densely biarcs must lie along a part of the curve, its integral, and places at shares of it.
//!
//! **Guarantees** integrals to round-off of places, as far as the density is smooth, so that places at shares do
//! not depend on the pieces of the curve, its parameter or its direction. **Method.** The density is interpolated at
//! Chebyshev places, 9 or 17 of them, on halves of halves until the last coefficients vanish; between, the integral
//! of that polynomial is solved for the parameter by Newton's method.

use super::biarc::Node;
use super::piece::Jet;
use super::track::Track;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Integrals over leaves are as precise, in biarcs, as this many times the round-off of places is in tolerances: a node
/// off by a part of a biarc makes arcs err by such a part of the tolerance.
const SHARE: f64 = 4.0;

/// They are as precise as this, in biarcs, at best: some times the round-off of the density, which takes a cube
/// root to 40 bits.
const FINEST: f64 = 1.0 / 68_719_476_736.0;

/// They need not be more precise than this, in biarcs.
const COARSEST: f64 = 1.0 / 4_194_304.0;

/// Each half is content with so many times the error of the whole, as noise of the density does not become less.
const CONTENT: f64 = 4.0;

/// Halvings of a piece at most; a root of the density, like that at an apex, takes most of them.
const MAX_HALVINGS: u32 = 24;

/// With so many leaves already, none is halved: the density is noise.
const MAX_LEAVES: usize = 1 << 16;

/// More degrees are tried where the error squared, which they promise, is at most so many times what it may be; what they
/// need not tell decides nothing.
const HOPE: f64 = 256.0;

/// A step of Newton's method as short as this part of the root of the precision is the last: it squares to less.
const CLOSE_ENOUGH: f64 = 0.5;

/// Parameters of ends that did not move are the same to this, as their round-off must not decide what is kept.
const SAME: f64 = 1.0 / 1_073_741_824.0;

/// Steps of the search within a leaf.
const MAX_STEPS: usize = 60;

/// Degrees of polynomials.
const LOW: usize = 8;
const HIGH: usize = 16;

/// A stretch of parameters in one piece with the integral of the density there.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    /// Parameter in its middle.
    middle: f64,
    /// Half its width.
    half: f64,
    /// Integral before it.
    before: f64,
    /// Integral from its middle to its start and to its end, divided by `half`.
    ends: [f64; 2],
    /// The polynomial of that integral by powers of the way from the middle, -1 to 1, without the first, which is 0:
    /// pairs of an even and an odd one, and the same of the density.
    powers: [[f64; 4]; HIGH / 2 + 1],
    /// How many pairs there are.
    count: usize,
}

/// The density along a part of a curve; kept for its buffer.
#[derive(Debug, Default)]
pub(super) struct Density {
    leaves: Vec<Leaf>,
    total: f64,
    /// Parameters between which it is known.
    range: [f64; 2],
    precision: f64,
}

/// Where the search for a share of the integral goes on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cursor(usize);

impl Density {
    /// Takes the density between two nodes, as precise as round-off of places is in tolerances. What it already is
    /// between nodes that are nearer to each other stays.
    pub fn fill(
        &mut self,
        track: &Track,
        (ends, tolerance): (&[Node; 2], f64),
        density: impl Fn(&Jet) -> f64,
    ) {
        let [from, to] = [ends[0].u, ends[1].u];
        let [first, last] = self.range;
        let known = std::mem::take(&mut self.total);
        let mut inner = std::mem::take(&mut self.leaves);
        self.range = [from, to];
        self.precision = (SHARE * track.noise() / tolerance).clamp(FINEST, COARSEST);
        if inner.is_empty() || first < from - SAME || last > to + SAME {
            inner.clear();
            self.leaves = inner;
            return self.append(track, [from, to], &density);
        }
        self.leaves.reserve(2 * inner.len());
        self.append(track, [from, first], &density);
        inner.iter_mut().for_each(|leaf| leaf.before += self.total);
        self.leaves.append(&mut inner);
        self.total += known;
        self.append(track, [last, to], &density);
    }

    /// Appends leaves between two parameters.
    fn append(&mut self, track: &Track, [from, to]: [f64; 2], density: &impl Fn(&Jet) -> f64) {
        let mut i = from as usize;
        while (i as f64) < to {
            let whole = i as f64;
            let (a, b) = ((from - whole).max(0.0), (to - whole).min(1.0));
            if a < b {
                let piece = track.piece(i);
                let at = |t: f64| density(&piece.jet(t));
                self.halve((whole, &at), (a, b), (at(a), at(b)), (0, self.precision));
            }
            i += 1;
        }
    }

    /// The integral, which is not finite where the density is not.
    pub fn total(&self) -> f64 {
        self.total
    }

    fn halve(
        &mut self,
        (whole, at): (f64, &impl Fn(f64) -> f64),
        (a, b): (f64, f64),
        (first, last): (f64, f64),
        (halvings, precision): (u32, f64),
    ) {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let last_one = halvings >= MAX_HALVINGS || self.leaves.len() >= MAX_LEAVES;
        let low: [f64; LOW + 1] = std::array::from_fn(|i| match i {
            0 => first,
            LOW => last,
            _ => at(middle + half * LOW_RULE.places[i]),
        });
        let error = half * LOW_RULE.rest(&low);
        if error <= precision {
            return self.push(whole + middle, half, LOW_RULE.powers(&low));
        }
        // Twice the degree squares the ratio of coefficients.
        let size = half * low[LOW / 2];
        if !last_one && error * error > HOPE * precision * size {
            return self.halves(
                (whole, at),
                [a, middle, b],
                [first, low[LOW / 2], last],
                (halvings, precision),
            );
        }
        let high: [f64; HIGH + 1] = std::array::from_fn(|i| match i % 2 {
            0 => low[i / 2],
            _ => at(middle + half * HIGH_RULE.places[i]),
        });
        if last_one || half * HIGH_RULE.rest(&high) <= precision {
            return self.push(whole + middle, half, HIGH_RULE.powers(&high));
        }
        self.halves((whole, at), [a, middle, b], [first, low[LOW / 2], last], (halvings, precision));
    }

    fn halves(
        &mut self,
        of: (f64, &impl Fn(f64) -> f64),
        [a, middle, b]: [f64; 3],
        [first, center, last]: [f64; 3],
        (halvings, precision): (u32, f64),
    ) {
        let next = (halvings + 1, (CONTENT * precision).min(COARSEST));
        self.halve(of, (a, middle), (first, center), next);
        self.halve(of, (middle, b), (center, last), next);
    }

    /// Appends a leaf.
    fn push<const N: usize>(&mut self, middle: f64, half: f64, found: [f64; N]) {
        let mut powers = [[0.0; 4]; HIGH / 2 + 1];
        for (i, c) in found.iter().enumerate() {
            (powers[i / 2][i % 2], powers[i / 2][2 + i % 2]) = (*c, c * (i + 1) as f64);
        }
        let mut leaf =
            Leaf { middle, half, before: self.total, ends: [0.0; 2], powers, count: N.div_ceil(2) };
        leaf.ends = [-1.0, 1.0].map(|z| leaf.integral(z).0);
        self.leaves.push(leaf);
        self.total += half * (leaf.ends[1] - leaf.ends[0]);
    }

    /// The parameter up to which the integral is `share`; shares must not fall from call to call with
    /// one cursor.
    pub fn beyond(&self, share: f64, cursor: &mut Cursor) -> f64 {
        let ends = |leaf: &Leaf| leaf.before + leaf.half * (leaf.ends[1] - leaf.ends[0]);
        while cursor.0 < self.leaves.len() && ends(&self.leaves[cursor.0]) < share {
            cursor.0 += 1;
        }
        let close = CLOSE_ENOUGH * self.precision.sqrt();
        self.leaves
            .get(cursor.0)
            .map_or(self.range[1], |leaf| leaf.middle + leaf.half * leaf.solve(share, close))
    }
}

/// Interpolation at Chebyshev places.
struct Rule<const N: usize> {
    /// From -1 to 1.
    places: [f64; N],
    /// The last coefficients by Chebyshev polynomials, for each value.
    last: [[f64; N]; 2],
    /// For each pair of values on both sides, shares of powers of the integral: of odd powers in their sum, of even
    /// ones in their difference.
    powers: [[f64; N]; N],
}

static LOW_RULE: LazyLock<Rule<{ LOW + 1 }>> = LazyLock::new(Rule::new);
static HIGH_RULE: LazyLock<Rule<{ HIGH + 1 }>> = LazyLock::new(Rule::new);

impl<const N: usize> Rule<N> {
    fn new() -> Rule<N> {
        let n = N - 1;
        // The coefficient of Chebyshev polynomial `k` for value `j`.
        let share = |k: usize, j: usize| {
            let halved = |i: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
            2.0 / n as f64 * halved(k) * halved(j) * (PI * (k * (n - j)) as f64 / n as f64).cos()
        };
        let (mut before, mut polynomial) = ([0.0; N], [0.0; N]);
        polynomial[0] = 1.0;
        let mut powers = [[0.0; N]; N];
        for k in 0..N {
            for (i, c) in polynomial.iter().enumerate() {
                (0..N).for_each(|j| powers[j][i] += c * share(k, j) / (i + 1) as f64);
            }
            // T(k + 1) = 2 z T(k) - T(k - 1), but T1 = z T0.
            let factor = if k == 0 { 1.0 } else { 2.0 };
            let next =
                std::array::from_fn(|i| if i > 0 { factor * polynomial[i - 1] } else { 0.0 } - before[i]);
            (before, polynomial) = (polynomial, next);
        }
        Rule {
            places: std::array::from_fn(|j| -(PI * j as f64 / n as f64).cos()),
            last: [n - 1, n].map(|k| std::array::from_fn(|j| share(k, j))),
            powers,
        }
    }

    /// The sum of the last coefficients of values, for the integral: what is left out is less than that.
    fn rest(&self, values: &[f64; N]) -> f64 {
        let mut last = [0.0; 2];
        for (j, value) in values.iter().enumerate() {
            (0..2).for_each(|i| last[i] += self.last[i][j] * value);
        }
        (last[0].abs() + last[1].abs()) / N as f64
    }

    /// The integral by powers.
    fn powers(&self, values: &[f64; N]) -> [f64; N] {
        let (n, mut powers) = (N - 1, [0.0; N]);
        for (j, shares) in self.powers[..=n / 2].iter().enumerate() {
            let (a, b) = (values[j], if 2 * j == n { 0.0 } else { values[n - j] });
            let by = [a + b, a - b];
            for (to, share) in powers.chunks_exact_mut(2).zip(shares.chunks_exact(2)) {
                (0..2).for_each(|i| to[i] += share[i] * by[i]);
            }
            powers[n] += shares[n] * by[0];
        }
        powers
    }
}

impl Leaf {
    /// The integral from the middle and its derivative, divided by `half`.
    #[inline]
    fn integral(&self, z: f64) -> (f64, f64) {
        // Four short chains of products run side by side.
        let (mut sums, square) = ([0.0; 4], z * z);
        for c in self.powers[..self.count].iter().rev() {
            (0..4).for_each(|i| sums[i] = sums[i] * square + c[i]);
        }
        (z * (sums[0] + z * sums[1]), sums[2] + z * sums[3])
    }

    /// The way from its middle, -1 to 1, up to which the integral of the whole is `share`.
    fn solve(&self, share: f64, close: f64) -> f64 {
        let [start, end] = self.ends;
        let wanted = (share - self.before) / self.half + start;
        let (mut low, mut high) = (-1.0, 1.0);
        // Through the ends and the middle.
        let mut z = wanted * ((wanted - start) / end + (wanted - end) / start) / (end - start);
        z = if z > low && z < high { z } else { 2.0 * (wanted - start) / (end - start) - 1.0 };
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.integral(z);
            if value > wanted {
                high = z;
            } else {
                low = z;
            }
            let next = z - (value - wanted) / slope;
            let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
            if (next - z).abs() <= close {
                return next;
            }
            z = next;
        }
        z
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
        density.fill(&track, (&ends, 1.0), |jet| jet.d1.length());
        let total = density.total();
        assert!((total - 2.0 * TAU).abs() < 64.0 * FINEST);
        let mut cursor = Cursor::default();
        for i in 1..10 {
            let angle = TAU * f64::from(i) / 10.0;
            let place = track.place(density.beyond(2.0 * angle, &mut cursor));
            assert!((place - vector(angle.cos(), angle.sin()) * 2.0).length() < 1e-11);
        }
    }
}
