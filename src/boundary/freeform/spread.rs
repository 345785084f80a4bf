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
//! density, until all are below the tolerance. Next to an arc over an apex one arc alone can take
//! the place of a biarc: its end turns the tangent there about as much as it should.

use super::biarc::{Arc, Joint, Node};
use super::density::{Cursor, Density};
use super::piece::Bend;
use super::spiral::{Cell, MAX_BIARCS, cell};
use super::track::Track;

/// The least number of arcs tried, as a part of the number that the density says: it is not that
/// precise for few arcs.
const FIRST: f64 = 0.875;

/// Layouts tried at most, and those with one number of arcs.
const MAX_LAYOUTS: usize = 16;
const MAX_SWEEPS: usize = 4;

/// With more biarcs than this, errors below the tolerance are not measured precisely and the
/// density is only corrected where it is too low.
const MANY: usize = 24;

/// Biarcs that are many are made shorter by this part than the density says, as it is not constant along
/// one.
const SPARE: f64 = 1.0 / 96.0;

/// A biarc turns by about this angle at most where the derivative of the curvature does not limit it,
/// in radians. The tangents of a biarc must be within a right angle of its chord; so the curve need not
/// be cut where it has turned by a right angle.
const MAX_TURN: f64 = 1.25;

/// With more arcs than so many times those that the density says, besides some, it says nothing.
const MOST: f64 = 2.0;

/// Biarcs on a chord as long as that of the whole part, at least: something, where nothing bends.
const LEAST: f64 = 1.0 / 64.0;

/// Largest turn of a tangent at a node, in radians: far beyond what the model above is good for.
const MAX_TILT: f64 = 0.125;

/// The error of a biarc that could not be measured, in tolerances.
const LOST: f64 = 8.0;

/// What biarcs are laid for.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    /// Largest distance from the curve.
    pub tolerance: f64,
    /// Where arcs of a biarc meet.
    pub joint: Joint,
    /// Whether tangents are turned at nodes.
    pub tilted: bool,
    /// The error of an arc of length 1 where the derivative of the curvature is 1.
    pub constant: f64,
}

/// The ends of a part of the curve.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    /// The nodes.
    pub nodes: [Node; 2],
    /// Whether an arc over an apex ends there.
    pub apex_arcs: [bool; 2],
    /// Whether one arc may be alone there.
    pub singles: [bool; 2],
}

/// The biarcs of a part in the making; kept for its buffers.
#[derive(Debug, Default)]
pub(super) struct Spread {
    density: Density,
    /// Shares of the integral of the density at nodes, and the corrected shares.
    marks: Vec<[f64; 2]>,
    /// Shares at nodes, for the next layout.
    shares: Vec<f64>,
    /// The nodes, and places of the curve halfway between them.
    nodes: Vec<Node>,
    halfway: Vec<Node>,
    cells: Vec<Cell>,
    /// How much denser biarcs must be.
    growth: Vec<f64>,
}

/// How many arcs, and which biarc is one arc alone.
#[derive(Clone, Copy)]
struct Layout {
    biarcs: usize,
    single: Option<usize>,
}

impl Goal {
    /// Biarcs for each unit of the parameter.
    fn density(&self, least: f64, bend: &Bend) -> f64 {
        let error = 0.125 * self.constant * bend.slope / self.tolerance;
        let turn = bend.curvature / MAX_TURN;
        let (turn, least) = (turn * turn * turn, least * least * least);
        bend.speed * (error * error + turn * turn + least * least).sqrt().cbrt()
    }
}

impl Layout {
    /// The layout of some arcs; with an odd number, one is alone beside an arc over an apex where the
    /// curve bends most.
    fn of(arcs: usize, ends: &Ends, many: bool) -> Option<Layout> {
        let biarcs = arcs.div_ceil(2);
        if many || arcs.is_multiple_of(2) {
            return Some(Layout { biarcs, single: None });
        }
        let bend = |i: usize| if ends.singles[i] { ends.nodes[i].curvature.abs() } else { -1.0 };
        let first = bend(0) > bend(1);
        let possible = biarcs > 1 && ends.singles[usize::from(!first)];
        possible.then_some(Layout { biarcs, single: Some(if first { 0 } else { biarcs - 1 }) })
    }

    /// The width of a cell in biarcs.
    fn width(&self, i: usize) -> f64 {
        if self.single == Some(i) { 0.5 } else { 1.0 }
    }
}

