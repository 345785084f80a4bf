//! A proven bound on the distance between an arc and a short part of a piece of low degree, in a few
//! steps and without division but in quarters.
//!
//! **Needs** what [`super::bound`] needs, and gives the same answer where it gives one. **Guarantees** a
//! bound that holds and is within the last of [`SLACKS`] of the largest distance. **Does not** answer for parts that
//! turn much and for weights of different orders, for which [`super::bound`] is there.
//!
//! **Method.** In the middle of the part the numerator `N` of the power (see [`super::bound`]) and its
//! denominator `D` are polynomials of degree 6 on -1..=1. An arc with common tangents errs like a cubic
//! and little else, so stationary places of the cubic, and a step or two of Newton's method, give the
//! largest value `m` of `|N / D|`. That `b D - N` and `b D + N` are positive for a `b` little above `m` is
//! then shown by the minimum of their cubic part, from which the other Chebyshev coefficients are
//! taken off. The angle is monotone by the ranges of its factors. Over an apex an arc errs like a quartic; each quarter
//! of it does so like a cubic.

use super::bound::{Distance, Frame};
use super::piece::Piece;

/// Largest degree of a piece.
const DEGREE: usize = 3;

/// The bound is above the largest distance found by one of these parts of it, or is the limit.
const SLACKS: [f64; 3] = [1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0];

/// Steps of Newton's method for a stationary place at most, and the length of the last one: the value there
/// is as good as the fourth power of that, as the steps square and it is stationary.
const STEPS: usize = 8;
const LAST_STEP: f64 = 1e-3;

/// Parts in which stationary places are looked for where all of them count.
const PARTS: i32 = 4;

/// Parts that are proven one by one where the whole is not.
const QUARTERS: i32 = 4;

/// A polynomial of degree 6.
type Sextic = [f64; 2 * DEGREE + 1];

/// Coordinates in the frame of an arc, times the weight, and the weight, by powers of a variable that
/// runs from -1 to 1.
struct Local {
    x: [f64; DEGREE + 1],
    y: [f64; DEGREE + 1],
    w: [f64; DEGREE + 1],
    rational: bool,
}

/// Distance between the arc of a frame and the part of a piece between two parameters; a bound below
/// `limit` need not be tight. `None` where it takes more to tell.
pub(super) fn measure(frame: &Frame, piece: &Piece, (from, to): (f64, f64), limit: f64) -> Option<Distance> {
    if !piece.has_powers() {
        return None;
    }
    let part = |i: i32| from + (to - from) * f64::from(i) / f64::from(QUARTERS);
    whole(frame, piece, (from, to), limit).or_else(|| {
        (0..QUARTERS).try_fold(Distance::ZERO, |distance, i| {
            let next = whole(frame, piece, (part(i), part(i + 1)), limit)?;
            Some(distance.max(next))
        })
    })
}

/// The same in one go.
fn whole(frame: &Frame, piece: &Piece, (from, to): (f64, f64), limit: f64) -> Option<Distance> {
    let local = Local::of(frame, piece, 0.5 * (from + to), 0.5 * (to - from));
    if !local.runs_on(frame) {
        return None;
    }
    let (n, d) = local.power(frame);
    let found = values(&n, &d, local.rational).iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let within = frame.power(limit);
    let proof = Proof::of(&n, &d, local.rational);
    let near = |slack: f64| {
        let bound = found * (1.0 + slack);
        let bound = if found <= within { bound.min(within) } else { bound };
        proof.holds(bound).then_some(bound)
    };
    let bound = SLACKS.iter().find_map(|&slack| near(slack))?;
    let [distance, found] = [bound, found].map(|power| frame.distance(power));
    // The round-off of a power there and back must not matter at the limit itself.
    let bound = if bound <= within { distance.min(limit) } else { distance };
    Some(Distance { bound, found: found.min(bound) })
}

