//! Sweeps solved in vectors against sweeps solved one value at a time: the same states, modes, labels, derivatives and
//! critical states up to rounding, and the same bits with every instruction set.

use std::mem::discriminant;
use std::ops::ControlFlow;

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{BatchKernels, Kernels};
use eigentol::modes::modes_of;
use eigentol::scalar::Instructions;
use eigentol::sensitivity::sensitivities;
use eigentol::sweep::sensitivity_sweep;
use eigentol::sweep::{Following, Sweep, SweepPoint, sweep};
use eigentol::tolerance::ModeTolerance;
use eigentol::{Error, Family, Input, Policy, Sensitivities, Study, Vector, mechanism};

mechanism! {
    mechanism Single {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    mechanism Double {
        input omega: rad/s;
        input load: N;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m;
        design l2 = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        force pull: potential(energy: load * l1 * cos(theta1));
    }
}

mechanism! {
    /// Coordinates of different kinds; a mass that an input sets.
    mechanism Triple {
        input omega: rad/s;
        input m: kg;
        design l1 = 1.0 m;
        design l2 = 0.7 m;
        design k = 400.0 N/m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: 3.0 kg, length: l1, along: -z);
        body bar2: rod(mass: 2.0 kg, length: l2, along: -z);
        body slider: point(mass: m);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        joint x: prismatic(z) from bar2 to slider at [0, 0, -l2 / 2];
        force spring: spring(on: x, stiffness: k);
    }
}

mechanism! {
    /// Two oscillators whose frequencies cross, a third one beside them, and one that hangs on a joint of three turns.
    mechanism Crossing {
        input k: N/m;
        design c = 100.0 N/m;
        gravity 9.81 m/s^2 along -z;
        body left: point(mass: 1.0 kg);
        body right: point(mass: 2.0 kg);
        body bob: box(mass: 1.0 kg, size: [0.1 m, 0.2 m, 0.3 m]);
        joint x: prismatic(x) from ground to left;
        joint y: prismatic(x) from ground to right;
        joint hang: spherical(yaw: x, pitch: y, roll: z) from ground to bob at [0, 0, 1 m], at [0, 0, 0.5 m] on bob;
        force first: spring(on: x, stiffness: k);
        force second: spring(on: y, stiffness: c);
        force twist: spring(on: roll, stiffness: 2.0 N*m/rad);
    }
}

mechanism! {
    /// Overdamped or not, by the damper: two real eigenvalues or a pair.
    mechanism Damped {
        input c: N*s/m;
        design m = 2.0 kg;
        design k = 8.0 N/m;
        body block: point(mass: m);
        joint x: prismatic(x) from ground to block;
        force spring: spring(on: x, stiffness: k);
        force friction: damper(on: x, damping: c);
    }
}

mechanism! {
    /// A weight on a cart that a rod holds.
    mechanism Held {
        input load: N;
        design m = 2.0 kg;
        design l = 1.5 m;
        gravity 9.81 m/s^2 along -z;
        body cart: point(mass: 1.0 kg);
        body bar: rod(mass: m, length: 1.0 m, along: -z);
        joint x: prismatic(x) from ground to cart;
        joint theta: revolute(y) from cart to bar;
        point wall: ground at [-1 m, 0, 0];
        point end: bar at [0, 0, -1 m];
        constraint hold: distance(from: wall, to: end, length: l);
        force spring: spring(on: x, stiffness: 30.0 N/m);
        force pull: potential(energy: load * x);
    }
}

fn nominal(m: &dyn Kernels) -> Vector {
    let description = m.description();
    description.design.iter().map(|info| info.nominal).collect()
}

fn near(a: f64, b: f64, scale: f64) {
    assert!((a - b).abs() <= 1e-10 * (scale + a.abs()), "{a:e} {b:e}");
}

