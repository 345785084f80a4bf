//! The certificate of an axis: residuals and topology, measured anew.

use super::bvh::SearchDisk;
use super::graph::{BoundaryPiece, DISK_ROUNDINGS, Graph, GraphEdge};
use super::piece::UnitDisk;
use super::site::{Foot, NONE};
use super::splice::TANGENT_ROUNDINGS;
use super::track::inner_disk;
use super::union::Sets;
use super::{Mat, Mismatch};
use crate::geom::Point;
use rayon::prelude::*;

/// Residuals up to this many times the round-off of a drawn coordinate are round-off.
///
/// A disk is computed with some 30 roundings of numbers up to 1; where the two sites it hangs between
/// have nearly equal normals (a corner of a few seconds of arc), or where a short arc is drawn with
/// rounded ends, digits of their angle are lost. 2^17 leaves room for both.
pub(super) const RESIDUAL_ROUNDINGS: f64 = 131_072.0;

/// What is round-off of an axis, in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    /// Of a disk: that of the numbers, and that of elements as short as round-off. Noise tilts an element of
    /// length `l` by up to `c noise / l`, but what it owns is no wider than `l`; of the two the smaller counts,
    /// which is at most the root of `c noise`.
    pub disks: f64,
    /// Of a footpoint along the boundary: disks that differ by round-off are one, and along a tie their feet lie
    /// apart by the root of twice that.
    pub feet: f64,
}

impl Doubt {
    /// That of an axis whose coordinates are off by `noise`, where angles up to `blur` at a joint were taken for
    /// round-off.
    pub fn of(noise: f64, blur: f64) -> Doubt {
        let disks = RESIDUAL_ROUNDINGS * noise + blur.min((2.0 * TANGENT_ROUNDINGS * noise).sqrt());
        Doubt { disks, feet: (2.0 * DISK_ROUNDINGS * noise).sqrt() + disks }
    }
}

/// Disks one after the other that are looked at together.
const NEAR: usize = 256;

impl Mat {
    /// Holds the axis against its boundary: it is connected and V - E = 1 - islands (but for islands that
    /// touch others or the wall where one side is no corner: around these it does not run, and may end on
    /// either side); its edges lie
    /// along the whole boundary in its order, and consecutive ones meet in a disk; every disk touches
    /// the sites it should, in the direction of their normals, and contains no boundary (at the
    /// vertices and in the middle of each edge); the radius is monotone along edges.
    ///
    /// # Errors
    /// The first [`Mismatch`] found.
    pub fn check(&self) -> Result<Residuals, Mismatch> {
        self.checked(0.0)
    }

    /// The same with a wish: residuals up to a length in job units are right, as those of round-off are.
    /// What is computed from an axis that keeps the tolerance of a job is as near to the truth.
    ///
    /// # Errors
    /// The first [`Mismatch`] found.
    pub fn check_within(&self, length: f64) -> Result<(), Mismatch> {
        self.checked(self.frame.length_in(length)).map(|_| ())
    }

    fn checked(&self, wish: f64) -> Result<Residuals, Mismatch> {
        self.check_topology()?;
        let mut found = Findings::default();
        for touch in self.touches()? {
            self.check_touch(&touch, &mut found);
        }
        let (disks, edges) = (&self.graph.disks, &self.graph.edges);
        let empty: Vec<(f64, Point)> =
            disks.par_chunks(NEAR).flat_map_iter(|some| self.look(some, wish)).collect();
        let of_edge = |edge: &GraphEdge| self.middle(edge);
        let (middles, beyond): (Vec<UnitDisk>, Vec<f64>) = edges.par_iter().map(of_edge).unzip();
        for (disk, beyond) in middles.iter().zip(beyond) {
            found.note(Residual::Monotone, beyond, disk.center);
        }
        let empty_middles: Vec<(f64, Point)> =
            middles.par_chunks(NEAR).flat_map_iter(|some| self.look(some, wish)).collect();
        for (intrusion, center) in empty.into_iter().chain(empty_middles) {
            found.note(Residual::Empty, intrusion, center);
        }
        let allowed = |r: Residual| match r {
            Residual::Foot => self.foot_error().max(wish.sqrt()),
            _ => self.residual_error().max(wish),
        };
        let within = |(r, (value, _)): &(Residual, (f64, Point))| *value <= allowed(*r);
        // NaN is within nothing.
        match found.worst.into_iter().find(|w| !within(w)) {
            Some((_, (relative, at))) => Err(Mismatch::Residual { relative, at: self.frame.leave(at) }),
            None => Ok(found.residuals()),
        }
    }

    /// Whether a disk touches a piece where it should.
    fn check_touch(&self, touch: &Touch, found: &mut Findings) {
        let Touch { site, foot, disk } = *touch;
        let disk = &self.graph.disks[disk as usize];
        let gap = (foot.point.distance(disk.center) - disk.radius).abs();
        let off_site = self.sites[site as usize].distance(foot.point);
        found.note(Residual::Touch, gap.max(off_site), disk.center);
        found.note(
            Residual::Foot,
            (foot.point + foot.normal * disk.radius).distance(disk.center),
            disk.center,
        );
    }

