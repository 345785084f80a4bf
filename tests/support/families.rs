//! Families of pockets in which all is ties, drawn with numbers that are a little off: what CAD programs
//! write. Every pocket from a family and a seed, with the trial that it must pass.
#![allow(dead_code)]

use crate::shapes::{Random, biarc, polygon, regular};
use medial::{ArcSpline, Pocket, Point, Tolerance, Vector, Vertex, point, verify};
use std::f64::consts::{PI, TAU};

/// The families; see [`make`].
pub const FAMILIES: [&str; 12] = [
    "gear", "polygon", "grid", "rings", "mirrored", "repeated", "fillets", "neck", "circle", "smooth",
    "cluster", "spiral",
];

/// By how much every number is off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// By up to 32 units in the last place, as sums in another order are.
    Ulps,
    /// By what a drawing written with fewer digits loses: up to ten million of them.
    Digits,
}

/// The loops of a member of a family, placed and perturbed.
pub fn make(family: &str, seed: u64, noise: Noise) -> Vec<ArcSpline> {
    let mut random = Random::new(seed);
    let r = &mut random;
    let mut loops = match family {
        "gear" => gear(r),
        "polygon" => polygons(r),
        "grid" => grid(r),
        "rings" => rings(r),
        "mirrored" => vec![mirrored(r)],
        "repeated" => vec![repeated(r)],
        "fillets" => fillets(r),
        "neck" => vec![neck(r)],
        "circle" => vec![circle_of(0.0, 0.0, 50.0, &angles(r))],
        "smooth" => vec![smooth(r)],
        "cluster" => cluster(r),
        "spiral" => vec![spiral(r)],
        _ => panic!("no such family: {family}"),
    };
    place(&mut loops, r);
    perturb(&mut loops, noise, r);
    loops
}

/// One of some.
fn one_of<T: Copy>(all: &[T], r: &mut Random) -> T {
    all[(r.next() % all.len() as u64) as usize]
}

/// A number from `low` to below `high`.
fn count(low: usize, high: usize, r: &mut Random) -> usize {
    low + (r.next() % (high - low) as u64) as usize
}

/// Turns, scales and moves, each of them often not at all.
fn place(loops: &mut [ArcSpline], r: &mut Random) {
    let angle = one_of(&[0.0, 0.0, 0.25 * PI, PI / 6.0, 1.0], r);
    let scale = one_of(&[1.0, 1.0, 1.0, 1e-3, 1e3, 1.0 / 25.4], r);
    let off = one_of(&[0.0, 0.0, 100.0, 1e4], r) * scale;
    let (sin, cos) = angle.sin_cos();
    let to = |p: Point| point(scale * (p.x * cos - p.y * sin) + off, scale * (p.x * sin + p.y * cos) - off);
    loops.iter_mut().for_each(|l| *l = l.mapped(false, to));
}

/// Moves every number a little.
fn perturb(loops: &mut [ArcSpline], noise: Noise, r: &mut Random) {
    let ulps = match noise {
        Noise::Ulps => one_of(&[0.0, 1.0, 4.0, 32.0], r),
        Noise::Digits => one_of(&[1e3, 1e4, 1e5, 1e6, 1e7], r),
    };
    let most = ulps * f64::EPSILON;
    let size = loops[0].bounds().magnitude();
    for v in loops.iter_mut().flat_map(|l| &mut l.vertices) {
        v.point += Vector { x: r.between(-most, most), y: r.between(-most, most) } * size;
        v.bulge *= 1.0 + r.between(-most, most);
    }
}

/// Bulge of an arc of this many degrees.
fn bulge(degrees: f64) -> f64 {
    (0.25 * degrees.to_radians()).tan()
}

fn vertex(p: Point, bulge: f64) -> Vertex {
    Vertex { point: p, bulge }
}

fn closed(vertices: Vec<Vertex>) -> ArcSpline {
    ArcSpline { vertices, closed: true }
}

fn circle(x: f64, y: f64, radius: f64) -> ArcSpline {
    ArcSpline::circle(point(x, y), radius)
}

/// A circle of arcs that begin at some angles, in degrees.
fn circle_of(x: f64, y: f64, radius: f64, degrees: &[f64]) -> ArcSpline {
    let n = degrees.len();
    let arc = |i: usize| {
        let sweep = (degrees[(i + 1) % n] - degrees[i]).rem_euclid(360.0);
        vertex(point(x, y) + Vector::from_angle(degrees[i].to_radians()) * radius, bulge(sweep))
    };
    closed((0..n).map(arc).collect())
}

/// Angles at which a circle may be cut: evenly or not, some of them next to each other.
fn angles(r: &mut Random) -> Vec<f64> {
    let n = count(2, 13, r);
    let mut all: Vec<f64> = (0..n).map(|i| 360.0 * i as f64 / n as f64).collect();
    if r.unit() < 0.5 {
        let beside = one_of(&[1e-9, 1e-6, 1e-3, 1.0], r);
        all.insert(1, beside);
    }
    all
}

