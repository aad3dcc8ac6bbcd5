//! Second order against exact paraboloids and balls.

use core::convert::Infallible;

use eigentol_statistics::Error;
use eigentol_statistics::reliability::{LimitFunction, LimitState, LimitValue, sorm};

use crate::common::{below, close, density, design_point, limit, mean};

/// `unit (b - n . z + sum kappa_i (t_i . z)^2 / 2)` with orthonormal `n`, `t_1`, `t_2` that are not coordinate axes.
fn paraboloid(b: f64, kappa: [f64; 2], unit: f64) -> impl LimitState<Error = Infallible> {
    const AXES: [[f64; 3]; 3] =
        [[2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0], [2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0], [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]];
    let along = |z: &[f64], axis: [f64; 3]| -> f64 { axis.iter().zip(z).map(|(a, z)| a * z).sum() };
    let value = move |z: &[f64]| {
        let [n, t, s] = AXES.map(|axis| along(z, axis));
        let value = b - n + 0.5 * (kappa[0] * t * t + kappa[1] * s * s);
        let entry = |i: usize| -AXES[0][i] + kappa[0] * t * AXES[1][i] + kappa[1] * s * AXES[2][i];
        Ok(LimitValue { value: unit * value, gradient: (0..3).map(|i| unit * entry(i)).collect() })
    };
    let hessian = move |_: &[f64]| {
        let entry =
            |i: usize, j: usize| unit * (kappa[0] * AXES[1][i] * AXES[1][j] + kappa[1] * AXES[2][i] * AXES[2][j]);
        Ok((0..3).map(|i| (0..3).map(|j| entry(i, j)).collect()).collect())
    };
    LimitFunction::new(3, value).with_hessian(hessian)
}

/// Hides the second derivatives.
struct FirstOrderOnly<L>(L);

impl<L: LimitState> LimitState for FirstOrderOnly<L> {
    type Error = L::Error;

    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, L::Error> {
        self.0.evaluate(z)
    }
}

#[test]
fn curvatures_of_paraboloids() {
    for unit in [1.0, 1e-200, 1e120] {
        for kappa in [[-0.1, 0.3], [0.0, 0.2], [0.25, 0.25]] {
            let limit = paraboloid(3.0, kappa, unit);
            let at = design_point(&limit);
            let exact = sorm(&limit, &at).unwrap();
            assert_eq!(exact.evaluations().total, 0);
            let differences = sorm(&FirstOrderOnly(&limit), &at).unwrap();
            assert_eq!(differences.evaluations().total, 4);
            for (found, tolerance) in [(exact, 1e-12), (differences, 1e-9)] {
                for (value, expected) in found.curvatures().iter().zip(kappa) {
                    assert!((value - expected).abs() < tolerance, "{value} {expected}");
                }
            }
        }
    }
}

/// Two equal curvatures: `P(Z > b + k R^2/2)` with `R^2 / 2` exponentially distributed, in closed form
/// `Phi(-b) - exp(b/k + 1/(2 k^2)) Phi(-b - 1/k)`.
#[test]
fn formulas_on_a_paraboloid() {
    let (b, k) = (3.0, 0.4_f64);
    let exact = below(-b) - (b / k + 0.5 / (k * k)).exp() * below(-b - 1.0 / k);
    let limit = paraboloid(b, [k, k], 1.0);
    let found = sorm(&limit, &design_point(&limit)).unwrap();
    close(found.tvedt().unwrap(), exact, 1e-9);
    close(found.breitung().unwrap(), below(-b) / (1.0 + b * k), 1e-9);
    let psi = density(b) / below(-b);
    close(found.hohenbichler_rackwitz().unwrap(), below(-b) / (1.0 + psi * k), 1e-9);
    // Each formula is closer than the previous one.
    let off = |p: f64| (p / exact - 1.0).abs();
    assert!(off(found.hohenbichler_rackwitz().unwrap()) < 0.5 * off(found.breitung().unwrap()));
    assert!(off(found.breitung().unwrap()) < 0.1 && off(below(-b)) > 0.5);
}

