//! The mechanisms of these tests.

use eigentol::{Description, Real};

use super::bordered::{Lagrangian, described, distance, reaction};
use crate::common::{GRAVITY, KILOGRAM, METRE, NUMBER, RAD, SPEED, STIFFNESS, coordinate, design, input, sizes};

fn c<T: Real>(value: f64) -> T {
    T::constant(value)
}

/// A point mass on a rod, on a turntable about the vertical `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point;

impl Lagrangian for Point {
    sizes!(3, 1, 2, 0);

    const DESCRIPTION: Description = described(
        "Point",
        const { &[coordinate("x", METRE), coordinate("y", METRE), reaction("rod", "N")] },
        const { &[input("omega", SPEED)] },
        const { &[design("m", KILOGRAM, 2.0, 0.0), design("l", METRE, 0.7, 0.01)] },
    );

    fn masses<T: Real>(&self, b: &[T; 2]) -> [T; 3] {
        [b[0], b[0], c(0.0)]
    }

    fn value<T: Real>(&self, x: &[T; 3], u: &[T; 1], b: &[T; 2]) -> T {
        let centrifugal = c::<T>(0.5) * b[0] * u[0] * u[0] * x[0] * x[0];
        b[0] * c(GRAVITY) * x[1] - centrifugal + x[2] * (distance(x[0], x[1]) - b[1])
    }
}

/// The same point with the rod stated twice, the second time in millimetres and with a separate length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twice;

impl Lagrangian for Twice {
    sizes!(4, 1, 3, 0);

    const DESCRIPTION: Description = described(
        "Twice",
        const { &[coordinate("x", METRE), coordinate("y", METRE), reaction("rod", "N"), reaction("again", "mN")] },
        const { &[input("omega", SPEED)] },
        const { &[design("m", KILOGRAM, 2.0, 0.0), design("l", METRE, 0.7, 0.01), design("l2", METRE, 0.7, 0.0)] },
    );

    fn masses<T: Real>(&self, b: &[T; 3]) -> [T; 4] {
        [b[0], b[0], c(0.0), c(0.0)]
    }

    fn value<T: Real>(&self, x: &[T; 4], u: &[T; 1], b: &[T; 3]) -> T {
        let once = Point.value(&[x[0], x[1], x[2]], u, &[b[0], b[1]]);
        once + x[3] * c(1e3) * (distance(x[0], x[1]) - b[2])
    }
}

/// Two point masses `A`, `B` on massless bars `O A`, `A B`, `B D`, with a spring along the diagonal `O B`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FourBar;

pub(crate) const FOUR_BAR: [f64; 8] = [1.5, 0.8, 0.4, 0.7, 0.6, 0.9, 120.0, 0.5];

impl Lagrangian for FourBar {
    sizes!(7, 1, 8, 0);

    const DESCRIPTION: Description = described(
        "FourBar",
        const {
            &[
                coordinate("ax", METRE),
                coordinate("ay", METRE),
                coordinate("bx", METRE),
                coordinate("by", METRE),
                reaction("crank", "N"),
                reaction("coupler", "N"),
                reaction("rocker", "N"),
            ]
        },
        const { &[input("omega", SPEED)] },
        const {
            &[
                design("ma", KILOGRAM, FOUR_BAR[0], 0.0),
                design("mb", KILOGRAM, FOUR_BAR[1], 0.0),
                design("l1", METRE, FOUR_BAR[2], 0.001),
                design("l2", METRE, FOUR_BAR[3], 0.001),
                design("l3", METRE, FOUR_BAR[4], 0.001),
                design("d", METRE, FOUR_BAR[5], 0.001),
                design("k", STIFFNESS, FOUR_BAR[6], 0.0),
                design("s0", METRE, FOUR_BAR[7], 0.0),
            ]
        },
    );

    fn masses<T: Real>(&self, b: &[T; 8]) -> [T; 7] {
        let none = c(0.0);
        [b[0], b[0], b[1], b[1], none, none, none]
    }

    fn value<T: Real>(&self, x: &[T; 7], u: &[T; 1], b: &[T; 8]) -> T {
        four_bar_potential(&[x[0], x[1], x[2], x[3]], u[0], b)
            + x[4] * (distance(x[0], x[1]) - b[2])
            + x[5] * (distance(x[2] - x[0], x[3] - x[1]) - b[3])
            + x[6] * (distance(x[2] - b[5], x[3]) - b[4])
    }
}

/// The potential on a turntable about the vertical through `O`.
pub(crate) fn four_bar_potential<T: Real>(p: &[T; 4], omega: T, b: &[T; 8]) -> T {
    let stretch = distance(p[2], p[3]) - b[7];
    let radii = b[0] * p[0] * p[0] + b[1] * p[2] * p[2];
    c::<T>(GRAVITY) * (b[0] * p[1] + b[1] * p[3]) + c::<T>(0.5) * b[6] * stretch * stretch
        - c::<T>(0.5) * omega * omega * radii
}

/// A crank `O A` (bar), a rod `A B` (bar) and a slider along `x` on a spring, each body in the absolute coordinates of
/// its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SliderCrank;

/// Masses of crank, rod and slider, lengths of crank and rod, spring rate and rest position.
pub(crate) const SLIDER: [f64; 7] = [0.9, 1.3, 2.1, 0.25, 0.6, 900.0, 0.7];

