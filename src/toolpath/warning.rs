//! What the planner could not do as asked.

use super::Entry;
use crate::geom::Point;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Something the user must know about a path. Lengths are in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Warning {
    /// The step was reduced so that neighboring cuts overlap.
    StepReduced {
        /// As asked.
        asked: f64,
        /// As used.
        used: f64,
    },
    /// The tool fits nowhere into a pocket, which is left out.
    ToolTooLarge {
        /// Index of the pocket.
        pocket: usize,
        /// Center of the largest disk in it.
        at: Point,
        /// Largest tool diameter that fits.
        largest: f64,
    },
    /// A neck is too narrow for the tool: what lies in it, and behind it if that is no wider, is
    /// left out.
    NarrowNeck {
        /// Index of the pocket.
        pocket: usize,
        /// The narrowest place.
        at: Point,
        /// How wide it is, less the stock to leave.
        width: f64,
        /// All area of the pocket that the tool cannot reach, corners included.
        area: f64,
    },
    /// The tool gets down in another way than asked.
    EntryFallback {
        /// As asked.
        asked: Entry,
        /// How many entries are ramps instead.
        ramps: usize,
        /// How many go straight down instead.
        plunges: usize,
        /// The first place where the tool goes straight down.
        at: Option<Point>,
    },
    /// Leads onto finishing passes are smaller than asked, or there are none.
    LeadFallback {
        /// Radius as asked.
        asked: f64,
        /// How many passes have a smaller one.
        smaller: usize,
        /// How many passes are met straight.
        none: usize,
        /// The first of these places.
        at: Option<Point>,
    },
}

impl Warning {
    /// Its kind as one word.
    pub fn kind(&self) -> &'static str {
        match self {
            Warning::StepReduced { .. } => "step-reduced",
            Warning::ToolTooLarge { .. } => "tool-too-large",
            Warning::NarrowNeck { .. } => "narrow-neck",
            Warning::EntryFallback { .. } => "entry-fallback",
            Warning::LeadFallback { .. } => "lead-fallback",
        }
    }

    /// Where in the drawing, if at a place.
    pub fn at(&self) -> Option<Point> {
        match self {
            Warning::StepReduced { .. } => None,
            Warning::ToolTooLarge { at, .. } | Warning::NarrowNeck { at, .. } => Some(*at),
            Warning::EntryFallback { at, .. } | Warning::LeadFallback { at, .. } => *at,
        }
    }

    /// Whether a pocket or a part of it was left out.
    pub fn leaves_out(&self) -> bool {
        matches!(self, Warning::ToolTooLarge { .. } | Warning::NarrowNeck { .. })
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Warning::StepReduced { used, .. } => format!("ask for --step {}", round_down(*used)),
            Warning::ToolTooLarge { largest, .. } if *largest > 0.0 => {
                format!("take a tool of at most --tool {}", round_down(*largest))
            }
            Warning::ToolTooLarge { .. } => "leave less with --stock".into(),
            Warning::NarrowNeck { width, .. } if *width > 0.0 => {
                format!("a tool of at most --tool {} passes", round_down(*width))
            }
            Warning::NarrowNeck { .. } => "leave less with --stock".into(),
            Warning::EntryFallback { plunges: 1.., .. } => {
                "use a tool that cuts at its center, or drill there first".into()
            }
            Warning::EntryFallback { .. } => "ask for --entry ramp".into(),
            Warning::LeadFallback { .. } => {
                "ask for smaller leads with --lead, or for none with --lead 0".into()
            }
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::StepReduced { asked, used } => {
                write!(f, "the step of {asked} is reduced to {used}, so that neighboring cuts overlap")
            }
            Warning::ToolTooLarge { largest, .. } if *largest > 0.0 => write!(
                f,
                "the tool is too large for a pocket, which is left out; the largest that fits is {}",
                round_down(*largest)
            ),
            Warning::ToolTooLarge { .. } => {
                write!(f, "the stock to leave fills a pocket, which is left out")
            }
            Warning::NarrowNeck { width, area, .. } => write!(
                f,
                "a neck of {} is too narrow for the tool; an area of {area:.4} is out of reach in all",
                round_down(width.max(0.0))
            ),
            Warning::EntryFallback { asked, ramps, plunges, .. } => {
                write!(f, "instead of entries by {}: ", asked.name())?;
                match (ramps, plunges) {
                    (ramps, 0) => write!(f, "{ramps} by ramp"),
                    (0, plunges) => write!(f, "{plunges} straight down"),
                    _ => write!(f, "{ramps} by ramp, {plunges} straight down"),
                }
            }
            Warning::LeadFallback { asked, smaller, none, .. } => {
                write!(f, "no room for leads of radius {asked} onto finishing passes: ")?;
                match (smaller, none) {
                    (smaller, 0) => write!(f, "{smaller} with a smaller one"),
                    (0, none) => write!(f, "{none} met straight"),
                    _ => write!(f, "{smaller} with a smaller one, {none} met straight"),
                }
            }
        }
    }
}

impl Entry {
    /// As the command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Entry::Helix => "helix",
            Entry::Ramp => "ramp",
            Entry::Plunge => "plunge",
        }
    }
}

/// Three significant digits or more, never above the value: a tool of that size still fits.
fn round_down(length: f64) -> f64 {
    if !(length > 0.0 && length.is_finite()) {
        return length;
    }
    let digits = (3 - length.log10().floor() as i32).clamp(0, 300);
    let scale = 10f64.powi(digits);
    let rounded = (length * scale).round() / scale;
    let ulps = 8.0 * f64::EPSILON * length;
    if (rounded - length).abs() <= ulps { rounded } else { (length * scale).floor() / scale }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_in_messages_are_never_rounded_up() {
        assert_eq!(round_down(2.999_99), 2.999);
        assert_eq!(round_down(0.123_456), 0.1234);
        assert_eq!(round_down(3.0_f64.next_down()), 3.0);
        assert_eq!(round_down(12345.6), 12345.0);
    }

    #[test]
    fn a_warning_names_its_cure() {
        let w = Warning::ToolTooLarge { pocket: 0, at: crate::geom::point(1.0, 2.0), largest: 4.0 };
        assert_eq!(w.help(), "take a tool of at most --tool 4");
        assert!(w.to_string().contains("too large"));
    }
}
