//! The medial axis as a network of roads, in job units: where a spoke meets it, what lies beside it.
//!
//! The **spoke** of a place is the way from its foot on the wall straight to the axis, along which
//! the distance to the wall grows as fast as can be. Where a road leads beside a wall, the spokes of
//! that wall end on it.

use crate::geom::{Element, Point, Vector, vector};
use crate::mat::{AxisEdge, Mat, NONE, falling_root};
use crate::offset::parallel_bulge;

/// Halvings that find a place on an edge: all digits of a parameter in 0..=1.
const HALVINGS: usize = 52;

/// A stretch of a conic is halved this often at most; each time it is about four times flatter.
const MAX_DEPTH: u32 = 12;

/// The axis of a pocket, made ready for search.
pub(super) struct Roads<'a> {
    pub(super) mat: &'a Mat,
    edges: Vec<AxisEdge>,
    /// Center and radius of each vertex.
    pub vertices: Vec<(Point, f64)>,
    /// Edges at each vertex: those of vertex `v` are `incident[first[v]..first[v + 1]]`.
    first: Vec<u32>,
    incident: Vec<u32>,
    /// Pieces of the boundary along each site in turn.
    pub(super) by_site: Vec<(u32, f64, u32)>,
}

/// A place on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub edge: u32,
    /// Parameter of the edge, in 0..=1.
    pub t: f64,
}

