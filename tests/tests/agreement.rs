//! Checks every implementation of the generated code's kernels against the oracle on random trees.

use std::cell::Cell;

use eigentol_oracle::agreement::{Case, Reference, assert_agrees};
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::kernels::{At, Gradient, Kernels, Pencil};
use eigentol_oracle::model::Model;
use eigentol_oracle::random::{Plan, Setting, on_plans};
use eigentol_oracle::{Linear, LinearPartials, Oracle};
use eigentol_tests::compiled::Compiled;

/// The compiler may refuse only those trees in which the oracle also finds a load along a direction that nothing holds.
#[test]
fn the_compiler_agrees_with_the_oracle() {
    agrees_on(16);
}

#[test]
#[ignore = "takes a minute"]
fn the_compiler_agrees_with_the_oracle_on_many_trees() {
    agrees_on(240);
}

fn agrees_on(trees: u32) {
    let compared = Cell::new(0);
    on_plans(trees, |plan| {
        let model = plan.model();
        match Compiled::new(&model) {
            Ok(compiled) => {
                compared.set(compared.get() + 1);
                assert_agrees(&model, &compiled, plan.seed);
            }
            Err(mistakes) => {
                for mistake in mistakes.iter() {
                    assert!(
                        is_unbalanced(&model, &mistake.message),
                        "{}\n{}",
                        mistake.message,
                        declaration(&model)
                    );
                }
            }
        }
    });
    let compared = compared.get();
    assert!(compared >= trees * 3 / 4, "{compared} trees compared");
}

/// Whether `message` names directions along which loads act and nothing holds the mechanism, and along each the oracle's
/// residual does the same work everywhere.
fn is_unbalanced(model: &Model, message: &str) -> bool {
    let directions = message
        .strip_suffix(", which nothing holds")
        .and_then(|rest| rest.split_once(" along "))
        .map(|(_, directions)| directions.replace(" and ", ", "));
    let Some(directions) = directions else {
        return false;
    };
    let free = model.free();
    let name = |coordinate: &_| model.step(*coordinate).name.clone();
    let names: Vec<String> = free.iter().map(name).collect();
    directions.split(", ").all(|direction| {
        let text = direction.trim_matches('`');
        let (moved, shares) = text.split_once(" = ").unwrap_or((text, "1"));
        let places = moved
            .split(" : ")
            .map(|own| names.iter().position(|name| name == own));
        let places: Option<Vec<usize>> = places.collect();
        let shares: Vec<f64> = shares
            .split(" : ")
            .filter_map(|own| own.parse().ok())
            .collect();
        let Some(places) = places.filter(|places| places.len() == shares.len()) else {
            return false;
        };
        let powers: Vec<f64> = (1..4)
            .map(|seed| {
                let Case { at: [q, ..], .. } = Case::random(model, seed);
                let Case { at: [_, u, b], .. } = Case::random(model, 1);
                let residual = Kernels::residual(&Oracle::new(model), [&q, &u, &b]);
                places
                    .iter()
                    .zip(&shares)
                    .map(|(&k, share)| share * residual[k])
                    .sum()
            })
            .collect();
        let same = |power: &f64| (power - powers[0]).abs() < 1e-4 * powers[0].abs();
        powers[0].abs() > 1e-9 && powers.iter().all(same)
    })
}

/// The oracle in another ground frame: correct, but rounded differently.
#[test]
fn rounding_is_no_disagreement() {
    on_plans(8, |plan| {
        let model = plan.model();
        let other = Oracle::new(&model).turned([1.0, 2.0, -0.4], 2.1);
        assert_agrees(&model, &other, plan.seed);
    });
}

/// The oracle with a small error in one entry of one returned array.
struct Faulty<'a> {
    oracle: Oracle<'a>,
    /// Index of the array, counted over all calls.
    target: usize,
    call: Cell<usize>,
    touched: Cell<bool>,
}

impl Faulty<'_> {
    fn spoil(&self, mut array: Vec<f64>) -> Vec<f64> {
        let call = self.call.get();
        self.call.set(call + 1);
        if call == self.target {
            // The largest entry of the array: small ones may be noise.
            let size = |i: &usize| array[*i].abs();
            let entry = (0..array.len()).max_by(|i, j| size(i).total_cmp(&size(j)));
            if let Some(entry) = entry.filter(|&entry| array[entry].abs() > 1e-4) {
                array[entry] *= 1.0 + 1e-5;
                self.touched.set(true);
            }
        }
        array
    }

    fn spoil_linear(&self, linear: Linear<f64>) -> Linear<f64> {
        Linear {
            mass: self.spoil(linear.mass),
            damping: self.spoil(linear.damping),
            stiffness: self.spoil(linear.stiffness),
        }
    }

    fn spoil_all(&self, list: Vec<Linear<f64>>) -> Vec<Linear<f64>> {
        list.into_iter()
            .map(|linear| self.spoil_linear(linear))
            .collect()
    }
}