impl Spread {
    /// Appends biarcs from one end to the other; nothing is appended when it fails.
    pub fn run(&mut self, track: &Track, ends: &Ends, goal: &Goal, out: &mut Vec<Cell>) -> Option<()> {
        let chord = (ends.nodes[1].place - ends.nodes[0].place).length();
        let least = LEAST / if chord > 0.0 { chord } else { track.extent() };
        let total = self.density.fill(track, &ends.nodes, |bend| goal.density(least, bend));
        if !(total > 0.0 && total <= MAX_BIARCS as f64) {
            return None;
        }
        self.marks.clear();
        self.marks.extend([[0.0; 2], [total; 2]]);
        let many = total > MANY as f64;
        let first = if many { 1.0 + SPARE } else { FIRST };
        let mut arcs = ((2.0 * first * total).ceil() as usize).max(2);
        let mut sweeps = 0;
        for _ in 0..MAX_LAYOUTS {
            let Some(layout) = Layout::of(arcs, ends, many) else {
                arcs += 1;
                continue;
            };
            self.lay(track, ends, goal, layout, many);
            let (fits, needed) = self.judge(goal, layout, many);
            if fits {
                out.extend_from_slice(&self.cells);
                return Some(());
            }
            let least = (2.0 * needed * if many { 1.0 + SPARE } else { 1.0 }).ceil();
            if least > MANY as f64 + MOST * 2.0 * total {
                return None;
            }
            sweeps = if least as usize <= arcs && sweeps < MAX_SWEEPS { sweeps + 1 } else { 0 };
            arcs = if sweeps > 0 { arcs } else { (least as usize).max(arcs + 1) };
        }
        None
    }

    /// Lays nodes at equal shares of the corrected density, and biarcs between.
    fn lay(&mut self, track: &Track, ends: &Ends, goal: &Goal, layout: Layout, many: bool) {
        self.share(layout);
        self.place(track, ends);
        if goal.tilted {
            self.tilt();
        }
        self.cells.clear();
        let limit = if many { goal.tolerance } else { 0.0 };
        let n = layout.biarcs;
        match layout.single {
            Some(0) => {
                let (cell, node) = single(track, &self.nodes[0], &self.nodes[1], false, limit);
                self.cells.push(cell);
                self.nodes[1] = node;
            }
            Some(_) => {
                let (cell, node) = single(track, &self.nodes[n], &self.nodes[n - 1], true, limit);
                self.nodes[n - 1] = node;
                self.lay_biarcs(track, goal, 0..n - 1, limit);
                return self.cells.push(cell);
            }
            None => {}
        }
        self.lay_biarcs(track, goal, self.cells.len()..n, limit);
    }

    fn lay_biarcs(&mut self, track: &Track, goal: &Goal, range: std::ops::Range<usize>, limit: f64) {
        for i in range {
            let (a, b, middle) = (&self.nodes[i], &self.nodes[i + 1], &self.halfway[i]);
            let [before, after] = [a, b].map(|n| (n.place - middle.place).length());
            let shifted = Joint::Shifted((before - after) / (before + after));
            let joint = if goal.tilted { shifted } else { goal.joint };
            self.cells.push(cell(track, [a, b], middle.u, joint, limit));
        }
    }

    /// Shares of the density at the nodes of a layout, by the marks.
    fn share(&mut self, layout: Layout) {
        let [raw, corrected] = self.marks[self.marks.len() - 1];
        let all = (0..layout.biarcs).map(|i| layout.width(i)).sum::<f64>();
        self.shares.clear();
        self.shares.push(0.0);
        let (mut mark, mut reached) = (1, 0.0);
        for i in 1..layout.biarcs {
            reached += layout.width(i - 1);
            let wanted = corrected * reached / all;
            while self.marks[mark][1] < wanted && mark + 1 < self.marks.len() {
                mark += 1;
            }
            let ([a, x], [b, y]) = (self.marks[mark - 1], self.marks[mark]);
            self.shares.push(a + (b - a) * ((wanted - x) / (y - x)));
        }
        self.shares.push(raw);
    }

    /// Nodes on the curve at the shares, and places halfway.
    fn place(&mut self, track: &Track, ends: &Ends) {
        let n = self.shares.len() - 1;
        self.nodes.clear();
        self.halfway.clear();
        let mut cursor = Cursor::default();
        self.nodes.push(ends.nodes[0]);
        for i in 0..n {
            let halfway = 0.5 * (self.shares[i] + self.shares[i + 1]);
            self.halfway.push(track.node(self.density.beyond(halfway, &mut cursor)));
            if i + 1 < n {
                self.nodes.push(track.node(self.density.beyond(self.shares[i + 1], &mut cursor)));
            }
        }
        self.nodes.push(ends.nodes[1]);
    }

