//! Findings: everything that was left out, assumed or mended, with numbers.

use medial::io::Warning;
use medial::io::dxf::BrokenEntity;
use medial::{Bounds, Defect, Point};
use serde::Serialize;

/// Something to know about a drawing.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// From 1; the picture shows it.
    pub number: usize,
    pub weight: Weight,
    pub kind: &'static str,
    pub message: String,
    /// The first of the places.
    pub at: Option<Point>,
    pub help: String,
    /// All places that are known; of a note the first.
    pub places: Vec<Point>,
    /// Entities that are concerned, as far as they are named one by one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub entities: Vec<BrokenEntity>,
}

/// Gaps wider than this part of the drawing are not closed by joining: much else is as near.
const WIDE: f64 = 0.02;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weight {
    /// Something is left out that may be part of a contour.
    Fault,
    /// Something was assumed, mended or passed over.
    Note,
}

impl Weight {
    fn of(warning: &Warning) -> Weight {
        match warning {
            Warning::Simplified { .. }
            | Warning::Mended { .. }
            | Warning::LayerSkipped { .. }
            | Warning::InvisibleSkipped { .. }
            | Warning::PaperSpaceSkipped { .. }
            | Warning::UnitAssumed { .. }
            | Warning::OriginMoved { .. }
            | Warning::OutlineOfPart { .. }
            | Warning::NotRead { layer: None, .. } => Weight::Note,
            // Nothing is lost with it.
            Warning::EntitySkipped { reason, .. } if reason == "it has no length" => Weight::Note,
            Warning::Defect(
                Defect::Duplicates { .. }
                | Defect::Overlaps { .. }
                | Defect::Divided { .. }
                | Defect::Healed { .. },
            ) => Weight::Note,
            _ => Weight::Fault,
        }
    }
}

/// Numbers the findings, faults first.
pub fn findings(warnings: &[Warning], broken: &[BrokenEntity], bounds: Bounds) -> Vec<Finding> {
    let mut findings: Vec<Finding> =
        warnings.iter().map(|w| Finding { help: help(w, bounds), ..finding(w, broken) }).collect();
    findings.sort_by_key(|f| f.weight);
    for (i, finding) in findings.iter_mut().enumerate() {
        finding.number = i + 1;
    }
    findings
}

/// What to do; a gap that is no slip of the pen is not for `--join`.
fn help(warning: &Warning, bounds: Bounds) -> String {
    match warning {
        Warning::Defect(Defect::OpenContour { gap, .. }) if *gap > WIDE * bounds.diagonal() => {
            "draw what is missing between its ends, or leave it out with --skip-layer if it is no contour"
                .into()
        }
        _ => warning.help(),
    }
}

fn finding(warning: &Warning, broken: &[BrokenEntity]) -> Finding {
    let entities: Vec<BrokenEntity> = match warning {
        Warning::EntitySkipped { entity, reason, .. } => {
            broken.iter().filter(|b| b.kind == *entity && b.reason == *reason).cloned().collect()
        }
        _ => Vec::new(),
    };
    let weight = Weight::of(warning);
    let mut places: Vec<Point> = match warning {
        Warning::Defect(Defect::OpenContour { start, end, .. }) => vec![*start, *end],
        _ if weight == Weight::Note => Vec::new(),
        _ => entities.iter().filter_map(|b| b.at).collect(),
    };
    places.dedup();
    if places.is_empty() {
        places.extend(warning.at());
    }
    Finding {
        number: 0,
        weight,
        kind: warning.kind(),
        message: warning.to_string(),
        at: warning.at(),
        help: warning.help(),
        places,
        entities,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::{io::Place, point};

    #[test]
    fn faults_come_first_and_are_numbered_through() {
        let (at, end) = (point(1.0, 2.0), point(3.0, 4.0));
        let skipped = Warning::EntitySkipped {
            entity: "ARC".into(),
            handle: None,
            place: Place::Line(1),
            reason: "its radius is 0".into(),
            count: 2,
            at: Some(at),
        };
        let broken = [at, end].map(|at| BrokenEntity {
            kind: "ARC".into(),
            handle: Some(1),
            place: Place::Line(1),
            reason: "its radius is 0".into(),
            at: Some(at),
        });
        let open = Defect::OpenContour { start: at, end, gap: 1.0, inside: false };
        let warnings = [Warning::Truncated, Defect::Duplicates { count: 1, at }.into(), open.into(), skipped];
        let found = findings(&warnings, &broken, Bounds::around([at, end]));
        assert!(found[1].help.contains("draw what is missing"));
        let kinds: Vec<_> =
            found.iter().map(|f| (f.number, f.kind, f.places.len(), f.entities.len())).collect();
        assert_eq!(
            kinds,
            [
                (1, "truncated", 0, 0),
                (2, "open-contour", 2, 0),
                (3, "entity-skipped", 2, 2),
                (4, "duplicates", 1, 0)
            ]
        );
    }
}
