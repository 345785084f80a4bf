//! Tells what occurs once from what may occur more often, at the cost of a few bits for each.
//!
//! **Guarantees** that nothing that occurs more often is taken for single. **Does not** guarantee the
//! opposite: two keys may share a bit.

/// Bits for each key: about one in so many is not known to be single although it is.
const BITS: usize = 16;

/// Odd, with bits in no order: the fraction of the golden ratio.
const MIX: u64 = 0x9e37_79b9_7f4a_7c15;

/// Keys that were noted, as bits.
#[derive(Debug)]
pub(super) struct Sieve {
    once: Vec<u64>,
    more: Vec<u64>,
    shift: u32,
}

impl Sieve {
    /// Room for some number of keys.
    pub fn new(count: usize) -> Sieve {
        let bits = (BITS * count).next_power_of_two().max(64);
        let words = vec![0; bits / 64];
        Sieve { once: words.clone(), more: words, shift: 64 - bits.trailing_zeros() }
    }

    /// Word and bit of a key.
    fn place(&self, [a, b]: [u64; 2]) -> (usize, u64) {
        let mixed = (a.wrapping_mul(MIX) ^ b).wrapping_mul(MIX);
        let bit = (mixed ^ (mixed >> 32)).wrapping_mul(MIX) >> self.shift;
        (bit as usize / 64, 1 << (bit % 64))
    }

    /// Notes a key once more.
    pub fn note(&mut self, key: [u64; 2]) {
        let (word, bit) = self.place(key);
        self.more[word] |= self.once[word] & bit;
        self.once[word] |= bit;
    }

    /// Whether a key was never noted; it may not be said although it is so.
    pub fn is_unknown(&self, key: [u64; 2]) -> bool {
        let (word, bit) = self.place(key);
        self.once[word] & bit == 0
    }

    /// Whether a key that was noted was noted once; it may not be said although it is so.
    pub fn is_single(&self, key: [u64; 2]) -> bool {
        let (word, bit) = self.place(key);
        self.more[word] & bit == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_single_keys_are_known_and_no_double_one_is_taken_for_single() {
        for count in [0_u64, 1, 3, 1000] {
            let mut sieve = Sieve::new(count as usize);
            let key = |i: u64| [(i as f64).to_bits(), (0.1 * i as f64).to_bits()];
            (0..count).for_each(|i| sieve.note(key(i)));
            (0..count).step_by(2).for_each(|i| sieve.note(key(i)));
            assert!((0..count).step_by(2).all(|i| !sieve.is_single(key(i)) && !sieve.is_unknown(key(i))));
            let odd = (1..count).step_by(2);
            let single = odd.clone().filter(|&i| sieve.is_single(key(i))).count();
            assert!(4 * single >= 3 * odd.count(), "{single} of {count}");
            let unknown = (count..2 * count).filter(|&i| sieve.is_unknown(key(i))).count();
            assert!(4 * unknown as u64 >= 3 * count, "{unknown} of {count}");
        }
    }
}
