//! Mutated drawings through the whole pipeline, for as long as is wanted:
//! `fuzz [SECONDS] [FIRST SEED] [FOLDER]`.
//!
//! Prints executions and finds. Each find is made small and written into the folder, one file for each
//! kind of fault. `current.dxf` there is the drawing at hand, for the case that the process dies.
//! A trial that takes longer than [`LIMIT`] ends the process.

#[path = "../tests/support/fuzz/mod.rs"]
mod fuzz;

use fuzz::trial::Figures;
use fuzz::{mutate, shrink, trial};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A trial should never take so long.
const LIMIT: Duration = Duration::from_secs(60);

/// Slower ones are finds.
const SLOW: Duration = Duration::from_secs(5);

/// Files written for one kind of fault.
const FILES: usize = 3;

/// Where the last panic was.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// The trial at hand.
static CURRENT: AtomicU64 = AtomicU64::new(0);

fn main() -> std::io::Result<()> {
    let mut args = std::env::args().skip(1);
    let mut number = |default: u64| args.next().map_or(default, |a| a.parse().expect("a number"));
    let (seconds, first) = (number(60), number(1));
    let folder = args.next();
    let folder = folder.as_deref().map(Path::new);
    folder.map_or(Ok(()), std::fs::create_dir_all)?;
    std::panic::set_hook(Box::new(|info| {
        *PANIC.lock().expect("a lock") = info.to_string().replace('\n', " ");
    }));
    watch();
    let (start, mut finds, mut total) = (Instant::now(), BTreeMap::new(), Figures::default());
    let mut seed = first;
    while start.elapsed() < Duration::from_secs(seconds) {
        CURRENT.store(seed, Ordering::Relaxed);
        let bytes = mutate::file(seed);
        folder.map_or(Ok(()), |f| std::fs::write(f.join("current.dxf"), &bytes))?;
        match attempt(&bytes, seed) {
            Ok(figures) => add(&mut total, figures),
            Err(fault) => note(&mut finds, &fault, seed, &bytes, folder)?,
        }
        seed += 1;
    }
    println!("{} executions, {total:?}", seed - first);
    finds.iter().for_each(|(kind, count)| println!("{count:>6}  {kind}"));
    Ok(())
}

/// Ends the process when a trial hangs.
fn watch() {
    std::thread::spawn(|| {
        let (mut seen, mut since) = (0, Instant::now());
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let now = CURRENT.load(Ordering::Relaxed);
            if now != seen {
                (seen, since) = (now, Instant::now());
            } else if since.elapsed() > LIMIT {
                println!("seed {now} hangs");
                std::process::exit(2);
            }
        }
    });
}

/// One trial; the fault if there is one.
fn attempt(bytes: &[u8], seed: u64) -> Result<Figures, String> {
    let start = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| trial::run(bytes, seed)))
        .unwrap_or_else(|_| Err(PANIC.lock().expect("a lock").clone()));
    if result.is_ok() && start.elapsed() > SLOW {
        return Err(format!("slow: {:?}", start.elapsed()));
    }
    result
}

/// What faults of one kind have in common: all but the numbers.
fn kind(fault: &str) -> String {
    let words = fault.split_whitespace().take(12);
    let plain = words.filter(|w| w.contains(".rs:") || !w.contains(|c: char| c.is_ascii_digit()));
    plain.take(8).collect::<Vec<_>>().join(" ")
}

fn note(
    finds: &mut BTreeMap<String, usize>,
    fault: &str,
    seed: u64,
    bytes: &[u8],
    folder: Option<&Path>,
) -> std::io::Result<()> {
    let kind_of_this = kind(fault);
    let count = finds.entry(kind_of_this.clone()).or_insert(0);
    *count += 1;
    let (Some(folder), true) = (folder, *count <= FILES) else { return Ok(()) };
    let same = |bytes: &[u8]| attempt(bytes, seed).is_err_and(|f| kind(&f) == kind_of_this);
    let slow = fault.starts_with("slow");
    let small = if slow { bytes.to_vec() } else { shrink::shrink(bytes, &same) };
    let now = attempt(&small, seed).err().unwrap_or_default();
    println!("seed {seed}: {fault}\n   small: {now}");
    std::fs::write(folder.join(format!("{seed}.dxf")), &small)?;
    std::fs::write(folder.join(format!("{seed}.txt")), format!("{fault}\n{now}\n"))
}

fn add(total: &mut Figures, of: Figures) {
    total.curves += of.curves;
    total.pockets += of.pockets;
    total.levels += of.levels;
    total.moves += of.moves;
}
