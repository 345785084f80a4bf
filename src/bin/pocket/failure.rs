//! Why the program stops: what happened, where in the drawing, what to do.

use crate::exit::Exit;
use medial::{Error, Point};

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
        Failure { exit, message: error.to_string(), at, help: help(&error) }
    }
}

fn help(error: &Error) -> Option<String> {
    let text = match error {
        Error::File { action: "read", .. } => "check the name of the drawing and whether it may be read",
        Error::File { .. } => "check that the folder exists and may be written to; nothing was written",
        Error::NotADrawing { .. } => "save the drawing as DXF in the drawing program",
        Error::NothingToMachine { .. } => "see the warnings above, or take a smaller tool: --tool, --stock",
        Error::Defects(defects) => return defects.first().map(medial::Defect::help),
        Error::Parameter { name, .. } => return Some(format!("see --{name} in pocket --help")),
        Error::Effort { .. } => {
            "take a larger step, step-down or ramp angle, or a smaller part of the drawing: --layer"
        }
        _ => return None,
    };
    Some(text.to_owned())
}
