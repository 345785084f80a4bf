//! Branch disks inside a face of the lamination.
//!
//! A face is a closed row of pieces; between a piece and the next lies a chord, one disk that both
//! end in. One piece: the contact arc of a leaf. Two pieces: one edge of the axis. Three and more:
//! walk along the first piece; the partner of its tangent disk changes from the last piece (at its
//! start) to the second (at its end), in descending order of the row because disks do not cross. The
//! last change is a branch disk. It touches the first piece, the second and one more; it cuts off an
//! edge between the first two and leaves two smaller faces.
//!
//! A face is one array and its sub-faces are ranges of it with new ends, so nothing is copied; large
//! faces have a hierarchy of boxes over the array.

use super::bvh::{Bvh, SearchDisk};
use super::graph::DISK_ROUNDINGS;
use super::patch::Patch;
use super::piece::{Piece, UnitDisk};
use super::site::{Foot, Site};
use super::touch::{Contact, Probe, foot_of};
use super::track::Track;
use crate::geom::{Bounds, Vector};
use std::cmp::Ordering;

/// A piece of a face and the disk at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub piece: u32,
    pub disk: u32,
}

/// Faces up to this many pieces are scanned; a hierarchy costs more to build and ask.
const SCANNED: usize = 32;

/// A sub-face: up to two new pieces, a range of the face, and a new last piece.
struct SubFace {
    head: [Option<Slot>; 2],
    range: std::ops::Range<usize>,
    tail: Option<Slot>,
}

/// A face being solved.
pub(super) struct Face<'a> {
    sites: &'a [Site],
    slots: &'a [Slot],
    boxes: Option<Bvh>,
}

impl SubFace {
    fn heads(&self) -> usize {
        self.head.iter().flatten().count()
    }

    fn len(&self) -> usize {
        self.heads() + self.range.len() + usize::from(self.tail.is_some())
    }

    fn get(&self, slots: &[Slot], i: usize) -> Slot {
        let h = self.heads();
        if let (true, Some(slot)) = (i < h, self.head.get(i).copied().flatten()) {
            return slot;
        }
        match self.tail {
            Some(tail) if i - h >= self.range.len() => tail,
            _ => slots[self.range.start + i - h],
        }
    }
}

/// A disk that touches the first piece, the second, and the one at `third`.
struct Branch {
    disk: UnitDisk,
    feet: [Foot; 3],
    third: usize,
}

impl<'a> Face<'a> {
    /// Makes all edges of a face of three pieces or more, adding branch disks and cutting pieces in `patch`.
    pub fn solve(sites: &'a [Site], slots: &'a [Slot], patch: &mut Patch) {
        let boxes = (slots.len() > SCANNED)
            .then(|| Bvh::build(slots.iter().map(|s| piece_bounds(sites, &patch.pieces[s.piece as usize]))));
        let face = Face { sites, slots, boxes };
        let mut open = vec![SubFace { head: [None; 2], range: 0..slots.len(), tail: None }];
        while let Some(sub) = open.pop() {
            match sub.len() {
                0 | 1 => {}
                2 => {
                    let (a, b) = (sub.get(slots, 0), sub.get(slots, 1));
                    patch.add_edge([a.piece, b.piece], [b.disk, a.disk]);
                }
                _ => face.divide(&sub, patch, &mut open),
            }
        }
    }

    /// Cuts a face of three or more pieces at the branch disk nearest to the end of its first piece.
    fn divide(&self, sub: &SubFace, patch: &mut Patch, open: &mut Vec<SubFace>) {
        let branch = self.last_branch(sub, patch);
        let (first, second, third) =
            (sub.get(self.slots, 0), sub.get(self.slots, 1), sub.get(self.slots, branch.third));
        let disk = patch.add_disk(branch.disk);
        let first_rest = patch.cut(self.sites, first.piece, branch.feet[0]);
        let second_rest = patch.cut(self.sites, second.piece, branch.feet[1]);
        let third_rest = patch.cut(self.sites, third.piece, branch.feet[2]);
        patch.add_edge([first_rest, second.piece], [disk, first.disk]);

        let (j, h, len) = (branch.third, sub.heads(), sub.len());
        let slot_index = |i: usize| sub.range.start + i.saturating_sub(h);
        // Between second and third.
        let inner_end = slot_index(j).min(sub.range.end);
        open.push(SubFace {
            head: [Some(Slot { piece: second_rest, disk: second.disk }), None],
            range: slot_index(2).min(inner_end)..inner_end,
            tail: Some(Slot { piece: third.piece, disk }),
        });
        // From third around to the first.
        let is_last = j + 1 == len;
        let outer_start = slot_index(j + 1).min(sub.range.end);
        open.push(SubFace {
            head: [
                Some(Slot { piece: first.piece, disk }),
                Some(Slot { piece: third_rest, disk: third.disk }),
            ],
            range: if is_last { 0..0 } else { outer_start..sub.range.end },
            tail: sub.tail.filter(|_| !is_last),
        });
    }

