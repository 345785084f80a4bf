//! What a user has to know about a drawing although it was read, and about a file although it was
//! written. What the planner of the path has to say is in `toolpath`.

use super::DrawingUnit;
use crate::error::Defect;
use crate::geom::Point;
use crate::tolerance::Units;
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::fmt;

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of a text, from 1.
    Line(u64),
    /// A byte of a binary file, from 0.
    Byte(u64),
}

impl Default for Place {
    fn default() -> Place {
        Place::Line(0)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Something that was left out, assumed or changed, with its place and its cure. Lengths are in
/// the unit of the job.
///
/// Serialized as `{"kind", "message", "at", "help"}`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Entities of a kind that is not read.
    NotRead {
        /// Kind of entity, as the format calls it.
        entity: String,
        /// How many.
        count: usize,
        /// The layer they lie on, if they may be part of an outline: curves, not texts.
        layer: Option<String>,
    },
    /// Entities of a known kind that hold nothing usable.
    EntitySkipped {
        /// Kind of entity.
        entity: String,
        /// Handle of the first one, where it has one.
        handle: Option<u64>,
        /// Where in the file the first one is wrong.
        place: Place,
        /// What is wrong with it.
        reason: String,
        /// How many have the same fault.
        count: usize,
        /// A place of the first one, where one is known.
        at: Option<Point>,
    },
    /// Ellipses and splines that no arcs were found for.
    NotFitted {
        /// Kind of entity.
        entity: String,
        /// Handle of the first one, where it has one.
        handle: Option<u64>,
        /// Why not.
        reason: String,
        /// How many have the same fault.
        count: usize,
        /// A place of the first one, where one is known.
        at: Option<Point>,
    },
    /// Entities of which something does not count.
    Simplified {
        /// Kind of entity.
        entity: String,
        /// Handle of the first one, where it has one.
        handle: Option<u64>,
        /// Where in the file the first one stands.
        place: Place,
        /// What became of it.
        how: &'static str,
        /// How many.
        count: usize,
        /// A place of the first one, where one is known.
        at: Option<Point>,
    },
    /// Faults in the form of a file that were put right.
    Mended {
        /// What was found, and how it is read.
        what: &'static str,
        /// How often.
        count: usize,
        /// Where first.
        place: Place,
    },
    /// Entities on a layer that is off or frozen.
    LayerSkipped {
        /// Name of the layer.
        layer: String,
        /// `off` or `frozen`.
        state: &'static str,
        /// How many entities lie on it.
        count: usize,
    },
    /// Entities that the drawing marks as invisible.
    InvisibleSkipped {
        /// How many.
        count: usize,
    },
    /// Entities of a layout, not of the part.
    PaperSpaceSkipped {
        /// How many.
        count: usize,
    },
    /// A layer was asked for that the drawing does not have.
    NoSuchLayer {
        /// What was asked for.
        pattern: String,
        /// The layers with entities on them.
        layers: Vec<String>,
    },
    /// A color was asked for that no entity of the drawing has.
    NoSuchColor {
        /// What was asked for.
        color: String,
        /// The colors that entities have.
        colors: Vec<String>,
    },
    /// The part is so large or so small that the drawing is probably in another unit.
    ImplausibleSize {
        /// Its width.
        width: f64,
        /// Its height.
        height: f64,
        /// The unit of the job.
        job: Units,
        /// The unit that the drawing was read in.
        unit: DrawingUnit,
        /// Whether it is too large, not too small.
        large: bool,
        /// Its middle.
        at: Point,
    },
    /// The drawing was moved, as the user wished; all other places are told after that.
    OriginMoved {
        /// The place of the drawing that the origin lies at now.
        to: Point,
    },
    /// The file breaks off.
    Truncated,
    /// The drawing does not say its unit.
    UnitAssumed {
        /// The unit taken for it.
        unit: DrawingUnit,
        /// The unit of the job.
        job: Units,
        /// Whether a flag of the drawing speaks for it.
        flagged: bool,
    },
    /// A fault in the contours.
    Defect(Defect),
    /// One outermost contour holds nearly everything: perhaps the outline of the part.
    OutlineOfPart {
        /// A place of the contour.
        at: Point,
    },
    /// Arcs too short to be written with the decimals of the program.
    ArcsDropped {
        /// How many.
        count: usize,
        /// Where one of them is.
        at: Point,
    },
}

impl Warning {
    /// Its name in reports.
    pub fn kind(&self) -> &'static str {
        match self {
            Warning::NotRead { .. } => "not-read",
            Warning::EntitySkipped { .. } => "entity-skipped",
            Warning::NotFitted { .. } => "not-fitted",
            Warning::Simplified { .. } => "simplified",
            Warning::Mended { .. } => "mended",
            Warning::LayerSkipped { .. } => "layer-skipped",
            Warning::InvisibleSkipped { .. } => "invisible-skipped",
            Warning::PaperSpaceSkipped { .. } => "paper-space-skipped",
            Warning::NoSuchLayer { .. } => "no-such-layer",
            Warning::NoSuchColor { .. } => "no-such-color",
            Warning::ImplausibleSize { .. } => "implausible-size",
            Warning::OriginMoved { .. } => "origin-moved",
            Warning::Truncated => "truncated",
            Warning::UnitAssumed { .. } => "unit-assumed",
            Warning::Defect(defect) => defect_kind(defect),
            Warning::OutlineOfPart { .. } => "outline-of-part",
            Warning::ArcsDropped { .. } => "arcs-dropped",
        }
    }

