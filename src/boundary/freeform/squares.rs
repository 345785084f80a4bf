//! Weighted least squares of a few parameters.
//!
//! **Guarantees** the step that makes the weighted squares of errors least, if these change by their slopes.
//! **Method.** Normal equations; they have few unknowns and need few digits. Weights that grow with the errors
//! lead from the least squares to the least largest error, and the weighted mean is never above that (Lawson,
//! *Contributions to the theory of linear least maximum approximation*, 1961).

/// Parameters at most.
pub(super) const MOST_PARAMETERS: usize = 9;

/// Errors at most.
pub(super) const MOST_ERRORS: usize = 48;

/// Keeps steps finite where a parameter does nothing.
const DAMPING: f64 = 1e-9;

/// One number for each error; those that are too many are zero.
pub(super) type Column = [f64; MOST_ERRORS];

/// Parameters, in their units.
pub(super) type Parameters = [f64; MOST_PARAMETERS];

/// Errors, how they change with each parameter, and how much they weigh.
pub(super) struct Squares {
    /// The errors.
    pub errors: Column,
    /// For each parameter, how errors change with it.
    pub slopes: [Column; MOST_PARAMETERS],
    weights: Column,
    /// Numbers of errors and of parameters.
    count: usize,
    parameters: usize,
}

impl Squares {
    /// No errors yet of some samples; all weigh the same.
    pub fn new(count: usize, parameters: usize) -> Squares {
        let mut weights = [0.0; MOST_ERRORS];
        weights[..count].fill(1.0);
        let (errors, slopes) = ([0.0; MOST_ERRORS], [[0.0; MOST_ERRORS]; MOST_PARAMETERS]);
        Squares { errors, slopes, weights, count, parameters }
    }

    /// The largest error; not a number if any is none.
    pub fn worst(&self) -> f64 {
        let errors = self.errors[..self.count].iter();
        errors.fold(0.0, |m: f64, e| if e.abs() <= m { m } else { e.abs() })
    }

    /// The weighted mean of errors that are as small as they can be: no largest one can be smaller.
    pub fn least(&self) -> f64 {
        let sum: f64 = self.weights.iter().zip(&self.errors).map(|(w, e)| w * e * e).sum();
        (sum / self.weights.iter().sum::<f64>()).sqrt()
    }

    /// The step that makes the weighted squares least.
    pub fn step(&self) -> Option<Parameters> {
        let n = self.parameters;
        let mut matrix = [[0.0; MOST_PARAMETERS + 1]; MOST_PARAMETERS];
        // Those beyond the last error are zero.
        let count = self.count.next_multiple_of(4);
        for (i, slope) in self.slopes[..n].iter().enumerate() {
            let weighted: Column = std::array::from_fn(|k| self.weights[k] * slope[k]);
            let with = |other: &Column| dot(&weighted[..count], &other[..count]);
            for (j, other) in self.slopes[..n].iter().enumerate().skip(i) {
                let sum = with(other);
                (matrix[i][j], matrix[j][i]) = (sum, sum);
            }
            matrix[i][n] = -with(&self.errors);
        }
        let most = (0..n).map(|i| matrix[i][i]).fold(0.0, f64::max);
        (0..n).for_each(|i| matrix[i][i] += DAMPING * most);
        solved(&mut matrix, n)
    }

    /// What is far weighs more, up to the worst.
    pub fn weigh(&mut self, worst: f64) {
        for (weight, error) in self.weights[..self.count].iter_mut().zip(&self.errors) {
            *weight *= error.abs() / worst + DAMPING;
        }
    }
}

/// The sum of products, four of them side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    for (x, y) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        (0..4).for_each(|i| sums[i] += x[i] * y[i]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// Solves a symmetric system with positive pivots.
fn solved(matrix: &mut [[f64; MOST_PARAMETERS + 1]; MOST_PARAMETERS], n: usize) -> Option<Parameters> {
    for i in 0..n {
        let row = matrix[i];
        if row[i] <= 0.0 || row[i].is_nan() {
            return None;
        }
        for other in &mut matrix[i + 1..n] {
            let factor = other[i] / row[i];
            other.iter_mut().zip(&row).for_each(|(a, b)| *a -= factor * b);
        }
    }
    let mut step = Parameters::default();
    for i in (0..n).rev() {
        let row = &matrix[i];
        let rest: f64 = row[i + 1..n].iter().zip(&step[i + 1..n]).map(|(a, b)| a * b).sum();
        step[i] = (row[n] - rest) / row[i];
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A column that begins with some numbers.
    fn column(numbers: &[f64]) -> Column {
        std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0))
    }

    #[test]
    fn weights_lead_to_the_least_largest_error() {
        // A line for the squares of 0 to 1: the least largest error is 1/8, on both sides in turn.
        let places: Vec<f64> = (0..=32).map(|i| f64::from(i) / 32.0).collect();
        let mut fit = Squares::new(places.len(), 2);
        (fit.slopes[0], fit.slopes[1]) = (column(&vec![1.0; places.len()]), column(&places));
        let errors = |p: &Parameters| places.iter().map(|x| p[0] + p[1] * x - x * x).collect::<Vec<f64>>();
        let mut parameters = Parameters::default();
        for round in 0..40 {
            fit.errors = column(&errors(&parameters));
            let worst = fit.worst();
            if round > 0 {
                assert!(fit.least() < 0.125 + 1e-6 && worst > 0.125 - 1e-6, "{round}: {worst}");
                fit.weigh(worst);
            }
            let step = fit.step().expect("two parameters that matter");
            parameters.iter_mut().zip(step).for_each(|(p, s)| *p += s);
        }
        assert!(errors(&parameters).iter().all(|e| e.abs() < 0.1275));
    }

    #[test]
    fn a_parameter_that_does_nothing_stays() {
        let mut fit = Squares::new(3, 2);
        fit.errors = column(&[1.0, 2.0, 3.0]);
        fit.slopes[0] = column(&[1.0, 1.0, 1.0]);
        let step = fit.step().expect("damped");
        assert!((step[0] + 2.0).abs() < 1e-6 && step[1] == 0.0, "{step:?}");
    }
}
