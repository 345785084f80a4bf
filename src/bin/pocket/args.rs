//! The command line as typed; `settings` makes sense of it.

use crate::length::{
    Length, Step, above_0, at_least_0, number_above_0, number_at_least_0, share, slope, step, whole,
};
use crate::reading::Reading;
use clap::{Parser, ValueEnum};
use std::path::PathBuf;

/// What stands below the options.
const AFTER: &str = "\
pocket inspect DRAWING.dxf -o picture.svg tells what a drawing holds, and every defect with its place \
and its cure; begin there when something is wrong (pocket inspect --help).

pocket check DRAWING.dxf --offsets theirs.dxf --distance 1.5 judges offsets that any program made \
(pocket check --help).

example: pocket part.dxf --tool 6 --step 40% --depth 5 --step-down 1.5 -o part.nc";

/// Tool paths for pockets, from a DXF drawing through the exact medial axis.
///
/// Every closed contour of the drawing counts: the outermost is a pocket, a contour in it an island,
/// a contour in an island a pocket again. Bare lengths are in the unit of the job (mm, or inches for
/// a drawing in inches); 0.5mm and 0.02in always work.
///
/// Exit status: 0 done; 1 cannot (unreadable drawing, nothing to machine, a file cannot be written);
/// 2 usage; 3 the judge refuses, or something was left out under --strict.
#[derive(Debug, Parser)]
#[command(
    name = "pocket",
    version,
    allow_negative_numbers = true,
    override_usage = "pocket [OPTIONS] <DRAWING.dxf>\n       pocket inspect [OPTIONS] <DRAWING.dxf>\n       pocket check [OPTIONS] --offsets <FILE> --distance <LENGTH> <DRAWING.dxf>",
    after_help = AFTER
)]
pub struct Args {
    /// Drawing to machine
    ///
    /// A file that is called inspect or check is written ./inspect, ./check: these names are kept
    /// for subcommands.
    #[arg(value_name = "DRAWING.dxf", value_parser = drawing)]
    pub drawing: PathBuf,

    /// File to write; repeatable, the extension chooses the form
    ///
    /// .nc .ngc .gcode .tap .cnc for G-code, .dxf for a drawing with boundary, axis, offsets and path
    /// on layers, .svg for a picture, .json for a document for CAM software, - for G-code on standard
    /// output. Files are written whole or not at all. Without this option there is a report only.
    #[arg(short, long = "output", value_name = "FILE")]
    pub outputs: Vec<PathBuf>,

