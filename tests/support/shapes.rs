//! Generators of pockets for tests, examples and benches: every shape from a kind, a size, a seed.
#![allow(dead_code)]

use medial::{ArcSpline, Point, Vector, Vertex, point};
use std::f64::consts::{PI, TAU};

/// A small, fast, seeded generator of random numbers (xorshift), so that a shape is its seed.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        for _ in 0..10 {
            random.next();
        }
        random
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Uniform in 0..1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// The kinds of shapes; see [`make`].
pub const KINDS: [&str; 10] =
    ["smooth", "wavy", "fingers", "coast", "isles", "hexagons", "gear", "convex", "spiral", "symmetric"];

/// The loops of a shape with about `size` elements, the outer one first and counter-clockwise.
pub fn make(kind: &str, size: usize, seed: u64) -> Vec<ArcSpline> {
    let mut random = Random::new(seed);
    let r = &mut random;
    match kind {
        "smooth" => vec![radial(size, &blob(r), point(0.0, 0.0), 1.3, false)],
        "wavy" => {
            let lobes = (size / 16).max(2) as f64;
            let waves = [(lobes, 0.6 / lobes, TAU * r.unit()), (3.0, 0.1, 1.0), (7.0, 0.05 * r.unit(), 2.0)];
            vec![radial(size, &waves, point(0.0, 0.0), 1.0, false)]
        }
        "fingers" => vec![fingers(size, r)],
        "coast" => vec![coast(size, r)],
        "isles" => {
            // From a few islands of many elements to many of two: 1000 circles at a size of 2000.
            let per = [2, 6, 10, 40][(r.next() % 4) as usize];
            let count = (if per == 2 { size / 2 } else { size / (2 * per) }).max(1);
            let outer = size.saturating_sub(count * per).max(16);
            let mut loops = vec![radial(outer, &blob(r), point(0.0, 0.0), 1.3, false)];
            loops.extend(isles(r, count, per, false));
            loops
        }
        "hexagons" => {
            let mut loops = vec![coast(size / 2, r)];
            loops.extend(isles(r, (size / 12).max(1), 6, true));
            loops
        }
        "gear" => gear(size, r.unit() < 0.5),
        "convex" => {
            let mut angles: Vec<f64> = (0..size).map(|_| TAU * r.unit()).collect();
            angles.sort_by(f64::total_cmp);
            angles.dedup();
            vec![polygon(angles.iter().map(|a| point(1.7 * a.cos(), a.sin())))]
        }
        "spiral" => vec![spiral(size, r)],
        "symmetric" => symmetric(size, r),
        _ => panic!("no such shape: {kind}"),
    }
}

/// A closed polygon.
pub fn polygon(points: impl IntoIterator<Item = Point>) -> ArcSpline {
    ArcSpline::closed(points.into_iter().map(|p| (p.x, p.y, 0.0)))
}

/// A regular polygon of circumradius `radius`.
pub fn regular(sides: usize, center: Point, radius: f64) -> ArcSpline {
    polygon((0..sides).map(|i| center + Vector::from_angle(TAU * i as f64 / sides as f64) * radius))
}

/// Two arcs from one place and direction to another, joined smoothly.
pub fn biarc(p0: Point, t0: Vector, p1: Point, t1: Vector) -> [Vertex; 2] {
    let v = p1 - p0;
    let (sum, turn) = (v.dot(t0 + t1), (t0 - t1).length_squared());
    let d = v.length_squared() / (sum + (sum * sum + turn * v.length_squared()).sqrt());
    let joint = (p0 + t0 * d).midpoint(p1 - t1 * d);
    let bulge = |t: Vector, chord: Vector| (0.5 * t.angle_to(chord)).tan();
    [
        Vertex { point: p0, bulge: bulge(t0, joint - p0) },
        Vertex { point: joint, bulge: -bulge(-t1, joint - p1) },
    ]
}

/// A closed smooth curve through places with directions.
fn through(curve: &[(Point, Vector)]) -> ArcSpline {
    let n = curve.len();
    let pair = |i: usize| (curve[i], curve[(i + 1) % n]);
    let vertices = (0..n).flat_map(|i| {
        let ((p0, t0), (p1, t1)) = pair(i);
        biarc(p0, t0, p1, t1)
    });
    ArcSpline { vertices: vertices.collect(), closed: true }
}

