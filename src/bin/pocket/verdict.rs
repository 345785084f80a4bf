//! `--verify`: every level set before the judges.

use crate::plan::Plan;
use crate::second::Second;
use medial::verify::{self, LevelReport};
use medial::{ArcSpline, Level};
use serde::Serialize;

/// What the judges say of all levels.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Verdict {
    pub levels: usize,
    pub max_deviation: f64,
    /// The second judge, where it is built in.
    pub cavalier_contours: Option<Second>,
    #[serde(skip)]
    pub wrong: Vec<LevelReport>,
}

impl Verdict {
    /// Asks the judges.
    pub fn of(plan: &Plan) -> Verdict {
        let mut verdict = Verdict { cavalier_contours: Second::of(plan), ..Verdict::default() };
        for (pocket, path) in plan.pockets.iter().zip(&plan.path.pockets) {
            for level in &path.levels {
                let report = verify::level(pocket.loops(), level.distance, &curves(level));
                verdict.levels += 1;
                verdict.max_deviation = verdict.max_deviation.max(report.max_deviation);
                if !report.is_right() {
                    verdict.wrong.push(report);
                }
            }
        }
        verdict
    }

    /// Whether the exact judge calls every level right.
    pub fn is_right(&self) -> bool {
        self.wrong.is_empty()
    }

    /// As lines of the text report.
    pub fn text(&self) -> String {
        let mut text = format!(
            "verify: {} levels, {} refused, largest deviation {:.3e}\n",
            self.levels,
            self.wrong.len(),
            self.max_deviation
        );
        for report in &self.wrong {
            let first = report.faults.first();
            let first = first
                .map_or(String::new(), |f| format!(", the first at {}: {}, by {:.3e}", f.at, f.kind, f.by));
            text += &format!("  level {}: {} faults{first}\n", report.distance, report.fault_count);
        }
        match &self.cavalier_contours {
            Some(second) => text += &second.text(),
            None => text += "  not compared with cavalier_contours: built without the feature verify\n",
        }
        text
    }
}

/// The loops and ridges of a level.
pub fn curves(level: &Level) -> Vec<ArcSpline> {
    level.loops.iter().chain(&level.ridges).cloned().collect()
}
