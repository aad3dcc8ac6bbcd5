//! Second derivatives of a scalar, assembled from the derivatives of its gradient.

use core::ops::{Add, Mul, Sub};
use core::slice;

use crate::algebra::Matrix;
use crate::sensitivity::Slopes;

/// Second derivatives of a scalar, SI.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: eigentol_statistics::serial::Exact + Copy + Default"))]
pub struct SecondDerivatives<T> {
    /// With respect to two inputs.
    pub by_input: Matrix<T>,
    /// `by_input_and_design[i][j]`: with respect to input `i` and design variable `j`.
    pub by_input_and_design: Matrix<T>,
    /// With respect to two design variables: the Hessian.
    pub by_design: Matrix<T>,
}

impl<T: Copy + Default> SecondDerivatives<T> {
    pub(crate) fn zeros(inputs: usize, design: usize) -> Self {
        Self {
            by_input: Matrix::zeros(inputs, inputs),
            by_input_and_design: Matrix::zeros(inputs, design),
            by_design: Matrix::zeros(design, design),
        }
    }
}

impl<T: Copy> SecondDerivatives<T> {
    /// Combines each element with the two first derivatives of its row and column.
    pub(crate) fn combine<F: Copy, R: Copy + Default>(
        &self,
        first: &Slopes<F>,
        f: impl Fn(F, F, T) -> R,
    ) -> SecondDerivatives<R> {
        Self::each(slice::from_ref(self), slice::from_ref(first), |a, b, ab| f(a[0], b[0], ab[0]))
    }

    /// Combines elements of several numbers with the first derivatives of their row and column.
    pub(crate) fn each<F: Copy, R: Copy + Default>(
        all: &[Self],
        first: &[Slopes<F>],
        f: impl Fn(&[F], &[F], &[T]) -> R,
    ) -> SecondDerivatives<R> {
        type Side<F> = for<'a> fn(&'a Slopes<F>) -> &'a [F];
        let block = |of: fn(&Self) -> &Matrix<T>, rows: Side<F>, columns: Side<F>| {
            let Some(matrix) = all.first().map(of) else { return Matrix::zeros(0, 0) };
            Matrix::from_fn(matrix.row_count(), matrix.column_count(), |i, j| {
                let slopes = |side: Side<F>, k: usize| first.iter().map(|own| side(own)[k]).collect::<Vec<F>>();
                let own: Vec<T> = all.iter().map(|own| of(own)[i][j]).collect();
                f(&slopes(rows, i), &slopes(columns, j), &own)
            })
        };
        let (inputs, design): (Side<F>, Side<F>) = (|own| &own.by_input, |own| &own.by_design);
        SecondDerivatives {
            by_input: block(|own| &own.by_input, inputs, inputs),
            by_input_and_design: block(|own| &own.by_input_and_design, inputs, design),
            by_design: block(|own| &own.by_design, design, design),
        }
    }

    /// The second derivatives of two numbers together.
    pub(crate) fn zip<S: Copy>(&self, other: &SecondDerivatives<S>) -> SecondDerivatives<(T, S)>
    where
        (T, S): Default,
    {
        let pairs = |matrix: &Matrix<T>, other: &Matrix<S>| {
            Matrix::from_fn(matrix.row_count(), matrix.column_count(), |i, j| (matrix[i][j], other[i][j]))
        };
        SecondDerivatives {
            by_input: pairs(&self.by_input, &other.by_input),
            by_input_and_design: pairs(&self.by_input_and_design, &other.by_input_and_design),
            by_design: pairs(&self.by_design, &other.by_design),
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        [&self.by_input, &self.by_input_and_design, &self.by_design].into_iter().flat_map(Matrix::as_flattened)
    }
}

/// Averages mirrored elements, and returns their largest relative difference; the first `inputs` rows belong to inputs.
pub(crate) fn symmetric<T>(rows: &[Slopes<T>], inputs: usize, size: impl Fn(T) -> f64) -> (SecondDerivatives<T>, f64)
where
    T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let element = |i: usize, j: usize| match j.checked_sub(inputs) {
        None => rows[i].by_input[j],
        Some(j) => rows[i].by_design[j],
    };
    let mean = |i: usize, j: usize| (element(i, j) + element(j, i)) * 0.5;
    let (mut most, mut difference) = (0.0_f64, 0.0_f64);
    for i in 0..rows.len() {
        for j in 0..=i {
            most = most.max(size(element(i, j)));
            difference = difference.max(size(element(i, j) - element(j, i)));
        }
    }
    let (u, p) = (inputs, rows.len() - inputs);
    let second = SecondDerivatives {
        by_input: Matrix::from_fn(u, u, mean),
        by_input_and_design: Matrix::from_fn(u, p, |i, j| mean(i, u + j)),
        by_design: Matrix::from_fn(p, p, |i, j| mean(u + i, u + j)),
    };
    (second, if most > 0.0 { difference / most } else { 0.0 })
}
