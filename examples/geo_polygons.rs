//! Polygons in, polygons out: level sets for a program that works with geo_types.
//!
//!     cargo run --example geo_polygons --features geo-types

use geo_types::{Polygon, polygon};
use medial::convert::geo_types::{multi_polygon, pocket};
use medial::{Error, Tolerance};

fn main() -> Result<(), Error> {
    // A part with a hole, from wherever: GeoJSON, a slicer, a nesting program.
    let part: Polygon<f64> = polygon!(
        exterior: [(x: 0., y: 0.), (x: 80., y: 0.), (x: 80., y: 50.), (x: 30., y: 50.), (x: 0., y: 20.)],
        interiors: [[(x: 50., y: 20.), (x: 60., y: 20.), (x: 60., y: 30.), (x: 50., y: 30.)]],
    );
    // From polygons nothing is lost: every edge is a segment of the boundary.
    let pocket = pocket(&part, Tolerance::MM)?;
    let mat = pocket.medial_axis()?;
    println!("largest tool: {:.3} mm", 2.0 * mat.largest_disk().radius);

    // Level sets hold arcs round the reflex corners; here chords within 0.01 mm stand for them.
    let within = 0.01;
    for distance in [3.0, 9.0, 15.0, 18.0] {
        let level = mat.level(distance);
        let polygons = multi_polygon(&level.loops, within)?;
        let holes: usize = polygons.iter().map(|p| p.interiors().len()).sum();
        let vertices: usize = polygons
            .iter()
            .flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()))
            .map(|ring| ring.0.len() - 1)
            .sum();
        let arcs = level.loops.iter().flat_map(|l| l.elements()).filter(|e| !e.is_segment()).count();
        println!(
            "at {distance} mm: {} polygons with {holes} holes, {vertices} vertices for {arcs} arcs and the rest",
            polygons.0.len()
        );
    }
    Ok(())
}
