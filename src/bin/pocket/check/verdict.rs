//! What is said of offsets: all of it, as JSON for programs.

use super::offsets::Offsets;
use crate::notice::Notice;
use medial::io::svg::Picture;
use medial::verify::Boundary;
use medial::{Fault, FaultKind, Level, LevelReport, Pocket, Point, Units};
use serde::Serialize;

/// Offsets that were judged. Lengths are in the unit of the job.
#[derive(Serialize)]
pub struct Verdict {
    pub source: String,
    pub offsets: String,
    pub units: Units,
    pub outward: bool,
    /// Largest deviation that counts as none.
    pub within: f64,
    pub right: bool,
    /// Largest deviation of a curve from its distance, over all levels.
    pub max_deviation: f64,
    pub max_deviation_at: Option<Point>,
    pub levels: Vec<LevelVerdict>,
    pub warnings: Vec<Notice>,
    #[serde(skip)]
    pub pockets: Vec<Pocket>,
    #[serde(skip)]
    pub curves: Vec<Level>,
}

/// One level.
#[derive(Serialize)]
pub struct LevelVerdict {
    pub distance: f64,
    pub loops: usize,
    pub area: f64,
    /// Number of places looked at.
    pub places: usize,
    pub max_deviation: f64,
    pub max_deviation_at: Option<Point>,
    pub fault_count: usize,
    /// Parts that are missing, the longest first.
    pub missing: Vec<Fault>,
    /// Parts that should not be there: phantoms, and what is misplaced.
    pub phantom: Vec<Fault>,
    /// What else is wrong.
    pub other: Vec<Fault>,
}

impl Verdict {
    /// Judges all levels.
    pub fn judge(&mut self, boundary: &Boundary, offsets: &[Offsets]) {
        for level in offsets {
            let curves = boundary.turned(&level.curves);
            let report = if self.outward {
                boundary.judge_outward(level.distance, &curves, self.within)
            } else {
                boundary.judge(level.distance, &curves, self.within)
            };
            self.right &= report.is_right();
            if self.max_deviation_at.is_none() || report.max_deviation > self.max_deviation {
                (self.max_deviation, self.max_deviation_at) = (report.max_deviation, report.max_deviation_at);
            }
            self.levels.push(LevelVerdict::from(report));
            let (loops, ridges) = curves.into_iter().partition(|c| c.closed);
            self.curves.push(Level { distance: level.distance, loops, ridges });
        }
    }

    /// One object and a line feed.
    pub fn json(&self) -> String {
        serde_json::to_string(self).map_or_else(|e| format!("{{\"error\":\"{e}\"}}\n"), |text| text + "\n")
    }

    /// All faults that are listed, numbered through.
    pub fn faults(&self) -> impl Iterator<Item = (usize, &Fault)> {
        (1..).zip(self.levels.iter().flat_map(LevelVerdict::faults))
    }

    /// Pockets, offsets, and the faults with their numbers.
    pub fn picture(&self) -> String {
        let marks = self.faults().map(|(number, f)| (f.at, number, super::text::fault(f, self.units)));
        let picture = Picture::new(self.units).title(&self.offsets).pockets(&self.pockets);
        picture.levels(&self.curves).numbered(marks).to_svg()
    }
}

impl LevelVerdict {
    /// The faults in the order in which they are told.
    pub fn faults(&self) -> impl Iterator<Item = &Fault> {
        self.missing.iter().chain(&self.phantom).chain(&self.other)
    }
}

impl From<LevelReport> for LevelVerdict {
    fn from(report: LevelReport) -> LevelVerdict {
        let of =
            |kind: FaultKind| report.faults.iter().filter(|f| f.kind == kind).copied().collect::<Vec<_>>();
        let named = |f: &Fault| matches!(f.kind, FaultKind::Missing | FaultKind::Distance);
        let mut phantom = of(FaultKind::Distance);
        phantom.sort_by(|a, b| b.by.total_cmp(&a.by));
        LevelVerdict {
            distance: report.distance,
            loops: report.loops,
            area: report.area,
            places: report.places,
            max_deviation: report.max_deviation,
            max_deviation_at: report.max_deviation_at,
            fault_count: report.fault_count,
            missing: of(FaultKind::Missing),
            phantom,
            other: report.faults.iter().filter(|f| !named(f)).copied().collect(),
        }
    }
}
