//! The frame of calculation: the pocket moved to the origin and scaled to size 1.
//!
//! The scale is a power of two and so costs nothing; moving rounds each coordinate once, by less
//! than an ulp of the size. All round-off bounds of the room `mat` are relative to 1.

use crate::geom::{Bounds, Point, point};

/// A similarity between job units and the unit frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    origin: Point,
    scale: f64,
    /// Round-off of one drawn coordinate, in the frame: an ulp of the largest coordinate.
    pub noise: f64,
}

impl Frame {
    /// The frame in which `bounds` lies around the origin with a diagonal in 0.5..=1.
    pub fn around(bounds: &Bounds) -> Frame {
        let scale = 2f64.powi(bounds.diagonal().log2().ceil() as i32);
        let noise = f64::EPSILON * (bounds.magnitude() / scale).max(1.0);
        Frame { origin: bounds.center(), scale, noise }
    }

    #[inline]
    pub fn enter(&self, p: Point) -> Point {
        let v = (p - self.origin) / self.scale;
        point(v.x, v.y)
    }

    #[inline]
    pub fn leave(&self, p: Point) -> Point {
        self.origin + p.to_vector() * self.scale
    }

    #[inline]
    pub fn length_in(&self, d: f64) -> f64 {
        d / self.scale
    }

    #[inline]
    pub fn length_out(&self, d: f64) -> f64 {
        d * self.scale
    }
}
