//! Numbers as they are written: whole multiples of the last decimal.

use crate::error::Error;
use crate::geom::Point;

/// Largest coordinate that can be written, in job units: farther than any machine reaches, and the
/// last of six decimals is still more than the round-off of such a number.
const MAX_COORDINATE: f64 = 1e8;

/// A number of decimals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    scale: f64,
}

impl Grid {
    /// Numbers with so many decimals.
    pub fn new(decimals: u32) -> Grid {
        Grid { scale: f64::from(10u32.pow(decimals)) }
    }

    /// The last decimal, as a length.
    pub fn step(&self) -> f64 {
        1.0 / self.scale
    }

    /// A length in steps of the last decimal.
    pub fn steps(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// The nearest number that can be written, in steps of the last decimal.
    pub fn round(&self, name: &'static str, value: f64) -> Result<i64, Error> {
        if !(-MAX_COORDINATE..=MAX_COORDINATE).contains(&value) {
            return Err(Error::Parameter { name, value, range: "a number from -1e8 to 1e8" });
        }
        // As `f64::round` does it: so far from overflow what is cut off is exact.
        let steps = self.steps(value);
        let whole = steps as i64;
        let rest = steps - whole as f64;
        Ok(whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5))
    }

    /// Both coordinates of a place.
    pub fn round_point(&self, p: Point) -> Result<[i64; 2], Error> {
        Ok([self.round("x", p.x)?, self.round("y", p.y)?])
    }
}

/// A rate, time or speed with at most three decimals and no more digits than needed.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

#[cfg(test)]
mod tests {
    use super::super::line::Line;
    use super::*;

    #[test]
    fn zero_has_no_sign_and_small_numbers_no_exponent() {
        let grid = Grid::new(4);
        let text = |v| {
            let mut line = Line::new();
            line.begin("");
            line.word(b'X', grid.round("x", v).unwrap(), 4);
            String::from_utf8(line.text()[2..].to_vec()).unwrap()
        };
        assert_eq!(text(-0.00001), "0.0000");
        assert_eq!(text(-0.00006), "-0.0001");
        assert_eq!(text(1e-300), "0.0000");
        assert_eq!(text(-12.34567), "-12.3457");
        assert_eq!(text(1e8), "100000000.0000");
    }

    #[test]
    fn halves_are_rounded_away_from_zero() {
        let grid = Grid::new(2);
        let round = |v| grid.round("x", v).unwrap();
        assert_eq!([0.005, -0.005, 1.125, -1.125].map(round), [1, -1, 113, -113]);
        for v in [0.5f64.next_down(), 0.5, 1e6 - 0.5, (1e6f64 - 0.5).next_down(), 99_999_999.995, 1e8] {
            for v in [v, -v, v / 100.0, -v / 100.0] {
                assert_eq!(round(v), grid.steps(v).round() as i64, "{v}");
            }
        }
    }

    #[test]
    fn numbers_that_no_machine_reaches_are_refused() {
        for v in [f64::NAN, f64::INFINITY, -1.1e8] {
            assert!(Grid::new(4).round("x", v).is_err());
        }
    }

    #[test]
    fn rates_are_written_short() {
        assert_eq!((short(600.0), short(23.6225), short(0.5)), ("600".into(), "23.622".into(), "0.5".into()));
    }
}
