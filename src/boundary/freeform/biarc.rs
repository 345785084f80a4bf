//! Biarcs: two arcs with one tangent at their joint, between two nodes with given tangents.
//!
//! **Method.** Let the tangents turn by `alpha` and `beta` from the chord. All joints lie on a circle
//! through the nodes, where the chords of both arcs meet at the angle `sigma = (beta - alpha) / 2`.
//! The joint in the middle of that circle makes both chords equally long, others divide `sigma` as the
//! chords are to be. S0's joint makes the first
//! arc osculate the curve where it is more curved, which keeps the curvature monotone for every
//! spiral (Meek and Walton, *Approximating smooth planar curves by arc splines*, 1995; Aichholzer et
//! al., *Medial axis computation for planar free-form shapes*, 2009, Algorithm 1). No center appears,
//! so that arcs as good as straight cost no digits.

use crate::geom::{Point, Vector};

/// A place of the curve where arcs meet, with their common tangent.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Node {
    /// Parameter along the curve.
    pub u: f64,
    /// Its place, as it is stored.
    pub place: Vector,
    /// Unit tangent of the arcs, which may differ a little from that of the curve.
    pub tangent: Vector,
    /// Signed curvature of the curve.
    pub curvature: f64,
}

/// An arc as it is stored, relative to the origin of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    /// Where it begins.
    pub start: Vector,
    /// Where it ends.
    pub end: Vector,
    /// Tangent of a quarter of the sweep.
    pub bulge: f64,
}

impl Arc {
    /// The arc that leaves `start` with unit tangent `tangent`.
    pub fn leaving(start: Vector, tangent: Vector, end: Vector) -> Arc {
        let u = (end - start).unit();
        Arc { start, end, bulge: tangent.cross(u) / (1.0 + tangent.dot(u)) }
    }

    /// The arc that arrives at `end` with unit tangent `tangent`.
    pub fn arriving(start: Vector, end: Vector, tangent: Vector) -> Arc {
        let u = (end - start).unit();
        Arc { start, end, bulge: u.cross(tangent) / (1.0 + u.dot(tangent)) }
    }

    /// The place halfway along it.
    pub fn middle(&self) -> Vector {
        (self.start + self.end) * 0.5 - (self.end - self.start).left() * (0.5 * self.bulge)
    }

    /// Signed curvature.
    pub fn curvature(&self) -> f64 {
        4.0 * self.bulge / ((1.0 + self.bulge * self.bulge) * (self.end - self.start).length())
    }

    /// Distance of a place from the whole circle or line.
    pub fn distance(&self, p: Vector) -> f64 {
        let chord = self.end - self.start;
        let (w, length) = (p - self.start, chord.length());
        let b2 = self.bulge * self.bulge;
        let normal = chord.left().rotated((1.0 - b2) / (1.0 + b2), -2.0 * self.bulge / (1.0 + b2)) / length;
        let k = self.curvature();
        let power = w.dot(normal) - 0.5 * k * w.length_squared();
        2.0 * power.abs() / (1.0 + (1.0 - 2.0 * k * power).max(0.0).sqrt())
    }

    /// Unit tangent at the start.
    pub fn start_tangent(&self) -> Vector {
        -Arc { start: self.end, end: self.start, bulge: -self.bulge }.end_tangent()
    }

    /// Unit tangent at the end.
    pub fn end_tangent(&self) -> Vector {
        let b2 = self.bulge * self.bulge;
        let u = (self.end - self.start).unit();
        u.rotated((1.0 - b2) / (1.0 + b2), 2.0 * self.bulge / (1.0 + b2))
    }
}

impl Joint {
    /// In the middle: chords equally long.
    pub const MIDDLE: Joint = Joint::Shifted(0.0);
}

/// Which biarc of the family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Joint {
    /// Chords about as long as `1 + shift` to `1 - shift`; without one, they are equally long.
    Shifted(f64),
    /// The arc at the more curved end is its osculating circle.
    Osculating,
}

/// Places as they come back from storage: rounded to coordinates relative to the drawing's zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// What local coordinates are relative to.
    pub origin: Point,
}

impl Grid {
    /// The place that is stored for `v`.
    #[inline]
    pub fn snap(self, v: Vector) -> Vector {
        (self.origin + v) - self.origin
    }
}

/// The biarc from `a` to `b`. `None` where a tangent turns from the chord by a right angle or more,
/// and where the joint asked for lies outside.
pub(super) fn biarc(a: &Node, b: &Node, joint: Joint, grid: Grid) -> Option<[Arc; 2]> {
    let chord = b.place - a.place;
    let u = chord.unit();
    let (ahead, behind) = (a.tangent.dot(u), b.tangent.dot(u));
    if !(ahead > 0.0 && behind > 0.0 && a.tangent.dot(b.tangent) > 0.0) {
        return None;
    }
    // Tangents of the half angles.
    let (alpha, beta) = (u.cross(a.tangent) / (1.0 + ahead), u.cross(b.tangent) / (1.0 + behind));
    let to_joint = match joint {
        Joint::Shifted(shift) => shifted([alpha, beta], chord, shift),
        Joint::Osculating => osculating([alpha, beta], chord, [a.curvature, b.curvature])?,
    };
    let place = grid.snap(a.place + to_joint);
    if place == a.place || place == b.place {
        return None;
    }
    let arcs = [Arc::leaving(a.place, a.tangent, place), Arc::arriving(place, b.place, b.tangent)];
    arcs.iter().all(|arc| arc.bulge.is_finite()).then_some(arcs)
}

