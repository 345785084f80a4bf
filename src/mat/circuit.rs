//! The boundary in the order in which levels follow it.
//!
//! Pieces of the boundary are numbered as they come into being, so that the way along it would lead to
//! and fro in memory. Here they stand one after the other, a *stop* for each, with what a level asks of
//! them; all radii stand together, as most of them are only compared.

use super::bvh::hilbert;
use super::graph::Graph;
use super::piece::Piece;
use super::site::{Foot, NONE, Site};

/// Where a piece of the boundary begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub foot: Foot,
    pub site: u32,
    /// The edge on its left, [`NONE`] along the contact arc of a leaf.
    pub edge: u32,
    /// The disk that touches here.
    pub disk: u32,
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

/// What a piece has in common with the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    OtherSource,
    /// Another site of the same element or vertex of the drawing.
    SameSource,
    SameSite,
}

/// A ring of the boundary.
#[derive(Clone, Debug)]
pub(crate) struct Ring {
    /// Its stops, without the one at its end.
    pub stops: std::ops::Range<u32>,
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
    /// In the order of their first pieces.
    pub rings: Vec<Ring>,
}

impl Circuit {
    pub fn of(sites: &[Site], graph: &Graph) -> Circuit {
        let mut circuit =
            Circuit { stops: Vec::new(), ways: Vec::new(), radii: Vec::new(), rings: Vec::new() };
        let mut stop_of = vec![NONE; graph.pieces.len()];
        let firsts = ring_firsts(graph);
        let count = graph.pieces.len() + firsts.len();
        circuit.stops.reserve_exact(count);
        circuit.ways.reserve_exact(count);
        circuit.radii.reserve_exact(count);
        let mut lone = graph.lone_disks().into_iter();
        let start = |first| {
            let start = site_start(graph, first);
            // A ring without edges is all contact arc: the pocket, or a part of it, is one disk.
            let disk = start_disk(graph, start).or_else(|| lone.next()).unwrap_or(NONE);
            [start, disk]
        };
        let mut starts: Vec<_> = (0usize..).zip(firsts.into_iter().map(start)).collect();
        // What is near is near in memory.
        starts.sort_by_cached_key(|&(_, [start, _])| hilbert(graph.pieces[start as usize].from.point));
        circuit.rings = vec![Ring { stops: 0..0, least: 0.0 }; starts.len()];
        for (ring, start) in starts {
            circuit.rings[ring] = circuit.add_ring(sites, graph, start, &mut stop_of);
        }
        for way in circuit.ways.iter_mut().filter(|w| w.has_edge()) {
            way.across = stop_of[way.across as usize];
        }
        circuit
    }

    /// The foot where the piece of a stop ends.
    pub fn end(&self, sites: &[Site], at: u32) -> Foot {
        let goes_on = self.ways[at as usize + 1].after == After::SameSite;
        if goes_on {
            self.stops[at as usize + 1].foot
        } else {
            sites[self.stops[at as usize].site as usize].end
        }
    }

    /// Adds the ring that begins with a piece, in a disk.
    fn add_ring(
        &mut self,
        sites: &[Site],
        graph: &Graph,
        [start, disk]: [u32; 2],
        stop_of: &mut [u32],
    ) -> Ring {
        let begin = self.stops.len() as u32;
        let (mut at, mut disk) = (start, disk);
        let mut before = NONE;
        loop {
            let piece = &graph.pieces[at as usize];
            let here = &sites[piece.site as usize];
            let Piece { from, to, .. } = graph.piece(sites, at);
            let turn = if here.is_straight() { 0.0 } else { from.normal.angle_to(to.normal) };
            let edge = graph.edges.get(piece.edge as usize);
            let backward = edge.is_some_and(|e| e.pieces[1] == at);
            stop_of[at as usize] = self.stops.len() as u32;
            self.radii.push(graph.disks.get(disk as usize).map_or(0.0, |d| d.radius));
            let site = piece.site;
            let across = edge.map_or(NONE, |e| e.pieces[usize::from(!backward)]);
            let after = after(sites, before, site);
            self.stops.push(Stop { foot: from, site, edge: piece.edge, disk });
            self.ways.push(Way { turn, across, after, backward, is_end: false });
            disk = edge.map_or(disk, |e| e.disks[usize::from(!backward)]);
            (before, at) = (site, piece.next);
            if at == start {
                break;
            }
        }
        let end = self.stops.len() as u32;
        let first = self.stops[begin as usize];
        let after = after(sites, before, first.site);
        self.ways[begin as usize].after = after;
        self.stops.push(first);
        self.ways.push(Way { turn: 0.0, across: begin, after, backward: false, is_end: true });
        let radii = &self.radii[begin as usize..];
        let least = radii.iter().copied().fold(f64::INFINITY, f64::min);
        self.radii.push(radii[0]);
        Ring { stops: begin..end, least }
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
fn ring_firsts(graph: &Graph) -> Vec<u32> {
    let mut seen = vec![false; graph.pieces.len()];
    let mut firsts = Vec::new();
    for first in 0..graph.pieces.len() as u32 {
        // What stands for a crossing of a link is no piece; nothing leads to it.
        if seen[first as usize] || graph.pieces[first as usize].next == NONE {
            continue;
        }
        firsts.push(first);
        let mut at = first;
        while !seen[at as usize] {
            seen[at as usize] = true;
            at = graph.pieces[at as usize].next;
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
