//! Two builders that share no combinatorics, held against each other.

#[path = "support/agreement.rs"]
mod agreement;
#[path = "support/shapes.rs"]
mod shapes;

use agreement::{Axis, difference, disagreement};
use medial::{ArcSpline, Error, Mat, Pocket, Point, Tolerance, point};
use rayon::prelude::*;

fn pocket(loops: Vec<ArcSpline>) -> Pocket {
    Pocket::from_loops(loops, Tolerance::MM).expect("a pocket")
}

/// What is wrong with the axis by division, by itself or compared with the other one.
fn fault(loops: Vec<ArcSpline>) -> Option<String> {
    let pocket = match Pocket::from_loops(loops, Tolerance::MM) {
        Ok(pocket) => pocket,
        Err(e) => return Some(e.to_string()),
    };
    let divided = match pocket.medial_axis_by_division() {
        // Free islands are for the other builder alone.
        Err(Error::Islands { .. }) => return None,
        Err(e) => return Some(e.to_string()),
        Ok(mat) => mat,
    };
    if let Err(e) = divided.check() {
        return Some(format!("division: {e}"));
    }
    match pocket.medial_axis() {
        Err(e) => Some(e.to_string()),
        Ok(mat) => disagreement(&mat, &divided),
    }
}

/// A size between 10 and 2000, most of them small, for a seed.
fn size_of(seed: u64) -> usize {
    let share = (seed * 2711 % 1000) as f64 / 1000.0;
    (10.0 * 200f64.powf(share * share)) as usize
}

/// The outer loop of a shape.
fn outline(kind: &str, size: usize, seed: u64) -> Vec<ArcSpline> {
    let mut loops = shapes::make(kind, size, seed);
    loops.truncate(1);
    loops
}

#[test]
fn both_builders_find_the_same_axes() {
    let faults: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map(|kind| (1..=30u64).into_par_iter().map(move |seed| (*kind, seed)))
        .filter_map(|(kind, seed)| {
            let size = size_of(seed);
            fault(outline(kind, size, seed)).map(|e| format!("{kind} of {size} elements, seed {seed}: {e}"))
        })
        .collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

/// Shapes that once divided wrongly, each with what was in the way.
#[test]
fn what_was_divided_wrongly_once_is_divided_well() {
    let cases = [
        ("coast", 789, 28, "an arc is passed over while the disk moves back to where the edge begins"),
        ("coast", 1571, 7, "the same"),
        ("coast", 1526, 1059, "the second arc comes into reach on the way only"),
        ("hexagons", 1315, 1111, "the same"),
        ("coast", 1344, 675, "the end of an element stands for the cone of the reflex vertex there"),
        ("coast", 1042, 907, "the same"),
        ("coast", 1866, 917, "the same"),
        ("smooth", 1947, 1045, "a disk that touches a short end of an arc does not osculate it"),
        ("smooth", 73, 1016, "an osculating disk touches where the next arc, almost as curved, begins"),
        ("fingers", 330, 1060, "the same"),
        ("convex", 1486, 1104, "three sides as good as in line touch a disk over a long way"),
        ("convex", 696, 1191, "three sides define a branch to a billionth only"),
    ];
    for (kind, size, seed, what) in cases {
        assert_eq!(fault(outline(kind, size, seed)), None, "{kind} {size} {seed}: {what}");
    }
}

fn polygon(corners: &[(f64, f64)]) -> ArcSpline {
    shapes::polygon(corners.iter().map(|&(x, y)| point(x, y)))
}

/// A pocket, a comb, a keyhole: shapes with names and with ties.
fn named() -> Vec<(String, Vec<ArcSpline>)> {
    let lens = [(0.0, 0.0, 0.3), (4.0, 0.0, 0.3)];
    let slot = [(0.0, -5.0, 0.0), (30.0, -5.0, 1.0), (30.0, 5.0, 0.0), (0.0, 5.0, 1.0)];
    let keyhole = [(-2.0, 0.0, 0.0), (-2.0, -20.0, 0.0), (2.0, -20.0, 0.0), (2.0, 0.0, 2.5)];
    let quarter = (std::f64::consts::PI / 8.0).tan();
    let rounded = [
        (2.0, 0.0, 0.0),
        (18.0, 0.0, quarter),
        (20.0, 2.0, 0.0),
        (20.0, 8.0, quarter),
        (18.0, 10.0, 0.0),
        (2.0, 10.0, quarter),
        (0.0, 8.0, 0.0),
        (0.0, 2.0, quarter),
    ];
    let square = polygon(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
    let mut all = vec![
        ("circle", vec![ArcSpline::circle(point(3.0, -7.0), 2.5)]),
        ("square", vec![square.clone()]),
        ("rectangle", vec![polygon(&[(0.0, 0.0), (40.0, 0.0), (40.0, 10.0), (0.0, 10.0)])]),
        ("triangle", vec![polygon(&[(0.0, 0.0), (7.0, 1.0), (2.0, 5.0)])]),
        ("L", vec![polygon(&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)])]),
        (
            "cross",
            vec![polygon(&[
                (1.0, 0.0),
                (2.0, 0.0),
                (2.0, 1.0),
                (3.0, 1.0),
                (3.0, 2.0),
                (2.0, 2.0),
                (2.0, 3.0),
                (1.0, 3.0),
                (1.0, 2.0),
                (0.0, 2.0),
                (0.0, 1.0),
                (1.0, 1.0),
            ])],
        ),
        ("lens", vec![ArcSpline::closed(lens)]),
        ("slot", vec![ArcSpline::closed(slot)]),
        ("keyhole", vec![ArcSpline::closed(keyhole)]),
        ("rounded rectangle", vec![ArcSpline::closed(rounded)]),
        ("square with an island at its wall", {
            let island = polygon(&[(5.0, 0.0), (4.0, 3.0), (6.0, 3.0)]);
            vec![square.clone(), island]
        }),
        ("square with a round island at its wall", {
            vec![square, ArcSpline::closed([(5.0, 0.0, -1.0), (5.0, 4.0, -1.0)])]
        }),
    ]
    .into_iter()
    .map(|(name, loops)| (name.to_owned(), loops))
    .collect::<Vec<_>>();
    for n in [5, 6, 7, 12, 100, 1000] {
        all.push((format!("{n}-gon"), vec![shapes::regular(n, point(0.0, 0.0), 50.0)]));
    }
    for size in [40, 400, 2000] {
        all.push((format!("gear of {size}"), shapes::gear(size, false)));
    }
    all
}

