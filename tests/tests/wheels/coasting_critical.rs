//! Critical values whose mode lies in the speeds of coasting coordinates.

use eigentol::branches::{BranchEnd, SpecialKind};
use eigentol::{Stability, Study, mechanism};

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

/// The rotor pulls out at `load = pull_out`, where it lags by `slip`.
#[test]
fn pull_out_of_a_motor() {
    let study = Study::new(Motor).start(Motor::spin, 95.0);
    let found = study
        .critical_state(Motor::load, 0.0, 2.0)
        .expect("critical");
    assert_eq!(found.kind, SpecialKind::Fold);
    assert!((found.value - 1.0).abs() < 1e-12, "{}", found.value);
    assert!((found.equilibrium.coordinates[0] - 80.0).abs() < 1e-4);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    // `v^T J v = 1`.
    assert!((found.v[0] - 10.0).abs() < 1e-12 && (found.w[0] - 10.0).abs() < 1e-12);

    let spread = study
        .critical_tolerance(Motor::load, 0.0, 2.0)
        .expect("spread");
    let spread = spread.spread.expect("a derivative");
    for (slope, expected) in spread.by_design.iter().zip([1.0, 0.0, 0.0]) {
        assert!((slope - expected).abs() < 1e-12, "{slope}");
    }
    assert!((spread.sigma - 0.01 / 3.0).abs() < 1e-14);
    let curvature = study
        .critical_curvature(Motor::load, 0.0, 2.0)
        .expect("curvature");
    let second = curvature.second.as_flattened();
    assert!(second.iter().all(|value| value.abs() < 1e-6), "{second:?}");
}

#[test]
fn the_branch_turns_back_at_pull_out() {
    let study = Study::new(Motor).start(Motor::spin, 95.0);
    let found = study.branches(Motor::load, 0.1, 2.0).expect("branches");
    let [branch] = &found.branches[..] else {
        panic!("one branch: {found}")
    };
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
    let (m, a, b, front, rear, drag): (f64, f64, f64, f64, f64, f64) =
        (1500.0, 1.8, 1.0, 60e3, 80e3, 40.0);
    let length = a + b;
    let surplus = a * front - b * rear;
    let force = drag * (length * length * front * rear / (m * surplus)).sqrt();
    let study = Study::new(Car)
        .input(Car::thrust, 800.0)
        .start(Car::forward, 20.0);
    let found = study
        .critical_state(Car::thrust, 200.0, 4000.0)
        .expect("critical");
    assert!(
        matches!(found.kind, SpecialKind::Pitchfork { .. }),
        "{:?}",
        found.kind
    );
    assert!(
        (found.value / force - 1.0).abs() < 1e-9,
        "{} {force}",
        found.value
    );
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });

    let curvature = study
        .critical_curvature(Car::thrust, 200.0, 4000.0)
        .expect("curvature");
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
        assert!(
            (slope / force - expected).abs() < 1e-7 * expected.abs().max(1e-7),
            "{slope} {expected}"
        );
    }
    let second = |i: usize, j: usize| curvature.second[i][j] / force;
    for (value, expected) in [
        (second(0, 0), 0.75 / (m * m)),
        (second(0, 6), -0.5 / (m * drag)),
        (
            second(4, 4),
            by[4] * by[4] - 0.5 / front.powi(2) + 0.5 * (a / surplus).powi(2),
        ),
        (
            second(2, 5),
            by[2] * by[5] - 0.5 * b * front / surplus.powi(2),
        ),
    ] {
        assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
    }
    let swept = study
        .sweep(Car::thrust, &[200.0, 1000.0, 2000.0])
        .expect("sweep");
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
    let found = study
        .critical_state(Slinger::moment, 0.0, 1.0)
        .expect("critical");
    assert_eq!(found.kind, SpecialKind::Fold);
    assert!(
        (found.value / expected - 1.0).abs() < 1e-11,
        "{} {expected}",
        found.value
    );
    assert!((found.equilibrium.coordinates[0] - radius).abs() < 1e-6);
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    let tolerance = study
        .critical_tolerance(Slinger::moment, 0.0, 1.0)
        .expect("spread");
    let slope = tolerance.spread.expect("a derivative").by_design[0];
    let step = 1e-3;
    let by_difference = (greatest(20.0 + step).1 - greatest(20.0 - step).1) / (2.0 * step);
    assert!(
        (slope / by_difference - 1.0).abs() < 1e-7,
        "{slope} {by_difference}"
    );
    let values = [0.2 * expected, 0.9 * expected, 1.1 * expected];
    let swept = study.sweep(Slinger::moment, &values).expect("sweep");
    assert_eq!(swept.critical.len(), 1);
}
