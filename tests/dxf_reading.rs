//! DXF drawings from the outside: the samples, and everything that a file may do wrong.

#![cfg(feature = "dxf")]

#[path = "../examples/samples.rs"]
#[allow(dead_code)]
mod samples;

use medial::io::DrawingUnit;
use medial::io::dxf::{Drawing, Origin, ReadOptions, read, read_bytes};
use medial::{ArcSpline, Error, Point, Units, point};
use std::f64::consts::PI;
use std::path::Path;

fn sample(name: &str) -> Drawing {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name);
    read(&path, &ReadOptions::default()).unwrap()
}

/// A file of `code value` pairs, separated by semicolons.
fn file(pairs: &str) -> String {
    let lines = pairs.split(';').map(str::trim);
    lines
        .map(|pair| pair.split_once(' ').map_or(format!("{pair}\n\n"), |(c, v)| format!("{c}\n{v}\n")))
        .collect()
}

/// A file in millimeters with these entities.
fn drawing(entities: &str) -> String {
    file(&format!(
        "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC; 0 SECTION; 2 ENTITIES; {entities}; 0 ENDSEC; 0 EOF"
    ))
}

fn read_text(text: &str, options: &ReadOptions) -> Drawing {
    read_bytes(text.as_bytes(), "test.dxf", options).unwrap()
}

fn read_entities(entities: &str) -> Drawing {
    read_text(&drawing(entities), &ReadOptions::default())
}

fn refusal(bytes: &[u8]) -> String {
    match read_bytes(bytes, "test.dxf", &ReadOptions::default()) {
        Err(Error::NotADrawing { path, reason }) if path == "test.dxf" => reason,
        other => panic!("{other:?}"),
    }
}

fn messages(drawing: &Drawing) -> Vec<String> {
    drawing.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn the_samples_are_what_the_example_writes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    let mut there: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".dxf"))
        .collect();
    there.sort();
    let files = samples::files();
    let mut written: Vec<&str> = files.iter().map(|&(name, _)| name).collect();
    written.sort();
    assert_eq!(there, written);
    for (name, text) in files {
        // Line ends may have been changed by a checkout.
        let stored = std::fs::read_to_string(folder.join(name)).unwrap().replace('\r', "");
        assert_eq!(stored, text, "{name}: run `cargo run --example samples`");
    }
}

#[test]
fn every_sample_is_read_whole_and_states_its_point() {
    for (name, text) in samples::files() {
        assert!(text.starts_with("999\n"), "{name}");
        let drawing = sample(name);
        assert_eq!(drawing.name, name);
        assert_eq!(drawing.units, if name == "inch.dxf" { Units::Inch } else { Units::Mm });
        assert_eq!(messages(&drawing), [""; 0], "{name}");
        let bounds = drawing.curves.iter().map(|c| c.path.bounds()).reduce(|a, b| a.union(b)).unwrap();
        let (size, unit) = (bounds.max - bounds.min, if drawing.units == Units::Inch { 25.4 } else { 1.0 });
        let longer = size.x.max(size.y) * unit;
        assert!((30.0..=130.0).contains(&longer), "{name} is {longer} mm long");
    }
}

#[test]
fn a_slot_comes_as_it_was_drawn() {
    let slot = sample("slot.dxf");
    let wanted = ArcSpline::closed([(6.0, 0.0, 0.0), (54.0, 0.0, 1.0), (54.0, 12.0, 0.0), (6.0, 12.0, 1.0)]);
    assert_eq!(slot.curves[0].path, wanted);
    assert_eq!(&*slot.curves[0].source.kind, "POLYLINE");
}

#[test]
fn arcs_meet_lines_to_the_last_bit_at_quarters() {
    let d = read_entities(
        "0 ARC; 5 A1; 8 Cut; 10 5; 20 5; 40 2.5; 50 90; 51 180; 0 LINE; 10 2.5; 20 5; 11 2.5; 21 0;
         0 CIRCLE; 10 1; 20 2; 40 3",
    );
    let [arc, line, circle] = &d.curves[..] else { panic!("{d:?}") };
    assert_eq!(arc.path.vertices[1].point, line.path.vertices[0].point);
    assert_eq!((arc.source.handle, &*arc.source.layer), (Some(0xA1), "Cut"));
    assert_eq!((line.source.handle, &*line.source.layer), (None, "0"));
    assert_eq!(circle.path, ArcSpline::circle(point(1.0, 2.0), 3.0));
}

#[test]
fn arcs_that_share_an_angle_meet_to_the_last_bit() {
    let mut meetings = 0;
    for i in 0..100 {
        let angle = 7.3 + 3.1 * f64::from(i);
        let (before, after) = (angle - 33.7, angle + 207.9);
        let d = read_entities(&format!(
            "0 ARC; 10 5.1; 20 7.3; 40 2.7; 50 {before}; 51 {angle}; 0 ARC; 10 5.1; 20 7.3; 40 2.7; 50 {angle}; 51 {after}"
        ));
        meetings += usize::from(ends(&d.curves[0].path)[1] == ends(&d.curves[1].path)[0]);
    }
    assert_eq!(meetings, 100);
}

