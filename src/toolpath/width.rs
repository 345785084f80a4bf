//! How wide the passes cut, as far as the axis knows it.
//!
//! **Needs** the axis, the levels, and the order in which the passes are cut.
//! **Guarantees** that the largest step is that between neighboring passes wherever they are, across
//! the axis too, measured on the axis; that cuts of the full width of the tool are told to within an
//! eighth of its radius, and rather too long than too short.
//! **Does not** look at the stretch in front of the tool in corners.
//!
//! **Method.** Where the spoke of a place on a pass reaches the next level, that pass is its neighbor,
//! a step away. Where the axis ends the spoke before, between `d` and the next level `e`, the neighbor
//! is the pass on the other side of the axis: parts of the axis with `d < r < e`, and the offsets on
//! both sides of them. Of the two sides the one that is cut first has no neighbor; it is cut as wide
//! as the tool where the next level is farther than the diameter; it is not looked for where the way up
//! the spoke and on along the axis is shorter (`ascent`).

use super::ascent::Ascents;
use super::crest::{Part, Reach};
use super::indexed::Indexed;
use super::nest::index;
use super::roads::{Roads, Spot};
use super::{Job, Start};
use crate::geom::{Element, Point};
use rayon::prelude::*;
use rstar::RTree;

/// Pieces per tool radius in which lengths are measured.
const PIECES: f64 = 8.0;

/// Most pieces of one part.
const MAX_PIECES: f64 = 4096.0;

/// How wide is cut in a pocket at one height.
#[derive(Clone, Debug, Default)]
pub(super) struct Widths {
    /// Largest distance between neighboring passes, and a place halfway between two of them.
    pub largest_step: f64,
    pub at: Option<Point>,
    /// Length of each pass that is cut at the full width of the tool.
    pub full: Vec<f64>,
    /// What of each pass has no neighbor inside; `None` where that is all of it. Empty if the feed does
    /// not depend on it.
    pub fresh: Vec<Option<Vec<Element>>>,
}

/// What one part of the axis tells.
struct Told {
    apart: f64,
    at: Point,
    full: Option<(usize, f64)>,
    fresh: [Option<(usize, Element)>; 2],
}

impl Widths {
    /// Looks at all passes; `rank` tells which comes before which.
    pub fn new(job: &Job, roads: &Roads, reach: &Reach, rank: &[usize]) -> Widths {
        let mut widths = Widths { full: vec![0.0; rank.len()], ..Widths::default() };
        let outward = reach.nest.outer.iter().zip(&reach.nest.passes);
        for (own, doors) in outward.map(|(doors, pass)| (pass.level, doors)) {
            for door in doors {
                let other = reach.nest.passes[door.pass].level;
                let apart = reach.levels[own].distance - reach.levels[other].distance;
                widths.step(apart, door.at);
            }
        }
        let parts = widths.parts(job, roads, reach);
        let ascents = Ascents::new(roads, reach);
        let is_wide = |part: &Part| {
            let d = reach.levels[part.level].distance;
            let lowest = roads.radii(part.edge).into_iter().fold(f64::INFINITY, f64::min).max(d);
            // Higher up the spoke is longer, but what is left of the way is shorter by more.
            lowest - d + ascents.of(part) > job.tool
        };
        let is_wide: Vec<bool> = parts.par_iter().map(is_wide).collect();
        let is_paced = job.slow < 1.0;
        let asked = parts.iter().zip(&is_wide).filter(|(_, is_wide)| **is_wide || is_paced);
        let trees = trees(reach, asked.map(|(part, _)| part.level));
        let of_part = |(part, &is_wide): (&Part, &bool)| {
            let &Part { level, edge, t, .. } = part;
            let beside = Beside { job, roads, reach, trees: &trees, rank, level, edge };
            beside.tell(t, is_wide)
        };
        let told: Vec<Told> = parts.par_iter().zip(&is_wide).map(of_part).collect();
        if is_paced {
            widths.fresh = vec![Some(Vec::new()); rank.len()];
        }
        for Told { apart, at, full, fresh } in told {
            widths.step(apart, at);
            if let Some((pass, length)) = full {
                widths.full[pass] += length;
            }
            for (pass, element) in fresh.into_iter().flatten() {
                if let Some(Some(of_pass)) = widths.fresh.get_mut(pass) {
                    of_pass.push(element);
                }
            }
        }
        if job.start == Start::Outside {
            widths.count_first(reach, rank);
        }
        widths
    }

