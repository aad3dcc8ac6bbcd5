//! Every kernel against the mechanism's own at shifted inputs, to the last bit, and derivatives by deviations against
//! differences.

use super::{Double, Single, Spherical, all_deviate};
use crate::common::chain::DOUBLE;
use crate::common::derived::Derived;
use crate::common::models::{Follower, Plate};
use crate::common::pendulum::Pendulum;
use eigentol::kernels::{
    BatchGradient, BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint, CurvatureKernels, DeviatingInputs,
    DirectionalKernels, Gradient, Kernels, Linear, LinearPartials, MotionKernels, ResidualPartials, Sizes,
};
use eigentol::scalar::{Batch, Instructions, WIDTH};
use eigentol::{DampingKind, Error, Input, Law, Matrix, ToleranceInfo, Vector};

/// Some numbers between 0.3 and 1.3.
fn numbers(n: usize, seed: usize) -> Vector {
    Vector::from_fn(n, |i| 0.3 + (((seed * 7 + i * 5) % 11) as f64) / 11.0)
}

/// Deviations, of which the last belongs to an input that already has one.
fn repeated<K: Kernels>(kernels: &K) -> DeviatingInputs<'_, K> {
    let inputs = (0..kernels.sizes().inputs).chain([0]).map(Input::new);
    DeviatingInputs::new(kernels, &inputs.collect::<Vec<_>>()).unwrap()
}

/// The inputs and own design variables that correspond to the given inputs and all design variables.
fn applied(sizes: Sizes, u: &[f64], b: &[f64]) -> (Vector, Vector) {
    let (own, deviations) = b.split_at(sizes.design);
    let mut u = Vector::from(u);
    for k in 0..u.len() {
        u[k] += deviations[k];
    }
    u[0] += deviations[u.len()];
    (u, own.into())
}

/// Derivatives by all design variables, assembled from those by inputs and own design variables.
fn joined(by_input: &[f64], by_design: &[f64]) -> Vec<f64> {
    [by_design, by_input, &by_input[..1]].concat()
}

fn same_gradient(gradient: &Gradient, expected: &Gradient) {
    assert_eq!(gradient.coordinates, expected.coordinates);
    assert_eq!(gradient.inputs, expected.inputs);
    assert_eq!(gradient.design, joined(&expected.inputs, &expected.design));
}

fn same_rows(matrix: &Matrix, by_input: &Matrix, by_design: &Matrix) {
    assert_eq!(matrix.row_count(), by_input.row_count());
    for ((found, by_input), by_design) in matrix.iter().zip(by_input.iter()).zip(by_design.iter()) {
        assert_eq!(found, joined(by_input, by_design));
    }
}

/// Both partial derivatives, from the kernel that computes them together.
fn partials_of(kernels: &dyn Kernels, q: &[f64], u: &[f64], b: &[f64]) -> (LinearPartials, ResidualPartials) {
    let mut residual = kernels.residual_partials(q, u, b);
    residual.0.as_flattened_mut().fill(f64::NAN);
    residual.1.as_flattened_mut().fill(f64::NAN);
    let matrices = kernels.partials(q, u, b, &mut residual);
    (matrices.to_lists(), residual)
}

fn same_partials(linear_partials: &LinearPartials, expected: &LinearPartials) {
    assert_eq!(linear_partials.by_coordinate, expected.by_coordinate);
    assert_eq!(linear_partials.by_input, expected.by_input);
    let (by_input, by_design) = (&expected.by_input, &expected.by_design);
    let joined: Vec<_> = [&by_design[..], by_input, &by_input[..1]].concat();
    assert_eq!(linear_partials.by_design, joined);
}

fn lists<const N: usize>(vectors: &[Vector; N]) -> [&[f64]; N] {
    vectors.each_ref().map(|vector| &**vector)
}

