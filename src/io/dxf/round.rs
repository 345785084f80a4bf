//! Lines, circles, arcs and ellipses.

use super::placement::{Plane, Roundness, cross, direction, in_job};
use super::record::Numbers;
use super::shape::{Drawn, Skip, Stage, is_usable, normal};
use crate::geom::{Ellipse, Point, Vector, Vertex, point, vector};
use std::f64::consts::TAU;

/// Parameters of a whole ellipse, written with 15 digits, differ by a whole turn less this part.
const WRITTEN: f64 = 64.0 * f64::EPSILON;

/// A whole turn written with six digits or more, as 6.28319, exceeds one by this part at most. Nobody
/// draws the rest of it, an arc of a millionth of a turn.
const WRITTEN_SHORT: f64 = 1e-6;

/// Lines are drawn in the coordinates of the world, whatever their extrusion direction is.
pub(super) fn line(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let ends = [numbers.place(10)?, numbers.place(11)?];
    let vertex = |p: [f64; 3]| {
        let [x, y, _] = stage.placement.point(p);
        Vertex { point: in_job(point(x, y), stage.scale), bulge: 0.0 }
    };
    drawn.flat_path(ends.map(vertex).to_vec(), false)
}

pub(super) fn circle(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let (center, radius) = center_and_radius(numbers)?;
    let plane = stage.plane(numbers, numbers.or(30, 0.0))?;
    round(center, radius, Sweep::FULL, &plane, drawn)
}

pub(super) fn arc(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let (center, radius) = center_and_radius(numbers)?;
    let sweep = Sweep::new(numbers.need(50)?, numbers.need(51)?, 360.0)?;
    let plane = stage.plane(numbers, numbers.or(30, 0.0))?;
    round(center, radius, sweep, &plane, drawn)
}

fn center_and_radius(numbers: Numbers) -> Result<(Point, f64), Skip> {
    let [x, y, _] = numbers.place(10)?;
    let radius = numbers.need(40)?;
    if radius <= 0.0 {
        return Err(Skip::Fault(format!("its radius is {radius}")));
    }
    Ok((point(x, y), radius))
}

/// What an arc covers, counter-clockwise, in degrees or radians. The end is kept beside the turn,
/// so that what ends and what begins at an angle meet to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sweep {
    pub start: f64,
    pub end: f64,
    pub turn: f64,
}

impl Sweep {
    /// A circle, in degrees.
    const FULL: Sweep = Sweep { start: 0.0, end: 0.0, turn: 360.0 };

    /// From one angle to another, where `full` is a whole turn. Angles may be written in any turn.
    pub fn new(start: f64, end: f64, full: f64) -> Result<Sweep, Skip> {
        if start == end {
            return Skip::fault("it begins and ends at the same angle");
        }
        let is_whole = (full..=full * (1.0 + WRITTEN_SHORT)).contains(&(end - start));
        let (start, end) = (start.rem_euclid(full), end.rem_euclid(full));
        if is_whole {
            return Ok(Sweep { start, end: start, turn: full });
        }
        // The larger angle goes first, so that equal angles leave a full turn.
        let turn = if start < end { end - start } else { full - (start - end) };
        let turn = if full - turn <= WRITTEN * full { full } else { turn };
        Ok(Sweep { start, end, turn })
    }

    /// The same in degrees, of an angle in radians.
    fn to_degrees(self) -> Sweep {
        let turn = if self.turn == TAU { 360.0 } else { self.turn.to_degrees() };
        Sweep { start: self.start.to_degrees(), end: self.end.to_degrees(), turn }
    }
}

