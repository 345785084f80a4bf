//! Offsets of unknown direction turned as the judge wants them.

use super::boundary::Boundary;
use super::level::ASIDE;
use crate::geom::{ArcSpline, Element};
use rayon::prelude::*;

/// Elements of a loop that are asked which side is farther from the boundary, the longest first.
const ASKED: usize = 8;

impl Boundary {
    /// Loops of any direction turned so that what is farther from the boundary lies on their left, on
    /// whichever side of the boundary they are. A loop that has no such side, as one far off, stays.
    pub fn turned(&self, offsets: &[ArcSpline]) -> Vec<ArcSpline> {
        let turn =
            |l: &ArcSpline| if l.closed && self.grows_left_of(l) < 0.0 { l.reversed() } else { l.clone() };
        offsets.par_iter().map(turn).collect()
    }

    /// By how much the distance grows from the right of a loop to the left, in all places asked.
    fn grows_left_of(&self, spline: &ArcSpline) -> f64 {
        let mut elements: Vec<Element> =
            spline.elements().filter(|e| e.chord().length_squared() > 0.0).collect();
        let length = |e: &Element| e.chord().length_squared();
        elements.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let aside = ASIDE * (self.bounds().magnitude() + spline.bounds().magnitude());
        let grows = |e: &Element| {
            let (at, n) = (e.midpoint(), e.normal_at(0.5) * aside);
            let growth = self.distance(at + n) - self.distance(at - n);
            if growth.is_finite() { growth } else { 0.0 }
        };
        elements.iter().take(ASKED).map(grows).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn loops_are_turned_on_either_side_of_the_boundary() {
        let ring = [ArcSpline::circle(point(0.0, 0.0), 9.0), ArcSpline::circle(point(0.0, 0.0), 4.0)];
        let boundary = Boundary::new(&ring);
        let radii = [2.0, 5.0, 8.0, 10.0];
        let loops: Vec<ArcSpline> = radii.iter().map(|r| ArcSpline::circle(point(0.0, 0.0), *r)).collect();
        for given in [loops.clone(), loops.iter().map(ArcSpline::reversed).collect()] {
            let areas: Vec<bool> = boundary.turned(&given).iter().map(|l| l.area() > 0.0).collect();
            assert_eq!(areas, [true, false, true, false]);
        }
    }
}
