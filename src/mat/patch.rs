//! Faces solved side by side.
//!
//! A piece of the boundary lies in one face, so faces have nothing in common but the disks at their chords, which
//! stay as they are. Some faces in a row are solved on a *patch* of the graph: copies of their pieces and disks,
//! close together, and what is made of them. Patches are written back in the order of their faces, so that ids
//! do not depend on threads.

use super::face::{Face, Slot};
use super::graph::{Graph, GraphEdge};
use super::piece::{Piece, UnitDisk};
use super::site::{Foot, Site};
use rayon::prelude::*;

/// All faces of a map, each a range of slots.
pub(super) struct Faces {
    slots: Vec<Slot>,
    /// Where each face ends.
    ends: Vec<u32>,
}

/// Faces to a patch: enough that threads have something to do, few enough that copies are small.
const FACES: usize = 128;

/// Patches that are solved at a time.
const PATCHES: usize = 64;

impl Faces {
    /// No faces, with room for some slots.
    pub fn with_capacity(slots: usize) -> Faces {
        Faces { slots: Vec::with_capacity(slots), ends: Vec::new() }
    }

    pub fn push(&mut self, slot: Slot) {
        self.slots.push(slot);
    }

    /// Ends a face; one of less than two pieces has no edge.
    pub fn close(&mut self) {
        match self.open().len() {
            0 | 1 => self.leave_out(),
            _ => self.ends.push(self.slots.len() as u32),
        }
    }

    /// The face that is not ended yet.
    pub fn open(&self) -> &[Slot] {
        &self.slots[self.ends.last().map_or(0, |&end| end as usize)..]
    }

    /// Drops the face that is not ended yet.
    pub fn leave_out(&mut self) {
        self.slots.truncate(self.ends.last().map_or(0, |&end| end as usize));
    }

    /// Gives disks other numbers.
    pub fn renumber_disks(&mut self, number: &[u32]) {
        self.slots.iter_mut().for_each(|slot| slot.disk = number[slot.disk as usize]);
    }

    /// Solves all faces.
    pub fn solve(self, sites: &[Site], graph: &mut Graph) {
        graph.reserve(self.growth());
        let mut begin = 0;
        for ends in self.ends.chunks(FACES * PATCHES) {
            let face = |&end: &u32| &self.slots[std::mem::replace(&mut begin, end as usize)..end as usize];
            let faces: Vec<&[Slot]> = ends.iter().map(face).collect();
            let shared = &*graph;
            let patches: Vec<Patch> =
                faces.par_chunks(FACES).map(|faces| Patch::of(sites, shared, faces)).collect();
            for (faces, patch) in faces.chunks(FACES).zip(patches) {
                patch.write(graph, faces);
            }
        }
    }

    /// How many disks, pieces and edges faces add: `n` pieces need `n - 2` branch disks, each of which cuts three
    /// pieces and divides the face.
    fn growth(&self) -> [usize; 3] {
        let branches = self.slots.len() - 2 * self.ends.len();
        [branches, 3 * branches, 2 * branches + self.ends.len()]
    }
}

/// A part of the graph on which some faces are solved. Ids are its own.
pub(super) struct Patch {
    pub disks: Vec<UnitDisk>,
    pub pieces: Vec<Piece>,
    pub error: f64,
    edges: Vec<GraphEdge>,
    /// Pieces that were cut, and their rests.
    cuts: Vec<[u32; 2]>,
    /// How much there was after each face.
    ends: Vec<Extent>,
}

/// Numbers of things.
#[derive(Clone, Copy, Default)]
struct Extent {
    disks: usize,
    pieces: usize,
    edges: usize,
    cuts: usize,
}

impl Patch {
    /// The large ones of some faces, solved.
    fn of(sites: &[Site], graph: &Graph, faces: &[&[Slot]]) -> Patch {
        let error = graph.error;
        let (disks, pieces, edges) = Default::default();
        let mut patch = Patch { disks, pieces, error, edges, cuts: Vec::new(), ends: Vec::new() };
        let mut own = Vec::new();
        // Most faces are one edge.
        for face in faces.iter().filter(|face| face.len() > 2) {
            own.clear();
            for slot in *face {
                own.push(Slot { piece: patch.pieces.len() as u32, disk: patch.disks.len() as u32 });
                patch.pieces.push(graph.piece(sites, slot.piece));
                patch.disks.push(graph.disks[slot.disk as usize]);
            }
            Face::solve(sites, &own, &mut patch);
            patch.ends.push(patch.extent());
        }
        patch
    }

    fn extent(&self) -> Extent {
        let (disks, pieces) = (self.disks.len(), self.pieces.len());
        Extent { disks, pieces, edges: self.edges.len(), cuts: self.cuts.len() }
    }

    pub fn add_disk(&mut self, disk: UnitDisk) -> u32 {
        self.disks.push(disk);
        self.disks.len() as u32 - 1
    }

    pub fn add_edge(&mut self, pieces: [u32; 2], disks: [u32; 2]) {
        self.edges.push(GraphEdge { pieces, disks });
    }

    /// Cuts a piece at a foot; the id stays with the first part, that of the rest is returned.
    pub fn cut(&mut self, sites: &[Site], id: u32, foot: Foot) -> u32 {
        let rest_id = self.pieces.len() as u32;
        let rest = self.pieces[id as usize].cut(sites, foot);
        self.pieces.push(rest);
        self.cuts.push([id, rest_id]);
        rest_id
    }

    /// Writes faces into the graph.
    fn write(&self, graph: &mut Graph, faces: &[&[Slot]]) {
        let (mut ends, mut begin) = (self.ends.iter(), Extent::default());
        for face in faces {
            if let [a, b] = face {
                graph.add_edge([a.piece, b.piece], [b.disk, a.disk]);
            } else if let Some(&end) = ends.next() {
                self.write_face(graph, face, begin, end);
                begin = end;
            }
        }
    }

    fn write_face(&self, graph: &mut Graph, slots: &[Slot], begin: Extent, end: Extent) {
        let n = slots.len();
        let (new_disks, new_pieces) = (graph.disks.len(), graph.pieces.len());
        let disk = |id: u32| match id as usize - begin.disks {
            i if i < n => slots[i].disk,
            i => (new_disks + i - n) as u32,
        };
        let piece = |id: u32| match id as usize - begin.pieces {
            i if i < n => slots[i].piece,
            i => (new_pieces + i - n) as u32,
        };
        graph.disks.extend_from_slice(&self.disks[begin.disks + n..end.disks]);
        graph.add_rests(&self.pieces[begin.pieces + n..end.pieces]);
        for &[cut, rest] in &self.cuts[begin.cuts..end.cuts] {
            graph.follow(piece(cut), piece(rest));
        }
        for edge in &self.edges[begin.edges..end.edges] {
            graph.add_edge(edge.pieces.map(piece), edge.disks.map(disk));
        }
    }
}
