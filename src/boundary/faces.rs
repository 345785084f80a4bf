//! The faces into which pieces divide the plane, and how deep they lie.
//!
//! **Needs** pieces that have nothing in common but vertices, in which they do not cross.
//! **Guarantees** for each side of each piece its face, and for each face the number of loops around
//! it. Where loose curves end on others or on each other, all that they enclose together counts as
//! one loop, and they divide it: neighboring parts are equally deep.
//!
//! **Method.** Every piece has two sides, and sides that bound the same part of the plane are put
//! in one class. Around a common vertex, the sides that face each other between neighboring
//! branches are of one class. A set of pieces that touch is placed as a whole, by a ray to the
//! left from its leftmost place, which cannot hit the set itself. No place is tested that lies on
//! a piece, and no piece is compared with all others. A curve that encloses nothing has the same
//! face on both sides, and so does no harm. Both sides of a face that a plain loop pinches are one
//! face, as the loop has but one outer side.

use super::grain::Grain;
use super::junction::{Junction, Junctions};
use super::pieces::Piece;
use super::ray::{Hit, Rays, turned};
use crate::geom::{ArcSpline, Point, Vector};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::f64::consts::TAU;

/// The faces between pieces. A face is named by one of the sides that bound it.
#[derive(Debug)]
pub(super) struct Faces {
    /// The class of every side.
    classes: Vec<usize>,
    /// For each face how many loops are around it.
    pub depth: Vec<usize>,
    /// Where pieces meet.
    pub junctions: Junctions,
    count: usize,
}

/// Classes of sides: the right or outer side of piece `i` is `2 i`, the left or inner one
/// `2 i + 1`, and one more stands for what is around everything.
#[derive(Debug)]
pub(super) struct Classes(Vec<usize>);

impl Classes {
    /// As many classes as items.
    pub fn new(count: usize) -> Classes {
        Classes((0..count).collect())
    }

    /// The class of an item.
    pub fn of(&mut self, mut side: usize) -> usize {
        while self.0[side] != side {
            self.0[side] = self.0[self.0[side]];
            side = self.0[side];
        }
        side
    }

    /// Makes two classes one.
    pub fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// The class of every item.
    pub fn settled(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|side| self.of(side)).collect()
    }
}

impl Faces {
    /// Finds the faces between pieces, and what tells in which of them a place lies: that takes more room than
    /// all the rest.
    pub fn new(pieces: &[Piece], grain: Grain) -> (Faces, Rays) {
        let count = pieces.len();
        let paths: Vec<&ArcSpline> = pieces.iter().map(|p| &p.path).collect();
        let junctions = Junctions::of(&paths, grain);
        let rays = Rays::new(paths.iter().copied().enumerate());
        let mut classes = Classes::new(2 * count + 1);
        let (mut touching, mut woven) = (Classes::new(count), Classes::new(count));
        for junction in &junctions.all {
            unite_between_branches(junction, &mut classes);
            junction.strands.windows(2).for_each(|s| touching.unite(s[0].path, s[1].path));
            let parts: Vec<usize> =
                junction.strands.iter().map(|s| s.path).filter(|&i| !pieces[i].is_plain()).collect();
            parts.windows(2).for_each(|w| woven.unite(w[0], w[1]));
        }
        for (i, path) in paths.iter().enumerate().filter(|(_, p)| !p.closed) {
            let ends = [0, path.len()];
            if ends.iter().any(|&v| !junctions.at.contains_key(&(i, v))) {
                classes.unite(2 * i, 2 * i + 1);
            }
        }
        let (touching, woven) = (touching.settled(), woven.settled());
        for (leftmost, place, outer) in leftmost_sides(&rays, &paths, &touching, &junctions) {
            let around = match rays.first(place, |other| touching[other] == touching[leftmost]) {
                Some(hit) => side_of(hit),
                None => 2 * count,
            };
            classes.unite(outer, around);
        }
        let classes = classes.settled();
        let outer_sides = leftmost_sides(&rays, &paths, &woven, &junctions);
        let mut faces = Faces { classes, depth: Vec::new(), junctions, count };
        faces.measure_depth(pieces, &woven, &outer_sides);
        (faces, rays)
    }

