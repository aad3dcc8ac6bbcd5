//! A machine with beams, compiled, and the same in the oracle.

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::{Compilation, compile};
use eigentol_oracle::kernels::Kernels;
use eigentol_oracle::model::Model;
use eigentol_oracle::random::Random;
use eigentol_oracle::{Oracle, energy};
use eigentol_tests::to_oracle_model::to_oracle_model;

pub(crate) struct Machine {
    pub(crate) compiled: Compilation,
    pub(crate) text: String,
}

/// A state of motion in the unknowns of the machine.
pub(crate) struct State {
    pub(crate) acceleration: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) u: Vec<f64>,
    pub(crate) b: Vec<f64>,
}

impl Machine {
    pub(crate) fn new(text: &str) -> Result<Self, String> {
        let tokens = text.parse().unwrap_or_else(|error| panic!("{error}\n{text}"));
        let compiled = compile(tokens, Limits::default()).map_err(|mistakes| mistakes.to_string())?;
        Ok(Self { compiled, text: text.to_owned() })
    }

    /// A machine that must be accepted.
    pub(crate) fn right(text: &str) -> Self {
        Self::new(text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
    }

    pub(crate) fn roles(&self) -> Vec<Role> {
        let unknowns = self.compiled.functions.unknowns.iter();
        unknowns.map(|unknown| unknown.role).collect()
    }

    /// Random: beams turn by half a radian or less per coordinate, and stretch and shear by a tenth.
    pub(crate) fn state(&self, random: &mut Random) -> State {
        let mechanism = &self.compiled.mechanism;
        let n = self.roles().len();
        let beams: Vec<_> = mechanism.beams.iter().flat_map(|beam| beam.coordinates.concat()).collect();
        let strains = mechanism.beams.iter().map(|beam| beam.strains.concat());
        let strains: Vec<_> = strains.flatten().collect();
        let mut all = |limit: f64| (0..n).map(|_| random.between(-limit, limit)).collect();
        let (acceleration, velocity): (Vec<f64>, Vec<f64>) = (all(3.0), all(2.0));
        let q = self.roles().into_iter().map(|role| match role {
            Role::Position(id) if beams.contains(&id) => random.between(-0.5, 0.5),
            Role::Position(id) if strains.contains(&id) => random.between(-0.1, 0.1),
            _ => random.between(-0.9, 0.9),
        });
        let q = q.collect();
        let inputs = mechanism.inputs.iter();
        let u = inputs.map(|_| random.between(0.5, 4.0)).collect();
        let design = mechanism.design.iter();
        let b = design.map(|design| design.nominal * random.between(0.9, 1.1));
        State { acceleration, velocity, q, u, b: b.collect() }
    }

    pub(crate) fn evaluate(&self, kernel: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
        let found = self.compiled.program.evaluate(kernel, arguments);
        found.unwrap_or_else(|| panic!("no kernel {kernel}"))
    }

    /// The oracle's model at inputs and design variables, and the speeds of its drives.
    pub(crate) fn model(&self, state: &State) -> (Model, Vec<f64>) {
        to_oracle_model(&self.compiled.mechanism, &state.u, &state.b)
    }

    /// For each unknown, the place of its coordinate among the free ones of the oracle.
    pub(crate) fn order(&self, model: &Model) -> Vec<usize> {
        let free = model.free();
        let names: Vec<&str> = free.iter().map(|x| model.step(*x).name.as_str()).collect();
        let coordinates = &self.compiled.mechanism.coordinates;
        let place = |role: Role| match role {
            Role::Position(id) | Role::Speed(id) => {
                let name = coordinates[id.index()].name.to_string();
                let place = names.iter().position(|x| *x == name);
                place.unwrap_or_else(|| panic!("{name} is not in {names:?}"))
            }
            _ => panic!("reactions are unknown to the oracle"),
        };
        self.roles().into_iter().map(place).collect()
    }

    /// Acceleration, velocity and position of the oracle: a coasting coordinate stands at zero, its unknown is the speed.
    pub(crate) fn motion(&self, model: &Model, state: &State) -> [Vec<f64>; 3] {
        let mut motion = [(); 3].map(|()| vec![0.0; model.free().len()]);
        for (k, (place, role)) in self.order(model).into_iter().zip(self.roles()).enumerate() {
            let own = match role {
                Role::Speed(_) => [state.velocity[k], state.q[k], 0.0],
                _ => [state.acceleration[k], state.velocity[k], state.q[k]],
            };
            for (list, value) in motion.iter_mut().zip(own) {
                list[place] = value;
            }
        }
        motion
    }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

/// Panics unless all entries agree to a share of `size`.
pub(crate) fn assert_close(what: &str, values: &[f64], expected: &[f64], bar: f64, size: f64) {
    assert_eq!(values.len(), expected.len(), "{what}");
    for (k, (one, other)) in values.iter().zip(expected).enumerate() {
        // NaN is not agreement
        let agrees = (one - other).abs() <= bar * size;
        assert!(agrees, "{what}[{k}] is {one:e}, not {other:e}");
    }
}

const BAR: f64 = 1e-10;

/// Residual, mass, damping, stiffness and motion against both derivations of the oracle.
pub(crate) fn judge(what: &str, machine: &Machine, state: &State) {
    let (model, speeds) = machine.model(state);
    let oracle = Oracle::new(&model);
    let order = machine.order(&model);
    let ordered = |values: &[f64]| -> Vec<f64> { order.iter().map(|&k| values[k]).collect() };
    let what = |kernel: &str| format!("{what}: {kernel}\n{}", machine.text);

    let motion = machine.motion(&model, state);
    let [acceleration, velocity, q] = motion.each_ref().map(Vec::as_slice);
    let arguments: [&[f64]; 5] = [&state.acceleration, &state.velocity, &state.q, &state.u, &state.b];
    let found = &machine.evaluate("motion_residual", &arguments)[0];
    let lagrange = energy::residual(&model, [acceleration, velocity, q], &speeds, &[]);
    let size = 1.0 + largest(&lagrange);
    assert_close(&what("motion, by energies"), found, &ordered(&lagrange), BAR, size);
    let paper = Kernels::motion_residual(&oracle, acceleration, velocity, [q, &speeds, &[]]);
    assert_close(&what("motion, by matrices"), found, &ordered(&paper), BAR, size);
    let coasts = machine.roles().iter().any(|role| matches!(role, Role::Speed(_)));
    if coasts {
        return;
    }
    let at: [&[f64]; 3] = [q, &speeds, &[]];
    let rest: [&[f64]; 3] = [&state.q, &state.u, &state.b];
    let linear = Kernels::linear(&oracle, at);
    let n = q.len();
    let matrix = |values: &[f64]| -> Vec<f64> {
        let rows = order.iter();
        rows.flat_map(|i| order.iter().map(move |j| values[i * n + j])).collect()
    };
    let found = machine.evaluate("linear", &rest);
    let names = ["mass", "damping", "stiffness"];
    let expected = [&linear.mass, &linear.damping, &linear.stiffness];
    for ((name, found), expected) in names.iter().zip(&found).zip(expected) {
        let size = match *name {
            "mass" => largest(expected),
            _ => 1.0 + largest(&linear.stiffness).max(largest(expected)),
        };
        assert_close(&what(name), found, &matrix(expected), BAR, size);
    }
    let found = &machine.evaluate("residual", &rest)[0];
    let expected = Kernels::residual(&oracle, at);
    let size = 1.0 + largest(&linear.stiffness);
    assert_close(&what("residual"), found, &ordered(&expected), BAR, size);
}
