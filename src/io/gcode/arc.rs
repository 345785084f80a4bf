//! An arc between rounded ends.

use crate::geom::{Element, Vector, vector};
use std::f64::consts::PI;

/// How an arc is written. Lengths are whole steps of the last decimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fit {
    /// Not at all: its rounded ends coincide.
    Nothing,
    /// As a line: it leaves its chord by less than half a step.
    Line,
    /// With the center at this offset from its start.
    Center([i64; 2]),
    /// With this radius.
    Radius(i64),
    /// In two halves.
    Halves,
}

/// Farthest that a written arc may leave its chord and be written as a line, in steps.
const STRAIGHT: f64 = 0.5;

/// Largest difference of the swept angle from that of the drawn arc, in radians. Rounding of the
/// center turns a tiny arc by more, or over to the other side of its chord.
const SWEEP_ERROR: f64 = 0.25 * PI;

/// Largest sweep of an arc that is written with its radius; near half a circle the center would
/// hang on the last digit of the radius.
const RADIUS_SWEEP: f64 = 2.0 * PI / 3.0;

/// Largest offset that is a whole number in `f64`.
const EXACT: f64 = (1u64 << 53) as f64;

/// Center of the arc of the same sweep as `drawn` between two rounded places, if the radii at the
/// two agree to `radius_error` steps.
pub(super) fn with_center(drawn: &Element, start: [i64; 2], end: [i64; 2], radius_error: f64) -> Fit {
    let chord = match chord(drawn.bulge, start, end) {
        Ok(chord) => chord,
        Err(fit) => return fit,
    };
    let b = drawn.bulge;
    let center = chord * 0.5 + chord.left() * ((1.0 - b * b) / (4.0 * b));
    let center = vector(center.x.round(), center.y.round());
    if center.x.abs().max(center.y.abs()) > EXACT {
        return Fit::Halves;
    }
    let (from, to) = (-center, chord - center);
    let turn = from.angle_to(to);
    let sweep = if b > 0.0 { turn.rem_euclid(2.0 * PI) } else { -(-turn).rem_euclid(2.0 * PI) };
    if (from.length() - to.length()).abs() > radius_error || (sweep - drawn.sweep()).abs() > SWEEP_ERROR {
        return Fit::Halves;
    }
    Fit::Center([center.x as i64, center.y as i64])
}

/// Radius of the arc of the same sweep as `drawn` between two rounded places.
pub(super) fn with_radius(drawn: &Element, start: [i64; 2], end: [i64; 2]) -> Fit {
    let chord = match chord(drawn.bulge, start, end) {
        Ok(chord) => chord.length(),
        Err(fit) => return fit,
    };
    let b = drawn.bulge.abs();
    let radius = (chord * (1.0 + b * b) / (4.0 * b)).max(0.5 * chord).round();
    if drawn.sweep().abs() > RADIUS_SWEEP || radius > EXACT || 2.0 * radius <= chord {
        return Fit::Halves;
    }
    Fit::Radius(radius as i64)
}

/// Whether the chord between two rounded places is as good as an arc about a center, for sure, told without its
/// angle: `|bulge| = tan(sweep / 4)`, and a quarter of the tangent of an acute angle is more than that.
pub(super) fn surely_straight([from, to]: [Vector; 2], start: [i64; 2], end: [i64; 2]) -> bool {
    /// Of what is straight, a part that leaves room for round-off.
    const SURELY: f64 = 0.9 * STRAIGHT;
    let (cross, dot) = (from.cross(to).abs(), from.dot(to));
    let chord = vector((end[0] - start[0]) as f64, (end[1] - start[1]) as f64);
    dot > 0.0 && 0.125 * cross * chord.length() < SURELY * dot
}

/// From one rounded end to the other, in steps, or how the arc is written if it has no shape.
fn chord(bulge: f64, start: [i64; 2], end: [i64; 2]) -> Result<Vector, Fit> {
    if start == end {
        return Err(Fit::Nothing);
    }
    let chord = vector((end[0] - start[0]) as f64, (end[1] - start[1]) as f64);
    if 0.5 * bulge.abs() * chord.length() < STRAIGHT { Err(Fit::Line) } else { Ok(chord) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn arc(x: f64, y: f64, bulge: f64) -> Element {
        Element::arc(point(0.0, 0.0), point(x, y), bulge)
    }

    #[test]
    fn a_half_circle_has_its_center_in_the_middle() {
        assert_eq!(with_center(&arc(2.0, 0.0, 1.0), [0, 0], [20000, 0], 20.0), Fit::Center([10000, 0]));
        assert_eq!(with_radius(&arc(2.0, 0.0, 1.0), [0, 0], [20000, 0]), Fit::Halves);
    }

    #[test]
    fn an_arc_whose_ends_round_to_one_place_vanishes() {
        assert_eq!(with_center(&arc(4e-5, 0.0, 0.5), [7, 7], [7, 7], 20.0), Fit::Nothing);
        assert_eq!(with_center(&arc(1e-4, 0.0, 0.5), [7, 7], [8, 7], 20.0), Fit::Line);
    }

    #[test]
    fn coarse_rounding_halves_arcs_until_their_radii_agree() {
        let whole = with_center(&arc(1.01, 0.53, 0.9), [0, 0], [101, 53], 0.2);
        assert_eq!(whole, Fit::Halves);
    }
}