/// Teeth of segments and arcs around a hub, perhaps with a hole.
fn gear(r: &mut Random) -> Vec<ArcSpline> {
    let teeth = count(3, 25, r);
    let (low, high) = (40.0, 40.0 + one_of(&[5.0, 10.0, 20.0], r));
    let round = r.unit() < 0.5;
    let step = 360.0 / teeth as f64;
    let corner = |i: usize, share: f64, radius: f64| {
        point(0.0, 0.0) + Vector::from_angle((step * (i as f64 + share)).to_radians()) * radius
    };
    let along = if round { bulge(0.5 * step) } else { 0.0 };
    let tooth = |i: usize| {
        [
            vertex(corner(i, 0.0, low), along),
            vertex(corner(i, 0.5, low), 0.0),
            vertex(corner(i, 0.5, high), along),
            vertex(corner(i, 1.0, high), 0.0),
        ]
    };
    let mut loops = vec![closed((0..teeth).flat_map(tooth).collect())];
    match r.next() % 3 {
        0 => loops.push(circle(0.0, 0.0, 15.0).reversed()),
        1 => loops.push(regular(teeth, point(0.0, 0.0), 15.0).reversed()),
        _ => {}
    }
    loops
}

/// A regular polygon, perhaps around another one.
fn polygons(r: &mut Random) -> Vec<ArcSpline> {
    let sides = one_of(&[3, 4, 5, 6, 8, 12, 16, 60, 120], r);
    let mut loops = vec![regular(sides, point(0.0, 0.0), 50.0)];
    if r.unit() < 0.5 {
        let others = one_of(&[sides, 3, 4, 6], r);
        loops.push(regular(others, point(0.0, 0.0), 20.0).reversed());
    }
    loops
}

/// Equal islands in rows and columns.
fn grid(r: &mut Random) -> Vec<ArcSpline> {
    let (rows, columns) = (count(1, 5, r), count(1, 5, r));
    let (pitch, half) = (20.0, one_of(&[3.0, 5.0, 9.0, 9.999], r));
    let shape = r.next() % 4;
    let island = |x: f64, y: f64| match shape {
        0 => circle(x, y, half),
        1 => rectangle(x - half, y - half, x + half, y + half),
        2 => slot(x, y, 0.5 * half, 0.5 * half),
        _ => regular(6, point(x, y), half),
    };
    let mut loops = vec![rectangle(0.0, 0.0, pitch * columns as f64, pitch * rows as f64)];
    for i in 0..rows * columns {
        let (x, y) = ((i % columns) as f64 + 0.5, (i / columns) as f64 + 0.5);
        loops.push(island(pitch * x, pitch * y).reversed());
    }
    loops
}

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> ArcSpline {
    polygon([point(x0, y0), point(x1, y0), point(x1, y1), point(x0, y1)])
}

/// A slot of half a length and a radius around a place.
fn slot(x: f64, y: f64, half: f64, radius: f64) -> ArcSpline {
    ArcSpline::closed([
        (x - half, y - radius, 0.0),
        (x + half, y - radius, 1.0),
        (x + half, y + radius, 0.0),
        (x - half, y + radius, 1.0),
    ])
}

/// A ring between two circles cut anywhere, concentric or nearly so.
fn rings(r: &mut Random) -> Vec<ArcSpline> {
    let off = one_of(&[0.0, 0.0, 1e-13, 1e-9, 1e-6, 1e-3, 4.0], r);
    let inner = circle_of(off, 0.0, one_of(&[10.0, 25.0, 40.0], r), &angles(r));
    vec![circle_of(0.0, 0.0, 50.0, &angles(r)), inner.reversed()]
}

/// A random half and its mirror image.
fn mirrored(r: &mut Random) -> ArcSpline {
    let n = count(2, 9, r);
    let heights: Vec<(f64, f64)> =
        (0..=n).map(|i| (100.0 * i as f64 / n as f64 - 50.0, r.between(10.0, 30.0))).collect();
    let bulges: Vec<f64> = (0..=n).map(|_| one_of(&[0.0, 0.0, 0.3, -0.3, bulge(90.0)], r)).collect();
    let below =
        (0..=n).map(|i| vertex(point(heights[i].0, -heights[i].1), if i < n { bulges[i] } else { 0.0 }));
    let above = (0..=n)
        .rev()
        .map(|i| vertex(point(heights[i].0, heights[i].1), if i > 0 { bulges[i - 1] } else { 0.0 }));
    closed(below.chain(above).collect())
}

