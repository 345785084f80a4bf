//! What the user asks of the cutter.

use crate::error::Error;
use crate::tolerance::Units;
use serde::{Deserialize, Serialize};

/// On which side of the motion the uncut stock lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Uncut stock on the right of the motion (spindle clockwise, M3).
    #[default]
    Climb,
    /// Uncut stock on the left.
    Conventional,
}

/// Where the clearing of a pocket begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// From the largest disk outward.
    #[default]
    Inside,
    /// From the wall inward.
    Outside,
}

/// What comes first where there is more than one pocket.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// Each pocket down to its floor.
    #[default]
    Pocket,
    /// All pockets height by height: thin walls between them stay stiff.
    Level,
}

/// How the tool gets down into the stock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Entry {
    /// Down a helix; where it does not fit, by a ramp.
    #[default]
    Helix,
    /// Down along the first pass; where that is too short, straight.
    Ramp,
    /// Straight down.
    Plunge,
}

/// The pattern of the passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Strategy {
    /// Level sets of the distance to the wall, one by one.
    #[default]
    Offset,
}

/// A tool and what it shall do. Lengths are in `units`, rates in `units` per minute, the ramp angle
/// in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// Unit of all lengths of this job and of the pockets.
    pub units: Units,
    /// Tool diameter; 0 asks for the level sets alone, at `step`, 2 `step`, ...
    pub tool: f64,
    /// Largest difference of distance between neighboring levels.
    pub step: f64,
    /// Depth of the floor below the top.
    pub depth: f64,
    /// Height of the top of the stock.
    pub top: f64,
    /// Largest depth per level; half the tool when not given.
    pub step_down: Option<f64>,
    /// Material left on walls.
    pub stock: f64,
    /// Material left on the floor.
    pub floor_stock: f64,
    /// Where positive: material that roughing leaves on the wall for one more pass at full depth.
    pub finish: f64,
    /// How often the wall passes are run once more at the floor, where the tool was bent away.
    pub spring: u32,
    /// Radius of the arcs onto finishing passes and off them; the tool's radius when not given, none
    /// when 0.
    pub lead: Option<f64>,
    /// On which side the uncut stock lies.
    pub direction: Direction,
    /// The pattern of the passes.
    pub strategy: Strategy,
    /// Where a pocket begins.
    pub start: Start,
    /// Whether pockets are cut one after the other or height by height.
    pub order: Order,
    /// How the tool gets down.
    pub entry: Entry,
    /// Whether links may cut through stock as wide as the tool, where nothing beside a pass is cut yet:
    /// through a neck instead of over it.
    pub slot: bool,
    /// Slope of ramps, in degrees.
    pub ramp_angle: f64,
    /// Feed rate of cuts.
    pub feed: f64,
    /// Share of the feed rate where more is cut than the step: on first passes, in necks and corners.
    pub slow: f64,
    /// Feed rate straight down, and of the downward part of a ramp at most.
    pub plunge_feed: f64,
    /// Largest acceleration of the machine in `units` per second squared, for the estimate of time and
    /// the choice between links and lifts.
    pub acceleration: f64,
    /// Height of rapids above the top.
    pub clearance: f64,
    /// Height above the stock where feed begins.
    pub retract: f64,
}

impl Job {
    /// A job with the defaults of its unit, for a tool diameter and a step.
    pub fn new(units: Units, tool: f64, step: f64) -> Job {
        let [depth, clearance, retract, feed, plunge_feed, acceleration] = match units {
            Units::Mm => [1.0, 5.0, 1.0, 600.0, 200.0, 500.0],
            Units::Inch => [0.04, 0.2, 0.04, 24.0, 8.0, 20.0],
        };
        Job {
            units,
            tool,
            step,
            depth,
            top: 0.0,
            step_down: None,
            stock: 0.0,
            floor_stock: 0.0,
            finish: 0.0,
            spring: 0,
            lead: None,
            direction: Direction::Climb,
            strategy: Strategy::Offset,
            start: Start::Inside,
            order: Order::Pocket,
            entry: Entry::Helix,
            slot: false,
            ramp_angle: 3.0,
            feed,
            slow: 1.0,
            plunge_feed,
            acceleration,
            clearance,
            retract,
        }
    }

    /// Whether every number is in its range.
    ///
    /// # Errors
    /// [`Error::Parameter`] for the first one that is not.
    pub fn validate(&self) -> Result<(), Error> {
        let at_least_0 = |name, value: f64| require(name, value, value >= 0.0, "0 or more");
        let above_0 = |name, value: f64| require(name, value, value > 0.0, "above 0");
        at_least_0("tool", self.tool)?;
        above_0("step", self.step)?;
        if self.tool > 0.0 {
            require("step", self.step, self.step <= self.tool, "at most the tool diameter")?;
        }
        require("top", self.top, true, "a finite number")?;
        above_0("depth", self.depth)?;
        if let Some(step_down) = self.step_down {
            above_0("step-down", step_down)?;
        }
        at_least_0("stock", self.stock)?;
        at_least_0("floor-stock", self.floor_stock)?;
        require("floor-stock", self.floor_stock, self.floor_stock < self.depth, "less than the depth")?;
        at_least_0("finish", self.finish)?;
        let widest = if self.tool > 0.0 { self.step.min(0.5 * self.tool) } else { self.step };
        require("finish", self.finish, self.finish <= widest, "at most the step and half the tool")?;
        if let Some(lead) = self.lead {
            at_least_0("lead", lead)?;
        }
        require(
            "ramp-angle",
            self.ramp_angle,
            self.ramp_angle > 0.0 && self.ramp_angle < 90.0,
            "above 0 and below 90 degrees",
        )?;
        above_0("feed", self.feed)?;
        require("slow", self.slow, self.slow > 0.0 && self.slow <= 1.0, "above 0 and at most 1")?;
        above_0("plunge-feed", self.plunge_feed)?;
        above_0("acceleration", self.acceleration)?;
        above_0("clearance", self.clearance)?;
        above_0("retract", self.retract)?;
        require("retract", self.retract, self.retract <= self.clearance, "at most the clearance")
    }

