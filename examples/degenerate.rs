//! Families of nearly degenerate pockets by the hundred thousand: `degenerate [SEEDS] [FIRST SEED] [digits]`.
//! Their numbers are off by up to 32 units in the last place; with `digits`, by up to ten million of them.
//!
//! Prints for each family how many pockets there were, how many of them were refused (a hair-thin neck that
//! closes when it is perturbed is no pocket), their sites, the failures, and the largest residual of the
//! certificate relative to the size.

#[path = "../tests/support/families.rs"]
mod families;
#[path = "../tests/support/shapes.rs"]
mod shapes;

use families::{FAMILIES, Figures, Noise};
use rayon::prelude::*;

fn main() {
    let mut args = std::env::args().skip(1);
    let mut number = |default: u64| args.next().map_or(default, |a| a.parse().expect("a number"));
    let (seeds, first) = (number(8334), number(1));
    let noise = if args.next().is_some_and(|a| a == "digits") { Noise::Digits } else { Noise::Ulps };
    println!("  family   pockets  refused     sites  failures  residual");
    let mut failures = 0;
    for family in FAMILIES {
        let results: Vec<Result<Figures, String>> =
            (first..first + seeds).into_par_iter().map(|seed| families::run(family, seed, noise)).collect();
        let faults: Vec<&String> = results.iter().filter_map(|r| r.as_ref().err()).collect();
        faults.iter().for_each(|e| println!("{e}"));
        failures += faults.len();
        let found = || results.iter().flatten();
        println!(
            "{family:>8}  {:>8}  {:>7}  {:>8}  {:>8}  {:.1e}",
            results.len(),
            found().filter(|f| f.refused).count(),
            found().map(|f| f.sites).sum::<usize>(),
            faults.len(),
            found().map(|f| f.residual).fold(0.0, f64::max)
        );
    }
    println!("{failures} failures");
    std::process::exit(i32::from(failures > 0));
}
