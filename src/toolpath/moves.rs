//! What the machine is told to do, one motion at a time.

use crate::geom::{Element, Point, point};
use serde::{Deserialize, Serialize};

/// A place of the tool's tip, in job units. Written as `[x, y, z]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Point3 {
    /// To the right.
    pub x: f64,
    /// Up in the drawing.
    pub y: f64,
    /// Away from the table.
    pub z: f64,
}

/// One motion of the tool. Rates are job units per minute.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Move {
    /// As fast as the machine can, through air.
    Rapid {
        /// Where it ends.
        to: Point3,
    },
    /// A straight cut.
    Feed {
        /// Where it ends.
        to: Point3,
        /// Feed rate.
        rate: f64,
    },
    /// A circular cut in the plane of the drawing; a helix where z changes. Never more than a half
    /// circle.
    Arc {
        /// Where it ends.
        to: Point3,
        /// Center of the circle.
        center: Point,
        /// Whether it turns counter-clockwise.
        ccw: bool,
        /// Feed rate.
        rate: f64,
    },
}

impl Point3 {
    /// A place of the drawing at a height.
    pub const fn new(p: Point, z: f64) -> Point3 {
        Point3 { x: p.x, y: p.y, z }
    }

    /// The place in the drawing.
    pub const fn xy(self) -> Point {
        point(self.x, self.y)
    }

    /// Distance to another place.
    pub fn distance(self, other: Point3) -> f64 {
        let [x, y, z] = [self.x - other.x, self.y - other.y, self.z - other.z];
        (x * x + y * y + z * z).sqrt()
    }
}

impl Move {
    /// Along an element of half a circle at most, at a height: straight where an arc is as good as its chord.
    #[inline]
    pub(super) fn along(e: &Element, z: f64, rate: f64) -> Move {
        let to = Point3::new(e.end, z);
        match e.center().filter(|_| !is_flat(e)) {
            Some((center, _)) => Move::Arc { to, center, ccw: e.bulge > 0.0, rate },
            None => Move::Feed { to, rate },
        }
    }

    /// Where the motion ends.
    pub const fn to(&self) -> Point3 {
        match self {
            Move::Rapid { to } | Move::Feed { to, .. } | Move::Arc { to, .. } => *to,
        }
    }

    /// The feed rate; `None` for a rapid.
    pub const fn rate(&self) -> Option<f64> {
        match self {
            Move::Rapid { .. } => None,
            Move::Feed { rate, .. } | Move::Arc { rate, .. } => Some(*rate),
        }
    }
}

/// Whether an arc is no different from its chord, its center beyond reach.
fn is_flat(arc: &Element) -> bool {
    /// Round-off of the four coordinates that chord and bulge come from, one rounding each.
    const COORDINATE_ERROR: f64 = 2.0 * f64::EPSILON;
    let sagitta = 0.5 * arc.chord().length() * arc.bulge.abs();
    let magnitude =
        [arc.start.x, arc.start.y, arc.end.x, arc.end.y].into_iter().fold(0.0, |m, c| c.abs().max(m));
    sagitta <= COORDINATE_ERROR * magnitude
}

impl From<[f64; 3]> for Point3 {
    fn from([x, y, z]: [f64; 3]) -> Point3 {
        Point3 { x, y, z }
    }
}

impl From<Point3> for [f64; 3] {
    fn from(p: Point3) -> [f64; 3] {
        [p.x, p.y, p.z]
    }
}
