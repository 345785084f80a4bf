//! The binary as a user meets it: what it writes, what it says, how it ends.

use desk::Desk;
use predicates::prelude::*;
use predicates::str::{contains, is_empty, is_match};
use std::fs;
use std::path::{Path, PathBuf};

#[path = "support/desk.rs"]
mod desk;

impl Desk {
    /// With an output file from before.
    fn used(drawing: &str) -> Desk {
        let desk = Desk::new(drawing);
        desk.put("part.nc", "old");
        desk
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The command fails with this status and one error message, and no file is touched.
    fn refuses(&self, arguments: &[&str], status: i32, message: &str) {
        let output = self.pocket(arguments).assert().code(status).stdout(is_empty()).get_output().clone();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(told.matches("error:").count(), 1, "{told}");
        assert!(told.contains(message), "{told}");
        assert!(!told.contains("panicked"), "{told}");
        assert_eq!(self.read("part.nc"), "old");
        let mut names: Vec<_> = fs::read_dir(&self.folder).unwrap().map(|f| f.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["part.dxf", "part.nc"]);
    }
}

/// A drawing in millimeters of these entities.
fn drawing(entities: &[String]) -> String {
    drawing_in(4, entities)
}

fn drawing_in(units: u8, entities: &[String]) -> String {
    let header =
        format!("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n{units}\n0\nENDSEC\n");
    format!("{header}0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
}

fn circle(x: f64, y: f64, r: f64) -> String {
    format!("0\nCIRCLE\n8\n0\n10\n{x}\n20\n{y}\n30\n0\n40\n{r}\n")
}

fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> String {
    format!("0\nLINE\n8\n0\n10\n{x0}\n20\n{y0}\n30\n0\n11\n{x1}\n21\n{y1}\n31\n0\n")
}

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> String {
    [line(x0, y0, x1, y0), line(x1, y0, x1, y1), line(x1, y1, x0, y1), line(x0, y1, x0, y0)].concat()
}

/// A plate of 60 by 40 with a round island of radius 8.
fn plate() -> String {
    drawing(&[rectangle(0.0, 0.0, 60.0, 40.0), circle(30.0, 20.0, 8.0)])
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name)
}

#[test]
fn a_drawing_becomes_a_program() {
    let desk = Desk::used(&plate());
    desk.pocket(&["part.dxf", "--step", "0.5", "-o", "part.nc"])
        .assert()
        .success()
        .stdout(is_empty())
        .stderr(contains("pocket 1:").and(contains("path:")).and(contains("error").not()));
    let program = desk.read("part.nc");
    let first_motion = program.lines().find(|l| l.contains("G0")).unwrap();
    assert!(first_motion.contains("Z5") && !first_motion.contains('X'), "{first_motion}");
    assert!(program.contains("G21") && program.contains("M3") && program.contains("M30"));
}

#[test]
fn one_run_writes_every_form_that_is_asked_for() {
    let desk = Desk::used(&plate());
    let outputs = ["-o", "part.nc", "-o", "part.json", "-o", "part.svg", "-o", "out.DXF"];
    desk.pocket(&["part.dxf", "--tool", "6", "--step", "40%", "--depth", "5", "--step-down", "1.5"])
        .args(outputs)
        .assert()
        .success();
    let document: serde_json::Value = serde_json::from_str(&desk.read("part.json")).unwrap();
    assert_eq!(document["format"], "medial/1");
    let offsets = document["pockets"][0]["offsets"].as_array().unwrap();
    let distances: Vec<f64> = offsets.iter().map(|o| o["distance"].as_f64().unwrap()).collect();
    assert_eq!(distances[0], 3.0);
    assert!(distances.windows(2).all(|d| (d[1] - d[0] - 2.4).abs() < 1e-12));
    assert!(desk.read("part.svg").contains("<svg"));
    assert!(desk.read("part.nc").contains("Z-5"));
    let drawing = desk.read("out.DXF");
    assert!(["BOUNDARY", "MEDIAL_AXIS", "OFFSETS", "TOOLPATH"].iter().all(|layer| drawing.contains(layer)));
}

#[test]
fn a_written_drawing_is_read_again_by_its_layers() {
    let desk = Desk::used(&plate());
    desk.pocket(&["part.dxf", "--tool", "6", "-o", "out.dxf", "-o", "part.json"]).assert().success();
    desk.pocket(&["out.dxf", "--layer", "BOUNDARY", "--tool", "6", "-o", "again.json"]).assert().success();
    let boundary = |name: &str| {
        let document: serde_json::Value = serde_json::from_str(&desk.read(name)).unwrap();
        document["pockets"][0]["boundary"].clone()
    };
    assert_eq!(boundary("again.json"), boundary("part.json"));
    let onto_itself = desk.pocket(&["out.dxf", "--tool", "6", "-o", "./out.dxf"]).assert().code(2);
    onto_itself.stderr(contains("is the drawing itself"));
}

#[test]
fn without_output_there_is_a_report_only() {
    let desk = Desk::used(&plate());
    desk.pocket(&["part.dxf", "--tool", "6"]).assert().success().stdout(is_empty());
    assert_eq!(desk.read("part.nc"), "old");
}

#[test]
fn a_program_goes_to_standard_output_and_nothing_else_does() {
    let desk = Desk::used(&plate());
    let out = desk.pocket(&["part.dxf", "--tool", "6", "-o", "-"]).assert().success().get_output().clone();
    desk.pocket(&["part.dxf", "--tool", "6", "-o", "part.nc"]).assert().success();
    assert_eq!(String::from_utf8(out.stdout).unwrap(), desk.read("part.nc"));
}

#[test]
fn the_json_report_has_the_keys_of_its_contract() {
    let desk = Desk::used(&plate());
    let run = |more: &[&str]| -> serde_json::Value {
        let mut command = desk.pocket(&["part.dxf", "--tool", "6", "--report", "json"]);
        let out = command.args(more).assert().success().get_output().stdout.clone();
        serde_json::from_slice(&out).unwrap()
    };
    let keys =
        |value: &serde_json::Value| -> Vec<String> { value.as_object().unwrap().keys().cloned().collect() };
    let sorted = |text: &str| {
        let mut words: Vec<String> = text.split_whitespace().map(String::from).collect();
        words.sort();
        words
    };
    let report = run(&[]);
    assert_eq!(keys(&report), sorted("source units tool step tolerance pockets path verify warnings"));
    assert_eq!(
        keys(&report["pockets"][0]),
        sorted(
            "area islands arcs largest_tool unreachable_area unreachable narrowest_neck passes crests \
             crest_length largest_step largest_step_at full_width_length entry_length link_length slots slot_length \
             most_retracts path machined"
        )
    );
    assert_eq!(keys(&report["path"]), sorted("cut_length rapid_length retracts arcs lines minutes"));
    assert_eq!(report["pockets"][0]["path"], report["path"]);
    assert_eq!((report["source"].as_str(), report["units"].as_str()), (Some("part.dxf"), Some("mm")));
    assert_eq!((report["tool"].as_f64(), report["step"].as_f64()), (Some(6.0), Some(2.4)));
    let timed = run(&["--timings", "--verify"]);
    assert_eq!(
        keys(&timed["timings"]),
        sorted("read chain fit axis offsets path write sites vertices edges loops")
    );
    assert_eq!(keys(&timed["verify"]), sorted("levels max_deviation cavalier_contours"));
    assert!(timed["verify"]["max_deviation"].as_f64().unwrap() < 1e-9);
    let second = &timed["verify"]["cavalier_contours"];
    if cfg!(feature = "verify") {
        assert_eq!(keys(second), sorted("levels max_deviation disagreements not_compared"));
        assert_eq!(second["levels"], timed["verify"]["levels"]);
        assert!(
            second["max_deviation"].as_f64().unwrap() < 1e-6
                && second["disagreements"].as_array().unwrap().is_empty()
        );
    } else {
        assert!(second.is_null());
    }
}

#[test]
fn the_program_does_not_depend_on_the_number_of_threads() {
    let desk = Desk::used(&plate());
    let run = |jobs: &str| {
        let mut command = desk.pocket(&["part.dxf", "--step", "0.5", "--jobs", jobs, "-o", "-"]);
        command.assert().success().get_output().stdout.clone()
    };
    assert_eq!(run("1"), run("3"));
}

#[test]
fn every_sample_is_machined_and_judged_right() {
    let Ok(folder) = fs::read_dir(sample("")) else { panic!("the samples are gone") };
    let mut names: Vec<PathBuf> = folder.map(|f| f.unwrap().path()).collect();
    names.retain(|p| p.extension().is_some_and(|e| e == "dxf"));
    assert!(names.len() >= 8);
    let desk = Desk::used("");
    for path in names {
        let step = if path.ends_with("inch.dxf") { "0.02in" } else { "0.5mm" };
        desk.pocket(&[path.to_str().unwrap(), "--step", step, "-o", "part.nc", "--verify", "--strict"])
            .assert()
            .success()
            .stderr(is_match(r"verify: \d+ levels, 0 refused").unwrap());
    }
}

#[test]
fn lengths_with_units_mean_the_same_in_any_job() {
    let desk = Desk::used(&plate());
    let run = |arguments: &[&str]| {
        let mut command = desk.pocket(&["part.dxf", "-o", "-"]);
        command.args(arguments).assert().success().get_output().stdout.clone()
    };
    assert_eq!(run(&["--tool", "6"]), run(&["--tool", "6mm"]));
    let moves = |program: Vec<u8>| -> Vec<String> {
        let text = String::from_utf8(program).unwrap();
        text.lines().filter(|l| !l.starts_with('(')).map(String::from).collect()
    };
    assert_eq!(moves(run(&["--tool", "6.35"])), moves(run(&["--tool", "0.25in"])));
    let inches = String::from_utf8(run(&["--tool", "6mm", "--units", "in"])).unwrap();
    assert!(inches.contains("G20") && !inches.contains("G21"));
}

#[test]
fn a_drawing_in_inches_is_an_inch_job() {
    let desk = Desk::used(&drawing_in(1, &[rectangle(0.0, 0.0, 3.0, 2.0)]));
    desk.pocket(&["part.dxf", "--tool", "0.25", "-o", "part.nc"]).assert().success();
    assert!(desk.read("part.nc").contains("G20"));
}

#[test]
fn a_drawing_that_is_not_there_is_exit_1() {
    let desk = Desk::used(&plate());
    desk.refuses(&["none.dxf", "--step", "0.5", "-o", "part.nc"], 1, "none.dxf");
    desk.refuses(&[".", "--step", "0.5", "-o", "part.nc"], 1, "cannot read");
}

#[test]
fn what_is_no_drawing_is_exit_1() {
    for text in ["", "\n\n", "hello", "%PDF-1.7\n", "0\nSECTION\n"] {
        Desk::used(text).refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc"], 1, "help:");
    }
}

#[test]
fn a_drawing_without_a_closed_contour_is_exit_1_with_the_gap() {
    let open = [line(0.0, 0.0, 30.0, 0.0), line(30.0, 0.0, 30.0, 20.0), line(30.0, 20.0, 0.0, 1.0)];
    let desk = Desk::used(&drawing(&open));
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc"], 1, "nothing to machine");
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc"], 1, "--join");
    Desk::used(&drawing(&[])).refuses(&["part.dxf", "--step", "0.5"], 1, "nothing to machine");
}

#[test]
fn a_drawing_where_everything_crosses_is_exit_1_with_the_places() {
    let desk = Desk::used(&drawing(&[rectangle(0.0, 0.0, 30.0, 20.0), circle(30.0, 10.0, 5.0)]));
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc"], 1, "nothing to machine");
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc"], 1, "at: (");
}

#[test]
fn a_tool_larger_than_every_pocket_is_exit_1_with_the_largest_that_fits() {
    let desk = Desk::used(&drawing(&[circle(0.0, 0.0, 5.0), circle(20.0, 0.0, 4.0)]));
    desk.refuses(&["part.dxf", "--tool", "10.5", "-o", "part.nc"], 1, "10");
    desk.refuses(&["part.dxf", "--tool", "10.5", "-o", "part.nc"], 1, "largest that fits");
}

#[test]
fn a_tool_too_large_for_one_pocket_leaves_that_one_out_and_says_so() {
    let desk = Desk::used(&drawing(&[circle(0.0, 0.0, 5.0), circle(20.0, 0.0, 4.0)]));
    desk.pocket(&["part.dxf", "--tool", "9", "-o", "part.nc"])
        .assert()
        .success()
        .stderr(contains("warning:").and(contains("at: (20, 0)")).and(contains("--tool 8")));
    assert_ne!(desk.read("part.nc"), "old");
    desk.pocket(&["part.dxf", "--tool", "9", "--strict"]).assert().code(3);
}

#[test]
fn numbers_that_make_no_sense_are_usage_errors() {
    let desk = Desk::used(&plate());
    let cases: [&[&str]; 16] = [
        &["--step", "0"],
        &["--step", "-1"],
        &["--step", "nan"],
        &["--step", "inf"],
        &["--step", "0%", "--tool", "6"],
        &["--step", "101%", "--tool", "6"],
        &["--step", "7", "--tool", "6"],
        &["--step", "NaN%", "--tool", "6"],
        &["--step", "x"],
        &["--tool", "-6"],
        &["--tool", "nan"],
        &["--tool", "6", "--depth", "0"],
        &["--tool", "6", "--step-down", "-1"],
        &["--tool", "6", "--feed", "0"],
        &["--tool", "6", "--floor-stock", "1"],
        &["--tool", "6", "--jobs", "0"],
    ];
    for case in cases {
        let arguments = [&["part.dxf", "-o", "part.nc"], case].concat();
        desk.refuses(&arguments, 2, "--");
    }
}

#[test]
fn a_share_of_no_tool_is_a_usage_error() {
    let desk = Desk::used(&plate());
    desk.refuses(&["part.dxf", "--step", "40%", "-o", "part.nc"], 2, "--tool");
    desk.refuses(&["part.dxf", "-o", "part.nc"], 2, "add --tool");
}

#[test]
fn usage_is_judged_before_the_drawing_is_read() {
    let desk = Desk::used("no drawing");
    desk.refuses(&["part.dxf", "--step", "40%"], 2, "--tool");
    desk.refuses(&["none.dxf", "--step", "0.5", "-o", "part.xyz"], 2, "part.xyz");
    desk.refuses(&["none.dxf", "--tool", "6", "--step", "7"], 2, "--step 100%");
    desk.refuses(&["none.dxf", "--tool", "6", "--finish", "4"], 2, "leave less");
    desk.refuses(&["none.dxf", "--tool", "6", "--retract", "9"], 2, "--clearance");
    desk.refuses(&["none.dxf", "--tool", "6", "--floor-stock", "1"], 2, "--depth");
    desk.refuses(&["none.dxf", "--tool", "6", "--lead", "1"], 2, "--finish");
    desk.refuses(&["none.dxf", "--tool", "6", "--spring", "1.5"], 2, "whole number");
}

#[test]
fn an_extension_without_a_form_is_a_usage_error() {
    let desk = Desk::used(&plate());
    for name in ["part.xyz", "part", "part.nc.bak"] {
        desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc", "-o", name], 2, name);
    }
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "-", "--report", "json"], 2, "standard output");
}

