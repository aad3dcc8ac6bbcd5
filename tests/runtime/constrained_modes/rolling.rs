//! Mechanisms with speeds and velocity constraints, written with quasi-velocities.

use eigentol::{CoordinateInfo, DampingKind, Description, DesignInfo, InputInfo, Real, Role, Shared, Unit};

use crate::common::derived::Model;
use crate::common::{KILOGRAM, METRE, NUMBER, RAD, SPEED, STIFFNESS, coordinate, description, design, input, sizes};
use crate::constrained_modes::{FORCE, reaction};

const SLOW: Unit = Unit { symbol: Shared::Static("m/s"), scale: 1.0 };

pub(crate) const fn speed(name: &'static str, unit: Unit) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit, role: Role::Speed }
}

pub(crate) const fn rolling(name: &'static str) -> CoordinateInfo {
    CoordinateInfo { name: Shared::Static(name), unit: FORCE, role: Role::VelocityReaction }
}

const AT_SPEED: &[InputInfo] = &[input("v", SLOW)];

const fn described(
    name: &'static str,
    coordinates: &'static [CoordinateInfo],
    design: &'static [DesignInfo],
) -> Description {
    description!(name, coordinates, AT_SPEED, design, false, DampingKind::General)
}

macro_rules! no_forces {
    ($n:literal, $p:literal) => {
        fn applied<T: Real>(&self, _: &[T; $n], _: &[T; $n], _: &[T; 1], _: &[T; $p]) -> [T; $n] {
            [T::constant(0.0); $n]
        }
    };
}

/// A massless trail of length `a` towed at speed `v`: `a theta' + v sin theta = 0`, `s = -v / a`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trail;

impl Model for Trail {
    sizes!(2, 1, 1, 0);

    const DESCRIPTION: Description = described(
        "Trail",
        const { &[coordinate("theta", RAD), rolling("wheel")] },
        const { &[design("a", METRE, 0.3, 0.01)] },
    );

    fn inertia<T: Real>(&self, _: &[T; 2], velocity: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 1]) -> [T; 2] {
        [b[0] * q[1], b[0] * velocity[0] + u[0] * q[0].sin_cos().0]
    }

    no_forces! {2, 1}
}

/// A caster at speed `v`. Its kingpin moves sideways by `y` on a spring `k`; the fork, of mass `m` at distance `b`
/// behind the kingpin and inertia `J` about its centre, trails by `theta`; the wheel at distance `a` does not slip
/// sideways. A torsion spring `kt` about the angle `t0` keeps the wheel pushing, a damper `c` resists:
/// `(J + m (a - b)^2) s^3 + (m v (a - b) + c) s^2 + (k a^2 + kt) s + k a v = 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Caster;

pub(crate) const CASTER: [f64; 8] = [2.0, 0.05, 0.3, 0.1, 800.0, 2.0, 0.05, 0.4];

impl Model for Caster {
    sizes!(3, 1, 8, 0);

    const DESCRIPTION: Description = described(
        "Caster",
        const { &[coordinate("y", METRE), coordinate("theta", RAD), rolling("wheel")] },
        const {
            &[
                design("m", KILOGRAM, CASTER[0], 0.02),
                design("J", NUMBER, CASTER[1], 0.001),
                design("a", METRE, CASTER[2], 0.003),
                design("b", METRE, CASTER[3], 0.002),
                design("k", STIFFNESS, CASTER[4], 10.0),
                design("kt", NUMBER, CASTER[5], 0.1),
                design("t0", RAD, CASTER[6], 0.001),
                design("c", NUMBER, CASTER[7], 0.01),
            ]
        },
    );

    fn inertia<T: Real>(&self, acceleration: &[T; 3], velocity: &[T; 3], q: &[T; 3], u: &[T; 1], b: &[T; 8]) -> [T; 3] {
        let [m, j, a, centre, k, kt, t0, damper] = *b;
        let (sin, cos) = q[1].sin_cos();
        let (alpha, omega) = (acceleration[1], velocity[1]);
        // Centre (v t - b cos, y - b sin), its acceleration, and its velocity due to theta, b (sin, -cos).
        let ax = centre * (alpha * sin + omega * omega * cos);
        let ay = acceleration[0] - centre * (alpha * cos - omega * omega * sin);
        let mu = q[2];
        [
            m * ay + k * q[0] + cos * mu,
            m * centre * (sin * ax - cos * ay) + j * alpha + kt * (q[1] - t0) + damper * omega - a * mu,
            cos * velocity[0] - a * velocity[1] - u[0] * sin,
        ]
    }

    no_forces! {3, 8}
}

