//! Text DXF as tags: pairs of lines, a group code and a value.

/// One pair of lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tag<'a> {
    /// What the value means.
    pub code: i32,
    /// The value without blanks around it.
    pub value: &'a [u8],
    /// Line of the group code in the file, from 1.
    pub line: usize,
}

/// Where the tags of a file stop making sense.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BadTag {
    /// Line in the file, from 1.
    pub line: usize,
    /// What stands there instead of a group code.
    pub found: String,
}

/// The tags of a text DXF. Takes any line ends, blanks around lines and empty lines between pairs.
pub(super) struct Tags<'a> {
    rest: &'a [u8],
    line: usize,
    /// Whether the last value was followed by a line end, so that it is not cut off.
    whole: bool,
}

impl<'a> Tags<'a> {
    pub fn new(text: &'a [u8]) -> Tags<'a> {
        let rest = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        Tags { rest, line: 0, whole: true }
    }

    /// Whether the last value ended with its line.
    pub fn whole(&self) -> bool {
        self.whole
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.line += 1;
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r');
        self.whole = end.is_some();
        let (line, rest) = match end {
            None => (self.rest, &self.rest[self.rest.len()..]),
            Some(i) => {
                let two = self.rest[i] == b'\r' && self.rest.get(i + 1) == Some(&b'\n');
                (&self.rest[..i], &self.rest[i + 1 + usize::from(two)..])
            }
        };
        self.rest = rest;
        Some(line.trim_ascii())
    }
}

impl<'a> Iterator for Tags<'a> {
    type Item = Result<Tag<'a>, BadTag>;

    fn next(&mut self) -> Option<Self::Item> {
        let code = loop {
            let line = self.next_line()?;
            if !line.is_empty() {
                break line;
            }
        };
        let line = self.line;
        let Some(number) = std::str::from_utf8(code).ok().and_then(|c| c.parse().ok()) else {
            let found = String::from_utf8_lossy(&code[..code.len().min(40)]).into_owned();
            self.rest = &[];
            return Some(Err(BadTag { line, found }));
        };
        let value = self.next_line().unwrap_or_else(|| {
            self.whole = false;
            &[]
        });
        Some(Ok(Tag { code: number, value, line }))
    }
}

/// Text of a value: UTF-8, or else Latin-1, as old files have it.
pub(super) fn text(value: &[u8]) -> String {
    match std::str::from_utf8(value) {
        Ok(text) => text.to_owned(),
        Err(_) => value.iter().map(|&b| char::from(b)).collect(),
    }
}

/// Number of a value that can be a coordinate, finite or not; `None` for anything else.
pub(super) fn number<T: std::str::FromStr>(value: &[u8]) -> Option<T> {
    std::str::from_utf8(value).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &[u8]) -> Vec<(i32, String)> {
        Tags::new(text).map(|t| t.unwrap()).map(|t| (t.code, super::text(t.value))).collect()
    }

    #[test]
    fn any_line_end_will_do() {
        let wanted = [(0, "LINE".to_owned()), (8, String::new()), (10, "1.5".to_owned())];
        for text in ["0\nLINE\n8\n\n10\n1.5\n", "0\r\nLINE\r\n8\r\n\r\n10\r\n1.5", "0\rLINE\r8\r\r10\r1.5\r"]
        {
            assert_eq!(all(text.as_bytes()), wanted);
        }
        assert_eq!(all("\u{feff}\n  0 \n\tLINE  \n\n  8\n \n10\n1.5 \n".as_bytes()), wanted);
    }

    #[test]
    fn a_line_that_is_no_group_code_is_named() {
        let mut tags = Tags::new(b"0\nLINE\nAcDbLine\n10\n");
        assert!(tags.next().unwrap().is_ok());
        assert_eq!(tags.next(), Some(Err(BadTag { line: 3, found: "AcDbLine".into() })));
        assert_eq!(tags.next(), None);
    }

    #[test]
    fn a_value_cut_off_by_the_end_of_the_file_is_noticed() {
        let mut tags = Tags::new(b"0\nLINE\n10\n1.");
        assert!(tags.next().is_some() && tags.whole());
        assert!(tags.next().is_some() && !tags.whole());
        let mut tags = Tags::new(b"10\n");
        assert_eq!(tags.next().unwrap().unwrap().value, b"");
        assert!(!tags.whole());
    }

    #[test]
    fn bytes_that_are_no_utf8_are_latin_1() {
        assert_eq!(text(b"Au\xDFen"), "Außen");
        assert_eq!(text("Außen".as_bytes()), "Außen");
        assert_eq!((number::<f64>(b"+1.25E+01"), number::<f64>(b"12,5mm")), (Some(12.5), None));
    }
}
