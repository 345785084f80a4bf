//! Where on the axis the radius takes a value, without looking at all of it.

use super::circuit::Circuit;
use super::graph::Graph;
use super::kinds::Kinds;
use super::site::Site;
use std::ops::Range;
use wide::f64x2;

/// Index of the boundary and of peaks by radius.
#[derive(Clone, Debug)]
pub(crate) struct Radii {
    pub circuit: Circuit,
    /// Least and greatest radius from the first stop of each block to that after its last one; then those
    /// of blocks of such blocks, up to one.
    blocks: Vec<Vec<[f64; 2]>>,
    /// Vertices on peaks, sorted by radius.
    peaks: Vec<(f64, u32)>,
    /// Radii closer than this are equal.
    error: f64,
}

/// Stops to a block: as many as are compared in the time that it takes to come to another block.
const BLOCK: usize = 16;

impl Radii {
    pub fn of(sites: &[Site], graph: &Graph, kinds: &Kinds) -> Radii {
        let circuit = Circuit::of(sites, graph);
        let on_peak = |i: &u32| kinds.on_peak[*i as usize];
        let mut peaks: Vec<(f64, u32)> = (0..graph.disks.len() as u32)
            .filter(on_peak)
            .map(|i| (graph.disks[i as usize].radius, i))
            .collect();
        peaks.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Radii { blocks: blocks(&circuit.radii), circuit, peaks, error: graph.error }
    }

    /// Shows the stops, in the order of the boundary, from which the radius comes to more than `d`, and those
    /// from which or to which it is `d`, to round-off.
    pub fn search(&self, d: f64, rises: impl FnMut(u32), equals: impl FnMut(u32)) {
        let mut search = Search { radii: self, d, rises, equals };
        if let Some(top) = self.blocks.len().checked_sub(1) {
            search.blocks(top, 0..self.blocks[top].len());
        }
    }

    /// Vertices on peaks of radius `d`, to round-off.
    pub fn peaks_at(&self, d: f64) -> impl Iterator<Item = u32> + '_ {
        let first = self.peaks.partition_point(|&(r, _)| r < d - self.error);
        self.peaks[first..].iter().take_while(move |(r, _)| *r <= d + self.error).map(|&(_, i)| i)
    }
}

/// A search for a radius.
struct Search<'a, R, E> {
    radii: &'a Radii,
    d: f64,
    rises: R,
    equals: E,
}

impl<R: FnMut(u32), E: FnMut(u32)> Search<'_, R, E> {
    /// In some blocks of one size.
    fn blocks(&mut self, depth: usize, range: Range<usize>) {
        let [low, high] = [self.d - self.radii.error, self.d + self.radii.error];
        let blocks = &self.radii.blocks[depth];
        for i in range {
            if blocks[i][0] > high || blocks[i][1] < low {
                continue;
            }
            match depth.checked_sub(1) {
                None => self.stops(i),
                Some(below) => {
                    let end = ((i + 1) * BLOCK).min(self.radii.blocks[below].len());
                    self.blocks(below, i * BLOCK..end);
                }
            }
        }
    }

    /// In one block of stops, a bit for each.
    fn stops(&mut self, block: usize) {
        let first = block * BLOCK;
        let radii = &self.radii.circuit.radii[first..];
        let radii = &radii[..radii.len().min(BLOCK + 1)];
        let [d, error, above] = [self.d, self.radii.error, self.d + self.radii.error].map(f64x2::splat);
        let (mut larger, mut equal) = (0u32, 0u32);
        for (i, pair) in radii.chunks(2).enumerate() {
            // One alone stands for both, and the second bit is beyond the last stop.
            let pair = f64x2::new([pair[0], pair[pair.len() - 1]]);
            larger |= pair.simd_gt(above).to_bitmask() << (2 * i);
            equal |= (pair - d).abs().simd_le(error).to_bitmask() << (2 * i);
        }
        let all = (1 << (radii.len() - 1)) - 1;
        bits(!larger & (larger >> 1) & all).for_each(|i| (self.rises)(first as u32 + i));
        bits((equal | equal >> 1) & all).for_each(|i| (self.equals)(first as u32 + i));
    }
}

/// The bits that are set.
fn bits(mut word: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let lowest = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (lowest < u32::BITS).then_some(lowest)
    })
}

fn blocks(radii: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let around = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let starts = (0..radii.len().saturating_sub(1)).step_by(BLOCK);
    let first = starts.map(|i| {
        let members = &radii[i..(i + BLOCK + 1).min(radii.len())];
        members.iter().fold(none, |all, &r| around(all, [r, r]))
    });
    let mut blocks: Vec<Vec<[f64; 2]>> = vec![first.collect()];
    while blocks[blocks.len() - 1].len() > 1 {
        let members = blocks[blocks.len() - 1].chunks(BLOCK);
        blocks.push(members.map(|of| of.iter().fold(none, |all, &b| around(all, b))).collect());
    }
    blocks
}
