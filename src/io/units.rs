//! The unit that a drawing is drawn in, and the way from it to the unit of the job.
//!
//! A reader converts every length to the unit of the job at the door; behind it nothing is
//! converted any more.

use crate::tolerance::Units;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A unit that a drawing may claim.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DrawingUnit {
    /// 25.4 mm.
    Inch,
    /// 12 in.
    Foot,
    /// 5280 ft; no part is drawn in it.
    Mile,
    /// The millimeter.
    #[default]
    Millimeter,
    /// 10 mm.
    Centimeter,
    /// 1000 mm.
    Meter,
    /// 1000 m, the longest unit of a job.
    Kilometer,
    /// A millionth of an inch.
    Microinch,
    /// A thousandth of an inch.
    Mil,
    /// 36 in.
    Yard,
    /// A ten-millionth of a millimeter.
    Angstrom,
    /// A millionth of a millimeter.
    Nanometer,
    /// A thousandth of a millimeter.
    Micron,
    /// 100 mm.
    Decimeter,
    /// 10 m.
    Decameter,
    /// 100 m.
    Hectometer,
    /// A million kilometers; no part is drawn in it.
    Gigameter,
    /// Mean distance of the earth from the sun; no part is drawn in it.
    AstronomicalUnit,
    /// Way of light in a year; no part is drawn in it.
    LightYear,
    /// 3.26 light years; no part is drawn in it.
    Parsec,
    /// 1200/3937 m, the foot of old land surveys in the United States.
    SurveyFoot,
    /// A twelfth of the survey foot.
    SurveyInch,
    /// Three survey feet.
    SurveyYard,
    /// 5280 survey feet; no part is drawn in it.
    SurveyMile,
}

use DrawingUnit::*;

/// All units in the order of their numbers in a DXF file, from 1, with their names.
const NAMES: [(DrawingUnit, &str); 24] = [
    (Inch, "in"),
    (Foot, "ft"),
    (Mile, "mile"),
    (Millimeter, "mm"),
    (Centimeter, "cm"),
    (Meter, "m"),
    (Kilometer, "km"),
    (Microinch, "microinch"),
    (Mil, "mil"),
    (Yard, "yd"),
    (Angstrom, "angstrom"),
    (Nanometer, "nm"),
    (Micron, "um"),
    (Decimeter, "dm"),
    (Decameter, "dam"),
    (Hectometer, "hm"),
    (Gigameter, "Gm"),
    (AstronomicalUnit, "au"),
    (LightYear, "light-year"),
    (Parsec, "parsec"),
    (SurveyFoot, "survey-ft"),
    (SurveyInch, "survey-in"),
    (SurveyYard, "survey-yd"),
    (SurveyMile, "survey-mile"),
];

impl DrawingUnit {
    /// The unit with a number of the header variable `$INSUNITS`; `None` for 0 (no unit) and
    /// numbers that mean nothing.
    pub fn from_dxf(code: i64) -> Option<DrawingUnit> {
        let index = usize::try_from(code).ok()?.checked_sub(1)?;
        NAMES.get(index).map(|&(unit, _)| unit)
    }

    /// Its short name, as options and messages spell it.
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(unit, _)| *unit == self).map_or("", |&(_, name)| name)
    }

    /// The unit of a job on such a drawing; `None` for lengths beyond a kilometer, in which no
    /// part is drawn.
    pub fn job(self) -> Option<Units> {
        let (_, _, units) = self.ratio()?;
        Some(units)
    }

    /// The unit as a ratio of whole numbers, exact, of the millimeter or the inch.
    fn ratio(self) -> Option<(f64, f64, Units)> {
        // A survey foot is 1200/3937 m; in inches of 25.4 mm its twelfth is 500000/499999.
        let (times, over, units) = match self {
            Millimeter => (1.0, 1.0, Units::Mm),
            Centimeter => (10.0, 1.0, Units::Mm),
            Decimeter => (100.0, 1.0, Units::Mm),
            Meter => (1000.0, 1.0, Units::Mm),
            Decameter => (10_000.0, 1.0, Units::Mm),
            Hectometer => (100_000.0, 1.0, Units::Mm),
            Kilometer => (1_000_000.0, 1.0, Units::Mm),
            Micron => (1.0, 1000.0, Units::Mm),
            Nanometer => (1.0, 1_000_000.0, Units::Mm),
            Angstrom => (1.0, 10_000_000.0, Units::Mm),
            Inch => (1.0, 1.0, Units::Inch),
            Foot => (12.0, 1.0, Units::Inch),
            Yard => (36.0, 1.0, Units::Inch),
            Mil => (1.0, 1000.0, Units::Inch),
            Microinch => (1.0, 1_000_000.0, Units::Inch),
            SurveyInch => (500_000.0, 499_999.0, Units::Inch),
            SurveyFoot => (12.0 * 500_000.0, 499_999.0, Units::Inch),
            SurveyYard => (36.0 * 500_000.0, 499_999.0, Units::Inch),
            Mile | SurveyMile | Gigameter | AstronomicalUnit | LightYear | Parsec => return None,
        };
        Some((times, over, units))
    }
}

