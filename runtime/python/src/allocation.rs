//! Allocation of the cheapest tolerances that meet the requirements.

use eigentol::allocation::{self, Cost, HalfWidth, Nominal};
use eigentol::{Description, Unit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Array1, vector};
use crate::requirements::{Chances, Reliability, Requirement};
use crate::results::{attributes, result};
use crate::study::Study;
use crate::values::{List, number};
use crate::{hints, names};

/// Half-widths and what they cost, by name.
///
/// In Python `Mapping[str, tuple[Value, Value, tuple[float, float, float]]]`.
type Choices<'py> = Bound<'py, PyDict>;

/// Minimum and maximum half-width, and its cost: fixed, factor, power.
type Chosen<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, (f64, f64, f64));

#[pymethods]
impl Study {
    /// The cheapest tolerances that meet requirements, as `chances` takes them; samples check what is found.
    ///
    ///     study.allocate(
    ///         [(("frequency", 0), 3.9, None)],
    ///         failure=[1e-3],
    ///         tolerances={"l": ("0.1 mm", "5 mm", (0.0, 1e-3, 1.0))},
    ///     )
    ///
    /// Arguments:
    ///   failure: greatest probability of failing each requirement.
    ///   tolerances: by name of a design variable, or of an input that has a tolerance: least and greatest half-width T, and what
    ///       it costs, (fixed, factor, power): fixed + factor / T^power, T in SI.
    ///   nominals: by name of a design variable that may move: least and greatest nominal value.
    #[pyo3(signature = (requirements, *, failure, tolerances, nominals=None))]
    fn allocate(
        &self,
        py: Python<'_>,
        requirements: Vec<Requirement<'_>>,
        failure: Vec<f64>,
        tolerances: &Choices<'_>,
        nominals: Option<&hints::Ranges<'_>>,
    ) -> PyResult<Allocation> {
        let wanted = self.requirements(&requirements)?;
        let of = self.inner.description();
        let mut half_widths = Vec::new();
        for (name, chosen) in tolerances {
            let name = name.extract::<String>()?;
            let (variable, unit) = self.toleranced(py, of, &name)?;
            let (least, most, cost) = chosen.extract::<Chosen<'_>>()?;
            let limits = (number(&least, &unit, &name)?, number(&most, &unit, &name)?);
            half_widths.push((variable, limits, cost));
        }
        let mut moving = Vec::new();
        for (name, limits) in nominals.into_iter().flatten() {
            let name = name.extract::<String>()?;
            let (variable, unit) = List::Design.find(py, of, &name)?;
            let (least, most) = limits.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
            let limits = (number(&least, &unit, &name)?, number(&most, &unit, &name)?);
            moving.push(Nominal { variable, limits });
        }
        let answer = self.ask_stoppably(py, move |study| {
            let half_width = |(variable, limits, (fixed, factor, power))| HalfWidth {
                variable,
                limits,
                cost: Cost::reciprocal(fixed, factor, power),
            };
            let choices = allocation::Choices {
                half_widths: half_widths.into_iter().map(half_width).collect(),
                nominals: moving,
                failure,
            };
            study.allocation(&wanted, &choices)
        });
        answer.map(Allocation)
    }
}

impl Study {
    /// Index and unit among the design variables, followed by the input tolerances.
    fn toleranced(&self, py: Python<'_>, of: &Description, name: &str) -> PyResult<(usize, Unit)> {
        let inputs = self.inner.deviating_inputs();
        let input = inputs.iter().position(|input| of.inputs[input.index()].name == *name);
        match input {
            Some(k) => Ok((of.design.len() + k, of.inputs[inputs[k].index()].unit.clone())),
            None => List::Design.find(py, of, name),
        }
    }
}

result! {
    /// The cheapest tolerances that were found. `k` is the number of requirements.
    Allocation(allocation::Allocation)
}

attributes! {
    Allocation(self, py) {
        /// Names of the design variables, and after them of the inputs that have a tolerance.
        names: Vec<&str> = names::design(&self.0.description);
        /// Nominal values, SI, shape (variables,).
        nominal: Array1<'py> = vector(py, self.0.nominal.iter().copied());
        /// Half-widths, SI, shape (variables,).
        half_widths: Array1<'py> = vector(py, self.0.half_widths.iter().copied());
        /// Sum of the costs.
        cost: f64 = self.0.cost;
        /// The same for the tolerances at the start.
        cost_before: f64 = self.0.cost_before;
        /// Share of the samples that fail each requirement, shape (k,).
        sampled_failure: Array1<'py> =
            vector(py, self.0.chances.each.iter().map(|chance| chance.failure()));
        /// Positions of the requirements that the samples refute: first order failed there, allow less.
        refuted: Vec<usize> = self.0.refuted.clone();
        /// Greatest probability of failing each requirement that was allowed, shape (k,).
        failure: Array1<'py> = vector(py, self.0.failure.iter().copied());
        /// Reliability of what was found, by design points.
        reliability: Reliability = Reliability(self.0.reliability.clone());
        /// Chances of what was found, by samples.
        chances: Chances = Chances(self.0.chances.clone());
        /// Number of choices that were tried.
        evaluations: usize = self.0.evaluations;
        /// Whether the search was stopped, so that there may be cheaper ones.
        stopped: bool = self.0.stopped;
    }
}
