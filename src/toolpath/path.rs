//! From the axes of the pockets to one path.

use super::amounts::Amounts;
use super::cutter::Totals;
use super::job::MAX_HEIGHTS;
use super::plan::{MAX_MOVES, Planner, Prepared};
use super::ready::{Ready, batches};
use super::rest::Rest;
use super::route::route;
use super::time::Timer;
use super::{Job, Moves, Order, Warning};
use crate::error::Error;
use crate::geom::{Element, Point};
use crate::mat::Mat;
use crate::offset::Level;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Largest number of levels of a pocket.
const MAX_LEVELS: u64 = 1_000_000;

/// How many levels are computed before their size is looked at.
const LEVELS_AT_ONCE: u64 = 256;

/// Moves for all pockets and what they amount to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The moves; none when the tool diameter is 0.
    pub moves: Moves,
    /// The pockets, in the order given; they are cut in an order of short ways between them.
    pub pockets: Vec<PocketPath>,
    /// Lengths, counts and time.
    pub totals: Totals,
    /// What could not be done as asked.
    pub warnings: Vec<Warning>,
}

/// What became of one pocket. Lengths and areas in job units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PocketPath {
    /// The level sets that are used, outermost first.
    pub levels: Vec<Level>,
    /// Which of the moves cut this pocket: one range, or one for each height where all pockets are cut
    /// height by height.
    pub moves: Vec<Range<usize>>,
    /// Loops and ridges cut, counted once for each height.
    pub passes: usize,
    /// What is cut besides, and how wide.
    #[serde(flatten)]
    pub amounts: Amounts,
    /// As often as the tool needs to be lifted: at every height once for each peak of the radius that
    /// the tool reaches, and as often for finishing passes, but once less as they begin at depth.
    pub most_retracts: usize,
    /// Lengths, counts and time of this pocket alone, the way to it included.
    pub totals: Totals,
    /// Largest tool diameter that fits, less the stock to leave on both sides.
    pub largest_tool: f64,
    /// Area that the tool cannot reach, the stock to leave included. An axis [from a radius
    /// up](crate::Pocket::medial_axis_above) does not tell it, nor the two below.
    pub unreachable_area: Option<f64>,
    /// The places of that area, that which reaches farthest beyond the tool first: at most a thousand.
    pub unreachable: Vec<Rest>,
    /// Width of the narrowest neck, where there is one.
    pub narrowest_neck: Option<f64>,
    /// Whether the tool fits anywhere.
    pub machined: bool,
}

impl PocketPath {
    /// Cuts some heights and adds up what that amounts to.
    fn cut(
        &mut self,
        planner: &mut Planner,
        pocket: &mut Prepared,
        heights: Range<usize>,
    ) -> Result<(), Error> {
        let (before, totals) = (planner.cutter.moves.len(), planner.cutter.totals);
        planner.cut(pocket, heights)?;
        planner.cutter.leave();
        self.passes = pocket.passes();
        self.amounts = pocket.amounts;
        self.totals = self.totals.and(&planner.cutter.totals.since(&totals));
        self.moves.push(before..planner.cutter.moves.len());
        Ok(())
    }
}

impl Job {
    /// Plans the path through pockets given by their axes. Axes [from the distance of the wall passes
    /// up](crate::Pocket::medial_axis_above) do, where nobody asks what is out of reach.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a number out of its range, [`Error::Effort`] when levels or moves
    /// are too many, [`Error::NothingToMachine`] when the tool fits nowhere.
    pub fn path(&self, mats: &[Mat]) -> Result<Path, Error> {
        let levels = mats.iter().map(|mat| self.levels(mat)).collect::<Result<Vec<_>, _>>()?;
        self.path_along(mats, levels)
    }

    /// The level sets of a pocket that the path follows, outermost first; none when the tool fits
    /// nowhere.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a number out of its range, [`Error::Effort`] when they are too many.
    pub fn levels(&self, mat: &Mat) -> Result<Vec<Level>, Error> {
        self.validate()?;
        let least = mat.least_radius();
        if least > self.distance(0) {
            let (name, range) =
                ("the radius from which on an axis is whole", "that of the wall passes at most");
            return Err(Error::Parameter { name, value: least, range });
        }
        self.levels_up_to(mat.largest_disk().radius, &|d| mat.level(d))
    }