/// Compares one state of the mechanism with the same state expressed by deviations.
fn one_state<K: CurvatureKernels + MotionKernels>(machine: &K) {
    let deviating = repeated(machine);
    let (plain, found): (&dyn Kernels, &dyn Kernels) = (machine, &deviating);
    let (sizes, all) = (plain.sizes(), found.sizes());
    assert_eq!(all.design, sizes.design + sizes.inputs + 1);
    assert_eq!(found.description().design.len(), all.design);
    let n = sizes.coordinates;
    let (q, u, b) = (&*numbers(n, 1), &*numbers(sizes.inputs, 2), &*numbers(all.design, 3));
    let (moved, own) = applied(sizes, u, b);
    let (v, p) = (&*moved, &*own);

    assert_eq!(found.residual(q, u, b), plain.residual(q, v, p));
    assert_eq!(found.residual_parts(q, u, b), plain.residual_parts(q, v, p));
    assert_eq!(found.residual_and_stiffness(q, u, b), plain.residual_and_stiffness(q, v, p));
    assert_eq!(found.linear(q, u, b), plain.linear(q, v, p));
    assert_eq!(found.parts_and_linear(q, u, b), plain.parts_and_linear(q, v, p));
    assert_eq!(found.outputs(q, u, b), plain.outputs(q, v, p));
    assert_eq!(found.pose_margin(q, u, b), plain.pose_margin(q, v, p));
    let (real, imaginary) = (numbers(n, 4), numbers(n, 5));
    assert_eq!(found.whirl(q, u, b, &real, &imaginary), plain.whirl(q, v, p, &real, &imaginary));

    let (by_input, by_design) = plain.residual_partials(q, v, p);
    let partials = found.residual_partials(q, u, b);
    assert_eq!(partials.0, by_input);
    same_rows(&partials.1, &by_input, &by_design);
    same_partials(&found.linear_partials(q, u, b), &plain.linear_partials(q, v, p));
    let (matrices, residual) = partials_of(found, q, u, b);
    let (expected, (by_input, by_design)) = partials_of(plain, q, v, p);
    same_partials(&matrices, &expected);
    same_rows(&residual.1, &by_input, &by_design);
    let (outputs, expected) = (found.output_partials(q, u, b), plain.output_partials(q, v, p));
    assert_eq!(outputs[..2], expected[..2]);
    same_rows(&outputs[2], &expected[1], &expected[2]);

    let vectors = [6, 7, 8, 9].map(|seed| numbers(n, seed));
    let phi = &*vectors[0];
    same_gradient(&found.mode_gradient(q, u, b, phi, 0.7), &plain.mode_gradient(q, v, p, phi, 0.7));
    same_gradient(&found.pencil_gradient(q, u, b, lists(&vectors)), &plain.pencil_gradient(q, v, p, lists(&vectors)));
    same_gradient(&found.residual_gradient(q, u, b, phi), &plain.residual_gradient(q, v, p, phi));

    // Along a direction.
    let (dq, du, db) = (numbers(n, 10), numbers(sizes.inputs, 11), numbers(all.design, 12));
    let (dv, dp) = applied(sizes, &du, &db);
    let changes = [13, 14, 15, 16].map(|seed| numbers(n, seed));
    let dphi = &*changes[0];
    let (all, own) = (&deviating as &dyn CurvatureKernels, machine as &dyn CurvatureKernels);
    let (all_along, own_along): (&dyn DirectionalKernels, &dyn DirectionalKernels) = (all, own);
    assert_eq!(all_along.linear_along(q, u, b, [&dq, &du, &db]), own_along.linear_along(q, v, p, [&dq, &dv, &dp]));
    same_gradient(
        &all_along.residual_gradient_along(q, u, b, phi, [&dq, &du, &db, dphi]),
        &own_along.residual_gradient_along(q, v, p, phi, [&dq, &dv, &dp, dphi]),
    );
    same_gradient(
        &all.mode_gradient_along(q, u, b, phi, 0.7, [&dq, &du, &db, dphi], 0.2),
        &own.mode_gradient_along(q, v, p, phi, 0.7, [&dq, &dv, &dp, dphi], 0.2),
    );
    let (vectors, changes) = (lists(&vectors), lists(&changes));
    same_gradient(
        &all.pencil_gradient_along(q, u, b, vectors, [&dq, &du, &db], changes),
        &own.pencil_gradient_along(q, v, p, vectors, [&dq, &dv, &dp], changes),
    );

    // Along a motion.
    let (all, machine): (&dyn MotionKernels, &dyn MotionKernels) = (&deviating, machine);
    let (a, r) = (&*numbers(n, 17), &*numbers(n, 18));
    assert_eq!(all.motion_residual(a, r, q, u, b), machine.motion_residual(a, r, q, v, p));
    assert_eq!(all.motion(r, q, u, b), machine.motion(r, q, v, p));
    assert_eq!(all.motion_linear(a, r, q, u, b), machine.motion_linear(a, r, q, v, p));
}

