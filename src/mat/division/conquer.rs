//! The conquer step: the axes of the base cases meet in the centers of the dividing disks.
//!
//! Nothing has to be merged or adjusted for that. But a random disk also cuts edges in places that mean
//! nothing; there the two parts, of the same two sites, become one edge again.

use super::super::graph::{BoundaryPiece, Graph, GraphEdge};
use super::super::site::NONE;
use super::medialaxis::Division;

impl Division<'_> {
    /// The axis of the whole.
    pub fn conquer(mut self) -> Graph {
        self.graph.contract();
        Concatenation::of(self.graph).finish()
    }
}

/// The graph while edges are joined.
struct Concatenation {
    graph: Graph,
    /// Edges at every disk.
    edges_at: Vec<Vec<u32>>,
    dead_disks: Vec<bool>,
    dead_edges: Vec<bool>,
    dead_pieces: Vec<bool>,
}

/// An edge as it is met at one of its ends.
struct End {
    edge: u32,
    /// The piece that ends in the disk and the one that begins there.
    arriving: u32,
    leaving: u32,
    other_disk: u32,
}

impl Concatenation {
    fn of(graph: Graph) -> Concatenation {
        let mut edges_at = vec![Vec::new(); graph.disks.len()];
        for (id, edge) in (0u32..).zip(&graph.edges) {
            edge.disks.iter().for_each(|&d| edges_at[d as usize].push(id));
        }
        let (disks, edges, pieces) = (graph.disks.len(), graph.edges.len(), graph.pieces.len());
        let mut all = Concatenation {
            graph,
            edges_at,
            dead_disks: vec![false; disks],
            dead_edges: vec![false; edges],
            dead_pieces: vec![false; pieces],
        };
        (0..disks as u32).for_each(|disk| all.join_at(disk));
        all
    }

    fn end(&self, edge: u32, disk: u32) -> End {
        let GraphEdge { pieces: [p, q], disks } = self.graph.edges[edge as usize];
        if disks[1] == disk {
            End { edge, arriving: p, leaving: q, other_disk: disks[0] }
        } else {
            End { edge, arriving: q, leaving: p, other_disk: disks[1] }
        }
    }

    /// Joins the two edges at a disk if they are parts of one.
    fn join_at(&mut self, disk: u32) {
        let &[e, f] = self.edges_at[disk as usize].as_slice() else { return };
        if e == f {
            return;
        }
        let (e, f) = (self.end(e, disk), self.end(f, disk));
        if !(self.goes_on(e.arriving, f.leaving) && self.goes_on(f.arriving, e.leaving)) {
            return;
        }
        self.join_pieces(e.arriving, f.leaving);
        self.join_pieces(f.arriving, e.leaving);
        self.graph.edges[e.edge as usize] =
            GraphEdge { pieces: [e.arriving, f.arriving], disks: [e.other_disk, f.other_disk] };
        let at_far_end = self.edges_at[f.other_disk as usize].iter_mut();
        at_far_end.filter(|id| **id == f.edge).for_each(|id| *id = e.edge);
        self.dead_edges[f.edge as usize] = true;
        self.dead_disks[disk as usize] = true;
    }

    /// Whether the boundary goes on along the same site from one piece to another, over nothing but
    /// pieces without length.
    fn goes_on(&self, from: u32, to: u32) -> bool {
        let site = |p: u32| self.graph.pieces[p as usize].site;
        let mut at = self.graph.pieces[from as usize].next;
        while at != to && self.graph.pieces[at as usize].edge == NONE && site(at) == site(from) && at != from
        {
            at = self.graph.pieces[at as usize].next;
        }
        at == to && site(at) == site(from)
    }

    fn join_pieces(&mut self, first: u32, last: u32) {
        let mut at = self.graph.pieces[first as usize].next;
        while at != last {
            self.dead_pieces[at as usize] = true;
            at = self.graph.pieces[at as usize].next;
        }
        self.dead_pieces[last as usize] = true;
        self.graph.pieces[first as usize].next = self.graph.pieces[last as usize].next;
    }

    /// The graph of what is left, numbered anew.
    fn finish(self) -> Graph {
        let numbers = |dead: &[bool]| {
            let mut count = 0;
            let number = |&dead: &bool| {
                count += u32::from(!dead);
                if dead { NONE } else { count - 1 }
            };
            dead.iter().map(number).collect::<Vec<u32>>()
        };
        let [disk_number, piece_number] = [&self.dead_disks, &self.dead_pieces].map(|dead| numbers(dead));
        let Graph { feet, error, .. } = &self.graph;
        let mut graph = Graph { feet: feet.clone(), error: *error, ..Graph::default() };
        let alive = |dead: &[bool], i: usize| !dead[i];
        let disks = self.graph.disks.iter().enumerate().filter(|(i, _)| alive(&self.dead_disks, *i));
        graph.disks = disks.map(|(_, d)| *d).collect();
        let pieces = self.graph.pieces.iter().enumerate().filter(|(i, _)| alive(&self.dead_pieces, *i));
        let renumbered =
            |p: &BoundaryPiece| BoundaryPiece { next: piece_number[p.next as usize], edge: NONE, ..*p };
        graph.pieces = pieces.map(|(_, p)| renumbered(p)).collect();
        for (i, edge) in self.graph.edges.iter().enumerate() {
            if alive(&self.dead_edges, i) {
                let pieces = edge.pieces.map(|p| piece_number[p as usize]);
                graph.add_edge(pieces, edge.disks.map(|d| disk_number[d as usize]));
            }
        }
        graph
    }
}
