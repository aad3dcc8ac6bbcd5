//! Forbidden bands.

use eigentol::Vector;
use eigentol::second_order::MarginDerivatives;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::shared::judgement;
use crate::arrays::{Array1, vector};
use crate::results::{attributes, result};

result! {
    /// Probability that a quantity of a mode lies in a forbidden band.
    ModeMargin(eigentol::second_order::ModeMargin)
}

impl ModeMargin {
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&MarginDerivatives) -> &Vector,
    ) -> Array1<'py> {
        let own = self.0.margin.derivatives.as_ref().map(|own| &of(own)[..]);
        slopes(py, self.0.description.design.len(), own)
    }
}

attributes! {
    ModeMargin(self, py) {
        /// Probability by the exact distribution of the second-order model.
        probability: f64 = self.0.margin.corrected.value;
        /// Error of that: of the integration, and of the model where designs were solved anew.
        error: f64 = self.0.margin.corrected.error;
        /// Probability to first order.
        first_order: f64 = self.0.margin.first_order;
        /// Probability by designs solved anew, which judges the other two; None where that is too dear.
        solved_anew: Option<f64> = self.0.judgement.judged().map(|own| own.probability.value);
        /// 95 % interval of that.
        interval: Option<(f64, f64)> =
            self.0.judgement.judged().map(|own| own.interval()).map(|own| (own.lower, own.upper));
        /// Whether designs solved anew confirm the probability of the second-order model.
        verified: bool = self.0.verified();
        /// Positions of the other modes that tolerances mix with this one. If there are any, neither model can be relied on.
        mixed_with: Vec<usize> = self.0.mixed_with.clone();
        /// The band, in the unit of the quantity (rad/s, 1/s).
        band: (f64, f64) = self.0.margin.band;
        /// Standard deviations between the value and the nearest end of the band.
        distance: f64 = self.0.margin.distance;
        /// Position of the mode, from 0.
        mode: usize = self.0.mode;
        /// Name of the quantity, as `margin` takes it.
        quantity: String = self.0.quantity.to_string().replace(' ', "_");
        /// Its nominal value, rad/s or 1/s.
        value: f64 = self.0.margin.value;
        /// Its standard deviation to first order.
        sigma: f64 = self.0.margin.sigma;
        /// Error of the model alone; None where no designs were solved anew.
        model_error: Option<f64> = self.0.margin.corrected.model_error;
        /// What the designs solved anew say, by name; under "open" why there are none.
        judgement: PyResult<Bound<'py, PyDict>> = judgement(py, &self.0.judgement);
        /// Derivatives of the probability to first order by inputs, shape (inputs,); NaN where there are none.
        by_input: Array1<'py> =
            slopes(py, self.0.description.inputs.len(), self.0.by_input.as_deref());
        /// The same by nominal values of design variables, shape (design,).
        by_design: Array1<'py> = self.slopes(py, |own| &own.by_design);
        /// The same by half-widths of their tolerances, shape (design,).
        by_half_width: Array1<'py> = self.slopes(py, |own| &own.by_half_width);
    }
}

/// Derivatives, or as many NaN.
fn slopes<'py>(py: Python<'py>, count: usize, own: Option<&[f64]>) -> Array1<'py> {
    vector(
        py,
        own.map_or_else(|| vec![f64::NAN; count], <[f64]>::to_vec),
    )
}
