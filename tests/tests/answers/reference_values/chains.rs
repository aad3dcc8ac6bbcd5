//! `W1`, `W2`, `W3`: bars in series. The file uses absolute angles and the machines use relative coordinates;
//! frequencies and their derivatives do not depend on this.

use eigentol::kernels::{BatchKernels, Linear};
use eigentol::sensitivity::{
    equilibrium_shift, sensitivities, sensitivities_explicit, sensitivities_with_frozen_equilibrium,
};
use eigentol::{Coordinate, DesignVariable, Input, Kernels, Matrix, Stability, Study, Vector};
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::chain_of_eight::ChainOfEight;
use eigentol_tests::corpus::chain_of_four::ChainOfFour;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;

use super::common::{By, assert_close, assert_equilibrium, flat, frequencies, moved};

/// Absolute angles: cumulative sums.
fn absolute(relative: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    relative
        .iter()
        .map(|angle| {
            sum += angle;
            sum
        })
        .collect()
}

/// `D^T a`: generalised forces of absolute angles from those of relative angles, `q = D theta`.
fn absolute_forces(relative: &[f64]) -> Vec<f64> {
    let after = |j: usize| relative.get(j + 1).copied().unwrap_or(0.0);
    (0..relative.len()).map(|j| relative[j] - after(j)).collect()
}

/// `D^T A D`.
fn absolute_matrix(relative: &Matrix) -> Matrix {
    let n = relative.row_count();
    let entry = |i: usize, j: usize| if i < n && j < n { relative[i][j] } else { 0.0 };
    Matrix::from_fn(n, n, |i, j| entry(i, j) - entry(i + 1, j) - entry(i, j + 1) + entry(i + 1, j + 1))
}

fn study<M: Kernels>(machine: M, case: &Truth) -> Study<M> {
    let values = [case.get("L").numbers(), case.get("m").numbers()].concat();
    let study = Study::new(machine);
    assert_eq!(values.len(), study.design_values().len());
    let set = |study: Study<M>, (j, value)| study.design(DesignVariable::new(j), value);
    values.into_iter().enumerate().fold(study, set)
}

/// Every point of one chain. Above the critical speed, holding the equilibrium fixed must give wrong results.
fn check<M: BatchKernels + Copy>(machine: M, name: &str) {
    let case = Truth::load("w1_w2_w3").get(name);
    let mut above = 0;
    for point in case.get("points").list() {
        let omega = point.get("Omega").number();
        let what = format!("{name} at {omega} rad/s");
        let mut study = study(machine, &case).input(Input::new(0), omega);
        for i in 0..machine.sizes().coordinates {
            // Leaning outwards, like the branch in the file.
            study = study.start(Coordinate::new(i), if i == 0 { 0.9 } else { 0.1 });
        }
        let at = study.equilibrium().expect("an equilibrium");
        let theta = point.get("theta_star").numbers();
        assert_equilibrium(&absolute(&at.coordinates), &theta, &what);
        assert_eq!(at.stability, Stability::Stable, "{what}");
        for (field, matrix) in [("M", &at.linear.mass), ("K", &at.linear.stiffness)] {
            // Not stored for the longest chains.
            if let Some(expected) = point.find(field) {
                let found = flat(&absolute_matrix(matrix));
                assert_close(&found, &expected.matrix(), 1.0, &format!("{what} {field}"));
            }
        }

        let modes = study.modes().expect("modes");
        assert!(!modes.damping_ignored, "{what}");
        assert_close(&frequencies(&modes), &point.get("omega_n").numbers(), 0.0, &what);

        let adjoint = sensitivities(&machine, &at, &modes).expect("derivatives");
        let explicit = sensitivities_explicit(&machine, &at, &modes).expect("derivatives");
        let frozen = sensitivities_with_frozen_equilibrium(&machine, &at, &modes).expect("derivatives");
        let mut misses = 0;
        for (r, expected) in point.get("domega_db").list().iter().enumerate() {
            let expected = expected.numbers();
            // For a mass with hardly any effect: relative to the largest derivative of the mode.
            let scale = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            for found in [&adjoint, &explicit] {
                let found = found.modes[r].frequency().expect("it oscillates").by_design;
                assert_close(&found, &expected, 1e-2 * scale, &format!("{what} mode {r}"));
            }
            let found = frozen.modes[r].frequency().expect("it oscillates").by_design;
            misses += found.iter().zip(&expected).filter(|(one, other)| (*one - *other).abs() > 1e-3 * scale).count();
        }
        let bent = point.find("above_critical").is_some_and(|flag| flag.truth());
        assert_eq!(misses > 0, bent, "{what}: a frozen equilibrium misses {misses}");
        above += usize::from(bent);

        let shift = equilibrium_shift(&machine, &at).expect("a shift");
        for (j, expected) in point.get("dtheta_db").list().iter().enumerate() {
            let found = absolute(&moved(&shift, By::Design(j)));
            assert_close(&found, &expected.numbers(), 1e-2, &format!("{what} shift {j}"));
        }
    }
    assert!(above >= 2, "{name}");
}

