//! Counts of what was not read, and of what was made simpler.

use super::BrokenEntity;
use super::record::Record;
use crate::geom::Point;
use crate::io::{Place, Warning};
use std::collections::BTreeMap;

/// Kinds that may be part of an outline and are not read.
const OUTLINES: [&str; 10] =
    ["HELIX", "MLINE", "SOLID", "TRACE", "3DFACE", "REGION", "3DSOLID", "BODY", "SURFACE", "MESH"];

/// As many entities with faults are listed one by one.
const MAX_BROKEN: usize = 10_000;

/// Everything that was met and not read as it was drawn, by kind and reason.
#[derive(Default)]
pub(super) struct Skipped {
    /// By kind and, if it may be part of an outline, layer.
    kinds: BTreeMap<(String, Option<String>), usize>,
    faults: BTreeMap<(String, String), First>,
    simplified: BTreeMap<(String, &'static str), First>,
    /// Those with faults, one by one.
    pub broken: Vec<BrokenEntity>,
}

/// How many, and the first of them.
struct First {
    count: usize,
    handle: Option<u64>,
    place: Place,
    at: Option<Point>,
}

impl Skipped {
    /// An entity of a kind that is not read.
    pub fn kind(&mut self, kind: &str, layer: &str) {
        if OUTLINES.contains(&kind) {
            return self.form(kind, layer);
        }
        *self.kinds.entry((kind.to_owned(), None)).or_default() += 1;
    }

    /// An entity of a kind that is read, in a form that is not, or that becomes one.
    pub fn form(&mut self, form: &str, layer: &str) {
        *self.kinds.entry((form.to_owned(), Some(layer.to_owned()))).or_default() += 1;
    }

    /// An entity with something wrong.
    pub fn fault(&mut self, kind: &str, record: &Record, reason: &str, at: Option<Point>) {
        if self.broken.len() < MAX_BROKEN {
            let (kind, reason) = (kind.to_owned(), reason.to_owned());
            let (handle, place) = (record.handle, record.place);
            self.broken.push(BrokenEntity { kind, handle, place, reason, at });
        }
        count(&mut self.faults, (kind.to_owned(), reason.to_owned()), record, at);
    }

    /// An entity of which something was ignored.
    pub fn simplified(&mut self, kind: &str, record: &Record, how: &'static str, at: Option<Point>) {
        count(&mut self.simplified, (kind.to_owned(), how), record, at);
    }

    /// One warning per kind, fault and simplification.
    pub fn warnings(self) -> impl Iterator<Item = Warning> {
        let kinds =
            self.kinds.into_iter().map(|((entity, layer), count)| Warning::NotRead { entity, count, layer });
        let faults = self.faults.into_iter().map(|((entity, reason), first)| {
            let First { count, handle, place, at } = first;
            Warning::EntitySkipped { entity, handle, place, reason, count, at }
        });
        let simplified = self.simplified.into_iter().map(|((entity, how), first)| {
            let First { count, handle, place, at } = first;
            Warning::Simplified { entity, handle, place, how, count, at }
        });
        kinds.chain(faults).chain(simplified)
    }
}

fn count<K: Ord>(firsts: &mut BTreeMap<K, First>, key: K, record: &Record, at: Option<Point>) {
    let first = First { count: 0, handle: record.handle, place: record.place, at };
    firsts.entry(key).or_insert(first).count += 1;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn equal_faults_are_one_warning_with_the_first_place() {
        let mut skipped = Skipped::default();
        for (handle, x) in [(7, 1.0), (8, 2.0)] {
            let record = Record { handle: Some(handle), place: Place::Line(2 * handle), ..Record::default() };
            skipped.fault("ARC", &record, "its radius is 0", Some(point(x, 0.0)));
            skipped.simplified("LINE", &record, "its height is ignored", None);
        }
        for (kind, layer) in [("TEXT", "0"), ("SOLID", "Cut"), ("TEXT", "Notes"), ("SOLID", "Old")] {
            skipped.kind(kind, layer);
        }
        let warnings: Vec<String> = skipped.warnings().map(|w| w.to_string()).collect();
        assert_eq!(
            warnings,
            [
                "SOLID: 1 on layer `Cut` not read",
                "SOLID: 1 on layer `Old` not read",
                "TEXT: 2 skipped, no outline",
                "ARC 7 (line 14) and 1 more skipped: its radius is 0",
                "LINE 7 (line 14) and 1 more: its height is ignored",
            ]
        );
    }
}
