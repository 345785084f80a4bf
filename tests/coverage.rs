//! All that the tool can reach is cut, at any step: random places that the tool can reach, and those on
//! the axis, held against every cut at the floor.

#[path = "support/shapes.rs"]
mod shapes;

use medial::{
    ArcSpline, Element, Entry, Job, Mat, Move, Path, Pocket, Point, Start, Tolerance, Units, point, vector,
};
use shapes::Random;

const STEPS: [f64; 6] = [0.2, 0.45, 0.55, 0.75, 0.9, 1.0];

/// Relative to the tool, in pockets of some tools across: some thousand roundings of a place of a level.
const ROUND_OFF: f64 = 1e-12;

fn mat(loops: Vec<ArcSpline>) -> Mat {
    Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap()
}

fn job(tool: f64, share: f64, start: Start) -> Job {
    let job = Job::new(Units::Mm, tool, share * tool);
    Job { start, entry: Entry::Plunge, step_down: Some(1.0), ..job }
}

/// What is cut at the floor.
fn cuts(path: &Path) -> Vec<Element> {
    let floor = path.moves.iter().map(|m| m.to().z).fold(f64::INFINITY, f64::min);
    let at_floor = path.moves.pairs().filter(|pair| pair.iter().all(|m| m.to().z == floor));
    let element = |pair: [Move; 2]| {
        let mut e = Element::segment(pair[0].to().xy(), pair[1].to().xy());
        if let Move::Arc { center, ccw, .. } = pair[1] {
            let turn = (e.start - center).angle_to(e.end - center).abs();
            e.bulge = (turn / 4.0).tan() * if ccw { 1.0 } else { -1.0 };
        }
        e
    };
    at_floor.map(element).collect()
}

/// Places that the tool can reach: in disks with their centers on the axis and anywhere else.
fn reachable(mat: &Mat, radius: f64, random: &mut Random) -> Vec<Point> {
    let vertices = mat.vertices();
    let mut centers: Vec<Point> = vertices.iter().map(|v| v.disk.center).collect();
    for e in mat.edges() {
        let t = random.unit();
        let shares = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * e.weight, t * t];
        let sum = |of: fn(Point) -> f64| (0..3).map(|i| shares[i] * of(e.points[i])).sum::<f64>();
        let weight: f64 = shares.iter().sum();
        centers.push(point(sum(|p| p.x) / weight, sum(|p| p.y) / weight));
    }
    for v in &vertices {
        for _ in 0..8 {
            let away = vector(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * v.disk.radius;
            centers.push(v.disk.center + away);
        }
    }
    centers.retain(|&c| mat.distance(c) >= radius && is_inside(mat, c));
    let rims = centers.iter().flat_map(|&c| {
        (0..8).map(move |i| {
            let (sin, cos) = (f64::from(i) * 0.785 + c.x).sin_cos();
            c + vector(cos, sin) * radius
        })
    });
    let rims: Vec<Point> = rims.collect();
    centers.into_iter().chain(rims).collect()
}

/// Within one of the disks of the axis, which fill the pocket.
fn is_inside(mat: &Mat, p: Point) -> bool {
    mat.vertices().iter().any(|v| v.disk.center.distance(p) < v.disk.radius)
}

/// How far the farthest of the places is from all cuts.
fn farthest(places: &[Point], cuts: &[Element]) -> f64 {
    let nearest = |p: &Point| cuts.iter().map(|e| e.distance(*p)).fold(f64::INFINITY, f64::min);
    places.iter().map(nearest).fold(0.0, f64::max)
}

fn is_covered_at_any_step(mat: &Mat, name: &str, random: &mut Random) {
    let tool = 2.0 * mat.largest_disk().radius / random.between(1.2, 6.0);
    let places = reachable(mat, 0.5 * tool, random);
    for share in STEPS {
        let start = if random.unit() < 0.5 { Start::Inside } else { Start::Outside };
        let path = job(tool, share, start).path(std::slice::from_ref(mat)).unwrap();
        let left = farthest(&places, &cuts(&path));
        let limit = 0.5 * tool * (1.0 + ROUND_OFF);
        assert!(left <= limit, "{name} at {share}: {left} for a tool of {tool}");
    }
}