    /// Height of the floor that is cut.
    pub(super) fn floor(&self) -> f64 {
        self.top - self.depth + self.floor_stock
    }

    /// Radius of the tool.
    pub fn radius(&self) -> f64 {
        0.5 * self.tool
    }

    /// The step that is used: the one asked for, less where neighboring cuts would not overlap.
    pub fn used_step(&self) -> f64 {
        if self.tool > 0.0 { self.step.min(self.tool - self.overlap()) } else { self.step }
    }

    /// Least width on which neighboring cuts overlap, so that nothing stands between them by
    /// round-off, or where chords stand for a curve of the axis.
    pub(super) fn overlap(&self) -> f64 {
        /// Share of the tool's diameter: too little to matter for the time, far more than round-off.
        const OVERLAP: f64 = 1.0 / 256.0;
        OVERLAP * self.tool
    }

    /// Distance of the wall passes from the drawn wall.
    pub fn wall_distance(&self) -> f64 {
        self.radius() + self.stock
    }

    /// Depth levels from the top down: heights of the tool's tip. Equal steps, the last exactly at
    /// the floor.
    pub fn heights(&self) -> Vec<f64> {
        /// Round-off of the quotient of two lengths that come from decimal numbers: three
        /// roundings, so that depth 0.3 in steps of 0.1 is three levels.
        const QUOTIENT_ERROR: f64 = 4.0 * f64::EPSILON;
        let depth = self.depth - self.floor_stock;
        let step_down = self.step_down.unwrap_or(if self.tool > 0.0 { self.radius() } else { depth });
        let quotient = depth / step_down;
        let count = (quotient * (1.0 - QUOTIENT_ERROR)).ceil().max(1.0);
        let floor = self.floor();
        let height = |i: f64| if i == count { floor } else { self.top - depth * (i / count) };
        (1..=count.min(MAX_HEIGHTS as f64) as u64).map(|i| height(i as f64)).collect()
    }

    /// As many heights as there would be without a limit on effort, saturating.
    pub(super) fn height_count(&self) -> u64 {
        let depth = self.depth - self.floor_stock;
        (depth / self.step_down.unwrap_or(self.radius())).ceil().max(1.0) as u64
    }
}

/// Largest number of depth levels.
pub(super) const MAX_HEIGHTS: u64 = 1_000_000;

fn require(name: &'static str, value: f64, holds: bool, range: &'static str) -> Result<(), Error> {
    if value.is_finite() && holds { Ok(()) } else { Err(Error::Parameter { name, value, range }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(change: impl Fn(&mut Job)) -> bool {
        let mut job = Job::new(Units::Mm, 6.0, 2.4);
        change(&mut job);
        matches!(job.validate(), Err(Error::Parameter { .. }))
    }

    #[test]
    fn defaults_are_valid_in_both_units() {
        for units in [Units::Mm, Units::Inch] {
            Job::new(units, 0.25, 0.1).validate().unwrap();
        }
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refused(|j| j.step = bad), "step {bad}");
            assert!(refused(|j| j.depth = bad));
            assert!(refused(|j| j.step_down = Some(bad)));
            assert!(refused(|j| j.feed = bad));
            assert!(refused(|j| j.plunge_feed = bad) && refused(|j| j.slow = bad));
            assert!(bad == 0.0 || refused(|j| j.lead = Some(bad)));
            assert!(refused(|j| j.clearance = bad) && refused(|j| j.acceleration = bad));
            assert!(refused(|j| j.ramp_angle = bad));
        }
        assert!(refused(|j| j.step = 6.1) && !refused(|j| j.step = 6.0));
        assert!(refused(|j| j.tool = f64::NAN) && refused(|j| j.tool = -1.0));
        assert!(refused(|j| j.finish = 2.5) && refused(|j| j.stock = -0.1));
        assert!(refused(|j| j.floor_stock = 1.0) && refused(|j| j.top = f64::NAN));
    }

    #[test]
    fn depth_levels_are_equal_and_end_exactly_at_the_floor() {
        let mut job = Job { depth: 5.0, step_down: Some(1.5), top: 2.0, ..Job::new(Units::Mm, 6.0, 2.4) };
        assert_eq!(job.heights(), [0.75, -0.5, -1.75, -3.0]);
        job.floor_stock = 0.2;
        assert_eq!(job.heights().len(), 4);
        assert_eq!(*job.heights().last().unwrap(), 2.0 - 5.0 + 0.2);
    }

    #[test]
    fn a_depth_that_is_a_multiple_of_the_step_down_takes_no_extra_level() {
        let job = |depth, down| Job { depth, step_down: Some(down), ..Job::new(Units::Mm, 6.0, 2.4) };
        assert_eq!(job(0.3, 0.1).heights().len(), 3);
        assert_eq!(job(0.7, 0.1).heights().len(), 7);
        assert_eq!(job(6.0, 3.0).heights().len(), 2);
        assert_eq!(job(0.300_001, 0.1).heights().len(), 4);
    }
}
