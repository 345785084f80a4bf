//! Where a level crosses an edge of the axis.
//!
//! **Guarantees** the place on the edge that is at the distance from the elements on both sides, to
//! round-off: the same to the last bit for both.
//!
//! **Method.** The radius is monotone along the edge, so there is one such place. Newton's method finds it
//! in three or four steps from where a straight edge with a steady radius would have it; what it finds is
//! taken if its feet lie on the pieces of the boundary that the edge stands for, as nothing else is as far
//! from both. Otherwise it is tried once more from where a radius that grows evenly faster would have it,
//! as beside necks, and where that fails, too, beside ends of edges and between walls nearly parallel,
//! halving along the longer piece does not fail.

use super::carriers::{Below, Carriers};
use super::trace::Tracer;
use crate::geom::{Point, Vector, vector};
use crate::mat::{Foot, Site, Track, falling_root};
use wide::f64x2;

/// Crossings that are looked for side by side: neither memory nor roots are waited for one by one.
const AT_A_TIME: usize = 16;

/// Where the level crosses an edge, seen from the piece that runs into the inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub stop: u32,
    pub edge: u32,
    pub center: Point,
    /// Turn of the normal from here to the end of the piece.
    pub entering: f64,
    /// Turn of the normal from the beginning of the piece on the other side up to here.
    pub leaving: f64,
}

/// A place on an edge and the normals of the pieces along it and against it.
struct Crossing {
    center: Point,
    normals: [Vector; 2],
}

/// Where to find what is on both sides of an edge.
struct Seats {
    /// The stop that it is seen from, and whether its piece runs against the edge.
    at: u32,
    backward: bool,
    stops: [u32; 2],
    sites: [u32; 2],
}

