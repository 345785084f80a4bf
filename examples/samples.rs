//! Writes the drawings of `samples/`. Each states its point in its first lines.
//!
//!     cargo run --example samples
//!
//! Text DXF R12 with polylines, which every drawing program opens. Nothing in it depends on time
//! or place: the files are always the same, byte for byte.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    std::fs::create_dir_all(&folder)?;
    for (name, text) in files() {
        std::fs::write(folder.join(name), text)?;
        println!("samples/{name}");
    }
    Ok(())
}

/// Name and contents of every sample.
pub fn files() -> Vec<(&'static str, String)> {
    vec![
        ("rect-island.dxf", rect_island()),
        ("slot.dxf", slot()),
        ("keyhole.dxf", keyhole()),
        ("gear.dxf", gear()),
        ("h-neck.dxf", h_neck()),
        ("nested.dxf", nested()),
        ("plate21.dxf", plate21()),
        ("sharp.dxf", sharp()),
        ("loose.dxf", loose()),
        ("inch.dxf", inch()),
    ]
}

fn rect_island() -> String {
    let mut dxf = Dxf::new("Rectangle with a round island: segments and parabolas in one axis.", Unit::Mm);
    dxf.polyline(&rectangle(0.0, 0.0, 80.0, 50.0));
    dxf.circle(48.0, 22.0, 12.0);
    dxf.finish()
}

fn slot() -> String {
    let mut dxf = Dxf::new(
        "Slot of constant width 12: the axis is one segment, and at distance 6 the level is that segment.",
        Unit::Mm,
    );
    dxf.polyline(&[(6.0, 0.0, 0.0), (54.0, 0.0, 1.0), (54.0, 12.0, 0.0), (6.0, 12.0, 1.0)]);
    dxf.finish()
}

/// The walls of the slot meet the head in the right triangle 7, 24, 25.
fn keyhole() -> String {
    let mut dxf = Dxf::new(
        "Keyhole of loose lines and arcs that meet in their ends, with a round island in its head.",
        Unit::Mm,
    );
    let from_below = 7.0_f64.atan2(24.0).to_degrees();
    dxf.arc((40.0, 60.0), 25.0, 270.0 + from_below, 270.0 - from_below);
    dxf.line((33.0, 36.0), (33.0, 14.0));
    dxf.arc((40.0, 14.0), 7.0, 180.0, 360.0);
    dxf.line((47.0, 36.0), (47.0, 14.0));
    dxf.circle(40.0, 60.0, 8.0);
    dxf.finish()
}

fn gear() -> String {
    const TEETH: usize = 20;
    let (tip, root) = (44.0, 36.0);
    let mut dxf = Dxf::new("Gear of twenty equal teeth: an axis with a branch of degree twenty.", Unit::Mm);
    let pitch = TAU / TEETH as f64;
    let arc = |part: f64| (0.25 * part * pitch).tan();
    let mut outline = Vec::new();
    for tooth in 0..TEETH {
        let at = |radius: f64, part: f64, bulge: f64| {
            let angle = (tooth as f64 + part) * pitch;
            (50.0 + radius * angle.cos(), 50.0 + radius * angle.sin(), bulge)
        };
        // Tip over 0.3 of the pitch, flank, root over 0.4, flank.
        outline.extend([
            at(tip, 0.0, arc(0.3)),
            at(tip, 0.3, 0.0),
            at(root, 0.45, arc(0.4)),
            at(root, 0.85, 0.0),
        ]);
    }
    dxf.polyline(&outline);
    dxf.finish()
}

fn h_neck() -> String {
    let mut dxf = Dxf::new(
        "H whose crossbar narrows to a neck of width 6: beyond distance 3 the levels fall in two.",
        Unit::Mm,
    );
    dxf.polyline(&[
        (0.0, 0.0, 0.0),
        (20.0, 0.0, 0.0),
        // A bulge of 0.2 over a chord of 30 is 3 high.
        (20.0, 24.0, -0.2),
        (50.0, 24.0, 0.0),
        (50.0, 0.0, 0.0),
        (70.0, 0.0, 0.0),
        (70.0, 60.0, 0.0),
        (50.0, 60.0, 0.0),
        (50.0, 36.0, -0.2),
        (20.0, 36.0, 0.0),
        (20.0, 60.0, 0.0),
        (0.0, 60.0, 0.0),
    ]);
    dxf.finish()
}

fn nested() -> String {
    let mut dxf = Dxf::new(
        "Two pockets; in the islands of the first lie pockets again, and an island in one of those.",
        Unit::Mm,
    );
    dxf.polyline(&rectangle(0.0, 0.0, 60.0, 50.0));
    dxf.polyline(&rectangle(8.0, 8.0, 44.0, 34.0));
    dxf.circle(24.0, 25.0, 12.0);
    dxf.circle(24.0, 25.0, 5.0);
    dxf.polyline(&[(40.0, 19.0, 0.0), (41.0, 19.0, 1.0), (41.0, 31.0, 0.0), (40.0, 31.0, 0.0)]);
    dxf.circle(90.0, 25.0, 25.0);
    let hexagon: Vec<_> = (0..6)
        .map(|corner| f64::from(corner) * TAU / 6.0)
        .map(|angle| (90.0 + 11.0 * angle.cos(), 25.0 + 11.0 * angle.sin(), 0.0))
        .collect();
    dxf.polyline(&hexagon);
    dxf.finish()
}

