//! What the vertices of the axis are, and where the radius has its extrema.
//!
//! Between parallel walls the radius does not change, so extrema are *plateaus*: vertices joined by
//! edges of constant radius (to round-off). A plateau that only rises away is a neck, one that only
//! falls away a peak; their vertices of degree 2 are called so.

use super::Kind;
use super::graph::Graph;
use super::union::Sets;

/// Kind of every vertex, and whether it lies on a neck (also when it is a branch).
#[derive(Clone, Debug)]
pub(crate) struct Kinds {
    pub kinds: Vec<Kind>,
    pub on_neck: Vec<bool>,
    /// Whether no way leads up from its plateau.
    pub on_peak: Vec<bool>,
}

/// Which ways lead away from a plateau.
#[derive(Clone, Copy, Default)]
struct Ways {
    up: u32,
    down: u32,
}

impl Kinds {
    pub fn of(graph: &Graph) -> Kinds {
        let n = graph.disks.len();
        let mut degree = vec![0u32; n];
        let mut plateau = Sets::singles(n);
        for edge in &graph.edges {
            let [a, b] = edge.disks;
            degree[a as usize] += 1;
            degree[b as usize] += 1;
            if is_level(graph, a, b) {
                plateau.unite(a, b);
            }
        }
        let mut ways = vec![Ways::default(); n];
        for edge in &graph.edges {
            let [a, b] = edge.disks;
            if is_level(graph, a, b) {
                continue;
            }
            let (low, high) = if radius(graph, a) < radius(graph, b) { (a, b) } else { (b, a) };
            ways[plateau.find(low) as usize].up += 1;
            ways[plateau.find(high) as usize].down += 1;
        }
        let mut kinds = Vec::with_capacity(n);
        let mut on_neck = Vec::with_capacity(n);
        let mut on_peak = Vec::with_capacity(n);
        for (i, &degree) in degree.iter().enumerate() {
            let way = ways[plateau.find(i as u32) as usize];
            let neck = way.down == 0 && way.up >= 2;
            let peak = way.up == 0 && way.down > 0;
            on_neck.push(neck && graph.disks[i].radius > graph.error);
            on_peak.push(way.up == 0);
            kinds.push(match degree {
                0 => Kind::Peak,
                1 => Kind::Leaf,
                2 if neck => Kind::Neck,
                2 if peak => Kind::Peak,
                2 => Kind::Joint,
                _ => Kind::Branch,
            });
        }
        Kinds { kinds, on_neck, on_peak }
    }
}

fn radius(graph: &Graph, i: u32) -> f64 {
    graph.disks[i as usize].radius
}

fn is_level(graph: &Graph, a: u32, b: u32) -> bool {
    (radius(graph, a) - radius(graph, b)).abs() <= graph.error
}
