//! The words of one line, put together in place.

/// Room for a command and the five words of a helix: each two characters, a sign, twenty digits, a point.
const ROOM: usize = 128;

/// The numbers from 0 to 99 as they are written.
const PAIRS: [[u8; 2]; 100] = pairs();

/// Words of a line.
pub(super) struct Line {
    text: [u8; ROOM],
    length: usize,
}

impl Line {
    /// A line without words.
    pub fn new() -> Line {
        Line { text: [0; ROOM], length: 0 }
    }

    /// Begins anew, with this word.
    pub fn begin(&mut self, word: &str) {
        self.length = 0;
        self.push(word);
    }

    /// What was put together.
    pub fn text(&self) -> &[u8] {
        &self.text[..self.length]
    }

    /// Appends characters.
    pub fn push(&mut self, text: &str) {
        let end = self.length + text.len();
        self.text[self.length..end].copy_from_slice(text.as_bytes());
        self.length = end;
    }

    /// Appends a number given in steps of its last decimal: all decimals, and no sign on zero.
    pub fn push_steps(&mut self, steps: i64, decimals: u32) {
        if steps < 0 {
            self.push("-");
        }
        let steps = steps.unsigned_abs();
        let digits = 1 + steps.checked_ilog10().unwrap_or(0);
        let point = self.length + digits.saturating_sub(decimals).max(1) as usize;
        let end = point + 1 + decimals as usize;
        let whole = fill(&mut self.text[point + 1..end], steps);
        self.text[point] = b'.';
        fill(&mut self.text[self.length..point], whole);
        self.length = end;
    }
}

/// Fills the room with the last digits of a number; answers what stands before these.
fn fill(room: &mut [u8], mut number: u64) -> u64 {
    let mut places = room.rchunks_exact_mut(2);
    for place in &mut places {
        place.copy_from_slice(&PAIRS[(number % 100) as usize]);
        number /= 100;
    }
    if let [first] = places.into_remainder() {
        *first = b'0' + (number % 10) as u8;
        number /= 10;
    }
    number
}

const fn pairs() -> [[u8; 2]; 100] {
    let mut pairs = [[b'0'; 2]; 100];
    let mut i = 0;
    while i < pairs.len() {
        pairs[i] = [b'0' + (i / 10) as u8, b'0' + (i % 10) as u8];
        i += 1;
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(steps: i64, decimals: u32) -> String {
        let mut line = Line::new();
        line.begin("");
        line.push_steps(steps, decimals);
        String::from_utf8(line.text().to_vec()).unwrap()
    }

    #[test]
    fn numbers_have_all_their_decimals() {
        assert_eq!([written(0, 2), written(-7, 3), written(100, 2)], ["0.00", "-0.007", "1.00"]);
        assert_eq!([written(99_999, 5), written(100_000, 5)], ["0.99999", "1.00000"]);
        assert_eq!([written(-1_234_567, 4), written(12_345, 3)], ["-123.4567", "12.345"]);
    }

    #[test]
    fn the_longest_line_has_room() {
        let mut line = Line::new();
        line.begin("G2");
        for letter in [" X", " Y", " Z", " I", " J"] {
            line.push(letter);
            line.push_steps(i64::MIN, 6);
        }
        assert!(line.text().ends_with(b" J-9223372036854.775808"));
    }
}
