//! For every machine: the two sides of each joint, loop-closing joints included, meet as the joint allows; declared
//! points are where the outputs say; wheels touch the surfaces they roll on.

use eigentol::equilibrium::assemble;
use eigentol::kernels::Kernels;
use eigentol::picture::{Scene, scene};
use eigentol_compiler::compile_text;
use eigentol_compiler::mechanics::Limits;
use eigentol_interpreter::Interpreted;
use eigentol_oracle::truth::Truth;
use eigentol_tests::tables::{Machine, constrained, open};

use crate::pictures::space::{Vector, add, dot, norm, scaled, subtract};

/// Metres, and components of unit vectors.
const TOLERANCE: f64 = 1e-9;

/// A state of a machine: `q`, `u`, `b`.
type State = [Vec<f64>; 3];

/// Nonzero coordinates, all different; with constraints, the nearest assembled state to these or to a solution in
/// `truth/loops.json`.
fn state(machine: &Machine) -> State {
    let description = machine.picture.description();
    let mut q: Vec<f64> = (0..description.coordinates.len()).map(|k| 0.3 * (1.0 + 2.3 * k as f64).sin()).collect();
    let mut u = vec![1.3; description.inputs.len()];
    let b: Vec<f64> = description.design.iter().map(|info| info.nominal).collect();
    let constrained = description.coordinates.iter().any(|unknown| unknown.name.contains('.'));
    let constrained = constrained || machine_of_loops(machine.name).is_some();
    if let Some(truth) = machine_of_loops(machine.name) {
        let point = &truth.get("points").list()[0];
        for (value, unknown) in q.iter_mut().zip(description.coordinates.iter()) {
            let known = point.get("coordinates");
            if unknown.role == eigentol::Role::Position {
                *value = known.get(&unknown.name).number() + 0.001;
            }
        }
        u = vec![point.get("input").number(); u.len()];
    }
    if constrained {
        let assembled = assemble(&*machine.kernels, &u, &b, &q, &[]);
        q = assembled.expect("a mechanism that closes").coordinates.to_vec();
    }
    [q, u, b]
}

fn machine_of_loops(name: &str) -> Option<Truth> {
    let name = match name {
        "four_bar" => "four_bar_open",
        "five_bar" | "geared_coasting" | "geared_motor" | "geared_rotors" | "porter_governor" | "slider_crank" => name,
        _ => return None,
    };
    Some(Truth::load("loops").get("mechanisms").get(name))
}

fn shown(machine: &Machine, [q, u, b]: &State) -> Scene {
    scene(&*machine.picture, q, u, b).expect("a picture")
}

fn direction(scene: &Scene, body: Option<usize>, direction: Vector) -> Vector {
    body.map_or(direction, |body| scene.bodies[body].pose.direction(direction))
}

#[test]
fn both_sides_of_a_joint_meet() {
    let (mut joints, mut cut) = (0, 0);
    for machine in open().iter().chain(&constrained()) {
        let scene = shown(machine, &state(machine));
        assert!(!scene.bodies.is_empty(), "{}", machine.name);
        for joint in &scene.joints {
            let what = format!("{}: {}", machine.name, joint.name);
            let [from, to] = [joint.from, joint.to].map(|seat| {
                let axis = seat.axis.map(|axis| direction(&scene, seat.body, axis));
                (scene.place(seat.body, seat.place), axis)
            });
            let apart = subtract(to.0, from.0);
            let axes = from.1.zip(to.1);
            let along = |axis: Vector| subtract(apart, scaled(dot(axis, apart), axis));
            let (gap, same_axis) = match &*joint.kind {
                "fixed" | "universal" | "spherical" => (norm(apart), false),
                "revolute" => (norm(apart), true),
                "prismatic" | "screw" | "cylindrical" => {
                    let (axis, _) = axes.expect("an axis");
                    (norm(along(axis)), true)
                }
                "planar" => {
                    let (_, normal) = axes.expect("an axis");
                    (dot(normal, apart).abs(), false)
                }
                "free" | "flexure" => continue,
                other => panic!("{what} is a {other}"),
            };
            assert!(gap < TOLERANCE, "{what} gapes by {gap}");
            if same_axis {
                let (one, other) = axes.expect("an axis");
                assert!(norm(subtract(one, other)) < TOLERANCE, "{what}: {one:?}, {other:?}");
            }
            joints += 1;
            cut += u32::from(joint.closes_loop);
        }
    }
    assert!(joints > 70 && cut >= 3, "{joints} joints, {cut} cut");
}

