//! Walking around what lies farther from the boundary than a distance.

use super::crossing::Entry;
use crate::geom::Point;
use crate::mat::{After, Circuit, Foot, Mat, Ring, Site, Stop, Way};

/// A stretch of the boundary whose offset is part of the level set, within one element or vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The stops of its first and last piece.
    pub first: u32,
    pub last: u32,
    /// Angle by which the normal turns along it, counter-clockwise positive.
    pub turn: f64,
    /// Where its offset begins.
    pub start: Point,
    /// Whether it begins on the axis, at a crossing with another stretch.
    pub at_crossing: bool,
}

/// One distance in one axis, in the unit frame.
pub(super) struct Tracer<'a> {
    pub mat: &'a Mat,
    pub d: f64,
    pub circuit: &'a Circuit,
    /// How far beyond the ends of an edge its level may be found: `s` beyond the end of a wall the distance to it
    /// is no more than `s^2 / 2d` larger.
    pub beyond: f64,
    /// Where the level goes into the inside, in the order of the boundary.
    pub entries: Vec<Entry>,
    /// The numbers of entries by their stops.
    ranks: Ranks,
    /// The edges with an end that is as far away as `d`, in order of id.
    pub edges_at: Vec<u32>,
}

impl<'a> Tracer<'a> {
    pub fn new(mat: &'a Mat, d: f64) -> Tracer<'a> {
        let circuit = &mat.radii().circuit;
        let (mut stops, mut edges_at) = (Vec::new(), Vec::new());
        let is_piece = |at: u32| circuit.ways[at as usize].has_edge();
        let rises = |at| stops.extend(is_piece(at).then_some(at));
        let equals = |at| edges_at.extend(is_piece(at).then(|| circuit.stops[at as usize].edge));
        mat.radii().search(d, rises, equals);
        edges_at.sort_unstable();
        edges_at.dedup();
        let ranks = Ranks::of(&stops);
        let beyond = (2.0 * d * mat.graph.error).sqrt();
        let mut tracer = Tracer { mat, d, circuit, beyond, entries: Vec::new(), ranks, edges_at };
        tracer.entries = tracer.entries(&stops);
        tracer
    }

    /// Whether a radius is larger than `d` by more than round-off.
    #[inline]
    fn is_larger(&self, radius: f64) -> bool {
        radius > self.d + self.mat.graph.error
    }

    /// Whether a radius is `d` to round-off.
    #[inline]
    pub fn is_equal(&self, radius: f64) -> bool {
        (radius - self.d).abs() <= self.mat.graph.error
    }

    /// Whether more than round-off of the pocket is farther away than `d` at a vertex.
    pub fn is_inside(&self, vertex: u32) -> bool {
        self.is_larger(self.mat.graph.disks[vertex as usize].radius)
    }

    #[inline]
    pub fn stop(&self, at: u32) -> &'a Stop {
        &self.circuit.stops[at as usize]
    }