    /// The branch disk where the partner of the first piece changes to the second for good.
    fn last_branch(&self, sub: &SubFace, patch: &Patch) -> Branch {
        let piece = |i: usize| &patch.pieces[sub.get(self.slots, i).piece as usize];
        let (first, second) = (piece(0), piece(1));
        let track = Track::of(self.sites, first);
        let (mut third, mut from) = (sub.len() - 1, 0.0);
        loop {
            let t = equal_reach(self.sites, &track, second, piece(third), from);
            let probe = track.at(t);
            let reach = common_reach(self.sites, &track, t, [second, piece(third)]);
            // The order of partners makes the index fall, so this ends.
            if let Some(nearer) = self.nearest_between(sub, patch, &track, &probe, reach, third) {
                (third, from) = (nearer, t);
                continue;
            }
            let branch = self.branch(&track, &probe, reach, third, patch, sub);
            if spread(branch.feet) >= WELL_SPREAD {
                return branch;
            }
            let tie = self.chord_disk(&branch, patch, sub);
            return tie.or_else(|| self.best_of_ties(&track, &branch, patch, sub)).unwrap_or(branch);
        }
    }

    /// A disk of the face's own chords that touches the three pieces of a branch: where many pieces
    /// touch one disk, the first branches are defined by far ones, and later ones must not be made
    /// anew from three neighbors.
    fn chord_disk(&self, branch: &Branch, patch: &Patch, sub: &SubFace) -> Option<Branch> {
        let (third, last) = (branch.third, sub.len() - 1);
        let pieces = [0, 1, third].map(|i| &patch.pieces[sub.get(self.slots, i).piece as usize]);
        let sites = pieces.map(|p| &self.sites[p.site as usize]);
        // A piece without length is what a disk left that osculates its arc, and all that reaches into that
        // disk by less than a drawn coordinate is uncertain was passed over.
        let is_point = |i: usize| pieces[i].from.point == pieces[i].to.point && !sites[i].is_vertex;
        let error = if (0..3).any(is_point) { patch.error } else { TIE_ERROR };
        [0, 1, third - 1, third, last].into_iter().find_map(|i| {
            let disk = patch.disks[sub.get(self.slots, i).disk as usize];
            let feet = || [0, 1, 2].map(|i| foot_of(sites[i], disk.center, &pieces[i].from, &pieces[i].to));
            let touches = disk.radius > 0.0 && self.touches(sub, disk, [0, 1, third], patch, error);
            touches.then(|| Branch { disk, feet: feet(), third })
        })
    }

    /// Whether a disk touches three pieces, to within `error`.
    fn touches(&self, sub: &SubFace, disk: UnitDisk, pieces: [usize; 3], patch: &Patch, error: f64) -> bool {
        pieces.into_iter().all(|i| {
            let Piece { site, from, to, .. } = patch.pieces[sub.get(self.slots, i).piece as usize];
            let part = Site { start: from, end: to, ..self.sites[site as usize] };
            (part.distance(disk.center) - disk.radius).abs() <= error
        })
    }

