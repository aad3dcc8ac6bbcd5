//! Constraint reactions do no work on motions that the constraints allow: the column of a reaction is the row of its
//! constraint.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_tests::{loops, wheels};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::Numbers;

/// Every closing joint and constraint in space, on an otherwise free body.
const CLOSING: [&str; 11] = [
    "joint c: fixed from ground to b at [0.1, 0.2, 0.3] rotated(x, 0.4), at [0.3, 0.1, 0.2] rotated(z, 0.7) on b, cut;",
    "joint c: revolute([1, 2, 2]) from ground to b at [0.1, 0.2, 0.3] rotated(x, 0.4), cut;",
    "joint c: prismatic([1, 2, 2]) from ground to b at [0.1, 0.2, 0.3], at [0.3, 0.1, 0.2] on b, cut;",
    "joint c: cylindrical(s: y, t: y) from b to ground at [0.1, 0.2, 0.3] rotated(x, 0.4), cut;",
    "joint c: universal(s: x, t: [1, 1, 0]) from ground to b at [0.1, 0.2, 0.3], cut;",
    "joint c: planar(s: x, t: y, r: z) from ground to b rotated(x, 0.4), at [0.3, 0.1, 0.2] on b, cut;",
    "joint c: spherical(s: x, t: y, r: z) from ground to b at [0.1, 0.2, 0.3], cut;",
    "constraint c: aligned(from: p, to: q);",
    "constraint c: aligned(from: p, to: q, axis: [1, 2, 2]);",
    "constraint c: coincident(from: p, to: q, along: [x, z]);",
    "constraint c: distance(from: p, to: q, length: 0.5 m);",
];

fn in_space(closing: &str) -> String {
    let closing = closing.replace(", 0.2, 0.3]", ", 0.2, 0.3] m").replace(", 0.1, 0.2]", ", 0.1, 0.2] m");
    format!(
        "mechanism Space {{
            gravity 9.81 m/s^2 along -z;
            body b: box(mass: 2 kg, size: [0.3, 0.2, 0.1] m);
            joint f: free(px: x, py: y, pz: z, yaw: z, pitch: y, roll: x) from ground to b;
            point p: ground at [0.1, 0.2, 0.4] m rotated(y, 0.3);
            point q: b at [0.2, 0.1, 0.3] m rotated(z, 0.5);
            {closing}
            force k: potential(energy: (1 N/m) * px^2 + (2 N/m) * py^2 + (3 N/m) * pz^2
                + (1 N*m) * (yaw^2 + pitch^2 + roll^2));
        }}"
    )
}

/// Returns how many position and velocity equations were compared.
fn compare(name: &str, declaration: &str) -> [usize; 2] {
    let tokens = declaration.parse().expect("tokens");
    let compilation = compile(tokens, Limits::default()).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
    let role = |i: usize| compilation.functions.unknowns[i].role;
    let n = compilation.functions.unknowns.len();
    let nominal: Vec<f64> = compilation.mechanism.design.iter().map(|value| value.nominal).collect();
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(7));
    let mut compared = [0; 2];
    for _ in 0..3 {
        let (q, u) = (numbers.list(n), numbers.list(compilation.mechanism.inputs.len()));
        let linear = compilation.program.evaluate("linear", &[&q, &u, &nominal]).expect("in the contract");
        let damping = |i: usize, j: usize| linear[1][i * n + j];
        let stiffness = |i: usize, j: usize| linear[2][i * n + j];
        for row in 0..n {
            let by_rate = |j: usize| match (role(row), role(j)) {
                (Role::PositionReaction, Role::Position(_)) => stiffness(row, j),
                (Role::VelocityReaction, Role::Position(_)) => damping(row, j),
                (Role::VelocityReaction, Role::Speed(_)) => stiffness(row, j),
                _ => 0.0,
            };
            match role(row) {
                Role::PositionReaction => compared[0] += 1,
                Role::VelocityReaction => compared[1] += 1,
                Role::Position(_) | Role::Harmonic(_) | Role::Speed(_) => continue,
            }
            let moves = |&j: &usize| matches!(role(j), Role::Position(_) | Role::Speed(_));
            let motions = (0..n).filter(moves);
            let most = motions.clone().fold(0.0_f64, |most, j| most.max(by_rate(j).abs()));
            assert!(most > 0.0, "{name}: nothing moves constraint {row}");
            for j in motions {
                let (held, demanded) = (stiffness(j, row), by_rate(j));
                assert!(
                    (held - demanded).abs() <= 1e-12 * most,
                    "{name}: reaction {row} on {j} is {held}, its constraint changes by {demanded}"
                );
            }
        }
    }
    compared
}

#[test]
fn reactions_do_no_work() {
    let planar = [
        ("governor", loops::governor::DECLARATION),
        ("porter_governor", loops::porter_governor::DECLARATION),
        ("slider_crank", loops::slider_crank::DECLARATION),
        ("five_bar", loops::five_bar::DECLARATION),
        ("four_bar", loops::four_bar::DECLARATION),
        ("geared_rotors", loops::geared_rotors::DECLARATION),
        ("geared_coasting", loops::geared_coasting::DECLARATION),
        ("geared_motor", loops::geared_motor::DECLARATION),
        ("cart", wheels::cart::DECLARATION),
        ("caster", wheels::caster::DECLARATION),
        ("disk", wheels::disk::DECLARATION),
        ("trailer", wheels::trailer::DECLARATION),
        ("whipple", wheels::whipple::DECLARATION),
    ];
    let mut compared = [0; 2];
    for (name, declaration) in planar {
        let own = compare(name, declaration);
        compared = [compared[0] + own[0], compared[1] + own[1]];
    }
    assert!(compared[0] >= 40 && compared[1] >= 20, "{compared:?}");
}

/// Every spatial constraint at three states: 6 + 5 + 5 + 4 + 4 + 3 + 3 equations from joints, 3 + 2 + 2 + 1 from
/// constraints.
#[test]
fn reactions_in_space_do_no_work() {
    let equations: usize = CLOSING.into_iter().map(|closing| compare(closing, &in_space(closing))[0]).sum();
    assert_eq!(equations, 3 * (30 + 8));
}
