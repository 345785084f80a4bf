//! Free-form curves against dense sampling, and the same curves in other words.

#[path = "support/tree.rs"]
mod tree;

use medial::boundary::freeform::{CurveError, EllipseArc, Fit, Nurbs, Scheme};
use medial::{ArcSpline, Element, Point, Vector, point, vector};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::TAU;

/// Places of a spline by de Boor's algorithm, independent of Bezier pieces.
fn sampled(spline: &Nurbs, count: usize) -> Vec<Point> {
    let (d, knots) = (spline.degree(), spline.knots());
    let n = spline.points().len();
    let mut places = Vec::new();
    for i in d..n {
        if knots[i] == knots[i + 1] {
            continue;
        }
        for s in 0..=count {
            let u = (knots[i] + (knots[i + 1] - knots[i]) * s as f64 / count as f64).min(knots[i + 1]);
            let mut p: Vec<[f64; 3]> = (i - d..=i)
                .map(|j| {
                    let (q, w) = (spline.points()[j], spline.weights()[j]);
                    [q.x * w, q.y * w, w]
                })
                .collect();
            for level in 1..=d {
                for j in (level..=d).rev() {
                    let (low, high) = (knots[i - d + j], knots[i + 1 + j - level]);
                    let a = (u - low) / (high - low);
                    p[j] = [0, 1, 2].map(|c| (1.0 - a) * p[j - 1][c] + a * p[j][c]);
                }
            }
            places.push(point(p[d][0] / p[d][2], p[d][1] / p[d][2]));
        }
    }
    places
}

/// Largest distance of places to a path; places and path run the same way.
fn farthest(places: &[Point], path: &ArcSpline) -> f64 {
    let elements: Vec<Element> = path.elements().collect();
    let boxes: Vec<_> = elements.iter().map(Element::bounds).collect();
    let far = |p: &Point| {
        let mut best = f64::INFINITY;
        for (e, b) in elements.iter().zip(&boxes) {
            if b.nearest(*p).distance(*p) < best {
                best = best.min(e.distance(*p));
            }
        }
        best
    };
    places.iter().map(far).fold(0.0, f64::max)
}

/// Largest distance of places on a path to a chain of sampled places.
fn farthest_back(path: &ArcSpline, places: &[Point]) -> f64 {
    let chords = ArcSpline::open(places.iter().map(|p| (p.x, p.y, 0.0)));
    let on_path: Vec<Point> =
        path.elements().flat_map(|e| (0..8).map(move |i| e.point_at(f64::from(i) / 8.0))).collect();
    farthest(&on_path, &chords)
}

fn knots(multiplicities: &[usize]) -> Vec<f64> {
    multiplicities.iter().enumerate().flat_map(|(i, &m)| std::iter::repeat_n(i as f64, m)).collect()
}

fn uniform(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64).collect()
}

/// A closed cubic around a circle of control points.
fn star(count: usize, weight: f64) -> Nurbs {
    let place = |i: usize| {
        let r = if i.is_multiple_of(2) { 30.0 } else { 17.0 + 0.3 * i as f64 };
        point(5.0, -2.0) + Vector::from_angle(TAU * i as f64 / count as f64) * r
    };
    let weights = (0..count).map(|i| if i.is_multiple_of(3) { weight } else { 1.0 }).collect();
    Nurbs::new(3, uniform(count + 1), (0..count).map(place).collect(), weights, true).unwrap()
}

/// The wave of an open spline of any degree.
fn wave(degree: usize) -> Nurbs {
    let points: Vec<Point> = (0..12)
        .map(|i| point(3.0 * f64::from(i), if i % 4 < 2 { 4.0 } else { -3.0 + 0.2 * f64::from(i) }))
        .collect();
    let mut multiplicities = vec![1; 12 - degree + 1];
    let last = multiplicities.len() - 1;
    (multiplicities[0], multiplicities[last]) = (degree + 1, degree + 1);
    Nurbs::new(degree, knots(&multiplicities), points, vec![], false).unwrap()
}

/// Equal boundaries differ by so many roundings of their size at most, whatever the tolerance is: errors of arcs
/// near the tolerance say where arcs end, and so round-off of an error over that tolerance moves these ends. (2700 are
/// seen, at a tolerance of 1e-7 of the size, where the curve has moved or turned.)
const SAME_ROUNDINGS: f64 = 8192.0;

