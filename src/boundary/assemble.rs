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
use super::faces::Faces;
use super::gather::{all_ends_meet, gather};
use super::grain::Grain;
use super::loose::dividers;
use super::overlap::unite_courses;
use super::pieces::{Loop, Pieces};
use super::regions::{Nests, pockets};
use super::simple::{cut_small_loops, has_area, is_flat, simple_loops};
use super::tee::{Loose, attach};
use super::{Pocket, Pockets};
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Bounds, Point};

/// Rounds of mending: limit on effort. Each one mends what the one before has uncovered.
const HEALINGS: usize = 4;

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
    let mut drawing = Drawing { grain, join, ..Drawing::default() };
    let (contours, open) = drawing.contours(paths);
    let (lines, rest) = dividers(open, &contours, join, grain);
    let mut arranged = drawing.arranged(contours, lines, rest)?;
    let pockets = drawing.pockets(&mut arranged, from_depth);
    drawing.report();
    Ok(Pockets { pockets, defects: drawing.defects })
}

/// What is known of a drawing on the way.
#[derive(Default)]
struct Drawing {
    grain: Grain,
    join: f64,
    defects: Vec<Defect>,
    /// How many curves are copies of others, and where one of them is.
    copies: Option<(usize, Point)>,
    /// How many stretches lie on others, and where one of them does.
    overlaps: Option<(usize, Point)>,
    /// How many crossings were mended, and where one of them was.
    healed: Option<(usize, Point)>,
}

/// A drawing whose curves have common vertices where they meet.
struct Arranged {
    loops: Vec<Loop>,
    /// Whether loops touch at most, and nothing divides them.
    is_plain: bool,
    /// Contours that cross.
    crossing: Vec<ArcSpline>,
    /// Open curves that may divide contours.
    dividers: Vec<ArcSpline>,
    /// Open curves that may not.
    rest: Vec<ArcSpline>,
}

