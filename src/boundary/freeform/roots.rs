//! All roots of a polynomial in 0..=1, isolated with certainty.
//!
//! **Guarantees** that every root inside is found: a part of the interval is left aside only when
//! its coefficients have one sign for certain (no root), and a root counts as one only when the
//! signs of the coefficients change once for certain (Descartes' rule in Bernstein form). Where
//! round-off hides all signs, the roots there come as one [`Root`] over that stretch: a double root,
//! or several that cannot be told apart. **Does not** report roots that round-off cannot tell from
//! the ends of the interval.

use super::bernstein::Poly;

/// A root, or several that cannot be told apart, between two parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    /// Where, at best.
    pub at: f64,
    /// Half the width of the stretch in which round-off hides the sign.
    pub blur: f64,
}

/// Halvings before a stretch counts as one place: its width is then an ulp of 1.
const MAX_DEPTH: u32 = 52;

/// Steps of the search in a bracket; bisection alone would take 53.
const MAX_STEPS: usize = 100;

/// A root nearer to the end than this is one at the end when round-off hides the sign there.
const END: f64 = 1.0 / 128.0;

/// Where a stretch is divided; the next is taken where one lies on a root.
const DIVISIONS: [f64; 4] = [0.5, 0.4375, 0.59375, 0.328125];

/// The roots of `p` strictly inside 0..=1, ascending. `None` when all signs are hidden: the
/// polynomial is zero for all that round-off tells.
pub(super) fn isolate<const N: usize>(p: &Poly<N>) -> Option<Vec<Root>> {
    if (0..=p.degree()).all(|i| p.sign(i) == 0) {
        return None;
    }
    let mut found = Vec::new();
    search(p, 0.0, 1.0, MAX_DEPTH, &mut found);
    let mut roots: Vec<Root> = Vec::new();
    for root in found {
        match roots.last_mut() {
            // Stretches side by side, perhaps with one between them where round-off was a little less.
            Some(last) if root.at - last.at <= 2.0 * (last.blur + root.blur) => {
                let (from, to) = (last.at - last.blur, (root.at + root.blur).max(last.at + last.blur));
                *last = Root { at: 0.5 * (from + to), blur: 0.5 * (to - from) };
            }
            _ => roots.push(root),
        }
    }
    Some(roots)
}

/// Roots of `p`, which stands for the stretch `from..=to`.
fn search<const N: usize>(p: &Poly<N>, from: f64, to: f64, depth: u32, found: &mut Vec<Root>) {
    let n = p.degree();
    let width = to - from;
    let first = if from == 0.0 { certain_start(p) } else { Some(0) };
    let last = if to == 1.0 { certain_end(p) } else { Some(n) };
    if let (Some(first), Some(last)) = (first, last)
        && first <= last
    {
        match variations(p, first, last) {
            Some(0) => return,
            Some(1) if p.sign(first) * p.sign(last) < 0 => {
                let at = from + width * bracketed(p, first, last);
                return found.push(Root { at, blur: 0.0 });
            }
            _ => {}
        }
    }
    if depth == 0 || (0..=n).all(|i| p.sign(i) == 0) {
        return found.push(Root { at: from + 0.5 * width, blur: 0.5 * width });
    }
    let parts = DIVISIONS.iter().map(|&t| (t, p.split(t))).find(|(_, (before, _))| before.sign(n) != 0);
    let (t, (before, after)) = parts.unwrap_or_else(|| (DIVISIONS[0], p.split(DIVISIONS[0])));
    let middle = from + t * width;
    search(&before, from, middle, depth - 1, found);
    search(&after, middle, to, depth - 1, found);
}

/// The first coefficient of certain sign, when those before it can only mean a root at the start.
fn certain_start<const N: usize>(p: &Poly<N>) -> Option<usize> {
    let first = (0..=p.degree()).find(|&i| p.sign(i) != 0)?;
    (first == 0 || p.certainty(first).powf(-1.0 / first as f64) <= END).then_some(first)
}

/// The last coefficient of certain sign, when those behind it can only mean a root at the end.
fn certain_end<const N: usize>(p: &Poly<N>) -> Option<usize> {
    let n = p.degree();
    let last = (0..=n).rev().find(|&i| p.sign(i) != 0)?;
    (last == n || p.certainty(last).powf(-1.0 / (n - last) as f64) <= END).then_some(last)
}

