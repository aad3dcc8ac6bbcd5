//! The sign of reactions. Among the unknowns, in the report and as outputs, a reaction is the load of the `from` side
//! on the `to` side; for a distance it is the tension, for an equation the force in the direction in which its
//! expression grows. Each kind of constraint is checked by hand statics.

use eigentol::{Equilibrium, Input, Kernels, Policy, Study, mechanism};
use eigentol_tests::wheels::{PushedCart, RollingDisk};

const WEIGHT: f64 = 2.0 * 9.81;

/// The unknown that is the reaction of this name.
#[track_caller]
fn unknown(state: &Equilibrium, name: &str) -> f64 {
    let list = &state.description.coordinates;
    let place = list.iter().position(|unknown| unknown.name == name);
    let names: Vec<_> = list.iter().map(|unknown| &unknown.name).collect();
    state.coordinates[place.unwrap_or_else(|| panic!("no {name} among {names:?}"))]
}

/// Compares unknowns and report, then outputs, with the expected values.
#[track_caller]
fn check(study: &Study<impl Kernels>, unknowns: &[(&str, f64)], outputs: &[f64]) {
    let state = study.equilibrium().expect("an equilibrium");
    let report = state.to_string();
    for &(name, expected) in unknowns {
        let found = unknown(&state, name);
        assert!((found - expected).abs() < 1e-9 * WEIGHT, "{name}: {found}");
        let line = report.lines().find(|line| line.trim_start().starts_with(name));
        let line = line.unwrap_or_else(|| panic!("no {name} in\n{report}"));
        let value: f64 = line.split_whitespace().nth(2).expect("a value").parse().expect("a number");
        assert!((value - expected).abs() < 1e-5 * WEIGHT, "{line}");
    }
    let values = study.outputs().expect("outputs").values;
    for (k, expected) in outputs.iter().enumerate() {
        let name = &study.description().outputs[k].name;
        let off = (values[k] - expected).abs();
        assert!(off < 1e-9 * WEIGHT, "{name}: {}, not {expected}", values[k]);
    }
}

mechanism! {
    /// A weight in a hook that pulls it aside.
    mechanism Hooked {
        gravity 9.81 m/s^2 along -z;
        body carriage: massless;
        body weight: point(mass: 2 kg);
        joint x: prismatic(x) from ground to carriage;
        joint z: prismatic(z) from carriage to weight;
        point hook: ground;
        point ring: weight;
        constraint held: coincident(from: hook, to: ring, along: [x, z]);
        force wind: load(at: ring, force: [3, 0, 0] N);
        output aside = reaction_force(held).x;
        output up = reaction_force(held).z;
    }
}

mechanism! {
    /// The same, seen from the weight.
    mechanism HookedFromBelow {
        gravity 9.81 m/s^2 along -z;
        body carriage: massless;
        body weight: point(mass: 2 kg);
        joint x: prismatic(x) from ground to carriage;
        joint z: prismatic(z) from carriage to weight;
        point hook: ground;
        point ring: weight;
        constraint held: coincident(from: ring, to: hook, along: [x, z]);
        force wind: load(at: ring, force: [3, 0, 0] N);
        output aside = reaction_force(held).x;
        output up = reaction_force(held).z;
    }
}

#[test]
fn a_hook_pulls_a_weight_up_and_the_weight_pulls_the_hook_down() {
    let held = [("held.x", -3.0), ("held.z", WEIGHT)];
    check(&Study::new(Hooked), &held, &held.map(|(_, value)| value));
    let held = held.map(|(name, value)| (name, -value));
    check(&Study::new(HookedFromBelow), &held, &held.map(|(_, value)| value));
}

mechanism! {
    /// A weight on a rod.
    mechanism Pendulum {
        gravity 9.81 m/s^2 along -z;
        body carriage: massless;
        body weight: point(mass: 2 kg);
        joint x: prismatic(x) from ground to carriage;
        joint z: prismatic(z) from carriage to weight;
        point hook: ground;
        point ring: weight;
        constraint rod: distance(from: hook, to: ring, length: 0.5 m);
        output pull = reaction(rod);
    }
}

#[test]
fn a_rod_is_pulled_by_what_hangs_and_pushed_by_what_stands() {
    let study = Study::new(Pendulum).guess(Pendulum::z, -0.4);
    check(&study, &[("rod", WEIGHT)], &[WEIGHT]);
    let study = Study::new(Pendulum).guess(Pendulum::z, 0.4).policy(Policy::Nearest);
    check(&study, &[("rod", -WEIGHT)], &[-WEIGHT]);
}

mechanism! {
    /// A bar held level by what keeps its axes parallel to the ground's.
    mechanism Level {
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 2 kg, length: 0.6 m, along: x);
        joint hinge: revolute(y) from ground to bar;
        point floor: ground;
        point root: bar;
        constraint level: aligned(from: floor, to: root);
        output moment = reaction_moment(level).y;
    }
}

