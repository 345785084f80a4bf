//! Runs of chords become arcs again.
//!
//! **Needs** a path with runs of short chords, as programs write curves that they cannot draw.
//! **Guarantees** that every chord replaced is within the tolerance of its arcs and they of it, to
//! round-off; corners, arcs and chords too long to be parts of a curve stay as they are.
//! **Does not** replace chords by as many arcs.
//!
//! **Method.** Where a chord, bent as much as the path turns at its ends, would leave its place by more
//! than the tolerance, it is a segment; where that holds of both chords at a vertex, or the path turns
//! much, there is a corner. Between, biarcs reach as far as they may, with tangents of circles through
//! three vertices; each is held against its chords as against any curve ([`super::bound`]).

use super::biarc::{Joint, Node};
use super::bound::Distance;
use super::piece::Piece;
use super::pieces::{Pieces, is_usable};
use super::spiral::{Cell, cell};
use super::track::Track;
use crate::geom::{ArcSpline, Bounds, Vector, Vertex};

/// A path that turns by more than this at a vertex has a corner there, in radians.
const MAX_TURN: f64 = 0.55;

/// A biarc must stand for more chords than it has arcs.
const LEAST_CHORDS: usize = 3;

/// Vertices between those that a circle runs through are nearer to it than this part of the
/// tolerance.
const CIRCLE_SHARE: f64 = 0.125;

/// The tolerance must be this many times the round-off of a place for bounds to mean something.
const LEAST_TOLERANCE: f64 = 16.0;

impl ArcSpline {
    /// The path with runs of chords replaced by arcs within `tolerance`, in its own unit; `None` where
    /// there are none.
    pub fn with_arcs_for_chords(&self, tolerance: f64) -> Option<ArcSpline> {
        let usable = self.vertices.iter().all(|v| is_usable(v.point) && v.bulge.is_finite());
        if self.len() < LEAST_CHORDS || !usable {
            return None;
        }
        Chords::of(self, tolerance)?.replaced().map(|(path, _)| path)
    }
}

/// A path with its corners.
struct Chords {
    curve: Pieces,
    /// Vertices relative to the origin of the curve, the first one again at the end when closed.
    vertices: Vec<Vector>,
    bulges: Vec<f64>,
    closed: bool,
    /// For every vertex, whether the path has a corner there.
    corner: Vec<bool>,
    /// For every element, whether it stays.
    stays: Vec<bool>,
    tolerance: f64,
}

impl Chords {
    fn of(path: &ArcSpline, tolerance: f64) -> Option<Chords> {
        let mut curve = Pieces::around(&Bounds::around(path.vertices.iter().map(|v| v.point)));
        if !(tolerance > LEAST_TOLERANCE * curve.noise && tolerance.is_finite()) {
            return None;
        }
        let origin = curve.origin;
        let mut kept: Vec<Vertex> = path.vertices.clone();
        kept.dedup_by(|b, a| a.point == b.point && a.bulge == 0.0 && b.bulge == 0.0);
        if path.closed && kept.len() > 1 && kept[0].point == kept[kept.len() - 1].point {
            kept.pop();
        }
        let count = if path.closed { kept.len() } else { kept.len() - 1 };
        let vertices: Vec<Vector> = (0..=count).map(|i| kept[i % kept.len()].point - origin).collect();
        let bulges: Vec<f64> = kept[..count].iter().map(|v| v.bulge).collect();
        curve.pieces = vertices.windows(2).map(|w| Piece::new(w, &[1.0; 2])).collect();
        curve.closed = path.closed;
        let mut chords = Chords {
            curve,
            vertices,
            bulges,
            closed: path.closed,
            corner: Vec::new(),
            stays: Vec::new(),
            tolerance,
        };
        chords.corner = (0..=count).map(|i| chords.is_corner(i)).collect();
        chords.stays = (0..count).map(|i| chords.has_to_stay(i)).collect();
        Some(chords)
    }

    fn count(&self) -> usize {
        self.bulges.len()
    }

    fn chord(&self, i: usize) -> Vector {
        self.vertices[i + 1] - self.vertices[i]
    }

