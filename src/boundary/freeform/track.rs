//! Places, tangents and distances along a curve of many pieces.

use super::biarc::{Arc, Grid, Node};
use super::bound::{Distance, Frame};
use super::cuts::{first_leg, last_leg};
use super::piece::Piece;
use super::pieces::Pieces;
use super::short;
use crate::geom::Vector;

/// A curve with the grid that its nodes are stored on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track<'a> {
    pieces: &'a [Piece],
    /// Where nodes are stored.
    pub grid: Grid,
    noise: f64,
    extent: f64,
    /// Whether distances are estimated by samples.
    sampled: bool,
}

/// Which side of a parameter counts where pieces meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// What ends there.
    Before,
    /// What begins there.
    After,
}

/// Steps of the search for the place beyond a joint; Newton's method takes three or four, bisection
/// takes over when it fails.
const MAX_STEPS: usize = 80;

/// A derivative by so many times the round-off of places tells a direction: what control points and weights of
/// different orders leave of that is more than one leg.
const LEAST_LEG: f64 = 1_048_576.0;

/// A jump of the derivative of the curvature by this part of it matters to a biarc over it.
const KINK: f64 = 1.0 / 64.0;

impl<'a> Track<'a> {
    /// The track of some pieces.
    pub fn new(curve: &'a Pieces) -> Track<'a> {
        Track {
            pieces: &curve.pieces,
            grid: Grid { origin: curve.origin },
            noise: curve.noise,
            extent: curve.extent,
            sampled: false,
        }
    }

    /// The same with distances estimated by samples, not proven.
    pub fn sampled(self) -> Track<'a> {
        Track { sampled: true, ..self }
    }

    /// Round-off of a place.
    pub fn noise(&self) -> f64 {
        self.noise
    }

    /// The piece that holds a parameter, and the parameter in it.
    pub fn locate(&self, u: f64, side: Side) -> (&'a Piece, f64) {
        let below = u as usize;
        let at_end = side == Side::Before && below > 0 && below as f64 == u;
        let whole = if at_end { below - 1 } else { below };
        (self.piece(whole), u - whole as f64)
    }

