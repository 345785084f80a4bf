//! Polynomials in Bernstein form on 0..=1, each coefficient with a bound on its round-off.
//!
//! **Needs** coefficients with known errors. **Guarantees** that the true coefficient of every sum,
//! product and derivative lies within the stated error of the stored one, so that the sign of a
//! coefficient larger than its error is certain. **Does not** handle overflow: an infinite error
//! makes every sign uncertain, which is right.
//!
//! Products run over coefficients scaled by binomials, `c[i] * C(n, i)`, where they are plain
//! convolutions (Farouki and Rajan, *Algorithms for polynomials in Bernstein form*, 1988).

/// Room for coefficients of any degree: up to `8 d - 11`, the formal degree of the derivative of the curvature for
/// rational curves of degree `d = 10`.
pub(super) const ANY: usize = 70;

/// Room for those of curves of degree 3, which are by far the most: up to the degree 13.
pub(super) const CUBIC: usize = 14;

/// Half a unit in the last place of 1: the relative error of one rounding.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// `BINOMIAL[n][k]` is `n` over `k`, rounded a few times at most for large ones.
pub(super) static BINOMIAL: [[f64; ANY]; ANY] = binomials();

const fn binomials() -> [[f64; ANY]; ANY] {
    let mut table = [[0.0; ANY]; ANY];
    let mut n = 0;
    while n < ANY {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + if k < n { table[n - 1][k] } else { 0.0 };
            k += 1;
        }
        n += 1;
    }
    table
}

/// Roundings in a coefficient of a product besides those of its sum: of three binomials (each good
/// to one rounding per row beyond 2^53, at most 16 of them together), two scalings and a division.
const PRODUCT_ROUNDINGS: f64 = 24.0;

/// A polynomial with errors of its coefficients, with room for `N` of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Poly<const N: usize> {
    degree: usize,
    value: [f64; N],
    error: [f64; N],
}

impl<const N: usize> Poly<N> {
    /// From coefficients that all have the same absolute error.
    pub fn new(coefficients: impl IntoIterator<Item = f64>, error: f64) -> Poly<N> {
        Poly::with_errors(coefficients.into_iter().map(|c| (c, error)))
    }

    /// From coefficients, each with its own absolute error.
    pub fn with_errors(coefficients: impl IntoIterator<Item = (f64, f64)>) -> Poly<N> {
        let mut p = Poly::zero(0);
        for (i, (value, error)) in coefficients.into_iter().enumerate() {
            (p.degree, p.value[i], p.error[i]) = (i, value, error);
        }
        p
    }

    fn zero(degree: usize) -> Poly<N> {
        Poly { degree, value: [0.0; N], error: [0.0; N] }
    }

    /// Degree of the form; the polynomial may be of a lower one.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The coefficients.
    pub fn values(&self) -> &[f64] {
        &self.value[..=self.degree]
    }

    /// Sign of coefficient `i`; 0 where round-off hides it.
    pub fn sign(&self, i: usize) -> i8 {
        if self.value[i] > self.error[i] {
            1
        } else if self.value[i] < -self.error[i] {
            -1
        } else {
            0
        }
    }

    /// How far coefficient `i` is beyond its error, as a ratio.
    pub fn certainty(&self, i: usize) -> f64 {
        self.value[i].abs() / self.error[i]
    }

    /// `a self + b other` for polynomials of one degree.
    pub fn combined(&self, a: f64, other: &Poly<N>, b: f64) -> Poly<N> {
        debug_assert_eq!(self.degree, other.degree);
        let mut sum = Poly::zero(self.degree);
        for i in 0..=self.degree {
            let (x, y) = (a * self.value[i], b * other.value[i]);
            sum.value[i] = x + y;
            sum.error[i] = a.abs() * self.error[i]
                + b.abs() * other.error[i]
                + ROUNDING * (x.abs() + y.abs() + sum.value[i].abs());
        }
        sum
    }

    /// The derivative.
    pub fn derivative(&self) -> Poly<N> {
        if self.degree == 0 {
            return Poly::zero(0);
        }
        let n = self.degree as f64;
        let mut d = Poly::zero(self.degree - 1);
        for i in 0..self.degree {
            let step = n * (self.value[i + 1] - self.value[i]);
            d.value[i] = step;
            d.error[i] = n * (self.error[i] + self.error[i + 1]) + 2.0 * ROUNDING * step.abs();
        }
        d
    }