type Wave = (f64, f64, f64);

fn blob(r: &mut Random) -> Vec<Wave> {
    (1..=24).map(|k| (f64::from(k), 0.12 / (1.0 + 0.3 * f64::from(k)) * r.unit(), TAU * r.unit())).collect()
}

fn wave(waves: &[Wave], angle: f64) -> (f64, f64) {
    waves.iter().fold((1.0, 0.0), |(r, dr), &(k, a, p)| {
        (r + a * (k * angle + p).cos(), dr - a * k * (k * angle + p).sin())
    })
}

/// A smooth curve around a center, its radius a sum of waves.
fn radial(size: usize, waves: &[Wave], center: Point, scale: f64, clockwise: bool) -> ArcSpline {
    let m = (size / 2).max(3);
    let sign = if clockwise { -1.0 } else { 1.0 };
    let curve: Vec<_> = (0..m)
        .map(|i| {
            let angle = sign * TAU * i as f64 / m as f64;
            let (radius, slope) = wave(waves, angle);
            let out = Vector::from_angle(angle);
            (center + out * (radius * scale), ((out * slope + out.left() * radius) * sign).unit())
        })
        .collect();
    through(&curve)
}

fn fingers(size: usize, r: &mut Random) -> ArcSpline {
    let count = (size / 100).max(3);
    let width = TAU / count as f64;
    let length: Vec<f64> = (0..count).map(|_| r.between(0.15, 0.3)).collect();
    let phase = TAU * r.unit();
    let radius = |angle: f64| {
        let turns = (angle / width).rem_euclid(count as f64);
        let i = (turns as usize).min(count - 1);
        let s = 0.5 * (1.0 - ((turns - i as f64) * TAU).cos());
        let profile = 0.5 * ((3.0 * (s - 0.5)).tanh() / 1.5f64.tanh() + 1.0);
        1.0 + 0.08 * (3.0 * angle + phase).cos() + length[i] * profile
    };
    let m = (size / 2).max(12);
    let curve: Vec<_> = (0..m)
        .map(|i| {
            let angle = TAU * i as f64 / m as f64;
            let h = 1e-6 * width;
            let slope = (radius(angle + h) - radius(angle - h)) / (2.0 * h);
            let out = Vector::from_angle(angle);
            (point(0.0, 0.0) + out * radius(angle), (out * slope + out.left() * radius(angle)).unit())
        })
        .collect();
    through(&curve)
}

/// A noisy star-shaped polygon, about half its vertices reflex.
fn coast(size: usize, r: &mut Random) -> ArcSpline {
    let waves = blob(r);
    let m = size.max(5);
    polygon((0..m).map(|i| {
        let angle = TAU * (i as f64 + 0.4 * r.unit()) / m as f64;
        let radius = 1.3 * wave(&waves, angle).0 + r.between(-2.0, 2.0) / m as f64;
        point(0.0, 0.0) + Vector::from_angle(angle) * radius
    }))
}

/// Islands on a jittered grid inside of radius 0.45: smooth ones, or polygons.
fn isles(r: &mut Random, count: usize, per: usize, polygons: bool) -> Vec<ArcSpline> {
    let m = ((count as f64).sqrt() * 1.4).ceil() as usize + 2;
    let cell = 0.9 / m as f64;
    let place = |i: usize| -0.45 + cell * (i as f64 + 0.5);
    let centers: Vec<Point> = (0..m * m)
        .map(|i| point(place(i / m), place(if (i / m).is_multiple_of(2) { i % m } else { m - 1 - i % m })))
        .filter(|p| p.to_vector().length() < 0.45)
        .collect();
    (0..count.min(centers.len()))
        .map(|i| {
            let center = centers[i * centers.len() / count.min(centers.len())];
            let center = center + Vector { x: r.unit() - 0.5, y: r.unit() - 0.5 } * (0.2 * cell);
            let radius = cell * r.between(0.15, 0.3);
            if polygons {
                let corner = |k: usize, radius: f64| {
                    center + Vector::from_angle(-TAU * k as f64 / per as f64) * radius
                };
                polygon((0..per).map(|k| corner(k, radius * r.between(0.7, 1.0))).collect::<Vec<_>>())
            } else if per == 2 {
                ArcSpline::circle(center, radius).reversed()
            } else {
                let waves = [(2.0, 0.1 * r.unit(), TAU * r.unit()), (3.0, 0.08 * r.unit(), TAU * r.unit())];
                radial(per, &waves, center, radius, true)
            }
        })
        .collect()
}