/// From the first node to the joint whose angles from there and from the second node are
/// `1 - shift` to `1 + shift`, by their tangents.
fn shifted([alpha, beta]: [f64; 2], chord: Vector, shift: f64) -> Vector {
    let tan = (alpha - beta) / (1.0 + alpha * beta);
    let half = tan / (1.0 + (1.0 + tan * tan).sqrt());
    let (up, down) = (1.0 + half * half * shift, 1.0 - half * half * shift);
    let along = (1.0 + shift) * up / ((1.0 + shift) * up + (1.0 - shift) * down);
    (chord + chord.left() * (half * (1.0 - shift) / up)) * along
}

/// From the first node to the joint of the biarc with one osculating arc.
fn osculating([alpha, beta]: [f64; 2], chord: Vector, [k0, k1]: [f64; 2]) -> Option<Vector> {
    if k0.abs() < k1.abs() {
        // Run backwards, the ends change places and curvatures their signs.
        let back = osculating([beta, alpha], -chord, [-k1, -k0])?;
        return Some(chord + back);
    }
    let (sin_a, cos_a) = sin_cos(alpha);
    // Half the angle between the tangents.
    let tan = (beta - alpha) / (1.0 + alpha * beta);
    let (cos_s, sin_s) = ((1.0 + tan * tan).sqrt().recip(), tan / (1.0 + tan * tan).sqrt());
    let bend = 0.5 * k0 * chord.length();
    // Directions of both chords from the whole one: the first arc has curvature k0 for certain.
    let (y, x) = ((sin_a + bend) * sin_s, cos_a * sin_s - bend * cos_s);
    let sign = if x < 0.0 { -1.0 } else { 1.0 };
    let length = x.hypot(y) * sign;
    let (cos_1, sin_1) = (x / length, y / length);
    let ratio = (sin_1 * cos_s + cos_1 * sin_s) / sin_s;
    (ratio > 0.0 && ratio < 1.0 && ratio * cos_1 < 1.0).then(|| chord.rotated(cos_1, sin_1) * ratio)
}

/// Sine and cosine of the angle whose half has the tangent `t`.
fn sin_cos(t: f64) -> (f64, f64) {
    (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{point, vector};

    const GRID: Grid = Grid { origin: point(0.0, 0.0) };

    fn node(x: f64, y: f64, angle: f64, curvature: f64) -> Node {
        Node { u: 0.0, place: vector(x, y), tangent: Vector::from_angle(angle), curvature }
    }

    #[test]
    fn both_arcs_have_one_tangent_at_the_joint() {
        for (alpha, beta) in [(-0.3, 0.4), (0.2, 0.2), (0.1, -0.5), (-0.4, -0.4), (0.0, 0.0)] {
            let (a, b) = (node(1.0, 1.0, alpha, 0.0), node(3.0, 1.0, beta, 0.0));
            let [first, second] = biarc(&a, &b, Joint::MIDDLE, GRID).unwrap();
            let start = Arc { start: second.end, end: second.start, bulge: -second.bulge }.end_tangent();
            assert!((first.end_tangent() + start).length() < 1e-15);
            assert!((second.end_tangent() - b.tangent).length() < 1e-15);
            let chords = [first, second].map(|arc| (arc.end - arc.start).length());
            assert!((chords[0] - chords[1]).abs() < 1e-15);
        }
    }

    #[test]
    fn the_osculating_arc_has_the_curvature_of_the_curve() {
        // Places of the spiral whose curvature falls from 1 to 0.8 along its length.
        let place = |s: f64| {
            let steps = 4096;
            let h = s / f64::from(steps);
            (0..steps).fold(vector(0.0, 0.0), |p, i| {
                let m = (f64::from(i) + 0.5) * h;
                p + Vector::from_angle(m - 0.1 * m * m) * h
            })
        };
        let (a, b) = (node(0.0, 0.0, 0.0, 1.0), place(1.0));
        let b = Node { place: b, ..node(0.0, 0.0, 0.9, 0.8) };
        let arcs = biarc(&a, &b, Joint::Osculating, GRID).unwrap();
        assert!((arcs[0].curvature() - 1.0).abs() < 1e-12);
        assert!(arcs[1].curvature() < 1.0 && arcs[1].curvature() > 0.8);
        // The same curve run backwards.
        let turned = |n: Node| Node { tangent: -n.tangent, curvature: -n.curvature, ..n };
        let back = biarc(&turned(b), &turned(a), Joint::Osculating, GRID).unwrap();
        assert!((back[1].curvature() + 1.0).abs() < 1e-12);
        assert!((back[0].end - arcs[0].end).length() < 1e-14);
    }

    #[test]
    fn a_turn_of_a_right_angle_from_the_chord_is_too_much() {
        assert!(biarc(&node(0.0, 0.0, -1.6, 0.0), &node(1.0, 0.0, 0.0, 0.0), Joint::MIDDLE, GRID).is_none());
        assert!(biarc(&node(0.0, 0.0, -1.0, 0.0), &node(1.0, 0.0, 1.0, 0.0), Joint::MIDDLE, GRID).is_none());
    }
}
