//! A proven bound on the distance between an arc and the part of the curve it stands for.
//!
//! **Needs** a part of the curve whose ends lie on the normals of the arc at its ends. **Guarantees**
//! that no place of either is farther from the other than the bound, but for round-off in proportion
//! to the coordinates; the bound is at most [`TIGHT`] times the largest distance.
//!
//! **Method.** In the frame of the chord (length `c`, middle at zero, left normal `n`) a place `w`
//! has the power `e = cos(theta) w.n - k/2 (|w|^2 - c^2/4)` with respect to the circle of curvature
//! `k` and half sweep `theta`: no center, so it holds for straight arcs too. `e = d - k d^2 / 2` for
//! the signed distance `d` to the circle, thus `|d| <= 2|e| / (1 + sqrt(1 - 2|k e|))`. Along a
//! rational piece `e` is a ratio of Bernstein forms of twice its degree, bounded by the ratios of
//! their coefficients and divided until the bound is tight. The angle seen from the center is
//! monotone, shown by the control polygon, so every normal of the arc meets the part once and the
//! bound holds in both directions (S0, section 2.3, footnote 2, in curvature form).

use super::bernstein::BINOMIAL;
use super::biarc::Arc;
use super::piece::{MAX_CURVE_DEGREE, Piece};
use crate::geom::Vector;

/// The bound is at most this many times the largest distance, unless division is given up. So near, at round-off of
/// distances in tolerances, that the nodes, which follow from them, do not depend on the parameter of the curve; parts
/// that meet at stationary places double the digits each time.
pub(super) const TIGHT: f64 = 1.0 + 1.0 / 1_099_511_627_776.0;

/// Divisions before a bound that is not tight is taken as it is.
const MAX_DIVISIONS: u32 = 24;

/// Halvings of a part that is not shown to be monotone, before it counts as running back.
const MAX_HALVINGS: u32 = 8;

/// Intervals between samples of the estimate.
const SAMPLES: usize = 8;

const LEN: usize = 2 * MAX_CURVE_DEGREE + 1;

/// Bound and largest distance found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Distance {
    /// No distance is larger.
    pub bound: f64,
    /// Some distance is at least this.
    pub found: f64,
}

impl Distance {
    /// Nothing measured yet.
    pub const ZERO: Distance = Distance { bound: 0.0, found: 0.0 };
    /// What is known of parts that could not be matched: nothing.
    pub const UNKNOWN: Distance = Distance { bound: f64::INFINITY, found: f64::INFINITY };

    /// Of both together.
    pub fn max(self, other: Distance) -> Distance {
        Distance { bound: self.bound.max(other.bound), found: self.found.max(other.found) }
    }
}

/// An arc in the frame of its chord.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub middle: Vector,
    pub along: Vector,
    pub half: f64,
    pub cos: f64,
    pub half_curvature: f64,
}

impl Frame {
    /// The frame of an arc with two different ends.
    pub fn of(arc: &Arc) -> Frame {
        let chord = arc.end - arc.start;
        let length = chord.length();
        let b2 = arc.bulge * arc.bulge;
        Frame {
            middle: (arc.start + arc.end) * 0.5,
            along: chord / length,
            half: 0.5 * length,
            cos: (1.0 - b2) / (1.0 + b2),
            half_curvature: 2.0 * arc.bulge / ((1.0 + b2) * length),
        }
    }

    fn enter(&self, p: Vector) -> Vector {
        let w = p - self.middle;
        Vector { x: w.dot(self.along), y: self.along.cross(w) }
    }

    /// Distance to the circle for the absolute power.
    pub fn distance(&self, power: f64) -> f64 {
        let root = 1.0 - 4.0 * self.half_curvature.abs() * power;
        if root >= 0.0 { 2.0 * power / (1.0 + root.sqrt()) } else { f64::INFINITY }
    }

    /// The power of places at a distance.
    pub fn power(&self, distance: f64) -> f64 {
        (distance - self.half_curvature.abs() * distance * distance).max(0.0)
    }

