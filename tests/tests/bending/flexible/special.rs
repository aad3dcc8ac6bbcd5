//! Beams that coast, float, or close loops.

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_consistency::check::check;
use eigentol_consistency::subject::Subject;
use eigentol_oracle::Oracle;
use eigentol_oracle::energy;
use eigentol_oracle::kernels::Kernels;
use eigentol_oracle::model::Model;
use eigentol_oracle::random::Random;
use nalgebra::DMatrix;

use crate::flexible::judged::{Machine, State, assert_close, judge, largest};
use crate::flexible::moving::rate;

const SPATIAL: &str = "mass_per_length: 0.6 kg/m, stiffness_y: 9 N*m^2, stiffness_z: 16 N*m^2, \
    torsion_stiffness: 5 N*m^2, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m, bending: 2, torsion: 1, twist: 0.5 rad";

#[test]
fn beams_on_a_coasting_hub() {
    let machine = Machine::right(&format!(
        "mechanism Coasting {{
            gravity 9.81 m/s^2 along -z;
            body hub: disk(mass: 3 kg, radius: 0.2 m, axis: z);
            body blade: beam(length: 1.1 m, along: x, up: z, {SPATIAL}, lag: 0.02 s);
            body pod: box(mass: 0.3 kg, size: [0.1, 0.2, 0.1] m, center: [0.02, 0.03, 0.01] m);
            joint spin: revolute(z) from ground to hub, coasting;
            joint clamp: fixed from hub to blade at [0.2, 0, 0] m rotated(x, 20 deg);
            joint end: revolute([1, 2, 2]) from blade at tip to pod;
            force motor: generalized(on: spin, value: 3 N*m - 0.2 N*m*s * rate(spin));
            force hinge: spring(on: end, stiffness: 8 N*m/rad);
        }}"
    ));
    let mut random = Random::new(3);
    for round in 0..5 {
        judge(&format!("{round}"), &machine, &machine.state(&mut random));
    }
}

const CLOSED: &str = "mechanism Closed {
    design l = 1.2 m;
    gravity [1, 2, -9] m/s^2;
    body blade: beam(length: l, along: x, up: z, SPATIAL);
    body link: box(mass: 0.5 kg, size: [0.1, 0.8, 0.2] m, center: [0.03, 0.4, 0] m);
    joint clamp: fixed from ground to blade rotated(z, 10 deg);
    joint ball: spherical(a: x, b: y, c: z) from ground to link at [1, -0.7, 0.1] m;
    point eye: blade at tip rotated([1, 2, 2], 0.4 rad);
    point middle: blade at 0.5 length;
    point bolt: link at [0, 0.8, 0] m;
    CLOSING
    every angle: spring_damper(stiffness: 3 N*m/rad, damping: 0.1 N*m*s/rad);
}";

const CLOSINGS: [&str; 4] = [
    "constraint pin: coincident(from: eye, to: bolt, along: [x, y]); \
     constraint tie: distance(from: middle, to: bolt, length: 0.7 m);",
    "joint pin: revolute([0, 1, 3]) from blade at tip to link at [0, 0.8, 0] m on link, cut;",
    "joint pin: spherical(d: x, e: y, f: z) from link to blade at 0.3 length, cut;",
    "constraint pin: aligned(from: eye, to: bolt, axis: y);",
];

/// With no reaction in the constraints, the equations of the coordinates are those of the open machine; that reactions
/// act where they must is what consistency means.
#[test]
fn loops_that_end_at_a_beam() {
    for closing in CLOSINGS {
        let text = CLOSED.replace("SPATIAL", SPATIAL);
        let text = text.replace("CLOSING", closing);
        // the oracle knows no cut joints
        if !closing.ends_with("cut;") {
            open_part(&text);
        }
        consistent(&text);
    }
}

/// The equations of the coordinates where all reactions are zero.
fn open_part(text: &str) {
    let machine = Machine::right(text);
    let mut random = Random::new(5);
    for _ in 0..5 {
        let mut state = machine.state(&mut random);
        let is_position = |role: &Role| matches!(role, Role::Position(_));
        let roles = machine.roles();
        let n = roles.iter().filter(|role| is_position(role)).count();
        assert!(roles[..n].iter().all(is_position) && roles.len() > n);
        state.q[n..].fill(0.0);
        let (model, speeds) = machine.model(&state);
        let free = model.free();
        let names: Vec<&str> = free.iter().map(|x| model.step(*x).name.as_str()).collect();
        let unknowns = &machine.compiled.functions.unknowns[..n];
        let order: Vec<usize> = names
            .iter()
            .map(|name| {
                let place = unknowns.iter().position(|unknown| unknown.name == *name);
                place.unwrap_or_else(|| panic!("{name}"))
            })
            .collect();
        let ordered = |values: &[f64]| -> Vec<f64> { order.iter().map(|&k| values[k]).collect() };
        let motion = [&state.acceleration, &state.velocity, &state.q].map(|x| ordered(x));
        let motion = motion.each_ref().map(Vec::as_slice);
        let expected = energy::residual(&model, motion, &speeds, &[]);
        let arguments: [&[f64]; 5] = [&state.acceleration, &state.velocity, &state.q, &state.u, &state.b];
        let found = &machine.evaluate("motion_residual", &arguments)[0];
        let size = 1.0 + largest(&expected);
        assert_close("without reactions", &ordered(found), &expected, 1e-10, size);
    }
}

