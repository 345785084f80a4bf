//! From drawn curves to pockets, step by step.
//!
//! **Needs** nothing: any curves will do. **Guarantees** pockets as [`Pocket`] describes them, and
//! a defect for everything of the drawing that is in no pocket. **Does not** guess at contours
//! that cross: their nest is left out.

use super::arrange::arrange;
use super::chain::{Contour, OpenChain, chain};
use super::clean::{clean, is_usable, rough_bounds, some_place};
use super::crossing::Crossings;
use super::duplicate::Seen;
use super::grain::Grain;
use super::nest::Nest;
use super::ray::{Rays, turned};
use super::simple::{has_area, inner_place, is_flat, simple_loops};
use super::{Pocket, Pockets};
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Bounds};
use std::collections::BTreeMap;

/// Pockets of some paths, with their ranks as places in the drawing.
pub(super) fn assemble<'a>(
    paths: impl Iterator<Item = &'a ArcSpline> + Clone,
    join: f64,
    from_depth: usize,
) -> Result<Pockets, Error> {
    if !(join >= 0.0 && join.is_finite()) {
        return Err(Error::Parameter { name: "join", value: join, range: "a length of 0 or more" });
    }
    let usable = paths.clone().filter(|p| is_usable(p));
    let grain = Grain::of(&usable.fold(Bounds::EMPTY, |b, p| b.union(rough_bounds(p))));
    let mut drawing = Drawing { grain, defects: Vec::new(), seen: Seen::new(grain) };
    let (mut contours, open) = drawing.contours(paths, join);
    arrange(&mut contours, grain)?;
    drawing.drop_copies_and_lines(&mut contours);
    let mut crossings = Crossings::of(&contours, grain);
    drawing.defects.append(&mut crossings.defects);
    let (crossing, simple): (Vec<_>, Vec<_>) =
        contours.into_iter().zip(crossings.crosses).partition(|(_, crosses)| *crosses);
    let loops = drawing.loops(simple.into_iter().map(|(contour, _)| contour));
    let nest = Nest::new(&loops, grain);
    let crossing: Vec<ArcSpline> = crossing.into_iter().map(|(c, _)| c.path).collect();
    let left_out = left_out(&loops, &nest, &crossing, from_depth);
    drawing.report_open(&open, &nest, from_depth);
    drawing.defects.extend(drawing.seen.duplicates.take());
    let pockets = pockets(loops, &nest, &left_out, from_depth);
    Ok(Pockets { pockets, defects: drawing.defects })
}

/// What is known of a drawing on the way.
struct Drawing {
    grain: Grain,
    defects: Vec<Defect>,
    seen: Seen,
}