    /// The parts of edges that may tell something. Many may lead across many levels, each from corner
    /// to center of a polygon: where the spokes on both sides are nearly one, nothing is wide.
    fn parts(&self, job: &Job, roads: &Roads, reach: &Reach) -> Vec<Part> {
        let edges = (0..roads.edge_count()).into_par_iter();
        let openings: Vec<f64> = edges.map(|edge| roads.opening(edge)).collect();
        let is_plain = |edge: u32, step: f64| {
            let opening = openings[edge as usize];
            let steep = (1.0 - 0.25 * opening * opening).max(0.0).sqrt();
            // No place of the pass is farther from where the edge meets the next level than that part
            // of the edge is long, as the radius grows no faster than the edge.
            let is_near = step < job.tool * steep;
            let is_narrow = opening * step <= self.largest_step && step <= job.radius();
            job.slow == 1.0 && is_near && is_narrow
        };
        reach.between_levels(roads, is_plain)
    }

    fn step(&mut self, apart: f64, at: Point) {
        if apart > self.largest_step {
            (self.largest_step, self.at) = (apart, Some(at));
        }
    }

    /// From the wall inward every pass has its outer neighbor but the first ones, which are cut in full.
    fn count_first(&mut self, reach: &Reach, rank: &[usize]) {
        for (pass, full) in self.full.iter_mut().enumerate() {
            let mut outer = reach.nest.outer[pass].iter();
            let is_first = !outer.any(|door| rank[door.pass] < rank[pass]);
            *full = if is_first { reach.nest.spline(reach.levels, pass).length() } else { 0.0 };
            if let Some(fresh) = self.fresh.get_mut(pass) {
                *fresh = if is_first { None } else { Some(Vec::new()) };
            }
        }
    }
}

/// The levels that are asked for, and those inside of them, made ready for search.
fn trees(reach: &Reach, asked: impl Iterator<Item = usize>) -> Vec<RTree<Indexed>> {
    let mut is_asked = vec![false; reach.levels.len() + 1];
    for level in asked {
        is_asked[level..level + 2].fill(true);
    }
    let tree = |(level, is_asked): (_, &bool)| if *is_asked { index(level) } else { RTree::new() };
    reach.levels.par_iter().zip(&is_asked).map(tree).collect()
}

/// A part of an edge between two levels.
struct Beside<'a> {
    job: &'a Job,
    roads: &'a Roads<'a>,
    reach: &'a Reach<'a>,
    trees: &'a [RTree<Indexed>],
    rank: &'a [usize],
    level: usize,
    edge: u32,
}

