//! Kernels in single precision as compiled by rustc, and in dual numbers, which differentiate what the compiler has
//! already differentiated. The latter are interpreted: generated code gives the same bits, but rustc would need minutes
//! to compile every kernel again.

use eigentol::{Array, Kernels, Mechanism};
use eigentol_compiler::program;
use eigentol_compiler::program::Program;
use eigentol_consistency::interpreter::interpret;
use eigentol_tests::corpus::{Visitor, declarations, visit};
use eigentol_tests::dual::Dual;
use eigentol_tests::generated::{evaluate, evaluate_at};
use eigentol_tests::loops;
use eigentol_tests::wheels::{RollingDisk, TowedCaster, caster, disk};

use super::Numbers;

/// Kernels whose only arguments are `q`, `u`, `b`.
const AT: [&str; 6] = ["residual", "residual_parts", "linear", "residual_partials", "outputs", "output_partials"];

fn assert_close(values: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1e-3, |most: f64, value| most.max(value.abs()));
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() <= tolerance * scale, "{what}: {one:e}, not {other:e} (largest {scale:e})");
    }
}

#[derive(Default)]
struct SinglePrecision(usize);

impl Visitor for SinglePrecision {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, _: &'static str, machine: M) {
        let arguments = Numbers::new(3).point(&machine);
        let single: Vec<Vec<f32>> =
            arguments.iter().map(|list| list.iter().map(|&value| value as f32).collect()).collect();
        for kernel in AT {
            let expected = evaluate(&machine, kernel, &arguments).expect("in the contract");
            let found = evaluate_at(&machine, kernel, &single).expect("in the contract");
            assert_eq!(found.len(), expected.len(), "{name} {kernel}");
            // Single arrays may cancel to zero, but not everything that a kernel returns.
            let tolerance = 1e-3 * largest(&expected);
            for (found, expected) in found.iter().zip(&expected) {
                let values: Vec<f64> = found.iter().copied().map(f64::from).collect();
                assert_close_to(&values, expected, tolerance, &format!("{name} {kernel}"));
            }
        }
        self.0 += 1;
    }
}

#[test]
fn single_precision_agrees_roughly() {
    let mut single = SinglePrecision::default();
    visit(&mut single);
    assert_eq!(single.0, declarations().len());
}

/// Compares derivatives of kernels in dual numbers with the kernels that return these derivatives.
struct Duals {
    machines: usize,
}

/// `d kernel / d argument[which][entry]`, with all returned arrays concatenated.
fn slope(program: &Program, kernel: &str, arguments: &[Vec<f64>], direction: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let duals: Vec<Vec<Dual>> = arguments
        .iter()
        .zip(direction)
        .map(|(values, slopes)| values.iter().zip(slopes).map(|(&x, &dx)| Dual::new(x, dx)).collect())
        .collect();
    let slices: Vec<&[Dual]> = duals.iter().map(Vec::as_slice).collect();
    let kernel = program.kernel(kernel).expect("in the contract");
    let arrays = interpret(kernel, &slices);
    arrays.iter().map(|array| array.iter().map(|value| value.slope()).collect()).collect()
}

