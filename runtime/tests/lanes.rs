//! Kernels at the states of a batch give the bits that they give for each state alone, with every set of instructions.

mod common;

use common::pendulum::Pendulum as ByHand;
use eigentol::lanes::{self, Batch, Instructions, WIDTH};
use eigentol::{Gradient, Linear, LinearPartials, Mechanism, mechanism};

mechanism! {
    /// Every function of the language: roots, powers, exponentials and angles.
    mechanism Everything {
        input omega: rad/s;
        design l1 = 1.0 m;
        design l2 = 0.8 m;
        design m2 = 2.0 kg;
        design n = 1.5;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: 3.0 kg, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(x) from bar1 to bar2 at [0, 0, -l1];
        force roots: potential(energy: 1.0 J * sqrt(2.0 + sin(theta1) * cos(theta2)) + 0.5 J * theta1^3 / (1.0 + theta2^2)^2);
        force angles: potential(energy: 0.3 J * (tan(0.1 * theta1) + asin(0.01 * theta2) + acos(0.01 * theta1) + atan2(theta1, theta2)));
        force growth: potential(energy: 0.2 J * (exp(0.1 * theta1) + ln(3.0 + sin(theta2)) + (2.0 + cos(theta1))^n));
    }
}

mechanism! {
    mechanism Double {
        input omega: rad/s;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m;
        design l2 = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
    }
}

/// Numbers without a pattern in [-1, 1).
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 11_u64;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn batches<const K: usize>(mut value: impl FnMut() -> f64) -> [Batch; K] {
    core::array::from_fn(|_| Batch::from_fn(|_| value()))
}

fn of_state<const K: usize>(batches: &[Batch; K], state: usize) -> [f64; K] {
    core::array::from_fn(|k| batches[k].0[state])
}

/// Equal bits, or both not a number.
fn same(batch: &Batch, state: usize, alone: f64) {
    let value = batch.0[state];
    assert!(
        value.to_bits() == alone.to_bits() || (value.is_nan() && alone.is_nan()),
        "state {state}: {value:e}, alone {alone:e}"
    );
}

fn same_list(batches: &[Batch], state: usize, alone: &[f64]) {
    assert_eq!(batches.len(), alone.len());
    for (batch, alone) in batches.iter().zip(alone) {
        same(batch, state, *alone);
    }
}

fn same_linear<const N: usize>(batch: &Linear<Batch, N>, state: usize, alone: &Linear<f64, N>) {
    same_list(batch.mass.as_flattened(), state, alone.mass.as_flattened());
    same_list(
        batch.damping.as_flattened(),
        state,
        alone.damping.as_flattened(),
    );
    same_list(
        batch.stiffness.as_flattened(),
        state,
        alone.stiffness.as_flattened(),
    );
}

fn same_gradient<const N: usize, const U: usize, const P: usize>(
    batch: &Gradient<Batch, N, U, P>,
    state: usize,
    alone: &Gradient<f64, N, U, P>,
) {
    same_list(&batch.coordinates, state, &alone.coordinates);
    same_list(&batch.inputs, state, &alone.inputs);
    same_list(&batch.design, state, &alone.design);
}

