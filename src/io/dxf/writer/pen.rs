//! Tags: a group code and a value, each on its line.

use crate::toolpath::Point3;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes tags and counts handles.
pub(super) struct Pen<'a> {
    out: &'a mut dyn Write,
    next_handle: u64,
    number: String,
}

impl Pen<'_> {
    /// A pen whose next handle is this one.
    pub fn new(out: &mut dyn Write, next_handle: u64) -> Pen<'_> {
        Pen { out, next_handle, number: String::new() }
    }

    /// The handle of one more object.
    pub fn handle(&mut self) -> u64 {
        self.next_handle += 1;
        self.next_handle - 1
    }

    /// A text, which has no line ends.
    pub fn text(&mut self, code: u16, value: &str) -> io::Result<()> {
        writeln!(self.out, "{code}\n{value}")
    }

    /// Several texts.
    pub fn texts(&mut self, tags: &[(u16, &str)]) -> io::Result<()> {
        tags.iter().try_for_each(|(code, value)| self.text(*code, value))
    }

    /// An integer.
    pub fn integer(&mut self, code: u16, value: i64) -> io::Result<()> {
        writeln!(self.out, "{code}\n{value}")
    }

    /// A handle of an object.
    pub fn reference(&mut self, code: u16, handle: u64) -> io::Result<()> {
        writeln!(self.out, "{code}\n{handle:X}")
    }

    /// A number: the shortest text that reads back to the same bits, with a decimal point, as some
    /// readers take a number without one for an integer.
    ///
    /// # Errors
    /// [`io::ErrorKind::InvalidInput`] if it is not finite, which no reader understands.
    pub fn number(&mut self, code: u16, value: f64) -> io::Result<()> {
        if !value.is_finite() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "a number is not finite"));
        }
        self.number.clear();
        // Writing to a string cannot fail.
        let _ = write!(self.number, "{value:?}");
        if !self.number.contains('.') {
            let end = self.number.find('e').unwrap_or(self.number.len());
            self.number.insert_str(end, ".0");
        }
        writeln!(self.out, "{code}\n{}", self.number)
    }

    /// The three coordinates of a place, from this code on in steps of ten.
    pub fn place(&mut self, code: u16, p: Point3) -> io::Result<()> {
        self.number(code, p.x)?;
        self.number(code + 10, p.y)?;
        self.number(code + 20, p.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> String {
        let mut out = Vec::new();
        Pen::new(&mut out, 0).number(40, value).unwrap();
        String::from_utf8(out).unwrap().strip_prefix("40\n").unwrap().trim_end().to_owned()
    }

    #[test]
    fn numbers_have_a_point_and_read_back_to_the_last_bit() {
        let mut values = vec![0.0, -0.0, 1.0, 1e22, 5e-324, f64::MAX, -1e-7, 0.1 + 0.2, 1.0 / 3.0];
        values.extend((0..1000).map(|i| f64::from(i).exp2().sin() * (f64::from(i % 90) - 45.0).exp2()));
        for value in values {
            let text = number(value);
            assert!(text.contains('.'), "{text}");
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(
            (number(12.5), number(-3.0), number(1e-7)),
            ("12.5".into(), "-3.0".into(), "1.0e-7".into())
        );
    }

    #[test]
    fn what_no_reader_understands_is_refused() {
        for value in [f64::NAN, f64::INFINITY] {
            let error = Pen::new(&mut Vec::new(), 0).number(10, value).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
        }
    }
}
