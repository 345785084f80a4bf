//! What a piece looks like: straight, round, or with apices, inflections and cusps at parameters
//! that are found with certainty.
//!
//! **Method.** With homogeneous coordinates `(X, Y, w)`, sub-curves `A0, A1, ..` of lower degree that
//! share control points give the derivatives without a common factor: `a = A1x A0w - A0x A1w` is the
//! numerator of `x'`, `Q = det(A0, A1, A2)` that of `x'y'' - y'x''`. With `S = a^2 + b^2` the
//! curvature is `Q w^3 / S^(3/2)`, so inflections are roots of `Q`, cusps of `S`, and apices (where
//! the curvature is stationary) of `(Q'w + 3Qw')S - 3/2 QwS'`: of degree 5 for cubics, `4d - 7` for
//! polynomials and `8d - 12` for rational pieces of degree `d`.

use super::bernstein::{ANY, CUBIC, Poly};
use super::piece::Piece;
use super::roots::{Root, isolate};
use crate::geom::Vector;

/// Shape of a piece.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// Straight to round-off, perhaps turning back at some parameters.
    Straight { folds: Vec<f64> },
    /// The curvature is constant to round-off.
    Round,
    /// Curved.
    Curved(Features),
}

/// Parameters at which a curved piece is special, each list ascending.
#[derive(Clone, Debug, Default)]
pub(super) struct Features {
    /// Where the curvature has an extremum.
    pub apices: Vec<f64>,
    /// Where the curvature changes its sign.
    pub inflections: Vec<f64>,
    /// Where the curve stops and turns back.
    pub cusps: Vec<f64>,
    /// Sign of the derivative of the curvature after the start and before the end.
    pub slopes: [i8; 2],
}

/// Steps of Newton's method for the place of a cusp or a fold; it starts within the root of round-off.
const CUSP_STEPS: usize = 4;

/// Relative round-off of a weight: halves of an ulp, three for each of ten levels of knot insertion.
const WEIGHT_NOISE: f64 = 0.5 * f64::EPSILON * 32.0;

/// Finds the shape of a piece whose control points are known up to `noise`.
pub(super) fn shape(piece: &Piece, noise: f64) -> Shape {
    let far = piece.points().iter().map(|&p| p - piece.start());
    let far = far.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default();
    let along = far.unit();
    if piece.points().iter().all(|&p| (p - piece.start()).cross(along).abs() <= 2.0 * noise) {
        return Shape::Straight { folds: folds(piece, along, noise) };
    }
    match piece.degree() {
        ..=3 => curved(piece, &Numerators::<CUBIC>::of(piece, noise)),
        _ => curved(piece, &Numerators::<ANY>::of(piece, noise)),
    }
}

/// The shape of a piece that is not straight.
fn curved<const N: usize>(piece: &Piece, parts: &Numerators<N>) -> Shape {
    let Some(apices) = isolate(&parts.slope) else { return Shape::Round };
    let sign = |from: f64, to: f64| {
        let (value, error) = parts.slope.at(0.5 * (from + to));
        if value.abs() <= error { 0 } else { value.signum() as i8 }
    };
    let cusps = cusps(piece, &parts.speed);
    let apart = |r: &Root| !cusps.iter().any(|c| (c.at - r.at).abs() <= c.blur + r.blur);
    let apices: Vec<f64> = apices.iter().filter(|r| apart(r)).map(|r| r.at).collect();
    let mut stops: Vec<f64> = [0.0, 1.0].into_iter().chain(apices.iter().copied()).collect();
    stops.extend(cusps.iter().map(|c| c.at));
    stops.sort_by(f64::total_cmp);
    let signs: Vec<i8> = stops.windows(2).map(|w| sign(w[0], w[1])).collect();
    // A double root where the curvature goes on the same way is no extremum.
    let turns = |t: &f64| {
        let i = stops.partition_point(|s| s < t);
        signs[i - 1] * signs[i] <= 0
    };
    let inflections = isolate(&parts.bend).unwrap_or_default();
    Shape::Curved(Features {
        apices: apices.iter().copied().filter(turns).collect(),
        inflections: inflections.iter().filter(|r| apart(r)).map(|r| r.at).collect(),
        slopes: [signs[0], signs[signs.len() - 1]],
        cusps: cusps.iter().map(|c| c.at).collect(),
    })
}

