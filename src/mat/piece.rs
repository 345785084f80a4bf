//! Disks and pieces: what the axis is built from, whichever way it is built.

use super::site::{Foot, NONE, Site};
use crate::geom::Point;

/// A disk in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitDisk {
    pub center: Point,
    pub radius: f64,
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

/// Vertex of the boundary where a site is cut: a cone is cut at its vertex, other sites at none.
pub(super) fn cut_vertex(site: &Site) -> u32 {
    if site.is_vertex { site.vertices[0] } else { NONE }
}
