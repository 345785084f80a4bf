//! Shapes on which offsets are compared: about as many elements as asked for, the same every time.
//!
//! Lengths are millimeters. `snow` is a smooth coast with lobes of all sizes, `plate` one with an island
//! every 20 mm, `rand` a rough star, `hilbert` and `spiral` are long channels; `grid` is a plate with all
//! gaps exactly 10 wide, where fronts meet along whole edges.
#![allow(dead_code)]

#[path = "../../tests/support/shapes.rs"]
pub mod random;

use medial::{ArcSpline, Point, Vector, Vertex, point, vector};
use random::{Random, biarc, polygon};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

pub const NAMES: [&str; 6] = ["snow", "plate", "hilbert", "spiral", "rand", "grid"];

/// Bulge of a quarter circle.
fn quarter() -> f64 {
    (PI / 8.0).tan()
}

/// The loops of a shape, the outer one first; islands run clockwise.
pub fn make(name: &str, size: usize) -> Vec<ArcSpline> {
    let loops = match name {
        "snow" => vec![snow(size)],
        "plate" => plate(size),
        "rand" => vec![rough(size)],
        "hilbert" => vec![hilbert(size)],
        "spiral" => vec![spiral(size)],
        "grid" => grid(size),
        _ => panic!("no such shape: {name}; there are {NAMES:?}"),
    };
    let turned = |(i, l): (usize, ArcSpline)| if (l.area() > 0.0) == (i == 0) { l } else { l.reversed() };
    loops.into_iter().enumerate().map(turned).collect()
}

fn vertex(point: Point, bulge: f64) -> Vertex {
    Vertex { point, bulge }
}

/// Moved and turned.
fn placed(spline: &ArcSpline, at: Point, angle: f64) -> ArcSpline {
    let u = Vector::from_angle(angle);
    spline.mapped(false, |p| at + u * p.x + u.left() * p.y)
}

/// A snowflake of Koch with noise, rounded: parabolas between the middles of its sides, as biarcs.
fn snow(size: usize) -> ArcSpline {
    let mut r = Random::new(7);
    let corner = |k: i32| point(0.0, 0.0) + Vector::from_angle(FRAC_PI_2 - f64::from(k) * TAU / 3.0) * 500.0;
    let mut corners: Vec<Point> = (0..3).map(corner).collect();
    while 8 * corners.len() <= size.max(96) {
        let n = corners.len();
        let teeth = (0..n).flat_map(|i| {
            let (a, side) = (corners[i], (corners[(i + 1) % n] - corners[i]) / 3.0);
            let tip = side * 0.5 + side.left() * 0.75f64.sqrt();
            [a, a + side, a + side + tip, a + side * 2.0]
        });
        corners = teeth.collect();
    }
    let noise = 0.12 * corners[0].distance(corners[1]);
    corners.iter_mut().for_each(|p| *p += vector(r.between(-noise, noise), r.between(-noise, noise)));
    let n = corners.len();
    let parts = (size / (2 * n)).max(1);
    let mut places: Vec<(Point, Vector)> = Vec::with_capacity(n * parts);
    for i in 0..n {
        let [before, at, after] = [corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]];
        let (from, to) = (before.midpoint(at), at.midpoint(after));
        for k in 0..parts {
            let t = k as f64 / parts as f64;
            let (a, b) = (from + (at - from) * t, at + (to - at) * t);
            places.push((a + (b - a) * t, (b - a).unit()));
        }
    }
    smooth(&places)
}

/// A closed curve of biarcs.
fn smooth(places: &[(Point, Vector)]) -> ArcSpline {
    let n = places.len();
    let pair = |i: usize| (places[i], places[(i + 1) % n]);
    let vertices = (0..n).flat_map(|i| {
        let ((p, t), (q, u)) = pair(i);
        biarc(p, t, q, u)
    });
    ArcSpline { vertices: vertices.collect(), closed: true }
}

