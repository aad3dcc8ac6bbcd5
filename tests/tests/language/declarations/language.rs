//! Checks that every construct of the language reaches the model with its intended meaning.

use std::f64::consts::{PI, TAU};

use eigentol_compiler::model::evaluate::evaluate;
use eigentol_compiler::model::expression::Expr;
use eigentol_compiler::model::mechanism::{
    Body, Coordinate, CoordinateQuantity, Force, ForceLaw, Frame, Joint, Mechanism, Motion, Shape, StepMotion,
};
use eigentol_compiler::topology::build::build;

use super::common::{OPEN_MECHANISM, nominal, resolved};

fn mechanism() -> Mechanism {
    resolved(OPEN_MECHANISM)
}

fn body<'a>(mechanism: &'a Mechanism, name: &str) -> &'a Body {
    let body = mechanism.bodies.iter().find(|body| body.name == name);
    body.expect("a body")
}

fn joint<'a>(mechanism: &'a Mechanism, name: &str) -> &'a Joint {
    let joint = mechanism.joints.iter().find(|joint| joint.name == name);
    joint.expect("a joint")
}

fn coordinate<'a>(mechanism: &'a Mechanism, name: &str) -> &'a Coordinate {
    let all = &mechanism.coordinates;
    let coordinate = all.iter().find(|coordinate| coordinate.name == name);
    coordinate.expect("a coordinate")
}

fn force<'a>(mechanism: &'a Mechanism, name: &str) -> &'a ForceLaw {
    let force: Option<&Force> = mechanism.forces.iter().find(|force| force.name == name);
    &force.expect("a force").law
}

/// The value at the nominal design; inputs are 7 and 11 in SI.
fn value(mechanism: &Mechanism, expr: &Expr) -> f64 {
    evaluate(mechanism, expr, &[7.0, 11.0], &nominal(mechanism))
}

fn mass(mechanism: &Mechanism, shape: &Shape) -> f64 {
    let mass = match shape {
        Shape::Point { mass, .. }
        | Shape::Rod { mass, .. }
        | Shape::Disk { mass, .. }
        | Shape::Cylinder { mass, .. }
        | Shape::Tube { mass, .. }
        | Shape::Cuboid { mass, .. }
        | Shape::Sphere { mass, .. }
        | Shape::Rigid { mass, .. } => mass,
    };
    value(mechanism, mass)
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-13 * a.abs().max(b.abs()).max(1.0)
}

#[test]
fn joints_are_sequences_of_motions() {
    let mechanism = mechanism();
    let motions = |name: &str| -> String {
        let steps = joint(&mechanism, name).steps.iter();
        let letters = steps.map(|step| match step.motion {
            StepMotion::Turn => 'T',
            StepMotion::Slide => 'S',
            StepMotion::Screw { .. } => 'W',
        });
        letters.collect()
    };
    let expected = [
        ("mount", ""),
        ("spin", "T"),
        ("thread", "W"),
        ("sheath", "ST"),
        ("wrist", "TT"),
        ("table", "SST"),
        ("hip", "TTT"),
        ("tether", "SSSTTT"),
    ];
    for (name, letters) in expected {
        assert_eq!(motions(name), letters, "{name}");
    }
    assert_eq!(joint(&mechanism, "wrist").word, "universal");
    // Every coordinate belongs to the step that names it, in the order of the joints.
    let mut next = 0;
    for (index, joint) in mechanism.joints.iter().enumerate() {
        for step in &joint.steps {
            assert_eq!(step.coordinate.index(), next);
            let coordinate = &mechanism.coordinates[next];
            assert_eq!(coordinate.joint.index(), index);
            let expected = match step.motion {
                StepMotion::Slide => CoordinateQuantity::Displacement,
                StepMotion::Turn | StepMotion::Screw { .. } => CoordinateQuantity::Angle,
            };
            assert_eq!(coordinate.quantity, expected);
            next += 1;
        }
    }
    assert_eq!(next, mechanism.coordinates.len());
    assert_eq!(coordinate(&mechanism, "thread").name, "thread");
    let [_, lag] = joint(&mechanism, "wrist").steps.as_slice() else {
        panic!("two steps");
    };
    assert_eq!(mechanism.coordinates[lag.coordinate.index()].name, "lag");
    assert_eq!(lag.axis.each_ref().map(|x| value(&mechanism, x)), [0.0, 0.0, 1.0]);
}

#[test]
fn a_lead_is_travel_per_turn() {
    let mechanism = mechanism();
    for (name, travel) in [("thread", -5e-3), ("tail", 0.0254)] {
        let StepMotion::Screw { lead } = &joint(&mechanism, name).steps[0].motion else {
            panic!("a screw");
        };
        assert!(near(value(&mechanism, lead) * TAU, travel), "{name}");
    }
}

