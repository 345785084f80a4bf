//! Roots of falling functions, which the places of branches, extrema and crossings are.

/// Steps of the search: twice the bits of a parameter.
const STEPS: usize = 106;

/// Where a function falls through zero between two places; it need not be continuous. Regula
/// falsi (Illinois) with bisection.
pub(crate) fn falling_root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high, mut side) = (1.0, -1.0, 0);
    for step in 0..STEPS {
        if high - low <= f64::EPSILON * high {
            break;
        }
        let secant = (low * at_high - high * at_low) / (at_high - at_low);
        let bisect = step < 2 || step % 4 == 3 || !(secant > low && secant < high);
        let t = if bisect { 0.5 * (low + high) } else { secant };
        let value = f(t);
        if value.abs() <= f64::EPSILON {
            return t;
        }
        if value > 0.0 {
            (low, at_low) = (t, value);
            if side == 1 {
                at_high *= 0.5;
            }
            side = 1;
        } else {
            (high, at_high) = (t, value);
            if side == -1 {
                at_low *= 0.5;
            }
            side = -1;
        }
    }
    0.5 * (low + high)
}
