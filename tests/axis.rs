//! Axes that are known, and what must not change them.

#[path = "support/shapes.rs"]
mod shapes;

use medial::mat::{Kind, SiteKind};
use medial::{ArcSpline, Mat, Pocket, Point, Tolerance, Vector, point};

fn axis(loops: &[ArcSpline]) -> Mat {
    Pocket::from_loops(loops.to_vec(), Tolerance::MM).expect("a pocket").medial_axis().expect("an axis")
}

fn rectangle(w: f64, h: f64) -> ArcSpline {
    shapes::polygon([point(0.0, 0.0), point(w, 0.0), point(w, h), point(0.0, h)])
}

fn count(mat: &Mat, kind: Kind) -> usize {
    mat.vertices().iter().filter(|v| v.kind == kind).count()
}

#[test]
fn a_rectangle_has_a_roof() {
    let mat = axis(&[rectangle(40.0, 10.0)]);
    assert_eq!((count(&mat, Kind::Leaf), count(&mat, Kind::Branch), mat.counts().edges), (4, 2, 5));
    let branches: Vec<Point> =
        mat.vertices().iter().filter(|v| v.kind == Kind::Branch).map(|v| v.disk.center).collect();
    for p in [point(5.0, 5.0), point(35.0, 5.0)] {
        assert!(branches.iter().any(|b| b.distance(p) < 1e-14));
    }
}

#[test]
fn a_disk_has_one_center() {
    let mat = axis(&[ArcSpline::circle(point(3.0, -7.0), 2.5)]);
    assert_eq!((mat.counts().vertices, mat.counts().edges), (1, 0));
    assert_eq!(mat.vertices()[0].kind, Kind::Peak);
    assert!(mat.largest_disk().center.distance(point(3.0, -7.0)) < 1e-14);
}

#[test]
fn a_square_has_one_branch_of_four() {
    let mat = axis(&[rectangle(8.0, 8.0)]);
    assert_eq!((mat.counts().vertices, mat.counts().edges, count(&mat, Kind::Branch)), (5, 4, 1));
}

#[test]
fn a_hundred_ties_are_one_vertex() {
    let mat = axis(&[shapes::regular(100, point(0.0, 0.0), 50.0)]);
    assert_eq!((mat.counts().vertices, mat.counts().edges), (101, 100));
}

#[test]
fn the_bisector_of_a_line_and_a_vertex_is_a_parabola() {
    // An L: between its reflex corner (1, 1) and the walls x = 0, y = 0.
    let l = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
    let mat = axis(&[shapes::polygon(l.map(|(x, y)| point(x, y)))]);
    let edges = mat.edges();
    let parabolas: Vec<_> = edges
        .iter()
        .filter(|e| {
            e.sites.iter().any(|s| s.kind == SiteKind::Vertex)
                && e.sites.iter().any(|s| s.kind == SiteKind::Segment)
        })
        .collect();
    assert_eq!(parabolas.len(), 2);
    for edge in parabolas {
        // A rational Bezier curve with weight 1 is a parabola.
        assert!((edge.weight - 1.0).abs() < 1e-12, "{edge:?}");
        for t in [0.1, 0.5, 0.8] {
            let p = at(edge, t);
            let wall = p.x.min(p.y);
            assert!((p.distance(point(1.0, 1.0)) - wall).abs() < 1e-14);
        }
    }
}

/// A point of an edge.
fn at(edge: &medial::mat::AxisEdge, t: f64) -> Point {
    let s = 1.0 - t;
    let weights = [s * s, 2.0 * s * t * edge.weight, t * t];
    let sum: f64 = weights.iter().sum();
    let v =
        (0..3).fold(Vector { x: 0.0, y: 0.0 }, |v, i| v + edge.points[i].to_vector() * (weights[i] / sum));
    point(v.x, v.y)
}

