//! Warnings and errors as they are printed: what, where in the drawing, what to do.

use crate::failure::Failure;
use medial::{Defect, Point, io, toolpath};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{IsTerminal, Write as _};

/// As many warnings of one kind as a reader of the text report gets to see.
const MAX_OF_A_KIND: usize = 10;

/// Something the user must know although the work went on.
#[derive(Clone, Debug, Serialize)]
pub struct Notice {
    kind: String,
    message: String,
    at: Option<Point>,
    help: String,
    /// Whether a pocket, a nest of contours or a part of a pocket was left out.
    #[serde(skip)]
    pub leaves_out: bool,
}

impl From<&io::Warning> for Notice {
    fn from(w: &io::Warning) -> Notice {
        Notice {
            kind: w.kind().into(),
            message: w.to_string(),
            at: w.at(),
            help: w.help(),
            leaves_out: false,
        }
    }
}

impl From<&Defect> for Notice {
    fn from(defect: &Defect) -> Notice {
        let leaves_out = match defect {
            Defect::Crossing { .. } | Defect::SelfCrossing { .. } => true,
            Defect::OpenContour { inside, .. } => *inside,
            _ => false,
        };
        Notice { leaves_out, ..Notice::from(&io::Warning::from(defect.clone())) }
    }
}

impl From<&toolpath::Warning> for Notice {
    fn from(w: &toolpath::Warning) -> Notice {
        Notice {
            kind: w.kind().into(),
            message: w.to_string(),
            at: w.at(),
            help: w.help(),
            leaves_out: w.leaves_out(),
        }
    }
}

impl Notice {
    /// The same, said of another file than the drawing.
    pub fn about(self, what: &str) -> Notice {
        Notice { message: format!("{what}: {}", self.message), ..self }
    }

    /// Arcs that the decimals of the program are too few for.
    pub fn arcs_dropped(count: usize, at: Point) -> Notice {
        Notice::from(&io::Warning::ArcsDropped { count, at })
    }

    /// A contour that holds nearly everything.
    pub fn outline_of_part(at: Point) -> Notice {
        Notice::from(&io::Warning::OutlineOfPart { at })
    }

    /// All to standard error, but of each kind the first few only.
    pub fn print_all(notices: &[Notice]) {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for notice in notices {
            let count = counts.entry(&notice.kind).or_default();
            *count += 1;
            if *count <= MAX_OF_A_KIND {
                print("warning", "33", &notice.message, notice.at, Some(&notice.help));
            }
        }
        for (kind, count) in counts.into_iter().filter(|(_, count)| *count > MAX_OF_A_KIND) {
            let message = format!("{} more of the kind {kind}", count - MAX_OF_A_KIND);
            print("warning", "33", &message, None, Some("--report json lists them all"));
        }
    }
}

impl Failure {
    /// To standard error.
    pub fn print(&self) {
        print("error", "31", &self.message, self.at, self.help.as_deref());
    }
}

fn print(label: &str, color: &str, message: &str, at: Option<Point>, help: Option<&str>) {
    let colored =
        std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let paint = |word: &str, color: &str| {
        if colored { format!("\x1b[1;{color}m{word}:\x1b[0m") } else { format!("{word}:") }
    };
    let mut text = format!("{} {message}\n", paint(label, color));
    if let Some(at) = at {
        let _ = writeln!(text, "   {} {at}", paint("at", "36"));
    }
    if let Some(help) = help {
        let _ = writeln!(text, " {} {help}", paint("help", "36"));
    }
    // Nobody is left to tell when standard error is gone.
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// A length as a reader wants it: at most six decimals, no trailing zeros.
pub fn short(length: f64) -> String {
    let text = format!("{length:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A number with the word for what is counted.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short() {
        assert_eq!(short(2.400_000_000_000_000_4), "2.4");
        assert_eq!(
            (short(-0.000_000_1), short(120.0), short(-3.25)),
            ("0".into(), "120".into(), "-3.25".into())
        );
    }
}
