//! Links along the axis: two chambers and the corridor between them, and a ring that winds.

use medial::verify::Boundary;
use medial::{ArcSpline, Element, Job, Mat, Move, Path, Pocket, Point, Start, Tolerance, Units, point};

/// Two chambers, joined by a corridor with four turns, `half` wide on each side.
fn chambers(half: f64) -> Pocket {
    let w = half;
    let below = [(12.0, -w), (30.0 + w, -w), (30.0 + w, 15.0 - w), (50.0 - w, 15.0 - w), (50.0 - w, -w)];
    let above = [(50.0 + w, w), (50.0 + w, 15.0 + w), (30.0 - w, 15.0 + w), (30.0 - w, w), (12.0, w)];
    let left = [(12.0, 12.0), (-12.0, 12.0), (-12.0, -12.0), (12.0, -12.0)];
    let right = [(62.0, -w), (62.0, -13.0), (86.0, -13.0), (86.0, 13.0), (62.0, 13.0), (62.0, w)];
    let corners = left.into_iter().chain(below).chain(right).chain(above);
    let outer = ArcSpline::closed(corners.map(|(x, y)| (x, y, 0.0)));
    Pocket::from_loops(vec![outer], Tolerance::MM).unwrap()
}

/// A ring between two wavy walls of half circles.
fn ring() -> Pocket {
    let wall = |r: f64| {
        let vertex = |i: u32| {
            let (sin, cos) = (f64::from(i) / 16.0 * std::f64::consts::TAU).sin_cos();
            (r * cos, r * sin, [0.45, -0.25][i as usize % 2])
        };
        ArcSpline::closed((0..16).map(vertex))
    };
    Pocket::from_loops(vec![wall(30.0), wall(20.0).reversed()], Tolerance::MM).unwrap()
}

/// Fast enough that links of a hundred millimeters beat lifting the tool.
fn job(start: Start) -> Job {
    let job = Job::new(Units::Mm, 3.0, 1.2);
    Job { start, feed: 6000.0, plunge_feed: 6000.0, clearance: 50.0, step_down: Some(1.0), ..job }
}

fn mat(pocket: &Pocket) -> Mat {
    pocket.medial_axis().unwrap()
}

fn path(pocket: &Pocket, job: &Job) -> Path {
    job.path(&[mat(pocket)]).unwrap()
}

/// Ends of the straight moves below the top.
fn straight_cuts(path: &Path) -> Vec<[Point; 2]> {
    let pairs = path.moves.pairs().filter(|pair| matches!(pair[1], Move::Feed { .. }));
    let ends = pairs.map(|pair| [pair[0].to(), pair[1].to()]);
    ends.filter(|[a, b]| a.z.max(b.z) < 0.0).map(|ends| ends.map(|p| p.xy())).collect()
}

/// The judge looks at every cut, straight or not, in many places: none is closer to the wall than the tool
/// radius and the stock.
fn keeps_its_distance(pocket: &Pocket, job: &Job, path: &Path) {
    let wall = Boundary::new(pocket.loops());
    let mut arcs = 0;
    for pair in path.moves.pairs().filter(|pair| pair[1].to().z < 0.0) {
        let [from, to] = [pair[0].to().xy(), pair[1].to().xy()];
        let cut = match pair[1] {
            Move::Rapid { .. } => continue,
            Move::Feed { .. } => Element::segment(from, to),
            Move::Arc { center, ccw, .. } => {
                arcs += 1;
                let turn = (from - center).angle_to(to - center).abs();
                Element::arc(from, to, (0.25 * turn).tan() * if ccw { 1.0 } else { -1.0 })
            }
        };
        for i in 0..=50 {
            let p = cut.point_at(f64::from(i) / 50.0);
            assert!(wall.distance(p) >= job.wall_distance() - 1e-9, "{p} from {from} to {to}");
        }
    }
    assert!(arcs > 0);
}