impl Kernels for Faulty<'_> {
    fn residual(&self, at: At) -> Vec<f64> {
        self.spoil(Kernels::residual(&self.oracle, at))
    }

    fn residual_parts(&self, at: At) -> [Vec<f64>; 2] {
        self.oracle.residual_parts(at).map(|part| self.spoil(part))
    }

    fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], at: At) -> Vec<f64> {
        self.spoil(Kernels::motion_residual(
            &self.oracle,
            acceleration,
            velocity,
            at,
        ))
    }

    fn motion(&self, velocity: &[f64], at: At) -> [Vec<f64>; 2] {
        Kernels::motion(&self.oracle, velocity, at).map(|part| self.spoil(part))
    }

    fn residual_and_stiffness(&self, at: At) -> [Vec<f64>; 2] {
        self.oracle
            .residual_and_stiffness(at)
            .map(|part| self.spoil(part))
    }

    fn linear(&self, at: At) -> Linear<f64> {
        self.spoil_linear(Kernels::linear(&self.oracle, at))
    }

    fn residual_partials(&self, at: At) -> [Vec<f64>; 2] {
        Kernels::residual_partials(&self.oracle, at).map(|part| self.spoil(part))
    }

    fn linear_partials(&self, at: At) -> LinearPartials {
        let partials = Kernels::linear_partials(&self.oracle, at);
        LinearPartials {
            by_coordinate: self.spoil_all(partials.by_coordinate),
            by_input: self.spoil_all(partials.by_input),
            by_design: self.spoil_all(partials.by_design),
        }
    }

    fn linear_along(&self, at: At, along: At) -> Linear<f64> {
        self.spoil_linear(Kernels::linear_along(&self.oracle, at, along))
    }

    fn mode_gradient(&self, at: At, phi: &[f64], lambda: f64) -> Gradient {
        self.oracle
            .mode_gradient(at, phi, lambda)
            .map(|part| self.spoil(part))
    }

    fn pencil_gradient(&self, at: At, pencil: Pencil) -> Gradient {
        let gradient = self.oracle.pencil_gradient(at, pencil);
        gradient.map(|part| self.spoil(part))
    }

    fn residual_gradient(&self, at: At, w: &[f64]) -> Gradient {
        self.oracle
            .residual_gradient(at, w)
            .map(|part| self.spoil(part))
    }

    fn whirl(&self, at: At, real: &[f64], imaginary: &[f64]) -> Vec<f64> {
        self.spoil(Kernels::whirl(&self.oracle, at, real, imaginary))
    }

    fn mode_gradient_along(
        &self,
        at: At,
        mode: (&[f64], f64),
        along: At,
        mode_along: (&[f64], f64),
    ) -> Gradient {
        let gradient = self.oracle.mode_gradient_along(at, mode, along, mode_along);
        gradient.map(|part| self.spoil(part))
    }

    fn pencil_gradient_along(
        &self,
        at: At,
        pencil: Pencil,
        along: At,
        pencil_along: Pencil,
    ) -> Gradient {
        let oracle = &self.oracle;
        let gradient = oracle.pencil_gradient_along(at, pencil, along, pencil_along);
        gradient.map(|part| self.spoil(part))
    }

    fn residual_gradient_along(&self, at: At, w: &[f64], along: At, dw: &[f64]) -> Gradient {
        let gradient = self.oracle.residual_gradient_along(at, w, along, dw);
        gradient.map(|part| self.spoil(part))
    }
}

#[test]
fn every_fault_is_found() {
    every_fault_is_found_on(2);
}

#[test]
#[ignore = "a quarter of a minute"]
fn every_fault_is_found_on_three_bodies() {
    every_fault_is_found_on(3);
}

/// A comparison that cannot fail proves nothing: perturbs every array of every kernel once, by one part in 10^5.
fn every_fault_is_found_on(bodies: usize) {
    let plan = Plan {
        setting: Setting::Spinning,
        bodies,
        rotor: false,
        special: false,
        seed: 11,
    };
    let model = plan.model();
    let reference = Reference::new(&model, 5);
    let mut found = 0;
    for target in 0.. {
        let oracle = Oracle::new(&model);
        let faulty = Faulty {
            oracle,
            target,
            call: Cell::new(0),
            touched: Cell::new(false),
        };
        let report = reference.compare(&faulty);
        assert_eq!(
            report.is_err(),
            faulty.touched.get(),
            "array {target}: {report:?}"
        );
        found += usize::from(report.is_err());
        if target >= faulty.call.get() {
            break;
        }
    }
    assert!(found > 40, "{found} faults");
}

#[test]
fn a_report_names_the_kernel_the_entry_and_the_declaration() {
    let plan = Plan {
        setting: Setting::Spinning,
        bodies: 2,
        rotor: false,
        special: false,
        seed: 11,
    };
    let model = plan.model();
    let oracle = Oracle::new(&model);
    let faulty = Faulty {
        oracle,
        target: 0,
        call: Cell::new(0),
        touched: Cell::new(false),
    };
    let report = Reference::new(&model, 5)
        .compare(&faulty)
        .expect_err("a fault");
    for part in [
        "residual: residual[",
        "the oracle says",
        "pub mechanism Tree {",
        "seed 5",
    ] {
        assert!(report.contains(part), "{part}: {report}");
    }
}
