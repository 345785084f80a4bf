//! A closed spline like a tree: many apices close to each other, and branches of three sizes.

use medial::boundary::freeform::Nurbs;
use medial::{Point, Vector, point, vector};

/// A branch of the tree: where it begins, where it goes to, half its width at the foot, its side branches.
struct Branch {
    foot: Point,
    way: Vector,
    width: f64,
    sides: usize,
}

/// A tree with six branches on either side, five twigs on either side of each.
pub fn tree() -> Nurbs {
    let mut points = Vec::new();
    outline(&Branch { foot: point(0.0, 0.0), way: vector(0.0, 100.0), width: 3.0, sides: 6 }, 2, &mut points);
    let knots = (0..=points.len()).map(|i| i as f64).collect();
    let weights = vec![1.0; points.len()];
    Nurbs::new(3, knots, points, weights, true).expect("a spline")
}

/// Control points around a branch and all that is on it, up on the right and down on the left.
fn outline(branch: &Branch, generations: usize, points: &mut Vec<Point>) {
    let along = |t: f64, side: f64| {
        let half = branch.width * (1.0 - 0.7 * t) * side;
        branch.foot + branch.way * t + branch.way.unit().right() * half
    };
    let step = 1.0 / (branch.sides as f64 + 1.0);
    let stations = |side: f64, points: &mut Vec<Point>| {
        let place = |i: usize| step * (i as f64 + 0.7);
        let order: Vec<usize> =
            if side > 0.0 { (0..branch.sides).collect() } else { (0..branch.sides).rev().collect() };
        for i in order {
            let (t, half) = (place(i), 0.18 * step * side);
            points.push(along(t - half, side));
            if generations > 0 {
                let share = if generations > 1 { 0.42 - 0.28 * t } else { 0.12 - 0.04 * t };
                let length = branch.way.length() * share;
                let turn = Vector::from_angle(-side * 1.0);
                let way = branch.way.unit().rotated(turn.x, turn.y) * length;
                let twigs = if generations > 1 { 5 } else { 0 };
                outline(
                    &Branch { foot: along(t, side), way, width: 0.06 * length, sides: twigs },
                    generations - 1,
                    points,
                );
            }
            points.push(along(t + half, side));
        }
    };
    points.push(along(0.0, 1.0));
    stations(1.0, points);
    points.extend([along(0.97, 1.0), along(1.03, 0.0), along(0.97, -1.0)]);
    stations(-1.0, points);
    points.push(along(0.0, -1.0));
}
