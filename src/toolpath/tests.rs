//! Paths over level sets that are known without an axis: squares, rings, slots.

use super::plan::{IsClear, Planner};
use super::*;
use crate::geom::{ArcSpline, Element, Point, point};
use crate::offset::Level;
use crate::tolerance::Units;
use std::f64::consts::PI;

/// A square pocket with corners (0, 0) and (20, 20).
const SIDE: f64 = 20.0;

fn square_level(d: f64) -> Level {
    let (a, b) = (d, SIDE - d);
    let ring = ArcSpline::closed([(a, a, 0.0), (b, a, 0.0), (b, b, 0.0), (a, b, 0.0)]);
    Level { distance: d, loops: if a < b { vec![ring] } else { vec![] }, ridges: vec![] }
}

fn depth_in_square(p: Point) -> f64 {
    [p.x, p.y, SIDE - p.x, SIDE - p.y].into_iter().fold(f64::INFINITY, f64::min)
}

fn ring_level(d: f64) -> Level {
    let ring = |r| ArcSpline::circle(point(0.0, 0.0), r);
    let (outer, inner) = (20.0 - d, 10.0 + d);
    let mut level = Level { distance: d, ..Level::default() };
    if outer > inner {
        level.loops = vec![ring(outer), ring(inner).reversed()];
    } else if outer == inner {
        level.ridges = vec![ring(outer)];
    }
    level
}

fn depth_in_ring(p: Point) -> f64 {
    let r = p.to_vector().length();
    (20.0 - r).min(r - 10.0)
}

/// Distance is concave along straight links in these pockets, or sampled finely enough.
fn clear(depth: fn(Point) -> f64) -> impl Fn(&Element, f64) -> bool {
    move |e, radius| (0..=64).all(|i| depth(e.point_at(f64::from(i) / 64.0)) >= radius * (1.0 - 1e-12))
}

fn levels(level: fn(f64) -> Level, job: &Job) -> Vec<Level> {
    (0..100).map(|k| level(job.distance(k))).take_while(|l| !l.is_empty()).collect()
}

struct Planned {
    moves: Vec<Move>,
    totals: Totals,
    warnings: Vec<Warning>,
    passes: usize,
}

/// Cuts a pocket without its axis and answers the number of passes.
fn cut(planner: &mut Planner, levels: &[Level], is_clear: &IsClear) -> Result<usize, crate::Error> {
    let mut pocket = planner.prepare(levels, is_clear, None);
    let heights = 0..pocket.heights.len();
    planner.cut(&mut pocket, heights)?;
    Ok(pocket.passes())
}

fn plan(level: fn(f64) -> Level, depth: fn(Point) -> f64, job: &Job) -> Planned {
    job.validate().unwrap();
    let mut planner = Planner::new(job);
    let passes = cut(&mut planner, &levels(level, job), &clear(depth)).unwrap();
    let warnings = planner.finish();
    Planned { moves: planner.cutter.moves.to_vec(), totals: planner.cutter.totals, warnings, passes }
}

/// Each cut as an element of the plane with the heights at its ends.
fn cuts(moves: &[Move]) -> Vec<(Element, f64, f64)> {
    let mut cuts = Vec::new();
    for pair in moves.windows(2) {
        let (from, to) = (pair[0].to(), pair[1].to());
        let mut e = Element::segment(from.xy(), to.xy());
        match pair[1] {
            Move::Rapid { .. } => continue,
            Move::Feed { .. } => {}
            Move::Arc { center, ccw, .. } => {
                let turn = (e.start - center).angle_to(e.end - center).abs();
                e.bulge = (turn / 4.0).tan() * if ccw { 1.0 } else { -1.0 };
            }
        }
        cuts.push((e, from.z, to.z));
    }
    cuts
}

