//! The command line of the subcommand.

use crate::args::{ReportArg, drawing};
use crate::reading::Reading;
use clap::Parser;
use std::path::PathBuf;

/// What a drawing holds, and every defect with its place and its cure.
///
/// Told are unit, size, layers, kinds of entities, contours as they are nested with the largest tool
/// that fits, and everything that was left out, assumed or mended. Each finding has a number, which
/// stands in the picture too. Bare lengths are in the unit of the job (mm, or inches for a drawing in
/// inches).
///
/// Exit status: 0 something can be machined; 1 unreadable, nothing to machine, or a file cannot be
/// written; 2 usage.
#[derive(Debug, Parser)]
#[command(
    name = "pocket inspect",
    bin_name = "pocket inspect",
    version,
    allow_negative_numbers = true,
    after_help = "example: pocket inspect part.dxf -o picture.svg"
)]
pub struct InspectArgs {
    /// Drawing to look at
    #[arg(value_name = "DRAWING.dxf", value_parser = drawing)]
    pub drawing: PathBuf,

    /// File to write; repeatable: .svg for a picture, .json for all that is told
    ///
    /// The picture shows pockets filled, what is in no pocket in another color, ellipses and splines
    /// dashed, and marks every finding that has a place with its number. Files are written whole or not
    /// at all.
    #[arg(short, long = "output", value_name = "FILE")]
    pub outputs: Vec<PathBuf>,

    #[command(flatten)]
    pub reading: Reading,

    /// Form of what is told on standard output
    #[arg(long, value_enum, default_value_t, help_heading = "Report")]
    pub report: ReportArg,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        InspectArgs::command().debug_assert();
    }

    #[test]
    fn a_drawing_is_enough() {
        assert!(InspectArgs::try_parse_from(["inspect", "a.dxf"]).is_ok());
        assert!(InspectArgs::try_parse_from(["inspect", "a.dxf", "--tool", "6"]).is_err());
        assert!(InspectArgs::try_parse_from(["inspect"]).is_err());
    }
}
