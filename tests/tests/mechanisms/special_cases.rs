//! Special cases of the compiler in which a deliberately wrong line went undetected: each is now compared
//! with an independent number.

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::{Damping, Limits};

/// Evaluates a kernel of a declaration at its nominal design.
fn at_nominal(declaration: &str, kernel: &str, before: &[&[f64]]) -> Vec<Vec<f64>> {
    let compiled =
        compile(declaration.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let design = compiled.mechanism.design.iter();
    let nominal: Vec<f64> = design.map(|one| one.nominal).collect();
    let arguments = [before, &[&nominal]].concat();
    let found = compiled.program.evaluate(kernel, &arguments);
    found.expect("a kernel")
}

fn assert_equal(values: &[Vec<f64>], expected: &[Vec<f64>]) {
    for (one, other) in values.concat().into_iter().zip(expected.concat()) {
        assert!((one - other).abs() < 1e-13, "{one} {other}");
    }
}

/// Two links, each on one hinge, and the items that close the loop between their ends.
fn closed(closing: &str) -> String {
    format!(
        "pub mechanism Loop {{
            design l = 1 m;
            design e = 0 m;
            design f = 0 m;
            gravity 9.81 m/s^2 along -z;
            body left: rod(mass: 1 kg, length: l, along: -z);
            body right: box(mass: 2 kg, size: [0.1, 0.2, 0.7] m);
            joint a: universal(a1: x, a2: y) from ground to left;
            joint b: universal(b1: y, b2: z) from ground to right at [0.3, 0, 0] m;
            point eye: left at [0, 0, -l];
            point bolt: right at [0.1, 0.2, -0.3] m;
            {closing}
        }}"
    )
}

/// An axis that may be misaligned, by two variables that are nominally zero: perpendicular directions exist
/// nevertheless.
#[test]
fn an_axis_nominally_along_x_may_be_tilted() {
    let state: [&[f64]; 2] = [&[0.3, -0.4, 0.5, 0.2, 1.1, -0.7, 0.6, 0.9, -1.2], &[]];
    let joint = |kind: &str, axis: &str| {
        closed(&format!(
            "joint c: {} from left to right at [0, 0, -l], at [0.1, 0.2, -0.3] m on right, cut;",
            kind.replace("AXIS", axis)
        ))
    };
    let revolute = "revolute(AXIS)";
    let values = at_nominal(&joint(revolute, "[l, e, f]"), "residual", &state);
    assert!(values.concat().iter().all(|x| x.is_finite()), "{values:?}");
    assert_equal(&values, &at_nominal(&joint(revolute, "x"), "residual", &state));
}

fn messages(declaration: &str) -> Vec<String> {
    match compile(declaration.parse().expect("tokens"), Limits::NONE) {
        Ok(_) => Vec::new(),
        Err(mistakes) => mistakes.iter().map(|one| one.message.clone()).collect(),
    }
}

/// A thin bar that rotates about its own axis moves no mass, in any orientation: the rounding residue of its moment of
/// inertia does not count.
#[test]
fn a_bar_that_turns_about_itself_has_no_inertia() {
    let lengths = [-3.0, -1.0, 0.3, 0.7, 2.0];
    for (x, y, z) in lengths.iter().flat_map(|x| lengths.map(|y| (x, y))).flat_map(|(x, y)| lengths.map(|z| (x, y, z)))
    {
        let along = format!("[{x}, {y}, {z}]");
        let alone = format!(
            "mechanism Bar {{
                design l = 1 m;
                body bar: rod(mass: 1 kg, length: l, along: {along});
                joint spin: revolute({along}) from ground to bar;
                force hold: spring(on: spin, stiffness: 1 N*m/rad);
            }}"
        );
        let found = messages(&alone);
        assert_eq!(found.len(), 1, "{along}");
        assert!(found[0].starts_with("no mass moves when only `spin` changes"), "{found:?}");
    }
}

