//! Folds, pitchforks and critical speeds of mechanisms with constraints.

use eigentol::branches::{BranchEnd, Continuation, SpecialKind, branches};
use eigentol::kernels::CurvatureKernels;
use eigentol::sweep::{Range, critical_state, crossings};
use eigentol::sweep::{critical_sensitivity, crossing_sensitivity};
use eigentol::{Input, Policy, Stability};

use crate::common::derived::Derived;
use crate::constrained_modes::compare::{all_near, near, nominal};
use crate::constrained_modes::holonomic::{
    Bar, Chain, ChainByAngles, Press, PressByAngle, Spherical, SphericalByPlane,
};
use crate::critical_curvature::Case;

const OMEGA: Input = Input::new(0);

fn through(low: f64, high: f64) -> Range {
    Range::new(OMEGA, low, high).steps(20)
}

/// `sqrt(3 g / (2 L))` and its derivatives by `m`, `L`, `g`.
fn critical() -> (f64, [f64; 3]) {
    let speed = (1.5 * 9.81_f64).sqrt();
    (speed, [0.0, -0.5 * speed, 0.5 * speed / 9.81])
}

#[test]
fn the_critical_speed_of_a_bar_by_its_tip() {
    let b = nominal::<Bar<1>>();
    let (speed, slopes) = critical();
    let mechanism = Derived(Bar::<1>);
    let start = [0.3, 0.9, 0.0];
    let found = critical_state(&mechanism, &[0.0], &b, &start, through(0.5, 6.0)).unwrap();
    near(found.value, speed, 1e-13, speed);
    assert_eq!(found.kind, SpecialKind::Pitchfork { supercritical: Some(true) });
    assert_eq!(found.equilibrium.stability, Stability::Neutral { zero: 1 });
    all_near(&found.v, &[1.0, 0.0, 0.0], 1e-9);
    all_near(&critical_sensitivity(&mechanism, &found).unwrap(), &slopes, 1e-9);

    // The same bar with its length stated twice.
    let twice = Derived(Bar::<2>);
    let start = [0.3, 0.9, 0.0, 0.0];
    let found = critical_state(&twice, &[0.0], &b, &start, through(0.5, 6.0)).unwrap();
    near(found.value, speed, 1e-13, speed);
    all_near(&critical_sensitivity(&twice, &found).unwrap(), &slopes, 1e-9);
}

/// Second derivatives of `(3 g / 2 L)^(1/2)` with a constraint stated once and twice, and of a limit point in minimal
/// coordinates and with a loop.
#[test]
fn critical_values_bend_with_the_design() {
    let bar = |machine: &dyn CurvatureKernels, start: &[f64]| {
        let found = Case { machine, b: &nominal::<Bar<1>>(), start, between: (0.5, 6.0) }.curvature();
        let (speed, _) = critical();
        let g = 9.81;
        let mixed = -0.25 * speed / g;
        all_near(&found.second[0], &[0.0; 3], 1e-9);
        all_near(&found.second[1], &[0.0, 0.75 * speed, mixed], 1e-9);
        all_near(&found.second[2], &[0.0, mixed, mixed / g], 1e-9);
    };
    bar(&Derived(Bar::<1>), &[0.3, 0.9, 0.0]);
    bar(&Derived(Bar::<2>), &[0.3, 0.9, 0.0, 0.0]);
    let press = |machine: &dyn CurvatureKernels, start: &[f64]| {
        Case { machine, b: &nominal::<Press>(), start, between: (1.0, 40.0) }.curvature()
    };
    let angle = press(&Derived(PressByAngle), &[0.8]);
    let own = press(&Derived(Press), &[0.8, 0.61, 0.0]);
    for (own, angle) in own.second.iter().zip(angle.second.iter()) {
        all_near(own, angle, 1e-8);
    }
}

