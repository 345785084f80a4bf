//! Levels exactly where they change: at critical radii, at the radii of corners, where the offsets of two
//! islands coincide. The level at `d` is the boundary of {distance > d}; where the distance is `d` and no
//! area remains there are ridges; equality is decided to the round-off of the axis.

#[path = "../benches/peers/shapes.rs"]
mod machined;

use medial::{ArcSpline, Level, Mat, Pocket, Point, Tolerance, Vector, point, verify};
use std::f64::consts::PI;

fn axis(loops: &[ArcSpline]) -> Mat {
    Pocket::from_loops(loops.to_vec(), Tolerance::MM).expect("a pocket").medial_axis().expect("an axis")
}

fn square(x: f64, y: f64, half: f64) -> ArcSpline {
    rectangle(x - half, y - half, x + half, y + half)
}

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> ArcSpline {
    ArcSpline::closed([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)])
}

/// A plate with `rows` x `rows` squares 10 wide, exactly every 20: all gaps are 10 wide.
fn squares(rows: usize) -> Vec<ArcSpline> {
    let side = 20.0 * rows as f64 + 10.0;
    let place = |k: usize| 20.0 * k as f64 + 15.0;
    let islands = (0..rows * rows).map(|i| square(place(i / rows), place(i % rows), 5.0).reversed());
    std::iter::once(rectangle(0.0, 0.0, side, side)).chain(islands).collect()
}

/// The same shape turned and moved, where round numbers are round no longer.
fn turned(loops: &[ArcSpline]) -> Vec<ArcSpline> {
    let u = Vector::from_angle(0.6);
    let map = |p: Point| point(311.7, -96.3) + u * p.x + u.left() * p.y;
    loops.iter().map(|l| l.mapped(false, map)).collect()
}

/// What is to be known of a level: loops, ridges, area, length of the ridges.
fn known(level: &Level) -> (usize, usize, f64, f64) {
    let area = level.loops.iter().map(ArcSpline::area).sum();
    let length = level.ridges.iter().map(ArcSpline::length).sum();
    (level.loops.len(), level.ridges.len(), area, length)
}

/// Levels at `d` and within round-off of it, of the shape as drawn and turned, are all the same; each is
/// right to the judge, and the merge tree has as many loops.
fn assert_level(loops: &[ArcSpline], d: f64, wanted: (usize, usize, f64, f64)) {
    for (loops, name) in [(loops.to_vec(), "as drawn"), (turned(loops), "turned")] {
        let mat = axis(&loops);
        let tree = mat.levels();
        for ulps in [-4.0, -1.0, 0.0, 1.0, 4.0] {
            let at = d * (1.0 + ulps * f64::EPSILON);
            let level = mat.level(at);
            let found = known(&level);
            let case = format!("{name} at {d} and {ulps} ulps: {found:?}, not {wanted:?}");
            assert_eq!((found.0, found.1), (wanted.0, wanted.1), "{case}");
            assert!((found.2 - wanted.2).abs() <= 1e-9 * wanted.2.max(1.0), "{case}");
            assert!((found.3 - wanted.3).abs() <= 1e-9 * wanted.3.max(1.0), "{case}");
            assert_eq!(tree.loops_at(at), wanted.0, "{case}");
            let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
            let report = verify::level(&loops, at, &all);
            assert!(report.is_right(), "{case}: {report:?}");
        }
    }
}

#[test]
fn where_offsets_of_squares_coincide_there_are_ridges_between_stars() {
    for rows in [1, 2, 3] {
        let stars = (rows + 1) * (rows + 1);
        let gaps = 2 * rows * (rows + 1);
        let area = (rows * rows) as f64 * (100.0 - 25.0 * PI);
        assert_level(&squares(rows), 5.0, (stars, gaps, area, 10.0 * gaps as f64));
    }
}

#[test]
fn a_little_before_a_coincidence_all_hangs_together_and_a_little_after_nothing_is_left_of_it() {
    let mat = axis(&squares(3));
    let (before, after) = (mat.level(5.0 - 1e-7), mat.level(5.0 + 1e-7));
    // Around nine islands and along the wall; then sixteen stars and no ridge.
    assert_eq!((before.loops.len(), before.ridges.len()), (10, 0));
    assert_eq!((after.loops.len(), after.ridges.len()), (16, 0));
}

