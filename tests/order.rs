//! Pockets one after the other, or all of them height by height.

use medial::{ArcSpline, Job, Mat, Order, Path, Pocket, Tolerance, Units};

/// Two squares with a thin wall between them.
fn squares() -> Vec<Mat> {
    let square = |x: f64| {
        let corners = [(x, 0.0, 0.0), (x + 30.0, 0.0, 0.0), (x + 30.0, 30.0, 0.0), (x, 30.0, 0.0)];
        Pocket::from_loops(vec![ArcSpline::closed(corners)], Tolerance::MM).unwrap()
    };
    [0.0, 31.0].map(|x| square(x).medial_axis().unwrap()).into()
}

fn path(order: Order) -> Path {
    let job = Job { order, finish: 0.3, depth: 3.0, step_down: Some(1.0), ..Job::new(Units::Mm, 6.0, 2.4) };
    job.path(&squares()).unwrap()
}

/// The heights of the cuts, each with the pocket, as they follow one another.
fn sequence(path: &Path) -> Vec<(bool, i64)> {
    let mut found = Vec::new();
    for pair in path.moves.pairs() {
        let (a, b) = (pair[0].to(), pair[1].to());
        let at = (b.x > 30.5, (1000.0 * b.z).round() as i64);
        if a.z == b.z && b.z < 0.0 && found.last() != Some(&at) {
            found.push(at);
        }
    }
    found
}

#[test]
fn level_by_level_no_pocket_is_deeper_than_the_other_by_more_than_one_level() {
    let expected =
        [(false, -1000), (true, -1000), (false, -2000), (true, -2000), (false, -3000), (true, -3000)];
    assert_eq!(sequence(&path(Order::Level)), expected);
}

#[test]
fn pocket_by_pocket_each_is_finished_before_the_next() {
    let expected =
        [(false, -1000), (false, -2000), (false, -3000), (true, -1000), (true, -2000), (true, -3000)];
    assert_eq!(sequence(&path(Order::Pocket)), expected);
}

#[test]
fn both_orders_cut_the_same_and_tell_whose_moves_are_whose() {
    let (pocket, level) = (path(Order::Pocket), path(Order::Level));
    assert!((pocket.totals.cut_length - level.totals.cut_length).abs() < 1e-6);
    assert_eq!(pocket.totals.retracts, level.totals.retracts);
    for (path, ranges) in [(pocket, 1), (level, 3)] {
        let mut all: Vec<_> = path.pockets.iter().flat_map(|p| p.moves.clone()).collect();
        all.sort_by_key(|range| range.start);
        assert!(path.pockets.iter().all(|p| p.moves.len() == ranges));
        assert!(all[0].start == 0 && all.last().unwrap().end == path.moves.len());
        assert!(all.windows(2).all(|w| w[0].end == w[1].start));
    }
}
