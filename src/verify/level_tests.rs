use super::*;
use crate::geom::point;
use std::f64::consts::PI;

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> ArcSpline {
    ArcSpline::closed([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)])
}

fn slot(length: f64, radius: f64) -> ArcSpline {
    ArcSpline::closed([
        (0.0, -radius, 0.0),
        (length, -radius, 1.0),
        (length, radius, 0.0),
        (0.0, radius, 1.0),
    ])
}

/// A square with an island, and its level at 1: a frame with rounded inner corners.
fn frame() -> ([ArcSpline; 2], [ArcSpline; 2]) {
    let b = (PI / 8.0).tan();
    let island = rectangle(4.0, 4.0, 6.0, 6.0).reversed();
    let round = ArcSpline::closed([
        (4.0, 3.0, 0.0),
        (6.0, 3.0, b),
        (7.0, 4.0, 0.0),
        (7.0, 6.0, b),
        (6.0, 7.0, 0.0),
        (4.0, 7.0, b),
        (3.0, 6.0, 0.0),
        (3.0, 4.0, b),
    ]);
    ([rectangle(0.0, 0.0, 10.0, 10.0), island], [rectangle(1.0, 1.0, 9.0, 9.0), round.reversed()])
}

fn kinds(report: &LevelReport) -> Vec<FaultKind> {
    report.faults.iter().map(|f| f.kind).collect()
}

#[test]
fn right_offsets_pass() {
    let (boundary, offsets) = frame();
    let report = level(&boundary, 1.0, &offsets);
    assert!(report.is_right(), "{report:?}");
    assert!((report.area - (64.0 - 16.0 + 4.0 - PI)).abs() < 1e-12 && report.max_deviation < 1e-14);
    let report = level([&slot(10.0, 3.0)], 2.0, &[slot(10.0, 1.0)]);
    assert!(report.is_right(), "{report:?}");
    let (a, b) = (ArcSpline::circle(point(2.0, 1.0), 5.0), ArcSpline::circle(point(2.0, 1.0), 1.0));
    let offsets =
        [ArcSpline::circle(point(2.0, 1.0), 4.5), ArcSpline::circle(point(2.0, 1.0), 1.5).reversed()];
    assert!(level([&a, &b.reversed()], 0.5, &offsets).is_right());
}

#[test]
fn right_offsets_pass_at_any_size_place_and_turn() {
    let (boundary, offsets) = frame();
    let (s, c) = 37f64.to_radians().sin_cos();
    for (scale, shift) in [(1e-3, 0.0), (1e3, 0.0), (1.0, 1e6), (1e-3, 1.0)] {
        let map = |p: Point| point(shift + scale * (c * p.x - s * p.y), -shift + scale * (s * p.x + c * p.y));
        let boundary = boundary.clone().map(|l| l.mapped(false, map));
        let offsets = offsets.clone().map(|l| l.mapped(false, map));
        let report = level(&boundary, scale, &offsets);
        assert!(report.is_right(), "{scale} {shift} {report:?}");
        assert!(!level(&boundary, scale, &offsets[..1]).is_right());
    }
}

#[test]
fn a_slot_as_wide_as_twice_the_distance_has_a_ridge() {
    let ridge = ArcSpline::open([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]);
    assert!(level([&slot(10.0, 3.0)], 3.0, &[ridge]).is_right());
    assert!(level([&slot(10.0, 3.0)], 3.0, &[]).is_right());
    let side = ArcSpline::open([(0.0, 1.0, 0.0), (10.0, 1.0, 0.0)]);
    let report = level([&slot(10.0, 3.0)], 2.0, &[side, slot(10.0, 1.0)]);
    assert_eq!(kinds(&report), [FaultKind::Open]);
}

#[test]
fn a_wrong_radius_is_caught_where_it_bulges_most() {
    let (boundary, mut offsets) = frame();
    offsets[1].vertices[2].bulge *= 1.1;
    let report = level(&boundary, 1.0, &offsets);
    let fault = report.faults[0];
    assert_eq!(fault.kind, FaultKind::Distance);
    assert!(report.max_deviation > 0.01 && fault.at.distance(point(4.0, 6.0)) > 0.9, "{report:?}");
}

#[test]
fn a_dropped_loop_is_missing() {
    let (boundary, offsets) = frame();
    let report = level(&boundary, 1.0, &offsets[..1]);
    let [Fault { kind: FaultKind::Missing, at, by, length, area }] = report.faults[..] else {
        panic!("{report:?}");
    };
    assert!(offsets[1].distance(at) < 1e-12 && (by - offsets[0].distance(at)).abs() < 1e-12);
    assert!((length - offsets[1].length()).abs() < 1e-3 && (area + offsets[1].area()).abs() < 1e-2);
    assert!(!level(&boundary, 1.0, &[]).is_right());
}

