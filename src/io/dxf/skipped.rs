//! Counts of what was not read.

use super::records::Record;
use crate::geom::Point;
use crate::io::Warning;
use std::collections::BTreeMap;

/// Kinds that may be part of an outline and are not read yet.
const OUTLINES: [&str; 11] = [
    "SPLINE", "ELLIPSE", "INSERT", "HELIX", "MLINE", "SOLID", "TRACE", "3DFACE", "3DLINE", "REGION",
    "3DSOLID",
];

/// Everything that was met and not read, by kind and reason.
#[derive(Default)]
pub(super) struct Skipped {
    kinds: BTreeMap<String, (usize, bool)>,
    faults: BTreeMap<(String, String), Fault>,
}

/// The first entity with a fault, and how many have it.
struct Fault {
    count: usize,
    handle: Option<u64>,
    at: Option<Point>,
}

impl Skipped {
    /// An entity of a kind that is not read.
    pub fn kind(&mut self, kind: &str) {
        self.count(kind, OUTLINES.contains(&kind));
    }

    /// An entity of a kind that is read, in a form that is not.
    pub fn form(&mut self, form: &str) {
        self.count(form, true);
    }

    fn count(&mut self, kind: &str, outline: bool) {
        self.kinds.entry(kind.to_owned()).or_insert((0, outline)).0 += 1;
    }

    /// An entity with something wrong.
    pub fn fault(&mut self, record: &Record, reason: String, at: Option<Point>) {
        self.faults
            .entry((record.kind.clone(), reason))
            .or_insert(Fault { count: 0, handle: record.handle, at })
            .count += 1;
    }

    /// One warning per kind and per fault.
    pub fn warnings(self) -> impl Iterator<Item = Warning> {
        let kinds = self.kinds.into_iter().map(|(entity, (count, outline))| Warning::NotRead {
            entity,
            count,
            outline,
        });
        let faults = self.faults.into_iter().map(|((entity, reason), Fault { count, handle, at })| {
            Warning::EntitySkipped { entity, handle, reason, count, at }
        });
        kinds.chain(faults)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn equal_faults_are_one_warning_with_the_first_place() {
        let mut skipped = Skipped::default();
        for (handle, x) in [(7, 1.0), (8, 2.0)] {
            let record = Record { kind: "ARC".into(), handle: Some(handle), ..Record::default() };
            skipped.fault(&record, "its radius is 0".into(), Some(point(x, 0.0)));
        }
        for kind in ["TEXT", "SPLINE", "TEXT"] {
            skipped.kind(kind);
        }
        let warnings: Vec<String> = skipped.warnings().map(|w| w.to_string()).collect();
        assert_eq!(
            warnings,
            [
                "SPLINE: 1 not read yet",
                "TEXT: 2 skipped, no outline",
                "ARC 7 and 1 more skipped: its radius is 0"
            ]
        );
    }
}