#[test]
fn one_bar() {
    check(RotatingPendulum, "W1");
}

#[test]
fn two_bars() {
    check(RotatingDoublePendulum, "W2");
    check(RotatingDoublePendulum, "W2_varied");
}

#[test]
fn four_bars() {
    check(ChainOfFour, "W3_n4");
    check(ChainOfFour, "W3_n4_varied");
}

#[test]
fn eight_bars() {
    check(ChainOfEight, "W3_n8");
    check(ChainOfEight, "W3_n8_varied");
}

/// `sum_ij sin(3 i + 7 j + 1) D_ij`.
fn checksum(matrix: &Matrix) -> f64 {
    let term = |i: usize, j: usize| ((3 * i + 7 * j + 1) as f64).sin() * matrix[i][j];
    let n = matrix.row_count();
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| term(i, j)).sum()
}

fn away_from_equilibrium(machine: &dyn Kernels, case: &Truth) {
    let what = case.get("name").text();
    let theta = case.get("q").numbers();
    let q = Vector::from_fn(theta.len(), |i| theta[i] - if i > 0 { theta[i - 1] } else { 0.0 });
    let b = [case.get("L").numbers(), case.get("m").numbers()].concat();
    let u = [case.get("Omega").number()];

    let linear = machine.linear(&q, &u, &b);
    for (field, matrix) in [("M", &linear.mass), ("K", &linear.stiffness)] {
        let found = flat(&absolute_matrix(matrix));
        assert_close(&found, &case.get(field).matrix(), 1e-2, &format!("{what} {field}"));
    }
    let residual = absolute_forces(&machine.residual(&q, &u, &b));
    assert_close(&residual, &case.get("R").numbers(), 1e-2, &what);

    let partials = machine.linear_partials(&q, &u, &b);
    let sums = |list: &[Linear], part: fn(&Linear) -> &Matrix| {
        list.iter().map(|linear| checksum(&absolute_matrix(part(linear)))).collect::<Vec<f64>>()
    };
    let (design, coordinates) = (&partials.by_design, &partials.by_coordinate);
    for (field, found) in [
        ("dM_db_checksum", sums(design, |linear| &linear.mass)),
        ("dK_db_checksum", sums(design, |linear| &linear.stiffness)),
        ("dM_dq_checksum", absolute_forces(&sums(coordinates, |linear| &linear.mass))),
        ("dK_dq_checksum", absolute_forces(&sums(coordinates, |linear| &linear.stiffness))),
    ] {
        let expected = case.get(field).numbers();
        assert_close(&found, &expected, 1e-2, &format!("{what} {field}"));
    }
}

#[test]
fn matrices_and_their_derivatives_away_from_equilibrium() {
    let mut seen = Vec::new();
    for case in Truth::load("w1_w2_w3").get("given_q").list() {
        let bars = case.get("L").numbers().len();
        match bars {
            2 => away_from_equilibrium(&RotatingDoublePendulum, &case),
            4 => away_from_equilibrium(&ChainOfFour, &case),
            8 => away_from_equilibrium(&ChainOfEight, &case),
            _ => panic!("no machine of {bars} bars"),
        }
        seen.push(bars);
    }
    assert_eq!(seen, [2, 4, 8]);
}
