//! From a file to a drawing.

use super::buffer::Buffer;
use super::magic::other_format;
use super::mend::Mend;
use super::scan::Scan;
use super::tags::{Broken, Tags};
use super::unit::{Header, Unit};
use super::{Drawing, Inventory, ReadOptions};
use crate::error::Error;
use crate::io::{Scale, Warning};
use crate::tolerance::Units;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Sizes of a part outside of which its unit is probably another, in millimeters: no router bed
/// is as long as the one, and no pocket as small as the other can be cut.
const PLAUSIBLE_MM: std::ops::RangeInclusive<f64> = 0.5..=30_000.0;

/// Reads a drawing.
///
/// # Errors
///
/// [`Error::File`] if the file cannot be read, [`Error::NotADrawing`] if it is no DXF,
/// [`Error::Unit`] if no part is drawn in its unit, [`Error::Effort`] if it or its blocks hold too much,
/// [`Error::Parameter`] if [`ReadOptions::scale`] is no factor.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Drawing, Error> {
    let name = path.display().to_string();
    let mut file =
        File::open(path).map_err(|cause| Error::File { action: "read", path: name.clone(), cause })?;
    let mut drawing = read_from(&mut file, &name, options)?;
    if let Some(file) = path.file_name() {
        drawing.name = file.to_string_lossy().into_owned();
    }
    Ok(drawing)
}

/// Reads a drawing from the bytes of a file; `name` stands in messages.
///
/// # Errors
///
/// As for [`read`].
pub fn read_bytes(mut bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Drawing, Error> {
    read_from(&mut bytes, name, options)
}

/// Reads a drawing from a stream, which is never held as a whole; `name` stands in messages.
///
/// # Errors
///
/// As for [`read`].
pub fn read_from(source: &mut dyn Read, name: &str, options: &ReadOptions) -> Result<Drawing, Error> {
    if !(options.scale > 0.0 && options.scale.is_finite()) {
        return Err(Error::Parameter { name: "scale", value: options.scale, range: "above 0" });
    }
    let failed = |cause| Error::File { action: "read", path: name.to_owned(), cause };
    let no_drawing = |reason: String| Error::NotADrawing { path: name.to_owned(), reason };
    let mut buffer = Buffer::new(source);
    buffer.has(1).map_err(failed)?;
    if let Some(reason) = other_format(buffer.rest()) {
        return Err(no_drawing(reason.into()));
    }
    let mut tags = Tags::new(buffer).map_err(failed)?;
    let mut scan = Scan::new(options);
    let ended = scan_all(&mut tags, &mut scan, name, options)?;
    if !(scan.sections || ended) {
        return Err(no_drawing("it has no section of a DXF".into()));
    }
    scan.mends.count_all(Mend::BlankLine, tags.blanks());
    let binary = matches!(tags, Tags::Binary(_));
    let mut drawing = finish(scan, ended, name, options)?;
    drawing.inventory.binary = binary;
    Ok(drawing)
}

/// Takes all tags; answers whether the end mark was met.
fn scan_all(tags: &mut Tags, scan: &mut Scan, name: &str, options: &ReadOptions) -> Result<bool, Error> {
    let scale = |header| scale(header, name, options).map(|(_, _, scale)| scale);
    loop {
        match tags.next() {
            Ok(Some(tag)) if tag.code == 0 && tag.value.text() == b"EOF" => {
                scan.finish(false)?;
                return Ok(true);
            }
            Ok(Some(tag)) => scan.take(tag, scale)?,
            Ok(None) => break,
            Err(Broken::Io(cause)) => {
                return Err(Error::File { action: "read", path: name.to_owned(), cause });
            }
            Err(Broken::Code { place, .. }) if scan.entities_done => {
                scan.mends.count(Mend::Tail, place);
                break;
            }
            Err(Broken::Code { place, found }) => {
                let found = found.escape_debug();
                let reason = format!("{place} should hold the number of a group, but holds `{found}`");
                return Err(Error::NotADrawing { path: name.to_owned(), reason });
            }
        }
    }
    scan.finish(true)?;
    Ok(false)
}

/// The unit of the drawing, that of the job, and the way from one to the other.
fn scale(header: Header, name: &str, options: &ReadOptions) -> Result<(Unit, Units, Scale), Error> {
    let unit = Unit::of(header, options);
    let job = options.units.or(unit.unit.job()).unwrap_or_default();
    match Scale::new(unit.unit, job) {
        Some(scale) => Ok((unit, job, scale.times(options.scale))),
        None => Err(Error::Unit { path: name.to_owned(), unit: unit.unit.name() }),
    }
}

/// Everything that is known at the end.
fn finish(scan: Scan, ended: bool, name: &str, options: &ReadOptions) -> Result<Drawing, Error> {
    let (unit, units, _) = scale(scan.header, name, options)?;
    let claimed = scan.header.claimed();
    let Scan { mut collection, mut mends, tables, version, .. } = scan;
    let mut warnings: Vec<Warning> = unit.warning(units).into_iter().collect();
    if !ended {
        warnings.push(Warning::Truncated);
    }
    mends.count_all(Mend::VertexCount, collection.miscounted);
    warnings.extend(mends.warnings());
    let inventory = Inventory {
        version,
        binary: false,
        claimed,
        unit: unit.unit,
        reason: unit.reason,
        layers: collection.tally.layers(&tables),
        broken: std::mem::take(&mut collection.skipped.broken),
    };
    warnings.extend(collection.skipped.warnings());
    warnings.extend(collection.selection.warnings(&tables.names));
    let name = name.to_owned();
    let mut drawing =
        Drawing { name, units, curves: collection.curves, warnings, inventory, ..Drawing::default() };
    if let Some(tolerance) = options.chords {
        drawing.fit_chords(tolerance);
    }
    drawing.fit(collection.free, options.fit);
    drawing.warnings.extend(implausible(&drawing, &unit));
    drawing.move_origin(options.origin);
    Ok(drawing)
}

/// A part that is too large or too small for its unit.
fn implausible(drawing: &Drawing, unit: &Unit) -> Option<Warning> {
    let bounds = drawing.bounds();
    if bounds.is_empty() {
        return None;
    }
    let (width, height) = (bounds.extent().x, bounds.extent().y);
    let in_mm = Scale::new(drawing.units.into(), Units::Mm)?.length(width.max(height));
    let (at, job, unit) = (bounds.center(), drawing.units, unit.unit);
    let warning = Warning::ImplausibleSize { width, height, job, unit, large: in_mm > 1.0, at };
    (!PLAUSIBLE_MM.contains(&in_mm)).then_some(warning)
}
