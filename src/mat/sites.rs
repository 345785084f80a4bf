//! From the loops of a pocket to its sites.
//!
//! Arcs are split so that none sweeps more than a quarter turn, many arcs on one circle are united up to
//! that (`cocircular`), reflex vertices get their normal cones, and every hole gets a joint at its extreme place in one direction: the maximal disk there
//! lies beyond the hole and links it to a component that reaches farther in that direction, so that
//! these links form a tree (design after Aichholzer et al., SoCG 2009, with a shot for their sweep).

use super::cocircular::{Run, each_run};
use super::frame::Frame;
use super::site::{Foot, Joint, NONE, Site};
use super::splice::{Drawn, TANGENT_ROUNDINGS, same_places, splice};
use super::{SiteKind, SiteRef};
use crate::boundary::{Pocket, TOUCHING_ULPS};
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

/// Sweeps up to a quarter turn and this fraction of one more stay whole: a drawn quarter may be
/// longer by round-off, and all that is needed is a sweep below a half turn.
const QUARTER_SLACK: f64 = 0.01;

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
        for row in splice(pocket.loops(), frame) {
            let hole = is_hole(&row, pocket);
            let mut parts: Vec<Part> = Vec::with_capacity(row.len() + row.len() / 4);
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
        let mut normals = vec![n0];
        let angle = n0.angle_to(n1);
        // A cusp may turn by half a turn and a rounding more.
        let angle = if angle > 0.0 { -std::f64::consts::PI } else { angle };
        let count = (-angle / FRAC_PI_2 - QUARTER_SLACK).ceil().max(1.0) as usize;
        for i in 1..count {
            let (sin, cos) = (angle * i as f64 / count as f64).sin_cos();
            normals.push(n0.rotated(cos, sin));
        }
        normals.push(n1);
        if let Some(u) = direction {
            let inside =
                |w: &[Vector]| w[0].cross(u) < 0.0 && u.cross(w[1]) < 0.0 && u.dot(w[0] + w[1]) > 0.0;
            if let Some(i) = normals.windows(2).position(inside) {
                normals.insert(i + 1, u);
            }
        }
        let source = SiteRef { kind: SiteKind::Vertex, ..after.source };
        for w in normals.windows(2) {
            let foot = |normal| Foot { point: after.start.point, normal };
            self.push(foot(w[0]), foot(w[1]), 0.0, true, Joint::Cone, source);
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
        for group in same_places(convex.map(|(i, site)| (i, site.end.point))) {
            self.touching.extend(group.iter().map(|&i| (i, group[0])));
        }
    }
}

/// An element, or a part of one, on its way to be a site.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: Foot,
    end: Foot,
    curvature: f64,
    source: SiteRef,
    /// Length of the chord that its normals come from, for their round-off: that of the element it is a
    /// part of, or of a longer one that lent it its direction.
    chord: f64,
    /// Length of the chord of its own element.
    own_chord: f64,
    /// Angle that it may turn by unseen: near the round-off, an arc is drawn straight, and one arc may stand
    /// for many.
    unseen: f64,
    /// Whether it is the last part of its element.
    last: bool,
}

/// Directions that round-off turns by this angle are none: places of the boundary would come in another order than
/// their normals.
const NO_DIRECTION: f64 = 1.0 / 64.0;

