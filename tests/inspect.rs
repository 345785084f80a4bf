//! `pocket inspect` as a user meets it: what it tells, what it draws, how it ends.

use assert_cmd::Command;
use desk::Desk;
use predicates::prelude::*;
use predicates::str::{contains, is_empty};
use serde_json::Value;
use std::fs;

#[path = "support/desk.rs"]
mod desk;

impl Desk {
    fn inspect(&self, arguments: &[&str]) -> Command {
        self.pocket(&[&["inspect", "part.dxf"], arguments].concat())
    }

    /// Everything that is told, as JSON.
    fn report(&self, arguments: &[&str]) -> Value {
        let output = self.inspect(&[arguments, &["--report", "json"]].concat()).output().unwrap();
        serde_json::from_slice(&output.stdout).unwrap()
    }

    fn text(&self, arguments: &[&str]) -> String {
        String::from_utf8(self.inspect(arguments).output().unwrap().stdout).unwrap()
    }
}

fn on(layer: &str, kind: &str, groups: &[(i32, f64)]) -> String {
    let groups: String = groups.iter().map(|(code, value)| format!("{code}\n{value}\n")).collect();
    format!("0\n{kind}\n8\n{layer}\n{groups}")
}

fn circle(x: f64, y: f64, r: f64) -> String {
    on("0", "CIRCLE", &[(10, x), (20, y), (40, r)])
}

fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> String {
    on("0", "LINE", &[(10, x0), (20, y0), (11, x1), (21, y1)])
}