#[test]
fn light_and_heavy_polylines_are_the_same() {
    let d = read_entities(
        "0 LWPOLYLINE; 90 3; 70 1; 10 0; 20 0; 10 4; 20 0; 42 0.5; 10 4; 20 3;
         0 POLYLINE; 66 1; 10 0; 20 0; 30 0; 70 1; 0 VERTEX; 10 0; 20 0; 0 VERTEX; 10 4; 20 0; 42 0.5;
         0 VERTEX; 10 4; 20 3; 0 SEQEND",
    );
    assert_eq!(d.curves[0].path, ArcSpline::closed([(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 3.0, 0.0)]));
    assert_eq!(d.curves[0].path, d.curves[1].path);
}

#[test]
fn the_job_has_the_unit_of_the_drawing() {
    let entity = "0 SECTION; 2 ENTITIES; 0 CIRCLE; 10 1; 20 2; 40 3; 0 ENDSEC; 0 EOF";
    let with = |variables: &str, options: &ReadOptions| {
        let text = file(&format!("0 SECTION; 2 HEADER; {variables}; 0 ENDSEC; {entity}"));
        let d = read_text(&text, options);
        let x = d.curves[0].path.bounds().max.x;
        let assumed = d.warnings.iter().filter(|w| w.kind() == "unit-assumed").count();
        (d.units, x, assumed)
    };
    let none = ReadOptions::default();
    assert_eq!(with("9 $INSUNITS; 70 4", &none), (Units::Mm, 4.0, 0));
    assert_eq!(with("9 $INSUNITS; 70 5", &none), (Units::Mm, 40.0, 0));
    assert_eq!(with("9 $INSUNITS; 70 1", &none), (Units::Inch, 4.0, 0));
    assert_eq!(with("9 $INSUNITS; 70 2", &none), (Units::Inch, 48.0, 0));
    assert_eq!(with("9 $INSUNITS; 70 9", &none), (Units::Inch, 0.004, 0));
    // Nothing said: the flag, else millimeters, with a warning.
    assert_eq!(with("9 $INSUNITS; 70 0; 9 $MEASUREMENT; 70 0", &none), (Units::Inch, 4.0, 1));
    assert_eq!(with("9 $MEASUREMENT; 70 1", &none), (Units::Mm, 4.0, 1));
    assert_eq!(with("9 $INSUNITS; 70 255", &none), (Units::Mm, 4.0, 1));
    // Wishes of the user.
    let in_mm = ReadOptions { units: Some(Units::Mm), ..ReadOptions::default() };
    assert_eq!(with("9 $INSUNITS; 70 1", &in_mm), (Units::Mm, 4.0 * 25.4, 0));
    let in_inches = ReadOptions { units: Some(Units::Inch), ..ReadOptions::default() };
    assert_eq!(with("9 $MEASUREMENT; 70 1", &in_inches), (Units::Inch, 4.0, 0));
    let really_mm = ReadOptions { dxf_units: Some(DrawingUnit::Millimeter), ..ReadOptions::default() };
    assert_eq!(with("9 $INSUNITS; 70 1", &really_mm), (Units::Mm, 4.0, 0));
}

#[test]
fn what_is_not_read_is_counted_by_kind() {
    let d = read_entities(
        "0 SOLID; 10 0; 8 Cut; 0 SOLID; 40 x; 8 Cut; 0 TEXT; 1 hello; 0 HATCH; 10 x; 0 MYSTERY;
         0 POLYLINE; 70 64; 0 VERTEX; 10 0; 20 0; 0 SEQEND; 0 LINE; 10 0; 20 0; 11 1; 21 0; 230 -1",
    );
    assert_eq!(d.curves.len(), 1, "a line is drawn in world coordinates in any case");
    assert_eq!(
        messages(&d),
        [
            "HATCH: 1 skipped, no outline",
            "MYSTERY: 1 skipped, no outline",
            "POLYLINE, mesh: 1 on layer `0` not read",
            "SOLID: 2 on layer `Cut` not read",
            "TEXT: 1 skipped, no outline",
        ]
    );
}

#[test]
fn one_broken_entity_does_not_cost_the_others() {
    let good = "0 CIRCLE; 10 1; 20 2; 40 3";
    for (broken, reason) in [
        ("0 CIRCLE; 5 2B; 10 1; 20 2; 40 nan", "`nan` is no finite number"),
        ("0 CIRCLE; 5 2B; 10 1e400; 20 2; 40 3", "`1e400` is no finite number"),
        ("0 CIRCLE; 5 2B; 10 1e300; 20 2; 40 3", "too large"),
        ("0 CIRCLE; 5 2B; 10 1; 20 2; 40 -3", "radius is -3"),
        ("0 CIRCLE; 5 2B; 10 12,5mm; 20 2; 40 3", "`12,5mm`"),
        ("0 CIRCLE; 5 2B; 10; 20 2; 40 3", "a number is missing"),
        ("0 LINE; 5 2B; 10 1; 20 2; 11 3", "group 21 is missing"),
        ("0 LINE; 5 2B; 10 1; 20 2; 30 0; 11 1; 21 2; 31 9", "no length"),
        ("0 ARC; 5 2B; 10 1; 20 2; 40 3; 50 90; 51 90", "same angle"),
        ("0 LWPOLYLINE; 5 2B; 90 1; 70 1; 10 1; 20 2", "fewer than two"),
        ("0 ELLIPSE; 5 2B; 10 1; 20 2; 11 3; 21 0; 40 0", "flat"),
        ("0 SPLINE; 5 2B; 71 3; 10 1; 20 2; 10 5; 20 2", "control points"),
        ("0 INSERT; 5 2B; 2 NONE; 10 1; 20 2", "no block `NONE`"),
        ("0 CIRCLE; 5 2B; 10 1; 20 2; 40 3; 230 0", "extrusion direction"),
    ] {
        let d = read_entities(&format!("{good}; {broken}; {good}"));
        assert_eq!(d.curves.len(), 2, "{broken}");
        assert_eq!(d.warnings.len(), 1, "{broken}");
        let message = &messages(&d)[0];
        assert!(message.contains(" 2B (line ") && message.contains(reason), "{message}");
    }
}

