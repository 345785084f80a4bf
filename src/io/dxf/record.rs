//! An entity as its groups tell it, before anything is made of it.

use super::names::{Name, Names};
use super::number::{Reading, is_foreign, number, whole};
use super::shape::Skip;
use super::tags::Tag;
use crate::io::Place;

/// The kinds that are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    Line,
    Arc,
    Circle,
    Ellipse,
    Spline,
    LightPolyline,
    Polyline,
    Hatch,
    Insert,
    /// Any other.
    #[default]
    Other,
}

impl Kind {
    /// The kind of a name; areas only if they are wanted.
    pub fn of(name: &[u8], hatch: bool) -> Kind {
        match name {
            // In release 10 lines with a height had a name of their own.
            b"LINE" | b"3DLINE" => Kind::Line,
            b"ARC" => Kind::Arc,
            b"CIRCLE" => Kind::Circle,
            b"ELLIPSE" => Kind::Ellipse,
            b"SPLINE" => Kind::Spline,
            b"LWPOLYLINE" => Kind::LightPolyline,
            b"POLYLINE" => Kind::Polyline,
            b"HATCH" if hatch => Kind::Hatch,
            b"INSERT" => Kind::Insert,
            _ => Kind::Other,
        }
    }
}

/// Color number of an entity: as its block has it, or as its layer has it.
pub(super) const BY_BLOCK: i16 = 0;
pub(super) const BY_LAYER: i16 = 256;

/// Separates the vertices of a polyline among its numbers.
pub(super) const VERTEX: u16 = 0;

/// What a file tells of an entity.
#[derive(Clone, Debug, Default)]
pub(super) struct Record {
    pub kind: Kind,
    /// Its kind as the file calls it.
    pub kind_name: Name,
    pub place: Place,
    pub handle: Option<u64>,
    pub layer: Name,
    pub color: i16,
    pub paper: bool,
    pub invisible: bool,
    /// The block that it inserts.
    pub block: Option<Name>,
    /// Why it cannot be read.
    pub fault: Option<Box<str>>,
    /// Its geometry: group codes and numbers in their order.
    pub numbers: Vec<(u16, f64)>,
}

/// What a tag turned out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    Plain,
    MendedNumber,
    ForeignName,
}

impl Record {
    /// Begins an entity, in the memory of one that is done with.
    pub fn begin(&mut self, kind: Kind, kind_name: Name, layer: Name, place: Place) {
        let mut numbers = std::mem::take(&mut self.numbers);
        numbers.clear();
        *self = Record { kind, kind_name, place, layer, color: BY_LAYER, numbers, ..Record::default() };
    }

    /// Takes a tag of the entity itself.
    pub fn take(&mut self, tag: Tag, names: &mut Names) -> Taken {
        match tag.code {
            5 => self.handle = handle(tag.value.text()),
            8 => {
                self.layer = names.number(tag.value.text());
                if is_foreign(tag.value.text()) {
                    return Taken::ForeignName;
                }
            }
            2 if self.kind == Kind::Insert => self.block = Some(names.number(tag.value.text())),
            60 => self.invisible = whole(tag.value) == Some(1),
            62 => self.color = whole(tag.value).and_then(|c| i16::try_from(c).ok()).unwrap_or(BY_LAYER),
            67 => self.paper = whole(tag.value) == Some(1),
            _ => return self.take_number(tag),
        }
        Taken::Plain
    }

    /// Takes a tag that may be part of the geometry.
    pub fn take_number(&mut self, tag: Tag) -> Taken {
        let coordinate = matches!(tag.code, 10..=47 | 50..=59 | 210 | 220 | 230);
        if self.kind == Kind::Other || !(coordinate || matches!(tag.code, 70..=79 | 90..=99)) {
            return Taken::Plain;
        }
        let (value, taken) = match number(tag.value) {
            Reading::Plain(value) => (value, Taken::Plain),
            Reading::Mended(value) => (value, Taken::MendedNumber),
            Reading::None => (f64::NAN, Taken::Plain),
        };
        if value.is_finite() {
            self.numbers.push((tag.code as u16, value));
        } else if coordinate {
            let text = tag.value.text();
            let written = String::from_utf8_lossy(&text[..text.len().min(40)]);
            let what = if text.is_empty() {
                "a number is missing".into()
            } else {
                format!("`{written}` is no finite number")
            };
            self.spoil(what, tag.place);
        }
        taken
    }

    /// It cannot be read; the first reason stands.
    pub fn spoil(&mut self, reason: String, place: Place) {
        if self.fault.is_none() {
            self.fault = Some(reason.into());
            self.place = place;
        }
    }

    /// Its geometry.
    pub fn numbers(&self) -> Numbers<'_> {
        Numbers(&self.numbers)
    }
}

/// A handle of hexadecimal digits; files without handles leave it empty.
fn handle(text: &[u8]) -> Option<u64> {
    u64::from_str_radix(std::str::from_utf8(text).ok()?, 16).ok()
}

