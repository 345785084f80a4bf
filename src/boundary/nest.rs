//! Which loop lies in which.
//!
//! **Needs** simple loops, counter-clockwise, that have nothing in common but vertices, in which
//! they do not cross. **Guarantees** the loop directly around each loop and each other place.
//!
//! **Method.** Every loop has two sides, and sides that bound the same part of the plane are put
//! in one class. Around a common vertex, the sides that face each other between neighboring
//! branches are of one class. A set of loops that touch is placed as a whole, by a ray to the
//! left from its leftmost place, which cannot hit the set itself. No place is tested that lies on
//! a loop, and no loop is compared with all others.

use super::crossing::{Junction, junctions};
use super::grain::Grain;
use super::ray::{Hit, Rays, turned};
use crate::geom::{ArcSpline, Point, Vector};
use std::collections::HashMap;

/// The nesting of loops.
#[derive(Debug)]
pub(super) struct Nest {
    rays: Rays,
    /// The class of every side.
    classes: Vec<usize>,
    /// For each class of sides the loop around it.
    around: Vec<Option<usize>>,
    /// For each loop how many are around it.
    pub depth: Vec<usize>,
    count: usize,
}

/// Classes of sides: the outer side of loop `i` is `2 i`, the inner one `2 i + 1`, and one more
/// stands for what is around everything.
#[derive(Debug)]
struct Classes(Vec<usize>);

impl Classes {
    fn of(&mut self, mut side: usize) -> usize {
        while self.0[side] != side {
            self.0[side] = self.0[self.0[side]];
            side = self.0[side];
        }
        side
    }

    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// The class of every side.
    fn settled(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|side| self.of(side)).collect()
    }
}

impl Nest {
    /// Nests counter-clockwise loops.
    pub fn new(loops: &[ArcSpline], grain: Grain) -> Nest {
        let count = loops.len();
        let rays = Rays::new(loops.iter().enumerate());
        let mut classes = Classes((0..=2 * count).collect());
        let mut touching = Classes((0..count).collect());
        let junctions = junctions(|i| &loops[i], count, grain);
        for junction in &junctions {
            unite_between_branches(junction, &mut classes);
            junction.strands.windows(2).for_each(|s| touching.unite(s[0].path, s[1].path));
        }
        let touching = touching.settled();
        for (leftmost, place, outer) in leftmost_sides(&rays, &touching, &junctions) {
            let around = match rays.first(place, |other| touching[other] == touching[leftmost]) {
                Some(hit) => side_of(hit),
                None => 2 * count,
            };
            classes.unite(outer, around);
        }
        let classes = classes.settled();
        let mut around = vec![None; 2 * count + 1];
        (0..count).for_each(|i| around[classes[2 * i + 1]] = Some(i));
        let mut nest = Nest { rays, classes, around, depth: vec![usize::MAX; count], count };
        nest.measure_depth();
        nest
    }

    fn measure_depth(&mut self) {
        for start in 0..self.count {
            let mut way = vec![];
            let mut at = Some(start);
            while let Some(i) = at.filter(|&i| self.depth[i] == usize::MAX && way.len() <= self.count) {
                way.push(i);
                at = self.parent(i);
            }
            let mut depth = at.map_or(0, |i| self.depth[i].saturating_add(1));
            for &i in way.iter().rev() {
                self.depth[i] = depth;
                depth = depth.saturating_add(1);
            }
        }
    }

    /// The loop directly around a loop.
    pub fn parent(&self, i: usize) -> Option<usize> {
        self.around[self.classes[2 * i]]
    }

    /// The loop directly around a place that is on no loop.
    pub fn around(&self, p: Point) -> Option<usize> {
        let hit = self.rays.first(turned(p), |_| false)?;
        self.around[self.classes[side_of(hit)]]
    }
}

fn side_of(hit: Hit) -> usize {
    2 * hit.owner + usize::from(hit.from_left)
}

/// Branches `2 s` leave along strand `s`, with the inner side of their loop on the left, branches
/// `2 s + 1` have come along it, and look back. The side of a branch that faces the one before it.
fn right_side(junction: &Junction, branch: usize) -> usize {
    2 * junction.strands[branch / 2].path + branch % 2
}

