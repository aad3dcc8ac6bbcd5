//! Small mechanisms, each testing one feature.

use eigentol::{DampingKind, Description, Real, Violation};

use super::derived::Model;
use super::{KILOGRAM, METRE, NUMBER, RAD, SPEED, STIFFNESS, coordinate, description, design, input, positive};

/// A point mass on two perpendicular sliders on a spinning plate: gyroscopic `Chat`, shifted equilibrium
/// `x* = kx x0 / (kx - m Omega^2)`. Springs rest at `x0 = 0.1 m`, `y0 = 0.02 m`. Design: `m`, `kx`, `ky`, `c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate;

impl Model for Plate {
    sizes!(2, 1, 4, 0);

    const DESCRIPTION: Description = description!(
        "Plate",
        &[coordinate("x", METRE), coordinate("y", METRE)],
        &[input("omega", SPEED)],
        &[
            design("m", KILOGRAM, 0.5, 0.01),
            design("kx", STIFFNESS, 40.0, 1.2),
            design("ky", STIFFNESS, 60.0, 1.8),
            design("c", NUMBER, 0.0, 0.0),
        ],
        true,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 2], v: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 4]) -> [T; 2] {
        let two = T::constant(2.0);
        let square = u[0] * u[0];
        [b[0] * (a[0] - two * u[0] * v[1] - square * q[0]), b[0] * (a[1] + two * u[0] * v[0] - square * q[1])]
    }

    fn applied<T: Real>(&self, v: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 4]) -> [T; 2] {
        [b[1] * (T::constant(0.1) - q[0]) - b[3] * v[0], b[2] * (T::constant(0.02) - q[1]) - b[3] * v[1]]
    }

    fn violation<T: Real + PartialOrd>(&self, _: &[T; 1], b: &[T; 4]) -> Option<Violation<T>> {
        positive(&[(b[0], "mass"), (b[1], "stiffness kx"), (b[2], "stiffness ky")])
    }
}

/// One coordinate with a given stiffness, a cubic spring and a constant force: `mass qddot + k q + cubic q^3 - force`.
/// Any values are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring;

impl Model for Spring {
    sizes!(1, 1, 3, 0);

    const DESCRIPTION: Description = description!(
        "Spring",
        &[coordinate("x", METRE)],
        &[input("k", STIFFNESS)],
        &[design("mass", KILOGRAM, 1.0, 0.0), design("cubic", NUMBER, 0.0, 0.0), design("force", NUMBER, 1.0, 0.0),],
        true,
        DampingKind::Zero
    );

    fn inertia<T: Real>(&self, a: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 1], b: &[T; 3]) -> [T; 1] {
        [b[0] * a[0]]
    }

    fn applied<T: Real>(&self, _: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 3]) -> [T; 1] {
        [b[2] - u[0] * q[0] - b[1] * q[0] * q[0] * q[0]]
    }
}

/// Two bars under a compressive follower load on the second one (Ziegler): `Khat` is not symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follower;

impl Model for Follower {
    sizes!(2, 1, 1, 0);

    const DESCRIPTION: Description = description!(
        "Follower",
        &[coordinate("a", RAD), coordinate("b", RAD)],
        &[input("load", NUMBER)],
        &[design("stiffness", NUMBER, 1.0, 0.01)],
        false,
        DampingKind::Zero
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 1], _: &[T; 1]) -> [T; 2] {
        [T::constant(3.0) * a[0] + a[1], a[0] + a[1]]
    }

    fn applied<T: Real>(&self, _: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 1]) -> [T; 2] {
        let k = b[0];
        [u[0] * (q[0] - q[1]).sin() - k * (q[0] + q[0] - q[1]), -(k * (q[1] - q[0]))]
    }

    fn violation<T: Real + PartialOrd>(&self, _: &[T; 1], b: &[T; 1]) -> Option<Violation<T>> {
        positive(&[(b[0], "stiffness")])
    }
}

/// Two unit masses: `Khat = [[k1, c], [c, k2]]`, so that `c` couples the two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair;

impl Model for Pair {
    sizes!(2, 0, 3, 0);

    const DESCRIPTION: Description = description!(
        "Pair",
        &[coordinate("x", METRE), coordinate("y", METRE)],
        &[],
        &[design("k1", STIFFNESS, 100.0, 0.0), design("k2", STIFFNESS, 100.0, 0.0), design("c", STIFFNESS, 0.0, 3.0),],
        true,
        DampingKind::Zero
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 0], _: &[T; 3]) -> [T; 2] {
        *a
    }

    fn applied<T: Real>(&self, _: &[T; 2], q: &[T; 2], _: &[T; 0], b: &[T; 3]) -> [T; 2] {
        [-(b[0] * q[0] + b[2] * q[1]), -(b[2] * q[0] + b[1] * q[1])]
    }
}

/// Three unit masses with any symmetric `Khat`; design variables: its diagonal, then `k12`, `k13`, `k23`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triple;

impl Model for Triple {
    sizes!(3, 0, 6, 0);

