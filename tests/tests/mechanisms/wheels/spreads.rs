//! Tolerances of the bicycle: first order, second order and Monte Carlo against the derivatives of the reference.

use eigentol::{Complex, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::wheels::WhippleBicycle;

use super::common::{close, complex, truth};

/// Mean shift and standard deviation of the weave at 5 m/s to second order. With `g_i` and `H_ij` the derivatives times
/// the standard deviations of the parameters, the mean shifts by `sum H_ii / 2` and the variance is
/// `sum g_i^2 + sum H_ij^2 / 2`.
#[test]
fn samples_spread_as_the_derivatives_say() {
    const SAMPLES: usize = 3000;
    let hessian = truth("bicycle").get("hessian");
    let point = truth("bicycle").get("spectra").list().remove(5);
    let s = complex(&hessian.get("s"));
    let mode = point.get("modes").list();
    let mode = mode.iter().find(|mode| (complex(&mode.get("s")) - s).norm() < 1e-9);
    let by_design = mode.expect("the weave").get("by_design");
    let study = Study::new(WhippleBicycle).input(WhippleBicycle::v, 5.0).samples(SAMPLES).seed(11);
    let order: Vec<String> = hessian.get("order").list().iter().map(Truth::text).collect();
    let tolerances = study.tolerances().expect("tolerances");
    let sigma = tolerances.sigmas();
    let [real, imaginary] = ["real", "imag"].map(|part| hessian.get(part).matrix());
    let scaled = |i: usize, j: usize| Complex::new(real[26 * i + j], imaginary[26 * i + j]) * sigma[i] * sigma[j];
    let first: Vec<Complex> = (0..26).map(|j| complex(&by_design.get(&order[j])) * sigma[j]).collect();
    let drawn = study.monte_carlo().expect("samples");
    assert_eq!(drawn.counts.stable, SAMPLES, "{:?}", drawn.counts);
    let modes = study.modes().expect("modes");
    let weave = modes.modes.iter().position(|mode| (mode.s - s).norm() < 1e-6);
    let weave = weave.expect("the weave");
    let mean: f64 = (0..26).map(|i| 0.5 * scaled(i, i).im).sum();
    let linear: f64 = first.iter().map(|slope| slope.im.powi(2)).sum();
    let curved: f64 = (0..26 * 26).map(|k| 0.5 * scaled(k / 26, k % 26).im.powi(2)).sum();
    let spread = (linear + curved).sqrt();

    let first_order = study.first_order().expect("first order");
    let first_order = first_order.modes[weave].frequency();
    let sigma = first_order.expect("it oscillates").sigma;
    close(sigma, linear.sqrt(), 0.0, "sigma of first order");
    let second_order = study.second_order().expect("second order");
    let second_order = second_order.modes[weave].as_ref().expect("it oscillates");
    let model = second_order.frequency.moments;
    close(model.sigma, spread, 0.0, "sigma of second order");
    close(model.mean_shift, mean, 0.0, "mean of second order");

    let omega = drawn.modes[weave].as_ref().expect("it oscillates");
    let deviation = omega.sigma.expect("many samples");
    let error = spread / (SAMPLES as f64).sqrt();
    let off = omega.mean - s.im - mean;
    assert!(off.abs() < 4.0 * error, "the mean is off by {off}, its error {error}");
    let share = deviation / spread - 1.0;
    assert!(share.abs() < 4.0 / (2.0 * SAMPLES as f64).sqrt(), "sigma is off by {share}");
}
