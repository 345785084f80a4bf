//! Path data: what stands in the attribute `d`.

use super::frame::Frame;
use crate::geom::{ArcSpline, Element, Point};
use crate::mat::AxisEdge;
use std::fmt::Write;

/// Farthest that a drawn curve may lie from the true one, in pixels; invisible at a tenfold
/// enlargement.
const FINE: f64 = 0.02;

/// A conic is halved this often at most; each time it is some four times nearer to a parabola.
const MAX_HALVINGS: u32 = 12;

/// A whole spline. A lone vertex is a dot.
pub(super) fn spline(frame: &Frame, spline: &ArcSpline) -> String {
    let Some(first) = spline.vertices.first().filter(|v| v.point.is_finite()) else { return String::new() };
    let mut d = format!("M{}", frame.place(first.point));
    if spline.is_empty() {
        d += "h0";
    }
    for e in spline.elements().filter(Element::is_finite) {
        d += &element(frame, &e);
    }
    if spline.closed {
        d.push('Z');
    }
    d
}

/// A chain of segments.
pub(super) fn chain(frame: &Frame, places: &[Point]) -> String {
    let mut d = String::new();
    for (i, p) in places.iter().enumerate() {
        d.push(if i == 0 { 'M' } else { 'L' });
        d += &frame.place(*p);
    }
    d
}

/// One element, drawn from its start. Arcs beyond a half circle are drawn as two.
pub(super) fn element(frame: &Frame, e: &Element) -> String {
    let sagitta = 0.5 * e.bulge.abs() * e.chord().length();
    if sagitta < FINE * frame.pixel() {
        return format!("L{}", frame.place(e.end));
    }
    if e.bulge.abs() > 1.0 {
        let (a, b) = e.split(0.5);
        return arc(frame, &a) + &arc(frame, &b);
    }
    arc(frame, e)
}

fn arc(frame: &Frame, e: &Element) -> String {
    let radius = frame.number(e.curvature().abs().recip());
    format!("A{radius} {radius} 0 0 {} {}", u8::from(e.bulge > 0.0), frame.place(e.end))
}

/// An edge of the axis: straight, or parabolas that lie as good as on the conic.
pub(super) fn conic(frame: &Frame, edge: &AxisEdge) -> String {
    let points = edge.points;
    let usable = points.iter().all(|p| p.is_finite()) && edge.weight > 0.0 && edge.weight.is_finite();
    if !usable {
        return String::new();
    }
    let mut d = format!("M{}", frame.place(points[0]));
    let across = Element::segment(points[0], points[2]).distance(points[1]);
    if across < FINE * frame.pixel() {
        let _ = write!(d, "L{}", frame.place(points[2]));
    } else {
        parabolas(frame, points, edge.weight, MAX_HALVINGS, &mut d);
    }
    d
}

/// Halves a rational quadratic curve until the polynomial one with the same control points is as
/// good. In the middle they differ by `(w / (1 + w) - 1 / 2) |p1 - (p0 + p2) / 2|`.
fn parabolas(frame: &Frame, [p0, p1, p2]: [Point; 3], weight: f64, halvings: u32, d: &mut String) {
    let height = p1.distance(p0.midpoint(p2));
    let differs = (weight / (1.0 + weight) - 0.5).abs() * height;
    if halvings == 0 || differs < FINE * frame.pixel() {
        let _ = write!(d, "Q{} {}", frame.place(p1), frame.place(p2));
        return;
    }
    let share = weight / (1.0 + weight);
    let (a, b) = (p0 + (p1 - p0) * share, p2 + (p1 - p2) * share);
    let half = (0.5 * (1.0 + weight)).sqrt();
    parabolas(frame, [p0, a, a.midpoint(b)], half, halvings - 1, d);
    parabolas(frame, [a.midpoint(b), b, p2], half, halvings - 1, d);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Bounds, point};
    use crate::mat::{SiteKind, SiteRef};

    fn frame() -> Frame {
        Frame::new(Bounds::around([point(0.0, 0.0), point(100.0, 100.0)]))
    }

    fn edge(points: [(f64, f64); 3], weight: f64) -> AxisEdge {
        let site = SiteRef { loop_index: 0, element: 0, kind: SiteKind::Segment };
        AxisEdge { from: 0, to: 1, sites: [site; 2], points: points.map(|(x, y)| point(x, y)), weight }
    }

    #[test]
    fn a_slot_is_drawn_with_arcs() {
        let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (10.0, 0.0, 1.0), (10.0, 4.0, 0.0), (0.0, 4.0, 1.0)]);
        assert_eq!(spline(&frame(), &slot), "M0 0L10 0A2 2 0 0 1 10 4L0 4A2 2 0 0 1 0 0Z");
    }

    #[test]
    fn more_than_half_a_circle_is_drawn_in_two_and_almost_nothing_as_a_line() {
        let big = Element::arc(point(0.0, 0.0), point(2.0, 0.0), -3.0);
        assert_eq!(element(&frame(), &big).matches('A').count(), 2);
        let flat = Element::arc(point(0.0, 0.0), point(2.0, 0.0), 1e-6);
        assert_eq!(element(&frame(), &flat), "L2 0");
    }

    #[test]
    fn a_parabola_is_one_curve_and_a_line_is_a_line() {
        assert_eq!(conic(&frame(), &edge([(0.0, 0.0), (5.0, 8.0), (10.0, 0.0)], 1.0)), "M0 0Q5 8 10 0");
        assert_eq!(conic(&frame(), &edge([(0.0, 0.0), (2.0, 0.0), (10.0, 0.0)], 0.3)), "M0 0L10 0");
        assert_eq!(conic(&frame(), &edge([(0.0, 0.0), (f64::NAN, 0.0), (10.0, 0.0)], 0.3)), "");
    }

    #[test]
    fn a_quarter_of_a_circle_is_followed_closely() {
        let weight = std::f64::consts::FRAC_1_SQRT_2;
        let d = conic(&frame(), &edge([(100.0, 0.0), (100.0, 100.0), (0.0, 100.0)], weight));
        let numbers: Vec<f64> = d.split([' ', 'M', 'Q']).filter_map(|s| s.parse().ok()).collect();
        let mut from = point(numbers[0], numbers[1]);
        for c in numbers[2..].chunks(4) {
            let (control, to) = (point(c[0], c[1]), point(c[2], c[3]));
            let middle = from.midpoint(control).midpoint(control.midpoint(to));
            assert!((middle.distance(point(0.0, 0.0)) - 100.0).abs() < FINE * frame().pixel());
            from = to;
        }
        assert!(d.matches('Q').count() <= 8);
    }
}
