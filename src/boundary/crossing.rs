//! Which contours cross, and where.
//!
//! **Needs** contours whose common places are common vertices. **Guarantees** that contours that
//! are not marked neither cross each other or themselves nor run along each other; where they
//! touch in a vertex, all stay on their sides.
//!
//! **Method.** A contour passes a vertex on a strand. Around a vertex with several strands the
//! ends of strands that do not cross nest like brackets.

use super::chain::Contour;
use super::fan::Fan;
use super::grain::Grain;
use crate::error::Defect;
use crate::geom::{ArcSpline, Element, Point};
use std::collections::{BTreeMap, HashMap};

/// Crossings that are listed; of the others only their number is told.
const LISTED: usize = 100;

/// A passage through a vertex: the path and the number of its vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strand {
    pub path: usize,
    pub vertex: usize,
}

/// A place that is passed more than once.
#[derive(Clone, Debug)]
pub(super) struct Junction {
    pub place: Point,
    pub strands: Vec<Strand>,
    /// Branches around it: `2 s` is where strand `s` leaves, `2 s + 1` where it comes from.
    pub fan: Fan,
}

/// All places that closed paths pass more than once, in the order of their first passages.
pub(super) fn junctions<'a>(
    paths: impl Fn(usize) -> &'a ArcSpline,
    count: usize,
    grain: Grain,
) -> Vec<Junction> {
    let mut group_of: HashMap<(u64, u64), usize> = HashMap::new();
    let mut groups: Vec<Vec<Strand>> = Vec::new();
    for path in 0..count {
        for (vertex, v) in paths(path).vertices.iter().enumerate() {
            let bits = (v.point.x.to_bits(), v.point.y.to_bits());
            let group = *group_of.entry(bits).or_insert(groups.len());
            if group == groups.len() {
                groups.push(Vec::new());
            }
            groups[group].push(Strand { path, vertex });
        }
    }
    let several = groups.into_iter().filter(|g| g.len() > 1);
    several
        .map(|strands| {
            let branches: Vec<Element> =
                strands.iter().flat_map(|s| branches(paths(s.path), s.vertex)).collect();
            Junction { place: branches[0].start, fan: Fan::new(&branches, grain.same), strands }
        })
        .collect()
}

/// The two elements at a vertex, both running away from it.
fn branches(path: &ArcSpline, vertex: usize) -> [Element; 2] {
    let n = path.len();
    [path.element(vertex), path.element((vertex + n - 1) % n).reversed()]
}

/// Contours that cross or run along each other or themselves.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    /// Whether each contour takes part in a crossing.
    pub crosses: Vec<bool>,
    /// Every crossing, or as many as are listed.
    pub defects: Vec<Defect>,
    more: Option<(usize, Point)>,
}

impl Crossings {
    /// Finds all crossings of contours that have been arranged.
    pub fn of(contours: &[Contour], grain: Grain) -> Crossings {
        let junctions = junctions(|i| &contours[i].path, contours.len(), grain);
        let mut found = Crossings { crosses: vec![false; contours.len()], ..Crossings::default() };
        let overlaps = overlaps(contours, &junctions, grain);
        overlaps.iter().for_each(|(&(a, b), &place)| found.note(a, b, place));
        for junction in &junctions {
            for (a, b) in junction.crossings() {
                // Where branches coincide, their order means nothing.
                if !(junction.fan.ambiguous && overlaps.contains_key(&(a, b))) {
                    found.note(a, b, junction.place);
                }
            }
        }
        if let Some((count, at)) = found.more {
            found.defects.push(Defect::MoreCrossings { count, at });
        }
        found
    }

    fn note(&mut self, a: usize, b: usize, at: Point) {
        self.crosses[a] = true;
        self.crosses[b] = true;
        if self.defects.len() < LISTED {
            self.defects.push(if a == b { Defect::SelfCrossing { at } } else { Defect::Crossing { at } });
        } else {
            self.more.get_or_insert((0, at)).0 += 1;
        }
    }
}

