//! How the program ends.

use std::process::ExitCode;

/// Exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// Cannot: unreadable drawing, nothing to machine, a file that cannot be written.
    Cannot = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// The judge refuses, or something was left out under `--strict`.
    Refused = 3,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit as u8)
    }
}
