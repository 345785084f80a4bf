//! Random pockets by the hundred: the certificate of the axis must hold for each.

#[path = "support/shapes.rs"]
mod shapes;

use medial::{Pocket, Tolerance};
use rayon::prelude::*;

/// What is wrong with the axis of one shape.
fn fault(kind: &str, size: usize, seed: u64) -> Option<String> {
    let named = |e: &dyn std::fmt::Display| format!("{kind} of {size} elements, seed {seed}: {e}");
    let pocket = match Pocket::from_loops(shapes::make(kind, size, seed), Tolerance::MM) {
        Ok(pocket) => pocket,
        Err(e) => return Some(named(&e)),
    };
    match pocket.medial_axis() {
        Err(e) => Some(named(&e)),
        Ok(mat) => mat.check().err().map(|e| named(&e)),
    }
}

#[test]
fn every_random_axis_passes_its_check() {
    let faults: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map(|kind| (1..=100u64).into_par_iter().map(move |seed| (*kind, seed)))
        .filter_map(|(kind, seed)| fault(kind, 30 + (seed as usize * 2711) % 1970, seed))
        .collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}
