//! What of a drawing to read, and how: options that all commands share.

use crate::failure::Failure;
use crate::length::{Length, above_0, at_least_0, number_above_0};
use clap::{Args, ValueEnum};
use medial::io::dxf::{Color, FitTolerance, Origin, ReadOptions};
use medial::{Tolerance, Units};

/// Options of the drawing.
#[derive(Debug, Args)]
pub struct Reading {
    /// Unit of the job [default: in for a drawing in inches, else mm]
    #[arg(long, value_enum, value_name = "UNIT", help_heading = "Drawing")]
    pub units: Option<UnitsArg>,

    /// Unit of the drawing, whatever it claims
    #[arg(long, value_name = "UNIT", help_heading = "Drawing")]
    pub dxf_units: Option<String>,

    /// Factor for all coordinates of the drawing
    #[arg(long, value_name = "FACTOR", value_parser = number_above_0, default_value = "1", help_heading = "Drawing")]
    pub scale: f64,

    /// Where the origin lies: as drawn, or at the lower left corner or the center of all curves
    ///
    /// Everything that is written, and every place in the report, is told from there.
    #[arg(long, value_enum, default_value_t, help_heading = "Drawing")]
    pub origin: OriginArg,

    /// Largest distance between drawn curve and arc spline [default: 0.001 mm, 0.00004 in]
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Drawing")]
    pub tolerance: Option<Length>,

    /// Turn runs of chords of polylines into arcs within this distance [default: off]
    ///
    /// For drawings of programs that write curves as hundreds of tiny chords. Every chord replaced is
    /// within the distance of its arcs, by a proof; corners stay corners.
    #[arg(long, value_name = "LENGTH", value_parser = above_0, help_heading = "Drawing")]
    pub fit: Option<Length>,

    /// Largest gap closed between ends [default: 0.01 mm, 0.0004 in]
    #[arg(long, value_name = "LENGTH", value_parser = at_least_0, help_heading = "Drawing")]
    pub join: Option<Length>,

    /// Take the outermost contour for the outline of the part: pockets begin inside it
    ///
    /// The same as --from-depth 1.
    #[arg(long, conflicts_with = "from_depth", help_heading = "Drawing")]
    pub skip_outer: bool,

    /// Number of contours around a pocket: 0 for the outermost contours, 1 for those in them ...
    #[arg(long, value_name = "N", default_value_t = 0, help_heading = "Drawing")]
    pub from_depth: usize,

    /// Layer to read, * for anything; repeatable [default: all visible]
    #[arg(long = "layer", value_name = "NAME", help_heading = "Drawing")]
    pub layers: Vec<String>,

    /// Layer to leave out, * for anything; repeatable
    #[arg(long = "skip-layer", value_name = "NAME", help_heading = "Drawing")]
    pub skip_layers: Vec<String>,

    /// Color to read, a number of the AutoCAD index or red, yellow, green ...; repeatable [default: all]
    ///
    /// An entity that has the color of its layer or its block counts with that.
    #[arg(long = "color", value_name = "COLOR", help_heading = "Drawing")]
    pub colors: Vec<Color>,

    /// Read layers that are off or frozen too
    #[arg(long, help_heading = "Drawing")]
    pub hidden: bool,

    /// Read the boundaries of hatched areas too
    #[arg(long, help_heading = "Drawing")]
    pub hatch: bool,
}

/// `--units`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum UnitsArg {
    Mm,
    In,
}

/// `--origin`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum OriginArg {
    #[default]
    Dxf,
    Min,
    Center,
}

impl Reading {
    /// For the reader.
    pub fn options(&self) -> Result<ReadOptions, Failure> {
        let dxf_units = match &self.dxf_units {
            None => None,
            Some(name) => Some(name.parse().map_err(|reason| {
                Failure::usage(format!("--dxf-units: {reason}"), "write mm, cm, m, in, ft, mil ...")
            })?),
        };
        Ok(ReadOptions {
            units: self.units.map(|u| match u {
                UnitsArg::Mm => Units::Mm,
                UnitsArg::In => Units::Inch,
            }),
            dxf_units,
            scale: self.scale,
            layers: self.layers.clone(),
            skip_layers: self.skip_layers.clone(),
            colors: self.colors.clone(),
            hidden: self.hidden,
            hatch: self.hatch,
            origin: match self.origin {
                OriginArg::Dxf => Origin::Dxf,
                OriginArg::Min => Origin::Min,
                OriginArg::Center => Origin::Center,
            },
            fit: FitTolerance { mm: self.tolerance(Units::Mm).fit, inch: self.tolerance(Units::Inch).fit },
            chords: self.fit.map(|l| FitTolerance { mm: l.to(Units::Mm), inch: l.to(Units::Inch) }),
        })
    }

    /// Nesting depth at which pockets begin.
    pub fn depth_of_pockets(&self) -> usize {
        if self.skip_outer { 1 } else { self.from_depth }
    }

    /// Lengths that the user may choose.
    pub fn tolerance(&self, units: Units) -> Tolerance {
        let default = units.tolerance();
        let or = |length: Option<Length>, default: f64| length.map_or(default, |l| l.to(units));
        Tolerance { fit: or(self.tolerance, default.fit), join: or(self.join, default.join) }
    }
}
