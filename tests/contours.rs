//! Drawings as people export them: sides drawn twice, neighbors with one common line, lines that end
//! on others, ends that do not quite meet. What they mean must not depend on how they were drawn.

use medial::{ArcSpline, Curve, Defect, Pockets, Tolerance, point};
use proptest::prelude::*;

const JOIN: f64 = 0.01;

fn found(paths: &[ArcSpline]) -> Pockets {
    let curves: Vec<Curve> = paths.iter().cloned().map(Into::into).collect();
    Pockets::from_curves(&curves, Tolerance { join: JOIN, ..Tolerance::MM }).expect("there is little to do")
}

fn line(a: (f64, f64), b: (f64, f64)) -> ArcSpline {
    ArcSpline::open([(a.0, a.1, 0.0), (b.0, b.1, 0.0)])
}

fn lines(corners: &[(f64, f64)]) -> Vec<ArcSpline> {
    corners.windows(2).map(|w| line(w[0], w[1])).collect()
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> ArcSpline {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
    ArcSpline::closed(corners.map(|(x, y)| (x, y, 0.0)))
}

/// The sides of closed paths as loose curves.
fn sides(paths: &[ArcSpline]) -> Vec<ArcSpline> {
    let elements = paths.iter().flat_map(ArcSpline::elements);
    elements.map(|e| ArcSpline::open([(e.start.x, e.start.y, e.bulge), (e.end.x, e.end.y, 0.0)])).collect()
}

/// Area and number of islands of each pocket, sorted; areas to a tenth.
fn summary(found: &Pockets) -> Vec<(i64, usize)> {
    /// Areas are compared in these parts of a unit.
    const PART: f64 = 10.0;
    let mut all: Vec<_> =
        found.pockets.iter().map(|p| ((PART * p.area()).round() as i64, p.islands().len())).collect();
    all.sort_unstable();
    all
}

fn kinds(found: &Pockets) -> Vec<&'static str> {
    let name = |d: &Defect| match d {
        Defect::OpenContour { .. } => "open",
        Defect::Duplicates { .. } => "duplicates",
        Defect::Overlaps { .. } => "overlaps",
        Defect::Divided { .. } => "divided",
        Defect::Healed { .. } => "healed",
        Defect::Crossing { .. } => "crossing",
        Defect::SelfCrossing { .. } => "self-crossing",
        _ => "other",
    };
    found.defects.iter().map(name).collect()
}

#[test]
fn two_rectangles_with_one_common_line_are_two_pockets() {
    let mut drawing =
        lines(&[(0.0, 0.0), (4.0, 0.0), (9.0, 0.0), (9.0, 3.0), (4.0, 3.0), (0.0, 3.0), (0.0, 0.0)]);
    drawing.push(line((4.0, 0.0), (4.0, 3.0)));
    let both = found(&drawing);
    assert_eq!(summary(&both), [(120, 0), (150, 0)]);
    assert_eq!(kinds(&both), ["divided"]);
    let closed = found(&[rectangle(0.0, 0.0, 4.0, 3.0), rectangle(4.0, 0.0, 5.0, 3.0)]);
    assert_eq!(summary(&closed), summary(&both));
    assert_eq!(kinds(&closed), ["overlaps"]);
    let apart = found(&sides(&[rectangle(0.0, 0.0, 4.0, 3.0), rectangle(4.0, 0.0, 5.0, 3.0)]));
    assert_eq!(summary(&apart), summary(&both));
}

#[test]
fn a_line_that_ends_in_the_middle_of_two_sides_makes_two_pockets() {
    for off in [0.0, 0.004, -0.004] {
        let across = line((off, 1.0), (9.0 - off, 2.0));
        for frame in [vec![rectangle(0.0, 0.0, 9.0, 3.0)], sides(&[rectangle(0.0, 0.0, 9.0, 3.0)])] {
            let drawing: Vec<_> = frame.into_iter().chain([across.clone()]).collect();
            let both = found(&drawing);
            assert_eq!(summary(&both), [(135, 0), (135, 0)], "{off} {:?}", both.defects);
            assert_eq!(kinds(&both), ["divided"]);
        }
    }
    let short = found(&[rectangle(0.0, 0.0, 9.0, 3.0), line((0.0, 1.0), (8.0, 2.0))]);
    assert_eq!((summary(&short), kinds(&short)), (vec![(270, 0)], vec!["open"]));
}