fn consistent(text: &str) {
    let subject = Subject::new(text, Limits::NONE).unwrap_or_else(|all| panic!("{all:?}\n{text}"));
    for seed in 0..4 {
        let outcome = check(&subject, &subject.state(seed));
        assert!(outcome.differences.is_empty(), "{:#?}", outcome.differences);
    }
}

/// Momentum along a direction in which the whole machine can slide: what a unit of its speed adds to the energy.
fn momentum(model: &Model, motion: [&[f64]; 2], slide: usize) -> f64 {
    let kinetic = |velocity: &[f64]| energy::energies(model, [velocity, motion[1]], &[], &[])[0];
    let mut slid = motion[0].to_vec();
    slid[slide] += 1.0;
    let mut alone = vec![0.0; slid.len()];
    alone[slide] = 1.0;
    kinetic(&slid) - kinetic(motion[0]) - kinetic(&alone)
}

#[test]
fn a_floating_beam_keeps_momentum_and_energy() {
    let machine = Machine::right(&format!(
        "mechanism Floating {{
            body blade: beam(length: 1.3 m, along: [1, 2, 2], up: [2, 1, -2], {SPATIAL});
            body pod: box(mass: 0.4 kg, size: [0.1, 0.2, 0.3] m, center: [0.1, 0.03, 0.01] m);
            joint loose: free(x: x, y: y, z: z, a: x, b: y, c: z) from ground to blade;
            joint end: universal(d: x, e: z) from blade at tip to pod;
            force hinge: spring(on: d, stiffness: 8 N*m/rad);
            force other: spring(on: e, stiffness: 3 N*m/rad);
        }}"
    ));
    let mut random = Random::new(9);
    for _ in 0..4 {
        let state = machine.state(&mut random);
        judge("floating", &machine, &state);
        let (model, _) = machine.model(&state);
        let slides = ["x", "y", "z"].map(|name| {
            let free = model.free();
            let place = free.iter().position(|x| model.step(*x).name == name);
            place.expect("a slide")
        });
        for slide in slides {
            let changes = rate(&machine, &state, &model, |motion| momentum(&model, motion, slide));
            assert!(changes.abs() < 1e-6, "momentum {slide} changes by {changes}");
        }
        let changes = rate(&machine, &state, &model, |motion| energy::energies(&model, motion, &[], &[]).iter().sum());
        assert!(changes.abs() < 1e-5, "energy changes by {changes}");
    }
}

/// Without lag the energy of a motion stays; with it, it falls, and where nothing is bent at the rate
/// `qdot . C qdot`, with the damping matrix at rest.
#[test]
fn lag_takes_energy_away() {
    let text = |lag: &str| {
        format!(
            "mechanism Lagging {{
                gravity [1, -3, -9] m/s^2;
                body blade: beam(length: 0.9 m, along: x, up: z, {SPATIAL}, lag: {lag});
                joint clamp: fixed from ground to blade;
            }}"
        )
    };
    let [elastic, lagging] = ["0 s", "0.03 s"].map(|lag| Machine::right(&text(lag)));
    let mut random = Random::new(4);
    for _ in 0..4 {
        let state = elastic.state(&mut random);
        let (model, _) = elastic.model(&state);
        let total = |motion: [&[f64]; 2]| energy::energies(&model, motion, &[], &[]).iter().sum();
        let kept = rate(&elastic, &state, &model, total);
        let lost = rate(&lagging, &state, &model, total);
        assert!(kept.abs() < 1e-5, "{kept}");
        let mut straight = State { q: vec![0.0; state.q.len()], ..lagging.state(&mut random) };
        straight.velocity.clone_from(&state.velocity);
        let damping = &lagging.evaluate("linear", &[&straight.q, &straight.u, &straight.b])[1];
        let n = straight.q.len();
        let power: f64 = (0..n * n).map(|k| state.velocity[k / n] * damping[k] * state.velocity[k % n]).sum();
        let at_straight = rate(&lagging, &straight, &model, total);
        assert!(lost < 0.0, "{lost}");
        assert!((at_straight + power).abs() < 1e-5 * power, "{at_straight} {power}");
    }
}

