//! What is said of offsets, as text for people.

use super::verdict::{LevelVerdict, Verdict};
use crate::notice::{counted, short};
use medial::{Fault, FaultKind, Units};
use std::fmt::Write;

/// As many faults of a level as a reader of the text gets to see.
const MAX_LINES: usize = 20;

fn unit(units: Units) -> &'static str {
    match units {
        Units::Mm => "mm",
        Units::Inch => "in",
    }
}

/// Lengths that read well with six decimals.
const PLAIN: std::ops::Range<f64> = 1e-4..1e6;

/// A deviation: with the digits that matter, whether it is round-off or a millimeter.
fn deviation(length: f64) -> String {
    if length == 0.0 || PLAIN.contains(&length) { short(length) } else { format!("{length:.2e}") }
}

impl Verdict {
    /// The whole report.
    pub fn text(&self, files: &[std::path::PathBuf]) -> String {
        let unit = unit(self.units);
        let side = if self.outward { "outside" } else { "inside" };
        let mut text = format!("{} against {}, {side}\n", self.offsets, self.source);
        let mut number = 0;
        for level in &self.levels {
            self.level(level, &mut number, &mut text);
        }
        let within = deviation(self.within);
        let count: usize = self.levels.iter().map(|l| l.fault_count).sum();
        let _ = match self.right {
            true => writeln!(text, "right: nothing is off by more than {within} {unit}"),
            false => writeln!(text, "wrong: {} beyond {within} {unit}", counted(count, "fault", "faults")),
        };
        for file in files {
            let _ = writeln!(text, "written: {}", file.display());
        }
        text
    }

    fn level(&self, level: &LevelVerdict, number: &mut usize, text: &mut String) {
        let unit = unit(self.units);
        let loops = counted(level.loops, "curve", "curves");
        let _ = write!(text, "  at {} {unit}: {loops}, worst deviation", short(level.distance));
        let _ = match level.max_deviation_at {
            Some(at) => writeln!(text, " {} {unit} at {at}", deviation(level.max_deviation)),
            None => writeln!(text, " unknown, as there is nothing to measure"),
        };
        for fault in level.faults().take(MAX_LINES) {
            *number += 1;
            let _ = writeln!(text, "    {number}. {}, at {}", self::fault(fault, self.units), fault.at);
        }
        let told = level.faults().count();
        *number += told.saturating_sub(MAX_LINES);
        if level.fault_count > told.min(MAX_LINES) {
            let _ = writeln!(text, "    and {} more", level.fault_count - told.min(MAX_LINES));
        }
    }
}

/// One fault without its place.
pub fn fault(fault: &Fault, units: Units) -> String {
    let unit = unit(units);
    let long = format!("{} {unit} long", short(fault.length));
    let area =
        if fault.area > 0.0 { format!(", around {} {unit}2", short(fault.area)) } else { String::new() };
    let by = deviation(fault.by);
    match fault.kind {
        FaultKind::Missing => format!("missing: a part {long}{area}; the nearest curve is {by} {unit} away"),
        FaultKind::Distance => format!("phantom or misplaced: a part {long}{area}, off by {by} {unit}"),
        kind => kind.to_string(),
    }
}
