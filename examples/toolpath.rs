//! A drawing in, a program out, through the library.
//!
//!     cargo run --example toolpath samples/h-neck.dxf h-neck.nc

use medial::io::{atomic, dxf, gcode};
use medial::{Direction, Job, Pocket, Pockets, Units};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let input = arguments.next().unwrap_or_else(|| "samples/h-neck.dxf".into());
    let output = arguments.next().unwrap_or_else(|| "h-neck.nc".into());

    // Everything behind the reader is in the unit of the job.
    let options = dxf::ReadOptions { units: Some(Units::Mm), ..Default::default() };
    let drawing = dxf::read(Path::new(&input), &options)?;
    for warning in &drawing.warnings {
        eprintln!("{warning}");
    }
    // What is wrong with the drawing comes as values; the rest of it is machined.
    let Pockets { pockets, defects } = Pockets::from_curves(&drawing.curves, drawing.units.tolerance())?;
    for defect in &defects {
        eprintln!("{defect}: {}", defect.help());
    }
    let mats = pockets.iter().map(Pocket::medial_axis).collect::<Result<Vec<_>, _>>()?;

    let job = Job {
        depth: 5.0,
        step_down: Some(1.5),
        direction: Direction::Conventional,
        ..Job::new(drawing.units, 6.0, 2.4)
    };
    let path = job.path(&mats)?;
    for (i, pocket) in path.pockets.iter().enumerate() {
        println!(
            "pocket {}: {} passes, {:.3} mm2 out of reach",
            i + 1,
            pocket.passes,
            pocket.unreachable_area.unwrap_or(f64::NAN)
        );
    }
    for warning in &path.warnings {
        eprintln!("{warning}");
    }
    let program = gcode::write(&path.moves, &gcode::Setup::new(drawing.units))?;
    atomic::write_whole(&output, program.text.as_bytes())?;
    println!("{output}: {:.1} minutes", path.totals.minutes);
    Ok(())
}