fn rounded_rectangle(width: f64, height: f64, r: f64) -> ArcSpline {
    let (x, y, b) = (0.5 * width, 0.5 * height, quarter());
    ArcSpline::closed([
        (r - x, -y, 0.0),
        (x - r, -y, b),
        (x, r - y, 0.0),
        (x, y - r, b),
        (x - r, y, 0.0),
        (r - x, y, b),
        (-x, y - r, 0.0),
        (-x, r - y, b),
    ])
}

/// Circles, slots, rounded rectangles and hexagons in a rounded plate with round notches.
fn plate(size: usize) -> Vec<ArcSpline> {
    let mut r = Random::new(11);
    let rows = (((size as f64 / 5.0 + 0.64).sqrt() - 0.8).round() as usize).max(2);
    let side = 20.0 * (rows as f64 + 1.0);
    let mut outline = Vec::new();
    for (k, corner) in [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].into_iter().enumerate() {
        let mut along = vec![(6.0, 0.0, 0.0)];
        for i in 1..=rows {
            let x = 20.0 * i as f64;
            along.extend([(x - 2.5, 0.0, -1.0), (x + 2.5, 0.0, 0.0)]);
        }
        along.push((side - 6.0, 0.0, quarter()));
        let wall = placed(&ArcSpline::open(along), point(corner.0, corner.1), FRAC_PI_2 * k as f64);
        outline.extend(wall.vertices);
    }
    let mut loops = vec![ArcSpline { vertices: outline, closed: true }];
    for i in 0..rows * rows {
        let island = match r.next() % 4 {
            0 => ArcSpline::circle(Point::default(), r.between(2.0, 7.0)),
            1 => {
                let (h, x) = (r.between(1.0, 3.0), r.between(1.5, 5.0));
                ArcSpline::closed([(-x, -h, 0.0), (x, -h, 1.0), (x, h, 0.0), (-x, h, 1.0)])
            }
            2 => rounded_rectangle(r.between(5.0, 11.0), r.between(5.0, 11.0), r.between(0.8, 2.4)),
            _ => {
                let radius = r.between(3.0, 7.5);
                polygon(
                    (0..6).map(|k| Point::default() + Vector::from_angle(FRAC_PI_3 * f64::from(k)) * radius),
                )
            }
        };
        let cell = [i / rows, i % rows].map(|k| 20.0 * (k as f64 + 1.0) + r.between(-1.5, 1.5));
        loops.push(placed(&island, point(cell[0], cell[1]), TAU * r.unit()));
    }
    loops
}

/// A star with noise of several sizes, its vertices about 1 apart.
fn rough(size: usize) -> ArcSpline {
    let mut r = Random::new(13);
    let radius = size as f64 / TAU;
    let vertices = (0..size).map(|i| {
        let a = TAU * i as f64 / size as f64;
        let waves = 0.3 * (5.0 * a + 1.0).cos() + 0.12 * (13.0 * a + 2.0).cos() + 0.03 * (57.0 * a).cos();
        let at = point(0.0, 0.0) + Vector::from_angle(a) * (radius * (1.0 + waves) + r.between(-0.4, 0.4));
        vertex(at, if r.next().is_multiple_of(3) { 0.0 } else { r.between(-0.15, 0.15) })
    });
    ArcSpline { vertices: vertices.collect(), closed: true }
}

/// The cell of a Hilbert curve of `side` x `side` cells that comes at a number.
fn hilbert_cell(side: usize, number: usize) -> Point {
    let (mut x, mut y, mut rest, mut s) = (0, 0, number, 1);
    while s < side {
        let right = 1 & (rest / 2);
        let up = 1 & (rest ^ right);
        if up == 0 {
            if right == 1 {
                (x, y) = (s - 1 - x, s - 1 - y);
            }
            (x, y) = (y, x);
        }
        (x, y) = (x + s * right, y + s * up);
        (rest, s) = (rest / 4, 2 * s);
    }
    point(10.0 * x as f64, 10.0 * y as f64)
}

