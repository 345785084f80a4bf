//! Biarcs of equal error, laid from both ends of a run until they meet.
//!
//! **Guarantees** that every biarc is within the tolerance, and nearly as long as it can be but for
//! those in the middle of the run. The nodes depend on the shape of the curve alone, not on its
//! parameter or its direction: lengths of steps are distances in the plane.
//!
//! **Method.** An arc of length `g` errs by `C |k'| g^3`, where `k'` is the derivative of the curvature
//! by arc length. With the tangents of the curve at all nodes `C` is 1/40.5 for joints in the middle.
//! Turned by `-k' h^2 / 48`, `h` the length of a biarc, they make every arc take the mean curvature of
//! its part, with all joints on the curve: `C` is `sqrt(3) / 216`, the best for arcs with common
//! tangents, and curvatures stay monotone. As `h` follows from `C`, the tolerance and `k'`, the turn is
//! known at every place before any arc is. The length of a step follows from `k'` too; the error
//! measured corrects it until it is nearly the tolerance.

use super::biarc::{Arc, Joint, Node};
use super::spiral::{Cell, MAX_BIARCS, Scheme, cell};
use super::track::{Side, Track};

/// The error of a step is the tolerance, or less by this part.
const WINDOW: f64 = 1.0 / 6.0;

/// Corrections of one step; bisection of its length alone would need as many.
const MAX_CORRECTIONS: usize = 40;

/// A step turns by about this angle at most where the derivative of the curvature does not limit it,
/// in radians.
const MAX_TURN: f64 = 1.25;

/// A gap longer than this many steps is not closed by one biarc.
const CLOSING: f64 = 2.0;

/// Largest turn of a tangent at a node, in radians: far beyond what the model above is good for.
const MAX_TILT: f64 = 0.125;

/// Cells on each side of the meeting that share the room left there.
const SPREAD: usize = 4;

/// Steps that meet are made shorter by this factor until they do not.
const SHORTER: f64 = 0.625;

/// Laps of the search for the middle between two places.
const MIDDLE_STEPS: usize = 60;

/// The biarcs of a run in the making; kept for its buffers.
#[derive(Debug, Default)]
pub(super) struct March {
    /// Biarcs laid from the end, the last one first.
    behind: Vec<Cell>,
}

/// Where the march stands at one end.
#[derive(Clone, Copy)]
struct Front {
    node: Node,
    /// Derivative of the curvature here and at the node before.
    slopes: [f64; 2],
    /// Length of the last step.
    step: f64,
}

/// What the march aims at.
#[derive(Clone, Copy)]
struct Goal<'a, 'b> {
    track: &'a Track<'b>,
    tolerance: f64,
    joint: Joint,
    /// Whether tangents are turned at nodes.
    tilted: bool,
    /// The error of an arc of length 1 where the derivative of the curvature is 1.
    constant: f64,
    extent: f64,
}

impl March {
    /// Appends biarcs from one node to another; nothing is appended when it fails.
    pub fn run(
        &mut self,
        track: &Track,
        ends: [Node; 2],
        (tolerance, scheme): (f64, Scheme),
        out: &mut Vec<Cell>,
    ) -> Option<()> {
        let begin = out.len();
        self.behind.clear();
        let goal = Goal::of(track, tolerance, scheme);
        let Some(met) = self.meet(&goal, ends, out) else {
            out.truncate(begin);
            return None;
        };
        let (from, to) = ((out.len() - met).saturating_sub(SPREAD).max(begin), out.len() + SPREAD);
        out.extend(self.behind.iter().rev());
        if goal.tilted {
            let to = to.min(out.len());
            goal.spread(&mut out[from..to]);
        }
        Some(())
    }

