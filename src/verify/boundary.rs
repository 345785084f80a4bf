//! Loops with an index: distance and containment in logarithmic time.

use super::crossing::winding;
use crate::geom::{ArcSpline, Bounds, Element, Nearest, Point};
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// Loops that can be asked for distances and containment.
///
/// **Needs** any arc splines; elements with a coordinate that is not a number are left out.
/// **Guarantees** the distance to the nearest element, exact up to round-off, and winding numbers
/// that are right for every place farther from the loops than round-off.
///
/// **Method.** An R-tree over the boxes of the elements; distances in curvature form, winding
/// numbers by the crossings of a ray with parts of elements that are monotone in both coordinates.
#[derive(Debug)]
pub struct Boundary {
    loops: Vec<ArcSpline>,
    tree: RTree<Site>,
    bounds: Bounds,
}

/// The place of a [`Boundary`] nearest to some other place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where it is and how far.
    pub nearest: Nearest,
    /// Index of the loop.
    pub loop_index: u32,
    /// The element it lies on.
    pub element: Element,
    /// Index of that element in the loop.
    pub element_index: u32,
}

/// An element in the tree.
#[derive(Clone, Debug)]
struct Site {
    element: Element,
    bounds: Bounds,
    loop_index: u32,
    index: u32,
}

impl RTreeObject for Site {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.bounds.min.into(), self.bounds.max.into())
    }
}

impl PointDistance for Site {
    fn distance_2(&self, p: &[f64; 2]) -> f64 {
        let d = self.element.distance((*p).into());
        d * d
    }
}

impl Boundary {
    /// Indexes loops. Open splines count for distances and not for containment.
    pub fn new<'a>(loops: impl IntoIterator<Item = &'a ArcSpline>) -> Boundary {
        let loops: Vec<ArcSpline> = loops.into_iter().cloned().collect();
        let mut sites = Vec::new();
        for (loop_index, spline) in (0u32..).zip(&loops) {
            for (index, element) in (0u32..).zip(elements(spline)) {
                let bounds = element.bounds();
                if element.is_finite() && bounds.min.is_finite() && bounds.max.is_finite() {
                    sites.push(Site { element, bounds, loop_index, index });
                }
            }
        }
        let bounds = sites.iter().fold(Bounds::EMPTY, |b, s| b.union(s.bounds));
        Boundary { loops, tree: RTree::bulk_load(sites), bounds }
    }

    /// The loops.
    pub fn loops(&self) -> &[ArcSpline] {
        &self.loops
    }

    /// Box around all loops.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Distance to the nearest place of the loops; infinite when there is none.
    pub fn distance(&self, p: Point) -> f64 {
        self.nearest(p).map_or(f64::INFINITY, |hit| hit.nearest.distance)
    }

    /// The nearest place of the loops.
    pub fn nearest(&self, p: Point) -> Option<Hit> {
        if !p.is_finite() {
            return None;
        }
        // Not `nearest_neighbor`: it bounds the distance by faces of boxes, and round-off then
        // loses an element that is nearest with a place on such a face.
        let site = self.tree.nearest_neighbor_iter(&[p.x, p.y]).next()?;
        let nearest = site.element.nearest(p);
        Some(Hit { nearest, loop_index: site.loop_index, element: site.element, element_index: site.index })
    }

    /// How often the closed loops turn round a place, counter-clockwise positive.
    pub fn winding(&self, p: Point) -> i32 {
        self.ray(p).map(|s| winding(&s.element, p)).sum()
    }

    /// Whether a place lies inside by the even-odd rule, whatever the orientation of the loops.
    pub fn contains(&self, p: Point) -> bool {
        self.winding(p).rem_euclid(2) == 1
    }

    /// The loops turned so that the inside (even-odd) lies on the left of each.
    pub(super) fn oriented(&self) -> Vec<ArcSpline> {
        self.loops
            .iter()
            .zip(0u32..)
            .map(|(spline, i)| {
                let nested = widest(spline).is_some_and(|e| {
                    let p = e.midpoint();
                    let round = self.ray(p).filter(|s| s.loop_index != i).map(|s| winding(&s.element, p));
                    round.sum::<i32>().rem_euclid(2) == 1
                });
                if (spline.area() < 0.0) == nested { spline.clone() } else { spline.reversed() }
            })
            .collect()
    }

    /// Elements of closed loops whose boxes the ray from `p` to the right meets.
    fn ray(&self, p: Point) -> impl Iterator<Item = &Site> {
        let right = self.bounds.max.x.max(p.x);
        let ray = AABB::from_corners([p.x, p.y], [right, p.y]);
        let sites = p.is_finite().then(|| self.tree.locate_in_envelope_intersecting(&ray));
        sites.into_iter().flatten().filter(|s| self.loops[s.loop_index as usize].closed)
    }
}

