//! Critical values whose mode lies in the speeds of coasting coordinates.

use eigentol::branches::{BranchEnd, SpecialKind};
use eigentol::{Error, Stability, Study, mechanism};

mechanism! {
    /// An induction motor by Kloss's formula and a load torque.
    mechanism Motor {
        input load: N*m;
        design pull_out = 1 N*m +/- 1 %;
        design synchronous = 100 rad/s;
        design slip = 20 rad/s;
        body rotor: rigid(mass: 1 kg, inertia: [0.01, 0.01, 0.01] kg*m^2);
        joint spin: revolute(z) from ground to rotor, coasting;
        force drive: generalized(
            on: spin,
            value: pull_out * 2 * (synchronous - rate(spin)) / slip / (1 + ((synchronous - rate(spin)) / slip)^2) - load,
        );
    }
}

mechanism! {
    /// A rotor that hardly anything slows down.
    mechanism Rotor {
        input torque: N*m;
        design drag = 1 N*m*s/rad;
        body rotor: rigid(mass: 1 kg, inertia: [0.01, 0.01, 0.01] kg*m^2);
        joint spin: revolute(z) from ground to rotor, coasting;
        force drive: generalized(on: spin, value: torque - drag * rate(spin));
    }
}

/// However small a share of the way the first steps go.
#[test]
fn a_speed_far_beyond_the_reach_of_a_step_is_found() {
    for drag in [1.0, 1e-3, 1e-6, 1e-9] {
        let study = Study::new(Rotor).input(Rotor::torque, 2.0);
        let state = study.design(Rotor::drag, drag).equilibrium();
        let speed = state.expect("an equilibrium").coordinates[0];
        assert!((speed * drag / 2.0 - 1.0).abs() < 1e-12, "{drag}: {speed}");
    }
}

/// The rotor pulls out at `load = pull_out`, where it lags by `slip`.
#[test]
fn pull_out_of_a_motor() {
    let study = Study::new(Motor).start(Motor::spin, 95.0);
    let found = study.critical_state(Motor::load, 0.0, 2.0).expect("critical");
    assert_eq!(found.kind, SpecialKind::Fold);
    assert!((found.value - 1.0).abs() < 1e-12, "{}", found.value);
    assert!((found.equilibrium.coordinates[0] - 80.0).abs() < 1e-4);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    // `v^T J v = 1`.
    assert!((found.v[0] - 10.0).abs() < 1e-12 && (found.w[0] - 10.0).abs() < 1e-12);

    let spread = study.critical_tolerance(Motor::load, 0.0, 2.0).expect("spread");
    let spread = spread.spread.expect("a derivative");
    for (slope, expected) in spread.by_design.iter().zip([1.0, 0.0, 0.0]) {
        assert!((slope - expected).abs() < 1e-12, "{slope}");
    }
    assert!((spread.sigma - 0.01 / 3.0).abs() < 1e-14);
    let curvature = study.critical_curvature(Motor::load, 0.0, 2.0).expect("curvature");
    let second = curvature.second.as_flattened();
    assert!(second.iter().all(|value| value.abs() < 1e-6), "{second:?}");
}

#[test]
fn the_branch_turns_back_at_pull_out() {
    let study = Study::new(Motor).start(Motor::spin, 95.0);
    let found = study.branches(Motor::load, 0.1, 2.0).expect("branches");
    let [branch] = &found.branches[..] else { panic!("one branch: {found}") };
    assert_eq!(branch.ends, [BranchEnd::Low, BranchEnd::Low]);
    assert_eq!(branch.special.len(), 1);
    for point in &branch.points {
        let x: f64 = (100.0 - point.equilibrium.coordinates[0]) / 20.0;
        let moment = 2.0 * x / (1.0 + x * x);
        assert!((moment - point.value).abs() < 1e-12);
        let expected = match x {
            _ if (x - 1.0).abs() < 1e-6 => Stability::Neutral { zero: 1 },
            _ if x < 1.0 => Stability::Stable,
            _ => Stability::Divergent { negative: 1 },
        };
        assert_eq!(point.equilibrium.stability, expected, "{x}");
    }
}

