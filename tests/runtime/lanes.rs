//! On a batch of states, kernels give the same bits as for each state alone, with every instruction set.

use crate::common::pendulum::Pendulum as ByHand;
use eigentol::kernels::lanes::{self, LaneKernel};
use eigentol::kernels::{
    BatchGradient, BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint, Gradient, Kernel, Kernels, Linear,
    LinearPartials, MotionKernel, MotionKernels, RestParts,
};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{Matrix, Mechanism, mechanism};

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

mechanism! {
    /// Damping, a force without a potential, a body without mass: what vectors do not take in solvers.
    mechanism Damped {
        input omega: rad/s;
        design c = 0.4 N*m*s/rad;
        design push = 2.0 N;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 2.0 kg, length: 1.0 m, along: x);
        body bead: point(mass: 0.5 kg);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint lean: revolute(y) from shaft to bar;
        joint slide: prismatic(x) from bar to bead;
        point end: bar at [1.0, 0, 0] m;
        force hold: spring(on: slide, stiffness: 50 N/m, rest: 0.5 m);
        force grease: damper(on: lean, damping: c);
        force thrust: follower(at: end, force: [0, 0, push]);
    }
}

/// Irregular numbers in [-1, 1).
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 11_u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn batches(count: usize, mut value: impl FnMut() -> f64) -> Vec<Batch> {
    (0..count).map(|_| Batch::from_fn(|_| value())).collect()
}

fn of_state(batches: &[Batch], state: usize) -> Vec<f64> {
    batches.iter().map(|batch| batch.0[state]).collect()
}

/// Requires equal bits, or NaN for both.
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

fn same_linear(batch: &Linear<Batch>, state: usize, alone: &Linear) {
    same_list(batch.mass.as_flattened(), state, alone.mass.as_flattened());
    same_list(batch.damping.as_flattened(), state, alone.damping.as_flattened());
    same_list(batch.stiffness.as_flattened(), state, alone.stiffness.as_flattened());
}

fn same_gradient(batch: &Gradient<Batch>, state: usize, alone: &Gradient) {
    same_list(&batch.coordinates, state, &alone.coordinates);
    same_list(&batch.inputs, state, &alone.inputs);
    same_list(&batch.design, state, &alone.design);
}

fn room(linear: &mut Linear<Batch>) -> BatchLinear<'_> {
    BatchLinear {
        mass: linear.mass.as_flattened_mut(),
        damping: linear.damping.as_flattened_mut(),
        stiffness: linear.stiffness.as_flattened_mut(),
    }
}

fn gradient_room(gradient: &mut Gradient<Batch>) -> BatchGradient<'_> {
    BatchGradient { coordinates: &mut gradient.coordinates, inputs: &mut gradient.inputs, design: &mut gradient.design }
}

/// Partial derivatives as lists of matrices.
fn write_partials(
    m: &dyn BatchKernels,
    set: Instructions,
    at: BatchPoint<'_>,
    matrices: &mut LinearPartials<Batch>,
    residual: &mut (Matrix<Batch>, Matrix<Batch>),
) {
    let size = at.q.len() * at.q.len();
    let mut flat =
        [at.q.len(), at.u.len(), at.b.len()].map(|count| [(); 3].map(|()| vec![Batch::default(); count * size]));
    let [by_coordinate, by_input, by_design] =
        flat.each_mut().map(|[mass, damping, stiffness]| BatchLinear { mass, damping, stiffness });
    let mut partials = BatchPartials { by_coordinate, by_input, by_design };
    let by = [residual.0.as_flattened_mut(), residual.1.as_flattened_mut()];
    m.partials_batch(set, at, &mut partials, by);
    let lists = [&mut matrices.by_coordinate, &mut matrices.by_input, &mut matrices.by_design];
    for (list, [mass, damping, stiffness]) in lists.into_iter().zip(&flat) {
        for (k, change) in list.iter_mut().enumerate() {
            let own = k * size..(k + 1) * size;
            let to = room(change);
            to.mass.copy_from_slice(&mass[own.clone()]);
            to.damping.copy_from_slice(&damping[own.clone()]);
            to.stiffness.copy_from_slice(&stiffness[own]);
        }
    }
}

