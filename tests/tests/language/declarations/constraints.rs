//! Constraints, cut and coasting joints: from text to the tables of the mechanism.

use eigentol_compiler::base::ids::{ConstraintId, CoordinateId, JointId, PointId};
use eigentol_compiler::model::evaluate::evaluate;
use eigentol_compiler::model::expression::{Expr, Vector};
use eigentol_compiler::model::mechanism::{ConstraintLaw, CoordinateQuantity, Mechanism, Motion, Output};
use eigentol_compiler::syntax::print::print;

use super::common::{CLOSED_MECHANISM, nominal, read, resolved};

fn law<'a>(mechanism: &'a Mechanism, name: &str) -> &'a ConstraintLaw {
    let all = &mechanism.constraints;
    let found = all.iter().find(|constraint| constraint.name == name);
    &found.expect("a constraint").law
}

fn point(mechanism: &Mechanism, name: &str) -> PointId {
    let place = mechanism.points.iter().position(|point| point.name == name);
    PointId::new(place.expect("a point"))
}

fn coordinate(mechanism: &Mechanism, name: &str) -> CoordinateId {
    let all = &mechanism.coordinates;
    let place = all.iter().position(|coordinate| coordinate.name == name);
    CoordinateId::new(place.expect("a coordinate"))
}

fn output<'a>(mechanism: &'a Mechanism, name: &str) -> &'a Output {
    let output = mechanism.outputs.iter().find(|output| output.name == name);
    output.expect("an output")
}

fn value(mechanism: &Mechanism, expr: &Expr) -> f64 {
    evaluate(mechanism, expr, &[7.0], &nominal(mechanism))
}

fn values(mechanism: &Mechanism, vector: &Vector) -> [f64; 3] {
    vector.each_ref().map(|x| value(mechanism, x))
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * b.abs().max(1.0)
}

