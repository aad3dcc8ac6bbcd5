//! Excited mechanisms.

use eigentol::{Description, ExcitationInfo, Forcing, OutputInfo, Real, Shared, Unit};

use crate::common::derived::{Excited, Model};
use crate::common::{KILOGRAM, METRE, NUMBER, RAD, SPEED, STIFFNESS, coordinate, design, input, sizes};

pub(super) const fn excitation(name: &'static str, with: usize) -> ExcitationInfo {
    ExcitationInfo { name: Shared::Static(name), kind: Shared::Static("harmonic"), with, order: Shared::Static("") }
}

pub(super) const fn output(name: &'static str, unit: Unit) -> OutputInfo {
    OutputInfo { name: Shared::Static(name), unit }
}

/// A description; the coordinates, inputs, design variables, outputs and excitations follow its name, then whether the
/// stiffness is symmetric and the number of free directions.
macro_rules! described {
    ($name:expr, $($lists:expr),* $(,)?) => {
        described!($name, $($lists),*; true, 0)
    };
    (
        $name:expr, $coordinates:expr, $inputs:expr, $design:expr, $outputs:expr, $excitations:expr;
        $symmetric:expr, $free:expr
    ) => {
        eigentol::Description {
            name: Shared::Static($name),
            coordinates: Shared::Static(&$coordinates),
            inputs: Shared::Static(&$inputs),
            design: Shared::Static(&$design),
            outputs: Shared::Static(&$outputs),
            excitations: Shared::Static(&$excitations),
            symmetric_stiffness: $symmetric,
            free_directions: $free,
            held: Shared::Static(&[]),
            length: 1.0,
            frequency: eigentol::Unit::si("rad/s"),
            resolved_modes: None,
            correlations: eigentol::Shared::Static(&[]),
            rings: eigentol::Shared::Static(&[]),
            spans: eigentol::Shared::Static(&[]),
            harmonics: eigentol::Shared::Static(&[]),
            damping: eigentol::DampingKind::General,
            kernels: Shared::Static(&[]),
        }
    };
}
pub(super) use described;

/// A point mass on equal springs and dampers in two directions, with an eccentricity that spins: `m (xddot, yddot) + ..
/// = m e Omega^2 (cos, sin)(Omega t)`. Outputs: `x`, `y`, the force in the bearing along `x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jeffcott;

impl Model for Jeffcott {
    sizes!(2, 1, 4, 3, 1);

    const DESCRIPTION: Description = described!(
        "Jeffcott",
        [coordinate("x", METRE), coordinate("y", METRE)],
        [input("Omega", SPEED)],
        [
            design("m", KILOGRAM, 12.0, 0.12),
            design("k", STIFFNESS, 1.9e6, 1e4),
            design("c", NUMBER, 310.0, 30.0),
            design("e", METRE, 4e-5, 1e-5),
        ],
        [output("x", METRE), output("y", METRE), output("force", NUMBER),],
        [excitation("unbalance", 0)],
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 1], b: &[T; 4]) -> [T; 2] {
        [b[0] * a[0], b[0] * a[1]]
    }

    fn applied<T: Real>(&self, v: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 4]) -> [T; 2] {
        [T::constant(0.0) - b[1] * q[0] - b[2] * v[0], T::constant(0.0) - b[1] * q[1] - b[2] * v[1]]
    }

    fn outputs<T: Real>(&self, q: &[T; 2], u: &[T; 1], b: &[T; 4]) -> [T; 3] {
        let rest = [T::constant(0.0); 2];
        self.moving_outputs(&rest, &rest, q, u, b)
    }

    fn moving_outputs<T: Real>(&self, _: &[T; 2], v: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 4]) -> [T; 3] {
        [q[0], q[1], b[1] * q[0] + b[2] * v[0]]
    }

    fn forcing<T: Real>(&self, _: &[T; 2], u: &[T; 1], b: &[T; 4]) -> Excited<Self, T> {
        let (none, force) = (T::constant(0.0), b[0] * b[3] * u[0] * u[0]);
        Forcing {
            cosine: [[force, none]],
            frequency: [u[0]],
            direct_cosine: [[none; 3]],
            sine: [[none, force]],
            direct_sine: [[none; 3]],
        }
    }
}

/// A uniform rod hinged on the vertical shaft of a turntable, at `theta` from the lower vertical, with a damped hinge;
/// the table is shaken along the vertical by `a cos w t`. Inputs `Omega`, `w`. Outputs: `theta`, the height of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shaken;

impl Model for Shaken {
    sizes!(1, 2, 5, 2, 1);

    const DESCRIPTION: Description = described!(
        "Shaken",
        [coordinate("theta", RAD)],
        [input("Omega", SPEED), input("w", SPEED)],
        [
            design("m", KILOGRAM, 1.3, 0.01),
            design("l", METRE, 0.45, 0.01),
            design("c", NUMBER, 0.02, 0.0),
            design("g", NUMBER, 9.81, 0.0),
            design("a", METRE, 0.002, 0.0),
        ],
        [output("angle", RAD), output("tip", METRE)],
        [excitation("heave", 0)],
    );

    fn inertia<T: Real>(&self, a: &[T; 1], _: &[T; 1], q: &[T; 1], u: &[T; 2], b: &[T; 5]) -> [T; 1] {
        let inertia = b[0] * b[1] * b[1] * T::constant(1.0 / 3.0);
        [inertia * (a[0] - u[0] * u[0] * q[0].sin() * q[0].cos())]
    }

    fn applied<T: Real>(&self, v: &[T; 1], q: &[T; 1], _: &[T; 2], b: &[T; 5]) -> [T; 1] {
        let moment = b[0] * b[1] * T::constant(0.5);
        [T::constant(0.0) - b[2] * v[0] - moment * b[3] * q[0].sin()]
    }

    fn outputs<T: Real>(&self, q: &[T; 1], _: &[T; 2], b: &[T; 5]) -> [T; 2] {
        [q[0], T::constant(0.0) - b[1] * q[0].cos()]
    }

    fn forcing<T: Real>(&self, q: &[T; 1], u: &[T; 2], b: &[T; 5]) -> Excited<Self, T> {
        let none = T::constant(0.0);
        let moment = b[0] * b[1] * T::constant(0.5);
        Forcing {
            cosine: [[moment * b[4] * u[1] * u[1] * q[0].sin()]],
            frequency: [u[1]],
            direct_cosine: [[none, b[4]]],
            sine: [[none]],
            direct_sine: [[none; 2]],
        }
    }
}
