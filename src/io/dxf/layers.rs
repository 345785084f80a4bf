//! The table of layers.

use super::number::{name, whole};
use super::tags::Tag;
use std::collections::BTreeMap;

/// An entry of the table of layers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    /// As the table spells it.
    pub name: String,
    pub color: i16,
    pub off: bool,
    pub frozen: bool,
    pub locked: bool,
}

/// A layer that the table does not know: white, on and thawed.
static UNKNOWN: Layer = Layer { name: String::new(), color: 7, off: false, frozen: false, locked: false };

/// All layers by name, in lower case. A locked layer is a layer like any other.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    layers: BTreeMap<String, Layer>,
    /// The entry at hand.
    open: Option<Layer>,
}

impl Layers {
    /// Takes a tag of the section TABLES.
    pub fn take(&mut self, tag: Tag) {
        if tag.code == 0 {
            self.finish();
            self.open = (tag.value.text() == b"LAYER").then(|| UNKNOWN.clone());
            return;
        }
        let Some(layer) = &mut self.open else { return };
        match tag.code {
            2 => layer.name = name(tag.value.text()),
            62 => {
                let color = whole(tag.value).and_then(|c| i16::try_from(c).ok()).unwrap_or(UNKNOWN.color);
                (layer.color, layer.off) = (color.saturating_abs(), color < 0);
            }
            70 => {
                let flags = whole(tag.value).unwrap_or(0);
                (layer.frozen, layer.locked) = (flags & 1 != 0, flags & 4 != 0);
            }
            _ => {}
        }
    }

    /// The table ends.
    pub fn finish(&mut self) {
        self.layers.extend(self.open.take().map(|layer| (Layers::key(&layer.name), layer)));
    }

    /// The layer of a name in any case of letters.
    pub fn get(&self, name: &str) -> &Layer {
        self.layers.get(&Layers::key(name)).unwrap_or(&UNKNOWN)
    }

    /// All layers of the table with the keys of their names, in the order of these.
    pub fn all(&self) -> impl Iterator<Item = (&str, &Layer)> {
        self.layers.iter().map(|(key, layer)| (key.as_str(), layer))
    }

    /// What names have in common that differ in the case of letters.
    pub fn key(name: &str) -> String {
        name.to_lowercase()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tags::Value;
    use super::*;
    use crate::io::Place;

    /// A table of `code value` pairs.
    pub fn layers(pairs: &str) -> Layers {
        let mut layers = Layers::default();
        for pair in pairs.split("; ") {
            let (code, value) = pair.split_once(' ').unwrap();
            let value = Value::Text(value.as_bytes());
            layers.take(Tag { code: code.parse().unwrap(), value, place: Place::Line(0) });
        }
        layers.finish();
        layers
    }

    #[test]
    fn states_and_colors_are_read() {
        let table = "0 TABLE; 2 LAYER; 70 3; 0 LAYER; 2 Off; 70 0; 62 -5; 0 LAYER; 2 ICE; 70 5; 62 3; 0 LAYER; 2 Locked; 70 4; 62 1; 0 ENDTAB; 0 STYLE; 2 ice; 70 0";
        let layers = layers(table);
        let known = |name: &str, color| Layer { name: name.into(), color, ..UNKNOWN.clone() };
        assert_eq!(*layers.get("OFF"), Layer { off: true, ..known("Off", 5) });
        assert_eq!(*layers.get("Ice"), Layer { frozen: true, locked: true, ..known("ICE", 3) });
        assert_eq!(*layers.get("locked"), Layer { locked: true, ..known("Locked", 1) });
        assert_eq!(layers.get("no such layer"), &UNKNOWN);
        assert_eq!(layers.all().map(|(key, _)| key).collect::<Vec<_>>(), ["ice", "locked", "off"]);
    }
}
