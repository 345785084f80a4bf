//! The passes of one pocket in order, joined by links, each entered without harm.
//!
//! **Needs** the levels of a pocket, a judge of straight links, and the axis if links shall follow it.
//! **Guarantees** that rapids run at the clearance or straight down into a place already cut that
//! deep; that a link at depth joins neighbors and is as long as their distance, or follows the axis
//! (`detour`) in not much more time than lifting the tool would take; that it stays clear of the wall by the
//! tool radius and the stock; that a ramped stretch is cut again at depth.
//! **Does not** shorten the way between pockets or between branches of a pocket.

use super::amounts::Amounts;
use super::course::{Course, LONG};
use super::crest::{Crest, Reach};
use super::cutter::Cutter;
use super::detour::Detours;
use super::indexed::Indexed;
use super::lead::ShortLeads;
use super::link::{KnownBend, Last};
use super::nest::{Nest, Pass, index};
use super::roads::Roads;
use super::width::Widths;
use super::{Direction, Job, Start, Warning};
use crate::error::Error;
use crate::geom::{ArcSpline, Bounds, Element, Point};
use crate::offset::Level;
use rayon::prelude::*;
use rstar::RTree;
use std::collections::HashMap;
use std::ops::Range;

/// Largest number of moves of a path.
pub(super) const MAX_MOVES: u64 = 20_000_000;

/// For how many passes at once courses are laid.
const AHEAD: usize = 16;

/// Round-off of a place of a level set, relative to the largest coordinate: the levels come from
/// axis vertices, which are solved to about this accuracy.
const LEVEL_ERROR: f64 = 16384.0 * f64::EPSILON;

/// Whether the tool may run along a link with this much room around it.
pub(super) type IsClear<'a> = dyn Fn(&Element, f64) -> bool + Sync + 'a;

/// Plans pockets one after the other.
pub(super) struct Planner<'a> {
    pub job: &'a Job,
    pub cutter: Cutter<'a>,
    /// What was cut so far but passes.
    pub amounts: Amounts,
    /// Ramps and plunges that stand for another kind of entry, and the first of these plunges.
    pub fallbacks: Option<(usize, usize, Option<Point>)>,
    /// Leads that had less room than asked.
    pub leads: ShortLeads,
}

/// What is known of the pocket at hand.
pub(super) struct Ground<'a> {
    levels: &'a [Level],
    pub nest: Nest,
    pub is_clear: &'a IsClear<'a>,
    /// The axis, if it is known, and links along it.
    pub roads: Option<Roads<'a>>,
    pub detours: Option<Detours<'a>>,
    pub slack: f64,
    pub crests: Vec<Crest>,
    /// The crests that each pass cuts.
    pub crests_of: Vec<Vec<usize>>,
    /// Passes cut at the height at hand.
    pub done: Vec<bool>,
    pub last: Option<Last>,
    /// How long passes were come to at the height before, and their courses there.
    pub bends: HashMap<usize, KnownBend>,
    courses: HashMap<usize, Course>,
    /// Courses that were laid before their turn came.
    laid: HashMap<usize, Course>,
    /// What of each pass has no neighbor inside; `None` where that is all of it. Empty if not asked for.
    pub fresh: Vec<Option<Vec<Element>>>,
    /// Where each pass should begin, if that is known before.
    pub begin: Vec<Option<Point>>,
}

/// A pocket that is ready to be cut, height by height.
pub(super) struct Prepared<'a> {
    ground: Ground<'a>,
    /// Passes cut at every height, and those that wait for the floor.
    rough: Vec<usize>,
    wall: Vec<usize>,
    pub heights: Vec<f64>,
    /// What was cut of it so far but passes.
    pub amounts: Amounts,
}

impl Prepared<'_> {
    /// How many passes it has, counted once for each height.
    pub fn passes(&self) -> usize {
        self.rough.len() * self.heights.len() + self.wall.len()
    }
}

/// From where to where one height is cut.
#[derive(Clone, Copy)]
pub(super) struct Height {
    pub surface: f64,
    pub z: f64,
}

