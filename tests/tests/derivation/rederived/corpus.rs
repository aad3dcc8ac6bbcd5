//! Every machine: the product's derivatives against those found by solving again.

use eigentol::Error;
use eigentol::equilibrium::Equilibrium;
use eigentol::kernels::CurvatureKernels;
use eigentol::modes::undamped_modes;
use eigentol::sensitivity::{equilibrium_shift, output_sensitivities, sensitivities};
use eigentol_tests::corpus::declarations;
use eigentol_tests::rederived::{Comparison, ComplexDerived, Derived, GeneralMode, State, every_machine};
use nalgebra::{Complex, DMatrix, DVector};

use super::common::assert_within;

/// Required agreement of first derivatives.
const TIGHT: f64 = 1e-9;

/// A derivative by a variable of value `b` is significant from a hundredth of `value / b` upwards: smaller ones are
/// rounding errors of cancelling terms.
#[track_caller]
fn assert_gradient(values: &[f64], expected: &Derived, variables: &[f64], what: &str) {
    assert_eq!(values.len(), variables.len(), "{what}");
    for (k, (found, b)) in values.iter().zip(variables).enumerate() {
        let size = if *b == 0.0 { 1.0 } else { b.abs() };
        let scale = 1e-2 * expected.value.abs() / size;
        let what = format!("{what} by variable {k}");
        assert_within(TIGHT, &[*found], &[expected.gradient[k]], scale, &what);
    }
}

#[derive(Default)]
struct Gradients {
    points: usize,
    modes: usize,
    /// Nonzero derivatives of equilibria.
    shifts: usize,
    nonsymmetric: usize,
    repeated: usize,
}

impl Comparison for Gradients {
    fn compare(&mut self, what: &str, machine: &dyn CurvatureKernels, at: &Equilibrium, state: &State) {
        self.points += 1;
        let variables = [&at.design[..], &at.inputs].concat();

        let shift = equilibrium_shift(machine, at).expect("a shift");
        for (i, q) in state.equilibrium().into_iter().enumerate() {
            let found = [&shift.by_design[i][..], &shift.by_input[i]].concat();
            // An angle or a displacement may be zero and still move.
            let q = Derived { value: q.value.abs() + 1e-3, ..q };
            assert_gradient(&found, &q, &variables, &format!("{what} coordinate {i}"));
            self.shifts += q.gradient.iter().filter(|x| x.abs() > 1e-6).count();
        }

        let outputs = output_sensitivities(machine, at).expect("outputs");
        for (k, output) in state.outputs().iter().enumerate() {
            let (by_design, by_input) = (&outputs.by_design[k], &outputs.by_input[k]);
            if let (Some(by_design), Some(by_input)) = (by_design, by_input) {
                let found = [&by_design[..], by_input].concat();
                assert_gradient(&found, output, &variables, &format!("{what} output {k}"));
            }
        }

        let found = match undamped_modes(at) {
            Ok(undamped_modes) => undamped_modes,
            Err(Error::NonsymmetricStiffness { .. }) => {
                self.nonsymmetric += 1;
                return;
            }
            Err(error) => panic!("{what}: {error}"),
        };
        let all = sensitivities(machine, at, &found).expect("derivatives");
        for (r, mode) in state.undamped_modes().into_iter().enumerate() {
            let what = format!("{what} mode {r}");
            let Some(mode) = mode else {
                assert!(all.modes[r].clustered, "{what} is repeated");
                self.repeated += 1;
                continue;
            };
            let (own, product) = (&all.modes[r], &found.modes[r]);
            assert_within(TIGHT, &[product.lambda], &[mode.lambda.value], 0.0, &what);
            let by = [&own.lambda.by_design[..], &own.lambda.by_input].concat();
            assert_gradient(&by, &mode.lambda, &variables, &what);
            assert_eq!(own.frequency().is_some(), mode.omega.is_some(), "{what}");
            if let Some(omega) = mode.omega {
                let own = own.frequency().expect("checked");
                let by = [&own.by_design[..], &own.by_input].concat();
                assert_gradient(&by, &omega, &variables, &what);
            }
            let shape: Vec<f64> = mode.shape.iter().map(|x| x.value).collect();
            let scale = 1e-3 * shape[mode.lead];
            assert_within(1e-8, &product.shape.map(|x| x.re), &shape, scale, &what);
            self.modes += 1;
        }
    }
}

