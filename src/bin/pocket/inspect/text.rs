//! What is told, as text.

use super::contours::PocketReport;
use super::finding::{Finding, Weight};
use super::inspection::Inspection;
use super::run::is_picture;
use crate::notice::{counted, short};
use medial::io::DrawingUnit;
use medial::io::dxf::{Color, KindCount, LayerContent, UnitReason};
use medial::{Bounds, Units};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// As many lines of one table are printed.
const MAX_LINES: usize = 400;

/// As many islands of one pocket are printed.
const MAX_ISLANDS: usize = 20;

/// As many findings of one kind are printed with their cure.
const MAX_HELPS: usize = 10;

/// As many entities of one finding are printed.
const MAX_ENTITIES: usize = 20;

impl Inspection {
    /// Everything, for people.
    pub fn text(&self, outputs: &[PathBuf]) -> String {
        let mut text = self.head();
        text += &self.layers();
        text += &self.kinds();
        text += &self.contours();
        text += &self.findings(Weight::Fault, "faults, which leave something out");
        text += &self.findings(Weight::Note, "notes");
        if let Some(picture) = outputs.iter().find(|p| is_picture(p)) {
            let _ = writeln!(
                text,
                "\nthe numbers stand in the picture {}, those of pockets in gray",
                picture.display()
            );
        }
        text + &self.verdict()
    }

    fn head(&self) -> String {
        let content = &self.content;
        let form = if content.binary { "binary" } else { "text" };
        let version = match (&content.version, content.release) {
            (Some(version), Some(release)) => format!("DXF of release {release} ({version})"),
            (Some(version), None) => format!("DXF of version {version}"),
            (None, _) => "DXF that does not tell its version".into(),
        };
        let mut text = format!("{}: {version}, {form}\n", self.source);
        let (taken, job) = (content.unit.taken, DrawingUnit::from(self.units));
        let _ = writeln!(text, "unit: {taken}, {}; the job is in {job}", self.why_unit());
        let _ = match self.bounds {
            Some(bounds) => writeln!(text, "size: {}", self.extent(bounds)),
            None => writeln!(text, "size: there are no lines and arcs"),
        };
        text
    }

    fn why_unit(&self) -> String {
        let unit = &self.content.unit;
        match (unit.reason, unit.claimed) {
            (UnitReason::Told, Some(claimed)) if claimed != unit.taken => {
                format!("as --dxf-units says; the drawing claims {claimed}")
            }
            (UnitReason::Told, _) => "as --dxf-units says".into(),
            (UnitReason::Claimed, _) => "as the drawing claims".into(),
            (UnitReason::Job, _) => "after --units, as the drawing claims none".into(),
            (UnitReason::Flag, _) => "after its measurement flag, as the drawing claims none".into(),
            (UnitReason::Assumed, _) => "assumed, as the drawing claims none".into(),
        }
    }

