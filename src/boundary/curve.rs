//! One curve of a drawing.

use crate::geom::ArcSpline;
use serde::{Deserialize, Serialize};

/// Where a curve comes from, for messages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Kind of entity, as the format calls it.
    pub kind: String,
    /// Handle of the entity, where the format has one.
    pub handle: Option<u64>,
    /// Layer it lies on.
    pub layer: String,
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
