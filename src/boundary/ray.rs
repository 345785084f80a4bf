//! What lies to the left of a place.
//!
//! **Needs** loops with nothing in common but vertices, and places not on them. **Guarantees** the
//! loop that a ray to the left hits first, with the side that it hits. **Does not** take all hits
//! in turn for the first one: its cost is that of a walk down a tree, so a comb of a hundred
//! thousand teeth is no worse than a square.
//!
//! **Method.** Drawings love rays along the axes: rows of equal islands, corners on a grid. All
//! coordinates are turned by an angle that no drawing prefers, which makes a ray through a vertex
//! a matter of chance. Arcs are cut where they are level or plumb, so that each piece spans its
//! box from corner to corner.

use super::index::Index;
use super::intersect::at_height;
use crate::geom::{ArcSpline, Bounds, Element, Point, point};
use std::f64::consts::FRAC_PI_2;

/// Cosine and sine of 0.7 radians.
const TURN: (f64, f64) = (0.764_842_187_284_488_4, 0.644_217_687_237_691);

/// A place in the turned coordinates of this module.
pub(crate) fn turned(p: Point) -> Point {
    point(p.x * TURN.0 - p.y * TURN.1, p.x * TURN.1 + p.y * TURN.0)
}

/// A piece of an element, monotone in both coordinates.
#[derive(Clone, Copy, Debug)]
struct Piece {
    element: Element,
    owner: u32,
}

/// Where a ray to the left hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// The loop.
    pub owner: usize,
    /// Whether the ray comes from the left side of the loop.
    pub from_left: bool,
}

/// Loops prepared for rays.
#[derive(Debug)]
pub(crate) struct Rays {
    tree: Index,
    pieces: Vec<Piece>,
}

impl Rays {
    /// Prepares loops; they are numbered by their `owner`, in ascending order.
    pub fn new<'a>(loops: impl Iterator<Item = (usize, &'a ArcSpline)>) -> Rays {
        let mut pieces = Vec::new();
        for (owner, path) in loops {
            let owner = owner as u32;
            for e in path.elements() {
                let element = Element { start: turned(e.start), end: turned(e.end), ..e };
                each_monotone(&element, |element| pieces.push(Piece { element, owner }));
            }
        }
        let bounds = |i: usize| {
            let Element { start, end, .. } = pieces[i].element;
            Bounds {
                min: point(start.x.min(end.x), start.y.min(end.y)),
                max: point(start.x.max(end.x), start.y.max(end.y)),
            }
        };
        Rays { tree: Index::of(pieces.len(), bounds), pieces }
    }

    /// The first hit of the ray from a turned place, loops left out that are to be skipped.
    pub fn first(&self, p: Point, skip: impl Fn(usize) -> bool) -> Option<Hit> {
        let mut best: Option<(f64, Piece)> = None;
        self.tree.walk(
            &mut best,
            |best, _, b| {
                let nearer = best.is_none_or(|(x, _)| b.max.x >= x);
                (may_hit(p, b) && nearer).then_some(-b.max.x)
            },
            |best, item| {
                let piece = self.pieces[item as usize];
                if skip(piece.owner as usize) {
                    return;
                }
                let Some(x) = piece.hit(p) else { return };
                if best.is_none_or(|(bx, b)| piece.is_hit_before(x, &b, bx, p.y)) {
                    *best = Some((x, piece));
                }
            },
        );
        best.map(|(_, piece)| piece.as_hit())
    }

    /// All hits of the ray from a turned place.
    pub fn all(&self, p: Point, mut visit: impl FnMut(Hit)) {
        self.tree.walk(
            &mut (),
            |(), _, b| may_hit(p, b).then_some(0.0),
            |(), item| {
                let piece = self.pieces[item as usize];
                if piece.hit(p).is_some() {
                    visit(piece.as_hit());
                }
            },
        );
    }

    /// For each of `count` loops its leftmost turned place; `None` where there is no loop.
    pub fn leftmost(&self, count: usize) -> Vec<Option<Point>> {
        let mut places: Vec<Option<Point>> = vec![None; count];
        for piece in &self.pieces {
            let place = &mut places[piece.owner as usize];
            for p in [piece.element.start, piece.element.end] {
                if place.is_none_or(|q| (p.x, p.y) < (q.x, q.y)) {
                    *place = Some(p);
                }
            }
        }
        places
    }

    /// Whether the outside of a set of pieces is on the left of that one, not closed, which reaches
    /// the leftmost turned place of the set, and there alone.
    pub fn is_left_of(&self, owner: usize, place: Point) -> bool {
        // Of the branches there the lowest has the outside on its right, seen from the place.
        let mut lowest: Option<(f64, bool)> = None;
        let from = self.pieces.partition_point(|p| (p.owner as usize) < owner);
        for piece in self.pieces[from..].iter().take_while(|p| p.owner as usize == owner) {
            let e = &piece.element;
            for (end, away, forward) in [(e.start, *e, true), (e.end, e.reversed(), false)] {
                let angle = away.tangents().0.angle();
                if end == place && lowest.is_none_or(|(least, _)| angle < least) {
                    lowest = Some((angle, forward));
                }
            }
        }
        lowest.is_some_and(|(_, forward)| !forward)
    }
}