#[test]
fn a_sweep_lists_the_pull_out() {
    let study = Study::new(Motor).start(Motor::spin, 95.0);
    for values in [[0.0, 0.5, 0.9, 1.5], [0.0, 0.5, 0.9, 1.0]] {
        let found = study.sweep(Motor::load, &values).expect("sweep");
        assert_eq!(found.critical.len(), 1, "{values:?}");
        assert!((found.critical[0].value - 1.0).abs() < 1e-12);
    }
}

mechanism! {
    /// A single-track car in speeds along its own axes, with tyres of linear stiffness.
    mechanism Car {
        input thrust: N;
        design m = 1500 kg;
        design yaw_inertia = 2500 kg*m^2;
        design a = 1.8 m;
        design b = 1.0 m;
        design front = 60 kN;
        design rear = 80 kN;
        design drag = 40 N*s/m;
        body car: rigid(mass: m, inertia: [yaw_inertia, yaw_inertia, yaw_inertia]);
        joint run: planar(forward: x, side: y, yaw: z) from ground to car, coasting;
        force drive: generalized(on: forward, value: thrust - drag * rate(forward));
        force across: generalized(
            on: side,
            value: -front * atan2(rate(side) + a * rate(yaw), rate(forward))
                - rear * atan2(rate(side) - b * rate(yaw), rate(forward)),
        );
        force turn: generalized(
            on: yaw,
            value: b * rear * atan2(rate(side) - b * rate(yaw), rate(forward))
                - a * front * atan2(rate(side) + a * rate(yaw), rate(forward)),
        );
    }
}

/// `u^2 = (a + b)^2 front rear / (m (a front - b rear))`, at which the car diverges sideways.
#[test]
fn divergence_speed_of_a_car() {
    let (m, a, b, front, rear, drag): (f64, f64, f64, f64, f64, f64) = (1500.0, 1.8, 1.0, 60e3, 80e3, 40.0);
    let length = a + b;
    let surplus = a * front - b * rear;
    let force = drag * (length * length * front * rear / (m * surplus)).sqrt();
    let study = Study::new(Car).input(Car::thrust, 800.0).start(Car::forward, 20.0);
    let found = study.critical_state(Car::thrust, 200.0, 4000.0).expect("critical");
    // Beyond it the car settles in a wide turn to either side.
    let soft = SpecialKind::Pitchfork { supercritical: Some(true) };
    assert_eq!(found.kind, soft);
    let heavy = study.clone().design(Car::drag, 1000.0).critical_state(Car::thrust, 5e3, 1e5).expect("critical");
    assert_eq!(heavy.kind, soft);
    assert!((found.value / force - 1.0).abs() < 1e-9, "{} {force}", found.value);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });

    let curvature = study.critical_curvature(Car::thrust, 200.0, 4000.0).expect("curvature");
    let by = [
        -0.5 / m,
        0.0,
        1.0 / length - 0.5 * front / surplus,
        1.0 / length + 0.5 * rear / surplus,
        0.5 / front - 0.5 * a / surplus,
        0.5 / rear + 0.5 * b / surplus,
        1.0 / drag,
    ];
    for (slope, expected) in curvature.first.iter().zip(by) {
        assert!((slope / force - expected).abs() < 1e-7 * expected.abs().max(1e-7), "{slope} {expected}");
    }
    let second = |i: usize, j: usize| curvature.second[i][j] / force;
    for (value, expected) in [
        (second(0, 0), 0.75 / (m * m)),
        (second(0, 6), -0.5 / (m * drag)),
        (second(4, 4), by[4] * by[4] - 0.5 / front.powi(2) + 0.5 * (a / surplus).powi(2)),
        (second(2, 5), by[2] * by[5] - 0.5 * b * front / surplus.powi(2)),
    ] {
        assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
    }
    let swept = study.sweep(Car::thrust, &[200.0, 1000.0, 2000.0]).expect("sweep");
    assert_eq!(swept.critical.len(), 1);
    assert!((swept.critical[0].value / force - 1.0).abs() < 1e-9);
}

mechanism! {
    /// A shaft under a constant moment turns a mass on a spring that softens; the drag grows with its radius.
    mechanism Slinger {
        input moment: N*m;
        design stiffness = 20 N/m;
        body shaft: rigid(mass: 1 kg, inertia: [0.1, 0.1, 0.1] kg*m^2);
        body mass: point(mass: 1 kg);
        joint spin: revolute(z) from ground to shaft, coasting;
        joint r: prismatic(x) from shaft to mass;
        force drag: generalized(on: spin, value: moment - (0.01 N*m*s/rad + 0.02 N*s/(m*rad) * r^2) * rate(spin));
        force spring: potential(energy: stiffness * (r - 0.1 m)^2 / 2 - 100 N/m^2 * (r - 0.1 m)^3 + 200 N/m^3 * (r - 0.1 m)^4);
    }
}

