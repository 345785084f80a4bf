//! Two offsets of the same boundary held against each other, and who is right where they differ.
//!
//! **Needs** the boundary and two sets of loops, whoever made them.
//! **Guarantees** that every disagreement found is decided by exact distance: either the level
//! passes, and one party has no curve there, or it does not, and the other has one too many.
//! **Does not** look at every place: ends and middles of the elements of both. Loops that lie twice
//! in the same place, or run the wrong way round, are for [`Boundary::judge`] to see.
//!
//! **Method.** A place of one offset that is farther than the bound from all curves of the other is
//! in dispute. The signed distance to the boundary is continuous; so if it is larger than that of
//! the level at one place no farther away than the bound, and smaller at another, the level passes
//! between them, and a curve is missing. Such places are looked for beside the curve, from
//! round-off to the bound. If there are none, the curve should not be there; unless it keeps the
//! distance up to round-off, as a ridge does: then it is no disagreement whether it is drawn.

use super::boundary::Boundary;
use super::level::{ASIDE, ROUND_OFF};
use super::report::MAX_FAULTS;
use crate::geom::{ArcSpline, Element, Point, Vector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Steps aside of a curve grow by this factor from round-off to the bound.
const WIDER: f64 = 4.0;

/// Two offsets compared. Lengths are in job units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The distance that both should have.
    pub distance: f64,
    /// Number of loops of each.
    pub loops: [usize; 2],
    /// Number of places looked at.
    pub places: usize,
    /// Largest distance of a place of one from the curves of the other; the extent of the loop
    /// where the other has no curve at all.
    pub max_deviation: f64,
    /// Where that is.
    pub max_deviation_at: Option<Point>,
    /// Largest deviation that counts as none.
    pub within: f64,
    /// Number of stretches of curves of one that are none of the other.
    pub disagreement_count: usize,
    /// The disagreements with their places; no more than 64.
    pub disagreements: Vec<Disagreement>,
    /// Number of stretches that only one of the two has and that may be there or not: they keep the
    /// distance, and nothing is farther beside them, up to round-off.
    pub ridges: usize,
}

/// A stretch along which one offset has a curve and the other has none, decided by exact distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Disagreement {
    /// The distance of the level.
    pub distance: f64,
    /// The place of the stretch with the largest deviation.
    pub at: Point,
    /// What is wrong.
    pub kind: DisagreementKind,
    /// Who is wrong.
    pub wrong: Party,
    /// Distance of the place from the curves of the party that has none there.
    pub deviation: f64,
    /// Difference between the exact distance of the place to the boundary and that of the level.
    pub error: f64,
}

/// What is wrong where two offsets differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DisagreementKind {
    /// The level passes, and the curve of one party does not.
    Missing,
    /// A curve where the level does not pass: it is misplaced or a phantom.
    Phantom,
}

/// One of two offsets that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Party {
    /// The offset that was given to be judged.
    Ours,
    /// The offset that it is compared with.
    Theirs,
}

/// A place of a curve, and how far the other offset is.
struct Place {
    at: Point,
    deviation: f64,
    /// What the exact distance says; asked only where the two differ.
    verdict: Option<Verdict>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Passes,
    PassesNot,
    Ridge,
}

/// One boundary, one distance, and what counts as the same.
struct Court<'a> {
    boundary: &'a Boundary,
    distance: f64,
    within: f64,
    /// Round-off of a distance.
    noise: f64,
    /// Smallest step aside of a curve.
    aside: f64,
}

impl Boundary {
    /// Compares two offsets at a distance; deviations up to `within`, in job units, count as none.
    /// Open splines are ridges, which need no counterpart.
    pub fn compare(
        &self,
        distance: f64,
        ours: &[ArcSpline],
        theirs: &[ArcSpline],
        within: f64,
    ) -> Comparison {
        let magnitude = self.bounds().magnitude() + distance.abs();
        let noise = ROUND_OFF * magnitude;
        let court = Court {
            boundary: self,
            distance,
            within: within.max(ASIDE * magnitude),
            noise,
            aside: ASIDE * magnitude,
        };
        let loops = [ours, theirs].map(|set| set.iter().filter(|l| l.closed).count());
        let mut comparison = Comparison { distance, loops, within: court.within, ..Comparison::default() };
        for (party, set, other) in [(Party::Ours, ours, theirs), (Party::Theirs, theirs, ours)] {
            let other = Boundary::new(other);
            for spline in set.iter().filter(|l| l.closed) {
                comparison.take(party, &court.places(spline, &other), &court);
            }
        }
        comparison
    }
}