    /// Turns the tangents at nodes: by the mean of `-k' g^2 / 12` over the arcs on both sides.
    fn tilt(&mut self) {
        for i in 1..self.nodes.len() - 1 {
            let (node, before, after) = (self.nodes[i], &self.halfway[i - 1], &self.halfway[i]);
            let moment = (node.curvature - before.curvature) * (node.place - before.place).length()
                + (after.curvature - node.curvature) * (after.place - node.place).length();
            let angle = (moment / 24.0).clamp(-MAX_TILT, MAX_TILT);
            let cos = (1.0 + angle * angle).sqrt().recip();
            self.nodes[i].tangent = node.tangent.rotated(cos, -angle * cos);
        }
    }

    /// Whether all biarcs are within the tolerance, and how many would be needed; the density is
    /// corrected by their errors.
    fn judge(&mut self, goal: &Goal, layout: Layout, many: bool) -> (bool, f64) {
        let corrected = self.marks[self.marks.len() - 1][1];
        let all: f64 = (0..layout.biarcs).map(|i| layout.width(i)).sum();
        self.marks.clear();
        self.marks.push([0.0; 2]);
        self.growth.clear();
        self.growth.resize(self.cells.len(), 1.0);
        let (mut fits, mut needed) = (true, 0.0);
        for (i, cell) in self.cells.iter().enumerate() {
            let fine = cell.distance.bound <= goal.tolerance;
            fits &= fine;
            let width = layout.width(i) * (corrected / all).min(1.0);
            let error = (cell.distance.found / goal.tolerance).min(LOST);
            let measured = layout.width(i) * error.cbrt();
            self.growth[i] = match (many, fine) {
                (true, true) => 1.0,
                (true, false) => (measured / width).max(1.0) * (1.0 + SPARE),
                _ => measured / width,
            };
        }
        if many {
            // Smoothly, as arcs of different lengths side by side turn the tangent between wrongly.
            for i in 1..self.growth.len() {
                self.growth[i] = self.growth[i].max(0.5 + 0.5 * self.growth[i - 1]);
            }
            for i in (1..self.growth.len()).rev() {
                self.growth[i - 1] = self.growth[i - 1].max(0.5 + 0.5 * self.growth[i]);
            }
        }
        for i in 0..self.cells.len() {
            let width = layout.width(i) * (corrected / all).min(1.0);
            needed += self.growth[i] * width;
            self.marks.push([self.shares[i + 1], needed]);
        }
        (fits, needed)
    }
}

/// One arc from a node, its own tangent kept, to another, which answers with the tangent there.
/// Backwards, the arc arrives at the first.
fn single(track: &Track, from: &Node, to: &Node, backwards: bool, limit: f64) -> (Cell, Node) {
    let arc = if backwards {
        Arc::arriving(to.place, from.place, from.tangent)
    } else {
        Arc::leaving(from.place, from.tangent, to.place)
    };
    let tangent = if backwards { arc.start_tangent() } else { arc.end_tangent() };
    let (a, b) = if backwards { (to.u, from.u) } else { (from.u, to.u) };
    (Cell::of_one(track, arc, [a, b], limit), Node { tangent, ..*to })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::EllipseArc;
    use crate::boundary::freeform::track::Side;
    use crate::geom::{point, vector};

    #[test]
    fn errors_are_equal_and_below_the_tolerance() {
        let quarter = EllipseArc::new(point(0.0, 0.0), vector(2.0, 0.0), 0.5, 0.3, 1.2).unwrap();
        let pieces = quarter.pieces().unwrap();
        let track = Track::new(&pieces);
        let nodes = [track.cut_node(0.0, Side::After), track.cut_node(1.0, Side::Before)];
        let ends = Ends { nodes, apex_arcs: [false; 2], singles: [false; 2] };
        let goal = Goal { tolerance: 1e-7, joint: Joint::MIDDLE, tilted: false, constant: 2.0 / 81.0 };
        let mut cells = Vec::new();
        Spread::default().run(&track, &ends, &goal, &mut cells).unwrap();
        assert!(cells.len() > 10);
        let errors: Vec<f64> = cells.iter().map(|c| c.distance.bound / goal.tolerance).collect();
        assert!(errors.iter().all(|&e| e <= 1.0 && e > 0.5), "{errors:?}");
        assert!(cells.windows(2).all(|w| w[0].to == w[1].from && w[0].arcs[1].end == w[1].arcs[0].start));
    }
}
