//! Crests: what stands between passes that lie farther apart than the tool reaches.
//!
//! **Needs** the axis, level sets at most the tool's diameter apart, and the passes along them.
//! **Guarantees** that passes and crests together cut all that the tool can reach, at any step up to
//! the tool's diameter; that no crest is added where the passes alone do it, at half the tool and less.
//! **Does not** look for the shortest way to run a crest: along the axis and back.
//!
//! **Method.** A place at distance `p` from the wall lies on a spoke, along which the distance grows
//! up to the radius `r` of the axis where the spoke ends. With levels at `d` and `e` on either side of
//! `p` the passes meet the spoke there, and as `e - d` is at most the diameter, one of them is within
//! the tool's radius `R`. Only where the spoke ends before `e` it has a pass on one side alone, and what
//! lies beyond `d + R` stands: a crest along the parts of the axis where `d + R < r < e`. Run along the
//! axis itself, the tool is no farther from it than `r - d - R`, which is less than `R`. The parts are
//! read off the radius function: it is monotone along each edge.

use super::indexed::Indexed;
use super::nest::{Nest, index};
use super::roads::{Roads, Spot};
use super::tour::round_tour;
use super::trim::{End, Standing};
use crate::geom::{Element, Point};
use crate::offset::Level;
use rayon::prelude::*;
use rstar::RTree;
use std::collections::HashMap;

/// Connected parts of the axis to run along after a pass.
pub(super) struct Crest {
    /// The level of the passes on its sides.
    level: usize,
    /// Where stretches meet or end.
    nodes: Vec<Point>,
    stretches: Vec<[usize; 2]>,
    /// What to cut along each stretch, from its first node to its second.
    ways: Vec<Vec<Element>>,
    /// Ways to it, those of the pass that is cut last among its neighbors.
    pub gates: Vec<Gate>,
}

/// A way straight from a pass to a crest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    pub pass: usize,
    /// The place on the pass.
    pub at: Point,
    node: usize,
}

/// What crests depend on but the axis.
pub(super) struct Reach<'a> {
    pub levels: &'a [Level],
    pub nest: &'a Nest,
    pub tool_radius: f64,
    /// Farthest that a chord may leave the axis.
    pub flat: f64,
    /// Round-off of a place of a level.
    pub slack: f64,
}

/// A part of an edge within one band of radii.
pub(super) struct Part {
    pub level: usize,
    pub edge: u32,
    pub t: [f64; 2],
    ends: [End; 2],
}

impl Part {
    fn joints(&self) -> impl Iterator<Item = u32> {
        self.ends.into_iter().filter_map(|end| if let End::Joint(v) = end { Some(v) } else { None })
    }
}

impl Crest {
    /// All crests, outermost first.
    pub fn all(roads: &Roads, reach: &Reach) -> Vec<Crest> {
        let is_apart = |k: usize| reach.top(k) - reach.levels[k].distance > reach.tool_radius + reach.slack;
        if !(0..reach.levels.len()).any(is_apart) {
            return Vec::new();
        }
        let parts = reach.parts(roads);
        let mut crests: Vec<Crest> = parts
            .chunk_by(|a, b| a.level == b.level)
            .flat_map(|parts| connected(roads, parts, reach))
            .collect();
        crests.extend(reach.lone_places(roads));
        crests.sort_by_key(|c| c.level);
        for same in crests.chunk_by_mut(|a, b| a.level == b.level) {
            let tree = index(&reach.levels[same[0].level]);
            for crest in same {
                crest.gates = crest.find_gates(reach, &tree);
            }
        }
        crests
    }

    /// What to cut from a gate on: to the crest, along all of it, and back.
    pub fn excursion(&self, gate: Gate, from: Point) -> Vec<Element> {
        let there = self.nodes[gate.node];
        let mut way = vec![Element::segment(from, there)];
        for leg in round_tour(self.nodes.len(), &self.stretches, gate.node) {
            let elements = &self.ways[leg.stretch];
            if leg.backward {
                way.extend(elements.iter().rev().map(Element::reversed));
            } else {
                way.extend_from_slice(elements);
            }
        }
        way.push(Element::segment(there, from));
        way
    }