impl<'a> Planner<'a> {
    /// A planner without moves yet.
    pub fn new(job: &'a Job) -> Planner<'a> {
        Planner {
            job,
            cutter: Cutter::new(job),
            amounts: Amounts::default(),
            fallbacks: None,
            leads: ShortLeads::default(),
        }
    }

    /// Makes a pocket ready to be cut. Without its axis, links are straight.
    pub fn prepare<'g>(
        &self,
        levels: &'g [Level],
        is_clear: &'g IsClear<'g>,
        roads: Option<Roads<'g>>,
    ) -> Prepared<'g> {
        let bounds = levels
            .iter()
            .take(1)
            .flat_map(|l| l.loops.iter().chain(&l.ridges))
            .fold(Bounds::EMPTY, |b, s| b.union(s.bounds()));
        let slack = LEVEL_ERROR * bounds.magnitude();
        let nest = Nest::new(levels, slack);
        let order = nest.order(self.job.start);
        let (done, begin) = (vec![false; order.len()], vec![None; order.len()]);
        let last = self.last_passes(levels, &nest);
        let detours = roads.as_ref().map(|_| Detours::new(levels, slack));
        let crests = roads.as_ref().map_or(Vec::new(), |roads| self.crests(roads, levels, &nest, slack));
        let crests_of = vec![Vec::new(); order.len()];
        let mut ground = Ground {
            levels,
            nest,
            is_clear,
            roads,
            detours,
            slack,
            crests,
            crests_of,
            done,
            last: None,
            bends: HashMap::new(),
            courses: HashMap::new(),
            laid: HashMap::new(),
            fresh: Vec::new(),
            begin,
        };
        let needed = order.into_iter().filter(|&p| !ground.is_covered(p));
        let (wall, rough): (Vec<usize>, Vec<usize>) = needed.partition(|&p| last[p]);
        if self.job.start == Start::Outside {
            ground.plan_beginnings(&rough);
            ground.plan_beginnings(&wall);
        }
        let rank = ground.settle_crests(rough.iter().chain(&wall));
        let heights = self.job.heights();
        let amounts = self.widths(&mut ground, (&rough, &wall), heights.len(), &rank);
        Prepared { ground, rough, wall, heights, amounts }
    }

    /// Cuts a pocket at some of its heights, counted from the top, and its finishing passes with the
    /// last.
    pub fn cut(&mut self, pocket: &mut Prepared, heights: Range<usize>) -> Result<(), Error> {
        let Prepared { ground, rough, wall, heights: all, amounts } = pocket;
        self.amounts = *amounts;
        for i in heights.clone() {
            ground.done.fill(false);
            ground.last = None;
            let surface = i.checked_sub(1).map_or(self.job.top, |above| all[above]);
            self.passes(ground, rough, Height { surface, z: all[i] })?;
        }
        if heights.end == all.len() {
            let height = Height { surface: self.job.top, z: self.job.floor() };
            for (i, &pass) in wall.iter().enumerate() {
                if !self.finish_wall(ground, pass, height)? {
                    self.pass(ground, pass, &wall[i + 1..], height)?;
                }
            }
        }
        *amounts = self.amounts;
        Ok(())
    }

    /// Ends the path; answers what could not be done as asked.
    pub fn finish(&mut self) -> Vec<Warning> {
        self.cutter.leave();
        let entries = self.fallbacks.take().map(|(ramps, plunges, at)| Warning::EntryFallback {
            asked: self.job.entry,
            ramps,
            plunges,
            at,
        });
        entries.into_iter().chain(self.short_leads()).collect()
    }

    /// Which passes wait for roughing to reach the floor and then take the finishing stock off the
    /// wall. Where a wall pass would run through full stock, because roughing was nowhere near, it
    /// is cut with roughing, height by height.
    fn last_passes(&self, levels: &[Level], nest: &Nest) -> Vec<bool> {
        if self.job.finish <= 0.0 || levels.len() < 2 {
            return vec![false; nest.passes.len()];
        }
        let roughing = index(&levels[1]);
        let is_near = |e: Element| runs_near(&e, &roughing, self.job.radius());
        let is_last = |p: &Pass| {
            p.level == 0 && levels[0].loops.get(p.index).is_some_and(|s| s.elements().all(is_near))
        };
        nest.passes.iter().map(is_last).collect()
    }

    /// What stands between passes, if they are farther apart than the tool's radius.
    fn crests(&self, roads: &Roads, levels: &[Level], nest: &Nest, slack: f64) -> Vec<Crest> {
        let (tool_radius, flat) = (self.job.radius(), self.job.overlap());
        Crest::all(roads, &Reach { levels, nest, tool_radius, flat, slack })
    }

    /// How wide the passes cut, at all heights.
    fn widths(
        &self,
        ground: &mut Ground,
        (rough, wall): (&[usize], &[usize]),
        heights: usize,
        rank: &[usize],
    ) -> Amounts {
        let Some(roads) = &ground.roads else { return Amounts::default() };
        let Ground { levels, nest, slack, .. } = &*ground;
        let (tool_radius, flat) = (self.job.radius(), self.job.overlap());
        let reach = Reach { levels, nest, tool_radius, flat, slack: *slack };
        let widths = Widths::new(self.job, roads, &reach, rank);
        let full = |order: &[usize]| order.iter().map(|&pass| widths.full[pass]).sum::<f64>();
        let amounts = Amounts {
            full_width_length: heights as f64 * full(rough) + full(wall),
            largest_step: widths.largest_step,
            largest_step_at: widths.at,
            ..Amounts::default()
        };
        ground.fresh = widths.fresh;
        amounts
    }

    fn passes(&mut self, ground: &mut Ground, order: &[usize], height: Height) -> Result<(), Error> {
        for (i, &pass) in order.iter().enumerate() {
            if i % AHEAD == 0 {
                self.lay(ground, &order[i..order.len().min(i + AHEAD)]);
            }
            self.pass(ground, pass, &order[i + 1..], height)?;
        }
        Ok(())
    }

    /// Lays the courses of some long passes side by side, unless they are known from the height before.
    fn lay(&self, ground: &mut Ground, order: &[usize]) {
        let is_new = |pass: &usize| ground.spline(*pass).len() >= LONG && !ground.courses.contains_key(pass);
        let new: Vec<(usize, &ArcSpline, bool)> = order
            .iter()
            .filter(|pass| is_new(pass))
            .map(|&pass| (pass, ground.spline(pass), self.is_backwards(ground, pass)))
            .collect();
        let course = |(pass, spline, is_backwards)| Some((pass, Course::along(spline, is_backwards)?));
        let laid: Vec<(usize, Course)> = new.into_par_iter().filter_map(course).collect();
        ground.laid.extend(laid);
    }

    fn pass(
        &mut self,
        ground: &mut Ground,
        pass: usize,
        rest: &[usize],
        height: Height,
    ) -> Result<(), Error> {
        let course = if let Some(bend) = ground.bend_again(pass) {
            self.afford(bend.begun.elements.len() as u64)?;
            self.along_bend(ground, pass, bend)
        } else {
            let is_backwards = self.is_backwards(ground, pass);
            let laid = ground.laid.remove(&pass);
            let along = || Course::along(ground.spline(pass), is_backwards);
            let Some(course) = laid.or_else(along) else { return Ok(()) };
            self.afford(course.elements.len() as u64)?;
            match self.link(ground, pass, course) {
                Ok(linked) => linked,
                Err(course) => self.approach(ground, (pass, rest), course, height)?,
            }
        };
        let course = ground.as_before(pass, course);
        self.run(ground, pass, &course)?;
        if ground.nest.passes[pass].level == 0 && height.z == self.job.floor() {
            self.spring(&course)?;
        }
        ground.done[pass] = true;
        ground.last = Some(Last { pass, course });
        Ok(())
    }

    /// Once more along a wall, as often as asked: round, or back and forth.
    pub fn spring(&mut self, course: &Course) -> Result<(), Error> {
        let back = if course.closed { course.clone() } else { course.turned() };
        for i in 0..self.job.spring {
            self.afford(course.elements.len() as u64)?;
            let way = if i % 2 == 0 { &back } else { course };
            self.cutter.cut_all(way);
        }
        Ok(())
    }

    pub fn afford(&self, more: u64) -> Result<(), Error> {
        let needed = self.cutter.moves.len() as u64 + more;
        if needed > MAX_MOVES {
            return Err(Error::Effort { what: "the path in moves", needed, limit: MAX_MOVES });
        }
        Ok(())
    }

    /// Loops of a level run with the inner side on the left: climb, as long as the uncut stock is
    /// outside, as it is for wall passes and for all passes from the inside out.
    pub fn is_backwards(&self, ground: &Ground, pass: usize) -> bool {
        let walls = if self.job.finish > 0.0 { 2 } else { 1 };
        let inward = self.job.start == Start::Outside && ground.nest.passes[pass].level >= walls;
        inward != (self.job.direction == Direction::Conventional)
    }
}

