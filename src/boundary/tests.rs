//! Whole drawings: pockets and defects of known shapes, however they are drawn.

use super::{Pocket, Pockets};
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Point, point};
use crate::tolerance::Tolerance;
use proptest::prelude::*;
use std::collections::BTreeSet;

fn polygon(corners: &[(f64, f64)]) -> ArcSpline {
    ArcSpline::closed(corners.iter().map(|&(x, y)| (x, y, 0.0)))
}

fn square(x: f64, y: f64, side: f64) -> ArcSpline {
    polygon(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side)])
}

fn circle(x: f64, y: f64, radius: f64) -> ArcSpline {
    ArcSpline::circle(point(x, y), radius)
}

fn drawn(paths: &[ArcSpline]) -> Pockets {
    drawn_from(paths, 0)
}

fn drawn_from(paths: &[ArcSpline], depth: usize) -> Pockets {
    let curves: Vec<_> = paths.iter().cloned().map(Into::into).collect();
    let found = Pockets::from_curves_at_depth(&curves, Tolerance::MM, depth).expect("little effort");
    found.pockets.iter().for_each(assert_is_as_described);
    found
}

/// What the type `Pocket` promises, as far as it is quickly checked.
fn assert_is_as_described(pocket: &Pocket) {
    assert!(pocket.outer().area() > 0.0);
    assert!(pocket.islands().iter().all(|i| i.area() < 0.0));
    for path in pocket.loops() {
        assert!(path.closed);
        assert!(path.elements().all(|e| e.chord().length() > 0.0 && e.bulge.abs() <= 1.0));
        let places: BTreeSet<_> =
            path.vertices.iter().map(|v| (v.point.x.to_bits(), v.point.y.to_bits())).collect();
        assert_eq!(places.len(), path.len(), "a loop passes a vertex once");
    }
}

/// Number of islands of each pocket.
fn islands(found: &Pockets) -> Vec<usize> {
    found.pockets.iter().map(|p| p.islands().len()).collect()
}

fn shared_vertices(a: &ArcSpline, b: &ArcSpline) -> Vec<Point> {
    a.vertices.iter().map(|v| v.point).filter(|p| b.vertices.iter().any(|w| w.point == *p)).collect()
}

#[test]
fn even_contours_are_pockets_and_odd_ones_islands() {
    let nest =
        [square(2.0, 2.0, 16.0), square(0.0, 0.0, 20.0), circle(10.0, 10.0, 5.0), circle(10.0, 10.0, 2.0)];
    let found = drawn(&nest);
    assert!(found.defects.is_empty());
    assert_eq!(islands(&found), [1, 1]);
    assert_eq!(found.pockets[0].outer(), &nest[1]);
    assert_eq!(islands(&drawn_from(&nest, 1)), [1, 0]);
    assert_eq!(islands(&drawn_from(&nest, 3)), [0]);
    assert!(drawn_from(&nest, 4).pockets.is_empty());
}

#[test]
fn an_island_that_touches_shares_a_vertex() {
    for island in [
        circle(2.0, 5.0, 2.0),
        polygon(&[(0.0, 5.1), (3.0, 3.0), (3.0, 7.0)]),
        polygon(&[(0.0, 0.0), (3.0, 1.0), (1.0, 3.0)]),
    ] {
        let found = drawn(&[square(0.0, 0.0, 10.0), island]);
        assert!(found.defects.is_empty(), "{:?}", found.defects);
        assert_eq!(islands(&found), [1]);
        let pocket = &found.pockets[0];
        assert_eq!(shared_vertices(pocket.outer(), &pocket.islands()[0]).len(), 1);
    }
}

#[test]
fn circles_in_a_row_touch_their_neighbors() {
    let mut paths = vec![square(-1.0, -1.0, 12.0)];
    paths.extend((0..5).map(|i| circle(f64::from(2 * i) + 1.1, 3.3, 1.0)));
    let found = drawn(&paths);
    assert!(found.defects.is_empty(), "{:?}", found.defects);
    assert_eq!(islands(&found), [5]);
    let islands = found.pockets[0].islands();
    assert!(islands.windows(2).all(|w| shared_vertices(&w[0], &w[1]).len() == 1));
}

