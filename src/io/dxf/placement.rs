//! Where things come to lie: blocks that are moved, turned, scaled and mirrored, and coordinate
//! systems of entities in space.
//!
//! **Guarantees** that nothing changes where nothing is asked for, that quarter turns and mirror
//! images of round numbers are round numbers, and that equal places stay equal.
//!
//! **Method.** Everything is kept in space and looked at from above at the end. An extrusion
//! direction stands for a coordinate system by the arbitrary axis algorithm of the DXF reference.

use super::shape::Skip;
use crate::geom::{Point, Vector, point, vector};
use crate::io::Scale;

/// A place or a direction in space.
pub(super) type Space = [f64; 3];

/// Round-off of one placement, relative to its axes: eight roundings on the way of a number
/// through a turn, a scale and the placement around it.
const ROUND: f64 = 8.0 * f64::EPSILON;

/// Directions with `x` and `y` below this lie near the pole, in the arbitrary axis algorithm.
const NEAR_POLE: f64 = 1.0 / 64.0;

/// An affine map of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    /// Images of the axes.
    axes: [Space; 3],
    origin: Space,
    /// How many maps it is made of.
    depth: u32,
}

impl Placement {
    /// Everything stays.
    pub const ROOT: Placement =
        Placement { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin: [0.0; 3], depth: 0 };

    /// Image of a direction.
    pub fn vector(&self, v: Space) -> Space {
        combine(&self.axes, v)
    }

    /// Image of a place.
    pub fn point(&self, p: Space) -> Space {
        add(self.origin, self.vector(p))
    }

    /// Height of the origin.
    pub fn height(&self) -> f64 {
        self.origin[2]
    }

    /// Whether a direction leaves the plane that is seen from above.
    pub fn is_rising(&self, v: Space) -> bool {
        v[2].abs() > self.error() * v[0].hypot(v[1])
    }

    /// What a circle of two axes is, as they are seen from above.
    pub fn roundness_of(&self, x: Vector, y: Vector) -> Roundness {
        Roundness::of(x, y, self.error())
    }

    /// Round-off of all maps that it is made of.
    fn error(&self) -> f64 {
        ROUND * f64::from(self.depth + 1)
    }

    /// First `inner`, then this.
    pub fn around(&self, inner: &Placement) -> Placement {
        Placement {
            axes: inner.axes.map(|axis| self.vector(axis)),
            origin: self.point(inner.origin),
            depth: self.depth + inner.depth,
        }
    }

    /// The coordinate system of an extrusion direction.
    pub fn of_normal(normal: Space) -> Result<Placement, Skip> {
        Ok(Placement { axes: frame(normal)?, ..Placement::ROOT })
    }

    /// Scaled along the axes, then turned by an angle in degrees.
    pub fn turned(scale: Space, degrees: f64) -> Placement {
        let x = direction(degrees);
        let y = x.left();
        let axes = [
            [x.x * scale[0], x.y * scale[0], 0.0],
            [y.x * scale[1], y.y * scale[1], 0.0],
            [0.0, 0.0, scale[2]],
        ];
        Placement { axes, origin: [0.0; 3], depth: 1 }
    }

    /// Then moved.
    pub fn moved(mut self, by: Space) -> Placement {
        self.origin = add(self.origin, by);
        self
    }
}

/// A plane in space as it is seen from above, in job units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    x: Vector,
    y: Vector,
    origin: Point,
    scale: Scale,
    roundness: Roundness,
    tilted: bool,
}

/// What becomes of circles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Roundness {
    /// They stay circles, and keep their sense.
    Kept,
    /// They stay circles, run the other way.
    Mirrored,
    /// They become ellipses.
    Lost,
}

impl Plane {
    /// The plane at a height above the origin of a coordinate system.
    pub fn new(placement: &Placement, height: f64, scale: Scale) -> Plane {
        let [x, y, z] = placement.axes;
        let origin = add(placement.origin, z.map(|c| c * height));
        let above = |v: Space| vector(v[0], v[1]);
        Plane {
            x: above(x),
            y: above(y),
            origin: point(origin[0], origin[1]),
            scale,
            roundness: placement.roundness_of(above(x), above(y)),
            tilted: placement.is_rising(x) || placement.is_rising(y),
        }
    }

    /// Whether it does not lie flat.
    pub fn is_tilted(&self) -> bool {
        self.tilted
    }

    /// What becomes of circles in it.
    pub fn roundness(&self) -> Roundness {
        self.roundness
    }

    /// Where a place in it lies.
    pub fn point(&self, p: Point) -> Point {
        in_job(self.origin + (self.x * p.x + self.y * p.y), self.scale)
    }

    /// A direction in it with its length.
    pub fn vector(&self, v: Vector) -> Vector {
        let v = self.x * v.x + self.y * v.y;
        vector(self.scale.length(v.x), self.scale.length(v.y))
    }
}

