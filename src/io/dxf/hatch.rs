//! Boundaries of hatched areas.
//!
//! A path is a polyline, or edges: lines, arcs, ellipses and splines. Angles of edges that run
//! clockwise are counted clockwise.

use super::placement::{Placement, Plane};
use super::polyline::bulged_vertices;
use super::record::Numbers;
use super::round::{Sweep, elliptic, round};
use super::shape::{Drawn, Skip, Stage, normal};
use super::spline::{add, degree, weights};
use crate::geom::{Spline, Vertex, point, vector};
use std::f64::consts::TAU;

/// Flag of a path that is a polyline.
const POLYLINE: i64 = 2;

/// Flag of a path around a text.
const TEXT: i64 = 8;

pub(super) fn hatch(numbers: Numbers, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let height = numbers.or(30, 0.0);
    let plane = stage.plane(numbers, height)?;
    // The style comes behind the paths, and then the pattern with codes of its own.
    let end = numbers.0.iter().position(|(code, _)| *code == 75).unwrap_or(numbers.0.len());
    let placement = stage.placement.around(&Placement::of_normal(normal(numbers))?);
    let inner = Stage { placement: &placement, scale: stage.scale };
    let (_, paths) = Numbers(&numbers.0[..end]).split(92);
    for path in paths {
        let flags = path.flags(92);
        if flags & TEXT != 0 {
            continue;
        }
        if flags & POLYLINE != 0 {
            let closed = path.or(73, 1.0) != 0.0;
            drawn.path(bulged_vertices(path, path.all(10).count())?, closed, &plane)?;
            continue;
        }
        let (_, edges) = path.split(72);
        for edge in edges {
            draw_edge(edge, height, &plane, inner, drawn)?;
        }
    }
    if drawn.shapes.is_empty() { Skip::fault("it has no boundary") } else { Ok(()) }
}

fn draw_edge(edge: Numbers, height: f64, plane: &Plane, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    let flat = |code: u16| Ok::<_, Skip>(point(edge.need(code)?, edge.need(code + 10)?));
    let forward = edge.or(73, 1.0) != 0.0;
    match edge.flags(72) {
        1 => {
            let vertices = [flat(10)?, flat(11)?].map(|point| Vertex { point, bulge: 0.0 });
            drawn.path(vertices.to_vec(), false, plane)
        }
        2 => {
            let radius = edge.need(40)?;
            if radius <= 0.0 {
                return Err(Skip::Fault(format!("an edge has the radius {radius}")));
            }
            round(flat(10)?, radius, sweep(edge, forward)?, plane, drawn)
        }
        3 => {
            let (center, major) = (flat(10)?, flat(11)?.to_vector());
            let minor = major.left() * edge.need(40)?;
            // Parameters are written in degrees, here alone.
            let Sweep { start, end, turn } = sweep(edge, forward)?;
            let turn = if turn == 360.0 { TAU } else { turn.to_radians() };
            let sweep = Sweep { start: start.to_radians(), end: end.to_radians(), turn };
            let axes = [[major.x, major.y, 0.0], [minor.x, minor.y, 0.0]];
            elliptic([center.x, center.y, height], axes, sweep, stage, drawn)
        }
        4 => draw_spline(edge, plane, drawn),
        kind => Err(Skip::Fault(format!("an edge is of the unknown kind {kind}"))),
    }
}

/// What a round edge covers, counter-clockwise, in degrees.
fn sweep(edge: Numbers, forward: bool) -> Result<Sweep, Skip> {
    let (start, end) = (edge.need(50)?, edge.need(51)?);
    if forward { Sweep::new(start, end, 360.0) } else { Sweep::new(-end, -start, 360.0) }
}

fn draw_spline(edge: Numbers, plane: &Plane, drawn: &mut Drawn) -> Result<(), Skip> {
    let places = |code| -> Result<Vec<_>, Skip> {
        Ok(edge.places(code)?.into_iter().map(|[x, y, _]| plane.point(point(x, y))).collect())
    };
    let tangent = |code| {
        let [x, y, _] = edge.place(code).ok()?;
        Some(plane.vector(vector(x, y)))
    };
    let spline = Spline {
        degree: degree(edge.or(94, 3.0))?,
        knots: edge.all(40).collect(),
        control: places(10)?,
        weights: weights(edge.all(42).collect()),
        fit: places(11)?,
        tangents: [tangent(12), tangent(13)],
        closed: edge.flags(74) != 0,
    };
    drawn.tilted |= plane.is_tilted();
    add(spline, drawn)
}

