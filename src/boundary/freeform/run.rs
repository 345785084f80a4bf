//! Runs of spirals: stretches that meet smoothly at apices and inflections.
//!
//! **Needs** the cuts of the run, which are certain. **Guarantees** that the curvatures of the arcs
//! have their extrema where the curve has its apices, and no others, as far as round-off of stored
//! arcs lets curvatures be told apart.
//!
//! **Method.** A node at every apex and inflection would cost an arc or two at each. So the whole run
//! is laid at once first, and an arc may run over an apex: having the mean curvature of its part, it is
//! the extremum itself. Where the curvatures show another picture than the cuts, the nearest cut gets a
//! node; where that does not help, its neighborhood gets a more careful scheme.

use super::biarc::{Arc, Node};
use super::cuts::{CutKind, Stretch};
use super::march::{Centered, centered};
use super::spiral::{Cell, Fitter, Scheme};
use super::track::{Side, Track};
use std::collections::BTreeMap;
use std::ops::Range;

/// Rounds of putting nodes and choosing schemes; cuts that are still wrong then stay so.
const MAX_ROUNDS: usize = 12;

/// With fewer biarcs for each apex than this it is worth a try to lay them around the apices first.
const FEW: usize = 12;

/// Schemes for a part of a run, each more careful with curvatures than the one before.
const CAREFUL: [Scheme; 4] = [Scheme::Tilted, Scheme::Plain, Scheme::Osculating, Scheme::Bisection];

/// Fits a run; the biarcs are appended to `out`. `None` when the limit on effort is reached.
pub(super) fn fit_run(
    fitter: &mut Fitter,
    track: &Track,
    (tolerance, scheme): (f64, Scheme),
    stretches: &[Stretch],
    out: &mut Vec<Cell>,
) -> Option<()> {
    if !matches!(scheme, Scheme::Fewest | Scheme::Tilted) {
        return stretches
            .chunks(1)
            .try_for_each(|s| fitter.fit(track, ends(track, s), (tolerance, scheme), out));
    }
    let work = &mut Work { fitter, track, tolerance, stretches };
    let mut cells = laid_by(work, At::None)?;
    let apices = stretches[1..].iter().filter(|s| s.from.kind == CutKind::Apex).count();
    if scheme == Scheme::Fewest && cells.len() < FEW * apices {
        let other = laid_by(work, At::Center)?;
        if other.len() < cells.len() {
            cells = other;
        }
    }
    out.append(&mut cells);
    Some(())
}

/// Biarcs along a run with something at all apices at first.
fn laid_by(work: &mut Work, at: At) -> Option<Vec<Cell>> {
    let apex = |s: &Stretch| if s.from.kind == CutKind::Apex { at } else { At::None };
    let mut plan =
        Plan { nodes: work.stretches.iter().map(apex).collect(), care: vec![0; work.stretches.len()] };
    let mut laid = Laid::default();
    let mut cells = Vec::new();
    for _ in 0..MAX_ROUNDS {
        cells.clear();
        laid.lay(work, &plan)?;
        laid.parts.iter().for_each(|p| cells.extend_from_slice(&laid.cells[p.cells.clone()]));
        let wrong = wrong_places(&cells, work.stretches, work.track.noise());
        if !plan.improve(&wrong, work.stretches) {
            break;
        }
    }
    Some(cells)
}

fn ends(track: &Track, stretches: &[Stretch]) -> [Node; 2] {
    let (from, to) = (stretches[0].from.u, stretches[stretches.len() - 1].to.u);
    [track.cut_node(from, Side::After), track.cut_node(to, Side::Before)]
}

/// What there is at a cut where biarcs may run over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    /// Nothing in particular.
    None,
    /// A biarc that reaches as far to both sides.
    Center,
    /// A node.
    Node,
}

/// Where a run gets nodes, and how careful it is laid.
struct Plan {
    /// What there is where a stretch begins.
    nodes: Vec<At>,
    /// Number of the scheme of a stretch.
    care: Vec<usize>,
}

