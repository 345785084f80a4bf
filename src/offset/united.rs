//! Equal disks that overlap: what is counted more than once.

use crate::geom::Point;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use std::f64::consts::{PI, TAU};

/// By how much the areas of some disks of one radius add up to more than the area of their union.
///
/// Green's theorem on the union: of each circle the arcs that no other disk covers. Takes time in
/// proportion to the pairs that overlap.
pub(super) fn overlap(centers: &[Point], radius: f64) -> f64 {
    let disk = |(i, c): (usize, &Point)| GeomWithData::new([c.x, c.y], i);
    let tree = RTree::bulk_load(centers.iter().enumerate().map(disk).collect());
    let uncovered = |i: usize| -> f64 {
        let center = centers[i];
        let reach = 4.0 * radius * radius;
        let mut covered: Vec<(f64, f64)> = Vec::new();
        for other in tree.locate_within_distance([center.x, center.y], reach) {
            let to = centers[other.data] - center;
            let apart = to.length();
            if apart == 0.0 && other.data != i {
                // Of equal disks the first counts.
                if other.data < i {
                    return 0.0;
                }
            } else if other.data != i {
                let half = (0.5 * apart / radius).min(1.0).acos();
                let from = (to.y.atan2(to.x) - half).rem_euclid(TAU);
                covered.push((from, from + 2.0 * half));
            }
        }
        free_area(center, radius, covered)
    };
    let union: f64 = (0..centers.len()).map(uncovered).sum();
    centers.len() as f64 * PI * radius * radius - union
}

/// What the arcs of a circle outside of some ranges of angles (each beginning in 0..2 pi) contribute to
/// the enclosed area.
fn free_area(center: Point, radius: f64, mut covered: Vec<(f64, f64)>) -> f64 {
    covered.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Ranges that run over the end of the turn cover its beginning.
    let mut at = covered.iter().map(|c| c.1 - TAU).fold(0.0, f64::max);
    let mut area = 0.0;
    for (from, to) in covered.into_iter().chain([(TAU, TAU)]) {
        if from > at {
            let ((s0, c0), (s1, c1)) = (at.sin_cos(), from.sin_cos());
            let arc = radius * (from - at) + center.x * (s1 - s0) - center.y * (c1 - c0);
            area += 0.5 * radius * arc;
        }
        at = at.max(to);
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn two_disks_share_a_lens_and_three_no_more_than_there_is() {
        let lens = |apart: f64| {
            let half = 0.5 * apart;
            2.0 * (half.acos() - half * (1.0 - half * half).sqrt())
        };
        for (x, y) in [(0.7, 0.0), (-0.3, 1.1), (0.0, -1.9), (3.0, 0.0)] {
            let pair = [point(5.0, 5.0), point(5.0 + x, 5.0 + y)];
            let known = if x > 2.0 { 0.0 } else { lens(x.hypot(y)) };
            assert!((overlap(&pair, 1.0) - known).abs() < 1e-13, "{x} {y}");
        }
        let same = [point(1.0, 2.0); 3];
        assert!((overlap(&same, 2.0) - 8.0 * PI).abs() < 1e-13);
        assert_eq!((overlap(&[], 1.0), overlap(&same[..1], 1.0).abs() < 1e-14), (0.0, true));
        // Three disks through one point, a unit from each center: pairs share lenses that meet there only.
        let three = [0.0, 1.0, 2.0].map(|k: f64| point((k * TAU / 3.0).cos(), (k * TAU / 3.0).sin()));
        assert!((overlap(&three, 1.0) - 3.0 * lens(3f64.sqrt())).abs() < 1e-13);
        // With larger ones the middle is in all three: by brute force.
        let n = 600;
        let cell = 6.0 / f64::from(n);
        let counted: i32 = (0..n * n)
            .map(|i| {
                let p = point(cell * (f64::from(i / n) + 0.5) - 3.0, cell * (f64::from(i % n) + 0.5) - 3.0);
                (three.iter().filter(|c| c.distance(p) < 1.4).count() as i32 - 1).max(0)
            })
            .sum();
        assert!((overlap(&three, 1.4) - f64::from(counted) * cell * cell).abs() < 0.01);
    }
}
