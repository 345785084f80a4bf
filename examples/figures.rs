//! Draws the pictures of the documentation with the library itself.
//!
//!     cargo run --example figures
//!
//! Nothing in them depends on time or place; a test draws them again and compares.

use medial::io::dxf::{self, ReadOptions};
use medial::io::svg::Picture;
use medial::{ArcSpline, AxisEdge, Error, Job, Kind, Level, Mat, Pocket, Pockets, Units, point};
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    std::fs::create_dir_all(root().join("docs"))?;
    for (name, svg) in figures()? {
        std::fs::write(root().join("docs").join(name), svg)?;
        println!("docs/{name}");
    }
    Ok(())
}

/// Name and contents of every picture.
pub fn figures() -> Result<Vec<(&'static str, String)>, Error> {
    Ok(vec![
        ("keyhole.svg", keyhole()?),
        ("axis.svg", axis()?),
        ("nested.svg", nested()?),
        ("path.svg", path()?),
    ])
}

/// Boundary, axis and level sets, lying on its side.
fn keyhole() -> Result<String, Error> {
    let pockets: Vec<Pocket> = sample("keyhole.dxf")?.iter().map(on_its_side).collect::<Result<_, _>>()?;
    levels_and_axis(&pockets, 1.5)
}

/// Which contours are pockets and which are islands.
fn nested() -> Result<String, Error> {
    levels_and_axis(&sample("nested.dxf")?, 1.4)
}

/// Maximal disks: at the branches and the neck of an axis, and between them.
fn axis() -> Result<String, Error> {
    let pocket = Pocket::from_loops(
        vec![
            ArcSpline::closed([
                (0.0, 0.0, 0.0),
                (46.0, 0.0, 0.0),
                (46.0, 11.0, -0.45),
                (66.0, 11.0, 0.0),
                (66.0, 0.0, 0.0),
                (84.0, 0.0, 1.0),
                (84.0, 36.0, 0.0),
                (0.0, 36.0, 0.0),
            ]),
            ArcSpline::circle(point(20.0, 17.0), 7.0),
        ],
        Units::Mm.tolerance(),
    )?;
    let mat = pocket.medial_axis()?;
    let told = |kind| matches!(kind, Kind::Branch | Kind::Neck | Kind::Peak);
    let disks: Vec<ArcSpline> = mat
        .vertices()
        .iter()
        .filter(|v| told(v.kind))
        .map(|v| ArcSpline::circle(v.disk.center, v.disk.radius))
        .collect();
    let edges = mat.edges();
    let svg = Picture::new(Units::Mm).pockets([&pocket]).curves(&disks).axis(&edges).to_svg();
    Ok(svg.replace(">drawn<", ">disks<"))
}

/// The path of a tool round an island.
fn path() -> Result<String, Error> {
    let pockets = sample("rect-island.dxf")?;
    let mats = axes(&pockets)?;
    let path = Job::new(Units::Mm, 5.0, 2.0).path(&mats)?;
    Ok(Picture::new(Units::Mm).pockets(&pockets).path(&path.moves).to_svg())
}

/// Every pocket with its axis and its level sets at equal steps.
fn levels_and_axis(pockets: &[Pocket], step: f64) -> Result<String, Error> {
    let mats = axes(pockets)?;
    let job = Job::new(Units::Mm, 0.0, step);
    let levels: Vec<Vec<Level>> = mats.iter().map(|mat| job.levels(mat)).collect::<Result<_, _>>()?;
    let edges: Vec<AxisEdge> = mats.iter().flat_map(Mat::edges).collect();
    Ok(Picture::new(Units::Mm).pockets(pockets).levels(levels.iter().flatten()).axis(&edges).to_svg())
}

fn axes(pockets: &[Pocket]) -> Result<Vec<Mat>, Error> {
    pockets.iter().map(Pocket::medial_axis).collect()
}

fn on_its_side(pocket: &Pocket) -> Result<Pocket, Error> {
    let turned = pocket.loops().map(|l| l.mapped(false, |p| point(p.y, -p.x))).collect();
    Pocket::from_loops(turned, Units::Mm.tolerance())
}

fn sample(name: &str) -> Result<Vec<Pocket>, Error> {
    let drawing = dxf::read(&root().join("samples").join(name), &ReadOptions::default())?;
    Ok(Pockets::from_curves(&drawing.curves, drawing.units.tolerance())?.pockets)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}
