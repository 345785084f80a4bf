//! Places that are passed more than once, and what leaves them.
//!
//! **Needs** paths whose common places are common vertices, equal to the last bit, and whose
//! elements coincide from end to end or not at all. **Guarantees** every such place with the cyclic
//! order of the elements around it; elements that coincide are one slot of that order.

use super::fan::Fan;
use super::grain::Grain;
use super::sieve::Sieve;
use crate::geom::{ArcSpline, Element, Point, Vertex};
use std::collections::HashMap;

/// A passage of a path through a vertex, or its end there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strand {
    pub path: usize,
    pub vertex: usize,
    /// The slot that it comes from; `None` where an open path begins.
    pub from: Option<usize>,
    /// The slot that it leaves by; `None` where an open path ends.
    pub to: Option<usize>,
}

/// A place that is passed more than once.
#[derive(Clone, Debug)]
pub(super) struct Junction {
    pub place: Point,
    pub strands: Vec<Strand>,
    /// The slots around it in counter-clockwise order.
    pub fan: Fan,
    /// Where each slot is in that order.
    pub rank: Vec<usize>,
    /// Whether two branches are in one slot.
    pub is_shared: bool,
}

/// An element between two junctions, the lower one first: its bulge from there, its path and number.
type Between = (usize, usize, f64, (usize, usize), Element);

/// All junctions of some paths.
#[derive(Debug, Default)]
pub(super) struct Junctions {
    /// In the order of their first passages.
    pub all: Vec<Junction>,
    /// Junction and strand of each passage: of a path and the number of its vertex.
    pub at: HashMap<(usize, usize), (usize, usize)>,
    /// Elements that coincide with others, by path and number, and the number of their course.
    pub course: HashMap<(usize, usize), usize>,
}

impl Junctions {
    /// Finds the junctions of some paths.
    pub fn of(paths: &[&ArcSpline], grain: Grain) -> Junctions {
        let groups = passages(paths);
        let mut found = Junctions::default();
        for (junction, group) in groups.iter().enumerate() {
            found.at.extend(group.iter().enumerate().map(|(strand, &passage)| (passage, (junction, strand))));
        }
        found.find_courses(paths, grain);
        found.all = groups.iter().map(|g| found.junction(paths, g, grain)).collect();
        found
    }

    fn find_courses(&mut self, paths: &[&ArcSpline], grain: Grain) {
        let mut between: Vec<Between> = Vec::new();
        for &(path, v) in self.at.keys() {
            let n = paths[path].vertices.len();
            let next = (path, (v + 1) % n);
            let (Some(&(a, _)), Some(&(b, _))) = (self.at.get(&(path, v)), self.at.get(&next)) else {
                continue;
            };
            if v < paths[path].len() {
                let e = paths[path].element(v);
                between.push(if a <= b {
                    (a, b, e.bulge, (path, v), e)
                } else {
                    (b, a, -e.bulge, (path, v), e)
                });
            }
        }
        between.sort_by(|x, y| (x.0, x.1).cmp(&(y.0, y.1)).then(x.2.total_cmp(&y.2)).then(x.3.cmp(&y.3)));
        let mut courses = 0;
        for pair in between.windows(2) {
            let [(a, b, _, i, e), (c, d, _, j, f)] = [pair[0], pair[1]];
            if (a, b) == (c, d) && e.midpoint().distance(f.midpoint()) <= MIDDLES * grain.same {
                let course = *self.course.entry(i).or_insert_with(|| {
                    courses += 1;
                    courses - 1
                });
                self.course.insert(j, course);
            }
        }
    }

    fn junction(&self, paths: &[&ArcSpline], passages: &[(usize, usize)], grain: Grain) -> Junction {
        let mut slots: Vec<Element> = Vec::new();
        let mut known: HashMap<usize, usize> = HashMap::new();
        let mut slot_of = |element: (usize, usize), branch: Element| {
            let course = self.course.get(&element);
            let slot = course.and_then(|c| known.get(c)).copied().unwrap_or(slots.len());
            if slot == slots.len() {
                slots.push(branch);
                course.map(|&c| known.insert(c, slot));
            }
            slot
        };
        let strands: Vec<Strand> = passages
            .iter()
            .map(|&(path, vertex)| {
                let (curve, n) = (paths[path], paths[path].vertices.len());
                let before = (vertex > 0 || curve.closed).then(|| (vertex + n - 1) % n);
                let to = (vertex < curve.len()).then(|| slot_of((path, vertex), curve.element(vertex)));
                let from = before.map(|b| slot_of((path, b), curve.element(b).reversed()));
                Strand { path, vertex, from, to }
            })
            .collect();
        let fan = Fan::new(&slots, grain.same);
        let mut rank = vec![0; slots.len()];
        fan.order.iter().enumerate().for_each(|(at, &slot)| rank[slot] = at);
        let branches = strands.iter().flat_map(|s| [s.from, s.to]).flatten().count();
        let (path, vertex) = passages[0];
        let place = paths[path].vertices[vertex].point;
        Junction { place, is_shared: slots.len() < branches, strands, fan, rank }
    }
}

/// Middles of elements that coincide may be farther apart than their ends, by both bulges.
const MIDDLES: f64 = 4.0;

/// For each place that is passed more than once the passages: path and number of the vertex.
fn passages(paths: &[&ArcSpline]) -> Vec<Vec<(usize, usize)>> {
    let bits = |v: &Vertex| [v.point.x.to_bits(), v.point.y.to_bits()];
    let mut sieve = Sieve::new(paths.iter().map(|p| p.vertices.len()).sum());
    paths.iter().flat_map(|p| &p.vertices).for_each(|v| sieve.note(bits(v)));
    let mut all: Vec<([u64; 2], usize, usize)> = Vec::new();
    for (path, curve) in paths.iter().enumerate() {
        let passages = curve.vertices.iter().map(bits).enumerate();
        all.extend(passages.filter(|&(_, b)| !sieve.is_single(b)).map(|(vertex, b)| (b, path, vertex)));
    }
    all.sort_unstable();
    let several = all.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
    let mut groups: Vec<Vec<_>> =
        several.map(|group| group.iter().map(|&(_, path, vertex)| (path, vertex)).collect()).collect();
    groups.sort_unstable();
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Bounds;

    #[test]
    fn elements_that_coincide_are_one_slot() {
        let square = ArcSpline::closed([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]);
        let beside = ArcSpline::closed([(1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (3.0, 0.0, 0.0)]);
        let line = ArcSpline::open([(1.0, 1.0, 0.0), (2.0, 2.0, 0.0)]);
        let grain = Grain::of(&Bounds::around([crate::geom::point(3.0, 3.0)]));
        let found = Junctions::of(&[&square, &beside, &line], grain);
        let slots: Vec<usize> = found.all.iter().map(|j| j.rank.len()).collect();
        assert_eq!(slots, [3, 4]);
        assert!(found.all.iter().all(|j| j.is_shared));
        assert_eq!(found.course.len(), 2);
        let end = found.all[1].strands[2];
        assert_eq!((end.path, end.from, end.to.is_some()), (2, None, true));
    }
}