impl Part {
    /// Whether it is a reflex arc so small that its places do not tell its directions. Then it is a vertex that has
    /// these, and which is off by round-off.
    fn is_as_good_as_a_vertex(&self, noise: f64) -> bool {
        -self.curvature * PLACE_ROUNDINGS * noise > NO_DIRECTION
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

/// Adds the element of a run in parts that sweep a quarter at most; parts share places and normals. An element
/// whose bulge is at most `whole` is one part.
fn add_parts(run: &Run, whole: f64, parts: &mut Vec<Part>) {
    let Run { drawn, shorter, turned } = run;
    let e = &drawn.element;
    let kind = if e.is_segment() { SiteKind::Segment } else { SiteKind::Arc };
    let source = SiteRef { loop_index: drawn.loop_index, element: drawn.index, kind };
    let (n0, n1) = e.normals();
    let (curvature, own_chord) = (e.curvature(), e.chord().length());
    let start = Foot { point: e.start, normal: n0 };
    let end = Foot { point: e.end, normal: n1 };
    let (chord, unseen) = (*shorter, *turned);
    let mut part = Part { start, end, curvature, source, chord, own_chord, unseen, last: true };
    let count = if e.bulge.abs() <= whole {
        1
    } else {
        (e.sweep().abs() / FRAC_PI_2 - QUARTER_SLACK).ceil().max(1.0) as usize
    };
    for i in 1..count {
        let t = i as f64 / count as f64;
        let point = if 2 * i == count { e.midpoint() } else { e.point_at(t) };
        let foot = Foot { point, normal: e.normal_at(t) };
        parts.push(Part { end: foot, last: false, ..part });
        part.start = foot;
    }
    parts.push(part);
}

/// Splits the arc that holds the extreme place of the hole in its inside, if one does.
fn split_at_extreme(parts: &mut Vec<Part>, direction: Vector) {
    let corner = |p: &Part| p.end.point.to_vector().dot(direction);
    let farthest = parts.iter().map(corner).fold(f64::NEG_INFINITY, f64::max);
    let extreme = |p: &Part| -> Option<Point> {
        let inside = p.start.normal.cross(direction) < 0.0 && direction.cross(p.end.normal) < 0.0;
        // Holes run clockwise, so only arcs that turn right reach out between their ends.
        (p.curvature < 0.0 && inside && p.start.normal.dot(direction) > 0.0)
            .then(|| p.start.point + (p.start.normal - direction) / p.curvature)
    };
    let best = (0..parts.len())
        .filter_map(|i| Some((i, extreme(&parts[i])?)))
        .max_by(|a, b| a.1.to_vector().dot(direction).total_cmp(&b.1.to_vector().dot(direction)));
    if let Some((i, point)) = best.filter(|(_, p)| p.to_vector().dot(direction) > farthest) {
        let foot = Foot { point, normal: direction };
        let whole = parts[i];
        parts[i] = Part { end: foot, last: false, ..whole };
        parts.insert(i + 1, Part { start: foot, ..whole });
    }
}

/// Turns elements near the round-off, which have no direction of their own, to that of a longer
/// neighbor, one after the other, where one of them is an arc. Their tilt would hide a corner between
/// the neighbors: either joint looks smooth for what is known of the short element, but both together
/// need not be.
///
/// Longer ones keep their own direction, or levels beside them would be off by its change; so do those
/// between segments, where a joint is the corner that is drawn, however short they are.
/// Answers the largest angle of a turn.
fn lend_directions(parts: &mut [Part], noise: f64) -> f64 {
    let n = parts.len();
    let sliver = sliver(noise);
    if parts.iter().all(|p| p.chord >= sliver) {
        return 0.0;
    }
    let mut largest = 0.0f64;
    let beside = |i: usize, forward: bool| if forward { (i + 1) % n } else { (i + n - 1) % n };
    let tilt = |parts: &[Part], from: usize, forward: bool| {
        let to = beside(from, forward);
        let (before, after) = if forward { (from, to) } else { (to, from) };
        let angle = parts[before].end.normal.cross(parts[after].start.normal);
        let is_whole = parts[to].last && parts[beside(to, false)].last;
        let is_curved = [from, to, beside(to, forward)].iter().any(|&i| parts[i].curvature != 0.0);
        let is_round_off =
            joint_between(&parts[before], &parts[after], noise) == Joint::Smooth { same_circle: false };
        let is_seen = angle.abs() > TANGENT_ROUNDINGS * noise * (1.0 + parts[from].chord.recip());
        (is_whole && is_curved && is_round_off && is_seen && parts[to].chord < parts[from].chord.min(sliver))
            .then_some(if forward { -angle } else { angle })
    };
    let lends = |&i: &usize| tilt(parts, i, true).is_some() || tilt(parts, i, false).is_some();
    let mut lenders: Vec<usize> = (0..n).filter(lends).collect();
    lenders.sort_by(|&i, &j| parts[j].chord.total_cmp(&parts[i].chord));
    for (lender, forward) in lenders.into_iter().flat_map(|i| [(i, true), (i, false)]) {
        let mut from = lender;
        while let Some(sine) = tilt(parts, from, forward) {
            let to = beside(from, forward);
            let cos = (1.0 - sine * sine).max(0.0).sqrt();
            parts[to].start.normal = parts[to].start.normal.rotated(cos, sine);
            parts[to].end.normal = parts[to].end.normal.rotated(cos, sine);
            // What is shorter still says nothing of how it may bend.
            let longer =
                |i: usize| if parts[i].chord > parts[to].chord { parts[i].curvature.abs() } else { 0.0 };
            let bend = longer(from) + longer(beside(to, forward));
            parts[to].unseen += bend * parts[to].chord;
            parts[to].chord = parts[from].chord;
            largest = largest.max(sine.abs());
            from = to;
        }
    }
    largest
}

/// Gives both parts at every smooth joint one normal: that of the longer element, whose direction
/// round-off of its ends disturbs less. Elements near the round-off have no direction of their own.
/// Answers the largest angle that was taken for round-off.
fn share_normals(parts: &mut [Part], noise: f64) -> f64 {
    let mut blur = 0.0f64;
    for i in 0..parts.len() {
        let j = (i + 1) % parts.len();
        if joint_between(&parts[i], &parts[j], noise) == (Joint::Smooth { same_circle: false }) {
            // A lent direction gives way to one of a long element's own.
            let before_is_longer = parts[i].own_chord >= parts[j].own_chord;
            let normal = if before_is_longer { parts[i].end.normal } else { parts[j].start.normal };
            blur = blur.max(parts[i].end.normal.cross(parts[j].start.normal).abs());
            parts[i].end.normal = normal;
            parts[j].start.normal = normal;
        }
    }
    blur
}

/// Length below which noise tilts an element by more than that length: `c noise / l > l`.
pub(super) fn sliver(noise: f64) -> f64 {
    (TANGENT_ROUNDINGS * noise).sqrt()
}

/// Largest angle between two elements that round-off of their ends may have made, by their chords.
/// Between segments one as short as a sliver counts as it is drawn: if it were smooth for what is known of
/// its direction, on either side, it would hide the corner between its neighbors.
fn direction_error(part: &Part, after: &Part, noise: f64) -> f64 {
    let is_straight = part.curvature == 0.0 && after.curvature == 0.0;
    let tilt = |l: f64| if is_straight && l < sliver(noise) { 0.0 } else { l.recip() };
    TANGENT_ROUNDINGS * noise * (1.0 + tilt(part.chord) + tilt(after.chord))
}

/// How the boundary goes on from one part to the next.
fn joint_between(part: &Part, after: &Part, noise: f64) -> Joint {
    if !part.last {
        return Joint::Smooth { same_circle: true };
    }
    let (n0, n1) = (part.end.normal, after.start.normal);
    let (turn, ahead) = (n0.cross(n1), n0.dot(n1));
    let is_corner = turn.abs() > direction_error(part, after, noise) + part.unseen + after.unseen;
    // Two elements that turn back by `turn` less than half a turn and bend toward each other by `bend` meet
    // again at `2 turn / bend`. Between, they overlap by up to `turn^2 / (2 bend)`, and a pocket may.
    let bend = part.curvature + after.curvature;
    let is_cusp = ahead < 0.0 && turn * bend > 0.0 && turn * turn <= 2.0 * bend.abs() * TOUCHING_ULPS * noise;
    if is_corner && !is_cusp {
        if turn > 0.0 { Joint::Convex } else { Joint::Cone }
    } else if ahead > 0.0 {
        Joint::Smooth { same_circle: false }
    } else if is_inside_of_cusp(part, after, turn, noise) {
        Joint::Convex
    } else {
        Joint::Cone
    }
}

/// Whether the boundary turns back on the left of where it came, so that the wedge is inside: told by how
/// the sides bend, and where they do so by less than round-off, by the turn. However thin a straight wedge
/// is, a pocket has more than round-off between the ends of its sides, so that the sign is right.
fn is_inside_of_cusp(part: &Part, after: &Part, turn: f64, noise: f64) -> bool {
    let bend = part.curvature + after.curvature;
    let length = |p: &Part| p.start.point.distance(p.end.point);
    let half = 0.5 * length(part).min(length(after));
    if 0.5 * bend.abs() * half * half > noise { bend < 0.0 } else { turn > 0.0 }
}
