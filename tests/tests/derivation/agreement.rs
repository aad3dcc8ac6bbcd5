//! Checks every implementation of the generated code's kernels against the oracle on random trees.

mod refusals;

use std::cell::{Cell, RefCell};

use eigentol_oracle::agreement::{Reference, assert_agrees};
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::kernels::{At, Gradient, Kernels, Pencil};
use eigentol_oracle::model::{Coordinate, Force, ForceLaw, Value};
use eigentol_oracle::random::{Plan, Setting, on_plans};
use eigentol_oracle::{Linear, LinearPartials, Oracle};
use eigentol_tests::compiled::Compiled;

use refusals::is_unbalanced;

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
                    assert!(is_unbalanced(&model, &mistake.message), "{}\n{}", mistake.message, declaration(&model));
                }
            }
        }
    });
    let compared = compared.get();
    assert!(compared >= trees * 3 / 4, "{compared} trees compared");
}

/// A body on a ball joint, with a force fixed in it of which the moment about the line from the joint to the centre of
/// mass is the same everywhere.
const TURNED_BY_A_FOLLOWER: Plan =
    Plan { setting: Setting::Still, bodies: 5, rotor: false, special: false, seed: 7_501_538_584_419_613_230 };

/// A body on a hinge, with a load that is the same everywhere.
const TURNED_BY_A_LOAD: Plan =
    Plan { setting: Setting::Still, bodies: 1, rotor: false, special: true, seed: 10_268_359_363_991_272_455 };

#[test]
fn a_refusal_is_right_only_if_nothing_holds_the_motion() {
    for (plan, joint, message) in [
        (TURNED_BY_A_FOLLOWER, "joint3", "`force5` acts along rotation of `body1`, which nothing holds"),
        (TURNED_BY_A_LOAD, "joint0", "`force0` acts along `joint0`, which nothing holds"),
    ] {
        let mut model = plan.model();
        let mistakes = Compiled::new(&model).err().expect("a refusal");
        let messages: Vec<&str> = mistakes.iter().map(|mistake| mistake.message.as_str()).collect();
        assert_eq!(messages, [message]);
        assert!(is_unbalanced(&model, message), "{message}");

        let named = model.joints.iter().position(|x| x.name == joint);
        let coordinate = Coordinate { joint: named.expect("a joint of the model"), step: 0 };
        model.forces.push(Force {
            name: "holder".to_owned(),
            law: ForceLaw::Spring { coordinate, stiffness: Value::Number(0.1), rest: Value::Number(0.0) },
        });
        assert!(!is_unbalanced(&model, message), "held, yet {message}");
    }
}

#[test]
fn a_refusal_that_names_another_motion_is_wrong() {
    let model = TURNED_BY_A_FOLLOWER.model();
    for motion in [
        "`joint1`",
        "`joint3a`",
        "`joint3b : joint3c = 1 : -0.5`",
        "`joint3b` with rotation of `body3`",
        "rotation of `body0`",
        "rotation of `body2`, `body3`",
        "translation of `body1`",
        "rotation of `body1` and `joint1`",
        "rotation of `nobody`",
        "a motion",
    ] {
        let message = format!("`force5` acts along {motion}, which nothing holds");
        assert!(!is_unbalanced(&model, &message), "{message}");
    }
}

/// The oracle in another ground frame: correct, but rounded differently.
#[test]
fn rounding_is_no_disagreement() {
    agrees_in_another_frame(3);
}

#[test]
#[ignore = "ten seconds"]
fn rounding_is_no_disagreement_on_many_trees() {
    agrees_in_another_frame(16);
}

fn agrees_in_another_frame(trees: u32) {
    on_plans(trees, |plan| {
        let model = plan.model();
        let other = Oracle::new(&model).turned([1.0, 2.0, -0.4], 2.1);
        assert_agrees(&model, &other, plan.seed);
    });
}

/// The oracle with a small error in one entry of one returned array. What it said before is read from a record.
struct Faulty<'a> {
    oracle: &'a Oracle<'a>,
    /// The arrays of each call.
    record: &'a RefCell<Vec<Vec<Vec<f64>>>>,
    /// Index of the array, counted over all calls.
    target: usize,
    calls: Cell<usize>,
    arrays: Cell<usize>,
    touched: Cell<bool>,
}

impl<'a> Faulty<'a> {
    fn new(oracle: &'a Oracle<'a>, record: &'a RefCell<Vec<Vec<Vec<f64>>>>, target: usize) -> Self {
        Self { oracle, record, target, calls: Cell::new(0), arrays: Cell::new(0), touched: Cell::new(false) }
    }

    fn answer(&self, evaluate: impl FnOnce() -> Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let call = self.calls.replace(self.calls.get() + 1);
        let mut record = self.record.borrow_mut();
        if call == record.len() {
            record.push(evaluate());
        }
        let mut arrays = record[call].clone();
        arrays.iter_mut().for_each(|array| self.spoil(array));
        arrays
    }

    fn spoil(&self, array: &mut [f64]) {
        if self.arrays.replace(self.arrays.get() + 1) == self.target {
            // The largest entry of the array: small ones may be noise.
            let size = |i: &usize| array[*i].abs();
            let entry = (0..array.len()).max_by(|i, j| size(i).total_cmp(&size(j)));
            if let Some(entry) = entry.filter(|&entry| array[entry].abs() > 1e-4) {
                array[entry] *= 1.0 + 1e-5;
                self.touched.set(true);
            }
        }
    }

