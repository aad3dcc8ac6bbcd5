//! Compares derivatives by walks over the bodies with derivatives of the equations, for whole declarations.

use crate::mechanics::{compared, compared_at_rest};
use crate::model::mechanism::Mechanism;
use crate::model::resolve::resolve;
use crate::syntax::parse::parse;
use crate::topology::Topology;
use crate::topology::build::build;

const BODIES: &str = "input omega: rad/s; design l = 0.7 m; design m = 2 kg;
    gravity [0.3, -0.7, -9.81] m/s^2;
    body hub: rigid(mass: m, center: [0.1, -0.2, 0.3] m, inertia: [1, 2, 2.5, 0.1, -0.2, 0.3] kg*m^2);
    body arm: rigid(mass: 3 kg, center: [0.2 m, l, -0.1 m], inertia: [0.4, 0.3, 0.5, 0.02, 0.03, -0.01] kg*m^2);
    body hand: rigid(mass: 1.5 kg, center: [-0.3, 0.1, 0.2] m, inertia: [0.2, 0.3, 0.25, 0, 0.01, 0.02] kg*m^2);";

fn built(items: &str) -> (Mechanism, Topology) {
    let text = format!("mechanism Machine {{ {items} }}");
    let ast = parse(text.parse().expect("tokens")).expect("it parses");
    let mechanism = resolve(&ast).expect("it resolves");
    let topology = build(&mechanism).expect("it hangs together");
    (mechanism, topology)
}

fn of_joints(joints: &str) -> Option<usize> {
    let (mechanism, topology) = built(&format!("{BODIES} {joints}"));
    compared(&mechanism, &topology)
}

const BEAMS: &str = "input omega: rad/s; design l = 0.7 m; design s = 300 N*m^2; gravity [0.3, -0.7, -9.81] m/s^2;
    body hub: rigid(mass: 2 kg, center: [0.1, -0.2, 0.3] m, inertia: [1, 2, 2.5, 0.1, -0.2, 0.3] kg*m^2);
    body tip: rigid(mass: 1.5 kg, center: [-0.3, 0.1, 0.2] m, inertia: [0.2, 0.3, 0.25, 0, 0.01, 0.02] kg*m^2);";

/// Entries of mass, damping and stiffness that are not zero.
fn of_beams(items: &str) -> [usize; 3] {
    let (mechanism, topology) = built(&format!("{BEAMS} {items}"));
    compared_at_rest(&mechanism, &topology).expect("the walks apply")
}

#[test]
fn turns_about_skew_axes() {
    let entries = of_joints(
        "joint a: revolute([0.2, 0.3, 1]) from ground to hub;
         joint b: revolute(y) from hub to arm at [l, 0, 0.2 m] rotated(x, 20 deg);
         joint c: revolute([1, 0.4, 0]) from arm to hand at [0.1, 0.2, 0.3] m rotated(z, 10 deg) rotated(y, 5 deg);",
    );
    // all but one: the moment of the last body about its axis does not depend on how fast it turns about it
    assert_eq!(entries, Some(17));
}

#[test]
fn slides_and_screws_off_the_origin() {
    let entries = of_joints(
        "joint a: screw([0.1, 0.2, 1], lead: 300 mm) from ground to hub at [0.1, 0.2, 0] m, at [0.3, -0.1, 0.2] m on hub;
         joint b: prismatic([1, 0.5, 0.2]) from hub to arm at [l, 0, 0.2 m], at [0.1, 0.2, 0.3] m rotated(x, 30 deg) on arm;
         joint c: revolute(y) from arm to hand at [0.1, 0.2, 0.3] m, at [0, 0.4, 0.1] m rotated(z, 15 deg) on hand;",
    );
    // nothing depends on the speed of a slide along its own direction
    assert!(entries.is_some_and(|count| count >= 16), "{entries:?}");
}

#[test]
fn branches_drives_and_joints_declared_inwards() {
    let entries = of_joints(
        "body mast: rigid(mass: 1 kg, inertia: [0.1, 0.1, 0.1, 0, 0, 0] kg*m^2);
         joint spin: universal(turn: z, tilt: x) from ground to mast, turn driven at omega, tilt driven at 0.3 rad/s;
         joint a: revolute(x) from hub to mast at [l, 0.1 m, 0.2 m], at [0.3, 0.2, 0] m on mast;
         joint b: revolute(y) from hub to arm at [0.2, 0, 0.3] m;
         joint c: screw(z, lead: 100 mm) from hand to hub at [0.1, 0, 0] m;",
    );
    assert!(entries.is_some_and(|count| count >= 10), "{entries:?}");
}

