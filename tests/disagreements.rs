//! Where level sets and offsets by cavalier_contours differ, with its own tolerances and from level to
//! level: every case that is known, decided by exact distance, and kept.

#[path = "../benches/peers/shapes.rs"]
mod machined;

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use medial::verify::Boundary;
use medial::{ArcSpline, DisagreementKind, Mat, Party, Pocket, Tolerance, point};

fn shape(loops: &[ArcSpline]) -> Shape<f64> {
    Shape::from_plines(loops.iter().map(|l| {
        let mut polyline = Polyline::new_closed();
        l.vertices.iter().for_each(|v| polyline.add(v.point.x, v.point.y, v.bulge));
        polyline
    }))
}

fn splines(shape: &Shape<f64>) -> Vec<ArcSpline> {
    let polylines = shape.ccw_plines.iter().chain(&shape.cw_plines);
    polylines.map(|p| ArcSpline::closed(p.polyline.iter_vertexes().map(|v| (v.x, v.y, v.bulge)))).collect()
}

fn axis(loops: &[ArcSpline]) -> Mat {
    Pocket::from_loops(loops.to_vec(), Tolerance { fit: 0.0, join: 0.0 }).unwrap().medial_axis().unwrap()
}

/// What theirs has too much and too little, summed over levels; ours has neither, or this fails.
#[derive(Debug, Default, PartialEq)]
struct Theirs {
    levels: usize,
    phantoms: usize,
    missing: usize,
    worst: f64,
}

impl Theirs {
    fn take(&mut self, boundary: &Boundary, mat: &Mat, d: f64, theirs: &[ArcSpline], within: f64) {
        let level = mat.level(d);
        let ours: Vec<ArcSpline> = level.loops.into_iter().chain(level.ridges).collect();
        let report = boundary.judge(d, &ours, 0.0);
        assert!(report.is_right(), "{d}: {report:?}");
        let comparison = boundary.compare(d, &ours, theirs, within);
        let wrong = &comparison.disagreements;
        assert!(wrong.iter().all(|d| d.wrong == Party::Theirs), "{d}: {comparison:?}");
        // The judge of single offsets agrees with the judge of two.
        let refused = !boundary.judge(d, &boundary.turned(theirs), within).is_right();
        assert!(refused || wrong.is_empty(), "{d}: {comparison:?}");
        self.levels += usize::from(!wrong.is_empty());
        self.phantoms += wrong.iter().filter(|d| d.kind == DisagreementKind::Phantom).count();
        self.missing += wrong.iter().filter(|d| d.kind == DisagreementKind::Missing).count();
        self.worst = wrong.iter().map(|d| d.error).fold(self.worst, f64::max);
    }
}

/// From level to level at every half millimeter, where gaps are 10 wide: beyond 5, where whole sides of
/// offsets have met, curves are left that no longer belong there.
#[test]
fn steps_on_a_regular_plate_leave_phantoms_of_cavalier_contours() {
    let loops = machined::make("grid", 108);
    let (boundary, mat) = (Boundary::new(&loops), axis(&loops));
    let mut theirs = Theirs::default();
    let mut offset = shape(&loops);
    for k in 1..=18 {
        offset = offset.parallel_offset(0.5, &ShapeOffsetOptions::new());
        theirs.take(&boundary, &mat, 0.5 * f64::from(k), &splines(&offset), 1e-3);
    }
    assert!(theirs.phantoms > 0 && theirs.worst > 0.1, "{theirs:?}");
}

/// The same plate offset at once is right, as long as nothing coincides.
#[test]
fn a_regular_plate_offset_at_once_is_the_same_for_both() {
    let loops = machined::make("grid", 108);
    let (boundary, mat) = (Boundary::new(&loops), axis(&loops));
    let mut theirs = Theirs::default();
    for d in [0.5, 1.0, 2.5, 4.5, 5.5, 6.0, 8.5] {
        let offset = shape(&loops).parallel_offset(d, &ShapeOffsetOptions::new());
        theirs.take(&boundary, &mat, d, &splines(&offset), 1e-3);
    }
    assert_eq!(theirs, Theirs::default());
}

/// A plate in meters: the tolerances of cavalier_contours are lengths, a tenth of a millimeter now.
#[test]
fn a_plate_in_meters_is_too_small_for_cavalier_contours() {
    let (mut in_meters, mut in_millimeters) = (Theirs::default(), Theirs::default());
    for (scale, theirs) in [(1e-3, &mut in_meters), (1.0, &mut in_millimeters)] {
        let place = |p: medial::Point| point(scale * p.x, scale * p.y);
        let loops: Vec<_> = machined::make("plate", 960).iter().map(|l| l.mapped(false, place)).collect();
        let (boundary, mat) = (Boundary::new(&loops), axis(&loops));
        for d in [0.28, 0.84, 1.4, 2.8, 4.2, 5.6].map(|d| scale * d) {
            let offset = shape(&loops).parallel_offset(d, &ShapeOffsetOptions::new());
            theirs.take(&boundary, &mat, d, &splines(&offset), 1e-3 * scale);
        }
    }
    assert!(in_meters.levels > 0 && in_meters.worst > 1e-6, "{in_meters:?}");
    assert_eq!(in_millimeters, Theirs::default());
}
