//! A round tour over a network: along every stretch, and back to where it began.
//!
//! **Needs** a connected network. **Guarantees** that every stretch is run at least once, that the
//! tour is connected and closed, and that only stretches of a spanning tree are run twice. A tree is
//! run to and fro, a ring once round.
//!
//! **Method.** A connected network has a closed tour that runs each stretch once when an even number
//! of stretches meets at every node (Euler 1736). Where it is odd, the stretch of a spanning tree
//! toward the root is doubled, from the leaves inward; the tour is then found after Hierholzer (1873).

/// A stretch of a network, run forward or backward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leg {
    pub stretch: usize,
    pub backward: bool,
}

/// The legs of a tour from a node back to it. `stretches` names the two nodes of each.
pub(super) fn round_tour(node_count: usize, stretches: &[[usize; 2]], start: usize) -> Vec<Leg> {
    let mut beside = vec![Vec::new(); node_count];
    for (i, &[a, b]) in stretches.iter().enumerate() {
        beside[a].push(Leg { stretch: i, backward: false });
        beside[b].push(Leg { stretch: i, backward: true });
    }
    let mut runs = evened(stretches, &beside, start);
    // Depth first; a leg is final when nothing is left to run at its end.
    let mut stack: Vec<(usize, Option<Leg>)> = vec![(start, None)];
    let mut tour = Vec::new();
    while let Some(&(at, by)) = stack.last() {
        while beside[at].last().is_some_and(|leg| runs[leg.stretch] == 0) {
            beside[at].pop();
        }
        match beside[at].last() {
            Some(&leg) => {
                runs[leg.stretch] -= 1;
                stack.push((stretches[leg.stretch][usize::from(!leg.backward)], Some(leg)));
            }
            None => {
                tour.extend(by);
                stack.pop();
            }
        }
    }
    tour.reverse();
    tour
}

/// How often to run each stretch so that an even number of runs meets at every node.
fn evened(stretches: &[[usize; 2]], beside: &[Vec<Leg>], start: usize) -> Vec<u32> {
    let mut runs = vec![1; stretches.len()];
    let mut toward_root: Vec<Option<(usize, usize)>> = vec![None; beside.len()];
    let mut order = vec![start];
    let mut next = 0;
    while let Some(&at) = order.get(next) {
        next += 1;
        for leg in &beside[at] {
            let there = stretches[leg.stretch][usize::from(!leg.backward)];
            if there != start && toward_root[there].is_none() {
                toward_root[there] = Some((leg.stretch, at));
                order.push(there);
            }
        }
    }
    let mut odd: Vec<bool> = beside.iter().map(|legs| legs.len() % 2 == 1).collect();
    for &node in order.iter().rev() {
        if let (true, Some((stretch, root))) = (odd[node], toward_root[node]) {
            runs[stretch] += 1;
            odd[root] = !odd[root];
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walked(stretches: &[[usize; 2]], start: usize) -> Vec<usize> {
        let nodes = stretches.iter().flatten().max().map_or(1, |m| m + 1);
        let mut at = start;
        let mut counts = vec![0; stretches.len()];
        for leg in round_tour(nodes, stretches, start) {
            let [a, b] = stretches[leg.stretch];
            let [from, to] = if leg.backward { [b, a] } else { [a, b] };
            assert_eq!(from, at, "the legs are connected");
            at = to;
            counts[leg.stretch] += 1;
        }
        assert_eq!(at, start, "the tour is closed");
        counts
    }

    #[test]
    fn a_tree_is_run_to_and_fro() {
        assert_eq!(walked(&[[0, 1], [1, 2], [1, 3], [3, 4]], 0), [2, 2, 2, 2]);
        assert_eq!(walked(&[[0, 1], [1, 2], [1, 3], [3, 4]], 3), [2, 2, 2, 2]);
        assert_eq!(walked(&[], 0), [0; 0]);
    }

    #[test]
    fn a_ring_is_run_once_round_wherever_it_begins() {
        for start in 0..3 {
            assert_eq!(walked(&[[0, 1], [1, 2], [2, 0]], start), [1, 1, 1]);
        }
        assert_eq!(walked(&[[0, 0]], 0), [1]);
    }

    #[test]
    fn a_ring_with_tails_runs_only_the_tails_twice() {
        assert_eq!(walked(&[[0, 1], [1, 2], [2, 0], [2, 3], [4, 0]], 3), [1, 1, 1, 2, 2]);
    }

    #[test]
    fn of_a_theta_every_stretch_is_run_and_at_most_one_twice() {
        let counts = walked(&[[0, 1], [0, 1], [0, 1]], 0);
        assert!(counts.iter().all(|&c| c == 1 || c == 2));
        assert_eq!(counts.iter().sum::<usize>(), 4);
    }
}
