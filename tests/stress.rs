//! Random pockets by the hundred: the certificate of the axis must hold for each.

#[path = "support/shapes.rs"]
mod shapes;

fn run(kind: &str, seeds: std::ops::Range<u64>, size: usize) -> (usize, Vec<String>) {
    let mut failures = Vec::new();
    let mut sites = 0;
    for seed in seeds {
        let pocket =
            medial::Pocket::from_loops(shapes::make(kind, size, seed), medial::Tolerance::MM).unwrap();
        match pocket.medial_axis() {
            Err(e) => failures.push(format!("{kind} {seed}: {e}")),
            Ok(mat) => {
                sites += mat.counts().sites;
                if let Err(e) = mat.check() {
                    failures.push(format!("{kind} {seed} {size}: {e}"));
                }
            }
        }
    }
    (sites, failures)
}

#[test]
fn every_random_axis_passes_its_check() {
    for kind in shapes::KINDS {
        let t = std::time::Instant::now();
        let (sites, failures) = run(
            kind,
            1..std::env::var("SEEDS").map_or(51, |s| s.parse().unwrap()),
            std::env::var("SIZE").map_or(500, |s| s.parse().unwrap()),
        );
        println!(
            "{kind}: {sites} sites, {} failures {:?} {:?}",
            failures.len(),
            t.elapsed(),
            &failures[..failures.len().min(4)]
        );
    }
}