/// No rapid at or below the top but straight down where the tool has been that deep; the first goes
/// up; nothing cut leaves the pocket.
fn is_safe(planned: &Planned, depth: fn(Point) -> f64, job: &Job) {
    let mut done: Vec<(Element, f64)> = Vec::new();
    let mut at: Option<Point3> = None;
    let parts = cuts(&planned.moves);
    let mut next = parts.iter();
    for m in &planned.moves {
        let to = m.to();
        let Some(from) = at.replace(to) else {
            assert_eq!(to.z, job.top + job.clearance);
            continue;
        };
        if matches!(m, Move::Rapid { .. }) {
            if from.z.min(to.z) <= job.top && to.z <= from.z {
                assert_eq!(from.xy(), to.xy(), "a rapid across in the stock");
                assert!(
                    done.iter().any(|(e, z)| *z <= to.z && e.distance(to.xy()) < 1e-9),
                    "{from:?} {to:?}"
                );
            } else if from.z.min(to.z) <= job.top {
                assert_eq!(from.xy(), to.xy());
            }
            continue;
        }
        let (e, z0, z1) = next.next().unwrap();
        for i in 0..=16 {
            let room = depth(e.point_at(f64::from(i) / 16.0));
            assert!(room >= job.wall_distance() - 1e-9 || z0.min(*z1) > job.top, "gouge at {from:?}");
        }
        done.push((*e, z0.max(*z1)));
    }
}

fn job() -> Job {
    Job { entry: Entry::Ramp, depth: 2.0, step_down: Some(1.0), ..Job::new(Units::Mm, 4.0, 2.0) }
}

fn turning(moves: &[Move], z: f64, keep: impl Fn(&Element) -> bool) -> f64 {
    let flat = cuts(moves).into_iter().filter(|(e, a, b)| *a == z && *b == z && keep(e));
    flat.map(|(e, ..)| e.area(point(10.0, 10.0))).sum()
}

/// Length of a link to a parallel pass beside, 2 away, that meets it so far ahead: two arcs.
fn bent(ahead: f64) -> f64 {
    let turn = 2.0 * (2.0 / ahead).atan();
    ahead * turn / turn.sin()
}

/// Length of the links of the square at one height: for the first one a corner is too near to bend.
fn links_in_square() -> f64 {
    2.0 + bent(3.0) + bent(3.0)
}

#[test]
fn a_square_is_cut_from_the_inside_in_one_go_per_height() {
    let planned = plan(square_level, depth_in_square, &job());
    is_safe(&planned, depth_in_square, &job());
    // Levels at 2, 4, 6, 8 and two heights; nothing is lifted but between heights.
    assert_eq!((planned.passes, planned.totals.retracts), (8, 2));
    let loops: f64 = [16.0, 12.0, 8.0, 4.0].iter().map(|s| 4.0 * s).sum();
    let links = links_in_square();
    let ramp = (1.0 / 3f64.to_radians().tan()).hypot(1.0);
    let air = 1.0;
    assert!((planned.totals.cut_length - 2.0 * (loops + links + ramp + air)).abs() < 1e-9);
    assert!(planned.warnings.is_empty());
}

#[test]
fn the_last_height_is_the_floor_and_everything_ends_above() {
    let job = Job { top: 3.0, floor_stock: 0.25, ..job() };
    let planned = plan(square_level, depth_in_square, &job);
    is_safe(&planned, depth_in_square, &job);
    let lowest = planned.moves.iter().map(|m| m.to().z).fold(f64::INFINITY, f64::min);
    assert_eq!(lowest, 3.0 - 2.0 + 0.25);
    assert_eq!(planned.moves.last().unwrap().to().z, 8.0);
}

#[test]
fn climb_runs_walls_counter_clockwise_and_conventional_the_other_way() {
    let wall = |e: &Element| depth_in_square(e.midpoint()) < 2.1 && e.length() > 2.5;
    for start in [Start::Inside, Start::Outside] {
        let climb = Job { start, ..job() };
        let planned = plan(square_level, depth_in_square, &climb);
        is_safe(&planned, depth_in_square, &climb);
        assert!(turning(&planned.moves, -2.0, wall) > 0.0);
        let conventional = Job { direction: Direction::Conventional, ..climb };
        assert!(turning(&plan(square_level, depth_in_square, &conventional).moves, -2.0, wall) < 0.0);
    }
}

#[test]
fn from_outside_the_inner_passes_turn_round() {
    let inner = |e: &Element| depth_in_square(e.midpoint()) > 3.9 && e.length() > 2.5;
    let outside = Job { start: Start::Outside, ..job() };
    let planned = plan(square_level, depth_in_square, &outside);
    assert!(turning(&planned.moves, -2.0, inner) < 0.0);
    assert!(turning(&plan(square_level, depth_in_square, &job()).moves, -2.0, inner) > 0.0);
    assert_eq!(planned.totals.retracts, 2);
}