    /// The ways to it that are shortest, as a pass passes them by.
    fn find_gates(&self, reach: &Reach, tree: &RTree<Indexed>) -> Vec<Gate> {
        let mut gates = Vec::new();
        for (node, place) in self.nodes.iter().enumerate() {
            let mut nearest = f64::INFINITY;
            for (found, squared) in tree.nearest_neighbor_iter_with_distance_2(&[place.x, place.y]) {
                let distance = squared.sqrt();
                nearest = nearest.min(distance);
                if distance > nearest + reach.slack {
                    break;
                }
                if let Some(pass) = reach.nest.pass(self.level, found.index) {
                    gates.push(Gate { pass, at: found.element.nearest(*place).point, node });
                }
            }
        }
        gates
    }

    /// Keeps the gates of the pass that comes last, of these the shortest ones.
    pub fn settle(&mut self, rank: &[usize], slack: f64) {
        let Some(last) = self.gates.iter().map(|g| rank[g.pass]).max() else { return };
        self.gates.retain(|g| rank[g.pass] == last);
        let length = |g: &Gate| g.at.distance(self.nodes[g.node]);
        let shortest = self.gates.iter().map(length).fold(f64::INFINITY, f64::min);
        self.gates.retain(|g| length(g) <= shortest + slack);
    }
}

impl Reach<'_> {
    /// The parts of edges between each level and the next, beside which that level has no neighbor
    /// inside. Where an edge leads all the way to the next level, a whole step, it is left out if
    /// `is_plain` says so.
    pub fn between_levels(&self, roads: &Roads, is_plain: impl Fn(u32, f64) -> bool + Sync) -> Vec<Part> {
        let whole = Reach { tool_radius: 0.0, ..*self };
        let parts = |edge| {
            let radii = roads.radii(edge);
            let [low, high] = [radii[0].min(radii[1]), radii[0].max(radii[1])];
            let is_told = |&k: &usize| {
                let (d, e) = (self.levels[k].distance, self.top(k));
                d < low || e > high || !is_plain(edge, e - d)
            };
            let levels = whole.levels_along(roads, edge).filter(is_told);
            levels.filter_map(|k| whole.part(roads, edge, k)).collect::<Vec<_>>()
        };
        (0..roads.edge_count()).into_par_iter().flat_map_iter(parts).collect()
    }

    /// The level inside of level `k`; beyond everything for the last.
    pub fn top(&self, k: usize) -> f64 {
        self.levels.get(k + 1).map_or(f64::INFINITY, |l| l.distance)
    }

    /// Radii at which passes at level `k` leave something on the axis.
    fn band(&self, k: usize) -> [f64; 2] {
        [self.levels[k].distance + self.tool_radius, self.top(k)]
    }

    /// The levels at most as far from the wall as a radius: the first one whose band may reach it.
    pub fn first_level(&self, radius: f64) -> usize {
        self.levels.partition_point(|l| l.distance <= radius).saturating_sub(1)
    }

    /// The parts of edges within the bands, sorted by level.
    fn parts(&self, roads: &Roads) -> Vec<Part> {
        let mut parts = Vec::new();
        for edge in 0..roads.edge_count() {
            parts.extend(self.bands(roads, edge));
        }
        parts.sort_by_key(|p| p.level);
        self.find_leaves(&mut parts);
        parts.into_iter().filter_map(|part| self.trimmed(roads, part)).collect()
    }

    /// The parts of one edge.
    fn bands(&self, roads: &Roads, edge: u32) -> Vec<Part> {
        self.levels_along(roads, edge).filter_map(|level| self.part(roads, edge, level)).collect()
    }

    /// The levels whose bands an edge may lead through.
    fn levels_along(&self, roads: &Roads, edge: u32) -> impl Iterator<Item = usize> {
        let radii = roads.radii(edge);
        let [low, high] = [radii[0].min(radii[1]), radii[0].max(radii[1])];
        let levels = self.first_level(low)..self.levels.len();
        levels.take_while(move |&k| self.levels[k].distance + self.tool_radius + self.slack < high)
    }

    /// Where only one part ends at a vertex, the axis does: along all other edges the radius grows,
    /// and they are cut off at the next level, or falls, and they belong to the crest.
    fn find_leaves(&self, parts: &mut [Part]) {
        for same in parts.chunk_by_mut(|a, b| a.level == b.level) {
            let mut degree: HashMap<u32, u32> = HashMap::new();
            same.iter().flat_map(Part::joints).for_each(|v| *degree.entry(v).or_default() += 1);
            for end in same.iter_mut().flat_map(|part| &mut part.ends) {
                if matches!(end, End::Joint(v) if degree[v] == 1) {
                    *end = End::Leaf;
                }
            }
        }
    }

    fn trimmed(&self, roads: &Roads, part: Part) -> Option<Part> {
        let Part { edge, t, ends, level } = part;
        let reach = self.levels[level].distance + self.tool_radius;
        let tool_radius = self.tool_radius - self.slack;
        let t = Standing { roads, edge, t, ends, reach, tool_radius }.trimmed()?;
        let ends = part.ends.map(|end| if let End::Joint(_) = end { end } else { End::Free });
        Some(Part { t, ends, ..part })
    }

    fn part(&self, roads: &Roads, edge: u32, level: usize) -> Option<Part> {
        let [bottom, top] = self.band(level);
        if top <= bottom {
            return None;
        }
        let radii = roads.radii(edge);
        let is_level = (radii[0] - radii[1]).abs() <= self.slack;
        if is_level {
            // At the next level itself it is a ridge, which is a pass.
            let radius = radii[0].max(radii[1]);
            let inside = radius > bottom + self.slack && radius < top - self.slack;
            let ends = roads.ends(edge).map(End::Joint);
            return inside.then_some(Part { level, edge, t: [0.0, 1.0], ends });
        }
        let clamped = radii.map(|r| r.clamp(bottom, top));
        if (clamped[0] - clamped[1]).abs() <= self.slack {
            return None;
        }
        let mut part = Part { level, edge, t: [0.0, 1.0], ends: roads.ends(edge).map(End::Joint) };
        for end in 0..2 {
            if clamped[end] != radii[end] {
                part.t[end] = roads.spot_of_radius(edge, clamped[end]).t;
                // At a vertex a level may be one place, which is no pass.
                let is_cut = radii[end] > top + self.slack;
                part.ends[end] = if is_cut { End::Cut } else { End::Free };
            }
        }
        Some(part)
    }

    /// Axes that are one place: of round pockets.
    fn lone_places(&self, roads: &Roads) -> Vec<Crest> {
        let lone = (0..roads.vertices.len() as u32).filter(|&v| roads.at(v).is_empty());
        lone.filter_map(|v| {
            let (place, radius) = roads.vertices[v as usize];
            // What just reaches a level is nearer to the level outside of it, or one pass alone.
            let level = self.first_level(radius - self.slack);
            let above = radius - self.levels[level].distance;
            (above > self.tool_radius + self.slack).then(|| Crest {
                level,
                nodes: vec![place],
                stretches: Vec::new(),
                ways: Vec::new(),
                gates: Vec::new(),
            })
        })
        .collect()
    }
}