#[test]
fn circles_and_squares_touch_in_points_and_leave_ridges_at_the_walls_only() {
    // Circles at the corners and in the middle; four squares, one at each wall.
    let area = {
        let mat = axis(&machined::make("grid", 27));
        mat.level(5.0).loops.iter().map(ArcSpline::area).sum()
    };
    assert_level(&machined::make("grid", 27), 5.0, (16, 4, area, 40.0));
}

#[test]
fn every_round_step_of_a_regular_plate_is_right() {
    let loops = machined::make("grid", 48);
    let mat = axis(&loops);
    let tree = mat.levels();
    for level in mat.level_sets((1..).map(|k| 0.5 * f64::from(k))).take_while(|l| !l.is_empty()) {
        let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
        let report = verify::level(&loops, level.distance, &all);
        assert!(report.is_right(), "{}: {report:?}", level.distance);
        assert_eq!(tree.loops_at(level.distance), level.loops.len(), "{}", level.distance);
        assert_eq!(level, mat.level(level.distance));
    }
}

#[test]
fn at_the_radius_of_its_corners_a_rounded_plate_has_sharp_ones() {
    let b = (PI / 8.0).tan();
    let plate = ArcSpline::closed([
        (4.0, 0.0, 0.0),
        (36.0, 0.0, b),
        (40.0, 4.0, 0.0),
        (40.0, 26.0, b),
        (36.0, 30.0, 0.0),
        (4.0, 30.0, b),
        (0.0, 26.0, 0.0),
        (0.0, 4.0, b),
    ]);
    assert_level(std::slice::from_ref(&plate), 4.0, (1, 0, 32.0 * 22.0, 0.0));
    let level = axis(&[plate]).level(4.0);
    assert_eq!(level.loops[0].len(), 4);
    assert!(level.loops[0].elements().all(|e| e.is_segment() && e.length() > 21.0));
}

#[test]
fn at_its_largest_radius_a_pocket_is_a_ridge() {
    assert_level(&[rectangle(0.0, 0.0, 40.0, 30.0)], 15.0, (0, 1, 0.0, 10.0));
    assert_level(&[ArcSpline::circle(point(3.0, 4.0), 7.5)], 7.5, (0, 1, 0.0, 0.0));
    let ring = [ArcSpline::circle(point(1.0, 2.0), 10.0), ArcSpline::circle(point(1.0, 2.0), 4.0).reversed()];
    assert_level(&ring, 3.0, (0, 1, 0.0, 14.0 * PI));
    assert!(axis(&ring).level(3.0).ridges[0].closed);
    let mat = axis(&[rectangle(0.0, 0.0, 40.0, 30.0)]);
    assert!(mat.level(15.0 + 1e-9).is_empty());
    assert_eq!(known(&mat.level(15.0 - 1e-9)).0, 1);
}

#[test]
fn at_the_width_of_a_passage_two_loops_are_joined_by_a_ridge() {
    let corners = [
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 8.0),
        (30.0, 8.0),
        (30.0, 4.0),
        (42.0, 4.0),
        (42.0, 16.0),
        (30.0, 16.0),
        (30.0, 12.0),
        (20.0, 12.0),
        (20.0, 20.0),
        (0.0, 20.0),
    ];
    let dumbbell = ArcSpline::closed(corners.map(|(x, y)| (x, y, 0.0)));
    // Where the passage opens the corners round the offset of a wall: their arcs meet in its middle.
    let mouth = |half: f64| 4.0 * half - 2.0 * PI;
    let left = 16.0 * 16.0 + mouth(2.0);
    let right = 8.0 * 8.0 + mouth(2.0);
    assert_level(&[dumbbell], 2.0, (2, 1, left + right, 10.0));
}

#[test]
fn two_islands_whose_offsets_touch_in_a_point_have_no_ridge() {
    let loops = [
        rectangle(0.0, 0.0, 60.0, 40.0),
        ArcSpline::circle(point(20.0, 20.0), 5.0).reversed(),
        ArcSpline::circle(point(36.0, 20.0), 5.0).reversed(),
    ];
    // 6 apart: offsets of 3 touch. Both are round one hole of the level, which ends up with one loop round
    // each, or one round both: as the area beside the point hangs together, it is one.
    let mat = axis(&loops);
    let (before, at, after) = (mat.level(3.0 - 1e-7), mat.level(3.0), mat.level(3.0 + 1e-7));
    assert_eq!((before.loops.len(), after.loops.len()), (3, 2));
    assert_eq!((at.loops.len(), at.ridges.len()), (2, 0));
    let area = 54.0 * 34.0 - 2.0 * 64.0 * PI;
    assert_level(&loops, 3.0, (2, 0, area, 0.0));
}
