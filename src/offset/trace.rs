//! Walking around what lies farther from the boundary than a distance.

use super::crossing::Entry;
use super::runs::Runs;
use crate::geom::Point;
use crate::mat::{Circuit, Foot, Leg, Mat, Ring, Site, Stop, Way};

/// A stretch of the boundary whose offset is part of the level set, within one element or vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The stops of its first and last piece.
    pub first: u32,
    pub last: u32,
    /// Bulge of its offset.
    pub bulge: f64,
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
    pub ranks: Ranks,
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
    pub fn is_larger(&self, radius: f64) -> bool {
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
    pub fn walks<T: Default>(&self, mut make: impl FnMut(&[Stretch]) -> Option<T>) -> Vec<T> {
        let mut walk = Vec::new();
        let (mut whole, mut around) = (InOrder::new(), InOrder::new());
        for ring in self.circuit.rings.iter().filter(|ring| self.is_larger(ring.least)) {
            walk.clear();
            self.whole_ring(ring, &mut walk);
            whole.add(ring.number, make(&walk));
        }
        let runs = Runs::of(self);
        let mut done = vec![false; self.entries.len()];
        for first in 0..self.entries.len() {
            if !done[first] {
                walk.clear();
                let first_edge = runs.walk_from(first, &mut done, &mut walk);
                around.add(first_edge, make(&walk));
            }
        }
        whole.sorted().chain(around.sorted()).collect()
    }

    /// The stop that follows on the boundary.
    #[inline]
    pub fn following(&self, at: u32) -> u32 {
        let next = self.way(at + 1);
        if next.is_end { next.across } else { at + 1 }
    }

    /// A ring of the boundary that is inside all along.
    fn whole_ring(&self, ring: &Ring, walk: &mut Vec<Stretch>) {
        let legs = &self.circuit.legs[ring.legs.start as usize..=ring.legs.end as usize];
        walk.extend(legs.windows(2).map(|pair| self.whole_leg(&pair[0], &pair[1])));
    }

    /// A leg that is inside all along, before another.
    #[inline]
    pub fn whole_leg(&self, leg: &Leg, next: &Leg) -> Stretch {
        let start = leg.foot.point + leg.foot.normal * self.d;
        Stretch { first: leg.first, last: next.first - 1, bulge: leg.bulge, start, at_crossing: false }
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

/// What is made in one order and asked for in another.
struct InOrder<T> {
    made: Vec<T>,
    /// Keys and places of what is made.
    keys: Vec<(u32, u32)>,
}

impl<T: Default> InOrder<T> {
    fn new() -> InOrder<T> {
        InOrder { made: Vec::new(), keys: Vec::new() }
    }

    fn add(&mut self, key: u32, made: Option<T>) {
        let Some(made) = made else { return };
        self.keys.push((key, self.made.len() as u32));
        self.made.push(made);
    }

    /// In the order of keys, of which no two are the same.
    fn sorted(mut self) -> impl Iterator<Item = T> {
        self.keys.sort_unstable_by_key(|&(key, _)| key);
        self.keys.into_iter().map(move |(_, at)| std::mem::take(&mut self.made[at as usize]))
    }
}

/// A set of ids, a bit for each, and how many come before each word of them.
pub(super) struct Ranks(Vec<(u64, u32)>);

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
    #[inline]
    pub fn rank(&self, id: u32) -> usize {
        let (word, before) = self.0[id as usize / 64];
        before as usize + (word & ((1 << (id % 64)) - 1)).count_ones() as usize
    }
}