#[test]
fn at_any_step_all_that_the_tool_can_reach_is_cut() {
    let mut random = Random::new(7);
    for kind in shapes::KINDS {
        for seed in 1..=3 {
            is_covered_at_any_step(&mat(shapes::make(kind, 40, seed)), kind, &mut random);
        }
    }
    for _ in 0..20 {
        simple().iter().for_each(|mat| is_covered_at_any_step(mat, "a simple pocket", &mut random));
    }
}

/// A square with sides of 40, a disk with a radius of 20, and a slot between half disks 30 wide.
fn simple() -> [Mat; 3] {
    let square = [(0.0, 0.0, 0.0), (40.0, 0.0, 0.0), (40.0, 40.0, 0.0), (0.0, 40.0, 0.0)];
    let slot = [(0.0, 0.0, 0.0), (50.0, 0.0, 1.0), (50.0, 30.0, 0.0), (0.0, 30.0, 1.0)];
    let disk = ArcSpline::circle(point(0.0, 0.0), 20.0);
    [ArcSpline::closed(square), disk, ArcSpline::closed(slot)].map(|s| mat(vec![s]))
}

#[test]
fn levels_alone_leave_crests_a_tool_apart() {
    let [square, _, slot] = simple();
    for mat in [square, slot] {
        let job = job(12.0, 1.0, Start::Inside);
        let path = job.path(std::slice::from_ref(&mat)).unwrap();
        let own = &path.pockets[0];
        let loops: Vec<Element> = own
            .levels
            .iter()
            .flat_map(|l| l.loops.iter().chain(&l.ridges))
            .flat_map(|s| s.elements())
            .collect();
        let places = reachable(&mat, 6.0, &mut Random::new(1));
        assert!(farthest(&places, &loops) > 6.2, "levels alone would do");
        assert!(farthest(&places, &cuts(&path)) <= 6.0 * (1.0 + ROUND_OFF));
        assert!(own.amounts.crests > 0 && own.amounts.crest_length > 0.0);
    }
}

#[test]
fn a_crest_between_parallel_walls_is_one_straight_pass_and_in_a_disk_its_center() {
    // Levels at 6 and 15; the middle of the slot is at 15, that of the disk at 20.
    let [_, disk, slot] = simple();
    let crests = |mat: &Mat, step: f64| {
        let path = job(12.0, step, Start::Inside).path(std::slice::from_ref(mat)).unwrap();
        (path.pockets[0].amounts.crests, path.pockets[0].amounts.crest_length)
    };
    // At 10.8 from 6 on: the next level would be 16.8; the axis runs at 15, 9 from the pass.
    let (count, length) = crests(&slot, 0.9);
    assert_eq!(count, 1);
    // What stands round the ends of the axis is 3 wide, and the tool reaches it from 3 away.
    assert!((length - 2.0 * (50.0 - 2.0 * 3.0 + 9.0)).abs() < 1e-9, "{length}");
    // At 11 from 6 on: the level at 17 leaves 3 to the center, and that at 6 nothing.
    assert_eq!(crests(&disk, 11.0 / 12.0).0, 0);
    // At 14 - 0.05 of a tool of 14: levels at 7 and then beyond 20.
    let path = job(14.0, 1.0, Start::Inside).path(std::slice::from_ref(&disk)).unwrap();
    assert_eq!((path.pockets[0].amounts.crests, path.pockets[0].levels.len()), (1, 1));
    assert!((path.pockets[0].amounts.crest_length - 2.0 * 13.0).abs() < 1e-9);
}

#[test]
fn at_half_the_tool_and_less_nothing_is_added() {
    for mat in simple() {
        for share in [0.1, 0.3, 0.5] {
            let path = job(12.0, share, Start::Inside).path(std::slice::from_ref(&mat)).unwrap();
            assert_eq!(path.pockets[0].amounts.crests, 0);
        }
    }
}