#[test]
fn a_small_dropped_loop_far_along_a_wall_is_found() {
    // Walls that lean by 0.0005: the largest disk, 1.0095 wide, touches the right end.
    let wedge = ArcSpline::closed([(0.0, 0.0, 0.0), (20.0, -0.01, 0.0), (20.0, 2.01, 0.0), (0.0, 2.0, 0.0)]);
    assert!(!level([&wedge], 1.009, &[]).is_right());
    assert!(level([&wedge], 1.01, &[]).is_right());
}

#[test]
fn a_shifted_loop_is_off_by_the_shift() {
    let (boundary, offsets) = frame();
    let shifted = offsets.map(|l| l.mapped(false, |p| point(p.x + 0.01, p.y)));
    let report = level(&boundary, 1.0, &shifted);
    assert!((report.max_deviation - 0.01).abs() < 1e-12);
    assert!(Boundary::new(&boundary).judge(1.0, &shifted, 0.02).is_right());
}

#[test]
fn an_extra_loop_is_a_phantom_with_its_place() {
    let (boundary, offsets) = frame();
    let phantom = ArcSpline::circle(point(1.5, 1.5), 0.1);
    let [a, b] = offsets;
    let report = level(&boundary, 1.0, &[a.clone(), b.clone(), phantom]);
    assert_eq!(kinds(&report), [FaultKind::Distance]);
    assert!(report.faults[0].at.distance(point(1.5, 1.5)) < 0.11);
    let report = level(&boundary, 1.0, &[a.clone(), b, a]);
    assert_eq!(kinds(&report), [FaultKind::Overlapping; 2]);
}

#[test]
fn a_reversed_loop_and_one_outside_are_caught() {
    let (boundary, [a, b]) = frame();
    assert_eq!(kinds(&level(&boundary, 1.0, &[a.clone(), b.reversed()])), [FaultKind::Reversed]);
    let outside = ArcSpline::circle(point(5.0, 0.0), 3.0);
    let around = [ArcSpline::circle(point(5.0, 0.0), 4.0)];
    assert!(kinds(&level([&outside], 1.0, &around)).contains(&FaultKind::Outside));
    // The island's loop alone, as if it were a pocket, has an outside only.
    assert!(!level([&boundary[1]], 1.0, &[a, b]).is_right());
}

#[test]
fn bad_numbers_are_faults() {
    let (boundary, [a, mut b]) = frame();
    b.vertices[3].bulge = f64::NAN;
    assert_eq!(kinds(&level(&boundary, 1.0, &[a, b]))[0], FaultKind::NotANumber);
    assert!(level(&[], 1.0, &[]).is_right());
    assert!(!level(&[], 1.0, &frame().1).is_right());
    level(&boundary, f64::NAN, &frame().1);
    level(&boundary, f64::INFINITY, &frame().1);
}

#[test]
fn a_hundred_thousand_elements_are_judged() {
    let n = 100_000;
    let polygon = |r: f64| {
        ArcSpline::closed((0..n).map(|i| {
            let (s, c) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            (r * c, r * s, 0.0)
        }))
    };
    // Apothem of the inner polygon: one less than that of the outer one.
    let cos = (PI / f64::from(n)).cos();
    let report = level([&polygon(100.0)], 1.0, &[polygon(100.0 - 1.0 / cos)]);
    assert!(report.is_right(), "{report:?}");
}

#[test]
fn a_lost_outer_loop_leaves_the_inner_one_right() {
    let (boundary, offsets) = frame();
    let report = level(&boundary, 1.0, &offsets[1..]);
    assert_eq!(kinds(&report), [FaultKind::Missing]);
    assert!((report.faults[0].length - 32.0).abs() < 1e-2 && (report.faults[0].area - 64.0).abs() < 1e-1);
}

#[test]
fn a_moved_vertex_is_a_wrong_part_as_long_as_its_elements() {
    let (boundary, mut offsets) = frame();
    offsets[0].vertices[1].point = point(9.0, 1.5);
    let report = level(&boundary, 1.0, &offsets);
    assert_eq!(kinds(&report)[0], FaultKind::Distance);
    // The lower wall pass rises to 1.5 at its end, where the wall on the right is as far as ever.
    let fault = report.faults[0];
    assert!(
        fault.at.distance(point(8.529, 1.471)) < 0.001 && (fault.by - 8.0 / 17.0).abs() < 1e-3,
        "{report:?}"
    );
    assert!((fault.length - 8.0).abs() < 0.1 && fault.area == 0.0);
    let missing = report.faults.iter().find(|f| f.kind == FaultKind::Missing).expect("what it has left");
    assert!(missing.at.y < 1.0001 && (missing.length - 8.5).abs() < 0.1, "{report:?}");
}

