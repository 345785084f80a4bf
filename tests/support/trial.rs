//! Everything that must hold for the axis of a pocket: the certificate, maximal disks by brute force,
//! the same axis from the second builder, and that drawing the same pocket in other ways changes
//! nothing but coordinates.
#![allow(dead_code)]

use crate::agreement::disagreement;
use crate::alike::{self, Names};
use crate::brute::Brute;
use crate::shapes;
use medial::{ArcSpline, Mat, Pocket, Point, Tolerance, Vector, point};

/// What was measured, each relative to the size.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    pub sites: usize,
    /// Largest residual of the certificate.
    pub residual: f64,
    /// Largest deviation of brute-force disks from the axis and the other way round.
    pub brute: f64,
    /// Largest deviation of a vertex when the pocket is drawn in another way.
    pub alike: f64,
    /// The same for a pocket drawn a thousand sizes away, where coordinates have three digits less.
    pub far: f64,
    /// Sites of the pocket that both builders were given: without its islands, which are for one alone.
    pub divided: usize,
}

/// The figures of one random shape, or what is wrong with it.
pub fn run(kind: &str, size: usize, seed: u64) -> Result<Figures, String> {
    let loops = shapes::make(kind, size, seed);
    trial(&loops, seed).map_err(|e| format!("{kind} of {size} elements, seed {seed}: {e}"))
}

/// Brute-force disks to a shape, in either direction.
const DISKS: usize = 16;

/// The figures of one pocket.
pub fn trial(loops: &[ArcSpline], seed: u64) -> Result<Figures, String> {
    let (pocket, mat) = axis(loops, 1.0)?;
    let residuals = mat.check().map_err(|e| e.to_string())?;
    let mut figures = Figures {
        sites: mat.counts().sites,
        residual: residuals.empty.max(residuals.touch).max(residuals.monotone),
        brute: Brute::new(&pocket).deviation(&mat, seed, DISKS)?,
        divided: divided(loops, &mat).map_err(|e| format!("division: {e}"))?,
        ..Figures::default()
    };
    for way in &ways(&pocket) {
        let off = way.deviation(loops, &pocket, &mat).map_err(|e| format!("{}: {e}", way.name))?;
        let figure = if way.coarser > 1.0 { &mut figures.far } else { &mut figures.alike };
        *figure = figure.max(off);
    }
    Ok(figures)
}

/// Holds the second builder against the first; answers the number of sites.
fn divided(loops: &[ArcSpline], mat: &Mat) -> Result<usize, String> {
    let (pocket, outline) = axis(&loops[..1], 1.0)?;
    let mat = if loops.len() == 1 { mat } else { &outline };
    let other = pocket.medial_axis_by_division().map_err(|e| e.to_string())?;
    other.check().map_err(|e| e.to_string())?;
    disagreement(mat, &other).map_or(Ok(other.counts().sites), Err)
}

fn axis(loops: &[ArcSpline], scale: f64) -> Result<(Pocket, Mat), String> {
    let Tolerance { fit, join } = Tolerance::MM;
    let tolerance = Tolerance { fit: fit * scale, join: join * scale };
    let pocket = Pocket::from_loops(loops.to_vec(), tolerance).map_err(|e| e.to_string())?;
    let mat = pocket.medial_axis().map_err(|e| e.to_string())?;
    Ok((pocket, mat))
}

/// Another way to draw the same pocket.
struct Way {
    name: &'static str,
    place: Box<dyn Fn(Point) -> Point>,
    scale: f64,
    mirrored: bool,
    /// What to do with the loops besides.
    redrawn: fn(Vec<ArcSpline>) -> Vec<ArcSpline>,
    /// Digits that f64 holds less, as a factor; what is the same lies within that times [`SAME`].
    coarser: f64,
}

/// Vertices that close, relative to the size, are the same.
const SAME: f64 = 1e-9;

/// What a level may move by when coordinates are rounded anew, relative to the largest of them.
const LEVEL_ERROR: f64 = 64.0 * f64::EPSILON;

/// Sizes by which a pocket is moved far away.
const FAR: f64 = 1e3;

/// Sizes by which it is moved so far that a vertex where sites are nearly parallel may lie anywhere
/// near, and only the levels must be the same.
const FARTHEST: f64 = 1e6;

