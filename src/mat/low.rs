//! Sites along which no disk of a given radius fits.
//!
//! **Needs** a radius, the *floor*, and for each site others that are near. **Guarantees** that every disk which
//! touches a *low* site is smaller than the floor. **Does not** find all such sites: after a number of tries a site
//! counts as free.
//!
//! **Method.** Over a part of a site, the centers of the disks of that radius that are tangent to it lie on an arc.
//! A place of the boundary that is near enough to both ends of that arc lies in all disks, unless the arc turns away
//! from it in between. The distance to a segment is a convex function: along the chord of the arc of centers none is
//! farther from it than one of the ends, and sagittas come on top. An arc that bends with the arc of centers, as the
//! other wall of a channel does, is nearest and farthest at the ends of that, or on the line through both centers.
//! Where nothing is found, the part is halved.

use super::bvh::SearchDisk;
use super::piece::Piece;
use super::shot::{Field, RADIUS_ERROR, Shot};
use super::site::{Joint, NONE, Site};
use super::track::Track;
use crate::geom::{Point, Vector};
use rayon::prelude::*;

/// Parts of a site that are looked at, at most, for each radius of its length, of which no more count: the shots at its
/// ends tell as well, and more.
const PARTS: usize = 8;
const LENGTHS: usize = 128;

/// A part is halved if the middle disk is held back by more than this part of the way from it to the others, or of the
/// radius: by less, it would take many halvings.
const MARGIN: f64 = 0.125;

/// Sites to look at in one go.
const SITES: usize = 256;

/// A radius that is asked for, and what round-off may make of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor {
    pub radius: f64,
    pub error: f64,
}

/// Whether each site is free, or at least not low; `shots` know of each joint a disk that is not too small.
pub(super) fn free_sites(field: &Field, shots: &[Shot], floor: Floor) -> Vec<bool> {
    let is_low_at = |joint: u32| shots[joint as usize].radius < floor.radius;
    let is_free = |id: usize| {
        let ends = [field.sites[id].prev, id as u32];
        !(ends.into_iter().all(is_low_at) && Low::of(field, shots, floor, id as u32).is_sure())
    };
    (0..field.sites.len()).into_par_iter().with_min_len(SITES).map(is_free).collect()
}

/// A site that may be low.
struct Low<'a> {
    field: &'a Field<'a>,
    site: &'a Site,
    piece: Piece,
    floor: Floor,
    /// Sites that hold back many of its disks.
    near: [u32; 2],
}

impl<'a> Low<'a> {
    fn of(field: &'a Field<'a>, shots: &[Shot], floor: Floor, id: u32) -> Low<'a> {
        let site = &field.sites[id as usize];
        let piece = Piece { site: id, from: site.start, to: site.end, vertices: site.vertices };
        let near = [site.prev, id].map(|joint| shots[joint as usize].site);
        Low { field, site, piece, floor, near }
    }

    /// Whether it is low for sure.
    fn is_sure(&self) -> bool {
        let Floor { radius, error } = self.floor;
        if self.site.own_limit() < radius {
            return true;
        }
        let track = Track::of(self.field.sites, &self.piece);
        let around = if self.site.is_vertex { Some(self.site.start.point) } else { self.site.center() };
        let mut open = vec![[0.0, 1.0]];
        let lengths = self.site.start.point.distance(self.site.end.point) / radius;
        for _ in 0..PARTS * (1 + lengths as usize).min(LENGTHS) {
            let Some([from, to]) = open.pop() else { return true };
            let t = 0.5 * (from + to);
            let [a, middle, b] = [from, t, to].map(|t| track.at(t));
            let [from_center, middle, to_center] = [&a, &middle, &b].map(|probe| probe.center(radius));
            let part = Part {
                ends: [from_center, to_center],
                along: [a.normal.right(), b.normal.right()],
                middle,
                around,
                enough: radius - error,
            };
            match self.look(&part) {
                Found::Holds => {}
                Found::Near(margin) if margin > MARGIN * part.reach().min(radius) => {
                    open.extend([[from, t], [t, to]]);
                }
                Found::Near(_) | Found::Nothing => return false,
            }
        }
        open.is_empty()
    }

    /// Looks for a site that holds back all disks over a part, around the middle one.
    fn look(&self, part: &Part) -> Found {
        let sites = self.field.sites;
        if self.near.iter().any(|&i| i != NONE && part.is_held(sites, &sites[i as usize])) {
            return Found::Holds;
        }
        let (mut best, mut found) = (part.enough, Found::Nothing);
        let disk = |radius: f64| SearchDisk { center: part.middle, radius };
        self.field.bvh.search(disk(best), |i| {
            let site = &sites[i as usize];
            let distance = site.distance(part.middle);
            if distance >= best {
                return None;
            }
            let margin = part.enough - distance;
            found = if part.is_held(sites, site) { Found::Holds } else { Found::Near(margin) };
            best = if found == Found::Holds { 0.0 } else { distance };
            Some(disk(best))
        });
        found
    }
}