/// Where a straight piece turns back by more than round-off.
fn folds(piece: &Piece, along: Vector, noise: f64) -> Vec<f64> {
    let mut ways = Vec::new();
    find_ways(piece, along, noise, (0.0, 1.0), &mut ways);
    let turns = ways.windows(2).filter(|w| w[0].rises != w[1].rises);
    turns.map(|w| stationary(piece, along, [w[0].from, 0.5 * (w[0].to + w[1].from), w[1].to])).collect()
}

/// Where a straight piece is farthest along, near the middle one of three parameters and between the others.
fn stationary(piece: &Piece, along: Vector, [from, near, to]: [f64; 3]) -> f64 {
    let mut t = near;
    for _ in 0..CUSP_STEPS {
        let jet = piece.jet(t);
        t -= jet.d1.dot(along) / jet.d2.dot(along);
    }
    if t > from && t < to { t } else { near }
}

/// Parameters between which a straight piece runs one way.
struct Way {
    from: f64,
    to: f64,
    rises: bool,
}

/// Appends the ways of a part of a straight piece: halves of halves run one way, or nowhere. Signs of control
/// points say so for certain whatever the weights are, which those of a derivative would not.
fn find_ways(part: &Piece, along: Vector, noise: f64, (from, to): (f64, f64), ways: &mut Vec<Way>) {
    let places = || part.points().iter().map(|p| p.dot(along));
    let (low, high) = places().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
    if high - low <= 4.0 * noise {
        return;
    }
    let steps = || part.points().windows(2).map(|w| (w[1] - w[0]).dot(along));
    let middle = 0.5 * (from + to);
    let (rises, falls) = (steps().all(|s| s >= -2.0 * noise), steps().all(|s| s <= 2.0 * noise));
    if rises || falls || middle <= from || middle >= to {
        ways.push(Way {
            from,
            to,
            rises: if rises == falls { part.end().dot(along) > part.start().dot(along) } else { rises },
        });
        return;
    }
    find_ways(&part.part(0.0, 0.5), along, noise, (from, middle), ways);
    find_ways(&part.part(0.5, 1.0), along, noise, (middle, to), ways);
}

/// Where the squared speed vanishes: it cannot be negative, so these are double roots.
fn cusps<const N: usize>(piece: &Piece, speed: &Poly<N>) -> Vec<Root> {
    let mut found = isolate(speed).unwrap_or_default();
    for root in &mut found {
        let mut t = root.at;
        for _ in 0..CUSP_STEPS {
            let jet = piece.jet(t);
            t -= jet.d1.dot(jet.d2) / (jet.d2.length_squared() + jet.d1.dot(jet.d3));
        }
        if (t - root.at).abs() <= 2.0 * root.blur {
            root.at = t;
        }
    }
    found
}

/// Sub-curve of `count` control points from `first`, as numerators and denominator.
fn sub_curve<const N: usize>(piece: &Piece, first: usize, count: usize, noise: f64) -> [Poly<N>; 3] {
    let range = first..first + count;
    let center = piece.points()[piece.degree() / 2];
    let weights = &piece.weights()[range.clone()];
    let points = || piece.points()[range.clone()].iter().zip(weights);
    let scaled = |c: f64, w: f64| (c * w, noise * w);
    [
        Poly::with_errors(points().map(|(p, &w)| scaled(p.x - center.x, w))),
        Poly::with_errors(points().map(|(p, &w)| scaled(p.y - center.y, w))),
        Poly::with_errors(
            weights.iter().map(|&w| (w, if piece.is_rational() { WEIGHT_NOISE * w } else { 0.0 })),
        ),
    ]
}

