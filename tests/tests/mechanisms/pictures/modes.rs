//! Modes as sequences of poses: position, amplitude, and closed loops.

use eigentol::picture::{ModePictures, Pose, Scene, scene};
use eigentol::{Error, Excitation, Input, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::rotating_double_pendulum::RotatingDoublePendulum;
use eigentol_tests::loops::SliderCrank;
use eigentol_tests::machines::JeffcottRotor;

use crate::pictures::space::{Vector, add, dot, norm, scaled, subtract};

/// The position of a point of a body in a frame of a mode.
fn place(frame: &[Pose], body: usize, vector: Vector) -> Vector {
    frame[body].place(vector)
}

fn double_pendulum() -> Study<RotatingDoublePendulum> {
    Study::new(RotatingDoublePendulum)
        .input(RotatingDoublePendulum::omega, 4.0)
        .start(RotatingDoublePendulum::theta1, 0.9)
}

#[test]
fn frames_are_scenes_along_the_shape() {
    let study = double_pendulum();
    let at = study.equilibrium().expect("modes");
    let modes = study.modes().expect("modes");
    for mode in 0..2 {
        let swing = study.mode_pictures(mode, 8, 0.1).expect("a swing");
        assert_eq!((swing.mode, swing.frames.len()), (mode, 8));
        for (k, frame) in swing.frames.iter().enumerate() {
            let angle = std::f64::consts::TAU * k as f64 / 8.0;
            let shape = &modes.modes[mode].shape;
            let q: Vec<f64> =
                (at.coordinates.iter().zip(shape)).map(|(q, phi)| q + swing.amplitude * angle.cos() * phi.re).collect();
            let there = scene(study.mechanism(), &q, &at.inputs, &at.design).expect("a scene");
            for (pose, body) in frame.iter().zip(&there.bodies) {
                let apart = norm(subtract(pose.position, body.pose.position));
                assert!(apart < 1e-14, "mode {mode}, frame {k}: {apart}");
            }
        }
    }
}

/// To first order: for a small share the tip moves by the requested amount, whatever the mode.
#[test]
fn what_moves_most_moves_by_the_share_of_the_size() {
    let study = double_pendulum();
    let rest = study.picture().expect("a picture");
    for mode in 0..2 {
        let share = 1e-4;
        let swing = study.mode_pictures(mode, 4, share).expect("a swing");
        let tips = rest.bodies.iter().enumerate().flat_map(|(body, shown)| {
            shown.solids.iter().flat_map(move |solid| {
                // The bar of this machine hangs from the origin of its body.
                let end = scaled(2.0, solid.center);
                [(body, end), (body, [0.0; 3])]
            })
        });
        let farthest = tips.map(|(body, end)| {
            let moved = place(&swing.frames[0], body, end);
            norm(subtract(moved, rest.place(Some(body), end)))
        });
        let farthest = farthest.fold(0.0, f64::max);
        let expected = share * rest.size();
        assert!((farthest / expected - 1.0).abs() < 1e-3, "{farthest} {expected}");
    }
}

/// The two sides of every revolute joint meet in every frame, and the slider stays on its guide.
#[test]
fn loops_stay_closed() {
    let study = Study::new(SliderCrank).input(SliderCrank::omega, 3.0).start(SliderCrank::crank_angle, 0.6);
    let rest = study.picture().expect("a picture");
    let swing = study.mode_pictures(0, 12, 0.1).expect("a swing");
    assert!(rest.joints.iter().any(|joint| joint.closes_loop));
    let mut most = 0.0_f64;
    for frame in &swing.frames {
        let moved = with(&rest, frame);
        for joint in &moved.joints {
            let ends = [joint.from, joint.to].map(|seat| moved.place(seat.body, seat.place));
            let gap = subtract(ends[1], ends[0]);
            let gap = match &*joint.kind {
                "revolute" => norm(gap),
                _ => gap[1].hypot(gap[2]),
            };
            assert!(gap < 1e-9, "{}: {gap}", joint.name);
        }
        for (pose, body) in frame.iter().zip(&rest.bodies) {
            most = most.max(norm(subtract(pose.position, body.pose.position)));
        }
    }
    let share = most / rest.size();
    assert!((0.05..0.15).contains(&share), "{share}");
}

fn with(scene: &Scene, frame: &[Pose]) -> Scene {
    let mut moved = scene.clone();
    for (body, pose) in moved.bodies.iter_mut().zip(frame) {
        body.pose = *pose;
    }
    moved
}

/// Both modes of the rotor are circular, in opposite senses as seen from the ground relative to the shaft: the centre
/// keeps its distance from its equilibrium position and turns by a right angle in a quarter period.
#[test]
fn whirling_shapes_circle() {
    let study = Study::new(JeffcottRotor).input(JeffcottRotor::speed, 50.0);
    let modes = study.modes().expect("modes");
    let rest = study.picture().expect("a picture");
    for mode in 0..modes.modes.len() {
        let swing = study.mode_pictures(mode, 8, 0.05).expect("a swing");
        assert!(swing.amplitude > 0.0);
        let body = rest.bodies.len() - 1;
        let offset = |k: usize| subtract(swing.frames[k % 8][body].position, rest.bodies[body].pose.position);
        let radius = norm(offset(0));
        assert!(radius > 0.0);
        for k in 0..8 {
            assert!((norm(offset(k)) / radius - 1.0).abs() < 1e-6, "{mode} {k}");
            let across = dot(offset(k), offset(k + 2)) / radius.powi(2);
            assert!(across.abs() < 1e-6, "{mode} {k}: {across}");
            let half = add(offset(k), offset(k + 4));
            assert!(norm(half) < 1e-9 * radius.max(1.0), "{mode} {k}");
        }
    }
}

/// The rim of a thin shaft would have to make several turns to move by a tenth of its length.
#[test]
fn slender_shafts_turn_by_half_a_radian() {
    let machine = Interpreted::from_text(
        "mechanism Shaft {
            body shaft: cylinder(mass: 1 kg, radius: 1 mm, length: 1 m, axis: x);
            joint twist: revolute(x) from ground to shaft;
            force torsion: spring(on: twist, stiffness: 1 N*m/rad);
        }",
    );
    let study = Study::new(machine.expect("a declaration"));
    let ModePictures { frames, .. } = study.mode_pictures(0, 4, 0.1).expect("a swing");
    let turn = frames[0][0].rotation[2][1].atan2(frames[0][0].rotation[1][1]);
    assert!((turn.abs() - 0.5).abs() < 1e-6, "{turn}");
    assert!((frames[0][0].rotation[2][1] + frames[2][0].rotation[2][1]).abs() < 1e-12);
}

