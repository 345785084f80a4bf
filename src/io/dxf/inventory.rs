//! What a drawing holds, whether it takes part or not.

use super::Color;
use super::collect::Tables;
use super::layers::Layers;
use super::names::Name;
use crate::geom::Point;
use crate::io::{DrawingUnit, Place};
use serde::Serialize;
use std::collections::BTreeMap;

/// Releases by the name of the version in the header.
const RELEASES: [(&str, &str); 15] = [
    ("AC1.50", "2.05"),
    ("AC2.10", "2.1"),
    ("AC1002", "2.5"),
    ("AC1003", "2.6"),
    ("AC1004", "9"),
    ("AC1006", "10"),
    ("AC1009", "12"),
    ("AC1012", "13"),
    ("AC1014", "14"),
    ("AC1015", "2000"),
    ("AC1018", "2004"),
    ("AC1021", "2007"),
    ("AC1024", "2010"),
    ("AC1027", "2013"),
    ("AC1032", "2018"),
];

/// The whole content of a file, also what was left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Inventory {
    /// Version of the format as the header names it, such as `AC1015`.
    pub version: Option<String>,
    /// Whether the file is binary, not text.
    pub binary: bool,
    /// The unit that the header claims, if it claims one.
    pub claimed: Option<DrawingUnit>,
    /// The unit that the file was read in.
    pub unit: DrawingUnit,
    /// Why that one.
    pub reason: UnitReason,
    /// All layers by name: those of the table of layers and those with entities on them.
    pub layers: Vec<LayerContent>,
    /// Entities with something wrong, in the order of the file, at most the first 10,000.
    pub broken: Vec<BrokenEntity>,
}

/// What speaks for the unit of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum UnitReason {
    /// [`ReadOptions::dxf_units`](super::ReadOptions::dxf_units) says it.
    Told,
    /// The drawing claims it.
    Claimed,
    /// The drawing claims nothing, and the unit of the job was chosen.
    Job,
    /// The drawing claims nothing but a measurement flag.
    Flag,
    /// Nothing speaks for it.
    #[default]
    Assumed,
}

/// A layer and what lies on it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LayerContent {
    /// Its name.
    pub name: String,
    /// Color of entities without one of their own.
    pub color: Option<Color>,
    /// Whether it is turned off.
    pub off: bool,
    /// Whether it is frozen.
    pub frozen: bool,
    /// Whether it is locked, which does not matter to a reader.
    pub locked: bool,
    /// Its entities by kind, those of blocks once for each place.
    pub kinds: BTreeMap<String, KindCount>,
}

/// What became of entities of a kind. Each counts once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct KindCount {
    /// Read as segments and arcs, or, for an insert, put in place.
    pub read: usize,
    /// Read as ellipses or splines.
    pub free: usize,
    /// Of a kind or form that is not read.
    pub not_read: usize,
    /// With something wrong.
    pub broken: usize,
    /// Not asked for, by layer or color.
    pub unselected: usize,
    /// Invisible, or on a layer that is off or frozen.
    pub hidden: usize,
    /// In paper space.
    pub paper: usize,
}

/// An entity with something wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BrokenEntity {
    /// Kind of entity.
    pub kind: String,
    /// Its handle, where it has one.
    #[serde(serialize_with = "hexadecimal")]
    pub handle: Option<u64>,
    /// Where in the file it is wrong.
    #[serde(serialize_with = "in_words")]
    pub place: Place,
    /// What is wrong with it.
    pub reason: String,
    /// Where it lies, if that is known.
    pub at: Option<Point>,
}

fn in_words<S: serde::Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(place)
}

/// As drawings and drawing programs write handles.
fn hexadecimal<S: serde::Serializer>(handle: &Option<u64>, serializer: S) -> Result<S::Ok, S::Error> {
    handle.map(|h| format!("{h:X}")).serialize(serializer)
}

impl Inventory {
    /// The release that the version of the format belongs to, such as `2000`.
    pub fn release(&self) -> Option<&'static str> {
        let version = self.version.as_deref()?;
        RELEASES.iter().find(|(name, _)| *name == version).map(|(_, release)| *release)
    }

    /// All entities by kind, whatever layer they lie on.
    pub fn kinds(&self) -> BTreeMap<&str, KindCount> {
        let mut kinds: BTreeMap<&str, KindCount> = BTreeMap::new();
        for (kind, count) in self.layers.iter().flat_map(|l| &l.kinds) {
            kinds.entry(kind).or_default().add(count);
        }
        kinds
    }
}

impl KindCount {
    /// How many there are.
    pub fn total(&self) -> usize {
        let KindCount { read, free, not_read, broken, unselected, hidden, paper } = *self;
        read + free + not_read + broken + unselected + hidden + paper
    }

    fn add(&mut self, other: &KindCount) {
        self.read += other.read;
        self.free += other.free;
        self.not_read += other.not_read;
        self.broken += other.broken;
        self.unselected += other.unselected;
        self.hidden += other.hidden;
        self.paper += other.paper;
    }

    fn count(&mut self, fate: Fate) {
        let counter = match fate {
            Fate::Read => &mut self.read,
            Fate::Free => &mut self.free,
            Fate::NotRead => &mut self.not_read,
            Fate::Broken => &mut self.broken,
            Fate::Unselected => &mut self.unselected,
            Fate::Hidden => &mut self.hidden,
            Fate::Paper => &mut self.paper,
        };
        *counter += 1;
    }
}

/// What becomes of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    Read,
    Free,
    NotRead,
    Broken,
    Unselected,
    Hidden,
    Paper,
}

/// Counts as entities come, by the numbers of their layers and kinds.
#[derive(Default)]
pub(super) struct Tally {
    counts: BTreeMap<(Name, Name), KindCount>,
}

impl Tally {
    /// Counts an entity.
    pub fn count(&mut self, layer: Name, kind: Name, fate: Fate) {
        self.counts.entry((layer, kind)).or_default().count(fate);
    }

    /// The layers with their counts, in the order of their names.
    pub fn layers(&self, tables: &Tables) -> Vec<LayerContent> {
        let mut all: BTreeMap<String, LayerContent> = BTreeMap::new();
        for (key, layer) in tables.layers.all() {
            let (name, color) = (layer.name.clone(), Color::new(layer.color.into()));
            let (off, frozen, locked) = (layer.off, layer.frozen, layer.locked);
            let kinds = BTreeMap::new();
            all.insert(key.to_owned(), LayerContent { name, color, off, frozen, locked, kinds });
        }
        for (&(layer, kind), count) in &self.counts {
            let name = tables.names.text(layer);
            let content = all.entry(Layers::key(name)).or_default();
            if content.name.is_empty() {
                content.name = name.to_string();
            }
            content.kinds.entry(tables.names.text(kind).to_string()).or_default().add(count);
        }
        all.into_values().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_that_differ_in_case_are_one() {
        let (mut tables, mut tally) = (Tables::default(), Tally::default());
        let [cut, same, kind] = ["Cut", "CUT", "LINE"].map(|n| tables.names.number(n.as_bytes()));
        tally.count(cut, kind, Fate::Read);
        tally.count(same, kind, Fate::Broken);
        let layers = tally.layers(&tables);
        let count = KindCount { read: 1, broken: 1, ..KindCount::default() };
        assert_eq!((layers.len(), &*layers[0].name, layers[0].kinds["LINE"]), (1, "Cut", count));
        let inventory = Inventory { layers, version: Some("AC1015".into()), ..Inventory::default() };
        assert_eq!((inventory.kinds()["LINE"].total(), inventory.release()), (2, Some("2000")));
    }
}