#[test]
fn drives_are_those_of_their_coordinates() {
    let mechanism = mechanism();
    let speed = |name: &str| match &coordinate(&mechanism, name).motion {
        Motion::Free | Motion::Coasting => None,
        Motion::Driven(speed) => Some(value(&mechanism, speed)),
    };
    assert_eq!(speed("spin"), Some(7.0));
    assert_eq!(speed("slide"), Some(1e-3));
    assert_eq!(speed("roll"), Some(14.0));
    assert_eq!(speed("turn"), Some(7.0));
    assert_eq!(speed("a1"), Some(-7.0));
    assert_eq!(speed("tail"), Some(TAU / 20.0));
    let driven = mechanism.coordinates.iter();
    let driven = driven.filter(|coordinate| coordinate.motion != Motion::Free);
    assert_eq!(driven.count(), 6);
}

#[test]
fn masses_come_from_densities() {
    let mechanism = mechanism();
    let first = |name: &str| mass(&mechanism, &body(&mechanism, name).parts[0].shape);
    assert!(near(first("rail"), 2.0));
    assert!(near(first("plate"), 3.0 * PI * 0.04));
    assert!(near(first("pipe"), 7850.0 * PI * (0.01 - 0.0025)));
    assert!(near(first("drum"), 7850.0 * PI * 0.01 * 0.03));
    assert!(near(first("drone"), 300.0 * 4.0 / 3.0 * PI * 1e-3));
    assert!(near(first("sleeve"), 1.0));
    let cube = &body(&mechanism, "drum").parts[3].shape;
    assert!(near(mass(&mechanism, cube), 6e-3));
}

#[test]
fn a_sum_keeps_its_terms_in_order() {
    let mechanism = mechanism();
    assert!(body(&mechanism, "frame").parts.is_empty());
    let parts = &body(&mechanism, "drum").parts;
    let holes: Vec<bool> = parts.iter().map(|part| part.hole).collect();
    assert_eq!(holes, [false, false, true, false, true]);
    // The sum `2 * arm + [0, 0, r]` ends before the next shape.
    let rod = &parts[1].placement;
    let offset = rod.offset.each_ref().map(|x| value(&mechanism, x));
    assert_eq!(offset, [0.2, 0.0, 0.1]);
    assert_eq!(rod.rotations.len(), 1);
    assert_eq!(value(&mechanism, &rod.rotations[0].1), PI / 2.0);
    let hole = &parts[2].placement;
    assert_eq!(value(&mechanism, &hole.offset[0]), 0.05);
    assert!(matches!(parts[2].shape, Shape::Cylinder { .. }));
    let Shape::Rigid { about, .. } = &body(&mechanism, "hub").parts[0].shape else {
        panic!("a rigid body");
    };
    let about = about.as_ref().expect("a point of reference");
    assert_eq!(value(&mechanism, &about[2]), 0.1);
}

#[test]
fn points_have_axes() {
    let mechanism = mechanism();
    let anchor = &mechanism.points[1];
    assert_eq!((anchor.frame, anchor.placement.rotations.len()), (Frame::Ground, 2));
    assert_eq!(mechanism.points[3].placement.offset, [0.0; 3].map(Expr::Number));
    assert_eq!(mechanism.points[3].placement.rotations.len(), 1);
}

#[test]
fn forces_keep_what_was_given_and_are_zero_otherwise() {
    let mechanism = mechanism();
    let zero = [0.0; 3].map(Expr::Number);
    let ForceLaw::Bushing { stiffness, damping, turning_stiffness, turning_damping, .. } = force(&mechanism, "f8")
    else {
        panic!("a bushing");
    };
    assert_eq!(
        stiffness.each_ref().map(|row| row.each_ref().map(|k| value(&mechanism, k))),
        [[1e3, 0.0, 0.0], [0.0, 2e3, 0.0], [0.0, 0.0, 3e3]]
    );
    let none = [(); 3].map(|()| zero.clone());
    assert_eq!((&**damping, &**turning_stiffness), (&none, &none));
    assert_eq!(turning_damping[2][2], Expr::Number(0.1));
    let ForceLaw::Load { force: load, moment, following, .. } = force(&mechanism, "f10") else {
        panic!("a load");
    };
    assert!((value(&mechanism, &load[2]), moment, *following) == (11.0, &zero, false));
    assert!(matches!(force(&mechanism, "f12"), ForceLaw::Load { following: true, .. }));
    let ForceLaw::Drag { damping, .. } = force(&mechanism, "f14") else {
        panic!("a drag");
    };
    assert_eq!(*damping, Expr::Number(0.0));
}

#[test]
fn every_body_hangs_on_the_ground() {
    let mechanism = mechanism();
    let topology = build(&mechanism).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(topology.branches.len(), mechanism.bodies.len());
    assert_eq!(topology.driven.len(), 6);
    assert_eq!(topology.free.len(), mechanism.coordinates.len() - 6);
}