#[test]
fn a_link_through_a_winding_corridor_follows_the_axis() {
    let (pocket, job) = (chambers(3.2), job(Start::Outside));
    let path = path(&pocket, &job);
    assert_eq!(path.totals.retracts, 1);
    keeps_its_distance(&pocket, &job, &path);
    // The level sets in the corridor lie at 1.5 and 2.7; only a link comes to its middle.
    let wall = Boundary::new(pocket.loops());
    let in_the_middle = |[a, b]: &[Point; 2]| {
        let inside = |p: &Point| p.x > 13.0 && p.x < 61.0 && wall.distance(*p) > 3.0;
        inside(a) && inside(b)
    };
    let length: f64 =
        straight_cuts(&path).iter().filter(|c| in_the_middle(c)).map(|[a, b]| a.distance(*b)).sum();
    assert!((50.0..100.0).contains(&length), "{length}");
}

#[test]
fn a_corridor_that_is_not_cut_yet_is_no_way() {
    let (pocket, job) = (chambers(3.2), job(Start::Inside));
    let path = path(&pocket, &job);
    keeps_its_distance(&pocket, &job, &path);
    // Both chambers are cleared before the passes that run through the corridor.
    assert_eq!(path.totals.retracts, 2);
}

#[test]
fn with_slots_a_corridor_is_cut_through_and_that_is_told() {
    let (pocket, plain) = (chambers(3.2), job(Start::Inside));
    let slotted = Job { slot: true, feed: 1e9, ..plain.clone() };
    let path = path(&pocket, &slotted);
    keeps_its_distance(&pocket, &plain, &path);
    assert_eq!(path.totals.retracts, 1);
    let own = &path.pockets[0];
    assert!(
        own.amounts.slots == 1 && (40.0..120.0).contains(&own.amounts.slot_length),
        "{}",
        own.amounts.slot_length
    );
    assert!(own.amounts.full_width_length > own.amounts.slot_length);
}

#[test]
fn no_link_leads_through_a_neck_narrower_than_the_tool() {
    for start in [Start::Inside, Start::Outside] {
        for half in [1.0, 1.499_999] {
            let (pocket, job) = (chambers(half), job(start));
            let path = path(&pocket, &job);
            keeps_its_distance(&pocket, &job, &path);
            assert!(path.totals.retracts >= 2);
            let through = |[a, b]: &[Point; 2]| a.x.min(b.x) < 30.0 && a.x.max(b.x) > 50.0;
            assert!(!straight_cuts(&path).iter().any(through));
        }
    }
}

#[test]
fn stock_and_finish_keep_a_link_as_far_from_the_wall_as_a_pass() {
    for start in [Start::Inside, Start::Outside] {
        let job = Job { stock: 0.4, finish: 0.3, depth: 2.0, ..job(start) };
        for pocket in [chambers(3.2), ring()] {
            keeps_its_distance(&pocket, &job, &path(&pocket, &job));
        }
    }
}

#[test]
fn a_ring_is_crossed_at_depth_and_not_lifted_over() {
    let pocket = ring();
    let path = path(&pocket, &job(Start::Inside));
    keeps_its_distance(&pocket, &job(Start::Inside), &path);
    // Once down in each of the eight wide places, and from there to both walls.
    assert_eq!(path.totals.retracts, 8);
}

#[test]
fn links_are_the_same_at_any_size_and_place() {
    let plain = path(&chambers(3.2), &job(Start::Outside)).totals.retracts;
    for (scale, x, y) in [(1e-3, 0.0, 0.0), (1e3, 0.0, 0.0), (1.0, 1e6, -1e6)] {
        let moved = |p: Point| point(x + scale * p.x, y + scale * p.y);
        let outer = chambers(3.2).outer().mapped(false, moved);
        let pocket =
            Pocket::from_loops(vec![outer], Tolerance { fit: 1e-3 * scale, join: 1e-6 * scale }).unwrap();
        let job = Job {
            tool: 3.0 * scale,
            step: 1.2 * scale,
            depth: scale,
            step_down: Some(scale),
            clearance: 50.0 * scale,
            retract: scale,
            ..job(Start::Outside)
        };
        // Rapids do not scale; a feed that does not count always asks for the link.
        let job = Job { feed: 1e9, plunge_feed: 1e9, ..job };
        assert_eq!(path(&pocket, &job).totals.retracts, plain);
    }
}
