//! Runs of spirals: stretches that meet smoothly at apices and inflections.
//!
//! **Needs** the cuts of the run, which are certain. **Guarantees** that the curvatures of the arcs
//! have their extrema where the curve has its apices, and no others, as far as round-off of stored
//! arcs lets curvatures be told apart.
//!
//! **Method.** A node at every apex and inflection would cost an arc or two at each. So one arc is laid
//! over every apex first, and is the extremum itself; biarcs between run over inflections. Having the
//! mean curvature of their parts, arcs rise and fall as the curve does. Where the curvatures show
//! another picture than the cuts all the same, the nearest cut gets a node; where that does not help,
//! its neighborhood gets a more careful scheme.

use super::apex::{ApexArc, Room, apex_arc};
use super::biarc::{Arc, Node};
use super::cuts::{CutKind, Stretch};
use super::spiral::{Cell, Fitter, Scheme};
use super::spread::Ends;
use super::track::{Side, Track};
use std::collections::BTreeMap;
use std::ops::Range;

/// Rounds of putting nodes and choosing schemes; cuts that are still wrong then stay so.
const MAX_ROUNDS: usize = 12;

/// An arc over an apex reaches over at most this part of the way to the next apices and to the ends.
const APEX_SHARE: f64 = 0.4375;

/// Arcs over an apex are laid within the half of the tolerance, again and again, so many times at most
/// until those beside them fit.
const MAX_HALVINGS: i32 = 4;

/// Schemes for a part of a run, each more careful with curvatures than the one before.
const CAREFUL: [Scheme; 4] = [Scheme::Tilted, Scheme::Plain, Scheme::Osculating, Scheme::Bisection];

/// Stretches that biarcs may run over.
#[derive(Clone, Copy)]
pub(super) struct Run<'a> {
    /// The stretches in order.
    pub stretches: &'a [Stretch],
    /// Whether the first goes on smoothly behind the last.
    pub ring: bool,
}

/// Fits a run; the biarcs are appended to `out`. `None` when the limit on effort is reached.
pub(super) fn fit_run(
    fitter: &mut Fitter,
    track: &Track,
    (tolerance, scheme): (f64, Scheme),
    run: Run,
    out: &mut Vec<Cell>,
) -> Option<()> {
    if !matches!(scheme, Scheme::Fewest | Scheme::Tilted) {
        return run.stretches.chunks(1).try_for_each(|s| {
            let ends = Ends { nodes: ends(track, s), apex_arcs: [false; 2], singles: [false; 2] };
            fitter.fit(track, &ends, (tolerance, scheme), out)
        });
    }
    let work = &mut Work { fitter, track, tolerance, run };
    let mut plan = Plan::of(run);
    let mut laid = Laid::default();
    let begin = out.len();
    for round in 0..MAX_ROUNDS {
        out.truncate(begin);
        if round + 1 == MAX_ROUNDS {
            plan.give_up_apex_arcs();
        }
        laid.lay(work, &plan)?;
        if !laid.lost.is_empty() && plan.improve(&laid.lost, run, track) {
            continue;
        }
        laid.parts.iter().for_each(|p| out.extend_from_slice(&laid.cells[p.cells.clone()]));
        let wrong = wrong_places(&out[begin..], run, track.noise());
        if !plan.improve(&wrong, run, track) {
            break;
        }
    }
    Some(())
}

fn ends(track: &Track, stretches: &[Stretch]) -> [Node; 2] {
    let (from, to) = (stretches[0].from.u, stretches[stretches.len() - 1].to.u);
    [track.cut_node(from, Side::After), track.cut_node(to, Side::Before)]
}

