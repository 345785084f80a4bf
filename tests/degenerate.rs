//! Shapes in which everything is a tie, as drawn and turned, scaled, moved.

#[path = "support/shapes.rs"]
mod shapes;

use medial::{ArcSpline, Point, Vector, Vertex, point, verify};
use rayon::prelude::*;
use shapes::{gear, polygon, regular};
use std::f64::consts::PI;

/// A pocket with the number of vertices its axis must have, where that is known.
struct Case {
    name: String,
    loops: Vec<ArcSpline>,
}

fn case(name: impl Into<String>, loops: Vec<ArcSpline>) -> Case {
    Case { name: name.into(), loops }
}

fn circle(x: f64, y: f64, radius: f64) -> ArcSpline {
    ArcSpline::circle(point(x, y), radius)
}

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> ArcSpline {
    polygon([point(x0, y0), point(x1, y0), point(x1, y1), point(x0, y1)])
}

fn slot(length: f64, radius: f64) -> ArcSpline {
    ArcSpline::closed([
        (0.0, -radius, 0.0),
        (length, -radius, 1.0),
        (length, radius, 0.0),
        (0.0, radius, 1.0),
    ])
}

/// A circle whose vertices lie at some angles, in degrees, counter-clockwise.
fn circle_at(center: Point, radius: f64, degrees: &[f64]) -> ArcSpline {
    let vertices = (0..degrees.len()).map(|i| {
        let (a, b) = (degrees[i], degrees[(i + 1) % degrees.len()]);
        let sweep = (b - a).rem_euclid(360.0).to_radians();
        let at = center + Vector::from_angle(a.to_radians()) * radius;
        Vertex { point: at, bulge: (0.25 * sweep).tan() }
    });
    ArcSpline { vertices: vertices.collect(), closed: true }
}

