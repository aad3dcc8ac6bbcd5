//! Outputs at stations: places, energies, and reactions, which are forces along motions that the oracle sets free.

use eigentol_oracle::Oracle;
use eigentol_oracle::energy;
use eigentol_oracle::kernels::Kernels;
use eigentol_oracle::model::{Model, Motion, Step};
use eigentol_oracle::random::Random;

use crate::flexible::judged::{Machine, State, assert_close};

const TEXT: &str = "mechanism Outputs {
    input omega: rad/s;
    design l = 1.1 m;
    gravity 9.81 m/s^2 along -z;
    body hub: massless;
    body blade: beam(length: l, along: [3, 4, 0], up: z, mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2,
        stiffness_z: 16 N*m^2, torsion_stiffness: 5 N*m^2, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m,
        bending: 2, torsion: 1, twist: 0.5 rad);
    body whip: beam(length: 0.5 m, along: x, up: y, mass_per_length: 0.2 kg/m, stiffness_y: 2 N*m^2, bending_y: 2);
    body bead: box(mass: 0.3 kg, size: [0.1, 0.2, 0.15] m, center: [0.02, 0.03, 0.01] m);
    body pod: box(mass: 0.4 kg, size: [0.2, 0.1, 0.15] m, center: [0.05, 0.01, 0.02] m);
    joint spin: revolute(z) from ground to hub, driven at omega;
    joint clamp: fixed from hub to blade at [0.2, 0.1, 0] m rotated([1, 2, 2], 0.3 rad);
    joint inner: fixed from blade at 0.4 length to bead at [0.01, 0, 0.02] m rotated(x, 0.2 rad);
    joint second: fixed from blade at tip to whip rotated(y, 0.4 rad);
    joint weld: fixed from whip at tip to pod;
    joint hinge: revolute(z) from blade at 0.7 length to gauge;
    body gauge: box(mass: 0.1 kg, size: [0.1, 0.1, 0.05] m, center: [0, 0.06, 0] m);
    force leaf: spring(on: hinge, stiffness: 3 N*m/rad);
    point near: blade at 0.25 length rotated(x, 0.3 rad);
    point end: whip at tip;
    point mark: pod at [0.1, 0.2, 0.3] m;
    output d1 = distance_from_axis(near, z);
    output z1 = position(near).z;
    output d2 = distance_from_axis(end, z);
    output z2 = position(end).z;
    output d3 = distance_from_axis(mark, z);
    output z3 = position(mark).z;
    output kinetic = kinetic_energy();
    output potential = potential_energy();
    output fx = reaction_force(clamp).x; output fy = reaction_force(clamp).y; output fz = reaction_force(clamp).z;
    output mx = reaction_moment(clamp).x; output my = reaction_moment(clamp).y; output mz = reaction_moment(clamp).z;
    output ix = reaction_force(inner).x; output iy = reaction_force(inner).y; output iz = reaction_force(inner).z;
    output jx = reaction_moment(inner).x; output jy = reaction_moment(inner).y; output jz = reaction_moment(inner).z;
    output sx = reaction_force(second).x; output sy = reaction_force(second).y; output sz = reaction_force(second).z;
    output tx = reaction_moment(second).x; output ty = reaction_moment(second).y; output tz = reaction_moment(second).z;
    output wx = reaction_force(weld).x; output wy = reaction_force(weld).y; output wz = reaction_force(weld).z;
    output vx = reaction_moment(weld).x; output vy = reaction_moment(weld).y; output vz = reaction_moment(weld).z;
    output hinge_force = norm(reaction_force(hinge));
    output hinge_moment = norm(reaction_moment(hinge));
}";

/// Forces and moments along the axes of a joint, which the oracle lets slide and turn behind its own motions.
fn reaction(machine: &Machine, state: &State, joint: &str) -> Vec<f64> {
    let (mut model, speeds) = machine.model(state);
    let q = machine.motion(&model, state)[2].clone();
    let mut known: Vec<(String, f64)> = Vec::new();
    for (coordinate, q) in model.free().iter().zip(q) {
        known.push((model.step(*coordinate).name.clone(), q));
    }
    let released = model.joints.iter_mut().find(|x| x.name == joint);
    let steps = &mut released.expect("a joint").steps;
    for motion in [Motion::Slide, Motion::Turn] {
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            steps.push(Step::new(motion, axis).named("released"));
        }
    }
    let named = |model: &Model| -> Vec<String> {
        let free = model.free();
        free.iter().map(|x| model.step(*x).name.clone()).collect()
    };
    let names = named(&model);
    let value = |name: &String| known.iter().find(|pair| pair.0 == *name);
    let q: Vec<f64> = names.iter().map(|name| value(name).map_or(0.0, |pair| pair.1)).collect();
    let residual = Kernels::residual(&Oracle::new(&model), [&q, &speeds, &[]]);
    let all = names.iter().zip(residual);
    all.filter(|(name, _)| *name == "released").map(|(_, force)| force).collect()
}

#[test]
fn outputs_at_stations() {
    let machine = Machine::right(TEXT);
    let mut random = Random::new(8);
    for _ in 0..4 {
        let state = machine.state(&mut random);
        let (model, speeds) = machine.model(&state);
        let q = &machine.motion(&model, &state)[2];
        let oracle = Oracle::new(&model);
        let mut expected = Vec::new();
        for point in ["near", "end", "mark"] {
            let point = model.points.iter().find(|x| x.name == point);
            let place = point.expect("a point");
            let ([x, y, z], _) = oracle.place(q, &[], place.frame, &place.placement);
            expected.extend([x.hypot(y), z]);
        }
        let still = vec![0.0; q.len()];
        expected.extend(energy::energies(&model, [&still, q], &speeds, &[]));
        for joint in ["clamp", "inner", "second", "weld"] {
            expected.extend(reaction(&machine, &state, joint));
        }
        // along the axes beyond the hinge, about which its own spring acts within the joint
        let hinge = reaction(&machine, &state, "hinge");
        let norm = |list: &[f64]| list.iter().map(|x| x * x).sum::<f64>().sqrt();
        let found = machine.evaluate("outputs", &[&state.q, &state.u, &state.b]);
        let found = &found[0];
        assert_close("outputs", &found[..32], &expected, 1e-10, 100.0);
        assert_close("hinge", &found[32..33], &[norm(&hinge[..3])], 1e-10, 100.0);
    }
}
