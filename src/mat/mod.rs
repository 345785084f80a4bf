//! Medial axis transform of a [`Pocket`]: the centers of all maximal disks, with their radii.
//!
//! **Needs** a pocket of segments and arcs as [`Pocket`] describes it.
//! **Guarantees** a connected graph with one cycle per island (in parts where islands divide the
//! pocket); both footpoints of every disk, and nothing of the boundary inside it, to round-off of the
//! size ([`Mat::check`] measures it); a radius that is monotone along every edge; the same bytes for
//! any number of threads.
//! **Does not** prune: a small bump in the drawing is a small branch here.
//!
//! **Method**, the *contact lamination*: maximal disks at all joints of the boundary, one more for
//! each hole (`sites`, `shot`); their chords, which do not cross (`apart`), cut the pocket into faces
//! (`lamination`); a face of two pieces is an edge, larger ones are divided by branch disks (`face`);
//! edges without length are contracted and the others split where the radius has an extremum (`graph`).
//! Levels follow the boundary in the order of memory (`circuit`), arc by arc (`leg`).
//!
//! After Aichholzer, Aigner, Aurenhammer, Hackl, Juettler, Rabl: *Medial axis computation for planar
//! free-form shapes*, Computer-Aided Design 41 (2009), whose recursion it unrolls.
//!
//! [`Pocket`]: crate::Pocket

mod above;
mod apart;
mod bvh;
mod check;
mod circuit;
mod cocircular;
mod conic;
mod contacts;
mod division;
mod face;
mod frame;
mod graph;
mod hilbert;
mod joints;
mod kinds;
mod lamination;
mod leg;
mod low;
mod parts;
mod patch;
mod piece;
mod query;
mod radii;
mod root;
mod shot;
mod site;
mod sites;
mod splice;
mod stages;
#[cfg(test)]
mod tests;
mod ties;
mod touch;
mod track;
mod transform;
mod union;
mod vertex;

pub use check::Residuals;
pub use stages::Stages;
pub use transform::{Counts, Mat, Mismatch};
pub use vertex::{AxisEdge, AxisVertex, Disk, Kind, SiteKind, SiteRef};

pub(crate) use circuit::{Circuit, Ring, Stop, Way};
pub(crate) use leg::{After, Leg, bulge_of};
pub(crate) use root::falling_root;
pub(crate) use site::{Foot, NONE, Site};
pub(crate) use track::Track;
pub(crate) use union::Sets;
