//! Maximal disks at joints: *shots*.
//!
//! From a joint a disk grows along the normal until it touches the boundary elsewhere. The search
//! starts from the curvature limit of the sites it is tangent to, tries the contacts of the last
//! shots (the opposite wall runs backwards along with us), and then asks the hierarchy. Shots are
//! independent; hints live in runs of a fixed length, so the result does not depend on threads.

use super::bvh::{Bvh, SearchDisk};
use super::site::{Joint, NONE, Site};
use super::touch::{Contact, Probe, Span, touch};
use crate::geom::vector;
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

/// Larger than any disk in the unit frame.
const OUTSIDE: f64 = 2.0;

/// The disks at the ends of all sites.
pub(super) fn shoot_all(sites: &[Site], bvh: &Bvh) -> Vec<Shot> {
    let mut shots = vec![Shot { radius: 0.0, site: NONE, contact: Contact::Start }; sites.len()];
    shots.par_chunks_mut(RUN).enumerate().for_each(|(run, chunk)| {
        let mut hints = Hints([NONE; 4]);
        for (i, shot) in chunk.iter_mut().enumerate() {
            let joint = (run * RUN + i) as u32;
            if sites[joint as usize].joint != Joint::Convex {
                *shot = shoot(sites, bvh, joint, &hints);
                if shot.contact != Contact::Whole {
                    hints.remember(shot.site);
                }
            }
        }
    });
    shots
}

/// Sites touched last, the newest first.
struct Hints([u32; 4]);

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

fn shoot(sites: &[Site], bvh: &Bvh, joint: u32, hints: &Hints) -> Shot {
    let site = &sites[joint as usize];
    let probe = probe_at(site);
    let mut best = curvature_limit(sites, joint);
    let try_site = |best: &mut Shot, i: u32| -> bool {
        let (radius, contact) = touch(Span::whole(&sites[i as usize]), &probe);
        // A vertex and the ends of its neighbors are one place: the tangent contact is the one.
        let better = radius < best.radius
            || radius == best.radius && contact == Contact::Inside && best.contact != Contact::Inside;
        if better {
            let shrunk = radius < best.radius;
            *best = Shot { radius, site: i, contact };
            return shrunk;
        }
        false
    };
    for &hint in hints.0.iter().filter(|&&h| h != NONE) {
        try_site(&mut best, hint);
    }
    if hints.0[0] != NONE {
        let newest = &sites[hints.0[0] as usize];
        try_site(&mut best, newest.prev);
        try_site(&mut best, newest.next);
    }
    let disk = |radius: f64| SearchDisk { center: probe.center(radius), radius };
    bvh.search(disk(best.radius), |i| try_site(&mut best, i).then(|| disk(best.radius)));
    best
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
