//! What mutations begin with: the small samples, drawings with everything that a file may hold, and
//! drawings on a coarse grid, where contours meet, touch and lie on each other all the time.

use super::chance::Chance;
use super::drawing::{Group, groups};

const SAMPLES: [&str; 8] = [
    include_str!("../../../samples/h-neck.dxf"),
    include_str!("../../../samples/inch.dxf"),
    include_str!("../../../samples/keyhole.dxf"),
    include_str!("../../../samples/nested.dxf"),
    include_str!("../../../samples/plate21.dxf"),
    include_str!("../../../samples/rect-island.dxf"),
    include_str!("../../../samples/sharp.dxf"),
    include_str!("../../../samples/slot.dxf"),
];

/// Entities as `code value` pairs, separated by semicolons; parts of files that `|` separates are
/// sections before the entities.
const WRITTEN: [&str; 8] = [
    // A block with a contour, put there mirrored, stretched, turned and in rows, nested in another.
    "0 SECTION; 2 BLOCKS; 0 BLOCK; 2 A; 10 1; 20 1; 0 LWPOLYLINE; 90 3; 70 1; 10 0; 20 0; 10 4; 20 0; \
     42 1; 10 4; 20 3; 0 ENDBLK; 0 BLOCK; 2 B; 10 0; 20 0; 0 INSERT; 2 A; 10 9; 20 0; 50 30; 0 CIRCLE; \
     10 2; 20 12; 40 3; 0 ENDBLK; 0 ENDSEC | 0 INSERT; 2 A; 10 0; 20 0; 41 -1; 70 2; 71 3; 44 9; 45 9; \
     0 INSERT; 2 B; 10 40; 20 0; 41 2; 42 2; 43 2; 50 90; 0 INSERT; 2 B; 10 90; 20 0; 41 2; 42 1",
    // Hatches with a path of vertices and paths of edges.
    "| 0 HATCH; 91 2; 92 2; 72 1; 73 1; 93 4; 10 0; 20 0; 42 0.5; 10 30; 20 0; 42 0; 10 30; 20 20; 42 0; \
     10 0; 20 20; 42 0; 92 0; 93 4; 72 1; 10 5; 20 5; 11 12; 21 5; 72 2; 10 12; 20 8; 40 3; 50 270; 51 90; \
     73 1; 72 1; 10 12; 20 11; 11 5; 21 11; 72 3; 10 5; 20 8; 11 0; 21 3; 40 0.5; 50 0; 51 180; 73 1",
    // Free-form curves, whole and open, beside a contour.
    "| 0 ELLIPSE; 10 20; 20 20; 11 9; 21 3; 40 0.4; 41 0; 42 6.283185307179586; 0 SPLINE; 70 8; 71 3; 72 8; \
     73 4; 40 0; 40 0; 40 0; 40 0; 40 1; 40 1; 40 1; 40 1; 10 0; 20 0; 10 5; 20 9; 10 9; 20 -5; 10 14; 20 3; \
     0 CIRCLE; 10 20; 20 20; 40 15",
    // Polylines of the old form, of vertices with bulges and of curve fits.
    "| 0 POLYLINE; 66 1; 70 1; 0 VERTEX; 10 0; 20 0; 42 0.2; 0 VERTEX; 10 30; 20 0; 0 VERTEX; 10 30; 20 30; \
     42 -0.4; 0 VERTEX; 10 0; 20 30; 0 SEQEND; 0 POLYLINE; 66 1; 70 5; 0 VERTEX; 70 16; 10 5; 20 5; \
     0 VERTEX; 70 8; 10 12; 20 5; 0 VERTEX; 70 9; 10 12; 20 12; 0 VERTEX; 70 8; 10 5; 20 12; 0 SEQEND",
    // Layers, colors, heights and the other side of the sheet.
    "0 SECTION; 2 TABLES; 0 TABLE; 2 LAYER; 70 2; 0 LAYER; 2 WALL; 70 0; 62 3; 0 LAYER; 2 NOTES; 70 1; 62 -7; \
     0 ENDTAB; 0 ENDSEC | 0 LWPOLYLINE; 8 WALL; 62 5; 38 2; 39 1; 90 4; 70 1; 210 0; 220 0; 230 -1; 10 0; 20 0; \
     10 25; 20 0; 10 25; 20 12; 10 0; 20 12; 0 CIRCLE; 8 NOTES; 10 8; 20 6; 40 2; 0 ARC; 8 WALL; 10 -9; 20 6; \
     40 3; 50 0; 51 180; 0 ARC; 8 WALL; 10 -9; 20 6; 30 1; 40 3; 50 180; 51 360; 0 TEXT; 8 WALL; 1 note",
    // Neighbors with one common side, a line that ends on two sides, a contour drawn twice.
    "| 0 LINE; 10 0; 20 0; 11 4; 21 0; 0 LINE; 10 4; 20 0; 11 9; 21 0; 0 LINE; 10 9; 20 0; 11 9; 21 3; 0 LINE; \
     10 9; 20 3; 11 0; 21 3; 0 LINE; 10 0; 20 3; 11 0; 21 0; 0 LINE; 10 4; 20 0; 11 5; 21 3; 0 LINE; 10 0; \
     20 1; 11 4.333333; 21 1; 0 CIRCLE; 10 7; 20 1.5; 40 1; 0 ARC; 10 7; 20 1.5; 40 1; 50 10; 51 370",
    // Round contours that touch from inside and outside, and a slot as wide as another.
    "| 0 CIRCLE; 10 0; 20 0; 40 10; 0 CIRCLE; 10 5; 20 0; 40 5; 0 CIRCLE; 10 -3; 20 0; 40 3; 0 CIRCLE; 10 0; \
     20 -8; 40 2; 0 LWPOLYLINE; 90 4; 70 1; 10 20; 20 0; 10 40; 20 0; 42 1; 10 40; 20 6; 10 20; 20 6; 42 1; \
     0 LWPOLYLINE; 90 4; 70 1; 10 23; 20 2; 10 37; 20 2; 42 1; 10 37; 20 4; 10 23; 20 4; 42 1",
    // A comb and a star: narrow necks and sharp corners.
    "| 0 LWPOLYLINE; 90 12; 70 1; 10 0; 20 0; 10 30; 20 0; 10 30; 20 20; 10 26; 20 20; 10 26; 20 4; 10 25.9; \
     20 4; 10 25.9; 20 20; 10 20; 20 20; 10 20; 20 2; 10 10; 20 2; 10 10; 20 20; 10 0; 20 20; 0 LWPOLYLINE; \
     90 6; 70 1; 10 12; 20 0.5; 10 13; 20 1.5; 10 14; 20 0.5; 10 13.1; 20 1; 10 13; 20 0.5; 10 12.9; 20 1",
];

