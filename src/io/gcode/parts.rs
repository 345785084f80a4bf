//! A long program, written in parts side by side.
//!
//! What a line says depends on where the tool is and on the feed rate, no more. After a move that cuts for sure
//! both are known, and a part may begin there: the text is the same for any number of parts.

use super::number::Grid;
use super::setup::Setup;
use super::write::{MAX_LINES, USUAL_LINE, Writer, Written, too_long};
use crate::error::Error;
use crate::toolpath::Move;
use rayon::prelude::*;

/// Moves to a part that is worth a thread.
pub(super) const LEAST_PART: usize = 1 << 16;

/// Writes a program in parts side by side, each of so many moves at least.
pub(super) fn in_parts(moves: &[Move], setup: &Setup, count: usize, least: usize) -> Result<Written, Error> {
    let count = count.min(moves.len() / least).max(1);
    let mut begins = vec![0];
    begins.extend((1..count).filter_map(|i| resumable(moves, setup, moves.len() * i / count)));
    begins.dedup();
    let ends = begins.iter().skip(1).copied().chain([moves.len()]);
    let parts: Vec<(usize, usize)> = begins.iter().copied().zip(ends).collect();
    let write = |&(begin, end): &(usize, usize)| -> Result<Written, Error> {
        let mut writer = if begin == 0 { Writer::new(setup) } else { Writer::resumed(setup, moves, begin)? };
        writer.out.text.reserve((end - begin) * USUAL_LINE);
        if begin == 0 {
            writer.header()?;
        }
        writer.moves(&moves[begin..end])?;
        if end == moves.len() {
            writer.footer()?;
        }
        Ok(writer.out)
    };
    let parts: Vec<Result<Written, Error>> = parts.par_iter().map(write).collect();
    let mut parts = parts.into_iter();
    let mut whole = parts.next().unwrap_or_else(|| Ok(Written::default()))?;
    for part in parts {
        whole.append(part?)?;
    }
    whole.stats.bytes = whole.text.len();
    Ok(whole)
}

/// The first move from some on before which one cuts for sure, so that the state of the controller is known.
fn resumable(moves: &[Move], setup: &Setup, from: usize) -> Option<usize> {
    let grid = Grid::new(setup.decimals);
    let place = |i: usize| grid.round_point(moves[i].to().xy()).ok();
    let cuts = |i: usize| moves[i].rate().is_some() && place(i).is_some() && place(i) != place(i - 1);
    (from.max(2)..moves.len()).find(|&k| cuts(k - 1))
}

impl Written {
    /// Goes on with what was written apart.
    fn append(&mut self, part: Written) -> Result<(), Error> {
        self.text.push_str(&part.text);
        let (a, b) = (&mut self.stats, &part.stats);
        a.text_lines += b.text_lines;
        a.rapids += b.rapids;
        a.lines += b.lines;
        a.arcs += b.arcs;
        a.dropped_lines += b.dropped_lines;
        a.dropped_arcs += b.dropped_arcs;
        a.dropped_arc_at = a.dropped_arc_at.or(b.dropped_arc_at);
        if a.text_lines > MAX_LINES { Err(too_long()) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use crate::io::gcode::ArcWords;
    use crate::toolpath::Point3;

    /// Lines and arcs, rapids, other feeds, and moves that vanish.
    fn moves() -> Vec<Move> {
        let mut moves = vec![Move::Rapid { to: Point3 { x: 0.0, y: 0.0, z: 5.0 } }];
        for i in 0..400 {
            let at = moves[i].to();
            let ahead = |x: f64, z: f64| Point3 { x: at.x + x, y: 0.0, z };
            let rate = if i % 7 < 3 { 600.0 } else { 300.0 };
            moves.push(match i % 5 {
                0 => Move::Feed { to: ahead(1.0, -1.0), rate },
                // Less than the last decimal.
                1 => Move::Feed { to: ahead(1e-9, -1.0), rate },
                2 => {
                    Move::Arc { to: ahead(2.0, -1.0), center: point(at.x + 1.0, 0.0), ccw: i % 2 == 0, rate }
                }
                3 => Move::Arc { to: ahead(0.0, -1.5), center: point(at.x, 1.0), ccw: true, rate: 200.0 },
                _ => Move::Rapid { to: ahead(3.0, 5.0) },
            });
        }
        moves
    }

    #[test]
    fn parts_make_the_same_program() {
        for arcs in [ArcWords::Ijk, ArcWords::R, ArcWords::Off] {
            let setup = Setup { arcs, ..Setup::new(crate::Units::Mm) };
            let whole = in_parts(&moves(), &setup, 1, 1).unwrap();
            for count in 2..60 {
                assert_eq!(in_parts(&moves(), &setup, count, 1).unwrap(), whole, "{count} parts");
            }
        }
    }

    #[test]
    fn a_part_with_a_fault_is_an_error() {
        let mut moves = moves();
        moves.push(Move::Feed { to: Point3 { x: f64::NAN, y: 0.0, z: 0.0 }, rate: 1.0 });
        assert!(in_parts(&moves, &Setup::new(crate::Units::Mm), 3, 1).is_err());
    }
}