fn may_hit(p: Point, b: &Bounds) -> bool {
    b.min.y <= p.y && p.y <= b.max.y && b.min.x <= p.x
}

impl Piece {
    fn as_hit(self) -> Hit {
        // Upward, its right side is that of larger abscissas, where the ray comes from.
        Hit { owner: self.owner as usize, from_left: self.element.end.y < self.element.start.y }
    }

    /// Abscissa where the ray from `p` hits; of each piece the upper end counts, not the lower.
    fn hit(&self, p: Point) -> Option<f64> {
        let e = &self.element;
        let passes = (e.start.y < p.y) != (e.end.y < p.y);
        passes.then(|| self.abscissa(p.y)).filter(|&x| x < p.x)
    }

    fn abscissa(&self, y: f64) -> f64 {
        let e = &self.element;
        if y == e.start.y {
            return e.start.x;
        }
        if y == e.end.y {
            return e.end.x;
        }
        let (low, high) = (e.start.x.min(e.end.x), e.start.x.max(e.end.x));
        if e.is_segment() {
            let t = (y - e.start.y) / (e.end.y - e.start.y);
            return (e.start.x + t * (e.end.x - e.start.x)).max(low).min(high);
        }
        let within = |x: f64| x.max(low).min(high);
        let candidates = at_height(e, y).into_iter().flatten();
        let best = candidates.min_by(|a, b| (a - within(*a)).abs().total_cmp(&(b - within(*b)).abs()));
        within(best.unwrap_or(0.5 * (low + high)))
    }

    /// Of two pieces that the ray hits at abscissas `x` and `bx`, whether this one is the first. Where they
    /// meet nearby, the wedge between them may be thinner than an ulp: seen from where they meet it is not.
    fn is_hit_before(&self, x: f64, other: &Piece, bx: f64, y: f64) -> bool {
        let (x, bx) = self.common_end(other).map_or((x, bx), |end| {
            let seen = |p: &Piece| p.seen_from(end).abscissa(y - end.y);
            (seen(self), seen(other))
        });
        x > bx || (x == bx && self.is_right_of(other, y))
    }

    fn common_end(&self, other: &Piece) -> Option<Point> {
        let ends = [other.element.start, other.element.end];
        [self.element.start, self.element.end].into_iter().find(|e| ends.contains(e))
    }

    /// The piece as it leaves one of its ends, in coordinates from there.
    fn seen_from(&self, end: Point) -> Piece {
        let e = if self.element.start == end { self.element } else { self.element.reversed() };
        let far = point(e.end.x - end.x, e.end.y - end.y);
        Piece { element: Element { start: Point::default(), end: far, ..e }, ..*self }
    }