    /// Plans the path along [levels](Job::levels) that are known already, those of each pocket.
    ///
    /// # Errors
    /// As for [`Job::path`].
    pub fn path_along(&self, mats: &[Mat], levels: Vec<Vec<Level>>) -> Result<Path, Error> {
        self.validate()?;
        // From within a pool, work in parallel on thousands of small pockets begins at once.
        rayon::scope(|_| self.planned(mats, levels))
    }

    fn planned(&self, mats: &[Mat], levels: Vec<Vec<Level>>) -> Result<Path, Error> {
        let mut path = Path::default();
        self.note_step(&mut path);
        let mut planner = Planner::new(self);
        let unreachable = || -> Vec<Option<f64>> {
            let area = |mat: &Mat| is_whole(mat).then(|| mat.unreachable_area(self.wall_distance()));
            mats.par_iter().map(area).collect()
        };
        let cut = || {
            let of_pocket = |(mat, levels): (&Mat, &Vec<Level>)| PocketPath {
                largest_tool: 2.0 * (mat.largest_disk().radius - self.stock),
                narrowest_neck: mat.narrowest_neck().filter(|_| is_whole(mat)).map(|d| 2.0 * d.radius),
                machined: !levels.is_empty(),
                ..PocketPath::default()
            };
            let mut pockets: Vec<PocketPath> = mats.iter().zip(&levels).map(of_pocket).collect();
            if self.tool > 0.0 {
                self.cut(&mut planner, &mut pockets, mats, &levels)?;
            }
            Ok(pockets)
        };
        let (areas, pockets) = rayon::join(unreachable, cut);
        path.pockets = pockets?;
        for (i, (area, levels)) in areas.into_iter().zip(levels).enumerate() {
            path.pockets[i].unreachable_area = area;
            path.pockets[i].levels = levels;
            self.note_room(&mut path, i, &mats[i]);
        }
        self.conclude(path, planner)
    }

    /// In which order pockets are cut.
    fn order(&self, mats: &[Mat], pockets: &[PocketPath]) -> Vec<usize> {
        let machined: Vec<usize> = (0..pockets.len()).filter(|&i| pockets[i].machined).collect();
        let places: Vec<Point> = machined.iter().map(|&i| mats[i].largest_disk().center).collect();
        route(&places).into_iter().map(|i| machined[i]).collect()
    }

    /// Cuts the pockets one after the other, or all of them height by height.
    fn cut(
        &self,
        planner: &mut Planner,
        pockets: &mut [PocketPath],
        mats: &[Mat],
        levels: &[Vec<Level>],
    ) -> Result<(), Error> {
        let order = self.order(mats, pockets);
        let clear = |mat| move |link: &Element, radius: f64| Mat::is_clear(mat, link, radius);
        let is_clear: Vec<_> = mats.iter().map(clear).collect();
        let ready =
            |planner: &Planner, i: usize| Ready::new(planner, i, (&mats[i], &levels[i]), &is_clear[i]);
        let heights = self.heights().len();
        if self.order == Order::Pocket {
            for some in batches(&order, |i| mats[i].counts().sites) {
                let all: Vec<Ready> = some.par_iter().map(|&i| ready(planner, i)).collect();
                for ready in all {
                    let (i, mut pocket) = ready.noted_in(pockets);
                    pockets[i].cut(planner, &mut pocket, 0..heights)?;
                }
            }
            return Ok(());
        }
        let all: Vec<Ready> = order.par_iter().map(|&i| ready(planner, i)).collect();
        let mut prepared: Vec<(usize, Prepared)> =
            all.into_iter().map(|ready| ready.noted_in(pockets)).collect();
        for height in 0..heights {
            for (i, pocket) in &mut prepared {
                pockets[*i].cut(planner, pocket, height..height + 1)?;
            }
        }
        Ok(())
    }

    /// How long it takes, each pocket and all.
    fn estimate(&self, path: &mut Path) {
        let timer = Timer::new(&path.moves, self);
        for own in &mut path.pockets {
            own.totals.minutes = own.moves.iter().map(|range| timer.minutes(range.clone())).sum();
        }
        path.totals.minutes = path.pockets.iter().map(|own| own.totals.minutes).sum();
    }

