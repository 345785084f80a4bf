//! How the boundary goes on from one part to the next: round-off, a corner, a reflex vertex or a cusp.
//!
//! Directions are known to the round-off of places over the length of an element. Where that hides whether a joint is a
//! corner, it is smooth and both sides get one direction.

use super::parts::Part;
use super::site::Joint;
use super::splice::TANGENT_ROUNDINGS;
use crate::boundary::TOUCHING_ULPS;

/// Turns elements near the round-off, which have no direction of their own, to that of a longer
/// neighbor, one after the other, where one of them is an arc. Their tilt would hide a corner between
/// the neighbors: either joint looks smooth for what is known of the short element, but both together
/// need not be.
///
/// Longer ones keep their own direction, or levels beside them would be off by its change; so do those
/// between segments, where a joint is the corner that is drawn, however short they are.
/// Answers the largest angle of a turn.
pub(super) fn lend_directions(parts: &mut [Part], noise: f64) -> f64 {
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
        let is_seen = angle.abs() > angle_error([parts[from].chord.recip(), 0.0], noise);
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
pub(super) fn share_normals(parts: &mut [Part], noise: f64) -> f64 {
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
    angle_error([tilt(part.chord), tilt(after.chord)], noise)
}

/// The round-off of the angle between two directions, by one over the lengths that they come from.
pub(super) fn angle_error([before, after]: [f64; 2], noise: f64) -> f64 {
    TANGENT_ROUNDINGS * noise * (1.0 + before + after)
}

/// How the boundary goes on from one part to the next.
pub(super) fn joint_between(part: &Part, after: &Part, noise: f64) -> Joint {
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
