//! Colors of the AutoCAD color index.

use serde::{Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// A color of a drawing, 1 to 255 in the AutoCAD color index; the first ones have names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color(u8);

/// Names of the first colors, from 1.
const NAMES: [&str; 9] = ["red", "yellow", "green", "cyan", "blue", "magenta", "white", "gray", "light-gray"];

impl Color {
    /// The color of a number; `None` for numbers that stand for no color.
    pub fn new(number: i64) -> Option<Color> {
        u8::try_from(number).ok().filter(|n| *n > 0).map(Color)
    }

    /// Its number.
    pub fn number(self) -> u8 {
        self.0
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match NAMES.get(usize::from(self.0) - 1) {
            Some(name) => f.write_str(name),
            None => write!(f, "{}", self.0),
        }
    }
}

/// As its name or its number.
impl Serialize for Color {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl FromStr for Color {
    type Err = String;

    fn from_str(text: &str) -> Result<Color, String> {
        let lower = text.to_ascii_lowercase();
        let same = match lower.as_str() {
            "black" => "white",
            "grey" => "gray",
            name => name,
        };
        let named = NAMES.iter().position(|name| *name == same).map(|i| i as i64 + 1);
        named
            .or_else(|| text.parse().ok())
            .and_then(Color::new)
            .ok_or_else(|| format!("`{text}` is no color: a number from 1 to 255, {}", NAMES.join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_have_numbers_and_some_have_names() {
        for (text, number) in [("red", 1), ("Yellow", 2), ("7", 7), ("black", 7), ("255", 255), ("grey", 8)] {
            assert_eq!(text.parse::<Color>().unwrap().number(), number);
        }
        for text in ["0", "256", "-1", "pink", ""] {
            assert!(text.parse::<Color>().unwrap_err().contains("red"), "{text}");
        }
        assert_eq!([1, 10].map(|n| Color(n).to_string()), ["red", "10"]);
    }
}
