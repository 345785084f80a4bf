//! Where a run gets nodes, and how careful its parts are laid: first nowhere and not at all, then more of both where
//! the arcs turned out wrong.

use super::run::Run;
use super::spiral::Scheme;
use super::track::Track;

/// Schemes for a part of a run, each more careful with curvatures than the one before.
pub(super) const CAREFUL: [Scheme; 4] =
    [Scheme::Tilted, Scheme::Plain, Scheme::Osculating, Scheme::Bisection];

/// Most steps by which an arc over an apex yields; then it becomes a node.
pub(super) const MAX_STEPS: i32 = 8;

/// What there is at a cut where biarcs may run over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    /// Nothing in particular.
    None,
    /// An arc over an apex, so many steps within the tolerance.
    Apex(i32),
    /// A node.
    Node,
}

/// Where a run gets nodes, and how careful it is laid.
pub(super) struct Plan {
    /// What there is where a stretch begins, and at the end of the run.
    pub nodes: Vec<At>,
    /// Number of the scheme of a stretch.
    pub care: Vec<usize>,
}

impl Plan {
    /// Arcs over all apices.
    pub fn of(run: Run) -> Plan {
        let n = run.stretches.len();
        let mut nodes: Vec<At> =
            (0..=n).map(|i| if run.is_apex(i) { At::Apex(0) } else { At::None }).collect();
        for end in [0, n] {
            nodes[end] = if nodes[end] == At::None { At::Node } else { nodes[end] };
        }
        Plan { nodes, care: vec![0; n] }
    }

    /// The nearest arc over an apex: one too wide is what bends those beside it the wrong way.
    fn gives_way(nodes: &[At], u: f64, run: Run, track: &Track) -> Option<usize> {
        let (after, n) = (run.after(u), run.stretches.len());
        let before = (0..after).rev().find(|&i| run.is_apex(i));
        let here = Some(after).filter(|&i| run.is_apex(i) && run.at(i) == u);
        let behind = (after..=n).find(|&i| run.is_apex(i) && run.at(i) > u);
        let behind = behind.or_else(|| (1..n).find(|&i| run.ring && run.is_apex(i)));
        let apex_arcs = [before, here, behind].into_iter().flatten().filter(|&i| nodes[i] != At::Node);
        apex_arcs.min_by(|&i, &j| run.far(i, u, track).total_cmp(&run.far(j, u, track)))
    }

    /// Takes more care at some places; answers whether it can.
    pub fn improve(&mut self, (wrong, step): (&[f64], i32), run: Run, track: &Track) -> bool {
        let mut better = false;
        let n = run.stretches.len();
        let (nodes, care) = (self.nodes.clone(), self.care.clone());
        for &u in wrong {
            let (first, nearest) = (Plan::gives_way(&nodes, u, run, track), run.nearest(u, track));
            let first = first.or_else(|| Some(nearest).filter(|&i| nodes[i] != At::Node));
            if let Some(i) = first {
                self.nodes[i] = match nodes[i] {
                    At::Apex(steps) if steps + step <= MAX_STEPS => At::Apex(steps + step),
                    _ => At::Node,
                };
                if i == 0 || i == n {
                    (self.nodes[0], self.nodes[n]) = (self.nodes[i], self.nodes[i]);
                }
                better = true;
                continue;
            }
            let sides = match nearest {
                i if i % n == 0 && run.ring => [n - 1, 0],
                i => [i.saturating_sub(1), i.min(n - 1)],
            };
            for i in sides {
                if care[i] + 1 < CAREFUL.len() {
                    self.care[i] = if step > MAX_STEPS { CAREFUL.len() - 1 } else { care[i] + 1 };
                    better = true;
                }
            }
        }
        better
    }
}
