//! Which contours cross, and where.
//!
//! **Needs** contours whose common places are common vertices; open curves may be among them.
//! **Guarantees** that contours that are not marked cross neither each other nor themselves, and that
//! open curves that are not marked cross no contour. Contours may touch in vertices and run along
//! each other: each stays on its side. **Does not** mind open curves that cross each other.
//!
//! **Method.** A contour passes a vertex on a strand; which strands cross at a vertex, or along what they
//! share from there on, says `strands`.

use super::chain::Contour;
use super::grain::Grain;
use super::junction::Junctions;
use crate::error::Defect;
use crate::geom::{ArcSpline, Point};
use std::collections::{BTreeMap, BTreeSet};

/// A loop that reaches less far than this part of the rest of its contour is small.
const SMALL: f64 = 1.0 / 16.0;

/// Crossings that are listed; of the others only their number is told.
const LISTED: usize = 100;

/// Contours that cross each other or themselves, and open curves that cross contours.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    /// Whether each curve takes part in a crossing, or shares a side with a contour that does.
    pub crosses: Vec<bool>,
    /// Every crossing, or as many as are listed.
    pub defects: Vec<Defect>,
    /// Whether any curves run along each other.
    pub are_any_along: bool,
    /// Pairs of contours that cross each other.
    pub pairs: BTreeSet<(usize, usize)>,
    /// Contours that cross themselves, and in which vertices.
    pub own: BTreeMap<usize, Vec<usize>>,
    more: Option<(usize, Point)>,
}

impl Crossings {
    /// Finds all crossings of curves that have been arranged.
    pub fn of(curves: &[Contour], grain: Grain) -> Crossings {
        let paths: Vec<&ArcSpline> = curves.iter().map(|c| &c.path).collect();
        let junctions = Junctions::of(&paths, grain);
        let (crosses, are_any_along) = (vec![false; curves.len()], !junctions.course.is_empty());
        let mut found = Crossings { crosses, are_any_along, ..Crossings::default() };
        for junction in &junctions.all {
            let mut pairs = if junction.is_shared {
                junctions.crossings_along(junction, &paths)
            } else {
                junction.crossings()
            };
            let mut reach: Option<f64> = None;
            for &(s, t) in &pairs {
                let path = junction.strands[s].path;
                if path == junction.strands[t].path {
                    let vertices = [s, t].map(|s| junction.strands[s].vertex);
                    found.own.entry(path).or_default().extend(vertices);
                    if found.defects.len() < LISTED {
                        reach = small_loop(paths[path], vertices).or(reach);
                    }
                }
            }
            pairs.iter_mut().for_each(|(s, t)| {
                let (a, b) = (junction.strands[*s].path, junction.strands[*t].path);
                (*s, *t) = (a.min(b), a.max(b));
            });
            pairs.sort_unstable();
            pairs.dedup();
            pairs.into_iter().for_each(|(a, b)| found.note(&paths, [a, b], junction.place, reach));
        }
        found.spread(&junctions);
        if let Some((count, at)) = found.more {
            found.defects.push(Defect::MoreCrossings { count, at });
        }
        found
    }

    fn note(&mut self, paths: &[&ArcSpline], [a, b]: [usize; 2], at: Point, reach: Option<f64>) {
        if !paths[a].closed || !paths[b].closed {
            // Only an open curve gives way, and only to a contour.
            self.crosses[a] |= !paths[a].closed && paths[b].closed;
            self.crosses[b] |= !paths[b].closed && paths[a].closed;
            return;
        }
        self.crosses[a] = true;
        self.crosses[b] = true;
        if a != b {
            self.pairs.insert((a, b));
        }
        if self.defects.len() < LISTED {
            let own = Defect::SelfCrossing { at, reach };
            self.defects.push(if a == b { own } else { Defect::Crossing { at } });
        } else {
            self.more.get_or_insert((0, at)).0 += 1;
        }
    }

    /// Without a contour that crosses, what shares a side with it is not what was drawn either.
    fn spread(&mut self, junctions: &Junctions) {
        let mut along: Vec<(usize, usize)> =
            junctions.course.iter().map(|(&(path, _), &course)| (course, path)).collect();
        along.sort_unstable();
        along.dedup();
        let mut pairs: Vec<(usize, usize)> =
            along.windows(2).filter(|w| w[0].0 == w[1].0).map(|w| (w[0].1, w[1].1)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut beside: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (a, b) in pairs {
            beside.entry(a).or_default().push(b);
            beside.entry(b).or_default().push(a);
        }
        let mut open: Vec<usize> = beside.keys().copied().filter(|&i| self.crosses[i]).collect();
        while let Some(i) = open.pop() {
            for &j in &beside[&i] {
                if !std::mem::replace(&mut self.crosses[j], true) {
                    open.push(j);
                }
            }
        }
    }
}

/// How far the smaller of the two loops of a closed path between two vertices in one place reaches from
/// there, if it is small against the other.
fn small_loop(path: &ArcSpline, [i, j]: [usize; 2]) -> Option<f64> {
    let (n, at) = (path.vertices.len(), path.vertices[i].point);
    let reach = |from: usize, to: usize| {
        let count = (to + n - from) % n;
        let elements = (from..from + count).map(|k| path.element(k % n));
        elements.map(|e| e.midpoint().distance(at).max(e.end.distance(at))).fold(0.0, f64::max)
    };
    let (one, other) = (reach(i, j), reach(j, i));
    (path.closed && one.min(other) <= SMALL * one.max(other)).then_some(one.min(other))
}

#[cfg(test)]
mod tests {
    use super::super::arrange::arrange;
    use super::*;
    use crate::geom::{Bounds, point};

