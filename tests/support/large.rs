//! Pockets of any number of elements, as large parts have them: what the benches measure.
//!
//! `snow`: a snowflake of Koch, a little off everywhere and rounded by biarcs; smooth, with lobes of all
//! sizes. `plate`: circles, slots, rounded rectangles and hexagons in an irregular grid. `hilbert`: a
//! channel along a curve of Hilbert, round outside and sharp inside of its turns. `spiral`: a channel of
//! changing width. `coast`: a noisy polygon, half of its corners reflex. `grid`: equal circles in an exact
//! grid, where all is ties.
#![allow(dead_code)]

use crate::shapes::{self, Random, biarc, polygon};
use medial::{ArcSpline, Point, Vector, Vertex, point};
use std::f64::consts::{FRAC_PI_3, TAU};

/// The kinds of shapes; see [`make`].
pub const KINDS: [&str; 6] = ["snow", "plate", "hilbert", "spiral", "coast", "grid"];

/// The loops of a shape with about `size` elements, the outer one first and counter-clockwise.
pub fn make(kind: &str, size: usize) -> Vec<ArcSpline> {
    match kind {
        "snow" => vec![snow(size)],
        "plate" => plate(size),
        "hilbert" => vec![hilbert(size)],
        "spiral" => vec![spiral(size)],
        "coast" => shapes::make("coast", size, 1),
        "grid" => grid(size),
        _ => panic!("no such shape: {kind}"),
    }
}

/// Biarcs between the middles of the sides of a polygon, along the sides there.
fn rounded(corners: &[Point]) -> ArcSpline {
    let n = corners.len();
    let middle = |i: usize| {
        let (a, b) = (corners[i % n], corners[(i + 1) % n]);
        (a.midpoint(b), (b - a).unit())
    };
    let vertices = (0..n).flat_map(|i| {
        let ((p0, t0), (p1, t1)) = (middle(i), middle(i + 1));
        biarc(p0, t0, p1, t1)
    });
    ArcSpline { vertices: vertices.collect(), closed: true }
}

fn snow(size: usize) -> ArcSpline {
    /// Radius of the triangle it begins with.
    const RADIUS: f64 = 500.0;
    let corner = |i: u32| point(0.0, 0.0) + Vector::from_angle(TAU * f64::from(i) / 3.0) * RADIUS;
    let mut corners: Vec<Point> = (0..3).map(corner).collect();
    while 8 * corners.len() <= size {
        let n = corners.len();
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % n]);
            let third = (b - a) / 3.0;
            let (sin, cos) = FRAC_PI_3.sin_cos();
            [a, a + third, a + third + third.rotated(cos, -sin), b - third]
        };
        corners = (0..n).flat_map(side).collect();
    }
    let mut random = Random::new(1);
    let off = 0.1 * corners[0].distance(corners[1]);
    let moved = |p: Point| p + Vector { x: off * (random.unit() - 0.5), y: off * (random.unit() - 0.5) };
    rounded(&corners.into_iter().map(moved).collect::<Vec<_>>())
}

fn plate(size: usize) -> Vec<ArcSpline> {
    /// Elements of the four islands together.
    const FOUR: usize = 20;
    let m = ((size * 4 / FOUR) as f64).sqrt().round().max(1.0) as usize;
    let mut random = Random::new(2);
    let mut loops = vec![outline(m)];
    for i in 0..m * m {
        let center = place(i, m) + Vector { x: random.between(-2.0, 2.0), y: random.between(-2.0, 2.0) };
        let r = random.between(3.0, 5.0);
        let at = |x: f64, y: f64| center + Vector { x: x * r, y: y * r };
        let with_bulge = |corners: &[(f64, f64, f64)]| {
            let vertices = corners.iter().map(|&(x, y, bulge)| Vertex { point: at(x, y), bulge });
            ArcSpline { vertices: vertices.collect(), closed: true }
        };
        let quarter = (TAU / 16.0).tan();
        loops.push(match i % 4 {
            0 => ArcSpline::circle(center, r).reversed(),
            1 => with_bulge(&[(-1.0, -0.5, -1.0), (-1.0, 0.5, 0.0), (1.0, 0.5, -1.0), (1.0, -0.5, 0.0)]),
            2 => with_bulge(&[
                (-1.0, -0.6, 0.0),
                (-1.0, 0.6, -quarter),
                (-0.6, 1.0, 0.0),
                (0.6, 1.0, -quarter),
                (1.0, 0.6, 0.0),
                (1.0, -0.6, -quarter),
                (0.6, -1.0, 0.0),
                (-0.6, -1.0, -quarter),
            ]),
            _ => shapes::regular(6, center, r).reversed(),
        });
    }
    loops
}