/// The crests made of parts of one level, each connected.
fn connected(roads: &Roads, parts: &[Part], reach: &Reach) -> Vec<Crest> {
    let mut beside: HashMap<u32, Vec<usize>> = HashMap::new();
    for (i, part) in parts.iter().enumerate() {
        part.joints().for_each(|v| beside.entry(v).or_default().push(i));
    }
    let mut seen = vec![false; parts.len()];
    let mut crests = Vec::new();
    for first in 0..parts.len() {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut own = vec![first];
        let mut next = 0;
        while let Some(&i) = own.get(next) {
            next += 1;
            for &other in parts[i].joints().flat_map(|v| &beside[&v]) {
                if !std::mem::replace(&mut seen[other], true) {
                    own.push(other);
                }
            }
        }
        crests.push(crest(roads, own.iter().map(|&i| &parts[i]), reach));
    }
    crests
}

fn crest<'a>(roads: &Roads, parts: impl Iterator<Item = &'a Part>, reach: &Reach) -> Crest {
    let (mut nodes, mut numbers) = (Vec::new(), HashMap::new());
    let (mut stretches, mut ways, mut level) = (Vec::new(), Vec::new(), 0);
    for part in parts {
        level = part.level;
        let place = |end: usize| roads.place(Spot { edge: part.edge, t: part.t[end] });
        stretches.push([0, 1].map(|end| {
            let mut number = || {
                nodes.push(place(end));
                nodes.len() - 1
            };
            match part.ends[end] {
                End::Joint(vertex) => *numbers.entry(vertex).or_insert_with(number),
                End::Cut | End::Free | End::Leaf => number(),
            }
        }));
        ways.push(roads.way(part.edge, part.t, reach.flat));
    }
    Crest { level, nodes, stretches, ways, gates: Vec::new() }
}
