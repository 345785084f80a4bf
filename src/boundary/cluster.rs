//! Places that are the same to round-off.
//!
//! **Guarantees** that each place is in the first group within whose reach it lies: chains of near
//! places do not run away. **Does not** compare places two by two.
//!
//! **Method.** The first place of each group is filed in a square of a grid. Squares are so wide that
//! hardly any place is near a border, and few groups have room in one. Most places are alone in their
//! square, which a few bits tell.

use super::grain::Grain;
use super::sieve::Sieve;
use crate::geom::Point;
use std::collections::HashMap;

/// Width of a square in round-offs.
const SQUARE: f64 = 64.0;

/// A square of the grid.
type Square = [i64; 2];

/// Groups by their first places.
struct Groups {
    grain: Grain,
    firsts: Vec<Point>,
    /// The newest group of each square; groups of places that are alone are not there.
    newest: HashMap<Square, u32>,
    /// For each group the one before it in the same square.
    before: Vec<Option<u32>>,
}

/// Groups places that are the same to round-off: the group of each and a place of each group.
pub(super) fn cluster(places: &[Point], grain: Grain) -> (Vec<u32>, Vec<Point>) {
    let mut groups = Groups { grain, firsts: Vec::new(), newest: HashMap::new(), before: Vec::new() };
    let mut sieve = Sieve::new(places.len());
    let key = |square: Square| square.map(|c| c as u64);
    places.iter().for_each(|&p| sieve.note(key(groups.square(p))));
    let group_of = places.iter().map(|&p| {
        let own = groups.square(p);
        let is_empty = |square: Square| square == own || sieve.is_unknown(key(square));
        let is_alone = sieve.is_single(key(own)) && groups.around(p).all(is_empty);
        if is_alone { groups.push(p, None) } else { groups.of(p) }
    });
    (group_of.collect(), groups.firsts)
}

impl Groups {
    /// The squares of groups in which a place may be.
    fn around(&self, p: Point) -> impl Iterator<Item = Square> + use<> {
        // Twice the round-off, as the reach of a group is rounded too.
        let around = self.grain.around(p).grown(self.grain.same);
        let (from, to) = (self.square(around.min), self.square(around.max));
        (from[0]..=to[0]).flat_map(move |x| (from[1]..=to[1]).map(move |y| [x, y]))
    }

    /// The group of a place, a new one if it is in none.
    fn of(&mut self, p: Point) -> u32 {
        let mut first = None;
        for square in self.around(p) {
            let mut at = self.newest.get(&square).copied();
            while let Some(group) = at {
                if self.grain.around(self.firsts[group as usize]).contains(p) {
                    first = Some(first.map_or(group, |known: u32| known.min(group)));
                }
                at = self.before[group as usize];
            }
        }
        first.unwrap_or_else(|| {
            let group = self.firsts.len() as u32;
            let before = self.newest.insert(self.square(p), group);
            self.push(p, before)
        })
    }

    fn push(&mut self, p: Point, before: Option<u32>) -> u32 {
        self.firsts.push(p);
        self.before.push(before);
        self.firsts.len() as u32 - 1
    }

    fn square(&self, p: Point) -> Square {
        let width = SQUARE * self.grain.same;
        let number = |c: f64| if width > 0.0 { (c / width).floor() as i64 } else { 0 };
        [number(p.x), number(p.y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    const GRAIN: Grain = Grain { same: 1.0, ulp: 0.03125 };

    #[test]
    fn a_row_of_near_places_does_not_become_one() {
        let row: Vec<Point> = (0..400).map(|i| point(0.75 * f64::from(i), -0.5 * f64::from(i % 2))).collect();
        let (group_of, firsts) = cluster(&row, GRAIN);
        assert_eq!((group_of.len(), firsts.len()), (400, 200));
        assert!(row.iter().zip(&group_of).all(|(p, &g)| p.distance(firsts[g as usize]) < 1.0));
        assert!(group_of.chunks_exact(2).all(|pair| pair[0] == pair[1]));
    }

    #[test]
    fn a_place_between_two_groups_is_in_the_first_also_across_a_border() {
        for border in [0.0, SQUARE, -3.0 * SQUARE] {
            let at = |x: f64| point(border + x, border - x);
            let (group_of, firsts) = cluster(&[at(0.75), at(-0.75), at(0.0), at(-1.5)], GRAIN);
            assert_eq!(group_of, [0, 1, 0, 1]);
            assert_eq!(firsts, [at(0.75), at(-0.75)]);
        }
    }

    #[test]
    fn places_without_round_off_are_one_if_they_are_equal() {
        let grain = Grain { same: 0.0, ulp: 0.0 };
        assert_eq!(cluster(&[point(0.0, 0.0), point(0.0, 0.0)], grain).0, [0, 0]);
    }
}