    /// Distance between the arc and a part of a piece, whose ends are on its normals or inside. A bound
    /// below `limit` need not be tight.
    pub fn measure(&self, mut local: Piece, limit: f64) -> Distance {
        local.map(|p| self.enter(p));
        let back = self.turning_back(&local, MAX_HALVINGS);
        if back.is_infinite() {
            return Distance::UNKNOWN;
        }
        let limit = self.power(limit - back);
        // Cubics are by far the most; their forms are short.
        let range = match local.degree() {
            ..=3 => Power::<7>::along(&local, self).range(limit),
            _ => Power::<LEN>::along(&local, self).range(limit),
        };
        let found = self.distance(range.found.min(range.bound));
        Distance { bound: self.distance(range.bound) + back, found }
    }

    /// How far a part of a piece is to the left and to the right of the arc.
    pub fn sides(&self, mut local: Piece) -> [f64; 2] {
        local.map(|p| self.enter(p));
        let [left, right] = match local.degree() {
            ..=3 => Power::<7>::along(&local, self).sides(),
            _ => Power::<LEN>::along(&local, self).sides(),
        };
        [self.distance(left), self.distance(right)]
    }

    /// The largest distance of some samples of a part from the arc: an estimate, not a bound (S0,
    /// Algorithm 2).
    pub fn sample(&self, part: &Piece) -> Distance {
        let power = |i: usize| {
            let w = self.enter(part.at(i as f64 / SAMPLES as f64));
            (self.cos * w.y - self.half_curvature * (w.length_squared() - self.half * self.half)).abs()
        };
        let found = self.distance((0..=SAMPLES).map(power).fold(0.0, f64::max));
        Distance { bound: found, found }
    }

    /// How far the part may run back as seen from the center: 0 when the angle is monotone. With
    /// derivative `q'` that is `(cos(theta) - k q.y) q'.x + k q.x q'.y > 0`; `q` lies in the box of the
    /// control points, and `q'` is a positive sum of the steps between them. Small parts for which that
    /// is not shown count with their extent.
    fn turning_back(&self, part: &Piece, halvings: u32) -> f64 {
        let k = 2.0 * self.half_curvature;
        let points = part.points();
        let (mut low, mut high) = (points[0], points[0]);
        for p in &points[1..] {
            low = Vector { x: low.x.min(p.x), y: low.y.min(p.y) };
            high = Vector { x: high.x.max(p.x), y: high.y.max(p.y) };
        }
        let (a, b) = ([self.cos - k * low.y, self.cos - k * high.y], [k * low.x, k * high.x]);
        let least = |[a, b]: [f64; 2], s: f64| (a * s).min(b * s);
        if points.windows(2).all(|w| least(a, w[1].x - w[0].x) + least(b, w[1].y - w[0].y) >= 0.0) {
            return 0.0;
        }
        if halvings == 0 {
            return (high - low).length();
        }
        if halvings == MAX_HALVINGS && self.goes_back(part) {
            return f64::INFINITY;
        }
        self.turning_back(&part.part(0.0, 0.5), halvings - 1)
            + self.turning_back(&part.part(0.5, 1.0), halvings - 1)
    }

    /// Whether the angle seen from the center is no larger at the end of a part than at its start.
    fn goes_back(&self, part: &Piece) -> bool {
        let k = 2.0 * self.half_curvature;
        let (from, to) = (part.start(), part.end());
        let middle = (from + to) * 0.5;
        (self.cos - k * middle.y) * (to.x - from.x) + k * middle.x * (to.y - from.y) <= 0.0
    }
}

/// Sides of an arc that a range is about.
const BOTH: i8 = 0;
const LEFT: i8 = 1;
const RIGHT: i8 = -1;

/// How far a power is on a side.
#[inline]
fn on<const SIDE: i8>(power: f64) -> f64 {
    if SIDE == BOTH { power.abs() } else { f64::from(SIDE) * power }
}

