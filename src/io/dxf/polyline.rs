//! Polylines, light and heavy.

use super::placement::in_job;
use super::record::{Numbers, VERTEX};
use super::shape::{Drawn, Skip, Stage};
use crate::geom::{Vertex, point};

/// Flags of a polyline.
const CLOSED: i64 = 1;
const IN_SPACE: i64 = 8;
const MESH: i64 = 16 | 64;

/// Flag of a vertex that controls a curve through other vertices, and does not lie on it.
const CONTROL: i64 = 16;

pub(super) fn light_polyline(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let (head, _) = numbers.split(10);
    let count = numbers.all(10).count();
    let others = numbers.all(20).count();
    if count != others {
        return Err(Skip::Fault(format!("it has {count} x and {others} y coordinates")));
    }
    drawn.miscounted = head.get(90).is_some_and(|told| told != count as f64);
    let vertices = bulged_vertices(numbers, count)?;
    let closed = numbers.flags(70) & CLOSED != 0;
    drawn.path(vertices, closed, &stage.plane(numbers, numbers.or(38, 0.0))?)
}

/// The vertices of groups 10 and 20, each perhaps with a bulge.
pub(super) fn bulged_vertices(numbers: Numbers, count: usize) -> Result<Vec<Vertex>, Skip> {
    let mut vertices = Vec::with_capacity(count);
    let (_, parts) = numbers.split(10);
    for part in parts {
        vertices.push(Vertex { point: point(part.need(10)?, part.need(20)?), bulge: part.or(42, 0.0) });
    }
    Ok(vertices)
}

pub(super) fn polyline(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let (head, parts) = numbers.split(VERTEX);
    let flags = head.flags(70);
    if flags & MESH != 0 {
        return Err(Skip::NotRead("POLYLINE, mesh"));
    }
    let closed = flags & CLOSED != 0;
    let in_space = flags & IN_SPACE != 0;
    let mut vertices = Vec::new();
    for part in parts.filter(|part| part.flags(70) & CONTROL == 0) {
        let [x, y, z] = part.place(10)?;
        let place = if in_space {
            let [x, y, _] = stage.placement.point([x, y, z]);
            in_job(point(x, y), stage.scale)
        } else {
            point(x, y)
        };
        vertices.push(Vertex { point: place, bulge: if in_space { 0.0 } else { part.or(42, 0.0) } });
    }
    match in_space {
        true => drawn.flat_path(vertices, closed),
        false => drawn.path(vertices, closed, &stage.plane(head, head.or(30, 0.0))?),
    }
}

#[cfg(test)]
mod tests {
    use super::super::record::Kind;
    use super::super::shape::tests::{fault_of, path_of};
    use super::*;
    use crate::geom::ArcSpline;

    const CORNERS: [(f64, f64, f64); 3] = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, 0.0)];

    fn light(vertices: &[(f64, f64, f64)], flags: f64) -> Vec<(u16, f64)> {
        let vertices = vertices.iter().flat_map(|v| [(10, v.0), (20, v.1), (42, v.2)]);
        [(90, vertices.clone().count() as f64 / 3.0), (70, flags)].into_iter().chain(vertices).collect()
    }

    fn heavy(vertices: &[(f64, f64, f64, f64)], flags: f64) -> Vec<(u16, f64)> {
        let vertices = vertices
            .iter()
            .flat_map(|v| [(VERTEX, 0.0), (10, v.0), (20, v.1), (30, 0.0), (42, v.2), (70, v.3)]);
        [(10, 0.0), (20, 0.0), (30, 0.0), (70, flags)].into_iter().chain(vertices).collect()
    }

    #[test]
    fn a_polyline_closes_by_flag_or_by_its_ends() {
        let of = |vertices: &[_], flags| path_of(Kind::LightPolyline, &light(vertices, flags)).unwrap();
        let wanted = ArcSpline::closed(CORNERS);
        assert_eq!(of(&CORNERS, 1.0), wanted);
        assert!(!of(&CORNERS, 128.0).closed);
        let returning = [&CORNERS[..], &[(0.0, 0.0, 0.7)]].concat();
        assert_eq!(of(&returning, 0.0), wanted);
        assert_eq!(of(&returning, 1.0), wanted);
    }

    #[test]
    fn vertices_that_control_a_curve_are_not_on_it() {
        let drawn = CORNERS.map(|(x, y, bulge)| (x, y, bulge, 8.0));
        let controlled = [&drawn[..1], &[(9.0, 9.0, 0.0, 16.0)], &drawn[1..]].concat();
        assert_eq!(path_of(Kind::Polyline, &heavy(&controlled, 5.0)), Ok(ArcSpline::closed(CORNERS)));
    }

    #[test]
    fn a_polyline_in_space_is_flattened() {
        let mut numbers = heavy(&CORNERS.map(|(x, y, _)| (x, y, 0.0, 32.0)), 9.0);
        numbers[7].1 = 5.0;
        let flat = CORNERS.map(|(x, y, _)| (x, y, 0.0));
        assert_eq!(path_of(Kind::Polyline, &numbers), Ok(ArcSpline::closed(flat)));
    }

    #[test]
    fn what_is_no_outline_is_refused() {
        let vertex = heavy(&[(1.0, 1.0, 0.0, 0.0)], 1.0);
        assert!(fault_of(Kind::Polyline, &vertex).contains("two vertices"));
        assert!(fault_of(Kind::LightPolyline, &light(&[], 1.0)).contains("two vertices"));
        assert!(fault_of(Kind::LightPolyline, &[(10, 1.0), (10, 2.0), (20, 3.0)]).contains("2 x and 1 y"));
        assert!(
            fault_of(Kind::LightPolyline, &light(&[(0.0, 0.0, 1e13), (1.0, 0.0, 0.0)], 1.0))
                .contains("large")
        );
        for flags in [16.0, 64.0] {
            let numbers = heavy(&[(0.0, 0.0, 0.0, 64.0), (1.0, 0.0, 0.0, 64.0)], flags);
            assert_eq!(path_of(Kind::Polyline, &numbers), Err(Skip::NotRead("POLYLINE, mesh")));
        }
    }
}