/// How far the part of a piece between two parameters is to the left and to the right of an arc, as found
/// and not proven. `None` for pieces of higher degree.
pub(super) fn sides(frame: &Frame, piece: &Piece, (from, to): (f64, f64)) -> Option<[f64; 2]> {
    if !piece.has_powers() {
        return None;
    }
    let local = Local::of(frame, piece, 0.5 * (from + to), 0.5 * (to - from));
    let (n, d) = local.power(frame);
    let (mut least, mut most) = (0.0f64, 0.0f64);
    extrema((&n, &d, local.rational), |value| (least, most) = (least.min(value), most.max(value)));
    Some([frame.distance(most), frame.distance(-least)])
}

impl Local {
    fn of(frame: &Frame, piece: &Piece, middle: f64, half: f64) -> Local {
        let [mut x, mut y, mut w] = piece.powers(middle);
        let mut scale = 1.0;
        for i in 0..=DEGREE {
            let (u, v) = (x[i] - frame.middle.x * w[i], y[i] - frame.middle.y * w[i]);
            x[i] = scale * (u * frame.along.x + v * frame.along.y);
            y[i] = scale * (frame.along.x * v - frame.along.y * u);
            w[i] *= scale;
            scale *= half;
        }
        Local { x, y, w, rational: piece.is_rational() }
    }

    /// Whether the angle seen from the center rises all along: as in [`super::bound`], by the ranges of
    /// coordinates and derivatives.
    fn runs_on(&self, frame: &Frame) -> bool {
        let k = 2.0 * frame.half_curvature.abs();
        let most = |c: &[f64; 4]| c[0].abs() + c[1].abs() + c[2].abs() + c[3].abs();
        let change = |c: &[f64; 4]| 2.0 * c[2].abs() + 3.0 * c[3].abs();
        let (x, y, w) = (most(&self.x), most(&self.y), most(&self.w));
        let least_w = 2.0 * self.w[0] - w;
        let dw = self.w[1].abs() + change(&self.w);
        let dx = [self.x[1] - change(&self.x), self.x[1].abs() + change(&self.x)];
        let dy = self.y[1].abs() + change(&self.y);
        let along = dx[0] * least_w - x * dw;
        let toward = frame.cos * least_w - k * y;
        along > 0.0 && least_w > 0.0 && toward > 0.0 && toward * along > k * x * (dy * w + y * dw)
    }

    /// Numerator and denominator of the power.
    fn power(&self, frame: &Frame) -> (Sextic, Sextic) {
        let (k, q) = (frame.half_curvature, frame.half * frame.half);
        let (mut n, mut d) = ([0.0; 7], [0.0; 7]);
        if !self.rational {
            let square = |i: usize| self.x[i] * self.x[i] + self.y[i] * self.y[i];
            let twice = |i: usize, j: usize| 2.0 * (self.x[i] * self.x[j] + self.y[i] * self.y[j]);
            n = [
                frame.cos * self.y[0] + k * (q - square(0)),
                frame.cos * self.y[1] - k * twice(0, 1),
                frame.cos * self.y[2] - k * (twice(0, 2) + square(1)),
                frame.cos * self.y[3] - k * (twice(0, 3) + twice(1, 2)),
                -k * (twice(1, 3) + square(2)),
                -k * twice(2, 3),
                -k * square(3),
            ];
            d[0] = 1.0;
            return (n, d);
        }
        for i in 0..=DEGREE {
            for j in 0..=DEGREE {
                let ww = self.w[i] * self.w[j];
                d[i + j] += ww;
                n[i + j] += frame.cos * self.y[i] * self.w[j]
                    - k * (self.x[i] * self.x[j] + self.y[i] * self.y[j] - q * ww);
            }
        }
        (n, d)
    }
}

/// Value, first and second derivative.
#[inline]
fn at(p: &Sextic, z: f64) -> [f64; 3] {
    let (mut v, mut v1, mut v2) = (0.0, 0.0, 0.0);
    for c in p.iter().rev() {
        v2 = v2 * z + v1;
        v1 = v1 * z + v;
        v = v * z + c;
    }
    [v, v1, 2.0 * v2]
}

/// A cubic, and what is left of a polynomial of degree 6 beside it: coefficients of Chebyshev polynomials of degree 4
/// to 6.
#[derive(Clone, Copy)]
struct Split {
    cubic: [f64; 4],
    rest: [f64; 3],
}

