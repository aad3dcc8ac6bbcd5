use std::hint::black_box;

use eigentol::{Array, Mechanism, mechanism};

#[allow(dead_code)]
fn one<M: Mechanism>(m: M) {
    let q: &M::Coordinates<f64> = &black_box(Array::filled(0.1));
    let u: &M::Inputs<f64> = &black_box(Array::filled(5.0));
    let b: &M::Design<f64> = &black_box(Array::filled(1.0));
    black_box(m.residual(q, u, b));
}

#[allow(dead_code)]
fn all<M: Mechanism>(m: M) {
    let q: &M::Coordinates<f64> = &black_box(Array::filled(0.1));
    let u: &M::Inputs<f64> = &black_box(Array::filled(5.0));
    let b: &M::Design<f64> = &black_box(Array::filled(1.0));
    black_box(m.residual(q, u, b));
    black_box(m.residual_parts(q, u, b));
    black_box(m.motion_residual(q, q, q, u, b));
    black_box(m.motion(q, q, u, b));
    black_box(m.motion_linear(q, q, q, u, b));
    black_box(m.residual_and_stiffness(q, u, b));
    black_box(m.linear(q, u, b));
    black_box(m.residual_partials(q, u, b));
    black_box(m.linear_partials(q, u, b));
    black_box(m.linear_along(q, u, b, q, u, b));
    black_box(m.mode_gradient(q, u, b, q, 0.3));
    black_box(m.pencil_gradient(q, u, b, q, q, q, q));
    black_box(m.residual_gradient(q, u, b, q));
    black_box(m.mode_gradient_along(q, u, b, q, 0.3, q, u, b, q, 0.2));
    black_box(m.pencil_gradient_along(q, u, b, q, q, q, q, q, u, b, q, q, q, q));
    black_box(m.residual_gradient_along(q, u, b, q, q, u, b, q));
    black_box(m.whirl(q, u, b, q, q));
    black_box(m.picture(q, u, b));
    black_box(m.violation(u, b));
    black_box(m.pose_margin(q, u, b));
    black_box(m.outputs(q, u, b));
    black_box(m.output_partials(q, u, b));
}
