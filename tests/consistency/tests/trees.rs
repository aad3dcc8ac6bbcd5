//! Random mechanisms full of special cases: a twentieth of ten thousand by default, all of them with `-- --ignored`. For
//! more: `cargo run --release --package eigentol-consistency`.

use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::{Operand, Operation, Program};
use eigentol_consistency::check::check;
use eigentol_consistency::interpreter::interpret;
use eigentol_consistency::state::State;
use eigentol_consistency::subject::Subject;
use eigentol_consistency::trees::{Summary, summary};

const TREES: u64 = 10_000;

/// Special cases of the derivation, and the least number of the [`TREES`] that must use each.
const TAKEN: [(&str, u64); 36] = [
    ("augmented: rides on its seat", 3000),
    ("closing: demand ``", 50),
    ("closing: demand `about_x`", 50),
    ("closing: demand `across_1`", 50),
    ("closing: demand `cross`", 50),
    ("closing: demand `forward`", 50),
    ("closing: demand `lateral`", 50),
    ("closing: demand `normal`", 80),
    ("closing: demand `tilt_1`", 200),
    ("closing: demand `tilt_2`", 200),
    ("closing: demand `x`", 200),
    ("closing: equation", 50),
    ("closing: holds whatever moves", 50),
    ("composite: mass in a run that rides on no seat", 200),
    ("composite: moment of what goes on in a run", 400),
    ("frame: arm with 1 components", 3000),
    ("frame: arm with 2 components", 2000),
    ("frame: arm with 3 components", 2000),
    ("inertia: 1 equal second moments", 1000),
    ("inertia: 2 equal second moments", 1000),
    ("inertia: 3 equal second moments", 500),
    ("inertia: bar from its origin", 500),
    ("layout: a body continues a run", 1000),
    ("layout: no run, another axis", 1000),
    ("layout: no run, moved after the joint", 150),
    ("layout: no run, turned after the joint before", 20),
    ("layout: no run, turned before the joint", 300),
    ("linearise: along a motion by variation", 2000),
    ("linearise: stiffness and damping by variation", 2000),
    ("linearise: Equal across the diagonal", 2000),
    ("linearise: Unrelated across the diagonal", 2000),
    ("orientation: angles about one axis added", 1000),
    ("regroup: smaller true", 3000),
    ("turn_symmetric: any rotation", 1000),
    ("variation: beside runs", 300),
    ("variation: walks over bodies", 3000),
];

fn count(summary: &Summary, case: &str) -> u64 {
    summary.taken.get(case).copied().unwrap_or(0)
}

#[test]
fn kernels_of_random_trees_are_consistent() {
    require_consistent(TREES / 20);
}

#[test]
#[ignore = "a minute of the processor"]
fn kernels_of_ten_thousand_trees_are_consistent() {
    require_consistent(TREES);
}

/// Requires no difference in the first `trees` trees, and every special case in its proportional number of them.
fn require_consistent(trees: u64) {
    let found = summary(0, trees);
    assert_eq!(found.wrong, [0; 0], "trees with differences");
    assert_eq!(found.odd, [0; 0], "trees refused");
    assert!(found.compared > trees * 3 / 4, "{} compared", found.compared);
    assert!(found.blurred * 10 < found.values, "{} blurred", found.blurred);
    for (case, least) in TAKEN {
        let count = count(&found, case);
        assert!(count * TREES >= least * trees, "{case}: {count} of {trees}");
    }
    // a rotated inertia tensor: any axis onto any axis, in either direction
    for row in 0..3 {
        for column in 0..3 {
            for mirrored in [false, true] {
                let case = format!("turn_symmetric: row {row}, column {column}, mirrored {mirrored}");
                let count = count(&found, &case);
                assert!(count * TREES >= 30 * trees, "{case}: {count} of {trees}");
            }
        }
    }
}

