//! Limits as functions of independent standard normal numbers.

use core::cell::RefCell;

use eigentol_statistics::reliability::{LimitState, LimitValue};

use super::kinds::{Requirement, beyond};
use crate::deviations::Deviations;
use crate::response::{Realisation, Responses, Workspace};
use crate::tolerance::Outcome;

/// A limit as a function of deviations from a nominal design.
pub(crate) struct LimitAt<'a> {
    responses: &'a Responses<'a>,
    place: usize,
    limit: Requirement,
    deviations: &'a Deviations<'a>,
    room: RefCell<Workspace>,
}

impl<'a> LimitAt<'a> {
    /// Creates one of [`Requirement::limits`], for the response at position `index`.
    pub(crate) fn new(
        responses: &'a Responses<'a>,
        index: usize,
        limit: Requirement,
        deviations: &'a Deviations<'a>,
    ) -> Self {
        Self { room: RefCell::new(responses.workspace()), responses, place: index, limit, deviations }
    }

    /// Distance from failure and its derivatives with respect to the design variables.
    pub(crate) fn by_design(&self, z: &[f64]) -> Result<(f64, Vec<f64>), String> {
        let realisation = self.at(z, true)?;
        let value = self.value_of(&realisation)?;
        let gradient = realisation.gradients.get(self.place).cloned().flatten();
        let gradient = gradient.ok_or("the response has no derivatives there")?;
        let design = self.deviations.design(z);
        let (low, high) = self.band(&design);
        let below = low - value > value - high;
        let slope = |(k, slope): (usize, &f64)| {
            let (by_low, by_high) = self.band_slopes(&design, k);
            if below { by_low - slope } else { slope - by_high }
        };
        let slopes = gradient.iter().enumerate().map(slope).collect();
        Ok((beyond((low, high), value), slopes))
    }

    /// What is required below and above a band with two ends.
    pub(super) fn sides(&self) -> Vec<Requirement> {
        let (low, high) = self.band(&self.responses.nominal().design);
        match self.limit.response() {
            Some(response) if low.is_finite() && high.is_finite() => {
                vec![Requirement::at_least(response, low), Requirement::at_most(response, high)]
            }
            _ => Vec::new(),
        }
    }

    fn band(&self, design: &[f64]) -> (f64, f64) {
        let inputs = &self.responses.nominal().inputs;
        self.limit.band(self.responses.mechanism(), inputs, design)
    }

    /// Derivatives of the ends of the band with respect to a design variable.
    fn band_slopes(&self, design: &[f64], variable: usize) -> (f64, f64) {
        let mechanism = self.responses.mechanism();
        match mechanism.input_of_deviation(variable) {
            Some(input) => {
                let inputs = &self.responses.nominal().inputs;
                self.limit.band_slopes(mechanism, inputs, design, input)
            }
            None => (0.0, 0.0),
        }
    }

    fn at(&self, z: &[f64], slopes: bool) -> Result<Realisation, String> {
        let design = self.deviations.design(z);
        let mut room = self.room.borrow_mut();
        let realisation = if slopes {
            self.responses.with_gradients(&mut room, &design)
        } else {
            self.responses.at(&mut room, &design)
        };
        realisation.map_err(|error| error.to_string())
    }

    fn value_of(&self, realisation: &Realisation) -> Result<f64, String> {
        realisation.values.get(self.place).copied().flatten().ok_or_else(|| missing(realisation.outcome).to_owned())
    }
}

/// Why a response has no value at a design with this outcome.
fn missing(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Stable => {
            "its equilibrium is stable, but the mode does not oscillate, nothing shakes, or nothing happens in the range"
        }
        Outcome::Divergent | Outcome::Flutter => "its equilibrium is unstable",
        Outcome::Undecided => "the stability of its equilibrium is not decided",
        Outcome::NoEquilibrium => "it has no equilibrium",
        Outcome::NotAssembled => "its loops do not close",
        Outcome::Unphysical => "it has bodies that cannot exist, or lies beyond the end of a curve",
        Outcome::NoModes => "its modes were not found",
    }
}

impl LimitState for LimitAt<'_> {
    type Error = String;

    fn dimension(&self) -> usize {
        self.deviations.dimension()
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, String> {
        let (value, by_design) = self.by_design(z)?;
        let gradient = self.deviations.gradient(z, &by_design);
        Ok(LimitValue { value, gradient })
    }

    fn value(&self, z: &[f64]) -> Result<f64, String> {
        let value = self.value_of(&self.at(z, false)?)?;
        Ok(beyond(self.band(&self.deviations.design(z)), value))
    }
}
