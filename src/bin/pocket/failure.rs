//! Why the program stops: what happened, where in the drawing, what to do.

use crate::exit::Exit;
use medial::{Error, Point};
use std::path::Path;

/// An end before the work is done.
#[derive(Debug)]
pub struct Failure {
    pub exit: Exit,
    pub message: String,
    pub at: Option<Point>,
    pub help: Option<String>,
}

impl Failure {
    /// The command line makes no sense.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Failure {
        Failure { exit: Exit::Usage, message: message.into(), at: None, help: Some(help.into()) }
    }

    /// The same, with the advice to look at the drawing.
    pub fn or_inspect(self, drawing: &Path) -> Failure {
        let name = drawing.display().to_string();
        let is_plain = |c: char| c.is_alphanumeric() || "._-/\\:".contains(c);
        let name = if name.chars().all(is_plain) { name } else { format!("\"{name}\"") };
        let help = format!("see what the drawing holds: pocket inspect {name} -o picture.svg");
        Failure { help: Some(help), ..self }
    }

    /// Names the file that could not be written and why.
    pub fn standard_output(cause: &std::io::Error) -> Failure {
        let message = format!("cannot write to standard output: {cause}");
        Failure { exit: Exit::Cannot, message, at: None, help: None }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        let exit = if matches!(error, Error::Parameter { .. }) { Exit::Usage } else { Exit::Cannot };
        let at = match &error {
            Error::Internal { at, .. } => Some(*at),
            Error::Defects(defects) => defects.first().map(medial::Defect::at),
            _ => None,
        };
        let option = if matches!(error, Error::Parameter { .. }) { "--" } else { "" };
        Failure { exit, message: format!("{option}{error}"), at, help: help(&error) }
    }
}

/// What to change about an option that does not fit the others.
fn help_on(name: &str) -> String {
    match name {
        "step" => "ask for --step 100% or less of the tool, or take a larger tool: --tool".into(),
        "finish" => "leave less for the finishing pass, or take a larger step: --step".into(),
        "floor-stock" => "leave less on the floor, or go deeper: --depth".into(),
        "retract" => "begin to feed lower, or raise the rapids: --clearance".into(),
        _ => format!("see --{name} in pocket --help"),
    }
}

fn help(error: &Error) -> Option<String> {
    let text = match error {
        Error::File { action: "read", .. } => "check the name of the drawing and whether it may be read",
        Error::File { .. } => "check that the folder exists and may be written to; nothing was written",
        Error::NotADrawing { .. } => "save the drawing as DXF in the drawing program",
        Error::Unit { .. } => "tell its true unit: --dxf-units mm",
        Error::NothingToMachine { .. } => {
            "take a smaller tool: --tool, --stock; pocket inspect tells the largest that fits"
        }
        Error::Defects(defects) => return defects.first().map(medial::Defect::help),
        Error::Parameter { name, .. } => return Some(help_on(name)),
        Error::Effort { .. } => {
            "take a larger step, step-down or ramp angle, or a smaller part of the drawing: --layer"
        }
        _ => return None,
    };
    Some(text.to_owned())
}