/// Only coordinates move bodies: a mode consisting of speeds alone shows the equilibrium.
#[test]
fn modes_of_speeds_alone_stand_still() {
    let machine = Interpreted::from_text(
        "mechanism Fan {
            input torque: N*m;
            body fan: disk(mass: 1 kg, radius: 20 cm, axis: z);
            body flag: rod(mass: 1 kg, length: 1 m, along: x);
            joint run: revolute(z) from ground to fan, coasting;
            joint wave: revolute(z) from ground to flag;
            force motor: generalized(on: run, value: torque - 0.1 N*m*s * rate(run));
            force hold: spring(on: wave, stiffness: 3 N*m/rad);
        }",
    );
    let study = Study::new(machine.expect("a declaration")).input(Input::new(0), 2.0);
    let modes = study.modes().expect("modes");
    let rest = study.picture().expect("a picture");
    let moved = |mode: usize| {
        let swing = study.mode_pictures(mode, 3, 0.1).expect("a swing");
        let first = swing.frames[0].iter().zip(&rest.bodies);
        let moved: Vec<bool> = first.map(|(pose, body)| *pose != body.pose).collect();
        assert_eq!(swing.amplitude > 0.0, moved.contains(&true));
        moved
    };
    let mut all: Vec<Vec<bool>> = (0..modes.modes.len()).map(moved).collect();
    all.sort();
    assert_eq!(all, [[false, false], [false, true]]);
}

/// The operating deflection shape is the vibration itself, enlarged so that it moves as far as a mode does.
#[test]
fn a_forced_vibration_moves_as_its_response_says() {
    let machine = Interpreted::from_text(
        "mechanism Rotor {
            input speed: rad/s;
            body across: massless;
            body plate: massless;
            body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
            joint x: prismatic(x) from ground to across;
            joint y: prismatic(y) from across to plate;
            joint spin: revolute(z) from plate to disk, driven at speed;
            force sideways: spring(on: x, stiffness: 40 kN/m);
            force upwards: spring(on: y, stiffness: 70 kN/m);
            force damp_x: damper(on: x, damping: 30 N*s/m);
            unbalance u: on disk, amount: 20 g*mm;
        }",
    );
    let study = Study::new(machine.expect("a declaration")).input(Input::new(0), 115.0);
    let response = study.forced_response().expect("a vibration");
    let unknowns = &response.harmonics[0].unknowns;
    let moved = study.vibration_pictures(Excitation::new(0), 12, 0.1).expect("a picture");
    assert_eq!(moved.frequency, 115.0);
    let size = study.picture().expect("a picture").size();
    let mut farthest = 0.0_f64;
    for (k, frame) in moved.frames.iter().enumerate() {
        let angle = std::f64::consts::TAU * k as f64 / 12.0;
        let turn = eigentol::Complex::from_polar(moved.enlargement, angle);
        for axis in 0..2 {
            let expected = (turn * unknowns[axis]).re;
            let there = frame[2].position[axis];
            assert!((there - expected).abs() < 1e-14, "frame {k}: {there} {expected}");
        }
        farthest = farthest.max(norm(frame[2].position));
    }
    assert!(farthest < 0.1 * size * (1.0 + 1e-6) && farthest > 0.09 * size, "{farthest} {size}");
    let error = study.vibration_pictures(Excitation::new(1), 12, 0.1).unwrap_err();
    assert!(matches!(error, Error::UnknownHandle { .. }), "{error}");
    let error = study.vibration_pictures(Excitation::new(0), 12, -0.1).unwrap_err();
    assert!(matches!(error, Error::Setting { .. }), "{error}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let study = double_pendulum();
    let error = study.mode_pictures(7, 8, 0.1).unwrap_err();
    assert!(matches!(error, Error::NoSuchMode { mode: 7, count: 2 }), "{error}");
    for amplitude in [-0.1, f64::NAN, f64::INFINITY] {
        let error = study.mode_pictures(0, 8, amplitude).unwrap_err();
        assert!(matches!(error, Error::Setting { .. }), "{error}");
    }
    let still = study.mode_pictures(0, 2, 0.0).expect("a picture");
    assert_eq!(still.amplitude, 0.0);
    let none = study.mode_pictures(0, 0, 0.1).expect("no frames");
    assert!(none.frames.is_empty());
}
