//! How far the sections of beams are from turning by 180 degrees, where their coordinates become singular.

use eigentol::kernels::Kernels;

use crate::beams::compared::{machine, study};

const IN_SPACE: &str = "mechanism Arm {
    gravity 9.81 m/s^2 along -z;
    body arm: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2,
        stiffness_z: 9 N*m^2, bending_y: 4, bending_z: 2, points: 7);
    joint clamp: fixed from ground to arm;
}";

/// The end turns by 150 degrees: tan(75 degrees) is half the Rodrigues vector.
#[test]
fn at_150_degrees_the_margin_is_that_of_the_angle() {
    let arm = machine(IN_SPACE);
    let half_turn = 75.0_f64.to_radians();
    let vector = 2.0 * half_turn.tan();
    let q = [0.6 * vector, 0.0, 0.0, 0.0, 0.8 * vector, 0.0];
    let pose = arm.pose_margin(&q, &[], &[]).expect("a beam that turns about two axes");
    assert_eq!(&*pose.joint, "arm");
    assert!((pose.margin - half_turn.cos().powi(2)).abs() < 1e-12, "{}", pose.margin);
    assert!((pose.margin - 0.067).abs() < 1e-3);
}

/// The middle of a beam whose end has turned back is what counts.
#[test]
fn the_section_that_has_turned_most_counts() {
    let arm = machine(IN_SPACE);
    let wave = |amplitude: f64| {
        let q = [0.0, amplitude, 0.0, 0.0, 0.0, 0.0];
        arm.pose_margin(&q, &[], &[]).expect("a margin").margin
    };
    assert!((wave(0.0) - 1.0).abs() < 1e-15);
    // One of seven places is the middle, where the integral of the second polynomial is -1/4.
    let middle = 1.0 / (1.0 + 0.25 * (20.0_f64 / 4.0).powi(2));
    assert!((wave(20.0) - middle).abs() < 1e-12, "{} {middle}", wave(20.0));
}

#[test]
fn equilibria_say_it_and_beams_in_a_plane_have_no_singular_pose() {
    let bent = study(IN_SPACE, None).equilibrium().expect("it hangs");
    let pose = bent.pose.as_ref().expect("a margin");
    assert_eq!(&*pose.joint, "arm");
    assert!(pose.margin > 0.5 && pose.margin < 0.95, "{}", pose.margin);
    let planar = IN_SPACE.replace(", bending_z: 2", "");
    let planar = study(&planar, None).equilibrium().expect("it hangs");
    assert!(planar.pose.is_none());
}

/// A moment at the tip bends the beam to a part of a circle: `M L / EI` is the angle.
fn bent_by(moment: f64) -> String {
    IN_SPACE
        .replace("bending_y: 4, bending_z: 2, points: 7", "bending_y: 10, bending_z: 1")
        .replace("gravity 9.81 m/s^2 along -z;", "gravity [0, 0, 0];")
        .replace(
            "joint clamp",
            &format!(
                "point tip: arm at tip; force turning: follower(at: tip, moment: [0, {moment}, 0] N*m);
                joint clamp"
            ),
        )
}

#[test]
fn beams_that_turn_by_more_than_150_degrees_are_refused() {
    for (degrees, accepted) in [(140.0_f64, true), (149.0, true), (151.0, false), (160.0, false)] {
        let moment = 2.0 * degrees.to_radians();
        let study = study(&bent_by(moment), None).policy(eigentol::equilibrium::Policy::Nearest);
        let found = study.equilibrium();
        match (accepted, &found) {
            (true, Ok(state)) => {
                let margin = state.pose.as_ref().expect("a margin").margin;
                let exact = (0.5 * degrees.to_radians()).cos().powi(2);
                assert!((margin - exact).abs() < 1e-3, "{degrees}: {margin} {exact}");
            }
            (false, Err(eigentol::Error::BentTooFar { beam, degrees: found })) => {
                assert_eq!(&**beam, "arm");
                assert!((found - degrees).abs() < 1.0, "{found}");
            }
            _ => panic!("{degrees}: {found:?}"),
        }
    }
}
