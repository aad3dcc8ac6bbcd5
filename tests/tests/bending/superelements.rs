//! Superelements: frames of beams, reduced to their stations and the modes between them (R. R. Craig and M. C. C. Bampton,
//! AIAA Journal 6, 1968) by a small program of their own, against the whole frame.

mod frame;

use eigentol::{Complex, DesignVariable, Input, Study};
use nalgebra::{DMatrix, DVector};

use self::frame::{Frame, file};
use crate::beams::compared::{self, machine};

/// What holds the stations: springs of the last, along the axes; masses on the first.
const SPRING: [f64; 3] = [3e6, 2e6, 4e6];
const LOAD: f64 = 5.0;
const TURNS: f64 = 0.02;
/// Damping in proportion to stiffness, s, and mass, 1/s.
const LAG: f64 = 2e-5;
const DRAG: f64 = 3.0;
/// So little that the springs of the feet, which bend with the frame, push the same as in its shape at rest, m/s^2.
const GRAVITY: f64 = 1e-5;

/// A frame with its feet on springs and loads on its first two stations.
fn text(frame: &Frame, modes: usize) -> String {
    let [mass, stiffness] = frame.reduced(modes);
    let places: Vec<String> = frame.stations().iter().map(|[x, y, z]| format!("[{x}, {y}, {z}] m")).collect();
    let mut feet = String::new();
    for (k, place) in places.iter().enumerate().skip(2) {
        let number = k + 1;
        let [x, y, z] = SPRING;
        feet += &format!(
            "point below{k}: ground at {place}; point foot{k}: casing at station {number};
            force under{k}: bushing(from: below{k}, to: foot{k}, stiffness: [{x}, {y}, {z}] N/m,
                damping: lag * [{x}, {y}, {z}] N/m);"
        );
    }
    format!(
        "mechanism Casing {{
            design wall = 1; design weight = 1; design lag = {LAG} s; design drag = {DRAG} rad/s;
            gravity {GRAVITY} m/s^2 along -z;
            body casing: superelement(mass: [[\"mass.mtx\", weight]], stiffness: [[\"stiffness.mtx\", wall]],
                damping: [[\"stiffness.mtx\", lag * wall], [\"mass.mtx\", drag * weight]],
                stations: [{}]);
            body one: rigid(mass: {LOAD} kg, inertia: [{TURNS}, {TURNS}, {TURNS}] kg*m^2);
            body two: rigid(mass: {LOAD} kg, inertia: [{TURNS}, {TURNS}, {TURNS}] kg*m^2);
            joint first: fixed from casing at station 1 to one;
            joint second: fixed from casing at station 2 to two;
            point hub1: one at [0, 0, 0]; point hub2: two at [0, 0, 0];
            force air1: drag(at: hub1, damping: drag * {LOAD} kg, turning_damping: drag * {TURNS} kg*m^2);
            force air2: drag(at: hub2, damping: drag * {LOAD} kg, turning_damping: drag * {TURNS} kg*m^2);
            {feet}
            point top: casing at station 1;
            output sag = position(top).z - {} m;
        }}
        {}{}",
        places.join(", "),
        frame.stations()[0][2],
        file("mass.mtx", &mass),
        file("stiffness.mtx", &stiffness),
    )
}

/// The whole frame with the same loads and springs, its elastic part times `wall` and its mass times `weight`.
fn whole(frame: &Frame, wall: f64, weight: f64) -> [DMatrix<f64>; 2] {
    let (mut mass, mut stiffness) = (&frame.mass * weight, &frame.stiffness * wall);
    for station in 0..frame.stations().len() {
        for (k, spring) in SPRING.iter().enumerate() {
            let row = 6 * station + k;
            if station < 2 {
                mass[(row, row)] += LOAD;
                mass[(row + 3, row + 3)] += TURNS;
            } else {
                stiffness[(row, row)] += spring;
            }
        }
    }
    [mass, stiffness]
}

/// Squares of frequencies with their shapes, normalised by mass.
fn modes_of(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Vec<(f64, DVector<f64>)> {
    let root = mass.clone().cholesky().expect("a mass").l();
    let inverse = root.try_inverse().expect("a mass");
    let eigen = (&inverse * stiffness * inverse.transpose()).symmetric_eigen();
    let mut modes: Vec<(f64, DVector<f64>)> =
        (0..mass.nrows()).map(|k| (eigen.eigenvalues[k], inverse.transpose() * eigen.eigenvectors.column(k))).collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    modes
}

/// With all modes between the stations the reduction is exact: frequencies, damping, sag and derivatives by the factors of both
/// matrices are those of the whole frame.
#[test]
fn a_superelement_is_the_frame_that_it_stands_for() {
    for seed in 1..5 {
        let frame = Frame::random(seed);
        let study = Study::new(machine(&text(&frame, frame.inner())));
        let [mass, stiffness] = whole(&frame, 1.0, 1.0);
        let expected = modes_of(&mass, &stiffness);
        let found = study.modes().expect("modes").modes;
        let sensitivities = study.sensitivities().expect("derivatives").modes;
        for ((square, shape), (mode, sensitivity)) in expected.iter().zip(found.iter().zip(&sensitivities)).take(12) {
            // s^2 + (drag + lag square) s + square = 0
            let half = 0.5 * (DRAG + LAG * square);
            let s = Complex::new(-half, (square - half * half).sqrt());
            assert!((mode.s - s).norm() < 1e-9 * s.norm(), "{seed}: {} {s}", mode.s);
            let of = |matrix: &DMatrix<f64>| (shape.transpose() * matrix * shape)[0];
            let [elastic, heavy] = [of(&frame.stiffness), of(&frame.mass)];
            let slope = 2.0 * s + DRAG + LAG * square;
            let slopes = [
                -(1.0 + LAG * s) * elastic / slope,
                -(s * s + DRAG * s) * heavy / slope,
                -s * *square / slope,
                -s / slope,
            ];
            for (k, expected) in slopes.into_iter().enumerate() {
                let found = sensitivity.s().expect("derivatives").by_design[k];
                let scale = slopes[k].norm().max(1e-6 * s.norm());
                assert!((found - expected).norm() < 1e-7 * scale, "{seed} {k}: {found} {expected}");
            }
        }
        let mut weight = DVector::zeros(mass.nrows());
        for station in 0..frame.nodes.len() {
            weight[6 * station + 2] = -GRAVITY;
        }
        let sag = stiffness.clone().lu().solve(&(&mass * weight)).expect("a state")[2];
        let found = study.outputs().expect("outputs").values[0];
        assert!((found - sag).abs() < 1e-7 * sag.abs(), "{seed}: {found} {sag}");
    }
}

/// Fewer modes are a stiffer part, whose lowest frequencies hardly change.
#[test]
fn few_modes_are_enough() {
    let frame = Frame::random(3);
    let expected = modes_of(&whole(&frame, 1.0, 1.0)[0], &whole(&frame, 1.0, 1.0)[1]);
    let study =
        Study::new(machine(&text(&frame, 6))).design(DesignVariable::new(2), 0.0).design(DesignVariable::new(3), 0.0);
    let found = study.modes().expect("modes").modes;
    for ((square, _), mode) in expected.iter().zip(&found).take(5) {
        let apart = mode.s.im / square.sqrt() - 1.0;
        assert!((-1e-12..2e-3).contains(&apart), "{} {}", mode.s, square.sqrt());
    }
}

/// A wheel that spins, in axes that do not turn: its matrices are those of a disk on a driven joint.
#[test]
fn a_wheel_of_matrices_is_a_disk() {
    let [mass, across, about] = [7.0, 0.05, 0.09];
    let mut heavy = DMatrix::zeros(6, 6);
    for (row, own) in [mass, mass, mass, about, across, across].into_iter().enumerate() {
        heavy[(row, row)] = own;
    }
    // About y: across q'' + about omega r'; about z: across r'' - about omega q'.
    let mut turning = DMatrix::zeros(6, 6);
    turning[(4, 5)] = about;
    turning[(5, 4)] = -about;
    let matrices = [
        "body wheel: superelement(mass: \"m.mtx\", stiffness: \"k.mtx\", gyroscopic: [[\"g.mtx\", omega]],
            stations: [[0, 0, 0]]); point hub: wheel at station 1;"
            .to_owned(),
        file("m.mtx", &heavy) + &file("k.mtx", &DMatrix::zeros(6, 6)) + &file("g.mtx", &turning),
    ];
    let bodies = [
        format!(
            "joint afloat: free(px: x, py: y, pz: z, yaw: z, pitch: y, roll: x) from ground to carrier; body carrier: massless;
            body wheel: rigid(mass: {mass} kg, inertia: [{about}, {across}, {across}] kg*m^2);
            joint turns: revolute(x) from carrier to wheel, driven at omega; point hub: carrier at [0, 0, 0];"
        ),
        String::new(),
    ];
    let [a, b] = [matrices, bodies].map(|[wheel, after]| {
        let text = format!(
            "mechanism Wheel {{ input omega: rad/s; {wheel} point seat: ground at [0.1, 0, 0] m;
                force film: bushing(from: seat, to: hub, stiffness: [2, 3, 4] MN/m, damping: [200, 300, 100] N*s/m,
                    turning_stiffness: [5, 6, 7] kN*m/rad); }} {after}"
        );
        Study::new(machine(&text)).input(Input::new(0), 500.0).modes().expect("modes").modes
    });
    assert!(a.len() == 6 && b.len() == 6);
    for (a, b) in a.iter().zip(&b) {
        assert!((a.s - b.s).norm() < 1e-11 * b.s.norm(), "{} {}", a.s, b.s);
    }
}

