//! Arcs against tolerance for five curves: `convergence [--fine]`.
//!
//! For each curve and each tolerance from 1e-3 to 1e-9 of its box: the arcs by the default scheme and
//! by S0's (osculating arcs, halving), the asymptotic minimum of any arcs, `W / (192 eps)^(1/3)` with
//! `W` the integral of the cube root of the derivative of the curvature by arc length, and the slope
//! of the arcs in the tolerance, which should be -1/3.

use medial::boundary::freeform::{EllipseArc, Fit, Nurbs, Scheme};
use medial::{Point, Vector, point, vector};
use std::f64::consts::TAU;
use std::time::Instant;

/// A curve that can be fitted.
type Fitted = Box<dyn Fn(Scheme, f64) -> Fit>;

fn main() {
    for (name, size, fit) in curves() {
        // The finest fit tells W: arcs of curvature k between neighbors, integrated.
        let integral = integral(&fit(Scheme::Tilted, 1e-10 * size));
        println!("{name}, size {size}, W = {integral:.4}");
        println!("   eps      arcs  slope  ratio   S0  slope   bound/found  leaves   arcs/s");
        let mut before: Option<[f64; 2]> = None;
        for exponent in 3..=9 {
            let eps = 10f64.powi(-exponent) * size;
            let ours = fit(Scheme::Fewest, eps);
            let theirs = fit(Scheme::Bisection, eps);
            let least = integral / (192.0 * eps).cbrt();
            let counts = [ours.path.len() as f64, theirs.path.len() as f64];
            let slopes = before.map(|b| [0, 1].map(|i| -(counts[i] / b[i]).log10())).unwrap_or([f64::NAN; 2]);
            println!(
                "  1e-{exponent} {:8} {:6.3} {:6.3} {:6} {:6.3} {:8.3} {:8} {:12.0}",
                counts[0],
                slopes[0],
                counts[0] / least,
                counts[1],
                slopes[1],
                ours.bound / ours.found,
                extrema(&ours),
                speed(&fit, eps)
            );
            before = Some(counts);
        }
    }
}

/// Output arcs per second, proof included.
fn speed(fit: &Fitted, eps: f64) -> f64 {
    let start = Instant::now();
    let (mut arcs, mut runs) = (0, 0);
    while runs < 3 || start.elapsed().as_secs_f64() < 0.1 {
        arcs += fit(Scheme::Fewest, eps).path.len();
        runs += 1;
    }
    arcs as f64 / start.elapsed().as_secs_f64()
}

/// Integral of the cube root of the derivative of the curvature, from a fine fit.
fn integral(fit: &Fit) -> f64 {
    let elements: Vec<_> = fit.path.elements().map(|e| (e.curvature(), e.length())).collect();
    let n = elements.len();
    (0..n)
        .map(|i| {
            let ((k, a), (l, b)) = (elements[i], elements[(i + 1) % n]);
            let h = 0.5 * (a + b);
            ((l - k).abs() / h).cbrt() * h
        })
        .sum()
}

/// Local extrema of the curvature, to round-off.
fn extrema(fit: &Fit) -> usize {
    let k: Vec<f64> = fit.path.elements().map(|e| e.curvature()).collect();
    let size = fit.path.bounds().diagonal();
    let mut signs: Vec<bool> = Vec::new();
    for i in 0..k.len() {
        let step = k[(i + 1) % k.len()] - k[i];
        let h =
            fit.path.element(i).chord().length().min(fit.path.element((i + 1) % k.len()).chord().length());
        if step.abs() > 64.0 * f64::EPSILON * size / (h * h) {
            signs.push(step > 0.0);
        }
    }
    (0..signs.len()).filter(|&i| signs[i] != signs[(i + 1) % signs.len()]).count()
}

fn curves() -> Vec<(&'static str, f64, Fitted)> {
    let ellipse = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.0, 0.0).expect("an ellipse");
    let splines = [
        ("closed B-spline with 18 lobes", lobes(18, 1.0, 0.72, |_| 1.0)),
        ("rational closed spline", lobes(5, 1.0, 0.5, |i| if i % 2 == 0 { 3.0 } else { 0.6 })),
        ("tree", tree()),
        ("snow-flake", snow_flake()),
    ];
    let size = vector(4.0, 2.0).length();
    let mut all: Vec<(&'static str, f64, Fitted)> = vec![(
        "ellipse 2:1",
        size,
        Box::new(move |scheme, eps| ellipse.to_arcs_by(scheme, eps).expect("a fit")),
    )];
    for (name, spline) in splines {
        let size = medial::Bounds::around(spline.points().iter().copied()).diagonal();
        all.push((name, size, Box::new(move |scheme, eps| spline.to_arcs_by(scheme, eps).expect("a fit"))));
    }
    all
}

/// A closed cubic with control points on two circles in turn.
fn lobes(count: usize, outer: f64, inner: f64, weight: impl Fn(usize) -> f64) -> Nurbs {
    let n = 2 * count;
    let place = |i: usize| {
        let r = if i % 2 == 0 { outer } else { inner };
        point(0.0, 0.0) + Vector::from_angle(TAU * i as f64 / n as f64) * (50.0 * r)
    };
    closed((0..n).map(place).collect(), (0..n).map(weight).collect())
}

fn closed(points: Vec<Point>, weights: Vec<f64>) -> Nurbs {
    let knots = (0..=points.len()).map(|i| i as f64).collect();
    Nurbs::new(3, knots, points, weights, true).expect("a spline")
}

/// A trunk with branches that become shorter to the top.
fn tree() -> Nurbs {
    let side = [
        (4.0, 0.0),
        (5.0, 8.0),
        (4.0, 16.0),
        (30.0, 10.0),
        (34.0, 16.0),
        (10.0, 24.0),
        (6.0, 32.0),
        (26.0, 30.0),
        (28.0, 36.0),
        (8.0, 44.0),
        (5.0, 50.0),
        (18.0, 50.0),
        (19.0, 56.0),
        (6.0, 62.0),
        (4.0, 70.0),
    ];
    let right = side.iter().map(|&(x, y)| point(x, y));
    let left = side.iter().rev().map(|&(x, y)| point(-x, y + 0.0));
    let points: Vec<Point> = right.chain([point(0.0, 84.0)]).chain(left).collect();
    let weights = vec![1.0; points.len()];
    closed(points, weights)
}

/// Six arms with side arms.
fn snow_flake() -> Nurbs {
    let arm = [
        (8.0, -0.45),
        (20.0, -0.10),
        (26.0, -0.40),
        (31.0, -0.30),
        (28.0, -0.08),
        (44.0, -0.08),
        (46.0, 0.08),
        (28.0, 0.08),
        (31.0, 0.30),
        (26.0, 0.40),
        (20.0, 0.10),
    ];
    let mut points = Vec::new();
    for i in 0..6 {
        let turn = TAU * f64::from(i) / 6.0;
        points.extend(arm.iter().map(|&(r, a)| point(0.0, 0.0) + Vector::from_angle(turn + a) * r));
    }
    let weights = vec![1.0; points.len()];
    closed(points, weights)
}
