//! A quantity that is zero except for rounding is reported as zero, and no other: equilibria, modes and reports agree.

use std::sync::Arc;

use eigentol::kernels::Linear;
use eigentol::modes::{modes, modes_of};
use eigentol::summary::Doubt;
use eigentol::{
    Behaviour, Coordinate, DampingKind, Description, DesignVariable, Family, Input, Matrix, Policy, Real, Shared,
    Stability, Study, Vector, mechanism,
};
use eigentol_interpreter::Interpreted;

use crate::common::derived::{Derived, Model};
use crate::common::models::Plate;
use crate::common::pendulum::W;
use crate::common::{METRE, STIFFNESS, close, coordinate, description, design, sizes};

const BAR: &str = "
    mechanism Bar {
        input  omega: rad/s;
        design m = 3 kg +/- 0.03 kg;
        design l = 1 m +/- 3 %;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
";

mechanism! {
    /// Masses one behind the other, each held by a spring to the one before.
    mechanism Row {
        input  soft:  N/m;
        input  other: N/m;
        input  stiff: N/m;
        body a: sphere(mass: 1 kg, radius: 0.1 m);
        body b: sphere(mass: 2 kg, radius: 0.1 m);
        body c: sphere(mass: 3 kg, radius: 0.1 m);
        joint x: prismatic(x) from ground to a;
        joint y: prismatic(x) from a to b;
        joint z: prismatic(x) from b to c;
        force k1: spring(on: x, stiffness: soft);
        force k2: spring(on: y, stiffness: other);
        force k3: spring(on: z, stiffness: stiff);
    }
}

mechanism! {
    /// A spring whose stiffness is a small difference of design variables.
    mechanism Cancelling {
        design a = 0.1 N/m;
        design b = 0.2 N/m;
        design c = 0.3 N/m;
        body mass: point(mass: 1 kg);
        joint x: prismatic(x) from ground to mass;
        force k: spring(on: x, stiffness: a + b - c);
    }
}

mechanism! {
    mechanism DampedBar {
        input  omega: rad/s;
        design m = 3 kg +/- 0.03 kg;
        design l = 1 m +/- 3 %;
        design c = 0.5 N*m*s/rad;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        force friction: damper(on: theta, damping: c);
    }
}

mechanism! {
    /// Two bars that a gear makes one.
    mechanism GearedBars {
        input  omega: rad/s;
        design m = 3 kg +/- 0.03 kg;
        design l = 1 m +/- 3 %;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body one: rod(mass: m, length: l, along: -z);
        body two: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint a: revolute(y) from shaft to one;
        joint b: revolute(y) from shaft to two;
        constraint gear: coupling(of: a, with: b, ratio: 1);
    }
}

mechanism! {
    mechanism TwoBars {
        input  omega: rad/s;
        design l = 1 m +/- 3 %;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body one: rod(mass: 3 kg, length: l, along: -z);
        body two: rod(mass: 3 kg, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint a: revolute(y) from shaft to one;
        joint b: revolute(y) from one to two at [0, 0, -l];
    }
}

/// Masses of 1, 2 and 3 kg in a row, in ground coordinates: springs `k1` and `k2` between them, and `g` holds the
/// first. The stiffness that holds the row as a whole is added to `k1` in one matrix element and rounded with it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chain;

impl Model for Chain {
    sizes!(3, 0, 3, 0);

    const DESCRIPTION: Description = description!(
        "Chain",
        &[coordinate("x", METRE), coordinate("y", METRE), coordinate("z", METRE)],
        &[],
        &[design("k1", STIFFNESS, 1.0, 0.0), design("k2", STIFFNESS, 1.0, 0.0), design("g", STIFFNESS, 0.0, 0.0),],
        true,
        DampingKind::Zero
    );

    fn inertia<T: Real>(&self, a: &[T; 3], _: &[T; 3], _: &[T; 3], _: &[T; 0], _: &[T; 3]) -> [T; 3] {
        [a[0], T::constant(2.0) * a[1], T::constant(3.0) * a[2]]
    }

    fn applied<T: Real>(&self, _: &[T; 3], q: &[T; 3], _: &[T; 0], b: &[T; 3]) -> [T; 3] {
        let (first, second) = (b[0] * (q[1] - q[0]), b[1] * (q[2] - q[1]));
        [first - b[2] * q[0], second - first, -second]
    }
}

/// The floating-point number `count` places after `value`.
fn after(value: f64, count: i64) -> f64 {
    f64::from_bits(value.to_bits().wrapping_add_signed(count))
}

/// `3 g / (2 L) - omega^2`, the stiffness over the inertia where the bar hangs, rounded once at the end.
fn exact_lambda(omega: f64) -> f64 {
    let square = omega * omega;
    (W - square) - omega.mul_add(omega, -square)
}

fn bar(omega: f64, start: f64) -> Study<Interpreted> {
    let study = Study::new(Interpreted::from_text(BAR).unwrap());
    study.input(Input::new(0), omega).start(Coordinate::new(0), start)
}

#[test]
fn at_its_critical_speed_a_pendulum_is_neutral() {
    for start in [0.0, 1e-3, std::f64::consts::FRAC_PI_3] {
        for places in -3..=3 {
            let study = bar(after(W.sqrt(), places), start);
            let at = study.equilibrium().unwrap();
            assert_eq!(at.stability, Stability::Neutral { zero: 1 });
            for family in [Family::Undamped, Family::General] {
                let found = study.clone().family(family).modes().unwrap();
                let neutral = found.modes.iter().map(|mode| mode.behaviour);
                assert!(neutral.eq([Behaviour::Neutral]), "{start} {places} {found}");
            }
            if places % 3 != 0 {
                continue;
            }
            let summary = study.summary().unwrap();
            assert_eq!(summary.first.distance_to_critical, 0.0);
            let doubts = &summary.trust[0].doubts;
            assert!(doubts.contains(&Doubt::NearCritical { distance: 0.0 }), "{doubts:?}");
            for text in [summary.to_string(), summary.first.to_string()] {
                assert!(text.contains("zero within rounding"), "{text}");
                assert!(!text.contains("not stable"), "{text}");
            }
        }
    }
}

/// Data that balance in decimals leave a few rounding units of either sign.
#[test]
fn a_stiffness_that_is_rounding_of_the_design_is_zero() {
    let judged = |values: [f64; 3]| {
        let handles = [Cancelling::a, Cancelling::b, Cancelling::c];
        let study = handles
            .into_iter()
            .zip(values)
            .fold(Study::new(Cancelling).policy(Policy::Nearest), |study, (handle, value)| study.design(handle, value));
        let modes = study.modes().expect("modes");
        let stability = study.equilibrium().expect("a state").stability;
        (stability, modes.modes[0].behaviour)
    };
    for values in [[0.1, 0.2, 0.3], [0.7, 0.1, 0.8], [1.1, 2.2, 3.3], [4.35, 0.1, 4.45]] {
        let [a, b, c] = values;
        assert_ne!(a + b - c, 0.0);
        let found = judged(values);
        assert_eq!(found, (Stability::Neutral { zero: 1 }, Behaviour::Neutral), "{values:?}");
    }
    assert_eq!(judged([0.1, 0.2, 0.3 - 1e-12]).0, Stability::Stable);
    assert_eq!(judged([0.1, 0.2, 0.3 + 1e-12]).0, Stability::Divergent { negative: 1 });
}

/// Compared with the sign of the exact stiffness: no sign is wrong, and few are undecided.
#[test]
fn beside_its_critical_speed_a_pendulum_is_stable_or_not() {
    let critical = W.sqrt();
    for distance in [1e-14, 1e-13, 1e-12, 1e-9, 1e-6, 1e-3] {
        for omega in [critical * (1.0 - distance), critical * (1.0 + distance)] {
            let study = bar(omega, 0.0).policy(Policy::Nearest);
            let at = study.equilibrium().unwrap();
            let mode = study.modes().unwrap().modes.remove(0);
            let exact = exact_lambda(omega);
            let expected = match exact > 0.0 {
                true => (Stability::Stable, Behaviour::Oscillating(exact.sqrt())),
                false => (Stability::Divergent { negative: 1 }, Behaviour::Divergent((-exact).sqrt())),
            };
            assert!((mode.lambda - exact).abs() < at.rounding.max(1e-15 * W), "{distance}");
            assert_eq!(at.stability, expected.0, "{distance}");
            let same = core::mem::discriminant(&mode.behaviour);
            assert_eq!(same, core::mem::discriminant(&expected.1));
        }
    }
}

/// A located critical state is neutral, whatever the last digits of its speed.
#[test]
fn a_critical_state_that_was_located_is_neutral() {
    let found = bar(0.0, 0.0).critical_state(Input::new(0), 3.0, 5.0).unwrap();
    close(found.value, W.sqrt(), 1e-12);
    let at = &found.equilibrium;
    assert_eq!(at.stability, Stability::Neutral { zero: 1 });
    let mode = modes(at).unwrap().modes.remove(0);
    assert_eq!(mode.behaviour, Behaviour::Neutral);
}

/// Stiffnesses 1e15 apart in relative coordinates, where none is lost in the digits of another. Expected are the
/// frequencies with the stiff spring as a rigid joint; its compliance changes them by 1e-15.
#[test]
fn a_soft_mode_beside_a_stiff_one_is_as_good_as_alone() {
    // Squared frequencies of two masses with a spring on the first and one between them.
    let pair = |(first, near): (f64, f64), (second, between): (f64, f64)| {
        let trace = (near + between) / first + between / second;
        let product = near * between / (first * second);
        let root = (trace * trace - 4.0 * product).sqrt();
        let high = 0.5 * (trace + root);
        [product / high, high]
    };
    let (one, two, stiff) = (1.0, 2.0, 1e15);
    let reduced = |a: f64, b: f64| (1.0 / a + 1.0 / b) * stiff;
    for (springs, soft, high) in [
        ([one, two, stiff], pair((1.0, one), (5.0, two)), reduced(2.0, 3.0)),
        ([one, stiff, two], pair((3.0, one), (3.0, two)), reduced(1.0, 2.0)),
        ([stiff, one, two], pair((2.0, one), (3.0, two)), stiff),
        ([-one, two, stiff], pair((1.0, -one), (5.0, two)), reduced(2.0, 3.0)),
    ] {
        let study = Study::new(Row)
            .input(Row::soft, springs[0])
            .input(Row::other, springs[1])
            .input(Row::stiff, springs[2])
            .policy(Policy::Nearest);
        let stable = springs[0] > 0.0;
        let expected = match stable {
            true => Stability::Stable,
            false => Stability::Divergent { negative: 1 },
        };
        assert_eq!(study.equilibrium().unwrap().stability, expected);
        let found = study.modes().unwrap();
        for (mode, lambda) in found.modes.iter().zip([soft[0], soft[1], high]) {
            close(mode.lambda, lambda, 3e-14 + 2e-15 * f64::from(lambda == high));
            assert!((mode.s.norm() - lambda.abs().sqrt()).abs() <= mode.error + 1e-15 * mode.s.norm());
            match lambda > 0.0 {
                true => assert!(matches!(mode.behaviour, Behaviour::Oscillating(_)), "{found}"),
                false => assert!(matches!(mode.behaviour, Behaviour::Divergent(_)), "{found}"),
            }
        }
        let general = study.family(Family::General).modes().unwrap();
        assert_eq!(general.stable(), stable);
        assert!(general.modes.iter().all(|mode| mode.behaviour != Behaviour::Neutral));
    }
}

/// Without damping a whirling plate keeps its amplitude at every speed; a tiny `c` of either sign decides its
/// behaviour.
#[test]
fn an_oscillation_that_keeps_its_amplitude_neither_grows_nor_decays() {
    for speed in [0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 8.0] {
        let study = Study::new(Derived(Plate))
            .family(Family::General)
            .input(Input::new(0), speed)
            .tolerance(DesignVariable::new(3), 1e-2);
        let summary = study.summary().unwrap();
        for (mode, trust) in summary.first.modes.iter().zip(&summary.trust) {
            assert_eq!(mode.distance_to_instability, 0.0, "{speed}");
            assert_eq!(trust.doubts, [Doubt::NearInstability { distance: 0.0 }]);
        }
        for text in [summary.to_string(), summary.first.to_string()] {
            assert!(text.contains("neither grows nor decays within rounding"), "{text}");
            assert!(!text.contains("vibration grows") && !text.contains("begins to grow"), "{text}");
        }
    }
}

/// The same critical speed with damping, where one of two real eigenvalues vanishes, and with a constraint, where the
/// stiffness along the one free direction vanishes.
#[test]
fn damping_and_constraints_do_not_hide_a_critical_state() {
    for start in [0.0, 0.5] {
        for places in -2..=2 {
            let speed = after(W.sqrt(), places);
            let damped = Study::new(DampedBar).input(DampedBar::omega, speed).start(DampedBar::theta, start);
            assert_eq!(damped.equilibrium().unwrap().stability, Stability::Neutral { zero: 1 });
            let found = damped.modes().unwrap();
            // s = 0 and s = -c / J.
            let [neutral, decaying] = [0, 1].map(|r| found.modes[r].behaviour);
            assert_eq!(neutral, Behaviour::Neutral, "{found}");
            let Behaviour::Decaying(rate) = decaying else { panic!("{found}") };
            close(rate, 0.5, 1e-7);
            let geared = Study::new(GearedBars).input(GearedBars::omega, speed).start(GearedBars::a, start);
            assert_eq!(geared.equilibrium().unwrap().stability, Stability::Neutral { zero: 1 });
            for family in [Family::Undamped, Family::General] {
                let found = geared.clone().family(family).modes().unwrap();
                assert!(found.modes.iter().all(|mode| mode.behaviour == Behaviour::Neutral), "{found}");
            }
        }
    }
    for (speed, stable) in [(W.sqrt() * (1.0 - 1e-12), true), (W.sqrt() * (1.0 + 1e-12), false)] {
        let damped = Study::new(DampedBar).input(DampedBar::omega, speed).policy(Policy::Nearest);
        let geared = Study::new(GearedBars).input(GearedBars::omega, speed).policy(Policy::Nearest);
        for judged in [damped.equilibrium().unwrap().stability, geared.equilibrium().unwrap().stability] {
            let expected = match stable {
                true => Stability::Stable,
                false => Stability::Divergent { negative: 1 },
            };
            assert_eq!(judged, expected);
        }
    }
}

/// At the critical speed of two bars, 2.6801 rad/s, no element of `Khat` vanishes but its determinant does.
#[test]
fn a_stiffness_that_is_singular_but_nowhere_small_is_neutral() {
    let study = Study::new(TwoBars);
    let critical = study.critical_state(TwoBars::omega, 2.0, 3.0).unwrap().value;
    close(critical, 2.6801, 2e-5);
    for (distance, expected) in [
        (0.0, Stability::Neutral { zero: 1 }),
        (-1e-12, Stability::Stable),
        (1e-12, Stability::Divergent { negative: 1 }),
    ] {
        let at = study.clone().input(TwoBars::omega, critical * (1.0 + distance)).policy(Policy::Nearest);
        assert_eq!(at.equilibrium().unwrap().stability, expected);
        let found = at.modes().unwrap();
        let neutral = found.modes.iter().filter(|mode| mode.behaviour == Behaviour::Neutral).count();
        assert_eq!(neutral, usize::from(distance == 0.0), "{found}");
        assert_eq!(found.stable(), distance <= 0.0);
    }
}

/// An unheld row is neutral, even if rounding gives it a stiffness; one held by 1e-12 of its internal stiffness is
/// stable or unstable. `lambda = g / 6` to within `g^2`.
#[test]
fn what_the_elements_cannot_hold_is_neutral() {
    for i in 1..30 {
        let (k1, k2) = (0.1 * f64::from(i), 10.0 / f64::from(i));
        for (share, expected) in [
            (0.0, Stability::Neutral { zero: 1 }),
            (1e-12, Stability::Stable),
            (-1e-12, Stability::Divergent { negative: 1 }),
        ] {
            let g = share * (k1 + k2);
            let study = [k1, k2, g]
                .into_iter()
                .enumerate()
                .fold(Study::new(Derived(Chain)).policy(Policy::Nearest), |study, (k, value)| {
                    study.design(DesignVariable::new(k), value)
                });
            assert_eq!(study.equilibrium().unwrap().stability, expected, "{i} {share}");
            for family in [Family::Undamped, Family::General] {
                let found = study.clone().family(family).modes().unwrap();
                let neutral = found.modes.iter().filter(|mode| mode.behaviour == Behaviour::Neutral).count();
                assert_eq!(neutral > 0, share == 0.0, "{i} {share} {found}");
                assert_eq!(found.stable(), share >= 0.0);
            }
            let lambda = study.family(Family::Undamped).modes().unwrap().modes[0].lambda;
            assert!((lambda - g / 6.0).abs() < 1e-3 * g.abs() + 1e-15 * (k1 + k2), "{lambda} {g}");
        }
    }
}

/// Integer matrices with known eigenvalues: `Mhat = T^T T`, `Khat = T^T diag(d) T`, `T` a product of shears. None is
/// off by more than its stated error, and no sign is wrong.
fn known_eigenvalues(n: usize, seed: &mut u64) -> [usize; 2] {
    let infos = vec![coordinate("q", METRE); n];
    let description = Shared::Counted(Arc::new(Description {
        name: Shared::Static("Known"),
        coordinates: infos.into(),
        inputs: Shared::Static(&[]),
        design: Shared::Static(&[]),
        excitations: Shared::Static(&[]),
        outputs: Shared::Static(&[]),
        symmetric_stiffness: true,
        free_directions: 0,
        held: Shared::Static(&[]),
        length: 1.0,
        frequency: eigentol::Unit::si("rad/s"),
        resolved_modes: None,
        correlations: eigentol::Shared::Static(&[]),
        rings: eigentol::Shared::Static(&[]),
        spans: eigentol::Shared::Static(&[]),
        harmonics: eigentol::Shared::Static(&[]),
        damping: DampingKind::Zero,
        kernels: Shared::Static(&[]),
    }));
    let mut next = |count: u64| {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 33) % count
    };
    let mut t = Matrix::from_fn(n, n, |i, j| f64::from(u8::from(i == j)));
    for _ in 0..2 * n {
        let (i, j) = (next(n as u64) as usize, next(n as u64) as usize);
        let factor = next(3) as f64 - 1.0;
        if i != j {
            for k in 0..n {
                t[i][k] += factor * t[j][k];
            }
        }
    }
    // A quarter are zero, some negative, the others up to 2^30.
    let mut d = Vector::from_fn(n, |_| match next(4) {
        0 => 0.0,
        1 => -(next(1 << 10) as f64),
        _ => 2.0_f64.powi(next(31) as i32),
    });
    let product =
        |weight: &[f64]| Matrix::from_fn(n, n, |i, j| (0..n).map(|k| weight[k] * t[k][i] * t[k][j]).sum::<f64>());
    let (mass, stiffness) = (product(&vec![1.0; n]), product(&d));
    let exact = stiffness.as_flattened().iter().all(|value| value.abs() < 2.0_f64.powi(52));
    assert!(exact);
    let linear = Linear { mass, damping: Matrix::zeros(n, n), stiffness };
    let modes = modes_of(&linear, Family::Undamped, &description).unwrap();
    d.sort_by(f64::total_cmp);
    let mut counts = [0; 2];
    for (mode, exact) in modes.modes.iter().zip(d) {
        // Half of it for a zero, where `error` is a square root.
        let error = match mode.behaviour {
            Behaviour::Neutral => mode.error * mode.error,
            _ => mode.error * mode.s.norm(),
        };
        assert!((mode.lambda - exact).abs() <= error, "{modes} {exact} {error:e}");
        match mode.behaviour {
            Behaviour::Oscillating(_) => assert!(exact > 0.0),
            Behaviour::Divergent(_) => assert!(exact < 0.0),
            _ => counts[0] += usize::from(exact != 0.0),
        }
        counts[1] += 1;
    }
    counts
}

#[test]
fn errors_are_bounds_and_signs_are_true() {
    let mut seed = 5;
    let mut open = [0, 0];
    for _ in 0..400 {
        for n in [1, 2, 3, 5, 8, 10] {
            let count = known_eigenvalues(n, &mut seed);
            open = [open[0] + count[0], open[1] + count[1]];
        }
    }
    // Signs left undecided although the eigenvalue is not zero.
    assert_eq!(open, [0, 400 * 29]);
}