/// A drawing of release 2000 in millimeters; layer `Notes` is off and locked.
fn drawing(entities: &[String]) -> String {
    let header = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    let layer = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nNotes\n70\n4\n62\n-1\n0\nENDTAB\n0\nENDSEC\n";
    format!("{header}{layer}0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
}

/// A ring with a disk in its island, and one of each defect: circles that cross, an open chain, a
/// circle drawn twice, a circle without a radius, a line without length, an ellipse, a hidden line.
fn messy() -> String {
    drawing(&[
        circle(0.0, 0.0, 20.0),
        circle(0.0, 0.0, 10.0),
        circle(0.0, 0.0, 4.0),
        circle(60.0, 0.0, 10.0),
        circle(72.0, 0.0, 10.0),
        line(30.0, -20.0, 30.0, 20.0),
        line(30.0, 20.0, 31.0, 20.0),
        circle(0.0, 0.0, 20.0),
        format!("{}5\n2A\n", circle(5.0, 40.0, 0.0)),
        line(40.0, 40.0, 40.0, 40.0),
        on(
            "0",
            "ELLIPSE",
            &[
                (10, 100.0),
                (20, 0.0),
                (11, 9.0),
                (21, 0.0),
                (40, 0.5),
                (41, 0.0),
                (42, std::f64::consts::TAU),
            ],
        ),
        on("Notes", "LINE", &[(10, 0.0), (20, 0.0), (11, 1.0), (21, 1.0)]),
    ])
}

#[test]
fn the_text_of_a_drawing_with_faults() {
    let desk = Desk::new(&messy());
    desk.inspect(&[]).assert().code(0).stderr(is_empty());
    insta::assert_snapshot!(desk.text(&[]));
}

#[test]
fn contours_are_nested_and_the_largest_tool_is_told() {
    let report = Desk::new(&messy()).report(&[]);
    let pockets = report["pockets"].as_array().unwrap();
    let told: Vec<_> =
        pockets.iter().map(|p| (p["number"].as_u64(), p["inside"].as_u64(), p["depth"].as_u64())).collect();
    assert_eq!(told, [(Some(1), None, Some(0)), (Some(2), Some(1), Some(2)), (Some(3), None, Some(0))]);
    let tool = |i: usize| pockets[i]["largest_tool"].as_f64().unwrap();
    assert!((tool(0) - 10.0).abs() < 1e-12 && (tool(1) - 8.0).abs() < 1e-12);
    assert_eq!(report["machinable"], true);
}

#[test]
fn every_finding_has_a_number_and_a_cure_and_faults_come_first() {
    let report = Desk::new(&messy()).report(&[]);
    let findings = report["findings"].as_array().unwrap();
    let numbers: Vec<_> = findings.iter().map(|f| f["number"].as_u64().unwrap()).collect();
    assert_eq!(numbers, (1..=findings.len() as u64).collect::<Vec<_>>());
    assert!(findings.iter().all(|f| !f["help"].as_str().unwrap().is_empty()));
    let weights: Vec<_> = findings.iter().map(|f| f["weight"].as_str().unwrap()).collect();
    assert!(weights.is_sorted() && weights.contains(&"fault") && weights.contains(&"note"));
    let kinds: Vec<_> = findings.iter().map(|f| f["kind"].as_str().unwrap()).collect();
    for kind in ["crossing", "open-contour", "duplicates", "entity-skipped", "layer-skipped"] {
        assert!(kinds.contains(&kind), "{kind}");
    }
    let broken = findings.iter().find(|f| f["kind"] == "entity-skipped" && f["weight"] == "fault").unwrap();
    assert_eq!(broken["entities"][0]["handle"], "2A");
    // A line without length is no loss.
    assert!(findings.iter().any(|f| f["kind"] == "entity-skipped" && f["weight"] == "note"));
}

#[test]
fn the_inventory_counts_what_became_of_every_entity() {
    let report = Desk::new(&messy()).report(&[]);
    assert_eq!((&report["version"], &report["release"]), (&"AC1015".into(), &"2000".into()));
    assert_eq!(report["unit"]["reason"], "claimed");
    let count = |kind: &str, fate: &str| report["kinds"][kind][fate].as_u64().unwrap();
    assert_eq!((count("CIRCLE", "read"), count("CIRCLE", "broken")), (6, 1));
    assert_eq!((count("LINE", "read"), count("LINE", "broken"), count("LINE", "hidden")), (2, 1, 1));
    assert_eq!(count("ELLIPSE", "free"), 1);
    let layers = report["layers"].as_array().unwrap();
    let notes = layers.iter().find(|l| l["name"] == "Notes").unwrap();
    assert_eq!(
        (&notes["off"], &notes["locked"], &notes["frozen"]),
        (&true.into(), &true.into(), &false.into())
    );
}

#[test]
fn the_picture_shows_the_numbers_that_the_text_explains() {
    let desk = Desk::new(&messy());
    desk.inspect(&["-o", "picture.svg", "-o", "all.json"]).assert().success().stdout(contains("picture.svg"));
    let svg = fs::read_to_string(desk.path("picture.svg")).unwrap();
    let report: Value = serde_json::from_slice(&fs::read(desk.path("all.json")).unwrap()).unwrap();
    for finding in report["findings"].as_array().unwrap() {
        let explained = format!("{}: {}", finding["number"], finding["message"].as_str().unwrap());
        assert_eq!(svg.contains(&explained), !finding["at"].is_null(), "{explained}");
    }
    for shown in ["class=\"unused\"", "class=\"wall\"", ">pocket 1<"] {
        assert!(svg.contains(shown), "{shown}");
    }
    assert_eq!(desk.report(&[]), report);
}

#[test]
fn a_drawing_without_anything_to_machine_is_told_and_is_exit_1() {
    let desk = Desk::new(&drawing(&[line(0.0, 0.0, 10.0, 0.0)]));
    desk.inspect(&[]).assert().code(1).stdout(contains("nothing to machine").and(contains("open contour")));
    assert_eq!(desk.report(&[])["machinable"], false);
    let empty = Desk::new(&drawing(&[]));
    empty.inspect(&["-o", "a.svg"]).assert().code(1).stdout(contains("nothing to machine"));
    assert!(fs::read_to_string(empty.path("a.svg")).unwrap().ends_with("</svg>\n"));
}

#[test]
fn what_cannot_be_read_is_an_error() {
    let desk = Desk::new("no drawing\n");
    desk.inspect(&["-o", "a.svg"]).assert().code(1).stdout(is_empty()).stderr(contains("error:"));
    assert!(!desk.path("a.svg").exists());
    let missing = Command::cargo_bin("pocket").unwrap().args(["inspect", "no-such.dxf"]).assert().code(1);
    missing.stderr(contains("cannot read no-such.dxf"));
}

#[test]
fn usage_is_checked_before_any_work() {
    let desk = Desk::new(&messy());
    for arguments in [
        &["-o", "a.nc"][..],
        &["-o", "a.svg", "-o", "a.svg"],
        &["-o", "part.dxf"],
        &["--tool", "6"],
        &["--dxf-units", "elephants"],
        &["--skip-outer", "--from-depth", "2"],
    ] {
        desk.inspect(arguments).assert().code(2).stdout(is_empty());
    }
    let help = Command::cargo_bin("pocket").unwrap().args(["inspect", "--help"]).assert().success();
    help.stdout(contains("Usage: pocket inspect").and(contains("--skip-layer")));
}

#[test]
fn options_of_reading_are_those_of_the_main_command() {
    let desk = Desk::new(&messy());
    assert_eq!(desk.report(&["--units", "in"])["units"], "in");
    let outlines = desk.report(&["--skip-outer"]);
    let pockets = outlines["pockets"].as_array().unwrap();
    assert_eq!((pockets.len(), &pockets[0]["depth"]), (1, &1.into()));
    assert_eq!(desk.report(&["--hidden"])["kinds"]["LINE"]["hidden"], 0);
    assert_eq!(desk.report(&["--layer", "Notes"])["kinds"]["CIRCLE"]["unselected"], 7);
    let text = desk.text(&["--dxf-units", "cm"]);
    assert!(text.contains("unit: cm, as --dxf-units says; the drawing claims mm"), "{text}");
}

#[test]
fn places_are_told_from_the_moved_origin() {
    let report = Desk::new(&messy()).report(&["--origin", "center"]);
    let bounds = &report["bounds"];
    let [min, max] = ["min", "max"].map(|end| bounds[end][0].as_f64().unwrap());
    assert!((min + max).abs() <= 4.0 * f64::EPSILON * max, "{min} {max}");
    let broken =
        report["findings"].as_array().unwrap().iter().find(|f| f["kind"] == "entity-skipped").unwrap();
    assert_eq!(broken["places"][0], broken["at"]);
}

#[test]
fn a_file_with_the_name_of_the_subcommand_is_a_drawing_with_its_folder() {
    let desk = Desk::new(&messy());
    fs::copy(desk.path("part.dxf"), desk.path("inspect")).unwrap();
    let mut command = Command::cargo_bin("pocket").unwrap();
    command.current_dir(&desk.folder).args(["inspect", "./inspect"]).assert().success();
    let mut command = Command::cargo_bin("pocket").unwrap();
    command.current_dir(&desk.folder).args(["--tool", "3", "./inspect"]).assert().success();
}

#[test]
fn the_main_command_sends_a_user_here() {
    let desk = Desk::new(&drawing(&[line(0.0, 0.0, 10.0, 0.0)]));
    let mut command = Command::cargo_bin("pocket").unwrap();
    command.current_dir(&desk.folder).args(["part.dxf", "--tool", "3"]).assert().code(1);
    command.assert().stderr(contains("pocket inspect part.dxf -o picture.svg"));
}

#[test]
fn thousands_of_defects_are_told_and_drawn_in_time() {
    let open =
        |i: i32| line(f64::from(i % 100), f64::from(i / 100), f64::from(i % 100) + 0.5, f64::from(i / 100));
    let desk = Desk::new(&drawing(&(0..10_000).map(open).collect::<Vec<_>>()));
    desk.inspect(&["-o", "a.svg"]).timeout(std::time::Duration::from_secs(60)).assert().code(1);
    let labels = fs::read_to_string(desk.path("a.svg")).unwrap().matches("class=\"tag\"").count();
    assert!((20..400).contains(&labels), "{labels}");
}
