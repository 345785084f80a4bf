//! From the drawing to the path, stage by stage.

use crate::args::Args;
use crate::failure::Failure;
use crate::notice::Notice;
use crate::outputs::Outputs;
use crate::progress::Progress;
use crate::timings::{Timings, timed};
use medial::io::dxf::{self, Drawing, Sheet};
use medial::io::json::Document;
use medial::io::svg::Picture;
use medial::toolpath::{Job, Path};
use medial::{Error, Mat, Mismatch, Pocket, Pockets, Tolerance};
use rayon::prelude::*;
use std::io;

/// All that is known when the work is done.
pub struct Plan {
    pub source: String,
    pub job: Job,
    pub tolerance: Tolerance,
    pub pockets: Vec<Pocket>,
    pub mats: Vec<Mat>,
    pub path: Path,
    pub notices: Vec<Notice>,
}

impl Plan {
    /// Reads, chains, builds the axes, plans. What is known by then is printed before an error.
    pub fn new(
        args: &Args,
        outputs: &Outputs,
        progress: &Progress,
        timings: &mut Timings,
    ) -> Result<Plan, Failure> {
        let mut notices = Vec::new();
        Plan::with_notices(args, outputs, progress, timings, &mut notices).inspect_err(|_| {
            progress.clear();
            if !args.quiet {
                Notice::print_all(&notices);
            }
        })
    }

    fn with_notices(
        args: &Args,
        outputs: &Outputs,
        progress: &Progress,
        timings: &mut Timings,
        notices: &mut Vec<Notice>,
    ) -> Result<Plan, Failure> {
        progress.stage("reading");
        let options = args.reading.options()?;
        let drawing = timed(&mut timings.read, || dxf::read(&args.drawing, &options))?;
        timings.take_fit(drawing.fitted.time);
        notices.extend(drawing.warnings.iter().map(Notice::from));
        let job = args.job(drawing.units)?;
        let tolerance = args.reading.tolerance(drawing.units);
        progress.stage("chaining");
        let from_depth = args.reading.depth_of_pockets();
        let pockets = pockets(&drawing, tolerance, from_depth, timings, notices)
            .map_err(|failure| failure.or_inspect(&args.drawing))?;
        progress.stage("medial axis");
        let least = outputs.is_program_alone(args).then(|| job.wall_distance());
        let (pockets, mats) = timed(&mut timings.axis, || axes(pockets, least))?;
        progress.stage("offsets");
        let levels = timed(&mut timings.offsets, || {
            let levels = |mat: &Mat| certified(mat, tolerance).and_then(|mat| job.levels(mat));
            // All at once, and of errors always the first.
            let all: Vec<_> = mats.par_iter().map(levels).collect();
            all.into_iter().collect::<Result<Vec<_>, _>>()
        })?;
        progress.stage("tool path");
        let path = timed(&mut timings.path, || job.path_along(&mats, levels))?;
        notices.extend(path.warnings.iter().map(Notice::from));
        count(&mats, &path, timings);
        let notices = std::mem::take(notices);
        Ok(Plan { source: drawing.name, job, tolerance, pockets, mats, path, notices })
    }

    /// The document for CAM software.
    pub fn document(&self) -> Document {
        let mut document = Document::new(&self.source, self.job.units, self.tolerance.fit);
        for ((pocket, mat), path) in self.pockets.iter().zip(&self.mats).zip(&self.path.pockets) {
            document.add(pocket, mat, &path.levels);
        }
        document
    }

    /// The drawing of everything, as DXF.
    pub fn drawing(&self) -> io::Result<Vec<u8>> {
        let edges: Vec<_> = self.mats.iter().flat_map(Mat::edges).collect();
        let sheet = Sheet::new(self.job.units)
            .pockets(&self.pockets)
            .axis(&edges)
            .levels(self.path.pockets.iter().flat_map(|p| &p.levels))
            .path(&self.path.moves, self.tolerance.fit);
        let mut text = Vec::new();
        sheet.write(&mut text)?;
        Ok(text)
    }

    /// The picture of everything, as SVG.
    pub fn picture(&self) -> String {
        let edges: Vec<_> = self.mats.iter().flat_map(Mat::edges).collect();
        Picture::new(self.job.units)
            .title(&self.source)
            .pockets(&self.pockets)
            .levels(self.path.pockets.iter().flat_map(|p| &p.levels))
            .axis(&edges)
            .path(&self.path.moves)
            .to_svg()
    }
}

/// The axes of all pockets; where only a radius is asked for, those of the pockets in which a disk of it fits, and no
/// more of them than is needed. Where it fits nowhere, whole axes tell what does.
fn axes(pockets: Vec<Pocket>, least: Option<f64>) -> Result<(Vec<Pocket>, Vec<Mat>), Error> {
    if let Some(least) = least {
        let above: Vec<Option<Mat>> =
            pockets.iter().map(|pocket| pocket.medial_axis_above(least)).collect::<Result<_, _>>()?;
        if above.iter().any(Option::is_some) {
            let both = pockets.into_iter().zip(above);
            return Ok(both.filter_map(|(pocket, mat)| Some((pocket, mat?))).unzip());
        }
    }
    let mats = pockets.iter().map(Pocket::medial_axis).collect::<Result<_, _>>()?;
    Ok((pockets, mats))
}

/// An axis, unless it does not keep the tolerance: no program is better than one that cuts elsewhere.
fn certified(mat: &Mat, tolerance: Tolerance) -> Result<&Mat, Error> {
    let internal = |fault: Mismatch| {
        let at = match fault {
            Mismatch::Boundary { at } | Mismatch::Residual { at, .. } => at,
            _ => mat.largest_disk().center,
        };
        Error::Internal { what: fault.to_string(), at }
    };
    mat.check_within(tolerance.fit).map(|_| mat).map_err(internal)
}

fn pockets(
    drawing: &Drawing,
    tolerance: Tolerance,
    from_depth: usize,
    timings: &mut Timings,
    notices: &mut Vec<Notice>,
) -> Result<Vec<Pocket>, Failure> {
    let found =
        timed(&mut timings.chain, || Pockets::from_curves_at_depth(&drawing.curves, tolerance, from_depth))?;
    notices.extend(found.defects.iter().map(Notice::from));
    if from_depth == 0 {
        notices.extend(found.lone_outline().map(Notice::outline_of_part));
    }
    if found.pockets.is_empty() {
        let reason = nothing(drawing.curves.is_empty(), found.defects.is_empty(), from_depth);
        return Err(Error::NothingToMachine { reason }.into());
    }
    Ok(found.pockets)
}

/// Why there is no pocket.
pub fn nothing(no_curve: bool, no_defect: bool, from_depth: usize) -> String {
    let reason = match (no_curve, no_defect) {
        (true, _) => "the drawing holds no curve that is read",
        (false, _) if from_depth > 0 => {
            return format!("no good contour of the drawing lies inside {from_depth} others");
        }
        (false, true) => "no contour of the drawing is closed",
        (false, false) => "no contour of the drawing is closed and free of crossings",
    };
    reason.to_owned()
}

fn count(mats: &[Mat], path: &Path, timings: &mut Timings) {
    for counts in mats.iter().map(Mat::counts) {
        timings.sites += counts.sites;
        timings.vertices += counts.vertices;
        timings.edges += counts.edges;
    }
    let levels = path.pockets.iter().flat_map(|p| &p.levels);
    timings.loops = levels.map(|l| l.loops.len() + l.ridges.len()).sum();
}