/// One feature again and again along both sides of a bar, the two sides shifted or not.
fn repeated(r: &mut Random) -> ArcSpline {
    let n = count(1, 9, r);
    let depth: f64 = one_of(&[-4.0, 4.0, 9.0, 10.0], r);
    let (width, round) = (one_of(&[4.0, 10.0], r), r.unit() < 0.5);
    let shift = one_of(&[0.0, 0.0, 1e-9, 5.0], r);
    let feature = |x: f64, y: f64, sign: f64| {
        let half = 0.5 * width * sign;
        let end = if round { -depth.signum() } else { 0.0 };
        let (a, b) = (y, y + sign * depth);
        if round {
            vec![vertex(point(x - half, a), end), vertex(point(x + half, a), 0.0)]
        } else {
            vec![
                vertex(point(x - half, a), 0.0),
                vertex(point(x - half, b), 0.0),
                vertex(point(x + half, b), 0.0),
                vertex(point(x + half, a), 0.0),
            ]
        }
    };
    let mut all = vec![vertex(point(-20.0, -10.5), 0.0)];
    (0..n).for_each(|i| all.extend(feature(20.0 * i as f64, -10.5, 1.0)));
    all.push(vertex(point(20.0 * n as f64, -10.5), 0.0));
    all.push(vertex(point(20.0 * n as f64, 10.5), 0.0));
    (0..n).rev().for_each(|i| all.extend(feature(20.0 * i as f64 + shift, 10.5, -1.0)));
    all.push(vertex(point(-20.0, 10.5), 0.0));
    closed(all)
}

/// Rounded rectangles in each other: all joints smooth, walls parallel, arcs concentric.
fn fillets(r: &mut Random) -> Vec<ArcSpline> {
    let (w, h) = (50.0, one_of(&[50.0, 30.0, 10.0], r));
    let radius = one_of(&[1.0, 5.0, 0.5 * h, h], r);
    let rounded = |inset: f64, radius: f64| {
        let (a, b) = (w - inset, h - inset);
        let mut all = Vec::new();
        for (x, y, turned) in [(a, b, false), (-a, b, true), (-a, -b, false), (a, -b, true)] {
            let [along, across] = if turned { [(0.0, 1.0), (1.0, 0.0)] } else { [(1.0, 0.0), (0.0, 1.0)] };
            let from = |(u, v): (f64, f64)| point(x - x.signum() * u * radius, y - y.signum() * v * radius);
            all.extend([vertex(from(across), bulge(90.0)), vertex(from(along), 0.0)]);
        }
        let mut path = closed(all);
        path.vertices.dedup_by(|b, a| a.point == b.point);
        if path.vertices[0].point == path.vertices[path.len() - 1].point {
            path.vertices.pop();
        }
        path
    };
    let mut loops = vec![rounded(0.0, radius)];
    let inset = 0.4 * h;
    if r.unit() < 0.5 {
        loops.push(rounded(inset, (radius - inset).max(0.5)).reversed());
    }
    loops
}

/// Two chambers with a hair-thin way between them.
fn neck(r: &mut Random) -> ArcSpline {
    let half = one_of(&[1e-9, 1e-7, 1e-5, 1e-3, 0.1, 5.0], r);
    let length = one_of(&[1e-6, 1e-3, 1.0, 20.0], r);
    match r.next() % 3 {
        0 => {
            // Circles that open into each other, or into a channel.
            let radius: f64 = 20.0;
            let x = (radius * radius - half * half).sqrt() + length;
            let end = bulge(360.0 - 2.0 * (half / radius).asin().to_degrees());
            ArcSpline::closed([
                (-length, half, end),
                (-length, -half, 0.0),
                (length, -half, end),
                (length, half, 0.0),
            ])
            .mapped(false, |p| point(p.x * x / x, p.y))
        }
        1 => polygon(
            [
                (-30.0, -20.0),
                (-length, -half),
                (length, -half),
                (30.0, -20.0),
                (30.0, 20.0),
                (length, half),
                (-length, half),
                (-30.0, 20.0),
            ]
            .map(|(x, y)| point(x, y)),
        ),
        // Walls that come near in round noses.
        _ => ArcSpline::closed([
            (-30.0, -20.0, 0.0),
            (-length.max(0.1), -20.0, 0.0),
            (-length.max(0.1), -half - length.max(0.1), -1.0),
            (length.max(0.1), -half - length.max(0.1), 0.0),
            (length.max(0.1), -20.0, 0.0),
            (30.0, -20.0, 0.0),
            (30.0, 20.0, 0.0),
            (length.max(0.1), 20.0, 0.0),
            (length.max(0.1), half + length.max(0.1), -1.0),
            (-length.max(0.1), half + length.max(0.1), 0.0),
            (-length.max(0.1), 20.0, 0.0),
            (-30.0, 20.0, 0.0),
        ]),
    }
}

