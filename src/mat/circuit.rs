//! The boundary in the order in which levels follow it.
//!
//! Pieces of the boundary are numbered as they come into being, so that the way along it would lead to
//! and fro in memory. Here they stand one after the other, a *stop* for each, with what a level asks of
//! them; all radii stand together, as most of them are only compared.

use super::graph::Graph;
use super::hilbert::hilbert;
use super::leg::{After, Leg};
use super::site::{Foot, NONE, Site};
use crate::geom::Point;
use std::ops::Range;

/// Where a piece of the boundary begins, on one line of memory.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Stop {
    pub foot: Foot,
    /// The center of the disk that touches here.
    pub center: Point,
    pub site: u32,
    /// The edge on its left, [`NONE`] along the contact arc of a leaf.
    pub edge: u32,
    /// The leg that it is on.
    pub leg: u32,
}

/// The way from a stop along its piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    /// Angle by which the normal turns, counter-clockwise positive.
    pub turn: f64,
    /// The stop on the other side of the edge, [`NONE`] without one; at the end of a ring, where that begins.
    pub across: u32,
    /// How the boundary came to the stop.
    pub after: After,
    /// Whether it runs against its edge.
    pub backward: bool,
    /// Whether the stop stands for the first one of its ring at the end of that, and there is no piece.
    pub is_end: bool,
}

impl Way {
    /// Whether it runs along an edge.
    #[inline]
    pub fn has_edge(&self) -> bool {
        !self.is_end && self.across != NONE
    }
}

/// Pieces that are fetched side by side: memory is not waited for one by one.
const AT_A_TIME: usize = 32;

/// A ring of the boundary.
#[derive(Clone, Debug)]
pub(crate) struct Ring {
    /// Its legs, without what stands for its end.
    pub legs: Range<u32>,
    /// Its number in the order of first pieces.
    pub number: u32,
    /// The smallest radius along it.
    pub least: f64,
}

/// All stops.
#[derive(Clone, Debug)]
pub(crate) struct Circuit {
    /// Ring by ring, each from the beginning of a site; and the stop at its end.
    pub stops: Vec<Stop>,
    pub ways: Vec<Way>,
    /// The radius at each stop.
    pub radii: Vec<f64>,
    /// Ring by ring, and what stands for its end.
    pub legs: Vec<Leg>,
    /// In the order of their stops.
    pub rings: Vec<Ring>,
}

impl Circuit {
    pub fn of(sites: &[Site], graph: &Graph) -> Circuit {
        let mut stop_of = vec![NONE; graph.pieces.len()];
        let next: Vec<u32> = graph.pieces.iter().map(|p| p.next).collect();
        let firsts = ring_firsts(&next);
        let count = graph.pieces.len() + firsts.len();
        let mut circuit = Circuit {
            stops: Vec::with_capacity(count),
            ways: Vec::with_capacity(count),
            radii: Vec::with_capacity(count),
            legs: Vec::with_capacity(sites.len() + firsts.len()),
            rings: Vec::with_capacity(firsts.len()),
        };
        let mut lone = graph.lone_disks().into_iter();
        let start = |first| {
            let start = site_start(graph, first);
            // A ring without edges is all contact arc: the pocket, or a part of it, is one disk.
            let is_lone = !graph.pieces[start as usize].left_out;
            let lone_disk = || if is_lone { lone.next() } else { None };
            let disk = start_disk(graph, start).or_else(lone_disk).unwrap_or(NONE);
            [start, disk]
        };
        let mut starts: Vec<_> = (0u32..).zip(firsts.into_iter().map(start)).collect();
        // What is near is near in memory.
        starts.sort_by_cached_key(|&(_, [start, _])| hilbert(graph.from(sites, start).point));
        // The way along a ring leads to and fro; nothing else waits for it.
        let mut order = Vec::new();
        for (number, [start, disk]) in starts {
            order.clear();
            order.extend(std::iter::successors(Some(start), |&at| {
                Some(next[at as usize]).filter(|&at| at != start)
            }));
            let legs = circuit.add_ring(sites, graph, &order, disk, &mut stop_of);
            let least = circuit.legs[legs.start as usize..legs.end as usize].iter().map(|leg| leg.least);
            let least = least.fold(f64::INFINITY, f64::min);
            circuit.rings.push(Ring { legs, number, least });
        }
        for way in circuit.ways.iter_mut().filter(|w| w.has_edge()) {
            way.across = stop_of[way.across as usize];
        }
        circuit
    }

    /// The foot where the piece of a stop ends.
    #[inline]
    pub fn end<'a>(&'a self, sites: &'a [Site], at: u32) -> &'a Foot {
        let [here, next] = [0, 1].map(|i| &self.stops[at as usize + i]);
        if here.site == next.site { &next.foot } else { &sites[here.site as usize].end }
    }

