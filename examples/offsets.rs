//! Loops in, level sets out: how a CAM program asks for all offsets of a pocket at once.
//!
//!     cargo run --example offsets

use medial::{ArcSpline, Error, Pocket, Tolerance, point};

fn main() -> Result<(), Error> {
    // Vertices are (x, y, bulge); the bulge is that of the element to the next vertex, 1 for a half
    // circle to the left. Order and orientation of the loops do not matter.
    let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (80.0, 0.0, 1.0), (80.0, 40.0, 0.0), (0.0, 40.0, 0.0)]);
    let boss = ArcSpline::circle(point(30.0, 18.0), 9.0);
    let pocket = Pocket::from_loops(vec![slot, boss], Tolerance::MM)?;

    // The axis is computed once; levels at any distance are read off it.
    let mat = pocket.medial_axis()?;
    println!("largest tool: {:.3} mm", 2.0 * mat.largest_disk().radius);
    if let Some(neck) = mat.narrowest_neck() {
        println!(
            "narrowest neck: {:.3} mm at ({:.3}, {:.3})",
            2.0 * neck.radius,
            neck.center.x,
            neck.center.y
        );
    }
    let mut distance = 3.0;
    loop {
        let level = mat.level(distance);
        if level.is_empty() {
            break;
        }
        for spline in level.loops.iter().chain(&level.ridges) {
            let kind = if spline.closed { "loop" } else { "ridge" };
            println!("at {distance} mm: {kind} of {} elements, {:.3} mm", spline.len(), spline.length());
            for v in &spline.vertices {
                println!("    {:.4} {:.4} {:.6}", v.point.x, v.point.y, v.bulge);
            }
        }
        distance += 3.0;
    }
    Ok(())
}
