//! Where a curve is cut: at corners, cusps, jumps of the curvature, apices and inflections.
//!
//! Parameters along the whole curve are `u = i + t` for parameter `t` of piece `i`; a closed curve
//! goes on behind its last piece.

use super::features::{Features, Shape, shape};
use super::piece::Piece;
use super::pieces::Pieces;
use crate::geom::Vector;

/// A place where the curve is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    /// Parameter along the curve.
    pub u: f64,
    /// Why.
    pub kind: CutKind,
}

/// Why a curve is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CutKind {
    /// It begins or ends.
    End,
    /// Its tangent turns in a place.
    Corner,
    /// It stops and turns back.
    Cusp,
    /// Its curvature jumps, or it becomes straight or round.
    Jump,
    /// Its curvature has an extremum.
    Apex,
    /// Its curvature changes the sign.
    Inflection,
    /// The derivative of its curvature jumps.
    Kink,
}

impl CutKind {
    /// Whether biarcs may run over it.
    pub fn is_soft(self) -> bool {
        matches!(self, CutKind::Apex | CutKind::Inflection | CutKind::Kink)
    }

    /// Whether the tangent is continuous.
    pub fn is_smooth(self) -> bool {
        !matches!(self, CutKind::End | CutKind::Corner | CutKind::Cusp)
    }
}

/// What the curve is between two cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StretchKind {
    /// A segment.
    Straight,
    /// An arc of a circle.
    Round,
    /// The curvature is monotone.
    Spiral,
}

/// The curve between two neighboring cuts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Where it begins.
    pub from: Cut,
    /// Where it ends.
    pub to: Cut,
    /// What it is.
    pub kind: StretchKind,
    /// Whether the curvature of a spiral rises along it.
    pub rises: bool,
}

/// A jump of the curvature counts when it moves the curve, over the longer of both pieces, by more
/// than this part of the tolerance: smaller ones are written digits of a smooth spline.
const JUMP_SHARE: f64 = 1.0 / 64.0;

/// Jumps of the derivative of the curvature by more than this factor are worth a node where biarcs
/// need one.
const KINK: f64 = 2.0;

/// Roundings of a curvature at a knot, in noise of control points over the length of a leg, for the
/// largest degree.
const JUMP_ROUNDINGS: f64 = 64.0;

/// Parameters that divide a round piece, which may be a whole circle, in parts below a half circle.
const ROUND_CUTS: [f64; 3] = [0.25, 0.5, 0.75];

/// The stretches of a curve in order. A closed curve without ends begins at its first cut.
pub(super) fn stretches(curve: &Pieces, tolerance: f64) -> Vec<Stretch> {
    let shapes: Vec<Shape> = curve.pieces.iter().map(|p| shape(p, curve.noise)).collect();
    let count = shapes.len();
    let joints = Joints { curve, shapes: &shapes, tolerance };
    let mut cuts = Vec::new();
    for (i, shape) in shapes.iter().enumerate() {
        if i > 0 || curve.closed {
            let kind = joints.kind((i + count - 1) % count, i);
            cuts.extend(kind.map(|kind| Cut { u: i as f64, kind }));
        } else {
            cuts.push(Cut { u: 0.0, kind: CutKind::End });
        }
        inner_cuts(i as f64, shape, curve.pieces[i].degree(), &mut cuts);
    }
    if curve.closed {
        close(curve, &mut cuts);
    } else {
        cuts.push(Cut { u: count as f64, kind: CutKind::End });
    }
    let stretch = |w: &[Cut]| {
        let middle = 0.5 * (w[0].u + w[1].u);
        let kind = match &shapes[middle as usize % count] {
            Shape::Straight { .. } => StretchKind::Straight,
            Shape::Round => StretchKind::Round,
            Shape::Curved(_) => StretchKind::Spiral,
        };
        let slope = curve.pieces[middle as usize % count].jet(middle.fract()).curvature_slope();
        Stretch { from: w[0], to: w[1], kind, rises: slope > 0.0 }
    };
    cuts.windows(2).map(stretch).collect()
}

