//! All that is told of a drawing.

use super::content::Content;
use super::contours::{PocketReport, contours};
use super::finding::{Finding, findings};
use crate::plan::nothing;
use medial::io::Warning;
use medial::io::dxf::Drawing;
use medial::io::svg::Picture;
use medial::{Bounds, Error, Pockets, Point, Tolerance, Units};
use serde::Serialize;

/// A drawing that was looked at. Lengths are in the unit of the job.
#[derive(Serialize)]
pub struct Inspection {
    pub source: String,
    pub units: Units,
    /// Box around all lines and arcs that take part.
    pub bounds: Option<Bounds>,
    #[serde(flatten)]
    pub content: Content,
    pub tolerance: f64,
    pub join: f64,
    /// Nesting depth at which pockets begin.
    pub from_depth: usize,
    pub pockets: Vec<PocketReport>,
    pub findings: Vec<Finding>,
    pub machinable: bool,
    /// Why nothing can be machined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    #[serde(skip)]
    drawing: Drawing,
    #[serde(skip)]
    found: Pockets,
}

impl Inspection {
    /// Looks at a drawing.
    pub fn new(drawing: Drawing, tolerance: Tolerance, from_depth: usize) -> Result<Inspection, Error> {
        let found = Pockets::from_curves_at_depth(&drawing.curves, tolerance, from_depth)?;
        let mut warnings = drawing.warnings.clone();
        warnings.extend(found.defects.iter().cloned().map(Warning::from));
        if from_depth == 0 {
            warnings.extend(found.lone_outline().map(|at| Warning::OutlineOfPart { at }));
        }
        let machinable = !found.pockets.is_empty();
        let why = || nothing(drawing.curves.is_empty(), found.defects.is_empty(), from_depth);
        Ok(Inspection {
            source: drawing.name.clone(),
            units: drawing.units,
            bounds: Some(drawing.bounds()).filter(|b| !b.is_empty()),
            content: Content::of(&drawing),
            tolerance: tolerance.fit,
            join: tolerance.join,
            from_depth,
            pockets: contours(&found, from_depth),
            findings: findings(&warnings, &drawing.inventory.broken, drawing.bounds()),
            machinable,
            reason: (!machinable).then(why),
            drawing,
            found,
        })
    }

    /// One object and a line feed.
    pub fn json(&self) -> String {
        serde_json::to_string(self).map_or_else(|e| format!("{{\"error\":\"{e}\"}}\n"), |text| text + "\n")
    }

    /// Pockets, what is in none, and the findings with their numbers.
    pub fn picture(&self) -> String {
        let marks = self.findings.iter().flat_map(|f| {
            let places = f.places.iter().filter(|&&p| self.is_in_picture(p));
            places.map(|&p| (p, f.number, f.message.clone()))
        });
        let picture = Picture::new(self.units).title(&self.source).pockets(&self.found.pockets);
        let picture = picture.unused(self.drawing.curves.iter().map(|c| &c.path)).free(&self.drawing.free);
        let captions = self.pockets.iter().filter_map(|p| {
            let disk = p.largest_disk?;
            Some((disk.center, disk.radius, format!("pocket {}", p.number)))
        });
        picture.captions(captions).numbered(marks).to_svg()
    }

    /// Whether a place is near enough to the part that it does not make the picture of it small.
    pub fn is_in_picture(&self, place: Point) -> bool {
        self.bounds.is_none_or(|b| b.grown(0.5 * b.diagonal()).contains(place))
    }
}