#[test]
fn first_derivatives_of_equilibria_outputs_and_undamped_modes() {
    let mut gradients = Gradients::default();
    every_machine(&mut gradients);
    assert!(gradients.points >= declarations().len());
    // From the corpus the bearing rotor and the press once and the film rotor twice; the Jeffcott rotor twice, and the
    // column.
    assert_eq!(gradients.nonsymmetric, 7);
    // Four isotropic states with two modes each.
    assert_eq!(gradients.repeated, 8);
    assert!(gradients.modes > 55, "{}", gradients.modes);
    assert!(gradients.shifts > 150, "{}", gradients.shifts);
}

/// Every machine has differentiable modes of the whole pencil, including gyroscopic and damped ones.
#[derive(Default)]
struct Pencils {
    modes: usize,
    damped: usize,
    /// Left shapes that differ from the right ones.
    one_sided: usize,
}

impl Comparison for Pencils {
    fn compare(&mut self, what: &str, _: &dyn CurvatureKernels, _: &Equilibrium, state: &State) {
        let n = state.coordinates.len();
        let matrices = state.matrices().map(|matrix| DMatrix::from_row_iterator(n, n, matrix.iter().map(complex)));
        for (r, mode) in state.general_modes().into_iter().enumerate() {
            let mode = mode.unwrap_or_else(|| panic!("{what} mode {r} is repeated"));
            let numbers = [&mode.s.re, &mode.s.im, &mode.magnitude, &mode.damping_ratio];
            let shapes = mode.right.iter().chain(&mode.left);
            for number in numbers.into_iter().chain(shapes.flat_map(|x| [&x.re, &x.im])) {
                let derivatives = number.hessian.iter().flatten().chain(&number.gradient);
                assert!(derivatives.chain([&number.value]).all(|x| x.is_finite()), "{what} {r}");
            }
            assert_pair(&mode, &matrices, what);
            self.modes += 1;
            self.damped += usize::from(mode.damping_ratio.value.abs() > 1e-6);
            let apart = |(x, y): (&_, &_)| distance(x, y) > 1e-6;
            self.one_sided += usize::from(mode.right.iter().zip(&mode.left).any(apart));
        }
    }
}

fn complex(real: &Derived) -> Complex<f64> {
    Complex::from(real.value)
}

fn value(x: &ComplexDerived) -> Complex<f64> {
    Complex::new(x.re.value, x.im.value)
}

fn distance(x: &ComplexDerived, y: &ComplexDerived) -> f64 {
    (value(x) - value(y)).norm()
}

/// Both eigenvalue equations hold, and both normalisations.
fn assert_pair(mode: &GeneralMode, [m, c, k]: &[DMatrix<Complex<f64>>; 3], what: &str) {
    let s = value(&mode.s);
    let pencil = m * (s * s) + c * s + k;
    let terms = [m.camax() * s.norm_sqr(), c.camax() * s.norm(), k.camax()];
    let scale = 1e-10 * terms.into_iter().sum::<f64>();
    let sides = [(&mode.right, pencil.clone()), (&mode.left, pencil.transpose())];
    for ((shape, pencil), lead) in sides.into_iter().zip(mode.leads) {
        let shape = DVector::from_iterator(shape.len(), shape.iter().map(value));
        assert!((pencil * &shape).camax() <= scale * shape.camax(), "{what}: {shape}");
        // Large components cancel in the sum, so its rounding is relative to its terms.
        let sizes = shape.map(|x| x.norm());
        let terms = sizes.dot(&(m.map(|x| x.norm()) * &sizes));
        assert!((shape.dotc(&(m * &shape)) - 1.0).norm() < 1e-12_f64.max(1e-15 * terms), "{what}: {shape}");
        let leading = shape[lead];
        let most = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
        assert!(leading.re >= most * (1.0 - 1e-8), "{what}: {shape}");
        assert!(leading.im.abs() <= 1e-14 * leading.re, "{what}: {shape}");
    }
}

#[test]
fn every_machine_has_modes_of_the_whole_pencil() {
    let mut pencils = Pencils::default();
    every_machine(&mut pencils);
    assert!(pencils.modes >= 70, "{}", pencils.modes);
    assert!(pencils.damped > 30, "{}", pencils.damped);
    assert!(pencils.one_sided > 10, "{}", pencils.one_sided);
}
