//! Level sets by several libraries, of the same shapes in one run: time, size, deviation, wrong places.
//!
//!     cargo bench --bench peers
//!     cargo bench --bench peers -- plate 10000 20
//!
//! Arguments: shape, elements, levels. Without any, all shapes with 1,000 elements and 20 levels.
//!
//! All run on one thread; time is that of the processor where the system tells it, and includes whatever
//! a library prepares (the medial axis, an index). Level k of K lies at `(k - 1/2) / K` of the largest
//! radius. Libraries without arcs get lines within 0.005 mm. A library that takes longer than
//! [`PATIENCE`] stops there; its time is that of so many levels, taken for all. A place (a vertex or the middle
//! of an element) is wrong when it is off by more than a millionth of the size, or four times what arcs
//! were flattened by; faults are what the judge finds beyond that, parts that are missing or too much.

mod peers;
mod shapes;

use medial::ArcSpline;
use medial::verify::Boundary;
use peers::{PEERS, Peer, SAG, voronoi};
use std::time::Instant;

/// Seconds after which a library is asked for no more levels.
const PATIENCE: f64 = 20.0;

/// Seconds that a library runs at least: the system counts in ticks of a few milliseconds.
const STEADY: f64 = 0.4;

/// Most elements of a level for which the judge also looks for what is missing.
const JUDGED: usize = 50_000;

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().expect("one thread");
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let number = |i: usize, default: usize| words.get(i).and_then(|w| w.parse().ok()).unwrap_or(default);
    let (size, count) = (number(1, 1000), number(2, 20));
    let names: Vec<&str> = words.first().map_or(shapes::NAMES.to_vec(), |name| vec![name.as_str()]);
    for name in names {
        compare(name, size, count);
    }
}

/// Seconds that this thread has run.
fn seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let start = START.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

/// One shape, all libraries.
fn compare(name: &str, size: usize, count: usize) {
    let loops = shapes::make(name, size);
    let elements: usize = loops.iter().map(ArcSpline::len).sum();
    let flat: Vec<ArcSpline> = loops.iter().map(flattened).collect();
    let boundary = Boundary::new(&loops);
    let pocket = medial::Pocket::from_loops(loops.clone(), medial::Tolerance { fit: 0.0, join: 0.0 });
    let radius = pocket.expect("a pocket").medial_axis().expect("an axis").largest_disk().radius;
    let distances: Vec<f64> = (0..count).map(|k| (k as f64 + 0.5) / count as f64 * radius).collect();
    let lines: usize = flat.iter().map(ArcSpline::len).sum();
    println!("\n{name}: {elements} elements ({lines} lines), {} loops, {count} levels", loops.len());
    println!(
        "{:<20}{:>12}{:>10}{:>10}{:>12}{:>12}{:>20}{:>8}",
        "", "ms", "ratio", "levels", "loops out", "arcs out", "worst deviation", "wrong"
    );
    let mut ours = 0.0;
    for peer in &PEERS {
        let (time, levels) = run(peer, if peer.arcs { &loops } else { &flat }, &distances);
        if peer.name == "medial" {
            ours = time;
        }
        let within = if peer.arcs { 1e-6 * boundary.bounds().diagonal() } else { 4.0 * SAG };
        let done = levels.len();
        let all = || levels.iter().flat_map(|l| &l.1);
        let (worst, wrong, faults) = judged(&boundary, &levels, within);
        println!(
            "{:<20}{:>12.1}{:>10.2}{:>10}{:>12}{:>12}{:>20.1e}{:>8}  {faults}",
            peer.name,
            1e3 * time,
            time / ours,
            format!("{done}/{count}"),
            all().count(),
            all().map(ArcSpline::len).sum::<usize>(),
            worst,
            wrong
        );
    }
    let start = seconds();
    let edges = voronoi(&flat).map_or("failed".into(), |n| format!("{n} edges, no levels"));
    let time = seconds() - start;
    println!("{:<20}{:>12.1}{:>10.2}  {edges}", "boostvoronoi", 1e3 * time, time / ours);
}

/// Distances with their curves.
type Made = Vec<(f64, Vec<ArcSpline>)>;

/// The time that a library takes for all levels, and those that it made: the mean of as many runs as
/// make [`STEADY`] seconds.
fn run(peer: &Peer, loops: &[ArcSpline], distances: &[f64]) -> (f64, Made) {
    let start = seconds();
    let (mut sum, made) = run_once(peer, loops, distances);
    let mut runs = 1;
    while seconds() - start < STEADY {
        sum += run_once(peer, loops, distances).0;
        runs += 1;
    }
    (sum / f64::from(runs), made)
}

fn run_once(peer: &Peer, loops: &[ArcSpline], distances: &[f64]) -> (f64, Made) {
    let start = seconds();
    let mut levels = (peer.start)(loops);
    let prepared = seconds();
    let mut made = Vec::new();
    for &d in distances {
        made.push((d, levels(d)));
        if seconds() - start > PATIENCE {
            break;
        }
    }
    let share = distances.len() as f64 / made.len().max(1) as f64;
    (prepared - start + (seconds() - prepared) * share, made)
}

/// Worst deviation, number of wrong places, and what the judge says.
fn judged(boundary: &Boundary, levels: &Made, within: f64) -> (f64, usize, String) {
    let (mut worst, mut wrong, mut faults, mut asked) = (0.0f64, 0, 0, 0);
    for (d, curves) in levels {
        let middles = |s: &ArcSpline| s.elements().map(|e| e.midpoint()).collect::<Vec<_>>();
        let places = curves.iter().flat_map(|s| s.vertices.iter().map(|v| v.point).chain(middles(s)));
        for place in places {
            let off = (boundary.distance(place) - d).abs();
            worst = worst.max(off);
            wrong += usize::from(off.is_nan() || off > within);
        }
        if curves.iter().map(ArcSpline::len).sum::<usize>() <= JUDGED {
            asked += 1;
            faults += boundary.judge(*d, &boundary.turned(curves), within).fault_count;
        }
    }
    (worst, wrong, if asked == levels.len() { format!("{faults} faults") } else { String::new() })
}

/// A loop of lines within [`SAG`] of its arcs.
fn flattened(spline: &ArcSpline) -> ArcSpline {
    let places = spline.elements().flat_map(|e| {
        let radius = e.center().map_or(0.0, |c| c.1);
        let step = 2.0 * (1.0 - (SAG / radius).min(0.5)).acos();
        let parts = if e.is_segment() { 1 } else { (e.sweep().abs() / step).ceil().max(1.0) as usize };
        (0..parts).map(move |k| e.point_at(k as f64 / parts as f64))
    });
    ArcSpline::closed(places.map(|p| (p.x, p.y, 0.0)))
}