/// A pedestal of two masses on springs, within its matrices, is the same as one of bodies and joints; on it stands a shaft.
#[test]
fn a_pedestal_within_matrices_is_one_of_bodies() {
    let pedestal = |number: usize| {
        format!(
            "joint y{number}: prismatic(y) from ground to way{number} at [{}, 0, 0] m;
            joint z{number}: prismatic(z) from way{number} to block{number};
            body way{number}: massless; body block{number}: rigid(mass: 8 kg, inertia: [1, 1, 1] kg*m^2);
            force held_y{number}: spring(on: y{number}, stiffness: stiff * 6 MN/m);
            force held_z{number}: spring(on: z{number}, stiffness: stiff * 9 MN/m);
            force slow_y{number}: damper(on: y{number}, damping: 100 N*s/m);
            force slow_z{number}: damper(on: z{number}, damping: 200 N*s/m);
            point seat{number}: block{number} at [0, 0, 0];",
            0.5 * number as f64
        )
    };
    let diagonal = |name: &str, numbers: [f64; 2]| {
        let mut matrix = DMatrix::zeros(12, 12);
        for row in 0..4 {
            let row = 6 * (row / 2) + 1 + row % 2;
            matrix[(row, row)] = numbers[(row % 6 + 1) % 2];
        }
        file(name, &matrix)
    };
    let matrices = [
        "body casing: superelement(mass: \"m.mtx\", stiffness: [[\"k.mtx\", stiff]], damping: \"c.mtx\", held: inside,
            stations: [[0, 0, 0], [0.5, 0, 0] m]);
        point seat0: casing at station 1; point seat1: casing at station 2;"
            .to_owned(),
        diagonal("m.mtx", [8.0, 8.0]) + &diagonal("k.mtx", [6e6, 9e6]) + &diagonal("c.mtx", [100.0, 200.0]),
    ];
    let bodies = [pedestal(0) + &pedestal(1), String::new()];
    let studies = [bodies, matrices].map(|[inside, after]| {
        let text = format!(
            "mechanism Stand {{
                input omega: rad/s; design stiff = 1.1;
                material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
                gravity 9.81 m/s^2 along -z;
                body rotor: shaft(along: x, up: z, material: steel, sections: [[200 mm, 40 mm], [300 mm, 55 mm, 20 mm]])
                    spinning at omega;
                body disk: disk(mass: 11 kg, radius: 110 mm, axis: x);
                joint turns: revolute(x) from rotor at station 1 to disk, driven at omega;
                unbalance heavy: on disk, amount: 100 g*mm;
                {inside}
                point journal0: rotor at root; point journal1: rotor at tip;
                force film0: bushing(from: seat0, to: journal0, stiffness: [0, 20, 30] MN/m, damping: [0, 2, 2] kN*s/m);
                force film1: bushing(from: seat1, to: journal1, stiffness: [0, 30, 20] MN/m, damping: [0, 2, 3] kN*s/m);
                point hub: rotor at station 1; output y = position(hub).y;
            }} {after}"
        );
        Study::new(machine(&text)).input(Input::new(0), 300.0)
    });
    let [a, b] = studies.each_ref().map(|study| study.modes().expect("modes").modes);
    for (a, b) in a.iter().zip(&b).take(8) {
        assert!((a.s - b.s).norm() < 1e-10 * b.s.norm(), "{} {}", a.s, b.s);
    }
    let [a, b] = studies.each_ref().map(|study| {
        let response = study.forced_response().expect("a response").harmonics[0].outputs[0].expect("one");
        let slope =
            study.forced_sensitivities().expect("derivatives").harmonics[0].outputs[0].as_ref().expect("one").by_design
                [0];
        [response, slope]
    });
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).norm() < 1e-9 * b.norm(), "{a} {b}");
    }
}

