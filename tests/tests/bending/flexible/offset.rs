//! Beams whose sections have their mass off the axis.

use eigentol_oracle::energy;
use eigentol_oracle::random::Random;

use crate::flexible::judged::{Machine, assert_close, judge};

const SECTIONS: &str =
    "section: section(mass: 0.6 kg/m, EIy: 9 N*m^2, EIz: 16 N*m^2, GJ: 5 N*m^2, inertia_y: 0.01 kg*m,
        inertia_z: 0.02 kg*m, EA: 90 N, GAy: 50 N, GAz: 70 N, center_y: c, center_z: -0.04 m)
    to section(mass: 0.4 kg/m, EIy: 6 N*m^2, EIz: 11 N*m^2, GJ: 4 N*m^2, inertia_y: 0.01 kg*m, inertia_z: 0.01 kg*m,
        EA: 80 N, GAy: 40 N, GAz: 60 N, center_y: 0.01 m)";

/// In space, with strains, in one plane, only in torsion.
const WAYS: [&str; 4] = [
    "bending: 2, torsion: 1, shear: 1, stretch: 1, lag: 0.02 s",
    "bending: 2, torsion: 1, twist: 0.5 rad",
    "bending_y: 3",
    "torsion: 2, bending_y: 0, bending_z: 0, twist: 0.3 rad",
];

fn machine(way: &str, spin: &str) -> Machine {
    Machine::right(&format!(
        "mechanism Offset {{
            input omega: rad/s;
            design l = 1.1 m; design c = 0.03 m;
            gravity 9.81 m/s^2 along -z;
            body hub: massless;
            body blade: beam(length: l, along: [3, 4, 0], up: z, {SECTIONS}, {way});
            body pod: box(mass: 0.3 kg, size: [0.1, 0.2, 0.1] m, center: [0.02, 0.03, 0.01] m);
            joint spin: {spin};
            joint clamp: fixed from hub to blade at [0.2, 0.1, 0] m rotated([1, 2, 2], 0.3 rad);
            joint end: fixed from blade at tip to pod;
            output kinetic = kinetic_energy();
            output potential = potential_energy();
        }}"
    ))
}

#[test]
fn mass_off_the_axis() {
    let spins = ["revolute(z) from ground to hub, driven at omega", "revolute([1, 2, 2]) from ground to hub"];
    let mut random = Random::new(12);
    for way in WAYS {
        for spin in spins {
            let machine = machine(way, spin);
            for _ in 0..2 {
                let state = machine.state(&mut random);
                judge(way, &machine, &state);
                let (model, speeds) = machine.model(&state);
                let [_, _, q] = machine.motion(&model, &state);
                let still = vec![0.0; q.len()];
                let expected = energy::energies(&model, [&still, &q], &speeds, &[]);
                let found = &machine.evaluate("outputs", &[&state.q, &state.u, &state.b])[0];
                assert_close("energies", found, &expected, 1e-11, 100.0);
            }
        }
    }
}