/// One negative and one positive curvature, by conditioning on both.
#[test]
fn a_saddle() {
    let limit = paraboloid(2.0, [-0.2, 0.5], 1.0);
    let found = sorm(&limit, &design_point(&limit)).unwrap();
    let simpson = |y: f64| {
        let steps = 400;
        let step = 16.0 / f64::from(steps);
        let value = |k: i32| {
            let x = -8.0 + f64::from(k) * step;
            step * density(x) * below(-2.0 + 0.1 * x * x - 0.25 * y * y)
        };
        (0..=steps).map(value).sum::<f64>()
    };
    let exact = {
        let steps = 400;
        let step = 16.0 / f64::from(steps);
        let value = |k: i32| {
            let y = -8.0 + f64::from(k) * step;
            step * density(y) * simpson(y)
        };
        (0..=steps).map(value).sum::<f64>()
    };
    close(found.tvedt().unwrap(), exact, 1e-9);
}

/// The origin fails: the probability is the complement of that of the mirrored limit.
#[test]
fn negative_beta_is_the_complement() {
    let exact = mean(|y| below(1.5 + 0.1 * y * y));
    let failing = limit(2, |z| (-1.5 - z[0] - 0.1 * z[1] * z[1], vec![-1.0, -0.2 * z[1]]));
    let at = design_point(&failing);
    close(at.beta, -1.5, 1e-12);
    let found = sorm(&failing, &at).unwrap();
    close(found.curvatures()[0], -0.2, 1e-8);
    close(found.tvedt().unwrap(), exact, 1e-9);
    close(found.breitung().unwrap(), 1.0 - below(-1.5) / 1.3_f64.sqrt(), 1e-8);
}

/// Failure inside a ball, a noncentral chi-square probability: with three variables
/// `Phi(r - c) - Phi(-r - c) - (phi(r - c) - phi(r + c)) / c`.
#[test]
fn a_ball() {
    let (c, r) = (6.0, 3.0);
    let ball = limit(3, move |z| {
        let x = z[0] - c;
        let square = x * x + z[1] * z[1] + z[2] * z[2];
        (square - r * r, vec![2.0 * x, 2.0 * z[1], 2.0 * z[2]])
    });
    let exact = below(r - c) - below(-r - c) - (density(r - c) - density(r + c)) / c;
    let at = design_point(&ball);
    close(at.beta, c - r, 1e-12);
    let found = sorm(&ball, &at).unwrap();
    for kappa in found.curvatures() {
        close(*kappa, 1.0 / r, 1e-8);
    }
    let off = |p: f64| (p / exact - 1.0).abs();
    assert!(off(found.tvedt().unwrap()) < 0.1, "{} {exact}", found.tvedt().unwrap());
    assert!(off(at.probability()) > 0.5);
}

/// The limit is a circle about the origin, `beta kappa = -1`: none of the formulas is valid.
#[test]
fn too_much_curvature_is_refused() {
    let outside = limit(2, |z| (4.0 - z[0] * z[0] - z[1] * z[1] + 0.1 * z[1], vec![-2.0 * z[0], -2.0 * z[1] + 0.1]));
    let outside_more = limit(2, |z| (2.0 - z[0] - 0.3 * z[1] * z[1], vec![-1.0, -0.6 * z[1]]));
    let mut at = design_point(&outside_more);
    at.point = vec![2.0, 0.0];
    at.beta = 2.0;
    at.direction = vec![1.0, 0.0];
    at.gradient_norm = 1.0;
    let found = sorm(&outside_more, &at).unwrap();
    for refused in [found.breitung(), found.hohenbichler_rackwitz(), found.tvedt()] {
        let Err(Error::Curvature { curvature, beta, .. }) = refused else {
            panic!("{refused:?}");
        };
        close(curvature, -0.6, 1e-8);
        assert_eq!(beta, 2.0);
    }
    let at = design_point(&outside);
    let almost = sorm(&outside, &at).unwrap();
    assert!(almost.hohenbichler_rackwitz().is_err());
}

#[test]
fn one_variable_has_no_curvature() {
    let cubic = limit(1, |z| (8.0 - z[0].powi(3), vec![-3.0 * z[0] * z[0]]));
    // The gradient at the origin is zero, so restarts find the limit.
    let at = design_point(&cubic);
    let found = sorm(&cubic, &at).unwrap();
    assert!(found.curvatures().is_empty());
    close(found.breitung().unwrap(), below(-2.0), 1e-9);
    close(found.tvedt().unwrap(), below(-2.0), 1e-9);
}

#[test]
fn points_of_another_size_are_refused() {
    let at = design_point(&limit(1, |z| (1.0 - z[0], vec![-1.0])));
    let other = limit(2, |z| (1.0 - z[0], vec![-1.0, 0.0]));
    assert!(matches!(sorm(&other, &at), Err(Error::WrongLength { .. })));
}
