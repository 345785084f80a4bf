//! Holds offsets by cavalier_contours and by i_overlay against the exact distance, as a regression test of
//! either would.
//!
//!     cargo run --example judge_others

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use i_overlay::mesh::outline::offset::OutlineOffset;
use i_overlay::mesh::style::{LineJoin, OutlineStyle};
use medial::verify::{Boundary, chained};
use medial::{ArcSpline, point};

/// Largest distance between a circle and the lines that stand for it.
const SAG: f64 = 0.005;

/// With arcs: vertices are (x, y, bulge) there, too.
fn by_cavalier_contours(loops: &[ArcSpline], distance: f64) -> Vec<ArcSpline> {
    let polylines = loops.iter().map(|l| {
        let mut polyline = Polyline::new_closed();
        l.vertices.iter().for_each(|v| polyline.add(v.point.x, v.point.y, v.bulge));
        polyline
    });
    let offset = Shape::from_plines(polylines).parallel_offset(distance, &ShapeOffsetOptions::new());
    let polylines = offset.ccw_plines.iter().chain(&offset.cw_plines);
    polylines.map(|p| ArcSpline::closed(p.polyline.iter_vertexes().map(|v| (v.x, v.y, v.bulge)))).collect()
}

/// With lines alone, and round corners of lines.
fn by_i_overlay(loops: &[ArcSpline], distance: f64) -> Vec<ArcSpline> {
    let flattened = |l: &ArcSpline| -> Vec<[f64; 2]> {
        let places = l.elements().flat_map(|e| {
            let parts = if e.is_segment() { 1 } else { 64 };
            (0..parts).map(move |k| e.point_at(f64::from(k) / f64::from(parts)))
        });
        places.map(|p| [p.x, p.y]).collect()
    };
    let shape: Vec<Vec<[f64; 2]>> = loops.iter().map(flattened).collect();
    let angle = 2.0 * (1.0 - SAG / distance).acos();
    let style = OutlineStyle::new(-distance).line_join(LineJoin::Round(angle));
    let contours = shape.outline(&style).into_iter().flatten();
    contours.map(|c| ArcSpline::closed(c.into_iter().map(|[x, y]| (x, y, 0.0)))).collect()
}

fn main() {
    let plate = ArcSpline::closed([(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)]);
    let boss = ArcSpline::circle(point(22.0, 20.0), 8.0).reversed();
    let loops = [plate, boss];
    let boundary = Boundary::new(&loops);
    type Offset = fn(&[ArcSpline], f64) -> Vec<ArcSpline>;
    let programs: [(&str, Offset, f64); 2] =
        [("cavalier_contours", by_cavalier_contours, 1e-9), ("i_overlay", by_i_overlay, 2.0 * SAG)];
    for (name, offset, within) in programs {
        for distance in [1.0, 3.0, 6.0, 9.5] {
            // Loops may come in pieces, and in any direction.
            let loops = boundary.turned(&chained(&offset(&loops, distance), 0.0));
            let report = boundary.judge(distance, &loops, within);
            let verdict = if report.is_right() { "right" } else { "wrong" };
            let off = report.max_deviation;
            println!("{name} at {distance}: {verdict} within {within}, off by {off:.1e} at worst");
            for f in &report.faults {
                println!("    at {}: {}, by {:.4}, {:.3} long", f.at, f.kind, f.by, f.length);
            }
        }
    }
}
