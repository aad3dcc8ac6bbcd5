//! Linear regression of a result on its inputs.

use nalgebra::{DMatrix, DVector};

use super::Sample;
use super::indices::at_least;
use crate::Error;

/// Smallest diagonal element of the triangular factor, relative to the length of its column, that is not rounding.
const INDEPENDENT: f64 = 1e-10;

/// The linear function of the inputs that best fits the result.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Regression {
    /// For each input, the standardised regression coefficient (SRC): standard deviations of the result per standard
    /// deviation of the input.
    pub coefficients: Vec<f64>,
    /// For each input, the partial correlation coefficient (PCC): its correlation with the result after removing the
    /// linear effect of all other inputs from both.
    pub partial: Vec<f64>,
    /// Coefficient of determination: the fraction of the variance that the fit explains, between 0 and 1.
    pub determination: f64,
}

impl Sample {
    /// Fits the result by least squares. The coefficients indicate the importance of inputs if the determination is
    /// near 1.
    ///
    /// # Errors
    /// [`Error::TooFew`] unless there are at least two more rows than inputs, [`Error::Dependent`] if an input is a
    /// linear function of others.
    pub fn regression(&self) -> Result<Regression, Error> {
        let (rows, inputs) = (self.rows(), self.columns.len());
        at_least("rows with a result", rows, inputs + 2)?;
        let factors = DMatrix::from_fn(rows, inputs, |i, j| self.columns[j][i]).qr();
        let r = factors.r();
        if let Some(input) = (0..inputs).find(|&j| r[(j, j)].abs() < INDEPENDENT) {
            return Err(Error::Dependent { input });
        }
        let mut projected = DVector::from_column_slice(&self.result);
        factors.q_tr_mul(&mut projected);
        let projected = projected.rows(0, inputs).into_owned();
        let singular = || Error::Dependent { input: inputs - 1 };
        let coefficients = r.solve_upper_triangular(&projected).ok_or_else(singular)?;
        let identity = DMatrix::identity(inputs, inputs);
        let inverse = r.solve_upper_triangular(&identity).ok_or_else(singular)?;

        let determination = projected.norm_squared().min(1.0);
        let partial = |i: usize| {
            // b / sqrt(b^2 + C (1 - R^2)), where C is the diagonal element of the inverse of the correlation matrix.
            let b: f64 = coefficients[i];
            let unexplained = inverse.row(i).norm_squared() * (1.0 - determination);
            let length = (b * b + unexplained).sqrt();
            if length == 0.0 { 0.0 } else { b / length }
        };
        Ok(Regression {
            partial: (0..inputs).map(partial).collect(),
            coefficients: coefficients.iter().copied().collect(),
            determination,
        })
    }
}
