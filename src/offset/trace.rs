//! Walking around what lies farther from the boundary than a distance.

use crate::geom::Point;
use crate::mat::{BoundaryPiece, Foot, GraphEdge, Mat, NONE, Piece, Site};

/// A stretch of the boundary whose offset is part of the level set, within one site.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub site: u32,
    /// Angle by which the normal turns from `from` to `to`, counter-clockwise positive.
    pub turn: f64,
    pub from: Foot,
    pub to: Foot,
    /// Where its offset begins.
    pub start: Point,
    /// Whether it begins on the axis, at a crossing with another stretch.
    pub at_crossing: bool,
}

/// One distance in one axis, in the unit frame.
pub(super) struct Tracer<'a> {
    pub mat: &'a Mat,
    pub d: f64,
    /// The edges whose radii reach to `d`.
    pub edges: Vec<u32>,
}

impl<'a> Tracer<'a> {
    pub fn new(mat: &'a Mat, d: f64) -> Tracer<'a> {
        Tracer { mat, d, edges: mat.radii().edges_at(d) }
    }

    /// Whether more than round-off of the pocket is farther away than `d` at a vertex.
    pub fn is_inside(&self, vertex: u32) -> bool {
        self.mat.graph.disks[vertex as usize].radius > self.d + self.mat.graph.error
    }

    pub(super) fn edge(&self, id: u32) -> &GraphEdge {
        &self.mat.graph.edges[id as usize]
    }

    pub(super) fn piece(&self, id: u32) -> &BoundaryPiece {
        &self.mat.graph.pieces[id as usize]
    }

    /// Which of an edge's pieces runs into the inside, if the level crosses the edge.
    fn entering(&self, edge: u32) -> Option<u32> {
        let e = self.edge(edge);
        match e.disks.map(|d| self.is_inside(d)) {
            [false, true] => Some(e.pieces[0]),
            [true, false] => Some(e.pieces[1]),
            _ => None,
        }
    }

    /// All closed walks.
    pub fn walks(&self) -> Vec<Vec<Stretch>> {
        let mut walks = Vec::new();
        for &(first, least) in &self.mat.radii().rings {
            if least > self.d + self.mat.graph.error {
                walks.push(self.whole_ring(first));
            }
        }
        let mut done = Marks::up_to(self.edges.last().copied());
        for &edge in &self.edges {
            if let Some(entering) = self.entering(edge)
                && !done.contains(&edge)
            {
                walks.push(self.walk_from(entering, &mut done));
            }
        }
        walks
    }

    /// A ring of the boundary that is inside all along.
    fn whole_ring(&self, first: u32) -> Vec<Stretch> {
        // Begin where a site does, so that no stretch is cut.
        let mut start = first;
        while self.piece(start).piece.site == self.piece(self.piece(start).next).piece.site {
            start = self.piece(start).next;
            if start == first {
                break;
            }
        }
        start = self.piece(start).next;
        let mut walk = Vec::new();
        let mut at = start;
        loop {
            let piece = &self.piece(at).piece;
            self.add(&mut walk, piece.site, piece.from, piece.to, None);
            at = self.piece(at).next;
            if at == start {
                return walk;
            }
        }
    }

    /// The walk that begins where the level crosses the edge of `first` into the inside.
    fn walk_from(&self, first: u32, done: &mut Marks) -> Vec<Stretch> {
        let mut walk = Vec::new();
        let mut entering = first;
        let mut center = self.crossing(self.piece(first).edge);
        loop {
            done.insert(self.piece(entering).edge);
            let piece = self.piece(entering).piece;
            let foot = self.foot_below(&piece, center);
            self.add(&mut walk, piece.site, foot, piece.to, Some(center));
            let mut at = self.piece(entering).next;
            // Along the boundary until the level crosses an edge again, going out.
            loop {
                let BoundaryPiece { piece, next, edge } = *self.piece(at);
                if edge != NONE && self.entering(edge).is_some() {
                    center = self.crossing(edge);
                    let foot = self.foot_below(&piece, center);
                    self.add(&mut walk, piece.site, piece.from, foot, None);
                    let pieces = self.edge(edge).pieces;
                    entering = if pieces[0] == at { pieces[1] } else { pieces[0] };
                    break;
                }
                self.add(&mut walk, piece.site, piece.from, piece.to, None);
                at = next;
            }
            if entering == first {
                return walk;
            }
        }
    }

    /// Foot of a crossing on the carrier of a piece: where a neck is flat, the crossing may lie beyond
    /// the piece by the root of round-off, and its normal must be the one it really has.
    pub fn foot_below(&self, piece: &Piece, crossing: Point) -> Foot {
        let (distance, normal) = self.site(piece).carrier_distance(crossing);
        Foot { point: crossing - normal * distance, normal }
    }

    pub(super) fn site(&self, piece: &Piece) -> &Site {
        &self.mat.sites[piece.site as usize]
    }

    /// Adds a stretch, as one with the last if that is on the same site or arc and no crossing lies
    /// between them.
    fn add(&self, walk: &mut Vec<Stretch>, site: u32, from: Foot, to: Foot, crossing: Option<Point>) {
        let s = &self.mat.sites[site as usize];
        let straight = s.curvature == 0.0 && !s.is_vertex;
        let turn = if straight { 0.0 } else { from.normal.angle_to(to.normal) };
        if let (None, Some(last)) = (crossing, walk.last_mut()) {
            let other = &self.mat.sites[last.site as usize];
            let same = last.site == site
                || s.source == other.source && (last.turn + turn).abs() <= std::f64::consts::PI;
            if same {
                last.to = to;
                last.turn += turn;
                last.site = site;
                return;
            }
        }
        let start = crossing.unwrap_or(from.point + from.normal * self.d);
        walk.push(Stretch { site, turn, from, to, start, at_crossing: crossing.is_some() });
    }
}

/// A set of ids, a bit for each.
struct Marks(Vec<u64>);

impl Marks {
    /// Empty, for ids up to a largest one.
    fn up_to(largest: Option<u32>) -> Marks {
        Marks(vec![0; largest.map_or(0, |id| id as usize / 64 + 1)])
    }

    fn insert(&mut self, id: u32) {
        self.0[id as usize / 64] |= 1 << (id % 64);
    }

    fn contains(&self, id: &u32) -> bool {
        self.0[*id as usize / 64] & (1 << (id % 64)) != 0
    }
}
