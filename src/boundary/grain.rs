//! The round-off of a drawing: the one length below which its places cannot be told apart.

use crate::geom::{Bounds, Point};

/// Places nearer than this many units in the last place of the largest coordinate are one place.
/// The end of an arc computed from center, radius and angle in degrees carries up to 6 of them,
/// the foot of a perpendicular on an element with such ends as many again.
const ULPS: f64 = 16.0;

/// Places found from the full curves may be off by a few times the round-off of their ends.
pub(super) const SLACK: f64 = 4.0;

/// Units in the last place of the largest coordinate by which elements of a pocket may overlap on the way
/// from a common end to where they part: they cannot be told apart there.
pub(crate) const TOUCHING_ULPS: f64 = SLACK * ULPS;

/// Round-off of the places of one drawing, in job units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Grain {
    /// Places nearer than this are one place, and curves nearer than this touch.
    pub same: f64,
    /// Half a unit in the last place of the largest coordinate.
    pub ulp: f64,
}

impl Grain {
    /// The round-off of a drawing within a box.
    ///
    /// The axis is computed in units of a power of two above the diagonal. Round-off there counts as half of
    /// that at least, or places would be two here and one there.
    pub fn of(bounds: &Bounds) -> Grain {
        let ulp = f64::EPSILON * bounds.magnitude();
        let unit = bounds.diagonal().log2().ceil().exp2();
        Grain { same: ULPS * ulp.max(0.5 * f64::EPSILON * unit), ulp: 0.5 * ulp }
    }

    /// The box of all places that cannot be told from `p`.
    pub fn around(&self, p: Point) -> Bounds {
        Bounds { min: p, max: p }.grown(self.same)
    }
}