    fn one(&self, evaluate: impl FnOnce() -> Vec<f64>) -> Vec<f64> {
        let [array] = self.some(|| [evaluate()]);
        array
    }

    fn some<const N: usize>(&self, evaluate: impl FnOnce() -> [Vec<f64>; N]) -> [Vec<f64>; N] {
        let arrays = self.answer(|| evaluate().into());
        arrays.try_into().expect("as many as there were")
    }

    fn matrices(&self, evaluate: impl FnOnce() -> Linear<f64>) -> Linear<f64> {
        joined(self.some(|| split(evaluate())))
    }
}

fn split(linear: Linear<f64>) -> [Vec<f64>; 3] {
    [linear.mass, linear.damping, linear.stiffness]
}

fn joined([mass, damping, stiffness]: [Vec<f64>; 3]) -> Linear<f64> {
    Linear { mass, damping, stiffness }
}

impl Kernels for Faulty<'_> {
    fn residual(&self, at: At) -> Vec<f64> {
        self.one(|| Kernels::residual(self.oracle, at))
    }

    fn residual_parts(&self, at: At) -> [Vec<f64>; 2] {
        self.some(|| self.oracle.residual_parts(at))
    }

    fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], at: At) -> Vec<f64> {
        self.one(|| Kernels::motion_residual(self.oracle, acceleration, velocity, at))
    }

    fn motion(&self, velocity: &[f64], at: At) -> [Vec<f64>; 2] {
        self.some(|| Kernels::motion(self.oracle, velocity, at))
    }

    fn residual_and_stiffness(&self, at: At) -> [Vec<f64>; 2] {
        self.some(|| self.oracle.residual_and_stiffness(at))
    }

    fn linear(&self, at: At) -> Linear<f64> {
        self.matrices(|| Kernels::linear(self.oracle, at))
    }

    fn residual_partials(&self, at: At) -> [Vec<f64>; 2] {
        self.some(|| Kernels::residual_partials(self.oracle, at))
    }

    fn linear_partials(&self, at: At) -> LinearPartials {
        let mut arrays = self
            .answer(|| {
                let partials = Kernels::linear_partials(self.oracle, at);
                [partials.by_coordinate, partials.by_input, partials.by_design]
                    .into_iter()
                    .flatten()
                    .flat_map(split)
                    .collect()
            })
            .into_iter();
        let mut next = || arrays.next().expect("as many as there were");
        let [by_coordinate, by_input, by_design] = at.map(|arguments| {
            let one = |_| joined([next(), next(), next()]);
            (0..arguments.len()).map(one).collect()
        });
        LinearPartials { by_coordinate, by_input, by_design }
    }

    fn linear_along(&self, at: At, along: At) -> Linear<f64> {
        self.matrices(|| Kernels::linear_along(self.oracle, at, along))
    }

    fn mode_gradient(&self, at: At, phi: &[f64], lambda: f64) -> Gradient {
        self.some(|| self.oracle.mode_gradient(at, phi, lambda))
    }

    fn pencil_gradient(&self, at: At, pencil: Pencil) -> Gradient {
        self.some(|| self.oracle.pencil_gradient(at, pencil))
    }

    fn residual_gradient(&self, at: At, w: &[f64]) -> Gradient {
        self.some(|| self.oracle.residual_gradient(at, w))
    }

    fn whirl(&self, at: At, real: &[f64], imaginary: &[f64]) -> Vec<f64> {
        self.one(|| Kernels::whirl(self.oracle, at, real, imaginary))
    }

    fn mode_gradient_along(&self, at: At, mode: (&[f64], f64), along: At, mode_along: (&[f64], f64)) -> Gradient {
        self.some(|| self.oracle.mode_gradient_along(at, mode, along, mode_along))
    }

    fn pencil_gradient_along(&self, at: At, pencil: Pencil, along: At, pencil_along: Pencil) -> Gradient {
        self.some(|| {
            let oracle = self.oracle;
            oracle.pencil_gradient_along(at, pencil, along, pencil_along)
        })
    }

    fn residual_gradient_along(&self, at: At, w: &[f64], along: At, dw: &[f64]) -> Gradient {
        self.some(|| self.oracle.residual_gradient_along(at, w, along, dw))
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
    let plan = Plan { setting: Setting::Spinning, bodies, rotor: false, special: false, seed: 11 };
    let model = plan.model();
    let reference = Reference::new(&model, 5);
    let (oracle, record) = (Oracle::new(&model), RefCell::default());
    let mut found = 0;
    for target in 0.. {
        let faulty = Faulty::new(&oracle, &record, target);
        let report = reference.compare(&faulty);
        assert_eq!(report.is_err(), faulty.touched.get(), "array {target}: {report:?}");
        found += usize::from(report.is_err());
        if target >= faulty.arrays.get() {
            break;
        }
    }
    assert!(found > 40, "{found} faults");
}

#[test]
fn a_report_names_the_kernel_the_entry_and_the_declaration() {
    let plan = Plan { setting: Setting::Spinning, bodies: 2, rotor: false, special: false, seed: 11 };
    let model = plan.model();
    let (oracle, record) = (Oracle::new(&model), RefCell::default());
    let faulty = Faulty::new(&oracle, &record, 0);
    let report = Reference::new(&model, 5).compare(&faulty).expect_err("a fault");
    for part in ["residual: residual[", "the oracle says", "pub mechanism Tree {", "seed 5"] {
        assert!(report.contains(part), "{part}: {report}");
    }
}