/// The groups of a file in millimeters.
fn file(parts: &str) -> Vec<Group> {
    let (before, entities) = parts.split_once('|').expect("two parts");
    let head = "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC";
    let all = format!("{head}; {before}; 0 SECTION; 2 ENTITIES; {entities}; 0 ENDSEC; 0 EOF");
    let pairs = all.split(';').filter_map(|pair| pair.trim().split_once(' ').or(Some((pair.trim(), ""))));
    pairs.filter(|(code, _)| !code.is_empty()).map(|(c, v)| (c.into(), v.trim().into())).collect()
}

/// One drawing to begin with.
pub fn any(chance: &mut Chance) -> Vec<Group> {
    match chance.below(4) {
        0 => groups(chance.of(&SAMPLES)),
        1 => file(chance.of(&WRITTEN)),
        _ => file(&format!("|{}", on_a_grid(chance))),
    }
}

/// A few contours and loose curves with all their corners on a coarse grid.
fn on_a_grid(chance: &mut Chance) -> String {
    /// Bulges of half, quarter and flat arcs; most elements are straight.
    const BULGES: [&str; 9] =
        ["0", "0", "0", "0", "1", "-1", "0.41421356237309503", "-0.41421356237309503", "0.01"];
    let cells = chance.of(&[4, 6, 12]);
    let at = |chance: &mut Chance| (chance.below(cells + 1), chance.below(cells + 1));
    let mut entities = String::new();
    for _ in 0..1 + chance.below(6) {
        let ((x, y), (u, v)) = (at(chance), at(chance));
        entities += &match chance.below(6) {
            0 | 1 => {
                format!("0 LWPOLYLINE; 70 1; 10 {x}; 20 {y}; 10 {u}; 20 {y}; 10 {u}; 20 {v}; 10 {x}; 20 {v};")
            }
            2 => format!("0 CIRCLE; 10 {x}; 20 {y}; 40 {};", 1 + chance.below(cells / 2)),
            3 => format!("0 LINE; 10 {x}; 20 {y}; 11 {u}; 21 {v};"),
            4 => {
                let [start, sweep] = [chance.below(4), 1 + chance.below(3)].map(|quarters| 90 * quarters);
                let radius = 1 + chance.below(cells / 2);
                format!("0 ARC; 10 {x}; 20 {y}; 40 {radius}; 50 {start}; 51 {};", start + sweep)
            }
            _ => polyline(chance, cells, &BULGES),
        };
    }
    entities
}

/// A closed polyline around the middle of the grid, so that it seldom crosses itself.
fn polyline(chance: &mut Chance, cells: usize, bulges: &[&str]) -> String {
    let count = 2 + chance.below(7);
    let half = 0.5 * cells as f64;
    let corner = |i: usize, chance: &mut Chance| {
        let turn = std::f64::consts::TAU * i as f64 / count as f64;
        let radius = half * (0.3 + 0.9 * chance.share());
        let [x, y] = [turn.cos(), turn.sin()].map(|c| (half + radius * c).round());
        format!("10 {x}; 20 {y}; 42 {};", chance.of(bulges))
    };
    format!("0 LWPOLYLINE; 70 1; {}", (0..count).map(|i| corner(i, chance)).collect::<String>())
}
