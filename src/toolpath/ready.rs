//! Pockets made ready to be cut, many of them side by side.
//!
//! What a pocket needs before its first pass (ways along its axis, the order of its passes, how wide they cut)
//! depends on no other pocket; only the moves follow one another. Of thousands of small pockets some are made
//! ready at once, as many as have a number of sites together, so that the others take no memory yet.

use super::Job;
use super::path::{PocketPath, is_whole};
use super::plan::{IsClear, Planner, Prepared};
use super::rest::{Rest, rest};
use super::roads::Roads;
use crate::mat::Mat;
use crate::offset::{Level, Part};

/// Effort limit: sites of the pockets that are made ready at once, unless it is one pocket.
const SITES: usize = 1 << 14;

/// A pocket that is ready to be cut, and what is told of it.
pub(super) struct Ready<'a> {
    index: usize,
    most_retracts: usize,
    unreachable: Vec<Rest>,
    pocket: Prepared<'a>,
}

impl<'a> Ready<'a> {
    /// Makes a pocket ready, by its axis and its levels.
    pub fn new(
        planner: &Planner,
        index: usize,
        (mat, levels): (&'a Mat, &'a [Level]),
        is_clear: &'a IsClear<'a>,
    ) -> Ready<'a> {
        let job = planner.job;
        let along = || {
            let roads = Roads::new(mat);
            let rest = || rest(&roads, job.wall_distance(), job.overlap());
            let unreachable = if is_whole(mat) { rest() } else { Vec::new() };
            (roads, unreachable)
        };
        let (most_retracts, (roads, unreachable)) = rayon::join(|| most_retracts(job, mat, levels), along);
        let pocket = planner.prepare(levels, is_clear, Some(roads));
        Ready { index, most_retracts, unreachable, pocket }
    }

    /// Its number and what is to be cut; the rest is noted in its pocket.
    pub fn noted_in(self, pockets: &mut [PocketPath]) -> (usize, Prepared<'a>) {
        let own = &mut pockets[self.index];
        own.most_retracts = self.most_retracts;
        own.unreachable = self.unreachable;
        (self.index, self.pocket)
    }
}

/// Pockets in their order, as many at once as have a number of sites together.
pub(super) fn batches(mut order: &[usize], sites: impl Fn(usize) -> usize) -> impl Iterator<Item = &[usize]> {
    std::iter::from_fn(move || {
        let mut all = 0;
        let fits = |&&pocket: &&usize| {
            all += sites(pocket);
            all <= SITES
        };
        let count = order.iter().take_while(fits).count().max(1).min(order.len());
        let (some, others) = order.split_at(count);
        order = others;
        (!some.is_empty()).then_some(some)
    })
}

/// The bound on retracts that the peaks of the axis give.
fn most_retracts(job: &Job, mat: &Mat, levels: &[Level]) -> usize {
    let tree = mat.levels();
    let peaks = |level: &Level| {
        // A peak within round-off of a level is a ridge of it.
        let slack = job.overlap();
        let reached = |p: &&Part| p.children.is_empty() && p.peak.radius >= level.distance - slack;
        tree.parts.iter().filter(reached).count()
    };
    let rough = if job.finish > 0.0 && levels.len() > 1 { 1 } else { 0 };
    let wall = if rough > 0 { peaks(&levels[0]).saturating_sub(1) } else { 0 };
    levels.get(rough).map_or(0, |level| job.heights().len() * peaks(level) + wall)
}
