//! The layers of a written drawing.

/// What a layer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// Outlines of pockets and islands.
    Boundary,
    /// The medial axes.
    MedialAxis,
    /// Level sets.
    Offsets,
    /// Cuts at a constant height.
    Toolpath,
    /// Ways down into the stock: ramps, helices, plunges.
    Entry,
    /// Rapids.
    Rapid,
}

impl Layer {
    /// In the order of the table.
    pub const ALL: [Layer; 6] =
        [Layer::Boundary, Layer::MedialAxis, Layer::Offsets, Layer::Toolpath, Layer::Entry, Layer::Rapid];

    /// As drawing programs show it.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Boundary => "BOUNDARY",
            Layer::MedialAxis => "MEDIAL_AXIS",
            Layer::Offsets => "OFFSETS",
            Layer::Toolpath => "TOOLPATH",
            Layer::Entry => "TOOLPATH_ENTRY",
            Layer::Rapid => "TOOLPATH_RAPID",
        }
    }

    /// Color number (ACI): black or white as the ground asks for, magenta, cyan, and for the path
    /// a blue, an orange and a gray that read on light and dark ground.
    pub fn color(self) -> i64 {
        match self {
            Layer::Boundary => 7,
            Layer::MedialAxis => 6,
            Layer::Offsets => 4,
            Layer::Toolpath => 150,
            Layer::Entry => 30,
            Layer::Rapid => 8,
        }
    }
}