#[test]
fn a_ring_closed_on_itself_is_an_outer_loop_and_an_island() {
    let ring = polygon(&[
        (0.0, 0.0),
        (9.0, 0.0),
        (9.0, 9.0),
        (0.0, 9.0),
        (0.0, 0.0),
        (2.0, 6.0),
        (6.0, 6.0),
        (6.0, 2.0),
    ]);
    let found = drawn(std::slice::from_ref(&ring));
    assert!(found.defects.is_empty());
    assert_eq!(islands(&found), [1]);
    assert!((found.pockets[0].area() - ring.area()).abs() < 1e-12);
    let eight = polygon(&[
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 2.0),
        (4.0, 2.0),
        (4.0, 4.0),
        (2.0, 4.0),
        (2.0, 2.0),
        (0.0, 2.0),
    ]);
    assert_eq!(islands(&drawn(&[eight])), [0, 0]);
}

#[test]
fn a_nest_with_a_crossing_is_left_out_and_the_others_stay() {
    let found = drawn(&[
        square(0.0, 0.0, 10.0),
        circle(3.0, 3.0, 1.0),
        circle(4.5, 3.0, 1.0),
        circle(8.0, 8.0, 1.0),
        square(20.0, 0.0, 10.0),
        circle(25.0, 5.0, 1.0),
    ]);
    assert_eq!(islands(&found), [1]);
    assert_eq!(found.pockets[0].bounds().min, point(20.0, 0.0));
    assert_eq!(found.defects.len(), 2);
    assert!(found.defects.iter().all(|d| matches!(d, Defect::Crossing { .. })));
}

#[test]
fn contours_that_overlap_by_less_than_the_reach_end_on_each_other() {
    let is_mended = |found: &Pockets| {
        let overlaps = |d: &Defect| matches!(d, Defect::Overlaps { .. });
        let mut rest = found.defects.iter().filter(|d| !overlaps(d));
        matches!((rest.next(), rest.next()), (Some(Defect::Healed { count: 1, .. }), None))
    };
    let area = |found: &Pockets| found.pockets.iter().map(Pocket::area).sum::<f64>();
    for by in [0.004, -0.004] {
        let bar = polygon(&[(8.0, 3.0), (10.0 + by, 3.0), (10.0 + by, 5.0), (8.0, 5.0)]);
        let found = drawn(&[square(0.0, 0.0, 10.0), bar.reversed()]);
        let expected = if by > 0.0 { (vec![0], 96.0, true) } else { (vec![1], 96.008, false) };
        assert_eq!((islands(&found), is_mended(&found)), (expected.0, expected.2), "{:?}", found.defects);
        assert!((area(&found) - expected.1).abs() < 1e-9, "{}", area(&found));
    }
    let beside = drawn(&[square(0.0, 0.0, 4.0), square(3.996, 1.0, 5.0)]);
    assert!(is_mended(&beside) && islands(&beside) == [0, 0], "{:?}", beside.defects);
    assert!((area(&beside) - 41.0 + 0.004 * 3.0).abs() < 1e-9, "{}", area(&beside));
    let round = drawn(&[circle(0.0, 0.0, 5.0), circle(3.004, 0.0, 2.0)]);
    assert!(is_mended(&round) && islands(&round) == [0], "{:?}", round.defects);
    let tiny = drawn(&[square(0.0, 0.0, 0.004), square(0.003, 0.001, 0.004)]);
    assert!(tiny.pockets.is_empty() && tiny.defects.len() == 2);
}

