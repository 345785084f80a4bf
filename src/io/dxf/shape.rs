//! Entities as curves in job units, seen from above.
//!
//! **Guarantees** that what comes out is finite and has a length, that round numbers stay exact
//! (an arc from 0 to 90 degrees ends where a line does that is drawn to the same place), and that
//! what is no chain of segments and arcs is handed on as it was drawn. **Does not** look at
//! heights: what lies above or below the plane of the drawing, or tilted, is noted and flattened.

use super::hatch::hatch;
use super::placement::{Placement, Plane, Roundness};
use super::polyline::{light_polyline, polyline};
use super::record::{Kind, Numbers, Record};
use super::round::{arc, circle, ellipse, line};
use super::spline::spline;
use crate::boundary::FreeShape;
use crate::geom::{ArcSpline, Element, Ellipse, Point, Vertex};
use crate::io::Scale;

/// Largest coordinate and radius, in job units. Beyond it doubles are more than 0.0001 apart, and
/// nothing on a machine is a million kilometers long.
pub(super) const LARGEST: f64 = 1e12;

/// Flattest ellipse, as a ratio of its axes, as the DXF reference has it; what is flatter is a
/// circle seen from its edge.
const FLATTEST: f64 = 1e-6;

/// Why an entity gives no curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Skip {
    /// Its kind is not read, or a form of it.
    NotRead(&'static str),
    /// What is wrong with it.
    Fault(String),
}

impl Skip {
    /// Something is wrong with it.
    pub fn fault<T>(reason: &str) -> Result<T, Skip> {
        Err(Skip::Fault(reason.into()))
    }
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Path(ArcSpline),
    Free(FreeShape),
}

/// What one entity draws, and what was made simpler.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawn {
    pub shapes: Vec<Shape>,
    /// Its height or thickness was ignored.
    pub raised: bool,
    /// It was projected.
    pub tilted: bool,
    /// Its width was ignored.
    pub wide: bool,
    /// It has another number of vertices than it says.
    pub miscounted: bool,
}

/// The space that an entity is drawn in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<'a> {
    pub placement: &'a Placement,
    pub scale: Scale,
}

impl Stage<'_> {
    /// The plane of an entity that has a coordinate system of its own, at a height in it.
    pub fn plane(&self, numbers: Numbers, height: f64) -> Result<Plane, Skip> {
        let normal = normal(numbers);
        if normal == [0.0, 0.0, 1.0] {
            return Ok(Plane::new(self.placement, height, self.scale));
        }
        Ok(Plane::new(&self.placement.around(&Placement::of_normal(normal)?), height, self.scale))
    }
}

/// The extrusion direction.
pub(super) fn normal(numbers: Numbers) -> [f64; 3] {
    [numbers.or(210, 0.0), numbers.or(220, 0.0), numbers.or(230, 1.0)]
}

/// Adds what an entity draws.
///
/// Nothing is added if it is skipped.
pub(super) fn draw(record: &Record, stage: Stage, drawn: &mut Drawn) -> Result<(), Skip> {
    *drawn = Drawn { shapes: std::mem::take(&mut drawn.shapes), ..Drawn::default() };
    drawn.shapes.clear();
    let numbers = record.numbers();
    match record.kind {
        Kind::Line => line(numbers, stage, drawn),
        Kind::Arc => arc(numbers, stage, drawn),
        Kind::Circle => circle(numbers, stage, drawn),
        Kind::Ellipse => ellipse(numbers, stage, drawn),
        Kind::Spline => spline(numbers, stage, drawn),
        Kind::LightPolyline => light_polyline(numbers, stage, drawn),
        Kind::Polyline => polyline(numbers, stage, drawn),
        Kind::Hatch => hatch(numbers, stage, drawn),
        Kind::Insert | Kind::Other => Skip::fault("it draws nothing"),
    }?;
    let polyline = matches!(record.kind, Kind::LightPolyline | Kind::Polyline);
    let other_than_0 = |codes: &[u16]| record.numbers.iter().any(|(c, v)| *v != 0.0 && codes.contains(c));
    drawn.raised = stage.placement.height() != 0.0 || other_than_0(&[30, 31, 38, 39]);
    drawn.wide = polyline && other_than_0(&[40, 41, 43]);
    Ok(())
}

