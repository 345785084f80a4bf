//! Biarcs of a layout between nodes at equal shares of the density, with the tangents that suit them.

use super::super::biarc::{Arc, Joint};
use super::super::bound::Distance;
use super::super::density::Cursor;
use super::super::layout::{Ends, Goal, Layout};
use super::super::spiral::{Cell, cell};
use super::super::track::Track;
use super::Spread;

/// Largest turn of a tangent at a node, in radians: far beyond what the model above is good for.
const MAX_TILT: f64 = 0.125;

impl Spread {
    /// Lays nodes at equal shares of the corrected density, and biarcs between; of many only those near kinks
    /// and at ends, as the density is right elsewhere.
    pub(super) fn lay(&mut self, track: &Track, ends: &Ends, goal: &Goal, layout: Layout, many: bool) {
        self.share();
        self.place(track, ends);
        if goal.tilted {
            self.tilt(layout.single);
        }
        self.alone = layout.single.map(|i| self.single(i));
        self.cells.clear();
        for i in 0..layout.biarcs {
            let measured = !many || self.is_uneven(track, i);
            let cell = if measured { self.cell(track, goal, layout, i) } else { self.unmeasured(i) };
            self.cells.push(cell);
        }
    }

    /// Lays the biarcs that were left out.
    pub(super) fn complete(&mut self, track: &Track, goal: &Goal, layout: Layout) {
        for i in 0..layout.biarcs {
            if self.cells[i].distance == Distance::ZERO {
                self.cells[i] = self.cell(track, goal, layout, i);
            }
        }
    }

    /// Whether the derivative of the curvature jumps in a cell or one beside it, or there is none on one side.
    fn is_uneven(&self, track: &Track, i: usize) -> bool {
        if i == 0 || i + 2 >= self.nodes.len() {
            return true;
        }
        let (from, to) = (self.nodes[i - 1].u, self.nodes[i + 2].u);
        let mut knot = from.floor() + 1.0;
        while knot < to {
            if track.has_kink(knot) {
                return true;
            }
            knot += 1.0;
        }
        false
    }

    /// A cell without its arcs.
    fn unmeasured(&self, i: usize) -> Cell {
        let (a, b) = (&self.nodes[i], &self.nodes[i + 1]);
        let none = Arc { start: a.place, end: a.place, bulge: 0.0 };
        Cell { arcs: [none; 2], from: a.u, joint: b.u, to: b.u, distance: Distance::ZERO, sharp: false }
    }

    /// The biarc or arc alone between two nodes, with its distance from the curve.
    fn cell(&self, track: &Track, goal: &Goal, layout: Layout, i: usize) -> Cell {
        let (a, b, middle) = (&self.nodes[i], &self.nodes[i + 1], &self.halfway[i]);
        if let (Some(arc), true) = (self.alone, layout.single == Some(i)) {
            return Cell::of_one(track, arc, [a.u, b.u], goal.tolerance);
        }
        let [before, after] = [a, b].map(|n| (n.place - middle.place).length());
        let shifted = Joint::Shifted((before - after) / (before + after));
        let joint = if goal.tilted { shifted } else { goal.joint };
        cell(track, [a, b], middle.u, joint, goal.tolerance)
    }

    /// One arc between two nodes, which get its tangents; those at the ends of the part keep theirs.
    fn single(&mut self, i: usize) -> Arc {
        let (a, b) = (self.nodes[i], self.nodes[i + 1]);
        let leaving = Arc::leaving(a.place, a.tangent, b.place);
        let arriving = Arc::arriving(a.place, b.place, b.tangent);
        let last = i + 2 == self.nodes.len();
        let bulge = match (i == 0, last) {
            (true, _) => leaving.bulge,
            (_, true) => arriving.bulge,
            _ => 0.5 * (leaving.bulge + arriving.bulge),
        };
        let arc = Arc { bulge, ..leaving };
        if i > 0 {
            self.nodes[i].tangent = arc.start_tangent();
        }
        if !last {
            self.nodes[i + 1].tangent = arc.end_tangent();
        }
        arc
    }

    /// Shares of the density at the nodes of a layout, by the marks.
    fn share(&mut self) {
        let [raw, corrected] = self.marks[self.marks.len() - 1];
        let all: f64 = self.widths.iter().sum();
        self.shares.clear();
        self.shares.push(0.0);
        let (mut mark, mut reached) = (1, 0.0);
        for width in &self.widths[..self.widths.len() - 1] {
            reached += width;
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
    fn tilt(&mut self, single: Option<usize>) {
        for i in 1..self.nodes.len() - 1 {
            let node = self.nodes[i];
            let before = if single == Some(i - 1) { &self.nodes[i - 1] } else { &self.halfway[i - 1] };
            let after = if single == Some(i) { &self.nodes[i + 1] } else { &self.halfway[i] };
            let moment = (node.curvature - before.curvature) * (node.place - before.place).length()
                + (after.curvature - node.curvature) * (after.place - node.place).length();
            let angle = (moment / 24.0).clamp(-MAX_TILT, MAX_TILT);
            let cos = (1.0 + angle * angle).sqrt().recip();
            self.nodes[i].tangent = node.tangent.rotated(cos, -angle * cos);
        }
    }
}
