//! A file as tags: a group code and a value, whether it is text or binary.

use super::binary::{BinaryTags, is_binary};
use super::buffer::Buffer;
use crate::io::Place;
use std::io;
use std::ops::Range;

/// One group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tag<'a> {
    /// What the value means.
    pub code: i32,
    pub value: Value<'a>,
    /// Where it stands in the file.
    pub place: Place,
}

/// A value: text as it is written, without blanks around it, or a number of a binary file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value<'a> {
    Text(&'a [u8]),
    Number(f64),
}

impl<'a> Value<'a> {
    /// Its text; nothing for a number.
    pub fn text(self) -> &'a [u8] {
        match self {
            Value::Text(text) => text,
            Value::Number(_) => b"",
        }
    }
}

/// Why the tags of a file end before it does.
#[derive(Debug)]
pub(super) enum Broken {
    /// The file cannot be read on.
    Io(io::Error),
    /// No group code stands where one should.
    Code { place: Place, found: String },
}

impl From<io::Error> for Broken {
    fn from(e: io::Error) -> Broken {
        Broken::Io(e)
    }
}

/// The tags of a file of either form.
pub(super) enum Tags<'a> {
    Text(TextTags<'a>),
    Binary(BinaryTags<'a>),
}

impl<'a> Tags<'a> {
    /// Begins at the first byte.
    pub fn new(mut buffer: Buffer<'a>) -> io::Result<Tags<'a>> {
        buffer.has(BinaryTags::HEAD)?;
        if is_binary(buffer.rest()) {
            return Ok(Tags::Binary(BinaryTags::new(buffer)));
        }
        if buffer.rest().starts_with(b"\xEF\xBB\xBF") {
            buffer.pass(3);
        }
        Ok(Tags::Text(TextTags { buffer, line: 0, returned: false, blanks: None }))
    }

    /// The next tag; `None` at the end.
    pub fn next(&mut self) -> Result<Option<Tag<'_>>, Broken> {
        match self {
            Tags::Text(tags) => tags.next(),
            Tags::Binary(tags) => tags.next(),
        }
    }

    /// How many blank lines stood in the place of group codes, and where the first one.
    pub fn blanks(&self) -> Option<(usize, Place)> {
        match self {
            Tags::Text(tags) => tags.blanks,
            Tags::Binary(_) => None,
        }
    }
}

/// The tags of a text: pairs of lines. Takes any line ends, and blanks around lines.
pub(super) struct TextTags<'a> {
    buffer: Buffer<'a>,
    line: u64,
    /// Whether the last line ended in a carriage return, so that a line feed belongs to it.
    returned: bool,
    blanks: Option<(usize, Place)>,
}

impl TextTags<'_> {
    fn next(&mut self) -> Result<Option<Tag<'_>>, Broken> {
        let mut skipped = 0;
        let (code, place) = loop {
            let Some(line) = self.line()? else { return Ok(None) };
            let (text, place) = (trimmed(self.buffer.at(line)), Place::Line(self.line));
            // The end mark of old systems.
            if text == b"\x1A" {
                return Ok(None);
            }
            if text.is_empty() {
                skipped += 1;
                continue;
            }
            let Some(code) = group_code(text) else {
                let found = String::from_utf8_lossy(&text[..text.len().min(40)]).into_owned();
                return Err(Broken::Code { place, found });
            };
            break (code, place);
        };
        if skipped > 0 {
            let Place::Line(line) = place else { return Ok(None) };
            self.blanks.get_or_insert((0, Place::Line(line - skipped))).0 += skipped as usize;
        }
        let value = self.line()?;
        let value = value.map_or(&b""[..], |line| trimmed(self.buffer.at(line)));
        Ok(Some(Tag { code, value: Value::Text(value), place }))
    }

    /// Where the next line lies in the buffer.
    fn line(&mut self) -> io::Result<Option<Range<usize>>> {
        let mut looked = 0;
        loop {
            if self.returned && !self.buffer.rest().is_empty() {
                let feed = self.buffer.rest()[0] == b'\n';
                self.buffer.pass(usize::from(feed));
                self.returned = false;
            }
            let rest = self.buffer.rest();
            if let Some(i) = rest[looked..].iter().position(|&b| b == b'\n' || b == b'\r') {
                let length = looked + i;
                self.returned = rest[length] == b'\r';
                self.line += 1;
                let line = self.buffer.pass(length);
                self.buffer.pass(1);
                return Ok(Some(line));
            }
            looked = rest.len();
            if !self.buffer.more()? {
                if looked == 0 {
                    return Ok(None);
                }
                self.line += 1;
                return Ok(Some(self.buffer.pass(looked)));
            }
        }
    }
}