/// Compares all kernels on one batch of states.
fn check(m: &dyn BatchKernels, q: &[Batch], u: &[Batch], b: &[Batch]) {
    let kernels: &dyn Kernels = m;
    let sizes = kernels.sizes();
    let n = sizes.coordinates;
    let mut random = numbers();
    let (phi, lambda) = (batches(n, &mut random), Batch::from_fn(|_| random()));
    let at = BatchPoint { q, u, b };
    for set in Instructions::available() {
        let mut newton = (vec![Batch::default(); n], Matrix::zeros(n, n));
        let (mut linear, mut both) = (Linear::zeros(n), (RestParts::zeros(n), Linear::zeros(n)));
        let mut matrices = LinearPartials::zeros(sizes);
        let mut partials = (Matrix::zeros(n, sizes.inputs), Matrix::zeros(n, sizes.design));
        let (mut mode, mut residual) = (Gradient::zeros(sizes), Gradient::zeros(sizes));
        m.residual_and_stiffness_batch(set, at, &mut newton.0, newton.1.as_flattened_mut());
        m.linear_batch(set, at, &mut room(&mut linear));
        let mut parts = BatchParts { inertia: &mut both.0.inertia, applied: &mut both.0.applied };
        m.parts_and_linear_batch(set, at, &mut parts, &mut room(&mut both.1));
        write_partials(m, set, at, &mut matrices, &mut partials);
        m.mode_gradient_batch(set, at, &phi, &lambda, &mut gradient_room(&mut mode));
        m.residual_gradient_batch(set, at, &phi, &mut gradient_room(&mut residual));
        for state in 0..WIDTH {
            let [q, u, b] = [q, u, b].map(|batches| of_state(batches, state));
            let (phi, lambda) = (of_state(&phi, state), lambda.0[state]);
            let (g, k) = kernels.residual_and_stiffness(&q, &u, &b);
            same_list(&newton.0, state, &g);
            same_list(newton.1.as_flattened(), state, k.as_flattened());
            let alone = kernels.linear(&q, &u, &b);
            same_linear(&linear, state, &alone);
            same_linear(&both.1, state, &alone);
            let alone = kernels.residual_parts(&q, &u, &b);
            same_list(&both.0.inertia, state, &alone.inertia);
            same_list(&both.0.applied, state, &alone.applied);
            let (by_input, by_design) = kernels.residual_partials(&q, &u, &b);
            same_list(partials.0.as_flattened(), state, by_input.as_flattened());
            same_list(partials.1.as_flattened(), state, by_design.as_flattened());
            let alone = kernels.linear_partials(&q, &u, &b);
            let mut at_once = (Matrix::zeros(n, u.len()), Matrix::zeros(n, b.len()));
            let matrices_at_once = kernels.partials(&q, &u, &b, &mut at_once);
            for (batch, alone) in [
                (&matrices.by_coordinate, &alone.by_coordinate),
                (&matrices.by_input, &alone.by_input),
                (&matrices.by_design, &alone.by_design),
            ] {
                assert_eq!(batch.len(), alone.len());
                batch.iter().zip(alone).for_each(|(batch, alone)| same_linear(batch, state, alone));
            }
            let at_once = (matrices_at_once.to_lists(), at_once);
            let one_by_one = (alone, (by_input, by_design));
            assert!(format!("{at_once:?}") == format!("{one_by_one:?}"));
            same_gradient(&mode, state, &kernels.mode_gradient(&q, &u, &b, &phi, lambda));
            same_gradient(&residual, state, &kernels.residual_gradient(&q, &u, &b, &phi));
        }
    }
}

/// Compares a kernel that [`lanes::evaluate`] takes with the same for each state alone.
fn check_lists<K: LaneKernel + Copy, M: Mechanism>(
    (kernel, m): (K, &M),
    arguments: &[&[Batch]],
    entries: &[usize],
    alone: impl Fn(&[&[f64]], &mut [&mut [f64]]),
) {
    for set in Instructions::available() {
        let mut found: Vec<Vec<Batch>> = entries.iter().map(|count| vec![Batch::default(); *count]).collect();
        let mut to: Vec<&mut [Batch]> = found.iter_mut().map(Vec::as_mut_slice).collect();
        lanes::evaluate(kernel, m, set, arguments, &mut to);
        for state in 0..WIDTH {
            let lists: Vec<Vec<f64>> = arguments.iter().map(|list| of_state(list, state)).collect();
            let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
            let mut expected: Vec<Vec<f64>> = entries.iter().map(|count| vec![0.0; *count]).collect();
            let mut to: Vec<&mut [f64]> = expected.iter_mut().map(Vec::as_mut_slice).collect();
            alone(&lists, &mut to);
            found.iter().zip(&expected).for_each(|(found, expected)| same_list(found, state, expected));
        }
    }
}

