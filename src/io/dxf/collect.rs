//! From records to the curves of the part.
//!
//! **Needs** the entities of the model space in their order, then the blocks. **Guarantees**
//! every curve that takes part, once for each place where blocks put it, and a count of everything
//! else. **Does not** hold more than the curves and the inserts.
//!
//! **Method.** Curves are made as entities come; inserts wait until all blocks are known and are
//! walked through with a stack of our own, so that nests may be of any depth. A block that is met
//! inside itself is not entered again.

use super::ReadOptions;
use super::insert::{Blocks, Effort, expand};
use super::inventory::{Fate, Tally};
use super::layers::Layers;
use super::names::{Name, Names};
use super::placement::{Placement, in_job};
use super::record::{BY_BLOCK, BY_LAYER, Kind, Record, VERTEX};
use super::select::{Selection, Trait};
use super::shape::{Drawn, Shape, Skip, Stage, draw, is_usable, normal};
use super::skipped::Skipped;
use crate::boundary::{Curve, FreeCurve, FreeShape, Source};
use crate::error::Error;
use crate::geom::{Point, point};
use crate::io::{Place, Scale};

/// As many vertices of curves are held in memory: about a gigabyte.
const MAX_VERTICES: u64 = 20_000_000;

/// Where a block puts what it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Context {
    pub placement: Placement,
    /// Layer of what lies on layer 0 in the block.
    pub layer: Option<Name>,
    /// Color of what has the color of its block.
    pub color: i16,
}

impl Context {
    /// Of what lies in no block.
    pub const ROOT: Context = Context { placement: Placement::ROOT, layer: None, color: 7 };
}

/// What is known of all entities.
pub(super) struct Tables {
    pub layers: Layers,
    pub names: Names,
    pub scale: Scale,
    /// The name of layer 0.
    pub layer_0: Name,
}

impl Default for Tables {
    fn default() -> Tables {
        let mut names = Names::default();
        let layer_0 = names.number(b"0");
        Tables { layers: Layers::default(), names, scale: Scale::SAME, layer_0 }
    }
}

/// The curves so far.
pub(super) struct Collection<'a> {
    pub curves: Vec<Curve>,
    pub free: Vec<FreeCurve>,
    pub selection: Selection<'a>,
    pub skipped: Skipped,
    pub tally: Tally,
    /// How many polylines have another number of vertices than they say, and the first of them.
    pub miscounted: Option<(usize, Place)>,
    inserts: Vec<Record>,
    vertices: u64,
    drawn: Drawn,
}

