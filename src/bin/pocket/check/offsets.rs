//! The offsets to judge, in the unit and place of the drawing, each with its distance.

use super::args::CheckArgs;
use super::json;
use crate::failure::Failure;
use crate::notice::Notice;
use medial::io::DrawingUnit;
use medial::io::dxf::{self, Drawing, Origin, ReadOptions, UnitReason};
use medial::verify::{Boundary, chained};
use medial::{ArcSpline, Point, Units, point};

/// The offsets at one distance, as they are judged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offsets {
    pub distance: f64,
    pub curves: Vec<ArcSpline>,
}

/// Curves, each with its distance where the file knows it.
type Curves = Vec<(Option<f64>, ArcSpline)>;

/// Reads the offsets of a drawing, one group for each distance, growing.
pub fn read(
    args: &CheckArgs,
    part: &Drawing,
    boundary: &Boundary,
    notices: &mut Vec<Notice>,
) -> Result<Vec<Offsets>, Failure> {
    let is_json = args.offsets.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let curves = if is_json { of_json(args, part)? } else { of_dxf(args, part, notices)? };
    let mut distances: Vec<f64> = args.distances.iter().map(|d| d.to(part.units)).collect();
    if distances.is_empty() {
        distances = curves.iter().filter_map(|c| c.0).collect();
    }
    distances.sort_by(f64::total_cmp);
    distances.dedup();
    if distances.is_empty() {
        return Err(Failure::usage(
            "the distance of the offsets is not known",
            "say it: --distance 1.5, or several times for several levels",
        ));
    }
    let join = args.reading.tolerance(part.units).join;
    Ok(grouped(curves, &distances, boundary, join))
}

fn of_json(args: &CheckArgs, part: &Drawing) -> Result<Curves, Failure> {
    let loops = json::read(&args.offsets)?;
    let unit = told_unit(args)?.or(loops.units.map(DrawingUnit::from));
    let factor = unit.map_or(Some(1.0), |unit| length_of(unit, part.units));
    let factor =
        factor.ok_or_else(|| Failure::usage("the unit of the offsets is no length", "write mm or in"))?;
    let place = |p: Point| point(factor * p.x, factor * p.y);
    let curves = loops.curves.into_iter();
    Ok(curves.map(|(d, c)| (d.map(|d| factor * d), c.mapped(false, place))).collect())
}

/// A unit of a drawing in the unit of the job.
fn length_of(unit: DrawingUnit, job: Units) -> Option<f64> {
    medial::io::Scale::new(unit, job).map(|scale| scale.length(1.0))
}

fn told_unit(args: &CheckArgs) -> Result<Option<DrawingUnit>, Failure> {
    let unit = args.offsets_units.as_deref().map(str::parse).transpose();
    unit.map_err(|reason: String| {
        Failure::usage(format!("--offsets-units: {reason}"), "write mm, cm, m, in, ft, mil ...")
    })
}

fn of_dxf(args: &CheckArgs, part: &Drawing, notices: &mut Vec<Notice>) -> Result<Curves, Failure> {
    let mut options = ReadOptions {
        units: Some(part.units),
        dxf_units: told_unit(args)?,
        layers: args.offsets_layers.clone(),
        origin: Origin::Dxf,
        ..args.reading.options()?
    };
    (options.skip_layers, options.colors) = (Vec::new(), Vec::new());
    let mut theirs = dxf::read(&args.offsets, &options)?;
    let claims = matches!(theirs.inventory.reason, UnitReason::Told | UnitReason::Claimed);
    if !claims && theirs.inventory.unit != part.inventory.unit {
        options.dxf_units = Some(part.inventory.unit);
        theirs = dxf::read(&args.offsets, &options)?;
    }
    let warnings = theirs.warnings.iter().filter(|w| !matches!(w, medial::io::Warning::UnitAssumed { .. }));
    notices.extend(warnings.map(|w| Notice::from(w).about("offsets")));
    let moved = |p: Point| p - part.origin.to_vector();
    Ok(theirs.curves.iter().map(|c| (None, c.path.mapped(false, moved))).collect())
}

/// Loops for each distance: those that know theirs, and those that are nearest to it.
fn grouped(curves: Curves, distances: &[f64], boundary: &Boundary, join: f64) -> Vec<Offsets> {
    let mut levels: Vec<Offsets> =
        distances.iter().map(|&distance| Offsets { distance, curves: Vec::new() }).collect();
    let (known, unknown): (Curves, Curves) = curves.into_iter().partition(|c| c.0.is_some());
    for (distance, curve) in known {
        let same = |o: &&mut Offsets| distance.is_some_and(|d| same(d, o.distance));
        if let Some(level) = levels.iter_mut().find(same) {
            level.curves.push(curve);
        }
    }
    let unknown: Vec<ArcSpline> = unknown.into_iter().map(|c| c.1).collect();
    for curve in chained(&unknown, join) {
        let kept = kept_distance(&curve, boundary);
        let off = |o: &&mut Offsets| (o.distance - kept).abs();
        if let Some(level) = levels.iter_mut().min_by(|a, b| off(a).total_cmp(&off(b))) {
            level.curves.push(curve);
        }
    }
    levels
}

/// Whether a distance is that of a level, as it was typed: decimal fractions differ by round-off.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 16.0 * f64::EPSILON * a.abs().max(b.abs())
}

/// The distance that a curve keeps, as far as it keeps one: the median over a few places.
fn kept_distance(curve: &ArcSpline, boundary: &Boundary) -> f64 {
    const PLACES: usize = 15;
    let step = curve.len().div_ceil(PLACES).max(1);
    let mut distances: Vec<f64> =
        curve.elements().step_by(step).map(|e| boundary.distance(e.midpoint())).collect();
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 2).copied().unwrap_or(0.0)
}
