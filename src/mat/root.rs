//! Roots of falling functions, which the places of branches, extrema and crossings are.

/// Steps of the search: twice the bits of a parameter.
const STEPS: usize = 106;

/// Where a function falls through zero between two places; it need not be continuous, and may be infinite.
/// Inverse quadratic interpolation where three values admit it (Chandrupatla 1997); where it is infinite on
/// one side of the root, the line through two values of the other; bisection elsewhere.
pub(crate) fn falling_root(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let [mut newest, mut other] = [(high, f64::NEG_INFINITY), (low, f64::INFINITY)];
    let mut part = 0.5;
    for step in 0..STEPS {
        let at = newest.0 + part * (other.0 - newest.0);
        let value = f(at);
        if value.abs() <= f64::EPSILON {
            return at;
        }
        let mut before = newest;
        if (value > 0.0) != (newest.1 > 0.0) {
            (before, other) = (other, newest);
        }
        newest = (at, value);
        let least = 0.5 * f64::EPSILON * newest.0.max(other.0) / (other.0 - newest.0).abs();
        if least >= 0.5 {
            break;
        }
        let is_late = step % 4 == 3;
        let guess = part_to_root(newest, other, before).filter(|&t| t > 0.0 && t < 1.0 && !is_late);
        part = guess.map_or(0.5, |t| t.clamp(least, 1.0 - least));
    }
    0.5 * (newest.0 + other.0)
}

/// Where a function may be zero on the way from the newest place to the one on the other side of the root.
fn part_to_root(newest: (f64, f64), other: (f64, f64), before: (f64, f64)) -> Option<f64> {
    let ((a, f), (b, g), (c, h)) = (newest, other, before);
    if !g.is_finite() {
        return Some(f * (c - a) / ((f - h) * (b - a)));
    }
    let (place, value) = ((a - b) / (c - b), (f - g) / (h - g));
    let bends_little = value * value < place && (1.0 - value) * (1.0 - value) < 1.0 - place;
    bends_little.then(|| f / (g - f) * h / (g - h) + (c - a) / (b - a) * f / (h - f) * g / (h - g))
}
