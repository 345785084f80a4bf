//! Equal disks at the ends of an unreachable place: what of their arcs lies in other disks.

use crate::geom::Point;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use std::f64::consts::TAU;

/// A crossing of the level with the axis, and the arc of the disk about it that faces the unreachable
/// place: from an angle on, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facing {
    pub center: Point,
    pub from: f64,
    pub sweep: f64,
}

/// Area that is reached more than once in one unreachable place, by disks of this radius.
///
/// What is reached of it is bounded by those parts of the facing arcs that lie in no other disk. So the
/// sum of all that lies behind the arcs is too large by what the integral of Green gives along their other
/// parts. Centers closer than `same` are one place, where only what all its arcs have in common counts.
/// Takes time in proportion to the pairs that overlap.
pub(super) fn overlap(arcs: &[Facing], radius: f64, same: f64) -> f64 {
    let disk = |(i, a): (usize, &Facing)| GeomWithData::new([a.center.x, a.center.y], i);
    let tree = RTree::bulk_load(arcs.iter().enumerate().map(disk).collect());
    let covered = |(i, arc): (usize, &Facing)| -> f64 {
        let at = [arc.center.x, arc.center.y];
        let others = tree.locate_within_distance(at, 4.0 * radius * radius).map(|o| o.data);
        let mut ranges: Vec<(f64, f64)> = others
            .filter(|&j| j != i)
            .map(|j| {
                let to = arcs[j].center - arc.center;
                let apart = to.length();
                if apart > same {
                    let half = (0.5 * apart / radius).min(1.0).acos();
                    (to.y.atan2(to.x) - half, 2.0 * half)
                } else if j < i {
                    (arc.from, TAU)
                } else {
                    (arcs[j].from + arcs[j].sweep, TAU - arcs[j].sweep)
                }
            })
            // From the beginning of the arc on.
            .map(|(from, sweep)| ((from - arc.from).rem_euclid(TAU), sweep))
            .map(|(from, sweep)| (from, from + sweep))
            .collect();
        ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
        arc.integral(&ranges, radius)
    };
    arcs.iter().enumerate().map(covered).sum()
}

impl Facing {
    /// Integral of Green along the parts of the arc that lie in some ranges, sorted and counted from where
    /// it begins.
    fn integral(&self, ranges: &[(f64, f64)], radius: f64) -> f64 {
        // Ranges that run over the end of the turn cover its beginning.
        let around = ranges.iter().map(|r| r.1 - TAU).fold(0.0, f64::max);
        let mut at = 0.0;
        let mut sum = 0.0;
        for &(from, to) in std::iter::once(&(0.0, around)).chain(ranges) {
            let (from, to) = (from.max(at), to.min(self.sweep));
            if to > from {
                let (s0, c0) = (self.from + from).sin_cos();
                let (s1, c1) = (self.from + to).sin_cos();
                let beside = self.center.x * (s1 - s0) - self.center.y * (c1 - c0);
                sum += 0.5 * radius * (radius * (to - from) + beside);
                at = to;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;
    use std::f64::consts::PI;

    fn facing(x: f64, y: f64, towards: f64, sweep: f64) -> Facing {
        Facing { center: point(5.0 + x, 2.0 + y), from: towards - 0.5 * sweep, sweep }
    }

    fn lens(apart: f64) -> f64 {
        let half = 0.5 * apart;
        2.0 * (half.acos() - half * (1.0 - half * half).sqrt())
    }

    #[test]
    fn two_disks_that_face_each_other_share_a_lens() {
        for apart in [0.3, 1.0, 1.9, 2.5] {
            let pair = [facing(0.0, 0.0, 0.0, PI), facing(apart, 0.0, PI, PI)];
            let known = if apart < 2.0 { lens(apart) } else { 0.0 };
            assert!((overlap(&pair, 1.0, 0.0) - known).abs() < 1e-13, "{apart}");
        }
        assert_eq!(overlap(&[], 1.0, 0.0), 0.0);
        assert_eq!(overlap(&[facing(0.0, 0.0, 1.0, 2.0)], 1.0, 0.0), 0.0);
    }

    #[test]
    fn neighbors_that_look_the_same_way_share_what_lies_before_both() {
        // Side by side, their arcs meet at the top: only what is above the line of centers is counted.
        let pair = [facing(0.0, 0.0, 0.5 * PI, PI), facing(1.0, 0.0, 0.5 * PI, PI)];
        // Below that line lies the reachable part, and the lower half of the lens in it.
        assert!((overlap(&pair, 1.0, 0.0) - (0.5 * lens(1.0) + closing(&pair))).abs() < 1e-13);
    }

    /// The integral along the line from where one arc begins in the other disk to where the other ends.
    fn closing(pair: &[Facing; 2]) -> f64 {
        let (left, right) = (pair[1].center.x - 1.0, pair[0].center.x + 1.0);
        let y = pair[0].center.y;
        0.5 * ((right) * y - left * y)
    }

    #[test]
    fn at_a_neck_of_that_radius_all_of_the_disk_is_reached_twice() {
        let pair = [facing(0.0, 0.0, 0.0, PI), facing(0.0, 0.0, PI, PI)];
        assert!((overlap(&pair, 2.0, 1e-12) - 4.0 * PI).abs() < 1e-12);
    }
}
