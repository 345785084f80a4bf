//! Entities as arc splines in job units.
//!
//! **Guarantees** that what comes out is finite and has a length, and that round numbers stay
//! exact: an arc from 0 to 90 degrees ends where a line does that is drawn to the same place.
//! **Does not** read what lies in a mirrored or tilted coordinate system: a place in it is not
//! where it seems to be.

use crate::geom::{ArcSpline, Point, Vector, Vertex, point, vector};
use crate::io::Scale;
use ::dxf::entities::{Arc, Circle, EntityType, Line, LwPolyline, Polyline};

/// Largest coordinate and radius, in job units. Beyond it doubles are more than 0.0001 apart, and
/// nothing on a machine is a million kilometers long.
const LARGEST: f64 = 1e12;

/// Tilt of an extrusion direction that is round-off of its three numbers: one rounding each when
/// it was made a unit vector, and one when it was written.
const TILT: f64 = 4.0 * f64::EPSILON;

/// Why an entity gives no curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Skip {
    /// Its kind is not read.
    NotRead(&'static str),
    /// What is wrong with it, and a place of it where one is known.
    Fault(String, Option<Point>),
}

/// The curve that an entity draws.
pub(super) fn shape(entity: &EntityType, scale: Scale) -> Result<ArcSpline, Skip> {
    match entity {
        EntityType::Line(e) => line(e, scale),
        EntityType::Arc(e) => arc(e, scale),
        EntityType::Circle(e) => circle(e, scale),
        EntityType::LwPolyline(e) => light_polyline(e, scale),
        EntityType::Polyline(e) => polyline(e, scale),
        _ => Err(Skip::NotRead("")),
    }
}

/// Lines are drawn in the coordinates of the world, whatever their extrusion direction is.
fn line(e: &Line, scale: Scale) -> Result<ArcSpline, Skip> {
    let place = |p: &::dxf::Point| at(p.x, p.y, scale);
    let ends = [place(&e.p1), place(&e.p2)];
    polygon(ends.map(|point| Vertex { point, bulge: 0.0 }).to_vec(), false)
}

fn circle(e: &Circle, scale: Scale) -> Result<ArcSpline, Skip> {
    upright(&e.normal, ["CIRCLE, mirrored", "CIRCLE, tilted"])?;
    let (center, radius) = round(&e.center, e.radius, scale)?;
    Ok(ArcSpline::circle(center, radius))
}

fn arc(e: &Arc, scale: Scale) -> Result<ArcSpline, Skip> {
    upright(&e.normal, ["ARC, mirrored", "ARC, tilted"])?;
    let (center, radius) = round(&e.center, e.radius, scale)?;
    if !(e.start_angle.is_finite() && e.end_angle.is_finite()) {
        return Err(Skip::Fault("an angle is not a finite number".into(), Some(center)));
    }
    let (start, end) = (e.start_angle.rem_euclid(360.0), e.end_angle.rem_euclid(360.0));
    let turn = if e.start_angle == e.end_angle {
        return Err(Skip::Fault("it begins and ends at the same angle".into(), Some(center)));
    } else if start < end {
        end - start
    } else {
        // The larger angle goes first, so that equal angles leave a full turn.
        360.0 - (start - end)
    };
    let on_circle = |angle: f64| center + direction(angle) * radius;
    let vertex = |angle: f64, bulge: f64| Vertex { point: on_circle(angle), bulge };
    let half = 0.5 * turn;
    let vertices = if turn == 360.0 {
        let opposite = center + (center - on_circle(start));
        return polygon(vec![vertex(start, 1.0), Vertex { point: opposite, bulge: 1.0 }], true);
    } else if turn <= 180.0 {
        vec![vertex(start, bulge(turn)), vertex(end, 0.0)]
    } else {
        vec![vertex(start, bulge(half)), vertex(start + half, bulge(half)), vertex(end, 0.0)]
    };
    polygon(vertices, false)
}