/// Adds an arc in a plane; its sweep is in degrees.
pub(super) fn round(
    center: Point,
    radius: f64,
    sweep: Sweep,
    plane: &Plane,
    drawn: &mut Drawn,
) -> Result<(), Skip> {
    drawn.tilted |= plane.is_tilted();
    let (middle, a) = (plane.point(center), plane.vector(vector(radius, 0.0)));
    if plane.roundness() == Roundness::Lost {
        let b = plane.vector(vector(0.0, radius));
        let (start, turn) = (sweep.start.to_radians(), sweep.turn.to_radians());
        return drawn.ellipse(Ellipse::from_conjugate(middle, a, b, start, turn));
    }
    if !is_usable(middle) {
        return Skip::fault("it is too large to calculate with");
    }
    if is_lost_beside(a.length(), middle) {
        return Skip::fault("its radius is smaller than the last digit of its center");
    }
    let (vertices, closed) = arc_vertices(|unit| center + unit * radius, sweep);
    drawn.path(vertices, closed, plane)
}

/// Whether a length vanishes when it is added to a place.
fn is_lost_beside(length: f64, p: Point) -> bool {
    p.x + length == p.x || p.y + length == p.y
}

/// The vertices of an arc and whether it is closed; `at` places unit vectors, the sweep is in
/// degrees.
fn arc_vertices(at: impl Fn(Vector) -> Point, Sweep { start, end, turn }: Sweep) -> (Vec<Vertex>, bool) {
    let vertex = |angle: f64, bulge: f64| Vertex { point: at(direction(angle)), bulge };
    let half = 0.5 * turn;
    if turn == 360.0 {
        return (vec![vertex(start, 1.0), Vertex { point: at(-direction(start)), bulge: 1.0 }], true);
    }
    let vertices = if turn <= 180.0 {
        vec![vertex(start, bulge(turn)), vertex(end, 0.0)]
    } else {
        vec![vertex(start, bulge(half)), vertex(start + half, bulge(half)), vertex(end, 0.0)]
    };
    (vertices, false)
}

/// Bulge of an arc over an angle in degrees, up to a half turn, which is exact.
fn bulge(degrees: f64) -> f64 {
    if degrees == 180.0 { 1.0 } else { (0.25 * degrees).to_radians().tan() }
}

/// Ellipses are drawn in the coordinates of the world; their extrusion direction tells which way
/// they run.
pub(super) fn ellipse(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let center = numbers.place(10)?;
    let major = numbers.place(11)?;
    let ratio = numbers.need(40)?;
    let sweep = Sweep::new(numbers.or(41, 0.0), numbers.or(42, TAU), TAU)?;
    elliptic(center, [major, minor(major, normal(numbers), ratio)?], sweep, stage, drawn)
}

