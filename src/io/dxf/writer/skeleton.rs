//! What a drawing of release 2000 holds besides its entities: header, tables, blocks, dictionaries.
//!
//! AutoCAD refuses a drawing without one of these tables, the two blocks of the spaces, or the root
//! dictionary; others would do with less.

use super::layer::Layer;
use super::pen::Pen;
use crate::geom::Bounds;
use crate::tolerance::Units;
use crate::toolpath::Point3;
use std::io;

/// Handle of the first entity; smaller ones belong to what stands here.
pub(super) const FIRST_ENTITY: u64 = 0x100;

/// The block record that owns the entities of the model space.
pub(super) const MODEL_SPACE: u64 = 0x1F;

const PAPER_SPACE: u64 = 0x1B;

/// The linetype of all layers.
const LINETYPE: &str = "CONTINUOUS";

/// Tables with their handles.
const VPORT: u64 = 0x8;
const LTYPE: u64 = 0x5;
const LAYER: u64 = 0x2;
const STYLE: u64 = 0x3;
const VIEW: u64 = 0x6;
const UCS: u64 = 0x7;
const APPID: u64 = 0x9;
const DIMSTYLE: u64 = 0xA;
const BLOCK_RECORD: u64 = 0x1;

/// Entries of the tables with their handles; those of the layers follow one another.
const ACTIVE_VIEW: u64 = 0x30;
const BY_BLOCK: u64 = 0x14;
const BY_LAYER: u64 = 0x15;
const CONTINUOUS: u64 = 0x16;
const LAYER_0: u64 = 0x40;
const STANDARD_STYLE: u64 = 0x11;
const ACAD: u64 = 0x12;
const STANDARD_DIMSTYLE: u64 = 0x27;

/// Begin and end of the blocks.
const MODEL_BLOCK: [u64; 2] = [0x20, 0x21];
const PAPER_BLOCK: [u64; 2] = [0x1C, 0x1D];

/// Dictionaries.
const ROOT: u64 = 0xC;
const GROUPS: u64 = 0xD;

/// What depends on the entities.
pub(super) struct Head {
    pub units: Units,
    pub bounds: Bounds,
    /// Lowest and highest place.
    pub heights: [f64; 2],
    /// A handle above all others.
    pub next_handle: u64,
}

impl Head {
    /// Corners of the box around everything; around nothing as drawing programs have it.
    fn extents(&self) -> [Point3; 2] {
        const NOTHING: f64 = 1e20;
        if self.bounds.is_empty() {
            return [NOTHING, -NOTHING].map(|c| Point3 { x: c, y: c, z: c });
        }
        [Point3::new(self.bounds.min, self.heights[0]), Point3::new(self.bounds.max, self.heights[1])]
    }
}

/// Everything before the entities.
pub(super) fn before(pen: &mut Pen, head: &Head) -> io::Result<()> {
    header(pen, head)?;
    pen.texts(&[(0, "SECTION"), (2, "CLASSES"), (0, "ENDSEC"), (0, "SECTION"), (2, "TABLES")])?;
    view(pen, head)?;
    linetypes(pen)?;
    layers(pen)?;
    style(pen)?;
    table(pen, "VIEW", VIEW, 0)?;
    pen.text(0, "ENDTAB")?;
    table(pen, "UCS", UCS, 0)?;
    pen.text(0, "ENDTAB")?;
    table(pen, "APPID", APPID, 1)?;
    record(pen, "APPID", ACAD, APPID, ["AcDbRegAppTableRecord", "ACAD"])?;
    pen.text(0, "ENDTAB")?;
    dimension_style(pen)?;
    table(pen, "BLOCK_RECORD", BLOCK_RECORD, 2)?;
    for (handle, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
        owned(pen, "BLOCK_RECORD", handle, BLOCK_RECORD)?;
        pen.texts(&[(100, "AcDbSymbolTableRecord"), (100, "AcDbBlockTableRecord"), (2, name)])?;
    }
    pen.texts(&[(0, "ENDTAB"), (0, "ENDSEC")])?;
    blocks(pen)?;
    pen.texts(&[(0, "SECTION"), (2, "ENTITIES")])
}

/// Everything after the entities.
pub(super) fn after(pen: &mut Pen) -> io::Result<()> {
    pen.texts(&[(0, "ENDSEC"), (0, "SECTION"), (2, "OBJECTS")])?;
    owned(pen, "DICTIONARY", ROOT, 0)?;
    pen.texts(&[(100, "AcDbDictionary"), (281, "1"), (3, "ACAD_GROUP")])?;
    pen.reference(350, GROUPS)?;
    owned(pen, "DICTIONARY", GROUPS, ROOT)?;
    pen.texts(&[(100, "AcDbDictionary"), (281, "1"), (0, "ENDSEC"), (0, "EOF")])
}

