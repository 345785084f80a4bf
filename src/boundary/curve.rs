//! One curve of a drawing.

use crate::geom::{ArcSpline, Ellipse, Spline};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Where a curve comes from, for messages. Names are shared by all curves of a drawing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Kind of entity, as the format calls it.
    pub kind: Arc<str>,
    /// Handle of the entity, where the format has one.
    pub handle: Option<u64>,
    /// Layer it lies on.
    pub layer: Arc<str>,
}

/// One drawn curve: open or closed, in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Its shape. Closed when drawn as closed; an open one may still close by coincident ends.
    pub path: ArcSpline,
    /// Where it comes from.
    pub source: Source,
}

impl From<ArcSpline> for Curve {
    fn from(path: ArcSpline) -> Curve {
        Curve { path, source: Source::default() }
    }
}

/// A drawn curve that is no chain of segments and arcs, in job units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FreeCurve {
    /// Its shape.
    pub shape: FreeShape,
    /// Where it comes from.
    pub source: Source,
}

/// The shape of a [`FreeCurve`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FreeShape {
    /// An arc of an ellipse or all of it.
    Ellipse(Ellipse),
    /// A B-spline.
    Spline(Spline),
}
