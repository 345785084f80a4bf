//! What is drawn, one entity at a time.

use super::layer::Layer;
use super::pen::Pen;
use super::skeleton::MODEL_SPACE;
use crate::geom::{ArcSpline, Bounds, Point};
use crate::mat::AxisEdge;
use crate::toolpath::Point3;
use std::borrow::Cow;
use std::io;

/// One entity.
pub(super) struct Entity<'a> {
    pub layer: Layer,
    pub shape: Shape<'a>,
}

/// What an entity is.
pub(super) enum Shape<'a> {
    /// An LWPOLYLINE with bulges at a height; a POINT where it is a single place.
    Spline(Cow<'a, ArcSpline>, f64),
    /// A SPLINE: a rational quadratic Bezier curve with end weights 1.
    Conic([Point; 3], f64),
    /// A LINE, or a 3D POLYLINE through more than two places.
    Way(Vec<Point3>),
}

impl<'a> Entity<'a> {
    /// A spline at height 0.
    pub fn flat(layer: Layer, spline: &'a ArcSpline) -> Entity<'a> {
        Entity { layer, shape: Shape::Spline(Cow::Borrowed(spline), 0.0) }
    }

    /// An edge of an axis.
    pub fn axis(edge: &AxisEdge) -> Entity<'a> {
        let shape = if edge.is_straight() {
            Shape::Way([edge.points[0], edge.points[2]].map(|p| Point3::new(p, 0.0)).to_vec())
        } else {
            Shape::Conic(edge.points, edge.weight)
        };
        Entity { layer: Layer::MedialAxis, shape }
    }

    /// Whether there is anything to draw.
    pub fn is_drawn(&self) -> bool {
        match &self.shape {
            Shape::Spline(spline, _) => !spline.vertices.is_empty(),
            Shape::Conic(..) => true,
            Shape::Way(places) => !places.is_empty(),
        }
    }

    /// How many handles it takes.
    pub fn handles(&self) -> u64 {
        match &self.shape {
            // Each vertex has one, and so has the mark of the end.
            Shape::Way(places) if places.len() > 2 => places.len() as u64 + 2,
            _ => 1,
        }
    }

    /// The box around it and its lowest and highest place. Around a conic arc it may be larger than
    /// need be, up to its control points.
    pub fn extents(&self) -> (Bounds, [f64; 2]) {
        match &self.shape {
            Shape::Spline(spline, z) => (spline.bounds(), [*z, *z]),
            Shape::Conic(points, _) => (Bounds::around(*points), [0.0, 0.0]),
            Shape::Way(places) => {
                let low = places.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
                let high = places.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
                (Bounds::around(places.iter().map(|p| p.xy())), [low, high])
            }
        }
    }

    /// Writes it.
    pub fn write(&self, pen: &mut Pen) -> io::Result<()> {
        match &self.shape {
            Shape::Spline(spline, z) => match &spline.vertices[..] {
                [only] => {
                    head(pen, "POINT", self.layer, "AcDbPoint")?;
                    pen.place(10, Point3::new(only.point, *z))
                }
                _ => polyline(pen, self.layer, spline, *z),
            },
            Shape::Conic(points, weight) => conic(pen, self.layer, points, *weight),
            Shape::Way(places) => match places[..] {
                [from] => line(pen, self.layer, from, from),
                [from, to] => line(pen, self.layer, from, to),
                _ => way(pen, self.layer, places),
            },
        }
    }
}

/// What every entity begins with; answers its handle.
fn head(pen: &mut Pen, kind: &str, layer: Layer, class: &str) -> io::Result<u64> {
    let handle = owned(pen, kind, MODEL_SPACE, layer)?;
    pen.text(100, class)?;
    Ok(handle)
}

fn owned(pen: &mut Pen, kind: &str, owner: u64, layer: Layer) -> io::Result<u64> {
    let handle = pen.handle();
    pen.text(0, kind)?;
    pen.reference(5, handle)?;
    pen.reference(330, owner)?;
    pen.texts(&[(100, "AcDbEntity"), (8, layer.name())])?;
    Ok(handle)
}

fn line(pen: &mut Pen, layer: Layer, from: Point3, to: Point3) -> io::Result<()> {
    head(pen, "LINE", layer, "AcDbLine")?;
    pen.place(10, from)?;
    pen.place(11, to)
}

fn polyline(pen: &mut Pen, layer: Layer, spline: &ArcSpline, z: f64) -> io::Result<()> {
    head(pen, "LWPOLYLINE", layer, "AcDbPolyline")?;
    pen.integer(90, spline.vertices.len() as i64)?;
    pen.integer(70, i64::from(spline.closed))?;
    if z != 0.0 {
        pen.number(38, z)?;
    }
    for v in &spline.vertices {
        pen.number(10, v.point.x)?;
        pen.number(20, v.point.y)?;
        if v.bulge != 0.0 {
            pen.number(42, v.bulge)?;
        }
    }
    Ok(())
}

