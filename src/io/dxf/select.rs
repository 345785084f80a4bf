//! Which entities take part.

use super::inventory::Fate;
use super::layers::Layers;
use super::names::{Name, Names};
use super::{Color, ReadOptions};
use crate::io::Warning;
use std::collections::{BTreeMap, BTreeSet};

/// What of an entity decides whether it takes part, when layer and color are known that it has
/// in its place.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Trait {
    pub layer: Name,
    pub color: i16,
    pub paper: bool,
    pub invisible: bool,
}

/// Whether the entities of a layer take part.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Wanted,
    Unwanted,
    Hidden(&'static str),
}

/// Selects entities by layer, color and state, and counts those that the drawing itself hides.
pub(super) struct Selection<'a> {
    options: &'a ReadOptions,
    /// Of each layer that was met, by its name.
    states: BTreeMap<Name, State>,
    colors: BTreeSet<Color>,
    hidden: BTreeMap<(String, &'static str), usize>,
    invisible: usize,
    paper: usize,
}

impl<'a> Selection<'a> {
    pub fn new(options: &'a ReadOptions) -> Selection<'a> {
        Selection {
            options,
            states: BTreeMap::new(),
            colors: BTreeSet::new(),
            hidden: BTreeMap::new(),
            invisible: 0,
            paper: 0,
        }
    }

    /// Whether an entity takes part; if not, why.
    pub fn takes(&mut self, entity: Trait, layers: &Layers, names: &Names) -> Result<(), Fate> {
        self.is_in_model(entity)?;
        let options = self.options;
        let state = *self.states.entry(entity.layer).or_insert_with(|| {
            let name = names.text(entity.layer);
            let layer = layers.get(name);
            let named = |patterns: &[String]| patterns.iter().any(|p| matches(p, name));
            if named(&options.skip_layers) || !(options.layers.is_empty() || named(&options.layers)) {
                State::Unwanted
            } else if layer.frozen {
                State::Hidden("frozen")
            } else if layer.off {
                State::Hidden("off")
            } else {
                State::Wanted
            }
        });
        let color = Color::new(entity.color.into());
        self.colors.extend(color);
        let colored = options.colors.is_empty() || color.is_some_and(|c| options.colors.contains(&c));
        match state {
            State::Unwanted => Err(Fate::Unselected),
            _ if !colored => Err(Fate::Unselected),
            State::Hidden(state) if !options.hidden => {
                self.hide(names.text(entity.layer), state);
                Err(Fate::Hidden)
            }
            _ => self.is_seen(entity),
        }
    }

    /// Whether what a block holds is to be looked at: a frozen layer hides all of it.
    pub fn enters(&mut self, insert: Trait, layers: &Layers, names: &Names) -> Result<(), Fate> {
        self.is_in_model(insert)?;
        let name = names.text(insert.layer);
        if layers.get(name).frozen && !self.options.hidden {
            self.hide(name, "frozen");
            return Err(Fate::Hidden);
        }
        self.is_seen(insert)
    }

    fn is_in_model(&mut self, entity: Trait) -> Result<(), Fate> {
        self.paper += usize::from(entity.paper);
        if entity.paper { Err(Fate::Paper) } else { Ok(()) }
    }

    fn is_seen(&mut self, entity: Trait) -> Result<(), Fate> {
        let hidden = entity.invisible && !self.options.hidden;
        self.invisible += usize::from(hidden);
        if hidden { Err(Fate::Hidden) } else { Ok(()) }
    }

    fn hide(&mut self, layer: &str, state: &'static str) {
        *self.hidden.entry((layer.to_owned(), state)).or_default() += 1;
    }

    /// What was hidden, and which wishes met nothing.
    pub fn warnings(self, names: &Names) -> impl Iterator<Item = Warning> {
        let Selection { options, states, colors, hidden, invisible, paper } = self;
        let layers: BTreeSet<String> = states.keys().map(|&name| names.text(name).to_string()).collect();
        let layers: Vec<String> = layers.into_iter().collect();
        let colors: Vec<String> = colors.iter().map(Color::to_string).collect();
        let unmet_layers = options.layers.iter().chain(&options.skip_layers);
        let unmet_layers = unmet_layers
            .filter(|&pattern| !layers.iter().any(|layer| matches(pattern, layer)))
            .map(|pattern| Warning::NoSuchLayer { pattern: pattern.clone(), layers: layers.clone() });
        let unmet_colors = options
            .colors
            .iter()
            .map(Color::to_string)
            .filter(|color| !colors.contains(color))
            .map(|color| Warning::NoSuchColor { color, colors: colors.clone() });
        let unmet: Vec<Warning> = unmet_layers.chain(unmet_colors).collect();
        let hidden =
            hidden.into_iter().map(|((layer, state), count)| Warning::LayerSkipped { layer, state, count });
        let invisible = (invisible > 0).then_some(Warning::InvisibleSkipped { count: invisible });
        let paper = (paper > 0).then_some(Warning::PaperSpaceSkipped { count: paper });
        unmet.into_iter().chain(hidden).chain(invisible).chain(paper)
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

    fn taken(options: &ReadOptions, entities: &[(&str, i16)]) -> (Vec<bool>, Vec<Warning>) {
        let (mut names, mut selection) = (Names::default(), Selection::new(options));
        let taken = entities
            .iter()
            .map(|&(layer, color)| {
                let layer = names.number(layer.as_bytes());
                let its = Trait { layer, color, ..Trait::default() };
                selection.takes(its, &Layers::default(), &names).is_ok()
            })
            .collect();
        (taken, selection.warnings(&names).collect())
    }

    #[test]
    fn a_layer_that_nothing_lies_on_is_named() {
        let options = ReadOptions {
            layers: vec!["cut*".into(), "glue".into()],
            skip_layers: vec!["*old".into()],
            ..ReadOptions::default()
        };
        let (taken, warnings) = taken(&options, &[("0", 7), ("CUT 1", 7), ("cut old", 7)]);
        assert_eq!(taken, [false, true, false]);
        let layers = ["0", "CUT 1", "cut old"].map(String::from).to_vec();
        assert_eq!(warnings, [Warning::NoSuchLayer { pattern: "glue".into(), layers }]);
    }

    #[test]
    fn a_color_that_nothing_has_is_named() {
        let colors = ["red", "30"].map(|c| c.parse().unwrap()).to_vec();
        let options = ReadOptions { colors, ..ReadOptions::default() };
        let (taken, warnings) = taken(&options, &[("0", 7), ("0", 1), ("0", 0), ("0", 1)]);
        assert_eq!(taken, [false, true, false, true]);
        let colors = ["red", "white"].map(String::from).to_vec();
        assert_eq!(warnings, [Warning::NoSuchColor { color: "30".into(), colors }]);
    }
}
