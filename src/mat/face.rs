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
use super::root::falling_root;
use super::shot::RADIUS_ERROR;
use super::site::{Foot, Joint, NONE, Site};
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
pub(super) struct SubFace {
    head: [Option<Slot>; 2],
    range: std::ops::Range<usize>,
    tail: Option<Slot>,
}

/// A face being solved.
pub(super) struct Face<'a> {
    pub sites: &'a [Site],
    pub slots: &'a [Slot],
    boxes: Option<Bvh>,
}

impl SubFace {
    fn heads(&self) -> usize {
        self.head.iter().flatten().count()
    }

    pub fn len(&self) -> usize {
        self.heads() + self.range.len() + usize::from(self.tail.is_some())
    }

    pub fn get(&self, slots: &[Slot], i: usize) -> Slot {
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
pub(super) struct Branch {
    pub disk: UnitDisk,
    pub feet: [Foot; 3],
    pub third: usize,
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
            let mut reach = common_reach(self.sites, &track, t, [second, piece(third)]);
            // The order of partners makes the index fall, so this ends.
            if let Some(nearer) = self.nearest_between(sub, patch, &track, &probe, reach, third) {
                (third, from) = (nearer, t);
                continue;
            }
            if reach.is_infinite() {
                reach = [second, piece(third)]
                    .map(|p| track.reach(self.sites, p, &probe).0)
                    .into_iter()
                    .fold(reach, f64::min);
            }
            let branch = self.branch(&track, &probe, reach, third, patch, sub);
            if spread(branch.feet) >= WELL_SPREAD {
                return branch;
            }
            let tie = self.chord_disk(&branch, patch, sub);
            return tie.or_else(|| self.best_of_ties(&track, &branch, patch, sub)).unwrap_or(branch);
        }
    }