impl Roundness {
    /// Of perpendicular axes of equal length, as seen.
    fn of(x: Vector, y: Vector, error: f64) -> Roundness {
        let close = |a: Vector, b: Vector| (a - b).length() <= error * x.length();
        if close(y, x.left()) {
            Roundness::Kept
        } else if close(y, x.right()) {
            Roundness::Mirrored
        } else {
            Roundness::Lost
        }
    }
}

/// A place of the drawing seen from above, in job units; a zero has no sign.
pub(super) fn in_job(p: Point, scale: Scale) -> Point {
    point(scale.length(p.x) + 0.0, scale.length(p.y) + 0.0)
}

/// Unit vector at an angle in degrees, exact at multiples of a quarter turn and symmetric about
/// them, as the angle is taken from the nearest one.
pub(super) fn direction(degrees: f64) -> Vector {
    let quarters = (degrees / 90.0).round();
    let (sin, cos) = (degrees - 90.0 * quarters).to_radians().sin_cos();
    let v = vector(cos, sin);
    match quarters.rem_euclid(4.0) as u8 {
        0 => v,
        1 => v.left(),
        2 => -v,
        _ => v.right(),
    }
}

/// The axes of the coordinate system of an extrusion direction.
fn frame(normal: Space) -> Result<[Space; 3], Skip> {
    let largest = normal.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 {
        return Err(Skip::Fault("its extrusion direction has no length".into()));
    }
    // Scaled first, so that no square leaves the range of numbers.
    let mut z = unit(normal.map(|c| c / largest));
    if z[0].abs() <= ROUND && z[1].abs() <= ROUND {
        z = [0.0, 0.0, z[2].signum()];
    }
    let near_pole = z[0].abs() < NEAR_POLE && z[1].abs() < NEAR_POLE;
    let x = unit(cross(if near_pole { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] }, z));
    Ok([x, unit(cross(z, x)), z])
}

fn unit(v: Space) -> Space {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// The vector product of two directions.
pub(super) fn cross(a: Space, b: Space) -> Space {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn add(a: Space, b: Space) -> Space {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn combine(axes: &[Space; 3], v: Space) -> Space {
    let part = |i: usize| axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2];
    [part(0), part(1), part(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(placement: &Placement) -> Plane {
        Plane::new(placement, 0.0, Scale::SAME)
    }

    #[test]
    fn a_system_from_below_mirrors_exactly() {
        let below = Placement::of_normal([0.0, 0.0, -1.0]).unwrap();
        assert_eq!(below.point([0.1, 0.2, 0.3]), [-0.1, 0.2, -0.3]);
        let plane = seen(&below);
        assert_eq!((plane.roundness(), plane.is_tilted()), (Roundness::Mirrored, false));
        assert_eq!(Placement::of_normal([1e-17, 0.0, 0.7]), Ok(Placement::ROOT));
        assert!(Placement::of_normal([0.0; 3]).is_err());
    }

    #[test]
    fn a_tilted_system_is_foreshortened() {
        // Tilted by 60 degrees about the x axis.
        let tilted = Placement::of_normal([0.0, -(0.75_f64.sqrt()), 0.5]).unwrap();
        let plane = seen(&tilted);
        assert_eq!((plane.roundness(), plane.is_tilted()), (Roundness::Lost, true));
        assert!(plane.point(point(3.0, 4.0)).distance(point(3.0, 2.0)) < 1e-14);
        // Far from the pole the other axis is taken.
        let upright = Placement::of_normal([1e200, 0.0, 0.0]).unwrap();
        assert_eq!(upright.point([3.0, 4.0, 0.0]), [0.0, 3.0, 4.0]);
    }

    #[test]
    fn quarter_turns_and_mirror_images_are_exact_in_any_nest() {
        let mut nest = Placement::ROOT;
        for degrees in [90.0, -270.0, 450.0, 90.0] {
            nest = nest.around(&Placement::turned([-1.0, 1.0, 1.0], degrees).moved([1.0, 0.0, 0.0]));
        }
        let plane = seen(&nest);
        assert_eq!(plane.roundness(), Roundness::Kept);
        let images = [[0.1, 0.7, 0.0], [0.7, 0.1, 0.0]].map(|v| nest.vector(v).map(f64::abs));
        assert!(images.iter().all(|v| *v == [0.1, 0.7, 0.0] || *v == [0.7, 0.1, 0.0]), "{images:?}");
    }

    #[test]
    fn turns_by_any_angle_keep_circles_round_and_stretching_does_not() {
        let mut nest = Placement::ROOT;
        for i in 0..200 {
            nest = nest.around(&Placement::turned([1.25, 1.25, 1.0], 17.3 + f64::from(i)));
            nest = nest.around(&Placement::turned([0.8, 0.8, 1.0], 3.1));
        }
        assert_eq!(seen(&nest).roundness(), Roundness::Kept);
        nest = nest.around(&Placement::turned([1.0, 1.000_001, 1.0], 0.0));
        assert_eq!(seen(&nest).roundness(), Roundness::Lost);
    }
}
