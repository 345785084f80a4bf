//! Whether two axes are one but for a similarity of the plane and the names of sites.
//!
//! Two axes of one pocket need not have the same vertices. Where round-off breaks a tie of many
//! contacts, edges as short as round-off stand for one vertex; and vertices of degree 2 whose edges
//! lie between the same two sites are where an arc was split to quarter turns, where a hole is
//! linked, or where a radius that is as good as constant has its extremum. So the former are
//! contracted and the latter dissolved, and then the graphs must be the same: vertices by place and
//! radius, edges by their ends and sites.
#![allow(dead_code)]

use medial::{ArcSpline, AxisEdge, Mat, Pocket, Point, SiteKind, SiteRef};
use std::collections::HashMap;

/// How one axis goes over to another.
pub struct Map<'a> {
    /// Where a place goes.
    pub place: &'a dyn Fn(Point) -> Point,
    /// By how much lengths grow.
    pub scale: f64,
    /// What a site is called over there.
    pub site: &'a dyn Fn(SiteRef) -> SiteRef,
}

/// Ties are contracted at these parts of the distance allowed; where an edge is as long as one of
/// them by chance, it is not as long as another.
const TIES: [f64; 6] = [0.25, 0.07, 0.02, 0.005, 0.9, 3.0];

/// Where sites are short or nearly parallel, round-off of the drawing moves a vertex farther than
/// others. Up to this many times the distance allowed it is the same if its disk is as good over there.
const LOOSE: f64 = 1e4;

/// How much less than the distance allowed the radius of such a disk may differ from the distance.
const AS_GOOD: f64 = 1e-3;

/// Largest distance of vertices of `b` from those of `a` that they stand for, in units of `b`; or
/// what is different. Vertices farther apart than `within` are different ones, unless a disk is as
/// good in either place.
pub fn deviation(a: &Mat, b: &Mat, map: &Map<'_>, within: f64) -> Result<f64, String> {
    let same = |p: Point| p;
    let name = |s: SiteRef| s;
    let here = Map { place: &same, scale: 1.0, site: &name };
    let mut first = None;
    for tie in TIES {
        let reduced = [(a, map), (b, &here)].map(|(mat, map)| Graph::of(mat, map).reduced(tie * within));
        match compare(&reduced[0], &reduced[1], b, within) {
            Ok(worst) => return Ok(worst),
            Err(difference) => first = first.or(Some(difference)),
        }
    }
    Err(first.unwrap_or_default())
}

/// A site in an order.
type Name = (u32, u32, u8);

fn name(site: SiteRef) -> Name {
    let kind = match site.kind {
        SiteKind::Segment => 0,
        SiteKind::Arc => 1,
        SiteKind::Vertex => 2,
    };
    (site.loop_index, site.element, kind)
}

/// A place and the radius there.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    place: Point,
    radius: f64,
}

impl Vertex {
    fn distance(&self, other: &Vertex) -> f64 {
        self.place.distance(other.place) + (self.radius - other.radius).abs()
    }
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [usize; 2],
    sites: [Name; 2],
    /// How far it leads away from where it begins, at least.
    length: f64,
}

struct Graph {
    vertices: Vec<Vertex>,
    edges: Vec<Edge>,
}

impl Graph {
    fn of(mat: &Mat, map: &Map<'_>) -> Graph {
        let vertex =
            |disk: medial::Disk| Vertex { place: (map.place)(disk.center), radius: map.scale * disk.radius };
        let vertices: Vec<Vertex> = mat.vertices().iter().map(|v| vertex(v.disk)).collect();
        let edge = |e: &AxisEdge| {
            let mut sites = e.sites.map(|s| name((map.site)(s)));
            sites.sort_unstable();
            let ends = [e.from as usize, e.to as usize];
            let [start, control, end] = e.points;
            let bow = map.scale * control.distance(start).min(control.distance(end));
            Edge { ends, sites, length: vertices[ends[0]].distance(&vertices[ends[1]]).max(bow) }
        };
        let edges = mat.edges().iter().map(edge).collect();
        Graph { vertices, edges }
    }

