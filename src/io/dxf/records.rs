//! What a text DXF says about its entities, and the part of it that the parser is given.
//!
//! **Needs** tags. **Guarantees** one record per entity of the section ENTITIES, in their order,
//! with the reason if it cannot be read; a text that holds the geometry of all others and nothing
//! besides. **Does not** look into blocks or read geometry.
//!
//! **Method.** The parser refuses a whole file for one number or group code that it does not
//! expect, drops entities without a word, panics at dates out of range, and does not read which
//! layers are frozen. So it gets only checked numbers of the kinds that are read, and knows an
//! entity by its index here, which is written in the place of its handle.

use super::tags::{BadTag, Tag, Tags, number, text};

/// The kinds that are read.
pub(super) const KINDS: [&str; 5] = ["LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE"];

/// What is known of an entity besides its geometry.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Record {
    pub kind: String,
    pub handle: Option<u64>,
    pub layer: String,
    pub paper: bool,
    pub invisible: bool,
    /// Why its geometry cannot be read.
    pub fault: Option<String>,
}

/// An entry of the table of layers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Layer {
    pub name: String,
    pub off: bool,
    pub frozen: bool,
}

/// What a file says.
#[derive(Clone, Debug, Default)]
pub(super) struct Contents {
    pub insunits: Option<i64>,
    pub measurement: Option<i64>,
    pub layers: Vec<Layer>,
    pub records: Vec<Record>,
    /// Whether it ends with its end mark.
    pub ended: bool,
    /// Whether any section was found.
    pub sections: bool,
    /// Text DXF with the entities that have no fault; handles are indices into `records` plus 1.
    pub geometry: Vec<u8>,
}