impl Split {
    #[inline]
    fn of(p: &Sextic) -> Split {
        // z^6 = (10 + 15 T2 + 6 T4 + T6) / 32, z^5 = (10 T1 + 5 T3 + T5) / 16, z^4 = (3 + 4 T2 + T4) / 8.
        let [p0, p1, p2, p3, p4, p5, p6] = *p;
        let (t2, t3) = (0.5 * p4 + 15.0 / 32.0 * p6, 0.3125 * p5);
        let c0 = p0 + 0.375 * p4 + 0.3125 * p6 - t2;
        let c1 = p1 + 0.625 * p5 - 3.0 * t3;
        let rest = [0.125 * p4 + 0.1875 * p6, 0.0625 * p5, 0.03125 * p6];
        Split { cubic: [c0, c1, p2 + 2.0 * t2, p3 + 4.0 * t3], rest }
    }

    /// Some times another one, and this one times a sign.
    fn combined(&self, sign: f64, other: &Split, times: f64) -> Split {
        let cubic = std::array::from_fn(|i| times * other.cubic[i] + sign * self.cubic[i]);
        Split { cubic, rest: std::array::from_fn(|i| times * other.rest[i] + sign * self.rest[i]) }
    }

    /// What the rest contributes at most.
    #[inline]
    fn rest(&self) -> f64 {
        self.rest[0].abs() + self.rest[1].abs() + self.rest[2].abs()
    }

    /// The cubic at the ends and where it is stationary.
    #[inline]
    fn values(&self) -> [f64; 4] {
        let c = &self.cubic;
        let [a, b] = stationary(c);
        [-1.0, 1.0, a, b].map(|z| c[0] + z * (c[1] + z * (c[2] + z * c[3])))
    }
}

/// Places inside where a cubic is stationary; others are the ends next to them, so that it does not
/// matter which way the part is run.
#[inline]
fn stationary([_, c1, c2, c3]: &[f64; 4]) -> [f64; 2] {
    let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
    let q = -(c2 + root.copysign(*c2));
    [q / (3.0 * c3), c1 / q].map(|z| if z.is_nan() { 1.0 } else { z.clamp(-1.0, 1.0) })
}

/// Values of `n / d` at the ends and where it is stationary.
fn values(n: &Sextic, d: &Sextic, rational: bool) -> [f64; 4] {
    let ratio = |z: f64| at(n, z)[0] / if rational { at(d, z)[0] } else { 1.0 };
    let inner = stationary(&Split::of(n).cubic).map(|mut z| {
        for _ in 0..STEPS {
            let [v, v1, v2] = at(n, z);
            let step = if rational {
                let [w, w1, w2] = at(d, z);
                (v1 * w - v * w1) / (v2 * w - v * w2)
            } else {
                v1 / v2
            };
            let next = z - step;
            if next.abs() > 1.0 || next.is_nan() {
                break;
            }
            z = next;
            if step.abs() <= LAST_STEP {
                break;
            }
        }
        ratio(z)
    });
    [ratio(-1.0), ratio(1.0), inner[0], inner[1]]
}

/// Tells the values of `n / d` at the ends and at stationary places between: an arc over an apex errs like a quartic,
/// and may do so by next to nothing on one side.
fn extrema((n, d, rational): (&Sextic, &Sextic, bool), mut tell: impl FnMut(f64)) {
    // The ratio, and a positive multiple of its derivative and of the next one where that vanishes.
    let ratio = |z: f64| {
        let [v, v1, v2] = at(n, z);
        if !rational {
            return (v, v1, v2);
        }
        let [w, w1, w2] = at(d, z);
        (v / w, v1 * w - v * w1, v2 * w - v * w2)
    };
    let (mut low, mut before) = (-1.0, ratio(-1.0));
    tell(before.0);
    for i in 1..=PARTS {
        let high = 2.0 * f64::from(i) / f64::from(PARTS) - 1.0;
        let next = ratio(high);
        if before.1 * next.1 < 0.0 {
            let mut z = low + (high - low) * before.1 / (before.1 - next.1);
            for _ in 0..STEPS {
                let (_, slope, change) = ratio(z);
                let step = slope / change;
                let inside = z - step > low && z - step < high;
                z = if inside { z - step } else { 0.5 * (low + high) };
                if inside && step.abs() <= LAST_STEP {
                    break;
                }
            }
            tell(ratio(z).0);
        }
        (low, before) = (high, next);
    }
    tell(before.0);
}