fn light_polyline(e: &LwPolyline, scale: Scale) -> Result<ArcSpline, Skip> {
    upright(&e.extrusion_direction, ["LWPOLYLINE, mirrored", "LWPOLYLINE, tilted"])?;
    let vertices = e.vertices.iter().map(|v| Vertex { point: at(v.x, v.y, scale), bulge: v.bulge });
    polygon(vertices.collect(), e.is_closed())
}

fn polyline(e: &Polyline, scale: Scale) -> Result<ArcSpline, Skip> {
    if e.is_3d_polygon_mesh() || e.is_polyface_mesh() {
        return Err(Skip::NotRead("POLYLINE, mesh"));
    }
    if e.is_3d_polyline() {
        return Err(Skip::NotRead("POLYLINE, 3D"));
    }
    upright(&e.normal, ["POLYLINE, mirrored", "POLYLINE, tilted"])?;
    // Control points of a fitted curve stand among its vertices, but not on the curve.
    let vertices = e
        .vertices()
        .filter(|v| !v.is_spline_frame_control_point())
        .map(|v| Vertex { point: at(v.location.x, v.location.y, scale), bulge: v.bulge });
    polygon(vertices.collect(), e.is_closed())
}

/// A chain of elements without those of no length, closed also where its ends are the same place.
fn polygon(mut vertices: Vec<Vertex>, closed: bool) -> Result<ArcSpline, Skip> {
    let place = vertices.iter().map(|v| v.point).find(|p| usable(*p));
    let fault = |reason: &str| Err(Skip::Fault(reason.into(), place));
    if vertices.iter().any(|v| !(v.point.is_finite() && v.bulge.is_finite())) {
        return fault("a number is not finite");
    }
    if vertices.len() < 2 {
        return fault("it has fewer than two vertices");
    }
    // Of vertices in one place the last counts: its element is the one that leads on.
    let mut kept: Vec<Vertex> = Vec::with_capacity(vertices.len());
    for vertex in vertices.drain(..) {
        match kept.last_mut() {
            Some(last) if last.point == vertex.point => *last = vertex,
            _ => kept.push(vertex),
        }
    }
    let ends_meet = kept.len() > 1 && kept[0].point == kept[kept.len() - 1].point;
    if ends_meet {
        kept.pop();
    }
    if kept.len() < 2 {
        return fault("it has no length");
    }
    let spline = ArcSpline { vertices: kept, closed: closed || ends_meet };
    let fits = |v: &Vertex| usable(v.point);
    // Beyond a half circle an arc is about as wide and high as its sagitta.
    let sagitta = |e: crate::geom::Element| 0.5 * e.chord().length() * e.bulge.abs();
    if !(spline.vertices.iter().all(fits) && spline.elements().all(|e| sagitta(e) <= LARGEST)) {
        return fault("it is too large to calculate with");
    }
    Ok(spline)
}

/// Center and radius of something round.
fn round(center: &::dxf::Point, radius: f64, scale: Scale) -> Result<(Point, f64), Skip> {
    let (center, scaled) = (at(center.x, center.y, scale), scale.length(radius));
    let place = usable(center).then_some(center);
    let reason = if !(center.is_finite() && scaled.is_finite()) {
        "a number is not finite".into()
    } else if scaled <= 0.0 {
        format!("its radius is {radius}")
    } else if !usable(center) || scaled > LARGEST {
        "it is too large to calculate with".into()
    } else if center.x + scaled == center.x || center.y + scaled == center.y {
        "its radius is smaller than the last digit of its center".into()
    } else {
        return Ok((center, scaled));
    };
    Err(Skip::Fault(reason, place))
}