/// These components of a machine's points, from its outputs; `None` if one of them is not constant in steady motion.
fn outputs(machine: &Machine, [q, u, b]: &State, scene: &Scene, axes: &[usize]) -> Option<Vec<f64>> {
    let mut text = machine.declaration.to_owned();
    let end = text.rfind('}').expect("a declaration ends");
    let outputs = scene.points.iter().flat_map(|point| {
        let name = &point.name;
        axes.iter().map(move |&axis| {
            let axis = ["x", "y", "z"][axis];
            format!("output seen_{name}_{axis} = position({name}).{axis};\n")
        })
    });
    text.insert_str(end, &outputs.collect::<String>());
    let limits = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };
    let mut compilation = compile_text(&text, limits).ok()?;
    compilation.program.kernels.retain(|kernel| kernel.name == "outputs");
    let twin = Interpreted::new(&compilation);
    let mut values = vec![0.0; twin.sizes().outputs];
    twin.outputs_into(q, u, b, &mut values);
    Some(values.split_off(values.len() - axes.len() * scene.points.len()))
}

#[test]
fn points_are_where_outputs_say() {
    let mut compared = 0;
    for machine in open().iter().chain(&constrained()) {
        let at = state(machine);
        let scene = shown(machine, &at);
        if scene.points.is_empty() {
            continue;
        }
        // A vector that turns with a drive has no constant components except along its axis.
        let choices: [&[usize]; 4] = [&[0, 1, 2], &[2], &[1], &[0]];
        let found = choices.iter().find_map(|axes| {
            let values = outputs(machine, &at, &scene, axes)?;
            Some((axes, values))
        });
        let Some((axes, values)) = found else {
            continue;
        };
        for (point, expected) in scene.points.iter().zip(values.chunks_exact(axes.len())) {
            let place = scene.place(point.body, point.place);
            for (&axis, expected) in axes.iter().zip(expected) {
                let apart = (place[axis] - expected).abs();
                assert!(apart < 1e-12, "{}: {} {place:?}", machine.name, point.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 30, "{compared} components");
}

/// A disk whose axle is inclined at `angle` to the normal has its centre at `radius sin(angle)`.
#[test]
fn wheels_touch_their_planes() {
    let mut wheels = 0;
    for machine in constrained() {
        let scene = shown(&machine, &state(&machine));
        for wheel in &scene.wheels {
            let [center, on] = [wheel.center, wheel.on].map(|point| {
                let point = &scene.points[point];
                (point.body, scene.place(point.body, point.place))
            });
            let normal = direction(&scene, on.0, wheel.normal);
            let height = dot(normal, subtract(center.1, on.1));
            let inclined = wheel.axle.map_or(1.0, |axle| {
                let axle = direction(&scene, center.0, axle);
                (1.0 - dot(axle, normal).powi(2)).sqrt()
            });
            let expected = wheel.radius * inclined;
            assert!((height - expected).abs() < TOLERANCE, "{}: {}", machine.name, wheel.name);
            let low = add(center.1, scaled(-height, normal));
            let held = (0..3).all(|i| scene.bounds[0][i] <= low[i] + TOLERANCE);
            assert!(held, "{}: {:?}", machine.name, scene.bounds);
            wheels += 1;
        }
    }
    assert!(wheels >= 4, "{wheels} wheels");
}
