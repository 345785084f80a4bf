//! Axis, level sets and whole jobs of large pockets: `cargo bench [FILTER]`, as in `cargo bench axis/snow`.
//!
//! Shapes as `tests/support/large.rs` describes them, of 1000 to 100,000 elements; up to a million with
//! `LARGEST=1000000`. Throughput is in sites of the axis per second; `RAYON_NUM_THREADS=1` for one core.

#[path = "../tests/support/large.rs"]
mod large;
#[path = "../tests/support/shapes.rs"]
mod shapes;

use divan::Bencher;
use divan::counter::ItemsCount;
use medial::io::gcode;
use medial::{Job, Mat, Pocket, Tolerance, Units};

fn main() {
    divan::main();
}

/// Largest size without a request for more.
const LARGEST: usize = 100_000;

/// Names of all shapes, the small ones first.
fn cases() -> impl Iterator<Item = String> {
    let largest = std::env::var("LARGEST").ok().and_then(|n| n.parse().ok()).unwrap_or(LARGEST);
    let sizes = [1_000, 10_000, 100_000, 1_000_000].into_iter().filter(move |n| *n <= largest);
    sizes.flat_map(|n| large::KINDS.map(|kind| format!("{kind}/{n}")))
}

fn pocket(case: &str) -> Pocket {
    let (kind, size) = case.split_once('/').expect("a kind and a size");
    let loops = large::make(kind, size.parse().expect("a size"));
    Pocket::from_loops(loops, Tolerance::MM).expect("a pocket")
}

fn axis_of(pocket: &Pocket) -> Mat {
    pocket.medial_axis().expect("an axis")
}

/// From finished arc splines to the finished axis.
#[divan::bench(args = cases(), sample_size = 1, max_time = 3)]
fn axis(bencher: Bencher, case: &str) {
    let pocket = pocket(case);
    let sites = axis_of(&pocket).counts().sites;
    bencher.counter(ItemsCount::new(sites)).bench(|| axis_of(&pocket));
}

/// Levels of one pocket, evenly from the wall to the largest disk.
const LEVELS: u32 = 20;

/// Twenty level sets of a finished axis.
#[divan::bench(args = cases(), sample_size = 1, max_time = 3)]
fn levels(bencher: Bencher, case: &str) {
    let mat = axis_of(&pocket(case));
    let largest = mat.largest_disk().radius;
    bencher.counter(ItemsCount::new(mat.counts().sites)).bench(|| {
        (1..=LEVELS).map(|i| mat.level(largest * f64::from(i) / f64::from(LEVELS))).collect::<Vec<_>>()
    });
}

/// From finished arc splines to the text of a program of ten passes.
#[divan::bench(args = cases(), sample_size = 1, max_time = 3)]
fn job(bencher: Bencher, case: &str) {
    let pocket = pocket(case);
    let mat = axis_of(&pocket);
    let step = 0.1 * mat.largest_disk().radius;
    let mut job = Job::new(Units::Mm, 2.0 * step, step);
    job.depth = step;
    bencher.counter(ItemsCount::new(mat.counts().sites)).bench(|| {
        let path = job.path(&[axis_of(&pocket)]).expect("a path");
        gcode::write(&path.moves, &gcode::Setup::new(Units::Mm)).expect("a program").text.len()
    });
}