#[test]
fn the_line_of_a_number_that_is_none_is_told() {
    let d = read_entities("0 CIRCLE; 10 1; 20 2; 40 0x3; 0 LINE; 10 1; 20 2; 11 7; 21 x");
    assert_eq!(d.curves, []);
    let at = "0\nCIRCLE\n10\n1\n20\n2\n40\n";
    let line = drawing("0 CIRCLE; 10 1; 20 2; 40 0x3").split(at).next().unwrap().lines().count() + 7;
    assert_eq!(messages(&d)[0], format!("CIRCLE (line {line}) skipped: `0x3` is no finite number"));
    assert_eq!(d.warnings[1].at(), Some(point(1.0, 2.0)));
}

#[test]
fn faults_of_form_are_mended_and_named() {
    let circle = "0 CIRCLE; 10 1,5; 20 2.0D+00; 40 3";
    let d = read_entities(circle);
    assert_eq!(d.curves[0].path, ArcSpline::circle(point(1.5, 2.0), 3.0));
    assert!(messages(&d)[0].contains("decimal comma") && messages(&d)[0].contains(": 2, the first in line"));
    for (text, mend) in [
        (drawing(circle_at_1_2()).replace("10\n1\n", "\n\n10\n1\n"), "blank lines"),
        (file(&format!("{}; 0 EOF", circle_at_1_2())), "outside of any section"),
        (
            drawing(&format!("0 VERTEX; 10 3; 20 4; 0 SEQEND; {}", circle_at_1_2())),
            "vertices without a polyline",
        ),
        (
            drawing(&format!(
                "0 POLYLINE; 70 1; 0 VERTEX; 10 9; 20 9; 0 VERTEX; 10 8; 20 7; {}",
                circle_at_1_2()
            )),
            "without SEQEND",
        ),
        (
            drawing(&format!("0 LWPOLYLINE; 90 2000000000; 10 9; 20 9; 10 8; 20 7; {}", circle_at_1_2())),
            "than they say",
        ),
        (drawing(&format!("0 SECTION; 2 ENTITIES; {}", circle_at_1_2())), "before the last one has ended"),
        (
            drawing(circle_at_1_2()).replace("0\nEOF\n", "AcDbTail\n"),
            "without a group code after the entities",
        ),
        (drawing(&circle_at_1_2().replace("CIRCLE", "CIRCLE; 8 Ma\u{1}")).replace('\u{1}', "\u{df}"), ""),
    ] {
        let d = read_text(&text, &ReadOptions::default());
        assert_eq!(d.curves.last().unwrap().path, ArcSpline::circle(point(1.0, 2.0), 3.0), "{mend}");
        assert!(messages(&d).iter().any(|m| m.contains(mend)) || mend.is_empty(), "{:?}", messages(&d));
    }
    // Latin-1 in a name, NUL bytes, a mark at the end of the file.
    let mut bytes = drawing("0 CIRCLE; 8 Ma\u{1}; 10 1\0; 20 2; 40 3").into_bytes();
    bytes.iter_mut().filter(|b| **b == 1).for_each(|b| *b = 0xDF);
    bytes.push(0x1A);
    let d = read_bytes(&bytes, "test.dxf", &ReadOptions::default()).unwrap();
    assert_eq!(&*d.curves[0].source.layer, "Maß");
    assert!(messages(&d)[0].contains("code page"));
}

fn circle_at_1_2() -> &'static str {
    "0 CIRCLE; 10 1; 20 2; 40 3"
}

#[test]
fn a_file_that_breaks_off_keeps_what_is_whole() {
    let text = drawing("0 CIRCLE; 10 1; 20 2; 40 3; 0 CIRCLE; 10 1; 20 2; 40 35.5");
    let cut = text.split(".5").next().unwrap();
    let d = read_text(cut, &ReadOptions::default());
    assert_eq!(d.curves.len(), 1);
    assert!(
        messages(&d)[0].contains("without its end mark") && messages(&d)[1].contains("the file ends in it")
    );
}

