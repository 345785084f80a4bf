//! Links along the axis: from the end of a pass over the axis to the next pass, at depth.
//!
//! **Needs** the axis of the pocket, its level sets, and the passes already cut at this height.
//! **Guarantees** that a link keeps the tool radius and the stock from the wall, judged move by move
//! on the axis itself; that it cuts no fresh material wider than the step; that it is the shortest of
//! its kind and shorter than asked, or none.
//! **Does not** leave axis and spokes for a shorter way across, and gives up after a named number of
//! vertices.
//!
//! **Method.** Shortest path after Dijkstra: up the spoke from where the tool stands to the axis,
//! along it where {r >= tool radius + stock}, and down a spoke to the pass. A stretch of an edge with
//! radii between two levels may be driven when the pass of the lower level on one of its sides is
//! cut: then every place of it is no farther than the step from that pass, on the side away from the
//! wall, and what the tool meets on the other side is no wider. As the radius is monotone along an
//! edge, the places at one level on the spokes of one side of it lie all on one pass: one look decides.
//! Where a slot is wished for, the link may lead through stock as well.

use super::indexed::Indexed;
use super::nest::Nest;
use super::roads::{Roads, Spot};
use crate::geom::{ArcSpline, Element, Point};
use crate::offset::Level;
use rstar::RTree;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// Most vertices that a search for one link looks at; beyond that the tool is lifted.
const MAX_VERTICES: usize = 4096;

/// Finds links along the axis of one pocket.
pub(super) struct Detours<'a> {
    levels: &'a [Level],
    /// Round-off of a place of a level.
    slack: f64,
    index: Vec<Option<RTree<Indexed>>>,
    /// The pass of a level on a side of an edge.
    beside: HashMap<(u32, usize, usize), Option<usize>>,
}

/// What is asked: from a place on a pass to another pass, shorter than a length.
pub(super) struct Wish<'a> {
    pub nest: &'a Nest,
    /// Which passes are cut at this height.
    pub done: &'a [bool],
    pub from: Point,
    pub last: usize,
    pub to: usize,
    pub shorter_than: f64,
    /// Farthest that a chord may leave the axis.
    pub flat: f64,
    /// Whether stock may be cut on the way, and if so, along which level farthest outward.
    pub slot: Option<usize>,
}

/// A way that was found.
pub(super) struct Way {
    /// Its places, beginning where it is asked from.
    pub places: Vec<Point>,
    /// How much of it leads through stock.
    pub slot_length: f64,
}

/// A link that was found.
struct Found {
    length: f64,
    /// The vertex where the link leaves the axis; `None` where it leaves from its first spot.
    leaves: Option<u32>,
    /// What follows after that vertex.
    end: Vec<Point>,
}

/// How a vertex is reached.
#[derive(Clone, Copy)]
struct Step {
    length: f64,
    /// The vertex before and the edge from there; none at the first spot.
    before: Option<(u32, u32)>,
}

