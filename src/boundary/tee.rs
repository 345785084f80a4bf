//! Ends that lie on other curves.
//!
//! **Needs** clean paths. **Guarantees** that an end of an open curve that has no other end within
//! reach, but a curve, lies on that curve to round-off, and that an open curve on which an end lies
//! ends there itself. **Does not** move anything else, nor an end by more than the reach.
//!
//! **Method.** Curves are cut where ends come to lie on them before ends are moved, so that of two
//! curves that run side by side for a while each has a part between the same two places.

use super::arrange::filed;
use super::chain::Contour;
use super::grain::Grain;
use super::index::Index;
use crate::geom::{ArcSpline, Bounds, Element, Point, Vertex};
use std::collections::HashMap;

/// Open curves with their places in the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Loose {
    pub paths: Vec<ArcSpline>,
    pub ranks: Vec<usize>,
}

/// An end of an open curve: its number and whether it is the last vertex.
type End = (usize, bool);

/// Where an end comes to lie on a curve.
#[derive(Clone, Copy, Debug)]
struct Tee {
    end: End,
    /// Number of the curve, contours after open ones, and of its element.
    on: (usize, usize),
    place: Point,
    distance: f64,
    /// Whether it is no end of the element.
    is_inner: bool,
}

/// Moves lone ends onto the curves that they lie on.
pub(super) fn attach(loose: Loose, contours: &[Contour], join: f64, grain: Grain) -> Loose {
    let lone = lone_ends(&loose.paths, join);
    if lone.is_empty() {
        return loose;
    }
    let all: Vec<&ArcSpline> = loose.paths.iter().chain(contours.iter().map(|c| &c.path)).collect();
    let mut tees = tees(&all, &lone, join + grain.same);
    tees.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.end.cmp(&b.end)));
    let mut moved: HashMap<End, Point> = HashMap::new();
    let mut cuts: HashMap<usize, Vec<(usize, Point)>> = HashMap::new();
    let is_lone: HashMap<End, Point> = lone.iter().map(|&e| (e, place(&loose.paths, e))).collect();
    for tee in tees {
        if moved.contains_key(&tee.end) {
            continue;
        }
        // Two ends that overshoot each other are trimmed to where the curves meet.
        let beyond = [false, true].map(|last| (tee.on.0, last)).into_iter().find(|end| {
            !moved.contains_key(end) && is_lone.get(end).is_some_and(|p| p.distance(tee.place) <= join)
        });
        if let Some(other) = beyond.filter(|&o| o != tee.end) {
            moved.extend([(tee.end, tee.place), (other, tee.place)]);
            continue;
        }
        moved.insert(tee.end, tee.place);
        if tee.on.0 < loose.paths.len() {
            cuts.entry(tee.on.0).or_default().push((tee.on.1, tee.place));
        }
    }
    cut_and_moved(&loose, &cuts, &moved)
}

/// Open curves cut at places on their elements, and with some of their ends moved.
fn cut_and_moved(
    loose: &Loose,
    cuts: &HashMap<usize, Vec<(usize, Point)>>,
    moved: &HashMap<End, Point>,
) -> Loose {
    let mut found = Loose::default();
    for (i, path) in loose.paths.iter().enumerate() {
        let mut pieces = cut(path, cuts.get(&i).map_or(&[], Vec::as_slice));
        let last = pieces.len() - 1;
        if let Some(&p) = moved.get(&(i, false)) {
            pieces[0].vertices[0].point = p;
        }
        if let (Some(&p), Some(end)) = (moved.get(&(i, true)), pieces[last].vertices.last_mut()) {
            end.point = p;
        }
        found.ranks.extend(pieces.iter().map(|_| loose.ranks[i]));
        found.paths.extend(pieces);
    }
    found
}

/// Moves the ends of open curves onto the contours that they lie on, to vertices first.
pub(super) fn settle_on(curves: &mut [ArcSpline], contours: &[Contour], join: f64, grain: Grain) {
    let all: Vec<&ArcSpline> = contours.iter().map(|c| &c.path).collect();
    let ends: Vec<End> = (0..curves.len()).flat_map(|i| [(i, false), (i, true)]).collect();
    let places: Vec<Point> = ends.iter().map(|&e| place(curves, e)).collect();
    let near = Near::new(&all);
    for (&(curve, last), &p) in ends.iter().zip(&places) {
        let none = 0..0;
        if let Some(found) = near.find(p, join + grain.same, (usize::MAX, none)) {
            let path = &mut curves[curve];
            let vertex = if last { path.len() } else { 0 };
            path.vertices[vertex].point = found.place;
        }
    }
}

