//! Resonance, motions that nothing resists, redundant constraints, and what is refused.

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{Measure, response, second_derivatives, sensitivities};
use eigentol::{Complex, CoordinateInfo, Description, Error, Forcing, Output, Policy, Real, Role, Shared};

use super::models::{Jeffcott, described, excitation, output};
use crate::common::derived::{Derived, Excited, Model};
use crate::common::models::Plate;
use crate::common::{NUMBER, RAD, SPEED, coordinate, design, input, sizes};

/// The declared name and the mode of a resonance.
fn resonance(error: &Error) -> (&str, Option<usize>) {
    match error {
        Error::Resonance { excitation, mode, .. } => (excitation, *mode),
        other => panic!("{other}"),
    }
}

#[test]
fn resonance_without_damping_is_named() {
    let model = Derived(Jeffcott);
    let design = [12.0, 1.9e6, 0.0, 4e-5];
    let natural = (1.9e6_f64 / 12.0).sqrt();
    let near = |speed: f64| equilibrium(&model, &[speed], &design, &[0.0; 2], Policy::Stable).unwrap();
    for speed in [natural, natural * (1.0 + 3e-16), natural * (1.0 - 3e-16)] {
        let error = response(&model, &near(speed)).unwrap_err();
        let (name, mode) = resonance(&error);
        assert_eq!(name, "unbalance");
        assert!(mode.is_some());
        assert!(error.to_string().contains("in resonance at 397.911 rad/s"), "{error}");
    }
    // A speed that is not quite it has a response, of as many digits as the distance leaves.
    let found = response(&model, &near(natural * (1.0 + 1e-9))).unwrap();
    let expected = -4e-5 / 2e-9;
    assert!((found.harmonics[0].outputs[0].unwrap().re / expected - 1.0).abs() < 1e-5);
}

#[test]
fn what_does_not_shake_is_refused() {
    let plate = equilibrium(&Derived(Plate), &[2.0], &[0.5, 40.0, 60.0, 0.0], &[0.0; 2], Policy::Stable);
    let error = response(&Derived(Plate), &plate.unwrap()).unwrap_err();
    assert!(matches!(error, Error::NoExcitation { .. }), "{error}");
    let model = Derived(Jeffcott);
    let at = equilibrium(&model, &[0.0], &[12.0, 1.9e6, 10.0, 4e-5], &[0.0; 2], Policy::Stable);
    let error = response(&model, &at.unwrap()).unwrap_err();
    assert!(matches!(error, Error::NoFrequency { .. }), "{error}");
    assert!(error.to_string().contains("`unbalance`"));
}

/// Two equal masses on equal springs to ground, coupled by a third spring; a harmonic force on each, `together` and
/// `against`. Outputs: each position, their sum and their difference.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Twins;

impl Model for Twins {
    sizes!(2, 1, 3, 4, 1);

    const DESCRIPTION: Description = described!(
        "Twins",
        [coordinate("x", NUMBER), coordinate("y", NUMBER)],
        [input("w", SPEED)],
        [
            design("coupling", NUMBER, 2.0, 0.0),
            design("together", NUMBER, 0.0, 0.0),
            design("against", NUMBER, 1.0, 0.0),
        ],
        [output("x", NUMBER), output("y", NUMBER), output("sum", NUMBER), output("difference", NUMBER),],
        [excitation("force", 0)],
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 1], _: &[T; 3]) -> [T; 2] {
        *a
    }

    fn applied<T: Real>(&self, _: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 3]) -> [T; 2] {
        let coupling = b[0] * (q[1] - q[0]);
        let spring = T::constant(3.0);
        [coupling - spring * q[0], T::constant(0.0) - coupling - spring * q[1]]
    }

    fn outputs<T: Real>(&self, q: &[T; 2], _: &[T; 1], _: &[T; 3]) -> [T; 4] {
        [q[0], q[1], q[0] + q[1], q[0] - q[1]]
    }

    fn forcing<T: Real>(&self, _: &[T; 2], u: &[T; 1], b: &[T; 3]) -> Excited<Self, T> {
        let none = T::constant(0.0);
        Forcing {
            cosine: [[b[1] + b[2], b[1] - b[2]]],
            frequency: [u[0]],
            direct_cosine: [[none; 4]],
            sine: [[none; 2]],
            direct_sine: [[none; 4]],
        }
    }
}