fn header(pen: &mut Pen, head: &Head) -> io::Result<()> {
    let (unit, metric) = match head.units {
        Units::Inch => (1, 0),
        Units::Mm => (4, 1),
    };
    pen.texts(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015")])?;
    pen.texts(&[(9, "$DWGCODEPAGE"), (3, "ANSI_1252"), (9, "$HANDSEED")])?;
    pen.reference(5, head.next_handle)?;
    let [min, max] = head.extents();
    pen.text(9, "$EXTMIN")?;
    pen.place(10, min)?;
    pen.text(9, "$EXTMAX")?;
    pen.place(10, max)?;
    pen.text(9, "$INSUNITS")?;
    pen.integer(70, unit)?;
    pen.text(9, "$MEASUREMENT")?;
    pen.integer(70, metric)?;
    pen.text(0, "ENDSEC")
}

/// The view on opening: everything, with a little room around it.
fn view(pen: &mut Pen, head: &Head) -> io::Result<()> {
    const ROOM: f64 = 1.1;
    const LENS: f64 = 50.0;
    const ASPECT: f64 = 1.5;
    let nothing = head.bounds.is_empty();
    let (center, extent) = (head.bounds.center(), head.bounds.extent());
    let (center, height) = match nothing {
        true => (Default::default(), 1.0),
        false => (center, ROOM * extent.y.max(extent.x / ASPECT).max(f64::MIN_POSITIVE)),
    };
    table(pen, "VPORT", VPORT, 1)?;
    record(pen, "VPORT", ACTIVE_VIEW, VPORT, ["AcDbViewportTableRecord", "*ACTIVE"])?;
    for (code, value) in [(10, 0.0), (20, 0.0), (11, 1.0), (21, 1.0), (12, center.x), (22, center.y)] {
        pen.number(code, value)?;
    }
    pen.place(16, Point3 { x: 0.0, y: 0.0, z: 1.0 })?;
    pen.place(17, Point3::default())?;
    for (code, value) in [(40, height), (41, ASPECT), (42, LENS)] {
        pen.number(code, value)?;
    }
    pen.text(0, "ENDTAB")
}

fn linetypes(pen: &mut Pen) -> io::Result<()> {
    table(pen, "LTYPE", LTYPE, 3)?;
    for (handle, name) in [(BY_BLOCK, "BYBLOCK"), (BY_LAYER, "BYLAYER"), (CONTINUOUS, LINETYPE)] {
        record(pen, "LTYPE", handle, LTYPE, ["AcDbLinetypeTableRecord", name])?;
        // No text, aligned as always, no dashes, no length.
        pen.texts(&[(3, ""), (72, "65"), (73, "0"), (40, "0.0")])?;
    }
    pen.text(0, "ENDTAB")
}

fn layers(pen: &mut Pen) -> io::Result<()> {
    const WHITE: i64 = 7;
    let all = std::iter::once(("0", WHITE)).chain(Layer::ALL.iter().map(|l| (l.name(), l.color())));
    table(pen, "LAYER", LAYER, Layer::ALL.len() as i64 + 1)?;
    for ((name, color), handle) in all.zip(LAYER_0..) {
        record(pen, "LAYER", handle, LAYER, ["AcDbLayerTableRecord", name])?;
        pen.integer(62, color)?;
        pen.text(6, LINETYPE)?;
    }
    pen.text(0, "ENDTAB")
}

/// The text style that dimensions and new texts ask for.
fn style(pen: &mut Pen) -> io::Result<()> {
    table(pen, "STYLE", STYLE, 1)?;
    record(pen, "STYLE", STANDARD_STYLE, STYLE, ["AcDbTextStyleTableRecord", "Standard"])?;
    pen.texts(&[(40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "1.0"), (3, "txt"), (4, "")])?;
    pen.text(0, "ENDTAB")
}

/// This table alone has a class of its own, and its entries write their handle as 105.
fn dimension_style(pen: &mut Pen) -> io::Result<()> {
    table(pen, "DIMSTYLE", DIMSTYLE, 1)?;
    pen.texts(&[(100, "AcDbDimStyleTable"), (71, "1"), (0, "DIMSTYLE")])?;
    pen.reference(105, STANDARD_DIMSTYLE)?;
    pen.reference(330, DIMSTYLE)?;
    pen.texts(&[(100, "AcDbSymbolTableRecord"), (100, "AcDbDimStyleTableRecord"), (2, "Standard")])?;
    pen.texts(&[(70, "0"), (0, "ENDTAB")])
}

fn blocks(pen: &mut Pen) -> io::Result<()> {
    pen.texts(&[(0, "SECTION"), (2, "BLOCKS")])?;
    let spaces = [(MODEL_SPACE, MODEL_BLOCK, "*Model_Space"), (PAPER_SPACE, PAPER_BLOCK, "*Paper_Space")];
    for (record, [begin, end], name) in spaces {
        owned(pen, "BLOCK", begin, record)?;
        pen.text(100, "AcDbEntity")?;
        if record == PAPER_SPACE {
            pen.text(67, "1")?;
        }
        pen.texts(&[(8, "0"), (100, "AcDbBlockBegin"), (2, name), (70, "0")])?;
        pen.place(10, Point3::default())?;
        pen.texts(&[(3, name), (1, "")])?;
        owned(pen, "ENDBLK", end, record)?;
        pen.text(100, "AcDbEntity")?;
        if record == PAPER_SPACE {
            pen.text(67, "1")?;
        }
        pen.texts(&[(8, "0"), (100, "AcDbBlockEnd")])?;
    }
    pen.text(0, "ENDSEC")
}

fn table(pen: &mut Pen, name: &str, handle: u64, entries: i64) -> io::Result<()> {
    pen.texts(&[(0, "TABLE"), (2, name)])?;
    pen.reference(5, handle)?;
    pen.reference(330, 0)?;
    pen.text(100, "AcDbSymbolTable")?;
    pen.integer(70, entries)
}

/// The head of an entry of a table: its class and name.
fn record(pen: &mut Pen, kind: &str, handle: u64, owner: u64, [class, name]: [&str; 2]) -> io::Result<()> {
    owned(pen, kind, handle, owner)?;
    pen.texts(&[(100, "AcDbSymbolTableRecord"), (100, class), (2, name), (70, "0")])
}

fn owned(pen: &mut Pen, kind: &str, handle: u64, owner: u64) -> io::Result<()> {
    pen.text(0, kind)?;
    pen.reference(5, handle)?;
    pen.reference(330, owner)
}
