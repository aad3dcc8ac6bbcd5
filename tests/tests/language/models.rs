//! The random models and their declarations.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::mem::discriminant;

use eigentol_oracle::declaration::declaration;
use eigentol_oracle::examples::{
    anisotropic_bearing, blade, chain, jeffcott_in_the_ground, screw_pendulum, steadied_by_the_shaft, top, two_sliders,
};
use eigentol_oracle::model::{Amount, ForceLaw, Frame, Motion, ORIGIN, Shape, Value};
use eigentol_oracle::random::on_plans;

#[test]
fn a_chain_reads_as_a_person_would_write_it() {
    let expected = "\
pub mechanism Chain {
    input omega: rad/s;
    design l1 = 0.8 m;
    design l2 = 1.1 m;
    design m1 = 2.5 kg;
    design m2 = 3.7 kg;
    gravity [0.0, 0.0, -9.81] m/s^2;
    body shaft: massless;
    body bar1: rod(mass: m1, length: l1, along: -z);
    body bar2: rod(mass: m2, length: l2, along: -z);
    joint spin: revolute(z) from ground to shaft, driven at omega;
    joint theta1: revolute(y) from shaft to bar1;
    joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -1.0 * l1];
}
";
    assert_eq!(declaration(&chain(&[0.8, 1.1], &[2.5, 3.7])), expected);
}

#[test]
fn forces_of_sliders_have_the_units_of_displacements() {
    let text = declaration(&two_sliders([0.5, 40.0, 60.0, 0.1, 0.02, 0.3, 0.2]));
    for line in [
        "design kx = 40.0 N/m;",
        "design cx = 0.3 N*s/m;",
        "force spring_x: spring(on: along_x, stiffness: kx, rest: x0);",
        "force damper_y: damper(on: along_y, damping: cy);",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn several_coordinates_have_names_and_drives_of_their_own() {
    let particle = Shape::Point { mass: Value::Number(1.0), center: ORIGIN };
    for (model, line) in [
        (
            top(particle.clone(), ORIGIN),
            "joint pivot: spherical(precession: z, tilt: y, spin: z) from ground to top, \
             precession driven at Omega, spin driven at nu;",
        ),
        (blade(particle), "joint root: universal(flap: y, lag: z) from shaft to blade;"),
        (screw_pendulum(1.0, 0.5, 0.25 / TAU, 0.0), "joint theta: screw(x, lead: 0.25 m) from ground to nut;"),
        (
            jeffcott_in_the_ground(1.0, [2.0, 3.0], 0.1),
            "force force2: drag(at: point0, damping: 0.1 N*s/m, turning_damping: 0.3 N*m*s/rad);",
        ),
        (
            anisotropic_bearing(1.0, [2.0, 3.0]),
            "force force0: potential(energy: (0.5) * (2.0 N/m) * (position(point0).x)^2 \
             + (0.5) * (3.0 N/m) * (position(point0).y)^2);",
        ),
        (
            steadied_by_the_shaft(1.0, 2.0, 0.5, 0.1),
            "force force0: bushing(from: point0, to: point1, stiffness: [2.0, 2.0, 2.0] N/m, \
             damping: [0.5, 0.5, 0.5] N*s/m, turning_stiffness: [7.0, 7.0, 7.0] N*m/rad, \
             turning_damping: [0.4, 0.4, 0.4] N*m*s/rad);",
        ),
    ] {
        let text = declaration(&model);
        assert!(text.contains(line), "{line}: {text}");
    }
}

/// The generator produces everything it promises, and what it prints can be tokenised.
#[test]
fn random_models_leave_nothing_out() {
    let seen: RefCell<BTreeMap<String, usize>> = RefCell::default();
    let count = |what: String| *seen.borrow_mut().entry(what).or_default() += 1;
    on_plans(300, |plan| {
        let model = plan.model();
        let text = declaration(&model);
        let tokens: Result<proc_macro2::TokenStream, _> = text.parse();
        assert!(tokens.is_ok(), "{text}");

        count(format!("{} bodies", model.bodies.len()));
        count(format!("{} design variables", model.design.len()));
        count(format!("{} drives", model.driven().len()));
        for body in &model.bodies {
            count(format!("sum of {}", body.parts.len()));
            for part in &body.parts {
                count(format!("shape {:?}", discriminant(&part.shape)));
                match &part.shape {
                    Shape::Rod { center: Some(_), .. } => count("rod with a centre".to_owned()),
                    Shape::Rigid { about: Some(_), .. } => count("inertia elsewhere".to_owned()),
                    Shape::Tube { mass, .. } | Shape::Disk { mass, .. } if matches!(mass, Amount::Density(_)) => {
                        count("density".to_owned());
                    }
                    _ => {}
                }
                if part.hole {
                    count("hole".to_owned());
                }
            }
        }
        for joint in &model.joints {
            count(format!("joint {:?}", joint.word));
            let driven = joint.steps.iter().filter(|step| step.drive.is_some());
            let driven: Vec<_> = driven.collect();
            if driven.iter().any(|step| step.motion == Motion::Slide) {
                count("driven slider".to_owned());
            }
            if !driven.is_empty() {
                count(format!("driven {:?}", joint.word));
                if driven.len() < joint.steps.len() {
                    count("partly driven".to_owned());
                }
                if driven.len() > 1 {
                    count("several drives in one joint".to_owned());
                }
            }
        }
        for branch in model.tree() {
            if branch.reversed {
                let word = model.joints[branch.joint].word;
                count(format!("reversed {word:?}"));
                count("reversed joint".to_owned());
            }
            let children = model.tree().iter().filter(|b| b.parent == branch.parent).count();
            if branch.parent != Frame::Ground && children > 1 {
                count("fork".to_owned());
            }
        }
        for force in &model.forces {
            count(format!("force {:?}", discriminant(&force.law)));
            if let ForceLaw::Load { following, .. } = force.law {
                count(format!("load that follows: {following}"));
            }
            if let ForceLaw::SpringDamper { from, to, .. } = force.law {
                let ends = [model.points[from].frame, model.points[to].frame];
                let ground = ends.contains(&Frame::Ground);
                count(format!("spring between points, to the ground: {ground}"));
            }
        }
    });
    let seen = seen.into_inner();
    for (what, least) in [
        ("reversed joint", 50),
        ("fork", 50),
        ("driven slider", 20),
        ("hole", 50),
        ("density", 50),
        ("inertia elsewhere", 30),
        ("partly driven", 20),
        ("several drives in one joint", 20),
    ] {
        assert!(seen.get(what).is_some_and(|&count| count >= least), "{what}: {seen:#?}");
    }
    for (what, kinds) in [
        ("shape", 8),
        ("sum", 4),
        ("joint", 9),
        ("reversed ", 10),
        ("driven ", 9),
        ("force", 10),
        ("load", 2),
        ("spring between", 2),
    ] {
        let found = seen.keys().filter(|key| key.starts_with(what)).count();
        assert_eq!(found, kinds, "{what}: {seen:#?}");
    }
    for (what, range) in [("bodies", 1..=7), ("design variables", 1..=8), ("drives", 0..=3)] {
        for number in range {
            assert!(seen.contains_key(&format!("{number} {what}")), "{number} {what}: {seen:#?}");
        }
    }
}
