//! The product's derivatives of every mode of every machine, in both families: first and second derivatives of the
//! eigenvalue and of derived quantities, first derivatives of both shapes.

use core::f64::consts::TAU;

use eigentol::equilibrium::Equilibrium;
use eigentol::error::NoDerivative;
use eigentol::kernels::CurvatureKernels;
use eigentol::modes::{Family, Mode, Modes, modes, undamped_modes};
use eigentol::second_order::{mode_curvature, output_curvature};
use eigentol::sensitivity::{Quantity, sensitivities};
use eigentol::shapes::shape_sensitivity;
use eigentol::{Complex, Description, Error, Output, Role, Sensitivities};
use eigentol_tests::rederived::{Comparison, ComplexDerived, Derived, State, every_machine, ordered};

use super::expected::Expected;

/// Allowed relative errors: of values and first derivatives, of second derivatives, of shape derivatives.
const FIRST: f64 = 1e-9;
const SECOND: f64 = 2e-8;
const SHAPES: f64 = 1e-8;

#[derive(Default)]
pub(super) struct Product {
    modes: usize,
    second: usize,
    shapes: usize,
    one_sided: usize,
    outputs: usize,
    /// The largest errors relative to the allowed ones, and where they occur.
    worst: [(f64, String); 3],
}

/// Scales of the variables.
fn sizes(at: &Equilibrium) -> Vec<f64> {
    let all = at.design.iter().chain(&at.inputs);
    all.map(|&x| if x == 0.0 { 1.0 } else { x.abs() }).collect()
}

impl Product {
    fn note(&mut self, kind: usize, error: f64, allowed: f64, what: &str) {
        // NaN is the worst error of all.
        let ratio = if error.is_nan() { f64::INFINITY } else { error / allowed };
        if ratio > self.worst[kind].0 {
            self.worst[kind] = (ratio, what.to_owned());
        }
    }

    /// Checks first derivatives of a number of size `size`; the expected scale is `size` relative to each variable.
    fn first(&mut self, values: &[f64], expected: &Derived, b: &[f64], size: f64, what: &str) {
        assert_eq!(values.len(), b.len(), "{what}");
        for k in 0..b.len() {
            let scale = expected.gradient[k].abs() + 1e-2 * size / b[k];
            let error = (values[k] - expected.gradient[k]).abs();
            self.note(0, error, FIRST * scale, &format!("{what} by {k}"));
        }
    }

