//! From the loops of a pocket to its sites.
//!
//! Loops that touch are taken apart (`splice`), many arcs on one circle are united up to a quarter turn
//! (`cocircular`), and arcs that sweep more are divided (`parts`). It is told how the boundary goes on between them
//! (`joints`), reflex vertices get their normal cones, and every hole gets a joint at its extreme place in one
//! direction: the maximal disk there lies beyond the hole and links it to a component that reaches farther in that
//! direction, so that these links form a tree (design after Aichholzer et al., SoCG 2009, with a shot for their sweep).

use super::cocircular::each_run;
use super::frame::Frame;
use super::joints::{joint_between, lend_directions, share_normals};
use super::parts::{Part, QUARTER_SLACK, add_parts, split_at_extreme};
use super::site::{Foot, Joint, NONE, Site};
use super::splice::{Drawn, same_places, splice};
use super::{SiteKind, SiteRef};
use crate::boundary::Pocket;
use crate::geom::{Point, Vector};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

/// A closed row of sites.
#[derive(Clone, Debug)]
pub(crate) struct Ring {
    pub sites: Range<u32>,
    /// For a hole, the joint whose disk links it to the rest; `None` for an outer ring.
    pub link: Option<u32>,
}

/// All sites of a pocket.
#[derive(Clone, Debug)]
pub(crate) struct Sites {
    pub sites: Vec<Site>,
    pub rings: Vec<Ring>,
    /// For every convex joint at a place where loops touch: the first such joint there.
    pub touching: HashMap<u32, u32>,
    /// Round-off of a drawn coordinate.
    noise: f64,
    /// Largest angle at a joint that round-off may have made of a smooth one.
    pub blur: f64,
}

/// Roundings in a place of the boundary: two coordinates of either end, and of the place between.
pub(super) const PLACE_ROUNDINGS: f64 = 8.0;

impl Sites {
    /// The sites in the unit frame, holes with a joint at their extreme place in `direction`.
    pub fn of(pocket: &Pocket, frame: &Frame, direction: Vector) -> Sites {
        let mut all = Sites {
            sites: Vec::with_capacity(pocket.loops().map(|l| l.len()).sum()),
            rings: Vec::new(),
            touching: HashMap::new(),
            noise: frame.noise,
            blur: 0.0,
        };
        // Sweeps of a bulge up to this are not divided.
        let whole = (0.25 * FRAC_PI_2 * (1.0 + QUARTER_SLACK)).tan();
        let mut parts = Vec::new();
        for row in splice(pocket.loops(), frame) {
            let hole = is_hole(&row, pocket);
            parts.clear();
            parts.reserve(row.len() + row.len() / 4);
            each_run(&row, whole, frame.noise, |run| add_parts(&run, whole, &mut parts));
            drop(row);
            let lent = lend_directions(&mut parts, frame.noise);
            all.blur = all.blur.max(lent).max(share_normals(&mut parts, frame.noise));
            if hole {
                split_at_extreme(&mut parts, direction);
            }
            all.add_ring(&parts, hole.then_some(direction));
        }
        all.find_touching();
        all
    }

    /// How many islands the axis runs around.
    ///
    /// It runs around every hole, and through a place where loops touch from one sector of the pocket
    /// into another, but only between those that are corners: in a sector of half a turn or more, the
    /// place is no end of the axis, and an island that touches there is as good as a part of the wall: it may
    /// divide the axis into `parts`.
    pub fn encircled(&self, parts: usize) -> usize {
        let holes = self.rings.iter().filter(|ring| ring.link.is_some()).count();
        let united = self.touching.iter().filter(|(joint, first)| joint != first).count();
        (parts + holes + united).saturating_sub(self.rings.len() - holes)
    }

    fn add_ring(&mut self, parts: &[Part], direction: Option<Vector>) {
        let first = self.sites.len() as u32;
        for (i, part) in parts.iter().enumerate() {
            let after = &parts[(i + 1) % parts.len()];
            let joint = joint_between(part, after, self.noise);
            if part.is_as_good_as_a_vertex(self.noise) {
                let end = Foot { point: part.start.point, ..part.end };
                self.push(part.start, end, 0.0, true, joint, part.source);
            } else {
                self.push(part.start, part.end, part.curvature, false, joint, part.source);
            }
            if joint == Joint::Cone {
                self.add_cone(part.end, after, direction);
            }
        }
        self.connect(first);
        let sites = first..self.sites.len() as u32;
        let link = direction.and_then(|u| self.extreme_joint(sites.clone(), u));
        self.rings.push(Ring { sites, link });
    }

