//! Pockets that are a tie, or a cusp, or a circle, but for the last digits: smallest forms of what the
//! fuzzer and the long runs have found.

use medial::{ArcSpline, Pocket, Tolerance, verify};

type Loop<'a> = &'a [(f64, f64, f64)];

/// Levels per pocket, as shares of the largest radius.
const LEVELS: [f64; 5] = [0.03, 0.25, 0.5, 0.75, 0.97];

/// The axis passes its certificate and its levels are right; `None` if no axis is right for the loops.
fn fault(loops: &[Loop<'_>]) -> Option<String> {
    let loops = loops.iter().map(|l| ArcSpline::closed(l.iter().copied())).collect();
    let pocket = match Pocket::from_loops(loops, Tolerance::MM) {
        Ok(pocket) => pocket,
        Err(e) => return Some(e.to_string()),
    };
    let mat = match pocket.medial_axis() {
        Ok(mat) => mat,
        Err(e) => return Some(e.to_string()),
    };
    if let Err(e) = mat.check() {
        return Some(e.to_string());
    }
    LEVELS.iter().find_map(|share| {
        let d = share * mat.largest_disk().radius;
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.into_iter().chain(level.ridges).collect();
        let report = verify::level(pocket.loops(), d, &all);
        (!report.is_right()).then(|| format!("level {d}: {report:?}"))
    })
}

fn assert_right(cases: &[(&str, &[Loop<'_>])]) {
    let faults: Vec<String> =
        cases.iter().filter_map(|(name, loops)| Some(format!("{name}: {}", fault(loops)?))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A wall that turns back on itself and overlaps by some ten roundings is a corner of no angle. Taken for a
/// reflex one, its disks touched nothing.
#[test]
fn a_cusp_that_overlaps_by_round_off_is_a_corner() {
    assert_right(&[
        (
            "half circle and segment",
            &[&[(952.201365, 51.0, -1.0), (952.2014, 102.9407, 0.0), (592.0, 102.9407, 1.0)]],
        ),
        (
            "two arcs far away",
            &[&[
                (950682.009808, 950682.009797, -0.4),
                (950682.009792, 950682.009781, 1.0),
                (950682.009781, 950682.01, 0.0),
            ]],
        ),
    ]);
}