fn plate21() -> String {
    let mut dxf = Dxf::new("Plate with 21 equal bosses on a grid: ties wherever one looks.", Unit::Mm);
    let corners = [(0.0, 0.0), (120.0, 0.0), (120.0, 54.0), (0.0, 54.0)];
    for (i, &corner) in corners.iter().enumerate() {
        dxf.line(corner, corners[(i + 1) % 4]);
    }
    for row in 0..3 {
        for column in 0..7 {
            dxf.circle(12.0 + 16.0 * f64::from(column), 11.0 + 16.0 * f64::from(row), 4.0);
        }
    }
    dxf.finish()
}

fn sharp() -> String {
    let mut dxf =
        Dxf::new("Star with six corners of 23 degrees, which no round tool can reach into.", Unit::Mm);
    let star: Vec<_> = (0..12)
        .map(|i| {
            let radius = if i % 2 == 0 { 50.0 } else { 15.0 };
            let angle = f64::from(i) * TAU / 12.0;
            (50.0 + radius * angle.cos(), 50.0 + radius * angle.sin(), 0.0)
        })
        .collect();
    dxf.polyline(&star);
    dxf.finish()
}

fn loose() -> String {
    const SEGMENTS: usize = 500;
    let mut dxf =
        Dxf::new("One contour as 500 loose lines in no order, about half of them turned round.", Unit::Mm);
    let corner = |i: usize| {
        let angle = i as f64 / SEGMENTS as f64 * TAU;
        let radius = 38.0 + 8.0 * (5.0 * angle).cos() + 2.0 * (17.0 * angle).sin();
        (50.0 + radius * angle.cos(), 50.0 + radius * angle.sin())
    };
    let mut lines: Vec<_> = (0..SEGMENTS).map(|i| (corner(i), corner((i + 1) % SEGMENTS))).collect();
    let mut dice = Dice(1);
    for i in (1..lines.len()).rev() {
        lines.swap(i, dice.below(i + 1));
    }
    for (a, b) in lines {
        if dice.below(2) == 0 { dxf.line(a, b) } else { dxf.line(b, a) }
    }
    dxf.finish()
}

fn inch() -> String {
    let mut dxf = Dxf::new("Drawn in inches, 5 by 3.5: the program comes out in inches too.", Unit::Inch);
    let quarter = (TAU / 16.0).tan();
    dxf.polyline(&[
        (0.5, 0.0, 0.0),
        (4.5, 0.0, quarter),
        (5.0, 0.5, 0.0),
        (5.0, 3.0, quarter),
        (4.5, 3.5, 0.0),
        (0.5, 3.5, quarter),
        (0.0, 3.0, 0.0),
        (0.0, 0.5, quarter),
    ]);
    dxf.circle(2.5, 1.75, 0.5);
    dxf.finish()
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> [(f64, f64, f64); 4] {
    [(x, y, 0.0), (x + width, y, 0.0), (x + width, y + height, 0.0), (x, y + height, 0.0)]
}

/// Numbers in no order that are the same in every run (Lehmer 1951, modulus 2^31 - 1).
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0 * 48_271 % 2_147_483_647;
        self.0 as usize % limit
    }
}

enum Unit {
    Mm,
    Inch,
}

/// A drawing in the making.
struct Dxf {
    text: String,
}

impl Dxf {
    fn new(point: &str, unit: Unit) -> Dxf {
        let mut dxf = Dxf { text: String::new() };
        let (insunits, metric) = match unit {
            Unit::Mm => ("4", "1"),
            Unit::Inch => ("1", "0"),
        };
        dxf.tag(999, point);
        dxf.tags(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009")]);
        dxf.tags(&[(9, "$INSUNITS"), (70, insunits), (9, "$MEASUREMENT"), (70, metric)]);
        dxf.tags(&[(0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
        dxf
    }

    fn line(&mut self, a: (f64, f64), b: (f64, f64)) {
        self.entity("LINE");
        self.numbers(&[(10, a.0), (20, a.1), (11, b.0), (21, b.1)]);
    }

    fn circle(&mut self, x: f64, y: f64, radius: f64) {
        self.entity("CIRCLE");
        self.numbers(&[(10, x), (20, y), (40, radius)]);
    }

    /// Angles in degrees, counter-clockwise.
    fn arc(&mut self, center: (f64, f64), radius: f64, start: f64, end: f64) {
        self.entity("ARC");
        self.numbers(&[(10, center.0), (20, center.1), (40, radius), (50, start), (51, end)]);
    }

    /// A closed polyline of `(x, y, bulge)`.
    fn polyline(&mut self, vertices: &[(f64, f64, f64)]) {
        self.entity("POLYLINE");
        self.tags(&[(66, "1"), (10, "0"), (20, "0"), (30, "0"), (70, "1")]);
        for &(x, y, bulge) in vertices {
            self.entity("VERTEX");
            self.numbers(&[(10, x), (20, y)]);
            if bulge != 0.0 {
                self.numbers(&[(42, bulge)]);
            }
        }
        self.entity("SEQEND");
    }

    fn finish(mut self) -> String {
        self.tags(&[(0, "ENDSEC"), (0, "EOF")]);
        self.text
    }

    fn entity(&mut self, kind: &str) {
        self.tags(&[(0, kind), (8, "0")]);
    }

    fn numbers(&mut self, numbers: &[(i32, f64)]) {
        for &(code, number) in numbers {
            // Fewer digits than a sine has: its last one differs between machines.
            let decimals = if matches!(code, 42 | 50 | 51) { 12 } else { 6 };
            let number = format!("{number:.decimals$}");
            let number = number.trim_end_matches('0').trim_end_matches('.');
            self.tag(code, if number == "-0" { "0" } else { number });
        }
    }

    fn tags(&mut self, tags: &[(i32, &str)]) {
        for (code, value) in tags {
            self.tag(*code, value);
        }
    }

    fn tag(&mut self, code: i32, value: &str) {
        writeln!(self.text, "{code}\n{value}").expect("writing to a string");
    }
}