/// A distance that is round-off for a boundary.
fn round_off(path: &ArcSpline) -> f64 {
    SAME_ROUNDINGS * f64::EPSILON * path.bounds().diagonal()
}

/// Largest distance between two paths, both ways.
fn apart(a: &ArcSpline, b: &ArcSpline) -> f64 {
    let on = |path: &ArcSpline| -> Vec<Point> {
        path.elements().flat_map(|e| [e.start, e.point_at(0.3), e.midpoint(), e.point_at(0.8)]).collect()
    };
    farthest(&on(a), b).max(farthest(&on(b), a))
}

/// Changes between rising and falling curvature along a closed path.
fn extrema(path: &ArcSpline) -> usize {
    let k: Vec<f64> = path.elements().map(|e| e.curvature()).collect();
    let mut rises: Vec<bool> = Vec::new();
    for i in 0..k.len() {
        let step = k[(i + 1) % k.len()] - k[i];
        let c = path.element(i).chord().length().min(path.element((i + 1) % k.len()).chord().length());
        // Curvatures nearer than their round-off are one.
        if step.abs() > 64.0 * f64::EPSILON * 50.0 / (c * c) {
            rises.push(step > 0.0);
        }
    }
    (0..rises.len()).filter(|&i| rises[i] != rises[(i + 1) % rises.len()]).count()
}

#[test]
fn no_sample_is_farther_than_the_bound_and_the_bound_is_near() {
    let curves = [star(8, 1.0), star(9, 3.0), star(12, 0.2), wave(3), wave(2), wave(5), wave(10)];
    for (i, spline) in curves.iter().enumerate() {
        for tolerance in [1e-1, 1e-3, 1e-5] {
            for scheme in [Scheme::Fewest, Scheme::Plain, Scheme::Osculating, Scheme::Bisection] {
                let fit = spline.to_arcs_by(scheme, tolerance).unwrap();
                assert!(fit.bound <= tolerance);
                let places = sampled(spline, 400);
                let far = farthest(&places, &fit.path);
                assert!(far <= fit.bound, "{i} {scheme:?} {tolerance:e}: {far:e} > {:e}", fit.bound);
                assert!(
                    fit.bound <= 1.2 * far + 1e-11,
                    "{i} {scheme:?} {tolerance:e}: {far:e}, {:e}",
                    fit.bound
                );
            }
        }
        let fit = spline.to_arcs(1e-2).unwrap();
        assert!(farthest_back(&fit.path, &sampled(spline, 2000)) <= fit.bound + 1e-5);
    }
}

/// Where arcs over apices are as large as what is drawn, many have to yield, one after the other.
#[test]
fn curvature_has_as_many_extrema_as_a_tree_whose_twigs_are_near_the_tolerance() {
    let tree = tree::tree();
    for tolerance in [0.1, 0.03, 0.01, 0.003, 0.001] {
        let fit = tree.to_arcs(tolerance).unwrap();
        assert_eq!((extrema(&fit.path), fit.cuts.apices), (822, 822), "at {tolerance}");
        assert!(fit.bound <= tolerance);
    }
}

#[test]
fn curvature_has_as_many_extrema_as_the_curve_at_every_tolerance() {
    for spline in [star(8, 1.0), star(9, 3.0), star(12, 0.2)] {
        let counts: Vec<_> = [1e-1, 1e-2, 1e-3, 1e-4, 1e-6]
            .map(|tolerance| {
                let fit = spline.to_arcs(tolerance).unwrap();
                (extrema(&fit.path), fit.cuts.apices)
            })
            .into();
        assert!(counts.iter().all(|&(found, apices)| found == apices), "{counts:?}");
    }
}