#[test]
fn a_file_that_cannot_be_written_leaves_all_as_they_were() {
    let desk = Desk::used(&plate());
    desk.refuses(&["part.dxf", "--step", "0.5", "-o", "part.nc", "-o", "none/part.svg"], 1, "cannot write");
}

#[test]
fn names_of_subcommands_are_kept() {
    let desk = Desk::used(&plate());
    desk.refuses(&["--step", "0.5", "check"], 2, "./check");
    desk.refuses(&["--step", "0.5", "inspect"], 2, "./inspect");
}

#[test]
fn options_of_later_versions_are_not_swallowed() {
    let desk = Desk::used(&plate());
    for option in [["--strategy", "spiral"], ["--post", "grbl"], ["--job", "a.toml"]] {
        desk.refuses(&[&["part.dxf", "--step", "0.5"], &option[..]].concat(), 2, option[0]);
    }
}

#[test]
fn level_sets_alone_need_no_tool() {
    let desk = Desk::used(&plate());
    desk.refuses(&["part.dxf", "--tool", "0", "--step", "2", "-o", "part.nc"], 2, "--tool 0");
    desk.refuses(&["part.dxf", "--tool", "0", "--step", "90"], 1, "farther than 90 from the wall");
    desk.pocket(&["part.dxf", "--tool", "0", "--step", "2", "-o", "part.json"]).assert().success();
    let document: serde_json::Value = serde_json::from_str(&desk.read("part.json")).unwrap();
    assert_eq!(document["pockets"][0]["offsets"][0]["distance"], 2.0);
}

