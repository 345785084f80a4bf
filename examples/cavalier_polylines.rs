//! Polylines of cavalier_contours in, level sets out as its polylines, and a comparison of the two.
//!
//!     cargo run --example cavalier_polylines --features cavalier-contours

use cavalier_contours::pline_closed;
use cavalier_contours::polyline::{PlineSource, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use medial::convert::cavalier_contours::{loops, pockets};
use medial::{Error, Pockets, Tolerance, verify};

fn main() -> Result<(), Error> {
    // A slot with a round island. Vertices are (x, y, bulge) in both libraries.
    let slot = pline_closed![(0.0, 0.0, 0.0), (80.0, 0.0, 1.0), (80.0, 40.0, 0.0), (0.0, 40.0, 1.0)];
    let island = pline_closed![(25.0, 20.0, -1.0), (41.0, 20.0, -1.0)];
    let shape = Shape::from_plines([slot, island]);
    let Pockets { pockets, defects } = pockets(&shape, Tolerance::MM)?;
    assert!(defects.is_empty());

    for pocket in &pockets {
        // The axis is computed once, levels at any distance are read off it.
        let mat = pocket.medial_axis()?;
        for distance in [4.0, 8.0, 12.0] {
            let level = mat.level(distance);
            let ours: Vec<Polyline<f64>> = level.loops.iter().map(Polyline::from).collect();
            let theirs = Shape::from(pocket).parallel_offset(distance, &ShapeOffsetOptions::new());
            println!("at {distance} mm:");
            for polyline in &ours {
                let (n, area) = (polyline.vertex_count(), polyline.area());
                println!("    {n} vertices, area {area:.6} mm2, length {:.6} mm", polyline.path_length());
            }
            // The judge takes offsets of any origin.
            for (name, offsets) in [("medial", level.loops), ("cavalier_contours", loops(&theirs))] {
                let report = verify::level(pocket.loops(), distance, &offsets);
                println!(
                    "    {name}: {} loops, largest deviation {:.1e} mm, {} faults",
                    offsets.len(),
                    report.max_deviation,
                    report.fault_count
                );
            }
        }
    }
    Ok(())
}