    fn unit(&self) -> &'static str {
        match self.units {
            Units::Mm => "mm",
            Units::Inch => "in",
        }
    }

    fn extent(&self, bounds: Bounds) -> String {
        let (size, unit) = (bounds.extent(), self.unit());
        let [x0, y0, x1, y1] = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y].map(rounded);
        format!("{} x {} {unit}, from ({x0}, {y0}) to ({x1}, {y1})", rounded(size.x), rounded(size.y))
    }

    fn layers(&self) -> String {
        let layers = &self.content.layers;
        let mut rows = vec![["layer", "color", "state", "entities"].map(String::from).to_vec()];
        rows.extend(layers.iter().map(|layer| {
            let color = layer.color.map_or("-".into(), |c: Color| c.to_string());
            vec![layer.name.clone(), color, state(layer), amounts(&layer.kinds)]
        }));
        titled(&counted(layers.len(), "layer", "layers"), rows)
    }

    fn kinds(&self) -> String {
        let kinds = &self.content.kinds;
        let total: usize = kinds.values().map(KindCount::total).sum();
        let rows =
            kinds.iter().map(|(kind, count)| vec![kind.clone(), count.total().to_string(), fates(count)]);
        titled(&counted(total, "entity", "entities"), rows.collect())
    }

    fn contours(&self) -> String {
        let islands: usize = self.pockets.iter().map(|p| p.islands.len()).sum();
        let title = format!(
            "{} with {}",
            counted(self.pockets.len(), "pocket", "pockets"),
            counted(islands, "island", "islands")
        );
        if self.pockets.is_empty() {
            return String::new();
        }
        let rows: Vec<Vec<String>> = self.pockets.iter().flat_map(|p| self.contour(p)).collect();
        titled(&title, rows)
    }

    /// The lines of a pocket and its islands.
    fn contour(&self, pocket: &PocketReport) -> Vec<Vec<String>> {
        let unit = self.unit();
        let indent = "  ".repeat(pocket.depth.saturating_sub(self.from_depth).min(20));
        let row = |name: String, area: f64, elements: usize, bounds: Bounds, more: String| {
            let area = format!("{} {unit}2", rounded(area));
            vec![
                format!("{indent}{name}"),
                area,
                counted(elements, "element", "elements"),
                self.extent(bounds),
                more,
            ]
        };
        let tool = pocket.largest_tool.map(|d| format!("largest tool {} {unit}", short(d)));
        let neck = pocket.narrowest_neck.map(|d| format!("narrowest neck {} {unit}", short(d)));
        let more: Vec<String> = tool.into_iter().chain(neck).collect();
        let name = format!("pocket {}", pocket.number);
        let mut rows = vec![row(name, pocket.area, pocket.elements, pocket.bounds, more.join(", "))];
        for island in pocket.islands.iter().take(MAX_ISLANDS) {
            rows.push(row("  island".into(), island.area, island.elements, island.bounds, String::new()));
        }
        let more = pocket.islands.len().saturating_sub(MAX_ISLANDS);
        if more > 0 {
            rows.push(vec![format!("{indent}  and {}", counted(more, "more island", "more islands"))]);
        }
        rows
    }

    fn findings(&self, weight: Weight, title: &str) -> String {
        let findings: Vec<&Finding> = self.findings.iter().filter(|f| f.weight == weight).collect();
        if findings.is_empty() {
            return String::new();
        }
        let width = self.findings.len().to_string().len();
        let mut text = format!("\n{title}: {}\n", findings.len());
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        let mut last_help = "";
        for finding in findings {
            let count = counts.entry(finding.kind).or_default();
            *count += 1;
            let with_help = *count <= MAX_HELPS && finding.help != last_help;
            last_help = &finding.help;
            text += &self.finding(finding, width, with_help);
        }
        text
    }

    fn finding(&self, finding: &Finding, width: usize, with_help: bool) -> String {
        let mut text = format!("  {:>width$}  {}\n", finding.number, finding.message);
        let margin = " ".repeat(width + 4);
        if let Some(at) = finding.at {
            let far = !self.is_in_picture(at);
            if far || !finding.message.contains(&at.to_string()) {
                let far = if far { ", far outside of the part and not in the picture" } else { "" };
                let _ = writeln!(text, "{margin}  at: {at}{far}");
            }
        }
        if with_help {
            let _ = writeln!(text, "{margin}help: {}", finding.help);
        }
        let listed = if finding.entities.len() > 1 { &finding.entities[..] } else { &[] };
        for entity in listed.iter().take(MAX_ENTITIES) {
            let handle = entity.handle.map_or(String::new(), |h| format!(" {h:X}"));
            let at = entity.at.map_or(String::new(), |at| format!(" at {at}"));
            let _ = writeln!(text, "{margin}      {}{handle} ({}){at}", entity.kind, entity.place);
        }
        if listed.len() > MAX_ENTITIES {
            let _ =
                writeln!(text, "{margin}      and {} more, in the JSON report", listed.len() - MAX_ENTITIES);
        }
        text
    }

    /// Whether there is something to machine, and with what.
    fn verdict(&self) -> String {
        if let Some(reason) = &self.reason {
            return format!("\nnothing to machine: {reason}\n");
        }
        let tools: Option<Vec<f64>> = self.pockets.iter().map(|p| p.largest_tool).collect();
        let smallest = tools.and_then(|t| t.into_iter().min_by(f64::total_cmp));
        let tool = match smallest {
            Some(d) => format!("a tool up to {} {} goes into all of them", short(d), self.unit()),
            None => "the largest tool is not known, for too many elements or no axis".into(),
        };
        let count = counted(self.pockets.len(), "pocket", "pockets");
        let tool = if self.pockets.len() == 1 { tool.replace("all of them", "it") } else { tool };
        format!("\n{count} can be machined; {tool}\n")
    }
}