#[test]
fn joints_of_the_curve_are_smooth_as_stored() {
    for offset in [0.0, 1e6] {
        let spline = star(8, 1.0).transformed(|p| point(p.x + offset, p.y - offset));
        let fit = spline.to_arcs(1e-3).unwrap();
        let n = fit.path.len();
        assert_eq!(fit.smooth, vec![true; n]);
        let magnitude = fit.path.bounds().magnitude();
        for i in 0..n {
            let (a, b) = (fit.path.element(i), fit.path.element((i + 1) % n));
            let turn = a.tangents().1.cross(b.tangents().0).abs();
            let chords = a.chord().length().recip() + b.chord().length().recip();
            assert!(turn <= 4.0 * f64::EPSILON * (1.0 + magnitude * chords), "{i}: {turn:e}");
        }
    }
}

#[test]
fn the_curve_run_backwards_has_the_same_boundary() {
    for spline in [star(9, 3.0), wave(3), wave(4)] {
        for tolerance in [1e-1, 1e-3] {
            let (a, b) = (spline.to_arcs(tolerance).unwrap(), spline.reversed().to_arcs(tolerance).unwrap());
            assert_eq!(a.path.len(), b.path.len());
            let far = apart(&a.path, &b.path);
            assert!(far < round_off(&a.path), "{tolerance:e}: {far:e}");
        }
    }
    let e = EllipseArc::new(point(1.0, 2.0), vector(5.0, 1.0), 0.3, 0.4, 4.0).unwrap();
    let (a, b) = (e.to_arcs(1e-3).unwrap(), e.reversed().to_arcs(1e-3).unwrap());
    assert!(apart(&a.path, &b.path) < round_off(&a.path));
}

/// The same curve with one more knot (Boehm's algorithm).
fn with_knot(spline: &Nurbs, u: f64) -> Nurbs {
    let (d, k) = (spline.degree(), spline.knots());
    let at = (d..spline.points().len()).rfind(|&i| k[i] <= u).unwrap();
    let homogeneous = |i: usize| {
        let (p, w) = (spline.points()[i], spline.weights()[i]);
        [p.x * w, p.y * w, w]
    };
    let mixed: Vec<[f64; 3]> = (0..=spline.points().len())
        .map(|i| {
            let a = if i + d <= at {
                1.0
            } else if i > at {
                0.0
            } else {
                (u - k[i]) / (k[i + d] - k[i])
            };
            let before = if i > 0 { homogeneous(i - 1) } else { [0.0; 3] };
            let here = if i < spline.points().len() { homogeneous(i) } else { [0.0; 3] };
            [0, 1, 2].map(|c| (1.0 - a) * before[c] + a * here[c])
        })
        .collect();
    let mut knots = k.to_vec();
    knots.insert(at + 1, u);
    let points = mixed.iter().map(|p| point(p[0] / p[2], p[1] / p[2])).collect();
    Nurbs::new(d, knots, points, mixed.iter().map(|p| p[2]).collect(), spline.is_closed()).unwrap()
}

#[test]
fn more_knots_make_the_same_boundary() {
    for spline in [star(9, 3.0), wave(3), wave(4)] {
        let middle = 0.5 * (spline.knots()[0] + spline.knots()[spline.knots().len() - 1]);
        let mut more = spline.clone();
        for u in [middle + 0.3, middle - 1.1, middle + 0.3, middle + 0.3] {
            more = with_knot(&more, u);
        }
        for tolerance in [1e-1, 1e-3] {
            let (a, b) = (spline.to_arcs(tolerance).unwrap(), more.to_arcs(tolerance).unwrap());
            assert_eq!((a.path.len(), a.cuts), (b.path.len(), b.cuts), "{tolerance:e}");
            let far = apart(&a.path, &b.path);
            assert!(far < round_off(&a.path), "{tolerance:e}: {far:e}");
        }
    }
}

#[test]
fn a_higher_degree_makes_the_same_boundary() {
    // One Bezier piece of degree 3, raised to degree 5.
    let cubic = [point(0.0, 0.0), point(3.0, 9.0), point(9.0, 7.0), point(10.0, -2.0)];
    let mut raised = cubic.to_vec();
    for d in [3.0, 4.0] {
        let n = raised.len();
        let middle = (1..n).map(|i| {
            let a = i as f64 / (d + 1.0);
            raised[i] + (raised[i - 1] - raised[i]) * a
        });
        let all: Vec<Point> = [raised[0]].into_iter().chain(middle).chain([raised[n - 1]]).collect();
        raised = all;
    }
    let low = Nurbs::new(3, knots(&[4, 4]), cubic.to_vec(), vec![], false).unwrap();
    let high = Nurbs::new(5, knots(&[6, 6]), raised, vec![7.0; 6], false).unwrap();
    for tolerance in [1e-2, 1e-4] {
        let (a, b) = (low.to_arcs(tolerance).unwrap(), high.to_arcs(tolerance).unwrap());
        assert_eq!((a.path.len(), a.cuts), (b.path.len(), b.cuts));
        let far = apart(&a.path, &b.path);
        assert!(far < round_off(&a.path), "{far:e}");
    }
}

