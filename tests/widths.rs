//! The report knows how wide is cut: the largest step, what is cut at full width, and what remains.

use medial::{ArcSpline, Job, Mat, Move, Path, Pocket, Start, Tolerance, Units, point};

fn mat(loops: Vec<ArcSpline>) -> Mat {
    Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap()
}

/// A pocket of 60 by 40.
fn rectangle() -> Mat {
    mat(vec![ArcSpline::closed([(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)])])
}

fn job() -> Job {
    Job { depth: 2.0, step_down: Some(1.0), ..Job::new(Units::Mm, 6.0, 2.4) }
}

fn path(mat: &Mat, job: &Job) -> Path {
    job.path(std::slice::from_ref(mat)).unwrap()
}

/// Length of the links that go straight across from one level to the next.
fn straight_links(mat: &Mat, path: &Path) -> f64 {
    let feeds = path.moves.pairs().filter(|pair| matches!(pair[1], Move::Feed { .. }));
    let ends = feeds.map(|pair| [pair[0].to(), pair[1].to()]).filter(|[a, b]| a.z == b.z && a.z < 0.0);
    let across = ends.map(|ends| ends.map(|p| p.xy()));
    let across = across.filter(|[a, b]| (mat.distance(*a) - mat.distance(*b)).abs() > 1e-6);
    across.map(|[a, b]| a.distance(b)).sum()
}

/// Passes cut at full width, at each of two heights.
fn full(mat: &Mat, path: &Path) -> f64 {
    let own = &path.pockets[0];
    0.5 * (own.amounts.full_width_length - own.amounts.entry_length - straight_links(mat, path))
}

#[test]
fn at_the_corners_of_a_rectangle_neighbors_are_farther_apart_than_the_step() {
    let path = path(&rectangle(), &job());
    let own = &path.pockets[0];
    assert!((own.amounts.largest_step - 2.4 * 2f64.sqrt()).abs() < 1e-9, "{}", own.amounts.largest_step);
}

#[test]
fn between_straight_walls_passes_lie_apart_across_the_axis() {
    // Half circles at both ends: levels at 3 and 5.4, the axis at 7.
    let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (50.0, 0.0, 1.0), (50.0, 14.0, 0.0), (0.0, 14.0, 1.0)]);
    let own = &path(&mat(vec![slot]), &job()).pockets[0];
    assert!((own.amounts.largest_step - 2.0 * (7.0 - 5.4)).abs() < 1e-9, "{}", own.amounts.largest_step);
    assert!((own.amounts.largest_step_at.unwrap().y - 7.0).abs() < 1e-9);
}

#[test]
fn one_side_of_the_first_pass_is_cut_at_full_width() {
    // The innermost level at 19.8 is 20.4 by 0.4.
    let full = full(&rectangle(), &path(&rectangle(), &job()));
    assert!((full - 20.8).abs() < 1e-9, "{full}");
}

#[test]
fn from_outside_the_wall_pass_is_cut_at_full_width() {
    let full = full(&rectangle(), &path(&rectangle(), &Job { start: Start::Outside, ..job() }));
    assert!((full - 2.0 * (54.0 + 34.0)).abs() < 1e-9, "{full}");
}

#[test]
fn one_side_of_a_narrow_arm_is_cut_at_full_width() {
    let outline = ArcSpline::closed([
        (0.0, 0.0, 0.0),
        (40.0, 0.0, 0.0),
        (40.0, 16.0, 0.0),
        (80.0, 16.0, 0.0),
        (80.0, 24.0, 0.0),
        (40.0, 24.0, 0.0),
        (40.0, 40.0, 0.0),
        (0.0, 40.0, 0.0),
    ]);
    let arm = mat(vec![outline]);
    let full = full(&arm, &path(&arm, &job()));
    // The pass reaches 37 into the arm; the first diameter of that is cut beside the last pass of the
    // chamber, and a little belongs to the first pass.
    assert!(full > 30.0 && full < 42.0, "{full}");
}

