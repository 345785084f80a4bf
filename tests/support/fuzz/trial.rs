//! Everything from the bytes of a file to a program for the machine, held against what must be so.

use super::chance::Chance;
use medial::io::dxf::{Origin, ReadOptions, read_bytes};
use medial::io::gcode;
use medial::{ArcSpline, Direction, Entry, Error, Job, Mat, Pocket, Pockets, Start, Units, verify};

/// Larger drawings are left out, so that trials are fast.
const MAX_ELEMENTS: usize = 600;

/// Axes and paths of more pockets than these are not looked at.
const MAX_POCKETS: usize = 6;

/// Levels nearer to the wall than this many times the round-off are not judged: the judge has to step
/// aside of them by more than that.
const NEAR_ROUND_OFF: f64 = 64.0;

/// How far a trial came.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Curves read.
    pub curves: usize,
    /// Pockets with an axis.
    pub pockets: usize,
    /// Levels judged.
    pub levels: usize,
    /// Moves planned.
    pub moves: usize,
}

/// Runs a file through everything.
///
/// # Errors
/// What is wrong; its first word is the kind.
pub fn run(bytes: &[u8], seed: u64) -> Result<Figures, String> {
    let mut chance = Chance(seed);
    let options = ReadOptions {
        hatch: chance.once_in(2),
        hidden: chance.once_in(4),
        origin: chance.of(&[Origin::Dxf, Origin::Dxf, Origin::Min, Origin::Center]),
        ..ReadOptions::default()
    };
    let mut figures = Figures::default();
    let drawing = match read_bytes(bytes, "trial", &options) {
        Err(Error::NotADrawing { .. } | Error::Unit { .. } | Error::Effort { .. }) => return Ok(figures),
        other => other.map_err(|e| format!("read: {e}"))?,
    };
    figures.curves = drawing.curves.len();
    if drawing.curves.iter().any(|c| !sound(&c.path)) {
        return Err("curve with a coordinate that is no number".into());
    }
    if drawing.curves.iter().map(|c| c.path.vertices.len()).sum::<usize>() > MAX_ELEMENTS {
        return Ok(figures);
    }
    let tolerance = drawing.units.tolerance();
    let depth = usize::from(chance.once_in(8));
    let found = match Pockets::from_curves_at_depth(&drawing.curves, tolerance, depth) {
        Err(Error::Effort { .. }) => return Ok(figures),
        other => other.map_err(|e| format!("pockets: {e}"))?,
    };
    if let Some(defect) = found.defects.iter().find(|d| !d.at().is_finite()) {
        return Err(format!("defect nowhere: {defect}"));
    }
    let mut mats = Vec::new();
    for pocket in found.pockets.iter().take(MAX_POCKETS) {
        mats.push(axis(pocket, tolerance)?);
        figures.levels += levels(pocket, mats.last().expect("one"), &mut chance)?;
    }
    figures.pockets = mats.len();
    figures.moves = program(&mats, drawing.units, &mut chance)?;
    Ok(figures)
}

fn sound(path: &ArcSpline) -> bool {
    path.vertices.iter().all(|v| v.point.is_finite() && v.bulge.is_finite())
}

/// The axis of a pocket that is what it says.
fn axis(pocket: &Pocket, tolerance: medial::Tolerance) -> Result<Mat, String> {
    if !pocket.loops().all(sound) || pocket.loops().any(|l| !l.closed || l.len() < 2) {
        return Err(format!("pocket that is none: {pocket:?}"));
    }
    if pocket.loops().flat_map(ArcSpline::elements).any(|e| e.start == e.end) {
        return Err("pocket with an element of length 0".into());
    }
    if !(pocket.area() > 0.0
        && pocket.outer().area() > 0.0
        && pocket.islands().iter().all(|i| i.area() < 0.0))
    {
        return Err(format!("pocket of area {}, wall {}", pocket.area(), pocket.outer().area()));
    }
    let again = Pocket::from_loops(pocket.loops().cloned().collect(), tolerance);
    if let Err(e) = again {
        return Err(format!("pocket refused when it comes again: {e}"));
    }
    let mat = pocket.medial_axis().map_err(|e| format!("axis: {e}"))?;
    mat.check().map_err(|e| format!("check: {e}"))?;
    Ok(mat)
}

/// Judges levels; answers how many.
fn levels(pocket: &Pocket, mat: &Mat, chance: &mut Chance) -> Result<usize, String> {
    let largest = mat.largest_disk().radius;
    let distances = [0.03 * largest, chance.share() * largest, chance.share() * largest, 0.9 * largest];
    for d in distances {
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
        let report = verify::level(pocket.loops(), d, &all);
        if !report.is_right() && d > NEAR_ROUND_OFF * report.within {
            let faults = &report.faults[..report.faults.len().min(2)];
            let first = faults.first().map(|f| f.kind);
            return Err(format!("level {first:?} at {d} of {largest}, within {}: {faults:?}", report.within));
        }
    }
    Ok(distances.len())
}

/// Plans a path and writes it; answers its moves.
fn program(mats: &[Mat], units: Units, chance: &mut Chance) -> Result<usize, String> {
    if mats.is_empty() {
        return Ok(0);
    }
    // A tool for the largest pocket: one for the smallest would go around there for hours.
    let largest = mats.iter().map(|m| m.largest_disk().radius).fold(0.0, f64::max);
    let tool = largest * chance.of(&[0.2, 0.6, 1.0, 1.9, 2.0]);
    let mut job = Job::new(units, tool, tool * chance.of(&[0.2, 0.4, 1.0]));
    job.depth = tool;
    job.direction = chance.of(&[Direction::Climb, Direction::Conventional]);
    job.start = chance.of(&[Start::Inside, Start::Outside]);
    job.entry = chance.of(&[Entry::Helix, Entry::Ramp, Entry::Plunge]);
    job.finish = if chance.once_in(4) { 0.1 * job.step } else { 0.0 };
    let path = match job.path(mats) {
        Err(Error::Effort { .. } | Error::NothingToMachine { .. } | Error::Parameter { .. }) => return Ok(0),
        other => other.map_err(|e| format!("path: {e}"))?,
    };
    let written = match gcode::write(&path.moves, &gcode::Setup::new(units)) {
        Err(Error::Parameter { .. }) => return Ok(path.moves.len()),
        other => other.map_err(|e| format!("program: {e}"))?,
    };
    let bad = written
        .text
        .lines()
        .find(|l| l.len() > 80 || !l.is_ascii() || l.contains("NaN") || l.contains("inf"));
    match bad {
        Some(line) => Err(format!("program with the line {line}")),
        None => Ok(path.moves.len()),
    }
}