    /// Where more pieces touch the same disk, to round-off, than the three that define it: the disk
    /// through two of these and the one that defines it best, if it touches the three and is as empty. It
    /// need not: a disk that three pieces define badly is near to many that it has nothing to do with.
    fn best_of_ties(
        &self,
        track: &Track<'_>,
        branch: &Branch,
        patch: &Patch,
        sub: &SubFace,
    ) -> Option<Branch> {
        let defined = spread(branch.feet);
        // What a disk is uncertain by when it is divided by so little.
        let error = TIE_ERROR / defined.max(TIE_ERROR);
        let (three, [f0, f1, f2]) = ([0, 1, branch.third], branch.feet);
        let mut best = (defined, [0; 3]);
        self.near_disk(sub, branch.disk, error, |i| {
            let other = &patch.pieces[sub.get(self.slots, i).piece as usize];
            let site = &self.sites[other.site as usize];
            if !three.contains(&i)
                && (site.carrier_distance(branch.disk.center).0 - branch.disk.radius).abs() <= error
            {
                let foot = foot_of(site, branch.disk.center, &other.from, &other.to);
                for (pair, feet) in [([0, 1], [f0, f1]), ([0, 2], [f0, f2]), ([1, 2], [f1, f2])] {
                    let spread = spread([feet[0], feet[1], foot]);
                    if spread > best.0 {
                        best = (spread, [three[pair[0]], three[pair[1]], i]);
                    }
                }
            }
        });
        let tied = best.1;
        let other = match tied {
            [_, 0, _] => return None,
            [0, 1, _] => self.tangent_to(track, tied[2], patch, sub),
            _ => self.polished_branch(branch, tied, patch, sub),
        };
        let intrusion = |b: &Branch| self.intrusion(sub, b.disk, error, patch);
        let touches = self.touches(sub, other.disk, tied, patch, TIE_ERROR)
            && (other.third == tied[2] || self.touches(sub, other.disk, three, patch, TIE_ERROR));
        (touches && intrusion(&other) <= intrusion(branch)).then_some(other)
    }

    /// The branch of the first piece, the second and another one.
    fn tangent_to(&self, track: &Track<'_>, third: usize, patch: &Patch, sub: &SubFace) -> Branch {
        let piece = |i: usize| &patch.pieces[sub.get(self.slots, i).piece as usize];
        let t = equal_reach(self.sites, track, piece(1), piece(third), 0.0);
        let reach = common_reach(self.sites, track, t, [piece(1), piece(third)]);
        self.branch(track, &track.at(t), reach, third, patch, sub)
    }

    /// A branch moved to the disk that touches three other pieces.
    fn polished_branch(&self, branch: &Branch, tied: [usize; 3], patch: &Patch, sub: &SubFace) -> Branch {
        let piece = |i: usize| &patch.pieces[sub.get(self.slots, i).piece as usize];
        let disk = polished(tied.map(|i| &self.sites[piece(i).site as usize]), branch.disk);
        let feet = [0, 1, branch.third]
            .map(|i| foot_of(&self.sites[piece(i).site as usize], disk.center, &piece(i).from, &piece(i).to));
        Branch { disk, feet, third: branch.third }
    }

    /// How far pieces of the face reach into a disk.
    fn intrusion(&self, sub: &SubFace, disk: UnitDisk, error: f64, patch: &Patch) -> f64 {
        let mut deepest = 0.0f64;
        self.near_disk(sub, disk, error, |i| {
            let Piece { site, from, to, .. } = patch.pieces[sub.get(self.slots, i).piece as usize];
            let part = Site { start: from, end: to, ..self.sites[site as usize] };
            deepest = deepest.max(disk.radius - part.distance(disk.center));
        });
        deepest
    }

    /// Calls `visit` for the pieces of a sub-face that come near to a disk.
    fn near_disk(&self, sub: &SubFace, disk: UnitDisk, margin: f64, mut visit: impl FnMut(usize)) {
        let h = sub.heads();
        match &self.boxes {
            Some(boxes) if sub.range.len() > SCANNED => {
                (0..h).for_each(&mut visit);
                let disk = SearchDisk { center: disk.center, radius: disk.radius + margin };
                boxes.search_range(disk, sub.range.clone(), |leaf| {
                    visit(leaf as usize - sub.range.start + h);
                    None
                });
                (h + sub.range.len()..sub.len()).for_each(&mut visit);
            }
            _ => (0..sub.len()).for_each(&mut visit),
        }
    }

