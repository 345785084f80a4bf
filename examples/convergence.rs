//! Arcs against tolerance for five curves: `convergence [PLOT.svg [TABLE.md]]`.
//!
//! For each curve and each tolerance from 1e-3 to 1e-9 of its box: the arcs by the default scheme and
//! by S0's (osculating arcs, halving), their ratio to the asymptotic minimum of any arcs,
//! `W / (192 eps)^(1/3)` with `W` the integral of the cube root of the derivative of the curvature by
//! arc length, and the slopes of the arcs in the tolerance, which tend to -1/3. Leaves are extrema of
//! the curvature: as many as the curve has, at every tolerance.

use medial::boundary::freeform::{EllipseArc, Fit, Nurbs, Scheme};
use medial::{Bounds, Point, Vector, point, vector};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::time::Instant;

/// Tolerances are ten to these powers of the diagonal of the box.
const EXPONENTS: std::ops::RangeInclusive<i32> = -9..=-3;

/// A curve with a name.
struct Curve {
    name: &'static str,
    size: f64,
    shape: Shape,
}

enum Shape {
    Spline(Nurbs),
    Ellipse(EllipseArc),
}

impl Curve {
    fn spline(name: &'static str, spline: Nurbs) -> Curve {
        let size = Bounds::around(spline.points().iter().copied()).diagonal();
        Curve { name, size, shape: Shape::Spline(spline) }
    }

    fn fit(&self, scheme: Scheme, eps: f64) -> Fit {
        let fit = match &self.shape {
            Shape::Spline(spline) => spline.to_arcs_by(scheme, eps),
            Shape::Ellipse(ellipse) => ellipse.to_arcs_by(scheme, eps),
        };
        fit.expect("a curve that can be fitted")
    }
}

/// One curve at one tolerance.
struct Row {
    eps: f64,
    ours: usize,
    theirs: usize,
    least: f64,
    away: Option<f64>,
    leaves: usize,
    apices: usize,
    looseness: f64,
    speed: f64,
}

fn main() -> std::io::Result<()> {
    let curves = curves();
    let tables: Vec<Vec<Row>> = curves.iter().map(table).collect();
    for (curve, rows) in curves.iter().zip(&tables) {
        print(curve, rows);
    }
    if let Some(path) = std::env::args().nth(1) {
        std::fs::write(path, plot(&curves, &tables))?;
    }
    if let Some(path) = std::env::args().nth(2) {
        std::fs::write(path, page(&curves, &tables))?;
    }
    Ok(())
}

/// The tables as a page of the documentation, without what depends on the machine.
fn page(curves: &[Curve], tables: &[Vec<Row>]) -> String {
    let mut page = String::from(
        "# Arcs against tolerance\n\n\
         Written by `cargo run --release --example convergence docs/convergence.svg docs/convergence.md`.\n\n\
         ![arcs over tolerance](convergence.svg)\n\n\
         The tolerance is a part of the diagonal of the box. *Ratio* is the number of arcs over \
         `W / (192 eps)^(1/3)`, with `W` the integral of the cube root of the derivative of the curvature: \
         what any arcs need at least for small tolerances, even arcs that do not meet. Arcs that meet \
         with common tangents need 1.155 times that. *Away* is the same without the arcs over apices and those \
         beside them; where only three lie between two arcs over apices, one is left, and then these ratios go in steps: \
         the 36 equal parts of the lobes take four arcs each at 1e-4, as three would be a ratio of 1.03, less than \
         arcs with common tangents can do, so that no curve of such arcs has fewer. *S0* are the arcs by the scheme of Aichholzer et al., \
         *Medial axis computation for planar free-form shapes*, 2009: osculating biarcs and halving. *Slope* is \
         that of the logarithms from one tolerance to another, -1/3 in theory. *Leaves* are the extrema of \
         the curvature of the arcs; the curve has as many at every tolerance.\n",
    );
    for (curve, rows) in curves.iter().zip(tables) {
        let slope = |from: f64| {
            let (first, last) =
                (rows.iter().find(|r| r.eps < 2.0 * from).unwrap_or(&rows[0]), &rows[rows.len() - 1]);
            (last.ours as f64 / first.ours as f64).ln() / (last.eps / first.eps).ln()
        };
        let [all, usual, fine] = [1e-3, 1e-4, 1e-6].map(slope);
        let _ = write!(
            page,
            "\n## {}\n\n{} apices; slope {usual:.3} from 1e-4 to 1e-9, {fine:.3} from 1e-6, {all:.3} from 1e-3\n\n\
             | tolerance | arcs | ratio | away | S0 | leaves |\n|---|---|---|---|---|---|\n",
            curve.name, rows[0].apices
        );
        for row in rows {
            let ratio = row.ours as f64 / row.least;
            let away = row.away.map_or(String::new(), |away| format!("{away:.2}"));
            let _ = writeln!(
                page,
                "| {:.0e} | {} | {ratio:.2} | {away} | {} | {} |",
                row.eps, row.ours, row.theirs, row.leaves
            );
        }
    }
    page
}

