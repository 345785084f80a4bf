//! Loops and dividing curves cut into pieces that lie on no other piece.
//!
//! **Needs** simple loops, counter-clockwise, and open curves, whose common places are common
//! vertices and that do not cross, open ones among themselves apart. **Guarantees** pieces that
//! have nothing in common but vertices; a loop that shares no stretch with anything and on which no
//! open curve ends is one piece and stays as it is.
//!
//! **Method.** The others are cut wherever curves meet. Pieces between the same two places that
//! take the same course are one piece; between an open curve and another one, up to the reach of
//! joining.

use super::grain::Grain;
use super::junction::Junctions;
use crate::geom::ArcSpline;
use std::collections::HashMap;

/// A stretch of the drawing that counts once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// Its course: a closed loop, or open from one meeting place to the next.
    pub path: ArcSpline,
    /// How many more loops are around its left side than around its right side.
    pub rise: i32,
    /// The same for loops that were drawn closed.
    pub drawn_rise: i32,
    /// Whether only loose curves take this course, and no loop that was drawn closed.
    pub loose: bool,
    /// Whether a loop takes this course.
    pub in_loop: bool,
    /// The open curves that take this course.
    pub dividers: Vec<usize>,
}

/// A simple loop, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loop {
    pub path: ArcSpline,
    /// Whether it was drawn as loose curves.
    pub loose: bool,
}

/// Pieces of a drawing.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    pub all: Vec<Piece>,
    /// Where stretches were dropped because they lie on others.
    pub copies: Vec<crate::geom::Point>,
}

impl Pieces {
    /// Loops that touch at most, as they are.
    pub fn plain(loops: Vec<Loop>) -> Pieces {
        Pieces { all: loops.into_iter().map(Piece::plain).collect(), copies: Vec::new() }
    }

    /// Cuts loops and open curves; `reach` is that of joining.
    pub fn of(loops: Vec<Loop>, dividers: &[ArcSpline], reach: f64, grain: Grain) -> Pieces {
        let mut found = Pieces::default();
        let paths: Vec<&ArcSpline> = loops.iter().map(|l| &l.path).chain(dividers).collect();
        let junctions = Junctions::of(&paths, grain);
        let woven = woven(&junctions, loops.len());
        let mut between = Between { known: HashMap::new(), reach, grain };
        for (i, path) in paths.iter().enumerate() {
            let is_divider = i >= loops.len();
            if !is_divider && !woven[i] {
                found.all.push(Piece::plain(loops[i].clone()));
                continue;
            }
            for path in stretches(path, i, &junctions) {
                let piece = Piece {
                    path,
                    rise: i32::from(!is_divider),
                    drawn_rise: i32::from(!is_divider && !loops[i].loose),
                    loose: is_divider || loops[i].loose,
                    in_loop: !is_divider,
                    dividers: is_divider.then(|| i - loops.len()).into_iter().collect(),
                };
                between.add(piece, &mut found);
            }
        }
        found
    }
}

impl Piece {
    fn plain(of: Loop) -> Piece {
        let drawn_rise = i32::from(!of.loose);
        Piece { path: of.path, rise: 1, drawn_rise, loose: of.loose, in_loop: true, dividers: Vec::new() }
    }

    /// Whether it is a whole loop that nothing else takes part in.
    pub fn is_plain(&self) -> bool {
        self.path.closed
    }
}

/// For each loop whether it shares an element with another one or an open curve meets it.
fn woven(junctions: &Junctions, loops: usize) -> Vec<bool> {
    let mut woven = vec![false; loops];
    for &(path, _) in junctions.course.keys() {
        if path < loops {
            woven[path] = true;
        }
    }
    for junction in &junctions.all {
        if junction.strands.iter().any(|s| s.path >= loops) {
            let touched = junction.strands.iter().filter(|s| s.path < loops);
            touched.for_each(|s| woven[s.path] = true);
        }
    }
    woven
}

/// A path cut at its junctions.
fn stretches(path: &ArcSpline, number: usize, junctions: &Junctions) -> Vec<ArcSpline> {
    let n = path.vertices.len();
    let mut cuts: Vec<usize> = (0..n).filter(|&v| junctions.at.contains_key(&(number, v))).collect();
    if path.closed {
        cuts.extend(cuts.first().map(|first| first + n));
    } else {
        cuts.extend([0, n - 1]);
        cuts.sort_unstable();
        cuts.dedup();
    }
    let stretch = |from: usize, to: usize| ArcSpline {
        vertices: (from..=to).map(|v| path.vertices[v % n]).collect(),
        closed: false,
    };
    cuts.windows(2).map(|w| stretch(w[0], w[1])).collect()
}

/// Two places, as bits.
type Ends = [(u64, u64); 2];

/// Stretches by their ends.
struct Between {
    known: HashMap<Ends, Vec<usize>>,
    reach: f64,
    grain: Grain,
}