fn state(layer: &LayerContent) -> String {
    let states = [(layer.off, "off"), (layer.frozen, "frozen"), (layer.locked, "locked")];
    let states: Vec<&str> = states.into_iter().filter(|(is, _)| *is).map(|(_, name)| name).collect();
    if states.is_empty() { "on".into() } else { states.join(", ") }
}

fn amounts(kinds: &BTreeMap<String, KindCount>) -> String {
    let all: Vec<String> = kinds.iter().map(|(kind, count)| format!("{} {kind}", count.total())).collect();
    if all.is_empty() { "none".into() } else { all.join(", ") }
}

/// What became of the entities of a kind.
fn fates(count: &KindCount) -> String {
    let KindCount { read, free, not_read, broken, unselected, hidden, paper } = *count;
    let fates = [
        (read, "read"),
        (free, "free-form"),
        (not_read, "not read"),
        (broken, "broken"),
        (unselected, "not selected"),
        (hidden, "hidden"),
        (paper, "in paper space"),
    ];
    let told: Vec<_> = fates.into_iter().filter(|(n, _)| *n > 0).collect();
    match told[..] {
        [(_, fate)] => fate.to_owned(),
        _ => told.iter().map(|(n, fate)| format!("{n} {fate}")).collect::<Vec<_>>().join("; "),
    }
}

/// A number with about six digits that matter.
fn rounded(value: f64) -> String {
    let decimals = (5.0 - value.abs().log10().floor()).clamp(0.0, 9.0);
    let text = format!("{value:.*}", decimals as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// A table below its title, with columns of equal width.
fn titled(title: &str, rows: Vec<Vec<String>>) -> String {
    let mut widths: Vec<usize> = Vec::new();
    for row in rows.iter().take(MAX_LINES) {
        // What ends a line needs no room.
        for (column, cell) in row.iter().enumerate().take(row.len().saturating_sub(1)) {
            if widths.len() <= column {
                widths.push(0);
            }
            widths[column] = widths[column].max(cell.chars().count());
        }
    }
    let mut text = format!("\n{title}\n");
    for row in rows.iter().take(MAX_LINES) {
        let cells = row.iter().enumerate().map(|(i, cell)| {
            let width = if i + 1 == row.len() { 0 } else { widths[i] };
            format!("  {cell:<width$}")
        });
        let line: String = cells.collect();
        let _ = writeln!(text, "{}", line.trim_end());
    }
    if rows.len() > MAX_LINES {
        let _ = writeln!(text, "  and {} more lines; --report json tells them all", rows.len() - MAX_LINES);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_below_each_other() {
        let rows = [["a", "1", "x"], ["bcd", "22", "y"]].map(|r| r.map(String::from).to_vec()).to_vec();
        assert_eq!(titled("two", rows), "\ntwo\n  a    1   x\n  bcd  22  y\n");
    }

    #[test]
    fn fates_are_told_with_their_numbers_where_they_differ() {
        let count = KindCount { read: 3, ..KindCount::default() };
        assert_eq!(fates(&count), "read");
        assert_eq!(fates(&KindCount { hidden: 2, ..count }), "3 read; 2 hidden");
    }

    #[test]
    fn areas_have_digits_that_matter() {
        assert_eq!(
            [2198.93808, 0.000123456, 4.0, 1.5e7].map(rounded),
            ["2198.94", "0.000123456", "4", "15000000"]
        );
    }
}