#[test]
fn every_kind_keeps_what_was_given() {
    let mechanism = resolved(CLOSED_MECHANISM);
    let named = |name| point(&mechanism, name);
    let coincident = |name: &str| match law(&mechanism, name) {
        ConstraintLaw::Coincident { from, to, along } => (*from, *to, *along),
        other => panic!("{other:?}"),
    };
    let (elbow, knee) = (named("elbow"), named("knee"));
    assert_eq!(coincident("pin"), (elbow, knee, [true; 3]));
    assert_eq!(coincident("guide"), (knee, elbow, [true, false, true]));
    assert_eq!(coincident("floor"), (elbow, knee, [false, false, true]));

    let aligned = |name: &str| match law(&mechanism, name) {
        ConstraintLaw::Aligned { from, to, axis } => {
            assert_eq!((*from, *to), (elbow, knee));
            axis.as_ref().map(|axis| values(&mechanism, axis))
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(aligned("square"), None);
    let [x, y, z] = aligned("parallel").expect("an axis");
    assert!(near(x, 0.6) && y == 0.0 && near(z, 0.8));
    assert_eq!(aligned("opposite"), Some([0.0, -1.0, 0.0]));

    let ConstraintLaw::Distance { from, to, length } = law(&mechanism, "rod") else {
        panic!("a distance");
    };
    assert_eq!((*from, *to), (elbow, named("anchor")));
    assert!(near(value(&mechanism, length), 0.4));
}

#[test]
fn a_wheel_has_an_axle_and_a_ball_has_none() {
    let mechanism = resolved(CLOSED_MECHANISM);
    for (name, expected_axis, expected_normal) in
        [("contact", Some([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]), ("bounce", None, [0.0, 0.6, 0.8])]
    {
        let ConstraintLaw::Rolling { wheel, axis, radius, on, normal } = law(&mechanism, name) else {
            panic!("a rolling constraint");
        };
        assert_eq!(*wheel, point(&mechanism, "hub"));
        assert_eq!(*on, point(&mechanism, "road"));
        let axis = axis.as_ref().map(|axis| values(&mechanism, axis));
        assert_eq!(axis, expected_axis);
        assert!(near(value(&mechanism, radius), 0.3));
        let normal = values(&mechanism, normal);
        for (own, expected) in normal.iter().zip(expected_normal) {
            assert!(near(*own, expected), "{name}: {normal:?}");
        }
    }
}

/// The value of an expression of coordinates, and its unit, at given values of two coordinates.
fn equation_at(mechanism: &Mechanism, name: &str, at: [(&str, f64); 2]) -> (f64, String) {
    let ConstraintLaw::Equation { zero, unit } = law(mechanism, name) else {
        panic!("an equation");
    };
    fn of(mechanism: &Mechanism, expr: &Expr, at: &[(CoordinateId, f64)]) -> f64 {
        let part = |expr: &Expr| of(mechanism, expr, at);
        match expr {
            Expr::Coordinate(id) => {
                let found = at.iter().find(|(x, _)| x == id);
                found.expect("a given coordinate").1
            }
            Expr::Negate(a) => -part(a),
            Expr::Add(a, b) => part(a) + part(b),
            Expr::Subtract(a, b) => part(a) - part(b),
            Expr::Multiply(a, b) => part(a) * part(b),
            constant => value(mechanism, constant),
        }
    }
    let at = at.map(|(name, value)| (coordinate(mechanism, name), value));
    (of(mechanism, zero, &at), unit.symbol.clone())
}

#[test]
fn a_coupling_is_the_equation_of_its_coordinates() {
    let mechanism = resolved(CLOSED_MECHANISM);
    // theta1 = -z2/z1 theta2 + 5 deg, x = 3 cm/rad theta1, theta1 = 50 rad/m x + 5 deg.
    for (name, at, expected, unit) in [
        ("mesh", [("turn1", 0.5), ("turn2", 0.3)], 0.5 + 35.0 / 20.0 * 0.3 - 5f64.to_radians(), "rad"),
        ("rack", [("slide", 0.1), ("turn1", 0.5)], 0.1 - 0.03 * 0.5, "m"),
        ("pinion", [("turn1", 0.5), ("slide", 0.1)], 0.5 - 50.0 * 0.1, "rad"),
        ("tandem", [("slide", 0.1), ("lift", 0.4)], 0.1 - 0.4 + 0.02, "m"),
        ("belt", [("spin", 0.5), ("idle", 0.25)], 0.5 - 2.0 * 0.25, "rad"),
    ] {
        let (value, symbol) = equation_at(&mechanism, name, at);
        assert!(near(value, expected), "{name}: {value} {expected}");
        assert_eq!(symbol, unit, "{name}");
    }
}

#[test]
fn an_equation_may_have_any_dimension() {
    let mechanism = resolved(CLOSED_MECHANISM);
    for (name, unit) in [("slot", "m"), ("area", "m^2"), ("pure", ""), ("sum", "rad")] {
        let ConstraintLaw::Equation { unit: own, .. } = law(&mechanism, name) else {
            panic!("an equation");
        };
        assert_eq!((own.symbol.as_str(), own.scale), (unit, 1.0), "{name}");
    }
}

#[test]
fn coordinates_coast_by_name_or_all_together() {
    let mechanism = resolved(CLOSED_MECHANISM);
    let motion = |name: &str| &mechanism.coordinates[coordinate(&mechanism, name).index()].motion;
    for name in ["forward", "side", "yaw", "idle", "roll_on"] {
        assert_eq!(*motion(name), Motion::Coasting, "{name}");
    }
    assert_eq!(*motion("lift"), Motion::Free);
    let coasting = mechanism.coordinates.iter();
    let coasting = coasting.filter(|coasting| coasting.motion == Motion::Coasting);
    assert_eq!(coasting.count(), 5);
    assert!(motion("spin").runs() && motion("idle").runs() && !motion("lift").runs());
    assert!(!motion("held").runs());
    assert!(matches!(motion("held"), Motion::Driven(_)));
}

/// A cut joint keeps its place in the tables, and its steps keep coordinates of their own.
#[test]
fn a_cut_joint_is_marked_and_the_tables_stay_consistent() {
    let mechanism = resolved(CLOSED_MECHANISM);
    let cut: Vec<String> =
        mechanism.joints.iter().filter(|joint| joint.cut).map(|joint| joint.name.to_string()).collect();
    assert_eq!(cut, ["lower", "ball", "plate"]);
    for (index, joint) in mechanism.joints.iter().enumerate() {
        for step in &joint.steps {
            let coordinate = &mechanism.coordinates[step.coordinate.index()];
            assert_eq!(coordinate.joint, JointId::new(index));
            if joint.cut {
                assert_eq!(coordinate.motion, Motion::Free);
            }
        }
    }
}

#[test]
fn reactions_are_those_of_joints_and_constraints() {
    let mechanism = resolved(CLOSED_MECHANISM);
    let id = |name: &str| {
        let all = &mechanism.constraints;
        let place = all.iter().position(|constraint| constraint.name == name);
        ConstraintId::new(place.expect("a constraint"))
    };
    for (output_name, constraint, component, unit) in [
        ("o1", "guide", 2, "N"),
        ("o2", "square", 4, "N*m"),
        ("o3", "rod", 0, "N"),
        ("o4", "mesh", 0, "N*m"),
        ("o5", "rack", 0, "N"),
        ("o6", "area", 0, "N/m"),
        ("o7", "contact", 1, "N"),
        ("o8", "pure", 0, "N*m"),
    ] {
        let output = output(&mechanism, output_name);
        let expected = Expr::ConstraintReaction(id(constraint), component);
        assert_eq!(output.value, expected, "{output_name}");
        assert_eq!(output.unit.symbol, unit, "{output_name}");
    }
    let lower = mechanism.joints.iter().position(|joint| joint.name == "lower");
    let lower = JointId::new(lower.expect("a joint"));
    assert_eq!(output(&mechanism, "o9").value, Expr::Reaction(lower, 3));
    let pull = output(&mechanism, "pull").value.leaves().len();
    assert_eq!(pull, 3, "the norm of a force of three components");
}

#[test]
fn the_speed_of_a_coasting_coordinate_is_an_output() {
    let mechanism = resolved(CLOSED_MECHANISM);
    for (name, of, unit) in [("speed", "forward", "m/s"), ("yawing", "yaw", "rad/s"), ("wheel_speed", "idle", "rad/s")]
    {
        let output = output(&mechanism, name);
        let id = coordinate(&mechanism, of);
        assert_eq!(output.value, Expr::Rate(id));
        assert_eq!(output.unit.symbol, unit);
        let quantity = mechanism.coordinates[id.index()].quantity;
        assert_eq!(quantity == CoordinateQuantity::Displacement, unit == "m/s");
    }
}

#[test]
fn the_text_of_a_mechanism_names_its_constraints() {
    let elements = resolved(CLOSED_MECHANISM).elements();
    let text: String =
        elements.iter().map(|element| format!("{}: {} {}\n", element.name, element.kind, element.law)).collect();
    for line in [
        "pin: coincident from elbow to knee along x, y, z\n",
        "guide: coincident from knee to elbow along x, z\n",
        "square: aligned from elbow to knee\n",
        "opposite: aligned from elbow to knee axis [0, -1, 0]\n",
        "rod: distance from elbow to anchor length (2 * l)\n",
        "belt: equation zero (spin - (2 * idle)) [rad]\n",
        "contact: rolling wheel hub axis [0, 1, 0] radius r on road normal [0, 0, 1]\n",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

/// `cut` and `coasting` are ordinary names where a name is expected.
#[test]
fn the_words_of_clauses_are_names_too() {
    let source = "mechanism Words {
        body a: point(mass: 1 kg); body b: point(mass: 1 kg); body c: point(mass: 1 kg);
        joint j: cylindrical(cut: y, coasting: y) from ground to a cut coasting, coasting driven at 0;
        joint k: cylindrical(u: y, v: y) from a to b at [0, 0, 1 m], v coasting;
        joint l: revolute(y) from b to ground cut at [0, 0, 1 m];
        joint m: revolute(y) from b to c at [0, 0, high] coasting;
        joint n: revolute(y) from c to ground at [0, 0, 0] cut;
        let high = 1 m;
    }";
    let ast = read(source);
    let text = print(&ast);
    assert_eq!(read(&text), ast, "{text}");
    for line in [
        "from ground to a, cut coasting, coasting driven at 0.0;",
        "from a to b at [0.0, 0.0, 1.0 m], v coasting;",
        "from b to ground, cut, at [0.0, 0.0, 1.0 m];",
        "from c to ground at [0.0, 0.0, 0.0], cut;",
        "from b to c at [0.0, 0.0, high], coasting;",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let mechanism = resolved(source);
    let motions: Vec<bool> =
        mechanism.coordinates.iter().map(|coordinate| coordinate.motion == Motion::Coasting).collect();
    assert_eq!(motions, [true, false, false, true, false, true, false]);
    assert!(mechanism.joints[2].cut && !mechanism.joints[0].cut);
}
