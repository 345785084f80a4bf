//! The libraries that are compared: each makes one level after the other of the same loops.

use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use medial::{ArcSpline, Error, Pocket, Tolerance, point};

/// Largest distance between an arc and the lines that stand for it, for libraries that know no arcs, mm.
pub const SAG: f64 = 0.005;

/// Steps of a millimeter for libraries that calculate with integers.
const GRID: f64 = 1_048_576.0;

/// A library at work: what it makes at a distance, in any direction of the loops.
pub type Levels<'a> = Box<dyn FnMut(f64) -> Vec<ArcSpline> + 'a>;

/// A library.
pub struct Peer {
    pub name: &'static str,
    /// Whether it keeps arcs; otherwise it gets lines.
    pub arcs: bool,
    /// Prepares the loops; what that takes counts.
    pub start: fn(&[ArcSpline]) -> Levels<'_>,
}

pub const PEERS: [Peer; 5] = [
    Peer { name: "medial", arcs: true, start: medial },
    Peer { name: "cavalier_contours", arcs: true, start: cavalier },
    Peer { name: "  level to level", arcs: true, start: cavalier_in_steps },
    Peer { name: "i_overlay", arcs: false, start: i_overlay },
    Peer { name: "clipper2", arcs: false, start: clipper },
];

fn medial(loops: &[ArcSpline]) -> Levels<'_> {
    let mat = || -> Result<medial::Mat, Error> {
        Pocket::from_loops(loops.to_vec(), Tolerance { fit: 0.0, join: 0.0 })?.medial_axis()
    };
    let mat = mat().expect("a pocket");
    Box::new(move |d| {
        let level = mat.level(d);
        level.loops.into_iter().chain(level.ridges).collect()
    })
}

fn polyline(spline: &ArcSpline) -> Polyline<f64> {
    let mut polyline = Polyline::new_closed();
    spline.vertices.iter().for_each(|v| polyline.add(v.point.x, v.point.y, v.bulge));
    polyline
}

fn spline(polyline: &Polyline<f64>) -> ArcSpline {
    ArcSpline::closed(polyline.iter_vertexes().map(|v| (v.x, v.y, v.bulge)))
}

fn splines(shape: &Shape<f64>) -> Vec<ArcSpline> {
    shape.ccw_plines.iter().chain(&shape.cw_plines).map(|p| spline(&p.polyline)).collect()
}

fn cavalier(loops: &[ArcSpline]) -> Levels<'_> {
    if let [only] = loops {
        let polyline = polyline(only);
        return Box::new(move |d| {
            let index = polyline.create_approx_aabb_index();
            let options = PlineOffsetOptions { aabb_index: Some(&index), ..PlineOffsetOptions::default() };
            polyline.parallel_offset_opt(d, &options).iter().map(spline).collect()
        });
    }
    let shape = Shape::from_plines(loops.iter().map(polyline));
    Box::new(move |d| splines(&shape.parallel_offset(d, &ShapeOffsetOptions::new())))
}

/// Each level from the one before it.
fn cavalier_in_steps(loops: &[ArcSpline]) -> Levels<'_> {
    let mut shape = Shape::from_plines(loops.iter().map(polyline));
    let mut before = 0.0;
    Box::new(move |d| {
        shape = shape.parallel_offset(d - before, &ShapeOffsetOptions::new());
        before = d;
        splines(&shape)
    })
}

/// Angle of the chords of a rounded corner.
fn chord_angle(d: f64) -> f64 {
    2.0 * (1.0 - (SAG / d).min(0.5)).acos()
}

fn i_overlay(loops: &[ArcSpline]) -> Levels<'_> {
    use i_overlay::mesh::outline::offset::OutlineOffset;
    use i_overlay::mesh::style::{LineJoin, OutlineStyle};
    let contour = |l: &ArcSpline| l.vertices.iter().map(|v| [v.point.x, v.point.y]).collect();
    let shape: Vec<Vec<[f64; 2]>> = loops.iter().map(contour).collect();
    Box::new(move |d| {
        let style = OutlineStyle::new(-d).line_join(LineJoin::Round(chord_angle(d)));
        let contours = shape.outline(&style).into_iter().flatten();
        contours.map(|c| ArcSpline::closed(c.into_iter().map(|[x, y]| (x, y, 0.0)))).collect()
    })
}

fn clipper(loops: &[ArcSpline]) -> Levels<'_> {
    use clipper2_rust::{EndType, JoinType, Paths64, Point64, inflate_paths_64};
    let place = |v: &medial::Vertex| {
        let grid = point(GRID * v.point.x, GRID * v.point.y);
        Point64::new(grid.x.round() as i64, grid.y.round() as i64)
    };
    let paths: Paths64 = loops.iter().map(|l| l.vertices.iter().map(place).collect()).collect();
    Box::new(move |d| {
        let inflated =
            inflate_paths_64(&paths, -d * GRID, JoinType::Round, EndType::Polygon, 2.0, SAG * GRID);
        let place = |p: &Point64| (p.x as f64 / GRID, p.y as f64 / GRID, 0.0);
        inflated.iter().map(|path| ArcSpline::closed(path.iter().map(place))).collect()
    })
}

/// Builds the Voronoi diagram of segments, from which no level is made; its number of edges.
pub fn voronoi(loops: &[ArcSpline]) -> Option<usize> {
    use boostvoronoi::prelude::Builder;
    let magnitude = loops.iter().map(|l| l.bounds().magnitude()).fold(0.0, f64::max);
    let scale = f64::from(1 << 30) / magnitude;
    let place = |p: medial::Point| [(p.x * scale).round() as i32, (p.y * scale).round() as i32];
    let ends = loops.iter().flat_map(ArcSpline::elements).map(|e| (place(e.start), place(e.end)));
    let segments: Vec<[i32; 4]> =
        ends.filter(|(a, b)| a != b).map(|(a, b)| [a[0], a[1], b[0], b[1]]).collect();
    let diagram = Builder::<i32>::default().with_segments(segments.iter()).ok()?.build().ok()?;
    Some(diagram.edges().len())
}
