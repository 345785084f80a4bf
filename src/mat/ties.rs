//! Branch disks where more than three pieces touch one disk, to round-off.
//!
//! Three of them that lie well apart on the disk define it; three near to each other hardly do. So a branch that
//! its own three pieces define badly is taken from a disk that is there already, or from the two of them and the
//! one that define it best.

use super::face::{Branch, Face, SubFace, TIE_ERROR, common_reach, equal_reach, polished, spread};
use super::patch::Patch;
use super::piece::{Piece, UnitDisk};
use super::site::Site;
use super::touch::foot_of;
use super::track::Track;

impl Face<'_> {
    /// A disk of the face's own chords that touches the three pieces of a branch: where many pieces
    /// touch one disk, the first branches are defined by far ones, and later ones must not be made
    /// anew from three neighbors.
    pub fn chord_disk(&self, branch: &Branch, patch: &Patch, sub: &SubFace) -> Option<Branch> {
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
    pub fn best_of_ties(
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
}