impl Run<'_> {
    /// Parameter at the end.
    fn end(&self) -> f64 {
        self.stretches[self.stretches.len() - 1].to.u
    }

    /// What there is where stretch `i` begins; where the last one ends it is the same as at the first
    /// in a ring.
    fn is_apex(&self, i: usize) -> bool {
        let n = self.stretches.len();
        let inner = i > 0 && i < n;
        (inner || self.ring) && self.stretches[i % n].from.kind == CutKind::Apex
    }

    /// Parameter where stretch `i` begins, counted on around a ring.
    fn at(&self, i: usize) -> f64 {
        let n = self.stretches.len();
        let turns = (i / n) as f64 * (self.end() - self.stretches[0].from.u);
        if i == n { self.end() } else { self.stretches[i % n].from.u + turns }
    }

    /// Parameters of the apices before and after the one where stretch `i > 0` begins, or of the ends.
    fn neighbors(&self, i: usize) -> [f64; 2] {
        let last = if self.ring { 2 * self.stretches.len() } else { self.stretches.len() };
        let before = (0..i).rev().find(|&j| self.is_apex(j)).unwrap_or(0);
        let after = (i + 1..last).find(|&j| self.is_apex(j)).unwrap_or(last);
        [self.at(before), self.at(after)]
    }
}

/// What there is at a cut where biarcs may run over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    /// Nothing in particular.
    None,
    /// An arc over an apex, within half the tolerance as often as this says.
    Apex(i32),
    /// A node.
    Node,
}

/// Where a run gets nodes, and how careful it is laid.
struct Plan {
    /// What there is where a stretch begins, and at the end of the run.
    nodes: Vec<At>,
    /// Number of the scheme of a stretch.
    care: Vec<usize>,
}

impl Plan {
    /// Arcs over all apices.
    fn of(run: Run) -> Plan {
        let n = run.stretches.len();
        let mut nodes: Vec<At> =
            (0..=n).map(|i| if run.is_apex(i) { At::Apex(0) } else { At::None }).collect();
        for end in [0, n] {
            nodes[end] = if nodes[end] == At::None { At::Node } else { nodes[end] };
        }
        Plan { nodes, care: vec![0; n] }
    }

    /// Makes all arcs over apices nodes.
    fn give_up_apex_arcs(&mut self) {
        for at in &mut self.nodes {
            *at = if matches!(at, At::Apex(_)) { At::Node } else { *at };
        }
    }

    /// Takes more care at some places; answers whether it can.
    fn improve(&mut self, wrong: &[f64], run: Run, track: &Track) -> bool {
        let mut better = false;
        let n = run.stretches.len();
        let (nodes, care) = (self.nodes.clone(), self.care.clone());
        for &u in wrong {
            let after = run.stretches[1..].partition_point(|s| s.from.u < u) + 1;
            // Distances in the plane, as parameters say nothing about the shape.
            let place = track.place(u);
            let far = |i: usize| (track.place(run.at(i)) - place).length_squared();
            let nearest = if far(after) < far(after - 1) { after } else { after - 1 };
            // An arc too wide over an apex is what bends those beside it the wrong way.
            let before = (0..after).rev().find(|&i| run.is_apex(i));
            let behind = (after..=n).find(|&i| run.is_apex(i));
            let apex_arc = [before, behind].into_iter().flatten().filter(|&i| nodes[i] != At::Node);
            let first = apex_arc.min_by(|&i, &j| far(i).total_cmp(&far(j)));
            let first = first.or_else(|| Some(nearest).filter(|&i| nodes[i] != At::Node));
            if let Some(i) = first {
                self.nodes[i] = match nodes[i] {
                    At::Apex(halvings) if halvings < MAX_HALVINGS => At::Apex(halvings + 1),
                    _ => At::Node,
                };
                if i == 0 || i == n {
                    (self.nodes[0], self.nodes[n]) = (self.nodes[i], self.nodes[i]);
                }
                better = true;
                continue;
            }
            for i in [nearest.saturating_sub(1), nearest.min(n - 1)] {
                if care[i] + 1 < CAREFUL.len() {
                    self.care[i] = care[i] + 1;
                    better = true;
                }
            }
        }
        better
    }
}

/// What a run is laid with.
struct Work<'a, 'b> {
    fitter: &'a mut Fitter,
    track: &'a Track<'b>,
    tolerance: f64,
    run: Run<'a>,
}