/// The power along a piece as numerator and denominator in Bernstein form, with room for `N`
/// coefficients.
#[derive(Clone, Copy)]
struct Power<const N: usize> {
    degree: usize,
    rational: bool,
    numerator: [f64; N],
    denominator: [f64; N],
}

impl<const N: usize> Power<N> {
    fn along(local: &Piece, frame: &Frame) -> Power<N> {
        let d = local.degree();
        let (points, weights) = (local.points(), local.weights());
        let mut power = Power {
            degree: 2 * d,
            rational: local.is_rational(),
            numerator: [0.0; N],
            denominator: [0.0; N],
        };
        let (quarter, half_cos) = (frame.half * frame.half, 0.5 * frame.cos);
        for i in 0..=d {
            for j in i..=d {
                let twice = if i == j { 1.0 } else { 2.0 };
                let share = twice * SHARES[d][i][j] * weights[i] * weights[j];
                let (p, q) = (points[i], points[j]);
                let e = half_cos * (p.y + q.y) - frame.half_curvature * (p.dot(q) - quarter);
                power.numerator[i + j] += share * e;
                power.denominator[i + j] += share;
            }
        }
        power
    }

    /// Largest value of ratios of coefficients.
    fn largest<const SIDE: i8>(&self) -> f64 {
        let pairs = self.numerator[..=self.degree].iter().zip(&self.denominator[..=self.degree]);
        if self.rational {
            pairs.fold(0.0, |m: f64, (a, b)| m.max(on::<SIDE>(*a) / b))
        } else {
            pairs.fold(0.0, |m: f64, (a, _)| m.max(on::<SIDE>(*a)))
        }
    }

    /// Bound and largest value found of the absolute power.
    fn range(self, limit: f64) -> Distance {
        self.top::<BOTH>(limit)
    }

    /// Largest power, and largest negative one.
    fn sides(self) -> [f64; 2] {
        [self.top::<LEFT>(0.0).bound, self.top::<RIGHT>(0.0).bound]
    }

    /// Bound and largest value found of the power on a side.
    fn top<const SIDE: i8>(self, limit: f64) -> Distance {
        let found = on::<SIDE>(self.ratio(0)).max(on::<SIDE>(self.ratio(self.degree))).max(0.0);
        let mut range = Distance { bound: 0.0, found };
        let largest = self.largest::<SIDE>();
        self.bound::<SIDE>((largest, limit), MAX_DIVISIONS, &mut range);
        range
    }

    /// Widens a range by this part, whose largest ratio of coefficients is known.
    fn bound<const SIDE: i8>(mut self, (largest, limit): (f64, f64), divisions: u32, range: &mut Distance) {
        if largest <= range.bound {
            return;
        }
        if largest <= limit || largest <= TIGHT * range.found || divisions == 0 {
            range.bound = largest;
            return;
        }
        let before = self.divide();
        range.found = range.found.max(on::<SIDE>(before.ratio(before.degree)));
        // The larger part first: then the other is often settled at once.
        let (m, n) = (before.largest::<SIDE>(), self.largest::<SIDE>());
        if m > n {
            before.bound::<SIDE>((m, limit), divisions - 1, range);
            self.bound::<SIDE>((n, limit), divisions - 1, range);
        } else {
            self.bound::<SIDE>((n, limit), divisions - 1, range);
            before.bound::<SIDE>((m, limit), divisions - 1, range);
        }
    }

    fn ratio(&self, i: usize) -> f64 {
        self.numerator[i] / self.denominator[i]
    }