/// Turns one subtraction into an addition, or the reverse.
fn spoilt(subject: &Subject, kernel: usize, instruction: usize) -> Option<Subject> {
    use eigentol_compiler::algebra::Operator::{Add, Subtract};
    let mut subject = subject.clone();
    let operation = &mut subject.program.kernels[kernel].instructions[instruction].operation;
    *operation = match *operation {
        Operation::Binary(Add, a, b) => Operation::Binary(Subtract, a, b),
        Operation::Binary(Subtract, a, b) => Operation::Binary(Add, a, b),
        _ => return None,
    };
    Some(subject)
}

/// Whether a kernel still returns the same results because the operand with the changed sign is zero.
fn same_results(one: &Program, other: &Program, kernel: &str, state: &State) -> bool {
    let kernels = [one, other].map(|program| program.kernel(kernel).expect("a kernel"));
    let full = [0.3, -0.8, 0.6, 0.5, -0.4, 0.7, 0.2, -0.9];
    let arguments: Vec<Vec<f64>> = kernels[0]
        .parameters
        .iter()
        .map(|parameter| {
            let known = ["q", "u", "b"].iter().position(|name| *name == parameter.name);
            known.map_or_else(|| full[..parameter.entries.len()].to_vec(), |place| state.at[place].clone())
        })
        .collect();
    let arguments: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
    let [one, other] = kernels.map(|kernel| interpret(kernel, &arguments).concat());
    let size = one.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let mut pairs = one.iter().zip(&other);
    pairs.all(|(a, b)| (a - b).abs() <= 1e-12 * size)
}

/// A comparison that cannot fail proves nothing: flips every sign of every sum of every kernel once, and requires each
/// flip that changes a result to be detected.
#[test]
fn every_wrong_sign_is_found() {
    let text = "pub mechanism Crane {
        input speed: rad/s;
        design reach = 1.2 m;
        design load = 1.4 kg;
        gravity 9.81 m/s^2 along -z;
        body post: massless;
        body boom: rod(mass: 1 kg, length: reach, along: x);
        body jib: box(mass: load, size: [0.3, 0.2, 1.1] m, center: [0.5, 0, 0.1] m);
        body hook: point(mass: 1 kg, center: [0.1, 0.2, 0] m);
        joint slew: revolute(z) from ground to post, driven at speed;
        joint luff: revolute(y) from post to boom;
        joint fold: revolute(y) from boom to jib at [reach, 0, 0];
        joint run: prismatic(x) from jib to hook;
        force a: spring(on: luff, stiffness: 90 N*m/rad);
        force b: spring(on: fold, stiffness: 70 N*m/rad);
        force c: spring(on: run, stiffness: 80 N/m);
        force d: damper(on: run, damping: 2 N*s/m);
        output height = position(tip).z;
        point tip: hook at [0.2, 0, 0.1] m;
    }";
    let subject = Subject::new(text, Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes:?}"));
    let state = subject.state(3);
    assert!(check(&subject, &state).differences.is_empty());
    let mut seen_spoils = 0;
    for (place, kernel) in subject.program.kernels.iter().enumerate() {
        let reference = ["motion_residual", "outputs", "violation", "whirl", "picture", "pose_margin"];
        if reference.contains(&kernel.name) {
            continue;
        }
        let is_zero = |operand: &Operand| matches!(operand, Operand::Constant(0.0));
        assert!(!kernel.results.iter().all(|array| array.values.iter().all(is_zero)));
        for instruction in 0..kernel.instructions.len() {
            let Some(wrong) = spoilt(&subject, place, instruction) else {
                continue;
            };
            let seen = !check(&wrong, &state).differences.is_empty();
            let name = kernel.name;
            assert!(
                seen || same_results(&subject.program, &wrong.program, name, &state),
                "{name}: the sign of instruction {instruction}"
            );
            seen_spoils += u32::from(seen);
        }
    }
    assert!(seen_spoils > 1000, "{seen_spoils} signs");
}