    /// Ties contracted, then joints dissolved.
    fn reduced(self, tie: f64) -> Graph {
        self.contracted(tie).dissolved()
    }

    /// The ends of edges not longer than `tie` are one vertex.
    fn contracted(self, tie: f64) -> Graph {
        let mut parent: Vec<usize> = (0..self.vertices.len()).collect();
        fn find(parent: &mut [usize], mut i: usize) -> usize {
            while parent[i] != i {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            i
        }
        let (short, long): (Vec<Edge>, Vec<Edge>) = self.edges.iter().partition(|e| e.length <= tie);
        for edge in &short {
            let [a, b] = edge.ends.map(|v| find(&mut parent, v));
            parent[a.max(b)] = a.min(b);
        }
        let edge = |e: Edge| Edge { ends: e.ends.map(|v| find(&mut parent, v)), ..e };
        Graph { edges: long.into_iter().map(edge).collect(), vertices: self.vertices }
    }

    /// Vertices of degree 2 between edges of the same sites are gone.
    fn dissolved(mut self) -> Graph {
        let mut at: Vec<Vec<usize>> = vec![Vec::new(); self.vertices.len()];
        for (i, edge) in self.edges.iter().enumerate() {
            edge.ends.iter().for_each(|&v| at[v].push(i));
        }
        let mut gone = vec![false; self.edges.len()];
        for v in 0..self.vertices.len() {
            let [e, f] = at[v][..] else { continue };
            if e == f || self.edges[e].sites != self.edges[f].sites {
                continue;
            }
            let other = |edge: &Edge| if edge.ends[0] == v { edge.ends[1] } else { edge.ends[0] };
            let (u, w) = (other(&self.edges[e]), other(&self.edges[f]));
            self.edges[e].ends = [u, w];
            gone[f] = true;
            for i in at[w].iter_mut().filter(|i| **i == f) {
                *i = e;
            }
            at[v].clear();
        }
        let mut kept = gone.iter().map(|g| !g);
        self.edges.retain(|_| kept.next().unwrap_or(false));
        let used: Vec<bool> = at.iter().map(|edges| !edges.is_empty()).collect();
        let mut number = vec![0; self.vertices.len()];
        let mut vertices = Vec::new();
        // The axis of a disk is one vertex without edges.
        for (i, vertex) in
            self.vertices.iter().enumerate().filter(|(i, _)| used[*i] || self.edges.is_empty() && *i == 0)
        {
            number[i] = vertices.len();
            vertices.push(*vertex);
        }
        self.edges.iter_mut().for_each(|e| e.ends = e.ends.map(|v| number[v]));
        Graph { vertices, edges: self.edges }
    }
}

/// Largest distance of matched vertices, or the first difference.
fn compare(a: &Graph, b: &Graph, mat: &Mat, within: f64) -> Result<f64, String> {
    let (found, worst) = matched(a, b, mat, within)?;
    if a.vertices.len() != b.vertices.len() {
        return Err(format!("{} vertices became {}", a.vertices.len(), b.vertices.len()));
    }
    let key = |ends: [usize; 2], sites| {
        let [u, v] = ends;
        ([u.min(v), u.max(v)], sites)
    };
    let mut here: Vec<_> = a.edges.iter().map(|e| key(e.ends.map(|v| found[v]), e.sites)).collect();
    let mut there: Vec<_> = b.edges.iter().map(|e| key(e.ends, e.sites)).collect();
    here.sort_unstable();
    there.sort_unstable();
    if here == there {
        return Ok(worst);
    }
    let only = |one: &[([usize; 2], [Name; 2])], other: &[([usize; 2], [Name; 2])]| {
        let edge = one.iter().find(|e| other.binary_search(e).is_err());
        edge.map(|(ends, sites)| format!("{:?} between {sites:?}", ends.map(|v| b.vertices[v])))
    };
    Err(format!("edges are not the same: {:?} became {:?}", only(&here, &there), only(&there, &here)))
}

/// For every vertex of `a` the nearest of `b` that no other has taken, and the largest distance.
fn matched(a: &Graph, b: &Graph, mat: &Mat, within: f64) -> Result<(Vec<usize>, f64), String> {
    let mut order: Vec<usize> = (0..b.vertices.len()).collect();
    order.sort_unstable_by(|&i, &j| b.vertices[i].place.x.total_cmp(&b.vertices[j].place.x));
    let mut taken = vec![false; b.vertices.len()];
    let mut worst = 0.0f64;
    let mut found = Vec::with_capacity(a.vertices.len());
    for vertex in &a.vertices {
        let nearest = |reach: f64| {
            let first = order.partition_point(|&i| b.vertices[i].place.x < vertex.place.x - reach);
            let last = order.partition_point(|&i| b.vertices[i].place.x <= vertex.place.x + reach);
            let free = order[first..last].iter().filter(|i| !taken[**i]);
            let near = free.map(|&i| (b.vertices[i].distance(vertex), i)).filter(|(d, _)| *d <= reach);
            near.min_by(|i, j| i.0.total_cmp(&j.0))
        };
        let as_good = || (mat.distance(vertex.place) - vertex.radius).abs() <= AS_GOOD * within;
        let close = nearest(within);
        let Some((distance, i)) = close.or_else(|| nearest(LOOSE * within).filter(|_| as_good())) else {
            return Err(format!("{vertex:?} has no counterpart"));
        };
        if close.is_some() {
            worst = worst.max(distance);
        }
        taken[i] = true;
        found.push(i);
    }
    Ok((found, worst))
}

/// The sites of one pocket by their names in another that is drawn with the same vertices, though in
/// another order, direction or place.
pub struct Names(HashMap<(u32, u32, bool), (u32, u32)>);

impl Names {
    /// `None` when a loop has no counterpart whose vertices are those of it, to `within`.
    pub fn between(a: &Pocket, b: &Pocket, place: &dyn Fn(Point) -> Point, within: f64) -> Option<Names> {
        let mut names = HashMap::new();
        for (l, here) in (0u32..).zip(a.loops()) {
            let n = here.vertices.len();
            let vertices: Vec<Point> = here.vertices.iter().map(|v| place(v.point)).collect();
            let middles: Vec<Point> = here.elements().map(|e| place(e.midpoint())).collect();
            let fits = |there: &ArcSpline, turn: Turn| {
                (0..n).all(|i| {
                    there.vertices[turn.vertex(i)].point.distance(vertices[i]) <= within
                        && there.element(turn.element(i)).midpoint().distance(middles[i]) <= within
                })
            };
            let turns = (0..n).flat_map(|first| [false, true].map(|backward| Turn { first, n, backward }));
            let loops = (0u32..).zip(b.loops()).filter(|(_, there)| there.vertices.len() == n);
            let (m, turn) = loops
                .flat_map(|(m, there)| turns.clone().map(move |turn| (m, there, turn)))
                .find(|(_, there, turn)| fits(there, *turn))
                .map(|(m, _, turn)| (m, turn))?;
            for i in 0..n {
                names.insert((l, i as u32, true), (m, turn.vertex(i) as u32));
                names.insert((l, i as u32, false), (m, turn.element(i) as u32));
            }
        }
        Some(Names(names))
    }

    /// The other name of a site.
    pub fn of(&self, site: SiteRef) -> SiteRef {
        let key = (site.loop_index, site.element, site.kind == SiteKind::Vertex);
        let (loop_index, element) = self.0[&key];
        SiteRef { loop_index, element, ..site }
    }
}

/// A loop of `n` vertices as it begins at another vertex and perhaps runs backward.
#[derive(Clone, Copy)]
struct Turn {
    first: usize,
    n: usize,
    backward: bool,
}

impl Turn {
    fn vertex(&self, i: usize) -> usize {
        if self.backward { (self.first + self.n - i % self.n) % self.n } else { (self.first + i) % self.n }
    }

    /// The element that leads away from a vertex leads to it on the way back.
    fn element(&self, i: usize) -> usize {
        self.vertex(if self.backward { i + 1 } else { i })
    }
}
