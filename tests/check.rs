//! `pocket check` as a user meets it: right offsets pass, every way to be wrong is found with its place.

use assert_cmd::Command;
use desk::Desk;
use predicates::str::contains;
use serde_json::Value;
use std::f64::consts::PI;
use std::fs;

/// Tangent of a quarter of a right angle: the bulge of a quarter circle.
const QUARTER: f64 = 0.414_213_562_373_095_03;

/// A closed polyline of vertices with bulges.
type Loop = Vec<[f64; 3]>;

fn polyline(vertices: &Loop) -> String {
    let head = format!("0\nLWPOLYLINE\n8\n0\n90\n{}\n70\n1\n", vertices.len());
    vertices.iter().fold(head, |text, [x, y, b]| text + &format!("10\n{x}\n20\n{y}\n42\n{b}\n"))
}

fn drawing(entities: &str) -> String {
    let header = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    format!("{header}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

/// A plate with a bore and, in its upper wall, a notch 4.04 wide.
fn part() -> String {
    let corners = [
        [0.0, 0.0],
        [40.0, 0.0],
        [40.0, 20.0],
        [22.02, 20.0],
        [22.02, 30.0],
        [17.98, 30.0],
        [17.98, 20.0],
        [0.0, 20.0],
    ];
    let wall = corners.map(|[x, y]| [x, y, 0.0]).to_vec();
    drawing(&(polyline(&wall) + "0\nCIRCLE\n8\n0\n10\n10\n20\n10\n40\n3\n"))
}

/// Its level at 2: into the notch reaches a finger 0.04 wide and 10 long.
fn right() -> Vec<Loop> {
    let wall = vec![
        [2.0, 2.0, 0.0],
        [38.0, 2.0, 0.0],
        [38.0, 18.0, 0.0],
        [22.02, 18.0, -QUARTER],
        [20.02, 20.0, 0.0],
        [20.02, 28.0, 0.0],
        [19.98, 28.0, 0.0],
        [19.98, 20.0, -QUARTER],
        [17.98, 18.0, 0.0],
        [2.0, 18.0, 0.0],
    ];
    vec![wall, circle(10.0, 10.0, 5.0)]
}

fn circle(x: f64, y: f64, r: f64) -> Loop {
    vec![[x + r, y, 1.0], [x - r, y, 1.0]]
}

#[path = "support/desk.rs"]
mod desk;

impl Desk {
    /// With the part and offsets of it.
    fn with_offsets(offsets: &[Loop]) -> Desk {
        let desk = Desk::new(&part());
        desk.put("theirs.json", &serde_json::to_string(offsets).unwrap());
        desk
    }

    fn check(&self, arguments: &[&str]) -> Command {
        self.pocket(&[&["check", "part.dxf"], arguments].concat())
    }

    /// The report on the offsets in JSON at a distance, and the exit status.
    fn report(&self, arguments: &[&str]) -> (Value, i32) {
        let json = ["--offsets", "theirs.json", "--report", "json"];
        let output = self.check(&[&json[..], arguments].concat()).output().unwrap();
        let report = serde_json::from_slice(&output.stdout);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (report.unwrap_or_else(|_| panic!("{said}")), output.status.code().unwrap())
    }
}

/// A fault: place, deviation, length, area.
type Found = ([f64; 2], f64, f64, f64);

/// Faults of a kind at the only level.
fn faults(report: &Value, kind: &str) -> Vec<Found> {
    let number = |v: &Value| v.as_f64().unwrap();
    let fault = |f: &Value| {
        let at = [number(&f["at"][0]), number(&f["at"][1])];
        (at, number(&f["by"]), number(&f["length"]), number(&f["area"]))
    };
    report["levels"][0][kind].as_array().unwrap().iter().map(fault).collect()
}

/// What is told of offsets at 2 that are wrong: missing parts and phantom parts.
fn wrong(offsets: &[Loop]) -> [Vec<Found>; 2] {
    let (report, exit) = Desk::with_offsets(offsets).report(&["--distance", "2"]);
    assert_eq!((report["right"].as_bool(), exit), (Some(false), 3), "{report}");
    assert!(report["levels"][0]["other"].as_array().unwrap().is_empty(), "{report}");
    ["missing", "phantom"].map(|kind| faults(&report, kind))
}

fn near(a: f64, b: f64, by: f64) -> bool {
    (a - b).abs() < by
}

#[test]
fn right_offsets_pass_in_any_direction_and_form() {
    let desk = Desk::with_offsets(&right());
    let (report, exit) = desk.report(&["--distance", "2"]);
    assert_eq!((report["right"].as_bool(), exit), (Some(true), 0), "{report}");
    assert!(report["max_deviation"].as_f64().unwrap() < 1e-13 && report["within"] == 0.001);
    let mut turned = right();
    turned[1] = vec![[5.0, 10.0, -1.0], [15.0, 10.0, -1.0]];
    assert_eq!(Desk::with_offsets(&turned).report(&["--distance", "2"]).1, 0);
    // As loose lines and arcs of a drawing in centimeters, one of them reversed.
    let line = |a: [f64; 2], b: [f64; 2]| {
        let [x0, y0, x1, y1] = [a[0], a[1], b[0], b[1]].map(|c| 0.1 * c);
        format!("0\nLINE\n8\n0\n10\n{x0}\n20\n{y0}\n11\n{x1}\n21\n{y1}\n")
    };
    let arc = |x: f64, y: f64, from: f64, to: f64| {
        let (x, y) = (0.1 * x, 0.1 * y);
        format!("0\nARC\n8\n0\n10\n{x}\n20\n{y}\n40\n0.2\n50\n{from}\n51\n{to}\n")
    };
    let wall = &right()[0];
    let mut text = String::new();
    for (i, v) in wall.iter().enumerate() {
        let w = wall[(i + 1) % wall.len()];
        let (from, to) = ([v[0], v[1]], [w[0], w[1]]);
        text += &match i {
            3 => arc(22.02, 20.0, 180.0, 270.0),
            7 => arc(17.98, 20.0, 270.0, 360.0),
            4 => line(to, from),
            _ => line(from, to),
        };
    }
    text += "0\nCIRCLE\n8\n0\n10\n1\n20\n1\n40\n0.5\n";
    desk.put("theirs.dxf", &drawing(&text).replace("70\n4\n0\nENDSEC", "70\n5\n0\nENDSEC"));
    desk.check(&["--offsets", "theirs.dxf", "--distance", "2"]).assert().success().stdout(contains("right"));
}

#[test]
fn a_moved_vertex_is_found_where_it_is() {
    let mut offsets = right();
    offsets[0][1] = [38.0, 2.4, 0.0];
    let [missing, phantom] = wrong(&offsets);
    let ([at], [m]) = (&phantom[..], &missing[..]) else { panic!("{phantom:?} {missing:?}") };
    assert!(near(at.0[0], 37.6, 0.1) && near(at.0[1], 2.4, 0.1) && near(at.1, 0.4, 0.01), "{at:?}");
    assert!(near(m.0[1], 2.0, 0.1) && m.0[0] > 36.0 && near(m.1, 0.4, 0.1), "{m:?}");
    // As far off as is allowed.
    let loose = ["--distance", "2", "--within", "0.41"];
    assert_eq!(Desk::with_offsets(&offsets).report(&loose).1, 0);
}

#[test]
fn a_loop_left_out_is_missing_with_its_length_and_area() {
    let [missing, phantom] = wrong(&right()[..1]);
    let [(at, by, length, area)] = missing[..] else { panic!("{missing:?}") };
    assert!(near((at[0] - 10.0).hypot(at[1] - 10.0), 5.0, 1e-9) && by > 3.0 && phantom.is_empty());
    assert!(near(length, 10.0 * PI, 1e-2) && near(area, 25.0 * PI, 1e-1), "{missing:?}");
}

#[test]
fn a_loop_too_much_is_a_phantom_with_its_place_and_area() {
    let mut offsets = right();
    offsets.push(circle(30.0, 10.0, 1.0));
    let [missing, phantom] = wrong(&offsets);
    let [(at, by, length, area)] = phantom[..] else { panic!("{phantom:?}") };
    assert!(near((at[0] - 30.0).hypot(at[1] - 10.0), 1.0, 1e-9) && missing.is_empty());
    assert!(near(by, 8.0, 0.1) && near(length, 2.0 * PI, 1e-2) && near(area, PI, 1e-9), "{phantom:?}");
}

#[test]
fn a_loop_at_the_wrong_distance_is_told_as_both() {
    let mut offsets = right();
    offsets[1] = circle(10.0, 10.0, 5.1);
    let [missing, phantom] = wrong(&offsets);
    let ([m], [p]) = (&missing[..], &phantom[..]) else { panic!("{missing:?} {phantom:?}") };
    assert!(near(p.1, 0.1, 1e-3) && near(p.3, 5.1f64.powi(2) * PI, 1e-6), "{p:?}");
    assert!(near(m.1, 0.1, 1e-3) && near(m.3, 25.0 * PI, 0.1), "{m:?}");
}

#[test]
fn a_missing_sliver_is_found_although_little_else_is_wrong() {
    let mut offsets = right();
    offsets[0].drain(5..7);
    let [missing, phantom] = wrong(&offsets);
    let [(at, by, length, _)] = missing[..] else { panic!("{missing:?}") };
    assert!(near(at[0], 20.0, 0.03) && at[1] > 27.0 && near(by, 8.0, 0.5) && length > 16.0, "{missing:?}");
    // The line over the mouth of the notch, 0.04 long, is 0.02 off in its middle.
    let [(at, by, ..)] = phantom[..] else { panic!("{phantom:?}") };
    assert!(near(at[0], 20.0, 0.001) && near(at[1], 20.0, 1e-9) && near(by, 0.02, 1e-4), "{phantom:?}");
}

#[test]
fn a_flattened_offset_passes_within_its_sag() {
    let mut offsets = right();
    let at = |i: i32| {
        let (s, c) = (f64::from(i) * PI / 50.0).sin_cos();
        [10.0 + 5.0 * c, 10.0 + 5.0 * s, 0.0]
    };
    offsets[1] = (0..100).map(at).collect();
    let sag = 5.0 * (1.0 - (PI / 100.0).cos());
    let (report, exit) = Desk::with_offsets(&offsets).report(&["--distance", "2", "--within", "0.0025"]);
    assert!(exit == 0 && near(report["max_deviation"].as_f64().unwrap(), sag, 1e-9), "{report}");
    let (report, exit) = Desk::with_offsets(&offsets).report(&["--distance", "2", "--within", "0.0024"]);
    assert_eq!((exit, faults(&report, "phantom").len()), (3, 1));
}

#[test]
fn outward_offsets_are_judged_outside_and_in_the_islands() {
    let (q, d) = (QUARTER, 1.0);
    let around = vec![
        [0.0, -d, 0.0],
        [40.0, -d, q],
        [41.0, 0.0, 0.0],
        [41.0, 20.0, q],
        [40.0, 21.0, 0.0],
        [23.02, 21.0, 0.0],
        [23.02, 30.0, q],
        [22.02, 31.0, 0.0],
        [17.98, 31.0, q],
        [16.98, 30.0, 0.0],
        [16.98, 21.0, 0.0],
        [0.0, 21.0, q],
        [-1.0, 20.0, 0.0],
        [-1.0, 0.0, q],
    ];
    let desk = Desk::with_offsets(&[around.clone(), circle(10.0, 10.0, 2.0)]);
    assert_eq!(desk.report(&["--distance", "1", "--outward"]).1, 0);
    assert_eq!(desk.report(&["--distance", "1"]).1, 3);
    let desk = Desk::with_offsets(&[around]);
    let (report, exit) = desk.report(&["--distance", "1", "--outward"]);
    let missing = faults(&report, "missing");
    assert!(exit == 3 && missing.len() == 1 && near(missing[0].3, 4.0 * PI, 0.1), "{report}");
}

#[test]
fn levels_of_a_document_are_judged_each_at_its_distance() {
    let desk = Desk::with_offsets(&[]);
    let mut pocket = desk.pocket(&["part.dxf", "--tool", "2", "--step", "50%"]);
    pocket.args(["-o", "theirs.json", "-o", "all.dxf"]).assert().success();
    let (report, exit) = desk.report(&[]);
    assert!(exit == 0 && report["levels"].as_array().unwrap().len() > 3, "{report}");
    assert!(report["max_deviation"].as_f64().unwrap() < 1e-12);
    // The same levels from a drawing, where every loop finds its distance.
    let levels = report["levels"].as_array().unwrap();
    let distances: Vec<String> = levels.iter().map(|l| l["distance"].to_string()).collect();
    let mut arguments = vec!["--offsets", "all.dxf", "--offsets-layer", "OFFSETS"];
    distances.iter().for_each(|d| arguments.extend(["--distance", d]));
    desk.check(&arguments).assert().success();
    arguments[3] = "BOUND*";
    desk.check(&arguments).assert().code(3).stdout(contains("missing"));
}

#[test]
fn a_picture_has_the_faults_with_their_numbers() {
    let desk = Desk::with_offsets(&right()[..1]);
    let arguments = ["--offsets", "theirs.json", "--distance", "2", "-o", "a.svg"];
    desk.check(&arguments).assert().code(3).stdout(contains("1. missing: a part 31.4"));
    let picture = fs::read_to_string(desk.path("a.svg")).unwrap();
    assert!(picture.contains("missing: a part 31.4") && picture.ends_with("</svg>\n"));
}

#[test]
fn wrong_use_is_told_with_the_cure() {
    let desk = Desk::with_offsets(&right());
    desk.put("bad.json", "[[[1]]]");
    let said = |arguments: &[&str], code: i32, what: &str| {
        desk.check(arguments).assert().code(code).stderr(contains(what));
    };
    said(&["--distance", "2"], 2, "--offsets");
    said(&["--offsets", "theirs.json"], 2, "--distance 1.5");
    said(&["--offsets", "theirs.json", "--distance", "-2"], 2, "--outward");
    said(&["--offsets", "bad.json", "--distance", "2"], 1, "\"loops\"");
    said(&["--offsets", "none.dxf", "--distance", "2"], 1, "none.dxf");
    said(&["--offsets", "none.json", "--distance", "2"], 1, "none.json");
    said(&["--offsets", "theirs.json", "--distance", "2", "-o", "a.png"], 2, ".svg");
    said(&["--offsets", "theirs.json", "--distance", "2", "--offsets-units", "x"], 2, "--offsets-units");
    desk.put("part.dxf", &drawing(""));
    said(&["--offsets", "theirs.json", "--distance", "2"], 1, "inspect");
}
