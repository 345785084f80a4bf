use super::*;
use crate::geom::point;
use std::f64::consts::PI;

/// What counts as the same in these tests.
const WITHIN: f64 = 1e-8;

/// A square with a square island, and its level at 1.
fn frame() -> (Boundary, [ArcSpline; 2]) {
    let square = |a: f64, b: f64| ArcSpline::closed([(a, a, 0.0), (b, a, 0.0), (b, b, 0.0), (a, b, 0.0)]);
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
    let boundary = [square(0.0, 10.0), square(4.0, 6.0).reversed()];
    (Boundary::new(&boundary), [square(1.0, 9.0), round.reversed()])
}

fn verdicts(comparison: &Comparison) -> Vec<(DisagreementKind, Party)> {
    comparison.disagreements.iter().map(|d| (d.kind, d.wrong)).collect()
}

#[test]
fn an_offset_agrees_with_itself_however_it_is_cut_or_turned() {
    let (boundary, [outer, inner]) = frame();
    let mut cut = outer.clone();
    cut.vertices.insert(1, crate::geom::Vertex { point: point(4.5, 1.0), bulge: 0.0 });
    cut.vertices.rotate_left(2);
    let comparison = boundary.compare(1.0, &[outer, inner.clone()], &[inner.reversed(), cut], WITHIN);
    assert!(comparison.agrees() && comparison.max_deviation < 1e-15, "{comparison:?}");
    assert_eq!((comparison.loops, comparison.places), ([2, 2], 2 * (4 + 8 + 8 + 5)));
}

#[test]
fn a_moved_element_is_decided_against_the_one_who_moved_it() {
    let (boundary, right) = frame();
    let mut wrong = right.clone();
    // The lower wall pass, from (1, 1) to (9, 1), moves outward.
    for v in &mut wrong[0].vertices[..2] {
        v.point.y -= 1e-4;
    }
    let comparison = boundary.compare(1.0, &wrong, &right, WITHIN);
    assert!(!comparison.agrees());
    assert!(comparison.disagreements.iter().all(|d| d.wrong == Party::Ours), "{comparison:?}");
    assert!(comparison.disagreements.iter().all(|d| (d.error - 1e-4).abs() < 1e-12 || d.error < 1e-12));
    assert!((comparison.max_deviation - 1e-4).abs() < 1e-12);
    let kinds: Vec<_> = comparison.disagreements.iter().map(|d| d.kind).collect();
    assert_eq!(kinds, [DisagreementKind::Phantom, DisagreementKind::Missing]);
    assert!(comparison.disagreements.iter().all(|d| (d.at.y - 1.0).abs() < 1.1e-4));
    let comparison = boundary.compare(1.0, &right, &wrong, WITHIN);
    assert!(comparison.disagreements.iter().all(|d| d.wrong == Party::Theirs), "{comparison:?}");
}

#[test]
fn a_lost_loop_is_missing_on_the_side_that_lost_it() {
    let (boundary, right) = frame();
    let comparison = boundary.compare(1.0, &right[..1], &right, WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Missing, Party::Ours)]);
    // The middles of its arcs, sqrt(1/2) from their centers, are farthest from the outer loop.
    assert!(comparison.disagreements[0].error < 1e-14);
    assert!((comparison.max_deviation - (3.0 - 0.5f64.sqrt())).abs() < 1e-12, "{comparison:?}");
    let comparison = boundary.compare(1.0, &right, &right[1..], WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Missing, Party::Theirs)]);
    // Nothing at all on the other side: as far off as the loops are wide.
    let comparison = boundary.compare(1.0, &right, &[], WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Missing, Party::Theirs); 2]);
    assert!((comparison.max_deviation - 128f64.sqrt()).abs() < 1e-12);
}

#[test]
fn an_extra_loop_is_a_phantom_of_who_drew_it() {
    let (boundary, right) = frame();
    let [outer, inner] = right.clone();
    let more = [outer, ArcSpline::circle(point(2.0, 2.0), 0.3), inner];
    let comparison = boundary.compare(1.0, &more, &right, WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Phantom, Party::Ours)]);
    assert!(comparison.disagreements[0].at.distance(point(2.0, 2.0)) < 0.301);
    let comparison = boundary.compare(1.0, &right, &more, WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Phantom, Party::Theirs)]);
}

#[test]
fn verdicts_hold_at_any_size_and_place() {
    let (boundary, right) = frame();
    for (scale, shift) in [(1e-3, 0.0), (1e3, 0.0), (1.0, 1e4), (1e-6, 1e-3)] {
        let map = |p: Point| point(shift + scale * p.x, shift - scale * p.y);
        let mapped = |l: &ArcSpline| l.mapped(true, map).reversed();
        let boundary = Boundary::new(&boundary.loops().iter().map(mapped).collect::<Vec<_>>());
        let right: Vec<_> = right.iter().map(mapped).collect();
        assert!(boundary.compare(scale, &right, &right, 0.0).agrees());
        let comparison = boundary.compare(scale, &right[1..], &right, WITHIN * scale);
        assert_eq!(verdicts(&comparison), [(DisagreementKind::Missing, Party::Ours)]);
    }
}

/// A ring groove just as wide as twice the distance: nothing is farther than its middle circle, and
/// a loop there bounds nothing.
#[test]
fn a_ridge_may_be_drawn_or_not() {
    let (outer, inner) = (ArcSpline::circle(point(0.0, 0.0), 5.0), ArcSpline::circle(point(0.0, 0.0), 3.0));
    let boundary = Boundary::new([&outer, &inner.reversed()]);
    let middle = [ArcSpline::circle(point(0.0, 0.0), 4.0)];
    let comparison = boundary.compare(1.0, &middle, &[], WITHIN);
    assert!(comparison.agrees() && comparison.ridges == 1, "{comparison:?}");
    // A little more is a loop too many.
    let comparison = boundary.compare(1.001, &middle, &[], WITHIN);
    assert_eq!(verdicts(&comparison), [(DisagreementKind::Phantom, Party::Ours)]);
}

#[test]
fn numbers_that_are_none_are_phantoms_and_nothing_agrees_with_nothing() {
    let (boundary, right) = frame();
    let mut bad = right.clone();
    bad[0].vertices[2].point.x = f64::NAN;
    let comparison = boundary.compare(1.0, &bad, &right, WITHIN);
    assert!(comparison.disagreements.iter().any(|d| d.wrong == Party::Ours));
    assert!(boundary.compare(1.0, &[], &[], WITHIN).agrees());
    assert!(Boundary::new(&[]).compare(f64::NAN, &[], &right, 0.0).disagreement_count > 0);
}

#[test]
fn a_disagreement_is_written_with_place_and_party() {
    let (boundary, right) = frame();
    let comparison = boundary.compare(1.0, &right[1..], &right[..1], WITHIN);
    let first = serde_json::to_value(comparison.disagreements[0]).unwrap();
    let keys: Vec<&String> = first.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["at", "deviation", "distance", "error", "kind", "wrong"]);
    assert_eq!((first["kind"].as_str(), first["wrong"].as_str()), (Some("missing"), Some("theirs")));
    assert_eq!(first["at"].as_array().unwrap().len(), 2);
}
