//! What the command line means, once the unit of the job is known.

use crate::args::{
    ArcsArg, Args, CoolantArg, DirectionArg, EntryArg, OrderArg, PostArg, StartArg, StrategyArg,
};
use crate::failure::Failure;
use crate::length::{Length, Step};
use crate::notice::short;
use crate::reading::UnitsArg;
use medial::Units;
use medial::io::gcode::{ArcWords, Coolant, Setup};
use medial::toolpath::{Direction, Entry, Job, Order, Start, Strategy};

/// Step in percent of the tool, when only the tool is given.
const DEFAULT_PERCENT: f64 = 40.0;

impl Args {
    /// Whether the options fit together, as far as that can be said without the drawing.
    pub fn check(&self) -> Result<(), Failure> {
        if let (Some(Step::Percent(_)), None) = (self.step, self.tool) {
            return Err(Failure::usage(
                "--step in % needs the tool that it is a share of",
                "add --tool, or give the step as a length: --step 0.5",
            ));
        }
        match self.reading.units {
            Some(UnitsArg::Mm) => self.job(Units::Mm).map(drop),
            Some(UnitsArg::In) => self.job(Units::Inch).map(drop),
            // Options in mixed units may fit together in one unit alone; the drawing decides.
            None => self.job(Units::Mm).or_else(|e| self.job(Units::Inch).map_err(|_| e)).map(drop),
        }
    }

    /// The tool and what it shall do.
    pub fn job(&self, units: Units) -> Result<Job, Failure> {
        let (tool, step) = self.tool_and_step(units)?;
        let defaults = Job::new(units, tool, step);
        let or = |length: Option<Length>, default: f64| length.map_or(default, |l| l.to(units));
        let job = Job {
            depth: or(self.depth, defaults.depth),
            top: or(self.top, defaults.top),
            step_down: self.step_down.map(|l| l.to(units)),
            stock: or(self.stock, defaults.stock),
            floor_stock: or(self.floor_stock, defaults.floor_stock),
            finish: or(self.finish, defaults.finish),
            lead: self.lead.map(|l| l.to(units)),
            spring: self.spring,
            direction: match self.direction {
                DirectionArg::Climb => Direction::Climb,
                DirectionArg::Conventional => Direction::Conventional,
            },
            strategy: match self.strategy {
                StrategyArg::Offset => Strategy::Offset,
            },
            start: match self.start {
                StartArg::Inside => Start::Inside,
                StartArg::Outside => Start::Outside,
            },
            order: match self.order {
                OrderArg::Pocket => Order::Pocket,
                OrderArg::Level => Order::Level,
            },
            entry: match self.entry {
                EntryArg::Helix => Entry::Helix,
                EntryArg::Ramp => Entry::Ramp,
                EntryArg::Plunge => Entry::Plunge,
            },
            slot: self.slot,
            ramp_angle: self.ramp_angle,
            feed: or(self.feed, defaults.feed),
            slow: self.slow,
            acceleration: or(self.acceleration, defaults.acceleration),
            plunge_feed: or(self.plunge_feed, defaults.plunge_feed),
            clearance: or(self.clearance, defaults.clearance),
            retract: or(self.retract, defaults.retract.min(or(self.clearance, defaults.clearance))),
            ..defaults
        };
        job.validate()?;
        Ok(job)
    }

    fn tool_and_step(&self, units: Units) -> Result<(f64, f64), Failure> {
        let tool = self.tool.map(|l| l.to(units));
        match (tool, self.step) {
            (None, Some(Step::Length(step))) => Ok((2.0 * step.to(units), step.to(units))),
            (Some(tool), Some(Step::Length(step))) => Ok((tool, step.to(units))),
            (Some(0.0), _) => Err(Failure::usage(
                "--tool 0 needs a step that is a length",
                "say how far the level sets lie apart: --step 0.5",
            )),
            // The whole tool is never more than the tool, by no rounding.
            (Some(tool), Some(Step::Percent(percent))) => Ok((tool, (tool * percent / 100.0).min(tool))),
            (Some(tool), None) => Ok((tool, tool * DEFAULT_PERCENT / 100.0)),
            (None, _) => Err(Failure::usage(
                "the size of the tool is not known",
                "add --tool, or give the step as a length: --step 0.5",
            )),
        }
    }

    /// What the program needs besides its moves.
    pub fn setup(&self, job: &Job, source: &str) -> Result<Setup, Failure> {
        let defaults = Setup::new(job.units);
        let setup = Setup {
            decimals: self.decimals.unwrap_or(defaults.decimals),
            arcs: match self.arcs {
                ArcsArg::Ijk => ArcWords::Ijk,
                ArcsArg::R => ArcWords::R,
                ArcsArg::Off => ArcWords::Off,
            },
            tolerance: self.reading.tolerance(job.units).fit,
            top: job.top,
            clearance: job.clearance,
            spindle: self.spindle,
            dwell: self.dwell,
            tool_number: self.tool_number,
            coolant: match self.coolant {
                CoolantArg::Off => Coolant::Off,
                CoolantArg::Mist => Coolant::Mist,
                CoolantArg::Flood => Coolant::Flood,
            },
            wcs: self.wcs,
            line_numbers: self.line_numbers,
            comments: self.comments(job, source),
            ..defaults
        };
        setup.check()?;
        Ok(setup)
    }

    fn comments(&self, job: &Job, source: &str) -> Vec<String> {
        let PostArg::Generic = self.post;
        vec![
            format!("pocket {} of {source}", env!("CARGO_PKG_VERSION")),
            format!("tool {} step {} depth {}", short(job.tool), short(job.used_step()), short(job.depth)),
        ]
    }
}