fn place(paths: &[ArcSpline], (curve, last): End) -> Point {
    let vertices = &paths[curve].vertices;
    vertices[if last { vertices.len() - 1 } else { 0 }].point
}

/// Ends that have no other end within reach.
fn lone_ends(paths: &[ArcSpline], join: f64) -> Vec<End> {
    let ends: Vec<End> = (0..paths.len()).flat_map(|i| [(i, false), (i, true)]).collect();
    let places: Vec<Point> = ends.iter().map(|&e| place(paths, e)).collect();
    let mut count: HashMap<(u64, u64), u32> = HashMap::with_capacity(places.len());
    for p in &places {
        *count.entry((p.x.to_bits(), p.y.to_bits())).or_default() += 1;
    }
    let single: Vec<usize> =
        (0..ends.len()).filter(|&i| count[&(places[i].x.to_bits(), places[i].y.to_bits())] == 1).collect();
    if single.is_empty() {
        return Vec::new();
    }
    let tree = Index::new(&places.iter().map(|&p| Bounds { min: p, max: p }).collect::<Vec<_>>());
    let is_lone = |i: usize| {
        let p = places[i];
        let mut lone = true;
        tree.walk(
            &mut lone,
            |lone, _, b| (*lone && b.nearest(p).distance(p) <= join).then_some(0.0),
            |lone, other| *lone &= other as usize == i,
        );
        lone
    };
    single.into_iter().filter(|&i| is_lone(i)).map(|i| ends[i]).collect()
}

/// For each lone end the nearest curve within reach.
fn tees(all: &[&ArcSpline], lone: &[End], reach: f64) -> Vec<Tee> {
    let near = Near::new(all);
    let find = |&end: &End| {
        let p = all[end.0].vertices[if end.1 { all[end.0].len() } else { 0 }].point;
        let own = own_elements_near(all[end.0], end.1, reach);
        let found = near.find(p, reach, (end.0, own))?;
        Some(Tee { end, ..found })
    };
    lone.iter().filter_map(find).collect()
}

/// Curves prepared for the search of the nearest one.
struct Near {
    elements: Vec<Element>,
    /// Curve and number of each element.
    owners: Vec<(usize, usize)>,
    filed: Vec<u32>,
    tree: Index,
}

impl Near {
    fn new(curves: &[&ArcSpline]) -> Near {
        let owners: Vec<(usize, usize)> =
            curves.iter().enumerate().flat_map(|(i, p)| (0..p.len()).map(move |e| (i, e))).collect();
        let elements: Vec<Element> = owners.iter().map(|&(i, e)| curves[i].element(e)).collect();
        let (boxes, filed) = filed(elements.iter().copied(), 0.0);
        Near { elements, owners, filed, tree: Index::new(&boxes) }
    }

    /// The nearest place within reach that is not on some elements of a curve; the end that looks
    /// for it is not known here.
    fn find(&self, p: Point, reach: f64, not_on: (usize, std::ops::Range<usize>)) -> Option<Tee> {
        let mut best: Option<Tee> = None;
        self.tree.walk(
            &mut best,
            |_, _, b| Some(b.nearest(p).distance(p)).filter(|gap| *gap <= reach),
            |best, piece| {
                let number = self.filed[piece as usize] as usize;
                let on = self.owners[number];
                if on.0 == not_on.0 && not_on.1.contains(&on.1) {
                    return;
                }
                let (place, distance, is_inner) = nearest(&self.elements[number], p, reach);
                let key = (is_inner, distance, on);
                let is_better = best.is_none_or(|b| key < (b.is_inner, b.distance, b.on));
                if distance <= reach && is_better {
                    *best = Some(Tee { end: (usize::MAX, false), on, place, distance, is_inner });
                }
            },
        );
        best
    }
}

/// The place of an element nearest to `p`, how far it is, and whether it is no end of the element:
/// an end is taken where one is within reach.
fn nearest(element: &Element, p: Point, reach: f64) -> (Point, f64, bool) {
    let (a, b) = (element.start.distance(p), element.end.distance(p));
    if a.min(b) <= reach {
        return if a <= b { (element.start, a, false) } else { (element.end, b, false) };
    }
    let found = element.nearest(p);
    (found.point, found.distance, true)
}

/// How far along its own curve an end must come back to, in reaches, to lie on it: nearer, it is a
/// neighbor only.
const WAY_BACK: f64 = 4.0;

