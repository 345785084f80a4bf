//! A long program, written in parts side by side.
//!
//! **Method.** What a line says depends on where the tool is and on the feed rate, no more. After a move that
//! cuts for sure both are known, and a part may begin there: the text is the same for any number of parts. While
//! some parts are handed over, the next ones are made in the room of those before, so that a program takes
//! little room however long it is.

use super::number::Grid;
use super::program::{Part, Stats};
use super::setup::Setup;
use super::write::Writer;
use crate::error::Error;
use crate::toolpath::{Move, Moves};
use rayon::prelude::*;
use std::ops::Range;

/// Moves to a part: its text stays near the processor until it is handed over.
pub(super) const USUAL_PART: usize = 1 << 13;

/// Parts at once to a thread, as not all take the same time.
const PER_THREAD: usize = 2;

/// Writes a program in parts of so many moves at least, and hands these over in order.
pub(super) fn in_parts(
    moves: &Moves,
    setup: &Setup,
    least: usize,
    mut put: impl FnMut(&[u8]) -> Result<(), Error> + Send,
) -> Result<Stats, Error> {
    let at_once = PER_THREAD * rayon::current_num_threads();
    let (mut done, mut next): (Vec<Part>, Vec<Part>) = (Vec::new(), Vec::new());
    let mut stats = Stats::default();
    let ranges = ranges(moves, setup, least);
    for some in ranges.chunks(at_once).chain([&[][..]]) {
        let hand_over = || done.iter().try_for_each(|part| put(&part.text));
        let (handed, made) = rayon::join(hand_over, || make(&mut next, moves, setup, some));
        handed?;
        made?;
        next.iter().try_for_each(|part| stats.append(&part.stats))?;
        std::mem::swap(&mut done, &mut next);
    }
    Ok(stats)
}

/// Writes some parts side by side.
fn make(parts: &mut Vec<Part>, moves: &Moves, setup: &Setup, ranges: &[Range<usize>]) -> Result<(), Error> {
    parts.resize_with(ranges.len(), Part::default);
    let make = |(part, range): (&mut Part, &Range<usize>)| fill(part, moves, setup, range.clone());
    let results: Vec<_> = parts.par_iter_mut().zip(ranges).map(make).collect();
    results.into_iter().collect()
}

/// Writes one part; the first has the header, the last the footer.
fn fill(part: &mut Part, moves: &Moves, setup: &Setup, range: Range<usize>) -> Result<(), Error> {
    part.clear();
    let out = std::mem::take(part);
    let mut writer = match range.start {
        0 => Writer::new(setup, out),
        begin => Writer::resumed(setup, out, moves, begin)?,
    };
    if range.start == 0 {
        writer.header()?;
    }
    writer.moves(moves.range(range.clone()))?;
    if range.end == moves.len() {
        writer.footer()?;
    }
    *part = writer.out;
    part.stats.bytes = part.text.len();
    Ok(())
}

/// The moves of each part.
fn ranges(moves: &Moves, setup: &Setup, least: usize) -> Vec<Range<usize>> {
    let mut begins = vec![0];
    let mut from = least;
    while let Some(begin) = resumable(moves, setup, from) {
        begins.push(begin);
        from = begin.saturating_add(least);
    }
    let ends = begins.iter().skip(1).copied().chain([moves.len()]);
    begins.iter().copied().zip(ends).map(|(begin, end)| begin..end).collect()
}

/// The first move from some on before which one cuts for sure, so that the state of the controller is known.
fn resumable(moves: &Moves, setup: &Setup, from: usize) -> Option<usize> {
    let grid = Grid::new(setup.decimals);
    let place = |m: Move| grid.round_point(m.to().xy()).ok();
    let cuts = |last: Move, m: Move| m.rate().is_some() && place(m).is_some() && place(m) != place(last);
    let pairs = moves.range(from.max(2) - 2..moves.len()).zip(moves.range(from.max(2) - 1..moves.len()));
    let begin = from.max(2) + pairs.take_while(|&(last, m)| !cuts(last, m)).count();
    (begin < moves.len()).then_some(begin)
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

    /// A program written in parts, what is in it, and in how many parts it came.
    fn written(setup: &Setup, least: usize) -> (Vec<u8>, Stats, usize) {
        let (mut text, mut count) = (Vec::new(), 0);
        let put = |part: &[u8]| {
            text.extend_from_slice(part);
            count += 1;
            Ok(())
        };
        let stats = in_parts(&moves().into(), setup, least, put).unwrap();
        (text, stats, count)
    }

    #[test]
    fn parts_make_the_same_program() {
        for arcs in [ArcWords::Ijk, ArcWords::R, ArcWords::Off] {
            let setup = Setup { arcs, ..Setup::new(crate::Units::Mm) };
            let (text, stats, _) = written(&setup, usize::MAX);
            assert_eq!(stats.bytes, text.len());
            for least in 1..60 {
                let parts = written(&setup, least);
                assert_eq!((&parts.0, &parts.1), (&text, &stats), "{least} moves to a part");
                assert!(parts.2 > 200 / (least + 5), "{least}: {} parts", parts.2);
            }
        }
    }

    #[test]
    fn who_takes_no_more_ends_it() {
        let full = || Err(Error::Internal { what: "full".into(), at: point(0.0, 0.0) });
        assert!(in_parts(&moves().into(), &Setup::new(crate::Units::Mm), 10, |_| full()).is_err());
    }

    #[test]
    fn a_part_with_a_fault_is_an_error() {
        let mut moves = moves();
        moves.push(Move::Feed { to: Point3 { x: f64::NAN, y: 0.0, z: 0.0 }, rate: 1.0 });
        assert!(in_parts(&moves.into(), &Setup::new(crate::Units::Mm), 100, |_| Ok(())).is_err());
    }
}