#[test]
fn an_entry_is_as_long_as_its_slope_and_counts_as_full_width() {
    let path = path(&rectangle(), &job());
    let own = &path.pockets[0];
    let least = 2.0 / 3f64.to_radians().sin();
    assert!((own.amounts.entry_length / least - 1.0).abs() < 1e-9, "{}", own.amounts.entry_length);
    // Seven links at each height, of which those that bend are longer than the step.
    assert!(own.amounts.link_length > 2.0 * 7.0 * 2.4 && own.amounts.link_length < 2.0 * 7.0 * 2.4 * 2.5);
    let straight = straight_links(&rectangle(), &path);
    assert!(
        own.amounts.full_width_length > own.amounts.entry_length + straight
            && straight < own.amounts.link_length
    );
}

#[test]
fn rest_is_told_with_its_place() {
    let path = path(&rectangle(), &job());
    let rest = &path.pockets[0].unreachable;
    assert_eq!(rest.len(), 4);
    assert!(rest.iter().any(|r| r.at.distance(point(60.0, 40.0)) < 1e-9));
    assert!(rest.iter().all(|r| (r.height - 3.0 * (2f64.sqrt() - 1.0)).abs() < 1e-9));
}

#[test]
fn what_pockets_amount_to_adds_up_to_the_path() {
    let island = ArcSpline::circle(point(20.0, 20.0), 6.0).reversed();
    let square = |x: f64| {
        ArcSpline::closed([(x, 0.0, 0.0), (x + 40.0, 0.0, 0.0), (x + 40.0, 40.0, 0.0), (x, 40.0, 0.0)])
    };
    let mats = [mat(vec![square(0.0), island]), mat(vec![square(60.0)])];
    let path = job().path(&mats).unwrap();
    let sum = |of: fn(&medial::Totals) -> f64| path.pockets.iter().map(|p| of(&p.totals)).sum::<f64>();
    assert!((sum(|t| t.cut_length) - path.totals.cut_length).abs() < 1e-6);
    assert!((sum(|t| t.rapid_length) - path.totals.rapid_length).abs() < 1e-6);
    assert_eq!(sum(|t| t.retracts as f64), path.totals.retracts as f64);
    assert!(path.pockets.iter().all(|p| p.totals.retracts > 0 && p.most_retracts >= 2));
}

/// Length of what is cut at the floor at less than the feed rate.
fn slow_length(path: &Path, job: &Job) -> f64 {
    let floor = job.top - job.depth;
    let slow = |pair: &[Move; 2]| {
        let rate = match pair[1] {
            Move::Rapid { .. } => return false,
            Move::Feed { rate, .. } | Move::Arc { rate, .. } => rate,
        };
        pair.iter().all(|m| m.to().z == floor) && rate < job.feed
    };
    path.moves.pairs().filter(slow).map(|pair| pair[0].to().distance(pair[1].to())).sum()
}

#[test]
fn first_passes_and_corners_are_cut_more_slowly_if_asked() {
    let slow = Job { slow: 0.5, ..job() };
    let (plain, slowed) = (path(&rectangle(), &job()), path(&rectangle(), &slow));
    assert_eq!(slow_length(&plain, &job()), 0.0);
    // All of the innermost pass, and 3 + 2.4 + 2.4 round each corner of the seven others, but on the
    // short sides of the first of these, which are 5.2 long.
    let corner = 3.0 + 2.0 * 2.4;
    let expected = 2.0 * (20.4 + 0.4) + 2.0 * (5.2 + corner) + 6.0 * 4.0 * corner;
    let length = slow_length(&slowed, &slow);
    assert!((length - expected).abs() < 1e-6, "{length} {expected}");
    assert!((slowed.totals.cut_length - plain.totals.cut_length).abs() < 1e-6);
    assert!(slowed.totals.minutes > plain.totals.minutes);
    let outside = Job { start: Start::Outside, ..slow };
    let length = slow_length(&path(&rectangle(), &outside), &outside);
    assert!((length - 2.0 * (54.0 + 34.0)).abs() < 1e-6, "{length}");
}