#[test]
fn another_parameter_makes_the_same_boundary() {
    // A rational parameter: weights times powers of a factor.
    let points = vec![point(0.0, 0.0), point(3.0, 9.0), point(9.0, 7.0), point(10.0, -2.0)];
    let plain = Nurbs::new(3, knots(&[4, 4]), points.clone(), vec![], false).unwrap();
    let weights = (0..4).map(|i| 1.7f64.powi(i)).collect();
    let other = Nurbs::new(3, knots(&[4, 4]), points, weights, false).unwrap();
    for tolerance in [1e-2, 1e-4] {
        let (a, b) = (plain.to_arcs(tolerance).unwrap(), other.to_arcs(tolerance).unwrap());
        assert_eq!((a.path.len(), a.cuts), (b.path.len(), b.cuts));
        let far = apart(&a.path, &b.path);
        assert!(far < round_off(&a.path), "{far:e}");
    }
}

#[test]
fn similar_curves_have_similar_boundaries() {
    let spline = star(9, 3.0);
    let plain = spline.to_arcs(1e-3).unwrap();
    let (sin, cos) = 0.645f64.sin_cos();
    for (scale, mirror) in [(1.0, 1.0), (1.0, -1.0), (1e-3, 1.0), (1e3, -1.0)] {
        let map = |p: Point| {
            let v = vector(mirror * p.x, p.y).rotated(cos, sin) * scale;
            point(v.x + 3.0 * scale, v.y)
        };
        let mapped = spline.transformed(map).to_arcs(1e-3 * scale).unwrap();
        let expected = plain.path.mapped(mirror < 0.0, map);
        assert_eq!(mapped.path.len(), expected.len());
        let far = apart(&mapped.path, &expected);
        assert!(far < round_off(&expected), "{far:e}");
    }
}

#[test]
fn what_is_a_circle_or_a_line_stays_one() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let corners = [
        (1.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (-1.0, 1.0),
        (-1.0, 0.0),
        (-1.0, -1.0),
        (0.0, -1.0),
        (1.0, -1.0),
        (1.0, 0.0),
    ];
    let points: Vec<Point> = corners.iter().map(|&(x, y)| point(70.0 + 3.0 * x, 3.0 * y)).collect();
    let weights: Vec<f64> = (0..9).map(|i| if i % 2 == 0 { 1.0 } else { half }).collect();
    let circle =
        Nurbs::new(2, knots(&[3, 2, 2, 2, 3]), points, weights, true).unwrap().to_arcs(1e-3).unwrap();
    assert_eq!(circle.path.len(), 2);
    assert!(circle.path.closed && (circle.path.area() - 9.0 * std::f64::consts::PI).abs() < 1e-12);
    assert!(circle.bound < 1e-11);
    let round =
        EllipseArc::new(point(3.0, 4.0), vector(0.0, 2.0), 1.0, 0.0, 3.0).unwrap().to_arcs(1e-3).unwrap();
    assert_eq!(round.path.len(), 1);
    let line: Vec<Point> = (0..6).map(|i| point(f64::from(i * i), 2.0 * f64::from(i * i) + 1.0)).collect();
    let line = Nurbs::new(3, knots(&[4, 1, 1, 4]), line, vec![], false).unwrap().to_arcs(1e-3).unwrap();
    assert_eq!(line.path.len(), 1);
    assert!(line.path.element(0).is_segment());
    // Of degree 1 it is a polyline, with corners.
    let chain = vec![point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)];
    let chain = Nurbs::new(1, knots(&[2, 1, 2]), chain, vec![], false).unwrap().to_arcs(1e-3).unwrap();
    assert_eq!((chain.path.len(), chain.cuts.corners), (2, 1));
    assert_eq!(chain.smooth, [false, false, false]);
}

