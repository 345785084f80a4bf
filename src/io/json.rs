//! The document for CAM software: boundaries, medial axes and level sets as JSON.
//!
//! Every number reads back to the same `f64`, provided that the reader rounds correctly.

use crate::boundary::Pocket;
use crate::geom::{ArcSpline, Point, Vertex};
use crate::mat::{AxisEdge, AxisVertex, Kind, Mat, SiteRef};
use crate::offset::Level;
use crate::tolerance::Units;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const FORMAT: &str = "medial/1";

/// A document. Lengths are in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// [`FORMAT`].
    pub format: String,
    /// Unit of all lengths.
    pub units: Units,
    /// Largest distance between a drawn curve and the arc spline that stands for it.
    pub tolerance: f64,
    /// Name of the drawing.
    pub source: String,
    /// The pockets.
    pub pockets: Vec<PocketPart>,
}

/// One pocket of a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PocketPart {
    /// The outer loop, counter-clockwise, then the islands, clockwise.
    pub boundary: Vec<Loop>,
    /// The whole axis.
    pub medial_axis: Axis,
    /// The level sets in use, outermost first.
    pub offsets: Vec<Offset>,
}

/// A closed arc spline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loop {
    /// Each with the bulge of the element that leaves it.
    pub vertices: Vec<Vertex>,
}

/// An arc spline that bounds no area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ridge {
    /// Each with the bulge of the element that leaves it.
    pub vertices: Vec<Vertex>,
    /// Whether an element leads from the last vertex to the first.
    pub closed: bool,
}

/// A medial axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Centers of maximal disks.
    pub vertices: Vec<Place>,
    /// Conic arcs between them.
    pub edges: Vec<Edge>,
}

/// A vertex of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// Radius of the maximal disk.
    pub r: f64,
    /// What it is.
    pub kind: Kind,
}

/// An edge of an axis; the radius is monotone along it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// Index of the vertex where it begins.
    pub from: u32,
    /// Index of the vertex where it ends.
    pub to: u32,
    /// The boundary elements on both sides.
    pub sites: [SiteRef; 2],
    /// Its shape.
    pub curve: Conic,
}

/// A rational quadratic Bezier curve with end weights 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conic {
    /// Control points.
    pub points: [Point; 3],
    /// Weight of the middle one.
    pub weight: f64,
}

/// A level set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Offset {
    /// Distance to the boundary.
    pub distance: f64,
    /// Closed loops with the inner side on the left.
    pub loops: Vec<Loop>,
    /// Parts of the axis at this distance beside which nothing is farther.
    pub ridges: Vec<Ridge>,
}

impl Document {
    /// A document without pockets.
    pub fn new(source: impl Into<String>, units: Units, tolerance: f64) -> Document {
        Document { format: FORMAT.into(), units, tolerance, source: source.into(), pockets: Vec::new() }
    }

    /// Adds a pocket with its axis and the level sets in use, in any order.
    pub fn add(&mut self, pocket: &Pocket, mat: &Mat, levels: &[Level]) {
        self.pockets.push(PocketPart::new(pocket, &mat.vertices(), &mat.edges(), levels));
    }

    /// The text, on one line.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("all keys are strings") + "\n"
    }
}

impl PocketPart {
    /// A pocket with its axis and the level sets in use, in any order.
    pub fn new(pocket: &Pocket, vertices: &[AxisVertex], edges: &[AxisEdge], levels: &[Level]) -> PocketPart {
        let mut offsets: Vec<Offset> = levels.iter().map(Offset::from).collect();
        offsets.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        PocketPart {
            boundary: pocket.loops().map(Loop::from).collect(),
            medial_axis: Axis {
                vertices: vertices.iter().map(Place::from).collect(),
                edges: edges.iter().map(Edge::from).collect(),
            },
            offsets,
        }
    }
}

impl From<&ArcSpline> for Loop {
    fn from(spline: &ArcSpline) -> Loop {
        Loop { vertices: spline.vertices.clone() }
    }
}

impl From<&ArcSpline> for Ridge {
    fn from(spline: &ArcSpline) -> Ridge {
        Ridge { vertices: spline.vertices.clone(), closed: spline.closed }
    }
}

