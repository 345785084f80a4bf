//! Biarcs of equal error between two nodes, as few as will do.
//!
//! **Guarantees** that every biarc is within the tolerance. The nodes depend on the shape of the curve
//! alone, not on its parameter or its direction.
//!
//! **Method.** An arc of length `g` errs by `C |k'| g^3`, where `k'` is the derivative of the curvature
//! by arc length. With the tangents of the curve at all nodes `C` is 1/40.5 for joints in the middle.
//! Turned by `-k' h^2 / 48`, `h` the length of a biarc, they make every arc take the mean curvature of
//! its part, with all joints on the curve: `C` is `sqrt(3) / 216`, the best for arcs with common
//! tangents, and curvatures stay monotone. So the density of biarcs is known from `k'`, and its integral
//! says how many there must be. Nodes at equal shares of it come first; errors measured correct the
//! density, until all are below the tolerance. Beside an arc over an apex the tangent is given: cells
//! there are as narrow as suits it, and where it is too steep that arc has to yield. One arc alone may
//! take the place of a biarc, in the middle, where its tangents are those that its neighbors want.

mod laying;

use super::biarc::{Arc, Node};
use super::density::{Cursor, Density};
use super::few::few;
use super::layout::{Ends, Goal, Layout, Lost, MANY, SPARE, first};
use super::spiral::{Cell, MAX_BIARCS};
use super::track::{Side, Track};

/// A few biarcs may fit in the end though errors say that so many more would be needed.
const FEWER: f64 = 31.0 / 32.0;

/// With so many biarcs by the density at most, a few arcs are searched for: from two for each, less what ends that
/// slide spare, in so many numbers.
const FEW: f64 = 2.25;
const SPARED: f64 = 0.3;
const TRIED: usize = 2;

/// Layouts tried at most, and those with one number of arcs.
const MAX_LAYOUTS: usize = 16;
const MAX_SWEEPS: usize = 2;

/// A biarc beside an arc over an apex that errs by so many tolerances at most fits when that arc gives
/// way a little.
const YIELDING: f64 = 2.0;

/// With more arcs than so many times those that the density says, and some more, it says nothing.
const MOST: f64 = 2.0;
const MOST_MORE: f64 = 24.0;

/// Biarcs on a chord as long as that of the whole part, at least: something, where nothing bends.
const LEAST: f64 = 1.0 / 64.0;

/// A tangent at the end of an arc over an apex that turns more than suits the arc beside it by some part
/// makes that one err more by so many times that part: the arc over the apex should be shorter.
const STEEPNESS: f64 = 1.4;

/// Less than this is not made up for by a shorter arc.
const LEAST_SLANT: f64 = 0.5;

/// From a narrower cell at an end to the next, this part of what it is narrower by is left.
const FADING: f64 = 2.0 / 3.0;
const SHORT: usize = 4;

/// A cell narrower by some part makes the next one err as if it were wider by this part of that.
const NEXT_TO_SLANT: f64 = 0.25;

/// The error of a biarc that could not be measured, in tolerances.
const LOST: f64 = 8.0;

/// What is known of a layout.
struct Judged {
    /// Whether all biarcs are within the tolerance.
    fits: bool,
    /// How many would be.
    needed: f64,
    /// The ends that alone keep it from fitting, and may yield.
    yielding: [bool; 2],
}

/// The biarcs of a part in the making; kept for its buffers.
#[derive(Debug, Default)]
pub(super) struct Spread {
    density: Density,
    /// Whether that is the density of the part that comes next.
    is_filled: bool,
    /// Shares of the integral of the density at nodes, and the corrected shares.
    marks: Vec<[f64; 2]>,
    /// How wide cells are to be, in biarcs.
    widths: Vec<f64>,
    /// Shares at nodes, for the next layout.
    shares: Vec<f64>,
    /// The nodes, and places of the curve halfway between them.
    nodes: Vec<Node>,
    halfway: Vec<Node>,
    /// The arc that is alone.
    alone: Option<Arc>,
    cells: Vec<Cell>,
    /// How much denser biarcs must be.
    growth: Vec<f64>,
}

impl Spread {
    /// The density of the part checked last.
    pub fn density(&mut self) -> Density {
        std::mem::take(&mut self.density)
    }

    /// Takes the density of the part that comes next.
    pub fn take(&mut self, density: Option<Density>) {
        self.is_filled = density.is_some();
        self.density = density.unwrap_or_default();
    }

    /// Whether tangents at ends suit the biarcs beside them, if those ends may yield. The density may be known between
    /// ends nearer to each other.
    pub fn check(
        &mut self,
        track: &Track,
        ends: &Ends,
        (goal, inner): (&Goal, Option<Density>),
    ) -> Result<(), Lost> {
        (self.is_filled, self.density) = (false, inner.unwrap_or_default());
        let Some(total) = self.fill(track, ends, goal) else { return Ok(()) };
        if total <= FEW {
            return Ok(());
        }
        match Layout::of(first(total), ends) {
            Some(layout) => self.slants(track, ends, goal, (layout, total)).map(|_| ()),
            None => Ok(()),
        }
    }