#[test]
fn degenerate_splines_are_what_they_are() {
    let fit = |d: usize, m: &[usize], p: &[(f64, f64)]| -> Fit {
        let points = p.iter().map(|&(x, y)| point(x, y)).collect();
        Nurbs::new(d, knots(m), points, vec![], false).unwrap().to_arcs(1e-3).unwrap()
    };
    // A place.
    assert!(fit(3, &[4, 4], &[(1.0, 1.0); 4]).path.is_empty());
    // Ends with repeated control points, where the curvature is infinite.
    let end = fit(3, &[4, 4], &[(0.0, 0.0), (0.0, 0.0), (5.0, 0.0), (5.0, 5.0)]);
    assert!(end.bound <= 1e-3 && end.path.len() > 2);
    // A triple point is a corner.
    let corner = fit(
        3,
        &[4, 1, 1, 1, 4],
        &[(0.0, 0.0), (2.0, 1.0), (4.0, 0.0), (4.0, 0.0), (4.0, 0.0), (5.0, 3.0), (3.0, 6.0)],
    );
    assert_eq!(corner.cuts.corners + corner.cuts.cusps, 1, "{:?}", corner.cuts);
    // A cusp.
    let cusp = fit(3, &[4, 4], &[(0.0, 0.0), (4.0, 4.0), (0.0, 4.0), (4.0, 0.0)]);
    assert_eq!(cusp.cuts.cusps, 1, "{:?}", cusp.cuts);
    assert!(cusp.bound <= 1e-3);
    // A fold of a line.
    let fold = fit(2, &[3, 3], &[(0.0, 0.0), (4.0, 0.0), (1.0, 0.0)]);
    assert_eq!(fold.path.len(), 2);
}

#[test]
fn a_tolerance_below_round_off_is_refused() {
    let far = star(8, 1.0).transformed(|p| point(p.x + 1e9, p.y));
    assert!(matches!(far.to_arcs(1e-9), Err(CurveError::TooFine { .. })));
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert!(matches!(star(8, 1.0).to_arcs(tolerance), Err(CurveError::Tolerance { .. })));
    }
}

/// Coordinates that love to coincide.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![(-4i32..=4).prop_map(f64::from), -10.0..10.0f64]
}

fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1.0), (-6.0..6.0f64).prop_map(|e| 10f64.powf(e))]
}