#[test]
fn layers_off_or_frozen_are_left_out_and_named() {
    let text = file(
        "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC;
         0 SECTION; 2 TABLES; 0 TABLE; 2 LAYER; 0 LAYER; 2 Off; 70 0; 62 -3; 0 LAYER; 2 Ice; 70 1; 62 3; 0 ENDTAB;
         0 TABLE; 2 DIMSTYLE; 0 DIMSTYLE; 2 STANDARD; 5 TERMINATOROPEN; 0 ENDTAB; 0 ENDSEC;
         0 SECTION; 2 ENTITIES; 0 CIRCLE; 8 OFF; 10 1; 20 2; 40 3; 0 CIRCLE; 8 Ice; 10 1; 20 2; 40 3;
         0 CIRCLE; 8 0; 10 1; 20 2; 40 3; 0 CIRCLE; 67 1; 10 1; 20 2; 40 3; 0 ENDSEC; 0 EOF",
    );
    let d = read_text(&text, &ReadOptions::default());
    assert_eq!(d.curves.len(), 1);
    assert_eq!(
        messages(&d),
        [
            "layer `Ice` is frozen: 1 skipped",
            "layer `OFF` is off: 1 skipped",
            "entities of paper space: 1 skipped",
        ]
    );
    let only = ReadOptions { layers: vec!["o*".into()], hidden: true, ..ReadOptions::default() };
    assert_eq!(&*read_text(&text, &only).curves[0].source.layer, "OFF");
    let without = ReadOptions { skip_layers: vec!["ice".into()], hidden: true, ..ReadOptions::default() };
    assert_eq!(read_text(&text, &without).curves.len(), 2);
}

/// Blocks, each a name with a base point and entities, and what the model space holds.
fn with_blocks(blocks: &[(&str, &str, &str)], entities: &str) -> Drawing {
    let blocks: Vec<String> = blocks
        .iter()
        .map(|(name, head, entities)| format!("0 BLOCK; 8 0; 2 {name}; 70 0; {head}; {entities}; 0 ENDBLK"))
        .collect();
    let text = format!(
        "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC; 0 SECTION; 2 TABLES; 0 LAYER; 2 Cut; 70 0; 62 3;
         0 LAYER; 2 Off; 70 0; 62 -1; 0 LAYER; 2 Ice; 70 1; 62 1; 0 ENDSEC;
         0 SECTION; 2 BLOCKS; {}; 0 ENDSEC; 0 SECTION; 2 ENTITIES; {entities}; 0 ENDSEC; 0 EOF",
        blocks.join("; ")
    );
    read_text(&file(&text), &ReadOptions::default())
}

const ORIGIN: &str = "10 0; 20 0; 30 0";

/// A quarter of a circle with its two radii, at the origin.
const QUARTER: &str =
    "0 LINE; 10 0; 20 0; 11 2; 21 0; 0 ARC; 10 0; 20 0; 40 2; 50 0; 51 90; 0 LINE; 10 0; 20 2; 11 0; 21 0";

fn ends(path: &ArcSpline) -> [(f64, f64); 2] {
    [path.vertices[0].point, path.vertices[path.vertices.len() - 1].point].map(|p| (p.x, p.y))
}

#[test]
fn blocks_are_placed_turned_scaled_and_mirrored() {
    for (insert, line_end, arc_end) in [
        ("10 10; 20 5", (12.0, 5.0), (10.0, 7.0)),
        ("10 10; 20 5; 50 90", (10.0, 7.0), (8.0, 5.0)),
        ("10 10; 20 5; 41 3; 42 3; 43 3", (16.0, 5.0), (10.0, 11.0)),
        ("10 10; 20 5; 41 -1", (8.0, 5.0), (10.0, 7.0)),
        ("10 10; 20 5; 42 -1; 50 -90", (10.0, 3.0), (8.0, 5.0)),
        ("10 10; 20 5; 230 -1", (-12.0, 5.0), (-10.0, 7.0)),
    ] {
        let d = with_blocks(&[("Q", ORIGIN, QUARTER)], &format!("0 INSERT; 2 q; {insert}"));
        let [first, arc, last] = &d.curves[..] else { panic!("{d:?}") };
        assert_eq!(ends(&first.path)[1], line_end, "{insert}");
        assert_eq!(ends(&arc.path), [line_end, arc_end], "{insert}");
        assert_eq!(ends(&last.path)[0], arc_end, "{insert}");
        let center = ends(&last.path)[1];
        let (found, radius) = arc.path.element(0).center().unwrap();
        assert!(found.distance(point(center.0, center.1)) < 1e-14, "{insert}");
        assert!((radius - found.distance(point(line_end.0, line_end.1))).abs() < 1e-14);
        assert_eq!(messages(&d), [""; 0]);
    }
}

#[test]
fn blocks_lie_in_blocks_with_base_points_and_arrays() {
    let d = with_blocks(
        &[
            ("HOLE", "10 5; 20 5; 30 0", "0 CIRCLE; 10 6; 20 5; 40 1"),
            ("ROW", ORIGIN, "0 INSERT; 2 HOLE; 10 0; 20 0; 70 3; 44 10; 71 2; 45 20"),
        ],
        "0 INSERT; 2 ROW; 66 1; 10 100; 20 0; 50 90; 41 2; 42 2; 0 ATTRIB; 1 text; 0 SEQEND",
    );
    let centers: Vec<_> = d.curves.iter().map(|c| c.path.bounds().center()).map(|p| (p.x, p.y)).collect();
    let wanted = [(100.0, 2.0), (100.0, 22.0), (100.0, 42.0), (60.0, 2.0), (60.0, 22.0), (60.0, 42.0)];
    assert_eq!(centers, wanted);
    assert_eq!(messages(&d), [""; 0]);
}

