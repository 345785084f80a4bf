//! Places, tangents and distances along a curve of many pieces.

use super::biarc::{Arc, Grid, Node};
use super::bound::{Distance, Frame};
use super::cuts::{first_leg, last_leg};
use super::piece::Piece;
use super::pieces::Pieces;
use crate::geom::Vector;

/// A curve with the grid that its nodes are stored on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track<'a> {
    pieces: &'a [Piece],
    /// Where nodes are stored.
    pub grid: Grid,
    noise: f64,
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

impl<'a> Track<'a> {
    /// The track of some pieces.
    pub fn new(curve: &'a Pieces) -> Track<'a> {
        Track { pieces: &curve.pieces, grid: Grid { origin: curve.origin }, noise: curve.noise }
    }

    /// Round-off of a place.
    pub fn noise(&self) -> f64 {
        self.noise
    }

    /// The piece that holds a parameter, and the parameter in it.
    pub fn locate(&self, u: f64, side: Side) -> (&'a Piece, f64) {
        let whole = if side == Side::Before { u.ceil() - 1.0 } else { u.floor() };
        let whole = whole.max(0.0);
        (&self.pieces[whole as usize % self.pieces.len()], u - whole)
    }

    /// Piece `i`, counted on around a closed curve.
    pub fn piece(&self, i: usize) -> &'a Piece {
        &self.pieces[i % self.pieces.len()]
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
        let leg = match side {
            Side::Before => last_leg(&piece.part(0.0, t), self.noise),
            Side::After => first_leg(&piece.part(t, 1.0), self.noise),
        };
        let jet = piece.jet(t);
        let tangent = leg.unwrap_or(jet.d1).unit();
        Node { u, place: self.grid.snap(place), tangent, curvature: jet.curvature() }
    }

    /// Distance between arcs and the parts of the curve they stand for, and the parameter between.
    pub fn measure(&self, arcs: &[Arc; 2], from: f64, to: f64) -> (Distance, f64) {
        let joint = self.beyond(arcs[0].end, arcs[0].end_tangent(), from, to);
        let mut distance = self.measure_arc(&arcs[0], from, joint);
        if distance.bound.is_finite() {
            distance = distance.max(self.measure_arc(&arcs[1], joint, to));
        }
        (distance, joint)
    }

    /// Distance between an arc and the curve between two parameters.
    pub fn measure_arc(&self, arc: &Arc, from: f64, to: f64) -> Distance {
        if arc.start == arc.end {
            return Distance::UNKNOWN;
        }
        let frame = Frame::of(arc);
        let mut distance = Distance::ZERO;
        let mut whole = from.floor();
        while whole < to {
            let (a, b) = ((from - whole).max(0.0), (to - whole).min(1.0));
            if a < b {
                let part = self.piece(whole as usize).part(a, b);
                distance = distance.max(frame.measure(&part));
                if distance.bound.is_infinite() {
                    break;
                }
            }
            whole += 1.0;
        }
        distance
    }

    /// The parameter between two others where the curve crosses the normal at a joint.
    fn beyond(&self, joint: Vector, tangent: Vector, from: f64, to: f64) -> f64 {
        let ahead = |u: f64| {
            let (piece, t) = self.locate(u, Side::Before);
            (piece.at(t) - joint).dot(tangent)
        };
        let mut whole = from.floor();
        while whole + 1.0 < to && ahead(whole + 1.0) < 0.0 {
            whole += 1.0;
        }
        let piece = self.piece(whole as usize);
        let (mut low, mut high) = ((from - whole).max(0.0), (to - whole).min(1.0));
        let mut t = 0.5 * (low + high);
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