    /// Adds the ring of some pieces that begins in a disk; its legs.
    fn add_ring(
        &mut self,
        sites: &[Site],
        graph: &Graph,
        order: &[u32],
        mut disk: u32,
        stop_of: &mut [u32],
    ) -> Range<u32> {
        let (begin, first_leg) = (self.stops.len() as u32, self.legs.len() as u32);
        let mut before = NONE;
        let mut near = Vec::with_capacity(AT_A_TIME);
        for order in order.chunks(AT_A_TIME) {
            near.clear();
            near.extend(order.iter().map(|&at| graph.pieces[at as usize]));
            for (&at, piece) in order.iter().zip(&near) {
                let (from, site) = (graph.from(sites, at), piece.site);
                let turns = || from.normal.angle_to(graph.piece(sites, at).to.normal);
                let turn = if sites[site as usize].is_straight() { 0.0 } else { turns() };
                let edge = graph.edges.get(piece.edge as usize);
                let backward = edge.is_some_and(|e| e.pieces[1] == at);
                let stop = self.stops.len() as u32;
                stop_of[at as usize] = stop;
                // Where something is left out, the edges on either side do not meet in a disk.
                disk = edge.map_or(disk, |e| e.disks[usize::from(backward)]);
                let touching = graph.disks.get(disk as usize);
                let (center, radius) = touching.map_or((from.point, 0.0), |d| (d.center, d.radius));
                let across = edge.map_or(NONE, |e| e.pieces[usize::from(!backward)]);
                let after = after(sites, before, site);
                match self.legs.last_mut() {
                    Some(leg) if after.goes_on(leg.turn, turn) => leg.add(turn, radius),
                    _ => self.legs.push(Leg::begun(from, turn, radius, stop)),
                }
                let leg = self.legs.len() as u32 - 1;
                self.radii.push(radius);
                self.stops.push(Stop { foot: from, center, site, edge: piece.edge, leg });
                self.ways.push(Way { turn, across, after, backward, is_end: false });
                disk = edge.map_or(disk, |e| e.disks[usize::from(!backward)]);
                before = site;
            }
        }
        self.end_ring(sites, begin, before);
        let end = self.legs.len() as u32;
        let first = self.stops[begin as usize].foot;
        self.legs.push(Leg::end(first, self.stops.len() as u32 - 1));
        for leg in first_leg as usize..end as usize {
            let to = self.legs[leg + 1].first;
            self.legs[leg].close(self.radii[to as usize]);
        }
        first_leg..end
    }

    /// Adds the stop at the end of the ring that begins at a stop, after a piece of some site.
    fn end_ring(&mut self, sites: &[Site], begin: u32, before: u32) {
        let first = self.stops[begin as usize];
        let after = after(sites, before, first.site);
        self.ways[begin as usize].after = after;
        self.stops.push(first);
        self.ways.push(Way { turn: 0.0, across: begin, after, backward: false, is_end: true });
        self.radii.push(self.radii[begin as usize]);
    }
}

fn after(sites: &[Site], before: u32, site: u32) -> After {
    match sites.get(before as usize) {
        Some(_) if before == site => After::SameSite,
        Some(s) if s.source == sites[site as usize].source => After::SameSource,
        _ => After::OtherSource,
    }
}

/// The piece of the lowest number of every ring.
fn ring_firsts(next: &[u32]) -> Vec<u32> {
    let mut seen = vec![false; next.len()];
    let mut firsts = Vec::new();
    for first in 0..next.len() as u32 {
        // What stands for a crossing of a link is no piece; nothing leads to it.
        if seen[first as usize] || next[first as usize] == NONE {
            continue;
        }
        firsts.push(first);
        let mut at = first;
        while !seen[at as usize] {
            seen[at as usize] = true;
            at = next[at as usize];
        }
    }
    firsts
}

/// The first piece from here on that begins a site, so that no site is cut where a ring begins.
fn site_start(graph: &Graph, first: u32) -> u32 {
    let next = |at: u32| graph.pieces[at as usize].next;
    let site = |at: u32| graph.pieces[at as usize].site;
    let mut at = first;
    while site(at) == site(next(at)) {
        at = next(at);
        if at == first {
            break;
        }
    }
    next(at)
}

/// The disk where a piece begins; `None` on a ring without edges.
fn start_disk(graph: &Graph, start: u32) -> Option<u32> {
    let mut at = start;
    loop {
        let piece = &graph.pieces[at as usize];
        // All along a contact arc it is the disk in which the next edge begins.
        if let Some(edge) = graph.edges.get(piece.edge as usize) {
            return Some(edge.disks[usize::from(edge.pieces[1] == at)]);
        }
        at = piece.next;
        if at == start {
            return None;
        }
    }
}
