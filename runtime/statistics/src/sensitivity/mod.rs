//! Attribution of the scatter of a result to its inputs.
//!
//! Variance-based indices are valid for any model of independent inputs and cost `inputs + 2` evaluations for each row
//! of a [`SaltelliDesign`]. Correlation and regression use a plain random [`Sample`]; they are reliable for linear
//! models, or for monotonic ones after [`Sample::ranked`].

mod design;
#[cfg(test)]
mod design_tests;
mod estimator;
mod indices;
#[cfg(test)]
mod indices_tests;
mod regression;
mod sample;
#[cfg(test)]
mod sample_tests;
#[cfg(test)]
mod tests;

pub use design::{DesignWalk, SaltelliDesign};
pub use estimator::Estimator;
pub use indices::{Bootstrap, Estimate, SobolIndices, sobol_indices};
pub use regression::Regression;
pub use sample::Sample;
