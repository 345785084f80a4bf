//! How chains of arcs change with their parameters.
//!
//! **Guarantees** the derivatives of the arcs of a chain, but for the round-off of stored knots. **Method.** A place
//! with a tangent that moves by `dP` and turns by `dt` takes the arc that leaves it to an end along: for a chord
//! `c` its curvature is `2 T x c / c^2`, and it arrives turned by twice the turn of the chord less `dt`. So
//! changes go from arc to arc. The joint of the biarc that comes last lies by both its tangents and its chord.

use super::chain::{Chain, End, Joined, Links, MOST_ARCS};
use super::squares::{MOST_PARAMETERS, Parameters};
use crate::geom::Vector;

/// How the distance of places to the left of an arc changes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Change {
    /// How far the arc moves to its left where it begins.
    aside: f64,
    /// How much it turns to the right there, beyond what moving along it takes.
    turn: f64,
    /// Half of the change of its curvature.
    bend: f64,
}

/// Changes of each arc with each parameter.
pub(super) type Changes = [[Change; MOST_PARAMETERS]; MOST_ARCS];

/// How a place with a tangent moves.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    place: Vector,
    /// To the left.
    turn: f64,
}

/// Where a place is, seen from the start of an arc: what changes of the arc are multiplied by.
pub(super) struct Seen([f64; 3]);

impl Seen {
    /// A place seen from an arc.
    pub fn from(joined: &Joined, p: Vector) -> Seen {
        let w = p - joined.place;
        let left = w.dot(joined.tangent.left());
        Seen([joined.curvature * left - 1.0, w.dot(joined.tangent), -w.length_squared()])
    }

    /// The change of its distance to the left.
    pub fn change(&self, by: &Change) -> f64 {
        self.0[0] * by.aside + self.0[1] * by.turn + self.0[2] * by.bend
    }
}

impl Motion {
    /// The change of an arc that begins here and has some chord, with the motion of its end; that moves from place
    /// to place, and tangents follow.
    fn leaving(&self, from: &Joined, chord: Vector, end: Vector) -> (Change, Motion) {
        let (step, part) = (end - self.place, chord.length_squared().recip());
        let bend =
            from.tangent.cross(step) - from.tangent.dot(chord) * self.turn - from.curvature * chord.dot(step);
        let aside = self.place.dot(from.tangent.left());
        let turn = from.curvature * self.place.dot(from.tangent) - self.turn;
        let change = Change { aside, turn, bend: bend * part };
        (change, Motion { place: end, turn: 2.0 * chord.cross(step) * part - self.turn })
    }

    /// The motion of an end that slides along its circle by the unit of lengths.
    fn sliding(end: &End, at: &Joined, length: f64) -> Motion {
        Motion { place: at.tangent * length, turn: end.joined.curvature * length }
    }
}

impl Links<'_, '_> {
    /// How the arcs of a chain change with each of its parameters.
    pub fn changes(&self, parameters: &Parameters, chain: &Chain) -> Changes {
        let n = self.arcs;
        let (mut changes, mut used) = (Changes::default(), 0);
        let (mut at, mut last) = ([Motion::default(); MOST_PARAMETERS], Motion::default());
        if self.ends[0].slides {
            at[0] = Motion::sliding(&self.ends[0], &chain.joints[0], self.length);
            used = 1;
        }
        if n == 1 {
            changes[0][0] = self.touching_change(&at[0], chain);
            return changes;
        }
        let slide = self.ends[1].slides.then_some(used);
        if slide.is_some() {
            last = Motion::sliding(&self.ends[1], &chain.joints[n], -self.length);
            used += 1;
        }
        for (i, changes) in changes[..n - 2].iter_mut().enumerate() {
            let moves = self.moves(i + 1, parameters[used]);
            let (from, arc) = (&chain.joints[i], &chain.arcs[i]);
            for (j, at) in at[..used + 2].iter_mut().enumerate() {
                let end = if j < used { Vector::default() } else { moves[j - used] };
                (changes[j], *at) = at.leaving(from, arc.end - arc.start, end);
            }
            used += 2;
        }
        let joint = Divided::of(chain, n, parameters[used]);
        let (first, second) = (&chain.arcs[n - 2], &chain.arcs[n - 1]);
        for (j, at) in at[..=used].iter().enumerate() {
            let end = if slide == Some(j) { last } else { Motion::default() };
            let middle = joint.moves([at, &end], if j == used { 1.0 } else { 0.0 });
            let (change, at) = at.leaving(&chain.joints[n - 2], first.end - first.start, middle);
            changes[n - 2][j] = change;
            (changes[n - 1][j], _) = at.leaving(&chain.joints[n - 1], second.end - second.start, end.place);
        }
        changes
    }