/// Sweeps with every instruction set, compares with values solved one by one, and returns that sweep and the number of
/// states that rounding shows to be solved in vectors.
fn compare<M>(m: &dyn BatchKernels, u: &[f64], start: &[f64], input: Input<M>, values: &[f64]) -> (Sweep, usize) {
    let input = input.any();
    let b = nominal(m);
    let following = |vectors| Following::from(Policy::Stable).vectors(vectors);
    let run = |vectors| sweep(m, u, &b, start, following(vectors), input, values);
    let run = |vectors| run(vectors).expect("an input of the mechanism");
    let alone = run(None);
    let first = run(Some(Instructions::SCALAR));
    for set in Instructions::available() {
        let other = format!("{:?}", run(Some(set)));
        assert!(other == format!("{first:?}"), "{set:?}");
    }
    assert_eq!(first.points.len(), values.len());
    assert_eq!(first.critical.len(), alone.critical.len());
    for (own, other) in first.critical.iter().zip(&alone.critical) {
        near(own.value, other.value, 1.0);
    }
    let mut side_by_side = 0;
    for ((point, other), &value) in first.points.iter().zip(&alone).zip(values) {
        assert!(point.value == value || value.is_nan());
        let (state, expected) = match (&point.equilibrium, &other.equilibrium) {
            (Ok(state), Ok(expected)) => (state, expected),
            (equilibrium, other) => {
                assert_eq!(format!("{equilibrium:?}"), format!("{other:?}"));
                continue;
            }
        };
        side_by_side += usize::from(format!("{state:?}") != format!("{expected:?}"));
        let n = state.coordinates.len();
        for i in 0..n {
            near(state.coordinates[i], expected.coordinates[i], 1.0);
            for j in 0..n {
                near(state.linear.mass[i][j], expected.linear.mass[i][j], 1.0);
                let size = expected.linear.stiffness[i][i].abs();
                near(state.linear.stiffness[i][j], expected.linear.stiffness[i][j], size);
            }
        }
        assert_eq!(state.inputs, expected.inputs);
        assert_eq!(state.design, expected.design);
        assert_eq!(state.stability, expected.stability);
        assert_eq!(state.left_unstable_region, expected.left_unstable_region);
        assert!(state.relative_residual <= 1e-10);
        assert_eq!(state.pose.is_some(), expected.pose.is_some());
        if let (Some(pose), Some(other)) = (&state.pose, &expected.pose) {
            near(pose.margin, other.margin, 1.0);
        }
        let (Ok(modes), Ok(expected)) = (&point.modes, &other.modes) else {
            panic!("{:?} {:?}", point.modes, other.modes);
        };
        assert_eq!(modes.modes.len(), expected.modes.len());
        for (mode, expected) in modes.modes.iter().zip(expected.modes.iter()) {
            assert_eq!(mode.label, expected.label, "at {value}");
            near(mode.lambda, expected.lambda, 1.0);
            near(mode.s.im, expected.s.im, 1.0);
            assert!(mode.residual <= 1e-12);
            for (component, other) in mode.shape.iter().zip(&expected.shape) {
                near(component.re, other.re, 1.0);
            }
        }
    }
    derivatives(m, (u, &b), start, (input, values), &first);
    (first, side_by_side)
}