#[test]
fn a_mode_in_resonance_that_nothing_drives_does_not_respond() {
    let model = Derived(Twins);
    let natural = 3.0_f64.sqrt();
    let at = |design: [f64; 3]| equilibrium(&model, &[natural], &design, &[0.0; 2], Policy::Stable).unwrap();
    let still = at([2.0, 0.0, 1.0]);
    let first = sensitivities(&model, &still).unwrap();
    let outputs = &first.response.harmonics[0].outputs;
    // Against each other: `(3 + 2 coupling - w^2) x = 1`.
    for (found, expected) in outputs.iter().zip([0.25, -0.25, 0.0, 0.5]) {
        assert!((found.unwrap() - Complex::new(expected, 0.0)).norm() < 1e-14, "{found:?}");
    }
    // Only the difference does not see the mode in resonance.
    let exists = first.harmonics[0].outputs.iter().map(Option::is_some);
    assert_eq!(exists.collect::<Vec<_>>(), [false, false, false, true]);
    let slopes = first.complex(0, Output::new(3), Measure::Displacement).unwrap();
    assert!((slopes.by_design[0].re + 0.25).abs() < 1e-13);
    assert!((slopes.by_input[0].re - 0.25 * natural).abs() < 1e-13);
    assert!(slopes.by_design[1].norm() < 1e-13);
    assert!((slopes.by_design[2].re - 0.5).abs() < 1e-13);
    let second = second_derivatives(&model, &still).unwrap();
    assert!(second.complex(0, Output::new(0), Measure::Displacement).is_none());
    let error = response(&model, &at([2.0, 1e-6, 1.0])).unwrap_err();
    assert_eq!(resonance(&error), ("force", Some(0)));
}

/// Two inertias on a shaft that nothing holds, with a harmonic moment on the first. Outputs: the first angle, the twist.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shaft;

impl Model for Shaft {
    sizes!(2, 1, 3, 2, 1);

    const DESCRIPTION: Description = described!(
            "Shaft",
            [coordinate("first", RAD), coordinate("second", RAD)],
            [input("w", SPEED)],
            [
                design("inertia", NUMBER, 2.0, 0.0),
                design("stiffness", NUMBER, 50.0, 0.0),
                design("damping", NUMBER, 0.3, 0.0),
            ],
            [output("first", RAD), output("twist", RAD)],
            [excitation("moment", 0)]; true, 1
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 1], b: &[T; 3]) -> [T; 2] {
        [b[0] * a[0], a[1]]
    }

    fn applied<T: Real>(&self, v: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 3]) -> [T; 2] {
        let moment = b[1] * (q[1] - q[0]) + b[2] * (v[1] - v[0]);
        [moment, T::constant(0.0) - moment]
    }

    fn outputs<T: Real>(&self, q: &[T; 2], _: &[T; 1], _: &[T; 3]) -> [T; 2] {
        [q[0], q[1] - q[0]]
    }

    fn forcing<T: Real>(&self, _: &[T; 2], u: &[T; 1], _: &[T; 3]) -> Excited<Self, T> {
        let none = T::constant(0.0);
        Forcing {
            cosine: [[none; 2]],
            frequency: [u[0]],
            direct_cosine: [[none; 2]],
            sine: [[T::constant(4.0), none]],
            direct_sine: [[none; 2]],
        }
    }
}

#[test]
fn a_free_direction_does_not_stand_in_the_way() {
    let model = Derived(Shaft);
    let (w, [i, k, c]) = (6.0, [2.0, 50.0, 0.3]);
    let at = equilibrium(&model, &[w], &[i, k, c], &[0.4, 0.4], Policy::Stable).unwrap();
    assert_eq!(at.free.count(), 1);
    let of = second_derivatives(&model, &at).unwrap();
    let spring = Complex::new(k, w * c);
    let (m, turned) = (Complex::new(0.0, -4.0), spring - w * w);
    let determinant = (spring - i * w * w) * turned - spring * spring;
    let first = m * turned / determinant;
    let outputs = &of.first.response.harmonics[0].outputs;
    assert!((outputs[0].unwrap() - first).norm() < 1e-13 * first.norm());
    assert!((outputs[1].unwrap() - m * (w * w) / determinant).norm() < 1e-13 * first.norm());
    // By the inertia: `d/di (m turned / determinant) = m turned^2 w^2 / determinant^2`.
    let slope = m * turned * turned * (w * w) / (determinant * determinant);
    let slopes = of.first.complex(0, Output::new(0), Measure::Displacement).unwrap();
    assert!((slopes.by_design[0] - slope).norm() < 1e-12 * slope.norm());
    let bend = 2.0 * slope * turned * (w * w) / determinant;
    let second = of.complex(0, Output::new(0), Measure::Displacement).unwrap();
    assert!((second.by_design[0][0] - bend).norm() < 1e-11 * bend.norm());
}

/// Two masses on springs, tied together twice by the same constraint; a harmonic force on the first. The length of the
/// tie is `shaken`, of one of the two constraints alone if `torn`. Outputs: the second position, the force in the tie.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tied;

const fn reaction(name: &'static str) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit: NUMBER, role: Role::PositionReaction }
}