    /// The elements before and after a vertex.
    fn sides(&self, i: usize) -> Option<[usize; 2]> {
        let n = self.count();
        let inner = i > 0 && i < n;
        (inner || self.closed).then(|| [(i + n - 1) % n, i % n])
    }

    /// How far an arc that turns by `turn` leaves its chord.
    fn rise(chord: Vector, turn: f64) -> f64 {
        0.5 * chord.length() * (0.25 * turn).tan()
    }

    /// Angle of the path at a vertex between chords.
    fn turn(&self, [before, after]: [usize; 2]) -> f64 {
        self.chord(before).angle_to(self.chord(after)).abs()
    }

    fn is_corner(&self, i: usize) -> bool {
        let Some(sides) = self.sides(i) else { return true };
        let turn = self.turn(sides);
        let rise = |i: usize| Chords::rise(self.chord(i), turn);
        sides.iter().any(|&i| self.bulges[i] != 0.0)
            || !(turn <= MAX_TURN && rise(sides[0]).min(rise(sides[1])) <= self.tolerance)
    }

    fn has_to_stay(&self, i: usize) -> bool {
        let turned = |v: usize| !self.corner[v] && self.sides(v).is_some_and(|s| self.bends_too_much(i, s));
        self.bulges[i] != 0.0 || turned(i) || turned(i + 1)
    }

    fn bends_too_much(&self, i: usize, sides: [usize; 2]) -> bool {
        Chords::rise(self.chord(i), self.turn(sides)) > self.tolerance
    }

    /// The new path, and how far it is from the chords.
    fn replaced(&self) -> Option<(ArcSpline, Distance)> {
        let n = self.count();
        let track = Track::new(&self.curve);
        let mut made = Made { vertices: Vec::new(), replaced: false, distance: Distance::ZERO };
        let mut i = 0;
        while i < n {
            let mut end = i + 1;
            if !self.stays[i] {
                while end < n && !self.corner[end] && !self.stays[end] {
                    end += 1;
                }
                self.run(&track, [i, end], &mut made);
            } else {
                made.keep(self, i);
            }
            i = end;
        }
        if !made.replaced {
            return None;
        }
        if !self.closed {
            made.push(self, self.vertices[n], 0.0);
        }
        Some((ArcSpline { vertices: made.vertices, closed: self.closed }, made.distance))
    }

    /// Replaces the chords from one vertex to another, as far as that spares any.
    fn run(&self, track: &Track, [from, to]: [usize; 2], made: &mut Made) {
        let mut at = from;
        while at < to {
            let a = self.node(track, at, [from, to]);
            let fits = |end: usize| {
                let b = self.node(track, end, [from, to]);
                let middle = 0.5 * (a.u + b.u);
                let cell = cell(track, [&a, &b], middle, Joint::MIDDLE, self.tolerance);
                (cell.distance.bound <= self.tolerance - self.curve.noise).then_some(cell)
            };
            let mut best: Option<(usize, Cell)> = None;
            // As far as strides of twice the length lead, then by halves.
            let (mut stride, mut limit) = (LEAST_CHORDS, to + 1);
            while at + stride <= to {
                match fits(at + stride) {
                    Some(cell) => best = Some((at + stride, cell)),
                    None => {
                        limit = at + stride;
                        break;
                    }
                }
                stride *= 2;
            }
            if let Some((mut reached, _)) = best {
                while limit - reached > 1 {
                    let middle = reached + (limit - reached) / 2;
                    match fits(middle) {
                        Some(cell) => (reached, best) = (middle, Some((middle, cell))),
                        None => limit = middle,
                    }
                }
            }
            at = match best {
                Some((end, cell)) => {
                    made.replace(self, &cell);
                    end
                }
                None => {
                    made.keep(self, at);
                    at + 1
                }
            };
        }
    }

    /// A vertex with its tangent, in a run between two others.
    fn node(&self, track: &Track, i: usize, run: [usize; 2]) -> Node {
        let place = track.grid.snap(self.vertices[i]);
        Node { u: i as f64, place, tangent: self.tangent(i, run), curvature: 0.0 }
    }