#[test]
fn circles_in_stretched_blocks_are_ellipses() {
    let d = with_blocks(
        &[("C", ORIGIN, "0 CIRCLE; 8 Cut; 10 0; 20 0; 40 2; 0 LINE; 10 0; 20 0; 11 1; 21 1")],
        "0 INSERT; 2 C; 10 10; 20 0; 41 3; 42 0.5",
    );
    assert_eq!(ends(&d.curves[0].path), [(10.0, 0.0), (13.0, 0.5)]);
    let (path, area) = (&d.curves[1].path, PI * 6.0 * 1.0);
    assert!(path.closed && (path.area() - area).abs() < 0.001 * path.length(), "{d:?}");
    assert!(d.free.is_empty() && d.fitted.curves == 1 && d.fitted.bound <= 0.001);
    assert_eq!(messages(&d), [""; 0]);
}

#[test]
fn ellipses_and_splines_become_arcs_within_the_tolerance() {
    let d = read_entities(
        "0 ELLIPSE; 8 Rim; 10 1; 20 2; 11 4; 21 0; 40 0.5; 41 0; 42 1.5;
         0 SPLINE; 8 Rim; 70 8; 71 2; 40 0; 40 0; 40 0; 40 1; 40 1; 40 1; 10 0; 20 0; 10 2; 20 4; 10 4; 20 0",
    );
    assert_eq!(messages(&d), [""; 0]);
    let off = |p: Point, i: usize| {
        let path = &d.curves[i].path;
        path.elements().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min)
    };
    for t in (0..=30).map(|i| f64::from(i) / 30.0) {
        let (sin, cos) = (1.5 * t).sin_cos();
        let parabola = point(4.0 * t, 8.0 * t * (1.0 - t));
        assert!(off(point(1.0 + 4.0 * cos, 2.0 + 2.0 * sin), 0) <= 0.001 && off(parabola, 1) <= 0.001);
    }
    assert!(d.fitted.bound <= 0.001 && d.fitted.elements < 100);
}

#[test]
fn what_cannot_be_fitted_is_named_and_the_rest_goes_on() {
    let d = read_entities(
        "0 SPLINE; 5 2A; 70 8; 71 1; 40 0; 40 0; 40 1; 40 1; 40 2; 40 2; 10 0; 20 0; 10 2; 20 0; 10 2; 20 9; 10 4; 20 0;
         0 CIRCLE; 10 0; 20 0; 40 1",
    );
    assert_eq!((d.curves.len(), d.free.len(), d.fitted.curves), (1, 1, 0));
    assert_eq!(messages(&d), ["SPLINE 2A skipped: the spline jumps by 9.0000 at (2, 0)"]);
}

#[test]
fn blocks_that_hold_themselves_are_named_and_end() {
    let circle = "0 CIRCLE; 10 0; 20 0; 40 2";
    let d = with_blocks(
        &[
            ("A", ORIGIN, &format!("{circle}; 0 INSERT; 2 B; 10 9; 20 0")),
            ("B", ORIGIN, &format!("{circle}; 0 INSERT; 5 7F; 2 A; 10 0; 20 9")),
        ],
        "0 INSERT; 2 A; 10 0; 20 0",
    );
    assert_eq!(d.curves.len(), 2);
    assert!(messages(&d)[0].starts_with("INSERT 7F (line "), "{:?}", messages(&d));
    assert!(messages(&d)[0].ends_with("skipped: block `A` holds itself"));
}

#[test]
fn nests_may_be_of_any_depth() {
    let names: Vec<String> = (0..3000).map(|i| format!("B{i}")).collect();
    let inserts: Vec<String> = (0..3000).map(|i| format!("0 INSERT; 2 B{}; 10 1; 20 0", i + 1)).collect();
    let mut blocks: Vec<(&str, &str, &str)> =
        names.iter().zip(&inserts).map(|(name, insert)| (name.as_str(), ORIGIN, insert.as_str())).collect();
    blocks.push(("B3000", ORIGIN, "0 CIRCLE; 10 0; 20 0; 40 2"));
    let d = with_blocks(&blocks, "0 INSERT; 2 B0; 10 0; 20 0");
    assert_eq!(d.curves[0].path, ArcSpline::circle(point(3000.0, 0.0), 2.0));
}