    /// The normal cone of the reflex vertex where `after` begins, in parts of a quarter at most and
    /// split at `direction` if that lies inside.
    fn add_cone(&mut self, before: Foot, after: &Part, direction: Option<Vector>) {
        let (n0, n1) = (before.normal, after.start.normal);
        let is_within_quarter = n0.cross(n1) < 0.0 && n0.dot(n1) >= 0.0;
        let angle = if is_within_quarter { -FRAC_PI_2 } else { n0.angle_to(n1) };
        // A cusp may turn by half a turn and a rounding more.
        let angle = if angle > 0.0 { -std::f64::consts::PI } else { angle };
        let count = (-angle / FRAC_PI_2 - QUARTER_SLACK).ceil().max(1.0) as usize;
        let between = |i: usize| {
            let (sin, cos) = (angle * i as f64 / count as f64).sin_cos();
            n0.rotated(cos, sin)
        };
        let source = SiteRef { kind: SiteKind::Vertex, ..after.source };
        let foot = |normal| Foot { point: after.start.point, normal };
        let mut from = n0;
        for to in (1..count).map(between).chain([n1]) {
            let inside = |u: &Vector| from.cross(*u) < 0.0 && u.cross(to) < 0.0 && u.dot(from + to) > 0.0;
            for normal in direction.filter(inside).into_iter().chain([to]) {
                self.push(foot(from), foot(normal), 0.0, true, Joint::Cone, source);
                from = normal;
            }
        }
    }

    fn push(
        &mut self,
        start: Foot,
        end: Foot,
        curvature: f64,
        is_vertex: bool,
        joint: Joint,
        source: SiteRef,
    ) {
        let (prev, next, vertices) = (NONE, NONE, [NONE; 2]);
        let error = PLACE_ROUNDINGS * self.noise;
        self.sites.push(Site {
            start,
            end,
            curvature,
            error,
            is_vertex,
            joint,
            prev,
            next,
            vertices,
            source,
        });
    }

    /// Neighbors and vertex ids of the ring that begins at `first` and ends with the last site.
    /// A vertex has the number of the first site that ends in it.
    fn connect(&mut self, first: u32) {
        let end = self.sites.len() as u32;
        for i in first..end {
            let site = &mut self.sites[i as usize];
            site.prev = if i == first { end - 1 } else { i - 1 };
            site.next = if i + 1 == end { first } else { i + 1 };
        }
        for i in first..end {
            let prev = self.sites[i as usize].prev;
            let begins =
                if i == first { self.last_vertex(first, end) } else { self.sites[prev as usize].vertices[1] };
            let site = &mut self.sites[i as usize];
            site.vertices = [begins, if site.is_vertex { begins } else { i }];
        }
    }

    /// Vertex where the last site of a ring ends: the end of its last element.
    fn last_vertex(&self, first: u32, end: u32) -> u32 {
        (first..end).rev().find(|&i| !self.sites[i as usize].is_vertex).unwrap_or(first)
    }

    /// The joint of a hole whose normal is (nearest to) the direction at the farthest place.
    fn extreme_joint(&self, sites: Range<u32>, direction: Vector) -> Option<u32> {
        let reach = |i: u32| self.sites[i as usize].end.point.to_vector().dot(direction);
        let along = |i: u32| self.sites[i as usize].end.normal.dot(direction);
        let free = sites.filter(|&i| self.sites[i as usize].joint != Joint::Convex);
        free.max_by(|&a, &b| {
            reach(a).total_cmp(&reach(b)).then(along(a).total_cmp(&along(b))).then(b.cmp(&a))
        })
    }

    /// Convex joints of different sectors at one place.
    fn find_touching(&mut self) {
        let convex = (0u32..).zip(&self.sites).filter(|(_, site)| site.joint == Joint::Convex);
        let places: Vec<(u32, Point)> = convex.map(|(i, site)| (i, site.end.point)).collect();
        for group in same_places(places.iter().copied()) {
            self.touching.extend(group.iter().map(|&i| (i, group[0])));
        }
    }
}

/// Whether a row of elements runs around a hole. The loops of a pocket tell it themselves, the outer one
/// first; it is measured where loops that touch were taken apart.
fn is_hole(row: &[Drawn], pocket: &Pocket) -> bool {
    let index = row[0].loop_index;
    let drawn = if index == 0 { pocket.outer() } else { &pocket.islands()[index as usize - 1] };
    if drawn.len() == row.len() && row.iter().all(|d| d.loop_index == index) {
        return index > 0;
    }
    row.iter().map(|d| d.element.area(row[0].element.start)).sum::<f64>() < 0.0
}