#[test]
fn a_loop_at_the_wrong_distance_is_one_part_too_much_and_one_missing() {
    let (boundary, [outer, _]) = frame();
    let far = rectangle(1.2, 1.2, 8.8, 8.8);
    let report = level(&boundary[..1], 1.0, &[far]);
    let [wrong, missing] = report.faults[..] else { panic!("{report:?}") };
    assert_eq!((wrong.kind, missing.kind), (FaultKind::Distance, FaultKind::Missing));
    assert!((wrong.by - 0.2).abs() < 1e-12 && (wrong.area - 7.6 * 7.6).abs() < 1e-12);
    assert!((missing.area - outer.area()).abs() < 0.1 && missing.by < 0.3 && missing.by > 0.199);
}

#[test]
fn a_missing_sliver_is_found_with_its_length() {
    // A notch 2.02 wide in the wall of a plate: at 1, a finger of 0.02 by 6 reaches into it.
    let plate = ArcSpline::closed([
        (0.0, 0.0, 0.0),
        (20.0, 0.0, 0.0),
        (20.0, 10.0, 0.0),
        (11.01, 10.0, 0.0),
        (11.01, 16.0, 0.0),
        (8.99, 16.0, 0.0),
        (8.99, 10.0, 0.0),
        (0.0, 10.0, 0.0),
    ]);
    let without = rectangle(1.0, 1.0, 19.0, 9.0);
    let report = level([&plate], 1.0, std::slice::from_ref(&without));
    let missing: Vec<&Fault> = report.faults.iter().filter(|f| f.kind == FaultKind::Missing).collect();
    let [finger] = missing[..] else { panic!("{report:?}") };
    assert!(finger.at.y > 14.0 && (finger.by - 6.0).abs() < 0.3 && finger.length > 12.0, "{report:?}");
    // And where it should be there is a line that goes straight on over the mouth of the notch.
    assert!(
        report.faults.iter().any(|f| f.kind == FaultKind::Distance && f.at.distance(point(10.0, 9.0)) < 0.1)
    );
    // As wide as what counts as nothing, it may be missing; the arcs round its mouth may not.
    let loose = Boundary::new([&plate]).judge(1.0, &[without], 0.02);
    let missing = loose.faults.iter().filter(|f| f.kind == FaultKind::Missing);
    assert!(missing.clone().all(|f| f.at.y < 10.1) && missing.count() == 2, "{loose:?}");
}

#[test]
fn outward_offsets_are_judged_around_a_part_and_in_its_holes() {
    let b = (PI / 8.0).tan();
    let around = ArcSpline::closed([
        (0.0, -1.0, 0.0),
        (10.0, -1.0, b),
        (11.0, 0.0, 0.0),
        (11.0, 10.0, b),
        (10.0, 11.0, 0.0),
        (0.0, 11.0, b),
        (-1.0, 10.0, 0.0),
        (-1.0, 0.0, b),
    ]);
    let (boundary, _) = frame();
    let hole = rectangle(4.5, 4.5, 5.5, 5.5);
    let half = Boundary::new(&boundary).judge_outward(0.5, &[hole], 0.0);
    assert_eq!(kinds(&half), [FaultKind::Missing]);
    assert!((half.faults[0].length - (40.0 + PI)).abs() < 0.01, "{half:?}");
    // At 1 the hole, 2 wide, is gone.
    assert!(outward(&boundary, 1.0, &[around.reversed()]).is_right());
    assert_eq!(kinds(&outward(&boundary, 1.0, std::slice::from_ref(&around))), [FaultKind::Reversed]);
    let turned = Boundary::new(&boundary).turned(&[around]);
    assert!(outward(&boundary, 1.0, &turned).is_right());
    let inside = [rectangle(1.0, 1.0, 9.0, 9.0)];
    assert!(kinds(&outward(&boundary, 1.0, &inside)).contains(&FaultKind::Outside));
}

/// Round-off of a crossing between curves that hardly cross makes a loop run back over itself.
#[test]
fn a_fold_thinner_than_round_off_is_no_fault() {
    let plate = rectangle(0.0, 0.0, 10.0, 10.0);
    let folded = |by: f64| {
        ArcSpline::closed([
            (1.0, 1.0, 0.0),
            (6.0, 1.0, 0.0),
            (4.0, 1.0 + by, 0.0),
            (9.0, 1.0, 0.0),
            (9.0, 9.0, 0.0),
            (1.0, 9.0, 0.0),
        ])
    };
    let report = level([&plate], 1.0, &[folded(1e-13)]);
    assert!(report.is_right(), "{report:?}");
    assert_eq!(kinds(&level([&plate], 1.0, &[folded(1e-13).reversed()])), [FaultKind::Reversed]);
    assert!(kinds(&level([&plate], 1.0, &[folded(1e-3)])).contains(&FaultKind::Distance));
}
