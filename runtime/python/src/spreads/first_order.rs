//! The spread of modes and outputs to first order.

use eigentol::tolerance::{ModeTolerance, Spread};
use pyo3::prelude::*;

use super::shared::texts;
use crate::arrays::{Array1, Array2, optional, optional_rows, vector};
use crate::results::{attributes, quantity, result};
use crate::{hints, names};

result! {
    /// First-order spread of all modes. `m` is the number of modes; quantities are "frequency" (rad/s),
    /// "natural_frequency" (rad/s), "damping_ratio", "growth" (1/s) and "lambda" (1/s^2). NaN stands where a mode has
    /// none.
    FirstOrder(eigentol::FirstOrder)
}

impl FirstOrder {
    fn each<T>(&self, py: Python<'_>, name: &str, of: impl Fn(&Spread) -> T) -> PyResult<Vec<Option<T>>> {
        let wanted = match name {
            "lambda" => None,
            other => Some(quantity(py, other)?),
        };
        let one = |mode: &ModeTolerance| match wanted {
            None => Some(of(&mode.lambda)),
            Some(quantity) => mode.of(quantity).as_ref().map(&of),
        };
        Ok(self.0.modes.iter().map(one).collect())
    }
}

attributes! {
    FirstOrder(self, py) {
        /// Names of the design variables, and after them of the inputs that have a tolerance: the columns of gradients and
        /// shares.
        names: Vec<&str> = names::design(&self.0.description);
        /// Standard deviations between each mode and the state where its stiffness vanishes, shape (m,); may be infinite.
        distances_to_critical: Array1<'py> =
            vector(py, self.0.modes.iter().map(|mode| mode.distance_to_critical));
        /// For each mode the doubts that distances raise about its standard deviations: texts, none where they are large.
        /// They do not tell how large an error is; `summary` lets samples decide.
        doubts: Vec<Vec<String>> =
            (0..self.0.modes.len()).map(|mode| texts(&self.0.doubts(mode))).collect();
        /// Whether distances leave no doubt about any mode. Where they do, `summary` lets samples decide.
        trusted: bool = self.0.trusted();
        /// The same of each mode, shape (m,).
        trusted_modes: Array1<'py, bool> = {
            let all = 0..self.0.modes.len();
            vector(py, all.map(|mode| self.0.doubts(mode).is_empty()))
        };
        /// Least of `distances_to_critical`.
        distance_to_critical: f64 = self.0.distance_to_critical;
        /// Standard deviations between the growth of each mode and zero, shape (m,); may be infinite.
        distances_to_instability: Array1<'py> =
            vector(py, self.0.modes.iter().map(|mode| mode.distance_to_instability));
        /// Standard deviations between the eigenvalue of each mode and the nearest one, shape (m,); may be infinite.
        distances_to_neighbour: Array1<'py> =
            vector(py, self.0.modes.iter().map(|mode| mode.distance_to_neighbour));
        /// Whether each mode is one of a cluster of nearly equal eigenvalues, shape (m,).
        clustered: Array1<'py, bool> = vector(py, self.0.modes.iter().map(|mode| mode.clustered));
        /// What each mode does, in words.
        behaviours: Vec<String> =
            self.0.modes.iter().map(|mode| mode.behaviour.to_string()).collect();
    }
}

attributes! {
    FirstOrder(self, py, quantity: hints::QuantityOrLambda = "frequency") {
        /// Means, shape (m,).
        mean: Array1<'py> = Ok(optional(py, self.each(py, quantity, |x| x.mean)?));
        /// Standard deviations, shape (m,).
        sigma: Array1<'py> = Ok(optional(py, self.each(py, quantity, |x| x.sigma)?));
        /// Half-widths of the bands that hold as many standard deviations as the tolerances do, shape (m,).
        band: Array1<'py> = Ok(optional(py, self.each(py, quantity, |x| x.band)?));
        /// Derivatives per SI unit of each variable, shape (m, variables).
        gradient: Array2<'py> = {
            let all = self.each(py, quantity, |x| x.by_design.to_vec())?;
            optional_rows(py, self.0.description.design.len(), all)
        };
        /// Shares of the variables in the variance, shape (m, variables).
        shares: Array2<'py> = {
            let all = self.each(py, quantity, |x| x.variance_shares.to_vec())?;
            optional_rows(py, self.0.description.design.len(), all)
        };
    }
}

result! {
    /// First-order spread of the outputs, SI. `o` is the number of outputs; NaN stands where one has no derivatives.
    OutputTolerances(eigentol::tolerance::OutputTolerances)
}

impl OutputTolerances {
    fn each<T>(&self, of: impl Fn(&Spread) -> T) -> impl Iterator<Item = Option<T>> {
        self.0.spreads.iter().map(move |spread| spread.as_ref().map(&of))
    }
}

attributes! {
    OutputTolerances(self, py) {
        /// Values, SI, shape (o,).
        values: Array1<'py> = vector(py, self.0.values.clone());
        /// Names of the outputs.
        names: Vec<&str> = names::outputs(&self.0.description);
        /// Names of the design variables, and after them of the inputs that have a tolerance: the columns of gradients
        /// and shares.
        variables: Vec<&str> = names::design(&self.0.description);
        /// Means, SI, shape (o,).
        mean: Array1<'py> = optional(py, self.each(|x| x.mean));
        /// Standard deviations, SI, shape (o,).
        sigma: Array1<'py> = optional(py, self.each(|x| x.sigma));
        /// Half-widths of the bands that hold as many standard deviations as the tolerances do, SI, shape (o,).
        band: Array1<'py> = optional(py, self.each(|x| x.band));
        /// Derivatives per SI unit of each variable, shape (o, variables).
        gradient: PyResult<Array2<'py>> =
            optional_rows(py, self.variables(py).len(), self.each(|spread| spread.by_design.to_vec()));
        /// Shares of the variables in the variance, shape (o, variables).
        shares: PyResult<Array2<'py>> = {
            let all = self.each(|x| x.variance_shares.to_vec());
            optional_rows(py, self.variables(py).len(), all)
        };
    }
}