/// A car that coasts along x on a sledge that slides obliquely: the sledge carries the car's mass, and its acceleration
/// acts on the car.
#[test]
fn a_coasting_slide_loads_what_carries_it() {
    let text = "mechanism Sledge {
        body sledge: point(mass: 5 kg);
        body car: point(mass: 2 kg);
        joint s: prismatic([3, 4, 0]) from ground to sledge;
        joint x: prismatic(x) from sledge to car, coasting;
        force hold: spring(on: s, stiffness: 30 N/m);
        force drag: damper(on: x, damping: 0.5 N*s/m);
    }";
    let [s, speed] = [0.2, 3.0];
    let [s_growth, s_rate, speed_rate] = [1.1, 0.7, -0.4];
    let arguments: [&[f64]; 4] = [&[s_growth, 0.0], &[s_rate, speed_rate], &[s, speed], &[]];
    let values = at_nominal(text, "motion_residual", &arguments);
    // 3/5 of a unit along the sledge's path is along x
    let sledge = 7.0 * s_growth + 2.0 * 0.6 * speed_rate + 30.0 * s;
    let car = 2.0 * (speed_rate + 0.6 * s_growth) + 0.5 * speed;
    assert_equal(&values, &[vec![sledge, car]]);
}

/// A light slider between two springs carries a body 1e8 times heavier: numerically difficult, but regular.
#[test]
fn a_light_body_below_a_heavy_one_has_its_mass() {
    let text = "mechanism Light {
        body light: point(mass: 1 g);
        body heavy: point(mass: 100 t);
        joint a: prismatic(x) from ground to light;
        joint b: prismatic(x) from light to heavy;
        force first: spring(on: a, stiffness: 1 N/m);
        force second: spring(on: b, stiffness: 1 N/m);
    }";
    let values = at_nominal(text, "linear", &[&[0.0; 2], &[]]);
    let [light, heavy] = [1e-3, 1e5];
    assert_eq!(values[0], [light + heavy, heavy, heavy, heavy]);
}

/// A thin bar that spins about itself moves no mass, but it is geared to a swing: the mass matrix then need not be
/// regular.
#[test]
fn constraints_stand_for_mass() {
    let text = |gear: &str| {
        format!(
            "mechanism Drill {{
                gravity 9.81 m/s^2 along -z;
                body arm: rod(mass: 1 kg, length: 1 m, along: -z);
                body bit: rod(mass: 1 kg, length: 1 m, along: x);
                joint swing: revolute(y) from ground to arm;
                joint spin: revolute(x) from arm to bit;
                force hold: spring(on: spin, stiffness: 1 N*m/rad);
                {gear}
            }}"
        )
    };
    let found = messages(&text(""));
    assert!(found[0].starts_with("no mass moves when only `spin` changes"), "{found:?}");
    let geared = text("constraint gear: coupling(of: spin, with: swing, ratio: 3);");
    let mass = &at_nominal(&geared, "linear", &[&[0.2, 0.6, 1.5], &[]])[0];
    // two bars about their ends
    let expected = [2.0 / 3.0, 0.0, 0.0];
    assert_equal(&[mass[..3].to_vec()], &[expected.to_vec()]);
    assert_eq!(mass[3..], [0.0; 6]);
}

/// If one of two pendulums depends on the position of the drive, there is no steady state.
#[test]
fn one_equation_that_depends_on_a_drive_leaves_no_steady_state() {
    let found = messages(
        "mechanism Two {
            input speed: rad/s;
            gravity 9.81 m/s^2 along -x;
            body free: rod(mass: 1 kg, length: 1 m, along: -z);
            body shaft: massless;
            body bar: rod(mass: 1 kg, length: 1 m, along: -z);
            joint a: revolute(y) from ground to free;
            joint turn: revolute(z) from ground to shaft, driven at speed;
            joint b: revolute(y) from shaft to bar;
        }",
    );
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0]
            .starts_with("the equations of motion depend on the driven coordinate `turn`, so there is no steady state"),
        "{found:?}"
    );
}