    /// The change of the arc that touches the circle at the other end.
    fn touching_change(&self, at: &Motion, chain: &Chain) -> Change {
        let (from, circle) = (&chain.joints[0], &self.ends[1].joined);
        let (w, n, m) = (from.place - circle.place, from.tangent.left(), circle.tangent.left());
        let power = w.dot(m) - 0.5 * circle.curvature * w.length_squared();
        // As the left normal turns, it moves against the tangent.
        let turned = -from.tangent * at.turn;
        let above = circle.curvature * (at.place.dot(n) + w.dot(turned)) - (m - n).dot(turned);
        let below = at.place.dot(m) - circle.curvature * w.dot(at.place);
        let bend = 0.5 * (above - from.curvature * below) / power;
        Change { aside: at.place.dot(n), turn: from.curvature * at.place.dot(from.tangent) - at.turn, bend }
    }
}

/// Where the joint of a biarc lies, as [`super::biarc`] says for shifted ones: at `P + (c + h left(c)) l`, where `h` and
/// `l` depend on the shift and on the tangent of a quarter of the turn.
struct Divided {
    chord: Vector,
    /// `h` and `l`, and their derivatives by that tangent and by the shift.
    rise: [f64; 3],
    part: [f64; 3],
    /// Derivative of that tangent by the turn to the right.
    quarter: f64,
}

impl Divided {
    /// The last biarc of a chain of `n` arcs.
    fn of(chain: &Chain, n: usize, shift: f64) -> Divided {
        let (a, b) = (&chain.joints[n - 2], &chain.joints[n]);
        let (cross, dot) = (b.tangent.cross(a.tangent), b.tangent.dot(a.tangent));
        let half = cross / (1.0 + dot);
        let q = half / (1.0 + (1.0 + half * half).sqrt());
        let (square, other) = (q * q, 1.0 - shift);
        let up = 1.0 + square * shift;
        let h = q * other / up;
        let rise = [h, (other - 2.0 * h * q * shift) / up, -(q + h * square) / up];
        let sum = 2.0 + 2.0 * square * shift * shift;
        let l = (1.0 + shift) * up / sum;
        let by_tangent = 2.0 * q * shift * (1.0 + shift - 2.0 * l * shift) / sum;
        let by_shift = (up + (1.0 + shift) * square - 4.0 * l * square * shift) / sum;
        let quarter = 0.25 * (1.0 + square);
        Divided { chord: b.place - a.place, rise, part: [l, by_tangent, by_shift], quarter }
    }

    /// The motion of the joint by those of the ends and of the shift.
    fn moves(&self, [a, b]: [&Motion; 2], shift: f64) -> Vector {
        let (step, q) = (b.place - a.place, self.quarter * (a.turn - b.turn));
        let ([h, h_q, h_s], [l, l_q, l_s]) = (self.rise, self.part);
        let (rise, part) = (h_q * q + h_s * shift, l_q * q + l_s * shift);
        let left = self.chord.left();
        a.place + (step + step.left() * h + left * rise) * l + (self.chord + left * h) * part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::boundary::freeform::density::Density;
    use crate::boundary::freeform::layout::Ends;
    use crate::boundary::freeform::track::{Side, Track};
    use crate::geom::{point, vector};

    #[test]
    fn changes_are_limits_of_differences() {
        const STEP: f64 = 1.0 / 65536.0;
        let quarter = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.2, 1.3).unwrap();
        let pieces = quarter.pieces().unwrap();
        let track = Track::new(&pieces);
        let mut ends = Ends::of([track.cut_node(0.0, Side::After), track.cut_node(1.0, Side::Before)]);
        let mut density = Density::default();
        density.fill(&track, (&ends.nodes, 1.0), |jet| jet.d1.length());
        for (arcs, circles) in (1..=MOST_ARCS).flat_map(|arcs| [(arcs, [true; 2]), (arcs, [true, false])]) {
            let curvatures = [1.01 * ends.nodes[0].curvature, 0.99 * ends.nodes[1].curvature];
            ends.circles = [0, 1].map(|i| circles[i].then_some(curvatures[i]));
            let links = Links::new(&track, (&ends, &density), (arcs, 1e-3));
            let parameters = std::array::from_fn(|i| 0.05 - 0.02 * i as f64);
            let chain = links.chain(&parameters).unwrap();
            let changes = links.changes(&parameters, &chain);
            for j in 0..links.parameters() {
                let moved = [STEP, -STEP].map(|step| {
                    let mut other = parameters;
                    other[j] += step;
                    links.chain(&other).unwrap()
                });
                for (i, changes) in changes[..arcs].iter().enumerate() {
                    let p = track.place((i as f64 + 0.5) / arcs as f64);
                    let [up, down] = moved.map(|chain| chain.joints[i].left_of(p));
                    let change = Seen::from(&chain.joints[i], p).change(&changes[j]);
                    let off = (up - down) / (2.0 * STEP) - change;
                    assert!(off.abs() < 1e-7, "{arcs} arcs, {j} to {i}: {change:e}, off by {off:e}");
                }
            }
        }
    }
}