    /// Calls `visit` for the pieces of a sub-face that come near to a disk.
    pub fn near_disk(&self, sub: &SubFace, disk: UnitDisk, margin: f64, mut visit: impl FnMut(usize)) {
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

    pub fn branch(
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
pub(super) const TIE_ERROR: f64 = DISK_ROUNDINGS * f64::EPSILON;

/// Three normals that span a triangle of this area or more define a disk but for two bits.
const WELL_SPREAD: f64 = 0.25;

/// Twice the area of the triangle of the normals of a disk at three feet: what its center and radius
/// are divided by when they are computed from the three sites.
pub(super) fn spread(feet: [Foot; 3]) -> f64 {
    let [n0, n1, n2] = feet.map(|f| f.normal);
    (n1 - n0).cross(n2 - n0).abs()
}

/// Round-off of the quotient of difference and sum of two radii: four roundings.
const EQUAL: f64 = 4.0 * f64::EPSILON;

/// Parameter beyond `from` where the disks to both pieces are equal: at `from` the one to `before` is
/// smaller, at the end the one to `after`.
pub(super) fn equal_reach(
    sites: &[Site],
    track: &Track<'_>,
    after: &Piece,
    before: &Piece,
    from: f64,
) -> f64 {
    let difference = |t: f64| {
        let probe = track.at(t);
        let [(a, at_a), (b, at_b)] = [after, before].map(|p| track.reach(sites, p, &probe));
        match (a.is_finite(), b.is_finite()) {
            (true, true) => {
                let difference = (a - b) / (a + b);
                if difference.abs() > RADIUS_ERROR {
                    return difference;
                }
                // Round-off hides for the root of it which of two sites holds a disk back beside their corner:
                // the one that is touched between its ends, as the corner itself lies outside of all disks.
                match [is_corner(sites, after, at_a, before), is_corner(sites, before, at_b, after)] {
                    [true, false] => RADIUS_ERROR,
                    [false, true] => -RADIUS_ERROR,
                    _ if difference.abs() <= EQUAL => 0.0,
                    _ => difference,
                }
            }
            (true, false) => -1.0,
            (false, _) => 1.0,
        }
    };
    falling_root(from, 1.0, difference)
}

/// Whether a contact with a piece is a corner of the pocket where its site meets that of another piece.
fn is_corner(sites: &[Site], piece: &Piece, contact: Contact, other: &Piece) -> bool {
    let vertex = match contact {
        Contact::Start => piece.vertices[0],
        Contact::End => piece.vertices[1],
        Contact::Inside | Contact::Whole => return false,
    };
    vertex != NONE
        && sites[vertex as usize].joint == Joint::Convex
        && sites[other.site as usize].vertices.contains(&vertex)
}

/// Radius of the disk to both of two pieces at a place where they are equal. Next to a flat corner the reach
/// to the other side goes from nothing to infinity within a few roundings of the place: then that to the
/// piece that does not is the one, and may be infinite.
pub(super) fn common_reach(sites: &[Site], track: &Track<'_>, t: f64, pieces: [&Piece; 2]) -> f64 {
    let reach = |t: f64| {
        let probe = track.at(t);
        pieces.map(|p| track.reach(sites, p, &probe).0)
    };
    let [a, b] = reach(t);
    if (a - b).abs() <= TIE_ERROR || !(a.is_finite() || b.is_finite()) {
        return a.min(b);
    }
    JUMP_ROUNDINGS
        .iter()
        .find_map(|roundings| steadier(t, roundings * f64::EPSILON, [a, b], reach))
        .unwrap_or_else(|| less_wrong(sites, &track.at(t), pieces, [a, b]))
}

/// Of two reaches that do not get past each other the one whose disk is less wrong. The smaller disk does not
/// come near the other piece where the parameter is at an end, and holds the disk back there; the larger one
/// reaches over the first piece, but by next to nothing where an arc next to a flat corner has a center that
/// is not known as well as its places.
fn less_wrong(sites: &[Site], probe: &Probe, pieces: [&Piece; 2], reaches: [f64; 2]) -> f64 {
    let (small, large) = (reaches[0].min(reaches[1]), reaches[0].max(reaches[1]));
    let [at_small, at_large] = if reaches[0] <= reaches[1] { pieces } else { [pieces[1], pieces[0]] };
    let off = |p: &Piece, radius: f64| {
        let part = Site { start: p.from, end: p.to, ..sites[p.site as usize] };
        (part.distance(probe.center(radius)) - radius).abs()
    };
    let is_large_better = large.is_finite() && off(at_small, large) < off(at_large, small);
    if is_large_better { large } else { small }
}

/// Roundings of a parameter within which a reach may go back and forth where it jumps, one number after the other.
const JUMP_ROUNDINGS: [f64; 4] = [1.0, 8.0, 64.0, 512.0];

/// Of two reaches that change sides within a stretch of the parameter the one that changes less; what stays
/// infinite does not change.
fn steadier(t: f64, stretch: f64, [a, b]: [f64; 2], reach: impl Fn(f64) -> [f64; 2]) -> Option<f64> {
    let [before, after] = [t - stretch, t + stretch].map(reach);
    let change = |i: usize| {
        let all = [before[i], [a, b][i], after[i]];
        if all.iter().all(|r| r.is_infinite()) {
            return 0.0;
        }
        all.into_iter().fold(0.0, f64::max) - all.into_iter().fold(f64::INFINITY, f64::min)
    };
    let [of_a, of_b] = [change(0), change(1)];
    if of_a.max(of_b) < (a - b).abs() {
        return None;
    }
    Some(match of_a.total_cmp(&of_b) {
        Ordering::Less => a,
        Ordering::Greater => b,
        Ordering::Equal => a.min(b),
    })
}

/// Newton's step for the disk tangent to three carriers: `distance_i(c) = r`, gradients are normals.
/// Taken only while it makes the residual smaller.
pub(super) fn polished(sites: [&Site; 3], mut disk: UnitDisk) -> UnitDisk {
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