impl Work<'_, '_> {
    /// The arc over the apex where stretch `i > 0` begins, if there is room for one.
    fn apex_arc(&self, i: usize, halvings: i32) -> Option<ApexArc> {
        let u = self.run.at(i);
        let limits = self.run.neighbors(i);
        let place = self.track.place(u);
        let way = limits.map(|limit| (self.track.place(limit) - place).length());
        let room = Room { limits, most: APEX_SHARE * way[0].min(way[1]) };
        apex_arc(self.track, u, &room, self.tolerance * 0.5f64.powi(halvings))
    }
}

/// A part of a run between nodes, or an arc over an apex.
#[derive(Clone)]
struct Part {
    /// Its stretches; none for an arc over an apex.
    stretches: Range<usize>,
    care: usize,
    /// What there is at both ends.
    ends: [At; 2],
    /// Its biarcs, as places in the list of all.
    cells: Range<usize>,
}

/// The parts of a run as they are laid, kept while their plan does not change.
#[derive(Default)]
struct Laid {
    cells: Vec<Cell>,
    parts: Vec<Part>,
    /// Arcs over apices.
    apex_arcs: BTreeMap<(usize, i32), Option<ApexArc>>,
    /// Where arcs over apices leave no way for biarcs beside them.
    lost: Vec<f64>,
}

impl Laid {
    fn lay(&mut self, work: &mut Work, plan: &Plan) -> Option<()> {
        let n = work.run.stretches.len();
        let mut parts = Vec::with_capacity(self.parts.len() + 2);
        let mut from = 0;
        self.lost.clear();
        for to in 1..=n {
            if to < n && plan.nodes[to] == At::None && plan.care[to] == plan.care[from] {
                continue;
            }
            let ends = [from, to].map(|i| self.at(i, work, plan));
            parts.push(self.part(from..to, ends, work, plan.care[from])?);
            if let At::Apex(halvings) = ends[1]
                && let Some(Some(apex_arc)) = self.apex_arcs.get(&(to, halvings))
            {
                let begin = self.cells.len();
                self.cells.push(apex_arc.cell);
                let cells = begin..begin + 1;
                parts.push(Part { stretches: to..to, care: 0, ends: [ends[1]; 2], cells });
            }
            from = to;
        }
        self.parts = parts;
        Some(())
    }

    /// What there is where stretch `i` begins: a node where there is no room for anything else.
    fn at(&mut self, i: usize, work: &Work, plan: &Plan) -> At {
        match plan.nodes[i] {
            At::Apex(halvings) if self.apex_arc(i, halvings, work).is_some() => At::Apex(halvings),
            _ => At::Node,
        }
    }

    /// The arc over the apex where stretch `i` begins; the first of a ring counts as the last.
    fn apex_arc(&mut self, i: usize, halvings: i32, work: &Work) -> Option<ApexArc> {
        let i = if i == 0 { work.run.stretches.len() } else { i };
        *self.apex_arcs.entry((i, halvings)).or_insert_with(|| work.apex_arc(i, halvings))
    }