/// Ends the cuts of a closed curve with the first of them. It begins at the apex of the largest
/// curvature where biarcs may run over all cuts, so that the seam does not matter.
fn close(curve: &Pieces, cuts: &mut Vec<Cut>) {
    let count = curve.pieces.len() as f64;
    // A closed curve has apices, but round-off may hide those of one that is nearly a circle.
    if cuts.is_empty() {
        cuts.push(Cut { u: 0.0, kind: CutKind::Jump });
    }
    if cuts.iter().all(|c| c.kind.is_soft()) {
        let bend = |c: &Cut| curve.pieces[c.u as usize].jet(c.u.fract()).curvature().abs();
        let apices = (0..cuts.len()).filter(|&i| cuts[i].kind == CutKind::Apex);
        let first = apices.max_by(|&a, &b| bend(&cuts[a]).total_cmp(&bend(&cuts[b]))).unwrap_or(0);
        cuts.rotate_left(first);
        let begin = cuts[0].u;
        cuts.iter_mut().filter(|c| c.u < begin).for_each(|c| c.u += count);
    }
    cuts.push(Cut { u: cuts[0].u + count, ..cuts[0] });
}

/// Cuts inside piece `first`.
fn inner_cuts(first: f64, shape: &Shape, degree: usize, cuts: &mut Vec<Cut>) {
    let begin = cuts.len();
    let mut add = |list: &[f64], kind| cuts.extend(list.iter().map(|t| Cut { u: first + t, kind }));
    match shape {
        Shape::Straight { folds } => add(folds, CutKind::Cusp),
        Shape::Round if degree > 2 => add(&ROUND_CUTS, CutKind::Jump),
        Shape::Round => {}
        Shape::Curved(Features { apices, inflections, cusps, .. }) => {
            add(apices, CutKind::Apex);
            add(inflections, CutKind::Inflection);
            add(cusps, CutKind::Cusp);
        }
    }
    cuts[begin..].sort_by(|a, b| a.u.total_cmp(&b.u));
    // What cannot be told from the ends of the piece is said there.
    let mut last = first;
    let mut at = 0;
    cuts.retain(|cut| {
        at += 1;
        let keep = at <= begin || (cut.u > last && cut.u < first + 1.0);
        last = if at > begin && keep { cut.u } else { last };
        keep
    });
}

/// Decides how pieces go on.
struct Joints<'a> {
    curve: &'a Pieces,
    shapes: &'a [Shape],
    tolerance: f64,
}

impl Joints<'_> {
    /// The cut between two neighboring pieces; `None` where none is needed.
    fn kind(&self, before: usize, after: usize) -> Option<CutKind> {
        let noise = self.curve.noise;
        let (a, b) = (&self.curve.pieces[before], &self.curve.pieces[after]);
        let (Some(arrives), Some(leaves)) = (last_leg(a, noise), first_leg(b, noise)) else {
            return Some(CutKind::Corner);
        };
        let (u, v) = (arrives.unit(), leaves.unit());
        let error = 4.0 * noise * (arrives.length().recip() + leaves.length().recip());
        if u.cross(v).abs() > error || u.dot(v) < 0.0 {
            return Some(CutKind::Corner);
        }
        let (Shape::Curved(f), Shape::Curved(g)) = (&self.shapes[before], &self.shapes[after]) else {
            return Some(CutKind::Jump);
        };
        let (k, l) = (a.jet(1.0).curvature(), b.jet(0.0).curvature());
        let length = (a.end() - a.start()).length().max((b.end() - b.start()).length());
        let shift = 0.125 * (k - l).abs() * length * length;
        let blur = length / arrives.length().min(leaves.length());
        let small = JUMP_SHARE * self.tolerance + JUMP_ROUNDINGS * noise * blur * blur;
        if shift > small || shift.is_nan() {
            return Some(CutKind::Jump);
        }
        let turns = f.slopes[1] * g.slopes[0] <= 0;
        if turns {
            return Some(CutKind::Apex);
        }
        // A root of the curvature in the knot itself.
        if k * l < 0.0 {
            return Some(CutKind::Inflection);
        }
        let (s, t) = (a.jet(1.0).curvature_slope().abs(), b.jet(0.0).curvature_slope().abs());
        (s.max(t) > KINK * s.min(t)).then_some(CutKind::Kink)
    }
}