/// A car whose body frame is rotated relative to its joint is equivalent to one whose body is rotated in its frame.
#[test]
fn a_gliding_body_may_be_placed_anyhow() {
    let car = |shapes: &str, text: &str| {
        format!(
            "mechanism Car {{
                body car: {shapes};
                joint drive: planar(forward: x, side: y, yaw: z) from ground to car{text}, coasting;
                force a: damper(on: forward, damping: 2 N*s/m);
                force b: damper(on: side, damping: 3 N*s/m);
                force c: damper(on: yaw, damping: 5 N*m*s/rad);
            }}"
        )
    };
    let turned = car(
        "box(mass: 3 kg, size: [0.7, 0.2, 0.4] m, center: [1, 0.3, 0.2] m)",
        " at [0, 0, 0], at [0.1, 0.2, 0] m rotated(x, 90 deg) on car",
    );
    let upright = car("box(mass: 3 kg, size: [0.7, 0.4, 0.2] m, center: [0.9, 0.2, -0.1] m)", "");
    let state: [&[f64]; 4] = [&[0.0; 3], &[0.4, -0.3, 0.9], &[1.2, 0.7, -0.5], &[]];
    let [one, other] = [&turned, &upright].map(|text| at_nominal(text, "motion_residual", &state));
    assert_equal(&one, &other);
    let [one, other] = [turned, upright].map(|text| at_nominal(&text, "linear", &state[2..]));
    assert_equal(&one, &other);
}

/// A joint declared from the body towards the ground, with shifted and rotated frames, transmits the opposite
/// reaction, as seen from the body.
#[test]
fn a_reversed_joint_transmits_the_opposite() {
    let arm = |joint: &str| {
        format!(
            "mechanism Arm {{
                gravity 9.81 m/s^2 along -z;
                body arm: box(mass: 3 kg, size: [0.7, 0.2, 0.4] m, center: [1, 0.3, 0.2] m);
                joint hinge: revolute(z) {joint};
                output fx = reaction_force(hinge).x;
                output fy = reaction_force(hinge).y;
                output fz = reaction_force(hinge).z;
                output mx = reaction_moment(hinge).x;
                output my = reaction_moment(hinge).y;
                output mz = reaction_moment(hinge).z;
            }}"
        )
    };
    let ground = "[0.2, 0.5, 0] m rotated(y, 70 deg) rotated(x, 25 deg) on ground";
    let body = "[0.3, -0.1, 0.4] m rotated(x, 35 deg) rotated(y, 20 deg) on arm";
    let forward = arm(&format!("from ground to arm at {ground}, at {body}"));
    let reversed = arm(&format!("from arm to ground at {body}, at {ground}"));
    let angle = 0.6_f64;
    let on_arm = at_nominal(&forward, "outputs", &[&[angle], &[]]).concat();
    let on_ground = at_nominal(&reversed, "outputs", &[&[-angle], &[]]).concat();
    let (sine, cosine) = angle.sin_cos();
    let seen = on_arm.chunks(3).flat_map(|v| {
        let [x, y, z] = [v[0], v[1], v[2]];
        [-cosine * x - sine * y, sine * x - cosine * y, -z]
    });
    assert!(on_arm.iter().all(|x| x.abs() > 0.1), "{on_arm:?}");
    assert_equal(&[on_ground], &[seen.collect()]);
}

/// Loop reactions are derivatives of the loop equations, also where these are not satisfied: with only springs and
/// weights, `Khat` is symmetric everywhere.
#[test]
fn loops_of_every_kind_have_a_symmetric_stiffness() {
    let kinds = [
        "fixed",
        "revolute([1, 2, 2])",
        "prismatic([1, 2, 2])",
        "cylindrical(s: [1, 2, 2], t: [1, 2, 2])",
        "universal(s: x, t: [1, 2, 2])",
        "planar(s: x, t: y, r: z)",
        "spherical(s: x, t: y, r: z)",
    ];
    let joints = kinds
        .map(|kind| format!("joint c: {kind} from left to right at [0, 0, -l], at [0.1, 0.2, -0.3] m on right, cut;"));
    let constraints = [
        "coincident(from: eye, to: bolt, along: [x, z])",
        "aligned(from: eye, to: bolt)",
        "aligned(from: eye, to: bolt, axis: [1, 2, 2])",
        "distance(from: eye, to: bolt, length: 0.4 m)",
    ];
    let constraints = constraints.map(|law| format!("constraint c: {law};"));
    for closing in joints.into_iter().chain(constraints) {
        let text = closed(&closing);
        let compiled = compile(text.parse().expect("tokens"), Limits::NONE)
            .unwrap_or_else(|mistakes| panic!("{closing}: {mistakes}"));
        let properties = compiled.functions.properties;
        assert!(properties.symmetric_stiffness, "{closing}");
    }
}