/// The elements of a curve that are near to one of its ends along the curve.
fn own_elements_near(path: &ArcSpline, last: bool, reach: f64) -> std::ops::Range<usize> {
    let n = path.len();
    let (mut way, mut count) = (0.0, 0);
    while count < n && way <= WAY_BACK * reach {
        way += path.element(if last { n - 1 - count } else { count }).length();
        count += 1;
    }
    if last { n - count..n } else { 0..count }
}

/// A path cut at places on its elements.
fn cut(path: &ArcSpline, cuts: &[(usize, Point)]) -> Vec<ArcSpline> {
    let mut sorted: Vec<(usize, f64, Point)> = cuts
        .iter()
        .map(|&(element, p)| {
            let e = path.element(element);
            let parameter = if p == e.end { 1.0 } else { e.parameter(p).clamp(0.0, 1.0) };
            (element, if p == e.start { 0.0 } else { parameter }, p)
        })
        .collect();
    sorted.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut pieces = Vec::new();
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut rest = &sorted[..];
    for (i, e) in path.elements().enumerate() {
        let own;
        (own, rest) = rest.split_at(rest.partition_point(|c| c.0 <= i));
        let (mut at, mut from) = (e.start, 0.0);
        let bulge = |from: f64, to: f64| {
            if (from, to) == (0.0, 1.0) { e.bulge } else { (e.bulge.atan() * (to - from)).tan() }
        };
        for &(_, t, p) in own {
            if p != at {
                vertices.push(Vertex { point: at, bulge: bulge(from, t) });
                (at, from) = (p, t);
            }
            if !vertices.is_empty() {
                vertices.push(Vertex { point: p, bulge: 0.0 });
                pieces.push(ArcSpline { vertices: std::mem::take(&mut vertices), closed: false });
            }
        }
        if at != e.end {
            vertices.push(Vertex { point: at, bulge: bulge(from, 1.0) });
        }
    }
    if !vertices.is_empty() {
        vertices.push(Vertex { point: path.vertices[path.len()].point, bulge: 0.0 });
        pieces.push(ArcSpline { vertices, closed: false });
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    const JOIN: f64 = 0.01;

    fn attached(paths: &[ArcSpline], contours: &[ArcSpline]) -> Vec<ArcSpline> {
        let bounds = paths.iter().chain(contours).fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        let contours: Vec<Contour> =
            contours.iter().map(|p| Contour { path: p.clone(), rank: 0, loose: false }).collect();
        let loose = Loose { paths: paths.to_vec(), ranks: vec![0; paths.len()] };
        attach(loose, &contours, JOIN, Grain::of(&bounds)).paths
    }

    fn line(a: (f64, f64), b: (f64, f64)) -> ArcSpline {
        ArcSpline::open([(a.0, a.1, 0.0), (b.0, b.1, 0.0)])
    }

    #[test]
    fn a_line_is_cut_where_another_one_ends_on_it() {
        let found = attached(&[line((0.0, 0.0), (10.0, 0.0)), line((4.0, 0.007), (4.0, 5.0))], &[]);
        let expected =
            [line((0.0, 0.0), (4.0, 0.0)), line((4.0, 0.0), (10.0, 0.0)), line((4.0, 0.0), (4.0, 5.0))];
        assert_eq!(found, expected);
    }

    #[test]
    fn an_end_beyond_reach_stays_and_contours_are_not_cut() {
        let far = [line((0.0, 0.0), (10.0, 0.0)), line((4.0, 0.02), (4.0, 5.0))];
        assert_eq!(attached(&far, &[]), far);
        let circle = ArcSpline::circle(point(0.0, 0.0), 3.0);
        let found = attached(&[line((3.005, 0.0), (9.0, 0.0))], std::slice::from_ref(&circle));
        assert_eq!(found, [line((3.0, 0.0), (9.0, 0.0))]);
    }

    #[test]
    fn lines_that_overshoot_each_other_end_where_they_cross() {
        let found = attached(&[line((-0.009, 0.0), (9.0, 0.0)), line((0.0, 9.0), (0.0, -0.009))], &[]);
        assert_eq!(found, [line((0.0, 0.0), (9.0, 0.0)), line((0.0, 9.0), (0.0, 0.0))]);
    }

    #[test]
    fn a_curve_that_comes_back_to_itself_is_cut_there() {
        let six = ArcSpline::open([
            (0.0, 9.0, 0.0),
            (0.0, 0.0, 0.0),
            (5.0, 0.0, 0.0),
            (5.0, 4.0, 0.0),
            (0.001, 4.0, 0.0),
        ]);
        let found = attached(&[six], &[]);
        assert_eq!(found.iter().map(ArcSpline::len).collect::<Vec<_>>(), [1, 4]);
        assert_eq!(found[1].vertices[4].point, point(0.0, 4.0));
    }
}