    /// The tangent at a vertex: of the segment that the run goes on from, or of the widest circle
    /// through vertices about it that is as good as the path.
    fn tangent(&self, i: usize, [from, to]: [usize; 2]) -> Vector {
        let ring = self.closed && from == 0 && to == self.count() && !self.corner[0];
        let beside = self.sides(i).filter(|_| !self.corner[i]);
        if let Some([before, after]) = beside.filter(|_| !ring) {
            if i == from {
                return self.chord(before).unit();
            }
            if i == to {
                return self.chord(after).unit();
            }
        }
        let vertex = |j: isize| self.vertices[j.rem_euclid(self.count() as isize) as usize];
        let free = |j: isize| if ring { vertex(j) } else { self.vertices[j as usize] };
        let room = if ring { self.count() / 4 } else { (i - from).min(to - i) };
        if room == 0 {
            let inner = if i == from { 1 } else { -1 };
            let far = ((to - from) / 2) as isize;
            return self.end_tangent(i as isize, inner, far, free);
        }
        let mut tangent = None;
        let mut width = 1;
        while width <= room {
            let w = width as isize;
            let j = i as isize;
            let [a, p, b] = [free(j - w), free(j), free(j + w)];
            let good = width == 1 || (1 - w..w).all(|s| self.on_circle([a, p, b], free(j + s)));
            if !good {
                break;
            }
            let (before, after) = (p - a, b - p);
            tangent = Some((before / before.length_squared() + after / after.length_squared()).unit());
            width *= 2;
        }
        tangent.unwrap_or_else(|| self.chord(i.min(self.count() - 1)).unit())
    }

    /// The tangent at an end of a run, by a circle through vertices on one side.
    fn end_tangent(&self, i: isize, inner: isize, far: isize, vertex: impl Fn(isize) -> Vector) -> Vector {
        let sign = inner as f64;
        let mut tangent = (vertex(i + inner) - vertex(i)).unit() * sign;
        let mut width = 1;
        while width <= far {
            let [p, m, q] = [0, 1, 2].map(|s| vertex(i + s * inner * width));
            let good = width == 1 || (1..2 * width).all(|s| self.on_circle([p, m, q], vertex(i + s * inner)));
            if !good {
                break;
            }
            let (c, b) = (q - p, q - m);
            let turn = c.angle_to(b);
            tangent = (m - p).unit().rotated(turn.cos(), -turn.sin()) * sign;
            width *= 2;
        }
        tangent
    }

    /// Whether a place is on the circle through three others, nearly.
    fn on_circle(&self, [a, m, b]: [Vector; 3], p: Vector) -> bool {
        let (v, w) = (m - a, b - m);
        let bulge = v.cross(w) / (v.length() * w.length() + v.dot(w));
        bulge.abs() < 0.5
            && super::biarc::Arc { start: a, end: b, bulge }.distance(p) <= CIRCLE_SHARE * self.tolerance
    }
}

/// The new path.
struct Made {
    vertices: Vec<Vertex>,
    replaced: bool,
    distance: Distance,
}

impl Made {
    fn push(&mut self, chords: &Chords, place: Vector, bulge: f64) {
        self.vertices.push(Vertex { point: chords.curve.origin + place, bulge });
    }

    fn keep(&mut self, chords: &Chords, i: usize) {
        self.push(chords, chords.vertices[i], chords.bulges[i]);
    }