fn table(curve: &Curve) -> Vec<Row> {
    // The finest fit tells W: its arcs sample the curvature.
    let integral = integral(&curve.fit(Scheme::Plain, 1e-10 * curve.size));
    let row = |exponent: i32| {
        let eps = 10f64.powi(exponent) * curve.size;
        let ours = curve.fit(Scheme::Fewest, eps);
        Row {
            eps: eps / curve.size,
            ours: ours.path.len(),
            theirs: curve.fit(Scheme::Bisection, eps).path.len(),
            least: integral / (192.0 * eps).cbrt(),
            away: away(&ours, eps),
            leaves: extrema(&ours),
            apices: ours.cuts.apices,
            looseness: ours.bound / ours.found,
            speed: speed(curve, eps),
        }
    };
    EXPONENTS.rev().map(row).collect()
}

fn print(curve: &Curve, rows: &[Row]) {
    println!("{}, {} apices", curve.name, rows[0].apices);
    println!("    eps     arcs   slope   ratio    away      S0   slope   leaves  bound/found  arcs/s");
    for (i, row) in rows.iter().enumerate() {
        let slope = |count: fn(&Row) -> usize| match i {
            0 => String::new(),
            _ => format!("{:.3}", -(count(row) as f64 / count(&rows[i - 1]) as f64).log10()),
        };
        println!(
            "  {:5.0e} {:8} {:>7} {:7.3} {:7.3} {:7} {:>7} {:8} {:12.6} {:8.0}",
            row.eps,
            row.ours,
            slope(|r| r.ours),
            row.ours as f64 / row.least,
            row.away.unwrap_or(f64::NAN),
            row.theirs,
            slope(|r| r.theirs),
            row.leaves,
            row.looseness,
            row.speed
        );
    }
}

/// Output arcs per second by the default scheme, proof included.
fn speed(curve: &Curve, eps: f64) -> f64 {
    let start = Instant::now();
    let (mut arcs, mut runs) = (0, 0);
    while runs < 3 || start.elapsed().as_secs_f64() < 0.05 {
        arcs += curve.fit(Scheme::Fewest, eps).path.len();
        runs += 1;
    }
    arcs as f64 / start.elapsed().as_secs_f64()
}

/// Integral of the cube root of the derivative of the curvature, from a fine fit.
fn integral(fit: &Fit) -> f64 {
    let elements: Vec<_> = fit.path.elements().map(|e| (e.curvature(), e.length())).collect();
    let n = elements.len();
    let part = |i: usize| {
        let ((k, a), (l, b)) = (elements[i], elements[(i + 1) % n]);
        let h = 0.5 * (a + b);
        ((l - k).abs() / h).cbrt() * h
    };
    (0..n).map(part).sum()
}

/// The number of arcs over the least number of any arcs, without those that are an extremum of the
/// curvature and those beside them. `None` where too few are left.
fn away(fit: &Fit, eps: f64) -> Option<f64> {
    const FEW: usize = 8;
    let elements: Vec<_> = fit.path.elements().map(|e| (e.curvature(), e.length())).collect();
    let n = elements.len();
    let near = |i: usize, by: usize| elements[(i + by) % n];
    let is_apex = |i: usize| {
        let (before, (k, _), after) = (near(i, n - 1), near(i, 0), near(i, 1));
        (k > before.0) == (k > after.0)
    };
    let (mut count, mut least) = (0, 0.0);
    for i in (0..n).filter(|&i| ![n - 1, 0, 1].iter().any(|by| is_apex((i + by) % n))) {
        let ((before, a), (_, length), (after, b)) = (near(i, n - 1), near(i, 0), near(i, 1));
        let slope = (after - before).abs() / (0.5 * (a + b) + length);
        count += 1;
        least += length * (slope / (192.0 * eps)).cbrt();
    }
    (count >= FEW).then(|| f64::from(count as u32) / least)
}

/// Local extrema of the curvature, to round-off.
fn extrema(fit: &Fit) -> usize {
    let elements: Vec<_> = fit.path.elements().map(|e| (e.curvature(), e.chord().length())).collect();
    let noise = 64.0 * f64::EPSILON * fit.path.bounds().magnitude();
    let mut rises: Vec<bool> = Vec::new();
    for (i, (k, a)) in elements.iter().enumerate() {
        let (l, b) = elements[(i + 1) % elements.len()];
        let h = a.min(b);
        if (l - k).abs() > noise / (h * h) {
            rises.push(l > *k);
        }
    }
    (0..rises.len()).filter(|&i| rises[i] != rises[(i + 1) % rises.len()]).count()
}

fn curves() -> Vec<Curve> {
    let ellipse = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.0, 0.0).expect("an ellipse");
    let ellipse =
        Curve { name: "ellipse 2:1", size: vector(4.0, 2.0).length(), shape: Shape::Ellipse(ellipse) };
    vec![
        ellipse,
        Curve::spline("closed B-spline with 18 lobes", lobes(18, 0.72, [1.0, 1.0])),
        Curve::spline("closed rational spline", lobes(5, 0.5, [1.5, 0.8])),
        Curve::spline("tree", tree()),
        Curve::spline("snow-flake", snow_flake()),
    ]
}

