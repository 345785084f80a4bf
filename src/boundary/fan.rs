//! The cyclic order of the elements that leave one place.
//!
//! **Needs** elements that start at the place and meet nowhere else but at their ends.
//! **Guarantees** counter-clockwise order, also among elements that leave in the same direction.
//! **Does not** order elements that cannot be told apart along their common length: it says so.
//!
//! **Method.** By the angle of the tangent. Where round-off hides the difference of two angles, by
//! the side on which the shorter element leaves the longer one: they do not meet again, so what
//! is true a quarter of the way along is true at the start.

use crate::geom::{Element, Point};
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// Elements in counter-clockwise order around their common start.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fan {
    /// Indices of the elements; the widest gap between neighbors is that before the first.
    pub order: Vec<usize>,
    /// Angle of the tangent of each element in this order, ascending but for round-off.
    pub angles: Vec<f64>,
    /// Whether two of the elements cannot be told apart.
    pub ambiguous: bool,
}

/// Signed distance of a place from the line or full circle of an element, left positive. With
/// normal `n` and curvature `k` at the start and `w` the way to the place, it is the smaller root
/// of `|n - k w|^2 = (1 - k s)^2`, written so that nothing cancels when `k` is small.
pub(super) fn offset(element: &Element, p: Point) -> f64 {
    let (n, k, w) = (element.normals().0, element.curvature(), p - element.start);
    (2.0 * w.dot(n) - k * w.length_squared()) / (1.0 + (n - w * k).length())
}

impl Fan {
    /// Orders elements that start at one place; `same` is the round-off of places.
    pub fn new(elements: &[Element], same: f64) -> Fan {
        let mut rays: Vec<Ray> = elements.iter().enumerate().map(|(id, e)| Ray::new(id, e, same)).collect();
        rays.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.id.cmp(&b.id)));
        start_after_widest_gap(&mut rays);
        let mut fan = Fan { order: Vec::new(), angles: Vec::new(), ambiguous: false };
        let mut from = 0;
        for to in 1..=rays.len() {
            let ends = to == rays.len() || !rays[to].is_hidden_by(&rays[to - 1], same);
            if ends {
                fan.ambiguous |= sort_by_side(&mut rays[from..to], elements, same);
                from = to;
            }
        }
        fan.order = rays.iter().map(|r| r.id).collect();
        fan.angles = rays.iter().map(|r| r.angle).collect();
        fan
    }
}

/// The direction in which an element leaves.
#[derive(Clone, Copy)]
struct Ray {
    id: usize,
    angle: f64,
    /// Round-off of the angle: both ends of the chord may be off by the round-off of places.
    blur: f64,
    curvature: f64,
}

/// Differences of angles above this are seen, whatever the lengths.
const HIDDEN_ANGLE: f64 = 0.1;

impl Ray {
    fn new(id: usize, element: &Element, same: f64) -> Ray {
        let angle = element.tangents().0.angle();
        let angle = if angle.is_finite() { angle } else { 0.0 };
        Ray { id, angle, blur: 2.0 * same / element.chord().length(), curvature: element.curvature() }
    }

    /// Whether it cannot be told from the ray on its right, by `angle`, that it leaves to the left of it. If
    /// that one bends over to it, they meet again at `2 angle / bend`, with up to `angle^2 / (2 bend)`
    /// between them.
    fn is_hidden_by(&self, before: &Ray, same: f64) -> bool {
        let (blur, bend) = (self.blur + before.blur, before.curvature - self.curvature);
        let angle = self.angle - before.angle;
        let meets_again = bend > 0.0 && angle * angle <= 4.0 * same * bend;
        // A chord of no length has no direction; nothing may be hidden by it but itself.
        blur.is_finite() && angle <= HIDDEN_ANGLE && (angle <= blur || meets_again)
    }
}