fn cases() -> Vec<Case> {
    let mut cases = vec![
        case("full circle", vec![circle(0.0, 0.0, 10.0)]),
        case(
            "circle of seven arcs",
            vec![circle_at(point(0.0, 0.0), 10.0, &[0.0, 10.0, 11.0, 90.0, 200.0, 200.5, 340.0])],
        ),
        case("concentric annulus", vec![circle(0.0, 0.0, 10.0), circle(0.0, 0.0, 4.0).reversed()]),
        case("eccentric annulus", vec![circle(0.0, 0.0, 10.0), circle(3.1, 1.3, 4.0).reversed()]),
        case("slot", vec![slot(30.0, 5.0)]),
        case("square", vec![rectangle(0.0, 0.0, 10.0, 10.0)]),
        case("rectangle", vec![rectangle(0.0, 0.0, 40.0, 10.0)]),
        case("frame", vec![rectangle(0.0, 0.0, 40.0, 30.0), rectangle(10.0, 10.0, 30.0, 20.0).reversed()]),
        case(
            "square in a square",
            vec![rectangle(-10.0, -10.0, 10.0, 10.0), rectangle(-4.0, -4.0, 4.0, 4.0).reversed()],
        ),
        case(
            "diamond in a square",
            vec![rectangle(-10.0, -10.0, 10.0, 10.0), regular(4, point(0.0, 0.0), 4.0).reversed()],
        ),
        case("cross", vec![cross()]),
        case(
            "collinear edges",
            vec![polygon(
                (0..5)
                    .map(|i| point(10.0 * f64::from(i), 0.0))
                    .chain((0..5).rev().map(|i| point(10.0 * f64::from(i), 20.0))),
            )],
        ),
        case("arcs on one circle, apart", vec![arcs_on_one_circle()]),
        case("keyhole", vec![keyhole()]),
        case(
            "islands touching each other",
            vec![
                rectangle(-30.0, -20.0, 30.0, 20.0),
                circle_at(point(-5.0, 0.0), 5.0, &[0.0, 180.0]).reversed(),
                circle_at(point(5.0, 0.0), 5.0, &[0.0, 180.0]).reversed(),
            ],
        ),
        case(
            "three islands touching each other",
            vec![
                rectangle(-40.0, -40.0, 40.0, 40.0),
                square_island(-10.0, -10.0),
                square_island(0.0, 0.0),
                square_island(10.0, -10.0),
            ],
        ),
        case(
            "island touching the wall",
            vec![
                polygon(
                    [(-20.0, -20.0), (20.0, -20.0), (20.0, 0.0), (20.0, 20.0), (-20.0, 20.0)]
                        .map(|(x, y)| point(x, y)),
                ),
                circle(16.0, 0.0, 4.0).reversed(),
            ],
        ),
        case(
            "island corner touching the wall",
            vec![
                polygon(
                    [(-20.0, -20.0), (20.0, -20.0), (20.0, 0.0), (20.0, 20.0), (-20.0, 20.0)]
                        .map(|(x, y)| point(x, y)),
                ),
                regular(4, point(16.0, 0.0), 4.0).reversed(),
            ],
        ),
    ];
    // The interior may fall apart where islands touch in more than one point.
    cases.extend([
        case(
            "island touching both walls",
            vec![rectangle(0.0, 0.0, 40.0, 10.0), circle(20.0, 5.0, 5.0).reversed()],
        ),
        case(
            "square island touching three walls",
            vec![rectangle(0.0, 0.0, 40.0, 10.0), regular(4, point(35.0, 5.0), 5.0).reversed()],
        ),
        case(
            "three round islands touching each other",
            vec![
                rectangle(-40.0, -40.0, 40.0, 40.0),
                circle(-8.0, 0.0, 8.0).reversed(),
                circle(8.0, 0.0, 8.0).reversed(),
                circle(0.0, 8.0 * 3f64.sqrt(), 8.0).reversed(),
            ],
        ),
        case(
            "ring of four round islands",
            vec![
                rectangle(-40.0, -40.0, 40.0, 40.0),
                circle(-8.0, -8.0, 8.0).reversed(),
                circle(8.0, -8.0, 8.0).reversed(),
                circle(8.0, 8.0, 8.0).reversed(),
                circle(-8.0, 8.0, 8.0).reversed(),
            ],
        ),
        case(
            "ring of four round islands round a fifth",
            vec![
                rectangle(-40.0, -40.0, 40.0, 40.0),
                circle(-8.0, -8.0, 8.0).reversed(),
                circle(8.0, -8.0, 8.0).reversed(),
                circle(8.0, 8.0, 8.0).reversed(),
                circle(-8.0, 8.0, 8.0).reversed(),
                circle(0.0, 0.0, 2.0).reversed(),
            ],
        ),
    ]);
    for sides in [3, 4, 5, 6, 8, 17, 100, 1000] {
        cases.push(case(format!("regular {sides}-gon"), vec![regular(sides, point(0.0, 0.0), 50.0)]));
        if sides <= 100 {
            let outer = regular(sides, point(0.0, 0.0), 50.0);
            let ring = vec![outer, regular(sides, point(0.0, 0.0), 20.0).reversed()];
            cases.push(case(format!("ring of {sides}-gons"), ring));
        }
    }
    for teeth in [4, 12, 60, 250] {
        for hole in [false, true] {
            cases.push(case(format!("gear of {teeth} teeth, hole {hole}"), gear(4 * teeth, hole)));
        }
    }
    for m in [2, 3, 6] {
        cases.push(case(format!("{m} x {m} bosses"), grid(m, |x, y| circle(x, y, 5.0).reversed())));
        cases.push(case(
            format!("{m} x {m} squares"),
            grid(m, |x, y| rectangle(x - 5.0, y - 5.0, x + 5.0, y + 5.0).reversed()),
        ));
    }
    cases
}

fn cross() -> ArcSpline {
    let (a, b) = (10.0, 30.0);
    polygon(
        [
            (-a, -b),
            (a, -b),
            (a, -a),
            (b, -a),
            (b, a),
            (a, a),
            (a, b),
            (-a, b),
            (-a, a),
            (-b, a),
            (-b, -a),
            (-a, -a),
        ]
        .map(|(x, y)| point(x, y)),
    )
}

fn square_island(x: f64, y: f64) -> ArcSpline {
    let corner = |dx: f64, dy: f64| point(x + dx, y + dy);
    polygon([corner(0.0, -5.0), corner(-5.0, 0.0), corner(0.0, 5.0), corner(5.0, 0.0)]);
    polygon([corner(0.0, 0.0), corner(0.0, 10.0), corner(10.0, 10.0), corner(10.0, 0.0)])
}