/// An ellipse of many more arcs, or segments, than its shape asks for.
fn smooth(r: &mut Random) -> ArcSpline {
    let n = count(20, 300, r);
    let (a, b) = (50.0, one_of(&[50.0, 49.999, 30.0, 1.0, 0.01], r));
    let at = |i: usize| {
        let (sin, cos) = (TAU * (i % n) as f64 / n as f64).sin_cos();
        (point(a * cos, b * sin), Vector { x: -a * sin, y: b * cos }.unit())
    };
    if r.unit() < 0.5 {
        return polygon((0..n).map(|i| at(i).0));
    }
    let pair = |i: usize| (at(i), at(i + 1));
    closed((0..n).map(pair).flat_map(|((p, t), (q, u))| biarc(p, t, q, u)).collect())
}

/// Islands that are clusters of reflex vertices within a hair of each other, alone or as the tips of a star.
fn cluster(r: &mut Random) -> Vec<ArcSpline> {
    let size = one_of(&[1e-8, 1e-6, 1e-4, 1e-2, 1.0], r);
    let (n, sides) = (count(3, 12, r), one_of(&[4, 6, 12], r));
    let mut loops = vec![regular(sides, point(0.0, 0.0), 50.0)];
    match r.next() % 2 {
        0 => loops.push(regular(n, point(0.0, 0.0), size).reversed()),
        _ => {
            let tip = |i: usize, off: f64, radius: f64| {
                let out = Vector::from_angle(TAU * i as f64 / n as f64);
                point(0.0, 0.0) + out * radius + out.left() * off
            };
            let star = (0..n).flat_map(|i| {
                let between = Vector::from_angle(TAU * (i as f64 + 0.5) / n as f64) * 10.0;
                [
                    tip(i, -size, 25.0),
                    tip(i, 0.0, 25.0 + size),
                    tip(i, size, 25.0),
                    point(between.x, between.y),
                ]
            });
            loops.push(polygon(star).reversed());
        }
    }
    loops
}

/// A channel of constant width along half circles around two places in turn, each half circle larger than
/// the one before: outward along one wall, back along the other.
fn spiral(r: &mut Random) -> ArcSpline {
    let turns = count(2, 12, r);
    let width = one_of(&[1.0, 2.0, 3.0, 3.999], r);
    // Around (0, 0) and (2, 0) with radii that grow by 2: half circles meet on the x axis, turns lie 4 apart.
    let place = |i: usize, off: f64| {
        let even = 5.0 + off + 2.0 * (i - i % 2) as f64;
        point(if i.is_multiple_of(2) { even } else { -even }, 0.0)
    };
    let ends = [one_of(&[0.0, 1.0], r), one_of(&[0.0, 1.0], r)];
    let out = (0..=turns).map(|i| vertex(place(i, width), if i < turns { 1.0 } else { ends[0] }));
    let back = (0..=turns).rev().map(|i| vertex(place(i, 0.0), if i > 0 { -1.0 } else { ends[1] }));
    closed(out.chain(back).collect())
}

/// What was measured.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    pub sites: usize,
    /// Largest residual of the certificate, relative to the size.
    pub residual: f64,
    /// Whether the loops were refused as no pocket.
    pub refused: bool,
}

/// Levels per pocket, as shares of the largest radius: next to the wall, ties, next to the peak.
const LEVELS: [f64; 4] = [0.03, 0.5, 0.713, 0.99];

/// The trial of one member: the certificate of its axis, and its levels held against the judge.
///
/// # Errors
/// What is wrong.
pub fn run(family: &str, seed: u64, noise: Noise) -> Result<Figures, String> {
    trial(make(family, seed, noise)).map_err(|e| format!("{family}, seed {seed}, {noise:?}: {e}"))
}

fn trial(loops: Vec<ArcSpline>) -> Result<Figures, String> {
    let size = loops[0].bounds().diagonal();
    let Tolerance { fit, join } = Tolerance::MM;
    let scale = (size / 100.0).min(1.0);
    let tolerance = Tolerance { fit: fit * scale, join: join * scale };
    let Ok(pocket) = Pocket::from_loops(loops, tolerance) else {
        return Ok(Figures { refused: true, ..Figures::default() });
    };
    let mat = pocket.medial_axis().map_err(|e| e.to_string())?;
    let residuals = mat.check().map_err(|e| e.to_string())?;
    let largest = mat.largest_disk().radius;
    for d in LEVELS.map(|share| share * largest) {
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.into_iter().chain(level.ridges).collect();
        let report = verify::level(pocket.loops(), d, &all);
        if !report.is_right() {
            let faults = &report.faults[..report.faults.len().min(2)];
            return Err(format!("level {d} of {largest}, within {}: {faults:?}", report.within));
        }
    }
    Ok(Figures {
        sites: mat.counts().sites,
        residual: residuals.empty.max(residuals.touch).max(residuals.monotone),
        refused: false,
    })
}