#[test]
fn the_moment_on_a_level_bar_turns_its_end_up() {
    // A positive moment about y turns x towards -z.
    let moment = -WEIGHT * 0.3;
    check(&Study::new(Level), &[("level.about_y", moment)], &[moment]);
}

mechanism! {
    /// A weight on a rope round a drum, which a spring holds.
    mechanism Hoist {
        gravity 9.81 m/s^2 along -z;
        body drum: cylinder(mass: 1 kg, radius: 0.2 m, length: 0.1 m, axis: y);
        body weight: point(mass: 2 kg);
        joint turn: revolute(y) from ground to drum;
        joint lift: prismatic(z) from ground to weight;
        constraint rope: coupling(of: lift, with: turn, ratio: 0.2 m);
        force spring: spring(on: turn, stiffness: 50 N*m/rad);
        output pull = reaction(rope);
        output sunk = lift;
    }
}

#[test]
fn a_coupling_pulls_in_the_direction_of_its_first_coordinate() {
    let sunk = -WEIGHT * 0.2 * 0.2 / 50.0;
    check(&Study::new(Hoist), &[("rope", WEIGHT)], &[WEIGHT, sunk]);
}

mechanism! {
    /// A weight at a height.
    mechanism Shelf {
        gravity 9.81 m/s^2 along -z;
        body weight: point(mass: 2 kg);
        joint lift: prismatic(z) from ground to weight;
        constraint height: equation(zero: lift - 0.3 m);
        output push = reaction(height);
    }
}

mechanism! {
    /// A weight at a height, measured from above.
    mechanism Hung {
        gravity 9.81 m/s^2 along -z;
        body weight: point(mass: 2 kg);
        joint lift: prismatic(z) from ground to weight;
        constraint depth: equation(zero: 0.3 m - lift);
        output push = reaction(depth);
    }
}

#[test]
fn an_equation_pushes_in_the_direction_in_which_its_expression_grows() {
    check(&Study::new(Shelf), &[("height", WEIGHT)], &[WEIGHT]);
    check(&Study::new(Hung), &[("depth", -WEIGHT)], &[-WEIGHT]);
}

mechanism! {
    /// A bar welded to a wall by a joint that is cut.
    mechanism Welded {
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 2 kg, length: 0.6 m, along: x);
        joint slide: planar(x: x, z: z, tilt: y) from ground to bar;
        joint weld: fixed from ground to bar, cut;
        output up = reaction_force(weld).z;
        output moment = reaction_moment(weld).y;
    }
}

mechanism! {
    /// A bar welded to a wall by a joint from the bar to the wall.
    mechanism WeldedFromBar {
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 2 kg, length: 0.6 m, along: x);
        joint slide: planar(x: x, z: z, tilt: y) from ground to bar;
        joint weld: fixed from bar to ground, cut;
        output up = reaction_force(weld).z;
        output moment = reaction_moment(weld).y;
    }
}

#[test]
fn a_cut_joint_has_the_sign_of_every_joint() {
    let (up, moment) = (WEIGHT, -WEIGHT * 0.3);
    let unknowns = [("weld.z", up), ("weld.about_y", moment)];
    check(&Study::new(Welded), &unknowns, &[up, moment]);
    let unknowns = unknowns.map(|(name, value)| (name, -value));
    check(&Study::new(WeldedFromBar), &unknowns, &[-up, -moment]);
}

#[test]
fn the_road_carries_a_wheel() {
    // Upright at rest: only the weight acts.
    let study = Study::new(RollingDisk).guess(RollingDisk::height, 0.25).policy(Policy::Nearest);
    let weight = 3.0 * 9.81;
    check(&study, &[("contact.normal", weight), ("contact.lateral", 0.0)], &[0.0, weight]);
    // On a circle to the left, the road pushes to the left.
    let study = study.input(Input::new(0), 4.0).input(Input::new(1), 0.2);
    let state = study.equilibrium().expect("an equilibrium");
    let values = study.outputs().expect("outputs").values;
    let (aside, up) = (values[0], values[1]);
    assert!((unknown(&state, "contact.lateral") - aside).abs() < 1e-9 * weight);
    assert!((unknown(&state, "contact.normal") - up).abs() < 1e-9 * weight);
    assert!(aside > 1.0 && (up - weight).abs() < 1e-9 * weight);
    // A push against drag, which the wheel, free on its axle, does not transmit.
    let state = Study::new(PushedCart).input(Input::new(0), 2.0).equilibrium().expect("an equilibrium");
    assert!(unknown(&state, "contact.forward").abs() < 1e-9);
}