/// An edge between the pieces along it and against it, seen from a stop.
struct Sides<'a> {
    sites: [&'a Site; 2],
    carriers: Carriers,
    /// Where the pieces begin and end.
    feet: [[&'a Foot; 2]; 2],
    /// Its ends and the radii there.
    ends: [Point; 2],
    radii: [f64; 2],
    /// How far from either end a place on it can be, but for round-off. The edge turns by a quarter at most,
    /// so it is nowhere farther from one end than the other end is.
    longest: f64,
    id: u32,
    stop: u32,
}

/// A place on its way to a crossing.
struct Approach {
    /// The number of its edge among those that are looked at together.
    sides: usize,
    /// The place, and the one that was looked at before or after it.
    places: [(Point, Below); 2],
    /// Which of them it is.
    at: usize,
    /// Whether another step would not help.
    done: bool,
}

/// Round-off of the distance to an element in the unit frame: eight roundings of numbers up to 1.
const RESIDUAL: f64 = 8.0 * f64::EPSILON;

impl Tracer<'_> {
    /// Where the level crosses the edges of some stops: the same places for their other sides.
    pub fn entries(&self, stops: &[u32]) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(stops.len());
        let (mut seats, mut sides, mut found) = (Vec::new(), Vec::new(), Vec::new());
        let (mut missing, mut approaches) = (Vec::new(), Vec::new());
        for stops in stops.chunks(AT_A_TIME) {
            sides.clear();
            seats.clear();
            seats.extend(stops.iter().map(|&at| self.seats(at)));
            sides.extend(seats.iter().map(|seats| self.sides(seats)));
            found.clear();
            found.extend(sides.iter().map(|sides| self.between_vertices(sides)));
            for start in [Tracer::start, Tracer::curved_start] {
                missing.clear();
                missing.extend((0..sides.len()).filter(|&i| found[i].is_none()));
                approaches.clear();
                let begun = |&i: &usize| self.begun(i, &sides[i], start(self, &sides[i]));
                approaches.extend(missing.iter().map(begun));
                self.follow(&sides, &mut approaches);
                for approach in &approaches {
                    found[approach.sides] = self.by_newton(&sides[approach.sides], approach);
                }
            }
            entries.extend(sides.iter().zip(found.drain(..)).map(|(s, found)| self.entry(s, found)));
        }
        entries
    }

    fn entry(&self, sides: &Sides, found: Option<Crossing>) -> Entry {
        let Crossing { center, normals } = found.unwrap_or_else(|| self.by_halving(sides));
        // The radius grows along the piece that enters.
        let inward = usize::from(sides.radii[0] > sides.radii[1]);
        let outward = 1 - inward;
        let turn = |side: usize, from: Vector, to: Vector| {
            if sides.sites[side].is_straight() { 0.0 } else { from.angle_to(to) }
        };
        Entry {
            stop: sides.stop,
            edge: sides.id,
            center,
            entering: turn(inward, normals[inward], sides.feet[inward][1].normal),
            leaving: turn(outward, sides.feet[outward][0].normal, normals[outward]),
        }
    }

    /// The stops of an edge that a stop begins at, along it and against it, and their sites.
    #[inline]
    fn seats(&self, at: u32) -> Seats {
        let way = self.way(at);
        let stops = if way.backward { [way.across, at] } else { [at, way.across] };
        Seats { at, backward: way.backward, stops, sites: stops.map(|s| self.stop(s).site) }
    }

    fn sides(&self, &Seats { at, backward, stops, sites }: &Seats) -> Sides<'_> {
        let sites = sites.map(|s| &self.mat.sites[s as usize]);
        let feet = stops.map(|s| [&self.stop(s).foot, self.circuit.end(&self.mat.sites, s)]);
        // Its ends as they follow one another along this side.
        let [from, to] = if backward { [at + 1, at] } else { [at, at + 1] };
        let radii = [from, to].map(|s| self.circuit.radii[s as usize]);
        let ends = [from, to].map(|s| self.stop(s).center);
        let id = self.stop(at).edge;
        let longest = ends[0].distance(ends[1]) + self.beyond;
        Sides { sites, carriers: Carriers::of(sites), feet, ends, radii, longest, id, stop: at }
    }

    /// The crossing by halving, which does not fail.
    fn by_halving(&self, sides: &Sides) -> Crossing {
        let [a, b] = self.mat.graph.edges[sides.id as usize].pieces;
        let [a, b] = [a, b].map(|p| self.mat.graph.piece(&self.mat.sites, p));
        let extent = |[from, to]: [&Foot; 2]| from.point.distance(to.point);
        let swap = extent(sides.feet[1]) > extent(sides.feet[0]);
        let (along, across) = if swap { (&b, &a) } else { (&a, &b) };
        let falls = (sides.radii[0] > sides.radii[1]) != swap;
        let track = Track::of(&self.mat.sites, along);
        let radius = |t: f64| track.reach(&self.mat.sites, across, &track.at(t)).0;
        let sign = if falls { 1.0 } else { -1.0 };
        let t = falling_root(0.0, 1.0, |t| {
            sign * if radius(t).is_finite() { radius(t) - self.d } else { self.d }
        });
        // The place at this distance from the one side is exact; the other's is made so as well.
        let mut exact = [self.begun(0, sides, track.at(t).center(self.d))];
        self.follow(std::slice::from_ref(sides), &mut exact);
        exact[0].crossing()
    }

    /// The crossing between two vertices, on the line halfway between them. They may be the sides of a
    /// hair-thin neck, seen from afar in nearly one direction, which tells nothing of the place across it.
    fn between_vertices(&self, sides: &Sides) -> Option<Crossing> {
        if !sides.sites.iter().all(|s| s.is_vertex) {
            return None;
        }
        let [v, w] = [0, 1].map(|i: usize| sides.sites[i].start.point);
        let half = 0.5 * v.distance(w);
        let away = (w - v).left() * (((self.d - half) * (self.d + half)).max(0.0).sqrt() / (2.0 * half));
        let toward = sides.ends[usize::from(sides.radii[0] <= sides.radii[1])] - v.midpoint(w);
        let c = v.midpoint(w) + if toward.dot(away) < 0.0 { -away } else { away };
        let normals = [0, 1].map(|i: usize| sides.sites[i].carrier_distance(c).1);
        c.is_finite().then_some(Crossing { center: c, normals })
    }

    /// The crossing that Newton's method led to, if it is certain to be that.
    fn by_newton(&self, sides: &Sides, approach: &Approach) -> Option<Crossing> {
        let Crossing { center, normals } = approach.crossing();
        let distances = approach.places[approach.at].1.distances;
        let is_on = |i: usize| {
            (distances[i] - self.d).abs() <= RESIDUAL
                && spans(sides.feet[i], sides.sites[i], center - normals[i] * distances[i], normals[i])
        };
        (is_on(0) && is_on(1)).then_some(Crossing { center, normals })
    }

    /// Where on a straight edge the radius would be `d` if it were steady.
    fn start(&self, sides: &Sides) -> Point {
        let ([from, to], [here, there]) = (sides.ends, sides.radii);
        from + (to - from) * ((self.d - here) / (there - here))
    }

    /// About where on a straight edge the radius is `d` if it grows as it does at the lower end, and evenly
    /// faster or slower from there on: nearer where the radius is smallest, and slower to find.
    fn curved_start(&self, sides: &Sides) -> Point {
        let low = usize::from(sides.radii[0] > sides.radii[1]);
        let (from, along) = (sides.ends[low], sides.ends[1 - low] - sides.ends[low]);
        let [rise, whole] = [self.d, sides.radii[1 - low]].map(|r| r - sides.radii[low]);
        // On either side the distance grows along the normal.
        let normals = sides.feet[0][low].normal + sides.feet[1][1 - low].normal;
        let growth = 0.5 * normals.dot(along);
        let root = (growth * growth + 4.0 * (whole - growth) * rise).max(0.0).sqrt();
        from + along * (2.0 * rise / (growth + root))
    }

    /// Begins Newton's method.
    fn begun(&self, number: usize, sides: &Sides, start: Point) -> Approach {
        let below = sides.carriers.below(start);
        let places = [(start, below); 2];
        Approach { sides: number, places, at: 0, done: self.worst(&below) <= f64::EPSILON * self.d }
    }

    /// Newton's method for several places to the end of each.
    fn follow(&self, sides: &[Sides], approaches: &mut [Approach]) {
        let mut open: [usize; AT_A_TIME] = std::array::from_fn(|i| i);
        let mut count = approaches.len();
        while count > 0 {
            let mut left = 0;
            for k in 0..count {
                let approach = &mut approaches[open[k]];
                if !approach.done {
                    self.step(&sides[approach.sides], approach);
                }
                open[left] = open[k];
                left += usize::from(!approach.done);
            }
            count = left;
        }
    }

    /// How far a place is off.
    #[inline]
    fn worst(&self, below: &Below) -> f64 {
        let [e0, e1] = below.distances.map(|s| (self.d - s).abs());
        e0.max(e1)
    }

    /// Newton's step for a place at distance `d` from two carriers, if it helps. Between walls that are
    /// parallel but for round-off it may lead anywhere along them, and must not leave the edge.
    #[inline]
    fn step(&self, sides: &Sides, approach: &mut Approach) {
        let (center, below) = &approach.places[approach.at];
        let [n0, n1] = below.normals;
        let [e0, e1] = below.distances.map(|s| self.d - s);
        let worst = e0.abs().max(e1.abs());
        let det = n0.cross(n1);
        let step = vector((e0 * n1.y - e1 * n0.y) / det, (e1 * n0.x - e0 * n1.x) / det);
        let mut next = *center + step;
        if step.length_squared() > self.d * worst {
            // A step so long, between circles that hardly cross, leads away from both by more than they
            // are off: back to one of them.
            let (distance, normal) = sides.sites[0].carrier_distance(next);
            next += normal * (self.d - distance);
        }
        let below = sides.carriers.below(next);
        let now = self.worst(&below);
        let converges = (now < 0.5 * worst) & sides.may_hold(next);
        // Nothing is moved, and nothing guessed: the next place has its own place here.
        approach.places[1 - approach.at] = (next, below);
        approach.at ^= usize::from(converges);
        approach.done = !converges | (now <= f64::EPSILON * self.d);
    }
}

impl Sides<'_> {
    /// Whether a place can lie on the edge.
    #[inline]
    fn may_hold(&self, c: Point) -> bool {
        let [a, b] = self.ends;
        let [x, y] = [f64x2::new([a.x - c.x, b.x - c.x]), f64x2::new([a.y - c.y, b.y - c.y])];
        (x * x + y * y).sqrt().simd_le(f64x2::splat(self.longest)).all()
    }
}

impl Approach {
    fn crossing(&self) -> Crossing {
        let (center, Below { normals, .. }) = self.places[self.at];
        Crossing { center, normals }
    }
}

/// Whether a foot with its normal lies between the ends of a piece.
fn spans([from, to]: [&Foot; 2], site: &Site, foot: Point, normal: Vector) -> bool {
    if site.is_vertex {
        // The normals round a reflex vertex turn clockwise.
        return from.normal.cross(normal) < 0.0 && normal.cross(to.normal) < 0.0;
    }
    (foot - from.point).dot(from.normal.right()) > 0.0 && (foot - to.point).dot(to.normal.right()) < 0.0
}
