//! The disks tangent to one piece of the boundary, as a function of the place on it.

use super::piece::{Piece, UnitDisk};
use super::site::{NONE, Site};
use super::touch::{Contact, Probe, Span, touch};
use crate::geom::Vector;

/// A piece as a rational quadratic curve, which is stable for any radius; for a reflex vertex, its
/// normals.
pub(crate) struct Track<'a> {
    pub piece: &'a Piece,
    curvature: f64,
    is_vertex: bool,
    chord: Vector,
    /// Middle control point, seen from either end, and its weight.
    apex: [Vector; 2],
    weight: f64,
    /// Vertices at its ends where the boundary goes on without a convex corner.
    vertices: [u32; 2],
}

impl<'a> Track<'a> {
    pub fn of(sites: &[Site], piece: &'a Piece) -> Track<'a> {
        let site = &sites[piece.site as usize];
        let chord = piece.to.point - piece.from.point;
        let sine = (0.5 * chord.length() * site.curvature).clamp(-1.0, 1.0);
        let weight = (1.0 - sine * sine).max(f64::EPSILON).sqrt();
        let bow = chord.right() * (0.5 * sine / weight);
        let rounded = |v: u32| {
            if v == NONE || sites[v as usize].joint == super::site::Joint::Convex { NONE } else { v }
        };
        Track {
            piece,
            curvature: site.curvature,
            is_vertex: site.is_vertex,
            chord,
            apex: [chord * 0.5 + bow, bow - chord * 0.5],
            weight,
            vertices: piece.vertices.map(rounded),
        }
    }

    /// The place and normal at parameter `t` in 0..=1.
    #[inline]
    pub fn at(&self, t: f64) -> Probe {
        let (from, to) = (&self.piece.from, &self.piece.to);
        let s = 1.0 - t;
        if self.is_vertex {
            let normal = (from.normal * s + to.normal * t).unit();
            return Probe { base: from.point, offset: Vector::default(), normal, vertices: self.vertices };
        }
        let near_start = t <= 0.5;
        let base = if near_start { from } else { to };
        let (offset, normal) = if self.curvature == 0.0 {
            (if near_start { self.chord * t } else { self.chord * -s }, base.normal)
        } else {
            let middle = 2.0 * t * s * self.weight;
            let whole = s * s + middle + t * t;
            let v = if near_start {
                self.apex[0] * middle + self.chord * (t * t)
            } else {
                self.apex[1] * middle - self.chord * (s * s)
            };
            let offset = v / whole;
            (offset, (base.normal - offset * self.curvature).unit())
        };
        Probe { base: base.point, offset, normal, vertices: self.vertices }
    }

    /// Radius of the disk at a probe of this track that touches another piece.
    #[inline]
    pub fn reach(&self, sites: &[Site], other: &Piece, probe: &Probe) -> (f64, Contact) {
        if other.site == self.piece.site {
            return (f64::INFINITY, Contact::Inside);
        }
        let site = &sites[other.site as usize];
        touch(Span { site, from: &other.from, to: &other.to, vertices: other.vertices }, probe)
    }
}

/// A disk well inside of the edge between two pieces: over the middle of the longer one, or of the other if
/// that disk does not touch the shorter one between its ends. None where neither does, or one of them has no
/// length though it is no vertex: then round-off hides where the edge runs between its ends.
pub(super) fn inner_disk(sites: &[Site], [a, b]: [&Piece; 2], error: f64) -> Option<UnitDisk> {
    let extent = |p: &Piece| p.from.point.distance(p.to.point);
    if [a, b].into_iter().any(|p| extent(p) <= error && !sites[p.site as usize].is_vertex) {
        return None;
    }
    let (longer, shorter) = if extent(b) > extent(a) { (b, a) } else { (a, b) };
    [(longer, shorter), (shorter, longer)].into_iter().find_map(|(along, across)| {
        let track = Track::of(sites, along);
        let probe = track.at(0.5);
        let (radius, contact) = track.reach(sites, across, &probe);
        (contact == Contact::Inside && radius.is_finite())
            .then(|| UnitDisk { center: probe.center(radius), radius })
    })
}