/// A direction rotated by an angle about a perpendicular one is tilted from itself by that angle, also by nearly half a
/// turn.
#[test]
fn a_tilt_is_an_angle() {
    let text = "mechanism Tilt {
        body arm: box(mass: 2 kg, size: [0.1, 0.2, 0.7] m);
        joint turn: revolute([2, -1, 0]) from ground to arm;
        force hold: spring(on: turn, stiffness: 1 N*m/rad);
        point eye: ground;
        point bolt: arm;
        constraint c: aligned(from: eye, to: bolt, axis: [1, 2, 2]);
    }";
    for angle in [0.1_f64, 0.8, -1.4, 2.0, 3.0] {
        let found = at_nominal(text, "residual", &[&[angle, 0.0, 0.0], &[]]).concat();
        let tangents = found[1..].iter().map(|tilt| tilt.tan().powi(2));
        let square = angle.tan().powi(2);
        let difference = tangents.sum::<f64>() - square;
        assert!(difference.abs() < 1e-12 * square, "{found:?}");
        let is_obtuse = |tilt: &f64| tilt.cos() < 0.0;
        assert_eq!(found[1..].iter().all(is_obtuse), angle.cos() < 0.0);
    }
}

/// The Newton-Euler equations in rotating axes: `a = dv/dt + omega x v`.
#[test]
fn a_gliding_body_turns_its_velocity() {
    let text = "mechanism Car {
        body car: box(mass: 3 kg, size: [0.7, 0.4, 0.2] m);
        joint drive: planar(forward: x, side: y, yaw: z) from ground to car, coasting;
        force a: damper(on: forward, damping: 2 N*s/m);
        force b: damper(on: side, damping: 3 N*s/m);
        force c: damper(on: yaw, damping: 5 N*m*s/rad);
    }";
    let ([forward, side, yaw], [to_forward, to_side, to_yaw]) = ([1.2, 0.7, -0.5], [0.4, -0.3, 0.9]);
    let state: [&[f64]; 4] = [&[0.0; 3], &[to_forward, to_side, to_yaw], &[forward, side, yaw], &[]];
    let values = at_nominal(text, "motion_residual", &state);
    let expected = [
        3.0 * (to_forward - yaw * side) + 2.0 * forward,
        3.0 * (to_side + yaw * forward) + 3.0 * side,
        3.0 * (0.49 + 0.16) / 12.0 * to_yaw + 5.0 * yaw,
    ];
    assert_equal(&values, &[expected.to_vec()]);
}

/// Half the moment of inertia about the shaft times its squared speed, for a body whose origin moves on a circle.
#[test]
fn a_body_off_the_shaft_has_its_kinetic_energy() {
    let text = "mechanism Turntable {
        input speed: rad/s;
        body table: massless;
        body load: box(mass: 3 kg, size: [0.7, 0.4, 0.2] m, center: [0.4, 0.1, 0] m)
            + sphere(mass: 2 kg, radius: 0.3 m);
        joint turn: revolute(z) from ground to table, driven at speed;
        joint slide: prismatic(x) from table to load at [0.3, 0, 0] m;
        force hold: spring(on: slide, stiffness: 1 kN/m);
        output energy = kinetic_energy();
    }";
    let (slide, speed) = (0.25_f64, 1.7_f64);
    let values = at_nominal(text, "outputs", &[&[slide], &[speed]]);
    let (ball, centre) = (0.3 + slide, 0.7 + slide);
    let of_box = 3.0 * (centre * centre + 0.01 + (0.49 + 0.16) / 12.0);
    let of_sphere = 2.0 * (ball * ball + 0.4 * 0.09);
    let energy = 0.5 * (of_box + of_sphere) * speed * speed;
    assert_equal(&values, &[vec![energy]]);
}

/// A weight on a lever, seen from the hinge: about neither the origin of the body nor its centre.
#[test]
fn a_reaction_moment_is_about_the_joint() {
    let text = "mechanism Lever {
        gravity 10 m/s^2 along -z;
        body arm: box(mass: 3 kg, size: [0.7, 0.2, 0.4] m, center: [1, 0.3, 0.2] m);
        joint hinge: revolute(y) from ground to arm at [0, 0, 0], at [0.2, -0.1, 0.5] m on arm;
        output mx = reaction_moment(hinge).x;
        output my = reaction_moment(hinge).y;
        output mz = reaction_moment(hinge).z;
    }";
    let values = at_nominal(text, "outputs", &[&[0.0], &[]]);
    assert_equal(&values, &[vec![0.4 * 30.0, -0.8 * 30.0, 0.0]]);
}

