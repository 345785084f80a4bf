//! Free-form curves and the arc splines that stand for them.
//!
//! **Needs** a spline or an ellipse in job units ([`Nurbs`], [`EllipseArc`]) and a tolerance.
//! **Guarantees** a chain of segments and arcs within the tolerance of the curve, both ways, to
//! round-off ([`Fit::bound`]); joints are smooth where the curve is, to the round-off of stored places;
//! straight and round pieces come out as one segment or arc. The curvature of the arcs has its extrema
//! where the curve has its apices, so that the medial axis gets no leaf that the drawing does not have. The curve
//! backwards, in other pieces, of a higher degree, with another parameter, moved, turned, scaled or mirrored has the
//! same arcs to round-off, but for numbers of arcs where round-off decides what fits.
//! **Does not** reach the least possible number of arcs, and turns within a small part of the tolerance
//! may come out as corners.
//!
//! **Method.** The curve becomes rational Bezier pieces. Roots of Bernstein forms, isolated with
//! certainty, cut it at corners, cusps, jumps and extrema of the curvature. One arc is laid over every
//! apex, and biarcs between as densely as the derivative of the curvature says, which makes their errors
//! nearly equal; their tangents are turned a little from those of the curve so that errors are least. Where a
//! few arcs will do, these are searched for together with the ends of the arcs over apices. Each
//! is proven by bounds of a polynomial in the frame of its chord. Schemes of Aichholzer et al., *Medial axis computation for planar free-form shapes*, 2009
//! (S0 in the modules), section 2, stay for comparison ([`Scheme`]).
//!
//! ```
//! use medial::boundary::freeform::EllipseArc;
//! use medial::{point, vector};
//!
//! let ellipse = EllipseArc::new(point(0.0, 0.0), vector(20.0, 0.0), 0.5, 0.0, 0.0)?;
//! let fit = ellipse.to_arcs(0.001)?;
//! assert!(fit.path.closed && fit.bound <= 0.001);
//! assert_eq!(fit.cuts.apices, 4);
//! # Ok::<(), medial::boundary::freeform::CurveError>(())
//! ```

mod apex;
mod bernstein;
mod biarc;
mod bound;
mod chain;
mod changes;
mod chords;
mod cuts;
mod density;
mod drawn;
mod ellipse;
mod error;
mod features;
mod few;
mod fit;
mod interpolate;
mod layout;
mod nurbs;
mod order;
mod piece;
mod pieces;
mod plan;
mod roots;
mod run;
mod short;
mod spiral;
mod spread;
mod squares;
mod track;

pub use ellipse::EllipseArc;
pub use error::CurveError;
pub use fit::{Cuts, Fit};
pub use nurbs::Nurbs;
pub use spiral::Scheme;