    /// Answers how many biarcs were laid where both sides have met.
    fn meet(&mut self, goal: &Goal, ends: [Node; 2], out: &mut Vec<Cell>) -> Option<usize> {
        let [mut a, mut b] = [goal.front(ends[0], Side::After), goal.front(ends[1], Side::Before)];
        let mut reach = f64::INFINITY;
        while out.len() + self.behind.len() < MAX_BIARCS {
            let gap = (b.node.place - a.node.place).length();
            if gap > 0.0 && gap <= CLOSING * reach {
                let last = goal.cell(&a.node, &b.node);
                if last.distance.bound <= goal.tolerance {
                    out.push(last);
                    return Some(1);
                }
            }
            let (c, first) = goal.step(&a, b.node.u)?;
            let (d, second) = goal.step(&b, a.node.u)?;
            reach = c.step.max(d.step);
            if c.node.u < d.node.u {
                out.push(first);
                self.behind.push(second);
                (a, b) = (c, d);
                continue;
            }
            // Two biarcs are enough: any node between both steps will do, best the one in the middle.
            let middle = goal.middle(&d.node, &c.node);
            let place = goal.track.place(middle);
            let [before, after] = [a, b].map(|front| (place - front.node.place).length());
            let middle = goal.node(middle, before.min(after)).0;
            let halves = [goal.cell(&a.node, &middle), goal.cell(&middle, &b.node)];
            if halves.iter().all(|h| h.distance.bound <= goal.tolerance) {
                out.extend(halves);
                return Some(2);
            }
            let (c, first, d, second) = goal.shorter(&a, &b, [c.step, d.step])?;
            out.push(first);
            self.behind.push(second);
            (a, b) = (c, d);
        }
        None
    }
}

impl<'a, 'b> Goal<'a, 'b> {
    fn of(track: &'a Track<'b>, tolerance: f64, scheme: Scheme) -> Goal<'a, 'b> {
        let (joint, constant) = match scheme {
            Scheme::Osculating | Scheme::Bisection | Scheme::Published => (Joint::Osculating, 1.0 / 12.0),
            Scheme::Plain => (Joint::Middle, 2.0 / 81.0),
            Scheme::Fewest | Scheme::Tilted => (Joint::Middle, 3f64.sqrt() / 216.0),
        };
        let tilted = matches!(scheme, Scheme::Fewest | Scheme::Tilted);
        Goal { track, tolerance, joint, tilted, constant, extent: track.extent() }
    }

    fn front(&self, node: Node, side: Side) -> Front {
        let (piece, t) = self.track.locate(node.u, side);
        let slope = piece.jet(t).curvature_slope();
        Front { node, slopes: [slope; 2], step: f64::INFINITY }
    }

    /// Length of a biarc for a derivative of the curvature.
    fn length(&self, slope: f64) -> f64 {
        2.0 * ((1.0 - 0.5 * WINDOW) * self.tolerance / (self.constant * slope.abs())).cbrt()
    }

    /// The node at a parameter, its tangent turned for a biarc of some length on one side and one as
    /// long as it may be on the other, and the derivative of the curvature there.
    fn node(&self, u: f64, length: f64) -> (Node, f64) {
        let (mut node, slope) = self.track.node_and_slope(u);
        if self.tilted {
            let h = 0.5 * (length + self.length(slope).min(2.0 * length));
            let angle = slope * h * h / 48.0;
            if angle.abs() <= MAX_TILT {
                let cos = (1.0 + angle * angle).sqrt().recip();
                node.tangent = node.tangent.rotated(cos, -angle * cos);
            }
        }
        (node, slope)
    }

    /// The biarc between two nodes in order of their parameters.
    fn cell(&self, a: &Node, b: &Node) -> Cell {
        cell(self.track, a, b, self.joint)
    }