#[test]
fn joints_of_several_motions() {
    let entries = of_joints(
        "joint a: spherical(a1: z, a2: y, a3: x) from ground to hub at [0.1, 0, 0.3] m, at [0.2, 0.1, 0] m on hub;
         joint b: cylindrical(b1: [1, 0, 1], b2: [1, 0, 1]) from hub to arm at [l, 0, 0.2 m], at [0, 0.3, 0.1] m rotated(x, 20 deg) on arm;
         joint c: universal(c1: x, c2: z) from hand to arm at [0.1, 0.2, 0.3] m rotated(y, 15 deg), c2 driven at omega;",
    );
    assert!(entries.is_some_and(|count| count >= 55), "{entries:?}");
    let entries = of_joints(
        "joint a: free(x1: x, x2: y, x3: [0, 1, 1], a1: z, a2: y, a3: x) from ground to hub, x2 driven at 0.3 m/s, a1 driven at omega;
         joint b: planar(b1: x, b2: y, b3: z) from hub to arm at [l, 0, 0.2 m], at [0, 0.3, 0.1] m on arm, b2 driven at 0.2 m/s;
         joint c: fixed from arm to hand;",
    );
    assert!(entries.is_some_and(|count| count >= 35), "{entries:?}");
}

#[test]
fn a_run_between_other_joints() {
    let entries = of_joints(
        "joint a: revolute([0.2, 0, 1]) from ground to hub at [0.1, 0.2, 0] m;
         joint b: revolute(y) from hub to arm at [l, 0, 0.2 m] rotated(x, 20 deg);
         joint c: revolute(y) from arm to hand at [0.1, 0.2, 0.3] m;",
    );
    assert_eq!(entries, Some(17));
}

#[test]
fn runs_that_prevail_are_differentiated() {
    let entries = of_joints(
        "joint a: revolute(y) from ground to hub;
         joint b: revolute(y) from hub to arm at [l, 0, 0.2 m];
         joint c: revolute(y) from arm to hand at [0.1, 0.2, 0.3] m;",
    );
    assert_eq!(entries, None);
}

#[test]
fn a_beam_on_a_turning_hub_with_a_heavy_tip() {
    let entries = of_beams(
        "body blade: beam(length: l, along: x, up: z, mass_per_length: 2 kg/m, stiffness_y: s, stiffness_z: 2 * s,
             torsion_stiffness: 80 N*m^2, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m, center_y: 0.02 m, twist: 0.4 rad,
             bending: 2, torsion: 1);
         joint spin: universal(turn: z, tilt: x) from ground to hub, turn driven at omega, tilt driven at 0.3 rad/s;
         joint flap: revolute(y) from hub to blade at [0.2 m, 0, 0.1 m] rotated(x, 20 deg);
         joint seat: revolute([0.2, 1, 0]) from blade at tip to tip;",
    );
    assert_eq!(entries, [49, 42, 49]);
}

#[test]
fn beams_in_series_that_carry_a_disk_between_them() {
    let entries = of_beams(
        "material steel: density 7800 kg/m^3, modulus 210 GPa, poisson 0.3;
         body a: beam(length: l, along: [0, 1, 0], up: z, section: circle(radius: 20 mm), material: steel, bending: 2,
             torsion: 0, shear: static) spinning at omega;
         body b: beam(length: l, along: [0, 1, 0], up: z, section: circle(radius: 20 mm), material: steel, bending: 1,
             torsion: 1, shear: 1) spinning at omega;
         joint float: free(px: x, py: y, pz: z, rx: x, ry: y, rz: z) from ground to a, ry driven at 0;
         joint weld: fixed from a at tip to b;
         joint seat: revolute(y) from a at 0.4 length to hub, driven at omega;
         joint hang: spherical(c1: z, c2: y, c3: x) from b at tip to tip;",
    );
    assert_eq!(entries, [433, 125, 241]);
}

#[test]
fn branching_beams_that_stretch_and_lag() {
    let entries = of_beams(
        "body boom: beam(length: l, along: x, up: z, mass_per_length: 2 kg/m, stiffness_y: s, stiffness_z: 2 * s,
             torsion_stiffness: 80 N*m^2, axial_stiffness: 1e5 N, inertia_y: 0.01 kg*m, inertia_z: 0.02 kg*m,
             bending: 1, torsion: 1, stretch: 1, lag: 2 ms, prebend_y: 0.3 rad);
         body twig: beam(length: 0.5 * l, along: [0, 0.6, 0.8], up: x, mass_per_length: 1 kg/m, stiffness_y: s, bending_y: 2);
         joint root: prismatic([1, 0.5, 0.2]) from ground to boom;
         joint fork: revolute(z) from boom at 0.5 length to twig, driven at omega;
         joint end: fixed from twig at tip to tip;
         joint far: revolute(x) from boom at tip to hub;",
    );
    assert_eq!(entries, [124, 44, 92]);
}
