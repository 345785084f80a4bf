//! The moves of a path, stretch by stretch.
//!
//! **Guarantees** the same moves in the same order as a plain list would hold.
//!
//! **Method.** Most moves of a large path are those along its passes, and from height to height these differ in
//! z alone. So a long pass is held as the elements that it runs along, once for all heights, and its moves are
//! made when they are asked for. All other moves are held as they are.

use super::Move;
use crate::geom::Element;
use serde::{Deserialize, Serialize, Serializer};
use std::ops::Range;
use std::sync::Arc;

/// A list of moves. Serialized as that.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(from = "Vec<Move>")]
pub struct Moves {
    loose: Vec<Move>,
    stretches: Vec<Held>,
    count: usize,
}

/// Moves one after the other, as they are held.
#[derive(Clone, Debug)]
struct Held {
    /// How many moves come before.
    before: usize,
    source: Source,
}

/// Where moves come from.
#[derive(Clone, Debug)]
enum Source {
    /// Those in the list from one on.
    Loose(usize),
    /// One along each element, at a height and a rate.
    Along(Arc<Vec<Element>>, f64, f64),
}

/// Moves one after the other: either as they are, or along elements at a height and a rate.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stretch<'a> {
    Loose(&'a [Move]),
    Along(&'a Arc<Vec<Element>>, f64, f64),
}

impl Moves {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The move of that number, counted from 0.
    pub fn get(&self, index: usize) -> Option<Move> {
        if index >= self.count {
            return None;
        }
        let Held { before, source } = &self.stretches[self.stretch_of(index)];
        Some(match source {
            Source::Loose(first) => self.loose[first + index - before],
            Source::Along(elements, z, rate) => Move::along(&elements[index - before], *z, *rate),
        })
    }

    /// The last one.
    pub fn last(&self) -> Option<Move> {
        self.get(self.count.checked_sub(1)?)
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl Iterator<Item = Move> + Clone {
        self.range(0..self.count)
    }

    /// Some of them, in order; none beyond the last.
    pub fn range(&self, range: Range<usize>) -> impl Iterator<Item = Move> + Clone {
        self.held(range).flat_map(|(stretch, part)| {
            let (loose, (elements, z, rate)) = match stretch {
                Stretch::Loose(moves) => (&moves[part], (&[][..], 0.0, 0.0)),
                Stretch::Along(elements, z, rate) => (&[][..], (&elements[part], z, rate)),
            };
            loose.iter().copied().chain(elements.iter().map(move |e| Move::along(e, z, rate)))
        })
    }

    /// Each but the first one, with the one before it.
    pub fn pairs(&self) -> impl Iterator<Item = [Move; 2]> + Clone {
        self.iter().zip(self.range(1..self.count)).map(|(from, to)| [from, to])
    }

    /// All of them as a plain list.
    pub fn to_vec(&self) -> Vec<Move> {
        self.iter().collect()
    }

    /// Appends a move.
    pub fn push(&mut self, m: Move) {
        if !matches!(self.stretches.last(), Some(Held { source: Source::Loose(_), .. })) {
            self.stretches.push(Held { before: self.count, source: Source::Loose(self.loose.len()) });
        }
        self.loose.push(m);
        self.count += 1;
    }

    /// Appends a move along each of some elements, none of which is more than half a circle.
    pub(super) fn push_along(&mut self, elements: Arc<Vec<Element>>, z: f64, rate: f64) {
        let before = self.count;
        self.count += elements.len();
        self.stretches.push(Held { before, source: Source::Along(elements, z, rate) });
    }

    /// Some of the moves as they are held, in order: of what is held along elements, always the whole.
    pub(super) fn stretches(&self, range: Range<usize>) -> impl Iterator<Item = Stretch<'_>> {
        self.held(range).map(|(stretch, part)| match stretch {
            Stretch::Loose(moves) => Stretch::Loose(&moves[part]),
            along => along,
        })
    }

    /// The stretches that hold some of the moves, and which of its moves each.
    fn held(&self, range: Range<usize>) -> impl Iterator<Item = (Stretch<'_>, Range<usize>)> + Clone {
        let range = range.start..range.end.min(self.count);
        let first = if range.is_empty() { self.stretches.len() } else { self.stretch_of(range.start) };
        let rest = (first..self.stretches.len()).take_while(move |&i| self.stretches[i].before < range.end);
        rest.map(move |i| {
            let Held { before, source } = &self.stretches[i];
            let end = self.stretches.get(i + 1).map_or(self.count, |next| next.before);
            let part = range.start.saturating_sub(*before)..range.end.min(end) - before;
            match source {
                Source::Loose(first) => (Stretch::Loose(&self.loose[*first..first + end - before]), part),
                Source::Along(elements, z, rate) => (Stretch::Along(elements, *z, *rate), part),
            }
        })
    }

    /// Which stretch holds a move.
    fn stretch_of(&self, index: usize) -> usize {
        self.stretches.partition_point(|held| held.before <= index) - 1
    }
}

impl PartialEq for Moves {
    fn eq(&self, other: &Moves) -> bool {
        self.iter().eq(other.iter())
    }
}

impl From<Vec<Move>> for Moves {
    fn from(loose: Vec<Move>) -> Moves {
        let count = loose.len();
        let stretches = if count == 0 { vec![] } else { vec![Held { before: 0, source: Source::Loose(0) }] };
        Moves { loose, stretches, count }
    }
}

impl<const N: usize> From<[Move; N]> for Moves {
    fn from(loose: [Move; N]) -> Moves {
        Vec::from(loose).into()
    }
}

impl FromIterator<Move> for Moves {
    fn from_iter<I: IntoIterator<Item = Move>>(moves: I) -> Moves {
        Vec::from_iter(moves).into()
    }
}

impl Serialize for Moves {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::toolpath::Point3;

    fn rapid(x: f64) -> Move {
        Move::Rapid { to: Point3::new(point(x, 0.0), 1.0) }
    }

    /// Moves of all kinds, and the same as a plain list.
    fn both() -> (Moves, Vec<Move>) {
        let square = ArcSpline::closed([(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (4.0, 4.0, 0.0), (0.0, 4.0, -1.0)]);
        let elements: Arc<Vec<Element>> = Arc::new(square.elements().collect());
        let (mut moves, mut plain) = (Moves::default(), Vec::new());
        for z in [-1.0, -2.0] {
            for x in [7.0, 8.0] {
                moves.push(rapid(x));
                plain.push(rapid(x));
            }
            for z in [z, z - 0.5] {
                moves.push_along(elements.clone(), z, 600.0);
                plain.extend(elements.iter().map(|e| Move::along(e, z, 600.0)));
            }
        }
        (moves, plain)
    }

    #[test]
    fn moves_that_are_held_once_are_a_plain_list_to_their_reader() {
        let (moves, plain) = both();
        assert_eq!((moves.len(), moves.last()), (plain.len(), plain.last().copied()));
        assert_eq!(moves.to_vec(), plain);
        assert_eq!(moves, Moves::from(plain.clone()));
        assert!(moves.pairs().eq(plain.windows(2).map(|pair| [pair[0], pair[1]])));
        for begin in 0..=plain.len() {
            assert_eq!(moves.get(begin), plain.get(begin).copied());
            for end in begin..=plain.len() {
                assert_eq!(moves.range(begin..end).collect::<Vec<_>>(), plain[begin..end]);
            }
        }
        assert_eq!(moves.range(3..100).count(), plain.len() - 3);
        assert!(Moves::default().is_empty() && Moves::default().iter().next().is_none());
    }

    #[test]
    fn they_are_stored_as_a_plain_list() {
        let (moves, plain) = both();
        let text = serde_json::to_string(&moves).unwrap();
        assert_eq!(text, serde_json::to_string(&plain).unwrap());
        assert_eq!(serde_json::from_str::<Moves>(&text).unwrap(), moves);
    }
}