/// A part that is held has other masses along other directions: a column of one finite element, whose end a third of its mass
/// follows along it and 13 of 35 parts across it.
#[test]
fn a_column_that_is_held_weighs_less_across() {
    let (mass, axial, bending, twisting, length): (f64, f64, f64, f64, f64) = (40.0, 900e6, 5e6, 4e6, 0.8);
    let rotary = 0.02;
    let mut heavy = DMatrix::zeros(6, 6);
    let mut stiff = DMatrix::zeros(6, 6);
    for (row, own) in [13.0 / 35.0 * mass, 13.0 / 35.0 * mass, mass / 3.0].into_iter().enumerate() {
        heavy[(row, row)] = own;
    }
    let turns = mass * length * length / 105.0;
    for (row, own) in [turns, turns, rotary].into_iter().enumerate() {
        heavy[(3 + row, 3 + row)] = own;
    }
    let [push, couple] = [12.0 * bending / length.powi(3), 6.0 * bending / length.powi(2)];
    for (row, own) in [push, push, axial / length, 4.0 * bending / length, 4.0 * bending / length, twisting / length]
        .into_iter()
        .enumerate()
    {
        stiff[(row, row)] = own;
    }
    // Along x the end turns about y, along y against x.
    for (row, column, sign) in [(0, 4, 1.0), (1, 3, -1.0)] {
        let coupled = 11.0 / 210.0 * mass * length;
        for (matrix, own) in [(&mut heavy, coupled), (&mut stiff, couple)] {
            matrix[(row, column)] = -sign * own;
            matrix[(column, row)] = -sign * own;
        }
    }
    let text = format!(
        "mechanism Column {{
            body column: superelement(mass: \"m.mtx\", stiffness: \"k.mtx\", held: inside, stations: [[0, 0, {length}] m]);
        }} {}{}",
        file("m.mtx", &heavy),
        file("k.mtx", &stiff)
    );
    let found = Study::new(machine(&text)).modes().expect("modes").modes;
    let mut expected: Vec<f64> = modes_of(&heavy, &stiff).into_iter().map(|(square, _)| square.sqrt()).collect();
    expected.sort_by(f64::total_cmp);
    assert_eq!(found.len(), 6);
    for (mode, expected) in found.iter().zip(&expected) {
        assert!((mode.s.im - expected).abs() < 1e-9 * expected, "{} {expected}", mode.s);
    }
    // A uniform cantilever bends at 3.516 sqrt(EI / m L^4); one element is half a percent too stiff.
    let cantilever = 3.516_015 * (bending / (mass * length.powi(3))).sqrt();
    assert!((0.0..6e-3).contains(&(expected[0] / cantilever - 1.0)), "{} {cantilever}", expected[0]);
}