/// As drawn, and turned, scaled and moved so that nothing is symmetric to the last bit.
#[test]
fn both_builders_find_the_same_axes_of_shapes_full_of_ties() {
    let (sin, cos) = 0.61f64.sin_cos();
    let turned = |p: Point| point(30.7 + 1.3 * (cos * p.x - sin * p.y), 1.3 * (sin * p.x + cos * p.y) - 4.1);
    let faults: Vec<String> = named()
        .into_par_iter()
        .flat_map_iter(|(name, loops)| {
            let moved: Vec<_> = loops.iter().map(|l| l.mapped(false, turned)).collect();
            [(name.clone(), loops), (format!("{name}, turned"), moved)]
        })
        .filter_map(|(name, loops)| fault(loops).map(|e| format!("{name}: {e}")))
        .collect();
    assert!(faults.is_empty(), "{} failures:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn the_division_refuses_free_islands() {
    let mut loops = vec![polygon(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])];
    loops.push(ArcSpline::circle(point(3.0, 3.0), 1.0).reversed());
    loops.push(ArcSpline::circle(point(7.0, 7.0), 1.0).reversed());
    let refusal = pocket(loops).medial_axis_by_division();
    assert!(matches!(refusal, Err(Error::Islands { count: 2 })), "{refusal:?}");
}

fn coast() -> Mat {
    pocket(shapes::make("coast", 60, 5)).medial_axis().expect("an axis")
}

#[test]
fn an_axis_agrees_with_itself() {
    assert_eq!(disagreement(&coast(), &coast()), None);
}

#[test]
fn a_moved_vertex_is_seen() {
    let (good, size) = (Axis::of(&coast()), Axis::of(&coast()).size());
    for (by, seen) in [(1e-6 * size, true), (2e-9 * size, true), (1e-10 * size, false)] {
        let mut bad = good.clone();
        let branch = bad.vertices.iter().position(|v| v.kind == medial::Kind::Branch).expect("a branch");
        bad.vertices[branch].disk.center.x += by;
        assert_eq!(difference(&good, &bad).is_some(), seen, "{by}");
        let mut bad = good.clone();
        bad.vertices[branch].disk.radius += by;
        assert_eq!(difference(&good, &bad).is_some(), seen, "{by}");
    }
}

#[test]
fn a_dropped_edge_is_seen() {
    let good = Axis::of(&coast());
    for i in 0..good.edges.len() {
        let mut bad = good.clone();
        bad.edges.remove(i);
        assert!(difference(&good, &bad).is_some(), "edge {i}");
        assert!(difference(&bad, &good).is_some(), "edge {i}");
    }
}

#[test]
fn swapped_sites_are_seen() {
    let good = Axis::of(&coast());
    for i in 0..good.edges.len() {
        let mut bad = good.clone();
        bad.edges[i].sites.swap(0, 1);
        assert!(difference(&good, &bad).is_some(), "edge {i}");
    }
}