/// Without blanks and NUL bytes around it.
fn trimmed(mut line: &[u8]) -> &[u8] {
    let blank = |b: &u8| b.is_ascii_whitespace() || *b == 0;
    while let Some((_, rest)) = line.split_first().filter(|(b, _)| blank(b)) {
        line = rest;
    }
    while let Some((_, rest)) = line.split_last().filter(|(b, _)| blank(b)) {
        line = rest;
    }
    line
}

/// A group code; one too large for any meaning is as large as can be.
fn group_code(text: &[u8]) -> Option<i32> {
    let (sign, digits) = match text {
        [b'-', digits @ ..] => (-1, digits),
        [b'+', digits @ ..] => (1, digits),
        digits => (1, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let size = digits.iter().fold(0_i32, |n, d| n.saturating_mul(10).saturating_add(i32::from(d - b'0')));
    Some(sign * size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time.
    struct Drops<'a>(&'a [u8]);

    impl io::Read for Drops<'_> {
        fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
            let count = self.0.len().min(into.len()).min(1);
            into[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    type Read = (Vec<(i32, String)>, Option<(usize, Place)>);

    fn all(text: &[u8]) -> Read {
        let mut source = Drops(text);
        let mut tags = Tags::new(Buffer::new(&mut source)).unwrap();
        let mut found = Vec::new();
        while let Some(tag) = tags.next().unwrap() {
            found.push((tag.code, String::from_utf8_lossy(tag.value.text()).into_owned()));
        }
        (found, tags.blanks())
    }

    #[test]
    fn any_line_end_will_do() {
        let wanted = [(0, "LINE".to_owned()), (8, String::new()), (10, "1.5".to_owned())];
        for text in [
            "0\nLINE\n8\n\n10\n1.5\n",
            "0\r\nLINE\r\n8\r\n\r\n10\r\n1.5",
            "0\rLINE\r8\r\r10\r1.5\r",
            "0\rLINE\n8\r\n\r10\n1.5\r\n",
        ] {
            assert_eq!(all(text.as_bytes()), (wanted.to_vec(), None), "{text:?}");
        }
        let (found, blanks) = all("\u{feff}\n  0 \n\tLINE  \n\n  8\n \n10\0\n\x001.5 \n".as_bytes());
        assert_eq!((&found[..], blanks), (&wanted[..], Some((2, Place::Line(1)))));
    }

    #[test]
    fn a_line_that_is_no_group_code_is_named() {
        let mut source = &b"0\nLINE\nAcDbLine\n10\n"[..];
        let mut tags = Tags::new(Buffer::new(&mut source)).unwrap();
        assert!(tags.next().unwrap().is_some());
        match tags.next() {
            Err(Broken::Code { place: Place::Line(3), found }) => assert_eq!(found, "AcDbLine"),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn codes_of_any_size_are_codes() {
        for (text, code) in
            [("0", Some(0)), ("-5", Some(-5)), ("99999999999", Some(i32::MAX)), ("1071", Some(1071))]
        {
            assert_eq!(group_code(text.as_bytes()), code);
        }
        for text in ["10.0", "", "-", "X", "1 0"] {
            assert_eq!(group_code(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_file_may_end_anywhere() {
        assert_eq!(all(b"0\nLINE\n10\n1.").0[1], (10, "1.".into()));
        assert_eq!(all(b"10\n").0, [(10, String::new())]);
        assert_eq!(all(b"0\nEOF\n\x1A").0.len(), 1);
    }
}
