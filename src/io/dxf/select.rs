//! Which entities take part.

use super::ReadOptions;
use super::records::{Contents, Record};
use crate::io::Warning;
use std::collections::{BTreeMap, BTreeSet};

/// Selects entities by layer and state, and counts those that the drawing itself hides.
pub(super) struct Selection<'a> {
    options: &'a ReadOptions,
    /// Layers that are off or frozen, by name in lower case.
    hidden: BTreeMap<String, &'static str>,
    skipped: BTreeMap<(String, &'static str), usize>,
    invisible: usize,
    paper: usize,
    met: BTreeSet<String>,
}

impl<'a> Selection<'a> {
    pub fn new(options: &'a ReadOptions, contents: &Contents) -> Selection<'a> {
        let state = |off: bool, frozen: bool| if frozen { Some("frozen") } else { off.then_some("off") };
        let hidden = contents
            .layers
            .iter()
            .filter_map(|l| Some((l.name.to_lowercase(), state(l.off, l.frozen)?)))
            .collect();
        Selection { options, hidden, skipped: BTreeMap::new(), invisible: 0, paper: 0, met: BTreeSet::new() }
    }

    /// Whether an entity takes part.
    pub fn takes(&mut self, record: &Record) -> bool {
        if record.paper {
            self.paper += 1;
            return false;
        }
        if !self.met.contains(&record.layer) {
            self.met.insert(record.layer.clone());
        }
        let named = |patterns: &[String]| patterns.iter().any(|p| matches(p, &record.layer));
        if named(&self.options.skip_layers)
            || !(self.options.layers.is_empty() || named(&self.options.layers))
        {
            return false;
        }
        if self.options.hidden {
            return true;
        }
        if let Some(&state) = self.hidden.get(&record.layer.to_lowercase()) {
            *self.skipped.entry((record.layer.clone(), state)).or_default() += 1;
            return false;
        }
        self.invisible += usize::from(record.invisible);
        !record.invisible
    }

    /// What was hidden, and which wishes met nothing.
    pub fn warnings(self) -> impl Iterator<Item = Warning> {
        let Selection { options, skipped, invisible, paper, met, .. } = self;
        let all: Vec<String> = met.into_iter().collect();
        let unmet = options
            .layers
            .iter()
            .chain(&options.skip_layers)
            .filter(|&pattern| !all.iter().any(|layer| matches(pattern, layer)))
            .map(|pattern| Warning::NoSuchLayer { pattern: pattern.clone(), layers: all.clone() })
            .collect::<Vec<_>>();
        let skipped =
            skipped.into_iter().map(|((layer, state), count)| Warning::LayerSkipped { layer, state, count });
        let invisible = (invisible > 0).then_some(Warning::InvisibleSkipped { count: invisible });
        let paper = (paper > 0).then_some(Warning::PaperSpaceSkipped { count: paper });
        unmet.into_iter().chain(skipped).chain(invisible).chain(paper)
    }
}

/// Whether a name fits a pattern in which `*` stands for anything, in any case of letters.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name) = (pattern.to_lowercase(), name.to_lowercase());
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or("");
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let mut parts = parts.peekable();
    if parts.peek().is_none() {
        return rest.is_empty();
    }
    // Each part as early as it can be leaves the most for the others; the last one ends the name.
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::super::records::Layer;
    use super::*;

    #[test]
    fn a_star_stands_for_anything() {
        for (pattern, name) in [
            ("cut", "CUT"),
            ("CUT*", "cut-1"),
            ("*", ""),
            ("*in*er*", "Inner"),
            ("a*b*c", "a-b-b-c"),
            ("*ß", "Maß"),
        ] {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("cut", "cut1"), ("*cut", "cut1"), ("a*a", "a"), ("", "0"), ("a*b*c", "acb")]
        {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }

    fn on(layer: &str) -> Record {
        Record { layer: layer.into(), ..Record::default() }
    }

    #[test]
    fn hidden_entities_are_counted_and_come_on_demand() {
        let layer = |name: &str, off, frozen| Layer { name: name.into(), off, frozen };
        let contents = Contents {
            layers: vec![layer("Off", true, false), layer("Cold", true, true)],
            ..Contents::default()
        };
        let records = [
            on("0"),
            on("OFF"),
            on("cold"),
            Record { invisible: true, ..on("0") },
            Record { paper: true, ..on("0") },
        ];
        let options = ReadOptions::default();
        let mut selection = Selection::new(&options, &contents);
        let taken: Vec<bool> = records.iter().map(|r| selection.takes(r)).collect();
        assert_eq!(taken, [true, false, false, false, false]);
        let warnings: Vec<_> = selection.warnings().collect();
        assert_eq!(
            warnings,
            [
                Warning::LayerSkipped { layer: "OFF".into(), state: "off", count: 1 },
                Warning::LayerSkipped { layer: "cold".into(), state: "frozen", count: 1 },
                Warning::InvisibleSkipped { count: 1 },
                Warning::PaperSpaceSkipped { count: 1 },
            ]
        );
        let options = ReadOptions { hidden: true, ..ReadOptions::default() };
        let mut selection = Selection::new(&options, &contents);
        let taken: Vec<bool> = records.iter().map(|r| selection.takes(r)).collect();
        assert_eq!(taken, [true, true, true, true, false]);
    }

    #[test]
    fn a_layer_that_nothing_lies_on_is_named() {
        let options = ReadOptions {
            layers: vec!["cut*".into(), "glue".into()],
            skip_layers: vec!["*old".into()],
            ..ReadOptions::default()
        };
        let mut selection = Selection::new(&options, &Contents::default());
        let taken: Vec<bool> = ["0", "CUT 1", "cut old"].iter().map(|l| selection.takes(&on(l))).collect();
        assert_eq!(taken, [false, true, false]);
        let layers = ["0", "CUT 1", "cut old"].map(String::from).to_vec();
        let warnings: Vec<_> = selection.warnings().collect();
        assert_eq!(warnings, [Warning::NoSuchLayer { pattern: "glue".into(), layers }]);
    }
}
