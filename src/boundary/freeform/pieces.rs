//! The Bezier pieces of one curve, connected, with the round-off of its coordinates.

use super::error::CurveError;
use super::piece::Piece;
use crate::geom::{Bounds, Point, Vector};

/// Largest absolute coordinate, in job units: that of all drawings.
const COORDINATE_LIMIT: f64 = 1e10;

/// Roundings, in halves of an ulp of the largest coordinate, in a control point of a piece: those
/// of the drawn point, of the move to the origin, and three for each of up to ten levels of knot
/// insertion.
const POINT_ROUNDINGS: f64 = 32.0;

/// Connected pieces in coordinates relative to an origin.
#[derive(Clone, Debug)]
pub(super) struct Pieces {
    /// Where coordinates are relative to; exactly representable.
    pub origin: Point,
    /// Bound on the round-off of a control point, in job units.
    pub noise: f64,
    /// Diagonal of the box around the control points, in job units.
    pub extent: f64,
    /// The pieces; each begins where the one before ends, to the last bit.
    pub pieces: Vec<Piece>,
    /// Where the next piece must begin, pieces of no extent included.
    reached: Option<Vector>,
    /// Whether the last piece ends where the first begins.
    pub closed: bool,
}

/// Whether a place can be calculated with.
pub(super) fn is_usable(p: Point) -> bool {
    p.x.abs() <= COORDINATE_LIMIT && p.y.abs() <= COORDINATE_LIMIT
}

impl Pieces {
    /// No pieces yet, for a curve within a box.
    pub fn around(bounds: &Bounds) -> Pieces {
        let noise = 0.5 * f64::EPSILON * POINT_ROUNDINGS * bounds.magnitude();
        Pieces {
            reached: None,
            origin: bounds.center(),
            noise,
            extent: bounds.diagonal(),
            pieces: Vec::new(),
            closed: false,
        }
    }

    /// Appends a piece that begins where the last one ends, to round-off. A piece of no extent is
    /// left out.
    ///
    /// # Errors
    ///
    /// [`CurveError::Jump`] when it begins elsewhere.
    pub fn push(&mut self, piece: Piece) -> Result<(), CurveError> {
        let start = self.reached.unwrap_or(piece.start());
        self.reached = Some(start);
        let gap = (piece.start() - start).length();
        if gap > 2.0 * self.noise {
            return Err(CurveError::Jump { at: self.origin + start, gap });
        }
        if piece.points().iter().all(|&p| (p - start).length() <= 2.0 * self.noise) {
            return Ok(());
        }
        self.reached = Some(piece.end());
        self.pieces.push(piece.starting_at(start));
        Ok(())
    }

    /// Notes whether the curve is closed: its ends are one place to round-off.
    pub fn close(&mut self) {
        let (Some(first), Some(last)) = (self.pieces.first(), self.pieces.last()) else { return };
        self.closed = (first.start() - last.end()).length() <= 2.0 * self.noise;
        if self.closed {
            let end = last.end();
            self.pieces[0] = self.pieces[0].starting_at(end);
        }
    }
}