/// Two halves of a box are equivalent to the box.
#[test]
fn a_body_of_two_pieces_whirls_as_one() {
    let rotor = |shapes: &str| {
        format!(
            "mechanism Rotor {{
                input speed: rad/s;
                body outer: massless;
                body inner: massless;
                body wheel: {shapes};
                joint alpha: revolute(x) from ground to outer;
                joint beta: revolute(y) from outer to inner;
                joint spin: revolute(z) from inner to wheel, driven at speed;
                force hold_alpha: spring(on: alpha, stiffness: 40 N*m/rad);
                force hold_beta: spring(on: beta, stiffness: 40 N*m/rad);
            }}"
        )
    };
    let whole = rotor("box(mass: 2 kg, size: [0.6, 0.6, 0.4] m, center: [0, 0, 0.3] m)");
    let halves = rotor(
        "box(mass: 1 kg, size: [0.6, 0.6, 0.2] m, center: [0, 0, 0.2] m)
            + box(mass: 1 kg, size: [0.6, 0.6, 0.2] m, center: [0, 0, 0.4] m)",
    );
    let whirl = |text: &str| {
        let compiled =
            compile(text.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let arguments: [&[f64]; 5] = [&[0.0; 2], &[3.0], &[], &[1.0, 0.2], &[0.1, -0.7]];
        let found = compiled.program.evaluate("whirl", &arguments);
        found.expect("it turns")
    };
    let values = whirl(&halves);
    assert!(values.concat()[..2].iter().all(|x| x.abs() > 0.1), "{values:?}");
    assert_equal(&values, &whirl(&whole));
}

/// The height of a ball above a sloping plane, and the force that the plane exerts on it: the one that moves its
/// centre.
#[test]
fn a_ball_on_a_slope_is_held_by_the_slope() {
    let slope = |placed: &str| {
        format!(
            "mechanism Ball {{
                body ball: sphere(mass: 2 kg, radius: 0.1 m);
                joint loose: free(x: x, y: y, z: z, a: z, b: y, c: x) from ground to ball;
                force hold_x: spring(on: x, stiffness: 1 N/m);
                force hold_y: spring(on: y, stiffness: 1 N/m);
                force hold_a: spring(on: a, stiffness: 1 N*m/rad);
                force hold_b: spring(on: b, stiffness: 1 N*m/rad);
                force hold_c: spring(on: c, stiffness: 1 N*m/rad);
                point road: ground at [0.1, 0.2, 0.3] m {placed};
                point centre: ball;
                constraint contact: rolling(wheel: centre, radius: 0.1 m, on: road);
                output fx = reaction_force(contact).x;
                output fy = reaction_force(contact).y;
                output fz = reaction_force(contact).z;
            }}"
        )
    };
    let state: [&[f64]; 2] = [&[0.5, 0.9, 0.7, 0.0, 0.0, 0.0, 1.1, -0.6, 0.8], &[]];
    let values = at_nominal(&slope("rotated(x, 30 deg)"), "residual", &state);
    // the gap is the penetration of the ball into the plane
    let height = 0.7 * -0.5 + 0.4 * 0.75_f64.sqrt() - 0.1;
    assert_equal(&[vec![values[0][6]]], &[vec![-height]]);

    let force = at_nominal(&slope(""), "outputs", &state);
    let residual = &at_nominal(&slope(""), "residual", &state)[0];
    let expected = vec![0.5 - residual[0], 0.9 - residual[1], -residual[2]];
    assert_equal(&force, std::slice::from_ref(&expected));
    // about z, y, x: the force acts at the contact point
    let moment = vec![0.0, 0.1 * expected[0], -0.1 * expected[1]];
    assert_equal(&[residual[3..6].to_vec()], &[moment]);
}