#[test]
fn a_grid_of_lines_is_a_pocket_for_each_cell() {
    let mut drawing = Vec::new();
    for i in 0..5 {
        let at = f64::from(2 * i);
        drawing.extend([line((at, 0.0), (at, 8.0)), line((0.0, at), (8.0, at))]);
    }
    let cells = found(&drawing);
    assert_eq!(summary(&cells), [(40, 0); 16], "{:?}", cells.defects);
    let framed: Vec<_> = drawing.into_iter().chain([rectangle(-2.0, -2.0, 12.0, 12.0)]).collect();
    assert_eq!(summary(&found(&framed)), [(800, 1)], "a grid in a pocket is an island");
}

#[test]
fn a_center_line_divides_nothing() {
    let drawing = [
        rectangle(0.0, 0.0, 20.0, 10.0),
        ArcSpline::circle(point(10.0, 5.0), 3.0),
        line((6.0, 5.0), (14.0, 5.0)),
        line((10.0, 0.0), (10.0, 10.0)),
    ];
    let plain = found(&drawing);
    assert_eq!(summary(&plain), [(1717, 1)]);
    assert_eq!(kinds(&plain), ["open", "open"]);
}

/// The crescent has a corner of no angle there, one side of which leaves it a hair on the wrong side.
#[test]
fn a_triangle_at_the_tip_of_a_crescent_is_beside_it() {
    let quarter = -0.41421356240209145;
    let crescent = ArcSpline::closed([
        (3.0, 2.0, 0.0),
        (2.0, 3.0, 1.0),
        (2.0, 1.0, quarter),
        (1.9999999999505, 2.0000000000495, quarter),
    ]);
    let triangle = ArcSpline::closed([(4.0, 1.0, 0.0), (3.0, 1.0, 0.0), (3.0, 2.0, 0.0)]);
    assert_eq!(summary(&found(&[triangle, crescent])), [(5, 0), (18, 0)]);
}

#[test]
fn an_island_on_a_wall_is_a_bite_out_of_the_pocket() {
    let bite = found(&[rectangle(0.0, 0.0, 10.0, 10.0), rectangle(0.0, 4.0, 3.0, 2.0)]);
    assert_eq!((summary(&bite), kinds(&bite)), (vec![(940, 0)], vec!["overlaps"]));
    assert_eq!(bite.pockets[0].outer().len(), 8);
    let both = found(&[
        rectangle(0.0, 0.0, 10.0, 10.0),
        rectangle(4.0, 4.0, 2.0, 2.0),
        rectangle(6.0, 4.0, 2.0, 2.0),
    ]);
    assert_eq!(summary(&both), [(920, 1)]);
    let deep = found(&[
        rectangle(0.0, 0.0, 10.0, 10.0),
        rectangle(0.0, 2.0, 5.0, 5.0),
        rectangle(0.0, 3.0, 2.0, 2.0),
    ]);
    assert_eq!(summary(&deep), [(40, 0), (750, 0)]);
}

#[test]
fn a_circle_along_a_fillet_shares_it() {
    let quarter = (std::f64::consts::PI / 8.0).tan();
    let slot = ArcSpline::closed([(2.0, 0.0, 0.0), (8.0, 0.0, 1.0), (8.0, 4.0, 0.0), (2.0, 4.0, 1.0)]);
    let ring = found(&[slot.clone(), ArcSpline::circle(point(8.0, 2.0), 2.0)]);
    assert_eq!(summary(&ring), [(240, 0)]);
    assert_eq!(kinds(&ring), ["overlaps"]);
    let rounded = ArcSpline::closed([
        (1.0, 0.0, 0.0),
        (9.0, 0.0, quarter),
        (10.0, 1.0, 0.0),
        (10.0, 9.0, 0.0),
        (0.0, 9.0, 0.0),
        (0.0, 1.0, quarter),
    ]);
    let bitten = found(&[rounded, ArcSpline::circle(point(9.0, 1.0), 1.0)]);
    assert_eq!(summary(&bitten).len(), 1);
    assert!(
        (bitten.pockets[0].area() - (90.0 - 0.5 * (4.0 - std::f64::consts::PI) - std::f64::consts::PI)).abs()
            < 1e-12
    );
}

#[test]
fn squares_pushed_over_each_other_are_refused_with_the_places() {
    let pushed =
        found(&[rectangle(0.0, 0.0, 4.0, 4.0), rectangle(2.0, 0.0, 4.0, 4.0), rectangle(9.0, 0.0, 1.0, 1.0)]);
    assert_eq!(summary(&pushed), [(10, 0)]);
    assert_eq!(kinds(&pushed), ["crossing", "crossing"]);
}