fn start_after_widest_gap(rays: &mut [Ray]) {
    let n = rays.len();
    let gap = |i: usize| {
        if i == 0 { TAU + rays[0].angle - rays[n - 1].angle } else { rays[i].angle - rays[i - 1].angle }
    };
    let Some(first) = (0..n).max_by(|&i, &j| gap(i).total_cmp(&gap(j)).then(j.cmp(&i))) else { return };
    for ray in &mut rays[..first] {
        ray.angle += TAU;
    }
    rays.rotate_left(first);
}

/// Sorts rays whose angles are equal as far as can be told. Insertion, as the order may not be
/// transitive where elements cannot be told apart; answers whether that happened.
fn sort_by_side(rays: &mut [Ray], elements: &[Element], same: f64) -> bool {
    let mut ambiguous = false;
    for i in 1..rays.len() {
        let mut at = i;
        while at > 0 {
            match leaves_to(&elements[rays[at].id], &elements[rays[at - 1].id], same) {
                Some(Ordering::Less) => rays.swap(at, at - 1),
                Some(_) => break,
                None => {
                    ambiguous = true;
                    break;
                }
            }
            at -= 1;
        }
    }
    ambiguous
}

/// Whether `a` leaves to the left (`Greater`) or right of `b`; `None` if they cannot be told apart.
fn leaves_to(a: &Element, b: &Element, same: f64) -> Option<Ordering> {
    let a_is_shorter = a.length() <= b.length();
    let (short, long) = if a_is_shorter { (a, b) } else { (b, a) };
    let side = [0.25, 0.5, 1.0]
        .into_iter()
        .map(|t| offset(long, short.point_at(t)))
        .find(|s| s.abs() > 2.0 * same)?;
    Some(if (side > 0.0) == a_is_shorter { Ordering::Greater } else { Ordering::Less })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use std::f64::consts::PI;

    fn to(x: f64, y: f64, bulge: f64) -> Element {
        Element::arc(point(0.0, 0.0), point(x, y), bulge)
    }

    #[test]
    fn straight_rays_are_ordered_by_angle() {
        let fan =
            Fan::new(&[to(1.0, 0.0, 0.0), to(-1.0, 0.1, 0.0), to(0.0, 1.0, 0.0), to(0.0, -1.0, 0.0)], 1e-15);
        assert_eq!(fan.order, [3, 0, 2, 1]);
        assert!(!fan.ambiguous);
        assert!(fan.angles.is_sorted() && fan.angles[3] - fan.angles[0] < TAU);
    }

    #[test]
    fn rays_of_one_direction_are_ordered_by_curvature() {
        // Right turn, straight, weak left turn, strong left turn: all leave along the x axis.
        let arc = |bulge: f64| {
            let half = 2.0 * f64::atan(bulge);
            to(half.cos(), half.sin(), bulge)
        };
        let fan = Fan::new(&[arc(0.5), arc(0.0), arc(0.1), arc(-0.3), to(-1.0, 0.0, 0.0)], 1e-15);
        let start = fan.order.iter().position(|&i| i == 4).expect("all are in it");
        let turned: Vec<_> = (1..5).map(|i| fan.order[(start + i) % 5]).collect();
        assert_eq!(turned, [3, 1, 2, 0]);
        assert!(!fan.ambiguous);
    }

    #[test]
    fn an_arc_that_bends_over_a_ray_within_round_off_leaves_on_its_far_side() {
        // It leaves a hair to the right, is back after 1e-10, and ends far to the left.
        let arc = |bulge: f64| to(0.5f64.sqrt(), 0.5f64.sqrt(), bulge);
        let fan = Fan::new(&[arc((PI / 8.0).tan() + 5e-11), to(1.0, 0.0, 0.0), to(-1.0, 0.0, 0.0)], 1e-15);
        let start = fan.order.iter().position(|&i| i == 2).expect("all are in it");
        assert_eq!([fan.order[(start + 1) % 3], fan.order[(start + 2) % 3]], [1, 0]);
        assert!(!fan.ambiguous);
    }

    #[test]
    fn equal_rays_are_said_to_be_ambiguous() {
        assert!(Fan::new(&[to(1.0, 1.0, 0.0), to(2.0, 2.0, 0.0), to(0.0, -1.0, 0.0)], 1e-15).ambiguous);
    }
}