/// A follower force makes the stiffness asymmetric, however stiff the springs beside it.
#[test]
fn a_small_asymmetry_is_none_of_rounding() {
    let column = |thrust: &str| {
        let text = format!(
            "mechanism Column {{
                body lower: rod(mass: 1 kg, length: 1 m, along: z);
                body upper: rod(mass: 1 kg, length: 1 m, along: z);
                joint a: revolute(y) from ground to lower;
                joint b: revolute(y) from lower to upper at [0, 0, 1] m;
                force stiff: spring_damper(from: tip, to: hook, stiffness: 1e10 N/m);
                point hook: ground at [3 m, 0, 0];
                force soft: spring(on: a, stiffness: 1 N*m/rad);
                point tip: upper at [0, 0, 1 m];
                force thrust: follower(at: tip, force: [0, 0, {thrust}] N);
            }}"
        );
        let compiled =
            compile(text.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        compiled.functions.properties.symmetric_stiffness
    };
    assert!(column("0"));
    assert!(!column("-1"));
}

/// Principal minors of `tr(J)/2 1 - J` about the centre of mass, wherever it is.
#[test]
fn requirements_of_an_inertia_are_its_minors() {
    let text = "mechanism Rigid {
        design j = 1 kg*m^2;
        body one: rigid(mass: 3 kg, center: [0.4, -0.7, 0.5] m,
            inertia: [4 * j, 5 * j, 6 * j, 0.3 * j, 0.7 * j, -0.9 * j]);
        joint turn: revolute(x) from ground to one;
        force hold: spring(on: turn, stiffness: 1 N*m/rad);
    }";
    let found = at_nominal(text, "violation", &[&[]]).concat();
    let (a, b, c): (f64, f64, f64) = (3.5, 2.5, 1.5);
    let (xy, yz, xz): (f64, f64, f64) = (-0.3, -0.7, 0.9);
    let determinant = a * b * c + 2.0 * xy * yz * xz - a * yz * yz - b * xz * xz - c * xy * xy;
    let minors = [a * b - xy * xy, b * c - yz * yz, a * c - xz * xz];
    let expected = [&[a, b, c][..], &minors, &[determinant]].concat();
    assert_eq!(found.len(), expected.len());
    for (one, other) in found.iter().zip(expected) {
        assert!((one - other).abs() < 1e-6, "{found:?}");
    }
}

/// Only joints with three rotations have singular poses.
#[test]
fn slides_have_no_singular_pose() {
    let poses = |kind: &str, slides: &[&str], turns: &[&str]| {
        let spring = |unit: &'static str| {
            move |name: &&str| format!("force on_{name}: spring(on: {name}, stiffness: 1 {unit});")
        };
        let slides = slides.iter().map(spring("N/m"));
        let springs: String = slides.chain(turns.iter().map(spring("N*m/rad"))).collect();
        let text = format!(
            "mechanism Loose {{
                body one: box(mass: 1 kg, size: [0.1, 0.2, 0.3] m);
                joint hold: {kind} from ground to one;
                {springs}
            }}"
        );
        let compiled =
            compile(text.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        compiled.functions.poses.len()
    };
    assert_eq!(poses("planar(s: x, t: y, a: z)", &["s", "t"], &["a"]), 0);
    let free = "free(s: x, t: y, r: z, a: z, b: y, c: x)";
    assert_eq!(poses(free, &["s", "t", "r"], &["a", "b", "c"]), 1);
}

/// A welded body counts at its actual position: two masses of 1 kg, each 1 m from their common centre.
#[test]
fn requirements_of_welded_bodies_are_about_their_centre() {
    let text = "mechanism Welded {
        design j = 1 kg*m^2;
        body one: rigid(mass: 1 kg, inertia: [j, j, 3 * j]);
        body two: point(mass: 1 kg);
        joint turn: revolute(x) from ground to one;
        joint weld: fixed from one to two at [0, 0, 2] m;
        force hold: spring(on: turn, stiffness: 1 N*m/rad);
    }";
    let found = at_nominal(text, "violation", &[&[]]).concat();
    assert_eq!(found.len(), 3);
    assert!(found.iter().all(|x| (x - 1.5).abs() < 1e-6), "{found:?}");
}

