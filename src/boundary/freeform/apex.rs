//! One arc over an apex.
//!
//! **Guarantees** an arc within the tolerance of the curve around an apex, as far to both sides as it
//! may reach, nearly. Being the extremum itself, it costs the curve no apex.
//!
//! **Method.** Its ends lie on the curve, as far from the apex; its bulge makes the errors on both
//! sides of the arc equal. Such an arc spares more than another: with curvature `k - c s^2 / 2` it errs
//! by `c L^4 / 140` for ends at `s = L` and `-L`, where the least number of any arcs within that error
//! would be 1.35, and with `k - c |s|` by `c L^3 / 61`, for 1.37. In both cases that is the change of
//! the curvature times `L^2 / 65`, about, which makes a first guess.

use super::biarc::{Arc, Node};
use super::bound::Distance;
use super::spiral::Cell;
use super::track::{Side, Track};

/// Error over change of curvature times squared reach.
const FLATNESS: f64 = 1.0 / 65.0;

/// Steps of the guess, and corrections of the arc.
const GUESSES: usize = 6;
const MAX_CORRECTIONS: usize = 16;

/// The error is the tolerance, or less by this part.
const WINDOW: f64 = 1.0 / 16.0;

/// A rise of the middle of the arc by 1 moves the error at its sides by this part.
const AT_SIDES: f64 = 0.41;

/// Largest half of the turn of the arc, in radians.
const MAX_HALF_TURN: f64 = 0.75;

/// An arc over an apex with the nodes at its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct ApexArc {
    /// The arc, alone in its cell.
    pub cell: Cell,
    /// Its ends, with its tangents.
    pub nodes: [Node; 2],
}

/// Where an arc may reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// Parameters that it must not reach.
    pub limits: [f64; 2],
    /// The distance from the apex that it may reach at most.
    pub most: f64,
}

/// The arc over the apex at parameter `u`, if there is room for one.
pub(super) fn apex_arc(track: &Track, u: f64, room: &Room, tolerance: f64) -> Option<ApexArc> {
    let apex = track.cut_node(u, Side::After);
    let most = (MAX_HALF_TURN / apex.curvature.abs()).min(room.most);
    let ends = |reach: f64| room.limits.map(|limit| track.node(track.beyond_distance(&apex, reach, limit)));
    let mut reach = most;
    for _ in 0..GUESSES {
        let change: f64 = ends(reach).iter().map(|n| 0.5 * (n.curvature - apex.curvature).abs()).sum();
        let error = FLATNESS * change * reach * reach / tolerance;
        if error <= 1.0 && reach == most {
            break;
        }
        reach = (reach * error.powf(-0.25)).min(most);
    }
    let mut good = None;
    let mut lift = 0.0;
    for _ in 0..MAX_CORRECTIONS {
        if !(reach > track.noise() && reach.is_finite()) {
            break;
        }
        let nodes = ends(reach);
        let arc = over(&nodes, &apex, lift);
        let [above, below] = track.sides(&arc, nodes[0].u, nodes[1].u);
        let error = above.max(below) / tolerance;
        if error <= 1.0 {
            good = Some((arc, nodes));
            if error >= 1.0 - WINDOW || reach >= most {
                break;
            }
        }
        if !error.is_finite() {
            (reach, lift) = (0.5 * reach, 0.0);
            continue;
        }
        let balanced = 0.5 * (above + below) / tolerance;
        let factor = ((1.0 - 0.5 * WINDOW) / balanced).powf(0.25).clamp(0.5, 2.0).min(most / reach);
        lift = (lift + (below - above) / (1.0 + AT_SIDES)) * factor.powi(4);
        reach *= factor;
    }
    let (arc, nodes) = good?;
    let cell = Cell::of_one(track, arc, [nodes[0].u, nodes[1].u], 0.0);
    let [a, b] = nodes;
    let nodes = [Node { tangent: arc.start_tangent(), ..a }, Node { tangent: arc.end_tangent(), ..b }];
    (cell.distance != Distance::UNKNOWN && cell.distance.bound <= tolerance)
        .then_some(ApexArc { cell, nodes })
}

/// The arc between two nodes that passes the apex at a distance, which makes all errors larger.
fn over([a, b]: &[Node; 2], apex: &Node, lift: f64) -> Arc {
    let (v, w) = (apex.place - a.place, b.place - apex.place);
    let chord = (b.place - a.place).length();
    let through = v.cross(w) / (v.length() * w.length() + v.dot(w));
    Arc { start: a.place, end: b.place, bulge: through + 2.0 * lift / chord }
}
