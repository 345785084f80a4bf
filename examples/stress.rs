//! All trials of the axis over many random pockets: `stress [SEEDS] [SIZE] [FIRST SEED]`.
//!
//! Prints for each kind of shape how many there were, their sites, how many of these were given to the
//! second builder as well (which takes no islands), the failures, and the worst figures relative to the
//! size: the residual of the certificate, the deviation of brute-force disks
//! from the axis, and that of a vertex when the same pocket is drawn in another way, or far away.

#[path = "../tests/support/agreement.rs"]
mod agreement;
#[path = "../tests/support/alike.rs"]
mod alike;
#[path = "../tests/support/brute.rs"]
mod brute;
#[path = "../tests/support/shapes.rs"]
mod shapes;
#[path = "../tests/support/trial.rs"]
mod trial;

use rayon::prelude::*;
use trial::Figures;

fn main() {
    let mut args = std::env::args().skip(1).map(|a| a.parse::<u64>().expect("a number"));
    let (seeds, size) = (args.next().unwrap_or(1000), args.next().unwrap_or(2000));
    let first = args.next().unwrap_or(1);
    println!("      kind  shapes     sites   divided  failures  residual   brute    alike      far");
    let mut failures = 0;
    for kind in shapes::KINDS {
        let results: Vec<Result<Figures, String>> = (first..first + seeds)
            .into_par_iter()
            .map(|seed| trial::run(kind, spread(seed, size), seed))
            .collect();
        let faults: Vec<&String> = results.iter().filter_map(|r| r.as_ref().err()).collect();
        let worst = results.iter().flatten().fold(Figures::default(), worse);
        faults.iter().for_each(|e| println!("{e}"));
        failures += faults.len();
        println!(
            "{kind:>10}  {:>6}  {:>8}  {:>8}  {:>8}  {:.1e}  {:.1e}  {:.1e}  {:.1e}",
            results.len(),
            worst.sites,
            worst.divided,
            faults.len(),
            worst.residual,
            worst.brute,
            worst.alike,
            worst.far
        );
    }
    println!("{failures} failures");
    std::process::exit(i32::from(failures > 0));
}

/// A size up to the largest, small ones as often as large ones by their digits.
fn spread(seed: u64, size: u64) -> usize {
    const LEAST: f64 = 20.0;
    // The golden ratio spreads the seeds evenly.
    let share = (seed as f64 * 0.618_033_988_749_894_9).fract();
    (LEAST * (size as f64 / LEAST).max(1.0).powf(share)).round() as usize
}

/// The worst of both in each figure; counts are added up.
fn worse(a: Figures, b: &Figures) -> Figures {
    Figures {
        sites: a.sites + b.sites,
        residual: a.residual.max(b.residual),
        brute: a.brute.max(b.brute),
        alike: a.alike.max(b.alike),
        far: a.far.max(b.far),
        divided: a.divided + b.divided,
    }
}