/// Hinges about the `y` axes of their frames are not parallel if the body between them is rotated: compared with the
/// same two bodies, their frames aligned with the first joint.
#[test]
fn hinges_on_a_turned_body_are_no_run() {
    let arm = |first: &str, text: &str, axis: &str, seat: &str, second: &str| {
        format!(
            "mechanism Arm {{
                gravity 9.81 m/s^2 along -z;
                body one: {first};
                body two: {second};
                joint a: revolute(y) from ground to one{text};
                joint b: revolute({axis}) from one to two at {seat} m;
            }}"
        )
    };
    let turned = arm(
        "box(mass: 3 kg, size: [0.7, 0.2, 0.4] m, center: [1, 0.3, 0.2] m)",
        " at [0, 0, 0], at [0, 0, 0] rotated(x, 90 deg) on one",
        "y",
        "[0.5, 0.1, 0.2]",
        "box(mass: 2 kg, size: [0.3, 0.6, 0.1] m, center: [0.4, -0.2, 0.8] m)",
    );
    let along = arm(
        "box(mass: 3 kg, size: [0.7, 0.4, 0.2] m, center: [1, 0.2, -0.3] m)",
        "",
        "-z",
        "[0.5, 0.2, -0.1]",
        "box(mass: 2 kg, size: [0.3, 0.1, 0.6] m, center: [0.4, 0.8, 0.2] m)",
    );
    let state: [&[f64]; 4] = [&[0.9, -0.4], &[0.5, 1.3], &[0.3, 0.8], &[]];
    let [one, other] = [turned, along].map(|text| at_nominal(&text, "motion_residual", &state));
    assert_equal(&one, &other);
}

/// The reaction of a cut joint is the only load on an otherwise free body; it is reported at the joint, along the
/// joint's axes.
#[test]
fn a_cut_joint_exerts_what_moves_the_body() {
    let outputs: String = ["force", "moment"]
        .iter()
        .flat_map(|kind| ["x", "y", "z"].map(|axis| (kind, axis)))
        .map(|(kind, axis)| format!("output {kind}_{axis} = reaction_{kind}(hold).{axis};"))
        .collect();
    let text = format!(
        "mechanism Held {{
            body one: box(mass: 2 kg, size: [0.1, 0.2, 0.3] m);
            joint loose: free(x: x, y: y, z: z, a: z, b: y, c: x) from ground to one;
            joint hold: fixed from ground to one at [0.1, 0.2, 0.3] m rotated(x, 30 deg), cut;
            {outputs}
        }}"
    );
    let place = [0.5, 0.9, 0.7];
    let reactions = [1.1, -0.6, 0.8, 0.3, -0.7, 0.4];
    let q = [&place[..], &[0.0; 3], &reactions].concat();
    let found = at_nominal(&text, "outputs", &[&q, &[]]).concat();
    let residual = &at_nominal(&text, "residual", &[&q, &[]])[0];
    // about the origin of the body, whose angles are about z, y, x
    let force = [0, 1, 2].map(|k| -residual[k]);
    let [x, y, z] = [0.4, 0.7, 0.4];
    let moment = [
        y * force[2] - z * force[1] - residual[5],
        z * force[0] - x * force[2] - residual[4],
        x * force[1] - y * force[0] - residual[3],
    ];
    let (sine, cosine) = (0.5, 0.75_f64.sqrt());
    let along = |[x, y, z]: [f64; 3]| [x, cosine * y + sine * z, cosine * z - sine * y];
    let expected = [along(force), along(moment)].concat();
    assert!(expected.iter().all(|x| x.abs() > 0.01), "{expected:?}");
    assert_equal(&[found], &[expected]);
}

/// A pendulum without speed-dependent terms, one made gyroscopic by a rotor, and one with a damper.
#[test]
fn damping_is_of_three_kinds() {
    let damping = |speed: &str, damper: &str| {
        let text = format!(
            "mechanism Rotor {{
                input speed: rad/s;
                body outer: massless;
                body inner: massless;
                body wheel: disk(mass: 2 kg, radius: 0.3 m, axis: z, center: [0, 0, 0.2 m]);
                joint alpha: revolute(x) from ground to outer;
                joint beta: revolute(y) from outer to inner;
                joint spin: revolute(z) from inner to wheel, driven at {speed};
                force hold_alpha: spring(on: alpha, stiffness: 40 N*m/rad);
                force hold_beta: spring(on: beta, stiffness: 40 N*m/rad);
                {damper}
            }}"
        );
        let compiled =
            compile(text.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        compiled.functions.properties.damping
    };
    assert_eq!(damping("0 * speed", ""), Damping::Zero);
    assert_eq!(damping("speed", ""), Damping::Gyroscopic);
    let damper = "force slow: damper(on: beta, damping: 1e-9 N*m*s/rad);";
    assert_eq!(damping("speed", damper), Damping::General);
}