impl Lagrangian for SliderCrank {
    sizes!(13, 1, 7, 0);

    const DESCRIPTION: Description = described(
        "SliderCrank",
        const {
            &[
                coordinate("x1", METRE),
                coordinate("y1", METRE),
                coordinate("crank", RAD),
                coordinate("x2", METRE),
                coordinate("y2", METRE),
                coordinate("rod", RAD),
                coordinate("slider", METRE),
                reaction("o.x", "N"),
                reaction("o.y", "N"),
                reaction("a.x", "N"),
                reaction("a.y", "N"),
                reaction("b.x", "N"),
                reaction("b.y", "N"),
            ]
        },
        const { &[input("gravity", NUMBER)] },
        const {
            &[
                design("m1", KILOGRAM, SLIDER[0], 0.0),
                design("m2", KILOGRAM, SLIDER[1], 0.0),
                design("m3", KILOGRAM, SLIDER[2], 0.0),
                design("l1", METRE, SLIDER[3], 0.001),
                design("l2", METRE, SLIDER[4], 0.001),
                design("k", STIFFNESS, SLIDER[5], 0.0),
                design("s0", METRE, SLIDER[6], 0.0),
            ]
        },
    );

    fn masses<T: Real>(&self, b: &[T; 7]) -> [T; 13] {
        let none = c(0.0);
        let inertia = |mass: T, length: T| mass * length * length / c(12.0);
        let (j1, j2) = (inertia(b[0], b[3]), inertia(b[1], b[4]));
        let [m1, m2, m3] = [b[0], b[1], b[2]];
        [m1, m1, j1, m2, m2, j2, m3, none, none, none, none, none, none]
    }

    fn value<T: Real>(&self, x: &[T; 13], u: &[T; 1], b: &[T; 7]) -> T {
        let half = c::<T>(0.5);
        let (s1, c1) = x[2].sin_cos();
        let (s2, c2) = x[5].sin_cos();
        let arm1 = (half * b[3] * c1, half * b[3] * s1);
        let arm2 = (half * b[4] * c2, half * b[4] * s2);
        let stretch = x[6] - b[6];
        u[0] * (b[0] * x[1] + b[1] * x[4])
            + half * b[5] * stretch * stretch
            + x[7] * (x[0] - arm1.0)
            + x[8] * (x[1] - arm1.1)
            + x[9] * (x[3] - arm2.0 - x[0] - arm1.0)
            + x[10] * (x[4] - arm2.1 - x[1] - arm1.1)
            + x[11] * (x[6] - x[3] - arm2.0)
            + x[12] * (-x[4] - arm2.1)
    }
}

/// A platform hung on three equal parallel bars, one of them redundant; the input rotates gravity from `-y` to `+x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parallelogram;

impl Lagrangian for Parallelogram {
    sizes!(6, 1, 4, 0);

    const DESCRIPTION: Description = described(
        "Parallelogram",
        const {
            &[
                coordinate("x", METRE),
                coordinate("y", METRE),
                coordinate("tilt", RAD),
                reaction("left", "N"),
                reaction("middle", "N"),
                reaction("right", "N"),
            ]
        },
        const { &[input("turn", RAD)] },
        const {
            &[
                design("m", KILOGRAM, 3.0, 0.0),
                design("l", METRE, 0.8, 0.0),
                design("a", METRE, 0.5, 0.0),
                design("excess", METRE, 0.0, 0.0),
            ]
        },
    );

    fn masses<T: Real>(&self, b: &[T; 4]) -> [T; 6] {
        let none = c(0.0);
        let inertia = b[0] * b[2] * b[2] / c(3.0);
        [b[0], b[0], inertia, none, none, none]
    }

    fn value<T: Real>(&self, x: &[T; 6], u: &[T; 1], b: &[T; 4]) -> T {
        let (sin, cos) = u[0].sin_cos();
        let (turned, straight) = x[2].sin_cos();
        let mut sum = b[0] * c(GRAVITY) * (cos * x[1] - sin * x[0]);
        for (bar, side) in [-1.0, 0.0, 1.0].into_iter().enumerate() {
            let at = c::<T>(side) * b[2];
            let length = if bar == 1 { b[1] + b[3] } else { b[1] };
            let gap = distance(x[0] + at * straight - at, x[1] + at * turned) - length;
            sum = sum + x[3 + bar] * gap;
        }
        sum
    }
}

/// A point on two bars: an immobile structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Truss;

impl Lagrangian for Truss {
    sizes!(4, 1, 3, 0);

    const DESCRIPTION: Description = described(
        "Truss",
        const { &[coordinate("x", METRE), coordinate("y", METRE), reaction("left", "N"), reaction("right", "N")] },
        const { &[input("load", NUMBER)] },
        const { &[design("m", KILOGRAM, 2.0, 0.0), design("l", METRE, 1.3, 0.001), design("a", METRE, 0.5, 0.001)] },
    );

    fn masses<T: Real>(&self, b: &[T; 3]) -> [T; 4] {
        [b[0], b[0], c(0.0), c(0.0)]
    }

    fn value<T: Real>(&self, x: &[T; 4], u: &[T; 1], b: &[T; 3]) -> T {
        b[0] * c(GRAVITY) * x[1] - u[0] * x[0]
            + x[2] * (distance(x[0] + b[2], x[1]) - b[1])
            + x[3] * (distance(x[0] - b[2], x[1]) - b[1])
    }
}
