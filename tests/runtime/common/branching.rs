//! Mechanisms whose equilibrium branches have closed forms. Unit masses; each description gives `g`.

use eigentol::{CoordinateInfo, DampingKind, Description, DesignInfo, InputInfo, Real, Violation};

use super::derived::Model;
use super::{METRE, NUMBER, RAD, coordinate, description, design, input};

/// A mechanism of unit masses under a force law.
macro_rules! law {
    ($(#[$doc:meta])* $name:ident, $n:literal, $p:literal, symmetric: $symmetric:literal,
     $unit:ident, [$($design:literal = $nominal:literal),*],
     |$q:ident, $u:ident, $b:ident, $c:ident| $force:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name;

        impl Model for $name {
            sizes!($n, 1, $p, 0);

            const DESCRIPTION: Description = {
                const COORDINATE: CoordinateInfo = coordinate("q", $unit);
                const COORDINATES: [CoordinateInfo; $n] = [COORDINATE; $n];
                const INPUTS: [InputInfo; 1] = [input("u", NUMBER)];
                const DESIGN: [DesignInfo; $p] = [$(design($design, NUMBER, $nominal, 0.0)),*];
                description!(stringify!($name), &COORDINATES, &INPUTS, &DESIGN, $symmetric, DampingKind::Zero)
            };

            fn inertia<T: Real>(
                &self,
                a: &[T; $n],
                _: &[T; $n],
                _: &[T; $n],
                _: &[T; 1],
                _: &[T; $p],
            ) -> [T; $n] {
                *a
            }

            fn applied<T: Real>(
                &self,
                _: &[T; $n],
                q: &[T; $n],
                u: &[T; 1],
                b: &[T; $p],
            ) -> [T; $n] {
                let ($q, $u, $b) = (q, u[0], b);
                let $c = T::constant;
                let _ = ($q, $u, $b, $c);
                let g: [T; $n] = $force;
                g.map(|value| -value)
            }

            fn violation<T: Real + PartialOrd>(&self, _: &[T; 1], _: &[T; $p]) -> Option<Violation<T>> {
                None
            }

            fn outputs<T: Real>(&self, _: &[T; $n], _: &[T; 1], _: &[T; $p]) -> [T; 0] {
                []
            }
        }
    };
}

law!(
    /// Snap-through: `q^3 - a q + u`, folds at `u = +- 2 (a/3)^(3/2)`, `q = +- (a/3)^(1/2)`.
    Snap, 1, 1, symmetric: true, METRE, ["a" = 1.0],
    |q, u, b, c| [q[0] * q[0] * q[0] - b[0] * q[0] + u]
);

law!(
    /// Coinciding limit points: `(q - a)^4 - u`; at `u = 0` the equilibrium curve is flat.
    Flat, 1, 1, symmetric: true, METRE, ["a" = 0.3],
    |q, u, b, c| {
        let s = (q[0] - b[0]) * (q[0] - b[0]);
        [s * s - u]
    }
);

law!(
    /// Transcritical: `(q - d) (q - e - s (u - d))`; the branches `q = d` and `q = e + s (u - d)` cross at
    /// `u = d + (d - e) / s`.
    Exchange, 1, 3, symmetric: true, METRE, ["d" = 0.0, "e" = 0.0, "s" = 1.0],
    |q, u, b, c| [(q[0] - b[0]) * (q[0] - b[1] - b[2] * (u - b[0]))]
);

law!(
    /// Imperfect pitchfork: `q^3 - (u - a) q + e`.
    Imperfect, 1, 2, symmetric: true, METRE, ["e" = 0.01, "a" = 0.0],
    |q, u, b, c| [q[0] * q[0] * q[0] - (u - b[1]) * q[0] + b[0]]
);

law!(
    /// Subcritical pitchfork that turns back: `q^5 - q^3 + (a - u) q`, arms `u = a - q^2 + q^4`, folds at
    /// `q^2 = 1/2`, `u = a - 1/4`.
    Quintic, 1, 1, symmetric: true, METRE, ["a" = 1.0],
    |q, u, b, c| {
        let s = q[0] * q[0];
        [q[0] * (s * s - s + b[0] - u)]
    }
);

law!(
    /// Two equal stiffnesses on a rotor: `(1 - u) q`.
    Rotor, 2, 0, symmetric: true, METRE, [],
    |q, u, b, c| [(c(1.0) - u) * q[0], (c(1.0) - u) * q[1]]
);

law!(
    /// Two nearly equal stiffnesses with cubic springs: `(1 + e i - u) q_i + q_i^3`.
    NearlyTwo, 2, 1, symmetric: true, METRE, ["e" = 1e-4],
    |q, u, b, c| [
        (c(1.0) - u) * q[0] + q[0] * q[0] * q[0],
        (c(1.0) + b[0] - u) * q[1] + q[1] * q[1] * q[1]
    ]
);

law!(
    /// A non-symmetric `Khat` with a cubic spring at the first joint: `det Khat = k^2 - 6 k u + u^2` at `q = 0`, zero
    /// at `u = k (3 -+ 8^(1/2))`; on the arms `q2 = k q1 / (k - u)`.
    Lopsided, 2, 1, symmetric: false, RAD, ["k" = 1.0],
    |q, u, b, c| [
        b[0] * (q[0] + q[0] - q[1]) - u * (q[0] + c(3.0) * q[1]) + q[0] * q[0] * q[0],
        b[0] * (q[1] - q[0]) - u * q[1]
    ]
);

law!(
    /// A pitchfork at `z = q0 + 0.3 q1 - b^2 u = 0` on the branch `q1 = b u / a`, of the potential
    /// `(a - b u^2) z^2 / 2 + z^4 / 4 + a q1^2 / 2 - b u q1 + b q1 z^2`.
    MovingPitchfork, 2, 2, symmetric: true, METRE, ["a" = 1.0, "b" = 1.0],
    |q, u, b, c| {
        let z = q[0] + c(0.3) * q[1] - b[1] * b[1] * u;
        let by_z = (b[0] - b[1] * u * u) * z + z * z * z + c(2.0) * b[1] * q[1] * z;
        [by_z, c(0.3) * by_z + b[0] * q[1] - b[1] * u + b[1] * z * z]
    }
);

law!(
    /// A pitchfork at `z = q0 + 0.3 q1 - b u = 0` on the branch `q1 = u^2 - 0.2 u / b`, its rows mixed.
    Skewed, 2, 2, symmetric: false, METRE, ["a" = 1.0, "b" = 1.0],
    |q, u, b, c| {
        let z = q[0] + c(0.3) * q[1] - b[1] * u;
        let odd = (b[0] + c(0.25) * q[1] - u) * z + z * z * z;
        let even = b[1] * (q[1] - u * u) + z * z + c(0.2) * u;
        [odd + c(0.4) * even, even - c(0.6) * u * odd]
    }
);

law!(
    /// `q - sqrt(1 - u)`: the branch ends at `u = 1` with infinite slope.
    Edge, 1, 0, symmetric: true, METRE, [],
    |q, u, b, c| [q[0] - (c(1.0) - u).sqrt()]
);

law!(
    /// `(1 - u) q - 1`: runs to infinity at `u = 1`.
    Away, 1, 0, symmetric: true, METRE, [],
    |q, u, b, c| [(c(1.0) - u) * q[0] - c(1.0)]
);

law!(
    /// `(q - d) (q^2 + (u - 1)^2 - r^2)`: a line through a circle.
    Ring, 1, 2, symmetric: true, METRE, ["d" = 0.2, "r" = 0.5],
    |q, u, b, c| {
        let w = u - c(1.0);
        [(q[0] - b[0]) * (q[0] * q[0] + w * w - b[1] * b[1])]
    }
);

law!(
    /// Snap-through with a non-symmetric coupling, `q1 = q0/2`: `q0^3 - (1 - k/2) q0 + u`.
    LopsidedSnap, 2, 1, symmetric: false, METRE, ["k" = 0.2],
    |q, u, b, c| [
        q[0] * q[0] * q[0] - q[0] + b[0] * q[1] + u,
        q[1] - c(0.5) * q[0]
    ]
);

law!(
    /// Two coordinates in a quartic potential with adjustable lower-order terms, and a non-symmetric term `s`:
    /// `q_i^3 + sum_j a_ij q_j + e_i - u q_i + c q_0 q_1 (..) + s (q_1, 0)`.
    Field, 2, 7, symmetric: false, METRE,
    ["a00" = 0.0, "a01" = 0.0, "a11" = 0.0, "c" = 0.0, "e0" = 0.0, "e1" = 0.0, "s" = 0.0],
    |q, u, b, c| [
        q[0] * q[0] * q[0] + (b[0] - u) * q[0] + b[1] * q[1] + b[3] * q[0] * q[1] + b[4]
            + b[6] * q[1],
        q[1] * q[1] * q[1] + (b[2] - u) * q[1] + b[1] * q[0] + c(0.5) * b[3] * q[0] * q[0] + b[5]
    ]
);

law!(
    /// No resistance and no drive.
    Free, 1, 0, symmetric: true, METRE, [],
    |q, u, b, c| [c(0.0) * q[0] * u]
);

law!(
    /// No coordinates at all.
    Nothing, 0, 0, symmetric: true, METRE, [],
    |q, u, b, c| *q
);
