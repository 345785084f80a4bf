//! What biarcs are laid for, between which ends, and how many of them.

use super::biarc::{Joint, Node};
use super::piece::Jet;
use super::spiral::Scheme;

/// The least number of arcs tried, as a part of the number that the density says: it is not that
/// precise for few arcs.
const FIRST: f64 = 31.0 / 32.0;

/// With more biarcs than this, the density is right but where it is too low.
pub(super) const MANY: f64 = 3.0;

/// Biarcs that are many are made shorter by this part than the density says, as it is not constant along
/// one.
pub(super) const SPARE: f64 = 1.0 / 64.0;

/// A biarc turns by about this angle at most where the derivative of the curvature does not limit it,
/// in radians. The tangents of a biarc must be within a right angle of its chord; so the curve need not
/// be cut where it has turned by a right angle.
const MAX_TURN: f64 = 1.25;

/// What biarcs are laid for.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    /// Largest distance from the curve.
    pub tolerance: f64,
    /// Where arcs of a biarc meet.
    pub joint: Joint,
    /// Whether tangents are turned at nodes.
    pub tilted: bool,
    /// The error of an arc of length 1 where the derivative of the curvature is 1.
    pub constant: f64,
}

/// The ends of a part of the curve.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    /// The nodes.
    pub nodes: [Node; 2],
    /// Whether an arc over an apex ends there.
    pub apex_arcs: [bool; 2],
    /// Whether one arc may be alone there.
    pub singles: [bool; 2],
    /// Whether the arc over an apex that ends there may be laid again within less.
    pub yields: [bool; 2],
    /// Curvatures of the arcs over apices that end there.
    pub circles: [Option<f64>; 2],
    /// Parameters of those apices, or of the nodes.
    pub reach: [f64; 2],
}

impl Ends {
    /// Ends without arcs over apices.
    pub fn of(nodes: [Node; 2]) -> Ends {
        let (none, reach) = ([false; 2], nodes.map(|node| node.u));
        Ends { nodes, apex_arcs: none, singles: none, yields: none, circles: [None; 2], reach }
    }
}

/// Nothing fits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lost {
    /// The ends where something might if the arc over an apex there gave way.
    pub ends: [bool; 2],
}

/// How many arcs, and which biarc is one arc alone.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    /// Number of biarcs, the arc alone included.
    pub biarcs: usize,
    /// Which is one arc alone.
    pub single: Option<usize>,
}

impl Goal {
    /// The goal of a scheme.
    pub fn of(scheme: Scheme, tolerance: f64) -> Goal {
        let (joint, constant) = match scheme {
            Scheme::Osculating | Scheme::Bisection | Scheme::Published => (Joint::Osculating, 1.0 / 12.0),
            Scheme::Plain => (Joint::MIDDLE, 2.0 / 81.0),
            Scheme::Fewest | Scheme::Tilted => (Joint::MIDDLE, 3f64.sqrt() / 216.0),
        };
        Goal { tolerance, joint, tilted: matches!(scheme, Scheme::Fewest | Scheme::Tilted), constant }
    }

    /// Biarcs for each unit of the parameter.
    pub fn density(&self, least: f64, jet: &Jet) -> f64 {
        // With `speed2` to the third, the sixth power of all has no root and one division.
        let [speed2, cross, turn] = jet.turn();
        let error = 0.125 * self.constant / self.tolerance * turn;
        let (bend, least) = (cross / MAX_TURN, least * least * least);
        let (cube, sixth) = (speed2 * speed2 * speed2, bend * bend * bend);
        let inverse = cube.recip();
        let sum = (error * error + sixth * sixth * inverse) * inverse + least * least * cube;
        cube_root(sum.sqrt())
    }
}

/// Digits that a step towards a cube root starts from: a third of the exponent, with the best bias.
const THIRD: u64 = 715_094_163 << 32;

/// The cube root of a number that is not negative, to 40 bits: as good as a density needs, in a tenth of the
/// time of the whole.
fn cube_root(x: f64) -> f64 {
    if !x.is_finite() {
        return x;
    }
    let mut root = f64::from_bits(x.to_bits() / 3 + THIRD);
    // Halley's method triples the digits.
    for _ in 0..2 {
        let cube = root * root * root;
        root *= (cube + 2.0 * x) / (2.0 * cube + x);
    }
    root
}

impl Layout {
    /// The layout of some arcs. With an odd number, one is alone in the middle, where it has the tangents
    /// that biarcs beside it should have; of three, beside an arc over an apex where the curve bends most.
    pub fn of(arcs: usize, ends: &Ends) -> Option<Layout> {
        let biarcs = arcs.div_ceil(2);
        if arcs.is_multiple_of(2) {
            return Some(Layout { biarcs, single: None });
        }
        let bend = ends.nodes.map(|node| node.curvature.abs());
        if biarcs > 2 {
            let middle = if bend[0] > bend[1] { biarcs / 2 } else { (biarcs - 1) / 2 };
            return Some(Layout { biarcs, single: Some(middle) });
        }
        let bend = [0, 1].map(|i| if ends.singles[i] { bend[i] } else { -1.0 });
        let first = bend[0] > bend[1];
        let possible = biarcs == 2 && ends.singles[usize::from(!first)];
        possible.then_some(Layout { biarcs, single: Some(usize::from(!first)) })
    }

    /// The width of a cell in biarcs.
    pub fn width(&self, i: usize) -> f64 {
        if self.single == Some(i) { 0.5 } else { 1.0 }
    }

    /// Number of biarcs, a single arc for half of one.
    pub fn all(&self) -> f64 {
        self.biarcs as f64 - if self.single.is_some() { 0.5 } else { 0.0 }
    }
}

/// The number of arcs to begin with, by the integral of the density.
pub(super) fn first(total: f64) -> usize {
    let least = if total > MANY { 1.0 + SPARE } else { FIRST };
    ((2.0 * least * total).ceil() as usize).max(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_root_cubed_is_the_number() {
        for x in [1e-300, 1e-9, 0.3, 1.0, 7.0, 8.0, 1e5, 1e300] {
            assert!((cube_root(x) / x.cbrt() - 1.0).abs() < 1e-12, "{x:e}");
        }
        assert!(
            cube_root(0.0) < 1e-100 && cube_root(f64::INFINITY).is_infinite() && cube_root(f64::NAN).is_nan()
        );
    }
}
