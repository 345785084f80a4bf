//! The axis as a graph under construction: disks, pieces of the boundary, and edges between them.

use super::lamination::Lamination;
use super::patch::Faces;
use super::piece::{Piece, UnitDisk, cut_vertex};
use super::root::falling_root;
use super::site::{Foot, NONE, Site};
use super::touch::foot_of;
use super::track::Track;
use super::union::Sets;
use rayon::prelude::*;

/// A piece with its place on the boundary and in the axis. It ends where the next one on its site begins, or with the
/// site: see [`Graph::piece`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundaryPiece {
    /// Where it begins, one of [`Graph::feet`]; [`NONE`] for the beginning of its site.
    pub foot: u32,
    pub site: u32,
    /// The piece that follows on the boundary; [`NONE`] for what is no piece, the way over a link.
    pub next: u32,
    /// The edge on its left, [`NONE`] along the contact arc of a leaf.
    pub edge: u32,
    /// Whether the axis beside it is left out.
    pub left_out: bool,
}

/// An edge of the axis between the pieces on its two sides.
///
/// `pieces[0]` runs along with the edge, `pieces[1]` against it: each starts in the disk in which
/// the other ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GraphEdge {
    pub pieces: [u32; 2],
    pub disks: [u32; 2],
}

/// Disks, pieces and edges; ids are indices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    pub disks: Vec<UnitDisk>,
    /// Where disks touch sites between their ends.
    pub feet: Vec<Foot>,
    pub pieces: Vec<BoundaryPiece>,
    pub edges: Vec<GraphEdge>,
    /// Round-off of a disk, in the unit frame: closer disks are one, closer radii equal.
    pub error: f64,
}

/// Roundings in a disk: its center and radius come from four numbers with eight roundings each. Times
/// the round-off of a drawn coordinate that is the distance within which disks are one and radii equal.
pub(super) const DISK_ROUNDINGS: f64 = 32.0;

impl BoundaryPiece {
    /// Whether it begins where its site does.
    #[inline]
    pub fn begins(&self) -> bool {
        self.foot == NONE
    }
}

impl Graph {
    /// The graph of a lamination: all faces solved, or those with a free site.
    pub(super) fn of(sites: &[Site], mut map: Lamination, free: Option<&[bool]>, error: f64) -> Graph {
        let mut graph = Graph { disks: std::mem::take(&mut map.disks), error, ..Graph::default() };
        graph.pieces = map.pieces(sites);
        graph.feet = map.take_feet();
        let faces = graph.faces_of(&map, free);
        // What follows needs the faces alone.
        drop(map);
        faces.solve(sites, &mut graph);
        graph
    }

    /// Where a piece begins.
    #[inline]
    pub fn from(&self, sites: &[Site], id: u32) -> Foot {
        self.beginning(sites, &self.pieces[id as usize])
    }

    #[inline]
    fn beginning(&self, sites: &[Site], piece: &BoundaryPiece) -> Foot {
        if piece.begins() { sites[piece.site as usize].start } else { self.feet[piece.foot as usize] }
    }

    /// A piece with both of its ends.
    #[inline]
    pub fn piece(&self, sites: &[Site], id: u32) -> Piece {
        let piece = &self.pieces[id as usize];
        let BoundaryPiece { site, next, .. } = *piece;
        let whole = &sites[site as usize];
        let cut = cut_vertex(whole);
        let v0 = if piece.begins() { whole.vertices[0] } else { cut };
        let (to, v1) = match self.pieces.get(next as usize) {
            Some(after) if after.site == site => (self.beginning(sites, after), cut),
            _ => (whole.end, whole.vertices[1]),
        };
        let from = self.beginning(sites, piece);
        Piece { site, from, to, vertices: [v0, v1] }
    }

    /// The faces of a map; only those with a site that is free, if only such are asked for.
    fn faces_of(&mut self, map: &Lamination, free: Option<&[bool]>) -> Faces {
        let mut faces = Faces::with_capacity(map.visits.len());
        let Some(free) = free else {
            map.each_slot(|slot| match slot {
                Some(slot) => faces.push(slot),
                None => faces.close(),
            });
            return faces;
        };
        let mut is_asked_for = vec![false; self.disks.len()];
        map.each_slot(|slot| {
            if let Some(slot) = slot {
                return faces.push(slot);
            }
            if faces.open().iter().any(|slot| free[self.pieces[slot.piece as usize].site as usize]) {
                faces.open().iter().for_each(|slot| is_asked_for[slot.disk as usize] = true);
                faces.close();
            } else {
                faces.open().iter().for_each(|slot| self.pieces[slot.piece as usize].left_out = true);
                faces.leave_out();
            }
        });
        faces.renumber_disks(&self.keep_disks(&is_asked_for));
        faces
    }

