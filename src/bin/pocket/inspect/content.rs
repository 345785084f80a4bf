//! What the file holds: unit, layers, kinds.

use medial::io::DrawingUnit;
use medial::io::dxf::{Drawing, KindCount, LayerContent, UnitReason};
use serde::Serialize;
use std::collections::BTreeMap;

/// What a file holds, whether it takes part or not.
#[derive(Debug, Serialize)]
pub struct Content {
    pub version: Option<String>,
    pub release: Option<&'static str>,
    pub binary: bool,
    /// The unit of the drawing.
    pub unit: UnitReport,
    pub layers: Vec<LayerContent>,
    pub kinds: BTreeMap<String, KindCount>,
}

/// The unit of a drawing.
#[derive(Debug, Serialize)]
pub struct UnitReport {
    pub claimed: Option<DrawingUnit>,
    pub taken: DrawingUnit,
    pub reason: UnitReason,
}

impl Content {
    /// Of a drawing that was read.
    pub fn of(drawing: &Drawing) -> Content {
        let inventory = &drawing.inventory;
        let kinds = inventory.kinds().into_iter().map(|(kind, count)| (kind.to_owned(), count));
        Content {
            version: inventory.version.clone(),
            release: inventory.release(),
            binary: inventory.binary,
            unit: UnitReport { claimed: inventory.claimed, taken: inventory.unit, reason: inventory.reason },
            kinds: kinds.collect(),
            layers: inventory.layers.clone(),
        }
    }
}
