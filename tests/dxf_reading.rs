//! DXF drawings from the outside: the samples, and everything that a file may do wrong.

#![cfg(feature = "dxf")]

#[path = "../examples/samples.rs"]
#[allow(dead_code)]
mod samples;

use medial::io::DrawingUnit;
use medial::io::dxf::{Drawing, ReadOptions, read, read_bytes};
use medial::{ArcSpline, Error, Units};
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
    assert_eq!(slot.curves[0].source.kind, "POLYLINE");
}

#[test]
fn arcs_meet_lines_to_the_last_bit_at_quarters() {
    let d = read_entities(
        "0 ARC; 5 A1; 8 Cut; 10 5; 20 5; 40 2.5; 50 90; 51 180; 0 LINE; 10 2.5; 20 5; 11 2.5; 21 0;
         0 CIRCLE; 10 1; 20 2; 40 3",
    );
    let [arc, line, circle] = &d.curves[..] else { panic!("{d:?}") };
    assert_eq!(arc.path.vertices[1].point, line.path.vertices[0].point);
    assert_eq!((arc.source.handle, arc.source.layer.as_str()), (Some(0xA1), "Cut"));
    assert_eq!((line.source.handle, line.source.layer.as_str()), (None, "0"));
    assert_eq!(circle.path, ArcSpline::circle(medial::point(1.0, 2.0), 3.0));
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
        (d.units, x, d.warnings.len())
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
        "0 SPLINE; 10 0; 0 SPLINE; 40 1; 0 TEXT; 1 hello; 0 HATCH; 10 x; 0 MYSTERY;
         0 ARC; 10 0; 20 0; 40 1; 50 0; 51 90; 230 -1; 0 LINE; 10 0; 20 0; 11 1; 21 0; 230 -1",
    );
    assert_eq!(d.curves.len(), 1, "a line is drawn in world coordinates in any case");
    assert_eq!(
        messages(&d),
        [
            "ARC, mirrored: 1 not read yet",
            "HATCH: 1 skipped, no outline",
            "MYSTERY: 1 skipped, no outline",
            "SPLINE: 2 not read yet",
            "TEXT: 1 skipped, no outline",
        ]
    );
}

#[test]
fn one_broken_entity_does_not_cost_the_others() {
    let good = "0 CIRCLE; 10 1; 20 2; 40 3";
    for broken in [
        "0 CIRCLE; 5 2B; 10 1; 20 2; 40 nan",
        "0 CIRCLE; 5 2B; 10 1e400; 20 2; 40 3",
        "0 CIRCLE; 5 2B; 10 1; 20 2; 40 -3",
        "0 CIRCLE; 5 2B; 10 1,5; 20 2; 40 3",
        "0 CIRCLE; 5 2B; 10; 20 2; 40 3",
        "0 LINE; 5 2B; 10 1; 20 2; 11 3",
        "0 LWPOLYLINE; 5 2B; 90 2000000000; 70 1; 10 1; 20 2",
    ] {
        let d = read_entities(&format!("{good}; {broken}; {good}"));
        assert_eq!(d.curves.len(), 2, "{broken}");
        assert_eq!(d.warnings.len(), 1, "{broken}");
        assert!(messages(&d)[0].contains(" 2B skipped: "), "{}", messages(&d)[0]);
    }
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
    assert_eq!(read_text(&text, &only).curves[0].source.layer, "OFF");
    let without = ReadOptions { skip_layers: vec!["ice".into()], hidden: true, ..ReadOptions::default() };
    assert_eq!(read_text(&text, &without).curves.len(), 2);
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
    assert!(refusal(drawing("0 LINE").replace("70\n4\n", "70\n20\n").as_bytes()).contains("parsec"));
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
