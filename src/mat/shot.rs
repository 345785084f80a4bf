//! Maximal disks at joints: *shots*.
//!
//! From a joint a disk grows along the normal until it touches the boundary elsewhere. The search
//! starts from the curvature limit of the sites it is tangent to, tries the contacts of the last
//! shots (the opposite wall runs backwards along with us) and the neighbors, those whose boxes meet the disk, and then
//! asks the hierarchy, which comes to most of these again. Shots are independent; hints live in runs of a fixed
//! length, so the result does not depend on threads.

use super::bvh::{Bvh, Reach, SearchDisk};
use super::site::{Joint, NONE, Site};
use super::touch::{Contact, Probe, Span, touch};
use crate::geom::{Point, vector};
use rayon::prelude::*;

/// The maximal disk at a joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shot {
    pub radius: f64,
    /// A site that it touches besides; [`NONE`] at a convex corner.
    pub site: u32,
    pub contact: Contact,
}

/// Joints to a run: long enough that hints pay, short enough to spread over threads.
const RUN: usize = 512;

/// Sites on either side of a joint that are tried before the search. On a wall that is nearly round they
/// hold the disk back, and one held back by the far side alone nearly touches all others: the search
/// would look at every site.
const NEIGHBORS: usize = 4;

/// Disks so many times as large as the site at their joint may be held back by neighbors of that site; of smaller
/// ones the hierarchy finds neighbors soon enough.
const ROUND: f64 = 16.0;

/// Larger than any disk in the unit frame.
const OUTSIDE: f64 = 2.0;

impl Shot {
    /// No disk: that of a convex corner, or of a joint that is left out.
    pub const NONE: Shot = Shot { radius: 0.0, site: NONE, contact: Contact::Start };
}

/// Sites touched last, the newest first.
struct Hints([u32; 6]);

impl Hints {
    fn remember(&mut self, site: u32) {
        let at = self.0.iter().position(|&s| s == site).unwrap_or(self.0.len() - 1);
        self.0[..=at].rotate_right(1);
        self.0[0] = site;
    }
}

/// The probe at the end of a site that is no convex corner.
pub(super) fn probe_at(site: &Site) -> Probe {
    Probe {
        base: site.end.point,
        offset: vector(0.0, 0.0),
        normal: site.end.normal,
        vertices: [site.vertices[1], NONE],
    }
}

/// What shots may meet.
pub(super) struct Field<'a> {
    pub sites: &'a [Site],
    pub bvh: &'a Bvh,
    /// The leaf of each site.
    leaves: Vec<u32>,
    /// Largest angle at a joint that was taken for round-off.
    blur: f64,
}

impl<'a> Field<'a> {
    /// Some sites with their hierarchy; `blur` is the largest angle at a joint that was taken for round-off.
    pub fn new(sites: &'a [Site], bvh: &'a Bvh, blur: f64) -> Field<'a> {
        Field { sites, bvh, leaves: bvh.leaves(), blur }
    }

    /// The disks at the ends of all sites. Of a disk that comes to be smaller than `floor` no more is known than that.
    pub fn shoot_all(&self, floor: f64) -> Vec<Shot> {
        let mut shots = vec![Shot::NONE; self.sites.len()];
        shots.par_chunks_mut(RUN).enumerate().for_each(|(run, chunk)| {
            let mut hints = Hints([NONE; 6]);
            for (i, shot) in chunk.iter_mut().enumerate() {
                let joint = (run * RUN + i) as u32;
                if self.sites[joint as usize].joint != Joint::Convex {
                    *shot = self.shoot(joint, &hints, floor);
                    if shot.contact != Contact::Whole {
                        hints.remember(shot.site);
                    }
                }
            }
        });
        shots
    }

    /// The disks at some joints, each with a site that holds it back.
    pub fn shoot_some(&self, joints: &[(u32, u32)]) -> Vec<Shot> {
        let shoot = |&(joint, near): &(u32, u32)| {
            let mut hints = Hints([NONE; 6]);
            hints.remember(near);
            self.shoot(joint, &hints, 0.0)
        };
        joints.par_iter().with_min_len(RUN).map(shoot).collect()
    }

    /// The maximal disk at a joint, or one below `floor` that is not smaller.
    fn shoot(&self, joint: u32, hints: &Hints, floor: f64) -> Shot {
        let sites = self.sites;
        let site = &sites[joint as usize];
        let mut growth = Growth { floor, ..Growth::of(self, joint) };
        for &hint in hints.0.iter().filter(|&&h| h != NONE) {
            growth.glance(hint);
        }
        if hints.0[0] != NONE {
            let newest = &sites[hints.0[0] as usize];
            growth.glance(newest.prev);
            growth.glance(newest.next);
        }
        let (mut back, mut ahead) = (joint, site.next);
        let beside = site.start.point.distance(site.end.point);
        let is_large = growth.osculating.is_some() || growth.best.radius > ROUND * beside;
        for _ in 0..if is_large { NEIGHBORS } else { 0 } {
            (back, ahead) = (sites[back as usize].prev, sites[ahead as usize].next);
            growth.glance(back);
            growth.glance(ahead);
        }
        if !growth.is_done() {
            self.bvh.search_around(growth.probe.base, growth.disk(), |i| {
                growth.try_site(i).then(|| growth.disk_if_open())
            });
        }
        growth.best
    }
}