    /// Tool diameter [default: 2 x step]
    ///
    /// 0 asks for level sets alone, at step, 2 step, 3 step ...
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, help_heading = "Tool and passes")]
    pub tool: Option<Length>,

    /// Largest distance between passes; % of the tool diameter [default: 40%]
    ///
    /// Above 0 and at most 100% of the tool. One of --tool, --step is required.
    #[arg(long, value_name = "LENGTH|%", value_parser = step, help_heading = "Tool and passes")]
    pub step: Option<Step>,

    /// Floor below the top [default: 1 mm, 0.04 in]
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Tool and passes")]
    pub depth: Option<Length>,

    /// Height of the top of the stock [default: 0]
    #[arg(long, value_name = "Z", allow_hyphen_values = true, help_heading = "Tool and passes")]
    pub top: Option<Length>,

    /// Largest depth per level [default: half the tool]
    ///
    /// Levels are equal; the last lies exactly at the floor.
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Tool and passes")]
    pub step_down: Option<Length>,

    /// Material to leave on walls [default: 0]
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, help_heading = "Tool and passes")]
    pub stock: Option<Length>,

    /// Material to leave on the floor [default: 0]
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, help_heading = "Tool and passes")]
    pub floor_stock: Option<Length>,

    /// Material that roughing leaves on walls for one more pass at full depth [default: 0]
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, help_heading = "Tool and passes")]
    pub finish: Option<Length>,

    /// Radius of the arcs onto finishing passes and off them [default: half the tool]
    ///
    /// Less where there is less room, and at least as wide as --finish; 0 for none.
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, requires = "finish",
          help_heading = "Tool and passes")]
    pub lead: Option<Length>,

    /// Run the wall passes at the floor this often once more
    #[arg(long, value_name = "N", value_parser = whole, default_value = "0", help_heading = "Tool and passes")]
    pub spring: u32,

    /// Side of the uncut stock: on the right (climb) or left of the motion
    #[arg(long, value_enum, default_value_t, help_heading = "Tool and passes")]
    pub direction: DirectionArg,

    /// Pattern of the passes
    #[arg(long, value_enum, default_value_t, help_heading = "Tool and passes")]
    pub strategy: StrategyArg,

    /// Where a pocket begins: at its largest disk or at its wall
    #[arg(long, value_enum, default_value_t, help_heading = "Tool and passes")]
    pub start: StartArg,

    /// Each pocket down to its floor, or all of them level by level, for thin walls between them
    #[arg(long, value_enum, default_value_t, help_heading = "Tool and passes")]
    pub order: OrderArg,

    /// How the tool gets down; falls back in this order where it does not fit
    #[arg(long, value_enum, default_value_t, help_heading = "Machine")]
    pub entry: EntryArg,

    /// Cut through a neck as wide as the tool instead of lifting the tool over it
    #[arg(long, help_heading = "Machine")]
    pub slot: bool,

    /// Slope of ramps
    #[arg(long, value_name = "DEGREES", value_parser = slope, default_value = "3", help_heading = "Machine")]
    pub ramp_angle: f64,

    /// Feed rate [default: 600 mm/min, 24 in/min]
    #[arg(long, value_name = "LENGTH/MIN", value_parser = above_0, help_heading = "Machine")]
    pub feed: Option<Length>,

    /// Share of the feed where more is cut than the step: first passes, necks, corners [default: 100%]
    #[arg(long, value_name = "SHARE|%", value_parser = share, default_value = "1", hide_default_value = true,
          help_heading = "Machine")]
    pub slow: f64,

    /// Feed rate downward [default: 200 mm/min, 8 in/min]
    #[arg(long, value_name = "LENGTH/MIN", value_parser = above_0, help_heading = "Machine")]
    pub plunge_feed: Option<Length>,

    /// Largest acceleration, for the estimate of time [default: 500 mm/s2, 20 in/s2]
    #[arg(long, value_name = "LENGTH/S2", value_parser = above_0, help_heading = "Machine")]
    pub acceleration: Option<Length>,

    /// Spindle speed
    #[arg(long, value_name = "RPM", value_parser = number_above_0, default_value = "12000",
          help_heading = "Machine")]
    pub spindle: f64,

    /// Wait after the spindle starts
    #[arg(long, value_name = "SECONDS", value_parser = number_at_least_0, default_value = "0",
          help_heading = "Machine")]
    pub dwell: f64,

    /// Tool number of the program
    #[arg(long, value_name = "N", value_parser = whole, default_value = "1", help_heading = "Machine")]
    pub tool_number: u32,

    /// Coolant while the spindle turns
    #[arg(long, value_enum, default_value_t, help_heading = "Machine")]
    pub coolant: CoolantArg,

    /// Work coordinate system
    #[arg(long, value_name = "G54..G59", value_parser = wcs, default_value = "G54", help_heading = "Machine")]
    pub wcs: u8,

    /// Height of rapids above the top [default: 5 mm, 0.2 in]
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Machine")]
    pub clearance: Option<Length>,

    /// Height above the stock where feed begins [default: 1 mm, 0.04 in]
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Machine")]
    pub retract: Option<Length>,

    #[command(flatten)]
    pub reading: Reading,

    /// Controller that the program is for
    #[arg(long, value_enum, default_value_t, help_heading = "Program")]
    pub post: PostArg,

    /// How arcs are written: center, radius, or as lines within the tolerance
    #[arg(long, value_enum, default_value_t, help_heading = "Program")]
    pub arcs: ArcsArg,

    /// Decimals of coordinates [default: 4 in mm, 5 in inches]
    #[arg(long, value_name = "N", value_parser = whole, help_heading = "Program")]
    pub decimals: Option<u32>,

    /// Number the lines
    #[arg(long, help_heading = "Program")]
    pub line_numbers: bool,

    /// Hold every level set against exact distances and against cavalier_contours
    ///
    /// Exit 3 when one is wrong by exact distances; where cavalier_contours alone differs, the report
    /// says where.
    #[arg(long, help_heading = "Report")]
    pub verify: bool,

    /// Exit 3 when a pocket or a part of one was left out
    #[arg(long, help_heading = "Report")]
    pub strict: bool,

    /// Report as text on standard error or as JSON on standard output
    #[arg(long, value_enum, default_value_t, help_heading = "Report")]
    pub report: ReportArg,

    /// Add stage by stage timings to the report
    #[arg(long, help_heading = "Report")]
    pub timings: bool,

    /// Nothing on standard error but errors
    #[arg(long, short, help_heading = "Report")]
    pub quiet: bool,

    /// Threads; the result does not depend on it [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..), help_heading = "Report")]
    pub jobs: Option<u16>,
}

