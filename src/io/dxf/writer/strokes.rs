//! A tool path as entities: one for each run of moves of a kind.

use super::entity::{Entity, Shape};
use super::layer::Layer;
use crate::geom::{ArcSpline, Point, Vertex};
use crate::toolpath::{Move, Moves, Point3};
use std::borrow::Cow;
use std::f64::consts::PI;

/// Most chords of one helical move; beyond that they lie farther from it than asked.
const MAX_CHORDS: f64 = 4096.0;

/// The path as entities: cuts at one height as polylines with bulges at that height, entries and
/// rapids as ways in space. Helices become chords within `tolerance`.
pub(super) fn strokes(moves: &Moves, tolerance: f64) -> impl Iterator<Item = Entity<'_>> {
    let mut rest = moves.iter().peekable();
    // Nobody knows from where the first move comes.
    let mut at = rest.next().map(|m| m.to());
    std::iter::from_fn(move || {
        let from = at?;
        let layer = layer(from, rest.peek()?);
        let mut run = Vec::new();
        while let Some(m) = rest.next_if(|m| self::layer(at.unwrap_or(from), m) == layer) {
            at = Some(m.to());
            run.push(m);
        }
        let shape = if layer == Layer::Toolpath {
            Shape::Spline(Cow::Owned(flat(from, &run)), from.z)
        } else {
            Shape::Way(way(from, &run, tolerance))
        };
        Some(Entity { layer, shape })
    })
}

/// The layer of a move from here.
fn layer(from: Point3, m: &Move) -> Layer {
    match m {
        Move::Rapid { .. } => Layer::Rapid,
        _ if m.to().z == from.z => Layer::Toolpath,
        _ => Layer::Entry,
    }
}

/// Cuts at one height.
fn flat(from: Point3, run: &[Move]) -> ArcSpline {
    let mut vertices = Vec::with_capacity(run.len() + 1);
    let mut at = from.xy();
    for m in run {
        let bulge = match m {
            Move::Arc { center, .. } => (0.25 * sweep(at, *center, m)).tan(),
            _ => 0.0,
        };
        vertices.push(Vertex { point: at, bulge });
        at = m.to().xy();
    }
    vertices.push(Vertex { point: at, bulge: 0.0 });
    ArcSpline { vertices, closed: false }
}

/// Swept angle of a circular move, at most a half turn; its sign is told by the move, as a half turn
/// is as far either way.
fn sweep(from: Point, center: Point, m: &Move) -> f64 {
    let turn = (from - center).angle_to(m.to().xy() - center).abs();
    if matches!(m, Move::Arc { ccw: true, .. }) { turn } else { -turn }
}

/// The places that moves in space pass through.
fn way(from: Point3, run: &[Move], tolerance: f64) -> Vec<Point3> {
    let mut places = vec![from];
    let mut at = from;
    for m in run {
        let to = m.to();
        if let Move::Arc { center, .. } = m {
            let turn = sweep(at.xy(), *center, m);
            let chords = chords(turn, center.distance(to.xy()), tolerance);
            for i in 1..chords {
                let share = f64::from(i) / f64::from(chords);
                let (sin, cos) = (turn * share).sin_cos();
                let p = *center + (at.xy() - *center).rotated(cos, sin);
                places.push(Point3::new(p, at.z + (to.z - at.z) * share));
            }
        }
        places.push(to);
        at = to;
    }
    places
}

/// How many equal chords stay this close to an arc: over an angle `h` the sagitta is
/// `r (1 - cos(h / 2)) <= r h^2 / 8`.
fn chords(turn: f64, radius: f64, tolerance: f64) -> u32 {
    let step = (8.0 * tolerance / radius).sqrt().min(PI);
    // At most the named limit; nothing is asked of what is not a number.
    (turn.abs() / step).ceil().clamp(1.0, MAX_CHORDS) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn rapid(x: f64, y: f64, z: f64) -> Move {
        Move::Rapid { to: Point3 { x, y, z } }
    }

    fn feed(x: f64, y: f64, z: f64) -> Move {
        Move::Feed { to: Point3 { x, y, z }, rate: 600.0 }
    }

    fn arc(x: f64, y: f64, z: f64, center: Point) -> Move {
        Move::Arc { to: Point3 { x, y, z }, center, ccw: true, rate: 600.0 }
    }

    #[test]
    fn a_path_is_rapids_entries_and_cuts_at_their_height() {
        let moves = Moves::from([
            rapid(1.0, 0.0, 5.0),
            rapid(1.0, 0.0, 1.0),
            arc(-1.0, 0.0, 0.0, point(0.0, 0.0)),
            arc(1.0, 0.0, -1.0, point(0.0, 0.0)),
            arc(-1.0, 0.0, -1.0, point(0.0, 0.0)),
            feed(-4.0, 0.0, -1.0),
            rapid(-4.0, 0.0, 5.0),
        ]);
        let strokes: Vec<Entity> = strokes(&moves, 0.01).collect();
        let layers: Vec<Layer> = strokes.iter().map(|s| s.layer).collect();
        assert_eq!(layers, [Layer::Rapid, Layer::Entry, Layer::Toolpath, Layer::Rapid]);
        let Shape::Spline(cut, z) = &strokes[2].shape else { panic!() };
        assert_eq!(*z, -1.0);
        let wanted = ArcSpline::open([(1.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (-4.0, 0.0, 0.0)]);
        assert_eq!(cut.vertices.len(), 3);
        for (v, w) in cut.vertices.iter().zip(&wanted.vertices) {
            assert!(v.point == w.point && (v.bulge - w.bulge).abs() < 1e-15);
        }
    }

    #[test]
    fn a_helix_keeps_to_the_tolerance_and_no_number_asks_for_more_than_the_limit() {
        let moves = Moves::from([rapid(10.0, 0.0, 1.0), arc(-10.0, 0.0, 0.0, point(0.0, 0.0))]);
        let helix = strokes(&moves, 0.01).next().unwrap();
        let Shape::Way(places) = helix.shape else { panic!() };
        for pair in places.windows(2) {
            let middle = pair[0].xy().midpoint(pair[1].xy());
            assert!(pair[1].z < pair[0].z && (10.0 - middle.to_vector().length()).abs() < 0.01);
        }
        assert!(places.len() < 40);
        for tolerance in [0.0, 1e-300, f64::NAN, f64::INFINITY] {
            assert!(strokes(&moves, tolerance).count() == 1);
        }
    }

    #[test]
    fn nothing_and_one_move_draw_nothing() {
        assert_eq!(strokes(&Moves::default(), 0.01).count(), 0);
        assert_eq!(strokes(&[rapid(0.0, 0.0, 5.0)].into(), 0.01).count(), 0);
    }
}