fn conic(pen: &mut Pen, layer: Layer, points: &[Point; 3], weight: f64) -> io::Result<()> {
    const RATIONAL: i64 = 4;
    const PLANAR: i64 = 8;
    head(pen, "SPLINE", layer, "AcDbSpline")?;
    pen.place(210, Point3 { x: 0.0, y: 0.0, z: 1.0 })?;
    pen.integer(70, RATIONAL + PLANAR)?;
    // Degree, knots, control points, fit points.
    for (code, count) in [(71, 2), (72, 6), (73, 3), (74, 0)] {
        pen.integer(code, count)?;
    }
    for knot in [0.0, 0.0, 0.0, 1.0, 1.0, 1.0] {
        pen.number(40, knot)?;
    }
    for weight in [1.0, weight, 1.0] {
        pen.number(41, weight)?;
    }
    points.iter().try_for_each(|p| pen.place(10, Point3::new(*p, 0.0)))
}

/// A polyline in space.
fn way(pen: &mut Pen, layer: Layer, places: &[Point3]) -> io::Result<()> {
    const IN_SPACE: i64 = 8;
    const VERTEX_IN_SPACE: i64 = 32;
    let polyline = head(pen, "POLYLINE", layer, "AcDb3dPolyline")?;
    // Vertices follow, as old readers want to be told.
    pen.integer(66, 1)?;
    pen.place(10, Point3::default())?;
    pen.integer(70, IN_SPACE)?;
    for p in places {
        owned(pen, "VERTEX", polyline, layer)?;
        pen.texts(&[(100, "AcDbVertex"), (100, "AcDb3dPolylineVertex")])?;
        pen.place(10, *p)?;
        pen.integer(70, VERTEX_IN_SPACE)?;
    }
    owned(pen, "SEQEND", polyline, layer).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use crate::mat::{SiteKind, SiteRef};

    fn written(shape: Shape) -> (Vec<String>, u64) {
        let entity = Entity { layer: Layer::Offsets, shape };
        let mut out = Vec::new();
        let mut pen = Pen::new(&mut out, 7);
        entity.write(&mut pen).unwrap();
        let used = pen.handle() - 7;
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let tags = lines.chunks(2).map(|tag| tag.join(" "));
        assert_eq!(entity.handles(), used);
        (tags.collect(), used)
    }

    fn edge(points: [Point; 3], weight: f64) -> AxisEdge {
        let site = SiteRef { loop_index: 0, element: 0, kind: SiteKind::Segment };
        AxisEdge { from: 0, to: 1, sites: [site; 2], points, weight }
    }

    #[test]
    fn a_loop_is_a_closed_polyline_with_bulges() {
        let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (3.0, 0.0, 1.0), (3.0, 2.0, 0.0)]);
        let (tags, _) = written(Shape::Spline(Cow::Borrowed(&slot), -1.5));
        let wanted = "0 LWPOLYLINE|5 7|330 1F|100 AcDbEntity|8 OFFSETS|100 AcDbPolyline|90 3|70 1|38 -1.5|\
                      10 0.0|20 0.0|10 3.0|20 0.0|42 1.0|10 3.0|20 2.0";
        assert_eq!(tags.join("|"), wanted);
    }

    #[test]
    fn a_lone_place_is_a_point() {
        let place = ArcSpline::open([(4.0, 5.0, 0.0)]);
        let (tags, _) = written(Shape::Spline(Cow::Borrowed(&place), 0.0));
        assert!(tags.contains(&"0 POINT".into()) && tags.ends_with(&["20 5.0".into(), "30 0.0".into()]));
    }

    #[test]
    fn straight_edges_are_lines_and_others_exact_splines() {
        let line = Entity::axis(&edge([point(0.0, 0.0), point(1.0, 2.0), point(2.0, 4.0)], 1.0));
        assert!(matches!(&line.shape, Shape::Way(places) if places.len() == 2));
        let parabola = Entity::axis(&edge([point(0.0, 0.0), point(1.0, 2.5), point(2.0, 4.0)], 1.0));
        assert!(matches!(parabola.shape, Shape::Conic(..)));
        let (tags, _) = written(Shape::Conic([point(0.0, 0.0), point(1.0, 2.5), point(2.0, 4.0)], 0.75));
        let knots: Vec<&String> = tags.iter().filter(|t| t.starts_with("40 ")).collect();
        assert_eq!(knots, ["40 0.0", "40 0.0", "40 0.0", "40 1.0", "40 1.0", "40 1.0"]);
        let weights: Vec<&String> = tags.iter().filter(|t| t.starts_with("41 ")).collect();
        assert_eq!(weights, ["41 1.0", "41 0.75", "41 1.0"]);
    }

    #[test]
    fn a_way_in_space_has_a_handle_for_each_vertex() {
        let places = [[0.0, 0.0, 5.0], [3.0, 0.0, 5.0], [3.0, 0.0, 1.0]].map(Point3::from);
        let (tags, used) = written(Shape::Way(places.to_vec()));
        assert_eq!(used, 5);
        assert_eq!(tags.iter().filter(|t| *t == "330 7").count(), 4);
        assert_eq!(written(Shape::Way(places[..2].to_vec())).1, 1);
    }
}