#[test]
fn what_lies_in_crossing_contours_is_left_out_with_them() {
    let found = drawn(&[
        square(0.0, 0.0, 10.0),
        square(8.0, 8.0, 10.0),
        circle(3.0, 3.0, 1.0),
        circle(9.0, 9.0, 0.5),
        circle(30.0, 3.0, 1.0),
    ]);
    assert_eq!(islands(&found), [0]);
    assert!(found.pockets[0].bounds().min.x > 20.0);
}

#[test]
fn an_open_chain_says_whether_it_is_in_a_pocket() {
    let open = |x: f64| ArcSpline::open([(x, 4.0, 0.0), (x + 2.0, 4.0, 0.0), (x + 2.0, 6.0, 0.0)]);
    let found = drawn(&[square(0.0, 0.0, 10.0), open(3.0), open(30.0)]);
    assert_eq!(islands(&found), [0]);
    let inside: Vec<bool> =
        found.defects.iter().map(|d| matches!(d, Defect::OpenContour { inside: true, .. })).collect();
    assert_eq!(inside, [true, false]);
}

#[test]
fn copies_count_once_however_they_are_drawn() {
    let mut paths = vec![square(0.0, 0.0, 10.0), circle(5.0, 5.0, 2.0), circle(5.0, 5.0, 2.0).reversed()];
    // The same circle from another start, the same square with a vertex more and in pieces.
    paths.push(ArcSpline::closed([(5.0, 7.0, -1.0), (5.0, 3.0, -1.0)]));
    paths.push(polygon(&[(0.0, 10.0), (0.0, 0.0), (4.0, 0.0), (10.0, 0.0), (10.0, 10.0)]));
    paths.extend(
        square(0.0, 0.0, 10.0)
            .elements()
            .map(|e| ArcSpline::open([(e.start.x, e.start.y, 0.0), (e.end.x, e.end.y, 0.0)])),
    );
    let found = drawn(&paths);
    assert_eq!(islands(&found), [1]);
    assert!(matches!(found.defects[..], [Defect::Duplicates { count: 4, .. }]), "{:?}", found.defects);
}

#[test]
fn a_line_along_an_edge_of_a_contour_does_no_harm() {
    let line = ArcSpline::open([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]);
    let found = drawn(&[square(0.0, 0.0, 10.0), line]);
    assert_eq!(islands(&found), [0]);
    assert!(matches!(found.defects[..], [Defect::Overlaps { count: 1, .. }]), "{:?}", found.defects);
}

#[test]
fn one_outline_around_everything_is_noticed() {
    let plate = [square(0.0, 0.0, 10.0), circle(3.0, 3.0, 1.0), circle(7.0, 7.0, 1.0)];
    assert_eq!(drawn(&plate).lone_outline(), Some(point(0.0, 0.0)));
    assert_eq!(drawn(&plate[1..]).lone_outline(), None);
    assert_eq!(drawn(&plate[..1]).lone_outline(), None);
    assert_eq!(drawn(&[]).lone_outline(), None);
}

#[test]
fn loops_that_bound_one_pocket_are_one() {
    let outer = square(0.0, 0.0, 10.0).reversed();
    let pocket =
        Pocket::from_loops(vec![circle(5.0, 5.0, 2.0), outer.clone()], Tolerance::MM).expect("it is one");
    assert_is_as_described(&pocket);
    assert_eq!(pocket.islands().len(), 1);
    let faults = |loops: Vec<ArcSpline>| match Pocket::from_loops(loops, Tolerance::MM) {
        Err(Error::Defects(defects)) => defects,
        other => panic!("{other:?}"),
    };
    assert!(matches!(faults(vec![])[..], [Defect::NotOnePocket { count: 0, .. }]));
    assert!(matches!(
        faults(vec![outer.clone(), circle(50.0, 0.0, 1.0)])[..],
        [Defect::NotOnePocket { count: 2, .. }]
    ));
    assert_eq!(faults(vec![outer.clone(), circle(0.0, 5.0, 1.0)]).len(), 2);
    assert!(matches!(faults(vec![ArcSpline { closed: false, ..outer }])[..], [Defect::OpenContour { .. }]));
}