/// Numerators of the derivatives of both coordinates, up to a positive factor.
fn first_derivative<const N: usize>(piece: &Piece, noise: f64) -> [Poly<N>; 2] {
    let d = piece.degree();
    if !piece.is_rational() {
        let steps = |c: fn(&Vector) -> f64| {
            Poly::new(piece.points().windows(2).map(|w| c(&w[1]) - c(&w[0])), 2.0 * noise)
        };
        return [steps(|p| p.x), steps(|p| p.y)];
    }
    let [x0, y0, w0] = sub_curve(piece, 0, d, noise);
    let [x1, y1, w1] = sub_curve(piece, 1, d, noise);
    [minor(&x1, &w0, &x0, &w1), minor(&y1, &w0, &y0, &w1)]
}

/// `a b - c d`.
fn minor<const N: usize>(a: &Poly<N>, b: &Poly<N>, c: &Poly<N>, d: &Poly<N>) -> Poly<N> {
    a.times(b).combined(1.0, &c.times(d), -1.0)
}

/// Numerators of squared speed, curvature and derivative of the curvature, up to positive factors.
struct Numerators<const N: usize> {
    speed: Poly<N>,
    bend: Poly<N>,
    slope: Poly<N>,
}

impl<const N: usize> Numerators<N> {
    /// Of a piece that is not straight, so its degree is 2 at least.
    fn of(piece: &Piece, noise: f64) -> Numerators<N> {
        let [a, b] = first_derivative(piece, noise);
        let speed = a.times(&a).combined(1.0, &b.times(&b), 1.0);
        let bend = bend(piece, noise, [&a, &b]);
        let change = if piece.is_rational() {
            let [_, _, w] = sub_curve(piece, 0, piece.degree() + 1, noise);
            let with_w = bend.times(&w.derivative());
            let rising = match bend.degree() {
                0 => with_w.combined(3.0, &with_w, 0.0),
                _ => bend.derivative().times(&w).combined(1.0, &with_w, 3.0),
            };
            minor(&rising, &speed, &scaled(&bend.times(&w)), &speed.derivative())
        } else {
            let falling = scaled(&bend).times(&speed.derivative());
            match bend.degree() {
                0 => falling.combined(-1.0, &falling, 0.0),
                _ => bend.derivative().times(&speed).combined(1.0, &falling, -1.0),
            }
        };
        Numerators { speed, bend, slope: change }
    }
}

fn scaled<const N: usize>(p: &Poly<N>) -> Poly<N> {
    p.combined(1.5, p, 0.0)
}