    /// How many biarcs it takes from one end to the other, about.
    pub fn number(&mut self, track: &Track, ends: &Ends, goal: &Goal) -> Result<f64, Lost> {
        self.fill(track, ends, goal).ok_or(Lost { ends: ends.apex_arcs })
    }

    /// Appends biarcs from one end to the other, of a known number about; nothing is appended when it fails.
    pub fn run(
        &mut self,
        track: &Track,
        ends: &Ends,
        (goal, total): (&Goal, f64),
        out: &mut Vec<Cell>,
    ) -> Result<(), Lost> {
        let many = total > MANY;
        if self.lay_few(track, ends, (goal, total), out) {
            return Ok(());
        }
        let (mut arcs, mut sweeps) = (first(total), 0);
        for _ in 0..MAX_LAYOUTS {
            let Some(layout) = Layout::of(arcs, ends) else {
                arcs += 1;
                continue;
            };
            let slants = self.slants(track, ends, goal, (layout, total))?;
            let spare = self.widen(layout, slants) - total;
            if (many || layout.biarcs > 2) && spare < if many { SPARE * total } else { 0.0 } {
                arcs += 1;
                continue;
            }
            self.lay(track, ends, goal, layout, many);
            let steep = [0, 1].map(|end| slants[end] > 1.0 && ends.yields[end]);
            let mut judged = self.judge(goal, steep, many);
            if judged.fits && many {
                self.complete(track, goal, layout);
                judged = self.judge(goal, steep, many);
            }
            if judged.fits {
                out.extend_from_slice(&self.cells);
                return Ok(());
            }
            let least = (2.0 * judged.needed * if many { 1.0 + SPARE } else { FEWER }).ceil();
            if least > MOST_MORE + MOST * 2.0 * total {
                break;
            }
            if judged.yielding != [false; 2] {
                return Err(Lost { ends: judged.yielding });
            }
            let again = least as usize <= arcs && layout.biarcs > 1 && sweeps < MAX_SWEEPS;
            sweeps = if again { sweeps + 1 } else { 0 };
            arcs = if again { arcs } else { (least as usize).max(arcs + 1) };
        }
        Err(Lost { ends: ends.apex_arcs })
    }

    /// Appends a few arcs, if these will do and are found.
    fn lay_few(&self, track: &Track, ends: &Ends, (goal, total): (&Goal, f64), out: &mut Vec<Cell>) -> bool {
        let least = ((2.0 * total - SPARED).ceil() as usize).max(1);
        let mut found = |arcs: usize| few(track, (ends, &self.density), (arcs, goal.tolerance), out);
        total <= FEW && goal.tilted && (least..least + TRIED).any(&mut found)
    }

    /// Takes the density between two ends; answers its integral if it says something.
    fn fill(&mut self, track: &Track, ends: &Ends, goal: &Goal) -> Option<f64> {
        let chord = (ends.nodes[1].place - ends.nodes[0].place).length();
        let least = LEAST / if chord > 0.0 { chord } else { track.extent() };
        if !std::mem::take(&mut self.is_filled) {
            self.density.fill(track, (&ends.nodes, goal.tolerance), |jet| goal.density(least, jet));
        }
        let total = self.density.total();
        self.marks.clear();
        self.marks.extend([[0.0; 2], [total; 2]]);
        (total > 0.0 && total <= MAX_BIARCS as f64).then_some(total)
    }

    /// How far the tangents at both ends turn, as [`Spread::slant`] says, unless they turn too far.
    fn slants(
        &self,
        track: &Track,
        ends: &Ends,
        goal: &Goal,
        (layout, total): (Layout, f64),
    ) -> Result<[f64; 2], Lost> {
        let slants = [0, 1].map(|end| self.slant(track, ends, goal, (layout, total), end));
        let filled = total / layout.all();
        let steep = [0, 1].map(|end| {
            let error = filled.powi(3) * (1.0 + STEEPNESS * (slants[end] - 1.0));
            ends.yields[end] && filled <= 1.0 && error > 1.0 - SPARE
        });
        if steep == [false; 2] { Ok(slants) } else { Err(Lost { ends: steep }) }
    }