/// The axis of a hub may follow a variable: modes and states are those of a hub whose axis is given by numbers, derivatives those of
/// differences.
#[test]
fn a_hub_may_be_misaligned() {
    let node = |k: usize| 6 * (k / 3) + k % 3;
    let mut heavy = DMatrix::zeros(12, 12);
    let mut stiff = DMatrix::zeros(12, 12);
    for i in 0..6 {
        for j in 0..6 {
            if i % 3 == j % 3 {
                heavy[(node(i), node(j))] = [[2.0, 0.4], [0.4, 3.0]][i / 3][j / 3];
            }
            let spread = if i == j { 3.0 } else { 0.7 / (1.0 + i as f64 + j as f64) };
            stiff[(node(i), node(j))] = 1e5 * spread;
        }
    }
    let study = |axis: &str| {
        let text = format!(
            "mechanism Hub {{
                input omega: rad/s; design tilt = 0 rad;
                body hub: massless; joint drive: revolute({axis}) from ground to hub, driven at omega;
                body part: superelement(on: hub, mass: \"m.mtx\", stiffness: \"k.mtx\", held: inside,
                    stations: [[1, 0.1, 0] m, [1.4, 0.1, 0.2] m]);
                point at: part at station 2; point home: hub; output out = distance(at, home);
            }} {}{}",
            file("m.mtx", &heavy),
            file("k.mtx", &stiff)
        );
        Study::new(machine(&text)).input(Input::new(0), 120.0)
    };
    let follows = study("[tilt, 0.1 * tilt, 1]");
    let moved = |tilt: f64| follows.clone().design(DesignVariable::new(0), tilt);
    let [a, b] = [moved(0.3), study("[0.3, 0.03, 1]")];
    for (a, b) in a.modes().expect("modes").modes.iter().zip(&b.modes().expect("modes").modes) {
        assert!((a.s - b.s).norm() < 1e-10 * b.s.norm(), "{} {}", a.s, b.s);
    }
    let [a, b] = [a, b].map(|study| study.outputs().expect("outputs").values[0]);
    assert!((a - b).abs() < 1e-10 * b, "{a} {b}");
    let step = 1e-4;
    let around = [-step, step].map(|tilt| moved(tilt).modes().expect("modes").modes);
    for (mode, sensitivity) in follows.sensitivities().expect("derivatives").modes.iter().enumerate() {
        let found = sensitivity.s().expect("derivatives").by_design[0].im;
        let expected = (around[1][mode].s.im - around[0][mode].s.im) / (2.0 * step);
        assert!(expected.abs() > 0.1 && (found - expected).abs() < 1e-5 * expected.abs(), "{mode}: {found} {expected}");
    }
}

