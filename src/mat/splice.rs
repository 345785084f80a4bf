//! Loops that touch, taken apart at the touching points.
//!
//! Where loops touch in a point, the interior meets the point in several sectors. Instead of going
//! on along its own loop, the boundary is made to turn into the sector it bounds: arriving at the
//! point, it leaves by the next element clockwise. An island that touches the wall becomes a part
//! of the outer loop that way, two islands become one, and every sector is an ordinary corner. The
//! touching points are known by their coordinates, equal to the last bit (see [`Pocket`]).
//!
//! [`Pocket`]: crate::Pocket

use super::frame::Frame;
use crate::boundary::TOUCHING_ULPS;
use crate::geom::{ArcSpline, Element, Point, Vector};

/// A drawn element in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    pub element: Element,
    pub loop_index: u32,
    pub index: u32,
}

/// The elements of the loops, as loops that go on by sectors, one after the other.
pub(super) fn splice<'a>(
    loops: impl Iterator<Item = &'a ArcSpline>,
    frame: &Frame,
) -> impl Iterator<Item = Vec<Drawn>> {
    let Row { elements, mut next, prev } = Row::of(loops, frame);
    for touching in touching_vertices(&elements) {
        turn_into_sectors(&elements, &touching, &prev, &mut next, frame.noise);
    }
    follow(elements, next)
}

/// All elements in one row, with their neighbors on their own loops.
struct Row {
    elements: Vec<Drawn>,
    next: Vec<u32>,
    prev: Vec<u32>,
}

impl Row {
    fn of<'a>(loops: impl Iterator<Item = &'a ArcSpline>, frame: &Frame) -> Row {
        let mut row = Row { elements: Vec::new(), next: Vec::new(), prev: Vec::new() };
        for (loop_index, spline) in loops.enumerate() {
            let (first, count) = (row.elements.len(), spline.len());
            row.elements.reserve(count);
            for (index, e) in spline.elements().enumerate() {
                let element =
                    Element { start: frame.enter(e.start), end: frame.enter(e.end), bulge: e.bulge };
                row.elements.push(Drawn { element, loop_index: loop_index as u32, index: index as u32 });
            }
            let on_loop = |index: usize| (first + index) as u32;
            row.next.extend((1..count).chain([0]).map(on_loop));
            row.prev.extend([count - 1].into_iter().chain(0..count - 1).map(on_loop));
        }
        row
    }
}

/// For each place where more than one element begins: those elements.
fn touching_vertices(elements: &[Drawn]) -> Vec<Vec<u32>> {
    same_places((0u32..).zip(elements.iter().map(|drawn| drawn.element.start)))
}

/// Cells to a place: an eighth of all places shares one with another by chance.
const CELLS: usize = 8;

/// Bits of a word.
const WORD: usize = u64::BITS as usize;

/// Numbers whose places are equal to the last bit, those of each place in order.
pub(super) fn same_places(places: impl Iterator<Item = (u32, Point)> + Clone) -> Vec<Vec<u32>> {
    // Few places share a cell, and only those are sorted.
    let cells = (CELLS * places.clone().count()).next_power_of_two().max(WORD);
    let cell = |p: Point| hash(place_key(p)) as usize & (cells - 1);
    let [mut taken, mut shared] = [vec![0u64; cells / WORD], vec![0u64; cells / WORD]];
    for cell in places.clone().map(|(_, p)| cell(p)) {
        let (at, bit) = (cell / WORD, 1 << (cell % WORD));
        shared[at] |= taken[at] & bit;
        taken[at] |= bit;
    }
    let is_shared = |cell: usize| shared[cell / WORD] >> (cell % WORD) & 1 == 1;
    let mut found: Vec<([u64; 2], u32)> =
        places.filter(|&(_, p)| is_shared(cell(p))).map(|(i, p)| (place_key(p), i)).collect();
    found.sort_unstable();
    let groups = found.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
    groups.map(|group| group.iter().map(|&(_, i)| i).collect()).collect()
}

/// Bits of a place, the same for both zeros.
fn place_key(p: Point) -> [u64; 2] {
    [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]
}