/// What shows that a bound of `|n / d|` holds: `bound d` is above the absolute value of `n` for certain.
enum Proof {
    /// Without a denominator every bound holds that is not less.
    Plain { least: f64 },
    /// The numerator and the denominator.
    Rational { n: Split, d: Split },
}

impl Proof {
    fn of(n: &Sextic, d: &Sextic, rational: bool) -> Proof {
        let n = Split::of(n);
        if rational {
            return Proof::Rational { n, d: Split::of(d) };
        }
        Proof::Plain { least: n.values().iter().fold(0.0, |m: f64, v| m.max(v.abs())) + n.rest() }
    }

    fn holds(&self, bound: f64) -> bool {
        match self {
            Proof::Plain { least } => bound >= *least,
            Proof::Rational { n, d } => [1.0, -1.0].iter().all(|&sign| {
                let p = n.combined(sign, d, bound);
                p.values().iter().fold(f64::INFINITY, |m: f64, v| m.min(*v)) >= p.rest()
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::biarc::Arc;
    use crate::geom::vector;

    #[test]
    fn it_says_what_division_says() {
        let points = [vector(0.0, 0.0), vector(0.33, 0.011), vector(0.67, 0.012), vector(1.0, 0.001)];
        for weights in [[1.0; 4], [1.0, 1.1, 0.9, 1.05]] {
            let whole = Piece::new(&points, &weights);
            for (from, to) in [(0.0, 1.0), (0.25, 0.5), (0.6, 1.0)] {
                let (start, end) = (whole.at(from), whole.at(to));
                for bulge in [0.0, -0.01, 0.003] {
                    let frame = Frame::of(&Arc { start, end, bulge });
                    let quick = measure(&frame, &whole, (from, to), 0.0).expect("it hardly turns");
                    let slow = frame.measure(whole.part(from, to), 0.0);
                    assert!((quick.found - slow.found).abs() <= 1e-6 * slow.found, "{quick:?} {slow:?}");
                    assert!(
                        quick.bound >= slow.found && quick.bound <= 1.07 * slow.found,
                        "{quick:?} {slow:?}"
                    );
                    let [left, right] = sides(&frame, &whole, (from, to)).expect("a cubic");
                    assert!((left.max(right) - slow.found).abs() <= 1e-6 * slow.found);
                }
            }
        }
    }

    #[test]
    fn at_the_limit_a_bound_is_the_limit() {
        let points = [(0.0, 0.0), (1.0, 1.1e-5), (2.0, 1.2e-5), (3.0, 0.0)].map(|(x, y)| vector(x, y));
        let whole = Piece::new(&points, &[1.0; 4]);
        let frame = Frame::of(&Arc { start: vector(0.0, 0.0), end: vector(3.0, 0.0), bulge: -1e-5 });
        let found = measure(&frame, &whole, (0.0, 1.0), 0.0).expect("it hardly turns").found;
        let limit = found * 1.0001;
        assert!(measure(&frame, &whole, (0.0, 1.0), limit).is_some_and(|d| d.bound <= limit));
    }

    #[test]
    fn what_turns_back_is_left_to_division() {
        let points = [vector(0.0, 0.0), vector(3.0, 0.1), vector(-2.0, 0.1), vector(1.0, 0.0)];
        let frame = Frame::of(&Arc { start: vector(0.0, 0.0), end: vector(1.0, 0.0), bulge: -0.05 });
        assert!(measure(&frame, &Piece::new(&points, &[1.0; 4]), (0.0, 1.0), 0.0).is_none());
    }
}
