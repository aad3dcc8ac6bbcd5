//! Compares derivatives by walks over the bodies with derivatives of the equations, for whole declarations.

use crate::mechanics::compared;
use crate::model::resolve::resolve;
use crate::syntax::parse::parse;
use crate::topology::build::build;

const BODIES: &str = "input omega: rad/s; design l = 0.7 m; design m = 2 kg;
    gravity [0.3, -0.7, -9.81] m/s^2;
    body hub: rigid(mass: m, center: [0.1, -0.2, 0.3] m, inertia: [1, 2, 2.5, 0.1, -0.2, 0.3] kg*m^2);
    body arm: rigid(mass: 3 kg, center: [0.2 m, l, -0.1 m], inertia: [0.4, 0.3, 0.5, 0.02, 0.03, -0.01] kg*m^2);
    body hand: rigid(mass: 1.5 kg, center: [-0.3, 0.1, 0.2] m, inertia: [0.2, 0.3, 0.25, 0, 0.01, 0.02] kg*m^2);";

fn of_joints(joints: &str) -> Option<usize> {
    let text = format!("mechanism Machine {{ {BODIES} {joints} }}");
    let ast = parse(text.parse().expect("tokens")).expect("it parses");
    let mechanism = resolve(&ast).expect("it resolves");
    let topology = build(&mechanism).expect("it hangs together");
    compared(&mechanism, &topology)
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