/// A closed cubic with control points on two circles in turn, and weights in turn.
fn lobes(count: usize, inner: f64, weights: [f64; 2]) -> Nurbs {
    let n = 2 * count;
    let place = |i: usize| {
        let r = if i.is_multiple_of(2) { 50.0 } else { 50.0 * inner };
        point(0.0, 0.0) + Vector::from_angle(TAU * i as f64 / n as f64) * r
    };
    closed((0..n).map(place).collect(), (0..n).map(|i| weights[i % 2]).collect())
}

fn closed(points: Vec<Point>, weights: Vec<f64>) -> Nurbs {
    let knots = (0..=points.len()).map(|i| i as f64).collect();
    Nurbs::new(3, knots, points, weights, true).expect("a spline")
}

/// A trunk with branches that become shorter to the top.
fn tree() -> Nurbs {
    let side = [
        (4.0, 0.0),
        (5.0, 8.0),
        (4.0, 16.0),
        (30.0, 10.0),
        (34.0, 16.0),
        (10.0, 24.0),
        (6.0, 32.0),
        (26.0, 30.0),
        (28.0, 36.0),
        (8.0, 44.0),
        (5.0, 50.0),
        (18.0, 50.0),
        (19.0, 56.0),
        (6.0, 62.0),
        (4.0, 70.0),
    ];
    let right = side.iter().map(|&(x, y)| point(x, y));
    let left = side.iter().rev().map(|&(x, y)| point(-x, y));
    let points: Vec<Point> = right.chain([point(0.0, 84.0)]).chain(left).collect();
    let weights = vec![1.0; points.len()];
    closed(points, weights)
}

/// Six arms with side arms.
fn snow_flake() -> Nurbs {
    let arm = [
        (8.0, -0.45),
        (20.0, -0.10),
        (26.0, -0.40),
        (31.0, -0.30),
        (28.0, -0.08),
        (44.0, -0.08),
        (46.0, 0.08),
        (28.0, 0.08),
        (31.0, 0.30),
        (26.0, 0.40),
        (20.0, 0.10),
    ];
    let turned = |i: i32| {
        let turn = TAU * f64::from(i) / 6.0;
        arm.map(|(r, a)| point(0.0, 0.0) + Vector::from_angle(turn + a) * r)
    };
    let points: Vec<Point> = (0..6).flat_map(turned).collect();
    let weights = vec![1.0; points.len()];
    closed(points, weights)
}

/// Arcs over tolerance, both logarithmic, as SVG: ours solid, S0's dashed, the minimum thin.
fn plot(curves: &[Curve], tables: &[Vec<Row>]) -> String {
    const COLORS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7a5c00"];
    let x = |eps: f64| 60.0 + 80.0 * (-3.0 - eps.log10());
    let y = |arcs: f64| 380.0 - 80.0 * (arcs.log10() - 1.0);
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 440\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"640\" height=\"440\" fill=\"#fff\"/>\n",
    );
    for e in EXPONENTS {
        let at = x(10f64.powi(e));
        let _ = writeln!(svg, "<path d=\"M{at} 40V400\" stroke=\"#ddd\"/>");
        let _ = writeln!(svg, "<text x=\"{at}\" y=\"418\" text-anchor=\"middle\">1e{e}</text>");
    }
    for count in [10, 100, 1000, 10_000] {
        let at = y(f64::from(count));
        let _ = writeln!(svg, "<path d=\"M50 {at}H550\" stroke=\"#ddd\"/>");
        let _ = writeln!(svg, "<text x=\"46\" y=\"{}\" text-anchor=\"end\">{count}</text>", at + 4.0);
    }
    for (i, (curve, rows)) in curves.iter().zip(tables).enumerate() {
        let color = COLORS[i % COLORS.len()];
        let mut line = |style: &str, count: &dyn Fn(&Row) -> f64| {
            let points: Vec<String> =
                rows.iter().map(|r| format!("{:.1},{:.1}", x(r.eps), y(count(r)))).collect();
            let points = points.join(" ");
            let _ = writeln!(svg, "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" {style}/>");
        };
        line("stroke-width=\"2\"", &|r| r.ours as f64);
        line("stroke-dasharray=\"5 3\"", &|r| r.theirs as f64);
        line("stroke-width=\"0.5\"", &|r| r.least);
        let _ = writeln!(svg, "<text x=\"70\" y=\"{}\" fill=\"{color}\">{}</text>", 54 + 16 * i, curve.name);
    }
    svg.push_str(
        "<text x=\"300\" y=\"434\" text-anchor=\"middle\">tolerance / size; solid: arcs, dashed: S0, thin: \
         least of any arcs</text>\n</svg>\n",
    );
    svg
}
