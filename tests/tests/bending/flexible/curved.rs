//! Beams that are curved before they are loaded, and sections whose stiffness is a matrix.

use eigentol_oracle::energy;
use eigentol_oracle::model::Value;
use eigentol_oracle::random::Random;

use crate::flexible::judged::{Machine, assert_close, judge};

const CURVES: [&str; 4] = ["", ", prebend_y: -0.8 rad", ", prebend_z: t", ", prebend_y: 0.7 rad, prebend_z: t"];

/// In space, with strains, in one plane, only in torsion.
const WAYS: [&str; 5] = [
    "bending: 2, torsion: 1, shear: 1, stretch: 1, lag: 0.02 s",
    "bending: 2, torsion: 1, twist: 0.5 rad",
    "bending_y: 2, stretch: 1",
    "bending_z: 2, shear: 1, twist: 0.4 rad",
    "torsion: 2, bending_y: 0, bending_z: 0, twist: 0.3 rad",
];

const OF_NUMBERS: &str = "EIy: 9 N*m^2, EIz: 16 N*m^2, GJ: 5 N*m^2, EA: 90 N, GAy: 50 N, GAz: 70 N";

/// No two entries are equal.
const ROOT: [[f64; 6]; 6] = [
    [90.0, 7.0, -8.0, 3.0, -4.0, 5.0],
    [7.0, 50.0, 6.0, -2.0, 2.5, 3.5],
    [-8.0, 6.0, 70.0, 1.5, -3.2, 4.4],
    [3.0, -2.0, 1.5, 12.0, 1.1, -0.9],
    [-4.0, 2.5, -3.2, 1.1, 9.0, 0.7],
    [5.0, 3.5, 4.4, -0.9, 0.7, 16.0],
];

/// Only some are coupled, and others than at the root.
const TIP: [[f64; 6]; 6] = [
    [60.0, 0.0, 0.0, -6.0, 0.0, 0.0],
    [0.0, 40.0, 0.0, 0.0, 0.0, -5.0],
    [0.0, 0.0, 30.0, 0.0, 0.0, 0.0],
    [-6.0, 0.0, 0.0, 8.0, 3.0, 0.0],
    [0.0, 0.0, 0.0, 3.0, 6.0, 0.0],
    [0.0, -5.0, 0.0, 0.0, 0.0, 11.0],
];

fn machine(stiffness: [&str; 2], rest: &str) -> Machine {
    let [root, tip] = stiffness;
    Machine::right(&format!(
        "mechanism Curved {{
            input omega: rad/s;
            design l = 1.1 m; design t = 0.9 rad;
            gravity 9.81 m/s^2 along -z;
            body hub: massless;
            body blade: beam(length: l, along: [3, 4, 0], up: z,
                section: section(mass: 0.6 kg/m, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m, center_y: 0.03 m, {root})
                    to section(mass: 0.4 kg/m, inertia_y: 0.01 kg*m, inertia_z: 0.01 kg*m, center_z: -0.04 m, {tip}), {rest});
            body pod: box(mass: 0.3 kg, size: [0.1, 0.2, 0.1] m, center: [0.02, 0.03, 0.01] m);
            joint spin: revolute(z) from ground to hub, driven at omega;
            joint clamp: fixed from hub to blade at [0.2, 0.1, 0] m rotated([1, 2, 2], 0.3 rad);
            joint middle: fixed from blade at 0.4 length to pod rotated(x, 0.2 rad);
            force wind: distributed(on: blade, force: [0, 0, -2] N/m, follower: [0.5, -1, 2] N/m, damping: 0.8 N*s/m^2);
            output kinetic = kinetic_energy();
            output potential = potential_energy();
        }}"
    ))
}

#[test]
fn curved_beams_and_coupled_strains() {
    let matrices = [ROOT, TIP].map(|x| format!("stiffness: {x:?}"));
    let coupled = matrices.each_ref().map(String::as_str);
    let sections = [[OF_NUMBERS; 2], coupled, [coupled[0], OF_NUMBERS]];
    let mut random = Random::new(21);
    for (k, way) in WAYS.into_iter().enumerate() {
        for (j, curve) in CURVES.into_iter().enumerate().skip(k % 2).step_by(2) {
            let machine = machine(sections[(k + j) % 3], &format!("{way}{curve}"));
            let state = machine.state(&mut random);
            judge(way, &machine, &state);
            let (mut model, speeds) = machine.model(&state);
            // loads have no part in the output
            model.forces.clear();
            let [_, _, q] = machine.motion(&model, &state);
            let still = vec![0.0; q.len()];
            let expected = energy::energies(&model, [&still, &q], &speeds, &[]);
            let found = &machine.evaluate("outputs", &[&state.q, &state.u, &state.b])[0];
            assert_close("energies", found, &expected, 1e-11, 100.0);
        }
    }
}

/// The rows of a matrix are stretch, shear across and along `up`, twist, and bending about the axis across and about `up`.
#[test]
fn a_matrix_has_the_order_of_the_reference() {
    let [root, tip] = [ROOT, TIP].map(|x| format!("stiffness: {x:?}"));
    let machine = machine([&root, &tip], "bending: 2");
    let (model, _) = machine.model(&machine.state(&mut Random::new(1)));
    let parts = [(0.0, 0.4), (0.4, 1.0)];
    assert_eq!(model.beams.len(), parts.len());
    for (beam, (start, end)) in model.beams.iter().zip(parts) {
        for section in &beam.sections {
            let place = start + (end - start) * section.place;
            let found = section.stiffness.as_flattened().iter();
            let values: Vec<f64> = found
                .map(|item| match item {
                    Value::Number(number) => *number,
                    Value::Design { .. } => panic!("every value is fixed"),
                })
                .collect();
            let ends = ROOT.as_flattened().iter().zip(TIP.as_flattened());
            let expected: Vec<f64> = ends.map(|(root, tip)| root * (1.0 - place) + tip * place).collect();
            assert_close("stiffness", &values, &expected, 1e-14, 100.0);
        }
    }
}