    /// The product.
    pub fn times(&self, other: &Poly<N>) -> Poly<N> {
        let (n, m) = (self.degree, other.degree);
        let mut product = Poly::zero(n + m);
        let roundings = ROUNDING * (PRODUCT_ROUNDINGS + n.min(m) as f64);
        for (i, scale) in BINOMIAL[n][..=n].iter().enumerate() {
            let (a, da) = (scale * self.value[i], scale * self.error[i]);
            for (j, scale) in BINOMIAL[m][..=m].iter().enumerate() {
                let (b, db) = (scale * other.value[j], scale * other.error[j]);
                product.value[i + j] += a * b;
                product.error[i + j] += a.abs() * (db + roundings * b.abs()) + da * (b.abs() + db);
            }
        }
        for (k, scale) in BINOMIAL[n + m][..=n + m].iter().enumerate() {
            product.value[k] /= scale;
            product.error[k] /= scale;
        }
        product
    }

    /// Value at `t` by de Casteljau's scheme, with its error.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let (mut value, mut error) = (self.value, self.error);
        for level in (0..self.degree).rev() {
            for i in 0..=level {
                blend(&mut value, &mut error, i, i + 1, t);
            }
        }
        (value[0], error[0])
    }

    /// The parts before and after `t`, each on 0..=1.
    pub fn split(&self, t: f64) -> (Poly<N>, Poly<N>) {
        let (mut before, mut after) = (Poly::zero(self.degree), *self);
        for k in 0..=self.degree {
            (before.value[k], before.error[k]) = (after.value[0], after.error[0]);
            for i in 0..self.degree - k {
                blend(&mut after.value, &mut after.error, i, i + 1, t);
            }
        }
        (before, after)
    }
}

/// One step of de Casteljau's scheme: three roundings.
fn blend(value: &mut [f64], error: &mut [f64], i: usize, j: usize, t: f64) {
    let (x, y) = ((1.0 - t) * value[i], t * value[j]);
    value[i] = x + y;
    error[i] = (1.0 - t) * error[i] + t * error[j] + 2.0 * ROUNDING * (x.abs() + y.abs());
}

#[cfg(test)]
mod tests {
    use super::*;

    type Poly = super::Poly<ANY>;

    #[test]
    fn a_product_is_the_product_of_values() {
        let p = Poly::new([1.0, -2.0, 3.0, 0.5], 0.0);
        let q = Poly::new([2.0, 5.0, -1.0], 0.0);
        let pq = p.times(&q);
        assert_eq!(pq.degree(), 5);
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let (value, error) = pq.at(t);
            assert!((value - p.at(t).0 * q.at(t).0).abs() <= 2.0 * error && error < 1e-13);
        }
    }

    #[test]
    fn parts_and_derivatives_agree_with_the_whole() {
        let p = Poly::new([1.0, -2.0, 3.0, 0.5, 4.0], 0.0);
        let (before, after) = p.split(0.3);
        assert!((before.at(0.5).0 - p.at(0.15).0).abs() < 1e-14);
        assert!((after.at(0.5).0 - p.at(0.65).0).abs() < 1e-14);
        let step = 1e-6;
        let slope = (p.at(0.4 + step).0 - p.at(0.4 - step).0) / (2.0 * step);
        assert!((p.derivative().at(0.4).0 - slope).abs() < 1e-8);
        let twice = p.combined(3.0, &p, -1.0);
        assert!((twice.at(0.7).0 - 2.0 * p.at(0.7).0).abs() < 1e-14);
    }

    #[test]
    fn signs_hidden_by_errors_are_not_told() {
        let p = Poly::new([1.0, -0.5, 0.2], 0.3);
        assert_eq!([p.sign(0), p.sign(1), p.sign(2)], [1, -1, 0]);
        // The error of a product is that of the product of intervals.
        let square = p.times(&p);
        assert!((square.at(0.0).0 - 1.0).abs() < 1e-15);
        assert!((square.at(0.0).1 - 0.69).abs() < 1e-12);
    }

    #[test]
    fn binomials_are_exact_as_far_as_they_can_be() {
        assert_eq!(BINOMIAL[20][10], 184_756.0);
        assert_eq!(BINOMIAL[50][25], 126_410_606_437_752.0);
        assert_eq!(BINOMIAL[69][1], 69.0);
    }
}