/// Nodes on a hub that turns, with mass and springs between them, are particles on slides with the same energy: the state, modes and
/// derivatives, of whatever mass the nodes are made and wherever the axis is. A disk on one of them moves along.
#[test]
fn nodes_that_turn_are_particles_that_turn() {
    let places = [[0.3, 0.05, 0.1], [0.2, -0.2, 0.0], [0.45, 0.1, -0.05]];
    let masses = [0.8, 1.7, 0.5];
    let rows: Vec<usize> = (0..9).map(|k| 6 * (k / 3) + k % 3).collect();
    let mut seed = 7.0_f64;
    let mut random = || {
        seed = (seed * 16807.0) % 2147483647.0;
        seed / 2147483647.0 - 0.5
    };
    let root = DMatrix::from_fn(9, 9, |_, _| random());
    let elastic = (&root * root.transpose() + DMatrix::identity(9, 9) * 0.2) * 4e4;
    let spread = |small: &DMatrix<f64>| {
        let mut all = DMatrix::zeros(18, 18);
        (0..9).for_each(|i| (0..9).for_each(|j| all[(rows[i], rows[j])] = small[(i, j)]));
        all
    };
    let heavy = DMatrix::from_fn(9, 9, |i, j| if i == j { masses[i / 3] } else { 0.0 });
    let place = |k: usize| format!("[{}, {}, {}] m", places[k][0], places[k][1], places[k][2]);
    let matrices = [
        format!(
            "body part: superelement(on: hub, mass: [[\"m.mtx\", weight]], stiffness: \"k.mtx\", held: inside,
                stations: [{}, {}, {}]);
            joint welded: fixed from part at station 2 to wheel;
            point at: part at station 2; output out = distance(at, home);",
            place(0),
            place(1),
            place(2)
        ),
        file("m.mtx", &spread(&heavy)) + &file("k.mtx", &spread(&elastic)),
    ];
    let mut bodies = String::new();
    for (k, mass) in masses.iter().enumerate() {
        bodies += &format!(
            "body xs{k}: massless; body ys{k}: massless; body p{k}: point(mass: weight * {mass} kg);
            joint x{k}: prismatic(x) from hub to xs{k} at {}; joint y{k}: prismatic(y) from xs{k} to ys{k};
            joint z{k}: prismatic(z) from ys{k} to p{k};",
            place(k)
        );
    }
    let name = |k: usize| format!("{}{}", ["x", "y", "z"][k % 3], k / 3);
    let terms = (0..9).flat_map(|i| (0..9).map(move |j| (i, j)));
    let energy: Vec<String> =
        terms.map(|(i, j)| format!("{} N/m * {} * {}", 0.5 * elastic[(i, j)], name(i), name(j))).collect();
    bodies += &format!(
        "force held: potential(energy: {}); joint welded: fixed from p1 to wheel;
        point at: p1 at [0, 0, 0]; output out = distance(at, home);",
        energy.join(" + ")
    );
    for (axis, gravity) in [("z", "-z"), ("[0.6, 0, 0.8]", "[0.6, 0, 0.8]")] {
        let [a, b] = [&matrices, &[bodies.clone(), String::new()]].map(|[inside, after]| {
            let text = format!(
                "mechanism Turning {{
                    input omega: rad/s; design weight = 1.2; gravity 9.81 m/s^2 along {gravity};
                    body hub: massless; point home: hub at [0, 0, 0]; joint drive: revolute({axis}) from ground to hub at [0.05, 0.02, 0] m, driven at omega;
                    body wheel: rigid(mass: 2 kg, inertia: [0.01, 0.02, 0.025] kg*m^2);
                    {inside}
                }} {after}"
            );
            Study::new(machine(&text)).input(Input::new(0), 60.0)
        });
        let [found, expected] = [&a, &b].map(|study| study.outputs().expect("outputs"));
        assert!((found.values[0] - expected.values[0]).abs() < 1e-12, "{} {}", found.values[0], expected.values[0]);
        let modes = [&a, &b].map(|study| study.modes().expect("modes").modes);
        let slopes = [&a, &b].map(|study| study.sensitivities().expect("derivatives").modes);
        for k in 0..9 {
            let [own, other] = [&modes[0][k], &modes[1][k]];
            assert!((own.s - other.s).norm() < 1e-10 * other.s.norm(), "{} {}", own.s, other.s);
            let [own, other] = [&slopes[0][k], &slopes[1][k]].map(|mode| mode.s().expect("derivatives"));
            let pairs = [(own.by_input[0], other.by_input[0]), (own.by_design[0], other.by_design[0])];
            for (own, other) in pairs {
                assert!((own - other).norm() < 1e-8 * (1.0 + other.norm()), "{own} {other}");
            }
        }
    }
}

