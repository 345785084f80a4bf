//! How the tool gets down: helices where there is room, ramps where there is none.

use medial::toolpath::Warning;
use medial::{ArcSpline, Direction, Entry, Job, Move, Path, Pocket, Point, Start, Tolerance, Units};
use std::f64::consts::PI;

fn rectangle(width: f64, height: f64) -> Pocket {
    let corners = [(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, height, 0.0), (0.0, height, 0.0)];
    Pocket::from_loops(vec![ArcSpline::closed(corners)], Tolerance::MM).unwrap()
}

fn path(pocket: &Pocket, job: &Job) -> Path {
    job.path(&[pocket.medial_axis().unwrap()]).unwrap()
}

fn job() -> Job {
    Job { depth: 4.0, step_down: Some(2.0), ..Job::new(Units::Mm, 6.0, 2.4) }
}

/// A sloped arc: from where to where, its center, whether it runs counter-clockwise, and its length in
/// the plane.
struct Sloped {
    ends: [Point; 2],
    fall: f64,
    center: Point,
    ccw: bool,
    length: f64,
}

fn sloped_arcs(path: &Path) -> Vec<Sloped> {
    let sloped = |pair: [Move; 2]| {
        let (from, to) = (pair[0].to(), pair[1].to());
        let Move::Arc { center, ccw, .. } = pair[1] else { return None };
        let turn = (from.xy() - center).angle_to(to.xy() - center).abs();
        let length = turn * center.distance(to.xy());
        let ends = [from.xy(), to.xy()];
        (from.z > to.z).then_some(Sloped { ends, fall: from.z - to.z, center, ccw, length })
    };
    path.moves.pairs().filter_map(sloped).collect()
}

#[test]
fn a_helix_no_longer_than_its_slope_leads_to_every_height() {
    for start in [Start::Inside, Start::Outside] {
        for direction in [Direction::Climb, Direction::Conventional] {
            let job = Job { start, direction, ..job() };
            let path = path(&rectangle(60.0, 40.0), &job);
            let arcs = sloped_arcs(&path);
            assert!(path.warnings.is_empty(), "{:?}", path.warnings);
            assert!((arcs.iter().map(|a| a.fall).sum::<f64>() - 4.0).abs() < 1e-12);
            // Round with the pass that follows, which from the outside is that along the wall.
            let first = start == Start::Inside || arcs.len().is_multiple_of(2);
            assert!(first && arcs.iter().all(|a| a.ccw == (direction == Direction::Climb)));
            let steepest = arcs.iter().map(|a| a.fall / a.length).fold(0.0, f64::max);
            assert!((steepest / 3f64.to_radians().tan() - 1.0).abs() < 1e-12);
            // Twice 2 deep, three turns each: wider ones would be two and a bit.
            let fitted = 2.0 / 3f64.to_radians().tan() / (6.0 * PI);
            assert!(fitted < 2.7 && 3.0 * 2.7 - 2.7 < 3.0 * fitted);
            for arc in &arcs {
                let radius = arc.center.distance(arc.ends[0]);
                assert!((arc.length - PI * radius).abs() < 1e-9 && (radius - fitted).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn a_helix_ends_on_its_pass_in_the_direction_of_the_pass() {
    let path = path(&rectangle(60.0, 40.0), &Job { start: Start::Outside, ..job() });
    let ends: Vec<usize> = (1..path.moves.len() - 1)
        .filter(|&i| {
            let [a, b, c] = [i - 1, i, i + 1].map(|i| path.moves.get(i).unwrap().to().z);
            matches!(path.moves.get(i).unwrap(), Move::Arc { .. }) && a > b && b == c
        })
        .collect();
    assert_eq!(ends.len(), 2);
    for i in ends {
        let Move::Arc { to, center, ccw, .. } = path.moves.get(i).unwrap() else {
            unreachable!("filtered above")
        };
        let from_center = to.xy() - center;
        let ahead = if ccw { from_center.left() } else { from_center.right() };
        let onward = path.moves.get(i + 1).unwrap().to().xy() - to.xy();
        assert!(ahead.cross(onward).abs() < 1e-9 * ahead.length() * onward.length());
        assert!(ahead.dot(onward) > 0.0);
    }
}

#[test]
fn where_there_is_no_room_for_a_helix_the_tool_ramps_and_says_so() {
    // The tool leaves 0.4 to either side of the middle.
    let path = path(&rectangle(60.0, 6.8), &job());
    assert!(matches!(
        path.warnings[..],
        [Warning::EntryFallback { asked: Entry::Helix, ramps: 2, plunges: 0, .. }]
    ));
}

#[test]
fn a_helix_stays_as_far_from_the_wall_as_the_pass() {
    let island = ArcSpline::circle(medial::point(22.0, 20.0), 9.0).reversed();
    let corners = [(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)];
    let pocket = Pocket::from_loops(vec![ArcSpline::closed(corners), island], Tolerance::MM).unwrap();
    let mat = pocket.medial_axis().unwrap();
    let job = Job { stock: 0.3, ..job() };
    let arcs = sloped_arcs(&job.path(std::slice::from_ref(&mat)).unwrap());
    assert!(arcs.len() >= 4);
    for arc in arcs {
        let radius = arc.center.distance(arc.ends[0]);
        assert!(mat.distance(arc.center) - radius >= job.wall_distance() - 1e-9);
    }
}