    /// The face on the left of a piece: inside of a loop.
    pub fn left(&self, piece: usize) -> usize {
        self.classes[2 * piece + 1]
    }

    /// The face on the right of a piece: outside of a loop.
    pub fn right(&self, piece: usize) -> usize {
        self.classes[2 * piece]
    }

    /// The face in which a place lies that is on no piece.
    pub fn around(&self, rays: &Rays, p: Point) -> usize {
        let hit = rays.first(turned(p), |_| false);
        self.classes[hit.map_or(2 * self.count, side_of)]
    }

    fn measure_depth(&mut self, pieces: &[Piece], woven: &[usize], outer_sides: &[(usize, Point, usize)]) {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let cut = (0..self.count).filter(|&i| !pieces[i].is_plain());
        cut.for_each(|i| members.entry(woven[i]).or_default().push(i));
        // For each face the one around the pieces that enclose it, and how much deeper it is.
        let mut within: Vec<Option<(usize, usize)>> = vec![None; self.classes.len()];
        for &(leftmost, _, outer) in outer_sides {
            let around = self.classes[outer];
            match members.get(&woven[leftmost]) {
                None => within[self.left(leftmost)] = Some((around, 1)),
                Some(set) => {
                    let inner = self.depths_within(pieces, set, around);
                    inner.into_iter().for_each(|(face, depth)| within[face] = Some((around, depth)));
                }
            }
        }
        self.depth = total_depths(&within);
    }

    /// Depths of the faces within a set of woven pieces, counted from the face around it.
    fn depths_within(&self, pieces: &[Piece], set: &[usize], around: usize) -> Vec<(usize, usize)> {
        let is_divided = set.iter().any(|&i| !pieces[i].in_loop && self.left(i) != self.right(i));
        let mut beside: HashMap<usize, Vec<(usize, i32)>> = HashMap::new();
        let mut parts: HashSet<usize> = HashSet::new();
        for &i in set {
            let (left, right) = (self.left(i), self.right(i));
            let rise = if is_divided { pieces[i].drawn_rise } else { pieces[i].rise };
            beside.entry(right).or_default().push((left, rise));
            beside.entry(left).or_default().push((right, -rise));
            if is_divided && pieces[i].loose && left != right {
                parts.extend([left, right]);
            }
        }
        let mut found: HashMap<usize, i32> = HashMap::from([(around, 0)]);
        let mut open = vec![around];
        while let Some(face) = open.pop() {
            let depth = found[&face];
            for &(next, rise) in beside.get(&face).into_iter().flatten() {
                found.entry(next).or_insert_with(|| {
                    open.push(next);
                    depth + rise
                });
            }
        }
        found.remove(&around);
        let least = |face| i32::from(parts.contains(face));
        found.iter().map(|(face, &depth)| (*face, depth.max(least(face)) as usize)).collect()
    }
}

/// Depths from those relative to the face around.
fn total_depths(within: &[Option<(usize, usize)>]) -> Vec<usize> {
    let mut depth: Vec<Option<usize>> = vec![None; within.len()];
    for start in 0..within.len() {
        let (mut way, mut at, mut known) = (Vec::new(), start, 0);
        while way.len() <= within.len() {
            if let Some(d) = depth[at] {
                known = d;
                break;
            }
            let Some((around, deeper)) = within[at] else { break };
            way.push((at, deeper));
            at = around;
        }
        for &(face, deeper) in way.iter().rev() {
            known += deeper;
            depth[face] = Some(known);
        }
        depth[start].get_or_insert(known);
    }
    depth.into_iter().map(Option::unwrap_or_default).collect()
}

fn side_of(hit: Hit) -> usize {
    2 * hit.owner + usize::from(hit.from_left)
}

