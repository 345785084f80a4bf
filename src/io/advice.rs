//! What warnings say in words, and what to do about them.

use super::warning::Place;
use super::{DrawingUnit, Warning};
use std::fmt;

impl Warning {
    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Warning::NotRead { layer: Some(_), .. } => {
                "if it is part of an outline: convert it to polylines or arcs in the drawing program".into()
            }
            Warning::NotRead { entity, .. } if entity == "HATCH" => {
                "nothing to do, or read the boundaries of hatched areas with --hatch".into()
            }
            Warning::NotRead { .. } => "nothing to do, if it is no part of an outline".into(),
            Warning::EntitySkipped { .. } => "repair or delete it in the drawing".into(),
            Warning::NotFitted { .. } => {
                "draw it anew, or convert it to a polyline in the drawing program".into()
            }
            Warning::Simplified { .. } => {
                "nothing to do, if the part is drawn as it is seen from above".into()
            }
            Warning::Mended { .. } => "nothing to do, if the part is complete".into(),
            Warning::LayerSkipped { .. } => "turn the layer on in the drawing, or use --hidden".into(),
            Warning::InvisibleSkipped { .. } => "make them visible in the drawing, or use --hidden".into(),
            Warning::PaperSpaceSkipped { .. } => "nothing to do, if the part is drawn in model space".into(),
            Warning::NoSuchLayer { layers, .. } => format!("layers with entities: {}", layers.join(", ")),
            Warning::NoSuchColor { colors, .. } => format!("colors of entities: {}", colors.join(", ")),
            Warning::ImplausibleSize { unit, large, .. } => {
                let smaller = if *unit == DrawingUnit::Millimeter { "um" } else { "mm" };
                let larger = if *unit == DrawingUnit::Millimeter { "m" } else { "mm" };
                let other = if *large { smaller } else { larger };
                format!("if that is wrong: --dxf-units {other}, or multiply it with --scale")
            }
            Warning::OriginMoved { .. } => {
                "nothing to do; all places in this report and in what is written are told from there".into()
            }
            Warning::Truncated => "save the drawing again: its end is missing".into(),
            Warning::UnitAssumed { unit, .. } => {
                let other = if *unit == DrawingUnit::Inch { "mm" } else { "in" };
                format!("if that is wrong: --dxf-units {other}")
            }
            Warning::Defect(defect) => defect.help(),
            Warning::OutlineOfPart { .. } => {
                "if it is the outline of the part and not a pocket: --skip-outer".into()
            }
            Warning::ArcsDropped { .. } => "nothing to do, or ask for more --decimals".into(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Warning::NotRead { entity, count, layer: Some(layer) } => {
                write!(f, "{entity}: {count} on layer `{layer}` not read")
            }
            Warning::NotRead { entity, count, .. } => write!(f, "{entity}: {count} skipped, no outline"),
            Warning::NotFitted { entity, handle, reason, count, .. } => {
                let named = Named { entity, handle: *handle, place: None, count: *count };
                write!(f, "{named} skipped: {reason}")
            }
            Warning::EntitySkipped { entity, handle, place, reason, count, .. } => {
                write!(
                    f,
                    "{} skipped: {reason}",
                    Named { entity, handle: *handle, place: Some(*place), count: *count }
                )
            }
            Warning::Simplified { entity, handle, place, how, count, .. } => {
                write!(f, "{}: {how}", Named { entity, handle: *handle, place: Some(*place), count: *count })
            }
            Warning::Mended { what, count, place } => write!(f, "{what}: {count}, the first in {place}"),
            Warning::LayerSkipped { layer, state, count } => {
                write!(f, "layer `{layer}` is {state}: {count} skipped")
            }
            Warning::InvisibleSkipped { count } => write!(f, "invisible entities: {count} skipped"),
            Warning::PaperSpaceSkipped { count } => write!(f, "entities of paper space: {count} skipped"),
            Warning::NoSuchLayer { pattern, .. } => write!(f, "no entity lies on a layer `{pattern}`"),
            Warning::NoSuchColor { color, .. } => write!(f, "no entity has the color {color}"),
            Warning::ImplausibleSize { width, height, job, unit, large, .. } => {
                let job = DrawingUnit::from(*job);
                let size = if *large { "large" } else { "small" };
                let [width, height] = [width, height].map(|w| short(*w));
                write!(
                    f,
                    "the part is {width} by {height} {job}, which is very {size}; the drawing is read in {unit}"
                )
            }
            Warning::OriginMoved { to } => write!(f, "the origin is moved to {to} of the drawing"),
            Warning::Truncated => write!(f, "the file ends without its end mark"),
            Warning::UnitAssumed { unit, flagged: true, .. } => {
                write!(f, "the drawing does not say its unit; {unit} assumed after its measurement flag")
            }
            Warning::UnitAssumed { unit, .. } => {
                write!(f, "the drawing does not say its unit; {unit} assumed")
            }
            Warning::Defect(defect) => write!(f, "{defect}"),
            Warning::OutlineOfPart { .. } => {
                write!(f, "one outermost contour holds nearly everything; it is cleared as a pocket")
            }
            Warning::ArcsDropped { count, .. } => {
                let arcs = if *count == 1 { "arc is" } else { "arcs are" };
                write!(f, "{count} {arcs} shorter than the last decimal, dropped")
            }
        }
    }
}

/// An entity and how many are like it.
struct Named<'a> {
    entity: &'a str,
    handle: Option<u64>,
    place: Option<Place>,
    count: usize,
}

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.entity)?;
        if let Some(handle) = self.handle {
            write!(f, " {handle:X}")?;
        }
        if let Some(place) = self.place {
            write!(f, " ({place})")?;
        }
        if self.count > 1 { write!(f, " and {} more", self.count - 1) } else { Ok(()) }
    }
}

/// A length with six decimals, less zeros at the end.
fn short(length: f64) -> String {
    let text = format!("{length:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