    /// The disk in the middle of an edge, and how far its radius lies beyond those of the ends.
    fn middle(&self, edge: &GraphEdge) -> (UnitDisk, f64) {
        let [a, b] = edge.pieces.map(|p| self.graph.piece(&self.sites, p));
        let ends = edge.disks.map(|d| &self.graph.disks[d as usize]);
        let between = UnitDisk {
            center: ends[0].center.midpoint(ends[1].center),
            radius: 0.5 * (ends[0].radius + ends[1].radius),
        };
        // Ends that are one for all that residuals tell have no disk between them that is not either of them.
        let is_long = ends[0].apart(ends[1]) > self.residual_error();
        let inner = || inner_disk(&self.sites, [&a, &b], self.graph.error);
        let disk = is_long.then(inner).flatten().unwrap_or(between);
        let radii = ends.map(|d| d.radius);
        let beyond = (disk.radius - radii[0].max(radii[1])).max(radii[0].min(radii[1]) - disk.radius);
        (disk, beyond.max(0.0))
    }

    /// Largest distance of a center from the normal at a footpoint that is round-off.
    fn foot_error(&self) -> f64 {
        Doubt::of(self.frame.noise, self.blur).feet
    }

    /// Largest residual that is round-off, in the unit frame.
    pub(super) fn residual_error(&self) -> f64 {
        Doubt::of(self.frame.noise, self.blur).disks
    }

    /// How far the boundary reaches into disks at most, as far as the wish cares, and their centers. In a
    /// polygon that is nearly round all disks touch nearly all sites: only intrusions of more than half
    /// of the wish are looked for, and disks within the other half of one without have none.
    fn look(&self, disks: &[UnitDisk], wish: f64) -> impl Iterator<Item = (f64, Point)> {
        let mut last: Option<(&UnitDisk, f64)> = None;
        disks.iter().map(move |disk| {
            let beside = last.map_or(f64::INFINITY, |(near, intrusion)| {
                disk.center.distance(near.center) + (disk.radius - near.radius) + intrusion
            });
            if beside < wish {
                return (beside, disk.center);
            }
            let limit = (disk.radius - 0.5 * wish).max(0.0);
            let intrusion = (disk.radius - self.unit_distance(disk.center, limit)).abs();
            last = Some((disk, intrusion));
            (intrusion, disk.center)
        })
    }

    /// Distance of a place to the boundary, in the unit frame, if it is at most about `limit`.
    pub(super) fn unit_distance(&self, c: Point, limit: f64) -> f64 {
        let mut best = limit + self.residual_error();
        self.bvh.search(SearchDisk { center: c, radius: best }, |i| {
            let site = &self.sites[i as usize];
            // Where chords are short, the corners of many boxes lie in the disk.
            let d = if site.is_beyond(c, best) { f64::INFINITY } else { site.distance(c) };
            (d < best).then(|| {
                best = d;
                SearchDisk { center: c, radius: d }
            })
        });
        best
    }

    /// Where disks touch the boundary, found by walking around it: every piece must go on where the
    /// one before ends, in place and in the disk that touches there; together they must be all pieces, all
    /// sites, and both sides of every edge.
    fn touches(&self) -> Result<Vec<Touch>, Mismatch> {
        let pieces = &self.graph.pieces;
        let mut walk = Walk { seen: vec![false; pieces.len()], touches: Vec::new(), sites: 0, sides: 0 };
        // What stands for the way over a link is no piece. A ring without edges is one disk.
        let count = pieces.len() as u32;
        let rings = |first: &u32| pieces[*first as usize].next != NONE;
        let with_edges = (0..count).filter_map(|first| Some((first, self.disks_of(first)?[0])));
        for (first, disk) in with_edges.filter(|(first, _)| rings(first)) {
            self.walk_ring(first, disk, &mut walk)?;
        }
        let mut lone = self.graph.lone_disks().into_iter();
        for first in (0..count).filter(rings) {
            if walk.seen[first as usize] {
                continue;
            }
            let is_left_out = pieces[first as usize].left_out;
            if let Some(disk) = if is_left_out { Some(NONE) } else { lone.next() } {
                self.walk_ring(first, disk, &mut walk)?;
            }
        }
        let missed = (0..pieces.len()).find(|&i| !walk.seen[i] && pieces[i].next != NONE);
        let is_all = walk.sites == self.sites.len() && walk.sides == 2 * self.graph.edges.len();
        if is_all && missed.is_none() {
            return Ok(walk.touches);
        }
        let at = missed.map_or(Point::default(), |i| self.graph.from(&self.sites, i as u32).point);
        Err(Mismatch::Boundary { at: self.frame.leave(at) })
    }

