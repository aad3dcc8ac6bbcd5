//! Mechanisms with position constraints, each paired with a version in minimal coordinates that has the same inputs and
//! design variables.

use eigentol::{CoordinateInfo, DampingKind, Description, DesignInfo, InputInfo, Real};

use crate::common::derived::Model;
use crate::common::{KILOGRAM, METRE, NUMBER, RAD, SPEED, STIFFNESS, coordinate, description, design, input, sizes};
use crate::constrained_modes::{FORCE, reaction};

pub(crate) const OMEGA: &[InputInfo] = &[input("omega", SPEED)];
pub(crate) const BAR: &[DesignInfo] =
    &[design("m", KILOGRAM, 3.0, 0.01), design("L", METRE, 1.0, 0.03), design("g", NUMBER, 9.81, 0.0)];

const fn described(
    name: &'static str,
    coordinates: &'static [CoordinateInfo],
    design: &'static [DesignInfo],
    damping: DampingKind,
) -> Description {
    description!(name, coordinates, OMEGA, design, true, damping)
}

/// The paper's bar in the vertical plane of a spinning shaft, described by the position `x` (radial), `z` (down) of its
/// tip. `COPIES` is the number of times its length is stated, each time as a different function of the position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bar<const COPIES: usize>;

fn bar<T: Real, const N: usize>(a: &[T; N], q: &[T; N], u: &[T; 1], b: &[T; 3]) -> [T; N] {
    let c = T::constant;
    let (third, omega) = (b[0] / c(3.0), u[0]);
    let size = (q[0] * q[0] + q[1] * q[1]).sqrt();
    let mut residual = [c(0.0); N];
    residual[0] = third * (a[0] - omega * omega * q[0]);
    residual[1] = third * a[1] - b[0] * b[2] * c(0.5);
    for (copy, row) in (2..N).enumerate() {
        // |p| - L, then (p^2 - L^2) / 2 in another unit.
        let mu = q[row];
        let (value, slope) = if copy == 0 {
            (size - b[1], [q[0] / size, q[1] / size])
        } else {
            let unit = c(50.0 * copy as f64);
            let value = (q[0] * q[0] + q[1] * q[1] - b[1] * b[1]) * c(0.5) * unit;
            (value, [unit * q[0], unit * q[1]])
        };
        residual[0] = residual[0] + slope[0] * mu;
        residual[1] = residual[1] + slope[1] * mu;
        residual[row] = value;
    }
    residual
}

macro_rules! bars {
    ($($copies:literal $n:literal [$($name:literal),*])*) => {$(
        impl Model for Bar<$copies> {
            sizes!($n, 1, 3, 0);

            const DESCRIPTION: Description = described(
                "Bar",
                const {
                    &[coordinate("x", METRE), coordinate("z", METRE), $(reaction($name, FORCE)),*]
                },
                BAR,
                DampingKind::Zero,
            );
            fn inertia<T: Real>(
                &self, a: &[T; $n], _: &[T; $n], q: &[T; $n], u: &[T; 1], b: &[T; 3],
            ) -> [T; $n] {
                bar(a, q, u, b)
            }
            fn applied<T: Real>(&self, _: &[T; $n], _: &[T; $n], _: &[T; 1], _: &[T; 3]) -> [T; $n] {
                [T::constant(0.0); $n]
            }
        }
    )*};
}
bars! { 1 3 ["length"] 2 4 ["length", "square"] 3 5 ["length", "square", "again"] }

/// The same bar by its angle from the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BarByAngle;

impl Model for BarByAngle {
    sizes!(1, 1, 3, 0);

    const DESCRIPTION: Description = described("BarByAngle", ANGLE, BAR, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 1], _: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 3]) -> [T; 1] {
        let (sin, cos) = q[0].sin_cos();
        let inertia = b[0] * b[1] * b[1] / T::constant(3.0);
        let weight = b[0] * b[2] * b[1] * T::constant(0.5);
        [inertia * (a[0] - u[0] * u[0] * sin * cos) + weight * sin]
    }

    fn applied<T: Real>(&self, _: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 3]) -> [T; 1] {
        [T::constant(0.0)]
    }
}