fn left_side(junction: &Junction, branch: usize) -> usize {
    right_side(junction, branch) ^ 1
}

fn unite_between_branches(junction: &Junction, classes: &mut Classes) {
    let order = &junction.fan.order;
    for (i, &branch) in order.iter().enumerate() {
        let before = order[(i + order.len() - 1) % order.len()];
        classes.unite(right_side(junction, branch), left_side(junction, before));
    }
}

/// For each set of touching loops: the loop that reaches farthest left, where, and the side there
/// that faces left.
fn leftmost_sides(rays: &Rays, touching: &[usize], junctions: &[Junction]) -> Vec<(usize, Point, usize)> {
    let leftmost = rays.leftmost(touching.len());
    let mut first: Vec<Option<usize>> = vec![None; touching.len()];
    for i in 0..touching.len() {
        let Some(p) = leftmost[i] else { continue };
        let best = &mut first[touching[i]];
        if best.and_then(|b| leftmost[b]).is_none_or(|q| (p.x, p.y) < (q.x, q.y)) {
            *best = Some(i);
        }
    }
    let mut found: Vec<_> =
        first.into_iter().flatten().filter_map(|i| leftmost[i].map(|place| (i, place, 2 * i))).collect();
    let mut at_junction: HashMap<(u64, u64), usize> = HashMap::new();
    for (number, junction) in junctions.iter().enumerate() {
        let p = turned(junction.place);
        at_junction.insert((p.x.to_bits(), p.y.to_bits()), number);
    }
    for (_, place, side) in &mut found {
        if let Some(&number) = at_junction.get(&(place.x.to_bits(), place.y.to_bits())) {
            *side = left_facing_side(&junctions[number]);
        }
    }
    found
}

/// The side at a junction that faces left in turned coordinates, everything else being right of
/// it: the gap between branches that is widest and whose middle points left.
fn left_facing_side(junction: &Junction) -> usize {
    let fan = &junction.fan;
    let leftness = |i: usize| {
        let gap = fan.gap_before(i);
        let middle = fan.angles[i] - 0.5 * gap;
        -turned(Point::default() + Vector::from_angle(middle)).x * gap
    };
    let best = (0..fan.order.len()).max_by(|&i, &j| leftness(i).total_cmp(&leftness(j)));
    right_side(junction, fan.order[best.unwrap_or(0)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Bounds, point};

    fn depths(loops: &[ArcSpline]) -> Vec<usize> {
        let bounds = loops.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        Nest::new(loops, Grain::of(&bounds)).depth
    }

    fn square(x: f64, y: f64, side: f64) -> ArcSpline {
        ArcSpline::closed([(x, y, 0.0), (x + side, y, 0.0), (x + side, y + side, 0.0), (x, y + side, 0.0)])
    }

    #[test]
    fn squares_in_squares_count_their_depth() {
        let loops =
            [square(3.0, 3.0, 1.0), square(0.0, 0.0, 9.0), square(2.0, 2.0, 3.0), square(6.0, 2.0, 1.0)];
        assert_eq!(depths(&loops), [2, 0, 1, 1]);
    }

    #[test]
    fn islands_in_rows_are_beside_each_other() {
        let mut loops = vec![square(-1.0, -1.0, 99.0)];
        loops.extend(
            (0..64).map(|i| ArcSpline::circle(point(f64::from(3 * (i % 8)), f64::from(3 * (i / 8))), 0.5)),
        );
        assert!(depths(&loops)[1..].iter().all(|&d| d == 1));
    }

    #[test]
    fn touching_loops_know_who_is_inside() {
        // All touch in the origin, from within or from without, and one in one of these.
        let circle = |x: f64, y: f64| {
            let turned = ArcSpline::circle(point(x, y), x.hypot(y)).vertices;
            let far = point(2.0 * x, 2.0 * y);
            let vertices = [point(0.0, 0.0), far].map(|p| (p.x, p.y, turned[0].bulge));
            ArcSpline::closed(vertices)
        };
        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.6, -0.8), (-0.8, 0.6)] {
            let loops = [circle(x, y), circle(3.0 * x, 3.0 * y), circle(2.0 * x, 2.0 * y), circle(-x, -y)];
            assert_eq!(depths(&loops), [2, 0, 1, 0]);
        }
    }
}