/// Changes of sign from coefficient `first` to `last`; `None` when they are not certain.
fn variations<const N: usize>(p: &Poly<N>, first: usize, last: usize) -> Option<usize> {
    let (mut count, mut before) = (0, p.sign(first));
    let mut hidden = false;
    for i in first..=last {
        match p.sign(i) {
            0 => hidden = true,
            sign if sign == before => {
                // A hidden sign between equal ones may be two changes.
                if hidden {
                    return None;
                }
            }
            sign => {
                (count, before, hidden) = (count + 1, sign, false);
            }
        }
    }
    (before != 0 && !hidden).then_some(count)
}

/// The one root of a polynomial that changes its sign once between its certain ends.
fn bracketed<const N: usize>(p: &Poly<N>, first: usize, last: usize) -> f64 {
    // Hidden ends count as having the sign of the first certain coefficient.
    let (mut low, mut high) = (0.0, 1.0);
    let (mut at_low, mut at_high) = (p.values()[first], p.values()[last]);
    let mut side = 0;
    let mut before = None;
    for step in 0..MAX_STEPS {
        let secant = low + (high - low) * at_low / (at_low - at_high);
        let t = if step % 8 == 7 { 0.5 * (low + high) } else { secant };
        if t <= low || t >= high {
            return 0.5 * (low + high);
        }
        let (value, error) = p.at(t);
        if value.abs() <= error {
            // Bounds of round-off are far above round-off itself: one more step of the secant is for the better.
            let next = before.map_or(t, |(u, v): (f64, f64)| t - value * (t - u) / (value - v));
            return if next > low && next < high { next } else { t };
        }
        before = Some((t, value));
        // Illinois: an end that stays counts half.
        if (value > 0.0) == (at_low > 0.0) {
            (low, at_low) = (t, value);
            if side == -1 {
                at_high *= 0.5;
            }
            side = -1;
        } else {
            (high, at_high) = (t, value);
            if side == 1 {
                at_low *= 0.5;
            }
            side = 1;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::freeform::bernstein::ANY;

    type Poly = super::Poly<ANY>;

    /// The product of `t - r` over some roots, in Bernstein form.
    fn with_roots(roots: &[f64]) -> Poly {
        roots.iter().fold(Poly::new([1.0], 0.0), |p, r| p.times(&Poly::new([-r, 1.0 - r], f64::EPSILON)))
    }

    fn found(roots: &[f64]) -> Vec<f64> {
        isolate(&with_roots(roots)).unwrap().iter().map(|r| r.at).collect()
    }

    #[test]
    fn simple_roots_are_found_to_round_off() {
        let planted = [0.1, 0.25, 0.5, 0.500_1, 0.75];
        for (at, planted) in found(&planted).iter().zip(planted) {
            assert!((at - planted).abs() < 1e-10, "{at} {planted}");
        }
        assert_eq!(found(&planted).len(), 5);
        assert!(found(&[-0.5, 1.5, 3.0]).is_empty());
    }

    #[test]
    fn a_double_root_is_one_place() {
        for r in [0.3, 0.5, 0.77] {
            let roots = isolate(&with_roots(&[r, r])).unwrap();
            assert_eq!(roots.len(), 1, "{roots:?}");
            assert!((roots[0].at - r).abs() < 1e-7 && roots[0].blur < 1e-6);
            let triple = isolate(&with_roots(&[r, r, r])).unwrap();
            assert_eq!(triple.len(), 1, "{triple:?}");
            assert!((triple[0].at - r).abs() < 1e-4);
        }
    }

    #[test]
    fn roots_at_the_ends_are_left_out() {
        assert!(found(&[0.0]).is_empty());
        assert!(found(&[1.0, 0.0]).is_empty());
        let with = found(&[0.0, 0.25, 1.0]);
        assert!(with.len() == 1 && (with[0] - 0.25).abs() < 1e-14, "{with:?}");
    }

    #[test]
    fn what_is_zero_to_round_off_has_no_roots_of_its_own() {
        assert!(isolate(&Poly::new([1e-17, -1e-17, 0.0], 1e-16)).is_none());
    }

    #[test]
    fn twelve_roots_are_twelve_roots() {
        let planted: Vec<f64> = (1..=12).map(|i| f64::from(i) / 13.0).collect();
        let roots = found(&planted);
        assert_eq!(roots.len(), 12, "{roots:?}");
        for (at, planted) in roots.iter().zip(planted) {
            assert!((at - planted).abs() < 1e-5, "{at} {planted}");
        }
    }
}