/// Derivatives along the sweep against those at each of its states.
fn derivatives(
    m: &dyn BatchKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    (input, values): (Input, &[f64]),
    along: &Sweep,
) {
    let run = |set| {
        let following = Following::from(Policy::Stable).vectors(Some(set));
        let mut all: Vec<Result<Sensitivities, Error>> = Vec::new();
        let mut points = along.points.iter();
        let each = |point: &_, slopes: &Result<Sensitivities, Error>| {
            let kept = points.next().map(|point| format!("{point:?}"));
            assert_eq!(Some(format!("{point:?}")), kept);
            all.push(slopes.clone());
            ControlFlow::Continue(())
        };
        sensitivity_sweep(m, (u, b), start, following, (input, values), each).expect("an input of the mechanism");
        all
    };
    let first = run(Instructions::SCALAR);
    for set in Instructions::available() {
        assert!(format!("{:?}", run(set)) == format!("{first:?}"), "{set:?}");
    }
    assert_eq!(first.len(), values.len());
    for (slopes, point) in first.iter().zip(along) {
        let (Ok(state), Ok(modes)) = (&point.equilibrium, &point.modes) else {
            assert!(slopes.is_err());
            continue;
        };
        match (slopes, sensitivities(m, state, modes)) {
            (Ok(slopes), Ok(expected)) => {
                assert_eq!(slopes.method, expected.method);
                assert_eq!(slopes.modes.len(), expected.modes.len());
                for (mode, other) in slopes.modes.iter().zip(expected.modes.iter()) {
                    assert_eq!(mode.clustered, other.clustered);
                    let lists = [
                        (&mode.lambda.by_input[..], &other.lambda.by_input[..]),
                        (&mode.lambda.by_design, &other.lambda.by_design),
                    ];
                    for (own, other) in lists {
                        let size = other.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                        own.iter().zip(other).for_each(|(a, b)| near(*a, *b, size));
                    }
                    assert_eq!(mode.frequency().is_some(), other.frequency().is_some());
                    if let (Some(own), Some(other)) = (mode.frequency(), other.frequency()) {
                        let slopes = own.by_design.iter().zip(&other.by_design);
                        slopes.for_each(|(a, b)| near(*a, *b, 1.0));
                    }
                }
            }
            (slopes, other) => assert_eq!(format!("{slopes:?}"), format!("{other:?}")),
        }
    }
}

fn steps(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}

#[test]
fn neighbouring_values_are_solved_side_by_side() {
    for count in [9, 12, 17, 60] {
        let values = steps(4.5, 8.0, count);
        let (_, together) = compare(&Single, &[0.0], &[1.0], Single::omega, &values);
        let (_, also) = compare(&Double, &[0.0, 0.0], &[1.0, 0.1], Double::omega, &values);
        let (_, three) = compare(&Triple, &[0.0, 0.5], &[1.0, 0.1, 0.0], Triple::omega, &values);
        if count == 60 {
            let least = together.min(also).min(three);
            assert!(least >= 30, "{together} {also} {three}");
        }
    }
}

#[test]
fn critical_speeds_are_passed_as_one_by_one() {
    for (low, high) in [(0.5, 8.0), (8.0, 0.5), (2.6, 2.8), (3.9, 2.5)] {
        for count in [25, 70, 201] {
            let values = steps(low, high, count);
            let (single, _) = compare(&Single, &[0.0], &[0.9], Single::omega, &values);
            let crossed = |critical: f64| (low - critical) * (high - critical) < 0.0;
            let natural = (3.0_f64 * 9.81 / 2.0).sqrt();
            assert_eq!(single.critical.len(), usize::from(crossed(natural)));
            compare(&Double, &[0.0, 0.0], &[0.9, 0.1], Double::omega, &values);
        }
    }
}

#[test]
fn another_input_than_a_speed() {
    let values = steps(-20.0, 20.0, 50);
    compare(&Double, &[6.0, 0.0], &[1.0, 0.1], Double::load, &values);
    let masses = steps(0.2, 1.5, 40);
    compare(&Triple, &[5.0, 0.5], &[1.0, 0.1, 0.0], Triple::m, &masses);
}

#[test]
fn impossible_values_repeated_ones_and_leaps_keep_their_own_answer() {
    // A mass that becomes negative along the sweep and then positive again.
    let mut masses = steps(1.0, -0.5, 30);
    masses.extend(steps(0.3, 0.9, 30));
    let (found, _) = compare(&Triple, &[5.0, 0.5], &[1.0, 0.1, 0.0], Triple::m, &masses);
    assert!(found.points.iter().any(|point| point.equilibrium.is_err()));
    let mut values = steps(5.0, 6.0, 20);
    values.extend([6.0, 6.0, 6.0, f64::NAN, f64::INFINITY, 9.0, 2.0, 2.1, 2.2]);
    values.extend(steps(2.3, 9.0, 31));
    values.extend([7.0; 12]);
    compare(&Double, &[0.0, 0.0], &[1.0, 0.1], Double::omega, &values);
    compare(&Single, &[0.0], &[1.0], Single::omega, &values);
}