#[test]
fn kernels_are_those_at_moved_inputs() {
    one_state(&Pendulum);
    one_state(&DOUBLE);
    one_state(&Derived(Plate));
    one_state(&Derived(Follower));
    one_state(&Single);
    one_state(&Double);
    one_state(&Spherical);
}

/// `found` against central differences of `value` by every design variable.
fn against_differences(b: &[f64], value: impl Fn(&[f64]) -> Vec<f64>, values: &[Vec<f64>]) {
    const STEP: f64 = 1e-5;
    for (j, slopes) in values.iter().enumerate() {
        let at = |step: f64| {
            let mut b = Vector::from(b);
            b[j] += step;
            value(&b)
        };
        let (above, below) = (at(STEP), at(-STEP));
        let scale = slopes.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        assert_eq!(slopes.len(), above.len());
        for ((slope, above), below) in slopes.iter().zip(&above).zip(&below) {
            let error = (slope - (above - below) / (2.0 * STEP)).abs();
            assert!(error <= 1e-7 * scale, "variable {j}: {error:e} of {scale:e}");
        }
    }
}

fn flat(linear: &Linear) -> Vec<f64> {
    let matrices = [&linear.mass, &linear.damping, &linear.stiffness];
    matrices.map(Matrix::as_flattened).concat()
}

fn differences<K: CurvatureKernels>(machine: &K) {
    let deviating = repeated(machine);
    let curvature: &dyn CurvatureKernels = &deviating;
    let (directional, kernels): (&dyn DirectionalKernels, &dyn Kernels) = (curvature, curvature);
    let Sizes { coordinates: n, inputs, design, .. } = kernels.sizes();
    let (q, u, b) = (&*numbers(n, 1), &*numbers(inputs, 2), &*numbers(design, 3));
    let columns = |matrix: &Matrix| -> Vec<Vec<f64>> { (0..design).map(|j| matrix.column(j).into()).collect() };

    let (_, by_design) = kernels.residual_partials(q, u, b);
    against_differences(b, |b| kernels.residual(q, u, b).into(), &columns(&by_design));
    let [.., by_design] = kernels.output_partials(q, u, b);
    against_differences(b, |b| kernels.outputs(q, u, b).into(), &columns(&by_design));
    let partials = kernels.linear_partials(q, u, b);
    let derived: Vec<_> = partials.by_design.iter().map(flat).collect();
    against_differences(b, |b| flat(&kernels.linear(q, u, b)), &derived);

    let unit = |j: usize| Vector::from_fn(design, |k| f64::from(u8::from(j == k)));
    let (zq, zu) = (Vector::zeros(n), Vector::zeros(inputs));
    let along = |j: usize| flat(&directional.linear_along(q, u, b, [&zq, &zu, &unit(j)]));
    let derived: Vec<_> = (0..design).map(along).collect();
    against_differences(b, |b| flat(&kernels.linear(q, u, b)), &derived);

    let phi = &*numbers(n, 6);
    let form = |b: &[f64]| {
        let linear = kernels.linear(q, u, b);
        let entry = |i: usize, j: usize| phi[i] * phi[j] * (linear.stiffness[i][j] - 0.7 * linear.mass[i][j]);
        vec![(0..n * n).map(|k| entry(k / n, k % n)).sum()]
    };
    let gradient = kernels.mode_gradient(q, u, b, phi, 0.7).design;
    let derived: Vec<_> = gradient.iter().map(|slope| vec![*slope]).collect();
    against_differences(b, form, &derived);

    let list = |gradient: Gradient| [&gradient.coordinates[..], &gradient.inputs, &gradient.design].concat();
    let along = |j: usize| {
        let direction = [&zq[..], &zu, &unit(j), &zq];
        list(curvature.mode_gradient_along(q, u, b, phi, 0.7, direction, 0.0))
    };
    let derived: Vec<_> = (0..design).map(along).collect();
    let value = |b: &[f64]| list(kernels.mode_gradient(q, u, b, phi, 0.7));
    against_differences(b, value, &derived);
}

