//! How far level sets are off from exact distances, drawing by drawing.
//!
//!     cargo run --release --example accuracy [-- --write]
//!
//! With `--write`, what has become better is the new limit of the test `accuracy`, in tests/accuracy.txt;
//! what has become worse stays what it was, and the test fails.

#[path = "../tests/support/accuracy.rs"]
mod accuracy;

use accuracy::{PLACEMENTS, deviations, drawings, rounded_up, table, table_path, text};

fn main() -> std::io::Result<()> {
    let mut limits = table();
    let names = PLACEMENTS.map(|p| p.0);
    println!("{:<24}{:>12}{:>12}{:>12}{:>12}", "drawing", names[0], names[1], names[2], names[3]);
    for (name, pockets) in drawings() {
        let found = deviations(&pockets);
        let [a, b, c, d] = found;
        println!("{name:<24}{a:>12.1e}{b:>12.1e}{c:>12.1e}{d:>12.1e}");
        let limit = limits.entry(name).or_insert([f64::INFINITY; 4]);
        for (limit, found) in limit.iter_mut().zip(found) {
            *limit = limit.min(rounded_up(found));
        }
    }
    if std::env::args().any(|a| a == "--write") {
        std::fs::write(table_path(), text(&limits))?;
        println!("written: {}", table_path().display());
    }
    Ok(())
}