const CRANK_AND_SLIDER: &[CoordinateInfo] = &[coordinate("theta", RAD), coordinate("x", METRE), reaction("rod", FORCE)];
const ANGLE: &[CoordinateInfo] = &[coordinate("theta", RAD)];
const CRANK: &[DesignInfo] = &[
    design("J", NUMBER, 0.02, 2e-4),
    design("m", KILOGRAM, 1.5, 0.02),
    design("r", METRE, 0.2, 0.002),
    design("l", METRE, 0.5, 0.003),
    design("k", STIFFNESS, 400.0, 5.0),
    design("x0", METRE, 0.62, 0.004),
    design("torque", NUMBER, 3.0, 0.1),
];

/// A slider-crank on a turntable: crank angle `theta`, slider at `x` on a spring about `x0`, massless rod of length
/// `l`, constant torque on the crank. `free` is an otherwise unconnected pendulum on the slider's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SliderCrank;

impl Model for SliderCrank {
    sizes!(3, 1, 7, 0);

    const DESCRIPTION: Description = described("SliderCrank", CRANK_AND_SLIDER, CRANK, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 3], _: &[T; 3], q: &[T; 3], u: &[T; 1], b: &[T; 7]) -> [T; 3] {
        let [inertia, mass, r, l, k, x0, torque] = *b;
        let (sin, cos) = q[0].sin_cos();
        let (along, up) = (q[1] - r * cos, r * sin);
        let size = (along * along + up * up).sqrt();
        let (by_theta, by_x) = (r * q[1] * sin / size, along / size);
        [
            inertia * a[0] - torque + by_theta * q[2],
            mass * (a[1] - u[0] * u[0] * q[1]) + k * (q[1] - x0) + by_x * q[2],
            size - l,
        ]
    }

    fn applied<T: Real>(&self, _: &[T; 3], _: &[T; 3], _: &[T; 1], _: &[T; 7]) -> [T; 3] {
        [T::constant(0.0); 3]
    }
}

/// The same slider-crank, with the crank angle as its only coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CrankByAngle;

impl Model for CrankByAngle {
    sizes!(1, 1, 7, 0);

    const DESCRIPTION: Description = described("CrankByAngle", ANGLE, CRANK, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 1], v: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 7]) -> [T; 1] {
        let [inertia, mass, r, l, k, x0, torque] = *b;
        let (sin, cos) = q[0].sin_cos();
        let h = (l * l - r * r * sin * sin).sqrt();
        let x = r * cos + h;
        let slope = -(r * sin) - r * r * sin * cos / h;
        let bend =
            -(r * cos) - r * r * (cos * cos - sin * sin) / h - r * r * r * r * sin * sin * cos * cos / (h * h * h);
        let push = mass * (slope * a[0] + bend * v[0] * v[0] - u[0] * u[0] * x) + k * (x - x0);
        [inertia * a[0] - torque + slope * push]
    }

    fn applied<T: Real>(&self, _: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 7]) -> [T; 1] {
        [T::constant(0.0)]
    }
}

const CHAIN: &[DesignInfo] = &[
    design("m1", KILOGRAM, 2.0, 0.02),
    design("m2", KILOGRAM, 1.0, 0.02),
    design("l1", METRE, 0.8, 0.01),
    design("l2", METRE, 0.5, 0.01),
    design("k", STIFFNESS, 30.0, 1.0),
];
const G: f64 = 9.81;

/// Two point masses on rods in the vertical plane of a spinning shaft, with a spring from the second mass to the point
/// (0.6 m, 1 m): four coordinates, two lengths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chain;

impl Model for Chain {
    sizes!(6, 1, 5, 0);

    const DESCRIPTION: Description = described(
        "Chain",
        const {
            &[
                coordinate("x1", METRE),
                coordinate("z1", METRE),
                coordinate("x2", METRE),
                coordinate("z2", METRE),
                reaction("rod1", FORCE),
                reaction("rod2", FORCE),
            ]
        },
        CHAIN,
        DampingKind::Zero,
    );