#[cfg(test)]
mod tests {
    use super::super::record::Kind;
    use super::super::shape::Shape;
    use super::super::shape::tests::{drawn_by, fault_of};
    use super::*;
    use crate::boundary::FreeShape;
    use crate::geom::ArcSpline;

    fn drawn(paths: &[(u16, f64)]) -> Vec<Shape> {
        let head = [(10, 0.0), (20, 0.0), (30, 0.0), (230, 1.0), (70, 1.0), (91, 2.0)];
        let tail = [(75, 0.0), (76, 1.0), (98, 1.0), (10, 7.0), (20, 8.0)];
        drawn_by(Kind::Hatch, &[&head[..], paths, &tail].concat(), &Placement::ROOT).unwrap().shapes
    }

    #[test]
    fn a_boundary_may_be_a_polyline() {
        let slot = [(0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (4.0, 2.0, 0.0), (0.0, 2.0, 1.0)];
        let vertices = slot.iter().flat_map(|v| [(10, v.0), (20, v.1), (42, v.2)]);
        let path: Vec<_> = [(92, 7.0), (72, 1.0), (73, 1.0), (93, 4.0)].into_iter().chain(vertices).collect();
        assert_eq!(drawn(&path), [Shape::Path(ArcSpline::closed(slot))]);
    }

    #[test]
    fn a_boundary_may_be_edges_in_either_sense() {
        let line = [(72, 1.0), (10, 1.0), (20, 0.0), (11, -1.0), (21, 0.0)];
        let arc = [(72, 2.0), (10, 0.0), (20, 0.0), (40, 1.0), (50, 0.0), (51, 180.0), (73, 1.0)];
        let back =
            [(72, 2.0), (10, 0.0), (20, 0.0), (40, 1.0), (50, 180.0), (51, 360.0), (73, 0.0), (97, 0.0)];
        let shapes = drawn(&[&[(92, 1.0), (93, 3.0)][..], &line, &arc, &back].concat());
        let half = Shape::Path(ArcSpline::open([(1.0, 0.0, 1.0), (-1.0, 0.0, 0.0)]));
        assert_eq!(shapes[1..], [half.clone(), half], "backward from 180 to 360 is above the axis, too");
    }

    #[test]
    fn a_boundary_may_be_free() {
        let ellipse = [
            (72, 3.0),
            (10, 5.0),
            (20, 0.0),
            (11, 2.0),
            (21, 0.0),
            (40, 0.5),
            (50, 0.0),
            (51, 360.0),
            (73, 1.0),
        ];
        let spline = [(72, 4.0), (94, 1.0), (73, 0.0), (74, 0.0), (95, 4.0), (96, 2.0)];
        let knots = [0.0, 0.0, 1.0, 1.0].map(|k| (40, k));
        let points = [(10, 0.0), (20, 0.0), (10, 3.0), (20, 4.0), (97, 0.0)];
        let shapes = drawn(&[&[(92, 0.0), (93, 2.0)][..], &ellipse, &spline, &knots, &points].concat());
        let [Shape::Free(FreeShape::Ellipse(e)), Shape::Free(FreeShape::Spline(s))] = &shapes[..] else {
            panic!("{shapes:?}")
        };
        assert!(e.is_full() && e.ratio == 0.5);
        assert_eq!((s.degree, s.control.len(), s.knots.len()), (1, 2, 4));
    }

    #[test]
    fn an_area_without_boundary_is_refused() {
        assert!(fault_of(Kind::Hatch, &[(91, 0.0), (75, 1.0)]).contains("no boundary"));
        let radius = [(91, 1.0), (92, 1.0), (93, 1.0), (72, 2.0), (10, 0.0), (20, 0.0), (40, 0.0)];
        assert!(fault_of(Kind::Hatch, &radius).contains("radius"));
    }
}