#[test]
fn what_a_step_above_half_the_tool_leaves_is_cut_and_said() {
    let desk = Desk::used(&plate());
    let run = |step: &str| desk.pocket(&["part.dxf", "--tool", "6", "--step", step]).assert().success();
    run("80%").stderr(contains("step 4.8 mm").and(contains("passes along the axis")));
    run("50%").stderr(contains("along the axis").not());
    run("100%").stderr(contains("reduced"));
    // 0.1719 * 100 / 100 is a rounding more.
    let fine = ["part.dxf", "--tool", "0.1719", "--step", "100%", "--depth", "0.1"];
    desk.pocket(&fine).assert().success().stderr(contains("reduced"));
}

#[test]
fn quiet_says_nothing_but_errors() {
    let desk = Desk::used(&plate());
    desk.pocket(&["part.dxf", "--tool", "6", "--quiet"]).assert().success().stderr(is_empty());
    let error = desk.pocket(&["part.dxf", "--tool", "60", "--quiet"]).assert().code(1).get_output().clone();
    let told = String::from_utf8(error.stderr).unwrap();
    assert!(told.starts_with("error:") && !told.contains("warning:"), "{told}");
}

#[test]
fn an_outline_with_everything_in_it_may_be_skipped() {
    let desk = Desk::used(&drawing(&[
        rectangle(0.0, 0.0, 60.0, 40.0),
        circle(15.0, 20.0, 8.0),
        circle(45.0, 20.0, 10.0),
        circle(45.0, 20.0, 3.0),
    ]));
    let areas = |more: &[&str]| -> (Vec<f64>, bool) {
        let arguments = ["part.dxf", "--tool", "2", "--report", "json"].iter().chain(more);
        let run = desk.pocket(&arguments.copied().collect::<Vec<_>>()).assert().success();
        let report: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
        let pockets = report["pockets"].as_array().unwrap().iter();
        let hint = report["warnings"].as_array().unwrap().iter().any(|w| w["kind"] == "outline-of-part");
        (pockets.map(|p| p["area"].as_f64().unwrap().round()).collect(), hint)
    };
    assert_eq!(areas(&[]), (vec![1885.0, 28.0], true));
    assert_eq!(areas(&["--skip-outer"]), (vec![201.0, 286.0], false));
    assert_eq!(areas(&["--from-depth", "2"]), (vec![28.0], false));
    desk.refuses(&["part.dxf", "--tool", "2", "--from-depth", "3"], 1, "inside 3 others");
    desk.refuses(&["part.dxf", "--tool", "2", "--from-depth", "3", "--skip-outer"], 2, "--skip-outer");
}

