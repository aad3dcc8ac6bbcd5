//! The second-order model in off-centre or non-normal variables, against exact moments.

use super::close;
use eigentol::second_order::Quadratic;
use eigentol::tolerance::Distribution;
use eigentol::{Matrix, Tolerances, Vector};

fn quadratic(value: f64, slopes: &[f64], curvature: &[&[f64]]) -> Quadratic {
    let n = slopes.len();
    Quadratic { value, slopes: Vector::from(slopes), curvature: Matrix::from_fn(n, n, |i, j| curvature[i][j]) }
}

/// Normal variables whose means differ from the nominal values: the model about these means, with its coefficients
/// written out.
#[test]
fn means_beside_the_nominal_values() {
    let model = quadratic(2.0, &[1.0, -3.0], &[&[0.5, 0.2], &[0.2, -1.0]]);
    let (mean, sigma) = ([0.3, -0.1], [0.2, 0.1]);
    let values = |k: usize| Distribution::normal(mean[k], sigma[k]).unwrap();
    let nominal = [0.0, 0.0];
    let shifted = Tolerances::distributed(&nominal, vec![values(0), values(1)], 3.0, None).unwrap();
    let value = 2.0 + 0.3 + 0.3 + 0.5 * (0.5 * 0.09 - 2.0 * 0.2 * 0.03 - 0.01);
    let moved = quadratic(value, &[1.0 + 0.5 * 0.3 - 0.2 * 0.1, -3.0 + 0.2 * 0.3 + 0.1], &[&[0.5, 0.2], &[0.2, -1.0]]);
    let central = Tolerances::new(sigma, 1.0, None).unwrap();
    let (found, expected) = (model.moments(&shifted).unwrap(), moved.moments(&central).unwrap());
    close(found.mean, expected.mean, 1e-14);
    close(found.sigma, expected.sigma, 1e-14);
    close(found.skewness, expected.skewness, 1e-12);
}

/// `x + x^2` for a uniform `x` in (-1, 1): moments by integration.
#[test]
fn a_uniform_variable() {
    let model = quadratic(0.0, &[1.0], &[&[2.0]]);
    let uniform = Distribution::uniform(-1.0, 1.0).unwrap();
    let tolerances = Tolerances::distributed(&[0.0], vec![uniform], 3.0, None).unwrap();
    let found = model.moments(&tolerances).unwrap();
    close(found.mean, 1.0 / 3.0, 1e-14);
    close(found.sigma, (1.0 / 3.0 + 4.0 / 45.0_f64).sqrt(), 1e-5);
    // E (x + x^2 - 1/3)^3 = 3 E x^2 (x^2 - 1/3) + E (x^2 - 1/3)^3 = 4/15 + 16/945.
    let third = 4.0 / 15.0 + 16.0 / 945.0;
    close(found.skewness, third / (19.0 / 45.0_f64).powf(1.5), 1e-4);
}

/// Fully correlated variables: equivalent to a model in a single variable.
#[test]
fn complete_correlation() {
    let model = quadratic(0.0, &[1.0, 0.5], &[&[0.3, 0.1], &[0.1, 0.2]]);
    let one = quadratic(0.0, &[1.5], &[&[0.7]]);
    let weibull = || Distribution::weibull(1.5, 0.8).unwrap();
    let ones = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
    let two = Tolerances::distributed(&[0.0; 2], vec![weibull(), weibull()], 3.0, Some(ones));
    let single = Tolerances::distributed(&[0.0], vec![weibull()], 3.0, None);
    let [found, expected] =
        [(model, two.unwrap()), (one, single.unwrap())].map(|(model, tolerances)| model.moments(&tolerances).unwrap());
    close(found.mean, expected.mean, 1e-12);
    close(found.first_order_sigma, expected.first_order_sigma, 1e-12);
    close(found.sigma, expected.sigma, 2e-4);
    close(found.skewness, expected.skewness, 5e-3);
}
