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
        assert!(count("PROGRAM_END") == 1 && count("START_SPINDLE") > 0, "{}", sample.display());
    }
}