impl Beside<'_> {
    fn tell(&self, t: [f64; 2], is_wide: bool) -> Told {
        let (apart, at) = self.apart(t);
        let full = if is_wide { self.full_width(t) } else { None };
        Told { apart, at, full, fresh: self.fresh(t) }
    }

    /// How far the passes on both sides lie apart at most, or from a crest between them.
    fn apart(&self, t: [f64; 2]) -> (f64, Point) {
        let d = self.reach.levels[self.level].distance;
        let mut most = (0.0, Point::default());
        for t in [t[0], 0.5 * (t[0] + t[1]), t[1]] {
            let spot = Spot { edge: self.edge, t };
            let center = self.roads.place(spot);
            let above = self.roads.radius(spot) - d;
            let [a, b] = [0, 1].map(|side| self.roads.on_spoke(self.edge, side, center, d));
            let across = if above > self.job.radius() { above } else { a.distance(b) };
            if across.min(self.job.tool) > most.0 {
                most = (across.min(self.job.tool), center);
            }
        }
        most
    }

    /// What has no neighbor inside, if the feed depends on it.
    fn fresh(&self, t: [f64; 2]) -> [Option<(usize, Element)>; 2] {
        if self.job.slow == 1.0 {
            return [None; 2];
        }
        let d = self.reach.levels[self.level].distance;
        [0, 1].map(|side| {
            let e = self.roads.offset(self.edge, side, t, d);
            self.pass_at(e.midpoint()).map(|pass| (pass, e))
        })
    }

    /// The pass on the side that is cut first, and how long it is cut at full width there.
    fn full_width(&self, t: [f64; 2]) -> Option<(usize, f64)> {
        let d = self.reach.levels[self.level].distance;
        let sides = [0, 1].map(|side| self.roads.offset(self.edge, side, t, d));
        let inner = self.trees.get(self.level + 1);
        let is_beside =
            |p: Point, near: f64, far: f64| inner.map_or(Some(false), |tree| side(tree, p, near, far));
        let lengths = sides.map(|e| full_length(&e, self.job.radius() / PIECES, self.job.tool, is_beside));
        if lengths == [0.0; 2] {
            return None;
        }
        let passes = sides.map(|e| self.pass_at(e.midpoint()));
        let [Some(a), Some(b)] = passes else { return None };
        // On one pass either side may be the first.
        let first = match a == b {
            true => usize::from(lengths[1] > lengths[0]),
            false => usize::from(self.rank[b] < self.rank[a]),
        };
        Some((passes[first]?, lengths[first]))
    }

    fn pass_at(&self, p: Point) -> Option<usize> {
        let near = self.trees[self.level].nearest_neighbor(&[p.x, p.y])?;
        self.reach.nest.pass(self.level, near.index)
    }
}

/// Whether something is nearer to a place than `near`, or nothing nearer than `far`; `None` for neither.
fn side(tree: &RTree<Indexed>, p: Point, near: f64, far: f64) -> Option<bool> {
    let mut answer = Some(false);
    // What is nearest may be at the other end of the pocket: only what is within reach is looked at.
    for found in tree.locate_within_distance([p.x, p.y], far * far) {
        let distance = found.element.distance(p);
        if distance < near {
            return Some(true);
        }
        if distance < far {
            answer = None;
            if near <= 0.0 {
                break;
            }
        }
    }
    answer
}

/// How much of an element is as far as `tool` from all that is cut, looked at in pieces. `is_beside` tells
/// whether something is nearer to a place than one distance, or nothing nearer than another.
fn full_length(
    e: &Element,
    piece: f64,
    tool: f64,
    is_beside: impl Fn(Point, f64, f64) -> Option<bool>,
) -> f64 {
    let length = e.length();
    if !length.is_finite() || length == 0.0 {
        return 0.0;
    }
    // All of a short element is near where one place of it is very near.
    let is_near = |p: Point| is_beside(p, tool, tool) == Some(true);
    if length <= tool && is_near(e.start) && is_near(e.end) && is_near(e.midpoint()) {
        return 0.0;
    }
    let count = (length / piece).ceil().clamp(1.0, MAX_PIECES);
    let mut far = 0;
    // What holds of one piece by some length more holds of all pieces within that length.
    let mut open = vec![(0, count as u64)];
    while let Some((first, end)) = open.pop() {
        let middle = first + (end - first) / 2;
        let around = if end - first > 1 { 0.5 * (end - first + 1) as f64 * (length / count) } else { 0.0 };
        let p = e.point_at((middle as f64 + 0.5) / count);
        match is_beside(p, tool - around, tool + around) {
            Some(true) => {}
            None if end - first > 1 => open.extend([(first, middle), (middle, end)]),
            _ => far += end - first,
        }
    }
    length * far as f64 / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn of_an_element_counts_what_is_far_from_all_that_is_cut() {
        let e = Element::segment(point(0.0, 0.0), point(10.0, 0.0));
        // Cut is all beyond 2 on the left.
        let beside = |p: Point, near: f64, far: f64| match p.x + 2.0 {
            distance if distance < near => Some(true),
            distance if distance < far => None,
            _ => Some(false),
        };
        assert!((full_length(&e, 0.5, 6.0, beside) - 6.0).abs() <= 0.5);
        assert_eq!(full_length(&e, 0.5, 6.0, |_, _, _| Some(true)), 0.0);
        assert_eq!(full_length(&e, 0.5, 6.0, |_, _, _| Some(false)), 10.0);
    }
}