/// Two lobes cut from one circle, joined by a straight channel.
fn arcs_on_one_circle() -> ArcSpline {
    let (r, y): (f64, f64) = (20.0, 5.0);
    let angle = (y / r).asin();
    let x = r * angle.cos();
    let bulge = (0.25 * 2.0 * angle).tan();
    ArcSpline::closed([(-x, y, bulge), (-x, -y, 0.0), (x, -y, bulge), (x, y, 0.0)])
}

fn keyhole() -> ArcSpline {
    let (r, w): (f64, f64) = (12.0, 4.0);
    let x = (r * r - w * w).sqrt();
    let bulge = (0.25 * (2.0 * PI - 2.0 * (w / r).asin())).tan();
    ArcSpline::closed([(x, w, bulge), (x, -w, 0.0), (40.0, -w, 1.0), (40.0, w, 0.0)])
}

fn grid(m: usize, island: impl Fn(f64, f64) -> ArcSpline) -> Vec<ArcSpline> {
    let side = 20.0 * m as f64 + 10.0;
    let place = |i: usize| 20.0 * i as f64 + 15.0;
    let islands = (0..m * m).map(|i| island(place(i / m), place(i % m)));
    std::iter::once(rectangle(0.0, 0.0, side, side)).chain(islands).collect()
}

type Similarity = fn(Point) -> Point;

/// As drawn; turned by 37 degrees; small; large; far from the origin; all of it.
const SIMILARITIES: [(&str, Similarity); 6] = [
    ("as drawn", |p| p),
    ("turned", turned),
    ("small", |p| point(p.x * 1e-3, p.y * 1e-3)),
    ("large", |p| point(p.x * 1e3, p.y * 1e3)),
    ("far away", |p| point(p.x + 1e6, p.y - 1e6)),
    ("turned and far away", |p| turned(p) + Vector { x: -1e6, y: 1e6 }),
];

fn turned(p: Point) -> Point {
    let (sin, cos) = 37f64.to_radians().sin_cos();
    point(p.x * cos - p.y * sin, p.x * sin + p.y * cos)
}

#[test]
fn every_axis_and_level_of_degenerate_shapes_is_right() {
    let cases: Vec<(Case, &str, Similarity)> = cases()
        .into_iter()
        .flat_map(|case| {
            SIMILARITIES
                .map(|(how, map)| (Case { name: case.name.clone(), loops: case.loops.clone() }, how, map))
        })
        .collect();
    let failures: Vec<String> = cases
        .par_iter()
        .flat_map_iter(|(Case { name, loops }, how, map)| {
            let loops: Vec<ArcSpline> = loops.iter().map(|l| l.mapped(false, map)).collect();
            faults(&loops).into_iter().map(move |f| format!("{name}, {how}: {f}"))
        })
        .collect();
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

fn faults(loops: &[ArcSpline]) -> Vec<String> {
    let pocket = medial::Pocket::from_loops(loops.to_vec(), medial::Tolerance::MM).unwrap();
    let mat = match pocket.medial_axis() {
        Ok(mat) => mat,
        Err(e) => return vec![e.to_string()],
    };
    let mut faults = Vec::new();
    if let Err(e) = mat.check() {
        faults.push(e.to_string());
    }
    let largest = mat.largest_disk().radius;
    // Round numbers meet ties exactly: half the largest disk, the disk itself, a neck.
    let many = loops.iter().map(ArcSpline::len).sum::<usize>() > 500;
    let fractions: &[f64] = if many { &[0.5, 1.0] } else { &[0.01, 0.25, 0.5, 0.8, 0.99, 1.0] };
    let mut distances: Vec<f64> = fractions.iter().map(|f| f * largest).collect();
    distances.extend(mat.narrowest_neck().map(|neck| neck.radius));
    for d in distances {
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
        let report = verify::level(loops, d, &all);
        if !report.is_right() {
            faults.push(format!(
                "level {d} of {largest}, {} loops, {} ridges: {report:?}",
                level.loops.len(),
                level.ridges.len()
            ));
        }
        if level.is_empty() {
            faults.push(format!("level {d} of {largest} is empty"));
        }
    }
    faults
}