impl Contents {
    /// Reads all tags.
    pub fn new(bytes: &[u8]) -> Result<Contents, BadTag> {
        let mut scan = Scan::default();
        let mut tags = Tags::new(bytes);
        while let Some(tag) = tags.next() {
            let tag = tag?;
            if !tags.whole() && tag.code != 0 {
                scan.fault("the file ends in it".into());
            }
            if tag.code == 0 && tag.value == b"EOF" {
                scan.contents.ended = true;
                break;
            }
            scan.tag(tag);
        }
        if !scan.contents.ended && scan.section == Section::Entities {
            scan.fault("the file ends in it".into());
        }
        scan.finish_entity();
        scan.contents.geometry.splice(0..0, *b"0\nSECTION\n2\nENTITIES\n");
        scan.contents.geometry.extend_from_slice(b"0\nENDSEC\n0\nEOF\n");
        Ok(scan.contents)
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Section {
    #[default]
    None,
    /// Its name comes next.
    Named,
    Header,
    Tables,
    Entities,
    Other,
}

/// How often each group code below 60 was met in a part of an entity, by tens and ones.
type Seen = [[u32; 10]; 6];

#[derive(Default)]
struct Scan {
    contents: Contents,
    section: Section,
    variable: Vec<u8>,
    in_layer: bool,
    /// Kind of the part of an entity at hand: `VERTEX` within a `POLYLINE`.
    part: &'static str,
    seen: Seen,
    /// The entity at hand, for the parser.
    text: Vec<u8>,
    open: bool,
}

impl Scan {
    fn tag(&mut self, tag: Tag) {
        if tag.code == 0 && matches!(tag.value, b"SECTION" | b"ENDSEC") {
            self.finish_entity();
            self.section = if tag.value == b"SECTION" { Section::Named } else { Section::None };
            return;
        }
        match self.section {
            Section::None | Section::Other => {}
            Section::Named => {
                self.contents.sections = true;
                self.section = match tag.value {
                    b"HEADER" => Section::Header,
                    b"TABLES" => Section::Tables,
                    b"ENTITIES" => Section::Entities,
                    _ => Section::Other,
                };
            }
            Section::Header => self.header(tag),
            Section::Tables => self.table(tag),
            Section::Entities if tag.code == 0 => self.begin(tag),
            Section::Entities => self.entity(tag),
        }
    }

    fn header(&mut self, tag: Tag) {
        match (tag.code, self.variable.as_slice()) {
            (9, _) => self.variable = tag.value.to_vec(),
            (70, b"$INSUNITS") => self.contents.insunits = number(tag.value),
            (70, b"$MEASUREMENT") => self.contents.measurement = number(tag.value),
            _ => {}
        }
    }

    fn table(&mut self, tag: Tag) {
        if tag.code == 0 {
            self.in_layer = tag.value == b"LAYER";
            if self.in_layer {
                self.contents.layers.push(Layer::default());
            }
            return;
        }
        let (true, Some(layer)) = (self.in_layer, self.contents.layers.last_mut()) else { return };
        match tag.code {
            2 => layer.name = text(tag.value),
            62 => layer.off = number(tag.value).is_some_and(|color: i32| color < 0),
            70 => layer.frozen = number(tag.value).is_some_and(|flags: i32| flags & 1 != 0),
            _ => {}
        }
    }

    /// An entity begins, or a part of a polyline.
    fn begin(&mut self, tag: Tag) {
        self.finish_part();
        let in_polyline = self.open && self.contents.records.last().is_some_and(|r| r.kind == "POLYLINE");
        match tag.value {
            b"VERTEX" if in_polyline => {
                self.part = "VERTEX";
                self.text.extend_from_slice(b"0\nVERTEX\n");
            }
            // Without a polyline they end an insert or stand there by accident.
            b"VERTEX" | b"SEQEND" | b"ATTRIB" => {
                self.finish_entity();
                self.part = "";
            }
            kind => {
                self.finish_entity();
                let kind = text(kind);
                self.part = KINDS.into_iter().find(|&k| k == kind).unwrap_or("");
                self.contents.records.push(Record { kind, layer: "0".into(), ..Record::default() });
                self.open = true;
                if !self.part.is_empty() {
                    let index = self.contents.records.len();
                    self.text.extend_from_slice(format!("0\n{}\n5\n{index:X}\n", self.part).as_bytes());
                }
            }
        }
    }

    /// A tag of the entity at hand.
    fn entity(&mut self, tag: Tag) {
        let (true, Some(record)) = (self.open, self.contents.records.last_mut()) else { return };
        if self.part != "VERTEX" {
            match tag.code {
                5 => {
                    record.handle =
                        std::str::from_utf8(tag.value).ok().and_then(|h| u64::from_str_radix(h, 16).ok())
                }
                8 => record.layer = text(tag.value),
                60 => record.invisible = number(tag.value) == Some(1),
                67 => record.paper = number(tag.value) == Some(1),
                _ => {}
            }
        }
        if self.part.is_empty() {
            return;
        }
        let usable = match tag.code {
            10..=59 | 210..=239 => number::<f64>(tag.value).is_some(),
            70 => number::<i16>(tag.value).is_some(),
            _ => return,
        };
        if !usable {
            let value = text(&tag.value[..tag.value.len().min(40)]);
            self.fault(format!("`{value}` in line {} is no number", tag.line + 1));
            return;
        }
        if let 0..=59 = tag.code {
            self.seen[tag.code as usize / 10][tag.code as usize % 10] += 1;
        }
        self.text.extend_from_slice(tag.code.to_string().as_bytes());
        self.text.push(b'\n');
        self.text.extend_from_slice(tag.value);
        self.text.push(b'\n');
    }

    /// The entity at hand cannot be read; the first reason stands.
    fn fault(&mut self, reason: String) {
        if let (true, Some(record)) = (self.open, self.contents.records.last_mut()) {
            record.fault.get_or_insert(reason);
        }
    }

    /// Checks that the part at hand has what its geometry needs: a group that is missing would be
    /// read as 0.
    fn finish_part(&mut self) {
        let seen = std::mem::take(&mut self.seen);
        let count = |code: usize| seen[code / 10][code % 10];
        let needed: &[usize] = match self.part {
            "LINE" => &[10, 20, 11, 21],
            "CIRCLE" => &[10, 20, 40],
            "ARC" => &[10, 20, 40, 50, 51],
            "VERTEX" => &[10, 20],
            _ => &[],
        };
        if let Some(code) = needed.iter().find(|&&code| count(code) == 0) {
            self.fault(format!("group {code} is missing"));
        } else if self.part == "LWPOLYLINE" && count(10) != count(20) {
            self.fault(format!("it has {} x and {} y coordinates", count(10), count(20)));
        }
        self.part = "";
    }

    fn finish_entity(&mut self) {
        self.finish_part();
        if let (true, Some(record)) = (self.open, self.contents.records.last())
            && record.fault.is_none()
        {
            self.contents.geometry.append(&mut self.text);
        }
        self.text.clear();
        self.open = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of `code value` pairs.
    fn contents(pairs: &str) -> Contents {
        let text: Vec<String> = pairs
            .split(';')
            .map(|pair| {
                pair.trim()
                    .split_once(' ')
                    .map_or(format!("{}\n\n", pair.trim()), |(c, v)| format!("{c}\n{v}\n"))
            })
            .collect();
        Contents::new(text.concat().as_bytes()).unwrap()
    }

    const LINE: &str = "0 LINE; 10 0; 20 0; 11 1; 21 1";

    #[test]
    fn header_layers_and_attributes_are_read() {
        let c = contents(&format!(
            "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 9 $MEASUREMENT; 70 1; 0 ENDSEC;
             0 SECTION; 2 TABLES; 0 TABLE; 2 LAYER; 70 2; 0 LAYER; 2 Off; 70 0; 62 -7;
             0 LAYER; 2 Cold; 70 5; 62 7; 0 ENDTAB; 0 ENDSEC;
             0 SECTION; 2 ENTITIES; {LINE}; 5 2F; 8 Cold; 60 1; 67 1; 0 ENDSEC; 0 EOF"
        ));
        assert_eq!((c.insunits, c.measurement, c.ended), (Some(4), Some(1), true));
        assert_eq!(
            c.layers.iter().map(|l| (l.off, l.frozen)).collect::<Vec<_>>(),
            [(true, false), (false, true)]
        );
        let record = &c.records[0];
        assert_eq!((record.handle, record.layer.as_str()), (Some(0x2F), "Cold"));
        assert!(record.paper && record.invisible && record.fault.is_none());
    }

    #[test]
    fn the_parser_gets_only_what_can_be_read() {
        let c = contents(&format!(
            "0 SECTION; 2 ENTITIES; 0 HATCH; 10 x; {LINE}; 83 5; 1000 any; 0 LINE; 10 12,5mm; 20 0; 11 1; 21 1;
             0 CIRCLE; 10 0; 20 0; 0 ENDSEC; 0 EOF"
        ));
        let faults: Vec<_> = c.records.iter().map(|r| r.fault.clone()).collect();
        assert_eq!(faults[..2], [None, None]);
        assert!(faults[2].as_ref().unwrap().contains("`12,5mm` in line"));
        assert_eq!(faults[3].as_deref(), Some("group 40 is missing"));
        let text = String::from_utf8(c.geometry).unwrap();
        assert_eq!(
            text,
            "0\nSECTION\n2\nENTITIES\n0\nLINE\n5\n2\n10\n0\n20\n0\n11\n1\n21\n1\n0\nENDSEC\n0\nEOF\n"
        );
    }

    #[test]
    fn a_vertex_that_cannot_be_read_spoils_its_polyline() {
        let c = contents(
            "0 SECTION; 2 ENTITIES; 0 POLYLINE; 70 1; 0 VERTEX; 10 0; 20 0; 0 VERTEX; 10 1; 0 SEQEND;
             0 VERTEX; 10 5; 20 5; 0 ENDSEC; 0 EOF",
        );
        assert_eq!(c.records.len(), 1);
        assert_eq!(c.records[0].fault.as_deref(), Some("group 20 is missing"));
        assert!(!String::from_utf8(c.geometry).unwrap().contains("VERTEX"));
    }

    #[test]
    fn the_last_entity_of_a_file_that_breaks_off_is_not_trusted() {
        let c = contents(&format!("0 SECTION; 2 ENTITIES; {LINE}; {LINE}"));
        assert!(!c.ended);
        assert!(c.records[0].fault.is_none() && c.records[1].fault.is_some());
    }
}
