//! Runs of spirals: stretches that meet smoothly at apices and inflections.
//!
//! **Needs** the cuts of the run, which are certain. **Guarantees** that the curvatures of the arcs
//! have their extrema where the curve has its apices, and no others, as far as round-off of stored
//! arcs lets curvatures be told apart.
//!
//! **Method.** A node at every apex and inflection would cost an arc or two at each. So one arc is laid
//! over every apex first, and is the extremum itself; biarcs between run over inflections. Having the
//! mean curvature of their parts, arcs rise and fall as the curve does. Where the curvatures show
//! another picture than the cuts all the same, the arc over the nearest apex becomes shorter, and in the
//! end that cut gets a node; where that does not help, its neighborhood gets a more careful scheme. Arcs
//! over apices become shorter, too, where their tangents do not suit the biarcs beside them; that is known
//! before these are laid.

use super::apex::{ApexArc, Room, apex_arc};
use super::biarc::Node;
use super::cuts::{CutKind, Stretch};
use super::density::Density;
use super::layout::{Ends, Lost};
use super::order::wrong_places;
use super::plan::{At, CAREFUL, MAX_STEPS, Plan};
use super::spiral::{Cell, Fitter, Scheme};
use super::track::{Side, Track};
use std::collections::BTreeMap;
use std::ops::Range;

/// Rounds of putting nodes and choosing schemes; cuts that are still wrong then stay so.
const MAX_ROUNDS: usize = 64;

/// After so many rounds, what is wrong gets its nodes and the most careful scheme at once.
const PATIENCE: usize = 40;

/// An arc over an apex reaches over at most this part of the way to the next apices and to the ends.
const APEX_SHARE: f64 = 0.4375;

/// Arcs over an apex are laid within this part of the tolerance, again and again, until those beside them
/// fit: one step at a time, or many where curvatures are wrong.
const STEP: f64 = std::f64::consts::FRAC_1_SQRT_2;
const LEAP: i32 = 2;

