//! One arc over an apex.
//!
//! **Guarantees** an arc within the tolerance of the curve around an apex, as far to both sides as it
//! may reach, nearly. Being the extremum itself, it costs the curve no apex.
//!
//! **Method.** Its ends lie on the curve; their distances from the apex and its bulge make the errors
//! before, at and behind the apex equal. Such an arc spares more than another: with curvature `k - c s^2 / 2` it errs
//! by `c L^4 / 140` for ends at `s = L` and `-L`, where the least number of any arcs within that error
//! would be 1.35, and with `k - c |s|` by `c L^3 / 61`, for 1.37. In both cases that is the change of
//! the curvature times `L^2 / 65`, about, which makes a first guess.

use super::biarc::{Arc, Node};
use super::spiral::Cell;
use super::track::{Side, Track};

/// Error over change of curvature times squared reach.
const FLATNESS: f64 = 1.0 / 65.0;

/// Steps of the guess, and corrections of the arc.
const GUESSES: usize = 6;
const MAX_CORRECTIONS: usize = 16;

/// A guess of the error so near to the tolerance is good enough.
const NEARLY: f64 = 0.5;

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
    shape: Shape,
    tolerance: f64,
}

impl ApexArc {
    /// The arc between biarcs before and behind it, which may have moved its ends along its circle; parameters
    /// behind it go on from those before by some turn.
    pub fn between(&self, track: &Track, before: &Cell, (after, turn): (&Cell, f64)) -> Cell {
        let (Some((last, ..)), Some((next, ..))) = (before.spans().last(), after.spans().next()) else {
            return self.cell;
        };
        if last.end == self.nodes[0].place && next.start == self.nodes[1].place {
            return self.cell;
        }
        let angle = last.end_tangent().angle_to(next.start_tangent());
        let arc = Arc { start: last.end, end: next.start, bulge: (0.25 * angle).tan() };
        Cell::proven(track, arc, [before.to, after.from + turn], self.tolerance)
    }
}

/// What makes an arc over an apex.
#[derive(Clone, Copy, Debug)]
struct Shape {
    /// The distances of its ends from the apex.
    reach: [f64; 2],
    /// How far the apex is to the left of it, about.
    lift: f64,
}

/// Where an arc may reach.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// Parameters that it must not reach.
    pub limits: [f64; 2],
    /// The distances from the apex that it may reach at most.
    pub most: [f64; 2],
}

/// The arc over the apex at parameter `u`, if there is room for one. Another one over it, within so many
/// times the tolerance of this one, tells where to begin.
pub(super) fn apex_arc(
    track: &Track,
    u: f64,
    room: &Room,
    tolerance: f64,
    other: Option<(&ApexArc, f64)>,
) -> Option<ApexArc> {
    let apex = track.cut_node(u, Side::After);
    let most = room.most.map(|most| most.min(MAX_HALF_TURN / apex.curvature.abs()));
    let mut near = room.limits;
    let mut end = |side: usize, reach: f64| {
        let node = track.node(track.beyond_distance(&apex, reach, (near[side], room.limits[side])));
        near[side] = node.u;
        node
    };
    let first = match other {
        Some((other, times)) => {
            let shorter = times.powf(-0.25);
            let reach = [0, 1].map(|i| (other.shape.reach[i] * shorter).min(most[i]));
            Shape { reach, lift: other.shape.lift / times }
        }
        None => {
            let reach = [0, 1].map(|side| guess(|reach| end(side, reach), &apex, most[side], tolerance));
            Shape { reach, lift: 0.0 }
        }
    };
    let ends = |reach: [f64; 2]| [0, 1].map(|side| end(side, reach[side]));
    let (arc, [a, b], shape) = corrected(track, &apex, (most, tolerance), first, ends)?;
    let cell = Cell::proven(track, arc, [a.u, b.u], tolerance);
    let nodes = [Node { tangent: arc.start_tangent(), ..a }, Node { tangent: arc.end_tangent(), ..b }];
    (cell.distance.bound <= tolerance).then_some(ApexArc { cell, nodes, shape, tolerance })
}