#[test]
fn derivatives_by_deviations_are_what_differences_show() {
    differences(&Pendulum);
    differences(&DOUBLE);
    differences(&Derived(Plate));
    differences(&Double);
    differences(&Spherical);
}

/// A batch initialised to other numbers.
const BEFORE: Batch = Batch([7.0; WIDTH]);

fn list(from: &[Batch], state: usize) -> Vector {
    from.iter().map(|batch| batch.0[state]).collect()
}

fn same_batch(batches: &[Batch], state: usize, expected: &[f64]) {
    assert_eq!(list(batches, state), expected);
}

/// Storage for three matrices, by rows, for each of the variables.
fn room(entries: usize) -> eigentol::Linear<Vec<Batch>> {
    eigentol::Linear { mass: vec![BEFORE; entries], damping: vec![BEFORE; entries], stiffness: vec![BEFORE; entries] }
}

fn lend(room: &mut eigentol::Linear<Vec<Batch>>) -> BatchLinear<'_> {
    eigentol::Linear { mass: &mut room.mass, damping: &mut room.damping, stiffness: &mut room.stiffness }
}

/// The matrices of variable `k`.
fn same_linear(linear: &eigentol::Linear<Vec<Batch>>, k: usize, state: usize, expected: &Linear, damped: bool) {
    let matrix = |batches: &[Batch], expected: &Matrix| {
        let expected = expected.as_flattened();
        same_batch(&batches[k * expected.len()..][..expected.len()], state, expected);
    };
    matrix(&linear.mass, &expected.mass);
    matrix(&linear.stiffness, &expected.stiffness);
    if damped {
        matrix(&linear.damping, &expected.damping);
    }
}