/// The critical mode moves the mass outwards and slows the shaft down. Equilibria are a curve over the radius, whose
/// largest moment is the critical one.
#[test]
fn limit_point_in_position_and_speed() {
    let moment = |stiffness: f64, r: f64| {
        let x = r - 0.1;
        let force = stiffness * x - 300.0 * x * x + 800.0 * x.powi(3);
        (force / r).sqrt() * (0.01 + 0.02 * r * r)
    };
    // The maximum by bisection of the difference quotient.
    let greatest = |stiffness: f64| {
        let (mut low, mut high) = (0.1001, 0.15);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let rises = moment(stiffness, middle + 1e-6) > moment(stiffness, middle - 1e-6);
            *(if rises { &mut low } else { &mut high }) = middle;
        }
        (low, moment(stiffness, low))
    };
    let (radius, expected) = greatest(20.0);
    let study = Study::new(Slinger).start(Slinger::r, 0.1);
    let found = study.critical_state(Slinger::moment, 0.0, 1.0).expect("critical");
    assert_eq!(found.kind, SpecialKind::Fold);
    assert!((found.value / expected - 1.0).abs() < 1e-11, "{} {expected}", found.value);
    assert!((found.equilibrium.coordinates[0] - radius).abs() < 1e-6);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    let tolerance = study.critical_tolerance(Slinger::moment, 0.0, 1.0).expect("spread");
    let slope = tolerance.spread.expect("a derivative").by_design[0];
    let step = 1e-3;
    let by_difference = (greatest(20.0 + step).1 - greatest(20.0 - step).1) / (2.0 * step);
    assert!((slope / by_difference - 1.0).abs() < 1e-7, "{slope} {by_difference}");
    let values = [0.2 * expected, 0.9 * expected, 1.1 * expected];
    let swept = study.sweep(Slinger::moment, &values).expect("sweep");
    assert_eq!(swept.critical.len(), 1);
}

mechanism! {
    /// Two speeds: `u` settles at `input - slaved v^2`, and `v` grows as `(u - 5) v + cubic v^3`.
    mechanism Speeds {
        input thrust: N;
        design slaved = 0 N*s^2/m^2;
        design cubic = -1 N*s^3/m^3;
        body a: point(mass: 1 kg);
        body b: point(mass: 1 kg);
        joint u: prismatic(x) from ground to a, coasting;
        joint v: prismatic(y) from ground to b, coasting;
        force drive: generalized(on: u, value: thrust - 1 N*s/m * rate(u) - slaved * rate(v)^2);
        force grow: generalized(
            on: v,
            value: 1 N*s^2/m^2 * rate(u) * rate(v) - 5 N*s/m * rate(v) + cubic * rate(v)^3,
        );
    }
}

mechanism! {
    /// The same with positions in place of the speeds.
    mechanism Positions {
        input thrust: N;
        design slaved = 0 N/m^2;
        design cubic = -1 N/m^3;
        body a: point(mass: 1 kg);
        body b: point(mass: 1 kg);
        joint u: prismatic(x) from ground to a;
        joint v: prismatic(y) from ground to b;
        force damping_u: damper(on: u, damping: 3 N*s/m);
        force damping_v: damper(on: v, damping: 3 N*s/m);
        force drive: generalized(on: u, value: thrust - 1 N/m * u - slaved * v^2);
        force grow: generalized(on: v, value: 1 N/m^2 * u * v - 5 N/m * v + cubic * v^3);
    }
}

