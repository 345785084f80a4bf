//! Level sets on the other side of a pocket: around a part, and in its holes.
//!
//! **Needs** a pocket. **Guarantees** the boundary of what lies outside of the pocket and farther than `d`
//! from it, as [`Mat::level`] would: the inner side, here the one away from the pocket, is on the left, so
//! the loop around the pocket runs clockwise and those in its islands counter-clockwise.
//! **Does not** know other pockets of the drawing, nor open curves: what does not close bounds nothing.
//!
//! **Method.** Islands are pockets themselves, and no way leads from one to the other but through the
//! pocket. What is outside of the outer loop is made a pocket by a box around it, so far away that
//! nothing nearer to the pocket than the reach is as near to the box.

use super::level::Level;
use crate::boundary::Pocket;
use crate::error::Error;
use crate::geom::ArcSpline;
use crate::mat::Mat;
use rayon::prelude::*;

/// Distance of the box in units of the reach. What is at the reach from the pocket is at two of them
/// from the box, and so nothing of its levels hangs on the box.
const MARGIN: f64 = 3.0;

/// The other side of a pocket, for levels up to a reach.
#[derive(Clone, Debug)]
pub struct Exterior {
    /// The axis between the outer loop and the box, which is loop 0 of it.
    around: Mat,
    /// The axis of each island.
    islands: Vec<Mat>,
    reach: f64,
}

impl Pocket {
    /// The level set at distance `d` outside of the pocket and in its islands: the boundary of all that is
    /// farther away. For many distances make the [`Exterior`] once.
    ///
    /// ```
    /// use medial::{ArcSpline, Pocket, Tolerance, point};
    ///
    /// let square = ArcSpline::closed([(0.0, 0.0, 0.0), (8.0, 0.0, 0.0), (8.0, 8.0, 0.0), (0.0, 8.0, 0.0)]);
    /// let pocket = Pocket::from_loops(vec![square, ArcSpline::circle(point(4.0, 4.0), 2.0)], Tolerance::MM)?;
    /// let level = pocket.outward(1.0)?;
    /// let around = 4.0 * 8.0 + 2.0 * std::f64::consts::PI;
    /// assert_eq!(level.loops.len(), 2);
    /// assert!((level.loops[0].length() - around).abs() < 1e-12);
    /// assert!(medial::verify::outward(pocket.loops(), 1.0, &level.loops).is_right());
    /// # Ok::<(), medial::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pocket::exterior`].
    pub fn outward(&self, d: f64) -> Result<Level, Error> {
        Ok(self.exterior(d)?.level(d))
    }

    /// The other side of the pocket, for levels up to `reach` (job units, above 0).
    ///
    /// # Errors
    /// [`Error::Parameter`] when the reach is no such length, or so large that the pocket is round-off
    /// beside it; [`Error::Internal`] as [`Pocket::medial_axis`].
    pub fn exterior(&self, reach: f64) -> Result<Exterior, Error> {
        let bounds = self.bounds();
        if !(reach > 0.0 && reach * f64::EPSILON.sqrt() < bounds.diagonal()) {
            let range = "above 0 and no more than 67,108,864 times as large as the pocket";
            return Err(Error::Parameter { name: "distance", value: reach, range });
        }
        let bounds = bounds.grown(MARGIN * reach);
        let (low, high) = (bounds.min, bounds.max);
        let frame = ArcSpline::closed([
            (low.x, low.y, 0.0),
            (high.x, low.y, 0.0),
            (high.x, high.y, 0.0),
            (low.x, high.y, 0.0),
        ]);
        let around = Pocket::from_checked(frame, vec![self.outer().reversed()]).medial_axis()?;
        let island = |l: &ArcSpline| Pocket::from_checked(l.reversed(), Vec::new()).medial_axis();
        let islands = self.islands().par_iter().map(island).collect::<Result<_, _>>()?;
        Ok(Exterior { around, islands, reach })
    }
}

impl Exterior {
    /// The level set at distance `d`, in job units: around the pocket first, then in its islands. Empty
    /// unless `d` is above 0 and at most the reach.
    pub fn level(&self, d: f64) -> Level {
        if !(d > 0.0 && d <= self.reach) {
            return Level { distance: d, ..Level::default() };
        }
        let mut level = self.around.level_beside(d, 0);
        for island in &self.islands {
            let inner = island.level(d);
            level.loops.extend(inner.loops);
            level.ridges.extend(inner.ridges);
        }
        level
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Tolerance;
    use crate::geom::point;
    use std::f64::consts::PI;

    fn pocket(loops: Vec<ArcSpline>) -> Pocket {
        Pocket::from_loops(loops, Tolerance::MM).unwrap()
    }

    /// A part with a bay 2 wide at its mouth and 6 inside, and a bore.
    fn bay() -> Pocket {
        let wall = ArcSpline::closed(
            [
                (0.0, 0.0),
                (20.0, 0.0),
                (20.0, 20.0),
                (11.0, 20.0),
                (11.0, 16.0),
                (13.0, 16.0),
                (13.0, 10.0),
                (7.0, 10.0),
                (7.0, 16.0),
                (9.0, 16.0),
                (9.0, 20.0),
                (0.0, 20.0),
            ]
            .map(|(x, y)| (x, y, 0.0)),
        );
        pocket(vec![wall, ArcSpline::circle(point(3.0, 5.0), 2.0)])
    }

    #[test]
    fn a_bay_with_a_narrow_mouth_keeps_a_loop_of_its_own() {
        let exterior = bay().exterior(5.0).unwrap();
        let areas = |d: f64| {
            let mut areas: Vec<f64> = exterior.level(d).loops.iter().map(ArcSpline::area).collect();
            areas.sort_by(f64::total_cmp);
            areas
        };
        // Through the mouth at 0.5; closed off at 1.5; at 3 the bay is gone, at 2 the bore.
        assert_eq!((areas(0.5).len(), areas(1.5).len(), areas(2.0).len(), areas(3.5).len()), (2, 3, 2, 1));
        let [around, bore, inside] = areas(1.5)[..] else { panic!() };
        assert!((around + 400.0 + 4.0 * 20.0 * 1.5 + PI * 2.25).abs() < 2.0 && around < 0.0);
        assert!((bore - 0.25 * PI).abs() < 1e-12 && (inside - 9.0).abs() < 0.5);
    }

    #[test]
    fn levels_outside_are_judged_right() {
        let pocket = bay();
        let exterior = pocket.exterior(40.0).unwrap();
        for d in [0.1, 0.5, 0.999, 1.0, 1.001, 2.0, 2.5, 3.0, 7.0, 40.0] {
            let level = exterior.level(d);
            let all: Vec<ArcSpline> = level.loops.iter().chain(&level.ridges).cloned().collect();
            let report = crate::verify::outward(pocket.loops(), d, &all);
            assert!(report.is_right(), "{d}: {report:?}");
            let alone = pocket.outward(d).unwrap();
            assert_eq!(alone.loops.len(), level.loops.len());
        }
    }

    #[test]
    fn lengths_that_are_none_are_errors_and_what_is_beyond_the_reach_is_empty() {
        let pocket = bay();
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
            assert!(matches!(pocket.outward(bad), Err(Error::Parameter { .. })), "{bad}");
        }
        assert!(pocket.exterior(1.0).unwrap().level(1.1).is_empty());
    }
}
