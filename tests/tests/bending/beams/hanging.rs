//! Frames of beams: each beam hangs on its root, in whichever order the joints are declared.

use eigentol::Study;
use eigentol_interpreter::Interpreted;

/// Orders of a list in which everything stands at every place, forwards and backwards.
fn orders(list: &[String]) -> Vec<Vec<String>> {
    let backwards: Vec<String> = list.iter().rev().cloned().collect();
    let turned = |list: &[String], by: usize| [&list[by..], &list[..by]].concat();
    (0..list.len()).flat_map(|by| [turned(list, by), turned(&backwards, by)]).collect()
}

fn lowest(bodies: &str, joints: &[String]) -> f64 {
    let text = format!("mechanism Frame {{ {bodies} {} }}", joints.join(" "));
    let machine = Interpreted::from_text(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let modes = Study::new(machine).modes();
    let modes = modes.unwrap_or_else(|error| panic!("{error}\n{text}"));
    modes.modes[0].s.im
}

fn beam(name: &str, along: &str, up: &str, mass: f64) -> String {
    format!(
        "body {name}: beam(length: 1 m, along: {along}, up: {up}, mass_per_length: {mass} kg/m, stiffness_y: 1 N*m^2,
            axial_stiffness: 1e6 N, bending_y: 4, stretch: 2);"
    )
}

/// A portal of three equal beams on two feet.
#[test]
fn a_portal_in_other_orders() {
    let bodies = [beam("a", "z", "x", 1.0), beam("b", "z", "x", 1.0), beam("c", "x", "z", 1.0)];
    for feet in ["fixed", "revolute(y)"] {
        let joints = [
            format!("joint ja: {feet} from ground to a;"),
            format!("joint jb: {feet} from ground to b at [1, 0, 0] m;"),
            "joint jc: fixed from a at tip to c;".to_owned(),
            "joint jd: fixed from c at tip to b at tip;".to_owned(),
        ];
        let expected = lowest(&bodies.concat(), &joints);
        for joints in orders(&joints) {
            let frequency = lowest(&bodies.concat(), &joints);
            assert!((frequency / expected - 1.0).abs() < 1e-9, "{frequency} {expected} {joints:?}");
        }
    }
}

/// A platform clamped to two light leaf springs on pins: each has the stiffness `3 E I / l^3`.
#[test]
fn a_platform_on_leaf_springs_in_other_orders() {
    let bodies = [
        beam("l1", "z", "x", 1e-3),
        beam("l2", "z", "x", 1e-3),
        "body plate: box(mass: 10 kg, size: [1, 1, 0.1] m, center: [0.5 m, 0, 0]);".to_owned(),
    ];
    let joints = [
        "joint r1: revolute(y) from ground to l1;",
        "joint r2: revolute(y) from ground to l2 at [1, 0, 0] m;",
        "joint t1: fixed from l1 at tip to plate;",
        "joint t2: fixed from l2 at tip to plate at [1, 0, 0] m on plate;",
    ];
    for joints in orders(&joints.map(str::to_owned)) {
        let frequency = lowest(&bodies.concat(), &joints);
        assert!((frequency / 0.6_f64.sqrt() - 1.0).abs() < 1e-4, "{frequency} {joints:?}");
    }
}

/// The same, with the springs bent towards each other by two metres: the frequency is that of all orders, though the
/// tensile stiffness leaves its rounding in whatever the last joint cuts.
#[test]
fn a_platform_on_bent_springs_in_other_orders() {
    let bodies = [
        beam("l1", "z", "x", 1e-3),
        beam("l2", "z", "x", 1e-3),
        "body plate: box(mass: 10 kg, size: [1, 1, 0.1] m, center: [0.5 m, 0, 0]);".to_owned(),
    ];
    let joints = [
        "joint r1: fixed from ground to l1;",
        "joint r2: fixed from ground to l2 at [1, 0, 0] m;",
        "joint t1: fixed from l1 at tip to plate;",
        "joint t2: fixed from l2 at tip to plate at [-1, 0, 0] m on plate;",
    ];
    let joints = joints.map(str::to_owned);
    let expected = lowest(&bodies.concat(), &joints);
    for joints in orders(&joints) {
        let frequency = lowest(&bodies.concat(), &joints);
        assert!((frequency / expected - 1.0).abs() < 1e-7, "{frequency} {expected} {joints:?}");
    }
}
