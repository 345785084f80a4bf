//! What was done: as text for people or as JSON for programs.

use crate::notice::{Notice, counted, short};
use crate::plan::Plan;
use crate::timings::Timings;
use crate::verdict::Verdict;
use medial::toolpath::{Amounts, PocketPath, Rest, Totals};
use medial::{Pocket, Units};
use serde::Serialize;
use std::fmt::Write;

/// The JSON report.
#[derive(Serialize)]
pub struct Report<'a> {
    source: &'a str,
    units: Units,
    tool: f64,
    step: f64,
    tolerance: f64,
    pockets: Vec<PocketReport<'a>>,
    path: Totals,
    verify: Option<&'a Verdict>,
    warnings: &'a [Notice],
    #[serde(skip_serializing_if = "Option::is_none")]
    timings: Option<Timings>,
}

#[derive(Serialize)]
struct PocketReport<'a> {
    area: f64,
    islands: usize,
    arcs: usize,
    largest_tool: f64,
    unreachable_area: Option<f64>,
    unreachable: &'a [Rest],
    narrowest_neck: Option<f64>,
    passes: usize,
    #[serde(flatten)]
    amounts: Amounts,
    most_retracts: usize,
    path: Totals,
    machined: bool,
}

impl<'a> PocketReport<'a> {
    fn new(pocket: &Pocket, path: &'a PocketPath) -> PocketReport<'a> {
        PocketReport {
            area: pocket.area(),
            islands: pocket.islands().len(),
            arcs: pocket.loops().flat_map(|l| l.elements()).filter(|e| !e.is_segment()).count(),
            largest_tool: path.largest_tool,
            unreachable_area: path.unreachable_area,
            unreachable: &path.unreachable,
            narrowest_neck: path.narrowest_neck,
            passes: path.passes,
            amounts: path.amounts,
            most_retracts: path.most_retracts,
            path: path.totals,
            machined: path.machined,
        }
    }
}

impl PocketReport<'_> {
    /// How much the tool cannot reach.
    fn out_of_reach(&self, unit: &str) -> String {
        self.unreachable_area.map_or(String::new(), |area| format!(", {area:.4} {unit}2 out of reach"))
    }

    /// How the pocket is cut, for people.
    fn details(&self, unit: &str) -> String {
        if self.passes == 0 {
            return String::new();
        }
        let Totals { cut_length, rapid_length, retracts, minutes, .. } = self.path;
        let mut text = format!(
            "  {cut_length:.1} {unit} cut, {:.1} {unit} of it at full width, largest step {:.4} {unit}; \
             {rapid_length:.1} {unit} rapid, {} (at most {} needed), {minutes:.1} min\n",
            self.amounts.full_width_length,
            self.amounts.largest_step,
            counted(retracts, "retract", "retracts"),
            self.most_retracts,
        );
        if self.amounts.slots > 0 {
            let slots = counted(self.amounts.slots, "slot", "slots");
            text += &format!("  {slots} through stock, {:.1} {unit} long\n", self.amounts.slot_length);
        }
        if let Some(rest) = self.unreachable.first() {
            let places = counted(self.unreachable.len(), "place", "places");
            let far = format!("up to {:.4} {unit} beyond the tool at {}", rest.height, rest.at);
            text += &format!("  out of reach in {places}, {far}\n");
        }
        text
    }
}

impl<'a> Report<'a> {
    /// Collects what the plan knows.
    pub fn new(plan: &'a Plan, verify: Option<&'a Verdict>, timings: Option<Timings>) -> Report<'a> {
        let pockets = plan.pockets.iter().zip(&plan.path.pockets);
        Report {
            source: &plan.source,
            units: plan.job.units,
            tool: plan.job.tool,
            step: plan.job.used_step(),
            tolerance: plan.tolerance.fit,
            pockets: pockets.map(|(pocket, path)| PocketReport::new(pocket, path)).collect(),
            path: plan.path.totals,
            verify,
            warnings: &plan.notices,
            timings,
        }
    }

    /// One object and a line feed.
    pub fn json(&self) -> String {
        serde_json::to_string(self).map_or_else(|e| format!("{{\"error\":\"{e}\"}}\n"), |text| text + "\n")
    }

    /// A few lines.
    pub fn text(&self) -> String {
        let unit = match self.units {
            Units::Mm => "mm",
            Units::Inch => "in",
        };
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}: tool {} {unit}, step {} {unit}",
            self.source,
            short(self.tool),
            short(self.step)
        );
        for (i, p) in self.pockets.iter().enumerate() {
            let _ = write!(
                text,
                "pocket {}: area {:.3} {unit}2, {}, {}, largest tool {:.4} {unit}",
                i + 1,
                p.area,
                counted(p.islands, "island", "islands"),
                counted(p.arcs, "arc", "arcs"),
                p.largest_tool
            );
            if let Some(neck) = p.narrowest_neck {
                let _ = write!(text, ", narrowest neck {neck:.4} {unit}");
            }
            let _ = if p.machined {
                let _ = write!(text, ", {}", counted(p.passes, "pass", "passes"));
                if p.amounts.crests > 0 {
                    let crests = counted(p.amounts.crests, "pass", "passes");
                    let _ =
                        write!(text, " and {crests} along the axis ({:.1} {unit})", p.amounts.crest_length);
                }
                let _ = writeln!(text, "{}", p.out_of_reach(unit));
                text.write_str(&p.details(unit))
            } else {
                writeln!(text, ", left out")
            };
        }
        let path = &self.path;
        let _ = writeln!(
            text,
            "path: {:.1} {unit} cut, {:.1} {unit} rapid, {}, {}, {}, {:.1} min",
            path.cut_length,
            path.rapid_length,
            counted(path.retracts, "retract", "retracts"),
            counted(path.arcs, "arc", "arcs"),
            counted(path.lines, "line", "lines"),
            path.minutes
        );
        text += &self.verify.map_or(String::new(), Verdict::text);
        text += &self.timings.map_or(String::new(), |t| t.text());
        text
    }
}
