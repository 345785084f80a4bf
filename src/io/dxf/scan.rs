//! The sections of a file, tag by tag.
//!
//! **Needs** tags. **Guarantees** that every entity of the section ENTITIES reaches the
//! collection once, in its order, and those of blocks once for each insert; entities that cannot
//! be read are named with the reason. **Does not** hold more than the blocks and the entity at
//! hand. All other sections, kinds and groups are passed over.

use super::ReadOptions;
use super::collect::{Collection, Tables};
use super::insert::{Block, Blocks};
use super::mend::{Mend, Mends};
use super::number::{Reading, number, whole};
use super::record::{Kind, Record, Taken, VERTEX};
use super::tags::Tag;
use super::unit::Header;
use crate::error::Error;
use crate::io::{Place, Scale};

/// As many numbers of one entity are held in memory.
const MAX_NUMBERS: u64 = 50_000_000;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Section {
    #[default]
    None,
    /// Its name comes next.
    Named,
    Header,
    Tables,
    Blocks,
    Entities,
    Other,
}

/// What the tags at hand belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Part {
    /// Nothing that is read.
    #[default]
    None,
    /// The head of a block.
    Block,
    Entity,
    Vertex,
}

/// Everything that the tags said so far.
pub(super) struct Scan<'a> {
    pub header: Header,
    pub version: Option<String>,
    pub tables: Tables,
    pub blocks: Blocks,
    pub collection: Collection<'a>,
    pub mends: Mends,
    /// Whether any section was found, or an entity.
    pub sections: bool,
    /// Whether the entities were read to their end.
    pub entities_done: bool,
    hatch: bool,
    section: Section,
    variable: Vec<u8>,
    /// The block at hand, with its name and its place.
    block: Option<(String, Block, Place)>,
    part: Part,
    record: Record,
    open: bool,
}

