//! `P1`, `P2`, `P3`: every condition and every number of the undamped problem.

use eigentol::kernels::CurvatureKernels;
use eigentol::sensitivity::{
    Sensitivities, equilibrium_shift, sensitivities, sensitivities_explicit, sensitivities_with_frozen_equilibrium,
};
use eigentol::{Coordinate, DesignVariable, Family, Input, Kernels, Stability, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;

use super::common::{By, TIGHT, assert_close, assert_equilibrium, flat, moved, total_linear};

/// A machine at a condition, with that condition's tolerances.
pub(crate) fn study<M: Kernels>(machine: M, condition: &Truth, names: &[&str]) -> Study<M> {
    let parameters = condition.get("parameters");
    let omega = parameters.get("Omega").number();
    let mut study = Study::new(machine).input(Input::new(0), omega).threads(1);
    for (j, name) in names.iter().enumerate() {
        let variable = DesignVariable::new(j);
        study = study.design(variable, parameters.get(name).number()).tolerance(variable, 0.0);
    }
    for variable in condition.get("design").list() {
        let name = variable.get("name").text();
        if let Some(j) = names.iter().position(|other| *other == name) {
            study = study.tolerance(DesignVariable::new(j), variable.get("T").number());
        }
    }
    for (i, start) in condition.get("q_start").numbers().into_iter().enumerate() {
        study = study.start(Coordinate::new(i), start);
    }
    study
}

fn omega_by(all: &Sensitivities, mode: usize, by: By) -> f64 {
    let mode = &all.modes[mode];
    match by {
        By::Input(k) => mode.frequency().expect("it oscillates").by_input[k],
        By::Design(k) => mode.frequency().expect("it oscillates").by_design[k],
    }
}

/// Checks every condition of a file; `names` are the file's design variables in the machine's order. Returns the number
/// of derivatives that are wrong if the equilibrium is held fixed.
fn check<M: CurvatureKernels + Copy>(machine: M, file: &str, names: &[&str]) -> usize {
    let mut wrong_when_frozen = 0;
    for condition in Truth::load(file).get("conditions").list() {
        let what = format!("{file} {}", condition.get("label").text());
        let study = study(machine, &condition, names).family(Family::Undamped);
        let at = study.equilibrium().expect("an equilibrium");
        let q_star = condition.get("q_star");
        let expected: Vec<f64> = q_star.fields().iter().map(|name| q_star.get(name).number()).collect();
        assert_equilibrium(&at.coordinates, &expected, &what);
        assert_eq!(at.stability, Stability::Stable, "{what}");
        for (field, matrix) in [("M", &at.linear.mass), ("C", &at.linear.damping), ("K", &at.linear.stiffness)] {
            let expected = condition.get(field).matrix();
            assert_close(&flat(matrix), &expected, 1e-2, &format!("{what} {field}"));
        }

        let shift = equilibrium_shift(&machine, &at).expect("a shift");
        let variables = condition.get("dq_star_db").fields();
        assert!(variables.len() >= 2, "{what}");
        let by = |name: &str| {
            let design = names.iter().position(|other| *other == name);
            design.map_or(By::Input(0), By::Design)
        };
        for name in &variables {
            let expected = |field: &str| condition.get(field).get(name);
            let what = format!("{what} by {name}");
            let dq = moved(&shift, by(name));
            assert_close(&dq, &expected("dq_star_db").numbers(), 1e-3, &what);
            for total in total_linear(&machine, &at, &dq, by(name)) {
                for (field, matrix) in
                    [("dM_db_total", &total.mass), ("dC_db_total", &total.damping), ("dK_db_total", &total.stiffness)]
                {
                    let what = format!("{what} {field}");
                    assert_close(&flat(matrix), &expected(field).matrix(), 1e-2, &what);
                }
            }
        }

        let modes = study.modes().expect("modes");
        assert_eq!(modes.damping_ignored, file == "P3", "{what}");
        let adjoint = sensitivities(&machine, &at, &modes).expect("derivatives");
        let explicit = sensitivities_explicit(&machine, &at, &modes).expect("derivatives");
        let frozen = sensitivities_with_frozen_equilibrium(&machine, &at, &modes).expect("derivatives");
        let spread = study.first_order().expect("a spread");
        let truths = condition.get("undamped_modes").list();
        assert_eq!(truths.len(), machine.sizes().coordinates, "{what}");
        for (r, truth) in truths.iter().enumerate() {
            let what = format!("{what} mode {r}");
            let number = |field: &str| truth.get(field).number();
            let mode = &modes.modes[r];
            assert_close(&[mode.lambda], &[number("lambda")], 0.0, &what);
            let frequency = mode.frequency().expect("it oscillates");
            assert_close(&[frequency], &[number("omega")], 0.0, &what);
            let phi = truth.get("phi_M_normalised").numbers();
            let shape = mode.shape.map(|x| x.re);
            let side = phi.iter().zip(&shape).map(|(one, other)| one * other).sum::<f64>().signum();
            assert_close(&shape.map(|x| side * x), &phi, 1e-2, &what);

            let mut variance = 0.0;
            for name in &variables {
                let what = format!("{what} by {name}");
                let total = truth.get("domega_db").get(name).number();
                for found in [&adjoint, &explicit] {
                    assert_close(&[omega_by(found, r, by(name))], &[total], 1e-3, &what);
                }
                let without = truth.get("domega_db_frozen_equilibrium_WRONG").get(name);
                let without = without.number();
                let value = omega_by(&frozen, r, by(name));
                assert_close(&[value], &[without], 1e-3, &format!("{what}, frozen"));
                if (total - without).abs() > 1e-6 {
                    assert!((value - total).abs() > TIGHT * total.abs(), "{what}, frozen");
                    wrong_when_frozen += 1;
                }
                // The file's standard deviation includes the speed among the design variables.
                if let By::Input(_) = by(name) {
                    let design = condition.get("design").list();
                    let sigma = design
                        .iter()
                        .find(|variable| variable.get("name").text() == *name)
                        .map_or(0.0, |variable| variable.get("sigma").number());
                    variance += (total * sigma).powi(2);
                }
            }
            let own = spread.modes[r].frequency();
            let own = own.expect("it oscillates");
            let sigma = own.sigma;
            let sigma1 = variance.mul_add(1.0, sigma * sigma).sqrt();
            assert_close(&[sigma1], &[number("sigma1")], 0.0, &what);
            assert_close(&[own.band], &[3.0 * sigma], 0.0, &what);
            assert_close(&[own.variance_shares.iter().sum()], &[1.0], 0.0, &what);
        }
    }
    wrong_when_frozen
}

#[test]
fn rotating_pendulum() {
    // Two conditions above the critical speed, with derivatives by length and by speed.
    assert_eq!(check(RotatingPendulum, "P1", &["L", "m"]), 4);
}

#[test]
fn rotating_double_pendulum() {
    // Two conditions above the critical speed, two modes, four design variables and the speed.
    let names = &["L1", "L2", "m1", "m2"];
    assert_eq!(check(RotatingDoublePendulum, "P2", names), 20);
}

/// The modes omit the gyroscopic matrix and say so; the undamped numbers match the file's `undamped_modes`.
#[test]
fn sliders_on_a_spinning_plate() {
    let names = &["m", "kx", "ky", "x0", "y0", "cx", "cy"];
    // Forces are linear and the mass matrix is constant, so the moving equilibrium does not change any matrix.
    assert_eq!(check(SlidersOnPlate, "P3", names), 0);
}