/// Every kernel, outputs included, is what the equations of motion say.
#[test]
fn kernels_of_beams_are_consistent() {
    let curved = "section: section(mass: 0.6 kg/m, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m, center_y: ratio * 0.1 m,
            stiffness: [[90, 0, 0, 3, -4, 0], [0, 50, 0, 0, 0, 6], [0, 0, 70, 5, 0, 0], [3, 0, 5, 12, 10 * ratio, 0],
                [-4, 0, 0, 10 * ratio, 9, 0], [0, 6, 0, 0, 0, 16]])
            to section(mass: 0.5 kg/m, EA: 60 N, GAy: 40 N, GAz: 50 N, GJ: 7 N*m^2, EIy: 5 N*m^2, EIz: 8 N*m^2),
        prebend_y: -0.7 rad, prebend_z: 2 rad * ratio, twist: ratio * 1 rad, bending: 2, torsion: 1, shear: 1, stretch: 1";
    for section in [SPATIAL, curved, "mass_per_length: 0.6 kg/m, stiffness_z: 9 N*m^2, bending_z: 3"] {
        consistent(&format!(
            "mechanism Kernels {{
                input omega: rad/s; design l = 0.9 m; design lag = 0.02 s; design ratio = 0.3;
                gravity 9.81 m/s^2 along -z;
                body hub: massless;
                body blade: beam(length: l, along: y, up: z, lag: lag, {section});
                body pod: rod(mass: 0.4 kg, length: ratio * l, along: y);
                joint spin: revolute(z) from ground to hub, driven at omega;
                joint clamp: fixed from hub to blade at [0.1, 0, 0] m rotated(x, 5 deg);
                joint end: revolute(z) from blade at tip to pod;
                force hinge: spring(on: end, stiffness: 8 N*m/rad);
                point gauge: blade at 0.4 length;
                output height = position(gauge).z;
                output root = reaction_moment(clamp).z;
                output tip = reaction_force(end).y;
                output stored = potential_energy() - kinetic_energy();
            }}"
        ));
    }
}

/// Half the form of the mass matrix is the kinetic energy.
#[test]
fn the_two_derivations_of_the_oracle_agree_on_mass() {
    let machine = Machine::right(&format!(
        "mechanism Mass {{
            body blade: beam(length: 0.9 m, along: x, up: z, {SPATIAL});
            joint clamp: fixed from ground to blade;
        }}"
    ));
    let state = machine.state(&mut Random::new(2));
    let (model, _) = machine.model(&state);
    let oracle = Oracle::new(&model);
    let [mass, _] = Kernels::motion(&oracle, &state.velocity, [&state.q, &[], &[]]);
    let n = state.q.len();
    let form: f64 = (0..n * n).map(|k| state.velocity[k / n] * mass[k] * state.velocity[k % n] / 2.0).sum();
    let [kinetic, _] = energy::energies(&model, [&state.velocity, &state.q], &[], &[]);
    assert!((form - kinetic).abs() < 1e-12 * kinetic, "{form} {kinetic}");
}

/// Points and weights of quadrature are eigenvalues and first components of eigenvectors of the Jacobi matrix of
/// Legendre's polynomials (Golub and Welsch 1969).
#[test]
fn quadrature_is_that_of_gauss() {
    for count in 2..12 {
        let machine = Machine::right(&format!(
            "mechanism Points {{
                body blade: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2,
                    bending_y: 2, points: {count});
                joint clamp: fixed from ground to blade;
            }}"
        ));
        let jacobi = DMatrix::from_fn(count, count, |i, j| {
            let k = i.max(j) as f64;
            match i.abs_diff(j) {
                1 => k / (4.0 * k * k - 1.0).sqrt(),
                _ => 0.0,
            }
        });
        let eigen = jacobi.symmetric_eigen();
        let mut expected: Vec<[f64; 2]> = (0..count)
            .map(|k| {
                let weight = eigen.eigenvectors[(0, k)].powi(2);
                [(1.0 + eigen.eigenvalues[k]) / 2.0, weight]
            })
            .collect();
        expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let sections = machine.compiled.mechanism.beams[0].sections.iter();
        let mut values: Vec<[f64; 2]> = sections.map(|(place, weight, _)| [*place, *weight]).collect();
        values.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_close("points", &values.concat(), &expected.concat(), 1e-13, 1.0);
    }
}