impl Drawing {
    /// Closed contours in the order of the drawing, and what does not close.
    fn contours<'a>(&mut self, paths: impl Iterator<Item = &'a ArcSpline>) -> (Vec<Contour>, Vec<OpenChain>) {
        let (mut contours, mut loose): (Vec<Contour>, _) = (Vec::new(), Loose::default());
        let mut seen = Seen::new(self.grain, self.join);
        let mut seen_open = Seen::new(self.grain, self.join);
        for (rank, path) in paths.enumerate() {
            if !is_usable(path) {
                self.defects.push(Defect::Coordinate { at: some_place(path) });
                continue;
            }
            let cleaned = clean(path, self.grain);
            if cleaned.is_empty() {
                self.report_point(path);
            } else if cleaned.closed {
                if seen.is_new(&cleaned, |i| &contours[i].path) {
                    contours.push(Contour { path: cleaned, rank, loose: false });
                }
            } else if seen_open.is_new(&cleaned, |i| &loose.paths[i]) {
                loose.paths.push(cleaned);
                loose.ranks.push(rank);
            }
        }
        add(&mut self.copies, seen_open.copies);
        drop(seen_open);
        let loose = self.attached(loose, &contours);
        let (chained, open) = chain(&loose.paths, &loose.ranks, self.join, self.grain);
        drop(loose);
        for contour in chained {
            let path = clean(&contour.path, self.grain);
            if path.is_empty() || self.is_thin(&path) {
                self.report_point(&contour.path);
            } else if seen.is_new(&path, |i| &contours[i].path) {
                contours.push(Contour { path, ..contour });
            }
        }
        add(&mut self.copies, seen.copies);
        contours.sort_by_key(|c| c.rank);
        (contours, open)
    }

    /// Whether loose curves lie over one another within the gap that is joined: what is between them was no
    /// island to who drew them, but the tool would go around it.
    fn is_thin(&self, path: &ArcSpline) -> bool {
        2.0 * path.area().abs() <= self.join * path.length()
    }

    /// Open curves whose ends lie on the curves that they end on.
    fn attached(&mut self, loose: Loose, contours: &[Contour]) -> Loose {
        if all_ends_meet(&loose.paths) {
            return loose;
        }
        let mut loose = loose;
        gather(&mut loose.paths, self.join, self.grain);
        let count = loose.paths.len();
        let attached = attach(loose, contours, self.join, self.grain);
        if attached.paths.len() == count {
            return attached;
        }
        let mut seen = Seen::new(self.grain, self.join);
        let mut found = Loose::default();
        for (path, rank) in attached.paths.iter().zip(attached.ranks) {
            let path = clean(path, self.grain);
            if !path.is_empty() && seen.is_new(&path, |i| &found.paths[i]) {
                found.paths.push(path);
                found.ranks.push(rank);
            }
        }
        add(&mut self.overlaps, seen.copies);
        found
    }

    /// A closed path without length is a fault; an open one is nothing.
    fn report_point(&mut self, path: &ArcSpline) {
        if path.closed && !path.vertices.is_empty() {
            self.defects.push(Defect::NoArea { at: some_place(path) });
        }
    }

    /// Loops and open curves with common vertices; contours that cross apart.
    fn arranged(
        &mut self,
        contours: Vec<Contour>,
        lines: Vec<ArcSpline>,
        mut rest: Vec<ArcSpline>,
    ) -> Result<Arranged, Error> {
        let mut curves = contours;
        if lines.is_empty() {
            arrange(&mut curves, self.grain)?;
        } else {
            let contours = curves.clone();
            let open = lines.iter().cloned().map(|path| Contour { path, rank: usize::MAX, loose: true });
            curves.extend(open);
            if arrange(&mut curves, self.grain).is_err() {
                // Without the open curves it may be less.
                curves = contours;
                arrange(&mut curves, self.grain)?;
                rest.extend(lines);
            }
        }
        curves.retain(|c| c.path.closed || !c.path.is_empty());
        let (curves, mut crossings) = self.healed(curves);
        self.defects.append(&mut crossings.defects);
        let (mut crossing, mut simple, mut dividers) = (Vec::new(), Vec::new(), Vec::new());
        for (curve, crosses) in curves.into_iter().zip(crossings.crosses) {
            match (curve.path.closed, crosses) {
                (true, true) => crossing.push(curve.path),
                (true, false) => simple.push(curve),
                (false, true) => rest.push(curve.path),
                (false, false) => dividers.push(curve.path),
            }
        }
        let is_plain = dividers.is_empty() && !crossings.are_any_along;
        Ok(Arranged { loops: self.loops(simple), is_plain, crossing, dividers, rest })
    }

    /// Curves without copies and small crossings, and what still crosses.
    fn healed(&mut self, curves: Vec<Contour>) -> (Vec<Contour>, Crossings) {
        let mut curves = self.without_copies_and_lines(curves);
        let mut crossings = Crossings::of(&curves, self.grain);
        for _ in 0..HEALINGS {
            if !self.heal(&mut curves, &crossings) {
                break;
            }
            curves = self.without_copies_and_lines(curves);
            crossings = Crossings::of(&curves, self.grain);
        }
        (curves, crossings)
    }

    /// Once contours share their vertices, copies of contours drawn with others are equal too.
    fn without_copies_and_lines(&mut self, curves: Vec<Contour>) -> Vec<Contour> {
        let mut seen = Seen::new(self.grain, 0.0);
        let (mut kept, mut open): (Vec<Contour>, Vec<Contour>) = (Vec::new(), Vec::new());
        for curve in curves {
            if !curve.path.closed {
                open.push(curve);
            } else if is_flat(&curve.path, self.grain) {
                self.defects.extend(curve.path.vertices.first().map(|v| Defect::NoArea { at: v.point }));
            } else if seen.is_new(&curve.path, |i| &kept[i].path) {
                kept.push(curve);
            }
        }
        add(&mut self.copies, seen.copies);
        kept.append(&mut open);
        kept
    }

    /// Mends crossings smaller than the reach: cuts loops off contours that cross themselves, and makes
    /// contours that overlap end on each other. Answers whether there was one.
    fn heal(&mut self, curves: &mut [Contour], crossings: &Crossings) -> bool {
        let mut places = Vec::new();
        for (&curve, crossed) in &crossings.own {
            let path = &mut curves[curve].path;
            if path.closed {
                places.extend(cut_small_loops(path, crossed, self.join));
            }
        }
        let pairs: Vec<(usize, usize)> = crossings.pairs.iter().copied().collect();
        places.extend(unite_courses(curves, &pairs, self.join));
        add(&mut self.healed, places.first().map(|&at| (places.len(), at)));
        !places.is_empty()
    }

    /// Simple loops, counter-clockwise.
    fn loops(&mut self, contours: Vec<Contour>) -> Vec<Loop> {
        let mut loops = Vec::new();
        let mut is_cut = false;
        for contour in contours {
            let simple = simple_loops(contour.path);
            let count = simple.len();
            is_cut |= count > 1;
            for path in simple {
                if has_area(&path, self.grain) {
                    let path = if path.area() < 0.0 { path.reversed() } else { path };
                    loops.push(Loop { path, loose: contour.loose });
                } else if let Some(v) = path.vertices.first() {
                    // A way there and back between other loops of a contour is a bridge.
                    if count > 1 && is_flat(&path, self.grain) {
                        add(&mut self.overlaps, Some((1, v.point)));
                    } else {
                        self.defects.push(Defect::NoArea { at: v.point });
                    }
                }
            }
        }
        if is_cut {
            let mut seen = Seen::new(self.grain, 0.0);
            let mut kept: Vec<Loop> = Vec::with_capacity(loops.len());
            for one in loops {
                if seen.is_new(&one.path, |i| &kept[i].path) {
                    kept.push(one);
                }
            }
            add(&mut self.overlaps, seen.copies);
            return kept;
        }
        loops
    }

    fn pockets(&mut self, arranged: &mut Arranged, from_depth: usize) -> Vec<Pocket> {
        let loops = std::mem::take(&mut arranged.loops);
        let pieces = if arranged.is_plain {
            Pieces::plain(loops)
        } else {
            Pieces::of(loops, &arranged.dividers, self.join, self.grain)
        };
        add(&mut self.overlaps, pieces.copies.first().map(|&at| (pieces.copies.len(), at)));
        let pieces = pieces.all;
        let (faces, rays) = Faces::new(&pieces, self.grain);
        let nests = Nests::new(&pieces, &faces, from_depth);
        let left_out = nests.left_out(&pieces, (&faces, &rays), &arranged.crossing);
        let (mut along, mut between) =
            (vec![false; arranged.dividers.len()], vec![false; arranged.dividers.len()]);
        for (i, piece) in pieces.iter().enumerate() {
            let sides = [faces.left(i), faces.right(i)];
            let divides = sides[0] != sides[1]
                && sides.iter().any(|&s| nests.is_pocket(&faces, s) || faces.depth[s] <= from_depth);
            for &divider in &piece.dividers {
                along[divider] |= piece.in_loop;
                between[divider] |= divides && !piece.in_loop;
            }
        }
        let dividing = arranged.dividers.iter().zip(&between).filter(|(_, b)| **b);
        let places: Vec<Point> = dividing.map(|(path, _)| path.element(path.len() / 2).midpoint()).collect();
        let count = places.len();
        self.defects.extend(places.first().map(|&at| Defect::Divided { count, at }));
        let mut unused = std::mem::take(&mut arranged.rest);
        let idle = arranged.dividers.drain(..).enumerate().filter(|(i, _)| !along[*i] && !between[*i]);
        unused.extend(idle.map(|(_, path)| path));
        self.report_open(&unused, |p| nests.is_pocket(&faces, faces.around(&rays, p)));
        drop(rays);
        let mut found = pockets(&pieces, &faces, |face| nests.is_pocket(&faces, face) && !left_out[face]);
        found.retain(|pocket| self.is_more_than_a_gap(pocket));
        found
    }

    /// Whether a pocket is wider than the round-off: between curves that nearly lie on each other there
    /// may be one that is not, and the curves count as one there.
    fn is_more_than_a_gap(&mut self, pocket: &Pocket) -> bool {
        let length: f64 = pocket.loops().map(ArcSpline::length).sum();
        let is_pocket = pocket.area() > self.grain.same * length;
        if !is_pocket {
            add(&mut self.overlaps, pocket.outer().vertices.first().map(|v| (1, v.point)));
        }
        is_pocket
    }

    fn report_open(&mut self, curves: &[ArcSpline], is_in_pocket: impl Fn(Point) -> bool) {
        let (closed, open) = chain(curves, &vec![0; curves.len()], self.join, self.grain);
        self.defects.extend(open.iter().map(|chain| chain.defect(is_in_pocket(chain.middle))));
        // What closes only without what it crosses.
        self.defects.extend(closed.iter().map(|c| {
            let (start, middle) = (c.path.vertices[0].point, c.path.element(0).midpoint());
            Defect::OpenContour { start, end: start, gap: 0.0, inside: is_in_pocket(middle) }
        }));
    }

    /// What was counted on the way.
    fn report(&mut self) {
        self.defects.extend(self.overlaps.map(|(count, at)| Defect::Overlaps { count, at }));
        self.defects.extend(self.healed.map(|(count, at)| Defect::Healed { count, at }));
        self.defects.extend(self.copies.map(|(count, at)| Defect::Duplicates { count, at }));
    }
}

/// Adds to a count with a place.
fn add(to: &mut Option<(usize, Point)>, more: Option<(usize, Point)>) {
    if let Some((count, at)) = more {
        to.get_or_insert((0, at)).0 += count;
    }
}
