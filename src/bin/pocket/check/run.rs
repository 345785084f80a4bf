//! From the command line to the verdict.

use super::args::CheckArgs;
use super::offsets;
use super::verdict::Verdict;
use crate::args::ReportArg;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::notice::Notice;
use crate::outputs::{print_out, same_file};
use crate::plan::nothing;
use clap::Parser;
use medial::io::atomic;
use medial::io::dxf::{Drawing, read};
use medial::verify::Boundary;
use medial::{Pocket, Pockets};
use std::path::Path;

/// Judges the offsets of a drawing.
pub fn run() -> Result<Exit, Failure> {
    // Help and version end the program here.
    let args = CheckArgs::parse_from(std::env::args_os().skip(1));
    check(&args)?;
    let part = read(&args.drawing, &args.reading.options()?)?;
    let mut notices: Vec<Notice> = part.warnings.iter().map(Notice::from).collect();
    let verdict = judged(&args, &part, &mut notices).inspect_err(|_| Notice::print_all(&notices));
    let mut verdict = verdict?;
    Notice::print_all(&notices);
    verdict.warnings = notices;
    let picture = verdict.picture();
    let staged: Vec<(&Path, Vec<u8>)> =
        args.outputs.iter().map(|path| (path.as_path(), picture.clone().into_bytes())).collect();
    atomic::write_all_whole(&staged)?;
    print_out(&match args.report {
        ReportArg::Text => verdict.text(&args.outputs),
        ReportArg::Json => verdict.json(),
    })?;
    Ok(if verdict.right { Exit::Done } else { Exit::Refused })
}

fn judged(args: &CheckArgs, part: &Drawing, notices: &mut Vec<Notice>) -> Result<Verdict, Failure> {
    let tolerance = args.reading.tolerance(part.units);
    let from_depth = args.reading.depth_of_pockets();
    let found = Pockets::from_curves_at_depth(&part.curves, tolerance, from_depth)?;
    notices.extend(found.defects.iter().map(Notice::from));
    if found.pockets.is_empty() {
        let reason = nothing(part.curves.is_empty(), found.defects.is_empty(), from_depth);
        let failure = Failure::from(medial::Error::NothingToMachine { reason });
        return Err(failure.or_inspect(&args.drawing));
    }
    let boundary = Boundary::new(found.pockets.iter().flat_map(Pocket::loops));
    let offsets = offsets::read(args, part, &boundary, notices)?;
    let natural = tolerance.fit + part.fitted.bound;
    let mut verdict = Verdict {
        source: part.name.clone(),
        offsets: args.offsets.display().to_string(),
        units: part.units,
        outward: args.outward,
        within: args.within.map_or(natural, |l| l.to(part.units)),
        right: true,
        max_deviation: 0.0,
        max_deviation_at: None,
        levels: Vec::new(),
        warnings: Vec::new(),
        pockets: found.pockets,
        curves: Vec::new(),
    };
    verdict.judge(&boundary, &offsets);
    Ok(verdict)
}

fn check(args: &CheckArgs) -> Result<(), Failure> {
    for (i, path) in args.outputs.iter().enumerate() {
        if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg")) {
            return Err(Failure::usage(
                format!("the form of {} is not known to pocket check", path.display()),
                "end its name in .svg; --report json tells everything to programs",
            ));
        }
        if args.outputs[..i].contains(path) {
            return Err(Failure::usage(
                format!("{} is to be written twice", path.display()),
                "give each -o its own name",
            ));
        }
        if let Some(input) = [&args.drawing, &args.offsets].into_iter().find(|input| same_file(path, input)) {
            return Err(Failure::usage(
                format!("{} is an input itself", input.display()),
                "give the output another name",
            ));
        }
    }
    Ok(())
}