    fn crossings(paths: &[ArcSpline]) -> Crossings {
        let bounds = paths.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let grain = Grain::of(&bounds);
        let mut contours: Vec<Contour> = paths
            .iter()
            .enumerate()
            .map(|(rank, p)| Contour { path: p.clone(), rank, loose: false })
            .collect();
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
        assert_eq!(crossings(&[bow]).defects, [Defect::SelfCrossing { at: point(1.0, 1.0), reach: None }]);
    }

    #[test]
    fn a_small_loop_is_told_with_a_reach_that_cuts_it_off() {
        let looped = ArcSpline::closed([
            (0.0, 0.0, 0.0),
            (9.0, 0.0, 0.0),
            (9.0, 9.2, 0.0),
            (9.3, 9.2, 0.0),
            (9.3, 9.0, 0.0),
            (0.0, 9.0, 0.0),
        ]);
        let found = crossings(&[looped]).defects;
        let [Defect::SelfCrossing { at, reach: Some(reach) }] = found[..] else { panic!("{found:?}") };
        assert!(at.distance(point(9.0, 9.0)) < 1e-12, "{at:?}");
        assert!((reach - 0.3f64.hypot(0.2)).abs() < 1e-12, "{reach}");
        assert!(found[0].help().ends_with("--join 0.3642"), "{}", found[0].help());
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
    fn a_common_side_is_no_crossing() {
        for other in
            [square(2.0, 0.5, 1.0), square(0.0, 1.0, 1.0), square(2.0, -1.0, 3.0), square(-1.0, -1.0, 3.0)]
        {
            for pair in [[square(0.0, 0.0, 2.0), other.clone()], [other.reversed(), square(0.0, 0.0, 2.0)]] {
                let found = crossings(&pair);
                assert!(found.defects.is_empty(), "{:?}", found.defects);
            }
        }
    }

    #[test]
    fn squares_pushed_over_each_other_along_a_line_cross() {
        let pushed = square(1.0, 0.0, 2.0);
        for other in [pushed.clone(), pushed.reversed()] {
            for pair in [[square(0.0, 0.0, 2.0), other.clone()], [other.clone(), square(0.0, 0.0, 2.0)]] {
                let found = crossings(&pair);
                assert_eq!(found.crosses, [true, true]);
                assert_eq!(found.defects.len(), 2, "{:?}", found.defects);
            }
        }
    }

    #[test]
    fn a_way_there_and_back_is_no_crossing_and_one_through_is() {
        let spike = [
            (0.0, 0.0, 0.0),
            (2.0, 0.0, 0.0),
            (2.0, 1.0, 0.0),
            (4.0, 1.0, 0.0),
            (2.0, 1.0, 0.0),
            (1.0, 3.0, 0.0),
        ];
        assert!(!crossings(&[ArcSpline::closed(spike)]).crosses[0]);
        let through = [
            (0.0, 0.0, 0.0),
            (2.0, 0.0, 0.0),
            (2.0, 1.0, 0.0),
            (4.0, 1.0, 0.0),
            (4.0, 3.0, 0.0),
            (6.0, 3.0, 0.0),
            (6.0, -2.0, 0.0),
            (3.0, -2.0, 0.0),
            (3.0, 1.0, 0.0),
            (2.0, 1.0, 0.0),
            (0.0, 3.0, 0.0),
        ];
        assert!(crossings(&[ArcSpline::closed(through)]).crosses[0]);
        let mut around = through;
        around[2..10].reverse();
        assert!(!crossings(&[ArcSpline::closed(around)]).crosses[0]);
    }

    #[test]
    fn an_open_curve_gives_way_to_a_contour_that_it_crosses() {
        let line = |y: f64| ArcSpline::open([(0.0, y, 0.0), (9.0, y, 0.0)]);
        let plumb = ArcSpline::open([(4.0, 0.0, 0.0), (4.0, 9.0, 0.0)]);
        let found = crossings(&[square(0.0, 0.0, 9.0), square(2.0, 2.0, 1.0), line(2.5), line(5.0), plumb]);
        assert_eq!(found.crosses, [false, false, true, false, false]);
        assert!(found.defects.is_empty());
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