/// Arms at `thrust = 5 + (slaved - cubic) v^2`; the branch `v = 0` is unstable above 5.
#[test]
fn arms_of_a_pitchfork_are_on_the_soft_or_the_hard_side() {
    for (slaved, cubic, expected) in [
        (0.0, -1.0, Some(true)),
        (0.0, 1.0, Some(false)),
        (0.5, 1.0, Some(false)),
        (2.0, 1.0, Some(true)),
        (-1.5, -1.0, Some(false)),
        (1.0, 1.0, None),
    ] {
        let speeds = Study::new(Speeds).design(Speeds::slaved, slaved).design(Speeds::cubic, cubic);
        let positions = Study::new(Positions).design(Positions::slaved, slaved).design(Positions::cubic, cubic);
        for found in
            [speeds.critical_state(Speeds::thrust, 1.0, 8.0), positions.critical_state(Positions::thrust, 1.0, 8.0)]
        {
            let found = found.expect("critical");
            let kind = SpecialKind::Pitchfork { supercritical: expected };
            assert_eq!(found.kind, kind, "{slaved} {cubic}");
            assert!((found.value - 5.0).abs() < 1e-9);
        }
    }
}

mechanism! {
    /// Two speeds that start to grow one after the other.
    mechanism Twice {
        input thrust: N*s/m;
        body a: point(mass: 1 kg);
        body b: point(mass: 1 kg);
        joint x: prismatic(x) from ground to a, coasting;
        joint y: prismatic(y) from ground to b, coasting;
        joint z: prismatic(z) from ground to c, coasting;
        body c: point(mass: 1 kg);
        force on_x: generalized(on: x, value: (thrust - 1 N*s/m) * rate(x) - 1 N*s^3/m^3 * rate(x)^3);
        force on_y: generalized(on: y, value: (thrust - 1.5 N*s/m) * rate(y) - 1 N*s^3/m^3 * rate(y)^3);
        force on_z: generalized(on: z, value: (thrust - 2 N*s/m) * rate(z) - 1 N*s^3/m^3 * rate(z)^3);
    }
}

/// A branch that is already unstable does not lose its stability, whatever the sign of the determinant.
#[test]
fn only_the_loss_of_stability_is_critical() {
    let study = Study::new(Twice);
    let found = study.critical_state(Twice::thrust, 0.3, 3.0).expect("critical");
    assert!((found.value - 1.0).abs() < 1e-9, "{}", found.value);
    for (low, high) in [(1.2, 3.0), (1.7, 3.0), (3.0, 1.2)] {
        let none = study.critical_state(Twice::thrust, low, high);
        assert!(matches!(none, Err(Error::NotInRange { .. })), "{low} {high}: {none:?}");
    }
    // Along an input all of them are listed, also those at which a further motion begins to grow.
    for values in [&[0.3, 3.0][..], &[0.3, 1.2, 1.7, 3.0], &[3.0, 0.3]] {
        let swept = study.sweep(Twice::thrust, values).expect("sweep");
        let mut values: Vec<f64> = swept.critical.iter().map(|x| x.value).collect();
        values.sort_by(f64::total_cmp);
        assert_eq!(values.len(), 3, "{values:?}");
        for (found, expected) in values.iter().zip([1.0, 1.5, 2.0]) {
            assert!((found - expected).abs() < 1e-9, "{found}");
        }
    }
}

mechanism! {
    /// A boat whose drag grows as the cube of its speed.
    mechanism Boat {
        input thrust: N;
        body hull: point(mass: 1 kg);
        joint run: prismatic(x) from ground to hull, coasting;
        force drag: generalized(on: run, value: thrust - 1 N*s^3/m^3 * rate(run)^3);
    }
}

/// At rest the drag has no slope: a search that comes by there goes on.
#[test]
fn a_search_passes_a_state_without_stiffness() {
    for start in [-1.0, 0.0, 1.0, 5.0, -7.0] {
        for thrust in [3.0, -2.0, 1e-3] {
            let state = Study::new(Boat)
                .input(Boat::thrust, thrust)
                .start(Boat::run, start)
                .equilibrium()
                .unwrap_or_else(|error| panic!("{start} {thrust}: {error}"));
            let speed = thrust.cbrt();
            assert!((state.coordinates[0] - speed).abs() < 1e-9 * speed.abs(), "{start} {thrust}");
        }
    }
}

