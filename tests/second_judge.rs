//! Level sets beside the offsets of the same pockets by cavalier_contours.

#[path = "support/shapes.rs"]
mod shapes;

use medial::verify::SecondJudge;
use medial::{ArcSpline, Comparison, Error, Kind, Mat, Party, Pocket, Tolerance};
use rayon::prelude::*;

/// Deviation of both together, relative to the size: near acute corners the places where offsets
/// meet are known to fewer digits than the distance. The worst of these shapes has `1e-10`.
const CLOSE: f64 = 1e-9;

fn prepared(kind: &str, size: usize, seed: u64) -> (Mat, SecondJudge, f64) {
    let pocket = Pocket::from_loops(shapes::make(kind, size, seed), Tolerance::MM).expect("a pocket");
    let judge = SecondJudge::new(pocket.loops()).expect("few elements");
    (pocket.medial_axis().expect("an axis"), judge, pocket.bounds().diagonal())
}

fn compare(mat: &Mat, judge: &SecondJudge, d: f64) -> Result<Comparison, Error> {
    let level = mat.level(d);
    let ours: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
    judge.level(d, &ours)
}

#[test]
fn every_level_of_random_shapes_is_that_of_cavalier_contours() {
    let differences: Vec<String> = shapes::KINDS
        .par_iter()
        .flat_map(|kind| (1..=4u64).into_par_iter().map(move |seed| (*kind, seed)))
        .flat_map_iter(|(kind, seed)| {
            let (mat, judge, size) = prepared(kind, 60 + 60 * seed as usize, seed);
            let largest = mat.largest_disk().radius;
            let fractions = [0.01, 0.1, 0.3, 0.5, 0.77, 0.95];
            let compared = fractions.map(|f| compare(&mat, &judge, f * largest));
            let different = compared.into_iter().filter_map(move |answer| match answer {
                Ok(c) if c.agrees() && c.max_deviation <= CLOSE * size => None,
                other => Some(format!("{kind}, seed {seed}: {other:?}")),
            });
            different.collect::<Vec<_>>()
        })
        .collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

/// At the radii of branches and necks cavalier_contours loses or invents loops, and in debug builds
/// its assertions fail; neither is blamed on the levels, and no panic comes through.
#[test]
fn where_the_two_differ_it_is_not_the_level_that_is_wrong() {
    let (mut compared, mut differ) = (0, 0);
    for kind in ["smooth", "isles", "hexagons", "gear", "convex", "symmetric"] {
        let (mat, judge, _) = prepared(kind, 100, 100);
        let critical = mat.vertices().into_iter().filter(|v| matches!(v.kind, Kind::Neck | Kind::Branch));
        let radii = critical.map(|v| v.disk.radius).take(12);
        for d in radii.flat_map(|r| [r * (1.0 - 1e-9), r, r * (1.0 + 1e-9)]) {
            match compare(&mat, &judge, d) {
                Ok(comparison) => {
                    compared += 1;
                    differ += usize::from(!comparison.agrees());
                    let ours = comparison.disagreements.iter().find(|d| d.wrong == Party::Ours);
                    assert!(ours.is_none(), "{kind} at {d}: {ours:?}");
                }
                Err(Error::OtherLibrary { .. }) => {}
                Err(error) => panic!("{kind} at {d}: {error}"),
            }
        }
    }
    assert!(compared > 50 && differ > 0, "{compared} compared, {differ} differ");
}
