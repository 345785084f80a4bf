//! Roots of falling functions, which the places of branches, extrema and crossings are.

/// Steps of the search: twice the bits of a parameter.
const STEPS: usize = 106;

/// Smallest share of the way from 0: the square of a rounding, as that of halvings twice as many as bits.
const LEAST_SHARE: f64 = f64::EPSILON * f64::EPSILON;

/// Steps in which regula falsi is to halve a stretch; else it is halved.
const PATIENCE: usize = 3;

/// Where a function falls through zero between two places; it need not be continuous, and is not asked for at the
/// places themselves. From the middle on the search goes toward one end, by ever smaller shares of the way, as ties
/// have their roots there; once it has passed the root, by regula falsi (Anderson and Bjoerck, 1973) with bisection.
pub(crate) fn falling_root(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let middle = 0.5 * (low + high);
    let value = f(middle);
    if is_zero(value) {
        return middle;
    }
    let rises = value > 0.0;
    let (far, mut near) = (if rises { high } else { low }, (middle, value));
    let (mut share, least) = (0.5, (f64::EPSILON * far / (high - low)).max(LEAST_SHARE));
    while share > least {
        share = (share * share).max(least);
        let t = far + (low - high) * if rises { share } else { -share };
        let value = f(t);
        if is_zero(value) {
            return t;
        }
        if (value > 0.0) != rises {
            let (low, high) = if rises { (near, (t, value)) } else { ((t, value), near) };
            return root_between(low, high, f);
        }
        near = (t, value);
    }
    near.0
}

/// The root between two places, each with the value there.
fn root_between(
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    f: impl Fn(f64) -> f64,
) -> f64 {
    let (mut side, mut width) = (0, high - low);
    // At a jump the values tell nothing: there are more and more halvings each time.
    let (mut halvings, mut next) = (0, 1);
    for step in 1..=STEPS {
        let least = f64::EPSILON * high;
        if high - low <= least {
            break;
        }
        if step % PATIENCE == 0 {
            if high - low > 0.5 * width {
                (halvings, next) = (next, 2 * next);
            }
            width = high - low;
        }
        let secant = (low * at_high - high * at_low) / (at_high - at_low);
        let t = if halvings > 0 || !(secant > low && secant < high) {
            halvings -= i32::from(halvings > 0);
            0.5 * (low + high)
        } else {
            // One that is all but an end is passed by, so that the other end comes there.
            secant.max(low + 0.5 * least).min(high - 0.5 * least)
        };
        let value = f(t);
        if is_zero(value) {
            return t;
        }
        if value > 0.0 {
            at_high *= if side == 1 { share_left(value, at_low) } else { 1.0 };
            (low, at_low, side) = (t, value, 1);
        } else {
            at_low *= if side == -1 { share_left(value, at_high) } else { 1.0 };
            (high, at_high, side) = (t, value, -1);
        }
    }
    0.5 * (low + high)
}

fn is_zero(value: f64) -> bool {
    value.abs() <= f64::EPSILON
}

/// By how much the value at the other end is made smaller when one end has moved twice.
fn share_left(value: f64, before: f64) -> f64 {
    let share = 1.0 - value / before;
    if share > 0.0 { share } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// The root of a function and how often it was asked for.
    fn root(f: impl Fn(f64) -> f64) -> (f64, usize) {
        let count = Cell::new(0);
        let counted = |t: f64| {
            count.set(count.get() + 1);
            f(t)
        };
        (falling_root(0.0, 1.0, counted), count.get())
    }

    #[test]
    fn smooth_functions_take_few_steps() {
        for i in 1..100 {
            let at = f64::from(i) / 100.0;
            let (t, steps) = root(|t| (at * at - t * t) / (at * at + t * t));
            assert!((t - at).abs() <= 4.0 * f64::EPSILON && steps <= 13, "{at}: {t} in {steps}");
        }
    }

    #[test]
    fn roots_next_to_an_end_are_found_as_soon() {
        for at in [1e-300, 1e-30, 1e-15, 1e-6] {
            for (t, steps) in
                [root(|t| at - t), root(|t| 1.0 - at - t)].map(|(t, steps)| (t.min(1.0 - t), steps))
            {
                assert!((t - at).abs() <= f64::EPSILON && steps <= 12, "{at}: {t} in {steps}");
            }
        }
    }

    #[test]
    fn jumps_are_found_and_so_are_ends() {
        for at in [0.1, 0.3, 0.77] {
            let (t, steps) = root(|t| if t < at { 1.0 } else { -0.01 });
            assert!((t - at).abs() <= f64::EPSILON && steps <= 90, "{at}: {t} in {steps}");
        }
        assert!(root(|_| 1.0).0 >= 1.0 - f64::EPSILON);
        assert!(root(|_| -1.0).0 <= f64::EPSILON);
    }
}
