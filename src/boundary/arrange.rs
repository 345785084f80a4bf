//! Contours that meet get a vertex where they do.
//!
//! **Needs** contours of clean elements, open ones among them. **Guarantees** that contours have no common places
//! but common vertices, equal to the last bit, and elements that coincide from end to end. **Does
//! not** change a contour by more than the round-off.
//!
//! **Method.** Elements are filed in a tree in pieces of about the mean length of an element, so
//! that a long one does not meet every box; there are at most twice as many pieces as elements.

use super::chain::Contour;
use super::clean::clean;
use super::cluster::cluster;
use super::grain::Grain;
use super::index::Index;
use super::intersect::meet;
use crate::error::Error;
use crate::geom::{ArcSpline, Bounds, Element, Point, Vertex};
use rayon::prelude::*;

/// Pairs of elements near each other that are looked at, and pairs of boxes that meet: limits on effort. A
/// drawing in which contours hardly meet has a few of the first for each element; the walls of a spiral of a
/// million arcs have two hundred of the second.
const PAIR_LIMIT: usize = 20_000_000;
const BOX_LIMIT: usize = 400_000_000;

/// Gives contours common vertices where they meet. Contours that vanish are left empty.
pub(super) fn arrange(contours: &mut [Contour], grain: Grain) -> Result<(), Error> {
    snap(contours, grain);
    let elements = Elements::of(contours);
    let mut meetings = meetings(&elements, grain)?;
    unite(&elements, &mut meetings, grain);
    drop(elements);
    meetings.sort_by(|a, b| a.element.cmp(&b.element).then(a.parameter.total_cmp(&b.parameter)));
    let (mut first, mut rest) = (0, &meetings[..]);
    for contour in contours {
        let last = first + contour.path.len();
        let own = rest.partition_point(|m| (m.element as usize) < last);
        if own > 0 {
            contour.path = with_vertices(&contour.path, first, &rest[..own]);
        }
        (first, rest) = (last, &rest[own..]);
    }
    Ok(())
}

/// The elements of contours, numbered from one to the next.
struct Elements<'a> {
    contours: &'a [Contour],
    /// For each element its contour.
    contour_of: Vec<u32>,
    /// For each contour the number of its first element.
    first: Vec<u32>,
}

impl<'a> Elements<'a> {
    fn of(contours: &'a [Contour]) -> Elements<'a> {
        let (mut contour_of, mut first) = (Vec::new(), Vec::with_capacity(contours.len()));
        for (i, contour) in (0..).zip(contours) {
            first.push(contour_of.len() as u32);
            contour_of.resize(contour_of.len() + contour.path.len(), i);
        }
        Elements { contours, contour_of, first }
    }

    fn get(&self, i: u32) -> Element {
        let contour = self.contour_of[i as usize] as usize;
        self.contours[contour].path.element((i - self.first[contour]) as usize)
    }

    fn iter(&self) -> impl Iterator<Item = Element> + Clone {
        (0..self.contour_of.len() as u32).map(|i| self.get(i))
    }
}

/// A place inside an element where another one meets it.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    element: u32,
    parameter: f64,
    place: Point,
}

/// Makes vertices that are the same place to round-off equal.
fn snap(contours: &mut [Contour], grain: Grain) {
    let vertices = || contours.iter().flat_map(|c| c.path.vertices.iter());
    let places: Vec<Point> = vertices().map(|v| v.point).collect();
    let (group_of, groups) = cluster(&places, grain);
    let mut next = group_of.into_iter();
    for contour in contours {
        let mut moved = false;
        for (vertex, group) in contour.path.vertices.iter_mut().zip(&mut next) {
            moved |= vertex.point != groups[group as usize];
            vertex.point = groups[group as usize];
        }
        if moved {
            contour.path = clean(&contour.path, grain);
        }
    }
}

/// All places where elements meet inside at least one of them, once for each of these.
fn meetings(elements: &Elements, grain: Grain) -> Result<Vec<Meeting>, Error> {
    let mut found = Vec::new();
    let mut places = Vec::new();
    for (i, j) in near_pairs(elements, grain)? {
        places.clear();
        let pair = [(i, elements.get(i)), (j, elements.get(j))];
        meet(&pair[0].1, &pair[1].1, grain.same, &mut places);
        for &place in &places {
            for (element, e) in pair {
                let parameter = e.parameter(place);
                if place != e.start && place != e.end && parameter > 0.0 && parameter < 1.0 {
                    found.push(Meeting { element, parameter, place });
                }
            }
        }
    }
    Ok(found)
}

