//! Uniform bars hinged in series on a spinning shaft, with absolute angles from the downward axis, all in one plane
//! that turns with the shaft:
//!
//! `T = 1/2 sum A_jk cos(q_j - q_k) qdot_j qdot_k + Omega^2/2 sum A_jk sin q_j sin q_k`, `V = -g sum B_j cos q_j`,
//! `A_jj = L_j^2 (m_j/3 + S_j)`, `A_jk = L_j L_k (m_k/2 + S_k)` for `j < k`, `B_j = L_j (m_j/2 + S_j)`, with `S_j` the
//! mass beyond bar `j`. Design variables: lengths, then masses.

use std::array::from_fn;

use eigentol::{CoordinateInfo, DampingKind, Description, DesignInfo, OutputInfo, Real, Shared, Violation};

use super::derived::{Derived, Model};
use super::{GRAVITY, KILOGRAM, METRE, RAD, SPEED, coordinate, description, design, input, positive};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bars<const N: usize>;

pub const DOUBLE: Derived<Bars<2>> = Derived(Bars);

/// Coefficients `A` and `B`.
fn coefficients<T: Real, const N: usize>(l: &[T; N], m: &[T; N]) -> ([[T; N]; N], [T; N]) {
    let beyond: [T; N] = from_fn(|j| m[j + 1..].iter().fold(T::constant(0.0), |sum, &mass| sum + mass));
    let half = T::constant(0.5);
    let a = from_fn(|j| {
        from_fn(|k| {
            let far = j.max(k);
            let share = if j == k { T::constant(1.0 / 3.0) } else { half };
            l[j] * l[k] * (m[far] * share + beyond[far])
        })
    });
    (a, from_fn(|j| l[j] * (m[j] * half + beyond[j])))
}

macro_rules! chain {
    ($n:literal, $p:literal, $coordinates:expr, $design:expr) => {
        impl Model for Bars<$n> {
            sizes!($n, 1, $p, 1);

            const DESCRIPTION: Description = {
                const COORDINATES: [CoordinateInfo; $n] = $coordinates;
                const DESIGN: [DesignInfo; $p] = $design;
                description!(
                    "Bars",
                    &COORDINATES,
                    &[input("omega", SPEED)],
                    &DESIGN,
                    true,
                    DampingKind::Zero,
                    &[OutputInfo { name: Shared::Static("tip_radius"), unit: METRE }]
                )
            };

            fn inertia<T: Real>(
                &self,
                acceleration: &[T; $n],
                velocity: &[T; $n],
                q: &[T; $n],
                u: &[T; 1],
                b: &[T; $p],
            ) -> [T; $n] {
                let (a, _) = coefficients::<T, $n>(&from_fn(|i| b[i]), &from_fn(|i| b[i + $n]));
                from_fn(|j| {
                    let mut sum = T::constant(0.0);
                    for k in 0..$n {
                        let (sin, cos) = (q[j] - q[k]).sin_cos();
                        sum = sum
                            + a[j][k]
                                * (cos * acceleration[k] + sin * velocity[k] * velocity[k]
                                    - u[0] * u[0] * q[j].cos() * q[k].sin());
                    }
                    sum
                })
            }

            fn applied<T: Real>(&self, _: &[T; $n], q: &[T; $n], _: &[T; 1], b: &[T; $p]) -> [T; $n] {
                let (_, weight) = coefficients::<T, $n>(&from_fn(|i| b[i]), &from_fn(|i| b[i + $n]));
                from_fn(|j| -(T::constant(GRAVITY) * weight[j] * q[j].sin()))
            }

            fn violation<T: Real + PartialOrd>(&self, _: &[T; 1], b: &[T; $p]) -> Option<Violation<T>> {
                let names: [(T, &'static str); $p] =
                    from_fn(|j| (b[j], if j < $n { "length of a bar" } else { "mass of a bar" }));
                positive(&names)
            }

            fn outputs<T: Real>(&self, q: &[T; $n], _: &[T; 1], b: &[T; $p]) -> [T; 1] {
                [(0..$n).fold(T::constant(0.0), |sum, j| sum + b[j] * q[j].sin())]
            }
        }
    };
}

chain!(
    2,
    4,
    [coordinate("theta1", RAD), coordinate("theta2", RAD)],
    [
        design("l1", METRE, 1.0, 0.03),
        design("l2", METRE, 1.0, 0.03),
        design("m1", KILOGRAM, 3.0, 0.0),
        design("m2", KILOGRAM, 3.0, 0.0),
    ]
);

chain!(
    4,
    8,
    [coordinate("theta1", RAD), coordinate("theta2", RAD), coordinate("theta3", RAD), coordinate("theta4", RAD)],
    [
        design("l1", METRE, 1.0, 0.0),
        design("l2", METRE, 0.9, 0.0),
        design("l3", METRE, 1.2, 0.0),
        design("l4", METRE, 0.8, 0.0),
        design("m1", KILOGRAM, 3.0, 0.0),
        design("m2", KILOGRAM, 2.5, 0.0),
        design("m3", KILOGRAM, 3.5, 0.0),
        design("m4", KILOGRAM, 2.0, 0.0),
    ]
);