impl From<Units> for DrawingUnit {
    fn from(units: Units) -> DrawingUnit {
        match units {
            Units::Mm => Millimeter,
            Units::Inch => Inch,
        }
    }
}

impl fmt::Display for DrawingUnit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for DrawingUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<DrawingUnit, String> {
        let lower = text.to_ascii_lowercase();
        let long = match lower.as_str() {
            "inch" | "inches" => Some(Inch),
            "foot" | "feet" => Some(Foot),
            "yard" | "yards" => Some(Yard),
            "mils" | "thou" => Some(Mil),
            "micron" | "microns" => Some(Micron),
            "meter" | "meters" => Some(Meter),
            "millimeter" | "millimeters" => Some(Millimeter),
            "centimeter" | "centimeters" => Some(Centimeter),
            _ => NAMES.iter().find(|(_, name)| name.eq_ignore_ascii_case(&lower)).map(|&(unit, _)| unit),
        };
        long.ok_or_else(|| {
            let names: Vec<_> =
                NAMES.iter().filter(|(u, _)| u.job().is_some()).map(|&(_, name)| name).collect();
            format!("`{text}` is not a unit of a drawing: {}", names.join(", "))
        })
    }
}

/// Converts lengths of a drawing to the unit of the job, with at most one rounding inside one
/// system of units; the same number always gives the same length, so ends that meet keep meeting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    times: f64,
    over: f64,
}

impl Scale {
    /// No change.
    pub const SAME: Scale = Scale { times: 1.0, over: 1.0 };

    /// From a unit of a drawing; `None` if that is larger than any part.
    pub fn new(from: DrawingUnit, to: Units) -> Option<Scale> {
        let (times, over, system) = from.ratio()?;
        Some(match (system, to) {
            (Units::Mm, Units::Inch) => Scale { times: times * 5.0, over: over * 127.0 },
            (Units::Inch, Units::Mm) => Scale { times: times * 127.0, over: over * 5.0 },
            _ => Scale { times, over },
        })
    }

    /// The same with all lengths multiplied by a factor.
    pub fn times(self, factor: f64) -> Scale {
        Scale { times: self.times * factor, ..self }
    }

    /// A length of the drawing in the unit of the job.
    pub fn length(self, length: f64) -> f64 {
        length * self.times / self.over
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn convert(length: f64, from: DrawingUnit, to: Units) -> f64 {
        Scale::new(from, to).unwrap().length(length)
    }

    #[test]
    fn the_job_is_in_inches_when_the_drawing_says_so() {
        for unit in [Inch, Mil, Foot, Yard, Microinch] {
            assert_eq!(unit.job(), Some(Units::Inch), "{unit}");
        }
        for unit in [Millimeter, Centimeter, Meter, Kilometer, Micron, Nanometer, Angstrom] {
            assert_eq!(unit.job(), Some(Units::Mm), "{unit}");
        }
        for unit in [Mile, Gigameter, Parsec] {
            assert_eq!(unit.job(), None, "{unit}");
        }
    }

    #[test]
    fn lengths_convert_without_drift() {
        assert_eq!(convert(1.0, Inch, Units::Mm), 25.4);
        assert_eq!(convert(25.4, Millimeter, Units::Inch), 1.0);
        assert_eq!(convert(1.27, Centimeter, Units::Mm), 12.7);
        assert_eq!(convert(2500.0, Mil, Units::Inch), 2.5);
        assert_eq!(convert(0.1, Millimeter, Units::Mm), 0.1);
        assert_eq!(convert(3937.0, SurveyFoot, Units::Mm), 1_200_000.0);
    }

    #[test]
    fn a_factor_comes_on_top() {
        assert_eq!(Scale::new(Inch, Units::Mm).unwrap().times(0.5).length(2.0), 25.4);
        assert_eq!(Scale::SAME.times(10.0).length(0.1), 1.0);
    }

    #[test]
    fn numbers_of_the_format_are_understood() {
        assert_eq!(DrawingUnit::from_dxf(1), Some(Inch));
        assert_eq!(DrawingUnit::from_dxf(4), Some(Millimeter));
        assert_eq!(DrawingUnit::from_dxf(20), Some(Parsec));
        assert_eq!(DrawingUnit::from_dxf(24), Some(SurveyMile));
        for nothing in [0, -1, 25, 255] {
            assert_eq!(DrawingUnit::from_dxf(nothing), None);
        }
    }

    #[test]
    fn names_read_back() {
        for (unit, name) in NAMES {
            assert_eq!(name.parse(), Ok(unit));
        }
        assert_eq!("Inches".parse(), Ok(Inch));
        assert!("furlong".parse::<DrawingUnit>().unwrap_err().contains("mm"));
    }
}