/// Zero except for a one in one place of one argument.
fn unit(lengths: &[usize], which: usize, entry: usize) -> Vec<Vec<f64>> {
    let zeros = |(argument, &length): (usize, &usize)| {
        (0..length).map(|k| f64::from(argument == which && k == entry)).collect()
    };
    lengths.iter().enumerate().map(zeros).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `x^T A x`, with `A` by rows.
fn form(matrix: &[f64], x: &[f64]) -> f64 {
    bilinear(x, matrix, x)
}

/// `x^T A y`, with `A` by rows.
fn bilinear(x: &[f64], matrix: &[f64], y: &[f64]) -> f64 {
    matrix.chunks(y.len()).zip(x).map(|(row, x_i)| x_i * dot(row, y)).sum()
}

impl Visitor for Duals {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        const TIGHT: f64 = 1e-12;
        let tokens = declaration.parse().expect("the text has tokens");
        let program = program(tokens).expect("a declaration of the corpus");
        let mut numbers = Numbers::new(4);
        let at = numbers.point(&machine);
        let sizes = [at[0].len(), at[1].len(), at[2].len()];
        let n = sizes[0];
        let value =
            |kernel: &str, arguments: &[Vec<f64>]| evaluate(&machine, kernel, arguments).expect("in the contract");
        let linear = value("linear", &at);

        // A Jacobian assembled from its columns, by rows.
        let jacobian = |kernel: &str, arguments: &[Vec<f64>], which: usize| -> Vec<f64> {
            let lengths: Vec<usize> = arguments.iter().map(Vec::len).collect();
            let columns: Vec<Vec<f64>> = (0..lengths[which])
                .map(|entry| slope(&program, kernel, arguments, &unit(&lengths, which, entry)).swap_remove(0))
                .collect();
            let rows = value(kernel, arguments)[0].len();
            (0..rows).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
        };
        let stiffness = jacobian("residual", &at, 0);
        assert_close(&stiffness, &linear[2], TIGHT, &format!("{name} Khat"));
        let partials = value("residual_partials", &at);
        for (which, expected) in [(1, &partials[0]), (2, &partials[1])] {
            assert_close(&jacobian("residual", &at, which), expected, TIGHT, &format!("{name} dg"));
        }
        let at_rest: Vec<Vec<f64>> = [vec![vec![0.0; n]; 2], at.clone()].concat();
        for (which, expected) in [(0, &linear[0]), (1, &linear[1]), (2, &linear[2])] {
            let found = jacobian("motion_residual", &at_rest, which);
            assert_close(&found, expected, TIGHT, &format!("{name} of motion, {which}"));
        }
        let output_partials = value("output_partials", &at);
        for (which, expected) in output_partials.iter().enumerate() {
            assert_close(&jacobian("outputs", &at, which), expected, TIGHT, &format!("{name} outputs"));
        }

        // Second derivatives.
        let explicit = value("linear_partials", &at);
        for (which, matrices) in explicit.chunks(3).enumerate() {
            for entry in 0..sizes[which] {
                let found = slope(&program, "linear", &at, &unit(&sizes, which, entry));
                for (found, expected) in found.iter().zip(matrices) {
                    let expected = &expected[entry * n * n..(entry + 1) * n * n];
                    let what = format!("{name} linear_partials {which} {entry}");
                    assert_close_to(found, expected, TIGHT * largest(matrices), &what);
                }
            }
        }
        let along: Vec<Vec<f64>> = sizes.iter().map(|&size| numbers.list(size)).collect();
        let found = slope(&program, "linear", &at, &along);
        let expected = value("linear_along", &[at.clone(), along.clone()].concat());
        for (found, expected) in found.iter().zip(&expected) {
            assert_close(found, expected, TIGHT, &format!("{name} linear_along"));
        }

        // Gradients of a = phi^T (K - lambda M) phi and of w^T g, and their directional derivatives.
        let (phi, lambda, w) = (numbers.list(n), numbers.next(), numbers.list(n));
        let gradients = value("mode_gradient", &[at.clone(), vec![phi.clone(), vec![lambda]]].concat());
        let pulls = value("residual_gradient", &[at.clone(), vec![w.clone()]].concat());
        for which in 0..3 {
            let mut found = Vec::new();
            let mut pulled = Vec::new();
            for entry in 0..sizes[which] {
                let direction = unit(&sizes, which, entry);
                let change = slope(&program, "linear", &at, &direction);
                found.push(form(&change[2], &phi) - lambda * form(&change[0], &phi));
                pulled.push(dot(&slope(&program, "residual", &at, &direction)[0], &w));
            }
            assert_close_to(&found, &gradients[which], TIGHT * largest(&gradients), &format!("{name} gradient"));
            assert_close_to(&pulled, &pulls[which], TIGHT * largest(&pulls), &format!("{name} pull"));
        }
        let (dphi, dlambda, dw) = (numbers.list(n), numbers.next(), numbers.list(n));
        let mode = [at.clone(), vec![phi, vec![lambda]]].concat();
        let mode_along = [along.clone(), vec![dphi, vec![dlambda]]].concat();
        let found = slope(&program, "mode_gradient", &mode, &mode_along);
        let expected = value("mode_gradient_along", &[mode, mode_along].concat());
        for (found, expected) in found.iter().zip(&expected) {
            assert_close(found, expected, TIGHT, &format!("{name} mode_gradient_along"));
        }
        let vectors: Vec<Vec<f64>> = (0..4).map(|_| numbers.list(n)).collect();
        let pencil = [at.clone(), vectors.clone()].concat();
        let gradients = value("pencil_gradient", &pencil);
        // The explicit partial derivatives, contracted.
        for (which, matrices) in explicit.chunks(3).enumerate() {
            let values: Vec<f64> = (0..sizes[which])
                .map(|entry| {
                    let form = |(matrix, vector): (&Vec<f64>, &Vec<f64>)| {
                        let matrix = &matrix[entry * n * n..(entry + 1) * n * n];
                        bilinear(&vectors[0], matrix, vector)
                    };
                    matrices.iter().zip(&vectors[1..]).map(form).sum()
                })
                .collect();
            assert_close_to(
                &values,
                &gradients[which],
                TIGHT * largest(&gradients),
                &format!("{name} pencil_gradient {which}"),
            );
        }
        let vectors_along = (0..4).map(|_| numbers.list(n)).collect();
        let pencil_along = [along.clone(), vectors_along].concat();
        let found = slope(&program, "pencil_gradient", &pencil, &pencil_along);
        let expected = value("pencil_gradient_along", &[pencil, pencil_along].concat());
        for (found, expected) in found.iter().zip(&expected) {
            let what = format!("{name} pencil_gradient_along");
            assert_close(found, expected, TIGHT, &what);
        }
        let residual = [at, vec![w]].concat();
        let residual_along = [along, vec![dw]].concat();
        let found = slope(&program, "residual_gradient", &residual, &residual_along);
        let expected = value("residual_gradient_along", &[residual, residual_along].concat());
        for (found, expected) in found.iter().zip(&expected) {
            assert_close(found, expected, TIGHT, &format!("{name} residual_gradient_along"));
        }
        self.machines += 1;
    }
}

