//! The bytes of a file, a stretch at a time.

use std::io::{self, ErrorKind, Read};
use std::ops::Range;

/// How much is asked for at once, in bytes.
const STRETCH: usize = 1 << 18;

/// Longest line or value, in bytes: no number or name needs as much, and it is held in memory.
const LONGEST: usize = 1 << 24;

/// A window on a stream that holds no more than the value at hand and a stretch.
pub(super) struct Buffer<'a> {
    source: &'a mut dyn Read,
    bytes: Vec<u8>,
    start: usize,
    end: usize,
    passed: u64,
}

impl<'a> Buffer<'a> {
    pub fn new(source: &'a mut dyn Read) -> Buffer<'a> {
        Buffer { source, bytes: vec![0; STRETCH], start: 0, end: 0, passed: 0 }
    }

    /// What was read and not passed yet.
    pub fn rest(&self) -> &[u8] {
        &self.bytes[self.start..self.end]
    }

    /// How many bytes were passed.
    pub fn passed(&self) -> u64 {
        self.passed
    }

    /// Passes some of the rest; answers where they lie until more is read.
    pub fn pass(&mut self, count: usize) -> Range<usize> {
        let passed = self.start..self.start + count;
        self.start += count;
        self.passed += count as u64;
        passed
    }

    /// Bytes that were passed last.
    pub fn at(&self, range: Range<usize>) -> &[u8] {
        &self.bytes[range]
    }

    /// Reads more behind the rest; `false` when there is no more.
    pub fn more(&mut self) -> io::Result<bool> {
        if self.start > 0 {
            self.bytes.copy_within(self.start..self.end, 0);
            (self.start, self.end) = (0, self.end - self.start);
        }
        if self.end > LONGEST {
            return Err(io::Error::new(ErrorKind::InvalidData, "it holds a line of more than 16 MB"));
        }
        if self.bytes.len() - self.end < STRETCH / 2 {
            self.bytes.resize(2 * self.bytes.len(), 0);
        }
        loop {
            match self.source.read(&mut self.bytes[self.end..]) {
                Ok(count) => {
                    self.end += count;
                    return Ok(count > 0);
                }
                Err(e) if e.kind() == ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
            }
        }
    }

    /// Whether that many bytes can be had.
    pub fn has(&mut self, count: usize) -> io::Result<bool> {
        while self.rest().len() < count {
            if !self.more()? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_longer_than_a_stretch_is_held_whole() {
        let bytes: Vec<u8> = (0..3 * STRETCH).map(|i| i as u8).collect();
        let mut source = bytes.as_slice();
        let mut buffer = Buffer::new(&mut source);
        assert!(buffer.has(5).unwrap());
        let first = buffer.pass(5);
        assert_eq!(buffer.at(first), &bytes[..5]);
        assert!(buffer.has(2 * STRETCH).unwrap());
        let next = buffer.pass(2 * STRETCH);
        assert_eq!(buffer.at(next), &bytes[5..5 + 2 * STRETCH]);
        assert_eq!(buffer.passed(), 5 + 2 * STRETCH as u64);
        assert!(!buffer.has(STRETCH).unwrap());
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let mut source = io::repeat(b'0');
        let mut buffer = Buffer::new(&mut source);
        let refused = loop {
            if let Err(e) = buffer.more() {
                break e;
            }
        };
        assert_eq!(refused.kind(), ErrorKind::InvalidData);
    }
}