#[test]
fn links_leave_a_pass_and_meet_the_next_in_its_direction_or_go_straight_across() {
    let planned = plan(square_level, depth_in_square, &job());
    let cuts = cuts(&planned.moves);
    let is_across = |e: &Element| (depth_in_square(e.start) - depth_in_square(e.end)).abs() > 1e-9;
    let mut lengths = [0.0, 0.0];
    for w in cuts.windows(2).filter(|w| w.iter().all(|(_, a, b)| *a == -1.0 && *b == -1.0)) {
        let [(before, ..), (e, ..)] = w else { unreachable!() };
        if is_across(before) || is_across(e) {
            let turn = before.tangents().1.angle_to(e.tangents().0).abs();
            let is_straight = [before, e].iter().any(|e| is_across(e) && e.bulge == 0.0);
            assert!((turn - if is_straight { PI / 2.0 } else { 0.0 }).abs() < 1e-9, "{before:?} {e:?}");
        }
        if is_across(e) {
            lengths[usize::from(e.bulge == 0.0)] += e.length();
        }
    }
    assert!((lengths[0] - 2.0 * bent(3.0)).abs() < 1e-9 && (lengths[1] - 2.0).abs() < 1e-12);
}

#[test]
fn every_loop_is_run_in_full_at_its_height_after_a_ramp() {
    let planned = plan(square_level, depth_in_square, &job());
    for z in [-1.0, -2.0] {
        let flat = cuts(&planned.moves).into_iter().filter(|(_, a, b)| *a == z && *b == z);
        let length: f64 = flat.map(|(e, ..)| e.length()).sum();
        assert!((length - (160.0 + links_in_square())).abs() < 1e-9);
    }
    let sloped = cuts(&planned.moves).into_iter().filter(|(e, a, b)| a > b && e.length() > 0.0);
    let steepest = sloped.map(|(e, a, b)| (a - b) / e.length()).fold(0.0, f64::max);
    assert!((steepest - 3f64.to_radians().tan()).abs() < 1e-9);
}

#[test]
fn a_ring_is_cut_along_both_walls_and_entered_beside_what_is_cut() {
    let job = Job { step: 1.5, ..job() };
    let planned = plan(ring_level, depth_in_ring, &job);
    is_safe(&planned, depth_in_ring, &job);
    // Levels at 2 and 3.5 and the ridge 5: one ramp per height, the other wall through a door.
    assert_eq!((planned.passes, planned.totals.retracts), (10, 4));
    let helical = cuts(&planned.moves).iter().filter(|(e, a, b)| a != b && e.bulge != 0.0).count();
    assert!((2..=4).contains(&helical), "{helical}");
}

#[test]
fn a_finishing_pass_runs_once_at_the_floor() {
    let job = Job { finish: 0.5, ..job() };
    let planned = plan(square_level, depth_in_square, &job);
    is_safe(&planned, depth_in_square, &job);
    let wall: Vec<_> = cuts(&planned.moves)
        .into_iter()
        .filter(|(e, ..)| e.length() > 0.0 && depth_in_square(e.midpoint()) < 2.2)
        .collect();
    assert!(wall.iter().all(|(_, a, b)| *a == -2.0 && *b == -2.0));
    let length: f64 = wall.iter().map(|(e, ..)| e.length()).sum();
    assert!((length - 64.0).abs() < 0.6);
    // Roughing at 2.5, 4.5, 6.5, 8.5 twice, and the wall.
    assert_eq!(planned.passes, 9);
}

#[test]
fn spring_passes_run_along_the_wall_again_at_the_floor_only() {
    for finish in [0.0, 0.5] {
        let cut = |spring: u32| {
            let job = Job { finish, spring, ..job() };
            let planned = plan(square_level, depth_in_square, &job);
            is_safe(&planned, depth_in_square, &job);
            (planned.totals.cut_length, planned.totals.retracts)
        };
        let (once, thrice) = (cut(0), cut(2));
        assert!((thrice.0 - once.0 - 2.0 * 64.0).abs() < 1e-9);
        assert_eq!(thrice.1, once.1);
    }
}

