//! The certificate of the axis over many random pockets: `stress [SEEDS] [SIZE]`.
//!
//! Prints for each kind of shape how many there were, their sites, the failures, and the largest
//! residual of any disk relative to the size.

#[path = "../tests/support/shapes.rs"]
mod shapes;

use medial::{Pocket, Tolerance};
use rayon::prelude::*;

fn main() {
    let mut args = std::env::args().skip(1).map(|a| a.parse().expect("a number"));
    let (seeds, size) = (args.next().unwrap_or(1000), args.next().unwrap_or(2000));
    let mut failures = 0;
    for kind in shapes::KINDS {
        let results: Vec<Result<(usize, f64), String>> =
            (1..=seeds as u64).into_par_iter().map(|seed| run(kind, size, seed)).collect();
        let (mut sites, mut worst) = (0, 0.0f64);
        for result in &results {
            match result {
                Ok((count, residual)) => (sites, worst) = (sites + count, worst.max(*residual)),
                Err(e) => {
                    println!("{e}");
                    failures += 1;
                }
            }
        }
        println!("{kind:>10}: {} shapes, {sites} sites, worst residual {worst:.1e}", results.len());
    }
    println!("{failures} failures");
    std::process::exit(i32::from(failures > 0));
}

/// Sites and largest residual of one shape.
fn run(kind: &str, size: usize, seed: u64) -> Result<(usize, f64), String> {
    let named = |e: &dyn std::fmt::Display| format!("{kind} of {size} elements, seed {seed}: {e}");
    let pocket = Pocket::from_loops(shapes::make(kind, size, seed), Tolerance::MM).map_err(|e| named(&e))?;
    let mat = pocket.medial_axis().map_err(|e| named(&e))?;
    let residuals = mat.check().map_err(|e| named(&e))?;
    Ok((mat.counts().sites, residuals.empty.max(residuals.touch).max(residuals.monotone)))
}
