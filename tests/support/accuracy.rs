//! How far level sets are off, for a fixed set of drawings, and the table of what is allowed.
//!
//! Every drawing is taken as drawn, a thousand times smaller and larger, and moved by a million. The
//! deviation is that of vertices and middles of elements from their distance, measured by the exact
//! judge, relative to the size of the drawing; where it is moved, to the coordinates that hold it.
#![allow(dead_code)]

#[path = "../../benches/peers/shapes.rs"]
mod machined;

use machined::random;
use medial::io::dxf::{ReadOptions, read};
use medial::verify::Boundary;
use medial::{ArcSpline, Bounds, Pocket, Pockets, Tolerance, point};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The most that is allowed at all.
pub const LIMIT: f64 = 1e-12;

/// Levels at these shares of the largest radius.
const SHARES: [f64; 8] = [0.003, 0.02, 0.1, 0.25, 0.5, 0.75, 0.95, 0.999];

/// The placements: name, scale, shift.
pub const PLACEMENTS: [(&str, f64, f64); 4] =
    [("as drawn", 1.0, 0.0), ("x 0.001", 1e-3, 0.0), ("x 1000", 1e3, 0.0), ("+ 1000000", 1.0, 1e6)];

/// The deviation allowed for each drawing in each placement.
pub type Table = BTreeMap<String, [f64; 4]>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

pub fn table_path() -> PathBuf {
    root().join("tests/accuracy.txt")
}

/// All drawings with their names.
pub fn drawings() -> Vec<(String, Vec<Pocket>)> {
    let mut drawings = Vec::new();
    let mut samples: Vec<PathBuf> =
        std::fs::read_dir(root().join("samples")).unwrap().map(|entry| entry.unwrap().path()).collect();
    samples.sort();
    for path in samples {
        let drawing = read(&path, &ReadOptions::default()).unwrap();
        let found = Pockets::from_curves(&drawing.curves, drawing.units.tolerance()).unwrap();
        drawings.push((path.file_stem().unwrap().to_string_lossy().into_owned(), found.pockets));
    }
    let pocket = |loops| vec![Pocket::from_loops(loops, Tolerance { fit: 0.0, join: 0.0 }).unwrap()];
    for kind in random::KINDS {
        drawings.push((format!("random-{kind}"), pocket(random::make(kind, 240, 3))));
    }
    for name in machined::NAMES {
        drawings.push((format!("machined-{name}"), pocket(machined::make(name, 400))));
    }
    drawings
}

/// The deviations of a drawing in all placements.
pub fn deviations(pockets: &[Pocket]) -> [f64; 4] {
    PLACEMENTS.map(|(_, scale, shift)| {
        let placed = pockets.iter().map(|pocket| deviation(pocket, scale, shift));
        placed.fold(0.0, f64::max)
    })
}

/// The largest deviation of all levels of a pocket, relative to its size or its coordinates.
fn deviation(pocket: &Pocket, scale: f64, shift: f64) -> f64 {
    let map = |p: medial::Point| point(shift + scale * p.x, shift + scale * p.y);
    let loops: Vec<ArcSpline> = pocket.loops().map(|l| l.mapped(false, map)).collect();
    let bounds = loops.iter().fold(Bounds::EMPTY, |b, l| b.union(l.bounds()));
    let size = if shift == 0.0 { bounds.diagonal() } else { bounds.magnitude() };
    let pocket = Pocket::from_loops(loops, Tolerance { fit: 0.0, join: 0.0 }).unwrap();
    let mat = pocket.medial_axis().unwrap();
    let boundary = Boundary::new(pocket.loops());
    let largest = mat.largest_disk().radius;
    let off = |share: &f64| {
        let d = share * largest;
        let level = mat.level(d);
        let splines = level.loops.iter().chain(&level.ridges);
        let places = splines.flat_map(|s| {
            let middles = s.elements().map(|e| e.midpoint());
            s.vertices.iter().map(|v| v.point).chain(middles).collect::<Vec<_>>()
        });
        places.map(|p| (boundary.distance(p) - d).abs()).fold(0.0, f64::max)
    };
    SHARES.par_iter().map(off).reduce(|| 0.0, f64::max) / size
}

/// Two units in the last place of the size: a coordinate alone is rounded by a quarter of that, and what
/// is less is luck.
const LEAST: f64 = 5e-16;

/// The next of 1, 2, 5, 10 ... that is no smaller: what is written down, so that another machine, with
/// another sine, does not fail by a bit.
pub fn rounded_up(value: f64) -> f64 {
    if value <= LEAST {
        return LEAST;
    }
    let decade = 10f64.powi(value.log10().floor() as i32);
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * decade).find(|&m| m >= value).unwrap_or(10.0 * decade)
}

/// Reads the table; empty when there is none.
pub fn table() -> Table {
    let text = std::fs::read_to_string(table_path()).unwrap_or_default();
    let line = |line: &str| {
        let mut words = line.split_whitespace();
        let name = words.next()?.to_owned();
        let numbers: Vec<f64> = words.map(|w| w.parse().expect("a number")).collect();
        Some((name, numbers.try_into().expect("four numbers")))
    };
    text.lines().filter(|l| !l.starts_with('#')).filter_map(line).collect()
}

/// The table as text.
pub fn text(table: &Table) -> String {
    let mut text = String::from(
        "# Largest deviation of level sets, relative to the size of the drawing; these may only become smaller.\n",
    );
    let names = PLACEMENTS.map(|p| p.0);
    let _ =
        writeln!(text, "# {:<22}{:>12}{:>12}{:>12}{:>12}", "drawing", names[0], names[1], names[2], names[3]);
    for (name, [a, b, c, d]) in table {
        let _ = writeln!(text, "{name:<24}{a:>12.0e}{b:>12.0e}{c:>12.0e}{d:>12.0e}");
    }
    text
}