/// The widest arc within the tolerance that comes out when its shape is corrected by its errors.
fn corrected(
    track: &Track,
    apex: &Node,
    (most, tolerance): ([f64; 2], f64),
    mut shape: Shape,
    mut ends: impl FnMut([f64; 2]) -> [Node; 2],
) -> Option<(Arc, [Node; 2], Shape)> {
    let (mut good, mut widest) = (None, 0.0);
    for _ in 0..MAX_CORRECTIONS {
        let Shape { reach, lift } = shape;
        if !reach.iter().all(|&r| r > track.noise() && r.is_finite()) {
            break;
        }
        let nodes = ends(reach);
        let arc = over(&nodes, apex, lift);
        let errors = Errors::of(track, &arc, &nodes, apex, tolerance);
        if errors.largest() <= 1.0 {
            if reach[0] + reach[1] > widest {
                (good, widest) = (Some((arc, nodes, shape)), reach[0] + reach[1]);
            }
            if [0, 1].iter().all(|&i| errors.sides[i] >= 1.0 - WINDOW || reach[i] >= most[i]) {
                break;
            }
        }
        if !errors.largest().is_finite() {
            shape = Shape { reach: reach.map(|r| 0.5 * r), lift: 0.0 };
            continue;
        }
        let wanted = [0, 1].map(|i| {
            let balanced = 0.5 * (errors.sides[i] + errors.middle);
            let factor = ((1.0 - 0.5 * WINDOW) / balanced).powf(0.25).clamp(0.5, 2.0);
            (reach[i] * factor).min(most[i])
        });
        let both = 0.5 * (wanted[0] / reach[0] + wanted[1] / reach[1]);
        let lift = (lift + errors.raised() * tolerance) * both * both * both * both;
        shape = Shape { reach: wanted, lift };
    }
    good
}

/// How far an arc on one side may reach, by the change of the curvature.
fn guess(mut end: impl FnMut(f64) -> Node, apex: &Node, most: f64, tolerance: f64) -> f64 {
    let mut reach = most;
    for _ in 0..GUESSES {
        let change = (end(reach).curvature - apex.curvature).abs();
        let error = FLATNESS * change * reach * reach / tolerance;
        if error <= 1.0 && reach == most {
            break;
        }
        reach = (reach * error.powf(-0.25)).min(most);
        if (NEARLY..NEARLY.recip()).contains(&error) {
            break;
        }
    }
    reach
}

/// Errors of an arc over an apex, in tolerances.
#[derive(Clone, Copy, Debug)]
struct Errors {
    /// About the apex.
    middle: f64,
    /// Before it and behind it, on the other side of the arc.
    sides: [f64; 2],
    /// Whether the middle is to the left of the arc.
    left: bool,
}

impl Errors {
    fn of(track: &Track, arc: &Arc, [a, b]: &[Node; 2], apex: &Node, tolerance: f64) -> Errors {
        let halves = [(a.u, apex.u), (apex.u, b.u)].map(|(from, to)| track.sides(arc, from, to));
        let left = a.curvature + b.curvature > 2.0 * apex.curvature;
        let of = |half: [f64; 2], left: bool| half[usize::from(!left)] / tolerance;
        let middle = of(halves[0], left).max(of(halves[1], left));
        Errors { middle, sides: halves.map(|half| of(half, !left)), left }
    }

    fn largest(&self) -> f64 {
        self.middle.max(self.sides[0]).max(self.sides[1])
    }

    /// How far the middle of the arc must rise so that errors in the middle and at the sides are equal.
    fn raised(&self) -> f64 {
        let more = self.middle - self.sides[0].max(self.sides[1]);
        if self.left { -more / (1.0 + AT_SIDES) } else { more / (1.0 + AT_SIDES) }
    }
}

/// The arc between two nodes that passes the apex at a distance, which makes all errors larger.
fn over([a, b]: &[Node; 2], apex: &Node, lift: f64) -> Arc {
    let (v, w) = (apex.place - a.place, b.place - apex.place);
    let chord = (b.place - a.place).length();
    let through = v.cross(w) / (v.length() * w.length() + v.dot(w));
    Arc { start: a.place, end: b.place, bulge: through + 2.0 * lift / chord }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::geom::{point, vector};

    #[test]
    fn an_arc_over_an_apex_errs_by_the_tolerance_and_its_bound_is_near() {
        let ellipse = EllipseArc::new(point(0.0, 0.0), vector(20.0, 0.0), 0.5, 0.0, 0.0).unwrap();
        let pieces = ellipse.pieces().unwrap();
        let track = Track::new(&pieces);
        for u in [1.0, 2.0] {
            for tolerance in [1e-4, 1e-6, 1e-8] {
                let room = Room { limits: [u - 0.9, u + 0.9], most: [5.0; 2] };
                let found = apex_arc(&track, u, &room, tolerance, None).unwrap();
                let (from, to) = (found.nodes[0].u, found.nodes[1].u);
                let place = |i: i32| track.place(from + (to - from) * f64::from(i) / 1000.0);
                let far = (0..=1000).map(|i| found.cell.arcs[0].distance(place(i))).fold(0.0, f64::max);
                let bound = found.cell.distance.bound;
                assert!(far <= bound && bound <= tolerance, "{tolerance:e}: {far:e}, {bound:e}");
                assert!(bound <= 1.2 * far && far >= 0.9 * tolerance, "{tolerance:e}: {far:e}, {bound:e}");
                // Within less it is shorter, and the one before tells where to begin.
                let less = apex_arc(&track, u, &room, 0.5 * tolerance, Some((&found, 2.0))).unwrap();
                assert!((less.shape.reach[0] / found.shape.reach[0] - 0.5f64.powf(0.25)).abs() < 0.02);
            }
        }
    }
}