impl From<&AxisVertex> for Place {
    fn from(v: &AxisVertex) -> Place {
        Place { x: v.disk.center.x, y: v.disk.center.y, r: v.disk.radius, kind: v.kind }
    }
}

impl From<&AxisEdge> for Edge {
    fn from(e: &AxisEdge) -> Edge {
        let curve = Conic { points: e.points, weight: e.weight };
        Edge { from: e.from, to: e.to, sites: e.sites, curve }
    }
}

impl From<&Level> for Offset {
    fn from(level: &Level) -> Offset {
        Offset {
            distance: level.distance,
            loops: level.loops.iter().map(Loop::from).collect(),
            ridges: level.ridges.iter().map(Ridge::from).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use crate::mat::{Disk, SiteKind};

    /// A slot of radius 1, its axis, and its levels at 0.5 and 1.
    fn slot() -> Document {
        let slot = |r: f64| ArcSpline::closed([(0.0, -r, 0.0), (3.0, -r, 1.0), (3.0, r, 0.0), (0.0, r, 1.0)]);
        let leaf =
            |x: f64| AxisVertex { disk: Disk { center: point(x, 0.0), radius: 1.0 }, kind: Kind::Leaf };
        let site = |element| SiteRef { loop_index: 0, element, kind: SiteKind::Segment };
        let edge = AxisEdge {
            from: 0,
            to: 1,
            sites: [site(2), site(0)],
            points: [point(0.0, 0.0), point(1.5, 0.0), point(3.0, 0.0)],
            weight: 1.0,
        };
        let ridge = ArcSpline::open([(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)]);
        let levels = [
            Level { distance: 1.0, loops: vec![], ridges: vec![ridge] },
            Level { distance: 0.5, loops: vec![slot(0.5)], ridges: vec![] },
        ];
        let pocket = Pocket::from_checked(slot(1.0), vec![]);
        let mut document = Document::new("slot.dxf", Units::Mm, 0.001);
        document.pockets.push(PocketPart::new(&pocket, &[leaf(0.0), leaf(3.0)], &[edge], &levels));
        document
    }

    #[test]
    fn a_document_has_the_agreed_form() {
        insta::assert_snapshot!(slot().to_json().replace("],\"", "],\n\""), @r#"
        {"format":"medial/1","units":"mm","tolerance":0.001,"source":"slot.dxf","pockets":[{"boundary":[{"vertices":[[0.0,-1.0,0.0],[3.0,-1.0,1.0],[3.0,1.0,0.0],[0.0,1.0,1.0]]}],
        "medial_axis":{"vertices":[{"x":0.0,"y":0.0,"r":1.0,"kind":"leaf"},{"x":3.0,"y":0.0,"r":1.0,"kind":"leaf"}],
        "edges":[{"from":0,"to":1,"sites":[{"loop":0,"element":2,"kind":"segment"},{"loop":0,"element":0,"kind":"segment"}],
        "curve":{"points":[[0.0,0.0],[1.5,0.0],[3.0,0.0]],
        "weight":1.0}}]},"offsets":[{"distance":0.5,"loops":[{"vertices":[[0.0,-0.5,0.0],[3.0,-0.5,1.0],[3.0,0.5,0.0],[0.0,0.5,1.0]]}],
        "ridges":[]},{"distance":1.0,"loops":[],
        "ridges":[{"vertices":[[0.0,0.0,0.0],[3.0,0.0,0.0]],
        "closed":false}]}]}]}
        "#);
    }

    #[test]
    fn every_number_reads_back_to_the_last_bit() {
        let mut document = slot();
        for (i, v) in document.pockets[0].boundary[0].vertices.iter_mut().enumerate() {
            v.point.x = (0.1 + i as f64).exp() * 1e-7;
            v.point.y = f64::from_bits(v.point.x.to_bits() + 1) * 1e12 / 3.0;
            v.bulge = -5e-324;
        }
        let back: Document = serde_json::from_str(&document.to_json()).unwrap();
        assert_eq!(back, document);
    }
}