/// Eight states at once against each one alone; the previous contents of the results do not matter.
fn eight_states<K: BatchKernels>(machine: &K, instructions: Instructions) {
    let deviating = repeated(machine);
    let batches: &dyn BatchKernels = &deviating;
    let alone: &dyn Kernels = &deviating;
    let sizes = alone.sizes();
    let n = sizes.coordinates;
    let damped = alone.description().damping != DampingKind::Zero;
    let states = |count: usize, seed: usize| -> Vec<Batch> {
        let one = |i: usize| Batch::from_fn(|state| numbers(count, seed + 3 * state)[i]);
        (0..count).map(one).collect()
    };
    let (q, u, b) = (states(n, 1), states(sizes.inputs, 2), states(sizes.design, 3));
    let (phi, lambda) = (states(n, 4), states(1, 5));
    let at = BatchPoint { q: &q, u: &u, b: &b };
    let (mut residual, mut stiffness) = (vec![BEFORE; n], vec![BEFORE; n * n]);
    batches.residual_and_stiffness_batch(instructions, at, &mut residual, &mut stiffness);
    let (mut linear, mut linear_too) = (room(n * n), room(n * n));
    batches.linear_batch(instructions, at, &mut lend(&mut linear));
    let (mut inertia, mut applied) = (vec![BEFORE; n], vec![BEFORE; n]);
    let mut parts = BatchParts { inertia: &mut inertia, applied: &mut applied };
    batches.parts_and_linear_batch(instructions, at, &mut parts, &mut lend(&mut linear_too));
    let counts = [n, sizes.inputs, sizes.design];
    let [mut by_coordinate, mut by_input, mut by_design] = counts.map(|count| room(count * n * n));
    let mut matrices = BatchPartials {
        by_coordinate: lend(&mut by_coordinate),
        by_input: lend(&mut by_input),
        by_design: lend(&mut by_design),
    };
    let mut partials = [sizes.inputs, sizes.design].map(|count| vec![BEFORE; n * count]);
    let [first, second] = &mut partials;
    batches.partials_batch(instructions, at, &mut matrices, [first, second]);
    let [mut of_mode, mut of_residual] = [(); 2].map(|()| counts.map(|count| vec![BEFORE; count]));
    let gradient = |[coordinates, inputs, design]: &mut [Vec<Batch>; 3], residual: bool| {
        let mut gradient = BatchGradient { coordinates, inputs, design };
        match residual {
            true => batches.residual_gradient_batch(instructions, at, &phi, &mut gradient),
            false => {
                batches.mode_gradient_batch(instructions, at, &phi, &lambda[0], &mut gradient);
            }
        }
    };
    gradient(&mut of_mode, false);
    gradient(&mut of_residual, true);

    for state in 0..WIDTH {
        let [q, u, b, phi] = [&q, &u, &b, &phi].map(|values| list(values, state));
        let expected = alone.residual_and_stiffness(&q, &u, &b);
        same_batch(&residual, state, &expected.0);
        same_batch(&stiffness, state, expected.1.as_flattened());
        let (expected_parts, expected) = alone.parts_and_linear(&q, &u, &b);
        same_linear(&linear, 0, state, &expected, damped);
        same_linear(&linear_too, 0, state, &expected, damped);
        same_batch(&inertia, state, &expected_parts.inertia);
        same_batch(&applied, state, &expected_parts.applied);
        let (expected, of_residual_expected) = partials_of(alone, &q, &u, &b);
        for (found, expected) in [
            (&by_coordinate, &expected.by_coordinate),
            (&by_input, &expected.by_input),
            (&by_design, &expected.by_design),
        ] {
            assert_eq!(found.mass.len(), n * n * expected.len());
            for (k, expected) in expected.iter().enumerate() {
                same_linear(found, k, state, expected, damped);
            }
        }
        let (by_input, by_design) = &of_residual_expected;
        same_batch(&partials[0], state, by_input.as_flattened());
        same_batch(&partials[1], state, by_design.as_flattened());
        let pairs = [
            (&of_mode, alone.mode_gradient(&q, &u, &b, &phi, lambda[0].0[state])),
            (&of_residual, alone.residual_gradient(&q, &u, &b, &phi)),
        ];
        for (found, expected) in pairs {
            same_batch(&found[0], state, &expected.coordinates);
            same_batch(&found[1], state, &expected.inputs);
            same_batch(&found[2], state, &expected.design);
        }
    }
}

#[test]
fn eight_states_are_each_by_itself() {
    for instructions in Instructions::available() {
        eight_states(&Pendulum, instructions);
        eight_states(&Derived(Plate), instructions);
        eight_states(&Double, instructions);
        eight_states(&Spherical, instructions);
    }
}

#[test]
fn an_impossible_input_is_a_violation() {
    let deviating = all_deviate(&Spherical);
    let (u, b) = ([1.0, 2.0, 0.5], deviating.design(&[20.0, 0.3]));
    assert_eq!(deviating.violation(&u, &b), None);
    let mut light = b.clone();
    light[2] = -1.5;
    let violation = deviating.violation(&u, &light).expect("a negative mass");
    assert_eq!(violation.quantity, "mass of bar");
    assert_eq!(violation.value, -0.5);
    // The mechanism knows ranges of its own design variables; nothing is claimed for the others.
    let mut reach = Vector::zeros(5);
    assert!(deviating.possible_within(&u, &b, &reach));
    assert!(!deviating.possible_within(&u, &light, &reach));
    reach[3] = 1e-9;
    assert!(!deviating.possible_within(&u, &b, &reach));
}

