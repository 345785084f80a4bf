//! Blocks and their inserts.

use super::collect::{Collection, Context, Tables, place_of};
use super::inventory::Fate;
use super::names::{Name, Names};
use super::placement::Placement;
use super::record::{Kind, Numbers, Record};
use super::shape::{Skip, normal};
use crate::error::Error;
use std::collections::HashMap;

/// As many entities may come out of blocks: a drawing of more has blocks that multiply.
const MAX_ENTITIES: u64 = 1_000_000;

/// A block with what it holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub base: [f64; 3],
    /// Whether its entities are in another file.
    pub external: bool,
    pub entities: Vec<Record>,
}

/// All blocks, by name in lower case.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    numbers: HashMap<String, usize>,
    blocks: Vec<Block>,
}

impl Blocks {
    /// Adds a block; `false` if there is one of that name.
    pub fn add(&mut self, name: &str, block: Block) -> bool {
        let number = self.blocks.len();
        let is_new = !self.numbers.contains_key(&name.to_lowercase());
        if is_new {
            self.numbers.insert(name.to_lowercase(), number);
            self.blocks.push(block);
        }
        is_new
    }

    fn find(&self, name: Name, names: &Names) -> Option<usize> {
        self.numbers.get(&names.text(name).to_lowercase()).copied()
    }
}

/// How much came out of blocks so far.
#[derive(Default)]
pub(super) struct Effort(u64);

impl Effort {
    fn spend(&mut self, count: u64) -> Result<(), Error> {
        self.0 = self.0.saturating_add(count);
        if self.0 > MAX_ENTITIES {
            let what = "expanding blocks (in entities)";
            return Err(Error::Effort { what, needed: self.0, limit: MAX_ENTITIES });
        }
        Ok(())
    }
}

/// A block that is being walked through, once for each cell of an array.
struct Visit<'a> {
    block: usize,
    array: Array,
    cell: u64,
    /// The entity that comes next.
    next: usize,
    /// What the insert lies in.
    outer: Context,
    inner: Context,
    entities: &'a [Record],
}

/// The rows and columns of an insert.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Array {
    /// Of the first cell.
    placement: Placement,
    columns: u64,
    rows: u64,
    /// From column to column, from row to row, in the plane of the insert.
    steps: [[f64; 3]; 2],
}

/// Draws everything that an insert of the model space puts in place.
pub(super) fn expand(
    insert: &Record,
    collection: &mut Collection,
    blocks: &Blocks,
    tables: &Tables,
    effort: &mut Effort,
) -> Result<(), Error> {
    let mut inside = vec![false; blocks.blocks.len()];
    let mut visits = Vec::new();
    visits.extend(enter(insert, &Context::ROOT, collection, (blocks, tables), &inside));
    while let Some(visit) = visits.last_mut() {
        if visit.next == 0 {
            effort.spend(1)?;
        }
        if visit.next == 0 && visit.cell == 0 {
            // An array is refused before it is begun.
            effort.spend(visit.array.cells().saturating_mul(visit.entities.len() as u64))?;
            inside[visit.block] = true;
        }
        let Some(entity) = visit.entities.get(visit.next) else {
            if !visit.advance() {
                inside[visit.block] = false;
                visits.pop();
            }
            continue;
        };
        visit.next += 1;
        let context = visit.inner;
        if entity.kind == Kind::Insert {
            visits.extend(enter(entity, &context, collection, (blocks, tables), &inside));
        } else {
            collection.draw(entity, &context, tables)?;
        }
    }
    Ok(())
}

/// Begins to walk through the block of an insert, unless there is a reason not to.
fn enter<'a>(
    insert: &Record,
    outer: &Context,
    collection: &mut Collection,
    (blocks, tables): (&'a Blocks, &Tables),
    inside: &[bool],
) -> Option<Visit<'a>> {
    let its = Collection::trait_of(insert, outer, tables);
    let kind = insert.kind_name;
    if let Err(fate) = collection.selection.enters(its, &tables.layers, &tables.names) {
        collection.tally.count(its.layer, kind, fate);
        return None;
    }
    match array_of(insert, blocks, &tables.names, inside) {
        Ok((block, array)) => {
            collection.tally.count(its.layer, kind, Fate::Read);
            let inner = Context { placement: array.cell(0, outer), layer: Some(its.layer), color: its.color };
            let entities = &blocks.blocks[block].entities;
            Some(Visit { block, array, cell: 0, next: 0, outer: *outer, inner, entities })
        }
        Err(reason) => {
            let at = place_of(insert, outer, tables.scale);
            collection.tally.count(its.layer, kind, Fate::Broken);
            collection.skipped.fault(tables.names.text(kind), insert, &reason, at);
            None
        }
    }
}