impl Court<'_> {
    /// The places of one loop with their deviations from the other offset.
    fn places(&self, spline: &ArcSpline, other: &Boundary) -> Vec<Place> {
        let extent = spline.bounds().diagonal();
        let count = spline.len();
        let place = |i: usize| {
            let e = spline.element(i / 2);
            let at = if i.is_multiple_of(2) { e.start } else { e.midpoint() };
            let distance = other.distance(at);
            let deviation = if distance.is_finite() { distance } else { extent };
            let beside = || {
                let before = spline.element((i / 2 + count - 1) % count);
                if i.is_multiple_of(2) { across_corner(&before, &e) } else { [e.normal_at(0.5); 3] }
            };
            let same = deviation <= self.within && at.is_finite();
            Place { at, deviation, verdict: (!same).then(|| self.verdict(at, beside())) }
        };
        (0..2 * count).into_par_iter().map(place).collect()
    }

    /// Whether the level passes a place, no farther away than the bound.
    fn verdict(&self, at: Point, directions: [Vector; 3]) -> Verdict {
        let (mut nearer, mut farther) = (false, false);
        let mut aside = self.aside;
        loop {
            aside = aside.min(self.within);
            for p in directions.iter().flat_map(|n| [at + *n * aside, at - *n * aside]) {
                let beyond = self.boundary.distance(p) - self.distance;
                let inside = beyond > self.noise && self.boundary.contains(p);
                farther |= inside;
                nearer |= beyond < -self.noise || (beyond > self.noise && !inside);
            }
            if nearer && farther {
                return Verdict::Passes;
            }
            if aside >= self.within {
                break;
            }
            aside *= WIDER;
        }
        if self.error(at) <= self.noise { Verdict::Ridge } else { Verdict::PassesNot }
    }

    /// How far the exact distance of a place is off.
    fn error(&self, at: Point) -> f64 {
        (self.boundary.distance(at) - self.distance).abs()
    }
}

/// Normals of two elements where they meet, and the direction between them.
fn across_corner(before: &Element, after: &Element) -> [Vector; 3] {
    let (a, b) = (before.normals().1, after.normals().0);
    let sum = a + b;
    // At a spike the normals are opposite, and the way on is across them.
    let between = if sum.length_squared() > 0.0 { sum.unit() } else { a.left() };
    [a, b, between]
}

impl Comparison {
    /// Whether the two offsets are the same up to the bound.
    pub fn agrees(&self) -> bool {
        self.disagreement_count == 0
    }

    /// Takes note of the places of one loop: neighbors with the same verdict are one stretch.
    fn take(&mut self, party: Party, places: &[Place], court: &Court) {
        self.places += places.len();
        for place in places {
            if place.deviation > self.max_deviation || self.max_deviation_at.is_none() {
                (self.max_deviation, self.max_deviation_at) = (place.deviation, Some(place.at));
            }
        }
        // Begin where the verdict changes, so that no stretch is cut in two.
        let n = places.len();
        let before = |i: usize| places[(i + n - 1) % n].verdict;
        let first = (0..n).find(|&i| places[i].verdict != before(i)).unwrap_or(0);
        let turned: Vec<&Place> = (0..n).map(|i| &places[(first + i) % n]).collect();
        for stretch in turned.chunk_by(|a, b| a.verdict == b.verdict) {
            let worst = stretch.iter().max_by(|a, b| a.deviation.total_cmp(&b.deviation));
            if let Some((place, verdict)) = worst.and_then(|w| Some((w, w.verdict?))) {
                self.count(party, place, verdict, court);
            }
        }
    }

    /// Counts a stretch that one party has and the other has not.
    fn count(&mut self, party: Party, place: &Place, verdict: Verdict, court: &Court) {
        let (kind, wrong) = match verdict {
            Verdict::Passes => (DisagreementKind::Missing, party.other()),
            Verdict::PassesNot => (DisagreementKind::Phantom, party),
            Verdict::Ridge => {
                self.ridges += 1;
                return;
            }
        };
        self.disagreement_count += 1;
        if self.disagreements.len() < MAX_FAULTS {
            let (distance, at, deviation) = (self.distance, place.at, place.deviation);
            let error = court.error(at);
            self.disagreements.push(Disagreement { distance, at, kind, wrong, deviation, error });
        }
    }
}

impl Party {
    fn other(self) -> Party {
        match self {
            Party::Ours => Party::Theirs,
            Party::Theirs => Party::Ours,
        }
    }
}

impl std::fmt::Display for DisagreementKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            DisagreementKind::Missing => "no curve where the level passes",
            DisagreementKind::Phantom => "a curve where the level does not pass",
        })
    }
}

#[cfg(test)]
#[path = "compare_tests.rs"]
mod tests;