/// The first leg of the control polygon that is longer than round-off: the direction at the start.
pub(super) fn first_leg(piece: &Piece, noise: f64) -> Option<Vector> {
    piece.points().iter().map(|&p| p - piece.start()).find(|leg| leg.length() > 4.0 * noise)
}

/// The last leg of the control polygon that is longer than round-off: the direction at the end.
pub(super) fn last_leg(piece: &Piece, noise: f64) -> Option<Vector> {
    piece.points().iter().rev().map(|&p| piece.end() - p).find(|leg| leg.length() > 4.0 * noise)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::{EllipseArc, Nurbs};
    use crate::geom::{point, vector};

    fn kinds(curve: &Pieces) -> Vec<CutKind> {
        stretches(curve, 1e-3).iter().map(|s| s.from.kind).collect()
    }

    #[test]
    fn an_ellipse_has_four_apices() {
        for start in [0.0, 0.7] {
            let e = EllipseArc::new(point(5.0, 3.0), vector(2.0, 1.0), 0.5, start, start).unwrap();
            assert_eq!(kinds(&e.pieces().unwrap()), [CutKind::Apex; 4]);
        }
        let circle = EllipseArc::new(point(5.0, 3.0), vector(2.0, 1.0), 1.0, 0.0, 0.0).unwrap();
        assert!(stretches(&circle.pieces().unwrap(), 1e-3).iter().all(|s| s.kind == StretchKind::Round));
    }

    #[test]
    fn a_wave_of_control_points_has_apices_and_inflections_in_turn() {
        let points = (0..8).map(|i| {
            let r = if i % 2 == 0 { 5.0 } else { 2.0 };
            point(0.0, 0.0) + Vector::from_angle(f64::from(i) * std::f64::consts::FRAC_PI_4) * r
        });
        let knots = (0..=8).map(f64::from).collect();
        let star = Nurbs::new(3, knots, points.collect(), vec![], true).unwrap().pieces().unwrap();
        let kinds = kinds(&star);
        assert_eq!(kinds.iter().filter(|&&k| k == CutKind::Apex).count(), 8, "{kinds:?}");
        assert_eq!(kinds.iter().filter(|&&k| k == CutKind::Inflection).count(), 8, "{kinds:?}");
    }

    #[test]
    fn corners_and_jumps_are_told_apart() {
        let p = |x: f64, y: f64| point(x, y);
        let knots = |m: &[usize]| -> Vec<f64> {
            m.iter().enumerate().flat_map(|(i, &n)| std::iter::repeat_n(i as f64, n)).collect()
        };
        let corner = vec![p(0.0, 0.0), p(1.0, 1.0), p(2.0, 0.0), p(3.0, 2.0), p(4.0, 0.0)];
        let corner = Nurbs::new(2, knots(&[3, 2, 3]), corner, vec![], false).unwrap();
        assert!(kinds(&corner.pieces().unwrap()).contains(&CutKind::Corner));
        let jump = vec![p(0.0, 0.0), p(1.0, 1.0), p(2.0, 1.0), p(3.0, 1.0), p(5.0, -1.0)];
        let jump = Nurbs::new(2, knots(&[3, 2, 3]), jump, vec![], false).unwrap();
        assert!(kinds(&jump.pieces().unwrap()).contains(&CutKind::Jump));
    }
}