/// What there is around the middle disk over a part of a site.
#[derive(Clone, Copy, PartialEq)]
enum Found {
    /// A site that holds back all disks.
    Holds,
    /// One that holds back the middle one, by so much.
    Near(f64),
    Nothing,
}

/// The centers of the disks over a part of a site.
struct Part {
    ends: [Point; 2],
    /// Directions in which the arc of centers runs at its ends.
    along: [Vector; 2],
    middle: Point,
    /// The center of that arc, if it is one.
    around: Option<Point>,
    /// What is nearer than that to a center lies in the disk.
    enough: f64,
}

impl Part {
    /// Largest distance of the middle center from the others.
    fn reach(&self) -> f64 {
        let [a, b] = self.ends.map(|end| end.distance(self.middle));
        a.max(b)
    }

    /// Whether a site reaches into all disks, or it and one of its neighbors do.
    fn is_held(&self, sites: &[Site], site: &Site) -> bool {
        self.is_held_at(site.nearest(self.middle))
            || self.is_held_along(site)
            || self.is_held_around(sites, site)
    }

    /// Whether a place lies in all disks.
    fn is_held_at(&self, place: Point) -> bool {
        let [a, b] = self.ends.map(|end| end - place);
        let is_farthest_between = a.dot(self.along[0]) > 0.0 && b.dot(self.along[1]) < 0.0;
        a.length().max(b.length()) < self.enough && !is_farthest_between
    }

    /// Whether a site that is as good as straight reaches into all disks.
    fn is_held_along(&self, site: &Site) -> bool {
        let [a, b] = self.ends;
        let sagitta = self.middle.distance(a.midpoint(b));
        // From the arc of the site to its chord, and back.
        let slack = sagitta + 2.0 * site.sagitta();
        slack < self.enough && site.distance(a).max(site.distance(b)) + slack < self.enough
    }

    /// Whether an arc that bends like that of the centers reaches into all disks, or it and another one that it
    /// goes on in smoothly.
    fn is_held_around(&self, sites: &[Site], site: &Site) -> bool {
        let reaches = |site: &Site, end: Point| site.spans(site.nearest_on_carrier(end));
        let all = |other: &Site| self.ends.iter().all(|&end| reaches(site, end) || reaches(other, end));
        let [before, after] = [site.prev, site.next].map(|i| &sites[i as usize]);
        let goes_on = |first: &Site| matches!(first.joint, Joint::Smooth { .. });
        self.bends_with(site)
            && (all(site)
                || (goes_on(site) && all(after) && self.bends_with(after))
                || (goes_on(before) && all(before) && self.bends_with(before)))
    }

    /// Whether the circle of an arc is as near to all centers as is enough, and bends with them.
    fn bends_with(&self, site: &Site) -> bool {
        let (Some(own), Some(other)) = (self.around, site.center()) else { return false };
        let (bend, apart) = (own.distance(self.middle), own.distance(other));
        let from_other = self.ends.map(|end| end - other);
        let rates = [0, 1].map(|i| from_other[i].dot(self.along[i]));
        let [a, b] = from_other.map(Vector::length);
        let nearest = if rates[0] < 0.0 && rates[1] > 0.0 { bend - apart } else { a.min(b) };
        let farthest = if rates[0] > 0.0 && rates[1] < 0.0 { bend + apart } else { a.max(b) };
        let radius = site.curvature.abs().recip();
        let off = (nearest - radius).abs().max((farthest - radius).abs()) + RADIUS_ERROR * (radius + bend);
        // Seen from within the circle of centers, these run in one direction.
        apart < bend && off < self.enough
    }
}