/// Numerator of `x'y'' - y'x''`.
fn bend<const N: usize>(piece: &Piece, noise: f64, [a, b]: [&Poly<N>; 2]) -> Poly<N> {
    let d = piece.degree();
    if !piece.is_rational() {
        let part = |p: &Poly<N>, first: usize| {
            Poly::new(p.values()[first..first + d - 1].iter().copied(), 2.0 * noise)
        };
        return minor(&part(a, 0), &part(b, 1), &part(b, 0), &part(a, 1));
    }
    let [x0, y0, w0] = sub_curve(piece, 0, d - 1, noise);
    let [x1, y1, w1] = sub_curve(piece, 1, d - 1, noise);
    let [x2, y2, w2] = sub_curve(piece, 2, d - 1, noise);
    let first = x0.times(&minor(&y1, &w2, &w1, &y2));
    let second = y0.times(&minor(&x1, &w2, &w1, &x2));
    let third = w0.times(&minor(&x1, &y2, &y1, &x2));
    first.combined(1.0, &second, -1.0).combined(1.0, &third, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector;

    const NOISE: f64 = 1e-15;

    fn features(points: &[(f64, f64)], weights: &[f64]) -> Features {
        let points: Vec<Vector> = points.iter().map(|&(x, y)| vector(x, y)).collect();
        match shape(&Piece::new(&points, weights), NOISE) {
            Shape::Curved(features) => features,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_parabola_has_one_apex() {
        let f = features(&[(-1.0, 1.0), (0.5, -2.0), (2.0, 4.0)], &[1.0; 3]);
        assert!(f.apices.len() == 1 && (f.apices[0] - 1.0 / 3.0).abs() < 1e-14, "{f:?}");
        assert!(f.inflections.is_empty() && f.cusps.is_empty());
        assert_eq!(f.slopes, [1, -1]);
    }

    #[test]
    fn a_symmetric_cubic_bends_in_its_middle() {
        let f = features(&[(0.0, 0.0), (1.0, 1.0), (2.0, -1.0), (3.0, 0.0)], &[1.0; 4]);
        assert!(f.inflections.len() == 1 && (f.inflections[0] - 0.5).abs() < 1e-14);
        assert_eq!(f.apices.len(), 2, "{f:?}");
        assert!((f.apices[0] + f.apices[1] - 1.0).abs() < 1e-14);
    }

    #[test]
    fn apices_are_where_the_slope_changes_sign() {
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, -1.0), (4.0, 1.0), (5.0, 0.5)];
        for weights in [[1.0; 5], [1.0, 2.0, 0.5, 3.0, 1.5], [1e-6, 1.0, 1e6, 1.0, 0.1]] {
            let f = features(&points, &weights);
            let piece = Piece::new(&points.map(|(x, y)| vector(x, y)), &weights);
            let mut signs = Vec::new();
            for i in 1..20_000 {
                let slope = piece.jet(f64::from(i) / 20_000.0).curvature_slope();
                if signs.last() != Some(&slope.signum()) {
                    signs.push(slope.signum());
                }
            }
            // Sampling finds no more, and what it misses are pairs.
            assert!(signs.len() <= f.apices.len() + 1, "{weights:?} {f:?}");
            if weights[0] > 0.1 {
                assert_eq!(
                    (signs[0], signs[signs.len() - 1]),
                    (f64::from(f.slopes[0]), f64::from(f.slopes[1]))
                );
                assert_eq!(signs.len(), f.apices.len() + 1, "{weights:?} {f:?}");
            }
        }
    }

    #[test]
    fn a_quarter_of_an_ellipse_is_a_spiral() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let f = features(&[(2.0, 0.0), (2.0, 1.0), (0.0, 1.0)], &[1.0, half, 1.0]);
        assert!(f.apices.is_empty() && f.slopes == [-1, -1], "{f:?}");
        let circle = Piece::new(&[vector(1.0, 0.0), vector(1.0, 1.0), vector(0.0, 1.0)], &[1.0, half, 1.0]);
        assert!(matches!(shape(&circle, NOISE), Shape::Round));
    }

    #[test]
    fn a_cusp_is_found_where_it_is() {
        // (t^2, t^3) shifted to begin at t = -0.4.
        let cusp = |t: f64| vector(t * t, t * t * t);
        let (a, b) = (-0.4, 0.6);
        let polar = |t: f64, u: f64, v: f64| vector((t * u + u * v + v * t) / 3.0, t * u * v);
        let points = [cusp(a), polar(a, a, b), polar(a, b, b), cusp(b)];
        let Shape::Curved(f) = shape(&Piece::new(&points, &[1.0; 4]), NOISE) else { panic!() };
        assert!(f.cusps.len() == 1 && (f.cusps[0] - 0.4).abs() < 1e-9, "{f:?}");
        assert!(f.apices.len() <= 1, "{f:?}");
    }

    #[test]
    fn a_folded_line_turns_back() {
        let points = [(0.0, 0.0), (3.0, 3.0), (-1.0, -1.0), (2.0, 2.0)].map(|(x, y)| vector(x, y));
        let Shape::Straight { folds } = shape(&Piece::new(&points, &[1.0; 4]), NOISE) else { panic!() };
        assert_eq!(folds.len(), 2);
        let plain = [(0.0, 0.0), (1.0, 1.0), (1.0, 1.0), (2.0, 2.0)].map(|(x, y)| vector(x, y));
        assert!(
            matches!(shape(&Piece::new(&plain, &[1.0; 4]), NOISE), Shape::Straight { folds } if folds.is_empty())
        );
    }
}