/// A sweep goes on from a value exactly at a critical one.
#[test]
fn a_sweep_leaves_a_critical_value() {
    let slinger = Study::new(Slinger).start(Slinger::r, 0.1);
    let fold = slinger.critical_state(Slinger::moment, 0.0, 1.0).expect("critical").value;
    let car = Study::new(Car).start(Car::forward, 20.0);
    let crossing = car.critical_state(Car::thrust, 200.0, 4000.0).expect("critical").value;
    let swept = [
        slinger.sweep(Slinger::moment, &[0.5 * fold, fold, 0.9 * fold, 0.5 * fold]),
        slinger.sweep(Slinger::moment, &[fold, 0.9 * fold, 0.5 * fold]),
        car.sweep(Car::thrust, &[200.0, crossing, 2000.0]),
        car.sweep(Car::thrust, &[crossing, 2000.0, 3000.0]),
        car.sweep(Car::thrust, &[crossing, 500.0, 200.0]),
    ];
    for found in swept {
        for point in &found.expect("sweep").points {
            if let Err(error) = &point.equilibrium {
                panic!("{}: {error}", point.value);
            }
        }
    }
}

mechanism! {
    /// A governor on a shaft that coasts under a constant moment: its arm leaves the axis by a pitchfork.
    mechanism Governor {
        input moment: N*m;
        gravity 9.81 m/s^2 along -z;
        body shaft: rigid(mass: 1 kg, inertia: [0.01, 0.01, 0.01] kg*m^2);
        body arm: point(mass: 1 kg, center: [0, 0, -0.3] m);
        body link: massless;
        body sleeve: point(mass: 0.5 kg);
        joint spin: revolute(z) from ground to shaft, coasting;
        joint a: revolute(-y) from shaft to arm;
        joint g: revolute(-y) from arm to link at [0, 0, -0.3 m];
        joint h: prismatic(z) from shaft to sleeve;
        joint hinge: revolute(-y) from link to sleeve at [0, 0, -0.3 m], cut;
        force slide: damper(on: h, damping: 20 N*s/m);
        force swing: damper(on: a, damping: 0.1 N*m*s/rad);
        force drive: generalized(on: spin, value: moment - 0.1 N*m*s/rad * rate(spin));
    }
}

/// `w^2 l = g (1 + 2 ms / mb)`, `moment = 0.1 w`.
#[test]
fn a_sweep_leaves_the_pitchfork_of_a_loop() {
    let study = Study::new(Governor).start(Governor::spin, 1.0).start(Governor::a, 0.0).guess(Governor::h, -0.6);
    let critical = study.critical_state(Governor::moment, 0.1, 3.0).expect("critical").value;
    assert!((critical - 0.1 * (9.81 * 2.0 / 0.3_f64).sqrt()).abs() < 1e-9);
    for values in [[0.1, critical, 0.5], [critical, 0.4, 0.1], [critical, 1.0, 3.0]] {
        let found = study.sweep(Governor::moment, &values).expect("sweep");
        for point in &found.points {
            if let Err(error) = &point.equilibrium {
                panic!("{}: {error}", point.value);
            }
        }
    }
}

mechanism! {
    /// Two masses that push each other unequally; the spring of one softens.
    mechanism Unequal {
        input thrust: N;
        design there = 0.5 N/m;
        design back = 0.3 N/m;
        body a: point(mass: 1 kg);
        body b: point(mass: 2 kg);
        joint x: prismatic(x) from ground to a;
        joint y: prismatic(y) from ground to b;
        force on_x: generalized(on: x, value: thrust - 1 N/m * x + 1 N/m^2 * x^2 - back * y);
        force on_y: generalized(on: y, value: there * x - 1 N/m * y);
    }
}

/// `thrust = k x - x^2` with `k = 1 + there back` is greatest at `k / 2`. Two eigenvalues meet in zero there.
#[test]
fn limit_point_without_a_symmetric_stiffness() {
    let study = Study::new(Unequal);
    let found = study.critical_state(Unequal::thrust, 0.0, 1.0).expect("critical");
    let k = 1.0 + 0.5 * 0.3;
    assert_eq!(found.kind, SpecialKind::Fold);
    assert!((found.value - k * k / 4.0).abs() < 1e-12, "{}", found.value);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    let curvature = study.critical_curvature(Unequal::thrust, 0.0, 1.0).expect("curvature");
    for (slope, expected) in curvature.first.iter().zip([0.15 * k, 0.25 * k]) {
        assert!((slope - expected).abs() < 1e-10, "{slope} {expected}");
    }
    let mixed = 0.5 * k + 0.5 * 0.5 * 0.3;
    assert!((curvature.second[0][1] - mixed).abs() < 1e-6);
}
