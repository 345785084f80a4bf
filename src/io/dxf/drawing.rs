//! What is read from a file, and what a caller may ask for.

use crate::boundary::Curve;
use crate::io::{DrawingUnit, Warning};
use crate::tolerance::Units;
use serde::Serialize;

/// The curves of a drawing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Drawing {
    /// Name of the file without its folder.
    pub name: String,
    /// The unit of the job, in which all coordinates are.
    pub units: Units,
    /// The curves in the order of the file.
    pub curves: Vec<Curve>,
    /// What was left out or assumed.
    pub warnings: Vec<Warning>,
}

/// What of a drawing to read, and how.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The unit of the job; `None` takes inches for a drawing in inches, mils, feet or yards and
    /// millimeters for any other.
    pub units: Option<Units>,
    /// The unit that the drawing is in, whatever it claims.
    pub dxf_units: Option<DrawingUnit>,
    /// Names of the layers to read, with `*` for anything; all if empty.
    pub layers: Vec<String>,
    /// Names of layers to leave out, with `*` for anything.
    pub skip_layers: Vec<String>,
    /// Whether to read layers that are off or frozen, and invisible entities.
    pub hidden: bool,
}
