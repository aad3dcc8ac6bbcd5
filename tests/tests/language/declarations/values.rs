//! Declarations are read as written, and values arrive in SI.

use eigentol_compiler::base::ids::{BodyId, CoordinateId, JointId};
use eigentol_compiler::model::evaluate::evaluate;
use eigentol_compiler::model::expression::Expr;
use eigentol_compiler::model::mechanism::{Frame, Motion, Part, Shape};
use eigentol_compiler::syntax::print::print;
use eigentol_compiler::topology::build::build;

use super::common::{DECLARATIONS, DOUBLE_PENDULUM, EVERYTHING, nominal, read, resolved};

#[test]
fn printing_and_parsing_gives_the_same_tree() {
    for source in DECLARATIONS {
        let ast = read(source);
        let text = print(&ast);
        assert_eq!(read(&text), ast, "{text}");
        assert_eq!(print(&read(&text)), text);
    }
}

#[test]
fn the_double_pendulum_arrives_in_si() {
    let mechanism = resolved(DOUBLE_PENDULUM);
    assert_eq!(mechanism.name, "RotatingDoublePendulum");
    assert_eq!(mechanism.attributes.len(), 2);
    let input = &mechanism.inputs[0];
    assert_eq!(input.unit.symbol, "rpm");
    assert_eq!(input.unit.scale, std::f64::consts::TAU / 60.0);
    assert_eq!(input.docs, [" Speed of the shaft."]);
    let outer = &mechanism.design[3];
    assert_eq!((outer.nominal, outer.tolerance.upper), (1.0, 0.03));
    assert_eq!((outer.unit.symbol.as_str(), outer.unit.scale), ("mm", 1e-3));
    assert_eq!(mechanism.design[2].tolerance.upper, 0.03);
    assert_eq!(mechanism.gravity, [0.0, 0.0, -9.81].map(Expr::Number));
    assert_eq!(mechanism.coordinates.len(), 3);
    assert!(matches!(mechanism.coordinates[0].motion, Motion::Driven(_)));
    let units: Vec<&str> = mechanism.outputs.iter().map(|output| output.unit.symbol.as_str()).collect();
    assert_eq!(units, ["m", "m", "rad"]);
    let b = nominal(&mechanism);
    let [Part { shape: Shape::Rod { center, .. }, .. }] = mechanism.bodies[1].parts.as_slice() else {
        panic!("a rod");
    };
    assert_eq!(evaluate(&mechanism, &center[2], &[0.0], &b), -0.5);
    assert_eq!(evaluate(&mechanism, &mechanism.constants[0].value, &[0.0], &b), 6.0);
}

#[test]
fn values_of_a_full_declaration() {
    let mechanism = resolved(EVERYTHING);
    let b = nominal(&mechanism);
    let u = [0.0; 4];
    assert_eq!(b[0], -0.02);
    assert_eq!(mechanism.design[0].tolerance.upper, 5e-4);
    assert_eq!(mechanism.design[2].tolerance.upper, 0.125);
    assert_eq!(mechanism.inputs[3].unit.symbol, "kg/(m*s^2)");
    let constant = |name: &str| {
        let constant = mechanism.constants.iter().find(|constant| constant.name == name);
        evaluate(&mechanism, &constant.unwrap().value, &u, &b)
    };
    let r = 0.2;
    assert_eq!(constant("early"), 2.0 * r - 0.01);
    assert_eq!(constant("late"), constant("early").powi(2) + r * r);
    let t1 = r.atan2(1.0) + 0.5f64.atan() + 0.5f64.sqrt() + 0.5 + 2.0;
    assert!((constant("t1") - t1).abs() < 1e-14);
    let s1 = -r.powi(-4) - r.powi(4) / 16.0;
    assert!((constant("s1") - s1).abs() < 1e-9, "{}", constant("s1"));
    // Prerequisites first, whatever the order of declaration.
    let order: Vec<String> = mechanism.constants.iter().map(|c| c.name.to_string()).collect();
    let place = |name: &str| order.iter().position(|other| other == name).unwrap();
    assert!(place("early") < place("late"));
    let joint = &mechanism.joints[0];
    assert_eq!(joint.from_placement.rotations.len(), 2);
    assert_eq!(joint.to_placement.offset[2], Expr::Number(1e-3));
}

#[test]
fn the_forest_visits_parents_first() {
    let mechanism = resolved(EVERYTHING);
    let topology = build(&mechanism).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(topology.branches.len(), mechanism.bodies.len());
    let mut seen = vec![Frame::Ground];
    for branch in &topology.branches {
        assert!(seen.contains(&branch.parent));
        seen.push(Frame::Body(branch.body));
    }
    let reversed: Vec<JointId> =
        topology.branches.iter().filter(|branch| branch.reversed).map(|branch| branch.joint).collect();
    assert_eq!(reversed, [JointId(2)]);
    assert_eq!(topology.driven, [CoordinateId(1), CoordinateId(2)]);
    assert_eq!(topology.free.len(), 4);
    assert_eq!(topology.branches[0].body, BodyId(0));
}