#[test]
fn a_slot_as_wide_as_the_tool_is_run_to_and_fro() {
    fn slot(d: f64) -> Level {
        let ridge = ArcSpline::open([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]);
        Level { distance: d, loops: vec![], ridges: if d == 2.0 { vec![ridge] } else { vec![] } }
    }
    let planned = plan(slot, |p| 2.0 - p.y.abs(), &job());
    is_safe(&planned, |p| 2.0 - p.y.abs(), &job());
    let at_floor = cuts(&planned.moves)
        .iter()
        .filter(|(e, a, b)| *a == -2.0 && *b == -2.0 && e.length() == 10.0)
        .count();
    assert_eq!((planned.passes, at_floor), (2, 1));
}

#[test]
fn a_place_where_the_tool_just_fits_is_drilled_and_said() {
    fn hole(d: f64) -> Level {
        let place = ArcSpline::open([(3.0, 4.0, 0.0)]);
        Level { distance: d, loops: vec![], ridges: if d == 2.0 { vec![place] } else { vec![] } }
    }
    let planned = plan(hole, |_| 2.0, &job());
    assert!(matches!(
        planned.warnings[..],
        [Warning::EntryFallback { asked: Entry::Ramp, ramps: 0, plunges: 2, at: Some(_) }]
    ));
    assert_eq!(planned.moves.iter().filter(|m| m.to().z == -2.0).count(), 1);
}

#[test]
fn links_that_would_meet_the_wall_are_not_taken() {
    let job = job();
    let mut planner = Planner::new(&job);
    cut(&mut planner, &levels(square_level, &job), &|_: &Element, _| false).unwrap();
    planner.finish();
    // Each pass of each height is entered for itself.
    assert_eq!(planner.cutter.totals.retracts, 8);
}

#[test]
fn too_many_moves_are_an_error_and_not_a_hang() {
    let job = Job { ramp_angle: 1e-9, depth: 1e6, step_down: Some(1e6), ..job() };
    let mut planner = Planner::new(&job);
    let result = cut(&mut planner, &levels(square_level, &job), &clear(depth_in_square));
    assert!(matches!(result, Err(crate::Error::Effort { .. })));
}

#[test]
fn levels_without_a_tool_begin_at_the_step() {
    let job = Job::new(Units::Mm, 0.0, 3.0);
    let levels = job.levels_up_to(10.0, &square_level).unwrap();
    let distances: Vec<f64> = levels.iter().map(|l| l.distance).collect();
    assert_eq!(distances, [3.0, 6.0, 9.0]);
}

#[test]
fn levels_keep_their_distances_and_end_where_nothing_is_left() {
    let distances = |job: &Job| -> Vec<f64> {
        let levels = job.levels_up_to(10.0, &square_level).unwrap();
        levels.iter().map(|l| l.distance).collect()
    };
    assert_eq!(distances(&job()), [2.0, 4.0, 6.0, 8.0]);
    assert_eq!(distances(&Job { stock: 0.5, ..job() }), [2.5, 4.5, 6.5, 8.5]);
    assert_eq!(distances(&Job { finish: 1.0, ..job() }), [2.0, 3.0, 5.0, 7.0, 9.0]);
    assert_eq!(distances(&Job { step: 3.0, ..job() }), [2.0, 5.0, 8.0]);
    // Cuts a whole tool apart would only touch.
    let whole = distances(&Job { step: 4.0, ..job() });
    assert!(whole[1] < 6.0 && whole[1] > 5.95);
    let too_many = Job { step: 1e-9, ..job() }.levels_up_to(10.0, &square_level);
    assert!(matches!(too_many, Err(crate::Error::Effort { .. })));
}

#[test]
fn the_last_place_of_a_round_hole_is_not_drilled() {
    fn hole(d: f64) -> Level {
        let mut level = Level { distance: d, ..Level::default() };
        match d {
            d if d < 6.0 => level.loops = vec![ArcSpline::circle(point(0.0, 0.0), 6.0 - d)],
            6.0 => level.ridges = vec![ArcSpline::open([(0.0, 0.0, 0.0)])],
            _ => {}
        }
        level
    }
    let planned = plan(hole, |p| 6.0 - p.to_vector().length(), &job());
    assert!(planned.warnings.is_empty() && planned.moves.iter().all(|m| m.to().xy() != point(0.0, 0.0)));
    assert_eq!(planned.passes, 4);
}