/// Up to so many steps cost less than one more arc beside.
const YIELDING_STEPS: i32 = 2;

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
        return run
            .stretches
            .chunks(1)
            .try_for_each(|s| fitter.fit(track, &Ends::of(ends(track, s)), (tolerance, scheme), out).ok());
    }
    let work = &mut Work { fitter, track, tolerance, run };
    let mut plan = Plan::of(run);
    let mut laid = Laid::default();
    let begin = out.len();
    for round in 0..MAX_ROUNDS {
        out.truncate(begin);
        let haste = if round < PATIENCE { 0 } else { MAX_STEPS + 1 };
        laid.lay(work, &plan)?;
        if !laid.lost.is_empty() && plan.improve((&laid.lost, haste.max(1)), run, track) {
            continue;
        }
        laid.parts.iter().for_each(|p| out.extend_from_slice(&laid.cells[p.cells.clone()]));
        let wrong = wrong_places(&out[begin..], run, track.noise());
        if !plan.improve((&wrong, haste.max(LEAP)), run, track) {
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
    pub fn end(&self) -> f64 {
        self.stretches[self.stretches.len() - 1].to.u
    }

    /// What there is where stretch `i` begins; where the last one ends it is the same as at the first
    /// in a ring.
    pub fn is_apex(&self, i: usize) -> bool {
        let n = self.stretches.len();
        let inner = i > 0 && i < n;
        (inner || self.ring) && self.stretches[i % n].from.kind == CutKind::Apex
    }

    /// Parameter where stretch `i` begins, counted on around a ring.
    pub fn at(&self, i: usize) -> f64 {
        let n = self.stretches.len();
        let turns = (i / n) as f64 * (self.end() - self.stretches[0].from.u);
        if i == n { self.end() } else { self.stretches[i % n].from.u + turns }
    }

    /// The first stretch, from the second on, that does not begin before a parameter.
    pub fn after(&self, u: f64) -> usize {
        self.stretches[1..].partition_point(|s| s.from.u < u) + 1
    }

    /// The squared distance in the plane from where stretch `i` begins, as parameters say nothing about the
    /// shape.
    pub fn far(&self, i: usize, u: f64, track: &Track) -> f64 {
        (track.place(self.at(i)) - track.place(u)).length_squared()
    }

    /// The nearest end of the stretch that holds a parameter.
    pub fn nearest(&self, u: f64, track: &Track) -> usize {
        let after = self.after(u);
        if self.far(after, u, track) < self.far(after - 1, u, track) { after } else { after - 1 }
    }

    /// Parameters of the apices before and after the one where stretch `i > 0` begins, or of the ends.
    fn neighbors(&self, i: usize) -> [f64; 2] {
        let last = if self.ring { 2 * self.stretches.len() } else { self.stretches.len() };
        let before = (0..i).rev().find(|&j| self.is_apex(j)).unwrap_or(0);
        let after = (i + 1..last).find(|&j| self.is_apex(j)).unwrap_or(last);
        [self.at(before), self.at(after)]
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
    fn apex_arc(&self, i: usize, steps: i32, before: Option<ApexArc>) -> Option<ApexArc> {
        let u = self.run.at(i);
        let limits = self.run.neighbors(i);
        let place = self.track.place(u);
        let way = limits.map(|limit| (self.track.place(limit) - place).length());
        let room = Room { limits, most: way.map(|way| APEX_SHARE * way) };
        let other = before.as_ref().map(|other| (other, STEP.recip()));
        apex_arc(self.track, u, &room, self.tolerance * STEP.powi(steps), other)
    }
}

/// A part of a run between nodes, or an arc over an apex.
#[derive(Clone)]
struct Part {
    /// Its stretches; none for an arc over an apex.
    stretches: Range<usize>,
    care: usize,
    /// What there is at both ends.
    at: [At; 2],
    /// Its biarcs, as places in the list of all.
    cells: Range<usize>,
}

/// A part that may have to be laid.
struct Draft {
    stretches: Range<usize>,
    care: usize,
    at: [At; 2],
    ends: Ends,
    /// The density of biarcs along it, once that is known.
    density: Option<Density>,
    /// The density between its ends as they were before.
    inner: Option<Density>,
}

impl Draft {
    /// The same, with what is known of it.
    fn again(&mut self) -> Draft {
        let (density, inner) = (self.density.take(), self.inner.take());
        Draft { stretches: self.stretches.clone(), density, inner, ..*self }
    }

    /// Takes over what is known of the same part, whose ends have moved.
    fn learn(&mut self, old: &mut Draft) {
        if (&self.stretches, self.care) == (&old.stretches, old.care) {
            self.inner = old.density.take();
        }
    }
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
    /// The parts between nodes and arcs over apices, with what is known of them.
    drafts: Vec<Draft>,
}

impl Laid {
    /// Lays the parts that the plan has changed, or none while some arc over an apex is lost anyway.
    fn lay(&mut self, work: &mut Work, plan: &Plan) -> Option<()> {
        self.lost.clear();
        let mut drafts = self.drafts(work, plan)?;
        for draft in &mut drafts {
            if draft.density.is_none() && self.known(draft).is_none() {
                let goal = (work.tolerance, CAREFUL[draft.care]);
                let checked = work.fitter.check(work.track, &draft.ends, (goal, draft.inner.take()));
                draft.density = Some(work.fitter.density());
                self.note(draft, checked, work)?;
            }
        }
        if !self.lost.is_empty() {
            self.drafts = drafts;
            return Some(());
        }
        let mut parts = Vec::with_capacity(2 * drafts.len());
        for draft in &mut drafts {
            let (to, end) = (draft.stretches.end, draft.at[1]);
            parts.push(self.part(draft, work)?);
            if matches!(end, At::Apex(_)) {
                parts.push(Part { stretches: to..to, care: 0, at: [end; 2], cells: 0..0 });
            }
        }
        (self.parts, self.drafts) = (parts, drafts);
        self.close(work);
        Some(())
    }

    /// Lays the arcs over apices between the parts on both sides, which may have moved their ends.
    fn close(&mut self, work: &Work) {
        let n = self.parts.len();
        for i in 0..n {
            let (to, At::Apex(steps)) = (self.parts[i].stretches.end, self.parts[i].at[1]) else { continue };
            let Some(&Some(apex_arc)) = self.apex_arcs.get(&(to, steps)) else { continue };
            if !self.parts[i].stretches.is_empty() {
                continue;
            }
            let turn = if i + 1 == n { work.run.end() - work.run.at(0) } else { 0.0 };
            let [before, after] =
                [&self.parts[i - 1], &self.parts[(i + 1) % n]].map(|part| part.cells.clone());
            let (before, after) = (self.cells[before].last(), self.cells[after].first());
            let laid = match (before, after) {
                (Some(before), Some(after)) => apex_arc.between(work.track, before, (after, turn)),
                _ => apex_arc.cell,
            };
            if laid.distance.bound > work.tolerance || laid.distance.bound.is_nan() {
                self.lost.push(work.run.at(to));
            }
            let begin = self.cells.len();
            self.cells.push(laid);
            self.parts[i].cells = begin..begin + 1;
        }
    }

    /// The parts between nodes and arcs over apices.
    fn drafts(&mut self, work: &Work, plan: &Plan) -> Option<Vec<Draft>> {
        let n = work.run.stretches.len();
        let mut before = std::mem::take(&mut self.drafts);
        let mut drafts = Vec::with_capacity(before.len());
        let mut from = 0;
        for to in 1..=n {
            if to < n && plan.nodes[to] == At::None && plan.care[to] == plan.care[from] {
                continue;
            }
            let at = [from, to].map(|i| self.at(i, work, plan));
            let care = plan.care[from];
            let mut old =
                before.binary_search_by_key(&from, |d| d.stretches.start).ok().map(|i| &mut before[i]);
            if let Some(old) = &mut old
                && (old.stretches.end, old.care, old.at) == (to, care, at)
            {
                drafts.push(old.again());
            } else {
                let ends = self.ends(from..to, at, work)?;
                let mut draft = Draft { stretches: from..to, care, at, ends, density: None, inner: None };
                old.into_iter().for_each(|old| draft.learn(old));
                drafts.push(draft);
            }
            from = to;
        }
        Some(drafts)
    }

    /// What there is where stretch `i` begins: a node where there is no room for anything else.
    fn at(&mut self, i: usize, work: &Work, plan: &Plan) -> At {
        match plan.nodes[i] {
            At::Apex(steps) if self.has_apex_arc(i, steps, work) => At::Apex(steps),
            _ => At::Node,
        }
    }

    /// Whether there is an arc over the apex where stretch `i` begins.
    fn has_apex_arc(&mut self, i: usize, steps: i32, work: &Work) -> bool {
        let last = if i == 0 { work.run.stretches.len() } else { i };
        match self.apex_arcs.get(&(last, steps)) {
            Some(known) => known.is_some(),
            None => self.apex_arc(i, steps, work).is_some(),
        }
    }

    /// The arc over the apex where stretch `i` begins; the first of a ring counts as the last.
    fn apex_arc(&mut self, i: usize, steps: i32, work: &Work) -> Option<ApexArc> {
        let i = if i == 0 { work.run.stretches.len() } else { i };
        if let Some(known) = self.apex_arcs.get(&(i, steps)) {
            return *known;
        }
        let before = self.apex_arcs.get(&(i, steps - 1)).copied().flatten();
        let found = work.apex_arc(i, steps, before);
        self.apex_arcs.insert((i, steps), found);
        found
    }

    fn ends(&mut self, range: Range<usize>, at: [At; 2], work: &Work) -> Option<Ends> {
        let mut nodes = ends(work.track, &work.run.stretches[range.clone()]);
        let mut circles = [None; 2];
        let reach = [range.start, range.end].map(|i| work.run.at(i));
        if let At::Apex(steps) = at[0] {
            let apex_arc = self.apex_arc(range.start, steps, work)?;
            let turn = if range.start == 0 { work.run.end() - work.run.at(0) } else { 0.0 };
            nodes[0] = Node { u: apex_arc.nodes[1].u - turn, ..apex_arc.nodes[1] };
            circles[0] = Some(apex_arc.cell.arcs[0].curvature());
        }
        if let At::Apex(steps) = at[1] {
            let apex_arc = self.apex_arc(range.end, steps, work)?;
            nodes[1] = apex_arc.nodes[0];
            circles[1] = Some(apex_arc.cell.arcs[0].curvature());
        }
        let apex_arcs = at.map(|at| matches!(at, At::Apex(_)));
        let singles = at.map(|at| matches!(at, At::Apex(..=LEAP)));
        let yields = at.map(|at| matches!(at, At::Apex(steps) if steps < YIELDING_STEPS));
        Some(Ends { nodes, apex_arcs, singles, yields, circles, reach })
    }

    /// The part laid before, if nothing has changed.
    fn known(&self, draft: &Draft) -> Option<&Part> {
        let key = (draft.stretches.start, draft.stretches.end);
        let old = self.parts.binary_search_by_key(&key, |p| (p.stretches.start, p.stretches.end)).ok()?;
        Some(&self.parts[old]).filter(|part| part.care == draft.care && part.at == draft.at)
    }

    fn part(&mut self, draft: &mut Draft, work: &mut Work) -> Option<Part> {
        if let Some(part) = self.known(draft) {
            return Some(part.clone());
        }
        let begin = self.cells.len();
        let goal = (work.tolerance, CAREFUL[draft.care]);
        work.fitter.take(draft.density.take());
        let laid = work.fitter.fit(work.track, &draft.ends, goal, &mut self.cells);
        draft.density = Some(work.fitter.density());
        self.note(draft, laid, work)?;
        let (stretches, care, at) = (draft.stretches.clone(), draft.care, draft.at);
        Some(Part { stretches, care, at, cells: begin..self.cells.len() })
    }

    /// Notes which arcs over apices are lost; `None` if something else is.
    fn note(&mut self, draft: &Draft, laid: Result<(), Lost>, work: &Work) -> Option<()> {
        let Err(Lost { ends }) = laid else { return Some(()) };
        let lost = [draft.stretches.start, draft.stretches.end].into_iter().zip(ends);
        let before = self.lost.len();
        self.lost.extend(lost.filter(|(_, lost)| *lost).map(|(i, _)| work.run.at(i)));
        (self.lost.len() > before).then_some(())
    }
}