    fn conclude(&self, mut path: Path, mut planner: Planner) -> Result<Path, Error> {
        path.warnings.extend(planner.finish());
        path.moves = std::mem::take(&mut planner.cutter.moves);
        path.totals = planner.cutter.totals;
        self.estimate(&mut path);
        if path.pockets.iter().any(|p| p.machined) {
            return Ok(path);
        }
        let largest = path.pockets.iter().map(|p| p.largest_tool).fold(f64::NEG_INFINITY, f64::max);
        let reason = if path.pockets.is_empty() {
            "there is no pocket".to_owned()
        } else if self.tool == 0.0 {
            format!("no place of a pocket is farther than {} from the wall", self.distance(0))
        } else if largest > 0.0 {
            format!(
                "the tool of {} is larger than every pocket; the largest that fits is {largest:.4}",
                self.tool
            )
        } else {
            "the stock to leave fills every pocket".to_owned()
        };
        Err(Error::NothingToMachine { reason })
    }

    /// Distances of the levels: that of the wall pass, then equal steps until nothing is left.
    pub(super) fn distance(&self, k: u64) -> f64 {
        let k = k as f64;
        let step = self.used_step();
        if self.tool == 0.0 {
            self.stock + (k + 1.0) * step
        } else if self.finish > 0.0 {
            if k == 0.0 {
                self.wall_distance()
            } else {
                self.wall_distance() + self.finish + (k - 1.0) * step
            }
        } else {
            self.wall_distance() + k * step
        }
    }

    /// The level sets up to the largest radius; the last one may be a ridge alone.
    pub(super) fn levels_up_to(
        &self,
        largest: f64,
        level: &(dyn Fn(f64) -> Level + Sync),
    ) -> Result<Vec<Level>, Error> {
        // One level more than fits, as a level may be left at the largest radius itself.
        let count = ((largest - self.distance(0)) / self.used_step()).max(0.0).ceil() + 2.0;
        if count > MAX_LEVELS as f64 {
            return Err(Error::Effort {
                what: "the number of levels of a pocket",
                needed: count as u64,
                limit: MAX_LEVELS,
            });
        }
        let heights = if self.tool > 0.0 { self.height_count() } else { 1 };
        if heights > MAX_HEIGHTS {
            let what = "the number of heights";
            return Err(Error::Effort { what, needed: heights, limit: MAX_HEIGHTS });
        }
        let mut levels: Vec<Level> = Vec::new();
        let (mut next, mut elements) = (0, 0u64);
        while next < count as u64 {
            let end = (next + LEVELS_AT_ONCE).min(count as u64);
            let some: Vec<Level> = (next..end).into_par_iter().map(|k| level(self.distance(k))).collect();
            let full = some.iter().take_while(|l| !l.is_empty()).count();
            elements += some
                .iter()
                .flat_map(|l| l.loops.iter().chain(&l.ridges))
                .map(|s| s.len() as u64)
                .sum::<u64>();
            let needed = elements.saturating_mul(heights);
            if needed > MAX_MOVES {
                return Err(Error::Effort { what: "the path in moves", needed, limit: MAX_MOVES });
            }
            let stop = full < some.len();
            levels.extend(some.into_iter().take(full));
            if stop {
                break;
            }
            next = end;
        }
        Ok(levels)
    }

    fn note_step(&self, path: &mut Path) {
        if self.used_step() < self.step {
            path.warnings.push(Warning::StepReduced { asked: self.step, used: self.used_step() });
        }
    }

    fn note_room(&self, path: &mut Path, pocket: usize, mat: &Mat) {
        let own = &path.pockets[pocket];
        if !own.machined {
            let (at, largest) = (mat.largest_disk().center, own.largest_tool);
            path.warnings.push(Warning::ToolTooLarge { pocket, at, largest });
        } else if let (Some(neck), Some(area)) = (mat.narrowest_neck(), own.unreachable_area)
            && neck.radius < self.wall_distance()
            && self.tool > 0.0
        {
            path.warnings.push(Warning::NarrowNeck {
                pocket,
                at: neck.center,
                width: 2.0 * (neck.radius - self.stock),
                area,
            });
        }
    }
}

/// Whether an axis tells what is out of reach.
pub(super) fn is_whole(mat: &Mat) -> bool {
    mat.least_radius() == 0.0
}