    fn inertia<T: Real>(&self, a: &[T; 6], _: &[T; 6], q: &[T; 6], u: &[T; 1], b: &[T; 5]) -> [T; 6] {
        let c = T::constant;
        let [m1, m2, l1, l2, k] = *b;
        let square = u[0] * u[0];
        let r1 = (q[0] * q[0] + q[1] * q[1]).sqrt();
        let (dx, dz) = (q[2] - q[0], q[3] - q[1]);
        let r2 = (dx * dx + dz * dz).sqrt();
        let (mu1, mu2) = (q[4], q[5]);
        [
            m1 * (a[0] - square * q[0]) + mu1 * q[0] / r1 - mu2 * dx / r2,
            m1 * (a[1] - c(G)) + mu1 * q[1] / r1 - mu2 * dz / r2,
            m2 * (a[2] - square * q[2]) + mu2 * dx / r2 + k * (q[2] - c(0.6)),
            m2 * (a[3] - c(G)) + mu2 * dz / r2 + k * (q[3] - c(1.0)),
            r1 - l1,
            r2 - l2,
        ]
    }

    fn applied<T: Real>(&self, _: &[T; 6], _: &[T; 6], _: &[T; 1], _: &[T; 5]) -> [T; 6] {
        [T::constant(0.0); 6]
    }
}

/// The same chain, described by two absolute angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChainByAngles;

impl Model for ChainByAngles {
    sizes!(2, 1, 5, 0);

    const DESCRIPTION: Description =
        described("ChainByAngles", const { &[coordinate("a", RAD), coordinate("b", RAD)] }, CHAIN, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 2], v: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 5]) -> [T; 2] {
        let c = T::constant;
        let [m1, m2, l1, l2, k] = *b;
        let square = u[0] * u[0];
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        // Accelerations and positions, x radial, z down; forces on each mass, projected on its velocities.
        let (x1, x2, z2) = (l1 * s1, l1 * s1 + l2 * s2, l1 * c1 + l2 * c2);
        let ax1 = l1 * (c1 * a[0] - s1 * v[0] * v[0]);
        let az1 = -(l1 * (s1 * a[0] + c1 * v[0] * v[0]));
        let ax2 = ax1 + l2 * (c2 * a[1] - s2 * v[1] * v[1]);
        let az2 = az1 - l2 * (s2 * a[1] + c2 * v[1] * v[1]);
        let f1 = [m1 * (ax1 - square * x1), m1 * (az1 - c(G))];
        let f2 = [m2 * (ax2 - square * x2) + k * (x2 - c(0.6)), m2 * (az2 - c(G)) + k * (z2 - c(1.0))];
        [l1 * (c1 * (f1[0] + f2[0]) - s1 * (f1[1] + f2[1])), l2 * (c2 * f2[0] - s2 * f2[1])]
    }

    fn applied<T: Real>(&self, _: &[T; 2], _: &[T; 2], _: &[T; 1], _: &[T; 5]) -> [T; 2] {
        [T::constant(0.0); 2]
    }
}

const SPHERE: &[DesignInfo] = &[
    design("m", KILOGRAM, 0.7, 0.01),
    design("L", METRE, 1.2, 0.02),
    design("kx", STIFFNESS, 6.0, 0.1),
    design("ky", STIFFNESS, 9.0, 0.1),
    design("c", NUMBER, 0.4, 0.01),
    design("e", NUMBER, 1.0, 0.01),
];

/// A point mass on a rod of length `L` on a turntable with vertical axis, with two springs to the point `e` (0.3 m, 0.2
/// m) and a damper in the turning frame: gyroscopic and damped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spherical;

fn spherical<T: Real>(a: [T; 3], v: [T; 3], q: [T; 3], omega: T, b: &[T; 6]) -> [T; 3] {
    let c = T::constant;
    let [m, _, kx, ky, damper, e] = *b;
    let square = omega * omega;
    [
        m * (a[0] - c(2.0) * omega * v[1] - square * q[0]) + kx * (q[0] - e * c(0.3)) + damper * v[0],
        m * (a[1] + c(2.0) * omega * v[0] - square * q[1]) + ky * (q[1] - e * c(0.2)) + damper * c(0.5) * v[1],
        m * (a[2] - c(G)),
    ]
}

impl Model for Spherical {
    sizes!(4, 1, 6, 0);

