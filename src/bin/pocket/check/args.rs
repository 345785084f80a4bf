//! The command line of the subcommand.

use crate::args::{ReportArg, drawing};
use crate::length::{Length, above_0, at_least_0};
use crate::reading::Reading;
use clap::Parser;
use std::path::PathBuf;

/// Judges offsets that any other program made of a drawing, by exact distances to it.
///
/// Told are the worst deviation, every part that is missing and every part that should not be there,
/// each with its place, length and, where it is a whole loop, area. Direction and order of the offsets
/// do not matter, curves may be flattened or loose; ends within --join are joined. Nothing of medial
/// axis and offsets of this program takes part. Offsets of open curves are not judged: what the
/// drawing leaves open bounds nothing. Bare lengths are in the unit of the job (mm, or inches for a
/// drawing in inches).
///
/// Exit status: 0 right; 1 unreadable, nothing to judge, or a file cannot be written; 2 usage; 3 not
/// within --within.
#[derive(Debug, Parser)]
#[command(
    name = "pocket check",
    bin_name = "pocket check",
    version,
    allow_negative_numbers = true,
    after_help = "example: pocket check part.dxf --offsets theirs.dxf --distance 1.5 --within 0.001"
)]
pub struct CheckArgs {
    /// Drawing that was offset
    #[arg(value_name = "DRAWING.dxf", value_parser = drawing)]
    pub drawing: PathBuf,

    /// Offsets to judge: .dxf, or .json
    ///
    /// JSON is a document of this program, or {"loops": [[[x, y, bulge], ...], ...]} with a bulge that
    /// may be left out, or that list of loops alone; {"units": "mm"} or "in" converts, otherwise the
    /// unit is that of the job. A DXF that claims no unit is in that of the drawing.
    #[arg(long, value_name = "FILE")]
    pub offsets: PathBuf,

    /// Distance that the offsets should keep; repeatable
    ///
    /// With several, each loop counts for the distance that it is nearest to. A document of this
    /// program knows its distances.
    #[arg(long = "distance", value_name = "LENGTH", value_parser = distance)]
    pub distances: Vec<Length>,

    /// The offsets lie outside of the outermost contours and in the islands
    #[arg(long)]
    pub outward: bool,

    /// Largest deviation that counts as none [default: --tolerance, and what fitting ellipses and
    /// splines took of it again]
    ///
    /// A part of a level is missing where nothing is within twice as much. Round-off always counts
    /// as none.
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0)]
    pub within: Option<Length>,

    /// Layer of the offsets to read, * for anything; repeatable [default: all visible]
    #[arg(long = "offsets-layer", value_name = "NAME")]
    pub offsets_layers: Vec<String>,

    /// Unit of the offsets, whatever they claim
    #[arg(long, value_name = "UNIT")]
    pub offsets_units: Option<String>,

    /// Picture to write, .svg: pockets, offsets, and every fault with its number
    #[arg(short, long = "output", value_name = "FILE")]
    pub outputs: Vec<PathBuf>,

    #[command(flatten)]
    pub reading: Reading,

    /// Form of what is told on standard output
    #[arg(long, value_enum, default_value_t, help_heading = "Report")]
    pub report: ReportArg,
}

/// A distance above 0; which side is another option, as programs disagree about the sign.
fn distance(text: &str) -> Result<Length, String> {
    above_0(text).map_err(|reason| match text.trim().starts_with('-') {
        true => format!("{reason}; write --outward for offsets on the outside"),
        false => reason,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        CheckArgs::command().debug_assert();
    }

    #[test]
    fn a_negative_distance_is_answered_with_the_option_it_means() {
        let parse =
            |d: &str| CheckArgs::try_parse_from(["check", "a.dxf", "--offsets", "b.dxf", "--distance", d]);
        assert!(parse("1.5").is_ok() && parse("0").is_err());
        assert!(parse("-1.5").unwrap_err().to_string().contains("--outward"));
    }
}
