//! What is cut of a pocket besides its passes, and how wide.

use crate::geom::Point;
use serde::{Deserialize, Serialize};

/// What is cut of a pocket besides its passes, at all heights, and how wide. Lengths in job units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Amounts {
    /// Passes along parts of the axis, for what stands between levels more than half the tool apart;
    /// counted once for each height.
    pub crests: usize,
    /// Their length, the ways there and back included.
    pub crest_length: f64,
    /// Largest distance between neighboring passes, across the axis too; at most the tool diameter.
    pub largest_step: f64,
    /// A place halfway between two such passes.
    pub largest_step_at: Option<Point>,
    /// Length of cuts as wide as the tool: entries, first passes, the first side of narrow parts, and
    /// straight links. Measured on the axis, rather too long than too short.
    pub full_width_length: f64,
    /// Length of helices, ramps and plunges down into the stock.
    pub entry_length: f64,
    /// Length of links at depth, and of leads onto finishing passes and off them.
    pub link_length: f64,
    /// Links through stock instead of retracts, at all heights.
    pub slots: usize,
    /// Length of their parts that cut stock, as wide as the tool.
    pub slot_length: f64,
}
