//! Judges offsets of any origin, such as those of another library.
//!
//!     cargo run --example judge

use medial::{ArcSpline, verify};

fn main() {
    // An L with one reflex corner.
    let wall = ArcSpline::closed([
        (0.0, 0.0, 0.0),
        (30.0, 0.0, 0.0),
        (30.0, 10.0, 0.0),
        (10.0, 10.0, 0.0),
        (10.0, 30.0, 0.0),
        (0.0, 30.0, 0.0),
    ]);
    // Two programs offset it by 2: one rounds the reflex corner, one leaves it sharp.
    let offset = |corner: &[(f64, f64, f64)]| {
        let mut vertices = vec![(2.0, 2.0, 0.0), (28.0, 2.0, 0.0), (28.0, 8.0, 0.0)];
        vertices.extend(corner);
        vertices.extend([(8.0, 28.0, 0.0), (2.0, 28.0, 0.0)]);
        ArcSpline::closed(vertices)
    };
    let quarter = -std::f64::consts::FRAC_PI_8.tan();
    let rounded = offset(&[(10.0, 8.0, quarter), (8.0, 10.0, 0.0)]);
    let sharp = offset(&[(8.0, 8.0, 0.0)]);
    for (name, offsets) in [("rounded", vec![rounded]), ("sharp", vec![sharp]), ("none at all", vec![])] {
        let report = verify::level([&wall], 2.0, &offsets);
        println!("{name}: largest deviation {:.3e}, {} faults", report.max_deviation, report.fault_count);
        for fault in &report.faults {
            println!("    at ({:.3}, {:.3}): {}, by {:.4}", fault.at.x, fault.at.y, fault.kind, fault.by);
        }
    }
}