/// Names that are kept for subcommands.
pub const SUBCOMMANDS: [&str; 2] = ["inspect", "check"];

/// What to say when the name of a subcommand stands where none can.
pub fn reserved(name: &str) -> String {
    format!(
        "`{name}` is a subcommand and comes first, before all options; a file of that name is written ./{name}"
    )
}

/// The name of a drawing, which is not that of a subcommand.
pub fn drawing(text: &str) -> Result<PathBuf, String> {
    if SUBCOMMANDS.contains(&text) { Err(reserved(text)) } else { Ok(PathBuf::from(text)) }
}

fn wcs(text: &str) -> Result<u8, String> {
    let number = text.strip_prefix(['G', 'g']).and_then(|n| n.parse().ok());
    number.filter(|n| (54..=59).contains(n)).ok_or_else(|| "must be one of G54 to G59".into())
}

/// `--direction`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum DirectionArg {
    #[default]
    Climb,
    Conventional,
}

/// `--strategy`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum StrategyArg {
    #[default]
    Offset,
}

/// `--start`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum StartArg {
    #[default]
    Inside,
    Outside,
}

/// `--order`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum OrderArg {
    #[default]
    Pocket,
    Level,
}

/// `--entry`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum EntryArg {
    #[default]
    Helix,
    Ramp,
    Plunge,
}

/// `--coolant`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum CoolantArg {
    #[default]
    Off,
    Mist,
    Flood,
}

/// `--post`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum PostArg {
    /// Plain words that grbl, LinuxCNC, Mach and Fanuc all accept
    #[default]
    Generic,
}

/// `--arcs`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum ArcsArg {
    #[default]
    Ijk,
    R,
    Off,
}

/// `--report`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ReportArg {
    #[default]
    Text,
    Json,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn tool_or_step_is_required() {
        let neither = Args::try_parse_from(["pocket", "a.dxf"]).unwrap();
        assert!(neither.check().unwrap_err().help.unwrap().contains("--tool"));
        assert!(Args::try_parse_from(["pocket", "a.dxf", "--tool", "6"]).is_ok());
        assert!(Args::try_parse_from(["pocket", "a.dxf", "--step", "0.5"]).is_ok());
    }

    #[test]
    fn names_of_subcommands_are_no_drawings() {
        assert!(Args::try_parse_from(["pocket", "inspect", "--tool", "6"]).is_err());
        assert!(Args::try_parse_from(["pocket", "./inspect", "--tool", "6"]).is_ok());
    }

    #[test]
    fn negative_heights_are_numbers_and_not_options() {
        let args = Args::try_parse_from(["pocket", "a.dxf", "--tool", "6", "--top", "-2mm"]).unwrap();
        assert_eq!(args.top.unwrap().to(medial::Units::Mm), -2.0);
    }
}
