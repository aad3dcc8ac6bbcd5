//! One eigenpair of a matrix polynomial: `A(s) phi = 0` with one component of `phi` held at 1.

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

use super::complex::HyperComplex;
use super::machine::REPETITIONS;
use super::spectrum::evaluate;
use crate::hyper::Hyper;

type Matrix = DMatrix<Complex<f64>>;

/// A pair in doubles, ready to be refined in hyper-dual numbers.
pub(super) struct Pair {
    pub(super) s: Complex<f64>,
    shape: DVector<Complex<f64>>,
    /// The component held at 1: the largest, or the first of equally large ones.
    pub(super) lead: usize,
    /// Factors of `[A(s), A'(s) phi; e_lead^T, 0]`.
    factors: LU<Complex<f64>, Dyn, Dyn>,
}

/// The first of the largest components.
fn lead(shape: &DVector<Complex<f64>>) -> usize {
    let most = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let large = |x: &Complex<f64>| x.norm() >= most * (1.0 - 1e-9);
    shape.iter().position(large).unwrap_or(0)
}

/// The order of magnitude of the eigenvalues, estimated from the largest entries.
fn typical(coefficients: &[Matrix]) -> f64 {
    let degree = coefficients.len() - 1;
    (coefficients[0].camax() / coefficients[degree].camax()).powf(1.0 / degree as f64)
}

fn bordered(
    coefficients: &[Matrix],
    s: Complex<f64>,
    shape: &DVector<Complex<f64>>,
    lead: usize,
) -> (Matrix, DVector<Complex<f64>>) {
    let n = shape.len();
    let [value, slope] = evaluate(coefficients, s);
    let (residual, last) = (&value * shape, slope * shape);
    let mut jacobian = Matrix::zeros(n + 1, n + 1);
    jacobian.view_mut((0, 0), (n, n)).copy_from(&value);
    jacobian.view_mut((0, n), (n, 1)).copy_from(&last);
    jacobian[(n, lead)] = Complex::from(1.0);
    let mut right = DVector::zeros(n + 1);
    right.rows_mut(0, n).copy_from(&residual);
    right[n] = shape[lead] - Complex::from(1.0);
    (jacobian, right)
}

impl Pair {
    /// The pair near the eigenvalue `s`, with the given lead component or the largest one. `None` where
    /// the eigenvalue is not simple.
    pub(super) fn near(coefficients: &[Matrix], s: Complex<f64>, given: Option<usize>) -> Option<Self> {
        let n = coefficients[0].nrows();
        let mut s = s;
        let size = |s: Complex<f64>| s.norm().max(1e-6 * typical(coefficients));
        // Close to the eigenvalue, where `A` is regular.
        let factors = evaluate(coefficients, s + 1e-9 * size(s))[0].clone().lu();
        // Real for a real eigenvalue, so that the pair stays real.
        let imaginary = if s.im == 0.0 { 0.0 } else { 0.11 };
        let start = |i: usize, _| Complex::new(1.0 + 0.37 * i as f64, imaginary * i as f64);
        let mut shape = DVector::from_fn(n, start);
        for _ in 0..4 {
            shape = factors.solve(&shape)?;
            let largest = shape[lead(&shape)];
            shape /= largest;
        }
        let mut last = f64::INFINITY;
        for _ in 0..60 {
            let lead = given.unwrap_or_else(|| lead(&shape));
            let leading = shape[lead];
            shape /= leading;
            let (jacobian, right) = bordered(coefficients, s, &shape, lead);
            let factors = jacobian.lu();
            let step = factors.solve(&right)?;
            let length = step[n].norm() / size(s) + step.rows(0, n).camax();
            if length.is_nan() {
                return None;
            }
            if length <= 1e-14 || length <= 1e-9 && length >= last {
                return Some(Self { s, shape, lead, factors });
            }
            s -= step[n];
            shape -= step.rows(0, n);
            last = length;
        }
        None
    }

    /// The eigenpair of slightly different matrices, given by rows in hyper-dual numbers: eigenvalue and shape.
    pub(super) fn refine(&self, coefficients: &[&[Hyper]]) -> (HyperComplex, Vec<HyperComplex>) {
        let n = self.shape.len();
        let mut s = HyperComplex::constant(self.s);
        let constant = |value: &Complex<f64>| HyperComplex::constant(*value);
        let mut shape: Vec<HyperComplex> = self.shape.iter().map(constant).collect();
        for _ in 0..REPETITIONS {
            let mut residual = vec![HyperComplex::constant(Complex::from(0.0)); n + 1];
            for (i, row) in residual.iter_mut().take(n).enumerate() {
                for coefficient in coefficients.iter().rev() {
                    *row = *row * s;
                    for (j, component) in shape.iter().enumerate() {
                        *row = *row + component.scaled(coefficient[i * n + j]);
                    }
                }
            }
            residual[n] = shape[self.lead] - HyperComplex::constant(Complex::from(1.0));
            let steps: [DVector<Complex<f64>>; Hyper::PARTS] = std::array::from_fn(|part| {
                let column = DVector::from_fn(n + 1, |i, _| residual[i].parts()[part]);
                self.factors.solve(&column).expect("factors of a Newton step")
            });
            let step = |i: usize| HyperComplex::from_parts(std::array::from_fn(|part| steps[part][i]));
            for (i, component) in shape.iter_mut().enumerate() {
                *component = *component - step(i);
            }
            s = s - step(n);
        }
        (s, shape)
    }
}