    /// Drops the other disks; the new number of each that is kept.
    fn keep_disks(&mut self, is_kept: &[bool]) -> Vec<u32> {
        let mut numbers = Vec::with_capacity(is_kept.len());
        let mut count = 0;
        for &is_kept in is_kept {
            numbers.push(count);
            count += u32::from(is_kept);
        }
        let mut kept = is_kept.iter();
        self.disks.retain(|_| kept.next().is_some_and(|&is_kept| is_kept));
        numbers
    }

    /// Makes room for so many more disks, cuts of pieces, and edges.
    pub(super) fn reserve(&mut self, [disks, cuts, edges]: [usize; 3]) {
        self.disks.reserve_exact(disks);
        self.feet.reserve_exact(cuts);
        self.pieces.reserve_exact(cuts);
        self.edges.reserve_exact(edges);
    }

    /// Adds rests of pieces that follow on none yet and have no edge.
    pub(super) fn add_rests(&mut self, rests: &[Piece]) {
        for &Piece { from, site, .. } in rests {
            let foot = self.add_foot(from);
            self.pieces.push(BoundaryPiece { foot, site, next: NONE, edge: NONE, left_out: false });
        }
    }

    /// Lets a rest follow on the piece that it was cut from.
    pub(super) fn follow(&mut self, cut: u32, rest: u32) {
        self.pieces[rest as usize].next = self.pieces[cut as usize].next;
        self.pieces[cut as usize].next = rest;
    }

    /// Gives back what is reserved for more.
    pub(super) fn shrink(&mut self) {
        self.disks.shrink_to_fit();
        self.feet.shrink_to_fit();
        self.pieces.shrink_to_fit();
        self.edges.shrink_to_fit();
    }

    /// Disks that are a whole part of the pocket, without an edge, in the order of their rings.
    pub(super) fn lone_disks(&self) -> Vec<u32> {
        let mut is_lone = vec![true; self.disks.len()];
        self.edges.iter().flat_map(|e| e.disks).for_each(|d| is_lone[d as usize] = false);
        (0..self.disks.len() as u32).filter(|&d| is_lone[d as usize]).collect()
    }

    pub(super) fn add_disk(&mut self, disk: UnitDisk) -> u32 {
        self.disks.push(disk);
        self.disks.len() as u32 - 1
    }

    fn add_foot(&mut self, foot: Foot) -> u32 {
        self.feet.push(foot);
        self.feet.len() as u32 - 1
    }

    pub(super) fn add_edge(&mut self, pieces: [u32; 2], disks: [u32; 2]) {
        let id = self.edges.len() as u32;
        for p in pieces {
            self.pieces[p as usize].edge = id;
        }
        self.edges.push(GraphEdge { pieces, disks });
    }

    /// Cuts a piece at a foot; the id stays with the first part, that of the rest is returned.
    pub(super) fn cut(&mut self, id: u32, foot: Foot) -> u32 {
        let rest_id = self.pieces.len() as u32;
        let foot = self.add_foot(foot);
        self.pieces.push(BoundaryPiece { foot, ..self.pieces[id as usize] });
        self.follow(id, rest_id);
        rest_id
    }

    /// Unites the ends of edges without length and drops these edges.
    ///
    /// Ties leave such edges between disks that differ by round-off only. Edges are contracted one
    /// by one while their ends are different vertices, so V - E stays what it is.
    pub(super) fn contract(&mut self) {
        let Graph { disks, pieces, edges, error, .. } = self;
        let mut same = Sets::singles(disks.len());
        edges.retain(|edge| {
            // The older disk stays for both: it comes from a joint, not from an intersection.
            let [a, b] = edge.disks.map(|d| same.find(d));
            let apart = disks[a as usize].apart(&disks[b as usize]);
            !(apart <= *error && same.unite(a, b))
        });
        let number = same.numbers();
        let mut count = 0;
        for i in 0..disks.len() {
            // A disk that stays is the first of its set.
            if number[i] == count {
                disks[count as usize] = disks[i];
                count += 1;
            }
        }
        disks.truncate(count as usize);
        pieces.iter_mut().for_each(|piece| piece.edge = NONE);
        for (id, edge) in (0u32..).zip(edges) {
            edge.pieces.iter().for_each(|&p| pieces[p as usize].edge = id);
            edge.disks = edge.disks.map(|d| number[d as usize]);
        }
    }