    /// Piece `i`, counted on around a closed curve.
    pub fn piece(&self, i: usize) -> &'a Piece {
        // A division takes longer than all that a piece is asked for.
        let n = self.pieces.len();
        &self.pieces[if i < n { i } else { i % n }]
    }

    /// The node on the curve at a cut, with the one-sided tangent.
    pub fn cut_node(&self, u: f64, side: Side) -> Node {
        let (piece, t) = self.locate(u, side);
        let mut place = piece.at(t);
        if t == 0.0 {
            place = piece.start();
        } else if t == 1.0 {
            place = piece.end();
        }
        let jet = piece.jet(t);
        let tangent = self.tangent(piece, (t, side), jet.d1).unit();
        Node { u, place: self.grid.snap(place), tangent, curvature: jet.curvature() }
    }

    /// The one-sided direction at a parameter of a piece: that of the derivative, unless there is next to none.
    fn tangent(&self, piece: &Piece, (t, side): (f64, Side), d1: Vector) -> Vector {
        let way = if side == Side::Before { t } else { 1.0 - t };
        if way * d1.length() > LEAST_LEG * self.noise {
            return d1;
        }
        let leg = match side {
            Side::Before => last_leg(&piece.part(0.0, t), self.noise),
            Side::After => first_leg(&piece.part(t, 1.0), self.noise),
        };
        leg.unwrap_or(d1)
    }

    /// Whether the derivative of the curvature jumps where two pieces meet, other than by round-off or a
    /// little.
    pub fn has_kink(&self, knot: f64) -> bool {
        let slopes = [Side::Before, Side::After].map(|side| {
            let (piece, t) = self.locate(knot, side);
            piece.jet(t).curvature_slope()
        });
        (slopes[0] - slopes[1]).abs() > KINK * (slopes[0].abs() + slopes[1].abs())
    }

    /// The place at a parameter.
    pub fn place(&self, u: f64) -> Vector {
        let (piece, t) = self.locate(u, Side::Before);
        piece.at(t)
    }

    /// The node on the curve at a parameter that is no cut.
    pub fn node(&self, u: f64) -> Node {
        let (piece, t) = self.locate(u, Side::Before);
        let jet = piece.jet(t);
        Node { u, place: self.grid.snap(jet.q), tangent: jet.d1.unit(), curvature: jet.curvature() }
    }

    /// A distance from a place that the curve between two parameters does not exceed.
    pub fn reach(&self, place: Vector, from: f64, to: f64) -> f64 {
        let far = |r: f64, part: Piece| part.points().iter().fold(r, |r, &p| r.max((p - place).length()));
        self.parts(from, to).fold(0.0, far)
    }

    /// How far the curve between two parameters, which is straight, runs beyond the ends of a segment for
    /// it, but for less than `small`.
    pub fn overrun(&self, segment: &Arc, from: f64, to: f64, small: f64) -> f64 {
        let along = (segment.end - segment.start).unit();
        let ends = (segment.start.dot(along), segment.end.dot(along));
        self.parts(from, to).map(|part| beyond(&part, along, ends, (small, MAX_HALVINGS))).fold(0.0, f64::max)
    }

    /// Length of the diagonal of the box around all control points.
    pub fn extent(&self) -> f64 {
        self.extent
    }

    /// The first parameter from a node towards `limit` at a distance; `limit` if there is none. A
    /// parameter that may be near it, and no other is nearer to, saves the search.
    pub fn beyond_distance(&self, from: &Node, distance: f64, (near, limit): (f64, f64)) -> f64 {
        if near != limit
            && let Some(u) = self.near_distance(from, distance, near)
        {
            return u;
        }
        let forward = limit > from.u;
        let sign = if forward { 1.0 } else { -1.0 };
        let mut u = from.u;
        loop {
            let side = if forward { Side::After } else { Side::Before };
            let (piece, t) = self.locate(u, side);
            let whole = u - t;
            let last = if forward { (limit - whole).min(1.0) } else { (limit - whole).max(0.0) };
            if let Some(t) = crossing(piece, (t, last), from.place, distance) {
                return whole + t;
            }
            u = whole + last;
            if (limit - u) * sign <= 0.0 {
                return limit;
            }
        }
    }

    /// The parameter at a distance from a node by Newton's method alone, in the piece of one nearby.
    fn near_distance(&self, from: &Node, distance: f64, near: f64) -> Option<f64> {
        let (piece, mut t) = self.locate(near, if near > from.u { Side::Before } else { Side::After });
        let whole = near - t;
        for _ in 0..NEAR_STEPS {
            let (q, d1) = piece.motion(t);
            let w = q - from.place;
            let length = w.length();
            let step = (distance - length) * length / w.dot(d1);
            t += step;
            let (u, far) = (whole + t, (t - from.u + whole).abs());
            if !((0.0..=1.0).contains(&t) && (u - from.u) * (near - from.u) > 0.0) {
                return None;
            }
            if step.abs() <= NEAR_ENOUGH * far {
                return Some(u);
            }
        }
        None
    }

    /// Distance between arcs and the parts of the curve they stand for, and the parameter between,
    /// which is near the one in the middle of those given.
    pub fn measure(&self, arcs: &[Arc; 2], [from, near, to]: [f64; 3], limit: f64) -> (Distance, f64) {
        let joint = self.beyond(arcs[0].end, arcs[0].end_tangent(), [from, near, to]);
        let mut distance = self.measure_arc(&arcs[0], from, joint, limit);
        if distance.bound.is_finite() {
            distance = distance.max(self.measure_arc(&arcs[1], joint, to, limit));
        }
        (distance, joint)
    }

    /// Distance between an arc and the curve between two parameters; see [`Frame::measure`].
    pub fn measure_arc(&self, arc: &Arc, from: f64, to: f64, limit: f64) -> Distance {
        self.measure_by(arc, (from, to), [limit, 0.0])
    }

    /// The same, but below the limit the distance found may be less than the largest by far.
    pub fn prove_arc(&self, arc: &Arc, from: f64, to: f64, limit: f64) -> Distance {
        self.measure_by(arc, (from, to), [limit, limit])
    }

    /// Distance by short proofs within the first limit, or else by division within the second.
    fn measure_by(&self, arc: &Arc, (from, to): (f64, f64), limits: [f64; 2]) -> Distance {
        if arc.start == arc.end {
            return Distance::UNKNOWN;
        }
        let frame = Frame::of(arc);
        let mut distance = Distance::ZERO;
        for (piece, range) in self.ranges(from, to) {
            let found = if self.sampled {
                frame.sample(&piece.part(range.0, range.1))
            } else {
                let found = short::measure(&frame, piece, range, limits[0]);
                found.unwrap_or_else(|| frame.measure(piece.part(range.0, range.1), limits[1]))
            };
            distance = distance.max(found);
            if distance.bound.is_infinite() {
                break;
            }
        }
        distance
    }

    /// How far the curve between two parameters is to the left and to the right of an arc.
    pub fn sides(&self, arc: &Arc, from: f64, to: f64) -> [f64; 2] {
        let frame = Frame::of(arc);
        self.ranges(from, to).fold([0.0f64; 2], |[left, right], (piece, range)| {
            let found = short::sides(&frame, piece, range);
            let [l, r] = found.unwrap_or_else(|| frame.sides(piece.part(range.0, range.1)));
            [left.max(l), right.max(r)]
        })
    }

    /// The parts of pieces between two parameters.
    fn parts(&self, from: f64, to: f64) -> impl Iterator<Item = Piece> {
        self.ranges(from, to).map(|(piece, (a, b))| piece.part(a, b))
    }

    /// Pieces between two parameters, and the parameters in them.
    fn ranges(&self, from: f64, to: f64) -> impl Iterator<Item = (&'a Piece, (f64, f64))> {
        let (mut i, track) = (from as usize, *self);
        std::iter::from_fn(move || {
            let whole = i as f64;
            let (a, b) = ((from - whole).max(0.0), (to - whole).min(1.0));
            i += 1;
            (a < b).then(|| (track.piece(i - 1), (a, b)))
        })
    }

    /// The parameter between two others where the curve crosses the normal at a joint.
    pub fn beyond(&self, joint: Vector, tangent: Vector, [from, near, to]: [f64; 3]) -> f64 {
        let ahead = |u: f64| {
            let (piece, t) = self.locate(u, Side::Before);
            (piece.at(t) - joint).dot(tangent)
        };
        let mut first = from as usize;
        while ((first + 1) as f64) < to && ahead((first + 1) as f64) < 0.0 {
            first += 1;
        }
        let (piece, whole) = (self.piece(first), first as f64);
        let (mut low, mut high) = ((from - whole).max(0.0), (to - whole).min(1.0));
        let near = near - whole;
        let mut t = if near > low && near < high { near } else { 0.5 * (low + high) };
        for _ in 0..MAX_STEPS {
            let (q, d1) = piece.motion(t);
            let value = (q - joint).dot(tangent);
            if value > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let next = t - value / d1.dot(tangent);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - t).abs() * d1.length() <= self.noise || next == t {
                return whole + next;
            }
            t = next;
        }
        whole + t
    }
}