#[test]
fn all_entries_that_are_not_as_asked_make_one_warning() {
    let desk = Desk::used(&drawing(&[rectangle(0.0, 0.0, 60.0, 6.8), rectangle(0.0, 10.0, 60.0, 16.8)]));
    let run = desk.pocket(&["part.dxf", "--tool", "6", "--step", "40%", "--depth", "9"]).assert();
    let told = String::from_utf8(run.success().get_output().stderr.clone()).unwrap();
    assert_eq!(told.matches("instead of entries by helix").count(), 1, "{told}");
}

#[test]
fn help_is_short_and_long() {
    let desk = Desk::used("");
    let length = |flag: &str| desk.pocket(&[flag]).assert().success().get_output().stdout.len();
    assert!(length("-h") < length("--help"));
    desk.pocket(&["--version"]).assert().success().stdout(contains("pocket"));
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_quiet_success() {
    use std::process::{Command, Stdio};
    let desk = Desk::used(&plate());
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("pocket"))
        .current_dir(&desk.folder)
        .args(["part.dxf", "--step", "0.2", "--quiet", "--entry", "ramp", "-o", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The way inward links as often as the way outward: its passes begin at the feet of the inner ones. The
/// wall of an island is entered for itself, so these drawings have none.
#[test]
fn without_islands_clearing_from_outside_retracts_no_more_often() {
    let desk = Desk::used("");
    let retracts = |name: &str, start: &str| {
        let drawing = sample(name);
        let run = desk
            .pocket(&[drawing.to_str().unwrap(), "--step", "0.5", "--start", start, "--report", "json"])
            .assert()
            .success();
        let report: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
        report["path"]["retracts"].as_u64().unwrap()
    };
    for name in ["gear.dxf", "sharp.dxf"] {
        assert_eq!(retracts(name, "outside"), retracts(name, "inside"), "{name}");
    }
}

#[test]
fn chords_become_arcs_where_that_is_asked_for() {
    let count = 1000;
    let vertices: String = (0..count)
        .map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
            format!("10\n{}\n20\n{}\n", 20.0 * cos, 20.0 * sin)
        })
        .collect();
    let round = format!("0\nLWPOLYLINE\n8\n0\n90\n{count}\n70\n1\n{vertices}");
    let desk = Desk::used(&drawing(&[round, rectangle(-5.0, -5.0, 5.0, 5.0)]));
    let arcs = |options: &[&str]| {
        let arguments = [&["part.dxf", "--tool", "6", "--report", "json"], options].concat();
        let output = desk.pocket(&arguments).assert().success().get_output().stdout.clone();
        let report: serde_json::Value = serde_json::from_slice(&output).unwrap();
        (report["pockets"][0]["arcs"].as_u64().unwrap(), report["pockets"][0]["area"].as_f64().unwrap())
    };
    let (drawn, fitted) = (arcs(&[]), arcs(&["--fit", "0.01"]));
    assert_eq!(drawn.0, 0);
    assert!((4..=12).contains(&fitted.0), "{fitted:?}");
    assert!((fitted.1 - drawn.1).abs() < 0.1 && fitted.1 > drawn.1);
}