impl Ground<'_> {
    pub fn spline(&self, pass: usize) -> &ArcSpline {
        self.nest.spline(self.levels, pass)
    }

    /// The course of a pass as it is known from the height before, if it is the same.
    fn as_before(&mut self, pass: usize, course: Course) -> Course {
        if course.elements.len() < LONG {
            return course;
        }
        match self.courses.get(&pass) {
            Some(known) if known.is_same(&course) => known.clone(),
            _ => {
                course.tally();
                self.courses.insert(pass, course.clone());
                course
            }
        }
    }

    /// Each crest is cut with the last of the passes on its sides. Answers which pass comes when.
    fn settle_crests<'a>(&mut self, order: impl Iterator<Item = &'a usize>) -> Vec<usize> {
        let mut rank = vec![0; self.nest.passes.len()];
        for (i, &pass) in order.enumerate() {
            rank[pass] = i;
        }
        for (i, crest) in self.crests.iter_mut().enumerate() {
            crest.settle(&rank, self.slack);
            if let Some(gate) = crest.gates.first() {
                self.crests_of[gate.pass].push(i);
            }
        }
        rank
    }

    /// Whether a pass is a single place with a loop round it: all that the tool cuts there is within
    /// its reach from that loop, or part of a crest, and plunging there would only harm.
    fn is_covered(&self, pass: usize) -> bool {
        self.spline(pass).is_empty() && !self.nest.outer[pass].is_empty()
    }

    /// Chooses where passes begin that are cut from the wall inward. A closed pass ends where it
    /// began, and only the way outward from a place to its foot on the next pass is sure to be no
    /// longer than the step: so the innermost pass of a chain chooses, and its feet are where the
    /// others begin.
    fn plan_beginnings(&mut self, order: &[usize]) {
        for (i, &pass) in order.iter().enumerate().rev() {
            let Some(course) = Course::along(self.spline(pass), false) else { continue };
            let next = order.get(i + 1);
            let door = self.nest.inner[pass].iter().find(|d| Some(&d.pass) == next).copied();
            let mut place = course.nearest(course.calm_place());
            if let Some(door) = door {
                place = course.nearest(self.begin[door.pass].unwrap_or(door.at));
                if place.distance > self.apart(pass, door.pass) + self.slack {
                    self.begin[door.pass] = Some(door.at);
                    place = course.nearest(door.at);
                }
            }
            self.begin[pass] = Some(place.point);
        }
    }

    /// Difference of the distances of two passes from the wall.
    pub fn apart(&self, a: usize, b: usize) -> f64 {
        (self.distance(a) - self.distance(b)).abs()
    }

    /// Distance of a pass from the wall.
    pub fn distance(&self, pass: usize) -> f64 {
        self.levels[self.nest.passes[pass].level].distance
    }

    /// A place of the pass from which the next one lies straight across, if that is a neighbor.
    pub fn toward(&self, pass: usize, next: Option<usize>) -> Option<Point> {
        let doors = self.nest.outer[pass].iter().chain(&self.nest.inner[pass]);
        doors.into_iter().find(|d| Some(d.pass) == next).map(|d| d.at)
    }
}

/// Whether all of an element lies within a distance of the passes in an index.
///
/// Elements are lines and circles, as passes are: where three places are near one element of a pass, so
/// is what lies between them. Stretches where that changes are halved, down to the distance.
fn runs_near(e: &Element, passes: &RTree<Indexed>, within: f64) -> bool {
    let length = e.length();
    let nearest = |p: Point| passes.nearest_neighbor(&[p.x, p.y]).map(|found| found.element);
    let is_near = |p: Point| nearest(p).is_some_and(|n| n.distance(p) <= within);
    let mut stretches = vec![(0.0, 1.0)];
    while let Some((from, to)) = stretches.pop() {
        let middle = 0.5 * (from + to);
        let Some(n) = nearest(e.point_at(middle)) else { return false };
        if n.distance(e.point_at(middle)) > within {
            return false;
        }
        let [start, end] = [from, to].map(|t| e.point_at(t));
        if n.distance(start) <= within && n.distance(end) <= within {
            continue;
        }
        if !(is_near(start) && is_near(end)) {
            return false;
        }
        if length * (to - from) > within {
            stretches.extend([(from, middle), (middle, to)]);
        }
    }
    true
}
