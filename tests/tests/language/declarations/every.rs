//! Springs and dampers on every free coordinate, and mechanisms of which only the equations are needed.

use eigentol::Study;
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::model::mechanism::{ForceLaw, Mechanism};
use eigentol_compiler::{Compilation, compile};
use eigentol_consistency::interpreter::interpret;
use eigentol_interpreter::Interpreted;
use eigentol_tests::every;

fn compiled(text: &str) -> Compilation {
    let tokens = text.parse().expect("tokens");
    compile(tokens, Limits::default()).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// How many errors the compiler reports.
fn refusals(text: &str) -> usize {
    match compile(text.parse().expect("tokens"), Limits::default()) {
        Ok(_) => 0,
        Err(mistakes) => mistakes.iter().count(),
    }
}

fn kernel(compilation: &Compilation, name: &str, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
    interpret(compilation.program.kernel(name).expect("a kernel"), arguments)
}

/// The forces that `every` adds to the coordinates, as text.
fn of_every(mechanism: &Mechanism) -> Vec<String> {
    let forces = mechanism.forces.iter().filter(|force| force.of_every);
    let lines = forces.map(|force| match &force.law {
        ForceLaw::CoordinateSpring { coordinate, rest, .. } => {
            let on = &mechanism.coordinates[coordinate.index()].name;
            format!("{}: spring on {on} rest {rest:?}", force.name)
        }
        ForceLaw::CoordinateDamper { coordinate, damping } => {
            let on = &mechanism.coordinates[coordinate.index()].name;
            format!("{}: damper on {on} damping {damping:?}", force.name)
        }
        other => panic!("no spring or damper: {other:?}"),
    });
    lines.collect()
}

/// Driven coordinates, coordinates of cut joints, and coordinates with their own springs get none; the loop is cut in
/// the same place as without them.
#[test]
fn every_free_coordinate_gets_what_it_has_not() {
    let gripper = compiled(every::DECLARATION);
    let without: String =
        every::DECLARATION.split_inclusive(';').filter(|item| !item.trim_start().starts_with("every")).collect();
    let without = compiled(&without);
    assert_eq!(gripper.topology, without.topology);
    assert_eq!(gripper.topology.cut.len(), 1);
    assert_eq!(of_every(&without.mechanism), Vec::<String>::new());
    assert_eq!(of_every(&gripper.mechanism), EXPECTED);
}

const EXPECTED: [&str; 10] = [
    "angle: spring on finger_angle rest Number(0.17453292519943295)",
    "angle: damper on finger_angle damping Number(0.2)",
    "angle: spring on pin rest Number(0.17453292519943295)",
    "angle: damper on pin damping Number(0.2)",
    "angle: spring on wrist rest Number(0.17453292519943295)",
    "angle: damper on wrist damping Number(0.2)",
    "angle: damper on a damping Number(0.2)",
    "angle: spring on b rest Number(0.17453292519943295)",
    "angle: damper on b damping Number(0.2)",
    "displacement: damper on lift damping Number(3.0)",
];

/// Equivalent to springs and dampers written one by one.
#[test]
fn it_is_short_for_one_force_each() {
    let robot = |forces: &str| {
        compiled(&format!(
            "mechanism Arm {{
                gravity 9.81 m/s^2 along -y;
                body upper: rod(mass: 2 kg, length: 1 m, along: x);
                body lower: rod(mass: 1 kg, length: 1 m, along: x);
                body ram: point(mass: 1 kg, center: [0, 1, 0] m);
                joint shoulder: revolute(z) from ground to upper;
                joint elbow: revolute(z) from upper to lower at [1, 0, 0] m;
                joint push: prismatic(x) from lower to ram;
                {forces}
            }}"
        ))
    };
    let short = robot(
        "every angle: spring_damper(stiffness: 50 N*m/rad, damping: 0.5 N*m*s/rad);
        every displacement: spring_damper(stiffness: 60 N/m, damping: 0.6 N*s/m, rest: 1 cm);
        force own: spring(on: elbow, stiffness: 7 N*m/rad);",
    );
    let long = robot(
        "force own: spring(on: elbow, stiffness: 7 N*m/rad);
        force k1: spring(on: shoulder, stiffness: 50 N*m/rad);
        force c1: damper(on: shoulder, damping: 0.5 N*m*s/rad);
        force c2: damper(on: elbow, damping: 0.5 N*m*s/rad);
        force k3: spring(on: push, stiffness: 60 N/m, rest: 1 cm);
        force c3: damper(on: push, damping: 0.6 N*s/m);",
    );
    let state = [[0.3, -0.2, 0.1], [1.1, 0.7, -0.4], [0.2, 0.5, -0.9]];
    let [a, v, q] = &state;
    let at = |compilation: &Compilation| kernel(compilation, "motion_residual", &[a, v, q, &[], &[]]);
    assert_eq!(at(&short), at(&long));
}

