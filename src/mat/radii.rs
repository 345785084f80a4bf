//! Where on the axis the radius takes a value, without looking at all of it.

use super::graph::Graph;
use super::kinds::Kinds;
use super::site::NONE;

/// Index of edges, boundary rings and peaks by radius.
#[derive(Clone, Debug)]
pub(crate) struct Radii {
    /// Edges sorted by their smaller radius.
    low: Vec<(f64, u32)>,
    /// Binary tree over that order, from the root: the greatest radius below each node.
    high: Vec<f64>,
    /// One piece of every ring of the boundary, with the smallest radius along it.
    pub rings: Vec<(u32, f64)>,
    /// Vertices on peaks, sorted by radius.
    peaks: Vec<(f64, u32)>,
    /// Radii closer than this are equal.
    error: f64,
}

impl Radii {
    pub fn of(graph: &Graph, kinds: &Kinds) -> Radii {
        let ends = |e: u32| graph.edges[e as usize].disks.map(|d| graph.disks[d as usize].radius);
        let mut low: Vec<(f64, u32)> =
            (0..graph.edges.len() as u32).map(|e| (ends(e)[0].min(ends(e)[1]), e)).collect();
        low.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let leaves = low.len().next_power_of_two();
        let mut high = vec![f64::NEG_INFINITY; 2 * leaves];
        for (i, &(_, e)) in low.iter().enumerate() {
            high[leaves + i] = ends(e)[0].max(ends(e)[1]);
        }
        for i in (1..leaves).rev() {
            high[i] = high[2 * i].max(high[2 * i + 1]);
        }
        let on_peak = |i: &u32| kinds.on_peak[*i as usize];
        let mut peaks: Vec<(f64, u32)> = (0..graph.disks.len() as u32)
            .filter(on_peak)
            .map(|i| (graph.disks[i as usize].radius, i))
            .collect();
        peaks.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Radii { low, high, rings: rings(graph), peaks, error: graph.error }
    }

    /// Edges whose radii reach from below or at `d` to `d` or above, to round-off, in order of id.
    pub fn edges_at(&self, d: f64) -> Vec<u32> {
        let end = self.low.partition_point(|&(low, _)| low <= d + self.error);
        let leaves = self.high.len() / 2;
        let mut found = Vec::new();
        let mut open = vec![(1usize, 0usize, leaves)];
        while let Some((node, first, count)) = open.pop() {
            if first >= end || self.high[node] < d - self.error {
                continue;
            }
            if count == 1 {
                found.push(self.low[first].1);
                continue;
            }
            open.push((2 * node, first, count / 2));
            open.push((2 * node + 1, first + count / 2, count / 2));
        }
        found.sort_unstable();
        found
    }

    /// Vertices on peaks of radius `d`, to round-off.
    pub fn peaks_at(&self, d: f64) -> impl Iterator<Item = u32> + '_ {
        let first = self.peaks.partition_point(|&(r, _)| r < d - self.error);
        self.peaks[first..].iter().take_while(move |(r, _)| *r <= d + self.error).map(|&(_, i)| i)
    }
}

/// Walks around the boundary.
fn rings(graph: &Graph) -> Vec<(u32, f64)> {
    let mut seen = vec![false; graph.pieces.len()];
    let mut rings = Vec::new();
    let mut lone = graph.lone_disks().into_iter().map(|d| graph.disks[d as usize].radius);
    for first in 0..graph.pieces.len() as u32 {
        // What stands for a crossing of a link is no piece; nothing leads to it.
        if seen[first as usize] || graph.pieces[first as usize].next == NONE {
            continue;
        }
        let (mut at, mut least) = (first, f64::INFINITY);
        while !seen[at as usize] {
            seen[at as usize] = true;
            let piece = &graph.pieces[at as usize];
            if piece.edge != NONE {
                let radii = graph.edges[piece.edge as usize].disks.map(|d| graph.disks[d as usize].radius);
                least = least.min(radii[0]).min(radii[1]);
            }
            at = piece.next;
        }
        // A ring without edges is all contact arc: the pocket, or a part of it, is one disk.
        rings.push((first, if least.is_finite() { least } else { lone.next().unwrap_or(0.0) }));
    }
    rings
}
