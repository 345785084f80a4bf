//! The unit of a drawing, and what speaks for it.

use super::{ReadOptions, UnitReason};
use crate::io::{DrawingUnit, Warning};
use crate::tolerance::Units;

/// What the header says.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Header {
    pub insunits: Option<i64>,
    pub measurement: Option<i64>,
}

impl Header {
    /// The unit that the header names.
    pub fn claimed(self) -> Option<DrawingUnit> {
        self.insunits.and_then(DrawingUnit::from_dxf)
    }
}

/// The unit of a drawing and how it is known.
pub(super) struct Unit {
    pub unit: DrawingUnit,
    pub reason: UnitReason,
}

impl Unit {
    /// What the user says counts most, then what the drawing claims.
    pub fn of(header: Header, options: &ReadOptions) -> Unit {
        let flagged = match header.measurement {
            Some(0) => Some(DrawingUnit::Inch),
            Some(1) => Some(DrawingUnit::Millimeter),
            _ => None,
        };
        let signs = [
            (options.dxf_units, UnitReason::Told),
            (header.claimed(), UnitReason::Claimed),
            (options.units.map(DrawingUnit::from), UnitReason::Job),
            (flagged, UnitReason::Flag),
        ];
        let first = signs.into_iter().find_map(|(unit, reason)| Some(Unit { unit: unit?, reason }));
        first.unwrap_or(Unit { unit: DrawingUnit::Millimeter, reason: UnitReason::Assumed })
    }

    /// What the user has to know about it.
    pub fn warning(&self, job: Units) -> Option<Warning> {
        let flagged = self.reason == UnitReason::Flag;
        let assumed = flagged || self.reason == UnitReason::Assumed;
        assumed.then_some(Warning::UnitAssumed { unit: self.unit, job, flagged })
    }
}
