//! Names, each stored once.

use super::number;
use std::collections::HashMap;
use std::sync::Arc;

/// A name of the drawing, by its number.
pub(super) type Name = u32;

/// All names that were met, in their order.
#[derive(Default)]
pub(super) struct Names {
    numbers: HashMap<Box<[u8]>, Name>,
    texts: Vec<Arc<str>>,
    /// Bytes and number of the name that was asked for last, as it mostly is the next one too.
    last: (Vec<u8>, Name),
}

impl Names {
    /// The number of a name as the file spells it.
    pub fn number(&mut self, bytes: &[u8]) -> Name {
        if !self.texts.is_empty() && self.last.0 == bytes {
            return self.last.1;
        }
        let number = match self.numbers.get(bytes) {
            Some(&number) => number,
            None => {
                let number = self.texts.len() as Name;
                self.numbers.insert(bytes.into(), number);
                self.texts.push(number::name(bytes).into());
                number
            }
        };
        self.last = (bytes.to_vec(), number);
        number
    }

    /// A name in letters.
    pub fn text(&self, name: Name) -> &Arc<str> {
        &self.texts[name as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_stored_once() {
        let mut names = Names::default();
        let numbers: Vec<Name> = [&b""[..], b"Cut", b"Cut", b"", b"cut"].map(|n| names.number(n)).to_vec();
        assert_eq!(numbers, [0, 1, 1, 0, 2]);
        assert_eq!(&**names.text(1), "Cut");
    }
}
