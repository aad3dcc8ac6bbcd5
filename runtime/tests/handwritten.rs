//! The mechanisms written by hand keep the contract: their gradients are contractions of their explicit partial derivatives.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::array::from_fn;

use common::chain::DOUBLE;
use common::derived::Derived;
use common::models::{Follower, Plate};
use common::pendulum::Pendulum;
use eigentol::{Gradient, Linear, Mechanism};

/// Some numbers between 0.3 and 1.3.
fn numbers<const K: usize>(seed: usize) -> [f64; K] {
    from_fn(|i| 0.3 + (((seed * 7 + i * 5) % 11) as f64) / 11.0)
}

fn list<const N: usize, const U: usize, const P: usize>(
    gradient: &Gradient<f64, N, U, P>,
) -> Vec<f64> {
    [
        &gradient.coordinates[..],
        &gradient.inputs,
        &gradient.design,
    ]
    .concat()
}

fn check<M, const N: usize, const U: usize, const P: usize, const O: usize>(machine: M)
where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (numbers(1), numbers(2), numbers(3));
    let (dq, du, db) = (numbers(4), numbers(5), numbers(6));
    let vectors: [[f64; N]; 4] = from_fn(|k| numbers(7 + k));
    let along: [[f64; N]; 4] = from_fn(|k| numbers(11 + k));
    let value = |h: f64| {
        let [left, acceleration, velocity, position] =
            from_fn(|k| from_fn(|i| vectors[k][i] + h * along[k][i]));
        machine.pencil_gradient(
            &from_fn(|i| q[i] + h * dq[i]),
            &from_fn(|i| u[i] + h * du[i]),
            &from_fn(|i| b[i] + h * db[i]),
            &left,
            &acceleration,
            &velocity,
            &position,
        )
    };

    let [left, acceleration, velocity, position] = &vectors;
    let form = |x: &Linear<f64, N>| -> f64 {
        let entry = |i: usize, j: usize| {
            x.mass[i][j] * acceleration[j]
                + x.damping[i][j] * velocity[j]
                + x.stiffness[i][j] * position[j]
        };
        (0..N * N).map(|k| left[k / N] * entry(k / N, k % N)).sum()
    };
    let partials = machine.linear_partials(&q, &u, &b);
    let expected = Gradient {
        coordinates: partials.by_coordinate.map(|x| form(&x)),
        inputs: partials.by_input.map(|x| form(&x)),
        design: partials.by_design.map(|x| form(&x)),
    };
    let exact = value(0.0);
    let (found, expected) = (list(&exact), list(&expected));
    let scale = found.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(scale > 0.0);
    for (one, other) in found.iter().zip(&expected) {
        assert!((one - other).abs() < 1e-13 * scale, "{one} {other}");
    }

    let [dleft, dacceleration, dvelocity, dposition] = &along;
    let slope = list(&machine.pencil_gradient_along(
        &q,
        &u,
        &b,
        left,
        acceleration,
        velocity,
        position,
        &dq,
        &du,
        &db,
        dleft,
        dacceleration,
        dvelocity,
        dposition,
    ));
    let step = 1e-5;
    let scale = slope.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let (plus, minus) = (list(&value(step)), list(&value(-step)));
    for ((exact, plus), minus) in slope.iter().zip(plus).zip(minus) {
        let difference = (plus - minus) / (2.0 * step);
        assert!(
            (exact - difference).abs() < 1e-7 * scale,
            "{exact} {difference}"
        );
    }
}

#[test]
fn pencil_gradients_are_contractions_and_slopes() {
    check(Pendulum);
    check::<_, 2, 1, 4, 1>(DOUBLE);
    check(Derived(Plate));
    check(Derived(Follower));
}
