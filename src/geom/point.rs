//! Places and directions in the plane.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A place in the plane, in job units. Written as `[x, y]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

/// A difference of places, or a direction when of unit length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub struct Vector {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

/// The place `(x, y)`.
#[inline]
pub const fn point(x: f64, y: f64) -> Point {
    Point { x, y }
}

/// The vector `(x, y)`.
#[inline]
pub const fn vector(x: f64, y: f64) -> Vector {
    Vector { x, y }
}

impl Point {
    /// Distance to another place.
    #[inline]
    pub fn distance(self, other: Point) -> f64 {
        (self - other).length()
    }

    /// The place halfway to another one.
    #[inline]
    pub fn midpoint(self, other: Point) -> Point {
        self + (other - self) * 0.5
    }

    /// Whether both coordinates are finite numbers.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }

    /// The vector from the origin.
    #[inline]
    pub fn to_vector(self) -> Vector {
        vector(self.x, self.y)
    }
}

impl Vector {
    /// The unit vector at an angle, in radians counter-clockwise from the x axis.
    pub fn from_angle(angle: f64) -> Vector {
        let (s, c) = angle.sin_cos();
        vector(c, s)
    }

    /// Scalar product.
    #[inline]
    pub fn dot(self, other: Vector) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Signed area of the parallelogram: positive when `other` lies to the left.
    #[inline]
    pub fn cross(self, other: Vector) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Squared length.
    #[inline]
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    #[inline]
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// The same direction with length 1; not finite for the zero vector.
    #[inline]
    pub fn unit(self) -> Vector {
        self * (1.0 / self.length())
    }

    /// Turned by a quarter to the left.
    #[inline]
    pub fn left(self) -> Vector {
        vector(-self.y, self.x)
    }

    /// Turned by a quarter to the right.
    #[inline]
    pub fn right(self) -> Vector {
        vector(self.y, -self.x)
    }

    /// Turned by the angle whose cosine and sine are given, counter-clockwise.
    #[inline]
    pub fn rotated(self, cos: f64, sin: f64) -> Vector {
        vector(self.x * cos - self.y * sin, self.x * sin + self.y * cos)
    }

    /// Signed angle that turns this direction onto `other`, in `(-pi, pi]`.
    #[inline]
    pub fn angle_to(self, other: Vector) -> f64 {
        self.cross(other).atan2(self.dot(other))
    }

    /// Angle of the direction, counter-clockwise from the x axis, in `(-pi, pi]`.
    #[inline]
    pub fn angle(self) -> f64 {
        self.y.atan2(self.x)
    }
}

/// As a reader wants it: `(x, y)` with six decimals, or more where both coordinates are that small,
/// and without trailing zeros.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let magnitude = self.x.abs().max(self.y.abs());
        let decimals = (6.0 - magnitude.log10().floor()).clamp(6.0, 15.0) as usize;
        let short = |value: f64| {
            let text = format!("{value:.decimals$}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            if text == "-0" { "0".to_owned() } else { text.to_owned() }
        };
        write!(f, "({}, {})", short(self.x), short(self.y))
    }
}

impl Sub for Point {
    type Output = Vector;
    #[inline]
    fn sub(self, other: Point) -> Vector {
        vector(self.x - other.x, self.y - other.y)
    }
}

impl Add<Vector> for Point {
    type Output = Point;
    #[inline]
    fn add(self, v: Vector) -> Point {
        point(self.x + v.x, self.y + v.y)
    }
}

impl AddAssign<Vector> for Point {
    #[inline]
    fn add_assign(&mut self, v: Vector) {
        *self = *self + v;
    }
}

impl Sub<Vector> for Point {
    type Output = Point;
    #[inline]
    fn sub(self, v: Vector) -> Point {
        point(self.x - v.x, self.y - v.y)
    }
}

impl Add for Vector {
    type Output = Vector;
    #[inline]
    fn add(self, v: Vector) -> Vector {
        vector(self.x + v.x, self.y + v.y)
    }
}

impl AddAssign for Vector {
    #[inline]
    fn add_assign(&mut self, v: Vector) {
        *self = *self + v;
    }
}

impl Sub for Vector {
    type Output = Vector;
    #[inline]
    fn sub(self, v: Vector) -> Vector {
        vector(self.x - v.x, self.y - v.y)
    }
}

impl Neg for Vector {
    type Output = Vector;
    #[inline]
    fn neg(self) -> Vector {
        vector(-self.x, -self.y)
    }
}

impl Mul<f64> for Vector {
    type Output = Vector;
    #[inline]
    fn mul(self, s: f64) -> Vector {
        vector(self.x * s, self.y * s)
    }
}

impl Div<f64> for Vector {
    type Output = Vector;
    #[inline]
    fn div(self, s: f64) -> Vector {
        vector(self.x / s, self.y / s)
    }
}

impl From<[f64; 2]> for Point {
    fn from([x, y]: [f64; 2]) -> Point {
        point(x, y)
    }
}

impl From<Point> for [f64; 2] {
    fn from(p: Point) -> [f64; 2] {
        [p.x, p.y]
    }
}

impl From<[f64; 2]> for Vector {
    fn from([x, y]: [f64; 2]) -> Vector {
        vector(x, y)
    }
}

impl From<Vector> for [f64; 2] {
    fn from(v: Vector) -> [f64; 2] {
        [v.x, v.y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_short_and_never_lost() {
        let told = |x, y| point(x, y).to_string();
        assert_eq!(told(66.0, 7.999_999_999_999_998), "(66, 8)");
        assert_eq!(told(-0.0, -1e-9), "(0, -0.000000001)");
        assert_eq!(told(1e6 + 0.25, 1e-9), "(1000000.25, 0)");
        assert_eq!(told(f64::NAN, f64::INFINITY), "(NaN, inf)");
    }
}