impl Drawing {
    /// Closed contours in the order of the drawing, and what does not close.
    fn contours<'a>(
        &mut self,
        paths: impl Iterator<Item = &'a ArcSpline>,
        join: f64,
    ) -> (Vec<Contour>, Vec<OpenChain>) {
        let (mut contours, mut loose, mut ranks) = (Vec::new(), Vec::new(), Vec::new());
        for (rank, path) in paths.enumerate() {
            if !is_usable(path) {
                self.defects.push(Defect::Coordinate { at: some_place(path) });
                continue;
            }
            let cleaned = clean(path, self.grain);
            if cleaned.is_empty() {
                self.report_point(path);
            } else if self.seen.is_new(&cleaned) {
                if cleaned.closed {
                    contours.push(Contour { path: cleaned, rank });
                } else {
                    loose.push(cleaned);
                    ranks.push(rank);
                }
            }
        }
        let (chained, open) = chain(&loose, &ranks, join, self.grain);
        for contour in chained {
            let path = clean(&contour.path, self.grain);
            if path.is_empty() {
                self.report_point(&contour.path);
            } else if self.seen.is_new(&path) {
                contours.push(Contour { path, ..contour });
            }
        }
        contours.sort_by_key(|c| c.rank);
        (contours, open)
    }

    /// A closed path without length is a fault; an open one is nothing.
    fn report_point(&mut self, path: &ArcSpline) {
        if path.closed && !path.vertices.is_empty() {
            self.defects.push(Defect::NoArea { at: some_place(path) });
        }
    }

    /// Once contours share their vertices, copies of contours drawn with others are equal too.
    fn drop_copies_and_lines(&mut self, contours: &mut Vec<Contour>) {
        let mut seen = Seen::new(self.grain);
        seen.duplicates = self.seen.duplicates.take();
        contours.retain(|c| {
            if is_flat(&c.path, self.grain) {
                self.defects.extend(c.path.vertices.first().map(|v| Defect::NoArea { at: v.point }));
                return false;
            }
            seen.is_new(&c.path)
        });
        self.seen = seen;
    }

    /// Simple loops, counter-clockwise.
    fn loops(&mut self, contours: impl Iterator<Item = Contour>) -> Vec<ArcSpline> {
        let mut loops = Vec::new();
        for path in contours.flat_map(|c| simple_loops(&c.path)) {
            if !has_area(&path, self.grain) {
                self.defects.extend(path.vertices.first().map(|v| Defect::NoArea { at: v.point }));
            } else {
                loops.push(if path.area() < 0.0 { path.reversed() } else { path });
            }
        }
        loops
    }

    fn report_open(&mut self, open: &[OpenChain], nest: &Nest, from_depth: usize) {
        let is_pocket = |depth: usize| depth >= from_depth && (depth - from_depth).is_multiple_of(2);
        self.defects.extend(open.iter().map(|chain| {
            let around = nest.around(chain.middle);
            chain.defect(around.is_some_and(|i| is_pocket(nest.depth[i])))
        }));
    }
}

/// For each loop whether it is in a nest with contours that cross. Nests begin where pockets do: a
/// crossing in the outline of a part does no harm to the pockets in it.
fn left_out(loops: &[ArcSpline], nest: &Nest, crossing: &[ArcSpline], from_depth: usize) -> Vec<bool> {
    let outermost = outermost(nest, from_depth);
    let mut out = vec![false; loops.len()];
    if crossing.is_empty() {
        return out;
    }
    for path in crossing {
        if let Some(i) = nest.around(inner_place(path)) {
            out[outermost[i]] = true;
        }
    }
    let rays = Rays::new(crossing.iter().enumerate());
    for (i, path) in loops.iter().enumerate() {
        if outermost[i] == i && !out[i] {
            let mut windings: BTreeMap<usize, i32> = BTreeMap::new();
            rays.all(turned(inner_place(path)), |hit| {
                *windings.entry(hit.owner).or_default() += if hit.from_left { 1 } else { -1 };
            });
            out[i] = windings.values().any(|&w| w != 0);
        }
    }
    outermost.into_iter().map(|i| out[i]).collect()
}

/// For each loop the outermost one around it that may be a pocket.
fn outermost(nest: &Nest, from_depth: usize) -> Vec<usize> {
    let mut by_depth: Vec<usize> = (0..nest.depth.len()).collect();
    by_depth.sort_by_key(|&i| nest.depth[i]);
    let mut outermost: Vec<usize> = (0..by_depth.len()).collect();
    for i in by_depth {
        let parent = nest.parent(i).filter(|&p| nest.depth[p] >= from_depth);
        outermost[i] = parent.map_or(i, |p| outermost[p]);
    }
    outermost
}

fn pockets(loops: Vec<ArcSpline>, nest: &Nest, left_out: &[bool], from_depth: usize) -> Vec<Pocket> {
    let begins = |i: usize| {
        let depth = nest.depth[i];
        depth >= from_depth && (depth - from_depth).is_multiple_of(2) && !left_out[i]
    };
    let mut islands: Vec<Vec<ArcSpline>> = vec![Vec::new(); loops.len()];
    for (i, path) in loops.iter().enumerate() {
        if let Some(parent) = nest.parent(i).filter(|&p| begins(p)) {
            islands[parent].push(path.reversed());
        }
    }
    let all = loops.into_iter().zip(islands).enumerate();
    all.filter(|(i, _)| begins(*i))
        .map(|(_, (outer, islands))| Pocket::from_checked(outer, islands))
        .collect()
}
