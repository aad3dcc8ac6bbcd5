//! Monte Carlo against moments by quadrature: `w1_moments`, and closed-form integrals near the critical speed.

use eigentol::{MonteCarlo, Study};
use eigentol_interpreter::Interpreted;
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::rotating_pendulum::DECLARATION;

const SAMPLES: usize = 20_000;

/// Samples of the pendulum with a tolerance on its length only.
fn sampled(omega: f64, half_width: f64) -> MonteCarlo {
    let study = Study::new(Interpreted::from_text(DECLARATION).expect("a declaration"));
    let speed = study.find_input("omega").expect("declared");
    let angle = study.find_coordinate("theta").expect("declared");
    let [length, mass] = ["l", "m"].map(|name| study.find_design(name).expect("declared"));
    study
        .input(speed, omega)
        .start(angle, 0.5)
        .tolerance(length, half_width)
        .tolerance(mass, 0.0)
        .samples(SAMPLES)
        .seed(1)
        .monte_carlo()
        .expect("samples")
}

/// Checks mean and standard deviation to within four standard errors of a normal sample.
#[track_caller]
fn assert_moments(run: &MonteCarlo, mean: f64, deviation: f64, what: &str) {
    assert_eq!(run.counts.stable, SAMPLES, "{what}");
    let mode = run.modes[0].as_ref().expect("values");
    assert_eq!(mode.count, SAMPLES as u64, "{what}");
    let error = deviation / (SAMPLES as f64).sqrt();
    let off = (mode.mean - mean) / error;
    assert!(off.abs() <= 4.0, "{what}: mean {}, not {mean}: {off:.1} standard errors", mode.mean);
    let error = deviation / (2.0 * SAMPLES as f64).sqrt();
    let sampled = mode.sigma.expect("many values");
    let off = (sampled - deviation) / error;
    assert!(off.abs() <= 4.0, "{what}: deviation {sampled}, not {deviation}: {off:.1} standard errors");
}

#[test]
fn moments_of_the_single_bar() {
    let list = Truth::load("w1_w2_w3").get("w1_moments").list();
    assert_eq!(list.len(), 15);
    for moments in list {
        let number = |field: &str| moments.get(field).number();
        let (omega, half_width) = (number("Omega"), number("T"));
        let run = sampled(omega, half_width);
        let what = format!("{omega} rad/s, T = {half_width}");
        assert_moments(&run, number("mean_omega"), number("std_omega"), &what);
    }
}

/// Mean and standard deviation of `omega(L)` over both branches, integrated over the normal density by the midpoint
/// rule.
fn quadrature(omega: f64, sigma: f64) -> (f64, f64) {
    const STEPS: usize = 400_000;
    let (mut weight, mut first, mut second) = (0.0, 0.0, 0.0);
    for k in 0..STEPS {
        let z = 16.0 * ((k as f64 + 0.5) / STEPS as f64 - 0.5);
        let density = (-0.5 * z * z).exp();
        let w = 1.5 * 9.81 / (1.0 + sigma * z);
        let square = omega * omega;
        let lambda = if square < w { w - square } else { square - w * w / square };
        weight += density;
        first += density * lambda.sqrt();
        second += density * lambda;
    }
    let mean = first / weight;
    (mean, (second / weight - mean * mean).sqrt())
}

/// Exactly at the speed where first order fails: samples lie on both branches.
#[test]
fn moments_across_the_critical_speed() {
    let critical = Truth::load("P1").get("Omega_critical").number();
    for (factor, half_width, deviation) in [
        (1.0, 0.03, 0.1745),
        (1.0, 0.06, 0.2440),
        (1.0, 0.12, 0.3382),
        (1.005, 0.03, 0.2242),
        (1.005, 0.06, 0.2858),
        (1.005, 0.12, 0.3657),
    ] {
        let omega = factor * critical;
        let (mean, exact) = quadrature(omega, half_width / 3.0);
        assert!((exact - deviation).abs() < 1e-4, "{exact}, not {deviation}");
        let run = sampled(omega, half_width);
        let what = format!("{factor} of the critical speed, T = {half_width}");
        assert_moments(&run, mean, exact, &what);
        assert!(run.left_nominal_branch > 0 && run.left_nominal_branch < SAMPLES, "{what}");
    }
}
