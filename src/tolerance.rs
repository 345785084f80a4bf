//! The lengths that the user may choose.

use serde::{Deserialize, Serialize};

/// Lengths that are wishes of the user, in job units. Everything else that looks like a tolerance
/// in this crate is a derived bound on round-off or a limit on effort.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Largest distance between a drawn curve and the arc spline that stands for it. Lines and
    /// arcs are kept as drawn.
    pub fit: f64,
    /// Largest gap between drawn ends that is closed; both ends move to the middle. It mends
    /// noise of the drawing and is used nowhere else.
    pub join: f64,
}

impl Tolerance {
    /// The defaults of a job in millimeters.
    pub const MM: Tolerance = Tolerance { fit: 0.001, join: 0.01 };
    /// The defaults of a job in inches.
    pub const INCH: Tolerance = Tolerance { fit: 0.000_04, join: 0.000_4 };
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance::MM
    }
}

/// Unit of all lengths of a job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Millimeters.
    #[default]
    #[serde(rename = "mm")]
    Mm,
    /// Inches.
    #[serde(rename = "in")]
    Inch,
}
