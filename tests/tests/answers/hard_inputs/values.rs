//! Values that no machine can have, and settings that make no sense, are refused by name.

use eigentol::{Coordinate, DesignVariable, Error, Input, Kernels, Mechanism, Study};
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::corpus::{Visitor, declarations, visit};

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Tests every place of every machine.
struct EveryPlace(usize);

impl Visitor for EveryPlace {
    fn visit<M: Mechanism + Copy>(&mut self, machine: &'static str, _: &'static str, mechanism: M) {
        let names = Kernels::description(&mechanism);
        let refused = |study: Study<M>, expected: &str| {
            for error in
                [study.equilibrium().err(), study.modes().err(), study.sensitivities().err(), study.monte_carlo().err()]
            {
                let Some(Error::NotFinite { name, .. }) = error else {
                    panic!("{machine}, {expected}: {error:?}");
                };
                assert_eq!(name, expected, "{machine}");
            }
        };
        // Its curves begin at 2000 rpm.
        let input = if machine == "film_rotor" { 500.0 } else { 0.0 };
        let possible = || {
            let inputs = (0..names.inputs.len()).map(Input::new);
            inputs.fold(Study::new(mechanism), |study, x| study.input(x, input))
        };
        for value in NOT_FINITE {
            for (i, info) in names.coordinates.iter().enumerate() {
                let study = possible().start(Coordinate::new(i), value);
                refused(study, &info.name);
            }
            for (j, info) in names.inputs.iter().enumerate() {
                let study = possible().input(Input::new(j), value);
                refused(study, &info.name);
            }
            for (j, info) in names.design.iter().enumerate() {
                let study = possible().design(DesignVariable::new(j), value);
                refused(study, &info.name);
            }
        }
        self.0 += 1;
    }
}

#[test]
fn what_is_not_finite_is_named() {
    let mut every = EveryPlace(0);
    visit(&mut every);
    assert_eq!(every.0, declarations().len());
}

#[test]
fn what_no_body_can_have_is_named() {
    for (variable, quantity) in [
        (RotatingDoublePendulum::l1, "length of bar1"),
        (RotatingDoublePendulum::l2, "length of bar2"),
        (RotatingDoublePendulum::m1, "mass of bar1"),
        (RotatingDoublePendulum::m2, "mass of bar2"),
    ] {
        for value in [0.0, -0.0, -1e-300, -3.0, f64::MIN] {
            let study = Study::new(RotatingDoublePendulum).design(variable, value);
            let error = study.equilibrium().err();
            let Some(Error::Unphysical { quantity: found, requirement, value: got }) = error else {
                panic!("{quantity} = {value}: {error:?}");
            };
            assert_eq!((&*found, &*requirement), (quantity, "positive"));
            assert_eq!(got, value);
        }
    }
}

#[test]
fn settings_without_sense_are_named() {
    // Bent outwards, because the tip radius has no derivative at rest on the axis.
    let study = || Study::new(RotatingDoublePendulum).input(RotatingDoublePendulum::omega, 4.0);
    let refused = |study: Study<_>, expected: &str| {
        for error in [
            study.tolerances().err(),
            study.first_order().err(),
            study.output_tolerances().err(),
            study.monte_carlo().err(),
        ] {
            let Some(Error::Setting { setting, .. }) = error else {
                panic!("{expected}: {error:?}");
            };
            assert_eq!(setting, expected);
        }
    };
    for value in [-1e-300, -1.0].into_iter().chain(NOT_FINITE) {
        refused(study().tolerance(RotatingDoublePendulum::m1, value), "tolerance");
    }
    for value in [0.0, -0.0, -3.0].into_iter().chain(NOT_FINITE) {
        refused(study().sigma_level(value), "sigma level");
    }
    let identity = |change: &[(usize, usize, f64)]| {
        let mut matrix: [[f64; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        for &(i, j, value) in change {
            matrix[i][j] = value;
        }
        matrix
    };
    for change in [
        // Not positive semidefinite: 1 follows 0, 2 follows 1, but 2 opposes 0.
        &[(0, 1, 0.9), (1, 0, 0.9), (1, 2, 0.9), (2, 1, 0.9), (0, 2, -0.9), (2, 0, -0.9)][..],
        &[(0, 3, 1.1), (3, 0, 1.1)],
        &[(0, 3, 0.5)],
        &[(1, 1, 0.9)],
        &[(1, 1, f64::NAN)],
        &[(2, 1, f64::NAN), (1, 2, f64::NAN)],
        &[(2, 1, f64::INFINITY), (1, 2, f64::INFINITY)],
    ] {
        refused(study().correlation(identity(change)), "correlation matrix");
    }
    // Limiting case: fully correlated, singular, but semidefinite.
    let together = study().correlation([[1.0; 4]; 4]);
    assert!(together.first_order().is_ok());
}

#[test]
fn ranges_without_sense_are_named() {
    let omega = RotatingDoublePendulum::omega;
    let study = Study::new(RotatingDoublePendulum);
    for (low, high, steps) in [(f64::NAN, 1.0, 10), (0.0, f64::INFINITY, 10), (2.0, 2.0, 10), (0.0, 5.0, 0)] {
        let study = study.clone().steps(steps);
        for error in [study.critical_state(omega, low, high).err(), study.crossings(omega, low, high, 1.0).err()] {
            let refused = matches!(error, Some(Error::Setting { setting: "range", .. }));
            assert!(refused, "{low} to {high} in {steps}: {error:?}");
        }
    }
    for ratio in NOT_FINITE {
        let found = study.crossings(omega, 0.1, 2.0, ratio);
        let refused = matches!(found, Err(Error::Setting { setting: "line", .. }));
        assert!(refused, "{ratio}: {found:?}");
    }
    let none = study.critical_state(omega, 0.1, 1.0);
    let message = none.expect_err("no critical value").to_string();
    assert_eq!(message, "no critical value in the range 0.1 to 1 rad/s of input `omega`");
    let points = study.sweep(omega, &NOT_FINITE).expect("points carry their errors");
    for point in points {
        assert!(matches!(point.equilibrium, Err(Error::NotFinite { .. })));
        assert!(matches!(point.modes, Err(Error::NotFinite { .. })));
    }
}

#[test]
fn handles_of_other_machines_are_named() {
    let study = || Study::new(RotatingDoublePendulum);
    for (study, kind, index, count) in [
        (study().input(Input::new(1), 0.0), "input", 1, 1),
        (study().design(DesignVariable::new(4), 1.0), "design variable", 4, 4),
        (study().tolerance(DesignVariable::new(9), 1.0), "design variable", 9, 4),
        (study().start(Coordinate::new(usize::MAX), 0.0), "coordinate", usize::MAX, 2),
    ] {
        let expected = Error::UnknownHandle { kind, index, mechanism: "RotatingDoublePendulum".into(), count };
        assert_eq!(study.equilibrium().err(), Some(expected.clone()));
        assert_eq!(study.first_order().err(), Some(expected.clone()));
        assert_eq!(study.sweep(Input::new(0), &[1.0]).err(), Some(expected));
    }
    let swept = study().sweep(Input::new(1), &[1.0]);
    assert!(matches!(swept, Err(Error::UnknownHandle { kind: "input", .. })));
}
