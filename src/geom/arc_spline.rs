//! Chains of segments and arcs.

use super::{Bounds, Element, Point, point};
use serde::{Deserialize, Serialize};

/// A vertex of an [`ArcSpline`] with the bulge of the element that leaves it. Written as
/// `[x, y, bulge]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Vertex {
    /// Where it is.
    pub point: Point,
    /// Tangent of a quarter of the angle swept by the element from here to the next vertex.
    pub bulge: f64,
}

/// A chain of segments and circular arcs. Closed, it runs from the last vertex back to the first;
/// open, the bulge of the last vertex means nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ArcSpline {
    /// The vertices in order of travel.
    pub vertices: Vec<Vertex>,
    /// Whether an element leads from the last vertex to the first.
    pub closed: bool,
}

impl ArcSpline {
    /// A closed spline from `(x, y, bulge)`.
    pub fn closed(vertices: impl IntoIterator<Item = (f64, f64, f64)>) -> ArcSpline {
        let vertices =
            vertices.into_iter().map(|(x, y, bulge)| Vertex { point: point(x, y), bulge }).collect();
        ArcSpline { vertices, closed: true }
    }

    /// An open spline from `(x, y, bulge)`.
    pub fn open(vertices: impl IntoIterator<Item = (f64, f64, f64)>) -> ArcSpline {
        ArcSpline { closed: false, ..ArcSpline::closed(vertices) }
    }

    /// A full circle as two half circles, counter-clockwise.
    pub fn circle(center: Point, radius: f64) -> ArcSpline {
        ArcSpline::closed([(center.x + radius, center.y, 1.0), (center.x - radius, center.y, 1.0)])
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        if self.closed { self.vertices.len() } else { self.vertices.len().saturating_sub(1) }
    }

    /// Whether it has no element.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Element `i`, from vertex `i` to the next.
    pub fn element(&self, i: usize) -> Element {
        let (a, b) = (self.vertices[i], self.vertices.get(i + 1).unwrap_or(&self.vertices[0]));
        Element { start: a.point, end: b.point, bulge: a.bulge }
    }

    /// The elements in order of travel.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = Element> + '_ {
        (0..self.len()).map(|i| self.element(i))
    }

    /// The same curve run backwards, beginning at the same vertex when closed.
    pub fn reversed(&self) -> ArcSpline {
        let n = self.vertices.len();
        let first = if self.closed { n } else { n.wrapping_sub(1) };
        let vertices = (0..n)
            .map(|i| {
                let at = (first + n - i) % n.max(1);
                let before = (at + n - 1) % n;
                // Not `-bulge`, so that the bulge of a segment stays +0.
                Vertex { point: self.vertices[at].point, bulge: 0.0 - self.vertices[before].bulge }
            })
            .collect();
        ArcSpline { vertices, closed: self.closed }
    }

    /// Length along the curve.
    pub fn length(&self) -> f64 {
        self.elements().map(|e| e.length()).sum()
    }

    /// Enclosed area of a closed spline, counter-clockwise positive.
    pub fn area(&self) -> f64 {
        let Some(first) = self.vertices.first() else { return 0.0 };
        self.elements().map(|e| e.area(first.point)).sum()
    }

    /// Smallest box around the curve.
    pub fn bounds(&self) -> Bounds {
        let ends = Bounds::around(self.vertices.iter().map(|v| v.point));
        self.elements().fold(ends, |b, e| if e.stays_in(&b) { b } else { b.union(e.bounds()) })
    }

    /// Distance from a place to the curve; infinite when there is none.
    pub fn distance(&self, p: Point) -> f64 {
        if let (true, Some(only)) = (self.is_empty(), self.vertices.first()) {
            return only.point.distance(p);
        }
        self.elements().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min)
    }

    /// Moved, turned and scaled: every point `p` goes to `map(p)`, which must be a similarity that
    /// keeps the orientation when `mirrored` is false and turns it when it is true.
    pub fn mapped(&self, mirrored: bool, map: impl Fn(Point) -> Point) -> ArcSpline {
        let sign = if mirrored { -1.0 } else { 1.0 };
        let vertices =
            self.vertices.iter().map(|v| Vertex { point: map(v.point), bulge: sign * v.bulge }).collect();
        ArcSpline { vertices, closed: self.closed }
    }
}

impl From<[f64; 3]> for Vertex {
    fn from([x, y, bulge]: [f64; 3]) -> Vertex {
        Vertex { point: point(x, y), bulge }
    }
}

impl From<Vertex> for [f64; 3] {
    fn from(v: Vertex) -> [f64; 3] {
        [v.point.x, v.point.y, v.bulge]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reversing_keeps_the_curve_and_turns_the_area() {
        let d = ArcSpline::closed([(0.0, 0.0, 0.0), (2.0, 0.0, 1.0), (2.0, 2.0, 0.0), (0.0, 2.0, 0.3)]);
        let r = d.reversed();
        assert_eq!(r.vertices[0].point, d.vertices[0].point);
        assert!((d.area() + r.area()).abs() < 1e-15 && (d.length() - r.length()).abs() < 1e-14);
        assert_eq!(r.reversed(), d);
        assert!(r.vertices.iter().all(|v| v.bulge != 0.0 || v.bulge.is_sign_positive()));
        let o = ArcSpline::open([(0.0, 0.0, 0.5), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0)]);
        assert_eq!(o.reversed().vertices[1].bulge, -0.5);
        assert_eq!(o.reversed().vertices[0].point, point(1.0, 1.0));
    }

    #[test]
    fn a_circle_has_its_area() {
        let c = ArcSpline::circle(point(5.0, -3.0), 2.0);
        assert!((c.area() - 4.0 * std::f64::consts::PI).abs() < 1e-14);
        assert!((c.distance(point(5.0, -3.0)) - 2.0).abs() < 1e-15);
    }
}
