//! Level sets at many distances, one after the other.

use super::level::Level;
use crate::mat::Mat;

/// The level sets at some distances; [`Mat::level_sets`] makes it. Each is made when it is asked for, and
/// nothing of it is kept.
#[derive(Clone, Debug)]
pub struct LevelSets<'a, I> {
    mat: &'a Mat,
    distances: I,
}

impl Mat {
    /// The level sets at some distances, in job units, in their order: each the same as [`Mat::level`]
    /// gives, to the last bit.
    ///
    /// A level takes time in proportion to what it holds: the pieces of the boundary that it follows and
    /// the edges of the axis that it crosses, which an index by radius finds. So ten thousand levels need
    /// no more memory than one, and one high up in a large pocket costs next to nothing.
    ///
    /// ```
    /// use medial::{ArcSpline, Pocket, Tolerance, point};
    ///
    /// let disk = ArcSpline::circle(point(0.0, 0.0), 5.0);
    /// let mat = Pocket::from_loops(vec![disk], Tolerance::MM)?.medial_axis()?;
    /// let steps = (1..).map(|k| 0.001 * f64::from(k));
    /// let radii = mat.level_sets(steps).map_while(|level| Some(level.loops.first()?.length()));
    /// assert_eq!(radii.count(), 4999);
    /// # Ok::<(), medial::Error>(())
    /// ```
    pub fn level_sets<I>(&self, distances: I) -> LevelSets<'_, I::IntoIter>
    where
        I: IntoIterator<Item = f64>,
    {
        LevelSets { mat: self, distances: distances.into_iter() }
    }
}

impl<I: Iterator<Item = f64>> Iterator for LevelSets<'_, I> {
    type Item = Level;

    fn next(&mut self) -> Option<Level> {
        self.distances.next().map(|d| self.mat.level(d))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.distances.size_hint()
    }
}