/// A disk at a joint while it is held back by ever more sites.
struct Growth<'a> {
    field: &'a Field<'a>,
    probe: Probe,
    best: Shot,
    center: Point,
    /// The disk that osculates an arc at the joint, if it was that which held back first.
    osculating: Option<SearchDisk>,
    /// Below this radius it is looked for no further.
    floor: f64,
    /// The disk as it is looked for in boxes.
    reach: Reach,
    /// The two sites that meet at the joint, if they hold back nothing there.
    own: [u32; 2],
}

impl<'a> Growth<'a> {
    fn of(field: &'a Field<'a>, joint: u32) -> Growth<'a> {
        let probe = probe_at(&field.sites[joint as usize]);
        let best = curvature_limit(field.sites, joint);
        let disk = SearchDisk { center: probe.center(best.radius), radius: best.radius };
        let osculating = (best.contact == Contact::Whole).then(|| SearchDisk {
            radius: best.radius * (1.0 - direction_error(field.sites, joint, field.blur)),
            ..disk
        });
        let reach = Reach::of(&disk);
        let own = clear_at(field.sites, joint, &probe);
        Growth { field, probe, best, center: disk.center, osculating, floor: 0.0, reach, own }
    }

    fn disk(&self) -> SearchDisk {
        SearchDisk { center: self.center, radius: self.best.radius }
    }

    /// Whether the disk is so small that no more is asked.
    fn is_done(&self) -> bool {
        self.best.radius < self.floor
    }

    /// The disk while more is asked, then nothing.
    fn disk_if_open(&self) -> SearchDisk {
        let disk = self.disk();
        if self.is_done() { SearchDisk { radius: 0.0, ..disk } } else { disk }
    }

    /// Tries a site that may be near.
    #[inline]
    fn glance(&mut self, i: u32) {
        let is_near = || self.field.bvh.meets(self.field.leaves[i as usize], &self.reach);
        if !self.is_done() && is_near() && self.try_site(i) {
            self.reach = Reach::of(&self.disk());
        }
    }

    /// Lets a site hold the disk back; whether it makes it smaller.
    fn try_site(&mut self, i: u32) -> bool {
        // That which holds it back does so no more than it does.
        let is_known = i == self.best.site && self.best.contact != Contact::Whole;
        if is_known
            || self.own.contains(&i)
            || self.field.sites[i as usize].is_beyond(self.center, self.best.radius)
        {
            return false;
        }
        let (radius, contact) = touch(Span::whole(&self.field.sites[i as usize]), &self.probe);
        let shot = Shot { radius, site: i, contact };
        if !(is_better(self.field.sites, &shot, &self.best) && self.counts(i)) {
            return false;
        }
        let shrunk = shot.radius < self.best.radius;
        (self.best, self.center) = (shot, self.probe.center(shot.radius));
        shrunk
    }

    /// Whether a site may hold back a disk that osculates.
    fn counts(&self, i: u32) -> bool {
        self.osculating.is_none_or(|disk| reaches_into(&self.field.sites[i as usize], &disk))
    }
}

/// Round-off of a radius, relative to it: eight roundings on either side of a comparison.
pub(super) const RADIUS_ERROR: f64 = 16.0 * f64::EPSILON;

