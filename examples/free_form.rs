//! From a free-form outline to its medial axis, coarse to fine: `free_form [FINEST]`, the finest error as a
//! power of ten (-9).
//!
//! The outline is one closed cubic spline like a tree with twigs on its branches, after the shape of Table 1 of
//! Aichholzer et al., *Medial axis computation for planar free-form shapes*, 2009. Each row tells the error as
//! a multiple of `k`, a part of the size chosen so that the first row has about as many arcs as theirs; the arcs; the
//! seconds for the boundary, proof included, and for the axis; branch points and leaves, which stay the same; and
//! beside them the figures of the paper (seconds of a processor of 2006).

#[path = "../tests/support/tree.rs"]
mod tree;

use medial::{Bounds, Kind, Pocket, Tolerance};
use std::time::Instant;

/// The unit of errors, as a part of the size.
const K: f64 = 1e-3;

/// Arcs, seconds for the boundary and seconds for the axis, of the paper, from `K / 10` to `K / 1e9`.
const PAPER: [(usize, f64, f64); 9] = [
    (2_096, 0.06, 0.18),
    (3_736, 0.14, 0.36),
    (7_840, 0.32, 0.67),
    (16_970, 0.75, 1.53),
    (36_674, 1.65, 3.45),
    (78_736, 3.59, 7.21),
    (169_418, 7.76, 16.25),
    (364_528, 16.91, 36.49),
    (784_972, 36.76, 83.04),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let finest: i32 = std::env::args().nth(1).map_or(Ok(-9), |a| a.parse())?;
    let tree = tree::tree();
    let size = Bounds::around(tree.points().iter().copied()).diagonal();
    println!(
        "   error    arcs  boundary      axis   us/arc  branches  leaves | S0: arcs  boundary      axis"
    );
    for (power, (arcs, boundary, axis)) in (1..=-finest).zip(PAPER) {
        let start = Instant::now();
        let fit = tree.to_arcs(K * size * 10f64.powi(-power))?;
        let ours = start.elapsed().as_secs_f64();
        let pocket = Pocket::from_loops(vec![fit.path], Tolerance::MM)?;
        let start = Instant::now();
        let mat = pocket.medial_axis()?;
        let seconds = start.elapsed().as_secs_f64();
        let elements = pocket.outer().len();
        let vertices = mat.vertices();
        let count = |kind| vertices.iter().filter(|v| v.kind == kind).count();
        println!(
            "  k*1e-{power} {elements:>7} {ours:>9.4} {seconds:>9.4} {:>8.2} {:>9} {:>7} | {arcs:>8} {boundary:>9.2} {axis:>9.2}",
            (ours + seconds) * 1e6 / elements as f64,
            count(Kind::Branch),
            count(Kind::Leaf),
        );
        mat.check_within(Tolerance::MM.fit)?;
    }
    Ok(())
}