    #[inline]
    pub fn way(&self, at: u32) -> &'a Way {
        &self.circuit.ways[at as usize]
    }

    #[inline]
    pub fn site(&self, stop: &Stop) -> &'a Site {
        &self.mat.sites[stop.site as usize]
    }

    /// What is made of each closed walk, in the order of the rings that are inside all along, then of the
    /// ids of the first edges that walks cross.
    pub fn walks<T>(&self, mut make: impl FnMut(&[Stretch]) -> Option<T>) -> Vec<T> {
        let mut walk = Vec::new();
        let mut whole = Vec::new();
        for ring in self.circuit.rings.iter().filter(|ring| self.is_larger(ring.least)) {
            walk.clear();
            self.whole_ring(ring, &mut walk);
            whole.extend(make(&walk).map(|made| (ring.number, made)));
        }
        whole.sort_unstable_by_key(|&(number, _)| number);
        let runs = self.runs();
        let mut around = Vec::new();
        let mut done = vec![false; self.entries.len()];
        for first in 0..self.entries.len() {
            if !done[first] {
                walk.clear();
                let first_edge = runs.walk_from(first, &mut done, &mut walk);
                around.extend(make(&walk).map(|made| (first_edge, made)));
            }
        }
        around.sort_unstable_by_key(|&(edge, _)| edge);
        whole.into_iter().chain(around).map(|(_, made)| made).collect()
    }

    /// A ring of the boundary that is inside all along.
    fn whole_ring(&self, ring: &Ring, walk: &mut Vec<Stretch>) {
        for at in ring.stops.clone() {
            self.add(walk, at, self.way(at).turn);
        }
    }

    /// The runs from all entries.
    fn runs(&self) -> Runs {
        let mut stretches = Vec::with_capacity(2 * self.entries.len());
        let run = |entry: &Entry| {
            let begin = stretches.len() as u32;
            let &Entry { stop, edge, center: start, entering: turn, .. } = entry;
            stretches.push(Stretch { first: stop, last: stop, turn, start, at_crossing: true });
            // Along the boundary until the level crosses an edge again, going out.
            let mut at = self.following(stop);
            while self.is_larger(self.circuit.radii[at as usize + 1]) {
                self.add(&mut stretches, at, self.way(at).turn);
                at = self.following(at);
            }
            let next = self.ranks.rank(self.way(at).across);
            self.add(&mut stretches, at, self.entries[next].leaving);
            Run { begin, end: stretches.len() as u32, next: next as u32, edge }
        };
        let runs = self.entries.iter().map(run).collect();
        Runs { runs, stretches }
    }

    /// The stop that follows on the boundary.
    #[inline]
    fn following(&self, at: u32) -> u32 {
        let next = self.way(at + 1);
        if next.is_end { next.across } else { at + 1 }
    }

    /// Adds a piece or the beginning of one, as one stretch with the last if that is on the same site or arc.
    #[inline]
    fn add(&self, walk: &mut Vec<Stretch>, at: u32, turn: f64) {
        if let Some(last) = walk.last_mut() {
            let same = match self.way(at).after {
                After::SameSite => true,
                After::SameSource => (last.turn + turn).abs() <= std::f64::consts::PI,
                After::OtherSource => false,
            };
            if same {
                (last.last, last.turn) = (at, last.turn + turn);
                return;
            }
        }
        let foot = self.stop(at).foot;
        let start = foot.point + foot.normal * self.d;
        walk.push(Stretch { first: at, last: at, turn, start, at_crossing: false });
    }

    /// Where a stretch begins on the boundary.
    pub fn from(&self, stretch: &Stretch) -> Foot {
        let stop = self.stop(stretch.first);
        if stretch.at_crossing { self.foot_below(stop, stretch.start) } else { stop.foot }
    }

    /// Where a stretch ends on the boundary, if another one follows.
    pub fn to(&self, stretch: &Stretch, next: &Stretch) -> Foot {
        if next.at_crossing {
            self.foot_below(self.stop(stretch.last), next.start)
        } else {
            *self.circuit.end(&self.mat.sites, stretch.last)
        }
    }

    /// Foot of a crossing on the carrier of a piece: where a neck is flat, the crossing may lie beyond
    /// the piece by the root of round-off, and its normal must be the one it really has.
    pub fn foot_below(&self, stop: &Stop, crossing: Point) -> Foot {
        let (distance, normal) = self.site(stop).carrier_distance(crossing);
        Foot { point: crossing - normal * distance, normal }
    }
}

/// What the level follows of the boundary from one crossing to the next.
struct Run {
    /// Its stretches.
    begin: u32,
    end: u32,
    /// The run that follows it in the level.
    next: u32,
    /// The edge that it begins at.
    edge: u32,
}

/// All runs of a level in the order of the boundary, so that memory is read from one end to the other; only
/// then are they linked.
struct Runs {
    runs: Vec<Run>,
    stretches: Vec<Stretch>,
}

impl Runs {
    /// The walk that a run is part of. It begins at the crossed edge of the lowest id, which is returned.
    fn walk_from(&self, first: usize, done: &mut [bool], walk: &mut Vec<Stretch>) -> u32 {
        let mut lowest = first;
        let mut at = first;
        loop {
            done[at] = true;
            if self.runs[at].edge < self.runs[lowest].edge {
                lowest = at;
            }
            at = self.runs[at].next as usize;
            if at == first {
                break;
            }
        }
        at = lowest;
        loop {
            let Run { begin, end, next, .. } = self.runs[at];
            walk.extend_from_slice(&self.stretches[begin as usize..end as usize]);
            at = next as usize;
            if at == lowest {
                return self.runs[lowest].edge;
            }
        }
    }
}

/// A set of ids, a bit for each, and how many come before each word of them.
struct Ranks(Vec<(u64, u32)>);

impl Ranks {
    /// Of growing ids.
    fn of(ids: &[u32]) -> Ranks {
        let mut words = vec![(0u64, 0u32); ids.last().map_or(0, |&id| id as usize / 64 + 1)];
        ids.iter().for_each(|&id| words[id as usize / 64].0 |= 1 << (id % 64));
        let mut count = 0;
        for word in &mut words {
            word.1 = count;
            count += word.0.count_ones();
        }
        Ranks(words)
    }

    /// How many ids are lower than one.
    fn rank(&self, id: u32) -> usize {
        let (word, before) = self.0[id as usize / 64];
        before as usize + (word & ((1 << (id % 64)) - 1)).count_ones() as usize
    }
}
