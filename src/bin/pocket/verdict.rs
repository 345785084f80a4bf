//! `--verify`: every level set before the judge.

use crate::plan::Plan;
use medial::ArcSpline;
use medial::verify::{self, LevelReport};
use serde::Serialize;

/// What the judge says of all levels.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Verdict {
    pub levels: usize,
    pub max_deviation: f64,
    pub cavalier_contours: Second,
    #[serde(skip)]
    pub wrong: Vec<LevelReport>,
}

/// What the second judge says; it is not asked yet.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Second {
    pub levels: usize,
    pub max_deviation: f64,
    pub disagreements: Vec<String>,
}

impl Verdict {
    /// Asks the judge.
    pub fn of(plan: &Plan) -> Verdict {
        let mut verdict = Verdict::default();
        for (pocket, path) in plan.pockets.iter().zip(&plan.path.pockets) {
            for level in &path.levels {
                let offsets: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
                let report = verify::level(pocket.loops(), level.distance, &offsets);
                verdict.levels += 1;
                verdict.max_deviation = verdict.max_deviation.max(report.max_deviation);
                if !report.is_right() {
                    verdict.wrong.push(report);
                }
            }
        }
        verdict
    }

    /// Whether every level is right.
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
        text
    }
}
