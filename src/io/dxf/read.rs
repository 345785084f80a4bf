//! From the bytes of a file to curves.

use super::binary::{is_binary, to_text};
use super::records::{Contents, KINDS};
use super::select::Selection;
use super::shape::{Skip, shape};
use super::skipped::Skipped;
use super::{Drawing, ReadOptions};
use crate::boundary::{Curve, Source};
use crate::error::Error;
use crate::io::{DrawingUnit, Scale, Warning};
use crate::tolerance::Units;
use ::dxf::entities::EntityType;
use std::borrow::Cow;
use std::io::Cursor;
use std::path::Path;

/// Largest file that is read, in bytes: the parser needs about twenty times as much memory.
const MAX_BYTES: u64 = 1 << 29;

/// Reads a drawing.
///
/// # Errors
///
/// [`Error::File`] if the file cannot be read, [`Error::NotADrawing`] if it is no DXF or is in
/// a unit that no part is drawn in, [`Error::Effort`] if it is larger than half a gigabyte.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Drawing, Error> {
    let name = path.display().to_string();
    let failed = |cause| Error::File { action: "read", path: name.clone(), cause };
    let size = std::fs::metadata(path).map_err(failed)?.len();
    if size > MAX_BYTES {
        return Err(Error::Effort { what: "reading the drawing (in bytes)", needed: size, limit: MAX_BYTES });
    }
    let bytes = std::fs::read(path).map_err(failed)?;
    let mut drawing = read_bytes(&bytes, &name, options)?;
    if let Some(file) = path.file_name() {
        drawing.name = file.to_string_lossy().into_owned();
    }
    Ok(drawing)
}

/// Reads a drawing from the bytes of a file; `name` stands in messages.
///
/// # Errors
///
/// As for [`read`], but for those of the file system.
pub fn read_bytes(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Drawing, Error> {
    let no_drawing = |reason: String| Error::NotADrawing { path: name.to_owned(), reason };
    if let Some(reason) = other_format(bytes) {
        return Err(no_drawing(reason.into()));
    }
    let text = if is_binary(bytes) { Cow::Owned(to_text(bytes).map_err(no_drawing)?) } else { bytes.into() };
    let mut contents = contents(&text).map_err(no_drawing)?;
    drop(text);
    let geometry = std::mem::take(&mut contents.geometry);
    let parsed = ::dxf::Drawing::load(&mut Cursor::new(geometry)).map_err(|e| no_drawing(e.to_string()))?;
    let unit = Unit::of(&contents, options);
    let units = options.units.or(unit.unit.job()).unwrap_or_default();
    let Some(scale) = Scale::new(unit.unit, units) else {
        return Err(no_drawing(format!("its unit is {}; tell its true unit with --dxf-units", unit.unit)));
    };
    let mut warnings: Vec<Warning> = unit.warning(units).into_iter().collect();
    if !contents.ended {
        warnings.push(Warning::Truncated);
    }
    let (curves, met) = curves(&contents, shapes(&parsed), scale, options);
    warnings.extend(met);
    Ok(Drawing { name: name.to_owned(), units, curves, warnings })
}

/// The curves of all entities that take part, and what there is to say about the others.
fn curves<'a>(
    contents: &Contents,
    shapes: impl Iterator<Item = (usize, &'a EntityType)>,
    scale: Scale,
    options: &ReadOptions,
) -> (Vec<Curve>, Vec<Warning>) {
    let mut selection = Selection::new(options, contents);
    let mut skipped = Skipped::default();
    let mut curves = Vec::new();
    let mut shapes = shapes.peekable();
    for (index, record) in contents.records.iter().enumerate() {
        let entity = shapes.next_if(|&(whose, _)| whose == index).map(|(_, entity)| entity);
        if !selection.takes(record) {
            continue;
        }
        if let Some(fault) = &record.fault {
            skipped.fault(record, fault.clone(), None);
            continue;
        }
        if !KINDS.contains(&record.kind.as_str()) {
            skipped.kind(&record.kind);
            continue;
        }
        let Some(entity) = entity else {
            skipped.fault(record, "it cannot be parsed".into(), None);
            continue;
        };
        match shape(entity, scale) {
            Ok(path) => {
                let source =
                    Source { kind: record.kind.clone(), handle: record.handle, layer: record.layer.clone() };
                curves.push(Curve { path, source });
            }
            Err(Skip::NotRead(form)) => skipped.form(form),
            Err(Skip::Fault(reason, at)) => skipped.fault(record, reason, at),
        }
    }
    (curves, skipped.warnings().chain(selection.warnings()).collect())
}

/// The contents of a text DXF.
fn contents(text: &[u8]) -> Result<Contents, String> {
    let contents = Contents::new(text).map_err(|bad| {
        format!(
            "line {} should hold the number of a group, but holds `{}`",
            bad.line,
            bad.found.escape_debug()
        )
    })?;
    if contents.sections || contents.ended { Ok(contents) } else { Err("it has no section of a DXF".into()) }
}

/// The parsed entities, each with the index of its record.
fn shapes(parsed: &::dxf::Drawing) -> impl Iterator<Item = (usize, &EntityType)> {
    parsed.entities().map(|entity| {
        let index = usize::try_from(entity.common.handle.0).unwrap_or(0).wrapping_sub(1);
        (index, &entity.specific)
    })
}

/// What a file is that is no DXF, as far as its first bytes tell, and what to do.
fn other_format(bytes: &[u8]) -> Option<&'static str> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let begins = |with: &[u8]| text.len() >= with.len() && text[..with.len()].eq_ignore_ascii_case(with);
    if text.is_empty() {
        return Some("the file is empty");
    }
    if begins(b"AC10") || begins(b"AC1.") || begins(b"AC2.") {
        return Some(
            "it is a DWG; save it as DXF in the drawing program, or convert it with LibreDWG: dwg2dxf",
        );
    }
    if begins(b"\xFF\xFE") || begins(b"\xFE\xFF") {
        return Some("it is UTF-16 text; save it as UTF-8 or ANSI");
    }
    if begins(b"AutoCAD DXB") {
        return Some("it is a DXB; save it as DXF in the drawing program");
    }
    if begins(b"<") {
        return Some("it is XML, perhaps an SVG; save it as DXF in the drawing program");
    }
    if begins(b"%PDF") || begins(b"PK\x03\x04") {
        return Some("it is a PDF or an archive; save the drawing in it as DXF");
    }
    None
}

/// The unit of a drawing and how it is known.
struct Unit {
    unit: DrawingUnit,
    /// Assumed, by the measurement flag or without any sign.
    assumed: Option<bool>,
}

impl Unit {
    fn of(contents: &Contents, options: &ReadOptions) -> Unit {
        let told = options.dxf_units.or(contents.insunits.and_then(DrawingUnit::from_dxf));
        if let Some(unit) = told.or(options.units.map(DrawingUnit::from)) {
            return Unit { unit, assumed: None };
        }
        match contents.measurement {
            Some(0) => Unit { unit: DrawingUnit::Inch, assumed: Some(true) },
            Some(1) => Unit { unit: DrawingUnit::Millimeter, assumed: Some(true) },
            _ => Unit { unit: DrawingUnit::Millimeter, assumed: Some(false) },
        }
    }

    fn warning(&self, job: Units) -> Option<Warning> {
        self.assumed.map(|flagged| Warning::UnitAssumed { unit: self.unit, job, flagged })
    }
}