/// The elements of a spline; of a lone vertex the element of length 0 there.
fn elements(spline: &ArcSpline) -> impl Iterator<Item = Element> + '_ {
    let lone = spline.vertices.first().filter(|_| spline.is_empty());
    spline.elements().chain(lone.map(|v| Element::segment(v.point, v.point)))
}

/// The element with the longest chord.
pub(super) fn widest(spline: &ArcSpline) -> Option<Element> {
    spline.elements().max_by(|a, b| a.chord().length_squared().total_cmp(&b.chord().length_squared()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn annulus() -> Boundary {
        let outer = ArcSpline::circle(point(0.0, 0.0), 5.0);
        let island = ArcSpline::circle(point(1.0, 0.0), 2.0).reversed();
        Boundary::new([&outer, &island])
    }

    #[test]
    fn distance_and_containment_in_an_annulus() {
        let b = annulus();
        assert!((b.distance(point(-3.0, 0.0)) - 2.0).abs() < 1e-14);
        assert!(b.contains(point(-3.0, 0.0)) && !b.contains(point(1.0, 1.0)) && !b.contains(point(6.0, 0.0)));
        assert_eq!((b.winding(point(-3.0, 0.0)), b.winding(point(1.0, 0.0))), (1, 0));
    }

    #[test]
    fn loops_of_any_orientation_are_turned_with_the_inside_on_the_left() {
        let b = annulus();
        let turned: Vec<_> = b.loops().iter().map(ArcSpline::reversed).collect();
        let areas: Vec<_> = Boundary::new(&turned).oriented().iter().map(ArcSpline::area).collect();
        assert!(areas[0] > 0.0 && areas[1] < 0.0);
        assert!(b.oriented()[0].area() > 0.0 && b.oriented()[1].area() < 0.0);
    }

    #[test]
    fn nothing_is_infinitely_far_and_contains_nothing() {
        let b = Boundary::new(&[]);
        assert_eq!(b.distance(point(0.0, 0.0)), f64::INFINITY);
        assert!(!b.contains(point(0.0, 0.0)) && b.nearest(point(f64::NAN, 0.0)).is_none());
    }

    /// Among these are places whose nearest one is a corner of a box: round-off in a bound by
    /// boxes loses the element.
    #[test]
    fn the_index_agrees_with_trying_every_element() {
        let triangle = |i: u32| {
            let (s, c) = (f64::from(i) * 2.4).sin_cos();
            let (x, y) = (0.3 * f64::from(i).sqrt() * c, 0.3 * f64::from(i).sqrt() * s);
            let corner = |k: f64| {
                let (s, c) = (f64::from(i) + k).sin_cos();
                (x + 0.1 * c, y + 0.1 * s, if i.is_multiple_of(3) { 0.2 } else { 0.0 })
            };
            ArcSpline::closed([corner(0.0), corner(2.0), corner(4.0)])
        };
        let islands: Vec<ArcSpline> = (0..150).map(triangle).collect();
        let b = Boundary::new(&islands);
        for i in 0..20_000 {
            let (s, c) = (f64::from(i) * 2.7).sin_cos();
            let p = point(0.0002 * f64::from(i) * c, 0.0002 * f64::from(i) * s);
            let nearest = islands.iter().map(|l| l.distance(p)).fold(f64::INFINITY, f64::min);
            assert_eq!(b.distance(p), nearest);
        }
    }
}