    /// The longest biarc from a front towards `limit`, nearly.
    fn step(&self, from: &Front, limit: f64) -> Option<(Front, Cell)> {
        let [here, before] = from.slopes;
        // Growing slopes shorten the step; falling ones are left to the correction.
        let ahead = here.abs().max((1.5 * here - 0.5 * before).abs().min(2.0 * here.abs()));
        let turning = (MAX_TURN / from.node.curvature.abs()).min(self.extent);
        let mut length = self.length(ahead).min(turning);
        length = if length > 0.0 { length.min(CLOSING * from.step) } else { turning };
        let mut good: Option<(Front, Cell)> = None;
        let mut bracket = Bracket::default();
        for _ in 0..MAX_CORRECTIONS {
            let u = self.track.beyond_distance(&from.node, length, limit);
            let (node, slope) = self.node(u, length);
            let forward = u > from.node.u;
            let found = if forward { self.cell(&from.node, &node) } else { self.cell(&node, &from.node) };
            let error = found.distance.steady() / self.tolerance;
            if error <= 1.0 {
                good = Some((Front { node, slopes: [slope, here], step: length }, found));
                if error >= 1.0 - WINDOW || u == limit {
                    return good;
                }
            }
            if bracket.narrow(length, error) {
                return good;
            }
            length = bracket.next(1.0 - 0.5 * WINDOW);
            if length <= self.track.noise() || !length.is_finite() {
                return good;
            }
        }
        good
    }

    /// Steps from both ends shorter than those that meet.
    fn shorter(&self, a: &Front, b: &Front, steps: [f64; 2]) -> Option<(Front, Cell, Front, Cell)> {
        let mut share = 1.0;
        for _ in 0..MAX_CORRECTIONS {
            share *= SHORTER;
            let [c, d] = [(a, b, steps[0]), (b, a, steps[1])].map(|(from, to, step)| {
                let length = share * step;
                let u = self.track.beyond_distance(&from.node, length, to.node.u);
                let (node, slope) = self.node(u, length);
                Front { node, slopes: [slope, from.slopes[0]], step: length }
            });
            if c.node.u >= d.node.u {
                continue;
            }
            let (first, second) = (self.cell(&a.node, &c.node), self.cell(&d.node, &b.node));
            if [first, second].iter().all(|cell| cell.distance.bound <= self.tolerance) {
                return Some((c, first, d, second));
            }
        }
        None
    }

    /// Spreads the room that is left where both sides have met, over the cells
    /// around: a cell much shorter than the turns of its tangents are made for would bend the wrong way.
    fn spread(&self, cells: &mut [Cell]) {
        let count = cells.len();
        if count < 2 {
            return;
        }
        let lengths: Vec<f64> = cells.iter().map(|c| (c.arcs[1].end - c.arcs[0].start).length()).collect();
        let evened = evened(&lengths);
        let mut nodes = vec![Node::default(); count + 1];
        nodes[0] = node_at(&cells[0].arcs[0], cells[0].from);
        let last = &cells[count - 1];
        nodes[count] =
            Node { u: last.to, place: last.arcs[1].end, tangent: last.arcs[1].end_tangent(), curvature: 0.0 };
        let half = (count - 1) / 2;
        for i in 0..half {
            let u = self.track.beyond_distance(&nodes[i], evened[i], nodes[count].u);
            nodes[i + 1] = self.node(u, evened[i]).0;
            let k = count - 1 - i;
            let u = self.track.beyond_distance(&nodes[k + 1], evened[k], nodes[0].u);
            nodes[k] = self.node(u, evened[k]).0;
        }
        if count.is_multiple_of(2) {
            let u = self.middle(&nodes[half], &nodes[half + 2]);
            nodes[half + 1] = self.node(u, 0.5 * (evened[half] + evened[half + 1])).0;
        }
        if nodes.windows(2).any(|w| w[0].u >= w[1].u) {
            return;
        }
        let laid: Vec<Cell> = nodes.windows(2).map(|w| self.cell(&w[0], &w[1])).collect();
        if laid.iter().all(|c| c.distance.bound <= self.tolerance) {
            cells.copy_from_slice(&laid);
        }
    }

    /// The parameter between two nodes whose place is as far from both.
    fn middle(&self, a: &Node, b: &Node) -> f64 {
        let nearer = |u: f64| {
            let place = self.track.place(u);
            (place - a.place).length_squared() < (place - b.place).length_squared()
        };
        let (mut low, mut high) = (a.u, b.u);
        for _ in 0..MIDDLE_STEPS {
            let u = 0.5 * (low + high);
            if nearer(u) {
                low = u;
            } else {
                high = u;
            }
        }
        0.5 * (low + high)
    }
}

