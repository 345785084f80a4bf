//! Finishing passes are met and left on arcs that touch them, over what is cut already.

use medial::toolpath::Warning;
use medial::{ArcSpline, Direction, Job, Mat, Move, Path, Pocket, Point, Start, Tolerance, Units, point};

const FINISH: f64 = 0.5;

fn mat(loops: Vec<ArcSpline>) -> Mat {
    Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap()
}

fn rectangle(width: f64, height: f64) -> ArcSpline {
    ArcSpline::closed([(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, height, 0.0), (0.0, height, 0.0)])
}

/// A plate of 70 by 40 with a round and a square island.
fn plate() -> Mat {
    let boss = ArcSpline::circle(point(20.0, 20.0), 6.0).reversed();
    let block =
        ArcSpline::closed([(45.0, 15.0, 0.0), (45.0, 25.0, 0.0), (55.0, 25.0, 0.0), (55.0, 15.0, 0.0)]);
    mat(vec![rectangle(70.0, 40.0), boss, block])
}

fn job() -> Job {
    Job { finish: FINISH, depth: 4.0, step_down: Some(2.0), ..Job::new(Units::Mm, 6.0, 2.4) }
}

fn path(mat: &Mat, job: &Job) -> Path {
    job.path(std::slice::from_ref(mat)).unwrap()
}

/// A quarter circle at the floor.
#[derive(Clone, Copy)]
struct Arc {
    index: usize,
    from: Point,
    to: Point,
    center: Point,
    ccw: bool,
}

impl Arc {
    fn radius(&self) -> f64 {
        self.center.distance(self.to)
    }

    /// Direction of travel at a place of the arc.
    fn ahead(&self, at: Point) -> medial::Vector {
        if self.ccw { (at - self.center).left() } else { (at - self.center).right() }
    }
}

/// Quarter circles that end or begin on the wall pass while their other end is farther from the wall
/// than the finishing stock is wide.
fn leads(mat: &Mat, path: &Path, wall: f64) -> (Vec<Arc>, Vec<Arc>) {
    let (mut onto, mut off) = (Vec::new(), Vec::new());
    let floor = path.moves.iter().map(|m| m.to().z).fold(f64::INFINITY, f64::min);
    for (index, pair) in path.moves.pairs().enumerate() {
        let Move::Arc { to, center, ccw, .. } = pair[1] else { continue };
        let (from, to) = (pair[0].to(), to);
        let arc = Arc { index: index + 1, from: from.xy(), to: to.xy(), center, ccw };
        let [a, b] = [from, to].map(|p| mat.distance(p.xy()) - wall);
        let is_quarter = (arc.from - center).dot(arc.to - center).abs() < 1e-9;
        if from.z != floor || to.z != floor || !is_quarter {
            continue;
        }
        if b.abs() < 1e-9 && a > FINISH - 1e-9 {
            onto.push(arc);
        } else if a.abs() < 1e-9 && b > FINISH - 1e-9 {
            off.push(arc);
        }
    }
    (onto, off)
}

#[test]
fn each_finishing_pass_has_a_lead_of_the_radius_of_the_tool_at_either_end() {
    let mat = plate();
    for direction in [Direction::Climb, Direction::Conventional] {
        for start in [Start::Inside, Start::Outside] {
            let job = Job { direction, start, ..job() };
            let path = path(&mat, &job);
            let (onto, off) = leads(&mat, &path, job.wall_distance());
            assert_eq!((onto.len(), off.len()), (3, 3), "{direction:?} {start:?}");
            assert!(onto.iter().chain(&off).all(|a| (a.radius() - 3.0).abs() < 1e-9));
            assert!(!path.warnings.iter().any(|w| matches!(w, Warning::LeadFallback { .. })));
        }
    }
}

#[test]
fn leads_touch_the_pass_and_keep_as_far_from_the_wall() {
    let (mat, job) = (plate(), Job { stock: 0.2, ..job() });
    let path = path(&mat, &job);
    let (onto, off) = leads(&mat, &path, job.wall_distance());
    for (onto, off) in onto.iter().zip(&off) {
        assert_eq!(onto.to, off.from);
        assert!(onto.ccw == off.ccw && onto.center.distance(off.center) < 1e-9);
        // The element after the one and that before the other touch it.
        let next = path.moves.get(onto.index + 1).unwrap();
        let ahead = match next {
            Move::Arc { center, ccw, .. } => Arc { center, ccw, ..*onto }.ahead(onto.to),
            _ => next.to().xy() - onto.to,
        };
        let angle = onto.ahead(onto.to).angle_to(ahead);
        assert!(angle.abs() < 1e-9, "{angle}");
        for arc in [onto, off] {
            assert!(mat.distance(arc.center) - arc.radius() >= job.wall_distance() - 1e-9);
        }
    }
}

#[test]
fn leads_stand_away_from_corners() {
    let (mat, job) = (mat(vec![rectangle(70.0, 40.0)]), job());
    let (onto, _) = leads(&mat, &path(&mat, &job), job.wall_distance());
    // The corners of the pass are 3 from the sides.
    let p = onto[0].to;
    let from_corner = [point(3.0, 3.0), point(67.0, 3.0), point(67.0, 37.0), point(3.0, 37.0)]
        .map(|c| c.distance(p))
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    assert!(from_corner >= 3.0 - 1e-9, "{from_corner}");
}

#[test]
fn where_there_is_less_room_leads_are_smaller_or_none_and_that_is_said() {
    // The passes are 2.8 and 2 across; in the round one no quarter circle gets 0.4 away from it.
    let hole = ArcSpline::circle(point(0.0, 0.0), 4.0);
    for (outline, counts) in [(rectangle(60.0, 8.8), (1, 0)), (hole, (0, 1))] {
        let path = path(&mat(vec![outline]), &Job { finish: 0.4, ..job() });
        let told = path.warnings.iter().find_map(|w| match w {
            Warning::LeadFallback { asked, smaller, none, at } => {
                Some((*asked, (*smaller, *none), at.is_some()))
            }
            _ => None,
        });
        assert_eq!(told, Some((3.0, counts, true)));
    }
}

#[test]
fn the_radius_of_leads_is_a_wish_and_0_means_none() {
    let mat = plate();
    let found = |lead: f64| {
        let job = Job { lead: Some(lead), ..job() };
        let path = path(&mat, &job);
        assert!(!path.warnings.iter().any(|w| matches!(w, Warning::LeadFallback { .. })));
        leads(&mat, &path, job.wall_distance()).0
    };
    assert!(found(0.0).is_empty());
    assert!(found(1.5).iter().all(|a| (a.radius() - 1.5).abs() < 1e-9) && found(1.5).len() == 3);
    // Smaller than the stock is wide they would begin in it.
    assert!(found(0.1).iter().all(|a| (a.radius() - FINISH).abs() < 1e-9));
}