/// Compares the kernels that no table has in vectors.
fn check_named<M: Mechanism>(m: &M, q: &[Batch], u: &[Batch], b: &[Batch]) {
    let n = q.len();
    let mut random = numbers();
    let [a, v] = [(); 2].map(|()| batches(n, &mut random));
    let rest = |kernel| move |from: &[&[f64]], to: &mut [&mut [f64]]| Kernels::evaluate(m, kernel, from, to);
    let moving = |kernel| move |from: &[&[f64]], to: &mut [&mut [f64]]| m.evaluate_motion(kernel, from, to);
    let (at, along) = ([q, u, b], [&a, &v, q, u, b]);
    check_lists((lanes::Residual, m), &at, &[n], rest(Kernel::Residual));
    let by = [n * u.len(), n * b.len()];
    check_lists((lanes::ResidualPartials, m), &at, &by, rest(Kernel::ResidualPartials));
    let each = [n, u.len(), b.len()].map(|count| [count * n * n; 3]);
    check_lists((lanes::LinearPartials, m), &at, each.as_flattened(), |from, to| {
        let kernels: &dyn Kernels = m;
        let partials = kernels.linear_partials(from[0], from[1], from[2]);
        let kinds = [partials.by_coordinate, partials.by_input, partials.by_design];
        for (to, changes) in to.chunks_mut(3).zip(&kinds) {
            let lists = |of: fn(&Linear) -> &Matrix| changes.iter().flat_map(of_rows(of)).collect::<Vec<f64>>();
            to[0].copy_from_slice(&lists(|x| &x.mass));
            to[1].copy_from_slice(&lists(|x| &x.damping));
            to[2].copy_from_slice(&lists(|x| &x.stiffness));
        }
    });
    check_lists((lanes::MotionResidual, m), &along, &[n], moving(MotionKernel::Residual));
    check_lists((lanes::Motion, m), &along[1..], &[n * n, n], moving(MotionKernel::Motion));
    check_lists((lanes::MotionLinear, m), &along, &[n * n; 3], moving(MotionKernel::Linear));
}

/// The entries of one of three matrices.
fn of_rows(of: fn(&Linear) -> &Matrix) -> impl Fn(&Linear) -> Vec<f64> {
    move |linear| of(linear).as_flattened().to_vec()
}

#[test]
fn random_states() {
    let mut random = numbers();
    for _ in 0..200 {
        let q = batches(2, || 3.0 * random());
        let u = batches(1, || 10.0 * random());
        let b = batches(4, || 1.5 + random());
        check(&Everything, &q, &u, &b);
        check(&Double, &q, &u, &b);
        check(&Double, &batches(2, || 2e4 * random()), &u, &b);
        check_named(&Everything, &q, &u, &b);
        check_named(&Double, &q, &u, &b);
        check_named(&Damped, &q, &u, &b[..2]);
    }
}

/// Angles at the end of the reduction range, beyond it, and non-finite: alone and beside ordinary ones.
#[test]
fn states_at_the_edges() {
    let odd = [0.0, -0.0, 1e5, -1e5, 1.0e5_f64.next_up(), 1e300, f64::INFINITY, f64::NAN, f64::MIN_POSITIVE, 1e-310];
    for &value in &odd {
        for place in 0..WIDTH {
            let odd = |state| if state == place { value } else { 0.3 };
            let q = [Batch::from_fn(odd); 2];
            check(&Double, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 4]);
            check(&Everything, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 4]);
            check_named(&Everything, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 4]);
            check_named(&Damped, &q, &[Batch::all(2.0)], &[Batch::all(1.0); 2]);
        }
        check(&Double, &[Batch::all(value); 2], &[Batch::all(2.0)], &[Batch::all(value); 4]);
    }
}

/// A hand-written mechanism has lanes too.
#[test]
fn written_by_hand() {
    let mut random = numbers();
    let (q, b) = (batches(1, &mut random), batches(2, || 1.5 + random()));
    check(&ByHand, &q, &[Batch::all(3.0)], &b);
    check_named(&ByHand, &q, &[Batch::all(3.0)], &b);
}

#[test]
fn sets_are_in_order_and_the_best_is_one_of_them() {
    let all: Vec<_> = Instructions::available().collect();
    assert_eq!(all.first(), Some(&Instructions::SCALAR));
    assert_eq!(all.last(), Some(&Instructions::best()));
}