/// A channel 7 wide along a Hilbert curve: corners sharp inside of a turn and round outside.
fn hilbert(size: usize) -> ArcSpline {
    let mut side = 4;
    while 13 * side * side <= 2 * size {
        side *= 2;
    }
    let path: Vec<Point> = (0..side * side).map(|i| hilbert_cell(side, i)).collect();
    // One wall forth on the right of the path, the other one back.
    let wall = |path: &[Point]| {
        let offset = |p: Point, along: Vector| p + along.right() * 3.5;
        let first = (path[1] - path[0]).unit();
        let mut wall = vec![vertex(offset(path[0], first), 0.0)];
        for i in 1..path.len() - 1 {
            let (a, b) = ((path[i] - path[i - 1]).unit(), (path[i + 1] - path[i]).unit());
            let turn = a.cross(b);
            if turn < -0.5 {
                wall.push(vertex(path[i] + (a.right() + b.right()) * 3.5, 0.0));
            } else if turn > 0.5 {
                wall.extend([vertex(offset(path[i], a), quarter()), vertex(offset(path[i], b), 0.0)]);
            }
        }
        let n = path.len();
        wall.push(vertex(offset(path[n - 1], (path[n - 1] - path[n - 2]).unit()), 1.0));
        wall
    };
    let back: Vec<Point> = path.iter().rev().copied().collect();
    ArcSpline { vertices: [wall(&path), wall(&back)].concat(), closed: true }
}

/// A channel along a spiral of Archimedes, its width between 5 and 7.
fn spiral(size: usize) -> ArcSpline {
    let turns = (size as f64 / 128.0).max(1.0);
    let count = (32.0 * turns).round() as usize;
    let wall = |side: f64, i: usize| {
        let a = TAU * (1.0 + turns * i as f64 / count as f64);
        let (half, half_slope) = (3.0 + 0.5 * (7.3 * a).sin(), 3.65 * (7.3 * a).cos());
        let (radius, slope) = (10.0 * a / TAU + side * half, 10.0 / TAU + side * half_slope);
        let out = Vector::from_angle(a);
        (point(0.0, 0.0) + out * radius, (out * slope + out.left() * radius).unit())
    };
    let mut vertices = Vec::with_capacity(4 * count + 2);
    for i in 0..count {
        let ((p, t), (q, u)) = (wall(1.0, i), wall(1.0, i + 1));
        vertices.extend(biarc(p, t, q, u));
    }
    vertices.push(vertex(wall(1.0, count).0, 1.0));
    for i in (0..count).rev() {
        let ((p, t), (q, u)) = (wall(-1.0, i + 1), wall(-1.0, i));
        vertices.extend(biarc(p, -t, q, -u));
    }
    vertices.push(vertex(wall(-1.0, 0).0, 1.0));
    ArcSpline { vertices, closed: true }
}

/// Circles and squares 10 wide, exactly every 20.
fn grid(size: usize) -> Vec<ArcSpline> {
    let rows = ((size as f64 / 3.0).sqrt().round() as usize).max(2);
    let side = 20.0 * rows as f64 + 10.0;
    let square = |x: f64, y: f64, half: f64| {
        polygon(
            [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(a, b)| point(x + a, y + b)),
        )
    };
    let islands = (0..rows * rows).map(|i| {
        let (x, y) = (20.0 * (i / rows) as f64 + 15.0, 20.0 * (i % rows) as f64 + 15.0);
        if (i / rows + i % rows).is_multiple_of(2) {
            ArcSpline::circle(point(x, y), 5.0)
        } else {
            square(x, y, 5.0)
        }
    });
    std::iter::once(square(0.5 * side, 0.5 * side, 0.5 * side)).chain(islands).collect()
}