#[test]
fn wild_numbers_are_defects_and_never_panics() {
    let wild = [f64::NAN, f64::INFINITY, 1e300, -1e308, 1e-300, 0.0, 1.0, 5e-324];
    for &a in &wild {
        for &b in &wild {
            for closed in [false, true] {
                let path = ArcSpline {
                    closed,
                    ..ArcSpline::closed([(a, b, b), (b, 1.0, a), (1.0, a, 0.0), (2.0, 2.0, b)])
                };
                let found = drawn(&[path, square(0.0, 0.0, 1.0), circle(a, b, b)]);
                assert!(found.pockets.len() + found.defects.len() > 0);
            }
        }
    }
    let join = |join| Pockets::from_curves(&[], Tolerance { join, ..Tolerance::MM });
    assert!(join(f64::NAN).is_err() && join(-1.0).is_err() && join(0.0).is_ok());
}

/// A plate with nested islands, touching ones among them, of segments and arcs.
fn plate() -> Vec<ArcSpline> {
    let mut paths = vec![
        ArcSpline::closed([(0.0, 0.0, 0.0), (30.0, 0.0, 0.4), (30.0, 20.0, 0.0), (0.0, 20.0, -0.2)]),
        square(4.0, 4.0, 5.0),
        polygon(&[(9.0, 9.0), (12.0, 10.0), (10.0, 12.0)]),
        circle(6.5, 6.5, 1.5),
        ArcSpline::closed([(20.0, 5.0, 1.0), (23.0, 9.0, 0.0), (21.0, 10.0, 0.3), (18.0, 8.0, 0.0)]),
        square(100.0, 0.0, 3.0),
    ];
    paths.extend((0..3).map(|i| circle(14.0 + 1.2 * f64::from(i), 15.0 + 1.6 * f64::from(i), 1.0)));
    paths
}

/// Pieces of closed paths, some reversed, in another order, ends off by a little.
fn shattered(paths: &[ArcSpline], order: &[usize], reversed: &[bool], noise: f64) -> Vec<ArcSpline> {
    let mut pieces: Vec<ArcSpline> = Vec::new();
    for path in paths {
        for (i, e) in path.elements().enumerate() {
            let off = if i % 2 == 0 { noise } else { -noise };
            pieces.push(ArcSpline::open([
                (e.start.x + off, e.start.y, e.bulge),
                (e.end.x, e.end.y + off, 0.0),
            ]));
        }
    }
    let mut keyed: Vec<(usize, ArcSpline)> =
        pieces.into_iter().enumerate().map(|(i, p)| (order[i % order.len()] ^ i, p)).collect();
    keyed.sort_by_key(|(key, _)| *key);
    keyed
        .into_iter()
        .enumerate()
        .map(|(i, (_, p))| if reversed[i % reversed.len()] { p.reversed() } else { p })
        .collect()
}

