//! The hand-written mechanisms satisfy the contract: their gradients are contractions of their explicit partial
//! derivatives.

use crate::common::chain::DOUBLE;
use crate::common::derived::Derived;
use crate::common::models::{Follower, Plate};
use crate::common::pendulum::Pendulum;
use eigentol::Vector;
use eigentol::kernels::{CurvatureKernels, Gradient, Kernels, Linear};

/// Some numbers between 0.3 and 1.3.
fn numbers(n: usize, seed: usize) -> Vector {
    Vector::from_fn(n, |i| 0.3 + (((seed * 7 + i * 5) % 11) as f64) / 11.0)
}

fn list(gradient: &Gradient) -> Vec<f64> {
    [&gradient.coordinates[..], &gradient.inputs, &gradient.design].concat()
}

fn moved(values: &[f64], h: f64, along: &[f64]) -> Vector {
    values.iter().zip(along).map(|(x, dx)| x + h * dx).collect()
}

fn check(machine: &dyn CurvatureKernels) {
    let kernels: &dyn Kernels = machine;
    let sizes = kernels.sizes();
    let n = sizes.coordinates;
    let point = [n, sizes.inputs, sizes.design];
    let point = [0, 1, 2].map(|k| numbers(point[k], 1 + k));
    let direction = [0, 1, 2].map(|k| numbers(point[k].len(), 4 + k));
    let [vectors, along] = [7, 11].map(|seed| [0, 1, 2, 3].map(|k| numbers(n, seed + k)));
    let value = |h: f64| {
        let [q, u, b] = [0, 1, 2].map(|k| moved(&point[k], h, &direction[k]));
        let vectors = [0, 1, 2, 3].map(|k| moved(&vectors[k], h, &along[k]));
        kernels.pencil_gradient(&q, &u, &b, vectors.each_ref().map(|x| &**x))
    };

    let [q, u, b] = &point;
    let [left, acceleration, velocity, position] = &vectors;
    let form = |x: &Linear| -> f64 {
        let entry = |i: usize, j: usize| {
            x.mass[i][j] * acceleration[j] + x.damping[i][j] * velocity[j] + x.stiffness[i][j] * position[j]
        };
        (0..n * n).map(|k| left[k / n] * entry(k / n, k % n)).sum()
    };
    let partials = kernels.linear_partials(q, u, b);
    let expected = [&partials.by_coordinate[..], &partials.by_input, &partials.by_design];
    let expected = expected.concat().iter().map(form).collect::<Vec<f64>>();
    let found = list(&value(0.0));
    let scale = found.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(scale > 0.0);
    for (one, other) in found.iter().zip(&expected) {
        assert!((one - other).abs() < 1e-13 * scale, "{one} {other}");
    }

    let slope = list(&machine.pencil_gradient_along(
        q,
        u,
        b,
        vectors.each_ref().map(|x| &**x),
        direction.each_ref().map(|x| &**x),
        along.each_ref().map(|x| &**x),
    ));
    let step = 1e-5;
    let scale = slope.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let (plus, minus) = (list(&value(step)), list(&value(-step)));
    for ((exact, plus), minus) in slope.iter().zip(plus).zip(minus) {
        let difference = (plus - minus) / (2.0 * step);
        assert!((exact - difference).abs() < 1e-7 * scale, "{exact} {difference}");
    }
}

#[test]
fn pencil_gradients_are_contractions_and_slopes() {
    check(&Pendulum);
    check(&DOUBLE);
    check(&Derived(Plate));
    check(&Derived(Follower));
}
