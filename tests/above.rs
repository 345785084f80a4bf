//! The axis from a radius up, held against the whole one; and programs made from both.

#[path = "support/families.rs"]
mod families;
#[path = "support/shapes.rs"]
mod shapes;

use families::{FAMILIES, Noise};
use medial::toolpath::Job;
use medial::{ArcSpline, AxisEdge, AxisVertex, Level, Mat, Pocket, Tolerance, Units, point};
use rayon::prelude::*;
use std::process::Command;

/// Seeds of each family and kind.
const SEEDS: u64 = 12;

/// Parts of the largest radius from which on the axis is asked for.
const PARTS: [f64; 9] = [0.01, 0.1, 0.3, 0.6, 0.9, 0.999_999, 1.001, 3.0, 100.0];

/// Differences up to this part of the size are round-off: where ties are broken otherwise, feet and disks differ.
const ROUND_OFF: f64 = 1e-9;

fn axis(loops: &[ArcSpline]) -> Option<(Pocket, Mat)> {
    let pocket = Pocket::from_loops(loops.to_vec(), Tolerance::MM).ok()?;
    let mat = pocket.medial_axis().ok()?;
    Some((pocket, mat))
}

/// What an axis has from a radius up: vertices, and edges by the places of their ends.
fn from_radius(mat: &Mat, least: f64) -> (Vec<AxisVertex>, usize) {
    let vertices = mat.vertices();
    let is_in = |v: u32| vertices[v as usize].disk.radius >= least;
    let edges = mat.edges().iter().filter(|e: &&AxisEdge| is_in(e.from) && is_in(e.to)).count();
    let mut found: Vec<AxisVertex> = vertices.iter().copied().filter(|v| v.disk.radius >= least).collect();
    found.sort_by(|a, b| a.disk.center.x.total_cmp(&b.disk.center.x));
    (found, edges)
}

/// How much a part of an axis differs from the whole, in words.
fn difference(pocket: &Pocket, whole: &Mat, least: f64) -> Option<String> {
    let error = ROUND_OFF * pocket.bounds().diagonal();
    let largest = whole.largest_disk().radius;
    let part = match pocket.medial_axis_above(least) {
        Ok(Some(part)) => part,
        Ok(None) => return (largest > least + error).then(|| "nothing is found".to_owned()),
        Err(e) => return Some(e.to_string()),
    };
    if largest < least - error {
        return Some("something is found".to_owned());
    }
    if let (Ok(_), Err(fault)) = (whole.check(), part.check()) {
        return Some(fault.to_string());
    }
    let [(a, edges_a), (b, edges_b)] = [whole, &part].map(|mat| from_radius(mat, least + error));
    // Ties may be broken otherwise, so that edges as short as round-off are contracted or not.
    if edges_a + b.len() != edges_b + a.len() {
        return Some(format!("{} vertices and {edges_a} edges, {} and {edges_b}", a.len(), b.len()));
    }
    if let Some(missed) = missed(&a, &b, error).or_else(|| missed(&b, &a, error)) {
        return Some(format!("{missed:?} has only one of both"));
    }
    let levels = [1.0, 1.000_001, 1.2].into_iter().map(|by| by * least);
    levels.into_iter().find_map(|d| level_difference(&whole.level(d), &part.level(d), error))
}

/// A vertex of one axis that another has not.
fn missed(a: &[AxisVertex], b: &[AxisVertex], error: f64) -> Option<AxisVertex> {
    let is_there = |v: &&AxisVertex| {
        let first = b.partition_point(|w| w.disk.center.x < v.disk.center.x - error);
        let near = b[first..].iter().take_while(|w| w.disk.center.x <= v.disk.center.x + error);
        let apart =
            |w: &AxisVertex| w.disk.center.distance(v.disk.center).max((w.disk.radius - v.disk.radius).abs());
        near.map(apart).any(|apart| apart <= error)
    };
    a.iter().find(|v| !is_there(v)).copied()
}

fn level_difference(a: &Level, b: &Level, error: f64) -> Option<String> {
    let length = |level: &Level| -> f64 { level.loops.iter().map(ArcSpline::length).sum() };
    let areas = |level: &Level| -> f64 { level.loops.iter().map(ArcSpline::area).sum() };
    if (a.loops.len(), a.ridges.len()) != (b.loops.len(), b.ridges.len()) {
        let counts = |l: &Level| (l.loops.len(), l.ridges.len());
        return Some(format!("level {}: {:?} and {:?}", a.distance, counts(a), counts(b)));
    }
    let count: usize = a.loops.iter().map(|l| l.vertices.len()).sum();
    let slack = error * (1 + count) as f64;
    let is_same =
        (length(a) - length(b)).abs() <= slack && (areas(a) - areas(b)).abs() <= slack * (1.0 + length(a));
    (!is_same).then(|| format!("level {}: other loops", a.distance))
}