#[test]
fn deviations_are_described() {
    let inputs = [2, 0].map(Input::new);
    let deviating = DeviatingInputs::new(&Spherical, &inputs).unwrap();
    let description = deviating.description();
    let (own, deviations) = description.design.split_at(2);
    assert_eq!(own, &*Kernels::description(&Spherical).design);
    assert_eq!((&*deviations[0].name, &*deviations[1].name), ("l", "m"));
    assert_eq!(deviations[1].unit.symbol, "kg");
    assert!(deviations.iter().all(|info| info.nominal == 0.0));
    assert!(deviating.inputs().eq(inputs));
    assert!(deviating.deviations().map(|one| one.index()).eq([2, 3]));
    let foreign = DeviatingInputs::new(&Spherical, &[Input::new(3)]);
    assert!(matches!(foreign, Err(Error::UnknownHandle { kind: "input", index: 3, count: 3, .. })));
}

/// A table known only by its trait, from which another one is made.
#[test]
fn any_table_will_do() {
    let (once, u, b) = (&Double as &dyn CurvatureKernels, [5.0, 1.0], [3.0, 3.0, 1.0, 1.0]);
    let first = DeviatingInputs::new(once, &[Input::new(1)]).unwrap();
    let twice: &dyn CurvatureKernels = &first;
    let second = DeviatingInputs::new(twice, &[Input::new(0)]).unwrap();
    let both: &dyn Kernels = &second;
    let design = second.design(&first.design(&b));
    assert_eq!(design, [3.0, 3.0, 1.0, 1.0, 0.0, 0.0]);
    let mut moved = design.clone();
    (moved[4], moved[5]) = (0.25, 0.5);
    let plain: &dyn Kernels = &Double;
    let q = [0.3, 0.4];
    assert_eq!(both.residual(&q, &u, &moved), plain.residual(&q, &[5.5, 1.25], &b));
}

mod declared {
    use super::*;
    use crate::common::derived::Model;
    use crate::common::{METRE, NUMBER, coordinate, description, sizes};
    use eigentol::{Description, InputInfo, Real, Shared};

    const fn given(name: &'static str, tolerance: ToleranceInfo) -> InputInfo {
        InputInfo { name: Shared::Static(name), unit: NUMBER, tolerance }
    }

    const SKEW: ToleranceInfo = ToleranceInfo { lower: -1.0, upper: 2.0, relative: false, law: Law::Uniform };

    #[derive(Clone, Copy, Debug)]
    struct Toleranced;

    impl Model for Toleranced {
        sizes!(1, 2, 0, 0);

        const DESCRIPTION: Description = description!(
            "Toleranced",
            &[coordinate("x", METRE)],
            &[given("si", SKEW), given("fraction", ToleranceInfo { relative: true, ..SKEW })],
            &[],
            true,
            DampingKind::Zero
        );

        fn inertia<T: Real>(&self, a: &[T; 1], _: &[T; 1], _: &[T; 1], _: &[T; 2], _: &[T; 0]) -> [T; 1] {
            *a
        }

        fn applied<T: Real>(&self, _: &[T; 1], q: &[T; 1], u: &[T; 2], _: &[T; 0]) -> [T; 1] {
            [u[0] - u[1] * q[0]]
        }
    }

    #[test]
    fn tolerances_are_those_of_inputs_unless_they_are_fractions() {
        let machine = Derived(Toleranced);
        let description = all_deviate(&machine).description();
        assert_eq!(description.design[0].tolerance, SKEW);
        assert_eq!(description.design[1].tolerance, ToleranceInfo::NONE);
    }
}
