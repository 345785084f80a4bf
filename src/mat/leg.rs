//! What levels follow of the boundary in one arc.
//!
//! A level set moves every element of the boundary by the same distance, so the angle of its arc is always that
//! of the element: only where it begins depends on the distance. What is as far away as a level all along is
//! followed in *legs*, whose bulges are known once for all levels.

use super::site::Foot;
use std::f64::consts::PI;

/// A part of a ring that a level follows in one arc if all of it is farther away: on one element or vertex of the
/// drawing, and no more than half a turn of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// Where it begins.
    pub foot: Foot,
    /// Angle by which the normal turns along it.
    pub turn: f64,
    /// Bulge of its arc in every level.
    pub bulge: f64,
    /// The smallest radius along it, its ends included; less than any where a ring ends, which is no leg.
    pub least: f64,
    /// The stop that it begins at.
    pub first: u32,
}

/// What a piece has in common with the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    OtherSource,
    /// Another site of the same element or vertex of the drawing.
    SameSource,
    SameSite,
}

impl After {
    /// Whether a piece that turns so far is of one arc with what turns so far before it.
    #[inline]
    pub fn goes_on(self, before: f64, turn: f64) -> bool {
        match self {
            After::SameSite => true,
            After::SameSource => (before + turn).abs() <= PI,
            After::OtherSource => false,
        }
    }
}

impl Leg {
    /// One that begins in a disk, with the turn of its first piece.
    pub fn begun(foot: Foot, turn: f64, radius: f64, first: u32) -> Leg {
        Leg { foot, turn, bulge: 0.0, least: radius, first }
    }

    /// Stands for the end of a ring, so that no level runs on into the next.
    pub fn end(foot: Foot, first: u32) -> Leg {
        Leg { foot, turn: 0.0, bulge: 0.0, least: f64::NEG_INFINITY, first }
    }

    /// Adds a piece that begins in a disk.
    #[inline]
    pub fn add(&mut self, turn: f64, radius: f64) {
        self.turn += turn;
        self.least = self.least.min(radius);
    }

    /// Nothing is added anymore, and it ends in a disk.
    pub fn close(&mut self, radius: f64) {
        self.bulge = bulge_of(self.turn);
        self.least = self.least.min(radius);
    }
}

/// The bulge of an arc that turns so far.
#[inline]
pub(crate) fn bulge_of(turn: f64) -> f64 {
    if turn == 0.0 { 0.0 } else { (0.25 * turn).tan() }
}
