//! Drawings written and read back: by this library, to the last bit, and by the crate `dxf`.

#![cfg(feature = "dxf")]

use medial::io::dxf::{self, Drawing, ReadOptions, Sheet};
use medial::{ArcSpline, Error, Job, Mat, Pocket, Pockets, Tolerance, Units};
use std::path::Path;

const SAMPLES: [&str; 8] = ["gear", "h-neck", "inch", "keyhole", "nested", "rect-island", "sharp", "slot"];

/// Pockets of a sample and the unit of the job.
fn sample(name: &str) -> (Vec<Pocket>, Units) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name).with_extension("dxf");
    let drawing = dxf::read(&path, &ReadOptions::default()).unwrap();
    let pockets = Pockets::from_curves(&drawing.curves, drawing.units.tolerance()).unwrap().pockets;
    (pockets, drawing.units)
}

/// A drawing with everything that a job of a tool makes.
fn written(pockets: &[Pocket], units: Units, tool: f64) -> Vec<u8> {
    let mats: Vec<Mat> = pockets.iter().map(|p| p.medial_axis().unwrap()).collect();
    let edges: Vec<_> = mats.iter().flat_map(Mat::edges).collect();
    let path = Job::new(units, tool, 0.4 * tool).path(&mats).unwrap();
    let mut text = Vec::new();
    Sheet::new(units)
        .pockets(pockets)
        .axis(&edges)
        .levels(path.pockets.iter().flat_map(|p| &p.levels))
        .path(&path.moves, units.tolerance().fit)
        .write(&mut text)
        .unwrap();
    text
}

fn layer(text: &[u8], name: &str) -> Result<Drawing, Error> {
    let options = ReadOptions { layers: vec![name.into()], ..ReadOptions::default() };
    dxf::read_bytes(text, "part.dxf", &options)
}

/// The vertices of a closed loop as bits, beginning at the smallest.
fn bits(spline: &ArcSpline) -> Vec<[u64; 3]> {
    assert!(spline.closed);
    let mut bits: Vec<[u64; 3]> =
        spline.vertices.iter().map(|v| [v.point.x, v.point.y, v.bulge].map(f64::to_bits)).collect();
    let first = (0..bits.len()).min_by_key(|&i| bits[i]).unwrap();
    bits.rotate_left(first);
    bits
}

/// All loops of all pockets, pocket by pocket, islands in the order of their bits.
fn loops(pockets: &[Pocket]) -> Vec<Vec<Vec<[u64; 3]>>> {
    let mut all: Vec<Vec<Vec<[u64; 3]>>> = pockets
        .iter()
        .map(|p| {
            let mut islands: Vec<_> = p.islands().iter().map(bits).collect();
            islands.sort();
            [vec![bits(p.outer())], islands].concat()
        })
        .collect();
    all.sort();
    all
}

fn reads_back(pockets: &[Pocket], units: Units, text: &[u8]) {
    let back = layer(text, "BOUNDARY").unwrap();
    assert_eq!(back.units, units);
    let found = Pockets::from_curves(&back.curves, units.tolerance()).unwrap();
    assert!(found.defects.is_empty(), "{:?}", found.defects);
    assert_eq!(loops(&found.pockets), loops(pockets));
}

#[test]
fn boundaries_of_all_samples_read_back_to_the_last_bit() {
    for name in SAMPLES {
        let (pockets, units) = sample(name);
        let tool = if units == Units::Inch { 0.05 } else { 1.0 };
        reads_back(&pockets, units, &written(&pockets, units, tool));
    }
}