    /// Walks around a ring that begins in a disk, unless it was walked around.
    fn walk_ring(&self, first: u32, begin: u32, walk: &mut Walk) -> Result<(), Mismatch> {
        let at = || self.frame.leave(self.graph.from(&self.sites, first).point);
        let goes_on = walk.seen[first as usize] || self.goes_around(first, begin, walk).is_some();
        goes_on.then_some(()).ok_or_else(|| Mismatch::Boundary { at: at() })
    }

    /// Walks around one ring; `None` where it does not go on as it should.
    fn goes_around(&self, first: u32, begin: u32, walk: &mut Walk) -> Option<()> {
        let (mut at, mut disk) = (first, begin);
        while !walk.seen[at as usize] {
            walk.seen[at as usize] = true;
            let here = &self.graph.pieces[at as usize];
            let piece = self.graph.piece(&self.sites, at);
            // A piece without an edge is the contact arc of one disk, or left out; then no disk is known.
            let ends = match here {
                BoundaryPiece { left_out: true, .. } => [NONE; 2],
                BoundaryPiece { edge: NONE, .. } => [disk; 2],
                _ => self.disks_of(at)?,
            };
            if ends[0] != disk && ![disk, ends[0]].contains(&NONE) {
                return None;
            }
            disk = ends[1];
            let touch = |foot, disk| Touch { site: piece.site, foot, disk };
            let touches = [touch(piece.from, ends[0]), touch(piece.to, ends[1])];
            walk.touches.extend(touches.into_iter().filter(|touch| touch.disk != NONE));
            walk.sides += usize::from(here.edge != NONE);
            let after = self.graph.pieces.get(here.next as usize)?;
            walk.sites += usize::from(self.enters_site(here.site, after)?);
            at = here.next;
        }
        (at == first && (disk == begin || [disk, begin].contains(&NONE))).then_some(())
    }

    /// The disks at start and end of a piece that has an edge which knows it.
    fn disks_of(&self, piece: u32) -> Option<[u32; 2]> {
        let edge = self.graph.edges.get(self.graph.pieces[piece as usize].edge as usize)?;
        let [a, b] = edge.disks;
        match edge.pieces {
            [p, _] if p == piece => Some([a, b]),
            [_, p] if p == piece => Some([b, a]),
            _ => None,
        }
    }

    /// Whether the piece that follows one on a site begins the next site; `None` if it does not follow.
    fn enters_site(&self, site: u32, after: &BoundaryPiece) -> Option<bool> {
        if site == after.site {
            return (!after.begins()).then_some(false);
        }
        let is_next = self.sites[site as usize].next == after.site;
        (is_next && after.begins()).then_some(true)
    }

    fn check_topology(&self) -> Result<(), Mismatch> {
        if self.least > 0.0 {
            // What is left out may have been all that holds the rest together.
            return Ok(());
        }
        let (vertices, edges) = (self.graph.disks.len(), self.graph.edges.len());
        let components = components(&self.graph);
        if components != self.parts {
            return Err(Mismatch::Components { components });
        }
        if vertices as i64 - edges as i64 != self.parts as i64 - self.islands as i64 {
            return Err(Mismatch::Euler { vertices, edges, islands: self.islands });
        }
        Ok(())
    }
}

fn components(graph: &Graph) -> usize {
    let mut sets = Sets::singles(graph.disks.len());
    let joined = graph.edges.iter().filter(|e| sets.unite(e.disks[0], e.disks[1])).count();
    graph.disks.len() - joined
}

/// A disk and a place where it touches a site.
struct Touch {
    site: u32,
    foot: Foot,
    disk: u32,
}

/// What a walk around the boundary has met.
struct Walk {
    seen: Vec<bool>,
    touches: Vec<Touch>,
    sites: usize,
    /// Pieces that lie along an edge.
    sides: usize,
}

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Residual {
    Empty,
    Touch,
    Foot,
    Monotone,
}

/// The largest value of each residual and the center of the disk it belongs to.
struct Findings {
    worst: [(Residual, (f64, Point)); 4],
}

impl Default for Findings {
    fn default() -> Self {
        let all = [Residual::Empty, Residual::Touch, Residual::Foot, Residual::Monotone];
        Findings { worst: all.map(|r| (r, (0.0, Point::default()))) }
    }
}

impl Findings {
    fn note(&mut self, residual: Residual, value: f64, at: Point) {
        let (_, worst) = &mut self.worst[residual as usize];
        if value > worst.0 || value.is_nan() {
            *worst = (value, at);
        }
    }

    fn residuals(&self) -> Residuals {
        let [empty, touch, foot, monotone] = self.worst.map(|(_, (value, _))| value);
        Residuals { empty, touch, foot, monotone }
    }
}

/// Largest residuals of an axis, relative to the size of the pocket.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residuals {
    /// Difference of a radius and the distance of the center to the boundary.
    pub empty: f64,
    /// Distance of a disk from its footpoints, and of those from their sites.
    pub touch: f64,
    /// Distance of a center from the normals at its footpoints, at the radius. Where contacts tie,
    /// they may lie apart by the root of round-off.
    pub foot: f64,
    /// How far a radius inside an edge leaves the range of its ends.
    pub monotone: f64,
}
