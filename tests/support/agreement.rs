//! Whether two axes are the same: the same combinatorics up to ties, and vertices in the same places.
//!
//! Where more sites meet in one disk than three, or nearly so, round-off decides what short edges hold
//! the branch together; and a vertex between two parts of one element, or at an extremum of the radius,
//! is there or not as the builder likes. So vertices of either axis that are one place (and radius) to
//! [`SAME`] are one *knot*, edges inside a knot count for nothing, and a knot where an edge only goes on
//! between the same two elements is no knot. What is left must be equal, edge by edge: the knots at its
//! ends and the elements on its sides.
//!
//! Where three elements define a branch badly, two corners of a few seconds of arc say, its place is
//! uncertain by more than that although both disks are right to round-off. So much is allowed to two
//! branches of the same three elements.
#![allow(dead_code)]

use medial::{AxisEdge, AxisVertex, Mat, Point, SiteRef, Vector};
use std::collections::HashMap;

/// Distance of two places that are the same, relative to the size.
pub const SAME: f64 = 1e-9;

/// The vertices and edges of an axis.
#[derive(Clone)]
pub struct Axis {
    pub vertices: Vec<AxisVertex>,
    pub edges: Vec<AxisEdge>,
}

impl Axis {
    pub fn of(mat: &Mat) -> Axis {
        Axis { vertices: mat.vertices(), edges: mat.edges() }
    }

    /// Diagonal of the box around all disks.
    pub fn size(&self) -> f64 {
        let extent = |along: fn(&AxisVertex) -> f64| {
            let low = self.vertices.iter().map(|v| along(v) - v.disk.radius).fold(f64::INFINITY, f64::min);
            let high = self.vertices.iter().map(|v| along(v) + v.disk.radius).fold(-f64::INFINITY, f64::max);
            high - low
        };
        extent(|v| v.disk.center.x).hypot(extent(|v| v.disk.center.y))
    }
}

/// What two axes disagree in, if anything: the first difference with its place.
pub fn disagreement(a: &Mat, b: &Mat) -> Option<String> {
    difference(&Axis::of(a), &Axis::of(b))
}

/// The same for axes as they are read.
pub fn difference(a: &Axis, b: &Axis) -> Option<String> {
    let near = SAME * a.size();
    let knots = Knots::of(a, b, near);
    let n = a.vertices.len();
    let (of_a, of_b) = (Net::of(a, &knots.number[..n]), Net::of(b, &knots.number[n..]));
    let name = |strand: &Strand| {
        let at = |knot: Option<usize>| knot.map_or("a loop".to_owned(), |k| knots.place[k].to_string());
        format!("edge from {} to {} between {:?} and {:?}", at(strand.0), at(strand.1), strand.2, strand.3)
    };
    let (left, right) = (of_a.strands(), of_b.strands());
    for (these, those, which) in [(&left, &right, "first"), (&right, &left, "second")] {
        if let Some(strand) = first_missing(these, those) {
            let counts = format!("{} and {} edges", left.len(), right.len());
            return Some(format!("only the {which} axis has an {} ({counts})", name(strand)));
        }
    }
    let (left, right) = (of_a.lonely(), of_b.lonely());
    (left != right).then(|| format!("lonely vertices differ: {left:?} and {right:?}"))
}

/// The first of some sorted strands that is not among others, each counted.
fn first_missing<'a>(these: &'a [Strand], those: &[Strand]) -> Option<&'a Strand> {
    let mut rest = those.iter().peekable();
    these.iter().find(|strand| {
        while rest.next_if(|other| other < strand).is_some() {}
        rest.next_if_eq(strand).is_none()
    })
}

/// Vertices of two axes by places: the number of the knot of each, those of the second axis after
/// those of the first.
struct Knots {
    number: Vec<usize>,
    place: Vec<Point>,
}

impl Knots {
    fn of(a: &Axis, b: &Axis, near: f64) -> Knots {
        let disks: Vec<_> = a.vertices.iter().chain(&b.vertices).map(|v| v.disk).collect();
        let mut up: Vec<usize> = (0..disks.len()).collect();
        let one = |i: usize, j: usize| {
            let (p, q) = (disks[i], disks[j]);
            p.center.distance(q.center) <= near && (p.radius - q.radius).abs() <= near
        };
        let mut cells: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        for (i, d) in disks.iter().enumerate() {
            let [x, y] = [d.center.x, d.center.y].map(|c| (c / near).floor() as i64);
            for cell in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy])) {
                for &j in cells.get(&cell).into_iter().flatten().filter(|&&j| one(i, j)) {
                    unite(&mut up, i, j);
                }
            }
            cells.entry([x, y]).or_default().push(i);
        }
        let shift = a.vertices.len();
        for (edges, shift) in [(&a.edges, 0), (&b.edges, shift)] {
            for e in edges {
                let [i, j] = [e.from, e.to].map(|v| v as usize + shift);
                if one(i, j) {
                    unite(&mut up, i, j);
                }
            }
        }
        let branches = |axis, shift: usize| branches(axis).into_iter().map(move |b| (b.vertex + shift, b));
        let of_b: HashMap<_, _> = branches(b, shift).map(|(j, branch)| (branch.sides, j)).collect();
        for (i, branch) in branches(a, 0) {
            if let Some(&j) = of_b.get(&branch.sides) {
                let apart =
                    disks[i].center.distance(disks[j].center) + (disks[i].radius - disks[j].radius).abs();
                if apart <= branch.uncertain * near {
                    unite(&mut up, i, j);
                }
            }
        }
        let number: Vec<usize> = (0..disks.len()).map(|i| root(&up, i)).collect();
        Knots { number, place: disks.iter().map(|d| d.center).collect() }
    }
}