/// For each slot of a junction the piece that leaves by it, and whether in its own direction.
pub(super) fn branches(junction: &Junction) -> Vec<(usize, bool)> {
    let mut branches = vec![(0, false); junction.rank.len()];
    for s in &junction.strands {
        s.from.into_iter().for_each(|slot| branches[slot] = (s.path, false));
        s.to.into_iter().for_each(|slot| branches[slot] = (s.path, true));
    }
    branches
}

/// The side of a branch that faces the one before it.
fn right_side((piece, forward): (usize, bool)) -> usize {
    2 * piece + usize::from(!forward)
}

fn left_side(branch: (usize, bool)) -> usize {
    right_side(branch) ^ 1
}

fn unite_between_branches(junction: &Junction, classes: &mut Classes) {
    let (order, branches) = (&junction.fan.order, branches(junction));
    for (i, &slot) in order.iter().enumerate() {
        let before = order[(i + order.len() - 1) % order.len()];
        classes.unite(right_side(branches[slot]), left_side(branches[before]));
    }
}

/// For each set of pieces: the piece that reaches farthest left, where, and the side there that
/// faces left.
fn leftmost_sides(
    rays: &Rays,
    paths: &[&ArcSpline],
    set_of: &[usize],
    junctions: &Junctions,
) -> Vec<(usize, Point, usize)> {
    let leftmost = rays.leftmost(set_of.len());
    let mut first: Vec<Option<usize>> = vec![None; set_of.len()];
    for i in 0..set_of.len() {
        let Some(p) = leftmost[i] else { continue };
        let best = &mut first[set_of[i]];
        if best.and_then(|b| leftmost[b]).is_none_or(|q| (p.x, p.y) < (q.x, q.y)) {
            *best = Some(i);
        }
    }
    let mut at_junction: HashMap<(u64, u64), usize> = HashMap::new();
    for (number, junction) in junctions.all.iter().enumerate() {
        let p = turned(junction.place);
        at_junction.insert((p.x.to_bits(), p.y.to_bits()), number);
    }
    let found = first.into_iter().flatten().filter_map(|i| leftmost[i].map(|place| (i, place)));
    found
        .map(|(i, place)| {
            let side = match at_junction.get(&(place.x.to_bits(), place.y.to_bits())) {
                Some(&number) => left_facing_side(&junctions.all[number], |piece| set_of[piece] == set_of[i]),
                None if paths[i].closed => 2 * i,
                None => 2 * i + usize::from(rays.is_left_of(i, place)),
            };
            (i, place, side)
        })
        .collect()
}

