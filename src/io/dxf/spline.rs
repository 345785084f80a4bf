//! B-splines, checked but not changed.

use super::placement::in_job;
use super::record::Numbers;
use super::shape::{Drawn, LARGEST, Shape, Skip, Stage, is_usable};
use crate::boundary::FreeShape;
use crate::geom::{Point, Spline, Vector, point};

/// Highest degree that is read; programs write 3, and 5 at times.
const MAX_DEGREE: f64 = 25.0;

const CLOSED: i64 = 1;

/// Splines are drawn in the coordinates of the world.
pub(super) fn spline(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let spline = Spline {
        degree: degree(numbers.or(71, 3.0))?,
        knots: numbers.all(40).collect(),
        control: places(numbers, 10, stage)?,
        weights: weights(numbers.all(41).collect()),
        fit: places(numbers, 11, stage)?,
        tangents: [tangent(numbers, 12, stage), tangent(numbers, 13, stage)],
        closed: numbers.flags(70) & CLOSED != 0,
    };
    add(spline, drawn)
}

/// The degree of a spline.
pub(super) fn degree(degree: f64) -> Result<usize, Skip> {
    if (1.0..=MAX_DEGREE).contains(&degree) && degree.fract() == 0.0 {
        Ok(degree as usize)
    } else {
        Err(Skip::Fault(format!("its degree is {degree}")))
    }
}

/// Equal weights are none.
pub(super) fn weights(weights: Vec<f64>) -> Vec<f64> {
    let equal = weights.iter().all(|w| *w == weights[0] && *w > 0.0);
    if equal { Vec::new() } else { weights }
}

fn places(numbers: Numbers, code: u16, stage: Stage) -> Result<Vec<Point>, Skip> {
    let seen = |p: [f64; 3]| {
        let [x, y, _] = stage.placement.point(p);
        in_job(point(x, y), stage.scale)
    };
    Ok(numbers.places(code)?.into_iter().map(seen).collect())
}

fn tangent(numbers: Numbers, code: u16, stage: Stage) -> Option<Vector> {
    let [x, y, _] = stage.placement.vector(numbers.place(code).ok()?);
    Some(in_job(point(x, y), stage.scale).to_vector()).filter(|v| v.x != 0.0 || v.y != 0.0)
}

/// Adds a spline if it is one.
pub(super) fn add(spline: Spline, drawn: &mut Drawn) -> Result<(), Skip> {
    check(&spline)?;
    drawn.shapes.push(Shape::Free(FreeShape::Spline(spline)));
    Ok(())
}

fn check(spline: &Spline) -> Result<(), Skip> {
    let places = if spline.control.is_empty() { &spline.fit } else { &spline.control };
    let Some(first) = places.first() else { return Skip::fault("it has no points") };
    if !places.iter().all(|p| p.is_finite()) {
        return Skip::fault("a number is not finite");
    }
    if !places.iter().all(|p| is_usable(*p)) {
        return Err(Skip::Fault(format!("it reaches beyond {LARGEST}, too far to calculate with")));
    }
    if places.iter().all(|p| p == first) {
        return Skip::fault("it has no length");
    }
    if spline.control.is_empty() { Ok(()) } else { check_knots(spline) }
}