/// A beam of finite elements that turns, stiffened by the centrifugal forces of itself and of a body at its tip, with matrices given
/// for all of it: frequencies and their derivatives by the speed, in seventy digits.
#[test]
fn a_turning_beam_of_finite_elements() {
    const COUNT: usize = 24;
    let truth = compared::truth(include_str!("../../truth/flexible/F2_rotating_tip_mass.json"));
    for case in truth["cases"].as_array().expect("cases").iter().take(2) {
        let of = |name: &str| case["parameters"][name].as_f64().expect("a number");
        let [length, hub, speed, bending, line, tip, turns] = ["L", "R", "Omega", "EI", "rhoA", "m", "J"].map(of);
        let flap = case["motion"] == "flap";
        let h = length / COUNT as f64;
        let mut all = [(); 3].map(|()| DMatrix::<f64>::zeros(2 * COUNT, 2 * COUNT));
        for element in 0..COUNT {
            // Gauss's points of order seven on the element.
            for (x, weight) in [
                (-0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
                (-0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
                (0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
                (0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
            ] {
                let (t, weight): (f64, f64) = (0.5 + 0.5 * x, 0.5 * h * weight);
                let shape = [
                    1.0 - 3.0 * t * t + 2.0 * t.powi(3),
                    h * (t - 2.0 * t * t + t.powi(3)),
                    3.0 * t * t - 2.0 * t.powi(3),
                    h * (t.powi(3) - t * t),
                ];
                let slope =
                    [6.0 * (t * t - t) / h, 1.0 - 4.0 * t + 3.0 * t * t, 6.0 * (t - t * t) / h, 3.0 * t * t - 2.0 * t];
                let curvature =
                    [12.0 * t - 6.0, h * (6.0 * t - 4.0), 6.0 - 12.0 * t, h * (6.0 * t - 2.0)].map(|c| c / (h * h));
                let place = (element as f64 + t) * h;
                let tension =
                    line * (hub * (length - place) + 0.5 * (length * length - place * place)) + tip * (hub + length);
                // The tip's rows come first, the root has none.
                let row = |k: usize| (2 * (element + k / 2)).checked_sub(2).map(|at| (at + 2) % (2 * COUNT) + k % 2);
                for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                    let (Some(row), Some(column)) = (row(i), row(j)) else { continue };
                    for (matrix, factor, of) in [(0, line, shape), (1, bending, curvature), (2, tension, slope)] {
                        all[matrix][(row, column)] += weight * factor * of[i] * of[j];
                    }
                }
            }
        }
        // Deflection along z and turns about -y, or along y and about z.
        let rows: Vec<usize> = (0..2 * COUNT)
            .map(|k| match k {
                0 => 1 + usize::from(flap),
                1 => 5 - usize::from(flap),
                _ => k + 4,
            })
            .collect();
        let spread = |small: &DMatrix<f64>| {
            let mut spread = DMatrix::zeros(2 * COUNT + 4, 2 * COUNT + 4);
            let sign = |k: usize| if k == 1 && flap { -1.0 } else { 1.0 };
            for (i, j) in (0..2 * COUNT).flat_map(|i| (0..2 * COUNT).map(move |j| (i, j))) {
                spread[(rows[i], rows[j])] = sign(i) * sign(j) * small[(i, j)];
            }
            spread
        };
        let softening = if flap { "" } else { ", [\"m.mtx\", -omega^2]" };
        let inertia = if flap { [0.5, 1.0, 0.5] } else { [0.5, 0.5, 1.0] }.map(|part| part * turns);
        let text = format!(
            "mechanism Blade {{
                input omega: rad/s;
                body hub: massless; joint drive: revolute(z) from ground to hub, driven at omega;
                body blade: superelement(on: hub, mass: \"m.mtx\", gyroscopic: [[\"none.mtx\", omega]], held: inside,
                    stiffness: [\"k.mtx\", [\"tension.mtx\", omega^2]{softening}], stations: [[{}, 0, 0] m]);
                body tip: rigid(mass: {tip} kg, inertia: {inertia:?} kg*m^2);
                joint welded: fixed from blade at station 1 to tip;
            }} {}{}{}{}",
            hub + length,
            file("m.mtx", &spread(&all[0])),
            file("k.mtx", &spread(&all[1])),
            file("tension.mtx", &spread(&all[2])),
            file("none.mtx", &DMatrix::zeros(2 * COUNT + 4, 2 * COUNT + 4)),
        );
        let study = Study::new(machine(&text)).input(Input::new(0), speed);
        let (modes, slopes) = (study.modes().expect("modes").modes, study.sensitivities().expect("derivatives").modes);
        let expected = compared::numbers(&case["frequencies"]);
        let by_speed = compared::numbers(&case["derivatives"]["Omega"]["first"]);
        for k in 0..3 {
            assert!((modes[k].s.im / expected[k] - 1.0).abs() < 5e-6, "{} {}", modes[k].s, expected[k]);
            let slope = slopes[k].s().expect("derivatives").by_input[0].im;
            assert!((slope / by_speed[k] - 1.0).abs() < 1e-5, "{slope} {}", by_speed[k]);
        }
    }
}
