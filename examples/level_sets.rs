//! Level sets at scale: what many levels cost beside their axis, in time and in memory.
//!
//!     cargo run --release --example level_sets [-- ELEMENTS [LEVELS]]
//!
//! One after the other, on one thread: 20 levels of each shape against its axis, then as many as asked for.

#[path = "../benches/peers/shapes.rs"]
mod shapes;

use medial::{Error, Pocket, Tolerance};
use std::time::Instant;

/// The largest memory that the process had so far, in megabytes, where the system tells it.
fn peak() -> f64 {
    let told = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = told.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok()).map_or(0.0, |kb| kb / 1024.0)
}

/// Seconds that this thread has run, where the system tells it.
fn seconds(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

fn main() -> Result<(), Error> {
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().expect("one thread");
    let start = Instant::now();
    let number =
        |i: usize, default: usize| std::env::args().nth(i).and_then(|a| a.parse().ok()).unwrap_or(default);
    let (size, count) = (number(1, 100_000), number(2, 10_000));
    println!("shape      elements   axis ms  20 levels ms   ratio   arcs out  us per arc    peak MB");
    for name in shapes::NAMES {
        let pocket = Pocket::from_loops(shapes::make(name, size), Tolerance { fit: 0.0, join: 0.0 })?;
        let elements: usize = pocket.loops().map(|l| l.len()).sum();
        let begin = seconds(start);
        let mat = pocket.medial_axis()?;
        let axis = seconds(start) - begin;
        let largest = mat.levels().largest_disk().radius;
        for levels in if name == "plate" { vec![20, count] } else { vec![20] } {
            let distances = (0..levels).map(|k| (k as f64 + 0.5) / levels as f64 * largest);
            let begin = seconds(start);
            let arcs: usize = mat.level_sets(distances).flat_map(|l| l.loops).map(|l| l.len()).sum();
            let time = seconds(start) - begin;
            println!(
                "{name:<10}{elements:>9}{:>10.1}{:>14.1}{:>8.2}{arcs:>11}{:>12.3}{:>11.1}{}",
                1e3 * axis,
                1e3 * time,
                time / axis,
                1e6 * time / arcs as f64,
                peak(),
                if levels == 20 { String::new() } else { format!("  {levels} levels") }
            );
        }
    }
    Ok(())
}
