//! The certificate of an axis: residuals and topology, measured anew.

use super::bvh::SearchDisk;
use super::graph::Graph;
use super::piece::UnitDisk;
use super::splice::TANGENT_ROUNDINGS;
use super::track::Track;
use super::union::Sets;
use super::{Mat, Mismatch};
use crate::geom::Point;

/// Residuals up to this many times the round-off of a drawn coordinate are round-off.
///
/// A disk is computed with some 30 roundings of numbers up to 1; where the two sites it hangs between
/// have nearly equal normals (a corner of a few seconds of arc), or where a short arc is drawn with
/// rounded ends, digits of their angle are lost. 2^17 leaves room for both.
pub(super) const RESIDUAL_ROUNDINGS: f64 = 131_072.0;

impl Mat {
    /// Holds the axis against its boundary: every disk touches both its sites and contains no
    /// boundary (at the vertices and in the middle of each edge), the radius is monotone along
    /// edges, the graph is connected, and V - E = 1 - islands.
    ///
    /// # Errors
    /// The first [`Mismatch`] found.
    pub fn check(&self) -> Result<Residuals, Mismatch> {
        self.check_topology()?;
        let mut residuals = Residuals::default();
        let mut worst = (0.0, Point::default());
        let mut note = |value: f64, at: Point, slot: &mut f64| {
            *slot = slot.max(value);
            // NaN is as bad as it gets.
            if value > worst.0 || value.is_nan() {
                worst = (value, at);
            }
        };
        for disk in &self.graph.disks {
            note(self.intrusion(disk), disk.center, &mut residuals.empty);
        }
        for edge in &self.graph.edges {
            for (i, &d) in edge.disks.iter().enumerate() {
                let disk = &self.graph.disks[d as usize];
                for (j, &p) in edge.pieces.iter().enumerate() {
                    let piece = &self.graph.pieces[p as usize].piece;
                    let foot = if i == j { piece.from } else { piece.to };
                    let gap = (foot.point.distance(disk.center) - disk.radius).abs();
                    note(gap, disk.center, &mut residuals.touch);
                    let site = &self.sites[piece.site as usize];
                    note(site.distance(foot.point), disk.center, &mut residuals.touch);
                }
            }
            let pieces = edge.pieces.map(|p| self.graph.pieces[p as usize].piece);
            let track = Track::of(&self.sites, &pieces[0]);
            let probe = track.at(0.5);
            let (radius, _) = track.reach(&self.sites, &pieces[1], &probe);
            if radius.is_finite() {
                let disk = UnitDisk { center: probe.center(radius), radius };
                note(self.intrusion(&disk), disk.center, &mut residuals.empty);
                let ends = edge.disks.map(|d| self.graph.disks[d as usize].radius);
                let beyond = (radius - ends[0].max(ends[1])).max(ends[0].min(ends[1]) - radius);
                note(beyond.max(0.0), disk.center, &mut residuals.monotone);
            }
        }
        if worst.0 <= self.residual_error() {
            Ok(residuals)
        } else {
            Err(Mismatch::Residual { relative: worst.0, at: self.frame.leave(worst.1) })
        }
    }

    /// Largest residual that is round-off, in the unit frame: that of the numbers, and that of elements
    /// as short as round-off. Noise tilts an element of length `l` by up to `c noise / l`, but what it
    /// owns is no wider than `l`; of the two the smaller counts, which is at most the root of `c noise`.
    pub(super) fn residual_error(&self) -> f64 {
        let noise = self.frame.noise;
        RESIDUAL_ROUNDINGS * noise + self.blur.min((2.0 * TANGENT_ROUNDINGS * noise).sqrt())
    }

    /// How far the boundary reaches into a disk.
    fn intrusion(&self, disk: &UnitDisk) -> f64 {
        (disk.radius - self.unit_distance(disk.center, disk.radius)).abs()
    }

    /// Distance of a place to the boundary, in the unit frame, if it is at most about `limit`.
    pub(super) fn unit_distance(&self, c: Point, limit: f64) -> f64 {
        let mut best = limit + self.residual_error();
        self.bvh.search(SearchDisk { center: c, radius: best }, |i| {
            let d = self.sites[i as usize].distance(c);
            (d < best).then(|| {
                best = d;
                SearchDisk { center: c, radius: d }
            })
        });
        best
    }

    fn check_topology(&self) -> Result<(), Mismatch> {
        let (vertices, edges) = (self.graph.disks.len(), self.graph.edges.len());
        let components = components(&self.graph);
        if components != 1 {
            return Err(Mismatch::Components { components });
        }
        if vertices as i64 - edges as i64 != 1 - self.islands as i64 {
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

/// Largest residuals of an axis, relative to the size of the pocket.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residuals {
    /// Difference of a radius and the distance of the center to the boundary.
    pub empty: f64,
    /// Distance of a disk from its footpoints, and of those from their sites.
    pub touch: f64,
    /// How far a radius inside an edge leaves the range of its ends.
    pub monotone: f64,
}