impl Drawn {
    /// Adds a chain of vertices in a plane.
    pub fn path(&mut self, vertices: Vec<Vertex>, closed: bool, plane: &Plane) -> Result<(), Skip> {
        self.tilted |= plane.is_tilted();
        let sign = match plane.roundness() {
            Roundness::Kept => 1.0,
            Roundness::Mirrored => -1.0,
            Roundness::Lost if vertices.iter().any(|v| v.bulge != 0.0) => {
                return self.stretched(&chain(vertices, closed)?, plane);
            }
            Roundness::Lost => 0.0,
        };
        let vertices = vertices
            .into_iter()
            .map(|v| Vertex { point: plane.point(v.point), bulge: sign * v.bulge })
            .collect();
        self.flat_path(vertices, closed)
    }

    /// Adds a chain of vertices in job units.
    pub fn flat_path(&mut self, vertices: Vec<Vertex>, closed: bool) -> Result<(), Skip> {
        let path = chain(vertices, closed)?;
        // Beyond a half circle an arc is about as wide and high as its sagitta.
        let sagitta = |e: Element| 0.5 * e.chord().length() * e.bulge.abs();
        let fits = path.vertices.iter().all(|v| is_usable(v.point));
        if !(fits && path.elements().all(|e| e.is_segment() || sagitta(e) <= LARGEST)) {
            return Skip::fault("it is too large to calculate with");
        }
        self.shapes.push(Shape::Path(path));
        Ok(())
    }

    /// Adds a chain of segments and elliptic arcs: what becomes of arcs that are stretched.
    fn stretched(&mut self, path: &ArcSpline, plane: &Plane) -> Result<(), Skip> {
        let mut run: Vec<Vertex> = Vec::new();
        for element in path.elements() {
            let (Some((center, radius)), false) = (element.center(), element.is_segment()) else {
                if run.is_empty() {
                    run.push(Vertex { point: plane.point(element.start), bulge: 0.0 });
                }
                run.push(Vertex { point: plane.point(element.end), bulge: 0.0 });
                continue;
            };
            if !run.is_empty() {
                self.flat_path(std::mem::take(&mut run), false)?;
            }
            let axes = [(radius, 0.0), (0.0, radius)].map(|(x, y)| plane.vector(crate::geom::vector(x, y)));
            let start = (element.start - center).angle();
            let [a, b] = axes;
            self.ellipse(Ellipse::from_conjugate(plane.point(center), a, b, start, element.sweep()))?;
        }
        if run.is_empty() { Ok(()) } else { self.flat_path(run, false) }
    }

    /// Adds an elliptic arc.
    pub fn ellipse(&mut self, ellipse: Ellipse) -> Result<(), Skip> {
        let size = ellipse.major.length();
        if !(ellipse.center.is_finite() && size.is_finite()) {
            return Skip::fault("a number is not finite");
        }
        if size == 0.0 {
            return Skip::fault("it has no length");
        }
        if !(is_usable(ellipse.center) && size <= LARGEST) {
            return Skip::fault("it is too large to calculate with");
        }
        if ellipse.ratio < FLATTEST {
            return Skip::fault("it is as flat as a line");
        }
        self.shapes.push(Shape::Free(FreeShape::Ellipse(ellipse)));
        Ok(())
    }
}

/// Whether a place is within the domain.
pub(super) fn is_usable(p: Point) -> bool {
    p.x.abs() <= LARGEST && p.y.abs() <= LARGEST
}