/// Group codes and numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers<'a>(pub &'a [(u16, f64)]);

impl<'a> Numbers<'a> {
    /// The first number of a group.
    pub fn get(self, code: u16) -> Option<f64> {
        self.0.iter().find(|(c, _)| *c == code).map(|&(_, value)| value)
    }

    /// The first number of a group that may be left out.
    pub fn or(self, code: u16, value: f64) -> f64 {
        self.get(code).unwrap_or(value)
    }

    /// The first number of a group, as flags.
    pub fn flags(self, code: u16) -> i64 {
        self.or(code, 0.0) as i64
    }

    /// The first number of a group that must be there: if it is missing, 0 would be a guess.
    pub fn need(self, code: u16) -> Result<f64, Skip> {
        self.get(code).ok_or_else(|| Skip::Fault(format!("group {code} is missing")))
    }

    /// A place that must be there, with a height that need not.
    pub fn place(self, code: u16) -> Result<[f64; 3], Skip> {
        Ok([self.need(code)?, self.need(code + 10)?, self.or(code + 20, 0.0)])
    }

    /// All numbers of a group.
    pub fn all(self, code: u16) -> impl Iterator<Item = f64> + 'a {
        self.0.iter().filter(move |(c, _)| *c == code).map(|&(_, value)| value)
    }

    /// All places of a group.
    pub fn places(self, code: u16) -> Result<Vec<[f64; 3]>, Skip> {
        let mut places: Vec<[f64; 3]> = self.all(code).map(|x| [x, 0.0, 0.0]).collect();
        for axis in 1..3 {
            let count = self.all(code + 10 * axis).count();
            // Heights may be left out.
            if count != places.len() && !(axis == 2 && count == 0) {
                return Err(Skip::Fault(format!("it has {} x and {count} other coordinates", places.len())));
            }
            for (place, value) in places.iter_mut().zip(self.all(code + 10 * axis)) {
                place[usize::from(axis)] = value;
            }
        }
        Ok(places)
    }

    /// The parts that a group begins, and what stands before the first one.
    pub fn split(self, code: u16) -> (Numbers<'a>, impl Iterator<Item = Numbers<'a>>) {
        let first = self.0.iter().position(|(c, _)| *c == code).unwrap_or(self.0.len());
        let (head, parts) = self.0.split_at(first);
        let mut rest = parts;
        let next = move || {
            let (_, tail) = rest.split_first()?;
            let length = 1 + tail.iter().position(|(c, _)| *c == code).unwrap_or(tail.len());
            let (part, behind) = rest.split_at(length);
            rest = behind;
            Some(Numbers(part))
        };
        (Numbers(head), std::iter::from_fn(next))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tags::Value;
    use super::*;

    fn record(kind: Kind, tags: &[(i32, &str)]) -> Record {
        let (mut record, mut names) = (Record::default(), Names::default());
        record.begin(kind, 0, 0, Place::Line(1));
        for (i, (code, value)) in tags.iter().enumerate() {
            let place = Place::Line(2 * i as u64);
            record.take(Tag { code: *code, value: Value::Text(value.as_bytes()), place }, &mut names);
        }
        record
    }

    #[test]
    fn attributes_and_geometry_are_kept_apart() {
        let r = record(
            Kind::Circle,
            &[
                (5, "2F"),
                (8, "Cut"),
                (60, "1"),
                (62, "3"),
                (67, "1"),
                (10, "1"),
                (20, "2"),
                (1000, "x"),
                (40, "3"),
            ],
        );
        assert_eq!((r.handle, r.color, r.paper, r.invisible), (Some(0x2F), 3, true, true));
        assert_eq!(r.numbers, [(10, 1.0), (20, 2.0), (40, 3.0)]);
        assert!(r.fault.is_none());
    }

    #[test]
    fn a_number_that_is_none_spoils_the_entity_where_it_stands() {
        let r = record(Kind::Line, &[(10, "1"), (20, "12,5mm"), (11, "nan"), (48, "x"), (70, "x")]);
        assert_eq!(r.fault.as_deref(), Some("`12,5mm` is no finite number"));
        assert_eq!(r.place, Place::Line(2));
        assert!(record(Kind::Other, &[(10, "x")]).fault.is_none());
    }

    #[test]
    fn numbers_are_split_into_parts() {
        let numbers = [(90, 2.0), (10, 1.0), (20, 2.0), (10, 3.0), (42, 0.5)];
        let (head, parts) = Numbers(&numbers).split(10);
        assert_eq!(head.0, &numbers[..1]);
        assert_eq!(parts.map(|p| p.0.to_vec()).collect::<Vec<_>>(), [&numbers[1..3], &numbers[3..]]);
        assert!(Numbers(&numbers).places(10).is_err() && Numbers(&numbers).need(11).is_err());
        assert_eq!(Numbers(&numbers[1..3]).places(10), Ok(vec![[1.0, 2.0, 0.0]]));
    }
}