fn differences(name: &str, loops: &[ArcSpline]) -> Vec<String> {
    let Some((pocket, whole)) = axis(loops) else { return Vec::new() };
    let largest = whole.largest_disk().radius;
    let of_part = |part: &f64| {
        let what = difference(&pocket, &whole, part * largest)?;
        Some(format!("{name}, from {part} of {largest}: {what}"))
    };
    PARTS.iter().filter_map(of_part).collect()
}

fn none(found: Vec<String>) {
    assert!(found.is_empty(), "{} failures:\n{}", found.len(), found.join("\n"));
}

#[test]
fn the_part_of_a_degenerate_axis_is_that_of_the_whole() {
    let cases = FAMILIES.par_iter().flat_map(|family| (1..=SEEDS).into_par_iter().map(move |s| (*family, s)));
    none(
        cases
            .flat_map_iter(|(family, seed)| {
                let noise = if seed % 2 == 0 { Noise::Ulps } else { Noise::Digits };
                differences(&format!("{family} {seed}"), &families::make(family, seed, noise))
            })
            .collect(),
    );
}

#[test]
fn the_part_of_any_axis_is_that_of_the_whole() {
    let cases =
        shapes::KINDS.par_iter().flat_map(|kind| (1..=SEEDS).into_par_iter().map(move |s| (*kind, s)));
    none(
        cases
            .flat_map_iter(|(kind, seed)| {
                let loops = shapes::make(kind, 100 + 60 * seed as usize, seed);
                differences(&format!("{kind} {seed}"), &loops)
            })
            .collect(),
    );
}

#[test]
fn from_nothing_up_it_is_the_whole_axis() {
    for d in [0.0, -1.0, f64::NAN] {
        let (pocket, whole) = axis(&shapes::make(shapes::KINDS[0], 200, 1)).unwrap();
        let part = pocket.medial_axis_above(d).unwrap().unwrap();
        assert_eq!((part.counts(), part.least_radius()), (whole.counts(), 0.0));
    }
}

/// Narrow slots with ragged walls off a wide pocket: what lies in them is left out.
#[test]
fn little_is_computed_where_the_disk_does_not_fit() {
    let mut wall = vec![point(0.0, 0.0), point(100.0, 0.0), point(100.0, 100.0)];
    for slot in (0..10).rev() {
        let x = 10.0 * f64::from(slot) + 5.0;
        let side =
            |right: f64| (0..30).map(move |i| point(x + right * f64::from(1 + i % 2), 100.0 + f64::from(i)));
        wall.extend(side(1.0).chain(side(-1.0).rev()));
    }
    wall.push(point(0.0, 100.0));
    let (pocket, whole) = axis(&[shapes::polygon(wall)]).unwrap();
    let part = pocket.medial_axis_above(5.0).unwrap().unwrap();
    assert!(part.counts().edges < whole.counts().edges / 4, "{:?} of {:?}", part.counts(), whole.counts());
    assert_eq!(difference(&pocket, &whole, 5.0), None);
}

/// A program for which nobody asks what is out of reach is made from a part of each axis.
#[test]
fn programs_do_not_depend_on_what_is_told_besides() {
    let samples = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/");
    let mut programs = 0;
    for sample in
        ["gear", "h-neck", "inch", "keyhole", "loose", "nested", "plate21", "rect-island", "sharp", "slot"]
    {
        for tool in ["0.8mm", "2.5mm", "4mm", "7mm", "12mm"] {
            let program = |more: &[&str]| {
                let drawing = format!("{samples}{sample}.dxf");
                let asked = [&drawing, "--tool", tool, "--step", "45%", "-o", "-"];
                let output =
                    Command::new(env!("CARGO_BIN_EXE_pocket")).args(asked).args(more).output().unwrap();
                (output.status.code(), output.stdout)
            };
            let (told, quiet) = (program(&[]), program(&["--quiet"]));
            assert!(told == quiet, "{sample}, tool {tool}");
            programs += usize::from(told.0 == Some(0));
        }
    }
    assert!(programs > 30, "{programs}");
}

/// Levels below the radius from which on an axis is whole are refused, not guessed.
#[test]
fn a_job_refuses_an_axis_that_does_not_hold_its_wall_passes() {
    let (pocket, whole) = axis(&shapes::make(shapes::KINDS[0], 400, 3)).unwrap();
    let radius = 0.9 * whole.largest_disk().radius;
    let Some(part) = pocket.medial_axis_above(radius).unwrap().filter(|mat| mat.least_radius() > 0.0) else {
        panic!("a part of the axis")
    };
    let job = |tool: f64| Job::new(Units::Mm, tool, 0.4 * tool);
    assert!(job(1.9 * radius).levels(&part).is_err());
    assert_eq!(
        job(2.0 * radius).levels(&part).unwrap().len(),
        job(2.0 * radius).levels(&whole).unwrap().len()
    );
    assert!(part.unreachable_area(radius).is_nan());
    let path = job(2.0 * radius).path(&[part]).unwrap();
    assert_eq!(path.pockets[0].unreachable_area, None);
}