    /// The piece after the second and before `third` that the disk at the probe would meet first.
    fn nearest_between(
        &self,
        sub: &SubFace,
        patch: &Patch,
        track: &Track<'_>,
        probe: &Probe,
        reach: f64,
        third: usize,
    ) -> Option<usize> {
        let (mut best, mut found) = (reach, None);
        let mut try_index = |i: usize| {
            let other = &patch.pieces[sub.get(self.slots, i).piece as usize];
            let (radius, _) = track.reach(self.sites, other, probe);
            if radius < best {
                (best, found) = (radius, Some(i));
            }
            best
        };
        let h = sub.heads();
        let in_range = h.max(2)..third.min(h + sub.range.len());
        match &self.boxes {
            Some(boxes) if in_range.len() > SCANNED => {
                (2..third.min(h)).for_each(|i| _ = try_index(i));
                let shift = sub.range.start as isize - h as isize;
                let slot = |i: usize| (i as isize + shift) as usize;
                let mut radius = reach.min(1.0);
                let disk = |radius: f64| SearchDisk { center: probe.center(radius), radius };
                boxes.search_range(disk(radius), slot(in_range.start)..slot(in_range.end), |leaf| {
                    let now = try_index((leaf as isize - shift) as usize);
                    (now < radius).then(|| {
                        radius = now;
                        disk(radius)
                    })
                });
                (in_range.end.max(2)..third).for_each(|i| _ = try_index(i));
            }
            _ => (2..third).for_each(|i| _ = try_index(i)),
        }
        found
    }

    fn branch(
        &self,
        track: &Track<'_>,
        probe: &Probe,
        reach: f64,
        third: usize,
        patch: &Patch,
        sub: &SubFace,
    ) -> Branch {
        let pieces = [0, 1, third].map(|i| &patch.pieces[sub.get(self.slots, i).piece as usize]);
        let sites = pieces.map(|p| &self.sites[p.site as usize]);
        // Round-off may leave no partner at all where everything meets in one disk: that of the chord.
        let chord_disk = || patch.disks[sub.get(self.slots, 0).disk as usize];
        let mut disk = if reach.is_finite() {
            UnitDisk { center: probe.center(reach), radius: reach }
        } else {
            chord_disk()
        };
        let tangent = |p: &Piece| track.reach(self.sites, p, probe).1 == Contact::Inside;
        if tangent(pieces[1]) && tangent(pieces[2]) {
            disk = polished(sites, disk);
        }
        let feet = [0, 1, 2].map(|i| foot_of(sites[i], disk.center, &pieces[i].from, &pieces[i].to));
        Branch { disk, feet, third }
    }
}

/// Round-off of a disk as it is computed, in the unit frame, whatever that of the drawn coordinates is:
/// where a disk is farther from a piece, the drawing has no tie, and a flat corner makes much of little.
const TIE_ERROR: f64 = DISK_ROUNDINGS * f64::EPSILON;

/// Three normals that span a triangle of this area or more define a disk but for two bits.
const WELL_SPREAD: f64 = 0.25;

/// Twice the area of the triangle of the normals of a disk at three feet: what its center and radius
/// are divided by when they are computed from the three sites.
fn spread(feet: [Foot; 3]) -> f64 {
    let [n0, n1, n2] = feet.map(|f| f.normal);
    (n1 - n0).cross(n2 - n0).abs()
}

/// Steps of the search for a place of equal reach: twice the bits of a parameter.
const STEPS: usize = 106;

/// Parameter beyond `from` where the disks to both pieces are equal: at `from` the one to `before` is
/// smaller, at the end the one to `after`.
fn equal_reach(sites: &[Site], track: &Track<'_>, after: &Piece, before: &Piece, from: f64) -> f64 {
    let difference = |t: f64| {
        let probe = track.at(t);
        let (a, b) = (track.reach(sites, after, &probe).0, track.reach(sites, before, &probe).0);
        match (a.is_finite(), b.is_finite()) {
            (true, true) => (a - b) / (a + b),
            (true, false) => f64::NEG_INFINITY,
            (false, _) => f64::INFINITY,
        }
    };
    falling_root(from, 1.0, difference)
}

