//! From the command line to what is told.

use super::args::InspectArgs;
use super::inspection::Inspection;
use crate::args::ReportArg;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::outputs::{print_out, same_file};
use clap::Parser;
use medial::io::atomic;
use medial::io::dxf::read;
use std::path::Path;

/// Looks at a drawing and tells about it.
pub fn run() -> Result<Exit, Failure> {
    // Help and version end the program here.
    let args = InspectArgs::parse_from(std::env::args_os().skip(1));
    check(&args)?;
    let options = args.reading.options()?;
    let drawing = read(&args.drawing, &options)?;
    let tolerance = args.reading.tolerance(drawing.units);
    let inspection = Inspection::new(drawing, tolerance, args.reading.depth_of_pockets())?;
    let staged: Vec<(&Path, Vec<u8>)> = args
        .outputs
        .iter()
        .map(|path| {
            let text = if is_picture(path) { inspection.picture() } else { inspection.json() };
            (path.as_path(), text.into_bytes())
        })
        .collect();
    atomic::write_all_whole(&staged)?;
    print_out(&match args.report {
        ReportArg::Text => inspection.text(&args.outputs),
        ReportArg::Json => inspection.json(),
    })?;
    Ok(if inspection.machinable { Exit::Done } else { Exit::Cannot })
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().and_then(|e| e.to_str()).is_some_and(|e| e.eq_ignore_ascii_case(wanted))
}

/// Whether an output is a picture.
pub fn is_picture(path: &Path) -> bool {
    has_extension(path, "svg")
}

fn check(args: &InspectArgs) -> Result<(), Failure> {
    for (i, path) in args.outputs.iter().enumerate() {
        if !(is_picture(path) || has_extension(path, "json")) {
            return Err(Failure::usage(
                format!("the form of {} is not known to pocket inspect", path.display()),
                "end its name in .svg (picture) or .json (all that is told)",
            ));
        }
        if args.outputs[..i].contains(path) {
            return Err(Failure::usage(
                format!("{} is to be written twice", path.display()),
                "give each -o its own name",
            ));
        }
        if same_file(path, &args.drawing) {
            return Err(Failure::usage(
                format!("{} is the drawing itself", path.display()),
                "give the output another name",
            ));
        }
    }
    Ok(())
}