#[test]
fn a_bar_by_its_tip_has_both_arms_of_its_pitchfork() {
    let b = nominal::<Bar<1>>();
    let settings = Continuation::new(OMEGA, 1.0, 8.0);
    let found = branches(&Derived(Bar::<1>), &[0.0], &b, &[0.1, 1.0, 0.0], &settings, None);
    let found = found.unwrap();
    assert_eq!(found.branches.len(), 3);
    let (speed, _) = critical();
    let special = found.special();
    assert_eq!(special.len(), 1);
    near(special[0].value, speed, 1e-12, speed);
    let mut ends = Vec::new();
    for branch in &found.branches {
        assert!(branch.points.len() < 80, "{} points", branch.points.len());
        for point in &branch.points {
            let [x, z, force] = point.equilibrium.coordinates[..] else { panic!("three unknowns") };
            near(x.hypot(z), 1.0, 1e-12, 1.0);
            let omega = point.value;
            if x.abs() > 1e-6 {
                near(z, speed * speed / (omega * omega), 1e-9, 1.0);
            }
            // Along the bar: weight and centrifugal force.
            let held = 3.0 * (9.81 / 2.0 * z + omega * omega * x * x / 3.0);
            near(force, held, 1e-8, held);
            let stable = point.equilibrium.stability == Stability::Stable;
            if (omega - speed).abs() > 1e-6 {
                assert_eq!(stable, x.abs() > 1e-6 || omega < speed);
            }
        }
        if branch.ends.contains(&BranchEnd::BranchPoint) {
            ends.push(branch.points.iter().map(|point| point.equilibrium.coordinates[0]).sum::<f64>());
        }
    }
    assert_eq!(ends.len(), 2);
    assert!(ends[0] * ends[1] < 0.0, "both arms lie on one side");
}

#[test]
fn a_press_gives_way_at_its_greatest_torque() {
    let b = nominal::<Press>();
    let angle = critical_state(&Derived(PressByAngle), &[0.0], &b, &[0.8], through(0.0, 40.0)).unwrap();
    assert_eq!(angle.kind, SpecialKind::Fold);
    let start = [0.8, 0.61, 0.0];
    let own = critical_state(&Derived(Press), &[0.0], &b, &start, through(0.0, 40.0)).unwrap();
    assert_eq!(own.kind, SpecialKind::Fold);
    near(own.value, angle.value, 1e-12, angle.value);
    let wanted = critical_sensitivity(&Derived(PressByAngle), &angle).unwrap();
    let found = critical_sensitivity(&Derived(Press), &own).unwrap();
    all_near(&found, &wanted, 1e-9);
    // The branch turns back at the limit; it is followed on both sides.
    let settings = Continuation::new(OMEGA, 0.0, 40.0);
    let found = branches(&Derived(Press), &[0.0], &b, &start, &settings, None).unwrap();
    let folds = found.special();
    assert!(folds.iter().any(|fold| fold.kind == SpecialKind::Fold));
    assert!(found.stable().next().is_some());
}

#[test]
fn resonances_lie_where_minimal_coordinates_have_them() {
    let b = nominal::<Chain>();
    let range = through(0.1, 5.0);
    let other = crossings(&Derived(ChainByAngles), &[0.0], &b, &[0.3, 0.4], Policy::Stable, range, 2.0).unwrap();
    let start = [0.24, 0.76, 0.5, 1.2, 0.0, 0.0];
    let own = crossings(&Derived(Chain), &[0.0], &b, &start, Policy::Stable, range, 2.0).unwrap();
    assert!(!other.is_empty());
    assert_eq!(own.len(), other.len());
    for (own, other) in own.iter().zip(&other) {
        near(own.value, other.value, 1e-11, other.value);
        let wanted = crossing_sensitivity(&Derived(ChainByAngles), other).unwrap();
        let found = crossing_sensitivity(&Derived(Chain), own).unwrap();
        all_near(&found, &wanted, 1e-8);
    }
}

/// On springs that pull towards the axis a spinning pendulum loses its stiffness where `kx + m g / L = m omega^2`.
#[test]
fn a_general_mechanism_loses_its_stiffness_where_its_shadow_does() {
    let mut b = nominal::<Spherical>();
    b[5] = 0.0;
    let [m, length, kx, ..] = b;
    let speed = (kx / m + 9.81 / length).sqrt();
    let range = through(0.2, 4.5);
    let other = critical_state(&Derived(SphericalByPlane), &[0.0], &b, &[0.1, 0.1], range).unwrap();
    let start = [0.1, 0.1, 1.1, 0.0];
    let own = critical_state(&Derived(Spherical), &[0.0], &b, &start, range).unwrap();
    assert!(matches!(own.kind, SpecialKind::Pitchfork { .. }));
    assert_eq!(own.kind, other.kind);
    near(own.value, speed, 1e-12, speed);
    let disturbed = critical_sensitivity(&Derived(Spherical), &own);
    assert!(disturbed.is_err(), "an offset destroys the pitchfork");
}