#[test]
fn sides_drawn_twice_and_in_halves_count_once() {
    let frame = sides(&[rectangle(0.0, 0.0, 9.0, 3.0)]);
    let with = |more: Vec<ArcSpline>| found(&frame.iter().cloned().chain(more).collect::<Vec<_>>());
    for (more, expected) in [
        (vec![line((9.0, 0.0), (0.0, 0.0))], "duplicates"),
        (vec![line((9.004, 0.0), (0.003, 0.001))], "duplicates"),
        (vec![line((0.0, 0.0), (4.0, 0.0)), line((4.0, 0.0), (9.0, 0.0))], "overlaps"),
        (vec![line((0.0, 0.003), (4.0, 0.002)), line((4.001, 0.001), (9.0, 0.0))], "overlaps"),
        (vec![line((2.0, 0.0), (4.0, 0.0))], "overlaps"),
    ] {
        let once = with(more);
        assert_eq!((summary(&once), kinds(&once)), (vec![(270, 0)], vec![expected]), "{:?}", once.defects);
    }
    let overlapping = [
        line((0.0, 0.0), (6.0, 0.0)),
        line((9.0, 0.0), (4.0, 0.002)),
        line((9.0, 0.0), (9.0, 3.0)),
        line((9.0, 3.0), (0.0, 3.0)),
        line((0.0, 3.0), (0.0, 0.0)),
    ];
    assert_eq!(summary(&found(&overlapping)), [(270, 0)]);
    let arc = |from: f64, to: f64| {
        let (a, b) = (from.to_radians(), to.to_radians());
        ArcSpline::open([
            (5.0 * a.cos(), 5.0 * a.sin(), (0.25 * (b - a)).tan()),
            (5.0 * b.cos(), 5.0 * b.sin(), 0.0),
        ])
    };
    let disk = found(&[arc(0.0, 200.0), arc(150.0, 300.0), arc(290.0, 400.0)]);
    assert_eq!(summary(&disk), [(785, 0)], "{:?}", disk.defects);
}

#[test]
fn ends_that_overshoot_by_less_than_the_reach_are_trimmed() {
    let over = 0.009;
    let drawing = [
        line((-over, 0.0), (9.0 + over, 0.0)),
        line((9.0, -over), (9.0, 3.0 + over)),
        line((9.0 + over, 3.0), (-over, 3.0)),
        line((0.0, 3.0 + over), (0.0, -over)),
    ];
    let trimmed = found(&drawing);
    assert_eq!((summary(&trimmed), kinds(&trimmed)), (vec![(270, 0)], vec![]), "{:?}", trimmed.defects);
}

#[test]
fn a_small_loop_at_a_corner_is_cut_off_and_a_large_one_is_told() {
    let looped = |size: f64| {
        found(&[ArcSpline::closed([
            (0.0, 0.0, 0.0),
            (9.0 + size, 0.0, 0.0),
            (9.0 + size, -size, 0.0),
            (9.0, -size, 0.0),
            (9.0, 3.0, 0.0),
            (0.0, 3.0, 0.0),
        ])])
    };
    let small = looped(0.003);
    assert_eq!((summary(&small), kinds(&small)), (vec![(270, 0)], vec!["healed"]));
    let large = looped(0.1);
    assert_eq!((summary(&large), kinds(&large)), (vec![], vec!["self-crossing"]));
}

#[test]
fn a_hole_reached_by_a_way_there_and_back_is_an_island() {
    let keyhole = [
        (0.0, 0.0),
        (9.0, 0.0),
        (9.0, 9.0),
        (0.0, 9.0),
        (0.0, 0.0),
        (2.0, 2.0),
        (2.0, 6.0),
        (6.0, 6.0),
        (6.0, 2.0),
        (2.0, 2.0),
    ];
    let ring = found(&[ArcSpline::closed(keyhole.map(|(x, y)| (x, y, 0.0)))]);
    assert_eq!((summary(&ring), kinds(&ring)), (vec![(650, 1)], vec!["overlaps"]));
}