/// Boxes of elements, grown by a margin, of long ones in pieces; each with the number of its element.
pub(super) fn filed(elements: impl Iterator<Item = Element> + Clone, margin: f64) -> (Vec<Bounds>, Vec<u32>) {
    // Of at most a half circle, an element is not much longer than its chord.
    let chord = |e: &Element| e.chord().length();
    let (all, sum) = elements.clone().fold((0, 0.0), |(all, sum), e| (all + 1, sum + chord(&e)));
    let mean = sum / f64::from(all.max(1));
    let mut owners = Vec::with_capacity(2 * all as usize);
    let mut boxes = Vec::with_capacity(2 * all as usize);
    for (i, e) in elements.enumerate() {
        // Of chords that are nearly equal about half are longer than the mean: those up to twice as long stay whole.
        let count = if chord(&e) > 2.0 * mean { (chord(&e) / mean).ceil() as usize } else { 1 };
        let count = count.clamp(1, all as usize);
        for piece in 0..count {
            let part = |k: usize| k as f64 / count as f64;
            let piece = if count == 1 { e } else { e.part(part(piece), part(piece + 1)) };
            boxes.push(piece.bounds().grown(margin));
            owners.push(i as u32);
        }
    }
    (boxes, owners)
}

/// Pairs of elements whose boxes, piece by piece, come nearer than the round-off.
fn near_pairs(elements: &Elements, grain: Grain) -> Result<Vec<(u32, u32)>, Error> {
    let (boxes, owners) = filed(elements.iter(), grain.same);
    let tree = Index::new(&boxes);
    drop(boxes);
    let near = Near { elements, owners: &owners, tree: &tree, round_off: grain.same };
    let (mut pairs, mut boxes_met, mut done) = (Vec::new(), 0, 0);
    while done < owners.len() {
        let next = owners.len().min(done + AT_ONCE);
        let looked_at = tree
            .in_order()
            .skip(done)
            .take(next - done)
            .fold(Found::default, |found, piece| near.look(found, piece));
        for found in looked_at.collect::<Vec<_>>() {
            pairs.extend(found.pairs);
            boxes_met += found.boxes_met;
        }
        done = next;
        for (count, limit) in [(pairs.len(), PAIR_LIMIT), (boxes_met, BOX_LIMIT)] {
            if count > limit {
                let needed = (count as f64 / done as f64 * owners.len() as f64) as u64;
                let what = "the search for crossings, in pairs of elements,";
                return Err(Error::Effort { what, needed, limit: limit as u64 });
            }
        }
    }
    drop(tree);
    pairs.par_sort_unstable();
    pairs.dedup();
    Ok(pairs)
}

/// Pieces that are looked at before their pairs are counted.
const AT_ONCE: usize = 1 << 16;

/// Elements in a tree.
struct Near<'a> {
    elements: &'a Elements<'a>,
    owners: &'a [u32],
    tree: &'a Index,
    round_off: f64,
}

/// What is found near some elements.
#[derive(Default)]
struct Found {
    pairs: Vec<(u32, u32)>,
    boxes_met: usize,
}

impl Near<'_> {
    /// Adds what is near one more piece: elements of a higher number than its own.
    fn look(&self, mut found: Found, (piece, bounds): (u32, &Bounds)) -> Found {
        let i = self.owners[piece as usize];
        let a = self.elements.get(i);
        self.tree.meeting(bounds, |other| {
            let j = self.owners[other as usize];
            if i < j {
                found.boxes_met += 1;
                let b = self.elements.get(j);
                // Sides of a strip are told in a few steps, where elements meet in many.
                if !(lies_beside(&a, &b, self.round_off) || lies_beside(&b, &a, self.round_off)) {
                    found.pairs.push((i, j));
                }
            }
        });
        found
    }
}

/// Whether all of an element lies on one side of the strip between another one and its chord, farther from it than
/// round-off.
fn lies_beside(element: &Element, strip: &Element, round_off: f64) -> bool {
    let sagitta = |e: &Element, chord: f64| 0.5 * e.bulge * chord;
    let chord = strip.chord();
    let length = chord.length();
    // To the left of the chord, times its length.
    let [a, b] = [element.start, element.end].map(|p| chord.cross(p - strip.start));
    let margin = length * (sagitta(element, element.chord().length()).abs() + BESIDE * round_off);
    let depth = length * sagitta(strip, length);
    a.min(b) - margin > (-depth).max(0.0) || a.max(b) + margin < (-depth).min(0.0)
}

/// Places of two elements that are the same may be off by so many round-offs, each on its side.
const BESIDE: f64 = 4.0;

/// Makes places of meetings that are the same to round-off equal, to a vertex where there is one.
fn unite(elements: &Elements, meetings: &mut [Meeting], grain: Grain) {
    if meetings.is_empty() {
        return;
    }
    let near = Index::new(&meetings.iter().map(|m| grain.around(m.place)).collect::<Vec<_>>());
    let mut places: Vec<Point> = Vec::new();
    for p in elements.iter().flat_map(|e| [e.start, e.end]) {
        let mut wanted = false;
        near.meeting(&Bounds { min: p, max: p }, |_| wanted = true);
        if wanted {
            places.push(p);
        }
    }
    let vertices = places.len();
    places.extend(meetings.iter().map(|m| m.place));
    let (group_of, groups) = cluster(&places, grain);
    for (meeting, &group) in meetings.iter_mut().zip(&group_of[vertices..]) {
        meeting.place = groups[group as usize];
    }
}