    fn replace(&mut self, chords: &Chords, cell: &Cell) {
        self.replaced = true;
        self.distance = self.distance.max(cell.distance);
        for (arc, _, _) in cell.spans() {
            self.push(chords, arc.start, arc.bulge);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn circle(count: usize, radius: f64) -> ArcSpline {
        let place = |i: usize| Vector::from_angle(TAU * i as f64 / count as f64) * radius;
        ArcSpline::closed((0..count).map(|i| (100.0 + place(i).x, place(i).y, 0.0)))
    }

    /// Largest distance of places on a path from another path.
    fn apart(a: &ArcSpline, b: &ArcSpline) -> f64 {
        let places = a.elements().flat_map(|e| (0..16).map(move |i| e.point_at(f64::from(i) / 16.0)));
        places.map(|p| b.distance(p)).fold(0.0, f64::max)
    }

    #[test]
    fn a_circle_of_a_thousand_chords_is_a_few_arcs() {
        let drawn = circle(1000, 20.0);
        let arcs = drawn.with_arcs_for_chords(0.01).unwrap();
        assert!(arcs.len() <= 12, "{}", arcs.len());
        assert!((arcs.area() - 400.0 * std::f64::consts::PI).abs() < 0.01);
        assert!(apart(&drawn, &arcs) <= 0.01 && apart(&arcs, &drawn) <= 0.01);
    }

    #[test]
    fn the_bound_is_above_all_samples_and_near_them() {
        let wave = |i: usize| (0.05 * i as f64, (0.05 * i as f64).sin() + 0.2 * (0.11 * i as f64).cos());
        let waves = ArcSpline::open((0..400).map(wave).map(|(x, y)| (10.0 * x, 10.0 * y, 0.0)));
        let oval = |i: usize| Vector::from_angle(TAU * i as f64 / 300.0);
        let oval = ArcSpline::closed((0..300).map(oval).map(|v| (30.0 * v.x, 12.0 * v.y, 0.0)));
        let mut made = 0;
        for drawn in [circle(1000, 20.0), circle(37, 2.0), waves, oval] {
            for tolerance in [0.2, 0.05, 0.01] {
                let Some((arcs, distance)) = Chords::of(&drawn, tolerance).and_then(|c| c.replaced()) else {
                    continue;
                };
                let sampled = apart(&drawn, &arcs).max(apart(&arcs, &drawn));
                let bound = distance.bound;
                assert!(sampled <= bound && bound <= tolerance, "{tolerance}: {sampled:e}, {bound:e}");
                assert!(bound <= 1.2 * sampled, "{tolerance}: {sampled:e}, {bound:e}");
                made += 1;
            }
        }
        assert!(made >= 8, "{made}");
    }

    #[test]
    fn what_has_corners_alone_stays_as_it_is() {
        let rectangle = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 5.0, 0.0), (0.0, 5.0, 0.0)];
        for path in [ArcSpline::closed(rectangle), ArcSpline::open(rectangle), circle(8, 20.0)] {
            assert_eq!(path.with_arcs_for_chords(0.01), None);
        }
    }

    #[test]
    fn sides_and_round_corners_of_a_plate_come_back() {
        // A plate of 40 by 20 with corners of radius 5, each drawn with 40 chords.
        let centers = [(35.0, 15.0), (5.0, 15.0), (5.0, 5.0), (35.0, 5.0)];
        let places = centers.iter().enumerate().flat_map(|(q, c)| {
            (0..=40).map(move |i| {
                let v = Vector::from_angle(0.25 * TAU * (q as f64 + f64::from(i) / 40.0)) * 5.0;
                (c.0 + v.x, c.1 + v.y, 0.0)
            })
        });
        let drawn = ArcSpline::closed(places);
        let plate = drawn.with_arcs_for_chords(0.01).unwrap();
        assert!(plate.len() <= 20, "{}", plate.len());
        let sides: Vec<f64> =
            plate.elements().filter(|e| e.is_segment()).map(|e| e.chord().length()).collect();
        assert_eq!(sides.iter().filter(|l| **l > 9.0).count(), 4, "{sides:?}");
        assert!(apart(&drawn, &plate) <= 0.01 && apart(&plate, &drawn) <= 0.01);
    }

    #[test]
    fn a_corner_between_curves_stays_a_corner() {
        // A half disk: an arc of chords and its diameter.
        let places = (0..=200).map(|i| {
            let v = Vector::from_angle(0.5 * TAU * f64::from(i) / 200.0) * 10.0;
            (v.x, v.y, 0.0)
        });
        let half = ArcSpline::closed(places).with_arcs_for_chords(0.005).unwrap();
        assert!(half.len() <= 9, "{}", half.len());
        for x in [10.0, -10.0] {
            assert!(half.vertices.iter().any(|v| (v.point.x - x).abs() < 1e-12 && v.point.y.abs() < 1e-12));
        }
    }

    #[test]
    fn a_tolerance_below_round_off_changes_nothing() {
        for tolerance in [0.0, -1.0, f64::NAN, 1e-16] {
            assert_eq!(circle(1000, 20.0).with_arcs_for_chords(tolerance), None);
        }
    }
}