fn ways(pocket: &Pocket) -> Vec<Way> {
    let size = pocket.bounds().diagonal();
    let way = |name, scale, place: Box<dyn Fn(Point) -> Point>| Way {
        name,
        place,
        scale,
        mirrored: false,
        redrawn: |loops| loops,
        coarser: 1.0,
    };
    let same = || Box::new(|p| p);
    let scaled = |name, scale: f64| way(name, scale, Box::new(move |p| point(scale * p.x, scale * p.y)));
    let (sin, cos) = 37f64.to_radians().sin_cos();
    let turned = move |p: Point| {
        let v = p.to_vector().rotated(cos, sin);
        point(v.x, v.y)
    };
    let moved = |name, sizes: f64| {
        let by = Vector { x: sizes * size, y: -0.7 * sizes * size };
        Way { coarser: sizes, ..way(name, 1.0, Box::new(move |p| p + by)) }
    };
    vec![
        Way { redrawn: reversed, ..way("reversed", 1.0, same()) },
        Way { redrawn: restarted, ..way("another start", 1.0, same()) },
        Way { mirrored: true, ..way("mirrored", 1.0, Box::new(|p| point(-p.x, p.y))) },
        way("turned", 1.0, Box::new(turned)),
        scaled("small", 1e-3),
        scaled("large", 1e3),
        moved("moved", 1.0),
        moved("far away", FAR),
        moved("farthest away", FARTHEST),
    ]
}

/// Islands first, and all loops backward.
fn reversed(loops: Vec<ArcSpline>) -> Vec<ArcSpline> {
    loops.iter().rev().map(ArcSpline::reversed).collect()
}

/// Every loop begins a third of its vertices later.
fn restarted(mut loops: Vec<ArcSpline>) -> Vec<ArcSpline> {
    for spline in &mut loops {
        let n = spline.vertices.len();
        spline.vertices.rotate_left((n / 3 + 1) % n);
    }
    loops
}

impl Way {
    /// How far the axis of a pocket drawn this way is from the axis as it was, relative to the size.
    fn deviation(&self, loops: &[ArcSpline], pocket: &Pocket, mat: &Mat) -> Result<f64, String> {
        let drawn = loops.iter().map(|l| l.mapped(self.mirrored, &self.place)).collect();
        let (there, other) = axis(&(self.redrawn)(drawn), self.scale)?;
        other.check().map_err(|e| e.to_string())?;
        let size = self.scale * pocket.bounds().diagonal();
        let within = self.coarser * SAME * size;
        self.levels_alike(pocket, mat, &other)?;
        if self.coarser >= FARTHEST {
            return Ok(0.0);
        }
        let names = Names::between(pocket, &there, &self.place, within)
            .ok_or_else(|| String::from("the loops are not the same"))?;
        let map = alike::Map { place: &self.place, scale: self.scale, site: &|s| names.of(s) };
        Ok(alike::deviation(mat, &other, &map, within)? / size)
    }

    /// Levels are as many loops of the same length around the same area.
    fn levels_alike(&self, pocket: &Pocket, mat: &Mat, other: &Mat) -> Result<(), String> {
        let radius = mat.largest_disk().radius;
        let within = (self.coarser * LEVEL_ERROR).max(SAME) * self.scale * pocket.bounds().diagonal();
        for fraction in [0.0713, 0.3171, 0.7317] {
            let d = fraction * radius;
            let (a, b) = (mat.level(d).loops, other.level(self.scale * d).loops);
            let length = |loops: &[ArcSpline]| loops.iter().map(ArcSpline::length).sum::<f64>();
            let area = |loops: &[ArcSpline]| loops.iter().map(ArcSpline::area).sum::<f64>();
            let (la, lb) = (self.scale * length(&a), length(&b));
            let (aa, ab) = (self.scale * self.scale * area(&a), area(&b));
            // An offset that moves by e has an area that changes by its length times e.
            let same_area = (aa - ab).abs() <= within * la.max(lb);
            let count = a.iter().chain(&b).map(ArcSpline::len).sum::<usize>();
            let same_length = (la - lb).abs() <= within * count as f64;
            if !(same_area && same_length && a.len() == b.len()) {
                return Err(format!(
                    "level {d}: {} loops of length {la}, area {aa} became {}, {lb}, {ab}",
                    a.len(),
                    b.len()
                ));
            }
        }
        Ok(())
    }
}