#[test]
fn blocks_that_multiply_without_end_are_refused() {
    let tenfold = "0 INSERT; 2 NEXT; 10 1; 20 0; 70 32767; 71 32767";
    let text = file(&format!(
        "0 SECTION; 2 BLOCKS; 0 BLOCK; 2 NEXT; {ORIGIN}; 0 CIRCLE; 10 0; 20 0; 40 1; 0 ENDBLK; 0 ENDSEC;
         0 SECTION; 2 ENTITIES; {tenfold}; 0 ENDSEC; 0 EOF"
    ));
    match read_bytes(text.as_bytes(), "test.dxf", &ReadOptions::default()) {
        Err(Error::Effort { what, needed, .. }) => {
            assert!(what.contains("blocks") && needed > 32767 * 32767);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_lies_in_a_block_takes_layer_and_color_of_the_insert() {
    let blocks = [("B", ORIGIN, "0 CIRCLE; 8 0; 62 0; 10 0; 20 0; 40 1; 0 CIRCLE; 8 Own; 10 5; 20 0; 40 1")];
    let text = |insert: &str| {
        let (name, base, entities) = blocks[0];
        file(&format!(
            "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC; 0 SECTION; 2 TABLES; 0 LAYER; 2 Ice; 70 1; 62 1;
             0 LAYER; 2 Off; 62 -1; 0 LAYER; 2 Own; 62 5; 0 ENDSEC; 0 SECTION; 2 BLOCKS; 0 BLOCK; 2 {name}; {base}; {entities};
             0 ENDBLK; 0 ENDSEC; 0 SECTION; 2 ENTITIES; {insert}; 0 ENDSEC; 0 EOF"
        ))
    };
    let layers = |insert: &str, options: &ReadOptions| -> Vec<String> {
        let d = read_text(&text(insert), options);
        d.curves.iter().map(|c| c.source.layer.to_string()).collect()
    };
    let all = ReadOptions::default();
    assert_eq!(layers("0 INSERT; 8 Cut; 62 3; 2 B; 10 0; 20 0", &all), ["Cut", "Own"]);
    assert_eq!(layers("0 INSERT; 8 Off; 2 B; 10 0; 20 0", &all), ["Own"], "off hides what lies on layer 0");
    assert!(layers("0 INSERT; 8 Ice; 2 B; 10 0; 20 0", &all).is_empty(), "frozen hides everything");
    assert!(layers("0 INSERT; 8 Cut; 60 1; 2 B; 10 0; 20 0", &all).is_empty());
    assert!(layers("0 INSERT; 8 Cut; 67 1; 2 B; 10 0; 20 0", &all).is_empty());
    let colored =
        |color: &str| ReadOptions { colors: vec![color.parse().unwrap()], ..ReadOptions::default() };
    assert_eq!(layers("0 INSERT; 8 Cut; 62 3; 2 B; 10 0; 20 0", &colored("green")), ["Cut"]);
    assert_eq!(layers("0 INSERT; 8 Cut; 62 3; 2 B; 10 0; 20 0", &colored("blue")), ["Own"]);
}

#[test]
fn mirrored_systems_meet_what_is_drawn_in_the_world() {
    let d = read_entities(
        "0 ARC; 10 5; 20 5; 40 2; 50 0; 51 90; 230 -1; 0 LINE; 10 -7; 20 5; 11 -5; 21 7;
         0 LWPOLYLINE; 90 2; 70 1; 10 0; 20 0; 42 1; 10 4; 20 0; 42 0; 210 0; 220 0; 230 -1",
    );
    assert_eq!(ends(&d.curves[0].path), ends(&d.curves[1].path));
    assert_eq!(d.curves[2].path, ArcSpline::closed([(0.0, 0.0, -1.0), (-4.0, 0.0, 0.0)]));
    assert_eq!(messages(&d), [""; 0]);
}

#[test]
fn what_is_not_flat_is_flattened_and_named() {
    let d = read_entities(
        "0 LINE; 5 A; 10 0; 20 0; 30 5; 11 3; 21 0; 31 6; 0 CIRCLE; 5 B; 39 2; 10 0; 20 0; 40 3;
         0 LWPOLYLINE; 5 C; 43 0.5; 90 2; 10 0; 20 0; 10 4; 20 0; 0 LWPOLYLINE; 5 D; 38 7; 90 2; 10 0; 20 0; 10 4; 20 0;
         0 POLYLINE; 5 E; 70 8; 0 VERTEX; 10 0; 20 0; 30 1; 70 32; 0 VERTEX; 10 4; 20 0; 30 1; 70 32; 0 SEQEND;
         0 LWPOLYLINE; 5 F; 90 2; 10 0; 20 0; 10 0; 20 10; 210 0; 220 -0.6; 230 0.8",
    );
    assert_eq!(d.curves.len(), 6);
    assert_eq!(ends(&d.curves[0].path), [(0.0, 0.0), (3.0, 0.0)]);
    let [(x0, y0), (x1, y1)] = ends(&d.curves[5].path);
    assert_eq!((x0, y0, x1), (0.0, 0.0, 0.0));
    assert!((y1 - 8.0).abs() < 1e-14, "a slope is seen shorter");
    let told: Vec<(String, String)> = messages(&d)
        .iter()
        .map(|m| {
            let (who, what) = m.split_once(": ").unwrap();
            (who.split(" (").next().unwrap().to_owned(), what.to_owned())
        })
        .collect();
    let height = "its height or thickness is ignored";
    let wanted = [
        ("CIRCLE B", height),
        ("LINE A", height),
        ("LWPOLYLINE F", "it is tilted and seen from above"),
        ("LWPOLYLINE D", height),
        ("LWPOLYLINE C", "its width is ignored, its center line counts"),
        ("POLYLINE E", height),
    ];
    assert_eq!(told.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect::<Vec<_>>(), wanted);
}

#[test]
fn fitted_polylines_follow_their_curve() {
    let d = read_entities(
        "0 POLYLINE; 70 4; 0 VERTEX; 10 0; 20 0; 70 8; 0 VERTEX; 10 1; 20 9; 70 16; 0 VERTEX; 10 2; 20 3; 70 8;
         0 VERTEX; 10 4; 20 0; 70 8; 0 SEQEND;
         0 POLYLINE; 70 3; 0 VERTEX; 10 0; 20 0; 42 0.5; 70 1; 0 VERTEX; 10 4; 20 0; 42 0.25; 0 SEQEND",
    );
    assert_eq!(d.curves[0].path, ArcSpline::open([(0.0, 0.0, 0.0), (2.0, 3.0, 0.0), (4.0, 0.0, 0.0)]));
    assert_eq!(d.curves[1].path, ArcSpline::closed([(0.0, 0.0, 0.5), (4.0, 0.0, 0.25)]));
}

#[test]
fn hatched_areas_are_read_on_request() {
    let text = drawing(
        "0 HATCH; 10 0; 20 0; 30 0; 230 1; 2 SOLID; 70 1; 71 0; 91 1; 92 1; 93 2;
         72 1; 10 2; 20 0; 11 -2; 21 0; 72 2; 10 0; 20 0; 40 2; 50 180; 51 360; 73 0; 97 0; 75 0; 76 1; 98 1; 10 1; 20 1",
    );
    assert_eq!(read_text(&text, &ReadOptions::default()).curves, []);
    let d = read_text(&text, &ReadOptions { hatch: true, ..ReadOptions::default() });
    let paths: Vec<_> = d.curves.into_iter().map(|c| c.path).collect();
    let line = ArcSpline::open([(2.0, 0.0, 0.0), (-2.0, 0.0, 0.0)]);
    assert_eq!(paths, [line, ArcSpline::open([(2.0, 0.0, 1.0), (-2.0, 0.0, 0.0)])]);
}

#[test]
fn drawings_are_scaled_and_moved_on_request() {
    let entities = "0 CIRCLE; 10 10; 20 20; 40 2; 0 CIRCLE; 10 30; 20 20; 40 0; 0 CIRCLE; 10 20; 20 20; 40 4";
    let read = |options: &ReadOptions| read_text(&drawing(entities), options);
    let doubled = read(&ReadOptions { scale: 2.0, ..ReadOptions::default() });
    assert_eq!(doubled.curves[0].path, ArcSpline::circle(point(20.0, 40.0), 4.0));
    let min = read(&ReadOptions { origin: Origin::Min, ..ReadOptions::default() });
    assert_eq!((min.origin, min.bounds().min), (point(8.0, 16.0), point(0.0, 0.0)));
    assert_eq!(min.warnings[0].at(), Some(point(22.0, 4.0)), "warnings move along");
    let center = read(&ReadOptions { origin: Origin::Center, ..ReadOptions::default() });
    assert_eq!((center.origin, center.bounds().center()), (point(16.0, 20.0), point(0.0, 0.0)));
    for scale in [0.0, -1.0, f64::NAN] {
        let options = ReadOptions { scale, ..ReadOptions::default() };
        assert!(read_bytes(b"0\nEOF\n", "test.dxf", &options).is_err());
    }
}

#[test]
fn sizes_that_no_part_has_are_doubted() {
    let told = |radius: &str, options: &ReadOptions| {
        let d = read_text(&drawing(&format!("0 CIRCLE; 10 0; 20 0; 40 {radius}")), options);
        d.warnings.iter().map(|w| (w.kind(), w.help())).collect::<Vec<_>>()
    };
    let none = ReadOptions::default();
    assert_eq!(told("100", &none), []);
    assert!(told("60000", &none)[0].1.contains("--dxf-units um"));
    assert!(told("0.05", &none)[0].1.contains("--dxf-units m,"));
    let meters = ReadOptions { dxf_units: Some(DrawingUnit::Meter), ..ReadOptions::default() };
    assert_eq!(told("60", &meters)[0].0, "implausible-size");
    assert!(told("60", &meters)[0].1.contains("--dxf-units mm"));
}

/// The bytes of a binary file of the same tags.
fn binary(text: &str, wide: bool) -> Vec<u8> {
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    let mut lines = text.lines();
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        let code: u16 = code.parse().unwrap();
        if wide {
            bytes.extend(code.to_le_bytes());
        } else {
            bytes.push(code as u8);
        }
        match code {
            10..=59 | 210..=239 => bytes.extend(value.parse::<f64>().unwrap().to_le_bytes()),
            60..=79 => bytes.extend(value.parse::<i16>().unwrap().to_le_bytes()),
            90..=99 => bytes.extend(value.parse::<i32>().unwrap().to_le_bytes()),
            _ => bytes.extend([value.as_bytes(), &[0]].concat()),
        }
    }
    bytes
}

#[test]
fn text_and_binary_files_are_read_alike() {
    for (name, text) in samples::files() {
        let text: String = text.lines().skip(2).map(|line| format!("{}\n", line.trim())).collect();
        let wanted = read_text(&text, &ReadOptions::default());
        for wide in [true, false] {
            let mut read = read_bytes(&binary(&text, wide), "test.dxf", &ReadOptions::default()).unwrap();
            assert!(std::mem::take(&mut read.inventory.binary), "{name}");
            assert_eq!(read, wanted, "{name}");
        }
    }
}

#[test]
fn an_independent_reader_finds_the_same_places() {
    use ::dxf::entities::EntityType;
    for (name, text) in samples::files() {
        let other = ::dxf::Drawing::load(&mut text.as_bytes()).unwrap();
        let mut starts = Vec::new();
        for entity in other.entities() {
            let start = match &entity.specific {
                EntityType::Line(e) => (e.p1.x, e.p1.y),
                EntityType::Circle(e) => (e.center.x + e.radius, e.center.y),
                EntityType::Arc(e) => {
                    let (sin, cos) = e.start_angle.to_radians().sin_cos();
                    (e.center.x + e.radius * cos, e.center.y + e.radius * sin)
                }
                EntityType::LwPolyline(e) => (e.vertices[0].x, e.vertices[0].y),
                EntityType::Polyline(e) => e.vertices().next().map(|v| (v.location.x, v.location.y)).unwrap(),
                _ => continue,
            };
            starts.push(point(start.0, start.1));
        }
        let ours = sample(name);
        assert_eq!(ours.curves.len(), starts.len(), "{name}");
        for (curve, start) in ours.curves.iter().zip(starts) {
            assert!(curve.path.vertices[0].point.distance(start) < 1e-12, "{name}");
        }
    }
}

#[test]
fn a_drawing_in_a_unit_without_parts_is_refused_unless_its_true_unit_is_told() {
    let circle = "0 SECTION; 2 ENTITIES; 0 CIRCLE; 10 1; 20 2; 40 3; 0 ENDSEC; 0 EOF";
    for (code, name) in [(3, "mile"), (20, "parsec")] {
        let bytes = file(&format!("0 SECTION; 2 HEADER; 9 $INSUNITS; 70 {code}; 0 ENDSEC; {circle}"));
        match read_bytes(bytes.as_bytes(), "test.dxf", &ReadOptions::default()) {
            Err(Error::Unit { path, unit }) => assert_eq!((path.as_str(), unit), ("test.dxf", name)),
            other => panic!("{other:?}"),
        }
        let truth = ReadOptions { dxf_units: Some(DrawingUnit::Inch), ..ReadOptions::default() };
        let found = read_bytes(bytes.as_bytes(), "test.dxf", &truth).expect("its unit is told");
        assert_eq!((found.units, found.curves.len()), (Units::Inch, 1));
    }
}

#[test]
fn a_file_that_is_no_drawing_is_refused_with_the_cure() {
    assert!(refusal(b"").contains("empty"));
    assert!(refusal(b"\r\n").contains("empty"));
    assert!(refusal(b"AC1027\0\0\0").contains("DWG"));
    assert!(refusal(b"<?xml version=\"1.0\"?><svg/>").contains("SVG"));
    assert!(refusal(b"\xFF\xFE0\0\n\0").contains("UTF-16"));
    assert!(refusal(b"this is a letter\n").contains("line 1"));
    assert!(refusal(b"1\n2\n3\n4\n").contains("section"));
    assert!(refusal(b"AutoCAD Binary DXF\r\n\x1a\0\0SECT").contains("section"));
    assert!(refusal(b"PK\x03\x04").contains("archive") && refusal(b"%PDF-1.4").contains("PDF"));
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = read(Path::new("nowhere/part.dxf"), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("nowhere/part.dxf"), "{error}");
}

#[test]
fn a_drawing_without_curves_is_read() {
    assert_eq!(read_entities("0 TEXT").curves, []);
    assert_eq!(read_text("0\nEOF\n", &ReadOptions::default()).curves, []);
}

/// Cuts, bit flips and dropped bytes: any answer will do, a panic will not.
#[test]
fn mutilated_samples_never_panic() {
    let mut dice = 1_u64;
    let mut below = |limit: usize| {
        dice = dice * 48_271 % 2_147_483_647;
        dice as usize % limit
    };
    for (name, text) in samples::files().into_iter().filter(|(_, text)| text.len() < 5000) {
        for _ in 0..200 {
            let mut bytes = text.clone().into_bytes();
            for _ in 0..=below(3) {
                let at = below(bytes.len());
                match below(3) {
                    0 => bytes.truncate(at.max(1)),
                    1 => bytes[at] ^= 1 << below(8),
                    _ => drop(bytes.remove(at)),
                }
                if bytes.is_empty() {
                    break;
                }
            }
            for curve in read_bytes(&bytes, name, &ReadOptions::default()).map_or(Vec::new(), |d| d.curves) {
                assert!(curve.path.length().is_finite() && !curve.path.is_empty(), "{name}");
            }
        }
    }
}
