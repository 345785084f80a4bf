//! What each stage of the axis takes, and its memory: `axis_stages [LARGEST]`, elements at most (100,000).
//!
//!     RAYON_NUM_THREADS=1 cargo run --release --example axis_stages -- 1000000
//!
//! Microseconds per site, the best of some runs, and how each shape grows beside `n log n` from the size before.
//! Memory is that of a process which makes the pocket and its axis once, where the system tells it.

#[path = "../tests/support/large.rs"]
mod large;
#[path = "../tests/support/shapes.rs"]
mod shapes;

use medial::{Error, Mat, Pocket, Stages, Tolerance};
use std::process::Command;
use std::time::{Duration, Instant};

/// Time for the runs of one shape.
const TIME: Duration = Duration::from_secs(2);

/// Word before kind and size that asks a process for its memory.
const MEMORY: &str = "memory";

fn main() -> Result<(), Error> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let [word, kind, size] = &args[..]
        && word == MEMORY
    {
        return tell_memory(kind, size.parse().expect("a size"));
    }
    let largest = args.first().map_or(100_000, |a| a.parse().expect("a number of elements"));
    println!(
        "{} threads; microseconds per site\nshape      elements     sites {}     all  / n log n   bytes per site",
        rayon::current_num_threads(),
        Stages::default().named().map(|(name, _)| format!("{name:>7}")).concat()
    );
    for kind in large::KINDS {
        let mut before = None;
        for size in [1_000, 10_000, 100_000, 1_000_000].into_iter().filter(|&n| n <= largest) {
            before = Some(row(kind, size, before)?);
        }
    }
    Ok(())
}

/// Prints a row; answers the time per site over the logarithm of their number.
fn row(kind: &str, size: usize, before: Option<f64>) -> Result<f64, Error> {
    let pocket = Pocket::from_loops(large::make(kind, size), Tolerance::MM)?;
    let elements: usize = pocket.loops().map(|l| l.len()).sum();
    let begin = Instant::now();
    let mut best = timed(&pocket)?;
    while begin.elapsed() < TIME {
        let next = timed(&pocket)?;
        best = if next.0 < best.0 { next } else { best };
    }
    let (all, mat) = best;
    let sites = mat.counts().sites as f64;
    let each = |time: Duration| 1e6 * time.as_secs_f64() / sites;
    let stages = mat.stages().named().map(|(_, time)| format!("{:>7.3}", each(time))).concat();
    let by_log = each(all) / sites.log2();
    let growth = before.map_or(String::from("-"), |b| format!("{:.2}", by_log / b));
    let memory = memory_of(kind, size).unwrap_or_else(|| "-".into());
    println!("{kind:<10}{elements:>9}{sites:>10} {stages}{:>8.3}{growth:>11}   {memory}", each(all));
    Ok(by_log)
}

fn timed(pocket: &Pocket) -> Result<(Duration, Mat), Error> {
    let start = Instant::now();
    let mat = pocket.medial_axis()?;
    Ok((start.elapsed(), mat))
}

/// Asks a process of its own for its memory.
fn memory_of(kind: &str, size: usize) -> Option<String> {
    let asked =
        Command::new(std::env::current_exe().ok()?).args([MEMORY, kind, &size.to_string()]).output().ok()?;
    let told = String::from_utf8(asked.stdout).ok()?;
    asked.status.success().then(|| told.trim().to_owned())
}

/// Prints what the axis adds to the memory of this process at most, and all that it has then.
fn tell_memory(kind: &str, size: usize) -> Result<(), Error> {
    let pocket = Pocket::from_loops(large::make(kind, size), Tolerance::MM)?;
    let before = resident("VmRSS:");
    let sites = pocket.medial_axis()?.counts().sites as f64;
    let peak = resident("VmHWM:");
    println!("{:.0} of {:.0}", (peak - before) / sites, peak / sites);
    Ok(())
}

/// Bytes, where the system tells them.
fn resident(name: &str) -> f64 {
    let told = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = told.lines().find_map(|l| l.strip_prefix(name));
    line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok()).map_or(f64::NAN, |kb| 1024.0 * kb)
}