fn largest(arrays: &[Vec<f64>]) -> f64 {
    arrays.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()))
}

fn assert_close_to(values: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    for (one, other) in values.iter().zip(expected) {
        assert!((one - other).abs() <= tolerance, "{what}: {one:e}, not {other:e}");
    }
}

#[test]
fn duals_agree_with_every_derivative_kernel() {
    let mut duals = Duals { machines: 0 };
    visit(&mut duals);
    assert_eq!(duals.machines, declarations().len());
    loops::visit(&mut duals);
    duals.visit("caster", caster::DECLARATION, TowedCaster);
    duals.visit("disk", disk::DECLARATION, RollingDisk);
    assert!(duals.machines >= declarations().len() + 10);
}

#[derive(Default)]
struct AlongMotion(usize);

impl Visitor for AlongMotion {
    fn visit<M: Mechanism + Copy>(&mut self, name: &'static str, declaration: &'static str, machine: M) {
        let program = program(declaration.parse().expect("tokens")).expect("it compiles");
        let kernel = program.kernel("motion_residual").expect("in the contract");
        let sizes = machine.sizes();
        let n = sizes.coordinates;
        let lengths = [("acceleration", n), ("velocity", n), ("q", n), ("u", sizes.inputs), ("b", sizes.design)];
        let arguments = Numbers::new(8).arguments(&machine, &lengths);
        let [acceleration, velocity, q] = [0, 1, 2].map(|k| Array::view(&arguments[k]));
        let (u, b) = (Array::view(&arguments[3]), Array::view(&arguments[4]));
        let found = machine.motion_linear::<f64>(acceleration, velocity, q, u, b);
        for (list, matrix) in [found.mass, found.damping, found.stiffness].iter().enumerate() {
            for j in 0..n {
                let duals: Vec<Vec<Dual>> = arguments
                    .iter()
                    .enumerate()
                    .map(|(l, values)| {
                        let slope = |k: usize| if (l, k) == (list, j) { 1.0 } else { 0.0 };
                        values.iter().enumerate().map(|(k, &value)| Dual::new(value, slope(k))).collect()
                    })
                    .collect();
                let slices: Vec<&[Dual]> = duals.iter().map(Vec::as_slice).collect();
                let expected: Vec<f64> = interpret(kernel, &slices)[0].iter().map(|entry| entry.slope()).collect();
                let rows = matrix.as_ref().iter();
                let column: Vec<f64> = rows.map(|row| row.as_ref()[j]).collect();
                let scale = flat_largest(matrix.as_ref());
                for (one, other) in column.iter().zip(&expected) {
                    assert!(
                        (one - other).abs() <= 1e-11 * scale,
                        "{name}, matrix {list}, column {j}: {one:e}, not {other:e}"
                    );
                }
            }
        }
        self.0 += 1;
    }
}

fn flat_largest(matrix: &[impl AsRef<[f64]>]) -> f64 {
    matrix.iter().flat_map(AsRef::as_ref).fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()))
}

/// Generated for most machines; for the largest, differentiated column by column in the runtime's own duals.
#[test]
fn linearised_along_any_motion_as_dual_numbers_say() {
    let mut motion = AlongMotion::default();
    visit(&mut motion);
    assert_eq!(motion.0, declarations().len());
}
