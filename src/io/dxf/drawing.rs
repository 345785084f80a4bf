//! What is read from a file, and what a caller may ask for.

use super::{Color, Inventory};
use crate::boundary::{Curve, FreeCurve, FreeShape};
use crate::geom::{Bounds, Point, Vector, point};
use crate::io::{DrawingUnit, Warning};
use crate::tolerance::Units;
use serde::Serialize;
use std::time::Duration;

/// The curves of a drawing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Drawing {
    /// Name of the file without its folder.
    pub name: String,
    /// The unit of the job, in which all coordinates are.
    pub units: Units,
    /// The curves of segments and arcs in the order of the file; those of blocks come last.
    pub curves: Vec<Curve>,
    /// Ellipses and splines that could not be fitted, as they are drawn; a warning says why. Those
    /// that could are arcs and segments at the end of [`curves`](Drawing::curves).
    pub free: Vec<FreeCurve>,
    /// What became of the others.
    pub fitted: Fitted,
    /// The place of the drawing that the origin was moved to, and that all places are told from;
    /// `(0, 0)` unless [`ReadOptions::origin`] asks for another.
    pub origin: Point,
    /// What was left out, assumed or mended.
    pub warnings: Vec<Warning>,
    /// Everything that the file holds, also what is left out.
    pub inventory: Inventory,
}

/// How ellipses and splines became arcs and segments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Fitted {
    /// How many curves were fitted.
    pub curves: usize,
    /// How many arcs and segments they became.
    pub elements: usize,
    /// No place of any is farther from its curve than this, nor the other way, in job units.
    pub bound: f64,
    /// How many elements the polylines had in which arcs took the place of chords.
    pub chords: usize,
    /// How many elements those polylines have now.
    pub arcs_of_chords: usize,
    /// How long that took.
    #[serde(skip)]
    pub time: Duration,
}

/// The largest distance between a drawn curve and its arcs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitTolerance {
    /// In millimeters, for a job in millimeters.
    pub mm: f64,
    /// In inches, for a job in inches.
    pub inch: f64,
}

impl FitTolerance {
    /// That of a job in a unit.
    pub(super) fn of(self, units: Units) -> f64 {
        match units {
            Units::Mm => self.mm,
            Units::Inch => self.inch,
        }
    }
}

/// What of a drawing to read, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadOptions {
    /// The unit of the job; `None` takes inches for a drawing in inches, mils, feet or yards and
    /// millimeters for any other.
    pub units: Option<Units>,
    /// The unit that the drawing is in, whatever it claims.
    pub dxf_units: Option<DrawingUnit>,
    /// A factor for all coordinates, above 0.
    pub scale: f64,
    /// Names of the layers to read, with `*` for anything; all if empty.
    pub layers: Vec<String>,
    /// Names of layers to leave out, with `*` for anything.
    pub skip_layers: Vec<String>,
    /// Colors to read; all if empty. An entity may have the color of its layer or its block.
    pub colors: Vec<Color>,
    /// Whether to read layers that are off or frozen, and invisible entities.
    pub hidden: bool,
    /// Whether to read the boundaries of hatched areas.
    pub hatch: bool,
    /// Where the origin of the job lies.
    pub origin: Origin,
    /// How near to ellipses and splines their arcs must be.
    pub fit: FitTolerance,
    /// How near to runs of chords of polylines arcs must be that take their place; `None` leaves all
    /// chords as drawn.
    pub chords: Option<FitTolerance>,
}

impl Default for ReadOptions {
    fn default() -> ReadOptions {
        ReadOptions {
            units: None,
            dxf_units: None,
            scale: 1.0,
            layers: Vec::new(),
            skip_layers: Vec::new(),
            colors: Vec::new(),
            hidden: false,
            hatch: false,
            origin: Origin::Dxf,
            fit: FitTolerance { mm: Units::Mm.tolerance().fit, inch: Units::Inch.tolerance().fit },
            chords: None,
        }
    }
}

/// Where the origin of the job lies in the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// Where the drawing has it.
    #[default]
    Dxf,
    /// At the lower left corner of the box around all curves that were read.
    Min,
    /// At the center of that box.
    Center,
}

impl Drawing {
    /// The box around all curves of segments and arcs.
    pub fn bounds(&self) -> Bounds {
        self.curves.iter().fold(Bounds::EMPTY, |b, c| b.union(c.path.bounds()))
    }

    /// Moves all curves and the places of all warnings so that the origin lies where it is wanted.
    pub(super) fn move_origin(&mut self, origin: Origin) {
        let bounds = self.bounds();
        let to = match origin {
            _ if bounds.is_empty() => return,
            Origin::Dxf => return,
            Origin::Min => bounds.min,
            Origin::Center => bounds.center(),
        };
        let by = point(0.0, 0.0) - to;
        self.origin = to;
        for vertex in self.curves.iter_mut().flat_map(|c| &mut c.path.vertices) {
            vertex.point += by;
        }
        self.free.iter_mut().for_each(|free| move_free(free, by));
        self.warnings.iter_mut().for_each(|warning| warning.move_by(by));
        let places = self.inventory.broken.iter_mut().filter_map(|b| b.at.as_mut());
        places.for_each(|at| *at += by);
        self.warnings.push(Warning::OriginMoved { to });
    }
}

fn move_free(free: &mut FreeCurve, by: Vector) {
    match &mut free.shape {
        FreeShape::Ellipse(ellipse) => ellipse.center += by,
        FreeShape::Spline(spline) => {
            spline.control.iter_mut().chain(&mut spline.fit).for_each(|p| *p += by);
        }
    }
}
