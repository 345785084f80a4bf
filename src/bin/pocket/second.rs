//! The second judge: every level set beside the offset of the same pocket by cavalier_contours.

use crate::plan::Plan;
use medial::{Disagreement, DisagreementKind, Party};
use serde::Serialize;

/// As many disagreements as a reader of the text report gets to see.
const MAX_LINES: usize = 10;

/// What the second judge says of all levels.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Second {
    /// Number of levels compared.
    pub levels: usize,
    pub max_deviation: f64,
    /// Where the two differ, and who is wrong by exact distance.
    pub disagreements: Vec<Disagreement>,
    /// What was not compared, and why.
    pub not_compared: Vec<String>,
    /// Number of disagreements, listed or not.
    #[serde(skip)]
    count: usize,
}

impl Second {
    /// Asks the second judge; `None` where it is not built in.
    #[cfg(not(feature = "verify"))]
    pub fn of(_: &Plan) -> Option<Second> {
        None
    }

    /// Asks the second judge; `None` where it is not built in.
    #[cfg(feature = "verify")]
    pub fn of(plan: &Plan) -> Option<Second> {
        /// Most pairs of elements for all offsets of a job, of which each takes 1.4 ns at worst.
        const MAX_PAIRS: u64 = 20_000_000_000;
        let mut second = Second::default();
        let mut pairs = MAX_PAIRS;
        for (i, (pocket, path)) in plan.pockets.iter().zip(&plan.path.pockets).enumerate() {
            let levels = &path.levels;
            let name = |count: usize| format!("{count} levels of pocket {}", i + 1);
            match medial::verify::SecondJudge::new(pocket.loops()) {
                Ok(judge) => {
                    let affordable = usize::try_from(pairs / judge.pairs().max(1)).unwrap_or(usize::MAX);
                    let (asked, rest) = levels.split_at(affordable.min(levels.len()));
                    pairs -= judge.pairs() * asked.len() as u64;
                    second.ask(&judge, asked);
                    if !rest.is_empty() {
                        let limit = "the limit of effort for a job is reached";
                        second.not_compared.push(format!("{}: {limit}", name(rest.len())));
                    }
                }
                Err(error) => second.not_compared.push(format!("{}: {error}", name(levels.len()))),
            }
        }
        Some(second)
    }

    /// Compares some levels of one pocket.
    #[cfg(feature = "verify")]
    fn ask(&mut self, judge: &medial::verify::SecondJudge, levels: &[medial::Level]) {
        use rayon::prelude::*;
        let compare = |level: &medial::Level| judge.level(level.distance, &crate::verdict::curves(level));
        let answers: Vec<_> = levels.par_iter().map(compare).collect();
        for (level, answer) in levels.iter().zip(answers) {
            match answer {
                Ok(comparison) => {
                    self.levels += 1;
                    self.max_deviation = self.max_deviation.max(comparison.max_deviation);
                    self.count += comparison.disagreement_count;
                    self.disagreements.extend(comparison.disagreements);
                }
                Err(error) => self.not_compared.push(format!("level {}: {error}", level.distance)),
            }
        }
    }

    /// As lines of the text report.
    pub fn text(&self) -> String {
        let mut text = format!(
            "  cavalier_contours: {} levels, {} disagreements, largest deviation {:.3e}\n",
            self.levels, self.count, self.max_deviation
        );
        for d in self.disagreements.iter().take(MAX_LINES) {
            text += &line(d);
        }
        let more = self.count.saturating_sub(MAX_LINES);
        if more > 0 {
            text += &format!("    and {more} more\n");
        }
        for reason in &self.not_compared {
            text += &format!("  not compared with cavalier_contours: {reason}\n");
        }
        text
    }
}

/// Who is wrong, where, and by how much.
fn line(d: &Disagreement) -> String {
    let who = match d.wrong {
        Party::Ours => "this program",
        Party::Theirs => "cavalier_contours",
    };
    let by = match d.kind {
        DisagreementKind::Missing => format!("the nearest is {:.3e} away", d.deviation),
        DisagreementKind::Phantom => format!("its distance is off by {:.3e}", d.error),
    };
    format!("    level {}: {who} has {} at {}; {by}\n", d.distance, d.kind, d.at)
}
