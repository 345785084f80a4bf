//! What can go wrong: an [`Error`] stops a call, a [`Defect`] is a fault of the drawing that the
//! rest of it survives.

use crate::geom::Point;
use serde::Serialize;

/// Why a call gave no result. Each variant is something that the caller can act on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    #[error("cannot {action} {path}: {cause}")]
    File {
        /// `read` or `write`.
        action: &'static str,
        /// Which file.
        path: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// The bytes are no drawing that can be read.
    #[error("{path} is not a readable drawing: {reason}")]
    NotADrawing {
        /// Which file.
        path: String,
        /// What was found instead.
        reason: String,
    },
    /// The drawing claims a unit in which no part is drawn.
    #[error("{path} is drawn in {unit}, a unit in which no part is drawn")]
    Unit {
        /// Which file.
        path: String,
        /// Name of the unit.
        unit: &'static str,
    },
    /// The drawing holds nothing that can be machined.
    #[error("nothing to machine: {reason}")]
    NothingToMachine {
        /// Why not.
        reason: String,
    },
    /// Loops that do not bound a pocket: all faults, each with its place.
    #[error("the loops do not bound a pocket: {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Defects(Vec<Defect>),
    /// A number that the caller chose is out of its range.
    #[error("{name} is {value}, but must be {range}")]
    Parameter {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// A limit on effort was reached.
    #[error("{what} would need {needed}, more than the limit of {limit}")]
    Effort {
        /// What was too much.
        what: &'static str,
        /// How much it would take.
        needed: u64,
        /// The limit.
        limit: u64,
    },
    /// Another library, asked for its opinion, gave up.
    #[error("{library} gave up: {what}")]
    OtherLibrary {
        /// Which one.
        library: &'static str,
        /// What it said.
        what: String,
    },
    /// A pocket with islands, for a method that knows none.
    #[error("the pocket has {} apart from its wall; this method needs one without", counted(*count, "island", "islands"))]
    Islands {
        /// How many do not touch the wall.
        count: usize,
    },
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A fault of this library. The drawing that shows it is worth a report.
    #[error("internal fault near {at}: {what}; please report it with the drawing")]
    Internal {
        /// What was found inconsistent.
        what: String,
        /// Where in the drawing.
        at: Point,
    },
}

/// A fault of the drawing, with its place. Distances are in job units.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Defect {
    /// A chain of curves that does not close.
    #[error("open contour from {start} to {end}{}, a gap of {}", if *inside { " in a pocket" } else { "" }, digits(*gap))]
    OpenContour {
        /// One end.
        start: Point,
        /// The other end.
        end: Point,
        /// Distance between the ends.
        gap: f64,
        /// Whether it lies in a pocket, where it may be a lost island.
        inside: bool,
    },
    /// Curves that are drawn more than once; the copies were dropped.
    #[error("{} {at}", amount(*count, "duplicate dropped", "duplicates dropped"))]
    Duplicates {
        /// How many were dropped.
        count: usize,
        /// Where one of them begins.
        at: Point,
    },
    /// Stretches of curves that lie on others; they count once.
    #[error("{} {at}", amount(*count, "stretch of a curve lies on another and counts once", "stretches of curves lie on others and count once"))]
    Overlaps {
        /// How many there are.
        count: usize,
        /// Where one of them begins.
        at: Point,
    },
    /// Open curves that end on other curves and make several parts of one contour.
    #[error("{} {at}", amount(*count, "open curve ends on others and divides what is in them", "open curves end on others and divide what is in them"))]
    Divided {
        /// How many there are.
        count: usize,
        /// A place on one of them.
        at: Point,
    },
    /// Crossings smaller than the join tolerance. They were mended: loops by which contours crossed
    /// themselves were cut off, and contours that overlapped end on each other.
    #[error("{} {at}", amount(*count, "crossing smaller than --join was mended", "crossings smaller than --join were mended"))]
    Healed {
        /// How many there were.
        count: usize,
        /// Where one of them began.
        at: Point,
    },
    /// Contours that cross; the whole nest around them was left out.
    #[error("contours cross at {at}")]
    Crossing {
        /// A common point.
        at: Point,
    },
    /// A contour that crosses itself; the whole nest around it was left out.
    #[error("a contour crosses itself at {at}{}", reach.map_or(String::new(), |reach| format!(", in a loop of {}", digits(reach))))]
    SelfCrossing {
        /// The double point.
        at: Point,
        /// How far the loop reaches from there, if it is small against the contour.
        reach: Option<f64>,
    },
    /// More crossings than are listed one by one.
    #[error("contours cross at {}, one of them {at}", counted(*count, "more place", "more places"))]
    MoreCrossings {
        /// How many are not listed.
        count: usize,
        /// One of them.
        at: Point,
    },
    /// Loops that should bound one pocket bound another number of them.
    #[error("the loops bound {}, the last one at {at}", counted(*count, "pocket", "pockets"))]
    NotOnePocket {
        /// How many they bound.
        count: usize,
        /// A vertex of the last one; the origin when there is none.
        at: Point,
    },
    /// A curve with a coordinate that is not finite or too large to calculate with.
    #[error("a curve near {at} has a coordinate that is not a usable number")]
    Coordinate {
        /// Where it begins, as far as that is known.
        at: Point,
    },
    /// A loop that encloses nothing.
    #[error("the loop at {at} encloses no area")]
    NoArea {
        /// Its first vertex.
        at: Point,
    },
}

