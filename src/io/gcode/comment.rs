//! Comments that no controller takes for anything else.

/// Most characters in a line: what grbl stores of one.
pub(super) const MAX_LINE: usize = 80;

/// Characters that grbl acts on wherever they stand, and those that begin or end something else.
const ACTIVE: &str = "!~?$%;\"\\";

/// First words that make LinuxCNC act on a comment.
const COMMANDS: [&str; 7] = ["MSG", "DEBUG", "PRINT", "LOG", "PROBE", "PY", "ACTIVE"];

/// Lines of comment that hold the text in plain ASCII, in parentheses, none longer than
/// `MAX_LINE` characters.
pub(super) fn lines(text: &str) -> Vec<String> {
    let plain: String = text.chars().map(plain).collect();
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in plain.split_whitespace() {
        for part in word.as_bytes().chunks(MAX_LINE - 4) {
            let part: String = part.iter().map(|b| char::from(*b)).collect();
            if !line.is_empty() && line.len() + part.len() + 3 > MAX_LINE {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            } else if COMMANDS.iter().any(|c| part.to_ascii_uppercase().starts_with(c)) {
                line.push('-');
            }
            line.push_str(&part);
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines.into_iter().map(|l| format!("({l})")).collect()
}

/// The character itself or one that is harmless.
fn plain(c: char) -> char {
    match c {
        '(' => '[',
        ')' => ']',
        c if c.is_whitespace() => ' ',
        c if c.is_ascii_graphic() && !ACTIVE.contains(c) => c,
        _ => '_',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_plain() {
        assert_eq!(lines("part (left) ü? 50%"), ["(part [left] __ 50_)"]);
        assert_eq!(lines("msg, stop\nlogopen,/etc/x"), ["(-msg, stop logopen,/etc/x)"]);
        assert!(lines(" \n").is_empty());
    }

    #[test]
    fn long_comments_are_broken() {
        let broken = lines(&format!("{} {}", "word ".repeat(40), "x".repeat(200)));
        assert!(broken.len() > 4 && broken.iter().all(|l| l.len() <= MAX_LINE));
        assert!(broken[0].ends_with("word)"));
    }
}