    /// Keeps the second part and answers the first: of two halves, or of parts that meet about where
    /// the power is stationary, as the bound is tight there at once.
    fn divide(&mut self) -> Power<N> {
        let n = self.degree;
        let (first, last) = (self.ratio(1) - self.ratio(0), self.ratio(n) - self.ratio(n - 1));
        let t = first / (first - last);
        let t = if first * last < 0.0 { t.clamp(0.125, 0.875) } else { 0.5 };
        let mut before = *self;
        divide(&mut self.numerator, &mut before.numerator, n, t);
        if self.rational {
            divide(&mut self.denominator, &mut before.denominator, n, t);
        }
        before
    }
}

fn divide<const N: usize>(c: &mut [f64; N], before: &mut [f64; N], n: usize, t: f64) {
    let s = 1.0 - t;
    for (k, left) in before[..n].iter_mut().enumerate() {
        *left = c[0];
        for i in 0..n - k {
            c[i] = s * c[i] + t * c[i + 1];
        }
    }
    before[n] = c[0];
}

/// `SHARES[d][i][j]`: share of the product of coefficients `i` and `j` of two forms of degree `d` in
/// coefficient `i + j` of their product.
static SHARES: [[[f64; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1] = shares();

const fn shares() -> [[[f64; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1] {
    let mut table = [[[0.0; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1]; MAX_CURVE_DEGREE + 1];
    let mut d = 0;
    while d <= MAX_CURVE_DEGREE {
        let mut i = 0;
        while i <= d {
            let mut j = 0;
            while j <= d {
                table[d][i][j] = BINOMIAL[d][i] * BINOMIAL[d][j] / BINOMIAL[2 * d][i + j];
                j += 1;
            }
            i += 1;
        }
        d += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector;

    /// Largest distance of samples to the circle of the arc from (0, 0) to (1, 0).
    fn sampled(part: &Piece, arc: &Arc) -> f64 {
        let b = arc.bulge;
        let radius = (1.0 + b * b) / (4.0 * b).abs();
        let center = vector(0.5, (1.0 - b * b) / (4.0 * b));
        let off = |i: i32| {
            let p = part.at(f64::from(i) / 1000.0);
            if b == 0.0 { p.y.abs() } else { ((p - center).length() - radius).abs() }
        };
        (0..=1000).map(off).fold(0.0, f64::max)
    }

    #[test]
    fn the_bound_is_above_all_samples_and_near_them() {
        let points = [vector(0.0, 0.0), vector(0.3, -0.2), vector(0.7, -0.1), vector(1.0, 0.0)];
        for weights in [[1.0; 4], [1.0, 2.0, 0.7, 1.0]] {
            let part = Piece::new(&points, &weights);
            for bulge in [0.0, 0.1, 0.3, -0.1, 1e-9] {
                let arc = Arc { start: vector(0.0, 0.0), end: vector(1.0, 0.0), bulge };
                let distance = Frame::of(&arc).measure(part, 0.0);
                let sampled = sampled(&part, &arc);
                assert!(distance.bound >= sampled - 1e-9, "{bulge}: {distance:?}, sampled {sampled}");
                assert!(distance.bound <= 1.1 * sampled, "{bulge}: {distance:?}, sampled {sampled}");
            }
        }
    }

    #[test]
    fn a_part_that_turns_back_has_a_bound_that_says_so() {
        let points = [vector(0.0, 0.0), vector(3.0, 0.1), vector(-2.0, 0.1), vector(1.0, 0.0)];
        let arc = Arc { start: vector(0.0, 0.0), end: vector(1.0, 0.0), bulge: -0.05 };
        assert!(Frame::of(&arc).measure(Piece::new(&points, &[1.0; 4]), 0.0).bound > 0.3);
    }

    #[test]
    fn a_circle_has_no_distance_from_itself() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let quarter = Piece::new(&[vector(1.0, 0.0), vector(1.0, 1.0), vector(0.0, 1.0)], &[1.0, half, 1.0]);
        let arc =
            Arc { start: vector(1.0, 0.0), end: vector(0.0, 1.0), bulge: (std::f64::consts::PI / 8.0).tan() };
        assert!(Frame::of(&arc).measure(quarter, 0.0).bound < 1e-15);
    }
}
