//! `P1`, `P2`, `P3`: general modes with their first and second derivatives, Hessians of the frequencies, and
//! second-order moments.

use eigentol::kernels::CurvatureKernels;
use eigentol::second_order::{SecondDerivatives, mode_curvature};
use eigentol::sensitivity::{Quantity, sensitivities, sensitivities_explicit};
use eigentol::{Complex, Family, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::rotating_pendulum::RotatingPendulum;
use eigentol_tests::corpus::sliders_on_plate::SlidersOnPlate;

use super::common::{By, assert_close};
use super::conditions::study;

/// The machine's variable for a name in the file.
fn by(names: &[&str], name: &str) -> By {
    let design = names.iter().position(|other| *other == name);
    design.map_or(By::Input(0), By::Design)
}

fn second<T: Copy>(all: &SecondDerivatives<T>, pair: (By, By)) -> T {
    match pair {
        (By::Input(i), By::Input(j)) => all.by_input[i][j],
        (By::Input(i), By::Design(j)) | (By::Design(j), By::Input(i)) => all.by_input_and_design[i][j],
        (By::Design(i), By::Design(j)) => all.by_design[i][j],
    }
}

fn complex(value: &Truth) -> Complex {
    let parts = value.numbers();
    Complex::new(parts[0], parts[1])
}

#[track_caller]
fn assert_complex(complex: Complex, expected: Complex, scale: f64, what: &str) {
    let off = (complex - expected).norm();
    assert!(off <= 1e-9 * expected.norm().max(scale), "{what}: {complex}, not {expected}");
}

/// Compares a Hessian with the file's, entry by entry, relative to its largest entry.
fn assert_hessian(second_derivatives: &SecondDerivatives<f64>, expected: &Truth, order: &[By], what: &str) {
    let rows: Vec<Vec<f64>> = expected.list().iter().map(Truth::numbers).collect();
    let scale = rows.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (row, &a) in rows.iter().zip(order) {
        for (&value, &b) in row.iter().zip(order) {
            assert_close(&[second(second_derivatives, (a, b))], &[value], scale, what);
        }
    }
}

/// Hessians and second-order moments of the undamped modes of every condition; moments only if the file's design
/// contains no input.
fn undamped<M: CurvatureKernels + Copy>(machine: M, file: &str, names: &[&str]) {
    let mut moments = 0;
    for condition in Truth::load(file).get("conditions").list() {
        let label = condition.get("label").text();
        let study = study(machine, &condition, names).family(Family::Undamped);
        let design = condition.get("design").list();
        let order: Vec<By> = design.iter().map(|variable| by(names, &variable.get("name").text())).collect();
        for (r, truth) in condition.get("undamped_modes").list().iter().enumerate() {
            let what = format!("{file} {label} mode {r}");
            let curvature = study.mode_curvature(r).expect("second derivatives");
            assert!(curvature.asymmetry < 1e-10, "{what}: {}", curvature.asymmetry);
            let found = curvature.of(Quantity::Frequency).expect("it oscillates");
            assert_hessian(&found, &truth.get("d2omega_db2"), &order, &what);

            if order.iter().all(|by| matches!(by, By::Design(_))) {
                let spread = study.second_order().expect("a spread");
                let frequency = &spread.modes[r].as_ref().expect("a mode").frequency;
                let (shift, sigma) = (frequency.moments.mean_shift, frequency.moments.sigma);
                let omega = truth.get("omega").number();
                let scale = 1e-3 * omega;
                assert_close(&[shift], &[truth.get("mean_shift2").number()], scale, &what);
                assert_close(&[sigma], &[truth.get("sigma2").number()], 0.0, &what);
                moments += 1;
            }
        }
    }
    assert!(moments > 0 || file == "P3", "{file}");
}

#[test]
fn hessians_of_the_pendulums() {
    undamped(RotatingPendulum, "P1", &["L", "m"]);
    undamped(RotatingDoublePendulum, "P2", &["L1", "L2", "m1", "m2"]);
}

const PLATE: [&str; 7] = ["m", "kx", "ky", "x0", "y0", "cx", "cy"];

#[test]
fn hessians_of_the_sliders() {
    undamped(SlidersOnPlate, "P3", &PLATE);
}

#[test]
fn general_modes_of_the_sliders() {
    let mut modes = 0;
    for condition in Truth::load("P3").get("conditions").list() {
        let label = condition.get("label").text();
        let study = study(SlidersOnPlate, &condition, &PLATE);
        let at = study.equilibrium().expect("an equilibrium");
        let found = study.modes().expect("modes");
        assert_eq!(found.family, Family::General);
        assert!(!found.damping_ignored);
        let adjoint = sensitivities(&SlidersOnPlate, &at, &found).expect("derivatives");
        let explicit = sensitivities_explicit(&SlidersOnPlate, &at, &found).expect("derivatives");
        let truths = condition.get("quadratic_modes").list();
        assert_eq!(truths.len(), found.modes.len(), "{label}");
        let names: Vec<String> =
            condition.get("design").list().iter().map(|variable| variable.get("name").text()).collect();
        for (r, truth) in truths.iter().enumerate() {
            let what = format!("P3 {label} general mode {r}");
            let mode = &found.modes[r];
            assert_complex(mode.s, complex(&truth.get("s")), 0.0, &what);
            let number = |field: &str| truth.get(field).number();
            assert_close(&[mode.natural_frequency().expect("one")], &[number("omega_n")], 0.0, &what);
            assert_close(&[mode.frequency().expect("one")], &[number("omega_d")], 0.0, &what);
            let zeta = mode.damping_ratio().expect("one");
            assert_close(&[zeta], &[number("zeta")], 1e-3, &what);
            for name in &names {
                let what = format!("{what} by {name}");
                let expected = complex(&truth.get("ds_db").get(name));
                for all in [&adjoint, &explicit] {
                    let mode = &all.modes[r];
                    let ds = mode.s().expect("a derivative");
                    let natural = mode.of(Quantity::NaturalFrequency).expect("a derivative");
                    let (ds, natural) = match by(&PLATE, name) {
                        By::Input(k) => (ds.by_input[k], natural.by_input[k]),
                        By::Design(k) => (ds.by_design[k], natural.by_design[k]),
                    };
                    assert_complex(ds, expected, 1e-3, &what);
                    let expected = truth.get("domega_n_db").get(name).number();
                    assert_close(&[natural], &[expected], 1e-3, &what);
                }
            }
            let curvature = mode_curvature(&SlidersOnPlate, &at, &found, r).expect("second derivatives");
            assert!(curvature.asymmetry < 1e-11, "{what}: {}", curvature.asymmetry);
            let second_s = curvature.eigenvalue.expect("it oscillates");
            let scale = 1e-3 * complex(&truth.get("d2s_db2").list()[0].list()[0]).norm();
            for (i, row) in truth.get("d2s_db2").list().iter().enumerate() {
                for (j, value) in row.list().iter().enumerate() {
                    let pair = (by(&PLATE, &names[i]), by(&PLATE, &names[j]));
                    let what = format!("{what} by {} and {}", names[i], names[j]);
                    assert_complex(second(&second_s, pair), complex(value), scale, &what);
                }
            }
            modes += 1;
        }
    }
    assert!(modes >= 4);
}

/// Derivatives of the damping ratio, with damping as a design variable, against derivatives calculated by hand from
/// those of `s`.
#[test]
fn damping_ratios_follow_the_eigenvalue() {
    let study = Study::new(SlidersOnPlate)
        .input(SlidersOnPlate::omega, 4.0)
        .design(SlidersOnPlate::cx, 0.3)
        .design(SlidersOnPlate::cy, 0.1);
    let found = study.modes().expect("modes");
    let curvature = study.mode_curvature(0).expect("second derivatives");
    let slopes = curvature.first.of(Quantity::DampingRatio).expect("damped");
    let second = curvature.of(Quantity::DampingRatio).expect("damped");
    let ratio = |cx: f64| {
        let study = study.clone().design(SlidersOnPlate::cx, cx);
        let modes = study.modes().expect("modes").modes;
        modes[0].damping_ratio().expect("damped")
    };
    let zeta = found.modes[0].damping_ratio().expect("damped");
    let step = 1e-3;
    let (up, down) = (ratio(0.3 + step), ratio(0.3 - step));
    assert!(((up - down) / (2.0 * step) - slopes.by_design[5]).abs() < 1e-7);
    let curve = (up + down - 2.0 * zeta) / (step * step);
    assert!((curve - second.by_design[5][5]).abs() < 1e-6, "{curve}");
}