impl Junction {
    /// Pairs of paths whose strands cross here, each once.
    fn crossings(&self) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        for strand in self.fan.order.iter().map(|branch| branch / 2) {
            let Some(at) = open.iter().rposition(|&s| s == strand) else {
                open.push(strand);
                continue;
            };
            // Strands opened since and not yet closed have their other ends beyond this one.
            found.extend(open[at + 1..].iter().map(|&other| {
                let (a, b) = (self.strands[strand].path, self.strands[other].path);
                (a.min(b), a.max(b))
            }));
            open.remove(at);
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// For each pair of contours with coinciding elements, or contour with two of them, one place.
fn overlaps(contours: &[Contour], junctions: &[Junction], grain: Grain) -> BTreeMap<(usize, usize), Point> {
    // Numbers of vertices: that of the junction, or one of their own.
    let mut own = junctions.len()..;
    let mut number: Vec<Vec<usize>> =
        contours.iter().map(|c| own.by_ref().take(c.path.vertices.len()).collect()).collect();
    for (junction, j) in junctions.iter().enumerate() {
        j.strands.iter().for_each(|s| number[s.path][s.vertex] = junction);
    }
    let mut between: Vec<(usize, usize, f64, usize, Element)> = Vec::new();
    for (i, contour) in contours.iter().enumerate() {
        for (v, e) in contour.path.elements().enumerate() {
            let (a, b) = (number[i][v], number[i][(v + 1) % contour.path.len()]);
            between.push(if a <= b { (a, b, e.bulge, i, e) } else { (b, a, -e.bulge, i, e) });
        }
    }
    between.sort_by(|x, y| (x.0, x.1).cmp(&(y.0, y.1)).then(x.2.total_cmp(&y.2)).then(x.3.cmp(&y.3)));
    let mut found = BTreeMap::new();
    for pair in between.windows(2) {
        let [(a, b, _, i, e), (c, d, _, j, f)] = [pair[0], pair[1]];
        let middle = e.midpoint();
        if (a, b) == (c, d) && middle.distance(f.midpoint()) <= 4.0 * grain.same {
            found.entry((i.min(j), i.max(j))).or_insert(middle);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::arrange::arrange;
    use super::*;
    use crate::geom::{Bounds, point};

    fn crossings(paths: &[ArcSpline]) -> Crossings {
        let bounds = paths.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let grain = Grain::of(&bounds);
        let mut contours: Vec<Contour> =
            paths.iter().enumerate().map(|(rank, p)| Contour { path: p.clone(), rank }).collect();
        arrange(&mut contours, grain).expect("there are few pairs");
        Crossings::of(&contours, grain)
    }

    fn square(x: f64, y: f64, side: f64) -> ArcSpline {
        ArcSpline::closed([(x, y, 0.0), (x + side, y, 0.0), (x + side, y + side, 0.0), (x, y + side, 0.0)])
    }

    #[test]
    fn every_crossing_of_two_contours_is_told() {
        let found = crossings(&[square(0.0, 0.0, 2.0), square(1.0, 1.0, 2.0), square(9.0, 9.0, 1.0)]);
        assert_eq!(found.crosses, [true, true, false]);
        let at = |x, y| Defect::Crossing { at: point(x, y) };
        assert!(found.defects.contains(&at(2.0, 1.0)) && found.defects.contains(&at(1.0, 2.0)));
        assert_eq!(found.defects.len(), 2);
    }

    #[test]
    fn a_bow_tie_crosses_itself() {
        let bow = ArcSpline::closed([(0.0, 0.0, 0.0), (2.0, 2.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0)]);
        assert_eq!(crossings(&[bow]).defects, [Defect::SelfCrossing { at: point(1.0, 1.0) }]);
    }

    #[test]
    fn contours_that_cross_in_a_vertex_cross() {
        let other = ArcSpline::closed([(1.0, -1.0, 0.0), (2.0, 1.0, 0.0), (1.0, 1.0, 0.0)]);
        let through = ArcSpline::closed([(2.0, 2.0, 0.0), (3.0, 4.0, 0.0), (1.0, 1.5, 0.0)]);
        assert!(crossings(&[square(0.0, 0.0, 2.0), other]).crosses[0]);
        let found = crossings(&[square(0.0, 0.0, 2.0), through]);
        assert!(found.defects.contains(&Defect::Crossing { at: point(2.0, 2.0) }));
    }

    #[test]
    fn touching_is_no_crossing() {
        let corner = square(2.0, 2.0, 1.0);
        let inside = ArcSpline::closed([(2.0, 2.0, 0.0), (1.0, 1.5, 0.0), (1.5, 1.0, 0.0)]);
        let tangent = ArcSpline::circle(point(1.0, 0.5), 0.5);
        let outside = ArcSpline::circle(point(1.0, -0.5), 0.5);
        let found = crossings(&[square(0.0, 0.0, 2.0), corner, inside, tangent, outside]);
        assert!(found.defects.is_empty(), "{:?}", found.defects);
    }

    #[test]
    fn a_common_side_is_a_crossing_told_once() {
        let found = crossings(&[square(0.0, 0.0, 2.0), square(2.0, 0.5, 1.0)]);
        assert_eq!(found.defects, [Defect::Crossing { at: point(2.0, 1.0) }]);
    }

    #[test]
    fn a_way_there_and_back_is_a_self_crossing() {
        let spike = [
            (0.0, 0.0, 0.0),
            (2.0, 0.0, 0.0),
            (2.0, 1.0, 0.0),
            (4.0, 1.0, 0.0),
            (2.0, 1.0, 0.0),
            (1.0, 3.0, 0.0),
        ];
        assert!(crossings(&[ArcSpline::closed(spike)]).crosses[0]);
    }

    #[test]
    fn of_many_crossings_only_some_are_listed() {
        let mut teeth: Vec<(f64, f64, f64)> =
            (0..400).map(|i| (f64::from(i), f64::from(i % 2), 0.0)).collect();
        teeth.extend([(399.0, 5.0, 0.0), (0.0, 5.0, 0.0)]);
        let bar =
            ArcSpline::closed([(-1.0, 0.5, 0.0), (-1.0, -3.0, 0.0), (500.0, -3.0, 0.0), (500.0, 0.5, 0.0)]);
        let found = crossings(&[ArcSpline::closed(teeth), bar]);
        assert_eq!(found.defects.len(), LISTED + 1);
        assert!(matches!(found.defects[LISTED], Defect::MoreCrossings { count: 300, .. }));
    }
}
