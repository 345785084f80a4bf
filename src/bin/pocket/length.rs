//! Lengths as a user writes them: `2`, `0.5mm`, `0.02in`, and for the step `40%`.

use medial::Units;
use std::str::FromStr;

/// Millimeters in an inch.
const INCH: f64 = 25.4;

/// A number with or without its unit; bare numbers are in the unit of the job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    value: f64,
    unit: Option<Units>,
}

/// The step: a length or a share of the tool diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    Length(Length),
    Percent(f64),
}

impl Length {
    /// In the unit of the job.
    pub fn to(self, units: Units) -> f64 {
        match (self.unit, units) {
            (Some(Units::Inch), Units::Mm) => self.value * INCH,
            (Some(Units::Mm), Units::Inch) => self.value / INCH,
            _ => self.value,
        }
    }

    fn is_above_0(self) -> bool {
        self.value > 0.0
    }
}

impl FromStr for Length {
    type Err = String;

    fn from_str(text: &str) -> Result<Length, String> {
        let text = text.trim();
        let (number, unit) = if let Some(number) = text.strip_suffix("mm") {
            (number, Some(Units::Mm))
        } else if let Some(number) = text.strip_suffix("in") {
            (number, Some(Units::Inch))
        } else {
            (text, None)
        };
        let value = finite(number.trim_end())
            .map_err(|_| "not a length: write a number, perhaps with mm or in after it".to_owned())?;
        Ok(Length { value, unit })
    }
}

/// A length above 0.
pub fn above_0(text: &str) -> Result<Length, String> {
    let length: Length = text.parse()?;
    if length.is_above_0() { Ok(length) } else { Err("must be above 0".into()) }
}

/// A length of 0 or more.
pub fn at_least_0(text: &str) -> Result<Length, String> {
    let length: Length = text.parse()?;
    if length.value >= 0.0 { Ok(length) } else { Err("must be 0 or more".into()) }
}

/// The step: above 0, at most 100%.
pub fn step(text: &str) -> Result<Step, String> {
    let Some(percent) = text.trim().strip_suffix('%') else { return above_0(text).map(Step::Length) };
    let percent =
        finite(percent.trim_end()).map_err(|_| "not a step: write 0.5, 0.02in or 40%".to_owned())?;
    if percent > 0.0 && percent <= 100.0 {
        Ok(Step::Percent(percent))
    } else {
        Err("must be above 0% and at most 100% of the tool diameter".into())
    }
}

/// A number above 0 without unit.
pub fn number_above_0(text: &str) -> Result<f64, String> {
    let value = finite(text.trim())?;
    if value > 0.0 { Ok(value) } else { Err("must be above 0".into()) }
}

/// A number of 0 or more without unit.
pub fn number_at_least_0(text: &str) -> Result<f64, String> {
    let value = finite(text.trim())?;
    if value >= 0.0 { Ok(value) } else { Err("must be 0 or more".into()) }
}

/// A share of something: 0.6 or 60%.
pub fn share(text: &str) -> Result<f64, String> {
    let value = match text.trim().strip_suffix('%') {
        Some(percent) => finite(percent.trim_end())? / 100.0,
        None => finite(text.trim())?,
    };
    if value > 0.0 && value <= 1.0 { Ok(value) } else { Err("must be above 0 and at most 1 (100%)".into()) }
}

/// A number of things.
pub fn whole(text: &str) -> Result<u32, String> {
    text.trim().parse().map_err(|_| "must be a whole number, 0 or more".to_owned())
}

/// An angle between level and upright.
pub fn slope(text: &str) -> Result<f64, String> {
    let value = finite(text.trim())?;
    if value > 0.0 && value < 90.0 { Ok(value) } else { Err("must be above 0 and below 90 degrees".into()) }
}

fn finite(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if value.is_finite() { Ok(value) } else { Err("not a finite number".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_and_bare_numbers_do_not() {
        assert_eq!(above_0("0.5mm").unwrap().to(Units::Mm), 0.5);
        assert_eq!(above_0("0.02in").unwrap().to(Units::Mm), 0.02 * 25.4);
        assert_eq!(above_0("25.4 mm").unwrap().to(Units::Inch), 1.0);
        assert_eq!(above_0("3").unwrap().to(Units::Inch), 3.0);
    }

    #[test]
    fn a_step_may_be_a_share_of_the_tool() {
        assert_eq!(step("40%"), Ok(Step::Percent(40.0)));
        assert!(matches!(step("0.5"), Ok(Step::Length(_))));
    }

    #[test]
    fn numbers_that_mean_nothing_are_refused() {
        for bad in ["", "x", "NaN", "inf", "1e999", "-1", "0", "mm", "1m", "5 %%"] {
            assert!(above_0(bad).is_err() && step(bad).is_err(), "{bad}");
        }
        for bad in ["0%", "-1%", "100.1%", "NaN%", "%"] {
            assert!(step(bad).is_err(), "{bad}");
        }
        assert!(share("60%") == Ok(0.6) && share("0.6") == Ok(0.6) && share("6").is_err());
        assert!(whole("1.5").is_err() && whole("-1").is_err() && whole("3") == Ok(3));
        assert!(step("100%").is_ok() && slope("90").is_err() && number_above_0("nan").is_err());
    }
}
