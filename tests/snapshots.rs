//! Programs and messages as they are, so that a change of them is seen.
//!
//! After a change that is meant: `INSTA_UPDATE=always cargo test --test snapshots`.

use std::fs;
use std::path::Path;

/// What a run says: its exit status, then standard error, then standard output. Samples stand
/// beside the drawing `part.dxf`, which holds these entities.
fn run(entities: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    for name in ["slot.dxf", "inch.dxf"] {
        fs::copy(samples.join(name), folder.path().join(name)).unwrap();
    }
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    fs::write(folder.path().join("part.dxf"), format!("{header}{entities}0\nENDSEC\n0\nEOF\n")).unwrap();
    let mut command = assert_cmd::Command::cargo_bin("pocket").unwrap();
    let output = command.current_dir(&folder).env("COLUMNS", "100").args(arguments).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap() + &String::from_utf8(output.stdout).unwrap();
    let said = said.replace(env!("CARGO_PKG_VERSION"), "VERSION");
    format!("exit {}\n{said}", output.status.code().unwrap())
}

fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> String {
    format!("0\nLINE\n8\n0\n10\n{x0}\n20\n{y0}\n11\n{x1}\n21\n{y1}\n")
}

fn circle(x: f64, y: f64, r: f64) -> String {
    format!("0\nCIRCLE\n8\n0\n10\n{x}\n20\n{y}\n40\n{r}\n")
}

#[test]
fn program_of_a_slot() {
    let arguments = ["slot.dxf", "--tool", "8", "--depth", "2", "--step-down", "1", "--entry", "ramp"];
    insta::assert_snapshot!(run("", &[&arguments[..], &["-o", "-"]].concat()));
}

#[test]
fn program_in_inches_by_conventional_milling() {
    let arguments = ["inch.dxf", "--tool", "0.75", "--depth", "0.1", "--entry", "plunge"];
    let more = ["--direction", "conventional", "--start", "outside", "-o", "-"];
    insta::assert_snapshot!(run("", &[&arguments[..], &more].concat()));
}

#[test]
fn warnings_of_a_drawing_with_faults() {
    let drawn = [
        circle(0.0, 0.0, 20.0),
        line(-5.0, 0.0, 5.0, 0.0),
        circle(60.0, 0.0, 10.0),
        circle(72.0, 0.0, 10.0),
        circle(0.0, 0.0, 20.0),
        circle(100.0, 0.0, 2.0),
        "0\nSPLINE\n8\n0\n".into(),
    ];
    insta::assert_snapshot!(run(&drawn.concat(), &["part.dxf", "--tool", "6", "--entry", "plunge"]));
}

#[test]
fn errors_say_what_where_and_what_to_do() {
    let open = line(0.0, 0.0, 30.0, 0.0) + &line(30.0, 0.0, 0.0, 20.0) + &line(0.0, 20.0, 0.0, 0.5);
    let cases: [(&str, &str, &[&str]); 7] = [
        ("nothing closed", &open, &["part.dxf", "--tool", "6"]),
        ("tool too large", &circle(0.0, 0.0, 2.0), &["part.dxf", "--tool", "6"]),
        ("no such drawing", "", &["none.dxf", "--tool", "6"]),
        ("step of a tool that is not known", "", &["part.dxf", "--step", "40%"]),
        ("step above the tool", "", &["part.dxf", "--step", "7", "--tool", "6"]),
        ("unknown form", "", &["part.dxf", "--tool", "6", "-o", "part.xyz"]),
        ("folder that is not there", &circle(0.0, 0.0, 9.0), &["part.dxf", "--tool", "6", "-o", "none/a.nc"]),
    ];
    let told: Vec<String> = cases
        .iter()
        .map(|(case, entities, arguments)| format!("== {case}\n{}", run(entities, arguments)))
        .collect();
    insta::assert_snapshot!(told.join("\n"));
}
