//! What a level follows of the boundary from one crossing to the next.
//!
//! **Guarantees** stretches as long as one arc, with the bulges that their turns have.
//!
//! **Method.** All runs of a level are made in the order of the boundary, so that memory is read from one end to
//! the other, and only then linked. A run goes from piece to piece until an element begins, then from leg to leg
//! as long as they are inside, and again from piece to piece to where the level goes out.

use super::crossing::Entry;
use super::trace::{Stretch, Tracer};
use crate::mat::{After, bulge_of};

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

/// All runs of a level in the order of the boundary.
pub(super) struct Runs {
    runs: Vec<Run>,
    stretches: Vec<Stretch>,
}

impl Runs {
    /// The runs from all entries.
    pub fn of(tracer: &Tracer) -> Runs {
        let stretches = Vec::with_capacity(2 * tracer.entries.len());
        let mut trail = Trail { tracer, stretches, turn: 0.0, open: false };
        let runs = tracer.entries.iter().map(|entry| trail.run(entry)).collect();
        Runs { runs, stretches: trail.stretches }
    }

    /// The walk that a run is part of. It begins at the crossed edge of the lowest id, which is returned.
    pub fn walk_from(&self, first: usize, done: &mut [bool], walk: &mut Vec<Stretch>) -> u32 {
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

/// Stretches as they are made.
struct Trail<'t, 'a> {
    tracer: &'t Tracer<'a>,
    stretches: Vec<Stretch>,
    /// How far the normal turns along the last one.
    turn: f64,
    /// Whether its bulge is still that of less.
    open: bool,
}

impl Trail<'_, '_> {
    /// Along the boundary from where the level goes into the inside to where it goes out again.
    fn run(&mut self, entry: &Entry) -> Run {
        let tracer = self.tracer;
        let begin = self.stretches.len() as u32;
        let &Entry { stop, edge, center: start, entering, .. } = entry;
        self.begin(Stretch { first: stop, last: stop, bulge: 0.0, start, at_crossing: true }, entering);
        let mut at = self.along_legs(tracer.following(stop));
        while tracer.is_larger(tracer.circuit.radii[at as usize + 1]) {
            self.add(at, tracer.way(at).turn);
            at = self.along_legs(tracer.following(at));
        }
        let next = tracer.ranks.rank(tracer.way(at).across);
        self.add(at, tracer.entries[next].leaving);
        self.close();
        Run { begin, end: self.stretches.len() as u32, next: next as u32, edge }
    }

    /// Where an element begins, along the legs that are inside; the stop that they lead to.
    #[inline]
    fn along_legs(&mut self, mut at: u32) -> u32 {
        let (tracer, legs) = (self.tracer, &self.tracer.circuit.legs);
        while tracer.way(at).after == After::OtherSource {
            let mut leg = tracer.stop(at).leg as usize;
            if !tracer.is_larger(legs[leg].least) {
                break;
            }
            self.close();
            while tracer.is_larger(legs[leg].least) {
                self.stretches.push(tracer.whole_leg(&legs[leg], &legs[leg + 1]));
                self.turn = legs[leg].turn;
                leg += 1;
            }
            at = legs[leg].first;
            if !tracer.way(at).is_end {
                break;
            }
            at = tracer.way(at).across;
        }
        at
    }

    /// Adds a piece or the beginning of one, as one stretch with the last if both are one arc.
    #[inline]
    fn add(&mut self, at: u32, turn: f64) {
        let tracer = self.tracer;
        match self.stretches.last_mut() {
            Some(last) if tracer.way(at).after.goes_on(self.turn, turn) => {
                last.last = at;
                (self.turn, self.open) = (self.turn + turn, true);
            }
            _ => {
                let foot = tracer.stop(at).foot;
                let start = foot.point + foot.normal * tracer.d;
                self.begin(Stretch { first: at, last: at, bulge: 0.0, start, at_crossing: false }, turn);
            }
        }
    }

    fn begin(&mut self, stretch: Stretch, turn: f64) {
        self.close();
        self.stretches.push(stretch);
        (self.turn, self.open) = (turn, true);
    }

    /// Gives the last stretch its bulge.
    #[inline]
    fn close(&mut self) {
        if let (true, Some(last)) = (self.open, self.stretches.last_mut()) {
            last.bulge = bulge_of(self.turn);
        }
        self.open = false;
    }
}