#[test]
fn numbers_with_all_their_digits_read_back_at_any_size_and_place() {
    for (scale, x) in [(1.0, 0.0), (1e-3, 0.0), (1e3, 0.0), (1.0, 1e6), (7.3e-4, -3e2)] {
        let turned = |r: f64, lobes: u32| {
            let vertex = |i: u32| {
                let (sin, cos) = (f64::from(i) / f64::from(lobes) * std::f64::consts::TAU).sin_cos();
                let far = r * (1.0 + 0.3 * f64::from(i % 2));
                (x + scale * far * cos, scale * far * sin, 0.11 * f64::from(i % 3))
            };
            ArcSpline::closed((0..lobes).map(vertex))
        };
        let tolerance = Tolerance { fit: 1e-3 * scale, join: 1e-4 * scale };
        let loops = vec![turned(20.0, 14), turned(7.0, 8).reversed()];
        let pocket = Pocket::from_loops(loops, tolerance).unwrap();
        let mut text = Vec::new();
        Sheet::new(Units::Mm).pockets([&pocket]).write(&mut text).unwrap();
        let back = layer(&text, "BOUNDARY").unwrap();
        let found = Pockets::from_curves(&back.curves, tolerance).unwrap();
        assert_eq!(self::loops(&found.pockets), self::loops(&[pocket]));
    }
}

#[test]
fn offsets_read_back_as_the_level_sets_that_they_are() {
    let (pockets, units) = sample("rect-island");
    let mat = pockets[0].medial_axis().unwrap();
    let level = mat.level(2.0);
    let mut text = Vec::new();
    Sheet::new(units).levels([&level]).write(&mut text).unwrap();
    let back = layer(&text, "OFFSETS").unwrap();
    let read: Vec<_> = back.curves.iter().map(|c| bits(&c.path)).collect();
    assert_eq!(read, level.loops.iter().map(bits).collect::<Vec<_>>());
}

#[test]
fn the_crate_dxf_reads_every_entity_with_its_layer() {
    let (pockets, units) = sample("keyhole");
    let text = written(&pockets, units, 6.0);
    let drawing = ::dxf::Drawing::load(&mut &text[..]).unwrap();
    assert_eq!(drawing.header.default_drawing_units, ::dxf::enums::Units::Millimeters);
    let count = |layer: &str| drawing.entities().filter(|e| e.common.layer == layer).count();
    assert_eq!(count("BOUNDARY"), pockets.iter().map(|p| p.loops().count()).sum::<usize>());
    let edges = pockets.iter().map(|p| p.medial_axis().unwrap().counts().edges);
    assert_eq!(count("MEDIAL_AXIS"), edges.sum::<usize>());
    for layer in ["OFFSETS", "TOOLPATH", "TOOLPATH_ENTRY", "TOOLPATH_RAPID"] {
        assert!(count(layer) > 0, "{layer}");
        assert!(drawing.layers().any(|l| l.name == layer));
    }
}

#[test]
fn edges_of_the_axis_are_lines_or_exact_conics() {
    let (pockets, units) = sample("keyhole");
    let edges: Vec<_> = pockets.iter().flat_map(|p| p.medial_axis().unwrap().edges()).collect();
    let drawing = ::dxf::Drawing::load(&mut &written(&pockets, units, 6.0)[..]).unwrap();
    let axis = drawing.entities().filter(|e| e.common.layer == "MEDIAL_AXIS");
    let mut splines = 0;
    for (entity, edge) in axis.zip(&edges) {
        match &entity.specific {
            ::dxf::entities::EntityType::Line(line) => {
                assert!(edge.is_straight());
                assert_eq!([line.p1.x, line.p1.y], [edge.points[0].x, edge.points[0].y]);
                assert_eq!([line.p2.x, line.p2.y], [edge.points[2].x, edge.points[2].y]);
            }
            ::dxf::entities::EntityType::Spline(spline) => {
                splines += 1;
                let points: Vec<_> = spline.control_points.iter().map(|p| (p.x, p.y)).collect();
                assert_eq!(points, edge.points.map(|p| (p.x, p.y)));
                assert_eq!(spline.weight_values, [1.0, edge.weight, 1.0]);
                assert_eq!(spline.knot_values, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(splines > 0 && splines < edges.len());
}

#[test]
fn what_is_not_finite_is_an_error_and_not_a_drawing() {
    let level = medial::Level {
        distance: 1.0,
        loops: vec![ArcSpline::closed([(f64::NAN, 0.0, 0.0); 3])],
        ridges: vec![],
    };
    let error = Sheet::new(Units::Mm).levels([&level]).write(&mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
}
