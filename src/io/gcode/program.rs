//! The text of a program and what is in it.

use super::comment::MAX_LINE;
use crate::error::Error;
use crate::geom::Point;
use serde::{Deserialize, Serialize};

/// Most lines of a program; no controller holds as many.
const MAX_LINES: usize = 50_000_000;

/// A program as text.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Written {
    /// The text, with a line feed after each line.
    pub text: String,
    /// What is in it.
    pub stats: Stats,
}

/// What a program holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stats {
    /// Lines of text.
    pub text_lines: usize,
    /// Rapids (G0).
    pub rapids: usize,
    /// Straight feeds (G1).
    pub lines: usize,
    /// Arcs (G2, G3).
    pub arcs: usize,
    /// Straight feeds left out because their rounded ends coincide.
    pub dropped_lines: usize,
    /// Arcs left out because their rounded ends coincide.
    pub dropped_arcs: usize,
    /// Where the first of those arcs is.
    pub dropped_arc_at: Option<Point>,
    /// Length of the text.
    pub bytes: usize,
}

/// A stretch of a program.
#[derive(Default)]
pub(super) struct Part {
    /// ASCII.
    pub text: Vec<u8>,
    pub stats: Stats,
}

impl Part {
    /// Begins anew, in the same room.
    pub fn clear(&mut self) {
        self.text.clear();
        self.stats = Stats::default();
    }

    /// Appends a line. One that is too long goes without spaces, unless it is a comment.
    pub fn line(&mut self, number: &str, words: &[u8]) -> Result<(), Error> {
        let is_comment = words.starts_with(b"(");
        if !(is_comment || number.is_empty()) {
            self.text.extend_from_slice(number.as_bytes());
        }
        if number.len() + words.len() > MAX_LINE && !is_comment {
            self.text.extend(words.iter().filter(|c| **c != b' '));
        } else {
            self.text.extend_from_slice(words);
        }
        self.text.push(b'\n');
        self.stats.text_lines += 1;
        self.stats.check_length()
    }
}

impl Stats {
    /// Goes on with those of the next part.
    pub(super) fn append(&mut self, part: &Stats) -> Result<(), Error> {
        self.text_lines += part.text_lines;
        self.rapids += part.rapids;
        self.lines += part.lines;
        self.arcs += part.arcs;
        self.dropped_lines += part.dropped_lines;
        self.dropped_arcs += part.dropped_arcs;
        self.dropped_arc_at = self.dropped_arc_at.or(part.dropped_arc_at);
        self.bytes += part.bytes;
        self.check_length()
    }

    fn check_length(&self) -> Result<(), Error> {
        if self.text_lines <= MAX_LINES {
            return Ok(());
        }
        let needed = MAX_LINES as u64 + 1;
        Err(Error::Effort { what: "the program", needed, limit: MAX_LINES as u64 })
    }
}
