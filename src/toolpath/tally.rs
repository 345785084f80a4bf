//! What the moves along a long pass amount to: added up side by side, and once for all heights.

use super::Move;
use crate::geom::Element;
use rayon::prelude::*;

/// Elements that are worth a thread. What they amount to depends on it by round-off, so it is the same for
/// any number of threads.
const LEAST: usize = 1 << 10;

/// Moves along elements, one for each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tally {
    /// Of all moves together.
    pub length: f64,
    pub arcs: usize,
}

impl Tally {
    /// Of elements at one height. `None` where they do not follow one another, or one of them is no move, or
    /// more than one.
    pub fn of(elements: &[Element]) -> Option<Tally> {
        let is_next = |pair: &[Element]| pair[0].end == pair[1].start;
        let of_some = |(i, some): (usize, &[Element])| {
            let before =
                i.checked_mul(LEAST)?.checked_sub(1).map_or(some[0].start, |last| elements[last].end);
            let follows = before == some[0].start && some.windows(2).all(is_next);
            let mut tally = follows.then(Tally::default)?;
            for e in some {
                let is_move = e.bulge.abs() <= 1.0 && e.start != e.end;
                tally.add(is_move.then_some(e)?);
            }
            Some(tally)
        };
        let parts: Vec<Option<Tally>> = elements.par_chunks(LEAST).enumerate().map(of_some).collect();
        parts.into_iter().try_fold(Tally::default(), |all, part| {
            part.map(|part| Tally { length: all.length + part.length, arcs: all.arcs + part.arcs })
        })
    }

    fn add(&mut self, e: &Element) {
        match (Move::along(e, 0.0, 1.0), e.center()) {
            (Move::Arc { .. }, Some((_, radius))) => {
                self.arcs += 1;
                self.length += radius * e.sweep().abs();
            }
            _ => self.length += e.chord().length(),
        }
    }
}
