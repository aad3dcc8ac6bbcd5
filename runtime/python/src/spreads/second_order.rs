//! The spread of modes to second order.

use eigentol::Quantity;
use eigentol::second_order::{ModeSecondOrder, SecondOrderSpread};
use pyo3::prelude::*;

use super::shared::texts;
use crate::arrays::{Array1, optional};
use crate::errors::invalid;
use crate::hints;
use crate::results::{attributes, quantity, result};

result! {
    /// Spread of all modes to second order. `m` is the number of modes; quantities are "frequency" (rad/s),
    /// "natural_frequency" (rad/s) and "damping_ratio". NaN stands where a mode has none.
    SecondOrder(eigentol::second_order::SecondOrder)
}

impl SecondOrder {
    fn each<'py>(&self, py: Python<'py>, name: &str, of: impl Fn(&SecondOrderSpread) -> f64) -> PyResult<Array1<'py>> {
        let spread: fn(&ModeSecondOrder) -> &SecondOrderSpread = match quantity(py, name)? {
            Quantity::Frequency => |x| &x.frequency,
            Quantity::NaturalFrequency => |x| &x.natural_frequency,
            Quantity::DampingRatio => |x| &x.damping_ratio,
            _ => return Err(invalid(py, format!("there is no second order of `{name}`"))),
        };
        let all = self.0.modes.iter();
        Ok(optional(py, all.map(|mode| mode.as_ref().ok().map(|mode| of(spread(mode))))))
    }
}

attributes! {
    SecondOrder(self, py) {
        /// For each mode the doubts that distances raise, as those of first order.
        doubts: Vec<Vec<String>> = self.0.doubts.iter().map(|doubts| texts(doubts)).collect();
        /// Why a mode has no second order: a text for each mode, or None.
        failures: Vec<Option<String>> =
            self.0.modes.iter().map(|mode| mode.as_ref().err().map(ToString::to_string)).collect();
    }
}

attributes! {
    SecondOrder(self, py, quantity: hints::Quantity = "frequency") {
        /// Means, shape (m,).
        mean: Array1<'py> = self.each(py, quantity, |x| x.moments.mean);
        /// Standard deviations, shape (m,).
        sigma: Array1<'py> = self.each(py, quantity, |x| x.moments.sigma);
        /// Skewness, shape (m,).
        skewness: Array1<'py> = self.each(py, quantity, |x| x.moments.skewness);
        /// Excess kurtosis, shape (m,).
        excess_kurtosis: Array1<'py> = self.each(py, quantity, |x| x.moments.excess_kurtosis);
        /// Shifts of the means by curvature, shape (m,).
        mean_shift: Array1<'py> = self.each(py, quantity, |x| x.moments.mean_shift);
        /// Standard deviations to first order, shape (m,).
        first_order_sigma: Array1<'py> =
            self.each(py, quantity, |spread| spread.moments.first_order_sigma);
        /// Part of the standard deviations that curvature adds (its square is added to that of first order), shape (m,).
        curvature_sigma: Array1<'py> = self.each(py, quantity, |x| x.moments.curvature_sigma);
        /// Relative errors of the standard deviations to first order by this model, shape (m,).
        first_order_error: Array1<'py> =
            self.each(py, quantity, |x| x.nonlinearity.sigma_error());
    }
}
