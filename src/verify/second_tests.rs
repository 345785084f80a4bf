use super::super::{Disagreement, DisagreementKind, Party};
use super::*;
use std::f64::consts::PI;

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> ArcSpline {
    ArcSpline::closed([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)])
}

fn circle(x: f64, y: f64, radius: f64) -> ArcSpline {
    ArcSpline::circle(point(x, y), radius)
}

/// A square with an island, and its level at 1: a frame with rounded inner corners.
fn frame() -> ([ArcSpline; 2], [ArcSpline; 2]) {
    let b = (PI / 8.0).tan();
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
    let boundary = [rectangle(0.0, 0.0, 10.0, 10.0), rectangle(4.0, 4.0, 6.0, 6.0).reversed()];
    (boundary, [rectangle(1.0, 1.0, 9.0, 9.0), round.reversed()])
}

/// A rectangle with fifteen bores for islands, one drawing unit long as a meter or a millimeter.
fn plate(scale: f64) -> Vec<ArcSpline> {
    let mut loops = vec![rectangle(0.0, 0.0, 60.0, 40.0)];
    for i in 0..15 {
        let (column, row) = (f64::from(i % 5), f64::from(i / 5));
        loops.push(circle(8.0 + 11.0 * column, 8.0 + 12.0 * row, 2.5 + 0.1 * (column + row)).reversed());
    }
    loops.iter().map(|l| l.mapped(false, |p| point(scale * p.x, scale * p.y))).collect()
}

/// The offset of a shape as drawn, with the tolerances that cavalier_contours comes with.
fn offset_with_its_own_tolerances(loops: &[ArcSpline], distance: f64) -> Vec<ArcSpline> {
    let as_drawn = SecondJudge { center: Point::default(), scale: 1.0, ..SecondJudge::new(loops).unwrap() };
    let shape = Shape::from_plines(loops.iter().map(|l| as_drawn.polyline(l)));
    let offset = shape.parallel_offset(distance, &ShapeOffsetOptions::new());
    offset.ccw_plines.iter().chain(&offset.cw_plines).map(|p| as_drawn.spline(&p.polyline)).collect()
}

#[test]
fn shapes_that_can_be_offset_by_hand_agree() {
    let (boundary, offsets) = frame();
    let slot = |r: f64| ArcSpline::closed([(0.0, -r, 0.0), (9.0, -r, 1.0), (9.0, r, 0.0), (0.0, r, 1.0)]);
    // Three quarters of a disk: an arc beyond a half circle, which goes there in two pieces.
    let pie = |radius: f64, reach: f64| {
        let along = (radius * radius - 0.5 * reach * reach).sqrt() * 0.5f64.sqrt();
        let (x, y) = (0.5 * reach + along, 0.5 * reach - along);
        let sweep = 2.0 * PI - (x.atan2(y) - y.atan2(x));
        ArcSpline::closed([(y, x, (0.25 * sweep).tan()), (x, y, 0.0)])
    };
    let cases: [(Vec<ArcSpline>, Vec<ArcSpline>, f64); 4] = [
        (boundary.to_vec(), offsets.to_vec(), 1.0),
        (vec![slot(3.0)], vec![slot(1.0)], 2.0),
        (vec![circle(2.0, 1.0, 5.0)], vec![circle(2.0, 1.0, 0.5)], 4.5),
        (vec![pie(3.0, 3.0)], vec![pie(2.0, 3.0 - 2f64.sqrt())], 1.0),
    ];
    for (boundary, offsets, distance) in cases {
        let comparison = SecondJudge::new(&boundary).unwrap().level(distance, &offsets).unwrap();
        assert!(comparison.agrees() && comparison.max_deviation < 1e-12, "{comparison:?}");
    }
}

#[test]
fn the_answer_is_the_same_at_any_size_and_place() {
    let (boundary, offsets) = frame();
    for (scale, shift) in [(1e-6, 0.0), (1e-3, 0.0), (1e6, 0.0), (1.0, 1e5), (1e-3, 10.0)] {
        let map = |p: Point| point(shift + scale * p.x, scale * p.y - shift);
        let mapped = |l: &ArcSpline| l.mapped(false, map);
        let judge = SecondJudge::new(&boundary.each_ref().map(mapped)).unwrap();
        let comparison = judge.level(scale, &offsets.each_ref().map(mapped)).unwrap();
        assert!(comparison.agrees() && comparison.max_deviation < 1e-9 * scale, "{comparison:?}");
        let comparison = judge.level(scale, &[mapped(&offsets[0])]).unwrap();
        assert_eq!(comparison.disagreement_count, 1, "{comparison:?}");
    }
}

#[test]
fn planted_faults_are_decided_against_who_has_them() {
    let (boundary, right) = frame();
    let judge = SecondJudge::new(&boundary).unwrap();
    let mut moved = right.clone();
    moved[1].vertices[2].point.x += 1e-4;
    let extra = [right[0].clone(), right[1].clone(), circle(2.5, 2.5, 0.2)];
    let faults: [(&[ArcSpline], DisagreementKind); 3] = [
        (&moved, DisagreementKind::Phantom),
        (&right[1..], DisagreementKind::Missing),
        (&extra, DisagreementKind::Phantom),
    ];
    for (offsets, kind) in faults {
        let comparison = judge.level(1.0, offsets).unwrap();
        assert!(!comparison.agrees());
        assert!(comparison.disagreements.iter().all(|d| d.wrong == Party::Ours), "{comparison:?}");
        assert!(comparison.disagreements.iter().any(|d| d.kind == kind), "{comparison:?}");
    }
}