/// Bits that tell nearly all places apart; no order is taken from them. Both halves of a product depend on all bits
/// of its factors; the odd numbers are the golden ratio and the root of two.
fn hash([x, y]: [u64; 2]) -> u64 {
    let product = u128::from(x ^ 0x9E37_79B9_7F4A_7C15) * u128::from(y ^ 0xB504_F333_F9DE_6485);
    (product >> 64) as u64 ^ product as u64
}

/// One end of an element at a touching point.
struct Ray {
    /// Direction away from the point and its angle.
    direction: Vector,
    angle: f64,
    /// Curvature to the left, going away.
    curvature: f64,
    /// Length of the chord.
    length: f64,
    element: u32,
    arrives: bool,
}

/// Makes every element that arrives at the touching point go on by the next one clockwise.
fn turn_into_sectors(elements: &[Drawn], starting: &[u32], prev: &[u32], next: &mut [u32], noise: f64) {
    let mut rays = Vec::with_capacity(2 * starting.len());
    for &out in starting {
        let before = prev[out as usize];
        rays.push(ray(&elements[out as usize].element, out, false));
        rays.push(ray(&elements[before as usize].element.reversed(), before, true));
    }
    sort_clockwise(&mut rays, noise);
    let n = rays.len();
    let sectors: Vec<(u32, u32)> = (0..n)
        .filter(|&i| rays[i].arrives && !rays[(i + 1) % n].arrives)
        .map(|i| (rays[i].element, rays[(i + 1) % n].element))
        .collect();
    // Anything but an alternation of arriving and leaving would be a crossing: leave it alone then.
    if sectors.len() == starting.len() {
        for (arriving, leaving) in sectors {
            next[arriving as usize] = leaving;
        }
    }
}

/// Roundings in the direction of an element: two in each difference of coordinates, and those of
/// its unit vector and its turn by half the sweep.
pub(super) const TANGENT_ROUNDINGS: f64 = 8.0;

fn ray(away: &Element, element: u32, arrives: bool) -> Ray {
    let (direction, length) = (away.tangents().0, away.chord().length());
    Ray { direction, angle: direction.angle(), curvature: away.curvature(), length, element, arrives }
}

/// Clockwise by direction; rays of one direction by how far to the left they get, the leftmost first. The
/// place where two loops touch is on both but for what a pocket may overlap by, and so are directions there.
fn sort_clockwise(rays: &mut [Ray], noise: f64) {
    rays.sort_by(|a, b| b.angle.total_cmp(&a.angle));
    let apart = TOUCHING_ULPS * noise;
    // Of rays that leave a hair apart and bend over each other, too, the place where they meet again counts.
    let tangent = |a: &Ray, b: &Ray| {
        let (sine, bend) = (a.direction.cross(b.direction).abs(), b.curvature - a.curvature);
        a.direction.dot(b.direction) > 0.0
            && (sine <= apart / a.length + apart / b.length || sine * sine <= 2.0 * apart * bend)
    };
    // Begin at a gap between directions, so that no bundle of tangent rays is cut by the turn's end.
    let n = rays.len();
    if let Some(gap) = (0..n).find(|&i| !tangent(&rays[(i + n - 1) % n], &rays[i])) {
        rays.rotate_left(gap);
    }
    let mut first = 0;
    for i in 1..=n {
        if i == n || !tangent(&rays[i - 1], &rays[i]) {
            sort_bundle(&mut rays[first..i]);
            first = i;
        }
    }
}

/// Rays of nearly one direction, the leftmost first: where half of the shortest is passed.
fn sort_bundle(rays: &mut [Ray]) {
    let half = 0.5 * rays.iter().map(|r| r.length).fold(f64::INFINITY, f64::min);
    let ahead = rays[0].direction;
    let left = |r: &Ray| ahead.cross(r.direction) + 0.5 * half * r.curvature;
    rays.sort_by(|a, b| left(b).total_cmp(&left(a)));
}

/// The closed loops that `next` describes, in the order of their first elements.
fn follow(elements: Vec<Drawn>, next: Vec<u32>) -> impl Iterator<Item = Vec<Drawn>> {
    let mut seen = vec![false; elements.len()];
    (0..elements.len()).filter_map(move |first| {
        let mut row = Vec::new();
        let mut at = first;
        while !seen[at] {
            seen[at] = true;
            row.push(elements[at]);
            at = next[at] as usize;
        }
        (!row.is_empty()).then_some(row)
    })
}
