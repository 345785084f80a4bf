//! What the axis answers without a level being made, against levels made: what a tool reaches, where a
//! pocket splits, what it must get through.

#[path = "support/shapes.rs"]
mod shapes;

use medial::verify::Boundary;
use medial::{ArcSpline, Mat, Pocket, Tolerance, Vector, point};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_3, TAU};

fn pocket(loops: Vec<ArcSpline>) -> Pocket {
    Pocket::from_loops(loops, Tolerance { fit: 0.0, join: 0.0 }).expect("a pocket")
}

/// Area that a disk of radius `r` does not reach, counted on a grid: places that are farther than `r` from
/// all places where its center can be.
fn counted(pocket: &Pocket, mat: &Mat, r: f64) -> f64 {
    const ROWS: i32 = 500;
    let level = mat.level(r);
    let centers = Boundary::new(level.loops.iter().chain(&level.ridges));
    let walls = Boundary::new(pocket.loops());
    let bounds = pocket.bounds();
    let cell = bounds.extent() / f64::from(ROWS);
    let lost = |i: i32| {
        let (x, y) = (f64::from(i / ROWS) + 0.5, f64::from(i % ROWS) + 0.5);
        let p = point(bounds.min.x + cell.x * x, bounds.min.y + cell.y * y);
        let reached = || centers.contains(p) || centers.distance(p) <= r;
        i32::from(walls.contains(p) && !reached())
    };
    let count: i32 = (0..ROWS * ROWS).into_par_iter().map(lost).sum();
    f64::from(count) * cell.x * cell.y
}

fn assert_reach(name: &str, pocket: &Pocket, shares: &[f64]) {
    let mat = pocket.medial_axis().unwrap();
    for share in shares {
        let r = share * mat.largest_disk().radius;
        let (area, counted) = (mat.unreachable_area(r), counted(pocket, &mat, r));
        let off = (area - counted).abs() / pocket.area();
        assert!(off < 2e-3, "{name} at {r}: {area}, counted {counted}");
    }
}

/// Three round chambers that open into each other: in the middle, where a tool of radius 9 has no room,
/// it reaches the same places from all three.
fn trefoil() -> ArcSpline {
    let (radius, apart) = (10.0f64, 11.0);
    let out = apart * FRAC_PI_3.cos() + (radius * radius - (apart * FRAC_PI_3.sin()).powi(2)).sqrt();
    let corner = |k: f64| point(0.0, 0.0) + Vector::from_angle(k * TAU / 3.0) * out;
    let half = (out * FRAC_PI_3.sin()).atan2(out * FRAC_PI_3.cos() - apart);
    let bulge = (0.5 * half).tan();
    ArcSpline::closed([0.0, 1.0, 2.0].map(|k| (corner(k).x, corner(k).y, bulge)))
}

#[test]
fn what_is_reached_from_three_sides_is_reached_once() {
    let pocket = pocket(vec![trefoil()]);
    assert_eq!(pocket.medial_axis().unwrap().levels().parts_at(9.0).len(), 3);
    assert_reach("trefoil", &pocket, &[0.86, 0.9, 0.95, 0.99]);
}

#[test]
fn areas_out_of_reach_are_those_that_are_counted() {
    for kind in ["smooth", "fingers", "isles", "hexagons", "gear", "spiral", "symmetric"] {
        let pocket = pocket(shapes::make(kind, 90, 5));
        assert_reach(kind, &pocket, &[0.2, 0.45, 0.7, 0.93]);
    }
}

#[test]
fn the_merge_tree_knows_how_many_loops_every_level_has() {
    let wrong: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map_iter(|kind| {
            let mat = pocket(shapes::make(kind, 200, 9)).medial_axis().unwrap();
            let tree = mat.levels();
            let radii: Vec<f64> = mat.vertices().iter().map(|v| v.disk.radius).filter(|r| *r > 0.0).collect();
            let near = radii.into_iter().step_by(7).flat_map(|r| [r * (1.0 - 1e-9), r, r * (1.0 + 1e-9)]);
            let differ = near.filter_map(|d| {
                let (known, made) = (tree.loops_at(d), mat.level(d).loops.len());
                (known != made).then(|| format!("{kind} at {d}: {known}, not {made}"))
            });
            differ.collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn between_two_parts_the_largest_tool_that_gets_through_is_that_of_the_passage() {
    for kind in ["smooth", "fingers", "isles", "symmetric", "wavy"] {
        let mat = pocket(shapes::make(kind, 150, 4)).medial_axis().unwrap();
        let tree = mat.levels();
        let peaks: Vec<usize> =
            (0..tree.parts.len()).filter(|&i| tree.parts[i].children.is_empty()).collect();
        for pair in peaks.windows(2) {
            let passage = tree.passage_between(pair[0], pair[1]).unwrap();
            // The part of the level that holds the center of a peak.
            let part = |d: f64, i: usize| {
                let mut at = i;
                while tree.parts[at].from > d {
                    at = tree.parts[at].parent.unwrap();
                }
                at
            };
            let (below, above) = (passage.radius * (1.0 - 1e-6), passage.radius * (1.0 + 1e-6));
            assert_eq!(part(below, pair[0]), part(below, pair[1]), "{kind}");
            assert_ne!(part(above, pair[0]), part(above, pair[1]), "{kind}");
            // And in the level made: as many loops as parts and holes.
            for d in [below, above] {
                let parts = tree.parts_at(d);
                let holes: usize = parts.iter().map(|&p| tree.holes_of(p, d)).sum();
                assert_eq!(mat.level(d).loops.len(), parts.len() + holes, "{kind} at {d}");
            }
        }
        let narrowest = tree.passages().map(|d| d.radius).fold(f64::INFINITY, f64::min);
        assert_eq!(tree.narrowest_passage().map_or(f64::INFINITY, |d| d.radius), narrowest);
    }
}
