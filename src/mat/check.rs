//! The certificate of an axis: residuals and topology, measured anew.

use super::bvh::SearchDisk;
use super::graph::Graph;
use super::lamination::UnitDisk;
use super::track::Track;
use super::{Mat, Mismatch};
use crate::geom::Point;

/// Residuals up to this fraction of the size are round-off.
///
/// A footpoint disk is computed with some 30 roundings of numbers up to 1; where the two sites it
/// hangs between have nearly equal normals (a corner of a few seconds of arc), the radius loses the
/// digits of their angle, but the residual only to first order. 2^17 ulps leave room for both.
pub(super) const RESIDUAL_ERROR: f64 = 131_072.0 * f64::EPSILON;

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
            if !(value <= worst.0) {
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
        let scale = 1.0;
        if worst.0 <= RESIDUAL_ERROR * scale {
            Ok(residuals)
        } else {
            Err(Mismatch::Residual { relative: worst.0, at: self.frame.leave(worst.1) })
        }
    }

    /// How far the boundary reaches into a disk.
    fn intrusion(&self, disk: &UnitDisk) -> f64 {
        (disk.radius - self.unit_distance(disk.center, disk.radius)).abs()
    }

    /// Distance of a place to the boundary, in the unit frame, if it is at most about `limit`.
    pub(super) fn unit_distance(&self, c: Point, limit: f64) -> f64 {
        let mut best = limit + RESIDUAL_ERROR;
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
    let mut root: Vec<u32> = (0..graph.disks.len() as u32).collect();
    fn find(root: &mut [u32], mut i: u32) -> u32 {
        while root[i as usize] != i {
            root[i as usize] = root[root[i as usize] as usize];
            i = root[i as usize];
        }
        i
    }
    let mut count = root.len();
    for edge in &graph.edges {
        let [a, b] = edge.disks.map(|d| find(&mut root, d));
        if a != b {
            root[a.max(b) as usize] = a.min(b);
            count -= 1;
        }
    }
    count
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
