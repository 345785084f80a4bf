//! Exact medial axes, offsets and tool paths for CNC pockets of lines and arcs.
//!
//! From closed loops of segments and circular arcs to the medial axis of what they bound, from the
//! axis to level sets of the distance to the wall, from level sets to the moves of a tool. Nothing is
//! flattened on the way: an arc that is drawn is an arc that is cut.
#![doc = ""]
#![doc = include_str!("../docs/axis.svg")]
#![doc = ""]
//! *A pocket with one island, its medial axis, and the largest disks at the branches, necks and
//! peaks of the axis.*
//!
//! # Words
//!
//! - A **pocket** ([`Pocket`]) is a region to clear: an outer loop and **islands** in it that are
//!   left standing.
//! - An **arc spline** ([`ArcSpline`]) is a chain of segments and circular arcs. Each [`Vertex`]
//!   holds the **bulge** of the element that leaves it: the tangent of a quarter of the swept angle,
//!   0 for a segment, 1 for a half circle to the left.
//! - A **maximal disk** ([`Disk`]) lies in the pocket and in no other such disk. The **medial axis**
//!   ([`Mat`]) is the set of the centers of all maximal disks; the **radius** of each is the distance
//!   of its center to the boundary. Edges of the axis are conics ([`AxisEdge`]), each between two
//!   **sites** of the boundary ([`SiteRef`]): segments, arcs or reflex corners.
//! - A **leaf** of the axis has one edge and a **branch** three or more; a **neck** is a smallest
//!   radius between two larger ones, and a **peak** a largest ([`Kind`]).
//! - The **level** at `d` ([`Level`]) is the boundary of the part of the pocket that is farther than
//!   `d` from the wall: closed loops, and **ridges** where the distance is `d` and nothing is
//!   farther, as in a slot exactly as wide as the tool.
//!
//! # Units and signs
//!
//! Lengths are in the unit of the job, [`Units`]; the algorithms know no unit and no smallest
//! length. Angles are radians, counter-clockwise; y points up. Curvature is positive on a left turn.
//! The interior is on the left of every loop: outer loops run counter-clockwise, islands clockwise,
//! and level sets as the walls that they follow.
//!
//! # Guarantees
//!
//! - Axis and levels deviate from exact ones by round-off in proportion to the extent of the
//!   coordinates. [`Mat::check`] measures the axis against its definition, [`verify::level`] judges
//!   levels without looking at the axis.
//! - The axis is connected and has one cycle for each island; the radius is monotone along each
//!   edge. Loops are closed to the last bit.
//! - A wish of the caller ([`Tolerance`]) decides what counts as a gap in a drawing, and nothing
//!   else. The result is the same for any number of threads, byte for byte.
//! - No input panics: faults of a drawing are values with their places ([`Defect`]), and what cannot
//!   be done is an [`Error`].
//!
//! **Not guaranteed**: exact arithmetic, as everything is calculated with `f64`; a pruned axis, as a
//! small bump in the drawing is a small branch here; that a machine follows, as posts, fixtures and
//! holders are unknown.
//!
//! # From loops to level sets
//!
//! ```
//! use medial::{ArcSpline, Pocket, Tolerance, point};
//!
//! let plate = ArcSpline::closed([(0.0, 0.0, 0.0), (60.0, 0.0, 0.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)]);
//! let boss = ArcSpline::circle(point(22.0, 20.0), 8.0);
//! let pocket = Pocket::from_loops(vec![plate, boss], Tolerance::MM)?;
//! let mat = pocket.medial_axis()?;
//! let neck = mat.narrowest_neck().expect("a pocket with an island has a neck");
//! assert!((neck.radius - 6.0).abs() < 1e-12);
//! let level = mat.level(3.0);
//! assert_eq!(level.loops.len(), 2);
//! assert!(medial::verify::level(pocket.loops(), 3.0, &level.loops).is_right());
//! # Ok::<(), medial::Error>(())
//! ```
//!
//! # From a drawing to a program
//!
//! With the feature `dxf`, which is on unless default features are turned off:
//!
//! ```
//! # #[cfg(feature = "dxf")] {
//! use medial::io::{dxf, gcode};
//! use medial::{Job, Pocket, Pockets};
//!
//! let drawing = dxf::read("samples/keyhole.dxf".as_ref(), &dxf::ReadOptions::default())?;
//! let Pockets { pockets, defects } = Pockets::from_curves(&drawing.curves, drawing.units.tolerance())?;
//! assert!(defects.is_empty());
//! let mats = pockets.iter().map(Pocket::medial_axis).collect::<Result<Vec<_>, _>>()?;
//! let path = Job::new(drawing.units, 6.0, 2.4).path(&mats)?;
//! let program = gcode::write(&path.moves, &gcode::Setup::new(drawing.units))?;
//! assert!(program.text.contains("G21"));
//! # }
//! # Ok::<(), medial::Error>(())
//! ```
//!
//! # Features
//!
//! On by default are `cli`, the binary `pocket`; `dxf`, which reads and writes drawings; and `verify`,
//! with which cavalier_contours is a second judge of offsets beside the exact one, which is always
//! there (see [`verify`](mod@verify)).
//!
//! `geo-types` and `cavalier-contours` add conversions from and to polygons of geo_types, flattened to
//! a tolerance, and polylines of cavalier_contours, bit for bit (see [`convert`]).

pub mod boundary;
pub mod convert;
pub mod error;
pub mod geom;
pub mod io;
pub mod mat;
pub mod offset;
pub mod tolerance;
pub mod toolpath;
pub mod verify;

pub use boundary::{Curve, FreeCurve, FreeShape, Pocket, Pockets, Source};
pub use error::{Defect, Error};
pub use geom::{ArcSpline, Bounds, Element, Ellipse, Point, Spline, Vector, Vertex, point, vector};
pub use mat::{
    AxisEdge, AxisVertex, Counts, Disk, Kind, Mat, Mismatch, Residuals, SiteKind, SiteRef, Stages,
};
pub use offset::{Exterior, Level, LevelSets, MergeTree, Part};
pub use tolerance::{Tolerance, Units};
pub use toolpath::{
    Direction, Entry, Job, Move, Moves, Order, Path, PocketPath, Point3, Rest, Start, Strategy, Totals,
};
pub use verify::{Comparison, Disagreement, DisagreementKind, Fault, FaultKind, LevelReport, Party};
