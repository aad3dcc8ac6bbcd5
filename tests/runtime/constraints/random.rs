//! Hanging chains of three point masses with springs on a turntable: from any start a stable equilibrium is found, at
//! which the potential in minimal coordinates has a minimum.

use std::array::from_fn;

use eigentol::{Description, DesignInfo, Equilibrium, Policy, Real, Stability};

use super::bordered::{Lagrangian, bordered, described, distance, reaction};
use crate::common::dual::Dual;
use crate::common::{GRAVITY, METRE, NUMBER, SPEED, coordinate, design, input, sizes};

/// Masses, lengths, spring rates; the springs pull towards fixed points.
const DESIGN: &[DesignInfo] = &[
    design("m1", NUMBER, 1.0, 0.0),
    design("m2", NUMBER, 1.0, 0.0),
    design("m3", NUMBER, 1.0, 0.0),
    design("l1", NUMBER, 1.0, 0.0),
    design("l2", NUMBER, 1.0, 0.0),
    design("l3", NUMBER, 1.0, 0.0),
    design("k1", NUMBER, 1.0, 0.0),
    design("k2", NUMBER, 1.0, 0.0),
    design("k3", NUMBER, 1.0, 0.0),
];

fn potential<T: Real>(p: &[T; 6], omega: T, b: &[T; 9]) -> T {
    let half = T::constant(0.5);
    (0..3).fold(T::constant(0.0), |sum, i| {
        let (x, y) = (p[2 * i], p[2 * i + 1]);
        let (dx, dy) = (x - T::constant(0.7), y - T::constant(0.4 - 0.3 * i as f64));
        sum + b[i] * (T::constant(GRAVITY) * y - half * omega * omega * x * x) + half * b[6 + i] * (dx * dx + dy * dy)
    })
}

fn gaps<T: Real>(p: &[T], b: &[T; 9]) -> [T; 3] {
    from_fn(|i| {
        let before = |j: usize| {
            if i == 0 { T::constant(0.0) } else { p[2 * i - 2 + j] }
        };
        distance(p[2 * i] - before(0), p[2 * i + 1] - before(1)) - b[3 + i]
    })
}

#[derive(Clone, Copy)]
struct Chain;

impl Lagrangian for Chain {
    sizes!(9, 1, 9, 0);

    const DESCRIPTION: Description = described(
        "Chain",
        const {
            &[
                coordinate("x1", METRE),
                coordinate("y1", METRE),
                coordinate("x2", METRE),
                coordinate("y2", METRE),
                coordinate("x3", METRE),
                coordinate("y3", METRE),
                reaction("rod1", "N"),
                reaction("rod2", "N"),
                reaction("rod3", "N"),
            ]
        },
        const { &[input("omega", SPEED)] },
        DESIGN,
    );

    fn masses<T: Real>(&self, b: &[T; 9]) -> [T; 9] {
        from_fn(|i| if i < 6 { b[i / 2] } else { T::constant(0.0) })
    }

    fn value<T: Real>(&self, x: &[T; 9], u: &[T; 1], b: &[T; 9]) -> T {
        let gaps = gaps(&x[..6], b);
        potential(&from_fn(|i| x[i]), u[0], b) + x[6] * gaps[0] + x[7] * gaps[1] + x[8] * gaps[2]
    }
}

/// States the second rod twice, once by the square of its length, and adds the sum of the first and the third.
#[derive(Clone, Copy)]
struct Redundant;

impl Lagrangian for Redundant {
    sizes!(11, 1, 9, 0);

    const DESCRIPTION: Description = described(
        "Chain",
        const {
            &[
                coordinate("x1", METRE),
                coordinate("y1", METRE),
                coordinate("x2", METRE),
                coordinate("y2", METRE),
                coordinate("x3", METRE),
                coordinate("y3", METRE),
                reaction("rod1", "N"),
                reaction("sum", "N"),
                reaction("square", "N/m"),
                reaction("rod2", "N"),
                reaction("rod3", "N"),
            ]
        },
        const { &[input("omega", SPEED)] },
        DESIGN,
    );

    fn masses<T: Real>(&self, b: &[T; 9]) -> [T; 11] {
        from_fn(|i| if i < 6 { b[i / 2] } else { T::constant(0.0) })
    }

    fn value<T: Real>(&self, x: &[T; 11], u: &[T; 1], b: &[T; 9]) -> T {
        let g = gaps(&x[..6], b);
        let (dx, dy) = (x[2] - x[0], x[3] - x[1]);
        potential(&from_fn(|i| x[i]), u[0], b)
            + x[6] * g[0]
            + x[7] * (g[0] + g[2])
            + x[8] * (dx * dx + dy * dy - b[4] * b[4])
            + x[9] * g[1]
            + x[10] * g[2]
    }
}

/// `V` as a function of the three angles from the downward axis.
fn by_angles<T: Real>(t: &[T; 3], omega: T, b: &[T; 9]) -> T {
    let mut p = [T::constant(0.0); 6];
    let mut at = (T::constant(0.0), T::constant(0.0));
    for i in 0..3 {
        let (sin, cos) = t[i].sin_cos();
        at = (at.0 + b[3 + i] * sin, at.1 - b[3 + i] * cos);
        (p[2 * i], p[2 * i + 1]) = at;
    }
    potential(&p, omega, b)
}

