//! Joint distributions: the distribution of each variable and the dependence between them.

mod copula;
mod factor;
#[cfg(feature = "serde")]
mod serial;

use crate::{Distribution, Error};
use copula::normal_correlation;
pub use factor::semidefinite_factor;

/// Random variables with given distributions and linear correlations, joined by a Gaussian copula: each is an
/// increasing function of a standard normal variable, and these are jointly normal (the Nataf model; P.-L. Liu and A.
/// Der Kiureghian, Probabilistic Engineering Mechanics 1986).
///
/// ```
/// use eigentol_statistics::{Distribution, Joint};
///
/// let bore = Distribution::uniform(19.9, 20.1)?;
/// let load = Distribution::normal(100.0, 5.0)?;
/// let both = Joint::correlated(vec![bore, load], &[1.0, 0.5, 0.5, 1.0])?;
/// let mut values = [0.0; 2];
/// both.from_normal(&[0.0, 0.0], &mut values);
/// assert!((values[0] - 20.0).abs() < 1e-14 && values[1] == 100.0);
/// assert!((both.covariance(0, 1) - 0.5 * 5.0 * 0.1 / 3.0_f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self", expecting = "a joint distribution"))]
pub struct Joint {
    variables: Vec<Distribution>,
    dependence: Option<Dependence>,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Dependence {
    /// Linear correlations, row by row.
    correlation: Vec<f64>,
    /// Lower triangular factor of the correlations of the underlying normal variables, row by row.
    factor: Vec<f64>,
}

impl Joint {
    /// Independent variables.
    #[must_use]
    pub fn independent(variables: Vec<Distribution>) -> Self {
        Self { variables, dependence: None }
    }

    /// Variables with these linear correlations, row by row; those of the underlying normal variables are computed from
    /// them.
    ///
    /// # Errors
    /// [`Error::WrongLength`] for a matrix of the wrong size; [`Error::Setting`] for a matrix that is not symmetric,
    /// lacks ones on its diagonal or is not positive semidefinite, for a correlation that two such variables cannot
    /// have, and if no jointly normal variables have all of them.
    pub fn correlated(variables: Vec<Distribution>, correlation: &[f64]) -> Result<Self, Error> {
        let count = variables.len();
        let mut factor = semidefinite_factor(correlation, count)?;
        if !variables.iter().all(Distribution::is_normal) {
            let normal = normal_correlation(&variables, correlation)?;
            factor = semidefinite_factor(&normal, count).map_err(|_| {
                Error::setting(
                    "correlation matrix",
                    "no jointly normal variables give these variables all of these correlations; \
                         smaller ones may do",
                )
            })?;
        }
        Ok(Self { variables, dependence: Some(Dependence { correlation: correlation.to_vec(), factor }) })
    }

    /// Number of variables.
    #[must_use]
    pub fn len(&self) -> usize {
        self.variables.len()
    }

    /// Whether there are no variables.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.variables.is_empty()
    }

    /// The variables.
    #[must_use]
    pub fn variables(&self) -> &[Distribution] {
        &self.variables
    }

    /// Whether they are jointly normal.
    #[must_use]
    pub fn is_normal(&self) -> bool {
        self.variables.iter().all(Distribution::is_normal)
    }

    /// Whether the variables were declared independent; false if a correlation matrix was given, even the identity.
    #[must_use]
    pub fn is_independent(&self) -> bool {
        self.dependence.is_none()
    }

    /// Covariance of two variables.
    ///
    /// # Panics
    /// If an index is out of range.
    #[must_use]
    pub fn covariance(&self, i: usize, j: usize) -> f64 {
        let delta = if i == j { 1.0 } else { 0.0 };
        let correlation = (self.dependence.as_ref()).map_or(delta, |all| all.correlation[i * self.len() + j]);
        correlation * self.variables[i].sigma() * self.variables[j].sigma()
    }

    /// Element of the lower triangular factor that generates the underlying normal variables from independent ones.
    ///
    /// # Panics
    /// If an index is out of range.
    #[must_use]
    pub fn normal_factor(&self, i: usize, j: usize) -> f64 {
        let delta = if i == j { 1.0 } else { 0.0 };
        (self.dependence.as_ref()).map_or(delta, |all| all.factor[i * self.len() + j])
    }

    /// Writes the values of the variables for independent standard normal numbers, one per variable.
    ///
    /// # Panics
    /// If a list does not have one entry per variable.
    pub fn from_normal(&self, z: &[f64], values: &mut [f64]) {
        self.require_one_each([z, values]);
        for (i, (value, variable)) in values.iter_mut().zip(&self.variables).enumerate() {
            *value = variable.from_normal(self.own_normal(i, z));
        }
    }

    /// Transforms the derivatives of a function with respect to the variables into those with respect to the
    /// independent standard normal numbers at `z`.
    ///
    /// # Panics
    /// If a list does not have one entry per variable.
    pub fn gradient_by_normal(&self, z: &[f64], by_variable: &[f64], by_normal: &mut [f64]) {
        self.require_one_each([z, by_variable, by_normal]);
        by_normal.fill(0.0);
        for (i, (slope, variable)) in by_variable.iter().zip(&self.variables).enumerate() {
            let slope = slope * variable.slope_from_normal(self.own_normal(i, z));
            match &self.dependence {
                None => by_normal[i] = slope,
                Some(all) => {
                    let row = &all.factor[i * self.len()..][..=i];
                    for (sum, factor) in by_normal.iter_mut().zip(row) {
                        *sum += slope * factor;
                    }
                }
            }
        }
    }

    fn require_one_each<const N: usize>(&self, lists: [&[f64]; N]) {
        for list in lists {
            assert_eq!(list.len(), self.len(), "one number per variable");
        }
    }

    /// The standard normal variable underlying variable `i`.
    fn own_normal(&self, i: usize, z: &[f64]) -> f64 {
        match &self.dependence {
            None => z[i],
            Some(all) => {
                let row = &all.factor[i * self.len()..][..=i];
                row.iter().zip(z).fold(0.0, |sum, (l, z)| sum + l * z)
            }
        }
    }
}
