//! Operating points of the machines, at which equilibria move with the design, and a loop that passes every machine to
//! a comparison.

use eigentol::Policy;
use eigentol::equilibrium::{Equilibrium, equilibrium};
use eigentol::kernels::CurvatureKernels;
use eigentol::second_order::SecondDerivatives;
use eigentol::sensitivity::Slopes;

use crate::tables;

pub use eigentol_rederived::{ComplexDerived, Derived, GeneralMode, Machine, State, UndampedMode, Vibration};

/// One operating point of a machine: inputs in SI, and where to look for the equilibrium.
#[derive(Clone, Debug)]
pub struct Operation {
    /// Inputs, SI.
    pub inputs: Vec<f64>,
    /// Start values of the coordinates, rad or m.
    pub start: Vec<f64>,
    /// Which equilibrium to choose.
    pub policy: Policy,
}

/// Operating points of the machines of the corpus and of [`machines`](crate::machines): away from critical states and,
/// where a machine can bend, bent.
///
/// # Panics
/// For an unknown name.
pub fn operating_points(name: &str) -> Vec<Operation> {
    let point = |inputs: &[f64], start: &[f64]| Operation {
        inputs: inputs.to_vec(),
        start: start.to_vec(),
        policy: Policy::Stable,
    };
    // Held by its spin in a position that an energy descent would leave.
    let nearest = |inputs: &[f64]| Operation { policy: Policy::Nearest, ..point(inputs, &[0.0; 2]) };
    let rpm = 2.0 * std::f64::consts::PI / 60.0;
    match name {
        "rotating_pendulum" => vec![point(&[2.0], &[0.0]), point(&[5.0], &[0.9])],
        "rotating_double_pendulum" => vec![point(&[1.5], &[0.0; 2]), point(&[4.0], &[0.9, 0.1])],
        "sliders_on_plate" => vec![point(&[4.0], &[0.1, 0.02])],
        "chain_of_four" => vec![point(&[3.0], &[0.9, 0.1, 0.1, 0.1])],
        "chain_of_eight" => vec![point(&[2.5], &[0.9, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1])],
        "governor" => vec![point(&[110.0 * rpm, 0.09], &[0.4])],
        "turntable_slider" => vec![point(&[4.0], &[0.25, 0.3])],
        "rotor" => [600.0, 1500.0].map(|speed| point(&[speed * rpm], &[0.0; 2])).to_vec(),
        "gimbal" => vec![point(&[3000.0 * rpm], &[0.0; 2])],
        "carousel" => vec![point(&[9.0 * rpm], &[0.4, 0.0])],
        "rotor_blade" => vec![point(&[30.0], &[0.05, 0.0])],
        "centrifuge" => vec![point(&[12.0, 1.0], &[1.0])],
        "hoist" => vec![point(&[0.3, 0.2], &[0.5, 0.0, 0.0])],
        "bucket_chain" => vec![point(&[5.0], &[0.1; 14])],
        "flap_lag_blade" => vec![point(&[20.0], &[0.0; 2])],
        "bearing_rotor" => vec![point(&[3000.0 * rpm], &[0.0; 5])],
        "steady_top" => {
            [(25.0, 0.0), (12.0, 1000.0)].map(|(precession, spin)| point(&[precession, spin * rpm], &[0.6])).to_vec()
        }
        "screw_press" => vec![point(&[], &[0.0; 9])],
        "jeffcott_rotor" => vec![point(&[50.0], &[0.0; 2]), point(&[300.0], &[0.0; 2])],
        "overhung_rotor" => vec![point(&[200.0], &[0.0; 2])],
        "sleeping_top" => vec![nearest(&[150.0])],
        "sliding_pair" => vec![point(&[], &[0.0; 2])],
        "spherical_pendulum" => vec![point(&[1.0], &[0.0; 2]), nearest(&[5.0])],
        "ziegler_column" => vec![point(&[100.0], &[0.0; 2])],
        "film_rotor" => [3000.0, 9000.0].map(|speed| point(&[speed * rpm], &[0.0; 2])).to_vec(),
        "balanced_fan" => vec![point(&[150.0, 90.0], &[0.0; 4])],
        "shaken_turntable" => vec![point(&[6.0, 40.0], &[0.5])],
        "hinged_tip_blade" => [0.0, 25.0].map(|speed| point(&[speed], &[0.0; 4])).to_vec(),
        "twisting_boom" => vec![point(&[], &[0.0; 3])],
        "robot_arm" => vec![point(&[], &[0.1; 7])],
        _ => panic!("nobody has said how {name} is run"),
    }
}

/// First derivatives by design variables, then inputs.
#[must_use]
pub fn flat<T: Copy>(all: &Slopes<T>) -> Vec<T> {
    [&all.by_design[..], &all.by_input].concat()
}

/// Second derivatives by design variables, then inputs.
#[must_use]
pub fn ordered<T: Copy>(all: &SecondDerivatives<T>) -> Vec<Vec<T>> {
    let (design, inputs) = (all.by_design.row_count(), all.by_input.row_count());
    let by = |i: usize, j: usize| match (i < design, j < design) {
        (true, true) => all.by_design[i][j],
        (true, false) => all.by_input_and_design[j - design][i],
        (false, true) => all.by_input_and_design[i - design][j],
        (false, false) => all.by_input[i - design][j - design],
    };
    let variables = 0..design + inputs;
    let row = |i| variables.clone().map(|j| by(i, j)).collect();
    variables.clone().map(row).collect()
}

/// A comparison between the product and the solution in hyper-dual numbers.
pub trait Comparison {
    /// Called for each machine at each of its operating points, with nominal design variables. `state` is the same
    /// equilibrium as `at`.
    fn compare(&mut self, what: &str, machine: &dyn CurvatureKernels, at: &Equilibrium, state: &State);
}

fn compare(comparison: &mut impl Comparison, name: &str, declaration: &str, machine: &dyn CurvatureKernels) {
    let resolved = Machine::new(declaration);
    let design = &machine.description().design;
    let b: Vec<f64> = design.iter().map(|variable| variable.nominal).collect();
    assert_eq!(resolved.nominal(), b, "{name}");
    for operation in operating_points(name) {
        let Operation { inputs: u, start, policy } = operation;
        let what = format!("{name} at {u:?}");
        let at = equilibrium(machine, &u, &b, &start, policy).unwrap_or_else(|error| panic!("{what}: {error}"));
        let state = resolved.at(&u, &b, &at.coordinates);
        for (one, other) in at.coordinates.iter().zip(&state.coordinates) {
            assert!((one - other).abs() <= 1e-9 * (1.0 + one.abs()), "{what}: {one}, {other}");
        }
        comparison.compare(&what, machine, &at, &state);
    }
}

/// Compares every machine of the corpus and every machine with a closed form at all its operating points.
pub fn every_machine(comparison: &mut impl Comparison) {
    for machine in tables::open() {
        compare(comparison, machine.name, machine.declaration, &*machine.curvature);
    }
}
