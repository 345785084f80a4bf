//! Disks and pieces: what the axis is built from, whichever way it is built.

use super::site::{Foot, NONE, Site};
use crate::geom::Point;

/// A disk in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitDisk {
    pub center: Point,
    pub radius: f64,
}

impl UnitDisk {
    /// How far another disk is from being this one.
    #[inline]
    pub fn apart(&self, other: &UnitDisk) -> f64 {
        self.center.distance(other.center) + (self.radius - other.radius).abs()
    }
}

/// A part of one site between two places where disks touch it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub site: u32,
    pub from: Foot,
    pub to: Foot,
    /// Vertices of the boundary at its ends, where it reaches an end of its site.
    pub vertices: [u32; 2],
}

impl Piece {
    /// Ends the piece at a foot and returns the rest.
    pub fn cut(&mut self, sites: &[Site], foot: Foot) -> Piece {
        let vertex = cut_vertex(&sites[self.site as usize]);
        let rest = Piece { from: foot, vertices: [vertex, self.vertices[1]], ..*self };
        (self.to, self.vertices[1]) = (foot, vertex);
        rest
    }
}

/// Vertex of the boundary where a site is cut: a cone is cut at its vertex, other sites at none.
pub(super) fn cut_vertex(site: &Site) -> u32 {
    if site.is_vertex { site.vertices[0] } else { NONE }
}
