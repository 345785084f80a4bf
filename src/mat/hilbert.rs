//! Places along a Hilbert curve: what is near on it is near in the plane.

use crate::geom::Point;

/// Steps of the Hilbert curve along a side of the unit frame.
const SIDE: u32 = 1 << 16;

/// Place of a point of the unit frame along a Hilbert curve.
pub(super) fn hilbert(p: Point) -> u32 {
    let cell = |c: f64| (((c + 1.0) * 0.5 * f64::from(SIDE)) as u32).min(SIDE - 1);
    hilbert_place(cell(p.x), cell(p.y))
}

/// Place of a cell along the curve. At every bit the curve turns by one of four symmetries, and these are
/// composed for all bits at once, by distances 1, 2, 4 and 8 between bits, as a parallel prefix sum.
fn hilbert_place(x: u32, y: u32) -> u32 {
    const ALL: u32 = SIDE - 1;
    let (a, b, c, d) = (x ^ y, ALL ^ x ^ y, ALL ^ (x | y), x & (y ^ ALL));
    // The symmetry so far (`swap`, `turn`) and what it makes of the bits (`even`, `odd`).
    let mut swap = a | (b >> 1);
    let mut turn = (a >> 1) ^ a;
    let mut even = ((c >> 1) ^ (b & (d >> 1))) ^ c;
    let mut odd = ((a & (c >> 1)) ^ (d >> 1)) ^ d;
    for step in [2, 4, 8] {
        let (a, b, c, d) = (swap, turn, even, odd);
        swap = (a & (a >> step)) ^ (b & (b >> step));
        turn = (a & (b >> step)) ^ (b & ((a ^ b) >> step));
        even ^= (a & (c >> step)) ^ (b & (d >> step));
        odd ^= (b & (c >> step)) ^ ((a ^ b) & (d >> step));
    }
    let (a, b) = (even ^ (even >> 1), odd ^ (odd >> 1));
    let low = x ^ y;
    let high = b | (ALL ^ (low | a));
    spread(high) << 1 | spread(low)
}

/// The sixteen low bits at the even places.
fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x00FF_00FF;
    let x = (x | x << 4) & 0x0F0F_0F0F;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hilbert_curve_goes_from_cell_to_neighboring_cell() {
        let mut cells: Vec<(u32, u32, u32)> =
            (0..64 * 64).map(|i| (hilbert_place(i / 64, i % 64), i / 64, i % 64)).collect();
        cells.sort_unstable();
        for (i, w) in (0..).zip(cells.windows(2)) {
            assert_eq!(w[0].0, i);
            assert_eq!(w[0].1.abs_diff(w[1].1) + w[0].2.abs_diff(w[1].2), 1, "{w:?}");
        }
    }
}