/// The block of an insert and where it comes to lie, or why it does not.
fn array_of(
    insert: &Record,
    blocks: &Blocks,
    names: &Names,
    inside: &[bool],
) -> Result<(usize, Array), String> {
    if let Some(fault) = &insert.fault {
        return Err(fault.to_string());
    }
    let name = insert.block.ok_or("it names no block")?;
    let text = names.text(name);
    let block = blocks.find(name, names).ok_or_else(|| format!("there is no block `{text}`"))?;
    if inside[block] {
        return Err(format!("block `{text}` holds itself"));
    }
    if blocks.blocks[block].external {
        return Err(format!("block `{text}` is in another file; bind it in the drawing program"));
    }
    let array = Array::new(insert.numbers(), blocks.blocks[block].base).map_err(|skip| match skip {
        Skip::Fault(reason) => reason,
        Skip::NotRead(form) => form.to_owned(),
    })?;
    Ok((block, array))
}

impl Array {
    fn new(numbers: Numbers, base: [f64; 3]) -> Result<Array, Skip> {
        let scale = [41, 42, 43].map(|code| numbers.or(code, 1.0));
        if scale[0] == 0.0 || scale[1] == 0.0 {
            return Skip::fault("its scale is 0");
        }
        let degrees = numbers.or(50, 0.0);
        let system = Placement::of_normal(normal(numbers))?;
        let at = numbers.place(10)?;
        let turned = Placement::turned(scale, degrees);
        // What is read is moved to the base point first.
        let back = turned.vector(base).map(|c| -c);
        let plain = Placement::turned([1.0; 3], degrees);
        let count = |code: u16| numbers.or(code, 1.0).max(1.0) as u64;
        let step = |v: [f64; 3]| system.vector(plain.vector(v));
        Ok(Array {
            placement: system.around(&turned.moved(back).moved(at)),
            columns: count(70),
            rows: count(71),
            steps: [step([numbers.or(44, 0.0), 0.0, 0.0]), step([0.0, numbers.or(45, 0.0), 0.0])],
        })
    }

    fn cells(&self) -> u64 {
        self.columns.saturating_mul(self.rows)
    }

    /// Where a cell comes to lie.
    fn cell(&self, cell: u64, outer: &Context) -> Placement {
        let (column, row) = ((cell % self.columns) as f64, (cell / self.columns) as f64);
        let by = |i: usize| self.steps[0][i] * column + self.steps[1][i] * row;
        outer.placement.around(&self.placement.moved([by(0), by(1), by(2)]))
    }
}

impl Visit<'_> {
    /// Goes on to the next cell, if there is one.
    fn advance(&mut self) -> bool {
        self.cell += 1;
        self.next = 0;
        if self.cell == self.array.cells() || self.entities.is_empty() {
            return false;
        }
        self.inner.placement = self.array.cell(self.cell, &self.outer);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(numbers: &[(u16, f64)]) -> Array {
        Array::new(Numbers(numbers), [1.0, 2.0, 0.0]).unwrap()
    }

    #[test]
    fn a_base_point_comes_to_lie_at_the_insert() {
        let numbers = [(10, 10.0), (20, 20.0), (41, 2.0), (42, -3.0), (50, 90.0)];
        let placement = array(&numbers).cell(0, &Context::ROOT);
        assert_eq!(placement.point([1.0, 2.0, 0.0]), [10.0, 20.0, 0.0]);
        assert_eq!(placement.point([2.0, 2.0, 0.0]), [10.0, 22.0, 0.0]);
        assert_eq!(placement.point([1.0, 3.0, 0.0]), [13.0, 20.0, 0.0]);
    }

    #[test]
    fn cells_of_an_array_turn_with_it_but_do_not_grow() {
        let numbers = [(10, 0.0), (20, 0.0), (41, 5.0), (42, 5.0), (50, 90.0)];
        let array = array(&[&numbers[..], &[(70, 3.0), (71, 2.0), (44, 10.0), (45, 20.0)]].concat());
        assert_eq!(array.cells(), 6);
        assert_eq!(array.cell(5, &Context::ROOT).point([1.0, 2.0, 0.0]), [-20.0, 20.0, 0.0]);
    }

    #[test]
    fn counts_below_one_are_one_and_no_scale_may_be_0() {
        let numbers = [(10, 0.0), (20, 0.0), (70, -3.0), (71, 0.0)];
        assert_eq!(array(&numbers).cells(), 1);
        assert!(Array::new(Numbers(&[(10, 0.0), (20, 0.0), (41, 0.0)]), [0.0; 3]).is_err());
    }
}