    /// How far the tangent at an end turns from that of the curve, as a part of what suits the first arc
    /// there.
    fn slant(
        &self,
        track: &Track,
        ends: &Ends,
        goal: &Goal,
        (layout, total): (Layout, f64),
        end: usize,
    ) -> f64 {
        if !ends.apex_arcs[end] || !goal.tilted {
            return 1.0;
        }
        let node = &ends.nodes[end];
        let share = 0.5 * total / layout.all();
        let (share, side) = if end == 0 { (share, Side::After) } else { (total - share, Side::Before) };
        let next = track.node(self.density.beyond(share, &mut Cursor::default()));
        let length = (next.place - node.place).length();
        let (piece, t) = track.locate(node.u, side);
        let turn = piece.motion(t).1.unit().cross(node.tangent);
        let rises = if end == 0 { next.curvature > node.curvature } else { next.curvature < node.curvature };
        let turn = if rises { -turn } else { turn };
        let error = (total / layout.all()).powi(3) * goal.tolerance;
        turn * goal.constant * length * 12.0 / error
    }

    /// Widths of the cells of a layout, those at the ends as wide as the tangents there want it; answers for
    /// how many biarcs they are enough.
    fn widen(&mut self, layout: Layout, slants: [f64; 2]) -> f64 {
        let [mut first, mut last] = slants.map(|slant| slant.clamp(LEAST_SLANT, 1.0).sqrt() - 1.0);
        let loss = NEXT_TO_SLANT * (first + last);
        let fading = if layout.biarcs > SHORT { FADING } else { 0.5 };
        self.widths.clear();
        self.widths.resize(layout.biarcs, 1.0);
        for i in 0..layout.biarcs {
            self.widths[i] += first;
            self.widths[layout.biarcs - 1 - i] += last;
            (first, last) = (fading * first, fading * last);
        }
        (0..layout.biarcs).for_each(|i| self.widths[i] *= layout.width(i));
        self.widths.iter().sum::<f64>() + loss
    }

    /// Lets the growth fade from cell to cell, as arcs of different lengths side by side turn the tangent
    /// between wrongly.
    fn smooth(&mut self) {
        for i in 1..self.growth.len() {
            self.growth[i] = self.growth[i].max(0.5 + 0.5 * self.growth[i - 1]);
        }
        for i in (1..self.growth.len()).rev() {
            self.growth[i - 1] = self.growth[i - 1].max(0.5 + 0.5 * self.growth[i]);
        }
    }

    /// Judges a layout; the density is corrected by its errors.
    fn judge(&mut self, goal: &Goal, steep: [bool; 2], many: bool) -> Judged {
        let corrected = self.marks[self.marks.len() - 1][1];
        let scale = (corrected / self.widths.iter().sum::<f64>()).min(1.0);
        self.marks.clear();
        self.marks.push([0.0; 2]);
        self.growth.clear();
        self.growth.resize(self.cells.len(), 1.0);
        let last = self.cells.len() - 1;
        let mut judged = Judged { fits: true, needed: 0.0, yielding: [false; 2] };
        let mut inner = true;
        for (i, cell) in self.cells.iter().enumerate() {
            let fine = cell.distance.bound <= goal.tolerance;
            judged.fits &= fine;
            let width = self.widths[i] * scale;
            let error = (cell.distance.found / goal.tolerance).min(LOST);
            let yields = [i == 0 && steep[0], i == last && steep[1]];
            if !fine && yields != [false; 2] && error <= YIELDING {
                judged.yielding = [0, 1].map(|e| judged.yielding[e] || yields[e]);
            } else {
                inner &= fine;
            }
            let measured = || self.widths[i] * error.cbrt();
            self.growth[i] = match (many, fine) {
                (true, true) => 1.0,
                (true, false) => (measured() / width).max(1.0) * (1.0 + SPARE),
                _ => measured() / width,
            };
        }
        if !inner {
            judged.yielding = [false; 2];
        }
        if many {
            self.smooth();
        }
        for i in 0..self.cells.len() {
            let width = self.widths[i] * scale;
            judged.needed += self.growth[i] * width;
            self.marks.push([self.shares[i + 1], judged.needed]);
        }
        judged
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::boundary::freeform::biarc::Joint;
    use crate::geom::{point, vector};

    #[test]
    fn errors_are_equal_and_below_the_tolerance() {
        let quarter = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.3, 1.2).unwrap();
        let pieces = quarter.pieces().unwrap();
        let track = Track::new(&pieces);
        let nodes = [track.cut_node(0.0, Side::After), track.cut_node(1.0, Side::Before)];
        let ends = Ends::of(nodes);
        let goal = Goal { tolerance: 1e-7, joint: Joint::MIDDLE, tilted: false, constant: 2.0 / 81.0 };
        let (mut cells, mut spread) = (Vec::new(), Spread::default());
        let total = spread.number(&track, &ends, &goal).unwrap();
        spread.run(&track, &ends, (&goal, total), &mut cells).unwrap();
        assert!(cells.len() > 10);
        let errors: Vec<f64> = cells.iter().map(|c| c.distance.bound / goal.tolerance).collect();
        assert!(errors.iter().all(|&e| e <= 1.0 && e > 0.5), "{errors:?}");
        assert!(cells.windows(2).all(|w| w[0].to == w[1].from && w[0].arcs[1].end == w[1].arcs[0].start));
    }
}