impl Between {
    fn add(&mut self, mut piece: Piece, to: &mut Pieces) {
        let bits = |v: usize| {
            let p = piece.path.vertices[v].point;
            (p.x.to_bits(), p.y.to_bits())
        };
        let mut ends = [bits(0), bits(piece.path.len())];
        if ends[0] > ends[1] {
            ends.reverse();
            piece.path = piece.path.reversed();
            (piece.rise, piece.drawn_rise) = (-piece.rise, -piece.drawn_rise);
        }
        let known = self.known.entry(ends).or_default();
        for &other in known.iter() {
            let is_loop_pair = piece.in_loop && to.all[other].in_loop;
            let within = if is_loop_pair { 0.0 } else { self.reach };
            let Some(turned) = same_course(&piece.path, &to.all[other].path, within, self.grain) else {
                continue;
            };
            to.copies.push(piece.path.vertices[0].point);
            to.all[other].unite(piece, turned);
            return;
        }
        known.push(to.all.len());
        to.all.push(piece);
    }
}

impl Piece {
    /// Takes in a piece of the same course, in the other direction if `turned`.
    fn unite(&mut self, other: Piece, turned: bool) {
        let sign = if turned { -1 } else { 1 };
        self.rise += sign * other.rise;
        self.drawn_rise += sign * other.drawn_rise;
        self.loose &= other.loose;
        self.in_loop |= other.in_loop;
        self.dividers.extend(other.dividers);
    }
}

/// Middles of elements that coincide may be farther apart than their ends, by both bulges.
const MIDDLES: f64 = 4.0;

/// Stretches that differ by more than this part of their length have different courses, however
/// far the reach: what is small is not rough for that.
const ROUGHNESS: f64 = 1.0 / 16.0;

/// Pairs of places and elements that are compared: limit on effort; beyond it, stretches are the
/// same only element by element.
const COMPARED: usize = 10_000;

/// Whether two stretches with the same ends take the same course: `Some(true)` if in the other
/// direction, which only stretches with one end can.
fn same_course(a: &ArcSpline, b: &ArcSpline, reach: f64, grain: Grain) -> Option<bool> {
    let round = a.vertices[0].point == a.vertices[a.len()].point;
    let exact = |b: &ArcSpline| {
        a.len() == b.len()
            && a.elements().zip(b.elements()).all(|(e, f)| {
                e.end.distance(f.end) <= grain.same
                    && e.midpoint().distance(f.midpoint()) <= MIDDLES * grain.same
            })
    };
    if exact(b) {
        return Some(false);
    }
    if round && exact(&b.reversed()) {
        return Some(true);
    }
    let within = reach.min(ROUGHNESS * a.length().min(b.length()));
    let lies_along = |a: &ArcSpline, b: &ArcSpline| {
        a.elements().all(|e| b.distance(e.end) <= within && b.distance(e.midpoint()) <= within)
    };
    let alike = !round
        && within > 0.0
        && a.len() * b.len() <= COMPARED
        && (a.length() - b.length()).abs() <= 2.0 * within
        && lies_along(a, b)
        && lies_along(b, a);
    alike.then_some(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Bounds;

    fn pieces(loops: &[ArcSpline], dividers: &[ArcSpline]) -> Pieces {
        let bounds = loops.iter().chain(dividers).fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let loops = loops.iter().map(|path| Loop { path: path.clone(), loose: false }).collect();
        Pieces::of(loops, dividers, 0.01, Grain::of(&bounds))
    }

    fn square(x: f64) -> ArcSpline {
        ArcSpline::closed([(x, 0.0, 0.0), (x + 2.0, 0.0, 0.0), (x + 2.0, 2.0, 0.0), (x, 2.0, 0.0)])
    }

    #[test]
    fn a_common_side_is_one_piece_without_rise() {
        let found = pieces(&[square(0.0), square(2.0), square(9.0)], &[]);
        let mut rises: Vec<i32> = found.all.iter().map(|p| p.rise.abs()).collect();
        rises.sort_unstable();
        assert_eq!((rises, found.copies.len()), (vec![0, 1, 1, 1], 1));
        assert_eq!(found.all.iter().filter(|p| p.is_plain()).count(), 1);
    }

    #[test]
    fn a_line_nearly_along_a_side_is_that_side_and_one_across_is_not() {
        let along = ArcSpline::open([(0.0, 0.0, 0.0), (1.0, 0.004, 0.0), (2.0, 0.0, 0.0)]);
        let across = ArcSpline::open([(0.0, 0.0, 0.0), (1.0, 0.1, 0.0), (2.0, 0.0, 0.0)]);
        let found = pieces(&[square(0.0)], &[along, across]);
        assert_eq!((found.all.len(), found.copies.len()), (3, 1));
        let side = found.all.iter().find(|p| p.in_loop && p.path.len() == 1).expect("it is cut off");
        assert_eq!((side.dividers.as_slice(), side.rise.abs(), side.loose), (&[0][..], 1, false));
        assert_eq!(found.all.iter().filter(|p| !p.in_loop).count(), 1);
    }
}
