//! Programs run through the interpreter of LinuxCNC, where it is installed (package
//! `linuxcnc-uspace`, command `rs274`). Where it is not, the test says so and passes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs the interpreter on a program, in a home of its own as it keeps a table of tools there.
/// Answers the canonical moves, or what it refuses.
fn interpret(folder: &Path, program: &Path) -> Result<String, String> {
    let (variables, moves) = (folder.join("p.var"), folder.join("moves"));
    fs::write(&variables, "").unwrap();
    let output = Command::new("rs274")
        .env("HOME", folder)
        .args([Path::new("-g"), Path::new("-v"), &variables, program, &moves])
        .output()
        .unwrap();
    let moves = fs::read_to_string(moves).unwrap_or_default();
    if output.status.success() { Ok(moves) } else { Err(String::from_utf8_lossy(&output.stderr).into()) }
}

fn samples() -> Vec<PathBuf> {
    let folder = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("samples")).unwrap();
    let mut names: Vec<PathBuf> = folder.map(|f| f.unwrap().path()).collect();
    names.sort();
    names
}

/// An arc: end and center, and its sense.
#[derive(Debug)]
struct Arc {
    places: [f64; 4],
    ccw: bool,
}

/// The arcs that a program means.
fn arcs_of_program(text: &str) -> Vec<Arc> {
    let (mut at, mut arcs) = ([0.0; 2], Vec::new());
    for line in text.lines().filter(|l| !l.starts_with('(')) {
        let word = |letter: char| {
            let found = line.split_whitespace().find_map(|w| w.strip_prefix(letter));
            found.map(|number| number.parse::<f64>().unwrap())
        };
        let to = [word('X').unwrap_or(at[0]), word('Y').unwrap_or(at[1])];
        if let (Some(i), Some(j)) = (word('I'), word('J')) {
            let places = [to[0], to[1], at[0] + i, at[1] + j];
            arcs.push(Arc { places, ccw: line.contains("G3") });
        }
        at = to;
    }
    arcs
}

/// The arcs that the interpreter hands on: `ARC_FEED(x, y, center x, center y, turns, z, ...)`.
fn arcs_canonical(moves: &str) -> Vec<Arc> {
    let feeds = moves.lines().filter_map(|l| l.split_once("ARC_FEED(")).map(|(_, words)| words);
    let arc = |words: &str| {
        let numbers: Vec<f64> = words.split(',').take(5).map(|n| n.trim().parse().unwrap()).collect();
        Arc { places: [numbers[0], numbers[1], numbers[2], numbers[3]], ccw: numbers[4] > 0.0 }
    };
    feeds.map(arc).collect()
}

#[test]
fn linuxcnc_runs_the_program_of_every_sample() {
    if Command::new("rs274").arg("-h").output().is_err() {
        eprintln!("skipped: rs274 of LinuxCNC is not installed");
        return;
    }
    for sample in samples() {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("part.ngc");
        assert_cmd::Command::cargo_bin("pocket")
            .unwrap()
            .arg(&sample)
            .args(["--step", "0.5mm", "--depth", "2mm", "--step-down", "1mm", "-o"])
            .arg(&program)
            .assert()
            .success();
        let moves = interpret(folder.path(), &program)
            .unwrap_or_else(|refused| panic!("{}: {refused}", sample.display()));
        let count = |word: &str| moves.matches(word).count();
        assert!(count("STRAIGHT_FEED") > 0 && count("STRAIGHT_TRAVERSE") > 0, "{}", sample.display());
        let (ours, theirs) =
            (arcs_of_program(&fs::read_to_string(&program).unwrap()), arcs_canonical(&moves));
        assert_eq!(ours.len(), theirs.len(), "{}", sample.display());
        for (own, other) in ours.iter().zip(&theirs) {
            let off = own.places.iter().zip(&other.places).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-4 && own.ccw == other.ccw, "{}: {own:?} {other:?}", sample.display());
        }
        assert!(count("PROGRAM_END") == 1 && count("START_SPINDLE") > 0, "{}", sample.display());
    }
}
