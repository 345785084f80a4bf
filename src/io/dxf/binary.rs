//! Binary DXF as tags.
//!
//! A group is a code and a value whose form follows from the code. The code takes two bytes;
//! before release 13 it took one, or 255 and two.

use super::buffer::Buffer;
use super::tags::{Broken, Tag, Value};
use crate::io::Place;
use std::io;

/// How a binary DXF begins.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1A\0";

/// Whether the bytes begin as a binary DXF does.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(SENTINEL)
}

/// The tags of a binary file. What follows a broken one is lost. Raw bytes, such as previews, are
/// left out.
pub(super) struct BinaryTags<'a> {
    buffer: Buffer<'a>,
    /// Whether group codes take two bytes.
    wide: bool,
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

impl<'a> BinaryTags<'a> {
    /// As many bytes tell that it is one, and how wide its codes are.
    pub const HEAD: usize = SENTINEL.len() + 2;

    /// Begins behind the sentinel, which the buffer holds.
    pub fn new(mut buffer: Buffer<'a>) -> BinaryTags<'a> {
        buffer.pass(SENTINEL.len());
        // The first group is 0 and a name, so that a second 0 belongs to the code.
        let wide = buffer.rest().get(1) == Some(&0);
        BinaryTags { buffer, wide }
    }

    /// The next tag; `None` at the end.
    pub fn next(&mut self) -> Result<Option<Tag<'_>>, Broken> {
        loop {
            let place = Place::Byte(self.buffer.passed());
            let Some(code) = self.code()? else { return Ok(None) };
            let Some(form) = Form::of(code) else {
                return Err(Broken::Code { place, found: code.to_string() });
            };
            let code = i32::from(code);
            let value = match form {
                Form::Bytes => {
                    if self.bytes()?.is_none() {
                        return Ok(None);
                    }
                    continue;
                }
                Form::Text => {
                    let Some(length) = self.text_length()? else { return Ok(None) };
                    let text = self.buffer.pass(length);
                    self.buffer.pass(1);
                    Value::Text(self.buffer.at(text).trim_ascii())
                }
                _ => match self.number(form)? {
                    Some(number) => Value::Number(number),
                    None => return Ok(None),
                },
            };
            return Ok(Some(Tag { code, value, place }));
        }
    }

    fn code(&mut self) -> io::Result<Option<u16>> {
        if self.wide {
            return Ok(self.take()?.map(u16::from_le_bytes));
        }
        Ok(match self.take()? {
            Some([255]) => self.take()?.map(u16::from_le_bytes),
            Some([code]) => Some(code.into()),
            None => None,
        })
    }

    fn number(&mut self, form: Form) -> io::Result<Option<f64>> {
        Ok(match form {
            Form::Double => self.take()?.map(f64::from_le_bytes),
            Form::Int8 => self.take()?.map(|b| i8::from_le_bytes(b).into()),
            Form::Int16 => self.take()?.map(|b| i16::from_le_bytes(b).into()),
            Form::Int32 => self.take()?.map(|b| i32::from_le_bytes(b).into()),
            // No number of this size takes part in the geometry.
            Form::Int64 => self.take()?.map(|b| i64::from_le_bytes(b) as f64),
            Form::Text | Form::Bytes => None,
        })
    }

    /// Length of the text that comes next, which ends in a NUL byte.
    fn text_length(&mut self) -> io::Result<Option<usize>> {
        let mut looked = 0;
        loop {
            if let Some(i) = self.buffer.rest()[looked..].iter().position(|&b| b == 0) {
                return Ok(Some(looked + i));
            }
            looked = self.buffer.rest().len();
            if !self.buffer.more()? {
                return Ok(None);
            }
        }
    }

    /// Passes raw bytes.
    fn bytes(&mut self) -> io::Result<Option<()>> {
        let Some([length]) = self.take()? else { return Ok(None) };
        if !self.buffer.has(length.into())? {
            return Ok(None);
        }
        self.buffer.pass(length.into());
        Ok(Some(()))
    }

    fn take<const N: usize>(&mut self) -> io::Result<Option<[u8; N]>> {
        if !self.buffer.has(N)? {
            return Ok(None);
        }
        let range = self.buffer.pass(N);
        Ok(self.buffer.at(range).first_chunk().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tags::Tags;
    use super::*;

    fn line(code: impl Fn(u16) -> Vec<u8>) -> Vec<u8> {
        let mut bytes = SENTINEL.to_vec();
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

    fn all(mut bytes: &[u8]) -> Result<Vec<String>, String> {
        let mut tags = Tags::new(Buffer::new(&mut bytes)).unwrap();
        let mut found = Vec::new();
        loop {
            match tags.next() {
                Ok(None) => return Ok(found),
                Ok(Some(tag)) => found.push(match tag.value {
                    Value::Text(text) => format!("{} {}", tag.code, String::from_utf8_lossy(text)),
                    Value::Number(number) => format!("{} {number}", tag.code),
                }),
                Err(Broken::Code { place, found }) => return Err(format!("{place}: {found}")),
                Err(Broken::Io(e)) => panic!("{e}"),
            }
        }
    }

    const TAGS: [&str; 4] = ["0 LINE", "8 Cut\nhere", "10 0.1", "70 -7"];

    #[test]
    fn codes_of_two_bytes_and_of_one_give_the_same_tags() {
        let narrow = |code: u16| if code < 255 { vec![code as u8] } else { [vec![255], wide(code)].concat() };
        for bytes in [line(wide), line(narrow)] {
            assert!(is_binary(&bytes));
            assert_eq!(all(&bytes).unwrap(), TAGS);
        }
    }

    #[test]
    fn a_group_that_is_cut_off_is_left_out() {
        let bytes = line(wide);
        for cut in SENTINEL.len()..bytes.len() {
            let found = all(&bytes[..cut]).unwrap();
            assert!(found.len() < TAGS.len() && TAGS.map(String::from).starts_with(&found));
        }
    }

    #[test]
    fn a_code_that_is_none_is_named_with_its_place() {
        let mut bytes = line(wide);
        let place = bytes.len();
        bytes.extend(wide(500));
        assert_eq!(all(&bytes), Err(format!("byte {place}: 500")));
        assert!(!is_binary(b"AutoCAD Binary DXF"));
    }
}
