//! What a part of the axis costs: `axis_above [SIZE]`, about so many elements (100,000).
//!
//!     RAYON_NUM_THREADS=1 cargo run --release --example axis_above
//!
//! Microseconds per site of the whole axis, and of the axis from some parts of the largest radius up; the best of some
//! runs, beside it how much of the edges is left.

#[path = "../tests/support/large.rs"]
mod large;
#[path = "../tests/support/shapes.rs"]
mod shapes;

use medial::{Error, Mat, Pocket, Tolerance};
use std::time::{Duration, Instant};

/// Time for the runs of one number.
const TIME: Duration = Duration::from_secs(1);

/// Parts of the largest radius from which on the axis is asked for.
const PARTS: [f64; 7] = [0.01, 0.1, 0.3, 0.6, 0.9, 1.01, 2.0];

fn main() -> Result<(), Error> {
    let size = std::env::args().nth(1).map_or(100_000, |a| a.parse().expect("a number of elements"));
    println!("shape         sites   whole {}", PARTS.map(|part| format!("{part:>14}")).concat());
    for kind in large::KINDS {
        let pocket = Pocket::from_loops(large::make(kind, size), Tolerance::MM)?;
        let (time, whole) = best_of(|| pocket.medial_axis())?;
        let sites = whole.counts().sites as f64;
        let each = |time: Duration| 1e6 * time.as_secs_f64() / sites;
        print!("{kind:<10}{sites:>9}{:>8.3} ", each(time));
        for part in PARTS {
            let (time, axis) = best_of(|| pocket.medial_axis_above(part * whole.largest_disk().radius))?;
            let edges = axis.map_or(0, |mat: Mat| mat.counts().edges);
            print!("{:>8.3} {:>4.0}%", each(time), 100.0 * edges as f64 / whole.counts().edges as f64);
        }
        println!();
    }
    Ok(())
}

/// The shortest time that something takes, and what it made.
fn best_of<T>(make: impl Fn() -> Result<T, Error>) -> Result<(Duration, T), Error> {
    let timed = || {
        let start = Instant::now();
        make().map(|made| (start.elapsed(), made))
    };
    let (begin, mut best) = (Instant::now(), timed()?);
    while begin.elapsed() < TIME {
        let next = timed()?;
        best = if next.0 < best.0 { next } else { best };
    }
    Ok(best)
}