/// A drone with a massless rotor: compared with a drone held by springs, only the springs are missing.
#[test]
fn what_nothing_holds_has_kernels() {
    let drone = |more: &str| {
        format!(
            "mechanism Drone {{
                gravity 9.81 m/s^2 along -z;
                body hull: box(mass: 2 kg, size: [1, 2, 3] m);
                body rotor: massless;
                joint flight: free(px: x, py: y, pz: z, yaw: z, pitch: y, roll: x) from ground to hull;
                joint turn: revolute(z) from hull to rotor;
                {more}
            }}"
        )
    };
    assert_eq!(refusals(&drone("")), 1);
    let alone = compiled(&drone("kernels only;"));
    let held = compiled(&drone(
        "kernels only; every angle: spring(stiffness: 50 N*m/rad); every displacement: spring(stiffness: 60 N/m);",
    ));
    let q = [0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 0.7];
    let v = [1.1, 0.9, -1.2, 0.8, 0.7, -0.6, 0.5];
    let motion = |compilation: &Compilation| kernel(compilation, "motion", &[&v, &q, &[], &[]]);
    let (alone, held) = (motion(&alone), motion(&held));
    assert_eq!(alone[0], held[0]);
    assert!((alone[0][0] - 2.0).abs() < 1e-14);
    for (k, x) in q.into_iter().enumerate() {
        let stiffness: f64 = if k < 3 { 60.0 } else { 50.0 };
        let difference = alone[1][k] - held[1][k] - stiffness * x;
        assert!(difference.abs() < 1e-13, "{k}: {difference}");
    }
}

/// A coordinate without resistance, one without mass, and one whose speed is undetermined.
#[test]
fn without_a_steady_motion_there_are_kernels() {
    let spinning = |more: &str| {
        format!(
            "mechanism Spinning {{
                {more}
                body bar: rod(mass: 3 kg, length: 1 m, along: x);
                body fan: disk(mass: 3 kg, radius: 1 m, axis: z);
                body frame: massless;
                joint theta: revolute(z) from ground to bar;
                joint turn: revolute(z) from ground to fan, coasting;
                joint shake: prismatic(x) from bar to frame;
            }}"
        )
    };
    assert_eq!(refusals(&spinning("")), 1);
    let alone = compiled(&spinning("kernels only;"));
    // Positions first: (1/3) m l^2 and zero. For a speed, (1/2) m r^2 multiplies its rate, in the damping matrix.
    let matrices = kernel(&alone, "linear", &[&[0.0; 3], &[], &[]]);
    assert_eq!(matrices[0][..], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(matrices[1][..], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.5]);
}

/// A study of a mechanism without a steady motion gives a result or a reason: a drifting bar, a falling bar, and a bar
/// with a massless joint.
#[test]
fn a_study_of_kernels_alone_answers() {
    const LIGHT: &str = "body frame: massless; joint shake: prismatic(x) from bar to frame;";
    const GRAVITY: &str = "gravity 9.81 m/s^2 along -z;";
    for (more, expected) in [("", "Neutral"), (GRAVITY, "NoEquilibrium"), (LIGHT, "SingularMass")] {
        let text = format!(
            "mechanism Bar {{
                kernels only;
                {more}
                body bar: rod(mass: 3 kg, length: 1 m, along: x);
                joint slide: prismatic(z) from ground to bar;
            }}"
        );
        let study = Study::new(Interpreted::from_text(&text).expect("kernels"));
        let answer = format!("{:?} {:?}", study.equilibrium(), study.modes());
        assert!(answer.contains(expected), "{more}: {answer}");
    }
}
