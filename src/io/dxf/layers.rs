//! The table of layers.

use super::number::{name, whole};
use super::tags::Tag;
use std::collections::HashMap;

/// An entry of the table of layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    pub color: i16,
    pub off: bool,
    pub frozen: bool,
}

/// A layer that the table does not know: white, on and thawed.
const UNKNOWN: Layer = Layer { color: 7, off: false, frozen: false };

/// All layers by name, in lower case. A locked layer is a layer like any other.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    layers: HashMap<String, Layer>,
    /// The entry at hand.
    open: Option<(String, Layer)>,
}

impl Layers {
    /// Takes a tag of the section TABLES.
    pub fn take(&mut self, tag: Tag) {
        if tag.code == 0 {
            self.finish();
            self.open = (tag.value.text() == b"LAYER").then(|| (String::new(), UNKNOWN));
            return;
        }
        let Some((open, layer)) = &mut self.open else { return };
        match tag.code {
            2 => *open = name(tag.value.text()).to_lowercase(),
            62 => {
                let color = whole(tag.value).and_then(|c| i16::try_from(c).ok()).unwrap_or(UNKNOWN.color);
                (layer.color, layer.off) = (color.saturating_abs(), color < 0);
            }
            70 => layer.frozen = whole(tag.value).is_some_and(|flags| flags & 1 != 0),
            _ => {}
        }
    }

    /// The table ends.
    pub fn finish(&mut self) {
        self.layers.extend(self.open.take());
    }

    /// The layer of a name in any case of letters.
    pub fn get(&self, name: &str) -> Layer {
        self.layers.get(&name.to_lowercase()).copied().unwrap_or(UNKNOWN)
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
        assert_eq!(layers.get("OFF"), Layer { color: 5, off: true, frozen: false });
        assert_eq!(layers.get("Ice"), Layer { color: 3, off: false, frozen: true });
        assert_eq!(layers.get("locked"), Layer { color: 1, off: false, frozen: false });
        assert_eq!(layers.get("no such layer"), UNKNOWN);
    }
}
