//! Stretches of a level that no loop passes, put together to parts.

use super::level::Judge;
use super::report::{Fault, FaultKind};
use crate::geom::{ArcSpline, Bounds, Element, Point};
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// A missing stretch within one element, and its place that is farthest from all loops.
pub(super) struct Gap {
    pub element: Element,
    pub at: Point,
    pub by: f64,
}

/// Gaps are followed to their ends up to this share of their length: see `missing` and
/// [`change`](super::phantom::change), which halves twelve times.
const SHARE: f64 = 1.0 / 1024.0;

/// As many gaps that begin near the end of another are looked at for the one that follows.
const CANDIDATES: usize = 8;

/// The faults that gaps are: those that follow each other are one, the longest first.
pub(super) fn parts(judge: &Judge, gaps: &[Gap]) -> Vec<Fault> {
    let follow = follow(judge, gaps);
    let mut is_followed = vec![false; gaps.len()];
    follow.iter().flatten().for_each(|&i| is_followed[i] = true);
    let mut seen = vec![false; gaps.len()];
    let mut parts = Vec::new();
    // Chains from their first gap; what is left over are whole loops.
    let firsts = (0..gaps.len()).filter(|&i| !is_followed[i]);
    for first in firsts.chain(0..gaps.len()) {
        let mut chain: Vec<&Gap> = Vec::new();
        let mut next = Some(first);
        while let Some(i) = next.filter(|&i| !seen[i]) {
            seen[i] = true;
            chain.push(&gaps[i]);
            next = follow[i];
        }
        if !chain.is_empty() {
            parts.push(fault(&chain, next == Some(first)));
        }
    }
    parts.sort_by(|a, b| b.length.total_cmp(&a.length));
    parts
}

/// Which gap begins where each one ends.
fn follow(judge: &Judge, gaps: &[Gap]) -> Vec<Option<usize>> {
    let starts = gaps.iter().enumerate();
    let starts = starts.map(|(i, g)| GeomWithData::new([g.element.start.x, g.element.start.y], i));
    let tree = RTree::bulk_load(starts.collect());
    let mut taken = vec![false; gaps.len()];
    gaps.iter()
        .enumerate()
        .map(|(i, gap)| {
            let end = gap.element.end;
            // Each end of a gap stops short of what the loops pass by the margin of the search.
            let reach = |o: &Gap| SHARE * (gap.element.length() + o.element.length()) + 4.0 * judge.within;
            let near = tree.nearest_neighbor_iter(&[end.x, end.y]).map(|o| o.data);
            let follows =
                |&o: &usize| o != i && !taken[o] && end.distance(gaps[o].element.start) <= reach(&gaps[o]);
            let next = near.take(CANDIDATES).find(follows)?;
            taken[next] = true;
            Some(next)
        })
        .collect()
}

/// One part; a closed one is a whole loop.
fn fault(chain: &[&Gap], closed: bool) -> Fault {
    let worst = chain.iter().max_by(|a, b| a.by.total_cmp(&b.by)).expect("a part has a gap");
    let bounds = chain.iter().fold(Bounds::EMPTY, |b, g| b.union(g.element.bounds()));
    let vertices = chain.iter().map(|g| (g.element.start.x, g.element.start.y, g.element.bulge));
    let area = if closed { ArcSpline::closed(vertices).area().abs() } else { 0.0 };
    Fault {
        // Without any loop it is as far off as it is wide.
        by: if worst.by.is_finite() { worst.by } else { bounds.diagonal() },
        length: chain.iter().map(|g| g.element.length()).sum(),
        area,
        ..Fault::at(FaultKind::Missing, worst.at)
    }
}