impl Plan {
    /// Takes more care at some places; answers whether it can.
    fn improve(&mut self, wrong: &[f64], stretches: &[Stretch]) -> bool {
        let mut better = false;
        let n = stretches.len();
        let (nodes, care) = (self.nodes.clone(), self.care.clone());
        for &u in wrong {
            let after = stretches[1..].partition_point(|s| s.from.u < u) + 1;
            let off =
                |i: usize| if i == 0 || i >= n { f64::INFINITY } else { (stretches[i].from.u - u).abs() };
            let nearest = if off(after) < off(after - 1) { after } else { after - 1 };
            if nearest > 0 && nearest < n && nodes[nearest] != At::Node {
                let apex = stretches[nearest].from.kind == CutKind::Apex;
                let first = apex && nodes[nearest] == At::None;
                self.nodes[nearest] = if first { At::Center } else { At::Node };
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
    stretches: &'a [Stretch],
}

/// A biarc around an apex reaches over at most this part of the way to the next cuts.
const CENTER_SHARE: f64 = 0.3125;

impl Work<'_, '_> {
    /// The biarc around the apex where stretch `i` begins, if there is room for one.
    fn center(&self, i: usize) -> Option<Centered> {
        let place = |u: f64| self.track.place(u);
        let (before, after) = (&self.stretches[i - 1], &self.stretches[i]);
        let way = |u: f64| (place(u) - place(after.from.u)).length();
        let most = CENTER_SHARE * way(before.from.u).min(way(after.to.u));
        centered(self.track, after.from.u, [before.from.u, after.to.u], most, self.tolerance)
    }
}

/// A part of a run between nodes, or a biarc around an apex.
#[derive(Clone)]
struct Part {
    /// Its stretches; none for a biarc around an apex.
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
    /// Biarcs around apices.
    centers: BTreeMap<usize, Option<Centered>>,
}

impl Laid {
    fn lay(&mut self, work: &mut Work, plan: &Plan) -> Option<()> {
        let n = work.stretches.len();
        let mut parts = Vec::with_capacity(self.parts.len() + 2);
        let mut from = 0;
        for to in 1..=n {
            if to < n && plan.nodes[to] == At::None && plan.care[to] == plan.care[from] {
                continue;
            }
            let ends = [from, to].map(|i| self.at(i, work, plan));
            parts.push(self.part(from..to, ends, work, plan.care[from])?);
            if ends[1] == At::Center
                && let Some(Some(center)) = self.centers.get(&to)
            {
                let begin = self.cells.len();
                self.cells.push(center.cell);
                parts.push(Part {
                    stretches: to..to,
                    care: 0,
                    ends: [At::Center; 2],
                    cells: begin..begin + 1,
                });
            }
            from = to;
        }
        self.parts = parts;
        Some(())
    }

    /// What there is where stretch `i` begins: a node where there is no room for anything else.
    fn at(&mut self, i: usize, work: &Work, plan: &Plan) -> At {
        if i == 0 || i == work.stretches.len() || plan.nodes[i] != At::Center {
            return At::Node;
        }
        let center = self.centers.entry(i).or_insert_with(|| work.center(i));
        if center.is_some() { At::Center } else { At::Node }
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
        let mut nodes = ends(work.track, &work.stretches[range.clone()]);
        let center = |i: usize| self.centers.get(&i).copied().flatten();
        if let (At::Center, Some(center)) = (at[0], center(range.start)) {
            nodes[0] = center.nodes[1];
        }
        if let (At::Center, Some(center)) = (at[1], center(range.end)) {
            nodes[1] = center.nodes[0];
        }
        let begin = self.cells.len();
        work.fitter.fit(work.track, nodes, (work.tolerance, CAREFUL[care]), &mut self.cells)?;
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
fn wrong_places(cells: &[Cell], stretches: &[Stretch], noise: f64) -> Vec<f64> {
    let spans: Vec<Span> = cells
        .iter()
        .flat_map(|c| {
            let [a, b] = &c.arcs;
            [Span::of(a, c.from, c.joint, noise), Span::of(b, c.joint, c.to, noise)]
        })
        .collect();
    let apices: Vec<usize> =
        (1..stretches.len()).filter(|&i| stretches[i].from.kind == CutKind::Apex).collect();
    let at = |i: usize| stretches[apices[i]].from.u;
    // Number of apices before a parameter, and of those that are not behind it.
    let before = |u: f64| apices.partition_point(|&i| stretches[i].from.u < u);
    let up_to = |u: f64| apices.partition_point(|&i| stretches[i].from.u <= u);
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