/// The minor axis that belongs to a major one.
fn minor(major: [f64; 3], normal: [f64; 3], ratio: f64) -> Result<[f64; 3], Skip> {
    let length = |v: [f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    if length(normal) == 0.0 {
        return Skip::fault("its extrusion direction has no length");
    }
    let unit = normal.map(|c| c / length(normal));
    Ok(cross(unit, major).map(|c| c * ratio.abs()))
}

/// Adds an elliptic arc of two axes in space, its sweep in radians; a circular one where the axes
/// are equal.
pub(super) fn elliptic(
    center: [f64; 3],
    axes: [[f64; 3]; 2],
    sweep: Sweep,
    stage: Stage,
    drawn: &mut Drawn,
) -> Result<(), Skip> {
    let seen = |v: [f64; 3]| in_job(point(v[0], v[1]), stage.scale);
    let center = seen(stage.placement.point(center));
    let in_space = axes.map(|axis| stage.placement.vector(axis));
    let [a, b] = in_space.map(|axis| seen(axis).to_vector());
    drawn.tilted |= in_space.iter().any(|axis| stage.placement.is_rising(*axis));
    let sign = match stage.placement.roundness_of(a, b) {
        Roundness::Lost => {
            return drawn.ellipse(Ellipse::from_conjugate(center, a, b, sweep.start, sweep.turn));
        }
        Roundness::Kept => 1.0,
        Roundness::Mirrored => -1.0,
    };
    let at = |unit: Vector| center + a * unit.x + b * unit.y;
    let (mut vertices, closed) = arc_vertices(at, sweep.to_degrees());
    vertices.iter_mut().for_each(|v| v.bulge *= sign);
    drawn.flat_path(vertices, closed)
}

#[cfg(test)]
mod tests {
    use super::super::placement::Placement;
    use super::super::record::Kind;
    use super::super::shape::Shape;
    use super::super::shape::tests::{drawn_by, fault_of, path_of};
    use super::*;
    use crate::boundary::FreeShape;
    use crate::geom::ArcSpline;
    use std::f64::consts::FRAC_PI_2;

    fn an_arc(radius: f64, start: f64, end: f64) -> [(u16, f64); 5] {
        [(10, 10.0), (20, 20.0), (40, radius), (50, start), (51, end)]
    }

    fn arc(radius: f64, start: f64, end: f64) -> ArcSpline {
        path_of(Kind::Arc, &an_arc(radius, start, end)).unwrap()
    }

    #[test]
    fn arcs_between_quarters_end_on_round_numbers() {
        let places = [(13.0, 20.0), (10.0, 23.0), (7.0, 20.0), (10.0, 17.0), (13.0, 20.0)];
        for quarter in 0..4_u8 {
            let start = 90.0 * f64::from(quarter);
            let spline = arc(3.0, start, start + 90.0);
            let ends = spline.vertices.iter().map(|v| (v.point.x, v.point.y)).collect::<Vec<_>>();
            assert_eq!(ends, places[usize::from(quarter)..][..2]);
            assert!((spline.element(0).sweep().to_degrees() - 90.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_half_circle_has_bulge_one() {
        assert_eq!(arc(3.0, 270.0, 90.0), ArcSpline::open([(10.0, 17.0, 1.0), (10.0, 23.0, 0.0)]));
    }

    #[test]
    fn an_arc_beyond_a_half_circle_is_two_elements() {
        let spline = arc(3.0, 30.0, 300.0);
        assert_eq!(spline.len(), 2);
        assert!((spline.length() - 1.5 * std::f64::consts::PI * 3.0).abs() < 1e-13);
        let (center, radius) = spline.element(1).center().unwrap();
        assert!(center.distance(point(10.0, 20.0)) < 1e-13 && (radius - 3.0).abs() < 1e-13);
    }

    #[test]
    fn angles_may_be_written_in_any_turn() {
        let wanted = arc(3.0, 350.0, 20.0);
        for (start, end) in [(-10.0, 20.0), (350.0, 380.0), (710.0, -340.0)] {
            assert_eq!(arc(3.0, start, end), wanted);
        }
        assert_eq!(arc(3.0, 1e9, 1e9 + 90.0).len(), 1);
    }

    #[test]
    fn an_arc_of_a_full_turn_is_a_circle() {
        assert_eq!(arc(3.0, 0.0, 360.0), ArcSpline::circle(point(10.0, 20.0), 3.0));
        let full = arc(3.0, 33.0, 393.0);
        assert!(full.closed && (full.area() - 9.0 * std::f64::consts::PI).abs() < 1e-12);
        assert!(fault_of(Kind::Arc, &an_arc(3.0, 33.0, 33.0)).contains("same angle"));
        assert!(arc(3.0, 0.0, 360.0001).closed && !arc(3.0, 0.0, 361.0).closed);
    }

    #[test]
    fn what_has_no_size_is_refused() {
        for radius in [0.0, -5.0] {
            assert_eq!(fault_of(Kind::Arc, &an_arc(radius, 0.0, 90.0)), format!("its radius is {radius}"));
        }
        assert!(fault_of(Kind::Arc, &an_arc(1e15, 0.0, 90.0)).contains("large"));
        assert!(fault_of(Kind::Circle, &[(10, 1e300), (20, 0.0), (40, 1.0)]).contains("large"));
        assert!(fault_of(Kind::Circle, &[(10, 1e9), (20, 0.0), (40, 1e-9)]).contains("last digit"));
        assert_eq!(fault_of(Kind::Circle, &[(10, 0.0), (20, 0.0)]), "group 40 is missing");
        assert!(fault_of(Kind::Line, &[(10, 1.0), (20, 1.0), (11, 1.0), (21, 1.0)]).contains("no length"));
    }

    #[test]
    fn a_mirrored_arc_meets_what_is_drawn_in_the_world() {
        let numbers = [(10, 5.0), (20, 5.0), (40, 2.0), (50, 0.0), (51, 90.0), (230, -1.0)];
        let mirrored = path_of(Kind::Arc, &numbers).unwrap();
        let quarter = (std::f64::consts::PI / 8.0).tan();
        assert_eq!(mirrored, ArcSpline::open([(-7.0, 5.0, -quarter), (-5.0, 7.0, 0.0)]));
    }

    fn an_ellipse(major: (f64, f64), ratio: f64, start: f64, end: f64) -> Vec<(u16, f64)> {
        vec![(10, 1.0), (20, 2.0), (11, major.0), (21, major.1), (40, ratio), (41, start), (42, end)]
    }

    fn free(numbers: &[(u16, f64)]) -> Ellipse {
        match &drawn_by(Kind::Ellipse, numbers, &Placement::ROOT).unwrap().shapes[..] {
            [Shape::Free(FreeShape::Ellipse(e))] => *e,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn an_ellipse_with_equal_axes_is_a_circle_or_an_arc() {
        let full = path_of(Kind::Ellipse, &an_ellipse((3.0, 0.0), 1.0, 0.0, TAU)).unwrap();
        assert_eq!(full, ArcSpline::circle(point(1.0, 2.0), 3.0));
        let quarter = path_of(Kind::Ellipse, &an_ellipse((0.0, 3.0), 1.0, 0.0, FRAC_PI_2)).unwrap();
        let bulge = (std::f64::consts::PI / 8.0).tan();
        assert_eq!(quarter, ArcSpline::open([(1.0, 5.0, bulge), (-2.0, 2.0, 0.0)]));
    }

    #[test]
    fn an_ellipse_comes_as_it_was_drawn() {
        let e = free(&an_ellipse((4.0, 3.0), 0.5, 0.5, 7.0));
        assert_eq!((e.center, e.major, e.ratio, e.start), (point(1.0, 2.0), vector(4.0, 3.0), 0.5, 0.5));
        assert!((e.sweep - (6.5 - TAU)).abs() < 1e-14);
        assert!(free(&an_ellipse((4.0, 0.0), 0.5, 0.0, TAU * (1.0 - 8.0 * f64::EPSILON))).is_full());
        for written in ["6.28319", "6.28318531", "6.28318530718"] {
            let end = written.parse().unwrap();
            assert!(free(&an_ellipse((4.0, 0.0), 0.5, 0.0, end)).is_full(), "{written}");
        }
        // Seen from below it runs the other way.
        let mut below = an_ellipse((4.0, 0.0), 0.5, 0.0, FRAC_PI_2);
        below.push((230, -1.0));
        let e = free(&below);
        assert!(
            e.ends()[0].distance(point(1.0, 0.0)) < 1e-14 && e.ends()[1].distance(point(5.0, 2.0)) < 1e-14
        );
        // A minor axis longer than the major one takes its place.
        let e = free(&an_ellipse((1.0, 0.0), 2.0, 0.0, TAU));
        assert_eq!((e.major, e.ratio), (vector(0.0, 2.0), 0.5));
    }

    #[test]
    fn ellipses_as_flat_as_a_line_are_refused() {
        for ratio in [0.0, 1e-12] {
            assert!(fault_of(Kind::Ellipse, &an_ellipse((4.0, 3.0), ratio, 0.0, TAU)).contains("flat"));
        }
        assert!(fault_of(Kind::Ellipse, &an_ellipse((0.0, 0.0), 0.5, 0.0, TAU)).contains("no length"));
    }

    #[test]
    fn a_tilted_circle_is_an_ellipse() {
        let numbers = [(10, 0.0), (20, 0.0), (40, 2.0), (220, -(0.75_f64.sqrt())), (230, 0.5)];
        let drawn = drawn_by(Kind::Circle, &numbers, &Placement::ROOT).unwrap();
        let [Shape::Free(FreeShape::Ellipse(e))] = &drawn.shapes[..] else { panic!("{drawn:?}") };
        assert!(drawn.tilted && (e.ratio - 0.5).abs() < 1e-15 && e.is_full());
    }
}
