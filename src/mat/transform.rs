//! The transform as a whole.

use super::above::{Above, first_lost};
use super::bvh::Bvh;
use super::check::Doubt;
use super::conic::bezier;
use super::frame::Frame;
use super::graph::{DISK_ROUNDINGS, Graph};
use super::kinds::Kinds;
use super::lamination::Lamination;
use super::low::Floor;
use super::piece::UnitDisk;
use super::radii::Radii;
use super::shot::Field;
use super::site::Site;
use super::sites::Sites;
use super::stages::{Laps, Stages};
use super::{AxisEdge, AxisVertex, Disk};
use crate::boundary::Pocket;
use crate::error::Error;
use crate::geom::{Point, Vector};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// The medial axis transform of a pocket.
#[derive(Clone, Debug)]
pub struct Mat {
    pub(crate) frame: Frame,
    pub(crate) sites: Vec<Site>,
    pub(crate) bvh: Bvh,
    pub(crate) graph: Graph,
    pub(super) kinds: Kinds,
    /// Islands that the axis runs around, see [`Sites::encircled`].
    pub(super) islands: usize,
    /// Parts of the axis, see [`Lamination::parts`].
    pub(super) parts: usize,
    /// Largest angle at a joint that was taken for round-off.
    pub(super) blur: f64,
    /// Radius from which on it is whole, in the unit frame.
    pub(super) least: f64,
    stages: Stages,
    radii: OnceLock<Radii>,
}

/// Counts that `--timings` reports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Boundary elements, reflex vertices included.
    pub sites: usize,
    /// Axis vertices.
    pub vertices: usize,
    /// Axis edges.
    pub edges: usize,
}

/// What [`Mat::check`] can find wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Mismatch {
    /// The axis falls apart where the pocket does not.
    #[error("the axis has {components} components")]
    Components {
        /// How many.
        components: usize,
    },
    /// The Euler count is off.
    #[error("{vertices} vertices and {edges} edges do not fit {islands} islands")]
    Euler {
        /// Vertices of the axis.
        vertices: usize,
        /// Edges of the axis.
        edges: usize,
        /// Islands of the pocket that the axis runs around.
        islands: usize,
    },
    /// The pieces of the boundary that the edges stand for are not the whole boundary in its order.
    #[error("the axis does not go all along the boundary at ({}, {})", .at.x, .at.y)]
    Boundary {
        /// Where on the boundary.
        at: Point,
    },
    /// A disk does not touch what it should, or holds what it should not.
    #[error("a disk at ({}, {}) is off by {relative:e} of the size", .at.x, .at.y)]
    Residual {
        /// How much, relative to the size of the pocket.
        relative: f64,
        /// Center of the disk.
        at: Point,
    },
}

/// Directions in which holes are linked, one after the other until one has no ties. They are turned
/// by irrational angles: drawings have their symmetries along other ones.
const DIRECTIONS: [f64; 4] = [2.4, 5.2, 0.7, 3.9];

/// Disks united by ties are equal but for round-off; the angle under which they see their contacts
/// may cost half of the digits.
const UNION_ERROR: f64 = 1.0 / 67_108_864.0;

impl Pocket {
    /// The medial axis transform.
    ///
    /// # Errors
    /// [`Error::Internal`] when the loops do not bound a pocket after all.
    pub fn medial_axis(&self) -> Result<Mat, Error> {
        let axis = self.axis_above(0.0)?;
        axis.ok_or_else(|| Error::Internal { what: "an axis is empty".into(), at: self.bounds().center() })
    }

    /// What of the medial axis transform a disk of this radius (in job units) can get to: all vertices and
    /// edges with disks as large as that, and some with smaller ones around them. Everything that is asked of
    /// it about distances from that radius on is as the whole axis tells it: [level sets](Mat::level),
    /// [the largest disk](Mat::largest_disk), parts and passages of [`Mat::levels`]. Little is computed along
    /// walls where no such disk fits, so that with a large tool fine detail costs little; where most disks are nearly
    /// as large, it is the whole axis. `None` where none fits anywhere.
    ///
    /// # Errors
    /// [`Error::Internal`] when the loops do not bound a pocket after all.
    pub fn medial_axis_above(&self, radius: f64) -> Result<Option<Mat>, Error> {
        self.axis_above(radius)
    }

    fn axis_above(&self, radius: f64) -> Result<Option<Mat>, Error> {
        let frame = Frame::around(&self.bounds());
        let least = frame.length_in(radius);
        if least > 1.0 {
            // The pocket is no longer than that.
            return Ok(None);
        }
        let mut failure = None;
        for angle in DIRECTIONS {
            match laminate(self, &frame, Vector::from_angle(angle), least) {
                Ok(None) => return Ok(None),
                Ok(Some(laminated)) => {
                    let (union, _) = laminated.map.widest_union;
                    let mat = || Mat::of_map(frame, laminated, least);
                    if union <= UNION_ERROR {
                        return Ok(mat());
                    }
                    // Better an axis that says where it is doubtful than none.
                    failure.get_or_insert_with(|| Ok(mat()));
                }
                Err(at) => failure = failure.or(Some(Err(at))),
            }
        }
        match failure {
            Some(Ok(mat)) => Ok(mat),
            Some(Err(at)) => Err(Error::Internal {
                what: "a disk at the boundary touches nothing else".into(),
                at: frame.leave(at),
            }),
            None => unreachable!("there are directions"),
        }
    }
}

/// Sites and map of a pocket for one direction of links.
struct Laminated {
    all: Sites,
    bvh: Bvh,
    map: Lamination,
    /// The sites that are asked for, if not all are.
    free: Option<Vec<bool>>,
    stages: Stages,
}