fn grid(size: usize) -> Vec<ArcSpline> {
    let m = ((size / 2) as f64).sqrt().round().max(1.0) as usize;
    let circle = |i: usize| ArcSpline::circle(place(i, m), 5.0).reversed();
    std::iter::once(outline(m)).chain((0..m * m).map(circle)).collect()
}

/// Place `i` of an `m` by `m` grid, 20 apart, to and fro.
fn place(i: usize, m: usize) -> Point {
    let (row, column) = (i / m, i % m);
    let column = if row % 2 == 0 { column } else { m - 1 - column };
    point(20.0 * row as f64 + 10.0, 20.0 * column as f64 + 10.0)
}

/// A square around that grid.
fn outline(m: usize) -> ArcSpline {
    let side = 20.0 * m as f64;
    polygon([(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(x, y)| point(x, y)))
}

/// Half the width of the channel along the curve of Hilbert, whose steps are 10 long.
const HALF_WIDTH: f64 = 3.5;

fn hilbert(size: usize) -> ArcSpline {
    // Either wall has an element for most steps, and a round one for half of the turns.
    let mut order = 1;
    while 2 * 4usize.pow(order + 1) <= size {
        order += 1;
    }
    let path: Vec<Point> = (0..4usize.pow(order)).map(|i| hilbert_place(i, order)).collect();
    let backward: Vec<Point> = path.iter().rev().copied().collect();
    let mut vertices = wall(&path);
    vertices.extend(wall(&backward));
    let channel = ArcSpline { vertices, closed: true };
    if channel.area() < 0.0 { channel.reversed() } else { channel }
}

/// Place `i` of a curve of Hilbert.
fn hilbert_place(mut i: usize, order: u32) -> Point {
    let (mut x, mut y) = (0usize, 0usize);
    for level in 0..order {
        let step = 1 << level;
        let right = 1 & (i / 2);
        let up = 1 & (i ^ right);
        if up == 0 {
            if right == 1 {
                (x, y) = (step - 1 - x, step - 1 - y);
            }
            (x, y) = (y, x);
        }
        (x, y) = (x + step * right, y + step * up);
        i /= 4;
    }
    point(10.0 * x as f64, 10.0 * y as f64)
}

/// The wall on the right of a path of right angles, round where the path turns left, and square ends.
fn wall(path: &[Point]) -> Vec<Vertex> {
    let along = |i: usize| (path[i + 1] - path[i]).unit();
    let last = path.len() - 1;
    let sharp = |point| Vertex { point, bulge: 0.0 };
    let mut vertices = vec![sharp(path[0] + (along(0).right() - along(0)) * HALF_WIDTH)];
    for corner in path.windows(3) {
        let (before, after) = ((corner[1] - corner[0]).unit(), (corner[2] - corner[1]).unit());
        let turn = before.cross(after);
        let out = |v: Vector| corner[1] + v.right() * HALF_WIDTH;
        if turn > 0.5 {
            vertices.push(Vertex { point: out(before), bulge: (TAU / 16.0).tan() });
            vertices.push(sharp(out(after)));
        } else if turn < -0.5 {
            vertices.push(sharp(corner[1] + (before.right() + after.right()) * HALF_WIDTH));
        }
    }
    let end = along(last - 1);
    vertices.push(sharp(path[last] + (end.right() + end) * HALF_WIDTH));
    vertices
}

fn spiral(size: usize) -> ArcSpline {
    /// Arcs of a wall in a turn, and the distance of turns.
    const ARCS: f64 = 64.0;
    const PITCH: f64 = 10.0;
    let m = (size / 4).max(64);
    let at = |i: usize, sign: f64| {
        let angle = TAU * 2.0 * (i as f64 / ARCS + 1.0);
        let (swell, slope) = ((0.37 * angle).sin(), 0.37 * (0.37 * angle).cos());
        let radius = PITCH * angle / TAU + sign * (3.0 + 0.5 * swell);
        let out = Vector::from_angle(angle);
        let growth = PITCH / TAU + sign * 0.5 * slope;
        (point(0.0, 0.0) + out * radius, (out * growth + out.left() * radius).unit())
    };
    let mut vertices = Vec::with_capacity(4 * m + 2);
    for i in 0..m {
        let ((p0, t0), (p1, t1)) = (at(i, 1.0), at(i + 1, 1.0));
        vertices.extend(biarc(p0, t0, p1, t1));
    }
    vertices.push(Vertex { point: at(m, 1.0).0, bulge: 0.0 });
    for i in (0..m).rev() {
        let ((p0, t0), (p1, t1)) = (at(i + 1, -1.0), at(i, -1.0));
        vertices.extend(biarc(p0, -t0, p1, -t1));
    }
    vertices.push(Vertex { point: at(0, -1.0).0, bulge: 0.0 });
    ArcSpline { vertices, closed: true }
}