impl<'a> Roads<'a> {
    /// The roads of an axis.
    pub fn new(mat: &'a Mat) -> Roads<'a> {
        let edges = mat.edges();
        let vertices: Vec<_> = mat.vertices().iter().map(|v| (v.disk.center, v.disk.radius)).collect();
        let mut first = vec![0; vertices.len() + 1];
        for v in edges.iter().flat_map(|e| [e.from, e.to]) {
            first[v as usize + 1] += 1;
        }
        for v in 0..vertices.len() {
            first[v + 1] += first[v];
        }
        let (mut next, mut incident) = (first.clone(), vec![0; 2 * edges.len()]);
        for (id, e) in (0..).zip(&edges) {
            for v in [e.from, e.to] {
                incident[next[v as usize] as usize] = id;
                next[v as usize] += 1;
            }
        }
        let pieces = (0..).zip(&mat.graph.pieces).filter(|(_, p)| p.next != NONE);
        let position = |site: u32, id| mat.sites[site as usize].position(&mat.graph.from(&mat.sites, id));
        let mut by_site: Vec<_> = pieces.map(|(id, p)| (p.site, position(p.site, id), id)).collect();
        by_site.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        Roads { mat, edges, vertices, first, incident, by_site }
    }

    /// From a spot along the axis, to where the radius grows no more: an edge that ends there, and the
    /// place.
    pub fn climb(&self, spot: Spot) -> (u32, Point) {
        let radius = |v: u32| self.vertices[v as usize].1;
        let higher = |edge: u32| {
            let [a, b] = self.ends(edge);
            if radius(a) > radius(b) { a } else { b }
        };
        let (mut edge, mut top) = (spot.edge, higher(spot.edge));
        while let Some(&next) = self.at(top).iter().find(|&&e| radius(higher(e)) > radius(top)) {
            (edge, top) = (next, higher(next));
        }
        (edge, self.vertices[top as usize].0)
    }

    /// How many edges there are.
    pub fn edge_count(&self) -> u32 {
        self.edges.len() as u32
    }

    /// Edges at a vertex.
    pub fn at(&self, vertex: u32) -> &[u32] {
        let range = self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize;
        &self.incident[range]
    }

    /// The vertices of an edge.
    pub fn ends(&self, edge: u32) -> [u32; 2] {
        [self.edges[edge as usize].from, self.edges[edge as usize].to]
    }

    /// Radii at the ends of an edge.
    pub fn radii(&self, edge: u32) -> [f64; 2] {
        self.ends(edge).map(|v| self.vertices[v as usize].1)
    }

    /// The place at a spot.
    pub fn place(&self, spot: Spot) -> Point {
        let [x, y, w] = blossom(&self.edges[spot.edge as usize], spot.t, spot.t);
        Point { x: x / w, y: y / w }
    }

    /// Where on an edge the radius is `r`; the nearer end if it is nowhere.
    pub fn spot_of_radius(&self, edge: u32, r: f64) -> Spot {
        let [r0, r1] = self.radii(edge);
        let sign = if r1 > r0 { 1.0 } else { -1.0 };
        let (site, frame) = (self.site(edge, 0), &self.mat.frame);
        let r = frame.length_in(r);
        let above = |t: f64| sign * (r - site.carrier_distance(frame.enter(self.place(Spot { edge, t }))).0);
        let t = match above {
            above if above(1.0) >= 0.0 => 1.0,
            above if above(0.0) <= 0.0 => 0.0,
            above => falling_root(0.0, 1.0, above),
        };
        Spot { edge, t }
    }

    /// Radius at a spot.
    pub fn radius(&self, spot: Spot) -> f64 {
        self.distance(spot.edge, 0, self.place(spot))
    }

    /// The place at distance `d` from the wall on the spoke that ends in a place of an edge, on one
    /// of its two sides.
    pub fn on_spoke(&self, edge: u32, side: usize, p: Point, d: f64) -> Point {
        let (s, n) = self.site(edge, side).carrier_distance(self.mat.frame.enter(p));
        p - n * (self.mat.frame.length_out(s) - d)
    }

    /// The direction of the spoke that ends in a place of an edge, away from the wall on a side of it.
    pub fn spoke(&self, edge: u32, side: usize, p: Point) -> Vector {
        self.site(edge, side).carrier_distance(self.mat.frame.enter(p)).1
    }

    /// How far the directions of the spokes on both sides of an edge lie apart at most: what they do at
    /// one end, and what they turn by till the other.
    pub fn opening(&self, edge: u32) -> f64 {
        let spokes = |side| self.ends(edge).map(|v| self.spoke(edge, side, self.vertices[v as usize].0));
        let [a, b] = [0, 1].map(spokes);
        let turns = [a, b].map(|[begin, end]| (end - begin).length());
        // Within a quarter turn no direction between is farther from the first than the last.
        let is_bounded = turns.iter().all(|turn| *turn < std::f64::consts::SQRT_2);
        if is_bounded { (b[0] - a[0]).length() + turns[0] + turns[1] } else { f64::INFINITY }
    }

    /// The offset at distance `d` of the wall on a side of an edge, between the spokes of two spots.
    pub fn offset(&self, edge: u32, side: usize, t: [f64; 2], d: f64) -> Element {
        let site = self.site(edge, side);
        let spokes = t.map(|t| self.spoke(edge, side, self.place(Spot { edge, t })));
        let [start, end] = t.map(|t| self.on_spoke(edge, side, self.place(Spot { edge, t }), d));
        let is_straight = site.curvature == 0.0 && !site.is_vertex;
        let turn = if is_straight { 0.0 } else { spokes[0].angle_to(spokes[1]) };
        Element::arc(start, end, (0.25 * turn).tan())
    }

    /// Control points of a stretch of an edge, which lies in their convex hull.
    pub fn hull(&self, edge: u32, from: f64, to: f64) -> [Point; 3] {
        let e = &self.edges[edge as usize];
        [(from, from), (from, to), (to, to)].map(|(u, v)| {
            let [x, y, w] = blossom(e, u, v);
            Point { x: x / w, y: y / w }
        })
    }

    pub(super) fn distance(&self, edge: u32, side: usize, p: Point) -> f64 {
        let (s, _) = self.site(edge, side).carrier_distance(self.mat.frame.enter(p));
        self.mat.frame.length_out(s)
    }

    fn site(&self, edge: u32, side: usize) -> &crate::mat::Site {
        let piece = self.mat.graph.edges[edge as usize].pieces[side];
        &self.mat.sites[self.mat.graph.pieces[piece as usize].site as usize]
    }

    /// A stretch of an edge as elements that leave it by `flat` at most: an arc or a segment where the
    /// radius is constant along all of it, else chords.
    pub fn way(&self, edge: u32, [from, to]: [f64; 2], flat: f64) -> Vec<Element> {
        let start = self.place(Spot { edge, t: from });
        if [from, to] == [0.0, 1.0]
            && let Some(bulge) = parallel_bulge(self.mat, edge, false)
        {
            return vec![Element::arc(start, self.place(Spot { edge, t: to }), bulge)];
        }
        let places = self.chords(edge, from, to, flat);
        let starts = std::iter::once(start).chain(places.iter().copied());
        starts.zip(&places).map(|(a, &b)| Element::segment(a, b)).collect()
    }

    /// A stretch of an edge as a chain of chords that leave it by `flat` at most, without its first
    /// place.
    pub fn chords(&self, edge: u32, from: f64, to: f64, flat: f64) -> Vec<Point> {
        let mut places = Vec::new();
        let e = &self.edges[edge as usize];
        let end = |t: f64, places: &mut Vec<Point>| {
            places.push(match t {
                // Ends are the vertices, to the last bit.
                0.0 => e.points[0],
                1.0 => e.points[2],
                t => self.place(Spot { edge, t }),
            });
        };
        let mut open = vec![(from, to, 0)];
        while let Some((a, b, depth)) = open.pop() {
            if e.is_straight() || depth == MAX_DEPTH || shoulder(e, a, b) <= flat {
                end(b, &mut places);
            } else {
                let middle = 0.5 * (a + b);
                open.push((middle, b, depth + 1));
                open.push((a, middle, depth + 1));
            }
        }
        places
    }
}

/// Homogeneous place `[x w, y w, w]` of the polar form: the curve where both parameters are equal,
/// the middle control point of a stretch where they are its ends.
fn blossom(e: &AxisEdge, u: f64, v: f64) -> [f64; 3] {
    let shares = [(1.0 - u) * (1.0 - v), ((1.0 - u) * v + u * (1.0 - v)) * e.weight, u * v];
    let sum = |of: fn(Point) -> f64| (0..3).map(|i| shares[i] * of(e.points[i])).sum();
    [sum(|p| p.x), sum(|p| p.y), sum(|_| 1.0)]
}

/// Farthest that a stretch of a conic lies from its chord: at its shoulder, `w / (1 + w)` of the way
/// to the control point, where `w` is its weight with the weights at the ends made 1.
fn shoulder(e: &AxisEdge, a: f64, b: f64) -> f64 {
    let [p0, p1, p2] = [(a, a), (a, b), (b, b)].map(|(u, v)| blossom(e, u, v));
    let weight = p1[2] / (p0[2] * p2[2]).sqrt();
    let [p0, p1, p2] = [p0, p1, p2].map(|p| vector(p[0] / p[2], p[1] / p[2]));
    let chord = p2 - p0;
    let height = (p1 - p0).cross(chord).abs() / chord.length();
    let height = if height.is_nan() { (p1 - p0).length() } else { height };
    height * weight / (1.0 + weight)
}

/// Where a predicate that holds from 0 on ceases to hold.
pub(super) fn bisect(holds: impl Fn(f64) -> bool) -> f64 {
    if holds(1.0) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let t = 0.5 * (low + high);
        if holds(t) { low = t } else { high = t }
    }
    low
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::{Pocket, Tolerance};