fn check_knots(Spline { degree, knots, control, weights, .. }: &Spline) -> Result<(), Skip> {
    let needed = control.len() + degree + 1;
    if control.len() <= *degree {
        return Err(Skip::Fault(format!("it has {} control points for degree {degree}", control.len())));
    }
    if knots.len() != needed {
        return Err(Skip::Fault(format!("it has {} knots and needs {needed}", knots.len())));
    }
    if knots.windows(2).any(|pair| pair[0] > pair[1]) {
        return Skip::fault("its knots do not rise");
    }
    if knots[*degree] == knots[control.len()] {
        return Skip::fault("its knots are all equal");
    }
    if !weights.is_empty() && weights.len() != control.len() {
        return Err(Skip::Fault(format!("it has {} weights for {} points", weights.len(), control.len())));
    }
    match weights.iter().find(|w| **w <= 0.0) {
        Some(weight) => Err(Skip::Fault(format!("it has a weight of {weight}"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::placement::Placement;
    use super::super::record::Kind;
    use super::super::shape::tests::{drawn_by, fault_of};
    use super::*;
    use crate::geom::vector;

    fn numbers(degree: f64, knots: &[f64], weights: &[f64], control: &[(f64, f64)]) -> Vec<(u16, f64)> {
        let knots = knots.iter().map(|k| (40, *k));
        let weights = weights.iter().map(|w| (41, *w));
        let control = control.iter().flat_map(|p| [(10, p.0), (20, p.1), (30, 0.0)]);
        [(70, 8.0), (71, degree)].into_iter().chain(knots).chain(weights).chain(control).collect()
    }

    const KNOTS: [f64; 6] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    const POINTS: [(f64, f64); 3] = [(0.0, 0.0), (2.0, 4.0), (4.0, 0.0)];

    fn read(numbers: &[(u16, f64)], placement: &Placement) -> Spline {
        match &drawn_by(Kind::Spline, numbers, placement).unwrap().shapes[..] {
            [Shape::Free(FreeShape::Spline(spline))] => spline.clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_spline_comes_as_it_was_drawn() {
        let spline = read(&numbers(2.0, &KNOTS, &[1.0, 0.5, 1.0], &POINTS), &Placement::ROOT);
        assert_eq!(
            (spline.degree, &spline.knots[..], &spline.weights[..]),
            (2, &KNOTS[..], &[1.0, 0.5, 1.0][..])
        );
        assert_eq!(spline.control, POINTS.map(|(x, y)| point(x, y)));
        let plain = read(&numbers(2.0, &KNOTS, &[2.0; 3], &POINTS), &Placement::ROOT);
        assert!(plain.weights.is_empty());
    }

    #[test]
    fn a_spline_is_placed_by_its_points() {
        let placement = Placement::turned([-1.0, 2.0, 1.0], 90.0).moved([10.0, 0.0, 0.0]);
        let spline = read(&numbers(2.0, &KNOTS, &[], &POINTS), &placement);
        assert_eq!(spline.control, [(10.0, 0.0), (2.0, -2.0), (10.0, -4.0)].map(|(x, y)| point(x, y)));
        let fit = [(70, 1.0), (71, 3.0), (11, 0.0), (21, 0.0), (31, 0.0), (11, 1.0), (21, 2.0), (31, 0.0)];
        let tangent = [(12, 1.0), (22, 0.0), (32, 0.0)];
        let spline = read(&[&fit[..], &tangent].concat(), &placement);
        assert_eq!((spline.fit[1], spline.closed), (point(6.0, -1.0), true));
        assert_eq!(spline.tangents, [Some(vector(0.0, -1.0)), None]);
    }

    #[test]
    fn what_is_no_spline_is_refused() {
        let of = |degree, knots: &[f64], weights: &[f64], points: &[(f64, f64)]| {
            fault_of(Kind::Spline, &numbers(degree, knots, weights, points))
        };
        for degree in [0.0, 1000.0, 2.5] {
            assert!(of(degree, &KNOTS, &[], &POINTS).contains("degree"));
        }
        assert!(of(2.0, &[], &[], &POINTS).contains("0 knots and needs 6"));
        assert!(of(2.0, &[0.0, 0.0, 0.0, 1.0, 0.5, 0.5], &[], &POINTS).contains("rise"));
        assert!(of(2.0, &[1.0; 6], &[], &POINTS).contains("equal"));
        assert!(of(2.0, &KNOTS, &[0.0; 3], &POINTS).contains("weight of 0"));
        assert!(of(2.0, &KNOTS, &[1.0, -1.0, 1.0], &POINTS).contains("weight of -1"));
        assert!(of(2.0, &KNOTS, &[1.0, 2.0], &POINTS).contains("2 weights for 3 points"));
        assert!(of(2.0, &KNOTS, &[], &[(1.0, 1.0); 3]).contains("no length"));
        assert!(of(3.0, &KNOTS, &[], &POINTS).contains("3 control points"));
        assert!(of(2.0, &KNOTS, &[], &[]).contains("no points"));
    }
}
