//! Random pockets by the hundred: certificate, brute force, and other ways to draw the same.

#[path = "support/alike.rs"]
mod alike;
#[path = "support/brute.rs"]
mod brute;
#[path = "support/shapes.rs"]
mod shapes;
#[path = "support/trial.rs"]
mod trial;

use medial::{Pocket, Tolerance};
use rayon::prelude::*;

#[test]
fn every_random_axis_passes_all_trials() {
    let faults: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map(|kind| (1..=25u64).into_par_iter().map(move |seed| (*kind, seed)))
        .filter_map(|(kind, seed)| trial::run(kind, 30 + (seed as usize * 2711) % 1970, seed).err())
        .collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

/// Largest residual, relative to the size, where an element of that share of it is tilted by round-off.
const TILT: f64 = 1e-8;

/// A vertex drawn twice, not quite at one place: the element between has no direction of its own.
#[test]
fn elements_as_short_as_round_off_do_no_harm() {
    let lengths = [1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-8];
    let mut faults = Vec::new();
    for kind in ["smooth", "fingers", "isles", "spiral", "coast"] {
        for seed in 1..=10u64 {
            for length in lengths {
                let mut loops = shapes::make(kind, 300, seed);
                insert_short_element(&mut loops[0], 17, length);
                let mat = Pocket::from_loops(loops, Tolerance::MM).and_then(|p| p.medial_axis());
                let residuals =
                    mat.map_err(|e| e.to_string()).and_then(|m| m.check().map_err(|e| e.to_string()));
                let worst = residuals.map(|r| r.empty.max(r.touch).max(r.monotone));
                // The certificate allows for the tilt of such elements; what they do must stay far below.
                if !worst.as_ref().is_ok_and(|w| *w < TILT) {
                    faults.push(format!("{kind}, seed {seed}, {length:e}: {worst:?}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

/// Splits element `i` in its middle, and again a given length further on.
fn insert_short_element(spline: &mut medial::ArcSpline, i: usize, length: f64) {
    let (before, rest) = spline.element(i).split(0.5);
    let (short, after) = rest.split((length / rest.length()).min(0.9));
    spline.vertices[i].bulge = before.bulge;
    let vertex = |e: medial::Element| medial::Vertex { point: e.start, bulge: e.bulge };
    spline.vertices.insert(i + 1, vertex(short));
    spline.vertices.insert(i + 2, vertex(after));
}
