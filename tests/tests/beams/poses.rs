//! How far the sections of beams are from turning by 180 degrees, where their coordinates become singular.

use eigentol::kernels::Kernels;

use crate::compared::{machine, study};

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
    let pose = arm
        .pose_margin(&q, &[], &[])
        .expect("a beam that turns about two axes");
    assert_eq!(&*pose.joint, "arm");
    assert!(
        (pose.margin - half_turn.cos().powi(2)).abs() < 1e-12,
        "{}",
        pose.margin
    );
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
    assert!(
        (wave(20.0) - middle).abs() < 1e-12,
        "{} {middle}",
        wave(20.0)
    );
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