    /// Of two pieces that the ray hits in the same place, whether this one is farther right below.
    fn is_right_of(&self, other: &Piece, y: f64) -> bool {
        let bottom = |p: &Piece| p.element.start.y.min(p.element.end.y);
        let below = 0.5 * (y + bottom(self).max(bottom(other)));
        self.abscissa(below) > other.abscissa(below)
    }
}

/// Cuts an element where it is level or plumb.
fn each_monotone(element: &Element, mut visit: impl FnMut(Element)) {
    if element.is_segment() || element.turns_within_a_quadrant() {
        return visit(*element);
    }
    let (angle, sweep) = (element.tangents().0.angle(), element.sweep());
    let (from, to) = (angle.min(angle + sweep) / FRAC_PI_2, angle.max(angle + sweep) / FRAC_PI_2);
    let quarters = (from.ceil() as i32)..=(to.floor() as i32);
    let mut cuts: Vec<f64> = quarters.map(|q| (f64::from(q) * FRAC_PI_2 - angle) / sweep).collect();
    cuts.retain(|t| (0.0..=1.0).contains(t));
    cuts.sort_by(f64::total_cmp);
    cuts.push(1.0);
    let (mut at, mut t) = (element.start, 0.0);
    for next in cuts {
        let place = element.point_at(next);
        if place != at {
            let bulge = (element.bulge.atan() * (next - t)).tan();
            visit(Element { start: at, end: place, bulge });
            (at, t) = (place, next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_hits_the_nearest_loop_and_knows_the_side() {
        let outer = ArcSpline::circle(point(0.0, 0.0), 5.0);
        let inner = ArcSpline::circle(point(0.0, 0.0), 1.0).reversed();
        let rays = Rays::new([&outer, &inner].into_iter().enumerate());
        let first = |x, y| rays.first(turned(point(x, y)), |_| false);
        assert_eq!(first(0.0, 0.0), Some(Hit { owner: 1, from_left: false }));
        assert_eq!(first(0.7, 4.0), Some(Hit { owner: 0, from_left: true }));
        let (left, down) = (-TURN.0, TURN.1);
        assert_eq!(first(9.0 * left, 9.0 * down), None);
        assert_eq!(first(-3.0 * left, -3.0 * down), Some(Hit { owner: 1, from_left: true }));
        let mut hits = 0;
        rays.all(turned(point(-9.0 * left, -9.0 * down)), |_| hits += 1);
        assert_eq!(hits, 4);
    }

    /// The wedge is thinner than an ulp where the ray passes it.
    #[test]
    fn a_ray_past_a_sharp_corner_hits_its_near_side_first() {
        /// Height of the corner.
        const TIP: f64 = 481_460.585_3;
        let far = 481_461.0;
        let wedge = ArcSpline::closed([(-far, 481_460.595, 0.0), (far, TIP, 0.0), (-far, far, 0.0)]);
        let rays = Rays::new([(0, &wedge)].into_iter());
        for step in 1..100 {
            let below = turned(point(far, TIP - 1e-6 * f64::from(step)));
            let hit = rays.first(below, |_| false);
            assert_eq!(hit, Some(Hit { owner: 0, from_left: false }), "{step}");
        }
    }

    #[test]
    fn the_leftmost_place_of_a_circle_is_found_on_it() {
        let circle = ArcSpline::circle(point(3.0, 4.0), 2.0);
        let rays = Rays::new([(0, &circle)].into_iter());
        let expected = turned(point(3.0, 4.0)).x - 2.0;
        assert!((rays.leftmost(1)[0].expect("there is a loop").x - expected).abs() < 1e-14);
    }

    #[test]
    fn pieces_join_to_the_element() {
        let arc = Element::arc(point(1.0, 0.3), point(-0.8, -0.5), 0.97);
        let mut pieces = Vec::new();
        each_monotone(&arc, |p| pieces.push(p));
        assert_eq!(pieces.len(), 3);
        assert_eq!((pieces[0].start, pieces[2].end), (arc.start, arc.end));
        assert!((pieces.iter().map(Element::length).sum::<f64>() - arc.length()).abs() < 1e-14);
    }
}