    const DESCRIPTION: Description = description!(
        "Triple",
        &[coordinate("x", METRE), coordinate("y", METRE), coordinate("z", METRE)],
        &[],
        &[
            design("k1", STIFFNESS, 100.0, 3.0),
            design("k2", STIFFNESS, 100.0, 3.0),
            design("k3", STIFFNESS, 100.0, 3.0),
            design("k12", STIFFNESS, 0.0, 0.0),
            design("k13", STIFFNESS, 0.0, 0.0),
            design("k23", STIFFNESS, 0.0, 0.0),
        ],
        true,
        DampingKind::Zero
    );

    fn inertia<T: Real>(&self, a: &[T; 3], _: &[T; 3], _: &[T; 3], _: &[T; 0], _: &[T; 6]) -> [T; 3] {
        *a
    }

    fn applied<T: Real>(&self, _: &[T; 3], q: &[T; 3], _: &[T; 0], b: &[T; 6]) -> [T; 3] {
        [
            -(b[0] * q[0] + b[3] * q[1] + b[4] * q[2]),
            -(b[3] * q[0] + b[1] * q[1] + b[5] * q[2]),
            -(b[4] * q[0] + b[5] * q[1] + b[2] * q[2]),
        ]
    }
}

/// A point mass on a plate that turns at `omega` about the origin, held by a pretensioned radial spring, `k (r + a)`,
/// and free to slip about the axis. `r* = k a / (m omega^2 - k)`; with `omega^2 > k / m` its radial stiffness
/// `k - m omega^2` is negative, and `s^2 = 0` or `-(k / m + 3 omega^2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slipping;

impl Model for Slipping {
    sizes!(2, 1, 3, 0);

    const DESCRIPTION: Description = description!(
        "Slipping",
        &[coordinate("r", METRE), coordinate("phi", RAD)],
        &[input("omega", SPEED)],
        &[design("m", KILOGRAM, 1.0, 0.0), design("k", STIFFNESS, 10.0, 0.0), design("a", METRE, 0.2, 0.0),],
        true,
        DampingKind::Gyroscopic
    );

    fn inertia<T: Real>(&self, a: &[T; 2], v: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 3]) -> [T; 2] {
        let speed = u[0] + v[1];
        let coriolis = T::constant(2.0) * v[0] * speed;
        [b[0] * (a[0] - q[0] * speed * speed), b[0] * q[0] * (q[0] * a[1] + coriolis)]
    }

    fn applied<T: Real>(&self, _: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 3]) -> [T; 2] {
        [-(b[1] * (q[0] + b[2])), T::constant(0.0)]
    }
}

/// A unit mass on a plate that turns at `omega`, on hardening springs of unit stiffness, `q_i + q_i^3`, in `x` about
/// `e`. Beyond `omega = 1` only gyroscopic forces hold it near the axis, at `x* = -e / (omega^2 - 1)` approximately,
/// and two stable equilibria lie far outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Supercritical;

impl Model for Supercritical {
    sizes!(2, 1, 1, 0);

    const DESCRIPTION: Description = description!(
        "Supercritical",
        &[coordinate("x", METRE), coordinate("y", METRE)],
        &[input("omega", SPEED)],
        &[design("e", METRE, 0.0, 0.03)],
        true,
        DampingKind::Gyroscopic
    );

    fn inertia<T: Real>(&self, a: &[T; 2], v: &[T; 2], q: &[T; 2], u: &[T; 1], _: &[T; 1]) -> [T; 2] {
        let (two, square) = (T::constant(2.0), u[0] * u[0]);
        [a[0] - two * u[0] * v[1] - square * q[0], a[1] + two * u[0] * v[0] - square * q[1]]
    }

    fn applied<T: Real>(&self, _: &[T; 2], q: &[T; 2], _: &[T; 1], b: &[T; 1]) -> [T; 2] {
        let force = |x: T| -(x + x * x * x);
        [force(q[0] - b[0]), force(q[1])]
    }
}

/// Two unit masses on stiffnesses 1 and 4 whose damping peaks at `u = 1` and `u = 3`: each is overdamped in its own
/// range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overdamped;

impl Model for Overdamped {
    sizes!(2, 1, 0, 0);

    const DESCRIPTION: Description = description!(
        "Overdamped",
        &[coordinate("x", METRE), coordinate("y", METRE)],
        &[input("u", NUMBER)],
        &[],
        true,
        DampingKind::General
    );

    fn inertia<T: Real>(&self, a: &[T; 2], _: &[T; 2], _: &[T; 2], _: &[T; 1], _: &[T; 0]) -> [T; 2] {
        *a
    }

    fn applied<T: Real>(&self, v: &[T; 2], q: &[T; 2], u: &[T; 1], _: &[T; 0]) -> [T; 2] {
        let c = T::constant;
        let bump = |peak: f64, at: f64| {
            let away = u[0] - c(at);
            c(peak) / (c(1.0) + c(4.0) * away * away)
        };
        [-(q[0] + bump(4.0, 1.0) * v[0]), -(c(4.0) * q[1] + bump(8.0, 3.0) * v[1])]
    }
}
