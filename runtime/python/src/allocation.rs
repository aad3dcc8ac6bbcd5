//! Allocation of the cheapest tolerances that meet the requirements.

use eigentol::allocation::{self, Cost, HalfWidth, Nominal};
use eigentol::{Description, Unit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::hints;
use crate::results::Answer;
use crate::study::Study;
use crate::values::{List, number};

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
    ///         ["frequency 1 >= 3.9 rad/s"],
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
        requirements: Vec<hints::RequirementText<'_>>,
        failure: Vec<f64>,
        tolerances: &Choices<'_>,
        nominals: Option<&hints::Ranges<'_>>,
    ) -> PyResult<Answer> {
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
        answer.map(Answer::new)
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