    /// Splits edges where the radius has an extremum inside, so that it is monotone along each.
    ///
    /// Along an edge the radius grows as `n_b x n_a`, with the normals at the two feet; a bisector of
    /// two carriers has at most one place where they are opposite.
    pub(super) fn split_at_extrema(&mut self, sites: &[Site]) {
        let shared = &*self;
        let edges = (0..self.edges.len()).into_par_iter().with_min_len(EDGES);
        let extrema: Vec<Extremum> = edges.filter_map(|id| shared.extremum(sites, id)).collect();
        self.reserve([extrema.len(), 2 * extrema.len(), extrema.len()]);
        for Extremum { id, disk, feet } in extrema {
            let edge = self.edges[id];
            let middle = self.add_disk(disk);
            let rest_a = self.cut(edge.pieces[0], feet[0]);
            let rest_b = self.cut(edge.pieces[1], feet[1]);
            self.edges[id] = GraphEdge { pieces: [edge.pieces[0], rest_b], disks: [edge.disks[0], middle] };
            self.pieces[rest_b as usize].edge = id as u32;
            self.add_edge([rest_a, edge.pieces[1]], [middle, edge.disks[1]]);
        }
    }

    /// Where the radius has an extremum inside an edge.
    fn extremum(&self, sites: &[Site], id: usize) -> Option<Extremum> {
        let edge = self.edges[id];
        let [a, b] = edge.pieces.map(|p| self.piece(sites, p));
        let mut growth = [b.to.normal.cross(a.from.normal), b.from.normal.cross(a.to.normal)];
        // From a corner the radius can only grow, however flat its cusp.
        let radii = edge.disks.map(|d| self.disks[d as usize].radius);
        growth[0] = if radii[0] == 0.0 { 1.0 } else { growth[0] };
        growth[1] = if radii[1] == 0.0 { -1.0 } else { growth[1] };
        if !(growth[0] * growth[1] < 0.0 && growth.iter().all(|g| g.abs() > NORMAL_ERROR)) {
            return None;
        }
        let minimum = growth[0] < 0.0;
        // The longer piece is the better ruler.
        let extent = |p: &Piece| p.from.point.distance(p.to.point);
        let swap = extent(&b) > extent(&a);
        let (along, across) = if swap { (&b, &a) } else { (&a, &b) };
        let track = Track::of(sites, along);
        let (here, there) = (&sites[along.site as usize], &sites[across.site as usize]);

        let sign = if minimum { -1.0 } else { 1.0 };
        let t = falling_root(0.0, 1.0, |t| {
            let probe = track.at(t);
            let (radius, _) = track.reach(sites, across, &probe);
            if !radius.is_finite() {
                return 0.0;
            }
            let opposite = foot_of(there, probe.center(radius), &across.from, &across.to);
            let sine = opposite.normal.cross(probe.normal);
            if (sine * radius).abs() <= NORMAL_ERROR { 0.0 } else { sign * sine }
        });
        let probe = track.at(t);
        let (radius, _) = track.reach(sites, across, &probe);
        let beyond = if minimum { radii[0].min(radii[1]) - radius } else { radius - radii[0].max(radii[1]) };
        // Where the radius is as good as constant, round-off makes extrema that are none.
        if !(beyond > self.error && radius.is_finite()) {
            return None;
        }
        let disk = UnitDisk { center: probe.center(radius), radius };
        let feet = [(here, along), (there, across)].map(|(s, p)| foot_of(s, disk.center, &p.from, &p.to));
        Some(Extremum { id, disk, feet: if swap { [feet[1], feet[0]] } else { feet } })
    }
}

/// Edges to look at in one go.
const EDGES: usize = 256;

/// A disk inside an edge where the radius has an extremum, and its feet on the two pieces.
struct Extremum {
    id: usize,
    disk: UnitDisk,
    feet: [Foot; 2],
}

/// Round-off of the sine between two unit normals of four roundings each.
const NORMAL_ERROR: f64 = 8.0 * f64::EPSILON;
