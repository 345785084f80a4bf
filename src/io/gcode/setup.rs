//! What a program needs besides its moves.

use crate::error::Error;
use crate::tolerance::Units;
use serde::{Deserialize, Serialize};

/// Settings of a program. Lengths are in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Setup {
    /// Unit of all lengths: G21 or G20.
    pub units: Units,
    /// Decimals of coordinates, 2 to 6.
    pub decimals: u32,
    /// How arcs are written.
    pub arcs: ArcWords,
    /// Largest distance between an arc and the lines that stand for it, where arcs become lines.
    pub tolerance: f64,
    /// Height of the top of the stock.
    pub top: f64,
    /// Height of rapids above the top.
    pub clearance: f64,
    /// Turns per minute.
    pub spindle: f64,
    /// Seconds to wait for the spindle.
    pub dwell: f64,
    /// T word.
    pub tool_number: u32,
    /// Coolant while the spindle turns.
    pub coolant: Coolant,
    /// Work coordinate system: 54 to 59 for G54 to G59.
    pub wcs: u8,
    /// Whether lines are numbered.
    pub line_numbers: bool,
    /// Comments at the head of the program.
    pub comments: Vec<String>,
}

/// How arcs are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ArcWords {
    /// With the offset of the center from the start.
    #[default]
    Ijk,
    /// With the radius.
    R,
    /// As lines.
    Off,
}

/// Coolant while the spindle turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Coolant {
    /// None.
    #[default]
    Off,
    /// M7.
    Mist,
    /// M8.
    Flood,
}

impl Setup {
    /// The defaults of a job in the given unit.
    pub fn new(units: Units) -> Setup {
        let mm = units == Units::Mm;
        Setup {
            units,
            decimals: if mm { 4 } else { 5 },
            arcs: ArcWords::Ijk,
            tolerance: units.tolerance().fit,
            top: 0.0,
            clearance: if mm { 5.0 } else { 0.2 },
            spindle: 12000.0,
            dwell: 0.0,
            tool_number: 1,
            coolant: Coolant::Off,
            wcs: 54,
            line_numbers: false,
            comments: Vec::new(),
        }
    }

    /// Whether every number is in its range.
    ///
    /// # Errors
    /// The first one that is not.
    pub fn check(&self) -> Result<(), Error> {
        let refuse = |name, value, range| Err(Error::Parameter { name, value, range });
        if !(2..=6).contains(&self.decimals) {
            return refuse("decimals", f64::from(self.decimals), "from 2 to 6");
        }
        if !(54..=59).contains(&self.wcs) {
            return refuse("wcs", f64::from(self.wcs), "from 54 to 59");
        }
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            return refuse("tolerance", self.tolerance, "above 0");
        }
        if !(self.clearance > 0.0 && self.clearance.is_finite()) {
            return refuse("clearance", self.clearance, "above 0");
        }
        // Rounded to whole turns, it must not be 0.
        if !(1.0..=1e6).contains(&self.spindle) {
            return refuse("spindle", self.spindle, "from 1 to 1000000 turns per minute");
        }
        if !(0.0..=3600.0).contains(&self.dwell) {
            return refuse("dwell", self.dwell, "from 0 to 3600 seconds");
        }
        Ok(())
    }

    /// Largest difference between the radii at the written ends of an arc: 0.002 mm.
    pub(super) fn radius_error(&self) -> f64 {
        match self.units {
            Units::Mm => 0.002,
            Units::Inch => 0.002 / 25.4,
        }
    }
}

impl Default for Setup {
    fn default() -> Setup {
        Setup::new(Units::Mm)
    }
}