/// Refuses a coordinate system that is not the one of the world, perhaps raised.
fn upright(normal: &::dxf::Vector, names: [&'static str; 2]) -> Result<(), Skip> {
    let least = TILT * normal.z.abs();
    let plumb = normal.x.abs() <= least && normal.y.abs() <= least;
    match plumb {
        true if normal.z > 0.0 => Ok(()),
        true if normal.z < 0.0 => Err(Skip::NotRead(names[0])),
        _ => Err(Skip::NotRead(names[1])),
    }
}

fn at(x: f64, y: f64, scale: Scale) -> Point {
    point(scale.length(x), scale.length(y))
}

fn usable(p: Point) -> bool {
    p.x.abs() <= LARGEST && p.y.abs() <= LARGEST
}

/// Unit vector at an angle in degrees, exact at multiples of a quarter turn and symmetric about
/// them, as the angle is taken from the nearest one.
fn direction(degrees: f64) -> Vector {
    let quarters = (degrees / 90.0).round();
    let (sin, cos) = (degrees - 90.0 * quarters).to_radians().sin_cos();
    let v = vector(cos, sin);
    match quarters.rem_euclid(4.0) as u8 {
        0 => v,
        1 => v.left(),
        2 => -v,
        _ => v.right(),
    }
}

/// Bulge of an arc over an angle in degrees, up to a half turn, which is exact.
fn bulge(degrees: f64) -> f64 {
    if degrees == 180.0 { 1.0 } else { (0.25 * degrees).to_radians().tan() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MM: Scale = Scale::SAME;

    fn an_arc(radius: f64, start_angle: f64, end_angle: f64) -> Arc {
        Arc { center: ::dxf::Point::new(10.0, 20.0, 0.0), radius, start_angle, end_angle, ..Arc::default() }
    }

    fn a_polyline(vertices: &[(f64, f64, f64)], flags: i32) -> LwPolyline {
        let vertices = vertices.iter().map(|&(x, y, bulge)| ::dxf::LwPolylineVertex {
            x,
            y,
            bulge,
            ..Default::default()
        });
        LwPolyline { vertices: vertices.collect(), flags, ..LwPolyline::default() }
    }

    fn reason(result: Result<ArcSpline, Skip>) -> String {
        match result {
            Err(Skip::Fault(reason, _)) => reason,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn arcs_between_quarters_end_on_round_numbers() {
        let places = [(13.0, 20.0), (10.0, 23.0), (7.0, 20.0), (10.0, 17.0), (13.0, 20.0)];
        for quarter in 0..4_u8 {
            let start = 90.0 * f64::from(quarter);
            let spline = arc(&an_arc(3.0, start, start + 90.0), MM).unwrap();
            let ends = spline.vertices.iter().map(|v| (v.point.x, v.point.y)).collect::<Vec<_>>();
            assert_eq!(ends, places[usize::from(quarter)..][..2]);
            assert!((spline.element(0).sweep().to_degrees() - 90.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_half_circle_has_bulge_one() {
        let spline = arc(&an_arc(3.0, 270.0, 90.0), MM).unwrap();
        assert_eq!(spline, ArcSpline::open([(10.0, 17.0, 1.0), (10.0, 23.0, 0.0)]));
    }

    #[test]
    fn an_arc_beyond_a_half_circle_is_two_elements() {
        let spline = arc(&an_arc(3.0, 30.0, 300.0), MM).unwrap();
        assert_eq!(spline.len(), 2);
        assert!((spline.length() - 1.5 * std::f64::consts::PI * 3.0).abs() < 1e-13);
        let (center, radius) = spline.element(1).center().unwrap();
        assert!(center.distance(point(10.0, 20.0)) < 1e-13 && (radius - 3.0).abs() < 1e-13);
    }

    #[test]
    fn angles_may_be_written_in_any_turn() {
        let wanted = arc(&an_arc(3.0, 350.0, 20.0), MM).unwrap();
        for (start, end) in [(-10.0, 20.0), (350.0, 380.0), (710.0, -340.0)] {
            assert_eq!(arc(&an_arc(3.0, start, end), MM).unwrap(), wanted);
        }
        assert_eq!(arc(&an_arc(3.0, 1e9, 1e9 + 90.0), MM).unwrap().len(), 1);
    }

    #[test]
    fn an_arc_of_a_full_turn_is_a_circle() {
        let full = arc(&an_arc(3.0, 0.0, 360.0), MM).unwrap();
        assert_eq!(full, ArcSpline::circle(point(10.0, 20.0), 3.0));
        let full = arc(&an_arc(3.0, 33.0, 393.0), MM).unwrap();
        assert!(full.closed && (full.area() - 9.0 * std::f64::consts::PI).abs() < 1e-12);
        assert!(reason(arc(&an_arc(3.0, 33.0, 33.0), MM)).contains("same angle"));
    }

    #[test]
    fn what_has_no_size_or_no_number_is_refused() {
        for radius in [0.0, -5.0] {
            assert_eq!(reason(arc(&an_arc(radius, 0.0, 90.0), MM)), format!("its radius is {radius}"));
        }
        for radius in [f64::NAN, f64::INFINITY] {
            assert!(reason(arc(&an_arc(radius, 0.0, 90.0), MM)).contains("finite"));
        }
        assert!(reason(arc(&an_arc(3.0, f64::NAN, 90.0), MM)).contains("angle"));
        assert!(reason(arc(&an_arc(1e15, 0.0, 90.0), MM)).contains("large"));
        assert!(
            reason(light_polyline(&a_polyline(&[(0.0, 0.0, 1e13), (1.0, 0.0, 0.0)], 1), MM))
                .contains("large")
        );
        assert!(reason(light_polyline(&a_polyline(&[(0.0, 0.0, 0.0); 50], 1), MM)).contains("no length"));
        assert!(reason(light_polyline(&a_polyline(&[(3.0, 4.0, 0.0)], 1), MM)).contains("two vertices"));
        let nan = light_polyline(&a_polyline(&[(f64::NAN, 0.0, 0.0), (3.0, 4.0, 0.0)], 0), MM);
        assert_eq!(nan, Err(Skip::Fault("a number is not finite".into(), Some(point(3.0, 4.0)))));
    }

    #[test]
    fn a_polyline_closes_by_flag_or_by_its_ends() {
        let corners = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, 0.0)];
        let wanted = ArcSpline::closed(corners);
        assert_eq!(light_polyline(&a_polyline(&corners, 1), MM).unwrap(), wanted);
        assert!(!light_polyline(&a_polyline(&corners, 128), MM).unwrap().closed);
        let mut returning = corners.to_vec();
        returning.push((0.0, 0.0, 0.7));
        assert_eq!(light_polyline(&a_polyline(&returning, 0), MM).unwrap(), wanted);
        assert_eq!(light_polyline(&a_polyline(&returning, 1), MM).unwrap(), wanted);
    }

    #[test]
    fn elements_of_no_length_vanish_with_their_bulge() {
        let doubled = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.9), (4.0, 0.0, 0.5), (4.0, 3.0, 0.0)];
        let wanted = ArcSpline::closed([doubled[0], doubled[2], doubled[3]]);
        assert_eq!(light_polyline(&a_polyline(&doubled, 1), MM).unwrap(), wanted);
    }

    #[test]
    fn other_coordinate_systems_are_not_guessed_at() {
        let circle_on = |x, y, z| {
            let normal = ::dxf::Vector::new(x, y, z);
            circle(&Circle { radius: 1.0, normal, ..Circle::default() }, MM)
        };
        assert!(circle_on(0.0, 0.0, 1.0).is_ok() && circle_on(1e-17, 0.0, 1.0).is_ok());
        assert_eq!(circle_on(0.0, 0.0, -1.0), Err(Skip::NotRead("CIRCLE, mirrored")));
        for (x, y, z) in [(1e-6, 0.0, 1.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, f64::NAN, 1.0)] {
            assert_eq!(circle_on(x, y, z), Err(Skip::NotRead("CIRCLE, tilted")));
        }
    }
}
