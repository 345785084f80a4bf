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

    /// Appends a letter and its number, given in steps of its last decimal: all decimals, and no sign on zero.
    pub fn word(&mut self, letter: u8, steps: i64, decimals: u32) {
        let at = self.length;
        self.text[at..at + 3].copy_from_slice(&[b' ', letter, b'-']);
        let begin = at + 2 + usize::from(steps < 0);
        let steps = steps.unsigned_abs();
        // Most numbers are short, and the shorter ones are divided faster.
        self.length = match u32::try_from(steps) {
            Ok(steps) => self.short(begin, steps, decimals),
            Err(_) => self.long(begin, steps, decimals),
        };
    }

    fn short(&mut self, begin: usize, steps: u32, decimals: u32) -> usize {
        let digits = 1 + steps.checked_ilog10().unwrap_or(0);
        let point = begin + digits.saturating_sub(decimals).max(1) as usize;
        let end = point + 1 + decimals as usize;
        let mut rest = steps;
        let mut at = end;
        while at > point + 2 {
            at -= 2;
            self.text[at..at + 2].copy_from_slice(&PAIRS[(rest % 100) as usize]);
            rest /= 100;
        }
        while at > point + 1 {
            at -= 1;
            self.text[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        self.text[point] = b'.';
        at = point;
        while at > begin {
            at -= 1;
            self.text[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        end
    }

    fn long(&mut self, begin: usize, steps: u64, decimals: u32) -> usize {
        let digits = 1 + steps.checked_ilog10().unwrap_or(0);
        let point = begin + digits.saturating_sub(decimals).max(1) as usize;
        let end = point + 1 + decimals as usize;
        let whole = fill(&mut self.text[point + 1..end], steps);
        self.text[point] = b'.';
        fill(&mut self.text[begin..point], whole);
        end
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
        line.word(b'X', steps, decimals);
        String::from_utf8(line.text()[2..].to_vec()).unwrap()
    }

    #[test]
    fn numbers_have_all_their_decimals() {
        assert_eq!([written(0, 2), written(-7, 3), written(100, 2)], ["0.00", "-0.007", "1.00"]);
        assert_eq!([written(99_999, 5), written(100_000, 5)], ["0.99999", "1.00000"]);
        assert_eq!([written(-1_234_567, 4), written(12_345, 3)], ["-123.4567", "12.345"]);
    }

    #[test]
    fn short_and_long_numbers_are_written_alike() {
        let limit = i64::from(u32::MAX);
        for decimals in 0..=6 {
            for steps in (0..40).map(|i| 3i64.pow(i)).chain([limit, limit + 1, 9_999, 10_000]) {
                let scale = 10i64.pow(decimals);
                let point = if decimals == 0 { "0." } else { "" };
                let known =
                    format!(" X-{}.{:0width$}", steps / scale, steps % scale, width = decimals as usize);
                let known = if point.is_empty() { known } else { format!(" X-{steps}.") };
                let mut line = Line::new();
                line.begin("");
                line.word(b'X', -steps, decimals);
                assert_eq!(line.text(), known.as_bytes());
            }
        }
    }

    #[test]
    fn the_longest_line_has_room() {
        let mut line = Line::new();
        line.begin("G2");
        b"XYZIJ".iter().for_each(|letter| line.word(*letter, i64::MIN, 6));
        assert!(line.text().ends_with(b" J-9223372036854.775808"));
    }
}
