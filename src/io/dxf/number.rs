//! Numbers and names as files write them.

use super::tags::Value;

/// A number in one of the ways that it is written, and whether it had to be mended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reading {
    Plain(f64),
    /// With a decimal comma, or an exponent that begins with a D.
    Mended(f64),
    None,
}

/// Reads a number, finite or not.
pub(super) fn number(value: Value) -> Reading {
    let text = match value {
        Value::Number(number) => return Reading::Plain(number),
        Value::Text(text) => text,
    };
    let Ok(text) = std::str::from_utf8(text) else { return Reading::None };
    if let Ok(number) = text.parse() {
        return Reading::Plain(number);
    }
    // Of two commas one would part thousands: not to be guessed at.
    let commas = text.matches(',').count();
    if commas > 1 || (commas == 1 && text.contains('.')) {
        return Reading::None;
    }
    text.replace(',', ".").replace(['D', 'd'], "E").parse().map_or(Reading::None, Reading::Mended)
}

/// Reads a whole number.
pub(super) fn whole(value: Value) -> Option<i64> {
    match number(value) {
        // Beyond 2^53 it saturates, which no group code takes.
        Reading::Plain(x) | Reading::Mended(x) if x.fract() == 0.0 => Some(x as i64),
        _ => None,
    }
}

/// A name: UTF-8 or else Latin-1, as old files have it, with `\U+00DF` for characters beyond.
pub(super) fn name(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    };
    let mut parts = text.split("\\U+");
    let mut read = parts.next().unwrap_or("").replace('\0', "");
    for part in parts {
        let character = part.get(..4).and_then(|h| u32::from_str_radix(h, 16).ok()).and_then(char::from_u32);
        match character {
            Some(c) => {
                read.push(c);
                read += &part[4..];
            }
            None => {
                read += "\\U+";
                read += part;
            }
        }
    }
    read
}

/// Whether a name has letters of an unknown code page.
pub(super) fn is_foreign(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_err()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        let read = |text: &str| number(Value::Text(text.as_bytes()));
        for (text, value) in [("1.5", 1.5), ("+1.25E+01", 12.5), ("-.5", -0.5), ("3.", 3.0)] {
            assert_eq!(read(text), Reading::Plain(value), "{text}");
        }
        for (text, value) in [("1,5", 1.5), ("1.0D+02", 100.0), ("-2,5d-1", -0.25)] {
            assert_eq!(read(text), Reading::Mended(value), "{text}");
        }
        for text in ["12,5mm", "1,000,000", "1.000,5", "", "1 5", "-1.#IND", "D", ","] {
            assert_eq!(read(text), Reading::None, "{text}");
        }
        assert_eq!((whole(Value::Text(b"70.0")), whole(Value::Number(7.5))), (Some(70), None));
    }

    #[test]
    fn names_are_read_in_all_spellings() {
        assert_eq!(name(b"Au\xDFen"), "Außen");
        assert_eq!(name("Außen".as_bytes()), "Außen");
        assert_eq!(name(b"Au\\U+00DFen"), "Außen");
        assert_eq!(name(b"A\0\\U+D800 \\U+12"), "A\\U+D800 \\U+12");
        assert!(is_foreign(b"Au\xDFen") && !is_foreign("Außen".as_bytes()));
    }
}