/// Its tolerances are lengths, `1e-4` and `1e-5`; in a drawing in meters that is a tenth and a
/// hundredth of a millimeter. What it makes of such a drawing is wrong by a tenth.
#[test]
fn a_drawing_in_meters_is_right_here_and_wrong_with_its_own_tolerances() {
    let loops = plate(1e-3);
    let judge = SecondJudge::new(&loops).unwrap();
    for (distance, count) in [(0.0029, 13), (0.0032, 19), (0.004, 16)] {
        let right = judge.offset(distance).unwrap();
        assert_eq!(right.len(), count);
        let report = judge.boundary.judge(distance, &right, AGREEMENT / judge.scale);
        assert!(report.is_right(), "{report:?}");
        let wrong = offset_with_its_own_tolerances(&loops, distance);
        let comparison = judge.boundary.compare(distance, &right, &wrong, AGREEMENT / judge.scale);
        assert!(!comparison.agrees());
        assert!(comparison.disagreements.iter().all(|d| d.wrong == Party::Theirs), "{comparison:?}");
        // Theirs is off by some of it, or has no curve where the level is that far from any.
        let by = |d: &Disagreement| if d.kind == DisagreementKind::Phantom { d.error } else { d.deviation };
        let worst = comparison.disagreements.iter().map(by).fold(0.0, f64::max);
        assert!(worst > 5e-5, "{comparison:?}");
    }
    let offsets = offset_with_its_own_tolerances(&plate(1.0), 2.9);
    assert!(SecondJudge::new(&plate(1.0)).unwrap().level(2.9, &offsets).unwrap().agrees());
}

/// Two round noses that leave a neck of 2, and a distance just too large to pass it. What is within
/// its slack of the distance is as good to cavalier_contours, and so it goes through, along a way
/// that is longer than the slack by its square root.
#[test]
fn a_way_through_a_neck_within_its_slack_is_its_phantom() {
    let waist = ArcSpline::closed([
        (-9.0, -7.0, 0.0),
        (-6.0, -7.0, -1.0),
        (6.0, -7.0, 0.0),
        (9.0, -7.0, 0.0),
        (9.0, 7.0, 0.0),
        (6.0, 7.0, -1.0),
        (-6.0, 7.0, 0.0),
        (-9.0, 7.0, 0.0),
    ]);
    let judge = SecondJudge::new([&waist]).unwrap();
    let distance = 1.0 + 0.1 * SLACK / judge.scale;
    let theirs = judge.offset(distance).unwrap();
    // The level: three walls on either side of the neck, and arcs about the centers of the noses
    // that meet in a tip.
    let (x, y) = (9.0 - distance, 7.0 - distance);
    let foot = ((6.0 + distance).powi(2) - distance * distance).sqrt();
    let tip = (distance - 1.0).sqrt() * (13.0 + distance).sqrt();
    let b = (0.25 * ((-7f64).atan2(tip) - (-distance).atan2(foot))).tan();
    let right = ArcSpline::closed([(tip, 0.0, b), (foot, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (foot, y, b)]);
    let left = right.mapped(true, |p| point(-p.x, p.y)).reversed();
    let ours = [right, left];
    let report = judge.boundary.judge(distance, &ours, 0.0);
    assert!(report.is_right(), "{report:?}");
    let comparison = judge.boundary.compare(distance, &ours, &theirs, AGREEMENT / judge.scale);
    assert!(!comparison.agrees());
    for d in &comparison.disagreements {
        assert_eq!((d.kind, d.wrong), (DisagreementKind::Phantom, Party::Theirs));
        assert!(d.error < 2.0 * SLACK / judge.scale && d.deviation > 100.0 * d.error, "{d:?}");
    }
}

#[test]
fn more_elements_than_it_can_offset_soon_are_an_error() {
    let n = 31_700;
    let polygon = |n: i32| {
        ArcSpline::closed((0..n).map(|i| {
            let (s, c) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            (c, s, 0.0)
        }))
    };
    assert!(matches!(SecondJudge::new([&polygon(n)]), Err(Error::Effort { limit: MAX_PAIRS, .. })));
    assert_eq!(SecondJudge::new([&polygon(100)]).unwrap().pairs(), 10_000);
}

#[test]
fn what_is_no_pocket_or_no_distance_is_an_error_or_nothing() {
    let (mut boundary, offsets) = frame();
    let judge = SecondJudge::new(&boundary).unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(judge.level(bad, &offsets), Err(Error::Parameter { .. })));
    }
    assert!(judge.offset(1e300).unwrap().is_empty());
    boundary[0].vertices[0].bulge = f64::NAN;
    assert!(matches!(SecondJudge::new(&boundary), Err(Error::Defects(_))));
    let nothing = SecondJudge::new(&[]).unwrap();
    assert!(nothing.level(1.0, &[]).unwrap().agrees());
    let dot = ArcSpline::closed([(1.0, 1.0, 0.0), (1.0, 1.0, 0.0)]);
    assert!(SecondJudge::new([&dot]).unwrap().offset(1.0).unwrap().is_empty());
}

#[test]
fn a_panic_there_is_an_error_here() {
    let error = guarded(|| panic!("assertion\n  left: {}", 1)).map(|()| 0).unwrap_err();
    assert_eq!(error.to_string(), "cavalier_contours gave up: assertion left: 1");
    assert_eq!(guarded(|| 7).unwrap(), 7);
}