impl<'a> Collection<'a> {
    pub fn new(options: &'a ReadOptions) -> Collection<'a> {
        Collection {
            curves: Vec::new(),
            free: Vec::new(),
            selection: Selection::new(options),
            skipped: Skipped::default(),
            tally: Tally::default(),
            miscounted: None,
            inserts: Vec::new(),
            vertices: 0,
            drawn: Drawn::default(),
        }
    }

    /// Takes an entity of the model space; an insert waits for the blocks.
    pub fn add(&mut self, record: &Record, tables: &Tables) -> Result<(), Error> {
        if record.kind == Kind::Insert {
            self.inserts.push(record.clone());
            return Ok(());
        }
        self.draw(record, &Context::ROOT, tables)
    }

    /// Draws what all inserts put in place.
    pub fn insert_all(&mut self, blocks: &Blocks, tables: &Tables) -> Result<(), Error> {
        let mut effort = Effort::default();
        for insert in std::mem::take(&mut self.inserts) {
            expand(&insert, self, blocks, tables, &mut effort)?;
        }
        Ok(())
    }

    /// The layer and the color that an entity has in its place.
    pub fn trait_of(record: &Record, context: &Context, tables: &Tables) -> Trait {
        let layer = context.layer.filter(|_| record.layer == tables.layer_0).unwrap_or(record.layer);
        let color = match record.color {
            BY_BLOCK => context.color,
            BY_LAYER => tables.layers.get(tables.names.text(layer)).color,
            color => color,
        };
        Trait { layer, color, paper: record.paper, invisible: record.invisible }
    }

    /// Draws one entity that is no insert.
    pub fn draw(&mut self, record: &Record, context: &Context, tables: &Tables) -> Result<(), Error> {
        let its = Self::trait_of(record, context, tables);
        let fate = match self.selection.takes(its, &tables.layers, &tables.names) {
            Ok(()) => self.draw_selected(record, its, context, tables),
            Err(fate) => fate,
        };
        self.tally.count(its.layer, record.kind_name, fate);
        if self.vertices > MAX_VERTICES {
            let what = "holding the drawing in memory (in vertices)";
            return Err(Error::Effort { what, needed: self.vertices, limit: MAX_VERTICES });
        }
        Ok(())
    }

    fn draw_selected(&mut self, record: &Record, its: Trait, context: &Context, tables: &Tables) -> Fate {
        let (kind, layer) = (tables.names.text(record.kind_name), tables.names.text(its.layer));
        if record.kind == Kind::Other {
            self.skipped.kind(kind, layer);
            return Fate::NotRead;
        }
        let place = || place_of(record, context, tables.scale);
        if let Some(fault) = &record.fault {
            self.skipped.fault(kind, record, fault, place());
            return Fate::Broken;
        }
        let mut drawn = std::mem::take(&mut self.drawn);
        let fate =
            match draw(record, Stage { placement: &context.placement, scale: tables.scale }, &mut drawn) {
                Err(Skip::NotRead(form)) => {
                    self.skipped.form(form, layer);
                    Fate::NotRead
                }
                Err(Skip::Fault(reason)) => {
                    self.skipped.fault(kind, record, &reason, place());
                    Fate::Broken
                }
                Ok(()) => {
                    self.note(kind, record, &drawn, place);
                    let source = Source { kind: kind.clone(), handle: record.handle, layer: layer.clone() };
                    let is_free = drawn.shapes.iter().any(|shape| matches!(shape, Shape::Free(_)));
                    drawn.shapes.drain(..).for_each(|shape| self.keep(shape, &source));
                    if is_free { Fate::Free } else { Fate::Read }
                }
            };
        self.drawn = drawn;
        fate
    }

    fn note(&mut self, kind: &str, record: &Record, drawn: &Drawn, place: impl Fn() -> Option<Point>) {
        for (noted, how) in [
            (drawn.raised, "its height or thickness is ignored"),
            (drawn.tilted, "it is tilted and seen from above"),
            (drawn.wide, "its width is ignored, its center line counts"),
        ] {
            if noted {
                self.skipped.simplified(kind, record, how, place());
            }
        }
        if drawn.miscounted {
            self.miscounted.get_or_insert((0, record.place)).0 += 1;
        }
    }

    fn keep(&mut self, shape: Shape, source: &Source) {
        let source = source.clone();
        match shape {
            Shape::Path(path) => {
                self.vertices += path.vertices.len() as u64;
                self.curves.push(Curve { path, source });
            }
            Shape::Free(shape) => {
                self.vertices += match &shape {
                    FreeShape::Ellipse(_) => 2,
                    FreeShape::Spline(spline) => (spline.control.len() + spline.fit.len()) as u64,
                };
                self.free.push(FreeCurve { shape, source });
            }
        }
    }
}

/// A place of an entity, as near to it as it can be told.
pub(super) fn place_of(record: &Record, context: &Context, scale: Scale) -> Option<Point> {
    let mut numbers = &record.numbers[..];
    if record.kind == Kind::Polyline {
        let (_, mut vertices) = record.numbers().split(VERTEX);
        numbers = vertices.next()?.0;
    }
    let place = numbers.windows(2).find_map(|pair| match pair {
        [(10, x), (20, y)] => Some([*x, *y, 0.0]),
        _ => None,
    })?;
    let own = Placement::of_normal(normal(record.numbers())).unwrap_or(Placement::ROOT);
    let in_world = matches!(record.kind, Kind::Line | Kind::Ellipse | Kind::Spline);
    let [x, y, _] = context.placement.point(if in_world { place } else { own.point(place) });
    Some(in_job(point(x, y), scale)).filter(|p| is_usable(*p))
}