/// Whether a shot holds the disk back more than another. Next to the end of a site, the radius to the
/// contact and to the end differ by the square of their distance, which round-off hides long before
/// that distance: there the tangent contact is the one, or contacts would be off by its root.
fn is_better(sites: &[Site], shot: &Shot, best: &Shot) -> bool {
    if best.site == NONE || best.contact == Contact::Whole {
        return shot.radius < best.radius;
    }
    let error = RADIUS_ERROR * best.radius;
    if shot.radius >= best.radius + error {
        return false;
    }
    let (here, there) = (&sites[shot.site as usize], &sites[best.site as usize]);
    let are_neighbors = here.vertices.iter().any(|v| there.vertices.contains(v))
        || is_end_of(here, shot.contact, there)
        || is_end_of(there, best.contact, here);
    let (own, other) = (precedence(sites, here, shot.contact), precedence(sites, there, best.contact));
    if !are_neighbors || own == other {
        return shot.radius < best.radius;
    }
    shot.radius < best.radius + if own > other { error } else { -error }
}

/// Those of the two sites at a joint that do not hold back its disk there: vertices, and sites whose other end lies
/// on the tangent or behind it, as it does but where round-off has turned the normal.
fn clear_at(sites: &[Site], joint: u32, probe: &Probe) -> [u32; 2] {
    let before = &sites[joint as usize];
    let after = &sites[before.next as usize];
    let is_clear =
        |site: &Site, far: Point| site.is_vertex || probe.normal.dot(far - probe.base) <= site.error;
    [(joint, before, before.start.point), (before.next, after, after.end.point)]
        .map(|(i, site, far)| if is_clear(site, far) { i } else { NONE })
}

/// Angle by which round-off may have turned the normal at a joint, and with it an osculating disk: that of
/// the longer site there, whose ends are uncertain by so much, but no more than was seen on both sides.
fn direction_error(sites: &[Site], joint: u32, blur: f64) -> f64 {
    let before = &sites[joint as usize];
    let length = |s: &Site| s.start.point.distance(s.end.point);
    let longer = length(before).max(length(&sites[before.next as usize]));
    (before.error / longer).min(2.0 * blur)
}

/// Whether a site reaches into a disk by more than round-off. Into one that osculates an arc other arcs of
/// the same circle do not, and they hold back none: their touching disks are whatever round-off makes of them.
fn reaches_into(site: &Site, disk: &SearchDisk) -> bool {
    site.distance(disk.center) < disk.radius - site.error
}

/// Whether a contact at the end of a site is where another site ends, as where loops touch.
fn is_end_of(site: &Site, contact: Contact, other: &Site) -> bool {
    let end = match contact {
        Contact::Start => site.start.point,
        Contact::End => site.end.point,
        Contact::Inside | Contact::Whole => return false,
    };
    end == other.start.point || end == other.end.point
}

/// Which of two contacts in nearly one place tells where it really is. A corner of the pocket is none: where
/// loops touch there, the disk lies in the sector of another loop.
fn precedence(sites: &[Site], site: &Site, contact: Contact) -> u32 {
    let joint = match contact {
        Contact::Inside if !site.is_vertex => return 3,
        Contact::Inside | Contact::Whole => return 2,
        Contact::Start => sites[site.prev as usize].joint,
        Contact::End => site.joint,
    };
    u32::from(joint != Joint::Convex)
}

/// The largest disk that the sites tangent to it at the joint allow.
fn curvature_limit(sites: &[Site], joint: u32) -> Shot {
    let before = &sites[joint as usize];
    let after = &sites[before.next as usize];
    let mut best = Shot { radius: OUTSIDE, site: NONE, contact: Contact::Start };
    for (i, limit) in [(joint, before.own_limit()), (before.next, after.own_limit())] {
        let tangent = match before.joint {
            Joint::Smooth { .. } => true,
            // Only the element on the outer side of a cone's end is tangent there.
            Joint::Cone => {
                if i == joint {
                    after.is_vertex
                } else {
                    before.is_vertex
                }
            }
            Joint::Convex => false,
        };
        if tangent && limit < best.radius {
            best = Shot { radius: limit, site: i, contact: Contact::Whole };
        }
    }
    best
}