#[test]
fn modes_keep_their_labels_where_frequencies_cross() {
    // x has the frequency of y at k = c m_x / m_y = 50 N/m, which is at none of the values, or at one.
    for values in [steps(20.0, 90.0, 64), steps(20.0, 80.0, 31)] {
        let start = &[0.01, 0.01, 0.2, 0.1, 0.0];
        let (found, _) = compare(&Crossing, &[20.0], start, Crossing::k, &values);
        let labels = |point: usize| -> Vec<usize> {
            let modes = found.points[point].modes.as_ref().expect("modes");
            modes.modes.iter().map(|mode| mode.label).collect()
        };
        assert_eq!(labels(0), labels(found.points.len() - 1));
    }
}

#[test]
fn other_policies_and_families_go_one_by_one() {
    let values = steps(4.5, 8.0, 40);
    let design = nominal(&Double);
    let run = |policy, family, vectors| {
        let following = Following::default().policy(policy).family(family).vectors(vectors);
        let found = sweep(&Double, &[0.0, 0.0], &design, &[1.0, 0.1], following, Double::omega.any(), &values);
        format!("{found:?}")
    };
    let best = Some(Instructions::best());
    for (policy, family) in [(Policy::Nearest, None), (Policy::Stable, Some(Family::General))] {
        assert_eq!(run(policy, family, best), run(policy, family, None));
    }
    assert_ne!(run(Policy::Stable, None, best), run(Policy::Stable, None, None));
}

/// Solves one value after another, and compares every state, its modes and their derivatives with those computed from
/// scratch there. Returns how many values had all of them, and how often consecutive sets of modes differ in number or
/// kind.
fn from_nothing(
    m: &dyn BatchKernels,
    (u, start): (&[f64], &[f64]),
    (policy, family): (Policy, Option<Family>),
    (input, values): (Input, &[f64]),
) -> (usize, usize) {
    let b = nominal(m);
    let following = Following::from(policy).family(family).vectors(None);
    let (mut solved, mut changes, mut kinds) = (0, 0, Vec::new());
    let each = |point: &SweepPoint, slopes: &Result<Sensitivities, Error>| {
        let (Ok(state), Ok(modes)) = (&point.equilibrium, &point.modes) else {
            assert!(slopes.is_err());
            return ControlFlow::Continue(());
        };
        assert_eq!(*slopes, sensitivities(m, state, modes));
        let again = equilibrium(m, &state.inputs, &b, &state.coordinates, policy).expect("found");
        assert_eq!(again.inputs, state.inputs);
        assert_eq!(again.design, state.design);
        assert_eq!(again.stability, state.stability);
        assert_eq!(again.constraints, state.constraints);
        assert_eq!(again.pose.is_some(), state.pose.is_some());
        let entries = [
            (&again.linear.mass, &state.linear.mass),
            (&again.linear.damping, &state.linear.damping),
            (&again.linear.stiffness, &state.linear.stiffness),
        ];
        for (a, b) in entries {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            pairs.for_each(|(a, b)| near(*a, *b, 10.0));
        }
        let fresh = modes_of(&again.linear, modes.family, &again.description).expect("modes");
        assert_eq!(fresh.modes.len(), modes.modes.len());
        assert_eq!(fresh.damping_ignored, modes.damping_ignored);
        assert_eq!(modes.inputs, state.inputs);
        for mode in &modes.modes {
            let same = fresh.modes.iter().find(|other| {
                let apart = (other.s - mode.s).norm();
                apart < 1e-7 && discriminant(&other.behaviour) == discriminant(&mode.behaviour)
            });
            let same = same.unwrap_or_else(|| panic!("{}: {mode:?}", point.value));
            for (a, b) in same.shape.iter().zip(&mode.shape) {
                near(a.re, b.re, 1e4);
                near(a.im, b.im, 1e4);
            }
        }
        let mut derived: Vec<_> =
            (modes.modes.iter()).map(|mode| format!("{:?}", discriminant(&mode.behaviour))).collect();
        derived.sort();
        changes += usize::from(solved > 0 && derived != kinds);
        kinds = derived;
        solved += 1;
        ControlFlow::Continue(())
    };
    sensitivity_sweep(m, (u, &b), start, following, (input, values), each).expect("an input of the mechanism");
    (solved, changes)
}