    fn second(&mut self, values: &[Vec<f64>], expected: &Derived, b: &[f64], size: f64, what: &str) {
        for (i, row) in values.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                let exact = expected.hessian[i][j];
                let scale = exact.abs() + 1e-2 * size / (b[i] * b[j]);
                let error = (value - exact).abs();
                self.note(1, error, SECOND * scale, &format!("{what} by {i}, {j}"));
                self.second += 1;
            }
        }
    }

    fn shape(&mut self, rates: &[Complex], expected: &[[Derived; 2]], k: usize, b: f64, what: &str) {
        let most = expected.iter().map(|[x, y]| f64::hypot(x.value, y.value)).fold(0.0, f64::max);
        for (rate, [x, y]) in rates.iter().zip(expected) {
            for (found, exact) in [(rate.re, x.gradient[k]), (rate.im, y.gradient[k])] {
                let scale = exact.abs() + 1e-2 * most / b;
                self.note(2, (found - exact).abs(), SHAPES * scale, &format!("{what} by {k}"));
                self.shapes += 1;
            }
        }
    }

    /// Every output.
    fn outputs(&mut self, what: &str, machine: &dyn CurvatureKernels, at: &Equilibrium, expected: &[Derived]) {
        let b = sizes(at);
        for (o, expected) in expected.iter().enumerate() {
            let what = format!("{what} output {o}");
            let found = output_curvature(machine, at, Output::new(o));
            let derivatives = expected.gradient.iter().chain(expected.hessian.iter().flatten());
            if !derivatives.into_iter().all(|value| value.is_finite()) {
                let reason = NoDerivative::NotSmooth;
                assert_eq!(found, Err(Error::NoSensitivity { reason }), "{what}");
                continue;
            }
            let found = found.unwrap_or_else(|error| panic!("{what}: {error}"));
            assert!(found.asymmetry < 1e-8, "{what}: {:e}", found.asymmetry);
            let size = found.value.abs().max(1e-3);
            let first = [&found.first.by_design[..], &found.first.by_input].concat();
            self.first(&first, expected, &b, size, &what);
            self.second(&ordered(&found.second), expected, &b, size, &what);
            self.outputs += 1;
        }
    }

    #[allow(clippy::too_many_arguments)]
    fn mode(
        &mut self,
        what: &str,
        machine: &dyn CurvatureKernels,
        at: &Equilibrium,
        (modes, all): (&Modes, &Sensitivities),
        r: usize,
        expected: &Expected,
    ) {
        let b = sizes(at);
        let mode = &all.modes[r];
        let curvature = mode_curvature(machine, at, modes, r).unwrap_or_else(|error| panic!("{what}: {error}"));
        let size = modes.modes[r].s.norm();
        if let Some(lambda) = &expected.lambda {
            let found = [&mode.lambda.by_design[..], &mode.lambda.by_input].concat();
            self.first(&found, lambda, &b, size * size, &format!("{what} lambda"));
            let found = ordered(&curvature.lambda);
            self.second(&found, lambda, &b, size * size, &format!("{what} lambda"));
        }
        if let Some(s) = &expected.s {
            let slopes = mode.s().unwrap_or_else(|| panic!("{what} has no derivative"));
            let slopes = [&slopes.by_design[..], &slopes.by_input].concat();
            let second = ordered(curvature.eigenvalue.as_ref().expect("second derivatives"));
            for (part, number) in s.iter().enumerate() {
                let of = |x: &Complex| [x.re, x.im][part];
                let what = format!("{what} part {part} of s");
                let values: Vec<f64> = slopes.iter().map(of).collect();
                self.first(&values, number, &b, size, &what);
                let values: Vec<Vec<f64>> = second.iter().map(|row| row.iter().map(of).collect()).collect();
                self.second(&values, number, &b, size, &what);
            }
        }
        for (quantity, number) in &expected.quantities {
            let what = format!("{what} {quantity:?}");
            let oscillates = modes.modes[r].frequency().is_some();
            let Some(slopes) = mode.of(*quantity) else {
                assert!(!oscillates, "{what} has no derivative");
                continue;
            };
            let size = match quantity {
                Quantity::DampingRatio => 1.0,
                Quantity::LogDecrement => TAU * (size / modes.modes[r].s.im).powi(2),
                _ => size,
            };
            let found = [&slopes.by_design[..], &slopes.by_input].concat();
            self.first(&found, number, &b, size, &what);
            let found = ordered(&curvature.of(*quantity).expect("as the first"));
            self.second(&found, number, &b, size, &what);
        }
        let shapes = shape_sensitivity(machine, at, modes, r).unwrap_or_else(|error| panic!("{what}: {error}"));
        for (k, &b) in b.iter().enumerate() {
            let design = at.design.len();
            let (right, left) = if k < design {
                (&shapes.right_by_design[k], &shapes.left_by_design[k])
            } else {
                let k = k - design;
                (&shapes.right_by_input[k], &shapes.left_by_input[k])
            };
            self.shape(right, &expected.right, k, b, &format!("{what} right"));
            self.shape(left, &expected.left, k, b, &format!("{what} left"));
        }
        self.modes += 1;
    }
}

/// The components that the product makes real: the largest of the coordinates and speeds; for a left vector with
/// velocity constraints, the largest of all unknowns.
fn leads(mode: &Mode, description: &Description) -> [usize; 2] {
    let roles = || description.coordinates.iter().map(|info| info.role);
    let motions = roles().filter(|role| matches!(role, Role::Position | Role::Speed)).count();
    let holonomic = roles().all(|role| matches!(role, Role::Position | Role::PositionReaction));
    let unknowns = description.coordinates.len();
    let of_left = if holonomic { motions } else { unknowns };
    [(&mode.shape[..], motions), (mode.left(), of_left)].map(|(shape, count)| {
        let real = (0..count).filter(|&i| shape[i].im.abs() <= 1e-12 * shape[i].re);
        real.max_by(|&i, &j| shape[i].re.total_cmp(&shape[j].re)).expect("a real component")
    })
}

