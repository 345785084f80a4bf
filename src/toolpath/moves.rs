//! Motions of the tool.

use crate::geom::{Point, point};
use crate::tolerance::Units;
use serde::{Deserialize, Serialize};

/// A place in space, in job units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point3 {
    /// To the right.
    pub x: f64,
    /// Up on the drawing.
    pub y: f64,
    /// Up along the spindle.
    pub z: f64,
}

impl Point3 {
    /// The place in the plane of the drawing.
    pub fn xy(self) -> Point {
        point(self.x, self.y)
    }
}

/// One motion of the tool. It begins where the one before it ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Move {
    /// As fast as the machine can, above the stock (G0).
    Rapid {
        /// Where it ends.
        to: Point3,
    },
    /// Straight, with a feed rate (G1).
    Feed {
        /// Where it ends.
        to: Point3,
        /// Job units per minute.
        rate: f64,
    },
    /// Along an arc in the xy plane, never more than half a circle (G2, G3). A change of z makes
    /// it a helix.
    Arc {
        /// Where it ends.
        to: Point3,
        /// Center of the arc.
        center: Point,
        /// Whether it turns counter-clockwise.
        ccw: bool,
        /// Job units per minute.
        rate: f64,
    },
}

impl Move {
    /// Where it ends.
    pub fn to(&self) -> Point3 {
        match self {
            Move::Rapid { to } | Move::Feed { to, .. } | Move::Arc { to, .. } => *to,
        }
    }
}

/// A finished tool path.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// In order.
    pub moves: Vec<Move>,
    /// Unit of all lengths.
    pub units: Units,
}