impl<'a> Detours<'a> {
    /// The links between these levels; nothing is computed yet.
    pub fn new(levels: &'a [Level], slack: f64) -> Detours<'a> {
        let index = levels.iter().map(|_| None).collect();
        Detours { levels, slack, index, beside: HashMap::new() }
    }

    /// The shortest link.
    pub fn find(&mut self, roads: &Roads, wish: &Wish) -> Option<Way> {
        let (spot, side) = roads.foot(wish.from)?;
        let center = roads.place(spot);
        let radius = roads.radius(spot);
        let spoke = wish.from.distance(center);
        let own = wish.nest.passes[wish.last].level;
        if spoke > wish.shorter_than || !self.is_open_spoke(roads, wish, (spot.edge, side), own, radius) {
            return None;
        }
        let mut best = self.leave(roads, wish, &[spot.edge], center, radius).map(|end| {
            let length = spoke + center.distance(end);
            Found { length, leaves: None, end: vec![end] }
        });
        let mut steps: HashMap<u32, Step> = HashMap::new();
        let mut heap = BinaryHeap::new();
        for (t, vertex) in [0.0, 1.0].into_iter().zip(roads.ends(spot.edge)) {
            self.arrive(roads, wish, spot, (t, spoke), None, &mut best);
            if self.is_open(roads, wish, spot.edge, [radius, roads.vertices[vertex as usize].1]) {
                let length = spoke + self.length(roads, wish, spot, t);
                relax(&mut steps, &mut heap, vertex, Step { length, before: None });
            }
        }
        while let Some(Reverse((bits, vertex))) = heap.pop() {
            let length = f64::from_bits(bits);
            let limit = best.as_ref().map_or(wish.shorter_than, |b| b.length.min(wish.shorter_than));
            if length >= limit || steps.len() > MAX_VERTICES {
                break;
            }
            if length > steps[&vertex].length {
                continue;
            }
            self.visit(roads, wish, (vertex, length), &mut best);
            for &edge in roads.at(vertex) {
                let ends = roads.ends(edge);
                let back = usize::from(ends[1] == vertex);
                let start = Spot { edge, t: back as f64 };
                self.arrive(roads, wish, start, (1.0 - start.t, length), Some(vertex), &mut best);
                if self.is_open(roads, wish, edge, roads.radii(edge)) {
                    let length = length + self.length(roads, wish, start, 1.0 - start.t);
                    relax(
                        &mut steps,
                        &mut heap,
                        ends[1 - back],
                        Step { length, before: Some((vertex, edge)) },
                    );
                }
            }
        }
        let found = best.filter(|b| b.length < wish.shorter_than)?;
        Some(self.drawn(roads, wish, spot, &steps, found))
    }

    /// Leaves the axis at a vertex, if that is shorter.
    fn visit(&mut self, roads: &Roads, wish: &Wish, at: (u32, f64), best: &mut Option<Found>) {
        let (vertex, length) = at;
        let (center, radius) = roads.vertices[vertex as usize];
        if let Some(end) = self.leave(roads, wish, roads.at(vertex), center, radius) {
            keep(best, Found { length: length + center.distance(end), leaves: Some(vertex), end: vec![end] });
        }
    }

    /// Where a spoke from the axis leads to the pass that is asked for.
    fn leave(
        &mut self,
        roads: &Roads,
        wish: &Wish,
        edges: &[u32],
        center: Point,
        radius: f64,
    ) -> Option<Point> {
        let level = wish.nest.passes[wish.to].level;
        let d = self.levels[level].distance;
        if radius + self.slack < d {
            return None;
        }
        edges.iter().flat_map(|&e| [(e, 0), (e, 1)]).find_map(|(edge, side)| {
            let lands = self.pass_beside(roads, wish.nest, (edge, side), level) == Some(wish.to)
                && self.is_open_spoke(roads, wish, (edge, side), level, radius);
            lands.then(|| roads.on_spoke(edge, side, center, d))
        })
    }

    /// Along an edge from a spot toward one of its ends, to where the pass meets it.
    fn arrive(
        &mut self,
        roads: &Roads,
        wish: &Wish,
        start: Spot,
        (toward, length): (f64, f64),
        vertex: Option<u32>,
        best: &mut Option<Found>,
    ) {
        let edge = start.edge;
        let level = wish.nest.passes[wish.to].level;
        let d = self.levels[level].distance;
        let (low, high) = (roads.radius(start), roads.radii(edge)[toward as usize]);
        let meets = low < d && d < high;
        if !meets || self.pass_beside(roads, wish.nest, (edge, 0), level) != Some(wish.to) {
            return;
        }
        // Up to the level below: the pass itself is not cut yet.
        let open = low + self.slack >= self.levels[wish.slot.unwrap_or(0)].distance
            && (wish.slot.is_some()
                || (self.level_of(low)..level).all(|k| self.is_open_stretch(roads, wish, edge, k)));
        if !open {
            return;
        }
        let end = roads.spot_of_radius(edge, d);
        let chords = roads.chords(edge, start.t, end.t, wish.flat);
        let length = length + measure(roads.place(start), &chords);
        keep(best, Found { length, leaves: vertex, end: chords });
    }

    fn length(&self, roads: &Roads, wish: &Wish, start: Spot, to: f64) -> f64 {
        measure(roads.place(start), &roads.chords(start.edge, start.t, to, wish.flat))
    }

    /// The whole link: back over the vertices, then forward.
    fn drawn(
        &mut self,
        roads: &Roads,
        wish: &Wish,
        spot: Spot,
        steps: &HashMap<u32, Step>,
        found: Found,
    ) -> Way {
        let mut route = Vec::new();
        let mut at = found.leaves;
        while let Some(vertex) = at {
            let before = steps.get(&vertex).and_then(|s| s.before);
            route.push((vertex, before.map(|(_, edge)| edge)));
            at = before.map(|(v, _)| v);
        }
        let (mut places, mut slot_length) = (vec![wish.from, roads.place(spot)], 0.0);
        for (vertex, edge) in route.into_iter().rev() {
            let end = |edge: u32| usize::from(roads.ends(edge)[1] == vertex) as f64;
            let (edge, from) = edge.map_or((spot.edge, spot.t), |e| (e, 1.0 - end(e)));
            let chords = roads.chords(edge, from, end(edge), wish.flat);
            if wish.slot.is_some() && !self.is_cut(roads, wish, edge, roads.radii(edge)) {
                slot_length += measure(roads.place(Spot { edge, t: from }), &chords);
            }
            places.extend(chords);
        }
        places.extend(found.end);
        Way { places, slot_length }
    }

    /// Whether the spoke on a side of an edge is cut from the axis, where its radius is known, down to
    /// the level next to `level`.
    fn is_open_spoke(
        &mut self,
        roads: &Roads,
        wish: &Wish,
        beside: (u32, usize),
        level: usize,
        radius: f64,
    ) -> bool {
        (level + 1..=self.level_of(radius))
            .all(|k| self.pass_beside(roads, wish.nest, beside, k).is_some_and(|p| wish.done[p]))
    }

    /// Whether an edge may be driven between two radii on it.
    fn is_open(&mut self, roads: &Roads, wish: &Wish, edge: u32, radii: [f64; 2]) -> bool {
        match wish.slot {
            Some(outermost) => radii[0].min(radii[1]) + self.slack >= self.levels[outermost].distance,
            None => self.is_cut(roads, wish, edge, radii),
        }
    }

    /// Whether it is cut between two radii, beside a pass on one side of it.
    fn is_cut(&mut self, roads: &Roads, wish: &Wish, edge: u32, radii: [f64; 2]) -> bool {
        let (low, high) = (radii[0].min(radii[1]), radii[0].max(radii[1]));
        low + self.slack >= self.levels[0].distance
            && (self.level_of(low)..=self.level_of(high)).all(|k| self.is_open_stretch(roads, wish, edge, k))
    }

    /// The same for the stretch between level `k` and the next.
    fn is_open_stretch(&mut self, roads: &Roads, wish: &Wish, edge: u32, k: usize) -> bool {
        [0, 1]
            .into_iter()
            .any(|side| self.pass_beside(roads, wish.nest, (edge, side), k).is_some_and(|p| wish.done[p]))
    }

    /// The innermost level that reaches a radius; the outermost if none does.
    fn level_of(&self, radius: f64) -> usize {
        self.levels.partition_point(|l| l.distance <= radius + self.slack).saturating_sub(1)
    }

    /// The pass of a level that the spokes on a side of an edge cross.
    fn pass_beside(
        &mut self,
        roads: &Roads,
        nest: &Nest,
        (edge, side): (u32, usize),
        level: usize,
    ) -> Option<usize> {
        if let Some(&known) = self.beside.get(&(edge, side, level)) {
            return known;
        }
        let d = self.levels[level].distance;
        let radii = roads.radii(edge);
        let (low, high) = (radii[0].min(radii[1]), radii[0].max(radii[1]));
        let pass = (d <= high + self.slack).then(|| {
            // Away from the ends of the edge, where passes may touch, as long as there is room.
            let spot = roads.spot_of_radius(edge, 0.5 * (low.max(d) + high));
            let spot = if high - low <= self.slack { Spot { edge, t: 0.5 } } else { spot };
            let p = roads.on_spoke(edge, side, roads.place(spot), d);
            self.pass_at(nest, level, p)
        });
        self.beside.insert((edge, side, level), pass.flatten());
        pass.flatten()
    }

    /// The pass of a level that a place lies on.
    fn pass_at(&mut self, nest: &Nest, level: usize, p: Point) -> Option<usize> {
        let tree = self.index[level].get_or_insert_with(|| index(&self.levels[level]));
        let near = tree.nearest_neighbor(&[p.x, p.y])?;
        if near.element.distance(p) > self.slack {
            return None;
        }
        nest.pass(level, near.index)
    }
}

fn relax(
    steps: &mut HashMap<u32, Step>,
    heap: &mut BinaryHeap<Reverse<(u64, u32)>>,
    vertex: u32,
    step: Step,
) {
    if steps.get(&vertex).is_none_or(|known| step.length < known.length) {
        steps.insert(vertex, step);
        // Bits of numbers that are not negative are ordered as the numbers are.
        heap.push(Reverse((step.length.to_bits(), vertex)));
    }
}

fn keep(best: &mut Option<Found>, found: Found) {
    if best.as_ref().is_none_or(|b| found.length < b.length) {
        *best = Some(found);
    }
}

fn measure(mut at: Point, places: &[Point]) -> f64 {
    let mut length = 0.0;
    for p in places {
        length += at.distance(*p);
        at = *p;
    }
    length
}

/// Loops and ridges of a level, for finding the one that a place lies on.
fn index(level: &Level) -> RTree<Indexed> {
    let splines = level.loops.iter().chain(&level.ridges).enumerate();
    let elements = |(index, spline): (usize, &ArcSpline)| {
        let lone = spline.vertices.first().filter(|_| spline.is_empty());
        let lone = lone.map(|v| Element::segment(v.point, v.point));
        let all: Vec<Element> = spline.elements().chain(lone).collect();
        all.into_iter().map(move |element| Indexed::new(element, index))
    };
    RTree::bulk_load(splines.flat_map(elements).collect())
}
