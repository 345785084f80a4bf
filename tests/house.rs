//! What the repository tells its readers is so: pictures, help text, code, commands.
//!
//! After a change that is meant: `cargo run --example figures`, and
//! `UPDATE_README=1 cargo test --test house`.

use std::fs;
use std::path::{Path, PathBuf};

#[cfg(feature = "dxf")]
#[path = "../examples/figures.rs"]
#[allow(dead_code)]
mod figures;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Runs the binary; answers what it prints on standard output.
#[cfg(feature = "cli")]
fn printed(arguments: &[&str]) -> String {
    let mut command = assert_cmd::Command::cargo_bin("pocket").unwrap();
    let output = command
        .current_dir(root())
        .env("COLUMNS", "100")
        .args(arguments)
        .assert()
        .success()
        .get_output()
        .clone();
    String::from_utf8(output.stdout).unwrap()
}

/// The first fenced block of the README after a heading.
#[cfg(feature = "cli")]
fn fenced_after(heading: &str) -> String {
    let readme = text("README.md");
    let after = readme.split_once(heading).unwrap_or_else(|| panic!("README.md has no {heading}")).1;
    after.split("```").nth(1).unwrap().split_once('\n').unwrap().1.to_owned()
}

/// What the crate documentation shows of its examples, without the lines that it hides.
fn shown_code() -> String {
    let lib = text("src/lib.rs");
    let doc = lib.lines().filter_map(|l| l.strip_prefix("//!")).map(|l| l.strip_prefix(' ').unwrap_or(l));
    doc.filter(|l| !l.starts_with("# ")).map(|l| format!("{l}\n")).collect()
}

#[test]
fn the_code_of_the_readme_is_that_of_the_crate_documentation() {
    let (readme, compiled) = (text("README.md"), shown_code());
    let blocks: Vec<&str> = readme.split("```rust\n").skip(1).filter_map(|b| b.split("```").next()).collect();
    assert!(!blocks.is_empty());
    for block in blocks {
        assert!(compiled.contains(block), "not in src/lib.rs, where it would be compiled:\n{block}");
    }
}

#[cfg(feature = "dxf")]
#[test]
fn pictures_are_as_the_library_draws_them() {
    for (name, svg) in figures::figures().unwrap() {
        let stored = text(&format!("docs/{name}"));
        assert!(stored == svg, "docs/{name} is not up to date: cargo run --example figures");
        assert!(!svg.contains("\n\n"), "a blank line ends a picture within documentation");
    }
}

#[cfg(feature = "cli")]
#[test]
fn the_readme_shows_the_help_as_it_is() {
    let trimmed = |t: String| t.lines().map(str::trim_end).collect::<Vec<_>>().join("\n").trim().to_owned();
    let shown = trimmed(fenced_after("## Options"));
    let help = trimmed(printed(&["-h"]));
    if std::env::var_os("UPDATE_README").is_some() {
        return fs::write(root().join("README.md"), text("README.md").replace(&shown, &help)).unwrap();
    }
    assert!(shown == help, "the help text in README.md is not up to date; it should be:\n{help}");
}

#[cfg(feature = "cli")]
#[test]
fn the_commands_of_the_readme_name_what_exists() {
    let readme = text("README.md");
    let command = readme.lines().find(|l| l.starts_with("    cargo run")).unwrap();
    let arguments: Vec<&str> = command.split_once(" -- ").unwrap().1.split_whitespace().collect();
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("keyhole.nc");
    let arguments: Vec<&str> =
        arguments.iter().map(|a| if *a == "keyhole.nc" { output.to_str().unwrap() } else { a }).collect();
    printed(&arguments);
    assert!(fs::read_to_string(output).unwrap().contains("M30"));
    for link in readme.split("](").skip(1).filter_map(|l| l.split_once(')')).map(|l| l.0) {
        assert!(link.starts_with("https://") || root().join(link).exists(), "{link}");
    }
}

#[test]
fn every_sample_states_its_point_in_its_first_lines() {
    for entry in fs::read_dir(root().join("samples")).unwrap() {
        let path = entry.unwrap().path();
        let sample = fs::read_to_string(&path).unwrap();
        let mut lines = sample.lines();
        let (code, point) = (lines.next().unwrap().trim(), lines.next().unwrap());
        assert!(code == "999" && point.len() > 20 && point.ends_with('.'), "{}", path.display());
    }
}

#[test]
fn the_changelog_knows_the_version() {
    let (changelog, version) = (text("CHANGELOG.md"), env!("CARGO_PKG_VERSION"));
    let released = changelog.contains(&format!("## [{version}]"));
    assert!(released || changelog.contains("## [Unreleased]"), "{version}");
}
