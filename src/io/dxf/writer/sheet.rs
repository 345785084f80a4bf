//! A drawing to write, layer by layer.

use super::entity::Entity;
use super::layer::Layer;
use super::pen::Pen;
use super::skeleton::{self, FIRST_ENTITY, Head};
use super::strokes::strokes;
use crate::boundary::Pocket;
use crate::geom::Bounds;
use crate::mat::AxisEdge;
use crate::offset::Level;
use crate::tolerance::Units;
use crate::toolpath::Moves;
use std::io::{self, Write};

/// A drawing to write. Everything is optional: boundaries (layer `BOUNDARY`), axes (`MEDIAL_AXIS`),
/// level sets (`OFFSETS`) at height 0, and tool paths (`TOOLPATH` for cuts at their heights,
/// `TOOLPATH_ENTRY` for ways down, `TOOLPATH_RAPID`).
///
/// ```
/// use medial::io::dxf::{self, ReadOptions, Sheet};
/// use medial::{ArcSpline, Pocket, Tolerance, Units, point};
///
/// let hole = Pocket::from_loops(vec![ArcSpline::circle(point(0.1, 0.2), 0.3)], Tolerance::MM)?;
/// let mut text = Vec::new();
/// Sheet::new(Units::Mm).pockets([&hole]).write(&mut text).expect("memory takes it");
/// let back = dxf::read_bytes(&text, "hole.dxf", &ReadOptions::default())?;
/// assert_eq!(&back.curves[0].path, hole.outer());
/// # Ok::<(), medial::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Sheet<'a> {
    units: Units,
    pockets: Vec<&'a Pocket>,
    axes: Vec<&'a AxisEdge>,
    levels: Vec<&'a Level>,
    paths: Vec<(&'a Moves, f64)>,
}

impl<'a> Sheet<'a> {
    /// An empty sheet in this unit.
    pub fn new(units: Units) -> Sheet<'a> {
        Sheet { units, ..Sheet::default() }
    }

    /// Outlines of pockets and islands.
    pub fn pockets(mut self, pockets: impl IntoIterator<Item = &'a Pocket>) -> Self {
        self.pockets.extend(pockets);
        self
    }

    /// Edges of a medial axis.
    pub fn axis(mut self, edges: impl IntoIterator<Item = &'a AxisEdge>) -> Self {
        self.axes.extend(edges);
        self
    }

    /// Level sets.
    pub fn levels(mut self, levels: impl IntoIterator<Item = &'a Level>) -> Self {
        self.levels.extend(levels);
        self
    }

    /// A tool path. Helices become chords that lie within `tolerance`, a length, of them.
    pub fn path(mut self, moves: &'a Moves, tolerance: f64) -> Self {
        self.paths.push((moves, tolerance));
        self
    }

    /// Writes the drawing as text; best to something that collects small pieces.
    ///
    /// # Errors
    /// What `out` answers, and [`io::ErrorKind::InvalidInput`] if a number is not finite.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let head = self.head();
        let mut pen = Pen::new(out, FIRST_ENTITY);
        skeleton::before(&mut pen, &head)?;
        self.entities().try_for_each(|e| e.write(&mut pen))?;
        skeleton::after(&mut pen)?;
        out.flush()
    }

    /// The entities in the order of the file.
    fn entities(&self) -> impl Iterator<Item = Entity<'_>> {
        let loops = self.pockets.iter().flat_map(|p| p.loops());
        let boundary = loops.map(|l| Entity::flat(Layer::Boundary, l));
        let axes = self.axes.iter().map(|e| Entity::axis(e));
        let levels = self.levels.iter().flat_map(|l| l.loops.iter().chain(&l.ridges));
        let offsets = levels.map(|s| Entity::flat(Layer::Offsets, s));
        let paths = self.paths.iter().flat_map(|(moves, tolerance)| strokes(moves, *tolerance));
        boundary.chain(axes).chain(offsets).chain(paths).filter(Entity::is_drawn)
    }

    /// What stands before the entities and depends on them.
    fn head(&self) -> Head {
        let mut head = Head {
            units: self.units,
            bounds: Bounds::EMPTY,
            heights: [f64::INFINITY, f64::NEG_INFINITY],
            next_handle: FIRST_ENTITY,
        };
        for entity in self.entities() {
            let (bounds, heights) = entity.extents();
            head.bounds = head.bounds.union(bounds);
            head.heights = [head.heights[0].min(heights[0]), head.heights[1].max(heights[1])];
            head.next_handle += entity.handles();
        }
        head
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};
    use crate::toolpath::Move;
    use crate::toolpath::Point3;

    fn tags(sheet: &Sheet) -> Vec<String> {
        let mut out = Vec::new();
        sheet.write(&mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len() % 2, 0);
        lines.chunks(2).map(|tag| tag.join(" ")).collect()
    }

    fn after<'a>(tags: &'a [String], name: &str) -> &'a [String] {
        &tags[1 + tags.iter().position(|t| t == name).unwrap()..]
    }

    #[test]
    fn the_head_tells_unit_and_extents() {
        let hole = Pocket::from_checked(ArcSpline::circle(point(3.0, 4.0), 2.0), vec![]);
        let to = |z| Point3 { x: 3.0, y: 4.0, z };
        let moves = [Move::Rapid { to: to(5.0) }, Move::Feed { to: to(-1.0), rate: 1.0 }].into();
        let sheet = Sheet::new(Units::Inch).pockets([&hole]).path(&moves, 0.01);
        let tags = tags(&sheet);
        assert_eq!(after(&tags, "9 $INSUNITS")[0], "70 1");
        assert_eq!(after(&tags, "9 $MEASUREMENT")[0], "70 0");
        assert_eq!(after(&tags, "9 $EXTMIN")[..3], ["10 1.0", "20 2.0", "30 -1.0"]);
        assert_eq!(after(&tags, "9 $EXTMAX")[..3], ["10 5.0", "20 6.0", "30 5.0"]);
    }

    #[test]
    fn the_seed_is_above_every_handle_and_no_handle_is_used_twice() {
        let places = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]].map(Point3::from);
        let moves: Moves = places.into_iter().map(|to| Move::Rapid { to }).collect();
        let hole = Pocket::from_checked(ArcSpline::circle(point(3.0, 4.0), 2.0), vec![]);
        let tags = tags(&Sheet::new(Units::Mm).pockets([&hole]).path(&moves, 0.01));
        let hex = |t: &String| u64::from_str_radix(t.split(' ').nth(1).unwrap(), 16).unwrap();
        let seed = hex(&after(&tags, "9 $HANDSEED")[0]);
        let body = after(&tags, "2 TABLES");
        let mut handles: Vec<u64> =
            body.iter().filter(|t| t.starts_with("5 ") || t.starts_with("105 ")).map(hex).collect();
        handles.sort_unstable();
        assert_eq!(handles.last(), Some(&(seed - 1)));
        let count = handles.len();
        handles.dedup();
        assert_eq!(handles.len(), count);
    }

    #[test]
    fn an_empty_sheet_is_a_drawing() {
        let tags = tags(&Sheet::new(Units::Mm));
        assert_eq!(tags.last().unwrap(), "0 EOF");
        assert_eq!(after(&tags, "9 $EXTMIN")[0], "10 1.0e20");
    }
}
