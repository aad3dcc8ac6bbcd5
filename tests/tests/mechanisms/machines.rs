//! Every machine of the corpus against the oracle: residual, mass, damping and stiffness at random states, and their
//! derivatives by every design variable and input against finite differences of the oracle.

use eigentol_compiler::base::diagnostics::Diagnostics;
use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::model::mechanism::{CoordinateQuantity, Mechanism};
use eigentol_compiler::program::Program;
use eigentol_oracle::Oracle;
use eigentol_oracle::kernels::Kernels;
use eigentol_oracle::truth::Truth;
use eigentol_tests::corpus::declarations;
use eigentol_tests::to_oracle_model::to_oracle_model;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const EVERYTHING: Limits = Limits::NONE;

struct Machine {
    mechanism: Mechanism,
    program: Program,
    /// Units of the free coordinates.
    quantities: Vec<CoordinateQuantity>,
}

impl Machine {
    fn new(declaration: &str) -> Result<Self, Diagnostics> {
        let compilation = compile(declaration.parse().expect("tokens"), EVERYTHING)?;
        let coordinates = &compilation.mechanism.coordinates;
        let quantities = compilation.topology.free.iter().map(|id| coordinates[id.index()].quantity).collect();
        Ok(Self { mechanism: compilation.mechanism, program: compilation.program, quantities })
    }

    fn evaluate(&self, kernel: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
        self.program.evaluate(kernel, arguments).expect("the kernel exists")
    }
}

fn uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Residual, mass, damping and stiffness from the oracle.
fn judged(machine: &Machine, q: &[f64], u: &[f64], b: &[f64]) -> [Vec<f64>; 4] {
    let (model, speeds) = to_oracle_model(&machine.mechanism, u, b);
    let oracle = Oracle::new(&model);
    let at = [q, &speeds[..], &[][..]];
    let linear = Kernels::linear(&oracle, at);
    [Kernels::residual(&oracle, at), linear.mass, linear.damping, linear.stiffness]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

#[test]
fn the_corpus_agrees_with_the_oracle() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for (name, declaration) in declarations() {
        let machine = Machine::new(declaration).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        for _ in 0..4 {
            let q: Vec<f64> = machine
                .quantities
                .iter()
                .map(|quantity| match quantity {
                    CoordinateQuantity::Angle => uniform(&mut rng, 0.2, 1.1),
                    CoordinateQuantity::Displacement => uniform(&mut rng, -0.1, 0.1),
                })
                .collect();
            let u: Vec<f64> = machine.mechanism.inputs.iter().map(|_| uniform(&mut rng, 0.5, 4.0)).collect();
            let b: Vec<f64> = machine
                .mechanism
                .design
                .iter()
                .map(|variable| variable.nominal * uniform(&mut rng, 0.95, 1.05))
                .collect();
            let [residual, mass, damping, stiffness] = judged(&machine, &q, &u, &b);
            let got = [machine.evaluate("residual", &[&q, &u, &b]), machine.evaluate("linear", &[&q, &u, &b])].concat();
            let names = ["g", "Mhat", "Chat", "Khat"];
            // Stiff elements cancel in soft directions, so the size of the terms sets the scale.
            let size = largest(&stiffness).max(1e-3);
            for ((name_of, expected), got) in names.iter().zip([residual, mass, damping, stiffness]).zip(&got) {
                let scale = match *name_of {
                    "Mhat" => largest(&expected),
                    _ => size.max(largest(&expected)),
                };
                for (k, (x, y)) in got.iter().zip(&expected).enumerate() {
                    assert!((x - y).abs() <= 1e-11 * scale, "{name}, {name_of}[{k}]: {x:e}, the oracle says {y:e}");
                }
            }
            check_design_derivatives(name, &machine, &q, &u, &b);
        }
    }
}

/// `linear_partials` and `residual_partials` by design against central differences of the oracle.
fn check_design_derivatives(name: &str, machine: &Machine, q: &[f64], u: &[f64], b: &[f64]) {
    let n = q.len();
    let residual = &machine.evaluate("residual_partials", &[q, u, b])[1];
    let linear = machine.evaluate("linear_partials", &[q, u, b]);
    for j in 0..b.len() {
        let step = 1e-5 * b[j].abs().max(1e-3);
        let shifted = |sign: f64| {
            let mut b = b.to_vec();
            b[j] += sign * step;
            judged(machine, q, u, &b)
        };
        let (plus, minus) = (shifted(1.0), shifted(-1.0));
        for (which, (plus, minus)) in plus.iter().zip(&minus).enumerate() {
            let size = largest(plus).max(largest(minus)).max(1e-6);
            for k in 0..plus.len() {
                let difference = (plus[k] - minus[k]) / (2.0 * step);
                let exact = match which {
                    0 => residual[k * b.len() + j],
                    // By coordinate, by input, by design; mass, damping, stiffness each.
                    _ => linear[6 + which - 1][j * n * n + k],
                };
                assert!(
                    (exact - difference).abs() <= 1e-6 * (exact.abs() + size / b[j].abs().max(1e-3)),
                    "{name}: array {which}[{k}] by design {j}: {exact:e}, differences {difference:e}"
                );
            }
        }
    }
}

/// The arm with its servos off, against inverse dynamics, mass matrix and derivatives from Pinocchio
/// (`truth/panda_arm.json`).
#[test]
fn the_arm_is_the_public_one() {
    let (_, declaration) = declarations().into_iter().find(|(name, _)| *name == "robot_arm").expect("the arm is there");
    let machine = Machine::new(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let truth = Truth::load("panda_arm");
    for state in truth.get("states").list() {
        let numbers = |field: &str| state.get(field).numbers();
        let (q, velocity, acceleration) = (numbers("q"), numbers("qdot"), numbers("qddot"));
        let off = [0.0];
        let got = machine.evaluate("motion_residual", &[&acceleration, &velocity, &q, &[], &off]);
        let close = |got: &[f64], expected: &[f64], what: &str| {
            for (x, y) in got.iter().zip(expected) {
                assert!((x - y).abs() <= 1e-10 * (1.0 + largest(expected)), "{what}: {x} {y}");
            }
        };
        close(&got[0], &numbers("tau"), "tau");
        let motion = machine.evaluate("motion", &[&velocity, &q, &[], &off]);
        close(&motion[0], &state.get("M").matrix(), "M");
        let rest = machine.evaluate("residual_and_stiffness", &[&q, &[], &off]);
        close(&rest[0], &numbers("static_tau"), "tau at rest");
        close(&rest[1], &state.get("static_dtau_dq").matrix(), "dtau/dq at rest");
    }
}
