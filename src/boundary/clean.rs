//! Takes out of a path what no geometry needs: elements of no length, double vertices, arcs as
//! good as straight, and arcs of more than a half circle.
//!
//! **Guarantees** that every element is longer than the round-off of the drawing and sweeps at
//! most a half circle. **Does not** change the curve by more than that round-off.

use super::grain::Grain;
use crate::geom::{ArcSpline, Bounds, Element, Point, Vertex, point};

/// Largest absolute coordinate, in job units. Beyond it, round-off is no longer small against the
/// gaps that `--join` closes.
pub(super) const COORDINATE_LIMIT: f64 = 1e10;

/// A bulge may exceed 1 by the round-off of a tangent and still mean a half circle.
const HALF_CIRCLE: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Whether every number of a path can be calculated with.
pub(super) fn is_usable(path: &ArcSpline) -> bool {
    let within = |c: f64| c.abs() <= COORDINATE_LIMIT;
    let vertices = path.vertices.iter().all(|v| within(v.point.x) && within(v.point.y));
    // The bulge after the last vertex of an open path means nothing.
    vertices
        && path.elements().all(|e| {
            let far = e.midpoint();
            e.bulge.is_finite() && within(far.x) && within(far.y)
        })
}

/// The first finite vertex of a path, for messages.
pub(super) fn some_place(path: &ArcSpline) -> Point {
    path.vertices.iter().map(|v| v.point).find(|p| p.is_finite()).unwrap_or_default()
}

/// The box around the vertices of a path and the middles of its arcs: enough for magnitudes.
pub(super) fn rough_bounds(path: &ArcSpline) -> Bounds {
    let ends = Bounds::around(path.vertices.iter().map(|v| v.point));
    path.elements().fold(ends, |b, e| b.including(e.midpoint()))
}

/// The same curve with clean elements. Nothing remains of a path as short as the round-off.
pub(super) fn clean(path: &ArcSpline, grain: Grain) -> ArcSpline {
    let mut vertices: Vec<Vertex> = Vec::with_capacity(path.vertices.len());
    let Some(first) = path.vertices.first() else { return ArcSpline::default() };
    let mut at = plain(first.point);
    for i in 0..path.len() {
        let element = path.element(i);
        let element = Element { start: at, end: plain(element.end), ..element };
        if element.chord().length() > grain.same || element.length() > grain.same {
            push(&mut vertices, element, grain);
            at = element.end;
        }
    }
    if !path.closed {
        if !vertices.is_empty() {
            vertices.push(Vertex { point: at, bulge: 0.0 });
        }
        return ArcSpline { vertices, closed: false };
    }
    // A short element before the first vertex was left out: the one before it ends there instead.
    if vertices.is_empty() || (at != vertices[0].point && at.distance(vertices[0].point) > grain.same) {
        vertices.push(Vertex { point: at, bulge: 0.0 });
    }
    let closed = ArcSpline { vertices, closed: true };
    if closed.len() < 2 { ArcSpline::default() } else { closed }
}

/// Without a negative zero, so that equal places have equal bits.
fn plain(p: Point) -> Point {
    point(p.x + 0.0, p.y + 0.0)
}

/// Appends an element, in two halves where it is more than a half circle.
fn push(vertices: &mut Vec<Vertex>, element: Element, grain: Grain) {
    let b = element.bulge;
    let sagitta = 0.5 * b.abs() * element.chord().length();
    if sagitta <= grain.ulp {
        vertices.push(Vertex { point: element.start, bulge: 0.0 });
    } else if b.abs() <= 1.0 {
        vertices.push(Vertex { point: element.start, bulge: b });
    } else if b.abs() <= HALF_CIRCLE {
        vertices.push(Vertex { point: element.start, bulge: b.signum() });
    } else {
        let bulge = (0.5 * b.atan()).tan();
        vertices.push(Vertex { point: element.start, bulge });
        vertices.push(Vertex { point: plain(element.midpoint()), bulge });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cleaned(path: ArcSpline) -> ArcSpline {
        clean(&path, Grain::of(&rough_bounds(&path)))
    }

    #[test]
    fn double_vertices_go() {
        let square = ArcSpline::closed([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]);
        let mut doubled = square.clone();
        doubled.vertices = square.vertices.iter().flat_map(|&v| [v, v]).collect();
        assert_eq!(cleaned(doubled.clone()), square);
        doubled.vertices.push(Vertex { point: point(1e-16, 0.0), bulge: 0.0 });
        assert_eq!(cleaned(doubled), square);
        let open = ArcSpline { closed: false, ..square };
        assert_eq!(cleaned(open.clone()), open);
    }

    #[test]
    fn no_element_sweeps_more_than_a_half_circle() {
        let three_quarters = (3.0 * std::f64::consts::PI / 8.0).tan();
        let pie = cleaned(ArcSpline::closed([(1.0, 0.0, three_quarters), (0.0, -1.0, 0.0), (0.0, 0.0, 0.0)]));
        assert_eq!(pie.len(), 4);
        assert!(pie.vertices.iter().all(|v| v.bulge.abs() <= 1.0));
        assert!((pie.area() - 0.75 * std::f64::consts::PI).abs() < 1e-14);
        let circle = ArcSpline::circle(point(3.0, 4.0), 2.0);
        assert_eq!(cleaned(circle.clone()), circle);
    }

    #[test]
    fn a_point_leaves_nothing_and_a_flat_arc_is_straight() {
        assert!(cleaned(ArcSpline::closed([(1.0, 1.0, 1.0), (1.0, 1.0, 0.0)])).is_empty());
        assert!(cleaned(ArcSpline::open([(1.0, 1.0, 0.5), (1.0, 1.0, 0.0)])).is_empty());
        assert!(cleaned(ArcSpline::open([])).is_empty());
        assert!(cleaned(ArcSpline::open([(0.0, 0.0, 1e-18), (1.0, 0.0, 0.0)])).element(0).is_segment());
    }

    #[test]
    fn numbers_that_cannot_be_used_are_seen() {
        assert!(!is_usable(&ArcSpline::open([(0.0, f64::NAN, 0.0), (1.0, 0.0, 0.0)])));
        assert!(!is_usable(&ArcSpline::open([(0.0, 1e300, 0.0), (1.0, 0.0, 0.0)])));
        assert!(!is_usable(&ArcSpline::open([(0.0, 0.0, f64::INFINITY), (1.0, 0.0, 0.0)])));
        assert!(!is_usable(&ArcSpline::open([(0.0, 0.0, 1e200), (1.0, 0.0, 0.0)])));
        assert!(is_usable(&ArcSpline::open([(0.0, 0.0, 0.0), (1.0, 0.0, f64::NAN)])));
    }
}
