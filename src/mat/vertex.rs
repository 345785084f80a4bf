//! The axis as it is read: vertices and edges in job units.

use crate::geom::Point;
use serde::{Deserialize, Serialize};

/// A disk of the transform.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Disk {
    /// Its center, a point of the axis.
    pub center: Point,
    /// Its radius: the distance of the center to the boundary.
    pub radius: f64,
}

/// What an axis vertex is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Degree 1.
    Leaf,
    /// Degree 2, where one site gives way to the next.
    Joint,
    /// Degree 3 or more.
    Branch,
    /// Degree 2, an interior minimum of the radius.
    Neck,
    /// An interior maximum of the radius.
    Peak,
}

/// Which boundary element an axis edge is nearest to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SiteRef {
    /// Index of the loop in [`Pocket::loops`](crate::Pocket::loops).
    #[serde(rename = "loop")]
    pub loop_index: u32,
    /// Index of the element; of the vertex for a reflex vertex. Where several arcs lie on one circle to
    /// within round-off, and all in a quarter of it, that of the first stands for them.
    pub element: u32,
    /// What it is.
    pub kind: SiteKind,
}

/// What a site is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SiteKind {
    /// A straight element.
    Segment,
    /// A circular arc.
    Arc,
    /// A reflex vertex.
    Vertex,
}

/// A vertex of the axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisVertex {
    /// Its maximal disk.
    pub disk: Disk,
    /// What it is.
    pub kind: Kind,
}

/// An edge of the axis: one conic arc along which the radius is monotone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisEdge {
    /// Index of the vertex where it begins.
    pub from: u32,
    /// Index of the vertex where it ends.
    pub to: u32,
    /// The sites on its left and right.
    pub sites: [SiteRef; 2],
    /// Control points of the rational quadratic Bezier curve with end weights 1.
    pub points: [Point; 3],
    /// Middle weight.
    pub weight: f64,
}

impl AxisEdge {
    /// Whether it is a straight segment: its control point is the middle of its ends, to the last bit.
    pub fn is_straight(&self) -> bool {
        self.points[1] == self.points[0].midpoint(self.points[2])
    }
}
