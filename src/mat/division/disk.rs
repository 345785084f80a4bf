//! Algorithm 3, `maximaldisk`: the maximal disk that is tangent to a random arc in a fixed place.
//!
//! The place is the middle of the arc, or its reflex end if it has one. Every other arc of the
//! subdomain may make the disk smaller; none of the artificial ones can, as they are parts of maximal
//! disks. All arcs that the disk then touches, to round-off, are its tangent points.

use super::super::piece::{Piece, UnitDisk};
use super::super::shot::probe_at;
use super::super::site::Site;
use super::super::touch::{Probe, Span, foot_of, touch};
use super::super::track::Track;
use super::apollonius::tangent_to_three;
use super::medialaxis::Division;
use super::subdomain::{DividingDisk, Link, Slot, Touch};
use crate::geom::Point;

/// What is known of a disk's tangent points from the way it was made, and need not be measured.
#[derive(Clone, Copy, Debug)]
pub(super) enum Tangent {
    /// In a place of the piece.
    Piece(usize),
    /// Along the whole arc, which it osculates.
    Whole(usize),
    /// Where the piece goes over to the next.
    Joint(usize),
}

impl Division<'_> {
    /// The disk tangent to an arc of the subdomain in its middle or its reflex end.
    pub fn maximal_disk(&self, domain: &[Slot], a: usize) -> Option<DividingDisk> {
        let before = (a + domain.len() - 1) % domain.len();
        match [before, a].into_iter().find(|&i| domain[i].link == Link::Reflex) {
            Some(joint) => self.disk_at_joint(domain, joint),
            None => self.disk_at_middle(domain, a),
        }
    }

    /// The disk tangent to an arc in its middle.
    pub fn disk_at_middle(&self, domain: &[Slot], a: usize) -> Option<DividingDisk> {
        let piece = self.piece(domain, a);
        let probe = Track::of(self.sites, &piece).at(0.5);
        let limit = self.sites[piece.site as usize].own_limit();
        let (radius, toucher) = self.grow(domain, &probe, &[a], limit);
        let disk = UnitDisk { center: probe.center(radius), radius };
        if !radius.is_finite() {
            return None;
        }
        Some(match toucher {
            Some(b) => {
                let tangents = [Tangent::Piece(a), Tangent::Piece(b)];
                self.best_defined(domain, self.dividing_disk(domain, disk, &tangents))
            }
            None => self.dividing_disk(domain, disk, &[Tangent::Whole(a)]),
        })
    }

    /// The disk tangent to an arc where it goes over to the next.
    pub fn disk_at_joint(&self, domain: &[Slot], joint: usize) -> Option<DividingDisk> {
        let after = (joint + 1) % domain.len();
        let sites = [joint, after].map(|i| &self.sites[self.piece(domain, i).site as usize]);
        let limits = sites.map(Site::own_limit);
        let probe = probe_at(sites[0]);
        let (radius, toucher) = self.grow(domain, &probe, &[joint, after], limits[0].min(limits[1]));
        let mut tangents = vec![Tangent::Joint(joint)];
        match toucher {
            Some(b) => tangents.push(Tangent::Piece(b)),
            None if limits[0] <= limits[1] => tangents.push(Tangent::Whole(joint)),
            None => tangents.push(Tangent::Whole(after)),
        }
        let disk = UnitDisk { center: probe.center(radius), radius };
        radius.is_finite().then(|| self.dividing_disk(domain, disk, &tangents))
    }

    /// The disk that osculates an arc.
    pub fn osculating_disk(&self, domain: &[Slot], a: usize) -> Option<DividingDisk> {
        let piece = self.piece(domain, a);
        let radius = self.sites[piece.site as usize].own_limit();
        let disk = UnitDisk { center: piece.from.point + piece.from.normal * radius, radius };
        radius.is_finite().then(|| self.dividing_disk(domain, disk, &[Tangent::Whole(a)]))
    }

    /// Radius of the largest empty disk at a probe, and the arc that bounds it; no arc where that is
    /// the limit of curvature.
    fn grow(&self, domain: &[Slot], probe: &Probe, own: &[usize], limit: f64) -> (f64, Option<usize>) {
        let (mut radius, mut toucher) = (limit, None);
        for i in 0..domain.len() {
            if own.iter().any(|&o| self.piece(domain, o).site == self.piece(domain, i).site) {
                continue;
            }
            let reach = self.reach(&self.piece(domain, i), probe);
            if reach < radius {
                (radius, toucher) = (reach, Some(i));
            }
        }
        (radius, toucher)
    }

    /// Radius of the disk at a probe that touches a piece.
    pub fn reach(&self, piece: &Piece, probe: &Probe) -> f64 {
        let site = &self.sites[piece.site as usize];
        touch(Span { site, from: &piece.from, to: &piece.to, vertices: piece.vertices }, probe).0
    }

    /// The disk with all its tangent points: those that are known, and those of all arcs that come as
    /// near to it as round-off can tell.
    pub fn dividing_disk(&self, domain: &[Slot], disk: UnitDisk, known: &[Tangent]) -> DividingDisk {
        let n = domain.len();
        let mut touches: Vec<Touch> =
            (0..n).map(|i| self.touched(&self.piece(domain, i), &disk, self.graph.error)).collect();
        let natural = |i: usize| domain[i].link.disk().is_none();
        // Both sides end in the joint, whatever round-off says of the place.
        let meet = |touches: &mut [Touch], i: usize| {
            let j = (i + 1) % n;
            (touches[i].end, touches[i].inside) = (true, None);
            (touches[j].start, touches[j].inside) = (true, None);
        };
        for &tangent in known {
            match tangent {
                Tangent::Piece(i) => self.touch_for_sure(domain, &disk, i, &mut touches),
                Tangent::Whole(i) => {
                    touches[i] = Touch { start: true, inside: None, end: true };
                    let before = (i + n - 1) % n;
                    [before, i].into_iter().filter(|&j| natural(j)).for_each(|j| meet(&mut touches, j));
                }
                Tangent::Joint(i) => meet(&mut touches, i),
            }
        }
        DividingDisk::new(domain, disk, touches)
    }

    /// Notes where a disk touches a piece that it is known to touch. Where that is an end, the place
    /// may be the next piece's, as in the normal cone of a reflex vertex.
    fn touch_for_sure(&self, domain: &[Slot], disk: &UnitDisk, i: usize, touches: &mut [Touch]) {
        let n = domain.len();
        let touch = |j: usize| self.touched(&self.piece(domain, j), disk, f64::INFINITY);
        let natural = |j: usize| domain[j].link.disk().is_none();
        touches[i] = touch(i);
        let mut at = i;
        while touches[at].end && natural(at) && !touches[(at + 1) % n].is_any() {
            at = (at + 1) % n;
            touches[at] = touch(at);
        }
        at = i;
        while touches[at].start && natural((at + n - 1) % n) && !touches[(at + n - 1) % n].is_any() {
            at = (at + n - 1) % n;
            touches[at] = touch(at);
        }
    }

    /// A disk with more tangent points than it was made from, made anew from the three that define it
    /// best, if it is as empty then.
    ///
    /// Where the three normals are nearly one, as in two corners that are nearly flat, a disk touches
    /// all to round-off over a long way, and the place where it was found says little.
    pub fn best_defined(&self, domain: &[Slot], found: DividingDisk) -> DividingDisk {
        let touched: Vec<usize> = found.touched().collect();
        let site = |i: usize| &self.sites[self.piece(domain, i).site as usize];
        let normal = |i: usize| {
            let piece = self.piece(domain, i);
            foot_of(site(i), found.disk.center, &piece.from, &piece.to).normal
        };
        let [first, _, _, ..] = touched[..] else { return found };
        let n0 = normal(first);
        let farthest = |weight: &dyn Fn(usize) -> f64| {
            touched.iter().copied().max_by(|&i, &j| weight(i).total_cmp(&weight(j))).unwrap_or(first)
        };
        let second = farthest(&|i| (normal(i) - n0).length_squared());
        let across = normal(second) - n0;
        let third = farthest(&|i| (normal(i) - n0).cross(across).abs());
        let disk = tangent_to_three([first, second, third].map(site), found.disk);
        let gap = |i: usize| self.distance(&self.piece(domain, i), disk.center) - disk.radius;
        let error = self.graph.error;
        let touches = [first, second, third].into_iter().all(|i| gap(i).abs() <= error);
        let empty = (0..domain.len()).all(|i| gap(i) >= -error);
        if disk.radius > 0.0 && touches && empty {
            let tangents = [first, second, third].map(Tangent::Piece);
            return self.dividing_disk(domain, disk, &tangents);
        }
        found
    }

    /// Where a disk touches a piece that it comes nearer to than an error.
    fn touched(&self, piece: &Piece, disk: &UnitDisk, error: f64) -> Touch {
        let site = &self.sites[piece.site as usize];
        let limit = site.own_limit();
        let osculated = || {
            let center = piece.from.point + piece.from.normal * limit;
            center.distance(disk.center).max((limit - disk.radius).abs()) <= self.graph.error
        };
        if limit.is_finite() && osculated() {
            return Touch { start: true, inside: None, end: true };
        }
        if self.distance(piece, disk.center) - disk.radius > error {
            return Touch::default();
        }
        let foot = foot_of(site, disk.center, &piece.from, &piece.to);
        let (start, end) = (foot == piece.from, foot == piece.to);
        Touch { start, inside: (!start && !end).then_some(foot), end: end && !start }
    }

    /// Distance of a place from a piece.
    pub fn distance(&self, piece: &Piece, c: Point) -> f64 {
        let site = &self.sites[piece.site as usize];
        Site { start: piece.from, end: piece.to, ..*site }.distance(c)
    }
}