/// Sites, shots and map for one direction of links, from a radius up: none where no disk is so large. The place of a
/// shot into nothing otherwise.
fn laminate(
    pocket: &Pocket,
    frame: &Frame,
    direction: Vector,
    least: f64,
) -> Result<Option<Laminated>, Point> {
    let (mut laps, mut stages) = (Laps::start(), Stages::default());
    let all = Sites::of(pocket, frame, direction);
    stages.sites = laps.lap();
    let bvh = Bvh::sorted(&all.sites.iter().map(Site::bounds).collect::<Vec<_>>());
    stages.boxes = laps.lap();
    let field = Field::new(&all.sites, &bvh, all.blur);
    let doubt = Doubt::of(frame.noise, all.blur);
    let floor = Floor { radius: least - doubt.disks, error: doubt.disks };
    let place = |joint: u32| all.sites[joint as usize].end.point;
    let nowhere = || all.sites.first().map_or(Point::default(), |s| s.end.point);
    let (map, free) = if floor.radius > 0.0 && Above::pays(&field, floor) {
        let Some(mut above) = Above::of(&all, &field, floor).map_err(place)? else { return Ok(None) };
        stages.shots = laps.lap();
        (above.map(&all, &field, doubt).ok_or_else(nowhere)?, Some(above.free))
    } else {
        let shots = field.shoot_all(0.0);
        stages.shots = laps.lap();
        first_lost(&all.sites, &shots).map_or(Ok(()), |joint| Err(place(joint)))?;
        (Lamination::of(&all, &shots, doubt).ok_or_else(nowhere)?, None)
    };
    stages.map = laps.lap();
    Ok(Some(Laminated { all, bvh, map, free, stages }))
}

impl Mat {
    /// The transform of a map, if it has disks as large as is asked.
    fn of_map(frame: Frame, laminated: Laminated, least: f64) -> Option<Mat> {
        let Laminated { all, bvh, map, free, stages } = laminated;
        let mat = Mat::build(frame, all, bvh, (map, free.as_deref()), stages);
        // A comparison that holds for NaN: then all is asked for.
        let is_small = |disk: &UnitDisk| disk.radius < least - mat.graph.error;
        let is_nothing = mat.graph.disks.iter().all(is_small);
        (!is_nothing).then_some(Mat { least: if free.is_some() { least } else { 0.0 }, ..mat })
    }

    pub(super) fn build(
        frame: Frame,
        all: Sites,
        bvh: Bvh,
        (map, free): (Lamination, Option<&[bool]>),
        stages: Stages,
    ) -> Mat {
        let mut laps = Laps::start();
        let parts = map.parts(&all);
        let mut graph = Graph::of(&all.sites, map, free, DISK_ROUNDINGS * frame.noise);
        let faces = laps.lap();
        graph.contract();
        let mat = Mat::of_graph(frame, all, bvh, graph, parts);
        Mat { stages: Stages { faces, graph: laps.lap(), ..stages }, ..mat }
    }

    /// The transform whose vertices and edges are those of a graph of contracted edges in so many parts.
    pub(super) fn of_graph(frame: Frame, all: Sites, bvh: Bvh, mut graph: Graph, parts: usize) -> Mat {
        let islands = all.encircled(parts);
        graph.split_at_extrema(&all.sites);
        graph.shrink();
        let kinds = Kinds::of(&graph);
        let (sites, blur, stages, radii) = (all.sites, all.blur, Stages::default(), OnceLock::new());
        Mat { frame, sites, bvh, graph, kinds, islands, parts, blur, least: 0.0, stages, radii }
    }

    /// The index by radius, made when the first level asks for it.
    pub(crate) fn radii(&self) -> &Radii {
        self.radii.get_or_init(|| Radii::of(&self.sites, &self.graph, &self.kinds))
    }

    /// The vertices, in job units.
    pub fn vertices(&self) -> Vec<AxisVertex> {
        let vertex = |(disk, &kind)| AxisVertex { disk: self.disk_out(disk), kind };
        self.graph.disks.iter().zip(&self.kinds.kinds).map(vertex).collect()
    }

    /// The edges, in job units.
    pub fn edges(&self) -> Vec<AxisEdge> {
        let edge = |e: &super::graph::GraphEdge| {
            let (points, weight) = bezier(&self.sites, &self.graph, e);
            let source = |p: u32| self.sites[self.graph.pieces[p as usize].site as usize].source;
            let [right, left] = e.pieces.map(source);
            let straight = points[1] == points[0].midpoint(points[2]);
            let mut points = points.map(|p| self.frame.leave(p));
            if straight {
                points[1] = points[0].midpoint(points[2]);
            }
            AxisEdge { from: e.disks[0], to: e.disks[1], sites: [left, right], points, weight }
        };
        self.graph.edges.iter().map(edge).collect()
    }

    /// How much there is of everything.
    pub fn counts(&self) -> Counts {
        Counts { sites: self.sites.len(), vertices: self.graph.disks.len(), edges: self.graph.edges.len() }
    }

    /// The radius from which on it is whole, in job units: 0 for a whole axis.
    pub fn least_radius(&self) -> f64 {
        self.frame.length_out(self.least)
    }

    /// How long each stage took.
    pub fn stages(&self) -> Stages {
        self.stages
    }

    /// The disk of a vertex, in job units.
    pub(crate) fn disk(&self, vertex: u32) -> Disk {
        self.disk_out(&self.graph.disks[vertex as usize])
    }

    pub(super) fn disk_out(&self, disk: &UnitDisk) -> Disk {
        Disk { center: self.frame.leave(disk.center), radius: self.frame.length_out(disk.radius) }
    }
}