/// The side at a junction that faces left in turned coordinates, everything else of a set being
/// right of it: the gap between its branches that is widest and whose middle points left.
fn left_facing_side(junction: &Junction, is_in_set: impl Fn(usize) -> bool) -> usize {
    let (fan, branches) = (&junction.fan, branches(junction));
    let own: Vec<usize> = (0..fan.order.len()).filter(|&i| is_in_set(branches[fan.order[i]].0)).collect();
    let leftness = |i: usize| {
        let gap = if i == 0 {
            TAU - (fan.angles[own[own.len() - 1]] - fan.angles[own[0]])
        } else {
            (fan.angles[own[i]] - fan.angles[own[i - 1]]).max(0.0)
        };
        let middle = fan.angles[own[i]] - 0.5 * gap;
        -turned(Point::default() + Vector::from_angle(middle)).x * gap
    };
    let best = (0..own.len()).max_by(|&i, &j| leftness(i).total_cmp(&leftness(j)));
    right_side(branches[fan.order[own[best.unwrap_or(0)]]])
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{Loop, Pieces};
    use super::*;
    use crate::geom::{Bounds, point};

    /// Faces between loops and open curves that have common vertices.
    fn faces(loops: &[ArcSpline], dividers: &[ArcSpline]) -> Faces {
        let bounds = loops.iter().chain(dividers).fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let loops = loops.iter().map(|path| Loop { path: path.clone(), loose: false }).collect();
        let grain = Grain::of(&bounds);
        Faces::new(&Pieces::of(loops, dividers, 0.0, grain).all, grain).0
    }

    fn depths(loops: &[ArcSpline]) -> Vec<usize> {
        let faces = faces(loops, &[]);
        (0..loops.len()).map(|i| faces.depth[faces.left(i)]).collect()
    }

    fn square(x: f64, y: f64, side: f64) -> ArcSpline {
        ArcSpline::closed([(x, y, 0.0), (x + side, y, 0.0), (x + side, y + side, 0.0), (x, y + side, 0.0)])
    }

    #[test]
    fn squares_in_squares_count_their_depth() {
        let loops =
            [square(3.0, 3.0, 1.0), square(0.0, 0.0, 9.0), square(2.0, 2.0, 3.0), square(6.0, 2.0, 1.0)];
        assert_eq!(depths(&loops), [3, 1, 2, 2]);
    }

    #[test]
    fn islands_in_rows_are_beside_each_other() {
        let mut loops = vec![square(-1.0, -1.0, 99.0)];
        loops.extend(
            (0..64).map(|i| ArcSpline::circle(point(f64::from(3 * (i % 8)), f64::from(3 * (i / 8))), 0.5)),
        );
        assert!(depths(&loops)[1..].iter().all(|&d| d == 2));
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
            assert_eq!(depths(&loops), [3, 1, 2, 1]);
        }
    }

    /// Depths of all faces but the one around everything.
    fn inner_depths(faces: &Faces) -> Vec<usize> {
        let named: std::collections::BTreeSet<usize> = faces.classes.iter().copied().collect();
        let outside = faces.classes[2 * faces.count];
        let mut depths: Vec<usize> =
            named.iter().filter(|&&f| f != outside).map(|&f| faces.depth[f]).collect();
        depths.sort_unstable();
        depths
    }

    fn cut(side: f64, at: [(f64, f64); 2]) -> ArcSpline {
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        let mut corners: Vec<(f64, f64)> = corners.into_iter().chain(at).collect();
        corners.sort_by(|&a, &b| {
            let turn = |(x, y): (f64, f64)| (y - 0.5 * side).atan2(x - 0.5 * side);
            turn(a).total_cmp(&turn(b))
        });
        ArcSpline::closed(corners.into_iter().map(|(x, y)| (x, y, 0.0)))
    }

    #[test]
    fn a_line_across_makes_two_faces_and_one_that_ends_none() {
        let square = cut(4.0, [(0.0, 1.0), (4.0, 2.0)]);
        let across = ArcSpline::open([(0.0, 1.0, 0.0), (4.0, 2.0, 0.0)]);
        let ends = ArcSpline::open([(0.0, 1.0, 0.0), (3.0, 2.0, 0.0)]);
        assert_eq!(inner_depths(&faces(std::slice::from_ref(&square), &[across])), [1, 1]);
        assert_eq!(inner_depths(&faces(&[square], &[ends])), [1]);
    }

    #[test]
    fn a_part_drawn_on_to_a_side_is_as_deep_as_its_neighbor() {
        let square = cut(4.0, [(0.0, 1.0), (0.0, 2.0)]);
        let outside = ArcSpline::open([(0.0, 1.0, 0.0), (-3.0, 1.0, 0.0), (-3.0, 2.0, 0.0), (0.0, 2.0, 0.0)]);
        let inside = outside.mapped(true, |p| point(0.0 - p.x, p.y));
        for part in [&outside, &inside] {
            assert_eq!(
                inner_depths(&faces(std::slice::from_ref(&square), std::slice::from_ref(part))),
                [1, 1]
            );
        }
        let frame =
            ArcSpline::closed([(-9.0, -9.0, 0.0), (9.0, -9.0, 0.0), (9.0, 9.0, 0.0), (-9.0, 9.0, 0.0)]);
        assert_eq!(inner_depths(&faces(&[square, frame], &[outside])), [1, 2, 2]);
    }
}
