//! The unit of a drawing, and what speaks for it.

use super::ReadOptions;
use crate::io::{DrawingUnit, Warning};
use crate::tolerance::Units;

/// What the header says.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Header {
    pub insunits: Option<i64>,
    pub measurement: Option<i64>,
}

/// The unit of a drawing and how it is known.
pub(super) struct Unit {
    pub unit: DrawingUnit,
    /// Assumed, by the measurement flag or without any sign.
    assumed: Option<bool>,
}

impl Unit {
    /// What the user says counts most, then what the drawing claims.
    pub fn of(header: Header, options: &ReadOptions) -> Unit {
        let told = options.dxf_units.or(header.insunits.and_then(DrawingUnit::from_dxf));
        if let Some(unit) = told.or(options.units.map(DrawingUnit::from)) {
            return Unit { unit, assumed: None };
        }
        match header.measurement {
            Some(0) => Unit { unit: DrawingUnit::Inch, assumed: Some(true) },
            Some(1) => Unit { unit: DrawingUnit::Millimeter, assumed: Some(true) },
            _ => Unit { unit: DrawingUnit::Millimeter, assumed: Some(false) },
        }
    }

    /// What the user has to know about it.
    pub fn warning(&self, job: Units) -> Option<Warning> {
        self.assumed.map(|flagged| Warning::UnitAssumed { unit: self.unit, job, flagged })
    }
}