/// The path, whose first element has number `first`, cut at some sorted places.
fn with_vertices(path: &ArcSpline, first: usize, mut meetings: &[Meeting]) -> ArcSpline {
    let mut vertices = Vec::with_capacity(path.vertices.len() + meetings.len());
    for (i, element) in path.elements().enumerate() {
        let own = meetings.partition_point(|m| m.element as usize <= first + i);
        let (mut at, mut from) = (element.start, 0.0);
        let mut push = |start: Point, from: f64, to: f64| {
            let whole = (from, to) == (0.0, 1.0);
            let bulge = if whole { element.bulge } else { (element.bulge.atan() * (to - from)).tan() };
            vertices.push(Vertex { point: start, bulge });
        };
        for m in &meetings[..own] {
            if m.place != at && m.place != element.start && m.place != element.end {
                push(at, from, m.parameter);
                (at, from) = (m.place, m.parameter);
            }
        }
        push(at, from, 1.0);
        meetings = &meetings[own..];
    }
    vertices.extend(path.vertices.last().filter(|_| !path.closed));
    ArcSpline { vertices, closed: path.closed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn arranged(paths: &[ArcSpline]) -> Vec<ArcSpline> {
        let bounds = paths.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let mut contours: Vec<Contour> = paths
            .iter()
            .enumerate()
            .map(|(rank, p)| Contour { path: p.clone(), rank, loose: false })
            .collect();
        arrange(&mut contours, Grain::of(&bounds)).expect("there are few pairs");
        contours.into_iter().map(|c| c.path).collect()
    }

    fn square(x: f64, y: f64, side: f64) -> ArcSpline {
        ArcSpline::closed([(x, y, 0.0), (x + side, y, 0.0), (x + side, y + side, 0.0), (x, y + side, 0.0)])
    }

    fn has(path: &ArcSpline, p: Point) -> bool {
        path.vertices.iter().any(|v| v.point == p)
    }

    #[test]
    fn what_lies_beside_a_strip_does_not_meet_it_and_walls_of_a_spiral_do_lie_so() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut beside = 0;
        for _ in 0..4000 {
            let [a, b] = [(); 2].map(|()| {
                let [p, q] = [(); 2].map(|()| point(random(), random()));
                Element::arc(p, q, 2.0 * random() - 1.0)
            });
            if lies_beside(&a, &b, 1e-12) {
                let nearest = (0..=50).map(|i| b.distance(a.point_at(f64::from(i) / 50.0)));
                assert!(nearest.fold(f64::INFINITY, f64::min) > 0.0, "{a:?} {b:?}");
                beside += 1;
            }
        }
        assert!(beside > 100, "{beside}");
        let wall = |r: f64| Element::arc(point(r, 0.0), point(0.8 * r, 0.6 * r), 0.16);
        assert!(
            lies_beside(&wall(100.0), &wall(130.0), 1e-9) || lies_beside(&wall(130.0), &wall(100.0), 1e-9)
        );
        assert!(!lies_beside(&wall(100.0), &wall(100.0), 1e-9));
    }

    #[test]
    fn a_corner_on_a_side_becomes_a_vertex_of_it() {
        let diamond = ArcSpline::closed([(4.0, 1.3, 0.0), (5.0, 0.3, 0.0), (6.0, 1.3, 0.0), (5.0, 2.3, 0.0)]);
        let both = arranged(&[square(0.0, 0.0, 4.0), diamond.clone()]);
        assert_eq!(both[0].len(), 5);
        assert!(has(&both[0], point(4.0, 1.3)));
        assert_eq!(both[1], diamond);
    }

    #[test]
    fn circles_that_touch_share_a_vertex() {
        let (a, b) = (ArcSpline::circle(point(0.3, 0.7), 0.4), ArcSpline::circle(point(0.9, 1.5), 0.6));
        let both = arranged(&[a.clone(), b]);
        let common: Vec<_> = both[0].vertices.iter().filter(|v| has(&both[1], v.point)).collect();
        assert_eq!(common.len(), 1);
        assert!(common[0].point.distance(point(0.54, 1.02)) < 1e-15);
        assert!((both[0].area() - a.area()).abs() < 1e-15);
    }

    #[test]
    fn three_circles_through_one_place_have_it_in_common() {
        let circles = [0.1, 0.2, 0.3].map(|r| ArcSpline::circle(point(0.6 * r, 0.8 * r), r));
        let all = arranged(&circles);
        assert!(all.iter().all(|c| c.len() == 3));
        let at = all[0].vertices.iter().find(|v| v.point.distance(point(0.0, 0.0)) < 1e-15);
        let at = at.expect("they touch in the origin").point;
        assert!(all.iter().all(|c| has(c, at)));
    }

    #[test]
    fn contours_apart_stay_as_they_are() {
        let apart = [square(0.0, 0.0, 1.0), square(3.0, 0.0, 1.0), ArcSpline::circle(point(0.5, 0.5), 0.2)];
        assert_eq!(arranged(&apart), apart);
    }
}
