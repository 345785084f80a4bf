//! Mutated drawings through the whole pipeline, a short run that is always the same, and all drawings
//! that once showed a fault. `examples/fuzz.rs` runs for as long as is wanted.

#![cfg(feature = "dxf")]

#[path = "support/fuzz/mod.rs"]
mod fuzz;

use fuzz::{mutate, trial};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Drawings of the short run.
const SEEDS: std::ops::Range<u64> = 0..2400;

#[test]
fn whatever_mutated_drawings_mean_is_cut_right() {
    let faults: Vec<String> = SEEDS
        .into_par_iter()
        .filter_map(|seed| Some(format!("seed {seed}: {}", trial::run(&mutate::file(seed), seed).err()?)))
        .collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn many_mutated_drawings_come_as_far_as_a_program() {
    let seeds = SEEDS.start..SEEDS.start + 200;
    let figures: Vec<_> = seeds.filter_map(|seed| trial::run(&mutate::file(seed), seed).ok()).collect();
    let programs = figures.iter().filter(|f| f.moves > 0).count();
    assert!(3 * programs > figures.len(), "{programs} of {}", figures.len());
}

/// The drawings of the corpus, in order.
fn corpus() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    files
}

#[test]
fn drawings_that_once_showed_a_fault_show_it_no_more() {
    for file in corpus() {
        let bytes = std::fs::read(&file).unwrap();
        for seed in 0..20 {
            let result = trial::run(&bytes, seed);
            assert!(result.is_ok(), "{}, seed {seed}: {result:?}", file.display());
        }
    }
}

#[test]
fn every_drawing_of_the_corpus_names_its_fault_and_has_a_number() {
    for (i, file) in corpus().iter().enumerate() {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        assert!(name.starts_with(&format!("{:03}-", i + 1)), "{name} is out of order");
        let text = String::from_utf8_lossy(&std::fs::read(file).unwrap()).into_owned();
        let mut lines = text.lines();
        let (code, fault) = (lines.next().unwrap().trim(), lines.next().unwrap());
        assert!(code == "999" && fault.len() > 20 && fault.ends_with('.'), "{name}: {fault}");
    }
}