    /// Where in the drawing, if it has one place.
    pub fn at(&self) -> Option<Point> {
        match self {
            Warning::EntitySkipped { at, .. }
            | Warning::NotFitted { at, .. }
            | Warning::Simplified { at, .. } => *at,
            Warning::Defect(defect) => Some(defect.at()),
            Warning::OutlineOfPart { at }
            | Warning::ArcsDropped { at, .. }
            | Warning::ImplausibleSize { at, .. } => Some(*at),
            _ => None,
        }
    }

    /// Moves the place of something that a reader has to say, when it moves the drawing.
    #[cfg(feature = "dxf")]
    pub(super) fn move_by(&mut self, by: crate::geom::Vector) {
        match self {
            Warning::EntitySkipped { at: Some(at), .. }
            | Warning::NotFitted { at: Some(at), .. }
            | Warning::Simplified { at: Some(at), .. }
            | Warning::ImplausibleSize { at, .. } => *at += by,
            _ => {}
        }
    }
}

/// The name of a defect in reports.
fn defect_kind(defect: &Defect) -> &'static str {
    match defect {
        Defect::OpenContour { .. } => "open-contour",
        Defect::Duplicates { .. } => "duplicates",
        Defect::Overlaps { .. } => "overlaps",
        Defect::Divided { .. } => "divided",
        Defect::Healed { .. } => "healed",
        Defect::Crossing { .. } => "crossing",
        Defect::SelfCrossing { .. } => "self-crossing",
        Defect::MoreCrossings { .. } => "more-crossings",
        Defect::NotOnePocket { .. } => "not-one-pocket",
        Defect::Coordinate { .. } => "coordinate",
        Defect::NoArea { .. } => "no-area",
    }
}

impl From<Defect> for Warning {
    fn from(defect: Defect) -> Warning {
        Warning::Defect(defect)
    }
}

impl Serialize for Warning {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Warning", 4)?;
        fields.serialize_field("kind", self.kind())?;
        fields.serialize_field("message", &self.to_string())?;
        fields.serialize_field("at", &self.at())?;
        fields.serialize_field("help", &self.help())?;
        fields.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn a_defect_is_a_warning_with_its_place_and_cure() {
        let open =
            Defect::OpenContour { start: point(1.0, 2.0), end: point(1.0, 2.5), gap: 0.5, inside: false };
        let warning = Warning::from(open.clone());
        assert_eq!((warning.kind(), warning.at()), ("open-contour", Some(point(1.0, 2.0))));
        assert_eq!((warning.to_string(), warning.help()), (open.to_string(), open.help()));
    }

    #[test]
    fn every_defect_has_the_name_it_is_serialized_with() {
        let at = point(0.0, 0.0);
        let open = Defect::OpenContour { start: at, end: at, gap: 0.0, inside: true };
        let others = [
            Defect::Duplicates { count: 1, at },
            Defect::Crossing { at },
            Defect::SelfCrossing { at, reach: Some(2.0) },
            Defect::MoreCrossings { count: 1, at },
            Defect::NotOnePocket { count: 2, at },
            Defect::Coordinate { at },
            Defect::NoArea { at },
            Defect::MoreCrossings { count: 1, at },
            Defect::NotOnePocket { count: 2, at },
        ];
        for defect in others.into_iter().chain([open]) {
            assert_eq!(serde_json::to_value(&defect).unwrap()["kind"], defect_kind(&defect));
        }
    }

    #[test]
    fn a_report_holds_kind_message_place_and_help() {
        let warning = Warning::EntitySkipped {
            entity: "CIRCLE".into(),
            handle: Some(0x2A),
            place: Place::Line(120),
            reason: "its radius is 0".into(),
            count: 3,
            at: Some(point(4.0, 5.5)),
        };
        assert_eq!(warning.to_string(), "CIRCLE 2A (line 120) and 2 more skipped: its radius is 0");
        let json = serde_json::to_value(&warning).unwrap();
        assert_eq!(json["kind"], "entity-skipped");
        assert_eq!(json["at"], serde_json::json!([4.0, 5.5]));
        assert!(serde_json::to_value(Warning::Truncated).unwrap()["at"].is_null());
    }
}