#[test]
fn every_point_of_every_edge_is_equidistant_from_its_sites() {
    for kind in shapes::KINDS {
        let loops = shapes::make(kind, 120, 11);
        let mat = axis(&loops);
        let judge = medial::verify::Boundary::new(&loops);
        for edge in mat.edges() {
            for t in [0.0, 0.3, 0.6, 1.0] {
                let p = at(&edge, t);
                let nearest = judge.distance(p);
                for site in edge.sites {
                    let spline = &loops[site.loop_index as usize];
                    let d = match site.kind {
                        SiteKind::Vertex => spline.vertices[site.element as usize].point.distance(p),
                        _ => spline.element(site.element as usize).distance(p),
                    };
                    assert!(
                        (d - nearest).abs() < 1e-11 * judge.bounds().diagonal(),
                        "{kind}: {edge:?} at {t}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_largest_disk_and_the_neck_of_an_hourglass() {
    // Two squares of 10 joined by a channel of width 4.
    let h = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 3.0),
        (20.0, 3.0),
        (20.0, 0.0),
        (30.0, 0.0),
        (30.0, 10.0),
        (20.0, 10.0),
        (20.0, 7.0),
        (10.0, 7.0),
        (10.0, 10.0),
        (0.0, 10.0),
    ];
    let mat = axis(&[shapes::polygon(h.map(|(x, y)| point(x, y)))]);
    assert!((mat.narrowest_neck().expect("a neck").radius - 2.0).abs() < 1e-14);
    let largest = mat.largest_disk().radius;
    assert!(largest > 5.0 - 1e-12 && largest < 5.3, "{largest}");
}

/// The transform as bits.
fn bits(mat: &Mat) -> Vec<u64> {
    let vertices = mat.vertices().into_iter().flat_map(|v| [v.disk.center.x, v.disk.center.y, v.disk.radius]);
    let edges = mat.edges().into_iter().flat_map(|e| {
        let points = e.points.into_iter().flat_map(|p| [p.x, p.y]);
        points.chain([e.weight, f64::from(e.from), f64::from(e.to)]).collect::<Vec<_>>()
    });
    vertices.chain(edges).map(f64::to_bits).collect()
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    for kind in ["gear", "symmetric", "hexagons"] {
        let loops = shapes::make(kind, 3000, 2);
        let pocket = Pocket::from_loops(loops, Tolerance::MM).expect("a pocket");
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            bits(&pool.install(|| pocket.medial_axis()).expect("an axis"))
        };
        let one = with(1);
        assert!(one == with(2) && one == with(5), "{kind}");
    }
}

/// Length of the axis, what a similarity only scales.
fn length(mat: &Mat) -> f64 {
    const STEPS: usize = 64;
    let along = |e: &medial::mat::AxisEdge| -> f64 {
        let step = |i: usize| at(e, i as f64 / STEPS as f64).distance(at(e, (i + 1) as f64 / STEPS as f64));
        (0..STEPS).map(step).sum()
    };
    mat.edges().iter().map(along).sum()
}

#[test]
fn reversing_rotating_mirroring_turning_scaling_and_moving_change_nothing_else() {
    let turned = |p: Point| {
        let v = p.to_vector().rotated(37f64.to_radians().cos(), 37f64.to_radians().sin());
        point(v.x, v.y)
    };
    for kind in shapes::KINDS {
        let loops = shapes::make(kind, 150, 7);
        let whole = axis(&loops);
        let same = |loops: Vec<ArcSpline>, scale: f64, how: &str| {
            let mat = axis(&loops);
            assert_eq!(count(&mat, Kind::Leaf), count(&whole, Kind::Leaf), "{kind} {how}");
            let (a, b) = (length(&mat), length(&whole) * scale);
            assert!((a - b).abs() < 1e-6 * b, "{kind} {how}: {a} {b}");
            let (r, s) = (mat.largest_disk().radius, whole.largest_disk().radius * scale);
            assert!((r - s).abs() < 1e-9 * s, "{kind} {how}: {r} {s}");
        };
        let each = |f: &dyn Fn(&ArcSpline) -> ArcSpline| loops.iter().map(f).collect::<Vec<_>>();
        same(each(&ArcSpline::reversed), 1.0, "reversed");
        same(each(&|l| rotated_start(l, 17)), 1.0, "another start");
        same(each(&|l| l.mapped(true, |p| point(-p.x, p.y))), 1.0, "mirrored");
        same(each(&|l| l.mapped(false, turned)), 1.0, "turned");
        same(each(&|l| l.mapped(false, |p| point(1e-3 * p.x, 1e-3 * p.y))), 1e-3, "small");
        same(each(&|l| l.mapped(false, |p| point(1e3 * p.x, 1e3 * p.y))), 1e3, "large");
        same(each(&|l| l.mapped(false, |p| point(p.x + 300.0, p.y - 500.0))), 1.0, "moved");
    }
}

/// The same closed loop, beginning at another vertex.
fn rotated_start(spline: &ArcSpline, by: usize) -> ArcSpline {
    let mut vertices = spline.vertices.clone();
    let n = vertices.len();
    vertices.rotate_left(by % n);
    ArcSpline { vertices, closed: true }
}

/// The bisector of two equal circles is straight; round-off must not bend it into a Bezier curve whose
/// control point lies anywhere on the line.
#[test]
fn edges_that_are_straight_but_for_round_off_have_their_control_point_between_the_ends() {
    let r = 1.1;
    for i in 0..40 {
        let x = 70.2462463716 + 0.0137 * f64::from(i);
        let island = |x: f64| ArcSpline::circle(point(x, 103.7364883679), r).reversed();
        let outer = shapes::polygon(
            [(50.0, 80.0), (120.0, 80.0), (120.0, 130.0), (50.0, 130.0)].map(|(x, y)| point(x, y)),
        );
        let mat = axis(&[outer, island(x), island(x + 22.6)]);
        for e in mat.edges() {
            let chord = e.points[2] - e.points[0];
            let t = (e.points[1] - e.points[0]).dot(chord) / chord.length_squared();
            assert!(t > 0.0 && t < 1.0 && e.weight > 0.1, "{i}: {e:?}");
        }
    }
}