    const DESCRIPTION: Description = described(
        "Spherical",
        const { &[coordinate("x", METRE), coordinate("y", METRE), coordinate("z", METRE), reaction("rod", FORCE)] },
        SPHERE,
        DampingKind::General,
    );

    fn inertia<T: Real>(&self, a: &[T; 4], v: &[T; 4], q: &[T; 4], u: &[T; 1], b: &[T; 6]) -> [T; 4] {
        let size = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]).sqrt();
        let [fx, fy, fz] = spherical([a[0], a[1], a[2]], [v[0], v[1], v[2]], [q[0], q[1], q[2]], u[0], b);
        let pull = q[3] / size;
        [fx + pull * q[0], fy + pull * q[1], fz + pull * q[2], size - b[1]]
    }

    fn applied<T: Real>(&self, _: &[T; 4], _: &[T; 4], _: &[T; 1], _: &[T; 6]) -> [T; 4] {
        [T::constant(0.0); 4]
    }
}

/// The same pendulum, described by `x` and `y`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SphericalByPlane;

impl Model for SphericalByPlane {
    sizes!(2, 1, 6, 0);

    const DESCRIPTION: Description = described(
        "SphericalByPlane",
        const { &[coordinate("x", METRE), coordinate("y", METRE)] },
        SPHERE,
        DampingKind::General,
    );

    fn inertia<T: Real>(&self, a: &[T; 2], v: &[T; 2], q: &[T; 2], u: &[T; 1], b: &[T; 6]) -> [T; 2] {
        let h = (b[1] * b[1] - q[0] * q[0] - q[1] * q[1]).sqrt();
        let (qv, vv) = (q[0] * v[0] + q[1] * v[1], v[0] * v[0] + v[1] * v[1]);
        let qa = q[0] * a[0] + q[1] * a[1];
        let vz = -(qv / h);
        let az = -((qa + vv) / h) - qv * qv / (h * h * h);
        let [fx, fy, fz] = spherical([a[0], a[1], az], [v[0], v[1], vz], [q[0], q[1], h], u[0], b);
        [fx - fz * q[0] / h, fy - fz * q[1] / h]
    }

    fn applied<T: Real>(&self, _: &[T; 2], _: &[T; 2], _: &[T; 1], _: &[T; 6]) -> [T; 2] {
        [T::constant(0.0); 2]
    }
}

const PRESS: &[DesignInfo] = &[
    design("r", METRE, 0.2, 0.002),
    design("l", METRE, 0.5, 0.003),
    design("k", STIFFNESS, 400.0, 5.0),
    design("x0", METRE, 0.62, 0.004),
];

fn crank_design<T: Real>(torque: T, [r, l, k, x0]: [T; 4]) -> [T; 7] {
    let c = T::constant;
    [c(0.02), c(1.5), r, l, k, x0, torque]
}

/// The slider-crank at rest with its torque as the input: it gives way where the torque is largest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Press;

impl Model for Press {
    sizes!(3, 1, 4, 0);

    const DESCRIPTION: Description = described("Press", CRANK_AND_SLIDER, PRESS, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 3], v: &[T; 3], q: &[T; 3], u: &[T; 1], b: &[T; 4]) -> [T; 3] {
        SliderCrank.inertia(a, v, q, &[T::constant(0.0)], &crank_design(u[0], *b))
    }

    fn applied<T: Real>(&self, _: &[T; 3], _: &[T; 3], _: &[T; 1], _: &[T; 4]) -> [T; 3] {
        [T::constant(0.0); 3]
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct PressByAngle;

impl Model for PressByAngle {
    sizes!(1, 1, 4, 0);

    const DESCRIPTION: Description = described("PressByAngle", ANGLE, PRESS, DampingKind::Zero);

    fn inertia<T: Real>(&self, a: &[T; 1], v: &[T; 1], q: &[T; 1], u: &[T; 1], b: &[T; 4]) -> [T; 1] {
        CrankByAngle.inertia(a, v, q, &[T::constant(0.0)], &crank_design(u[0], *b))
    }

    fn applied<T: Real>(&self, _: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 4]) -> [T; 1] {
        [T::constant(0.0)]
    }
}
