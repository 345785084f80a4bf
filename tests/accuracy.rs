//! Deviations of level sets from exact distances, which may only become smaller.
//!
//! `cargo run --release --example accuracy` prints the table, and tightens it with `--write`.

#[path = "support/accuracy.rs"]
mod accuracy;

use accuracy::{LIMIT, PLACEMENTS, deviations, drawings, table};
use rayon::prelude::*;

#[test]
fn no_level_is_farther_off_than_it_ever_was() {
    let table = table();
    let worse: Vec<String> = drawings()
        .par_iter()
        .flat_map_iter(|(name, pockets)| {
            let allowed = table.get(name).unwrap_or_else(|| panic!("{name} is not in the table"));
            let found = deviations(pockets);
            let placements =
                (0..PLACEMENTS.len()).filter(move |&i| found[i].is_nan() || found[i] > allowed[i]);
            placements
                .map(move |i| format!("{name}, {}: {:e}, not {:e}", PLACEMENTS[i].0, found[i], allowed[i]))
        })
        .collect();
    assert!(worse.is_empty(), "{}", worse.join("\n"));
}

#[test]
fn what_is_allowed_is_round_off() {
    let table = table();
    assert_eq!(table.len(), drawings().len());
    for (name, allowed) in table {
        assert!(allowed.iter().all(|&a| a > 0.0 && a <= LIMIT), "{name}: {allowed:?}");
    }
}