impl<'a> Scan<'a> {
    pub fn new(options: &'a ReadOptions) -> Scan<'a> {
        Scan {
            header: Header::default(),
            version: None,
            tables: Tables::default(),
            blocks: Blocks::default(),
            collection: Collection::new(options),
            mends: Mends::default(),
            sections: false,
            entities_done: false,
            hatch: options.hatch,
            section: Section::None,
            variable: Vec::new(),
            block: None,
            part: Part::None,
            record: Record::default(),
            open: false,
        }
    }

    /// Takes the next tag; `scale` tells what becomes of lengths when the entities begin.
    pub fn take(&mut self, tag: Tag, scale: impl Fn(Header) -> Result<Scale, Error>) -> Result<(), Error> {
        let begins = tag.code == 0 && tag.value.text() == b"SECTION";
        if begins || (tag.code == 0 && tag.value.text() == b"ENDSEC") {
            if begins && self.section != Section::None {
                self.mends.count(Mend::NestedSection, tag.place);
            }
            self.end_section()?;
            self.section = if begins { Section::Named } else { Section::None };
            return Ok(());
        }
        match self.section {
            Section::Other => Ok(()),
            Section::None if tag.code != 0 || Kind::of(tag.value.text(), true) == Kind::Other => Ok(()),
            Section::None => {
                self.mends.count(Mend::NoSection, tag.place);
                self.sections = true;
                self.section = Section::Entities;
                self.tables.scale = scale(self.header)?;
                self.begin(tag)
            }
            Section::Named => {
                self.sections = true;
                self.section = section(tag.value.text());
                if self.section == Section::Entities {
                    self.tables.scale = scale(self.header)?;
                }
                Ok(())
            }
            Section::Header => {
                self.variable(tag);
                Ok(())
            }
            Section::Tables => {
                self.tables.layers.take(tag);
                Ok(())
            }
            Section::Blocks | Section::Entities if tag.code == 0 => self.begin(tag),
            Section::Blocks | Section::Entities => self.group(tag),
        }
    }

    /// The file ends, in the middle of something if it is `cut`.
    pub fn finish(&mut self, cut: bool) -> Result<(), Error> {
        if cut && self.open {
            let place = self.record.place;
            self.record.spoil("the file ends in it".into(), place);
        }
        self.end_section()?;
        self.collection.insert_all(&self.blocks, &self.tables)
    }

    fn end_section(&mut self) -> Result<(), Error> {
        self.finish_entity()?;
        self.finish_block(true);
        self.tables.layers.finish();
        self.entities_done |= self.section == Section::Entities;
        Ok(())
    }

    fn variable(&mut self, tag: Tag) {
        match (tag.code, self.variable.as_slice()) {
            (9, _) => self.variable = tag.value.text().to_vec(),
            (1, b"$ACADVER") => self.version = Some(super::number::name(tag.value.text())),
            (70, b"$INSUNITS") => self.header.insunits = whole(tag.value),
            (70, b"$MEASUREMENT") => self.header.measurement = whole(tag.value),
            _ => {}
        }
    }

    /// An entity begins, or a part of a polyline, or a block.
    fn begin(&mut self, tag: Tag) -> Result<(), Error> {
        let kind = tag.value.text();
        match kind {
            b"VERTEX" if self.in_polyline() => {
                self.part = Part::Vertex;
                self.record.numbers.push((VERTEX, 0.0));
                return Ok(());
            }
            // Without a polyline they end an insert or stand there by accident.
            b"VERTEX" | b"SEQEND" | b"ATTRIB" => {
                if kind == b"VERTEX" {
                    self.mends.count(Mend::StrayVertex, tag.place);
                }
                self.part = Part::None;
                self.finish_entity()?;
                return Ok(());
            }
            _ => {}
        }
        if self.in_polyline() {
            self.mends.count(Mend::NoSeqend, tag.place);
        }
        self.finish_entity()?;
        self.part = Part::None;
        match (self.section, kind) {
            (Section::Blocks, b"BLOCK") => {
                self.finish_block(true);
                self.part = Part::Block;
                self.block = Some((String::new(), Block::default(), tag.place));
            }
            (Section::Blocks, b"ENDBLK") => self.finish_block(false),
            _ => {
                let name = self.tables.names.number(kind);
                let known = Kind::of(kind, self.hatch);
                self.record.begin(known, name, self.tables.layer_0, tag.place);
                self.part = Part::Entity;
                self.open = true;
            }
        }
        Ok(())
    }

    fn in_polyline(&self) -> bool {
        self.open && self.record.kind == Kind::Polyline
    }

    /// A tag of the entity or block at hand.
    fn group(&mut self, tag: Tag) -> Result<(), Error> {
        let taken = match self.part {
            Part::None => return Ok(()),
            Part::Block => {
                self.block_group(tag);
                return Ok(());
            }
            Part::Entity => self.record.take(tag, &mut self.tables.names),
            Part::Vertex => self.record.take_number(tag),
        };
        match taken {
            Taken::Plain => {}
            Taken::MendedNumber => self.mends.count(Mend::Number, tag.place),
            Taken::ForeignName => self.mends.count(Mend::CodePage, tag.place),
        }
        let held = self.record.numbers.len() as u64;
        if held > MAX_NUMBERS {
            let what = "reading one entity (in numbers)";
            return Err(Error::Effort { what, needed: held, limit: MAX_NUMBERS });
        }
        Ok(())
    }

    fn block_group(&mut self, tag: Tag) {
        let Some((name, block, _)) = &mut self.block else { return };
        match tag.code {
            2 => *name = super::number::name(tag.value.text()),
            10 | 20 | 30 => {
                // A base point that is no number is the origin.
                if let Reading::Plain(c) | Reading::Mended(c) = number(tag.value)
                    && c.is_finite()
                {
                    block.base[tag.code as usize / 10 - 1] = c;
                }
            }
            70 => block.external = whole(tag.value).is_some_and(|flags| flags & EXTERNAL != 0),
            _ => {}
        }
    }

    /// The block at hand ends, perhaps without its end mark.
    fn finish_block(&mut self, unmarked: bool) {
        let Some((name, block, place)) = self.block.take() else { return };
        if unmarked {
            self.mends.count(Mend::NoEndblk, place);
        }
        if !self.blocks.add(&name, block) {
            self.mends.count(Mend::DoubleBlock, place);
        }
    }

    fn finish_entity(&mut self) -> Result<(), Error> {
        if !std::mem::take(&mut self.open) {
            return Ok(());
        }
        match (&mut self.block, self.section) {
            (Some((_, block, _)), Section::Blocks) => {
                self.record.numbers.shrink_to_fit();
                block.entities.push(std::mem::take(&mut self.record));
                Ok(())
            }
            (_, Section::Entities) => self.collection.add(&self.record, &self.tables),
            _ => Ok(()),
        }
    }
}

/// Flags of a block whose entities are in another file: references and overlays.
const EXTERNAL: i64 = 4 | 8;

fn section(name: &[u8]) -> Section {
    match name {
        b"HEADER" => Section::Header,
        b"TABLES" => Section::Tables,
        b"BLOCKS" => Section::Blocks,
        b"ENTITIES" => Section::Entities,
        _ => Section::Other,
    }
}