/// A sheet with every kind of contact: a grid, a bite, touching islands, arcs along fillets.
fn sheet() -> Vec<ArcSpline> {
    let mut paths = vec![
        rectangle(0.0, 0.0, 30.0, 20.0),
        rectangle(0.0, 8.0, 4.0, 3.0),
        rectangle(10.0, 10.0, 4.0, 4.0),
        rectangle(14.0, 10.0, 3.0, 4.0),
        ArcSpline::circle(point(22.0, 7.0), 2.0),
        ArcSpline::closed([(22.0, 5.0, 0.0), (26.0, 5.0, 1.0), (26.0, 9.0, 0.0), (22.0, 9.0, 1.0)]),
        rectangle(40.0, 0.0, 9.0, 9.0),
        rectangle(49.0, 0.0, 5.0, 9.0),
    ];
    paths.extend([
        line((40.0, 3.0), (49.0, 4.0)),
        line((43.0, 0.0), (43.0, 9.0)),
        line((49.0, 6.0), (54.0, 6.0)),
    ]);
    paths
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn order_direction_start_copies_and_place_do_not_matter(
        order in prop::collection::vec(0_usize..1000, 11),
        reversed in prop::collection::vec(any::<bool>(), 11),
        start in prop::collection::vec(0_usize..4, 11),
        copies in prop::collection::vec(0_usize..3, 11),
        moved in prop_oneof![Just(0.0), Just(1e6), Just(-1234.5)],
        angle in prop_oneof![Just(0.0_f64), Just(37.0), Just(90.0)],
    ) {
        let (sin, cos) = angle.to_radians().sin_cos();
        let turn = |p: &ArcSpline| p.mapped(false, |q| point(q.x * cos - q.y * sin + moved, q.x * sin + q.y * cos - moved));
        let mut drawing: Vec<(usize, ArcSpline)> = Vec::new();
        for (i, path) in sheet().iter().enumerate() {
            for copy in 0..=copies[i] / 2 {
                let mut path = turn(path);
                let n = path.vertices.len();
                if path.closed {
                    path.vertices.rotate_left((start[i] + copy) % n);
                }
                drawing.push((order[(i + copy) % 11] ^ i, if reversed[i] { path.reversed() } else { path }));
            }
        }
        drawing.sort_by_key(|(key, _)| *key);
        let drawing: Vec<ArcSpline> = drawing.into_iter().map(|(_, path)| path).collect();
        let all = found(&drawing);
        prop_assert_eq!(summary(&all), summary(&found(&sheet())), "{:?}", all.defects);
    }

    #[test]
    fn neighbors_drawn_as_loose_lines_are_the_same_in_any_order(
        order in prop::collection::vec(0_usize..1000, 60),
        reversed in prop::collection::vec(any::<bool>(), 60),
        noise in prop_oneof![Just(0.0), Just(0.002)],
    ) {
        let mut parts = Vec::new();
        for i in 0..4 {
            for j in 0..3 {
                let (x, y) = (f64::from(7 * i), f64::from(5 * j));
                // Rows of bricks, unless their joints would be in doubt by the noise.
                let stagger = if noise == 0.0 { 0.1 * y } else { 0.0 };
                parts.push(rectangle(x + stagger, y, 7.0, 5.0).mapped(false, |p| point(p.x, p.y + 0.01 * p.x)));
            }
        }
        let mut keyed: Vec<(usize, ArcSpline)> = sides(&parts)
            .into_iter()
            .enumerate()
            .map(|(i, mut side)| {
                // No two ends are off by the same: what meets exactly is not disturbed by what is near.
                let off = noise * (((37 * i) % 101) as f64 / 50.0 - 1.0);
                side.vertices[0].point.x += off;
                side.vertices[1].point.y -= off;
                (order[i % 60] ^ i, if reversed[i % 60] { side.reversed() } else { side })
            })
            .collect();
        keyed.sort_by_key(|(key, _)| *key);
        let drawing: Vec<ArcSpline> = keyed.into_iter().map(|(_, side)| side).collect();
        let all = found(&drawing);
        prop_assert_eq!(all.pockets.len(), 12, "{:?}", all.defects);
        let area: f64 = all.pockets.iter().map(medial::Pocket::area).sum();
        prop_assert!((area - 420.0).abs() < 1.0);
    }

    #[test]
    fn a_drawing_rounded_to_two_decimals_keeps_its_pockets(
        x in -500.0..500.0_f64,
        y in -500.0..500.0_f64,
        angle in 0.0..6.3_f64,
    ) {
        let (sin, cos) = angle.sin_cos();
        let round = |c: f64| (100.0 * c).round() / 100.0;
        let parts = [rectangle(0.0, 0.0, 30.0, 20.0), rectangle(5.0, 5.0, 4.0, 4.0)];
        let drawing: Vec<ArcSpline> = sides(&parts)
            .iter()
            .chain([&line((30.0, 20.0), (40.0, 20.0)), &line((40.0, 20.0), (40.0, 0.0)), &line((40.0, 0.0), (30.0, 0.0))])
            .map(|p| p.mapped(false, |q| point(round(q.x * cos - q.y * sin + x), round(q.x * sin + q.y * cos + y))))
            .collect();
        let all = found(&drawing);
        prop_assert_eq!(all.pockets.len(), 2, "{:?}", all.defects);
        prop_assert!((all.pockets.iter().map(medial::Pocket::area).sum::<f64>() - 784.0).abs() < 2.0);
    }
}