    /// The part over some stretches, laid before if nothing has changed.
    fn part(&mut self, range: Range<usize>, at: [At; 2], work: &mut Work, care: usize) -> Option<Part> {
        let key = (range.start, range.end);
        let old = self.parts.binary_search_by_key(&key, |p| (p.stretches.start, p.stretches.end));
        if let Ok(i) = old
            && self.parts[i].care == care
            && self.parts[i].ends == at
        {
            return Some(self.parts[i].clone());
        }
        let mut nodes = ends(work.track, &work.run.stretches[range.clone()]);
        if let At::Apex(halvings) = at[0] {
            let apex_arc = self.apex_arc(range.start, halvings, work)?;
            let turn = if range.start == 0 { work.run.end() - work.run.at(0) } else { 0.0 };
            nodes[0] = Node { u: apex_arc.nodes[1].u - turn, ..apex_arc.nodes[1] };
        }
        if let At::Apex(halvings) = at[1] {
            nodes[1] = self.apex_arc(range.end, halvings, work)?.nodes[0];
        }
        let apex_arcs = at.map(|at| matches!(at, At::Apex(_)));
        let singles = at.map(|at| matches!(at, At::Apex(0 | 1)));
        let begin = self.cells.len();
        let ends = Ends { nodes, apex_arcs, singles };
        let laid = work.fitter.fit(work.track, &ends, (work.tolerance, CAREFUL[care]), &mut self.cells);
        if laid.is_none() {
            let lost = [range.start, range.end].into_iter().zip(apex_arcs).filter(|(_, apex_arc)| *apex_arc);
            let before = self.lost.len();
            self.lost.extend(lost.map(|(i, _)| work.run.at(i)));
            if self.lost.len() == before {
                return None;
            }
        }
        Some(Part { stretches: range, care, ends: at, cells: begin..self.cells.len() })
    }
}

/// An arc with the parameters between which it stands for the curve.
#[derive(Clone, Copy)]
struct Span {
    from: f64,
    to: f64,
    curvature: f64,
    /// Round-off of the curvature.
    error: f64,
}

impl Span {
    fn of(arc: &Arc, from: f64, to: f64, noise: f64) -> Span {
        let error = noise / (arc.end - arc.start).length_squared();
        Span { from, to, curvature: arc.curvature(), error }
    }
}

/// The parameters where the curvatures of the arcs do not rise and fall as those of the curve.
fn wrong_places(cells: &[Cell], run: Run, noise: f64) -> Vec<f64> {
    let mut spans: Vec<Span> =
        cells.iter().flat_map(Cell::spans).map(|(arc, from, to)| Span::of(&arc, from, to, noise)).collect();
    let stretches = run.stretches;
    if run.ring {
        // On around the ring, so that both sides of the seam are seen.
        let turn = run.end() - run.at(0);
        let first: Vec<Span> = spans.iter().take(2).copied().collect();
        spans.extend(first.iter().map(|s| Span { from: s.from + turn, to: s.to + turn, ..*s }));
    }
    let apices: Vec<f64> = (1..=stretches.len()).filter(|&i| run.is_apex(i)).map(|i| run.at(i)).collect();
    let at = |i: usize| apices[i];
    // Number of apices before a parameter, and of those that are not behind it.
    let before = |u: f64| apices.partition_point(|&a| a < u);
    let up_to = |u: f64| apices.partition_point(|&a| a <= u);
    let inside = |s: &Span| before(s.to).saturating_sub(up_to(s.from));
    let mut wrong = Vec::new();
    let mut changes = Vec::new();
    for (i, w) in spans.windows(2).enumerate() {
        let step = w[1].curvature - w[0].curvature;
        let hidden = step.abs() <= w[0].error + w[1].error;
        if !hidden {
            changes.push(step > 0.0);
        }
        let rising = stretches[0].rises != (before(w[0].to) % 2 == 1);
        let certain = inside(&w[0]) == inside(&w[1]) && up_to(w[0].to) == before(w[0].to);
        let too_many = inside(&w[0]) > 1 || inside(&w[1]) > 1;
        if too_many || certain && (step > 0.0) != rising && (!hidden || inside(&w[0]) > 0) {
            wrong.push(w[0].to);
        }
        // A dent in the extremum: down and up again around the arc that runs over an apex.
        if let Some(next) = spans.get(i + 2)
            && inside(&w[1]) == 1
            && !hidden
        {
            let a = up_to(w[1].from);
            let rising = stretches[0].rises != (a % 2 == 1);
            debug_assert!(at(a) >= w[1].from);
            if (step > 0.0) != rising && (next.curvature > w[1].curvature) == rising {
                wrong.push(at(a));
            }
        }
    }
    changes.dedup();
    if wrong.is_empty() && changes.len().saturating_sub(1) != apices.len() && !apices.is_empty() {
        wrong.extend((0..apices.len()).map(at));
    }
    wrong
}