prop_compose! {
    /// Any spline: repeated points and knots, wild weights.
    fn any_spline()(degree in 1usize..=6, count in 0usize..8)
        (steps in prop::collection::vec(prop_oneof![Just(0.0), Just(1.0), 0.01..2.0f64], 2 * degree + 1 + count),
         points in prop::collection::vec((coordinate(), coordinate()), degree + 1 + count),
         weights in prop::collection::vec(weight(), degree + 1 + count),
         rational in any::<bool>(), closed in any::<bool>(), degree in Just(degree))
        -> Result<Nurbs, CurveError>
    {
        let knots = std::iter::once(0.0).chain(steps.iter().scan(0.0, |u, s| { *u += s; Some(*u) })).collect();
        let points = points.into_iter().map(|(x, y)| point(x, y)).collect();
        Nurbs::new(degree, knots, points, if rational { weights } else { vec![] }, closed)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn any_spline_is_within_its_bound_or_refused(spline in any_spline()) {
        let Ok(spline) = spline else { return Ok(()) };
        match spline.to_arcs(1e-3) {
            Ok(fit) => {
                prop_assert!(fit.bound <= 1e-3);
                prop_assert_eq!(fit.smooth.len(), fit.path.vertices.len());
                if !fit.path.is_empty() {
                    let far = farthest(&sampled(&spline, 100), &fit.path);
                    prop_assert!(far <= fit.bound + 1e-12, "{:e} > {:e}", far, fit.bound);
                }
            }
            Err(e) => prop_assert!(matches!(e, CurveError::Jump { .. }), "{e}"),
        }
    }

    #[test]
    fn places_are_met_by_the_curve_through_them(
        places in prop::collection::vec((coordinate(), coordinate()), 0..12), closed in any::<bool>()
    ) {
        let places: Vec<Point> = places.into_iter().map(|(x, y)| point(x, y)).collect();
        let Ok(spline) = Nurbs::through(&places, [None, None], closed) else { return Ok(()) };
        let fit = spline.to_arcs(1e-3).unwrap();
        prop_assert!(fit.bound <= 1e-3 && farthest(&places, &fit.path) <= 1e-3);
    }
}

#[test]
fn bounds_of_ellipses_are_near() {
    for ratio in [0.9, 0.5, 0.05] {
        for (start, end) in [(0.0, 0.0), (0.4, 4.0)] {
            let e = EllipseArc::new(point(1.0, 2.0), vector(20.0, 10.0), ratio, start, end).unwrap();
            for tolerance in [1e-1, 1e-3, 1e-5] {
                let fit = e.to_arcs(tolerance).unwrap();
                let (from, to) = e.range();
                let places: Vec<Point> =
                    (0..=8000).map(|i| e.at(from + (to - from) * f64::from(i) / 8000.0)).collect();
                let far = farthest(&places, &fit.path);
                assert!(far <= fit.bound && fit.bound <= tolerance, "{ratio} {tolerance:e}: {far:e}");
                assert!(fit.bound <= 1.2 * far + 1e-12, "{ratio} {tolerance:e}: {far:e}, {:e}", fit.bound);
                assert!(farthest_back(&fit.path, &places) <= fit.bound + 1e-4);
            }
        }
    }
}

#[test]
fn a_bound_made_tight_stays_within_the_tolerance() {
    let points = [(4.0, 1.0), (2.0, 3.0), (0.0, 1.0), (0.0, -8.424), (0.0, 0.0)].map(|(x, y)| point(x, y));
    let knots = vec![0.0, 0.0, 1.065, 2.065, 3.065, 3.065, 4.065, 4.065, 4.065];
    let spline = Nurbs::new(3, knots, points.to_vec(), vec![], false).unwrap();
    for i in 0..400 {
        let tolerance = 1e-3 * 0.99f64.powi(i);
        let fit = spline.to_arcs(tolerance).unwrap();
        assert!(fit.bound <= tolerance, "{:e} > {tolerance:e}", fit.bound);
    }
}

#[test]
fn arcs_over_apices_do_not_pass_them() {
    // Weights by chance put apices so near to each other that an arc over one would begin behind it.
    let points = [
        (10.0, 0.0),
        (9.210_609_965_717_158, 3.894_183_433_947_347),
        (6.967_067_140_419_26, 7.173_560_957_334_294),
        (3.623_577_566_116_644_3, 9.320_390_914_587_47),
        (-0.291_995_225_706_561_17, 9.995_736_122_626_301),
        (-4.161_468_392_838_42, 9.092_974_328_054_794),
        (-7.373_937_188_823_580_5, 6.754_631_836_116_572),
        (-9.422_223_468_538_72, 3.349_881_523_549_327),
        (-9.982_947_845_316_025, -0.583_741_439_384_573_3),
    ];
    let weights = [0.922, 0.743, 1.487, 2.285, 2.24, 2.238, 1.391, 2.03, 1.619];
    let mut knots = vec![0.0; 6];
    knots.extend([0.001_486, 0.027_814, 0.812_16]);
    knots.extend([1.812_16; 5]);
    let points = points.iter().map(|&(x, y)| point(x, y)).collect();
    let spline = Nurbs::new(4, knots, points, weights.to_vec(), false).unwrap();
    for tolerance in [0.2, 0.1, 0.05, 0.03, 0.02, 0.014, 0.01, 0.005] {
        let fit = spline.to_arcs(tolerance).unwrap();
        let far = farthest(&sampled(&spline, 2000), &fit.path);
        assert!(far <= fit.bound && fit.bound <= tolerance, "{tolerance}: {far:e} > {:e}", fit.bound);
    }
}

prop_compose! {
    /// A closed cubic whose control points are at random distances around a center.
    fn any_ring()(radii in prop::collection::vec(8.0..30.0f64, 5..12), weight in 0.3..3.0f64) -> Nurbs {
        let count = radii.len();
        let place = |i: usize| point(5.0, -2.0) + Vector::from_angle(TAU * i as f64 / count as f64) * radii[i];
        let weights = (0..count).map(|i| if i == 2 { weight } else { 1.0 }).collect();
        Nurbs::new(3, uniform(count + 1), (0..count).map(place).collect(), weights, true).unwrap()
    }
}

proptest! {
    // The same cases every time: where two numbers of arcs are equally good to round-off, either may come
    // out.
    #![proptest_config(ProptestConfig { cases: 96, rng_seed: RngSeed::Fixed(5), ..ProptestConfig::default() })]

    #[test]
    fn any_ring_has_the_same_boundary_in_other_words(
        ring in any_ring(), tolerance in prop_oneof![Just(1e-1), Just(1e-3), Just(1e-5)],
        turn in 0.0..TAU, scale in prop_oneof![Just(1.0), 1e-3..1e3f64], mirror in any::<bool>(), at in 0.1..0.9f64
    ) {
        let fit = ring.to_arcs(tolerance).unwrap();
        let range = (ring.knots()[3], ring.knots()[ring.knots().len() - 4]);
        let knot = with_knot(&ring, range.0 + (range.1 - range.0) * at);
        for (other, how) in [(ring.reversed(), "backwards"), (knot, "with a knot")] {
            let other = other.to_arcs(tolerance).unwrap();
            prop_assert_eq!(fit.path.len(), other.path.len());
            let far = apart(&fit.path, &other.path);
            prop_assert!(far < round_off(&fit.path), "{how}: {far:e} at {tolerance:e}");
        }
        let map = |p: Point| {
            let v = vector(if mirror { -p.x } else { p.x }, p.y).rotated(turn.cos(), turn.sin()) * scale;
            point(v.x + 3.0 * scale, v.y)
        };
        let mapped = ring.transformed(map).to_arcs(tolerance * scale).unwrap();
        prop_assert_eq!(fit.path.len(), mapped.path.len());
        let far = apart(&fit.path.mapped(mirror, map), &mapped.path);
        prop_assert!(far < round_off(&mapped.path), "{far:e} at {tolerance:e}");
        prop_assert_eq!(extrema(&fit.path), fit.cuts.apices);
        let far = farthest(&sampled(&ring, 400), &fit.path);
        prop_assert!(far <= fit.bound && fit.bound <= 1.2 * far + 1e-11, "{far:e}, {:e}", fit.bound);
    }

    #[test]
    fn arcs_for_chords_are_within_their_tolerance(
        ring in any_ring(), count in 4usize..60, tolerance in prop_oneof![Just(1e-1), Just(1e-2), Just(1e-3)]
    ) {
        let mut places = sampled(&ring, count);
        places.dedup();
        places.pop();
        let drawn = ArcSpline::closed(places.iter().map(|p| (p.x, p.y, 0.0)));
        if let Some(arcs) = drawn.with_arcs_for_chords(tolerance) {
            prop_assert!(arcs.len() < drawn.len());
            let far = apart(&drawn, &arcs);
            prop_assert!(far <= tolerance, "{far:e}");
        }
    }
}

#[test]
fn the_axis_has_a_leaf_for_each_sharpest_place_and_no_other() {
    // Leaves of the axis are at convex maxima of the curvature: two of an ellipse, and those of a star.
    let ellipse = EllipseArc::new(point(1.0, 2.0), vector(20.0, 10.0), 0.4, 0.0, 0.0).unwrap();
    for offset in [0.0, 1e5] {
        let moved = |p: Point| point(p.x + offset, p.y);
        for tolerance in [1e-1, 1e-3, 1e-5] {
            for (path, leaves) in [
                (ellipse.transformed(moved).to_arcs(tolerance).unwrap().path, 2),
                (star(8, 1.0).transformed(moved).to_arcs(tolerance).unwrap().path, 4),
            ] {
                let pocket = medial::Pocket::from_loops(vec![path], medial::Tolerance::MM).unwrap();
                let mat = pocket.medial_axis().unwrap();
                let found = mat.vertices().iter().filter(|v| v.kind == medial::Kind::Leaf).count();
                assert_eq!(found, leaves, "tolerance {tolerance:e}, moved by {offset}");
            }
        }
    }
}