/// Roundings in a disk, times those in a drawn coordinate.
const ROUNDINGS: f64 = 64.0;

/// A vertex of three edges.
struct Branch {
    vertex: usize,
    /// The three elements, in order.
    sides: Vec<Side>,
    /// Round-off of its place, in units of [`SAME`].
    uncertain: f64,
}

/// The vertices of three edges, with what round-off makes of them.
///
/// The edges halve the angles between the normals, so the triangle of the normals has twice the area
/// `4 sin A sin B sin C` with the angles between edges, and its longest side is twice the greatest of
/// the three sines. A disk is computed by a division by the one and a multiplication by the other.
fn branches(axis: &Axis) -> Vec<Branch> {
    let mut edges_at = vec![Vec::new(); axis.vertices.len()];
    for e in &axis.edges {
        let sides = [side(e.sites[0]), side(e.sites[1])];
        edges_at[e.from as usize].push((e.points[1] - e.points[0], sides));
        edges_at[e.to as usize].push((e.points[1] - e.points[2], sides));
    }
    let branch = |(vertex, edges): (usize, &Vec<(Vector, [Side; 2])>)| {
        let &[(u, s), (v, t), (w, r)] = edges.as_slice() else { return None };
        let sines = [(u, v), (v, w), (w, u)].map(|(a, b)| a.unit().cross(b.unit()).abs());
        let longest = sines.into_iter().fold(0.0, f64::max);
        let area: f64 = sines.iter().product();
        let mut sides = [s, t, r].concat();
        sides.sort_unstable();
        sides.dedup();
        Some(Branch { vertex, sides, uncertain: ROUNDINGS * f64::EPSILON * longest / area / SAME })
    };
    edges_at.iter().enumerate().filter_map(branch).collect()
}

fn root(up: &[usize], mut i: usize) -> usize {
    while up[i] != i {
        i = up[i];
    }
    i
}

fn unite(up: &mut [usize], i: usize, j: usize) {
    let (i, j) = (root(up, i), root(up, j));
    up[i.max(j)] = i.min(j);
}

/// An element as it can be sorted.
type Side = (u32, u32, u8);

/// An edge: the knots at its ends (none for a loop without a knot), the elements on its left and right.
type Strand = (Option<usize>, Option<usize>, Side, Side);

fn side(site: SiteRef) -> Side {
    (site.loop_index, site.element, site.kind as u8)
}

/// The edges between knots.
struct Net {
    strands: Vec<Option<Strand>>,
    /// Ends of strands at every knot, each with whether it is the first end.
    ends: HashMap<usize, Vec<(usize, bool)>>,
}

impl Net {
    fn of(axis: &Axis, knots: &[usize]) -> Net {
        let mut net = Net { strands: Vec::new(), ends: HashMap::new() };
        knots.iter().for_each(|&k| _ = net.ends.entry(k).or_default());
        for e in &axis.edges {
            let [from, to] = [e.from, e.to].map(|v| knots[v as usize]);
            let strand = (Some(from), Some(to), side(e.sites[0]), side(e.sites[1]));
            // An edge that returns to where it began is short, or it is a loop around an island.
            let middle = e.points[0].distance(e.points[1]).max(e.points[0].distance(e.points[2]));
            if from == to && middle <= SAME * axis.size() {
                continue;
            }
            for (knot, first) in [(from, true), (to, false)] {
                net.ends.entry(knot).or_default().push((net.strands.len(), first));
            }
            net.strands.push(Some(strand));
        }
        let mut all: Vec<usize> = net.ends.keys().copied().collect();
        all.sort_unstable();
        all.into_iter().for_each(|knot| net.dissolve(knot));
        net
    }

    /// Makes one strand of two that go on between the same elements.
    fn dissolve(&mut self, knot: usize) {
        let &[(i, i_first), (j, j_first)] = self.ends[&knot].as_slice() else { return };
        let towards = |s: Strand, reversed: bool| if reversed { (s.1, s.0, s.3, s.2) } else { s };
        let (s, t) = (self.strands[i].expect("a live strand"), self.strands[j].expect("a live strand"));
        // The first runs towards the knot, the second away from it.
        let (s, t) = (towards(s, i_first), towards(t, !j_first));
        if (s.2, s.3) != (t.2, t.3) {
            return;
        }
        if i == j {
            self.strands[i] = Some((None, None, s.2.min(s.3), s.2.max(s.3)));
            return;
        }
        self.strands[i] = Some((s.0, t.1, s.2, s.3));
        self.strands[j] = None;
        self.ends.remove(&knot);
        let ends_at = |knot: Option<usize>| knot.expect("a strand that is no loop");
        for (at, old, new) in
            [(ends_at(s.0), (i, !i_first), (i, true)), (ends_at(t.1), (j, !j_first), (i, false))]
        {
            let ends = self.ends.get_mut(&at).expect("a known knot");
            ends.iter_mut().filter(|e| **e == old).for_each(|e| *e = new);
        }
    }

    /// All strands, each from its smaller knot, in order.
    fn strands(&self) -> Vec<Strand> {
        let turned = |&(from, to, left, right): &Strand| {
            let other = (to, from, right, left);
            other.min((from, to, left, right))
        };
        let mut strands: Vec<Strand> = self.strands.iter().flatten().map(turned).collect();
        strands.sort_unstable();
        strands
    }

    /// Knots without an edge, in order.
    fn lonely(&self) -> Vec<usize> {
        let mut lonely: Vec<usize> =
            self.ends.iter().filter(|(_, ends)| ends.is_empty()).map(|(&knot, _)| knot).collect();
        lonely.sort_unstable();
        lonely
    }
}