fn assert_shape(mode: &Mode, expected: &Expected, what: &str) {
    for (shape, exact) in [(&mode.shape[..], &expected.right), (mode.left(), &expected.left)] {
        let most = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
        for (x, [re, im]) in shape.iter().zip(exact) {
            let error = f64::hypot(x.re - re.value, x.im - im.value);
            assert!(error <= 1e-8 * most, "{what}: {shape:?}");
        }
    }
}

impl Comparison for Product {
    fn compare(&mut self, what: &str, machine: &dyn CurvatureKernels, at: &Equilibrium, state: &State) {
        self.outputs(what, machine, at, &state.outputs());
        let general = eigentol::modes::modes_of(&at.linear, Family::General, &at.description)
            .unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_eq!(general.modes.len(), state.eigenvalues().len(), "{what}");
        self.general(what, machine, at, &general, state);
        let undamped = match undamped_modes(at) {
            Ok(undamped) => undamped,
            Err(Error::NonsymmetricStiffness { .. }) => return,
            Err(error) => panic!("{what}: {error}"),
        };
        let all = sensitivities(machine, at, &undamped).unwrap_or_else(|error| panic!("{what}: {error}"));
        for (r, mode) in state.undamped_modes().into_iter().enumerate() {
            let what = format!("{what} undamped mode {r}");
            let Some(mode) = mode else {
                let refused = mode_curvature(machine, at, &undamped, r);
                assert!(matches!(refused, Err(Error::ClusteredMode { .. })), "{what}");
                continue;
            };
            let expected = Expected::undamped(mode);
            assert_shape(&undamped.modes[r], &expected, &what);
            self.mode(&what, machine, at, (&undamped, &all), r, &expected);
        }
        assert!(modes(at).is_ok(), "{what}");
    }
}

impl Product {
    /// Checks every general mode.
    pub(super) fn general(
        &mut self,
        what: &str,
        machine: &dyn CurvatureKernels,
        at: &Equilibrium,
        general: &Modes,
        state: &State,
    ) {
        let all = sensitivities(machine, at, general).unwrap_or_else(|error| panic!("{what}: {error}"));
        for (r, mode) in general.modes.iter().enumerate() {
            let what = format!("{what} general mode {r}");
            let near = nalgebra::Complex::new(mode.s.re, mode.s.im);
            let leads = leads(mode, &at.description).map(Some);
            let Some(solved) = state.general_mode(near, leads) else {
                panic!("{what} is repeated");
            };
            let left = solved.left.iter().zip(&solved.right);
            let apart = |(x, y): (&ComplexDerived, &ComplexDerived)| {
                (x.re.value - y.re.value).abs() + (x.im.value - y.im.value).abs() > 1e-6
            };
            self.one_sided += usize::from(left.into_iter().any(apart));
            let expected = Expected::general(solved);
            let [re, im] = expected.s.as_ref().expect("of a general mode");
            let error = f64::hypot(re.value - mode.s.re, im.value - mode.s.im);
            assert!(error <= 1e-10 * mode.s.norm(), "{what}: {error:e} of {}", mode.s);
            assert_shape(mode, &expected, &what);
            self.mode(&what, machine, at, (general, &all), r, &expected);
        }
    }

    /// Fails if an error is larger than allowed.
    #[track_caller]
    pub(super) fn judge(self, modes: usize) {
        assert!(self.modes >= modes, "{} modes", self.modes);
        for (ratio, what) in self.worst {
            assert!(ratio <= 1.0, "{what}: {ratio:.1e} of the allowed error");
        }
    }
}

#[test]
fn every_derivative_of_every_mode() {
    let mut product = Product::default();
    every_machine(&mut product);
    let Product { second, shapes, one_sided, outputs, .. } = product;
    assert!(second > 10_000 && shapes > 5_000 && one_sided > 20 && outputs > 40);
    product.judge(150);
}