    /// A plate with a round island: axis edges straight and curved, spokes of every kind.
    pub(in super::super) fn plate() -> Mat {
        let outer =
            [(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (30.0, 40.0, 0.4), (0.0, 40.0, 0.0)];
        let notch = ArcSpline::closed([(10.0, 10.0, 0.0), (10.0, 15.0, 0.0), (15.0, 10.0, 0.0)]);
        let boss = ArcSpline::circle(point(38.0, 20.0), 8.0).reversed();
        let loops = vec![ArcSpline::closed(outer), notch, boss];
        Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap()
    }

    #[test]
    fn chords_stay_as_close_to_the_axis_as_asked() {
        let mat = plate();
        let roads = Roads::new(&mat);
        for edge in 0..roads.edges.len() as u32 {
            for flat in [0.5, 0.01] {
                let chords = roads.chords(edge, 0.0, 1.0, flat);
                assert_eq!(*chords.last().unwrap(), roads.edges[edge as usize].points[2]);
                let mut at = roads.edges[edge as usize].points[0];
                let places: Vec<Point> =
                    (0..=200).map(|i| roads.place(Spot { edge, t: f64::from(i) / 200.0 })).collect();
                for to in chords {
                    let middle = at.midpoint(to);
                    let off = places.iter().map(|p| p.distance(middle)).fold(f64::INFINITY, f64::min);
                    assert!(off <= flat + 0.2, "{off}");
                    at = to;
                }
            }
        }
    }

    #[test]
    fn a_radius_is_found_on_an_edge() {
        let mat = plate();
        let roads = Roads::new(&mat);
        for edge in 0..roads.edges.len() as u32 {
            let [r0, r1] = roads.radii(edge);
            let r = 0.3 * r0 + 0.7 * r1;
            assert!((roads.radius(roads.spot_of_radius(edge, r)) - r).abs() < 1e-9);
        }
    }
}