/// An exactly periodic gear of straight teeth, perhaps with a round hole: all its disks are ties.
pub fn gear(size: usize, hole: bool) -> Vec<ArcSpline> {
    let teeth = (size / 4).max(3);
    let tip = 1.0 + 4.0 / teeth as f64;
    let profile = [(0.0, 1.0), (0.45, 1.0), (0.5, tip), (0.95, tip)];
    let corners = (0..teeth).flat_map(|i| {
        profile.map(|(at, radius)| {
            point(0.0, 0.0) + Vector::from_angle(TAU * (i as f64 + at) / teeth as f64) * radius
        })
    });
    let mut loops = vec![polygon(corners)];
    if hole {
        loops.push(ArcSpline::circle(point(0.0, 0.0), 0.3).reversed());
    }
    loops
}

/// A corridor of several turns, its walls biarcs.
fn spiral(size: usize, r: &mut Random) -> ArcSpline {
    let turns = r.between(2.0, 8.0);
    let width = 0.9 / turns * r.between(0.2, 0.5);
    let m = (size / 4).max(16);
    let wall = |u: f64, off: f64| {
        let angle = TAU * turns * u;
        let radius = 0.1 + 0.9 * u + off;
        let out = Vector::from_angle(angle);
        (point(0.0, 0.0) + out * radius, (out * 0.9 + out.left() * (radius * TAU * turns)).unit())
    };
    let at = |i: usize| i as f64 / m as f64;
    let (outer, inner): (Vec<_>, Vec<_>) = (0..=m).map(|i| (wall(at(i), width), wall(at(i), 0.0))).unzip();
    let mut vertices = Vec::new();
    for i in 0..m {
        vertices.extend(biarc(outer[i].0, outer[i].1, outer[i + 1].0, outer[i + 1].1));
    }
    vertices.push(Vertex { point: outer[m].0, bulge: 0.0 });
    for i in (0..m).rev() {
        vertices.extend(biarc(inner[i + 1].0, -inner[i + 1].1, inner[i].0, -inner[i].1));
    }
    vertices.push(Vertex { point: inner[0].0, bulge: 0.0 });
    ArcSpline { vertices, closed: true }
}

/// A plate with rows of equal islands, every number a little off: by nothing, by a few ulps, or by so
/// much that what was a tie is one no longer.
fn symmetric(size: usize, r: &mut Random) -> Vec<ArcSpline> {
    let m = (((size / 5) as f64).sqrt() as usize).max(1);
    let side = 20.0 * m as f64 + 10.0;
    let ulps = [0.0, 4.0, 32.0, 1e3, 1e5, 1e8][(r.next() % 6) as usize];
    let mut near = |x: f64| x * (1.0 + (ulps * r.between(-1.0, 1.0)).round() * f64::EPSILON);
    let mut loops = vec![polygon(
        [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(x, y)| point(near(x), near(y))),
    )];
    for i in 0..m * m {
        let (x, y) = (20.0 * (i / m) as f64 + 15.0, 20.0 * (i % m) as f64 + 15.0);
        loops.push(match i % 3 {
            0 => ArcSpline::circle(point(near(x), near(y)), near(5.0)).reversed(),
            1 => polygon(
                [(-5.0, -5.0), (-5.0, 5.0), (5.0, 5.0), (5.0, -5.0)]
                    .map(|(a, b)| point(near(x + a), near(y + b))),
            ),
            _ => {
                let half = near(5.0);
                ArcSpline::closed([(x - half, y, -1.0), (x + half, y, -(PI / 4.0).tan())])
            }
        });
    }
    loops
}
