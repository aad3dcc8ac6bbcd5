//! Mechanisms with constraints: the bordered equations solved again in hyper-dual numbers, reactions included.

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::CurvatureKernels;
use eigentol::modes::{Family, modes_of};
use eigentol::sensitivity::equilibrium_shift;
use eigentol::{Policy, Vector};
use eigentol_tests::rederived::Machine;
use eigentol_tests::tables;

use super::common::assert_within;
use super::product::Product;

/// Inputs, and approximate equilibrium values of the coordinates that are not close to zero.
type Operation = (&'static [f64], &'static [(&'static str, f64)]);

/// Operating points of the mechanisms of [`loops`] and [`wheels`]; `None` for redundant constraints, whose bordered
/// matrices are singular.
fn operation(name: &str) -> Option<Operation> {
    Some(match name {
        "governor" => (
            &[16.0],
            &[("lift_right", 0.84), ("lift_left", 0.84), ("slide", -0.15), ("knee_right", -1.7), ("knee_left", -1.7)],
        ),
        "porter_governor" => (&[16.0], &[("lift_right", 0.84), ("lift_left", 0.84), ("slide", -0.15)]),
        "slider_crank" => (&[14.0], &[("crank_angle", 0.42), ("pin", -0.51), ("guide", 0.27)]),
        "five_bar" => (&[9.0], &[("left", 1.94), ("right", 1.08), ("left_elbow", -1.0), ("right_elbow", 1.2)]),
        "four_bar" => (&[9.0], &[("crank_angle", 1.6), ("elbow", -1.4), ("rocker_angle", 1.8)]),
        "geared_rotors" | "geared_coasting" => (&[120.0], &[("run", -72.0)]),
        "geared_unbalance" => (&[100.0], &[("slow", -40.0)]),
        "shaken_linkage" => (&[30.0], &[("a", 0.3), ("b", -0.3), ("d", 0.2)]),
        "geared_motor" => (&[2.0], &[("run_in", 90.0), ("run_out", -54.0)]),
        "caster" => (&[3.0], &[("spin", 37.0)]),
        "disk" => (&[8.0], &[("forward", 2.0)]),
        // Its derivatives are stored in a file: with 27 variables this oracle would take too long.
        "whipple" => return None,
        "cart" => (&[6.0], &[("run", 2.5), ("spin", 16.7)]),
        "trailer" => return None,
        _ => panic!("nobody has said how {name} is run"),
    })
}

struct Every(Product, usize);

impl Every {
    fn check(&mut self, name: &str, declaration: &str, machine: &dyn CurvatureKernels) {
        let Some((inputs, near)) = operation(name) else {
            return;
        };
        let description = machine.description();
        let b: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
        let mut u = vec![0.0; description.inputs.len()];
        u[..inputs.len()].copy_from_slice(inputs);
        let start = Vector::from_fn(description.coordinates.len(), |i| {
            let own = &description.coordinates[i].name;
            near.iter().find(|(name, _)| *own == *name).map_or(0.0, |(_, x)| *x)
        });
        let at =
            equilibrium(machine, &u, &b, &start, Policy::Nearest).unwrap_or_else(|error| panic!("{name}: {error}"));
        let state = Machine::new(declaration).at(&u, &b, &at.coordinates);
        let shift = equilibrium_shift(machine, &at).expect("a shift");
        for (i, solved) in state.equilibrium().into_iter().enumerate() {
            let found = [&shift.by_design[i][..], &shift.by_input[i]].concat();
            let what = format!("{name} {}", description.coordinates[i].name);
            let variables = b.iter().chain(&u).copied();
            for ((found, exact), value) in found.iter().zip(&solved.gradient).zip(variables) {
                let size = if value == 0.0 { 1.0 } else { value.abs() };
                let scale = 1e-2 * (solved.value.abs() + 1e-3) / size;
                assert_within(1e-9, &[*found], &[*exact], scale, &what);
                self.1 += 1;
            }
        }
        let general =
            modes_of(&at.linear, Family::General, &at.description).unwrap_or_else(|error| panic!("{name}: {error}"));
        self.0.general(name, machine, &at, &general, &state);
    }
}

#[test]
fn unknowns_and_modes_with_constraints() {
    let mut every = Every(Product::default(), 0);
    for machine in tables::constrained() {
        every.check(machine.name, machine.declaration, &*machine.curvature);
    }
    assert!(every.1 > 500, "{} derivatives of unknowns", every.1);
    every.0.judge(19);
}