/// Islands and area of each pocket, in no order.
fn summary(found: &Pockets, scale: f64) -> Vec<(usize, i64)> {
    /// Shapes are compared to this part of a unit of area.
    const PART: f64 = 10.0;
    let mut all: Vec<_> = found
        .pockets
        .iter()
        .map(|p| (p.islands().len(), (p.area() / (scale * scale) * PART).round() as i64))
        .collect();
    all.sort_unstable();
    all
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn shuffled_and_reversed_pieces_give_the_same_pockets(
        order in prop::collection::vec(0_usize..1000, 40),
        reversed in prop::collection::vec(any::<bool>(), 37),
        noise in prop_oneof![Just(0.0), Just(0.001)],
    ) {
        // With noise, what touches in the drawing may cross.
        let apart: Vec<ArcSpline> = plate().into_iter().enumerate().filter(|(i, _)| noise == 0.0 || ![2, 7].contains(i)).map(|(_, p)| p).collect();
        let found = drawn(&shattered(&apart, &order, &reversed, noise));
        prop_assert!(found.defects.is_empty(), "{:?}", found.defects);
        prop_assert_eq!(summary(&found, 1.0), summary(&drawn(&apart), 1.0));
    }

    #[test]
    fn turned_mirrored_scaled_and_moved_drawings_have_the_same_pockets(
        angle in prop_oneof![Just(37_f64), Just(0.0), Just(90.0), 0.0..360.0],
        mirrored in any::<bool>(),
        scale in prop_oneof![Just(1e-3), Just(1.0), Just(1e3)],
        moved in prop_oneof![Just(0.0), Just(1e6), Just(-1234.5678)],
        start in 0_usize..4,
        backwards in any::<bool>(),
    ) {
        let (sin, cos) = angle.to_radians().sin_cos();
        let flip = if mirrored { -1.0 } else { 1.0 };
        let map = |p: Point| point(
            scale * (flip * p.x * cos - p.y * sin) + moved,
            scale * (flip * p.x * sin + p.y * cos) - moved,
        );
        let paths: Vec<ArcSpline> = plate().iter().map(|p| {
            let mut path = p.mapped(mirrored, map);
            let n = path.vertices.len();
            path.vertices.rotate_left(start % n);
            if backwards { path.reversed() } else { path }
        }).collect();
        let found = drawn(&paths);
        prop_assert!(found.defects.is_empty(), "{:?}", found.defects);
        prop_assert_eq!(islands(&found), islands(&drawn(&plate())));
        let touching = found.pockets.iter().flat_map(|p| p.islands()).flat_map(|i| &i.vertices).count();
        prop_assert_eq!(touching, drawn(&plate()).pockets.iter().flat_map(|p| p.islands()).flat_map(|i| &i.vertices).count());
    }

    #[test]
    fn random_polygons_never_panic_and_keep_the_promise(
        corners in prop::collection::vec(prop::collection::vec((0_i32..6, 0_i32..6, -2_i32..=2), 1..7), 1..6),
        closed in prop::collection::vec(any::<bool>(), 6),
    ) {
        let paths: Vec<ArcSpline> = corners.iter().zip(&closed).map(|(c, &closed)| {
            let vertices = c.iter().map(|&(x, y, b)| (f64::from(x), f64::from(y), 0.5 * f64::from(b)));
            ArcSpline { closed, ..ArcSpline::closed(vertices) }
        }).collect();
        drawn(&paths);
    }
}

#[test]
fn a_crossing_spoils_no_pocket_beside_it_in_the_outline_of_a_part() {
    let square = |x: f64, y: f64, side: f64| {
        ArcSpline::closed([(x, y, 0.0), (x + side, y, 0.0), (x + side, y + side, 0.0), (x, y + side, 0.0)])
    };
    let part = [
        square(0.0, 0.0, 100.0),
        square(10.0, 10.0, 20.0),
        square(20.0, 20.0, 20.0),
        square(60.0, 60.0, 20.0),
        square(65.0, 65.0, 5.0),
    ];
    assert!(drawn_from(&part, 0).pockets.is_empty());
    let inside = drawn_from(&part, 1);
    assert_eq!(inside.pockets.iter().map(Pocket::area).collect::<Vec<_>>(), [375.0]);
    assert_eq!(inside.defects.len(), 2);
}

#[test]
fn loose_lines_over_one_another_are_no_island() {
    let line = |from: (f64, f64), to: (f64, f64)| ArcSpline::open([(from.0, from.1, 0.0), (to.0, to.1, 0.0)]);
    let islands = |height: f64| {
        let top = (4.25, 5.0 + height);
        let lines = [line((4.0, 5.0), top), line(top, (4.5, 5.0)), line((4.5, 5.0), (4.0, 5.0))];
        let found = drawn(&[&[square(0.0, 0.0, 10.0)], &lines[..]].concat());
        let defects = found.defects.iter().filter(|d| matches!(d, Defect::NoArea { .. })).count();
        (found.pockets[0].islands().len(), defects)
    };
    assert_eq!((islands(0.005), islands(0.2)), ((0, 1), (1, 0)));
}