/// Radius of the disk to both of two pieces at a place where they are equal. Next to a flat corner the reach
/// to the other side goes from nothing to infinity within a few roundings of the place: then that to the
/// piece that does not is the one.
fn common_reach(sites: &[Site], track: &Track<'_>, t: f64, pieces: [&Piece; 2]) -> f64 {
    let reach = |t: f64| {
        let probe = track.at(t);
        pieces.map(|p| track.reach(sites, p, &probe).0)
    };
    let [a, b] = reach(t);
    if (a - b).abs() <= TIE_ERROR || !(a.is_finite() && b.is_finite()) {
        return a.min(b);
    }
    let (before, after) = (reach(t - f64::EPSILON), reach(t + f64::EPSILON));
    let [steep_a, steep_b] = [0, 1].map(|i| (after[i] - before[i]).abs());
    match steep_a.partial_cmp(&steep_b) {
        Some(Ordering::Less) => a,
        Some(Ordering::Greater) => b,
        // Infinite on both sides, which has no difference, or equal.
        _ => a.min(b),
    }
}

/// Where a function falls through zero between two places; it need not be continuous, and may be infinite.
/// Inverse quadratic interpolation where three values admit it (Chandrupatla 1997); where it is infinite on
/// one side of the root, the line through two values of the other; bisection elsewhere.
pub(crate) fn falling_root(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let [mut newest, mut other] = [(high, f64::NEG_INFINITY), (low, f64::INFINITY)];
    let mut part = 0.5;
    for step in 0..STEPS {
        let at = newest.0 + part * (other.0 - newest.0);
        let value = f(at);
        if value.abs() <= f64::EPSILON {
            return at;
        }
        let mut before = newest;
        if (value > 0.0) != (newest.1 > 0.0) {
            (before, other) = (other, newest);
        }
        newest = (at, value);
        let least = 0.5 * f64::EPSILON * newest.0.max(other.0) / (other.0 - newest.0).abs();
        if least >= 0.5 {
            break;
        }
        let is_late = step % 4 == 3;
        let guess = part_to_root(newest, other, before).filter(|&t| t > 0.0 && t < 1.0 && !is_late);
        part = guess.map_or(0.5, |t| t.clamp(least, 1.0 - least));
    }
    0.5 * (newest.0 + other.0)
}

/// Where a function may be zero on the way from the newest place to the one on the other side of the root.
fn part_to_root(newest: (f64, f64), other: (f64, f64), before: (f64, f64)) -> Option<f64> {
    let ((a, f), (b, g), (c, h)) = (newest, other, before);
    if !g.is_finite() {
        return Some(f * (c - a) / ((f - h) * (b - a)));
    }
    let (place, value) = ((a - b) / (c - b), (f - g) / (h - g));
    let bends_little = value * value < place && (1.0 - value) * (1.0 - value) < 1.0 - place;
    bends_little.then(|| f / (g - f) * h / (g - h) + (c - a) / (b - a) * f / (h - f) * g / (h - g))
}

/// Newton's step for the disk tangent to three carriers: `distance_i(c) = r`, gradients are normals.
/// Taken only while it makes the residual smaller.
fn polished(sites: [&Site; 3], mut disk: UnitDisk) -> UnitDisk {
    let residuals =
        |d: &UnitDisk| sites.map(|s| s.carrier_distance(d.center)).map(|(s, n)| (d.radius - s, n));
    let worst = |r: &[(f64, Vector); 3]| r.iter().fold(0.0f64, |w, (e, _)| w.max(e.abs()));
    let mut now = residuals(&disk);
    while worst(&now) > f64::EPSILON * disk.radius {
        let [(e0, n0), (e1, n1), (e2, n2)] = now;
        // n_i . step - dr = e_i; differences leave two equations in the step.
        let (a, b) = (n1 - n0, n2 - n0);
        let det = a.cross(b);
        // What is left may be round-off, and divided by little it is no step.
        if worst(&now) <= TIE_ERROR && det.abs() < WELL_SPREAD {
            break;
        }
        let step = Vector {
            x: ((e1 - e0) * b.y - (e2 - e0) * a.y) / det,
            y: ((e2 - e0) * a.x - (e1 - e0) * b.x) / det,
        };
        let next = UnitDisk { center: disk.center + step, radius: disk.radius + n0.dot(step) - e0 };
        let after = residuals(&next);
        // A step that does not halve the residual has met round-off; NaN fails this too.
        if !(worst(&after) < 0.5 * worst(&now) && next.radius > 0.0) {
            break;
        }
        (disk, now) = (next, after);
    }
    disk
}

/// A box around a piece.
fn piece_bounds(sites: &[Site], piece: &Piece) -> Bounds {
    let site = &sites[piece.site as usize];
    Site { start: piece.from, end: piece.to, ..*site }.bounds()
}