impl Model for Tied {
    sizes!(4, 1, 4, 2, 1);

    const DESCRIPTION: Description = described!(
        "Tied",
        [coordinate("x", NUMBER), coordinate("y", NUMBER), reaction("tie"), reaction("again"),],
        [input("w", SPEED)],
        [
            design("m", NUMBER, 2.0, 0.0),
            design("k", NUMBER, 30.0, 0.0),
            design("shaken", NUMBER, 0.0, 0.0),
            design("torn", NUMBER, 0.0, 0.0),
        ],
        [output("y", NUMBER), output("tie", NUMBER)],
        [excitation("force", 0)],
    );

    fn inertia<T: Real>(&self, a: &[T; 4], _: &[T; 4], q: &[T; 4], _: &[T; 1], b: &[T; 4]) -> [T; 4] {
        let none = T::constant(0.0);
        let gap = q[0] - q[1];
        [b[0] * a[0], a[1], gap + none, T::constant(3.0) * gap]
    }

    fn applied<T: Real>(&self, v: &[T; 4], q: &[T; 4], _: &[T; 1], b: &[T; 4]) -> [T; 4] {
        let none = T::constant(0.0);
        let tie = q[2] + T::constant(3.0) * q[3];
        let damper = T::constant(0.7) * v[1];
        [none - b[1] * q[0] - tie, tie - T::constant(5.0) * q[1] - damper, none, none]
    }

    fn outputs<T: Real>(&self, q: &[T; 4], _: &[T; 1], _: &[T; 4]) -> [T; 2] {
        [q[1], q[2] + T::constant(3.0) * q[3]]
    }

    fn forcing<T: Real>(&self, _: &[T; 4], u: &[T; 1], b: &[T; 4]) -> Excited<Self, T> {
        let none = T::constant(0.0);
        Forcing {
            cosine: [[T::constant(2.0), none, b[2] + b[3], T::constant(3.0) * b[2]]],
            frequency: [u[0]],
            direct_cosine: [[none; 2]],
            sine: [[none; 4]],
            direct_sine: [[none; 2]],
        }
    }
}

#[test]
fn redundant_constraints_share_their_reaction() {
    let model = Derived(Tied);
    let (w, m, k) = (2.5, 2.0, 30.0);
    let at = equilibrium(&model, &[w], &[m, k, 0.0, 0.0], &[0.0; 4], Policy::Stable).unwrap();
    assert_eq!(at.constraints.redundant, 1);
    let of = second_derivatives(&model, &at).unwrap();
    let stiffness = Complex::new(k + 5.0 - (m + 1.0) * w * w, 0.7 * w);
    let y = 2.0 / stiffness;
    let harmonic = &of.first.response.harmonics[0];
    assert!((harmonic.outputs[0].unwrap() - y).norm() < 1e-13 * y.norm());
    let tie = 2.0 - (k - m * w * w) * y;
    assert!((harmonic.outputs[1].unwrap() - tie).norm() < 1e-13 * tie.norm());
    assert!((harmonic.unknowns[2] - 3.0 * harmonic.unknowns[3]).norm() < 1e-13 * tie.norm());
    let slopes = of.first.complex(0, Output::new(0), Measure::Displacement).unwrap();
    assert!((slopes.by_design[1] + y / stiffness).norm() < 1e-13 * y.norm());
    let second = of.complex(0, Output::new(0), Measure::Displacement).unwrap();
    assert!((second.by_design[1][1] - 2.0 * y / (stiffness * stiffness)).norm() < 1e-12 * y.norm());
}

#[test]
fn redundant_constraints_are_shaken_together() {
    let model = Derived(Tied);
    let (w, m, k) = (2.5, 2.0, 30.0);
    let found = |shaken: f64, torn: f64| {
        let at = equilibrium(&model, &[w], &[m, k, shaken, torn], &[0.0; 4], Policy::Stable);
        sensitivities(&model, &at.unwrap())
    };
    let first = found(0.1, 0.0).unwrap();
    let stiffness = Complex::new(k + 5.0 - (m + 1.0) * w * w, 0.7 * w);
    let y = (2.0 - (k - m * w * w) * 0.1) / stiffness;
    assert!((first.response.harmonics[0].outputs[0].unwrap() - y).norm() < 1e-13 * y.norm());
    let slopes = first.complex(0, Output::new(0), Measure::Displacement).unwrap();
    let slope = -(k - m * w * w) / stiffness;
    assert!((slopes.by_design[2] - slope).norm() < 1e-12 * slope.norm());
    let error = found(0.1, 0.01).unwrap_err();
    assert!(matches!(error, Error::ClosesHereOnly { .. }), "{error}");
    assert!(error.to_string().contains("`force`"));
}