/// A length with four decimals, or with three digits where it is small: a reach a hundredth wider than a
/// gap is wider when it is read, too.
fn digits(length: f64) -> String {
    let decimals = (2.0 - length.log10().floor()).clamp(4.0, 15.0) as usize;
    format!("{length:.decimals$}")
}

/// A number with the word for what is counted.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// What is said of one or of many, up to the place of one of them.
fn amount(count: usize, one: &str, many: &str) -> String {
    let of = if count == 1 { "at" } else { "one at" };
    format!("{}, {of}", counted(count, one, many))
}

impl Defect {
    /// Where in the drawing, one place.
    pub fn at(&self) -> Point {
        match self {
            Defect::OpenContour { start, .. } => *start,
            Defect::Duplicates { at, .. }
            | Defect::Overlaps { at, .. }
            | Defect::Divided { at, .. }
            | Defect::Healed { at, .. }
            | Defect::Crossing { at }
            | Defect::SelfCrossing { at, .. }
            | Defect::MoreCrossings { at, .. }
            | Defect::NotOnePocket { at, .. }
            | Defect::Coordinate { at }
            | Defect::NoArea { at } => *at,
        }
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Defect::OpenContour { gap, .. } => {
                format!("close the contour in the drawing, or try --join {}", digits(gap * 1.01))
            }
            Defect::Duplicates { .. } => "nothing to do; equal curves count once".into(),
            Defect::Overlaps { .. } => "nothing to do, unless a curve is missing or doubled there".into(),
            Defect::Divided { .. } => {
                "each part is a pocket of its own; if the curves are no walls, remove them or select with --layer".into()
            }
            Defect::Healed { .. } => "nothing to do, unless it is meant so: then choose a smaller --join".into(),
            Defect::NotOnePocket { .. } => "make one pocket of each outer loop with its islands".into(),
            Defect::SelfCrossing { reach: Some(reach), .. } => {
                format!("cut the loop off in the drawing, or try --join {}", digits(reach * 1.01))
            }
            Defect::Crossing { .. } | Defect::SelfCrossing { .. } | Defect::MoreCrossings { .. } => {
                "trim the curves in the drawing so that contours touch at most, or select with --layer".into()
            }
            Defect::Coordinate { .. } => "repair the curve in the drawing".into(),
            Defect::NoArea { .. } => "remove the loop from the drawing".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_told_with_digits_that_close_it() {
        for gap in [3.0, 0.05, 0.000_41, 9.96e-7, 1.234_5e-9] {
            let open =
                Defect::OpenContour { start: Point::default(), end: Point::default(), gap, inside: true };
            let (text, help) = (open.to_string(), open.help());
            let last = |text: &str| text.rsplit(' ').next().and_then(|n| n.parse::<f64>().ok());
            assert!(last(&text).is_some_and(|told| (told - gap).abs() <= 0.005 * gap), "{text}");
            assert!(last(&help).is_some_and(|reach| reach > gap && reach < 1.02 * gap), "{help}");
            assert!(text.contains("in a pocket"));
        }
    }
}