/// All kernels at one batch of states.
fn check<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    m: &M,
    q: &[Batch; N],
    u: &[Batch; U],
    b: &[Batch; P],
) where
    M: Mechanism<N, U, P, O>,
{
    let mut random = numbers();
    let (phi, lambda): ([Batch; N], _) = (batches(&mut random), Batch::from_fn(|_| random()));
    for set in Instructions::available() {
        let mut newton = ([Batch::default(); N], [[Batch::default(); N]; N]);
        let mut linear = Linear::default();
        let mut partials = ([[Batch::default(); U]; N], [[Batch::default(); P]; N]);
        let mut matrices = LinearPartials::default();
        let (mut mode, mut residual) = (Gradient::default(), Gradient::default());
        lanes::residual_and_stiffness(set, m, q, u, b, &mut newton);
        lanes::linear(set, m, q, u, b, &mut linear);
        lanes::residual_partials(set, m, q, u, b, &mut partials);
        lanes::linear_partials(set, m, q, u, b, &mut matrices);
        lanes::mode_gradient(set, m, q, u, b, &phi, &lambda, &mut mode);
        lanes::residual_gradient(set, m, q, u, b, &phi, &mut residual);
        for state in 0..WIDTH {
            let (q, u, b) = (of_state(q, state), of_state(u, state), of_state(b, state));
            let (phi, lambda) = (of_state(&phi, state), lambda.0[state]);
            let (g, k) = m.residual_and_stiffness(&q, &u, &b);
            same_list(&newton.0, state, &g);
            same_list(newton.1.as_flattened(), state, k.as_flattened());
            same_linear(&linear, state, &m.linear(&q, &u, &b));
            let (by_input, by_design) = m.residual_partials(&q, &u, &b);
            same_list(partials.0.as_flattened(), state, by_input.as_flattened());
            same_list(partials.1.as_flattened(), state, by_design.as_flattened());
            let alone = m.linear_partials(&q, &u, &b);
            let at_once = m.partials(&q, &u, &b);
            let one_by_one = (alone, (by_input, by_design));
            assert!(format!("{at_once:?}") == format!("{one_by_one:?}"));
            for (batch, alone) in [
                (&matrices.by_coordinate[..], &alone.by_coordinate[..]),
                (&matrices.by_input, &alone.by_input),
                (&matrices.by_design, &alone.by_design),
            ] {
                assert_eq!(batch.len(), alone.len());
                batch
                    .iter()
                    .zip(alone)
                    .for_each(|(batch, alone)| same_linear(batch, state, alone));
            }
            same_gradient(&mode, state, &m.mode_gradient(&q, &u, &b, &phi, lambda));
            same_gradient(&residual, state, &m.residual_gradient(&q, &u, &b, &phi));
        }
    }
}

#[test]
fn random_states() {
    let mut random = numbers();
    for _ in 0..200 {
        let q = batches(|| 3.0 * random());
        let u = batches(|| 10.0 * random());
        let b = batches(|| 1.5 + random());
        check(&Everything, &q, &u, &b);
        check(&Double, &q, &u, &b);
        check(&Double, &batches(|| 2e4 * random()), &u, &b);
    }
}

/// Angles at the end of the range of the reduction, beyond it, and no angles at all: alone and beside ordinary ones.
#[test]
fn states_at_the_edges() {
    let odd = [
        0.0,
        -0.0,
        1e5,
        -1e5,
        1.0e5_f64.next_up(),
        1e300,
        f64::INFINITY,
        f64::NAN,
        f64::MIN_POSITIVE,
        1e-310,
    ];
    for &value in &odd {
        for place in 0..WIDTH {
            let q = batches(|| 0.3).map(|batch: Batch| {
                Batch::from_fn(|state| {
                    if state == place {
                        value
                    } else {
                        batch.0[state]
                    }
                })
            });
            check(&Double, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 4]);
            check(&Everything, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 4]);
        }
        check(
            &Double,
            &[Batch::all(value); 2],
            &[Batch::all(2.0)],
            &[Batch::all(value); 4],
        );
    }
}

/// A mechanism that no compiler wrote has lanes too.
#[test]
fn written_by_hand() {
    let mut random = numbers();
    let (q, b) = (batches(&mut random), batches(|| 1.5 + random()));
    check(&ByHand, &q, &[Batch::all(3.0)], &b);
}

#[test]
fn sets_are_in_order_and_the_best_is_one_of_them() {
    let all: Vec<_> = Instructions::available().collect();
    assert_eq!(all.first(), Some(&Instructions::SCALAR));
    assert_eq!(all.last(), Some(&Instructions::best()));
}