/// The gradient of `V` by the angles, relative to its curvature; and the leading minors of the Hessian.
fn minimum(state: &Equilibrium) -> (f64, [f64; 3]) {
    let x = &state.coordinates;
    let angles: [f64; 3] = from_fn(|i| {
        let before = |j: usize| if i == 0 { 0.0 } else { x[2 * i - 2 + j] };
        (x[2 * i] - before(0)).atan2(before(1) - x[2 * i + 1])
    });
    let b = from_fn(|i| Dual::fixed(Dual::fixed(state.design[i])));
    let omega = Dual::fixed(Dual::fixed(state.inputs[0]));
    let value = |i: usize, j: usize| {
        let seed = |hit: bool| if hit { 1.0 } else { 0.0 };
        let t = from_fn(|k| Dual::new(Dual::new(angles[k], seed(k == i)), Dual::new(seed(k == j), 0.0)));
        by_angles(&t, omega, &b)
    };
    let h: [[f64; 3]; 3] = from_fn(|i| from_fn(|j| value(i, j).slope.slope));
    let size = h.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs()));
    let slope = (0..3).fold(0.0_f64, |most, i| most.max(value(i, i).value.slope.abs()));
    let two = h[0][0] * h[1][1] - h[0][1] * h[1][0];
    let three = h[0][0] * (h[1][1] * h[2][2] - h[1][2] * h[2][1]) - h[0][1] * (h[1][0] * h[2][2] - h[1][2] * h[2][0])
        + h[0][2] * (h[1][0] * h[2][1] - h[1][1] * h[2][0]);
    (slope / size, [h[0][0], two, three])
}

struct Random(u64);

impl Random {
    /// Uniform between two values.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn a_stable_equilibrium_is_found_from_anywhere() {
    stable_equilibria_are_found(6);
}

#[test]
#[ignore = "ten seconds"]
fn a_stable_equilibrium_is_found_from_anywhere_many_times() {
    stable_equilibria_are_found(40);
}

fn stable_equilibria_are_found(cases: u32) {
    let mut random = Random(7);
    for case in 0..cases {
        let mut b: [f64; 9] = from_fn(|i| match i {
            0..3 => 10_f64.powf(random.between(-2.0, 2.0)),
            3..6 => random.between(0.2, 1.5),
            _ => 10_f64.powf(random.between(0.0, 3.0)),
        });
        if case % 3 == 0 {
            b[6..].fill(0.0);
        }
        let omega = random.between(0.0, 6.0);
        let values: [f64; 6] = from_fn(|_| random.between(-2.0, 2.0));
        let plain: [f64; 9] = from_fn(|i| if i < 6 { values[i] } else { 0.0 });
        let redundant: [f64; 11] = from_fn(|i| if i < 6 { values[i] } else { 0.0 });
        let one = eigentol::equilibrium::equilibrium(&bordered(Chain), &[omega], &b, &plain, Policy::Stable);
        let two = eigentol::equilibrium::equilibrium(&bordered(Redundant), &[omega], &b, &redundant, Policy::Stable);
        let one = one.unwrap_or_else(|error| panic!("case {case}: {error}"));
        let two = two.unwrap_or_else(|error| panic!("case {case}, redundant: {error}"));
        assert_eq!((one.constraints.freedom, one.constraints.redundant), (3, 0));
        assert_eq!((two.constraints.freedom, two.constraints.redundant), (3, 2), "case {case}");
        assert!(!two.constraints.singular);
        for (stability, (slope, minors)) in [(one.stability, minimum(&one)), (two.stability, minimum(&two))] {
            assert_eq!(stability, Stability::Stable, "case {case}");
            assert!(slope < 1e-11, "case {case}: {slope:e}");
            assert!(minors.iter().all(|&minor| minor > 0.0), "case {case}: {minors:?}");
        }
    }
}

#[test]
fn the_nearest_equilibrium_is_one() {
    nearest_equilibria_are_equilibria(6);
}

#[test]
#[ignore = "ten seconds"]
fn the_nearest_equilibrium_is_one_many_times() {
    nearest_equilibria_are_equilibria(40);
}

fn nearest_equilibria_are_equilibria(cases: u32) {
    let mut random = Random(8);
    let mut found = 0;
    for case in 0..cases {
        let b: [f64; 9] = from_fn(|i| match i {
            0..6 => random.between(0.3, 1.5),
            _ => random.between(0.0, 100.0),
        });
        let omega = random.between(0.0, 4.0);
        let start: [f64; 11] = from_fn(|i| if i < 6 { random.between(-1.5, 1.5) } else { 0.0 });
        let state = eigentol::equilibrium::equilibrium(&bordered(Redundant), &[omega], &b, &start, Policy::Nearest);
        if let Ok(state) = state {
            let (slope, minors) = minimum(&state);
            assert!(slope < 1e-10, "case {case}: {slope:e}");
            let stable = minors.iter().all(|&minor| minor > 0.0);
            assert_eq!(stable, state.stability == Stability::Stable, "case {case}");
            found += 1;
        }
    }
    assert!(5 * found >= 4 * cases, "{found}");
}