/// Halvings of a straight part that may run beyond the ends of its segment.
const MAX_HALVINGS: u32 = 16;

/// How far places of a part are beyond two others along a line: 0 where that is less than `small`.
fn beyond(part: &Piece, along: Vector, ends: (f64, f64), (small, halvings): (f64, u32)) -> f64 {
    let past = |p: &Vector| (ends.0 - p.dot(along)).max(p.dot(along) - ends.1);
    let most = part.points().iter().map(past).fold(0.0, f64::max);
    if most <= small {
        return 0.0;
    }
    if halvings == 0 || past(&part.start()).max(past(&part.end())) > small {
        return most;
    }
    let halves = [(0.0, 0.5), (0.5, 1.0)].map(|(a, b)| part.part(a, b));
    halves.iter().map(|half| beyond(half, along, ends, (small, halvings - 1))).fold(0.0, f64::max)
}

/// Divisions of a piece, at least, in the search for a distance.
const LEAST_DIVISIONS: f64 = 8.0;

/// Where a piece, run from one parameter to another, is first at a distance from a place.
fn crossing(piece: &Piece, (from, to): (f64, f64), place: Vector, distance: f64) -> Option<f64> {
    let sign = if to > from { 1.0 } else { -1.0 };
    let (q, d1) = piece.motion(from);
    let missing = distance - (q - place).length();
    if missing <= 0.0 {
        return Some(from);
    }
    let mut stride = (missing / d1.length()).min(1.0 / LEAST_DIVISIONS);
    let (mut near, mut far) = (from, from);
    loop {
        if far == to {
            return None;
        }
        far = if (to - far) * sign <= stride { to } else { far + sign * stride };
        if (piece.at(far) - place).length() >= distance {
            break;
        }
        near = far;
        stride = (2.0 * stride).min(1.0 / LEAST_DIVISIONS);
    }
    Some(refined(piece, near, far, place, distance))
}

/// Where a piece is at a distance from a place: nearer at `near`, not at `far`.
fn refined(piece: &Piece, mut near: f64, mut far: f64, place: Vector, distance: f64) -> f64 {
    let mut t = far;
    for _ in 0..MAX_STEPS {
        let (q, d1) = piece.motion(t);
        let w = q - place;
        let length = w.length();
        if length >= distance {
            far = t;
        } else {
            near = t;
        }
        let step = (distance - length) * length / w.dot(d1);
        let next = t + step;
        let inside = (next - near) * (next - far) <= 0.0;
        let next = if inside { next } else { 0.5 * (near + far) };
        if (next - t).abs() <= f64::EPSILON || step.abs() <= CLOSE_ENOUGH * (far - near).abs() {
            return next;
        }
        t = next;
    }
    t
}

/// Steps of Newton's method from a parameter nearby, before the search begins anew.
const NEAR_STEPS: usize = 6;

/// A step of Newton's method so much shorter than the distance leaves 1e-14 of that, less than places there are
/// uncertain by.
const NEAR_ENOUGH: f64 = 1e-7;

/// A step of Newton's method so much shorter than the bracket squares to less than round-off.
const CLOSE_ENOUGH: f64 = 1e-9;