#[test]
fn nothing_of_an_earlier_value_is_left_in_a_later_one() {
    let there_and_back = |low, high| -> Vec<f64> {
        let there = steps(low, high, 23);
        let back = there.iter().rev().copied();
        there.iter().copied().chain(back).collect()
    };
    // Hanging straight down: modes diverge above the critical speed, the second one too at higher speed.
    let values = there_and_back(0.5, 9.0);
    let hanging = (&[0.0, 0.0][..], &[0.0, 0.0][..]);
    for family in [None, Some(Family::General)] {
        let along = (Double::omega.any(), &values[..]);
        let found = from_nothing(&Double, hanging, (Policy::Nearest, family), along);
        assert_eq!(found.0, values.len());
        assert!(found.1 >= 2, "{found:?}");
    }
    // On stable branches, and with impossible values of the mechanism.
    let along = (Double::omega.any(), &values[..]);
    let out = (&[0.0, 0.0][..], &[0.3, 0.1][..]);
    let found = from_nothing(&Double, out, (Policy::Stable, None), along);
    assert!(found.0 > 30, "{found:?}");
    let masses = [1.0, 1.1, 1.2, -1.0, 1.3, f64::NAN, 1.4, 1.5];
    let along = (Triple::m.any(), &masses[..]);
    let lying = (&[5.0, 1.0][..], &[0.9, 0.1, 0.0][..]);
    let found = from_nothing(&Triple, lying, (Policy::Stable, None), along);
    assert_eq!(found.0, 6);
    // One mode or two: critical damping is 8 N s/m.
    let values = there_and_back(1.0, 15.3);
    for family in [None, Some(Family::Undamped)] {
        let along = (Damped::c.any(), &values[..]);
        let rest = (&[1.0][..], &[0.0][..]);
        let found = from_nothing(&Damped, rest, (Policy::Stable, family), along);
        let expected = if family.is_none() { 2 } else { 0 };
        assert_eq!(found, (values.len(), expected));
    }
    // With reactions among the unknowns.
    let values = there_and_back(-4.0, 5.0);
    let along = (Held::load.any(), &values[..]);
    let start = (&[0.0][..], &[0.0, 0.0, 0.0][..]);
    let found = from_nothing(&Held, start, (Policy::Stable, None), along);
    assert_eq!(found.0, values.len());
}

#[test]
fn spreads_along_a_sweep_are_those_of_each_value() {
    let study = Study::new(Double)
        .start(Double::theta1, 1.0)
        .relative_tolerance(Double::l1, 0.03)
        .relative_tolerance(Double::m2, 0.02);
    let values = steps(4.5, 8.0, 40);
    let along = study.first_order_sweep(Double::omega, &values).expect("an input of the mechanism");
    assert_eq!(along.len(), values.len());
    for (found, &value) in along.iter().zip(&values) {
        let alone = study.clone().input(Double::omega, value).first_order();
        let (Ok(found), Ok(alone)) = (found, alone) else {
            panic!("{found:?}");
        };
        for (own, other) in found.modes.iter().zip(alone.modes.iter()) {
            let frequency = |mode: &ModeTolerance| mode.frequency().expect("it swings");
            let (found, alone) = (frequency(own), frequency(other));
            near(found.mean, alone.mean, 1.0);
            near(found.sigma, alone.sigma, 1.0);
            let shares = own.variance_shares().iter().zip(other.variance_shares());
            shares.for_each(|(a, b)| near(*a, *b, 1.0));
        }
    }
    let foreign = study.first_order_sweep(Input::new(7), &values);
    assert!(matches!(foreign, Err(Error::UnknownHandle { .. })));
}

