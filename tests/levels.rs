//! Level sets held against the exact judge, and against each other.

#[path = "support/shapes.rs"]
mod shapes;

use medial::{ArcSpline, Kind, Mat, Pocket, Tolerance, verify};
use rayon::prelude::*;

/// Faults of the levels of one shape at some fractions of its largest radius.
fn faults(kind: &str, size: usize, seed: u64) -> Vec<String> {
    let loops = shapes::make(kind, size, seed);
    let mat = axis(&loops);
    let largest = mat.largest_disk().radius;
    let mut faults = Vec::new();
    for fraction in [0.01, 0.1, 0.3, 0.5, 0.77, 0.95] {
        let d = fraction * largest;
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
        let report = verify::level(&loops, d, &all);
        if !report.is_right() {
            faults.push(format!("{kind} of {size}, seed {seed}, level {d}: {report:?}"));
        }
    }
    faults
}

fn axis(loops: &[ArcSpline]) -> Mat {
    Pocket::from_loops(loops.to_vec(), Tolerance::MM).expect("a pocket").medial_axis().expect("an axis")
}

#[test]
fn every_level_of_random_shapes_is_judged_right() {
    let faults: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map(|kind| (1..=6u64).into_par_iter().map(move |seed| (*kind, seed)))
        .flat_map_iter(|(kind, seed)| faults(kind, 150 + 40 * seed as usize, seed))
        .collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

/// Where all slots are as wide as each other, but for some digits: levels at their radii and next to
/// them. Crossings slid along walls that are parallel to round-off, out of the slot.
#[test]
fn every_level_at_a_critical_radius_is_judged_right() {
    let critical = |v: &medial::AxisVertex| matches!(v.kind, Kind::Neck | Kind::Branch | Kind::Peak);
    let refused = |(seed, size): (u64, usize)| {
        let loops = shapes::make("symmetric", size, seed);
        let mat = axis(&loops);
        let mut radii: Vec<f64> =
            mat.vertices().iter().filter(|v| critical(v)).map(|v| v.disk.radius).collect();
        radii.sort_by(f64::total_cmp);
        radii.dedup();
        let near = [0.0, -1e-12, 1e-12, -1e-9, 1e-9, -1e-6];
        let some = radii.iter().step_by((radii.len() / 12).max(1));
        let mut distances = some.flat_map(|r| near.map(|by| r * (1.0 + by)));
        distances.find_map(|d| {
            let level = mat.level(d);
            let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
            let report = verify::level(&loops, d, &all);
            (!report.is_right()).then(|| format!("seed {seed}, level {d:?}: {report:?}"))
        })
    };
    let shapes = [(29, 157), (44, 152), (68, 104), (59, 147), (96, 148), (148, 144), (192, 156), (207, 151)];
    let faults: Vec<String> =
        shapes.into_par_iter().filter_map(|(size, seed)| refused((seed, size))).collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

/// Area beyond a distance falls at the rate of the length of the level there: dA/dd = -L.
#[test]
fn area_falls_with_the_distance_by_the_length_of_the_level() {
    for kind in shapes::KINDS {
        let mat = axis(&shapes::make(kind, 200, 3));
        let d = 0.37 * mat.largest_disk().radius;
        let h = 1e-4 * d;
        let area = |d: f64| mat.level(d).loops.iter().map(ArcSpline::area).sum::<f64>();
        let length: f64 = mat.level(d).loops.iter().map(ArcSpline::length).sum();
        let rate = (area(d - h) - area(d + h)) / (2.0 * h);
        assert!((rate - length).abs() < 1e-3 * length, "{kind}: {rate} against {length}");
    }
}

/// Offsets can be taken in steps: the level at a + b is the level at b of what the level at a bounds,
/// wherever the latter is one pocket.
#[test]
fn a_level_of_a_level_is_a_level() {
    for kind in ["smooth", "coast", "fingers", "spiral"] {
        let mat = axis(&shapes::make(kind, 300, 5));
        let largest = mat.largest_disk().radius;
        let first = mat.level(0.2 * largest);
        let pieces: Vec<Mat> = first.loops.iter().map(|l| axis(std::slice::from_ref(l))).collect();
        let area = |loops: &[ArcSpline]| loops.iter().map(ArcSpline::area).sum::<f64>();
        let stepped: f64 = pieces.iter().map(|p| area(&p.level(0.4 * largest).loops)).sum();
        let direct = area(&mat.level(0.6 * largest).loops);
        assert!(
            (stepped - direct).abs() <= 1e-9 * direct.max(largest * largest),
            "{kind}: {stepped} {direct}"
        );
    }
}

/// The opening by a disk: what it cannot reach shrinks to nothing with the disk, and is the corners of
/// a square.
#[test]
fn a_disk_reaches_all_of_a_square_but_its_corners() {
    let square =
        shapes::polygon([(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(|(x, y)| medial::point(x, y)));
    let mat = axis(&[square]);
    for r in [0.5, 2.0, 4.5] {
        let corners = (4.0 - std::f64::consts::PI) * r * r;
        assert!((mat.unreachable_area(r) - corners).abs() < 1e-12, "{r}: {}", mat.unreachable_area(r));
    }
    assert_eq!(mat.unreachable_area(4.6), 81.0);
}

/// A slot as wide as the disk is reached to its round ends, a bore of its diameter altogether.
#[test]
fn a_disk_reaches_all_of_what_it_just_fits() {
    let slot = ArcSpline::closed([(0.0, -6.0, 0.0), (48.0, -6.0, 1.0), (48.0, 6.0, 0.0), (0.0, 6.0, 1.0)]);
    for loops in [vec![slot], vec![ArcSpline::circle(medial::point(3.0, 4.0), 6.0)]] {
        let mat = axis(&loops);
        assert!(mat.unreachable_area(6.0) < 1e-10, "{}", mat.unreachable_area(6.0));
        assert_eq!((mat.level(6.0).loops.len(), mat.level(6.0).ridges.len()), (0, 1));
    }
}

/// The merge tree knows, without making a level, what every level consists of.
#[test]
fn the_merge_tree_counts_the_loops_of_every_level() {
    for kind in shapes::KINDS {
        for seed in 1..=5u64 {
            let mat = axis(&shapes::make(kind, 400, seed));
            let tree = mat.levels();
            let mut radii: Vec<f64> = mat.vertices().iter().map(|v| v.disk.radius).collect();
            radii.sort_by(f64::total_cmp);
            // Between the radii of the vertices, where no count hangs on round-off.
            let places = radii.windows(2).filter(|w| w[1] - w[0] > 1e-6 * w[1]).step_by(17);
            for d in places.map(|w| 0.5 * (w[0] + w[1])) {
                let loops = mat.level(d).loops;
                let parts = tree.parts_at(d);
                let outer = loops.iter().filter(|l| l.area() > 0.0).count();
                let holes: usize = parts.iter().map(|&p| tree.holes_of(p, d)).sum();
                let counted = (parts.len(), holes, tree.loops_at(d));
                assert_eq!(counted, (outer, loops.len() - outer, loops.len()), "{kind}, seed {seed}, {d}");
            }
        }
    }
}

/// A wall that goes on, after a short piece tilted by its own round-off, into a corner of two degrees and a
/// small rounding: the short piece was turned to the long one, and what the rounding bends along it was
/// taken for round-off of the corner. Plates with rounded cutouts have hundreds of these.
#[test]
fn a_corner_between_a_short_wall_and_a_small_rounding_is_kept() {
    let (start, end) = (medial::point(60.1, 1.0 + 5e-14), medial::point(60.9, 1.3));
    for corner in [0.03, -0.03f64] {
        let bulge = (0.5 * ((end - start).angle() - corner)).tan();
        let loops = vec![ArcSpline::closed([
            (0.0, 1.0, 0.0),
            (60.0, 1.0, 0.0),
            (start.x, start.y, bulge),
            (end.x, end.y, 0.0),
            (100.0, 1.3, 0.0),
            (100.0, 50.0, 0.0),
            (0.0, 50.0, 0.0),
        ])];
        let mat = axis(&loops);
        mat.check().expect("a good axis");
        for d in [0.05, 0.3, 2.0, 10.0] {
            let level = mat.level(d);
            let report = verify::level(&loops, d, &level.loops);
            assert!(report.is_right(), "corner {corner}, level {d}: {report:?}");
        }
    }
}