/// A biarc over an apex, as far to both sides, with its nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Centered {
    /// The biarc.
    pub cell: Cell,
    /// Where it begins and ends.
    pub nodes: [Node; 2],
}

/// The longest biarc, nearly, that reaches as far to both sides of an apex at `u`, between the
/// parameters `room` and no farther than `most`. Its joint beside the apex lets both arcs be the
/// extremum, which a node on the curve would not.
pub(super) fn centered(track: &Track, u: f64, room: [f64; 2], most: f64, tolerance: f64) -> Option<Centered> {
    let goal = Goal::of(track, tolerance, Scheme::Tilted);
    let apex = track.cut_node(u, Side::After);
    let turning = (0.5 * MAX_TURN / apex.curvature.abs()).min(most);
    let slopes = [Side::Before, Side::After].map(|side| goal.front(apex, side).slopes[0]);
    let mut length = slopes.iter().fold(turning, |m, &s| m.min(0.5 * goal.length(s)));
    let mut good: Option<Centered> = None;
    let mut bracket = Bracket::default();
    for _ in 0..MAX_CORRECTIONS {
        if length <= track.noise() || !length.is_finite() {
            break;
        }
        let nodes = room.map(|limit| goal.node(track.beyond_distance(&apex, length, limit), 2.0 * length).0);
        let cell = goal.cell(&nodes[0], &nodes[1]);
        let error = cell.distance.steady() / tolerance;
        if error <= 1.0 {
            good = Some(Centered { cell, nodes });
            if error >= 1.0 - WINDOW || length >= most {
                break;
            }
        }
        if bracket.narrow(length, error) {
            break;
        }
        length = bracket.next(1.0 - 0.5 * WINDOW).min(most);
    }
    good
}

/// The node where an arc begins.
fn node_at(arc: &Arc, u: f64) -> Node {
    Node { u, place: arc.start, tangent: arc.start_tangent(), curvature: 0.0 }
}

/// Lengths with the same sum whose logarithms follow a line: nothing is shorter than its neighbors.
fn evened(lengths: &[f64]) -> Vec<f64> {
    // The cells in the middle were cut short, those farther away are as long as they may be.
    let n = lengths.len();
    let (first, last) = (lengths[0].ln(), lengths[n - 1].ln());
    let line: Vec<f64> = (0..n).map(|i| (first + (last - first) * i as f64 / (n - 1) as f64).exp()).collect();
    let scale = lengths.iter().sum::<f64>() / line.iter().sum::<f64>();
    line.iter().map(|l| l * scale).collect()
}

/// Lengths that are known to be too short and too long, with their errors relative to the tolerance.
#[derive(Clone, Copy, Default)]
struct Bracket {
    short: Option<[f64; 2]>,
    long: Option<[f64; 2]>,
}

impl Bracket {
    /// Takes a length; answers whether no other is worth a try.
    fn narrow(&mut self, length: f64, error: f64) -> bool {
        *(if error <= 1.0 { &mut self.short } else { &mut self.long }) = Some([length, error]);
        matches!((self.short, self.long), (Some(a), Some(b)) if b[0] < a[0] * (1.0 + WINDOW / 16.0))
    }

    /// The length that may have an error of `goal`: errors grow with some power of lengths.
    fn next(&self, goal: f64) -> f64 {
        match (self.short, self.long) {
            (Some([a, e]), Some([b, f])) => {
                let share = (goal / e).ln() / (f / e).ln();
                // An error of zero or infinity tells nothing but the side.
                let share = if share.is_finite() && f.is_finite() { share.clamp(0.125, 0.875) } else { 0.5 };
                a * (b / a).powf(share)
            }
            (Some([a, e]), None) => a * (goal / e).cbrt().min(2.0),
            (None, Some([b, f])) => b * (goal / f).cbrt().max(0.375),
            (None, None) => f64::NAN,
        }
    }
}