/// Central differences of frequencies, each computed from scratch at a changed design, one by one.
#[test]
fn derivatives_along_a_sweep_are_what_differences_show() {
    let values = steps(4.5, 8.0, 24);
    let start = [1.0, 0.1];
    let design = nominal(&Double);
    let squares = |design: &[f64]| -> Vec<[f64; 2]> {
        let following = Following::from(Policy::Stable).vectors(None);
        let found = sweep(&Double, &[0.0, 3.0], design, &start, following, Double::omega.any(), &values);
        let found = found.expect("an input of the mechanism");
        let modes = found.points.iter().map(|point| point.modes.as_ref().expect("modes"));
        modes.map(|modes| [0, 1].map(|r| modes.modes[r].lambda)).collect()
    };
    let mut slopes = Vec::new();
    let each = |_: &SweepPoint, sensitivities: &Result<Sensitivities, Error>| {
        let found = sensitivities.as_ref().expect("derivatives");
        slopes.push([0, 1].map(|r| found.modes[r].lambda.by_design.clone()));
        ControlFlow::Continue(())
    };
    let along = (Double::omega.any(), &values[..]);
    sensitivity_sweep(&Double, (&[0.0, 3.0], &design), &start, Policy::Stable, along, each)
        .expect("an input of the mechanism");
    for j in 0..4 {
        let at = |step: f64| {
            let mut moved = design.clone();
            moved[j] += step;
            squares(&moved)
        };
        let step = 1e-5;
        let (above, below) = (at(step), at(-step));
        for (point, slopes) in slopes.iter().enumerate() {
            for r in 0..2 {
                let expected = (above[point][r] - below[point][r]) / (2.0 * step);
                let scale = slopes[r].iter().fold(1.0, |most: f64, x| most.max(x.abs()));
                let error = (slopes[r][j] - expected).abs();
                assert!(error <= 1e-7 * scale, "{point} {r} {j}: {error:e} of {scale:e}");
            }
        }
    }
}

/// Above its critical speed a uniform bar has `lambda = u^2 - (3 g / 2 l)^2 / u^2`.
#[test]
fn a_bar_along_its_speeds_is_the_closed_form() {
    let (l, gravity) = (1.0_f64, 9.81);
    let values = steps(4.2, 9.0, 64);
    let mut seen = 0;
    let each = |point: &SweepPoint, slopes: &Result<Sensitivities, Error>| {
        let (Ok(state), Ok(modes), Ok(slopes)) = (&point.equilibrium, &point.modes, slopes) else {
            panic!("{point:?}");
        };
        let (u, w) = (point.value, 1.5 * gravity / l);
        near(state.coordinates[0].cos(), w / (u * u), 0.0);
        near(modes.modes[0].lambda, u * u - (w / u).powi(2), 0.0);
        let mode = &slopes.modes[0];
        near(mode.lambda.by_input[0], 2.0 * u + 2.0 * w * w / u.powi(3), 0.0);
        near(mode.lambda.by_design[0], 0.0, 1.0);
        near(mode.lambda.by_design[1], 2.0 * w * w / (l * u * u), 0.0);
        let by_length = mode.frequency().map(|slopes| slopes.by_design[1]);
        let omega = modes.modes[0].lambda.sqrt();
        near(by_length.unwrap_or(0.0), w * w / (l * u * u * omega), 0.0);
        seen += 1;
        ControlFlow::Continue(())
    };
    let b = nominal(&Single);
    let along = (Single::omega.any(), &values[..]);
    sensitivity_sweep(&Single, (&[0.0], &b), &[1.0], Policy::Stable, along, each).expect("an input of the mechanism");
    assert_eq!(seen, values.len());
}