/// A disk on a plane: lean `phi` and height `z` of the centre; its speeds forward, to the left and in yaw; and its
/// spin, either free ([`Disk`]) or driven at `v` over the radius with a yaw damper `c` ([`DrivenDisk`]). Axial inertia
/// `C`, transverse inertia `A`.
fn disk<T: Real, const N: usize>(
    (phi, z, forward, side, yaw, spin): (T, T, T, T, T, T),
    (phi_rate, phi_rate_2, z_rate_2): (T, T, T),
    (forward_rate, side_rate, yaw_rate, spin_rate): (T, T, T, T),
    [normal, along, across]: [T; 3],
    [m, r, axial, transverse, c]: [T; 5],
) -> ([T; 6], [T; 3]) {
    let (sin, cos) = phi.sin_cos();
    let about_axis = spin + yaw * sin;
    let about_axis_rate = spin_rate + yaw_rate * sin + yaw * cos * phi_rate;
    let two = T::constant(2.0);
    let dynamics = [
        transverse * phi_rate_2 + transverse * yaw * yaw * sin * cos - axial * about_axis * yaw * cos
            + r * sin * normal
            + r * cos * across,
        m * z_rate_2 + m * T::constant(9.81) + normal,
        m * (forward_rate - yaw * side) + along,
        m * (side_rate + yaw * forward) + across,
        transverse * (yaw_rate * cos * cos - two * yaw * sin * cos * phi_rate)
            + axial * (about_axis_rate * sin + about_axis * cos * phi_rate)
            + c * yaw
            - r * sin * along,
        axial * about_axis_rate - r * along,
    ];
    let constraints = [z - r * cos, forward - r * about_axis, side + r * cos * phi_rate];
    (dynamics, constraints)
}

pub(crate) const DRIVEN: [f64; 5] = [2.0, 0.3, 0.1, 0.05, 0.02];

const DISK_DESIGN: &[DesignInfo] = &[
    design("m", KILOGRAM, 2.0, 0.01),
    design("r", METRE, 0.3, 0.001),
    design("C", NUMBER, 0.1, 0.001),
    design("A", NUMBER, 0.05, 0.001),
    design("c", NUMBER, 0.02, 0.001),
];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk;

impl Model for Disk {
    sizes!(9, 1, 5, 0);

    const DESCRIPTION: Description = described(
        "Disk",
        const {
            &[
                coordinate("phi", RAD),
                coordinate("z", METRE),
                speed("forward", SLOW),
                speed("side", SLOW),
                speed("yaw", SPEED),
                speed("spin", SPEED),
                reaction("normal", FORCE),
                rolling("along"),
                rolling("across"),
            ]
        },
        DISK_DESIGN,
    );

    fn inertia<T: Real>(&self, acceleration: &[T; 9], velocity: &[T; 9], q: &[T; 9], _: &[T; 1], b: &[T; 5]) -> [T; 9] {
        let (d, c) = disk::<T, 9>(
            (q[0], q[1], q[2], q[3], q[4], q[5]),
            (velocity[0], acceleration[0], acceleration[1]),
            (velocity[2], velocity[3], velocity[4], velocity[5]),
            [q[6], q[7], q[8]],
            *b,
        );
        [d[0], d[1], d[2], d[3], d[4], d[5], c[0], c[1], c[2]]
    }

    no_forces! {9, 5}
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct DrivenDisk;

impl Model for DrivenDisk {
    sizes!(8, 1, 5, 0);

    const DESCRIPTION: Description = described(
        "DrivenDisk",
        const {
            &[
                coordinate("phi", RAD),
                coordinate("z", METRE),
                speed("forward", SLOW),
                speed("side", SLOW),
                speed("yaw", SPEED),
                reaction("normal", FORCE),
                rolling("along"),
                rolling("across"),
            ]
        },
        DISK_DESIGN,
    );

    fn inertia<T: Real>(&self, acceleration: &[T; 8], velocity: &[T; 8], q: &[T; 8], u: &[T; 1], b: &[T; 5]) -> [T; 8] {
        let (d, c) = disk::<T, 8>(
            (q[0], q[1], q[2], q[3], q[4], u[0] / b[1]),
            (velocity[0], acceleration[0], acceleration[1]),
            (velocity[2], velocity[3], velocity[4], T::constant(0.0)),
            [q[5], q[6], q[7]],
            *b,
        );
        [d[0], d[1], d[2], d[3], d[4], c[0], c[1], c[2]]
    }

    no_forces! {8, 5}
}

/// A sleigh on a knife edge at distance `a` behind its centre, pushed by `d (v - forward)`: `s = -d / m` and
/// `-m a v / (J + m a^2)`. Without a push (`d = 0`) any speed is steady.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sleigh;

impl Model for Sleigh {
    sizes!(4, 1, 4, 0);

    const DESCRIPTION: Description = described(
        "Sleigh",
        const { &[speed("forward", SLOW), speed("side", SLOW), speed("yaw", SPEED), rolling("edge")] },
        const {
            &[
                design("m", KILOGRAM, 3.0, 0.02),
                design("J", NUMBER, 0.4, 0.004),
                design("a", METRE, 0.25, 0.002),
                design("d", NUMBER, 1.5, 0.02),
            ]
        },
    );

    fn inertia<T: Real>(&self, _: &[T; 4], velocity: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 4]) -> [T; 4] {
        let [m, j, a, d] = *b;
        [
            m * (velocity[0] - q[2] * q[1]) + d * (q[0] - u[0]),
            m * (velocity[1] + q[2] * q[0]) + q[3],
            j * velocity[2] - a * q[3],
            q[1] - a * q[2],
        ]
    }

    no_forces! {4, 4}
}
