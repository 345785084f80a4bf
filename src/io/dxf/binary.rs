//! Binary DXF as text DXF, so that there is one reader for both.
//!
//! A pair is a group code and a value whose form follows from the code. The code takes two bytes;
//! before release 13 it took one, or 255 and two.

/// How a binary DXF begins; a line end, 1A and 00 follow.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF";

/// Whether the bytes begin as a binary DXF does.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(SENTINEL)
}

/// The same pairs as text; what follows a broken pair is lost, and with it the end mark. Pairs of
/// raw bytes, such as previews, are left out.
///
/// # Errors
///
/// The place of a group code that the format does not know.
pub(super) fn to_text(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let rest = bytes.strip_prefix(SENTINEL).unwrap_or(bytes);
    let rest = rest.strip_prefix(b"\r").unwrap_or(rest);
    let rest = rest.strip_prefix(b"\n\x1A\0").ok_or("it says to be binary, but does not begin so")?;
    // The first pair is 0 and a name, so that a second 0 belongs to the code.
    let mut pairs = Pairs { rest, wide: rest.get(1) == Some(&0) };
    let mut text = Vec::with_capacity(bytes.len());
    while let Some(code) = pairs.code() {
        let form = Form::of(code).ok_or_else(|| {
            format!("byte {} holds group code {code}, which is none", bytes.len() - pairs.rest.len())
        })?;
        let Some(value) = pairs.value(form) else { break };
        if form != Form::Bytes {
            text.extend_from_slice(format!("{code}\n").as_bytes());
            text.extend(value.into_iter().map(|b| if matches!(b, b'\r' | b'\n') { b' ' } else { b }));
            text.push(b'\n');
        }
    }
    Ok(text)
}

/// Form of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Text,
    Double,
    Int8,
    Int16,
    Int32,
    Int64,
    Bytes,
}

impl Form {
    fn of(code: u16) -> Option<Form> {
        Some(match code {
            310..=319 | 1004 => Form::Bytes,
            0..=9 | 100..=109 | 300..=309 | 320..=369 | 390..=399 | 410..=419 => Form::Text,
            430..=439 | 470..=481 | 999..=1009 => Form::Text,
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Form::Double,
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Form::Int16,
            90..=99 | 420..=429 | 440..=459 | 1071 => Form::Int32,
            160..=169 => Form::Int64,
            290..=299 => Form::Int8,
            _ => return None,
        })
    }
}

struct Pairs<'a> {
    rest: &'a [u8],
    /// Whether group codes take two bytes.
    wide: bool,
}

impl Pairs<'_> {
    fn code(&mut self) -> Option<u16> {
        if self.wide {
            return self.take().map(u16::from_le_bytes);
        }
        match self.take()? {
            [255] => self.take().map(u16::from_le_bytes),
            [code] => Some(code.into()),
        }
    }

    /// The next value as text; `None` if the file ends in it.
    fn value(&mut self, form: Form) -> Option<Vec<u8>> {
        let text = match form {
            Form::Text => {
                let end = self.rest.iter().position(|&b| b == 0)?;
                let text = self.rest[..end].to_vec();
                self.rest = &self.rest[end + 1..];
                return Some(text);
            }
            Form::Bytes => {
                let [length] = self.take()?;
                self.rest = self.rest.get(usize::from(length)..)?;
                return Some(Vec::new());
            }
            Form::Double => f64::from_le_bytes(self.take()?).to_string(),
            Form::Int8 => i8::from_le_bytes(self.take()?).to_string(),
            Form::Int16 => i16::from_le_bytes(self.take()?).to_string(),
            Form::Int32 => i32::from_le_bytes(self.take()?).to_string(),
            Form::Int64 => i64::from_le_bytes(self.take()?).to_string(),
        };
        Some(text.into_bytes())
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*taken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(code: impl Fn(u16) -> Vec<u8>) -> Vec<u8> {
        let mut bytes = b"AutoCAD Binary DXF\r\n\x1A\0".to_vec();
        for (number, value) in [(0, "LINE"), (8, "Cut\nhere")] {
            bytes.extend([code(number), value.into(), vec![0]].concat());
        }
        bytes.extend([code(10), 0.1_f64.to_le_bytes().to_vec()].concat());
        bytes.extend([code(310), vec![3, 0, 10, 0]].concat());
        bytes.extend([code(70), (-7_i16).to_le_bytes().to_vec()].concat());
        bytes
    }

    fn wide(code: u16) -> Vec<u8> {
        code.to_le_bytes().to_vec()
    }

    const TEXT: &str = "0\nLINE\n8\nCut here\n10\n0.1\n70\n-7\n";

    #[test]
    fn codes_of_two_bytes_and_of_one_give_the_same_text() {
        let narrow = |code: u16| if code < 255 { vec![code as u8] } else { [vec![255], wide(code)].concat() };
        for bytes in [line(wide), line(narrow)] {
            assert!(is_binary(&bytes));
            assert_eq!(String::from_utf8(to_text(&bytes).unwrap()).unwrap(), TEXT);
        }
    }

    #[test]
    fn a_pair_that_is_cut_off_is_left_out() {
        let bytes = line(wide);
        for cut in 22..bytes.len() {
            let text = String::from_utf8(to_text(&bytes[..cut]).unwrap()).unwrap();
            assert!(TEXT.starts_with(&text) && text.len() < TEXT.len());
        }
    }

    #[test]
    fn a_code_that_is_none_is_named_with_its_place() {
        let mut bytes = line(wide);
        bytes.extend(wide(500));
        let place = bytes.len();
        assert_eq!(to_text(&bytes), Err(format!("byte {place} holds group code 500, which is none")));
        assert!(to_text(b"AutoCAD Binary DXF").is_err());
    }
}
