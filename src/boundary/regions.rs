//! Faces become pockets.
//!
//! **Needs** pieces and the faces between them. **Guarantees** for each chosen face its boundary as
//! simple loops; a loop that is one piece stays as it was drawn.
//!
//! **Method.** Sides of pieces that bound a face are followed with the face on the left. At a
//! junction the next side is the first one clockwise from where the walk comes from.

use super::Pocket;
use super::faces::{Classes, Faces, branches};
use super::pieces::Piece;
use super::ray::{Rays, turned};
use super::simple::{inner_place, simple_loops};
use crate::geom::ArcSpline;
use std::collections::{BTreeMap, HashSet};

/// A loop of the boundary of a face: its first piece and its course, the face on the left.
type Boundary = (usize, ArcSpline);

/// Which faces are pockets, and which of them lie in one nest.
#[derive(Debug)]
pub(super) struct Nests {
    /// For each face its nest; faces that are no deeper than the outlines have their own.
    nest_of: Vec<usize>,
    from_depth: usize,
}

impl Nests {
    /// Nests begin where pockets do: a crossing in the outline of a part does no harm to the
    /// pockets in it. Neighboring parts of equal depth are nests of their own.
    pub fn new(pieces: &[Piece], faces: &Faces, from_depth: usize) -> Nests {
        let mut nests = Classes::new(faces.depth.len());
        for i in 0..pieces.len() {
            let (left, right) = (faces.left(i), faces.right(i));
            let (a, b) = (faces.depth[left], faces.depth[right]);
            if a.min(b) > from_depth && a != b {
                nests.unite(left, right);
            }
        }
        Nests { nest_of: nests.settled(), from_depth }
    }

    /// Whether a face is a pocket, if nothing in its nest crosses.
    pub fn is_pocket(&self, faces: &Faces, face: usize) -> bool {
        let depth = faces.depth[face];
        depth > self.from_depth && !(depth - self.from_depth).is_multiple_of(2)
    }

    /// For each face whether it is in a nest with contours that cross.
    pub fn left_out(
        &self,
        pieces: &[Piece],
        (faces, rays): (&Faces, &Rays),
        crossing: &[ArcSpline],
    ) -> Vec<bool> {
        let mut out: HashSet<usize> = HashSet::new();
        for path in crossing {
            let face = faces.around(rays, inner_place(path));
            if faces.depth[face] > self.from_depth {
                out.insert(self.nest_of[face]);
            }
        }
        if !crossing.is_empty() {
            let rays = Rays::new(crossing.iter().enumerate());
            for (i, piece) in pieces.iter().enumerate() {
                let sides = [faces.left(i), faces.right(i)];
                let Some(&outside) = sides.iter().find(|&&s| faces.depth[s] <= self.from_depth) else {
                    continue;
                };
                let inside = if outside == sides[0] { sides[1] } else { sides[0] };
                if faces.depth[inside] > self.from_depth
                    && !out.contains(&self.nest_of[inside])
                    && is_wound_around(&rays, &piece.path)
                {
                    out.insert(self.nest_of[inside]);
                }
            }
        }
        self.nest_of.iter().map(|nest| out.contains(nest)).collect()
    }
}

/// Whether a path lies inside one of the contours that rays were prepared for.
fn is_wound_around(rays: &Rays, path: &ArcSpline) -> bool {
    let mut windings: BTreeMap<usize, i32> = BTreeMap::new();
    rays.all(turned(inner_place(path)), |hit| {
        *windings.entry(hit.owner).or_default() += if hit.from_left { 1 } else { -1 };
    });
    windings.values().any(|&w| w != 0)
}

/// The pockets that some faces are, in the order of the first pieces of their outer loops.
pub(super) fn pockets(pieces: &[Piece], faces: &Faces, is_chosen: impl Fn(usize) -> bool) -> Vec<Pocket> {
    let mut boundaries: BTreeMap<usize, Vec<Boundary>> = BTreeMap::new();
    for (i, piece) in pieces.iter().enumerate().filter(|(_, p)| p.is_plain()) {
        for (face, forward) in [(faces.left(i), true), (faces.right(i), false)] {
            if is_chosen(face) {
                let path = if forward { piece.path.clone() } else { piece.path.reversed() };
                boundaries.entry(face).or_default().push((i, path));
            }
        }
    }
    for (face, (first, walk)) in walks(pieces, faces, is_chosen) {
        let loops = simple_loops(walk).into_iter().map(|path| (first, path));
        boundaries.entry(face).or_default().extend(loops);
    }
    let mut found: Vec<(usize, Pocket)> = Vec::new();
    for mut loops in boundaries.into_values() {
        loops.sort_by_key(|(first, _)| *first);
        let (outer, islands): (Vec<_>, Vec<_>) = loops.into_iter().partition(|(_, path)| path.area() > 0.0);
        let mut islands: Vec<ArcSpline> = islands.into_iter().map(|(_, path)| path).collect();
        for (first, outer) in outer {
            found.push((first, Pocket::from_checked(outer, std::mem::take(&mut islands))));
        }
    }
    found.sort_by_key(|(first, _)| *first);
    found.into_iter().map(|(_, pocket)| pocket).collect()
}

/// Closed walks along woven pieces around the chosen faces, which lie on the left.
fn walks(pieces: &[Piece], faces: &Faces, is_chosen: impl Fn(usize) -> bool) -> Vec<(usize, Boundary)> {
    let face_of = |(i, forward): (usize, bool)| if forward { faces.left(i) } else { faces.right(i) };
    let is_side = |side: (usize, bool)| {
        !pieces[side.0].is_plain() && face_of(side) != face_of((side.0, !side.1)) && is_chosen(face_of(side))
    };
    let around: Vec<Vec<(usize, bool)>> = faces.junctions.all.iter().map(branches).collect();
    let next = |(i, forward): (usize, bool)| {
        let end = if forward { pieces[i].path.len() } else { 0 };
        let &(junction, strand) = faces.junctions.at.get(&(i, end))?;
        let (at, fan) = (&faces.junctions.all[junction], &around[junction]);
        let strand = at.strands[strand];
        let from = at.rank[if forward { strand.from? } else { strand.to? }];
        let n = at.fan.order.len();
        let turn = (1..=n).map(|step| fan[at.fan.order[(from + n - step) % n]]);
        turn.into_iter().find(|&side| is_side(side) && face_of(side) == face_of((i, forward)))
    };
    let mut walked: HashSet<(usize, bool)> = HashSet::new();
    let mut found = Vec::new();
    for first in (0..pieces.len()).flat_map(|i| [(i, true), (i, false)]).filter(|&side| is_side(side)) {
        let mut vertices = Vec::new();
        let mut at = Some(first);
        while let Some((i, forward)) = at.filter(|&side| walked.insert(side)) {
            let path = &pieces[i].path;
            let turned = if forward { path.clone() } else { path.reversed() };
            vertices.extend_from_slice(&turned.vertices[..turned.len()]);
            at = next((i, forward));
        }
        if !vertices.is_empty() {
            found.push((face_of(first), (first.0, ArcSpline { vertices, closed: true })));
        }
    }
    found
}
