//! Legendre polynomials on [0, 1]: what beams are interpolated and integrated with.

/// Shifted Legendre polynomials `P_0 .. P_n` at `x`, with `P_j(1) = 1`.
pub fn polynomials(n: usize, x: f64) -> Vec<f64> {
    let t = 2.0 * x - 1.0;
    let mut values = vec![1.0, t];
    for j in 1..n {
        let k = j as f64;
        values.push(((2.0 * k + 1.0) * t * values[j] - k * values[j - 1]) / (k + 1.0));
    }
    values.truncate(n + 1);
    values
}

/// The integrals `I_0 .. I_n` of the polynomials from 0 to `x`: `I_0 = x`, and all others vanish at 0 and 1.
pub fn integrals(n: usize, x: f64) -> Vec<f64> {
    let p = polynomials(n + 1, x);
    let of = |j: usize| match j {
        0 => x,
        _ => (p[j + 1] - p[j - 1]) / (2.0 * (2.0 * j as f64 + 1.0)),
    };
    (0..=n).map(of).collect()
}

/// The derivatives of the polynomials.
pub fn derivatives(n: usize, x: f64) -> Vec<f64> {
    let p = polynomials(n, x);
    let mut slopes: Vec<f64> = vec![0.0; n + 1];
    // P_j' - P_{j-2}' = 2 (2 j - 1) P_{j-1}
    for j in 1..=n {
        let before = if j >= 2 { slopes[j - 2] } else { 0.0 };
        slopes[j] = before + 2.0 * (2.0 * j as f64 - 1.0) * p[j - 1];
    }
    slopes
}

/// Gauss-Legendre quadrature on [0, 1]: exact for polynomials of degree `2 n - 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauss {
    /// The points, in increasing order.
    pub points: Vec<f64>,
    /// Their weights, with the sum one.
    pub weights: Vec<f64>,
}

impl Gauss {
    /// The rule with `n` points.
    pub fn new(n: usize) -> Self {
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for k in 0..n {
            // Newton from an asymptotic estimate; the roots of P_n are simple.
            let angle = std::f64::consts::PI * (n as f64 - k as f64 - 0.25) / (n as f64 + 0.5);
            let mut x = 0.5 * (1.0 + angle.cos());
            for _ in 0..10 {
                let (value, slope) = with_slope(n, x);
                x -= value / slope;
            }
            let (_, slope) = with_slope(n, x);
            points.push(x);
            weights.push(1.0 / (x * (1.0 - x) * slope * slope));
        }
        Self { points, weights }
    }

    /// The integrals from 0 to `x` of the polynomials that are one at one of the points and zero at all others.
    pub fn integrals_to(&self, x: f64) -> Vec<f64> {
        let n = self.points.len();
        let up_to = integrals(n - 1, x);
        let of = |(&point, &weight): (&f64, &f64)| {
            let here = polynomials(n - 1, point);
            let sum: f64 = here.iter().zip(&up_to).enumerate().map(|(j, (p, i))| (2 * j + 1) as f64 * p * i).sum();
            weight * sum
        };
        self.points.iter().zip(&self.weights).map(of).collect()
    }
}

impl Gauss {
    /// The slopes at each point of the polynomials that are one at one of the points and zero at all others.
    pub fn slopes(&self) -> Vec<Vec<f64>> {
        let n = self.points.len();
        let at = |x: f64| {
            let slopes = derivatives(n - 1, x);
            let of = |(&point, &weight): (&f64, &f64)| {
                let here = polynomials(n - 1, point);
                let sum: f64 = here.iter().zip(&slopes).enumerate().map(|(j, (p, d))| (2 * j + 1) as f64 * p * d).sum();
                weight * sum
            };
            self.points.iter().zip(&self.weights).map(of).collect()
        };
        self.points.iter().map(|&x| at(x)).collect()
    }
}

/// `P_n` and its slope, inside (0, 1).
fn with_slope(n: usize, x: f64) -> (f64, f64) {
    let p = polynomials(n, x);
    let t = 2.0 * x - 1.0;
    let slope = n as f64 * (t * p[n] - p[n - 1]) / (t * t - 1.0);
    (p[n], 2.0 * slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_integrates_powers_exactly() {
        for n in 1..12 {
            let rule = Gauss::new(n);
            for power in 0..2 * n as i32 {
                let terms = rule.points.iter().zip(&rule.weights);
                let sum: f64 = terms.map(|(x, w)| w * x.powi(power)).sum();
                assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-13, "{n} {power} {sum}");
            }
        }
    }

    #[test]
    fn interpolated_polynomials_are_integrated_up_to_any_place() {
        for n in 1..10 {
            let rule = Gauss::new(n);
            for x in [0.0, 0.3, 0.77, 1.0] {
                let values = rule.integrals_to(x);
                for power in 0..n as i32 {
                    let terms = rule.points.iter().zip(&values);
                    let sum: f64 = terms.map(|(p, w)| w * p.powi(power)).sum();
                    let expected = f64::powi(x, power + 1) / f64::from(power + 1);
                    assert!((sum - expected).abs() < 1e-13, "{n} {x} {power}");
                }
            }
        }
    }

    #[test]
    fn slopes_are_those_of_powers() {
        let rule = Gauss::new(6);
        for (x, slope) in rule.points.iter().zip(rule.slopes()) {
            for power in 1..6 {
                let terms = rule.points.iter().zip(&slope);
                let sum: f64 = terms.map(|(p, w)| w * p.powi(power)).sum();
                let expected = f64::from(power) * x.powi(power - 1);
                assert!((sum - expected).abs() < 1e-12, "{x} {power}");
            }
        }
    }

    #[test]
    fn integrals_are_those_of_the_polynomials() {
        let rule = Gauss::new(8);
        for x in [0.2, 0.9, 1.0] {
            for (j, value) in integrals(6, x).into_iter().enumerate() {
                let terms = rule.points.iter().zip(&rule.weights);
                let sum: f64 = terms.map(|(p, w)| w * x * polynomials(6, p * x)[j]).sum();
                assert!((value - sum).abs() < 1e-14, "{j} {x} {value} {sum}");
            }
        }
    }
}