/// A chain of elements without those of no length, closed also where its ends are the same place.
fn chain(mut vertices: Vec<Vertex>, closed: bool) -> Result<ArcSpline, Skip> {
    if vertices.iter().any(|v| !(v.point.is_finite() && v.bulge.is_finite())) {
        return Skip::fault("a number is not finite");
    }
    if vertices.len() < 2 {
        return Skip::fault("it has fewer than two vertices");
    }
    // Of vertices in one place the last counts: its element is the one that leads on.
    let mut kept = 0;
    for i in 0..vertices.len() {
        if kept > 0 && vertices[kept - 1].point == vertices[i].point {
            kept -= 1;
        }
        vertices[kept] = vertices[i];
        kept += 1;
    }
    vertices.truncate(kept);
    let ends_meet = kept > 1 && vertices[0].point == vertices[kept - 1].point;
    if ends_meet {
        vertices.pop();
    }
    if vertices.len() < 2 {
        return Skip::fault("it has no length");
    }
    Ok(ArcSpline { vertices, closed: closed || ends_meet })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::geom::point;

    /// What a record of these numbers draws.
    pub fn drawn_by(kind: Kind, numbers: &[(u16, f64)], placement: &Placement) -> Result<Drawn, Skip> {
        let record = Record { kind, numbers: numbers.to_vec(), ..Record::default() };
        let mut drawn = Drawn::default();
        draw(&record, Stage { placement, scale: Scale::SAME }, &mut drawn).map(|()| drawn)
    }

    /// The one path that a record of these numbers draws.
    pub fn path_of(kind: Kind, numbers: &[(u16, f64)]) -> Result<ArcSpline, Skip> {
        match &drawn_by(kind, numbers, &Placement::ROOT)?.shapes[..] {
            [Shape::Path(path)] => Ok(path.clone()),
            other => panic!("{other:?}"),
        }
    }

    /// Why a record of these numbers is skipped.
    pub fn fault_of(kind: Kind, numbers: &[(u16, f64)]) -> String {
        match drawn_by(kind, numbers, &Placement::ROOT) {
            Err(Skip::Fault(reason)) => reason,
            other => panic!("{other:?}"),
        }
    }

    fn vertex(x: f64, y: f64, bulge: f64) -> Vertex {
        Vertex { point: point(x, y), bulge }
    }

    #[test]
    fn elements_of_no_length_vanish_with_their_bulge() {
        let doubled =
            vec![vertex(0.0, 0.0, 0.0), vertex(4.0, 0.0, 0.9), vertex(4.0, 0.0, 0.5), vertex(4.0, 3.0, 0.0)];
        let wanted = ArcSpline::closed([(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, 0.0)]);
        assert_eq!(chain(doubled, true), Ok(wanted));
        assert!(chain(vec![vertex(1.0, 1.0, 0.5); 50], true).is_err());
    }

    #[test]
    fn heights_are_noted_and_ignored() {
        let line = [(10, 1.0), (20, 2.0), (30, 5.0), (11, 3.0), (21, 2.0), (31, 7.0)];
        let drawn = drawn_by(Kind::Line, &line, &Placement::ROOT).unwrap();
        assert!(drawn.raised && !drawn.tilted);
        assert_eq!(drawn.shapes, [Shape::Path(ArcSpline::open([(1.0, 2.0, 0.0), (3.0, 2.0, 0.0)]))]);
        let flat = [(10, 1.0), (20, 2.0), (30, 0.0), (11, 3.0), (21, 2.0)];
        assert!(!drawn_by(Kind::Line, &flat, &Placement::ROOT).unwrap().raised);
    }

    #[test]
    fn a_stretched_polyline_keeps_its_lines_and_stretches_its_arcs() {
        let slot = [
            [(10, 0.0), (20, 0.0), (42, 0.0)],
            [(10, 4.0), (20, 0.0), (42, 1.0)],
            [(10, 4.0), (20, 2.0), (42, 0.0)],
            [(10, 0.0), (20, 2.0), (42, 1.0)],
        ];
        let numbers = [&[(70, 1.0)][..], &slot.concat()].concat();
        let placement = Placement::turned([2.0, 1.0, 1.0], 0.0);
        let drawn = drawn_by(Kind::LightPolyline, &numbers, &placement).unwrap();
        let [
            Shape::Path(a),
            Shape::Free(FreeShape::Ellipse(b)),
            Shape::Path(c),
            Shape::Free(FreeShape::Ellipse(_)),
        ] = &drawn.shapes[..]
        else {
            panic!("{drawn:?}")
        };
        assert_eq!(a, &ArcSpline::open([(0.0, 0.0, 0.0), (8.0, 0.0, 0.0)]));
        assert_eq!((b.center, b.ratio), (point(8.0, 1.0), 0.5));
        assert!(
            b.ends()[0].distance(point(8.0, 0.0)) < 1e-15 && b.ends()[1].distance(point(8.0, 2.0)) < 1e-15
        );
        assert_eq!(c, &ArcSpline::open([(8.0, 2.0, 0.0), (0.0, 2.0, 0.0)]));
    }
}
