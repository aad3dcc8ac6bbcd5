//! The analyses of a study.

use eigentol::response::Vibration;
use eigentol::sweep::{Line, Range};
use eigentol::{Coordinate, DesignVariable, Input};
use eigentol_interpreter::{Interpreted, range, vibration};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::arrays::{Array1, optional};
use crate::errors::invalid;
use crate::hints;
use crate::results::{Answer, Equilibrium, ForcedResponse, Modes, MonteCarlo, Sensitivities, Sweep};
use crate::study::Study;
use crate::values::{List, all_finite, meaningless, mode_number, number, numbers, text};

/// Steps between the values of a range that a text gives.
const STEPS: usize = 50;

/// Analyses without arguments.
macro_rules! questions {
    ($($(#[$doc:meta])* $question:ident -> $result:ident = $wrap:expr;)*) => {
        #[pymethods]
        impl Study {
            $(
                $(#[$doc])*
                fn $question(&self, py: Python<'_>) -> PyResult<$result> {
                    self.ask(py, |study| study.$question()).map($wrap)
                }
            )*
        }
    };
}

questions! {
    /// The state that closes the loops from the start values, before any equilibrium is looked for: which of the
    /// assemblies it is, and how far from a dead centre. Coordinates with a start value are held.
    assembly -> Answer = Answer::new;
    /// Where the mechanism stays: equilibrium, Mhat, Chat, Khat, stability.
    equilibrium -> Equilibrium = Equilibrium;
    /// How the equilibrium moves with inputs and design variables.
    equilibrium_shift -> Answer = Answer::new;
    /// How it vibrates about the equilibrium.
    modes -> Modes = Modes;
    /// Total derivatives of all modes.
    sensitivities -> Sensitivities = Sensitivities;
    /// The outputs and their total derivatives.
    outputs -> Answer = Answer::new;
    /// The steady vibration under the declared excitations. Raises NoVibration where nothing excites one, and where a mode
    /// without damping resonates.
    forced_response -> ForcedResponse = ForcedResponse;
    /// The steady vibration and its total derivatives: equilibrium and frequencies follow the variables.
    forced_sensitivities -> Answer = Answer::new;
    /// What each excitation contributes, and its total derivatives: a harmonic for every excitation alone, in the order of
    /// `mechanism.excitations`.
    share_sensitivities -> Answer = Answer::new;
    /// The steady vibration with total first and second derivatives.
    forced_curvature -> Answer = Answer::new;
    /// First-order spread of the outputs.
    output_tolerances -> Answer = Answer::new;
    /// First-order spread of all modes.
    first_order -> Answer = Answer::new;
    /// Spread of all modes to second order.
    second_order -> Answer = Answer::new;
    /// First order, second order, and for each mode whether its standard deviation can be trusted. The samples that
    /// judge are always the same, whatever `samples` and `seed` of the study.
    summary -> Answer = Answer::new;
}

/// Analyses of responses, given as the texts that `Study.response` takes.
macro_rules! of_responses {
    ($($(#[$doc:meta])* $question:ident;)*) => {
        #[pymethods]
        impl Study {
            $(
                $(#[$doc])*
                fn $question(
                    &self,
                    py: Python<'_>,
                    responses: Vec<hints::ResponseText<'_>>,
                ) -> PyResult<Answer> {
                    let wanted: Vec<_> = responses.iter().map(|given| self.wanted(given)).collect::<PyResult<_>>()?;
                    self.ask_stoppably(py, |study| study.$question(&wanted)).map(Answer::new)
                }
            )*
        }
    };
}

of_responses! {
    /// How tolerances spread responses, by the method that suits them: texts such as "frequency 1", "angle", "vibration shake
    /// under u", "critical speed=0..6000rpm" or "resonance 1 speed=0..6000rpm", as `response` takes them.
    propagate;
    /// Which variables the scatter of responses comes from; texts as `propagate` takes them.
    influence;
    /// The least and the greatest values of responses within the limits; texts as `propagate` takes them.
    worst_case;
}

/// Analyses between two values of an input.
macro_rules! between {
    ($($(#[$doc:meta])* $name:ident: $question:ident;)*) => {
        #[pymethods]
        impl Study {
            $(
                $(#[$doc])*
                fn $name(
                    &self,
                    py: Python<'_>,
                    input: &str,
                    low: &hints::Value<'_>,
                    high: &hints::Value<'_>,
                ) -> PyResult<Answer> {
                    let (input, low, high) = self.range(py, input, low, high)?;
                    self.ask_stoppably(py, |study| study.$question(input, low, high)).map(Answer::new)
                }
            )*
        }
    };
}

between! {
    /// Branches of equilibria along an input between two values, SI or texts with units.
    branches: branches;
    /// The first value of an input between two, SI or texts with units, at which the stable equilibrium loses its
    /// stiffness, and how tolerances move it. Raises NotInRange where there is none. A tolerance of this input counts
    /// with a derivative of -1, as the value that is set lies below the one that acts by the deviation; one in per cent
    /// is that at the operating point.
    critical: critical_tolerance;
    /// First and second derivatives of that value by the design variables.
    critical_curvature: critical_curvature;
    /// Values of an input between two, SI or texts with units, at which an oscillation begins or ceases to grow, and
    /// how tolerances move them.
    flutter_onsets: flutter_onset_tolerances;
}

impl Study {
    /// An input and the two ends of its range, SI.
    fn range(
        &self,
        py: Python<'_>,
        input: &str,
        low: &hints::Value<'_>,
        high: &hints::Value<'_>,
    ) -> PyResult<(Input<Interpreted>, f64, f64)> {
        let (index, unit) = List::Inputs.find(py, self.inner.description(), input)?;
        let (low, high) = (number(low, &unit, input)?, number(high, &unit, input)?);
        Ok((Input::new(index), low, high))
    }

    /// An input and its values, SI.
    pub(crate) fn values(
        &self,
        py: Python<'_>,
        input: &str,
        values: &hints::ArrayLike<'_>,
        unit: Option<&str>,
    ) -> PyResult<(Input<Interpreted>, Vec<f64>)> {
        let (index, declared) = List::Inputs.find(py, self.inner.description(), input)?;
        let scale = match unit {
            None => 1.0,
            Some(unit) => {
                let one = PyString::new(py, &format!("1 {unit}"));
                number(one.as_any(), &declared, input)?
            }
        };
        let converted = match numbers(values, input) {
            Ok(values) => values.into_iter().map(|value| value * scale).collect(),
            Err(_) if values.is_instance_of::<PyString>() => {
                let text = values.cast::<PyString>()?.to_cow()?;
                if !text.contains("..") {
                    let message = format!("`{input}`: a list of values or a range is expected, not {values}");
                    return Err(invalid(py, message));
                }
                let range = range(&self.inner, &format!("{input}={text}")).map_err(|error| meaningless(py, error))?;
                let step = (range.high - range.low) / (STEPS as f64);
                (0..=STEPS).map(|k| if k == STEPS { range.high } else { range.low + k as f64 * step }).collect()
            }
            Err(error) => values
                .try_iter()
                .map_err(|_| error)?
                .map(|value| number(&value?, &declared, input))
                .collect::<PyResult<_>>()?,
        };
        let values: Vec<f64> = converted;
        all_finite(py, input, &values)?;
        Ok((Input::new(index), values))
    }
}

impl Study {
    fn vibrations(&self, given: &[hints::ResponseText<'_>]) -> PyResult<Vec<Vibration>> {
        let one = |given: &hints::ResponseText<'_>| {
            vibration(&self.inner, &text(given, "vibration shake")?).map_err(|error| meaningless(given.py(), error))
        };
        given.iter().map(one).collect()
    }
}

#[pymethods]
impl Study {
    /// How tolerances spread amplitudes of vibration, right at a resonance too: texts such as "vibration shake
    /// under u as velocity".
    fn vibration_spread(&self, py: Python<'_>, vibrations: Vec<hints::ResponseText<'_>>) -> PyResult<Answer> {
        let wanted = self.vibrations(&vibrations)?;
        self.ask_stoppably(py, |study| study.vibration_spread(&wanted)).map(Answer::new)
    }

    /// How far frequencies and damping ratios, of the first `modes` modes that oscillate or of all, and outputs change with
    /// one and with two more coordinates of each component of the beams. `along`, a range of an input such as
    /// "speed=0..6000rpm", adds the first critical value between them, onsets of flutter, where frequencies meet `orders`, and the
    /// highest peaks. Raises InvalidValue where there is no beam.
    #[pyo3(signature = (modes=None, along=None, orders=Vec::new()))]
    fn converge(
        &self,
        py: Python<'_>,
        modes: Option<usize>,
        along: Option<&str>,
        orders: Vec<f64>,
    ) -> PyResult<Answer> {
        let mechanism = self.mechanism(py);
        let text = mechanism.get().text();
        let refined =
            |more| py.detach(|| Interpreted::refined(text, more)).map_err(|error| invalid(py, error.to_string()));
        let refined = [refined(1)?, refined(2)?];
        let answer = match along {
            None => self.ask(py, |study| study.convergence(refined))?,
            Some(along) => {
                let range = range(&self.inner, along).map_err(|error| meaningless(py, error))?;
                let range = Range::new(Input::new(range.input.index()), range.low, range.high);
                let lines: Vec<Line> = orders.into_iter().map(Line::from).collect();
                self.ask_stoppably(py, |study| study.convergence_along(refined, range, &lines))?
            }
        };
        Ok(Answer::new(answer.of_first(modes.unwrap_or(usize::MAX))))
    }

    /// Forced vibration at each value of an input: amplitudes and phases with their total derivatives. Values are SI,
    /// texts with units, or numbers in `unit`. A value without a vibration is NaN in arrays; `failures` says why.
    #[pyo3(signature = (input, values, unit=None))]
    fn bode(&self, py: Python<'_>, input: &str, values: &hints::ArrayLike<'_>, unit: Option<&str>) -> PyResult<Answer> {
        let (input, values) = self.values(py, input, values, unit)?;
        self.ask_stoppably(py, |study| study.bode(input, &values)).map(Answer::new)
    }

    /// The same with bands of these vibrations under tolerances, given as `vibration_spread` takes them. `checked`
    /// designs are solved anew at each value to say how good the bands are; 0 for none.
    #[pyo3(signature = (input, values, vibrations, checked=64, unit=None))]
    fn bode_bands(
        &self,
        py: Python<'_>,
        input: &str,
        values: &hints::ArrayLike<'_>,
        vibrations: Vec<hints::ResponseText<'_>>,
        checked: usize,
        unit: Option<&str>,
    ) -> PyResult<Answer> {
        let (input, values) = self.values(py, input, values, unit)?;
        let wanted = self.vibrations(&vibrations)?;
        self.ask_stoppably(py, |study| study.bode_bands(input, &values, &wanted, checked)).map(Answer::new)
    }

    /// The peaks of a vibration, a text such as "vibration shake", between two values of an input: places, heights,
    /// half-power points and amplification factors, with their derivatives and spreads. With `operating`, the lowest and
    /// the highest value of the input in operation, SI or texts with units, how far the peaks keep away from these, and
    /// what their amplification factors ask for (API 617).
    #[pyo3(signature = (vibration, input, low, high, operating=None))]
    fn peaks(
        &self,
        py: Python<'_>,
        vibration: hints::ResponseText<'_>,
        input: &str,
        low: &hints::Value<'_>,
        high: &hints::Value<'_>,
        operating: Option<(hints::Value<'_>, hints::Value<'_>)>,
    ) -> PyResult<Answer> {
        let operating = match operating {
            None => None,
            Some((lowest, highest)) => Some(self.range(py, input, &lowest, &highest)?),
        };
        let (input, low, high) = self.range(py, input, low, high)?;
        let wanted = self.vibrations(&[vibration])?;
        let found = self.ask_stoppably(py, |study| study.peaks(wanted[0], input, low, high))?;
        match operating {
            None => Ok(Answer::new(found)),
            Some((_, lowest, highest)) if lowest > highest => {
                Err(invalid(py, "the range of operation starts above its end".to_owned()))
            }
            Some((_, lowest, highest)) => Ok(Answer::new(found.separation([lowest, highest]))),
        }
    }

    /// How much higher the worst blade of a ring vibrates than equal blades would under a force of an engine order, along a
    /// coordinate of the blades such as "flap", and the distribution within the tolerances. The first ring and the first
    /// coordinate are the defaults.
    #[pyo3(signature = (order, ring=None, coordinate=None, samples=1000, seed=0))]
    fn mistuning(
        &self,
        py: Python<'_>,
        order: usize,
        ring: Option<&str>,
        coordinate: Option<&str>,
        samples: usize,
        seed: u64,
    ) -> PyResult<Answer> {
        use eigentol::mistuning::EngineOrder;
        let asked = self.ask(py, |study| EngineOrder::of(study.description(), ring, coordinate, order))?;
        let asked = EngineOrder { samples, seed, ..asked };
        self.ask_stoppably(py, |study| study.mistuning(asked)).map(Answer::new)
    }

    /// Samples of the design, each with its own equilibrium and modes, on all processors. Ctrl-C ends it; to keep what
    /// is done, take the samples in parts (`samples_between`).
    fn monte_carlo(&self, py: Python<'_>) -> PyResult<MonteCarlo> {
        self.ask_stoppably(py, |study| study.monte_carlo()).map(MonteCarlo)
    }

    /// Equilibria found from random starts: between bounds for the coordinates that have some,
    /// `{"x": ("-10 mm", "10 mm")}`, and anywhere for other angles. A displacement needs bounds.
    #[pyo3(signature = (bounds=None, starts=None, seed=None))]
    fn equilibria(
        &self,
        py: Python<'_>,
        bounds: Option<&hints::Ranges<'_>>,
        starts: Option<usize>,
        seed: Option<u64>,
    ) -> PyResult<Vec<Equilibrium>> {
        let of = self.inner.description();
        let mut within = Vec::new();
        for (name, ends) in bounds.into_iter().flatten() {
            let name = name.extract::<String>()?;
            let (index, unit) = List::Coordinates.find(py, of, &name)?;
            let (low, high) = ends.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
            let end = |end: &Bound<'_, PyAny>| number(end, &unit, &name);
            within.push((Coordinate::new(index), end(&low)?, end(&high)?));
        }
        let mut search = self.ask(py, |study| study.search(&within))?;
        search.starts = starts.unwrap_or(search.starts);
        search.seed = seed.unwrap_or(search.seed);
        Ok(self.ask(py, |study| study.equilibria(&search))?.into_iter().map(Equilibrium).collect())
    }

    /// Whirl of each mode, shape (m,): minor over major axis of the orbit, positive along the rotation; NaN where it
    /// does not apply.
    fn whirls<'py>(&self, py: Python<'py>) -> PyResult<Array1<'py>> {
        let answer = self.ask(py, |study| study.whirls())?;
        Ok(optional(py, answer.into_iter().map(|whirl| whirl.and_then(|whirl| whirl.ratio))))
    }

    /// Kind of each mode, "lateral", "torsional", "axial", "mixed", or "blades"; None where neither shafts nor blades of a
    /// ring move.
    fn kinds(&self, py: Python<'_>) -> PyResult<Vec<Option<String>>> {
        let answer = self.ask(py, |study| study.whirls())?;
        Ok(answer.into_iter().map(|whirl: Option<eigentol::modes::Whirl>| Some(whirl?.kind.to_string())).collect())
    }

    /// What the blades of a ring do in each mode: "collective", "differential", "regressive", "2 diameters"; None where
    /// there is no ring or its blades do not move.
    fn patterns(&self, py: Python<'_>) -> PyResult<Vec<Option<String>>> {
        let answer = self.ask(py, |study| study.whirls())?;
        Ok(answer.into_iter().map(|whirl: Option<eigentol::modes::Whirl>| Some(whirl?.blades?.to_string())).collect())
    }

    /// First and second derivatives of one mode, counted from 0.
    fn mode_curvature(&self, py: Python<'_>, mode: i64) -> PyResult<Answer> {
        let mode = mode_number(py, mode)?;
        self.ask(py, |study| study.mode_curvature(mode)).map(Answer::new)
    }

    /// First and second derivatives of an output.
    fn output_curvature(&self, py: Python<'_>, output: &str) -> PyResult<Answer> {
        self.ask(py, |study| study.output_curvature(study.find_output(output)?)).map(Answer::new)
    }

    /// Derivatives of the shapes of one mode, counted from 0.
    fn shape_sensitivity(&self, py: Python<'_>, mode: i64) -> PyResult<Answer> {
        let mode = mode_number(py, mode)?;
        self.ask(py, |study| study.shape_sensitivity(mode)).map(Answer::new)
    }

    /// Equilibria and modes along an input. Values are SI, texts with units, or numbers in `unit`.
    #[pyo3(signature = (input, values, unit=None))]
    fn sweep(&self, py: Python<'_>, input: &str, values: &hints::ArrayLike<'_>, unit: Option<&str>) -> PyResult<Sweep> {
        let (input, values) = self.values(py, input, values, unit)?;
        self.ask_stoppably(py, |study| study.sweep(input, &values)).map(Sweep)
    }

    /// A Campbell diagram: modes along an input with spreads, and where they meet `orders`, multiples of the input.
    /// Values are SI, texts with units, or numbers in `unit`.
    #[pyo3(signature = (input, values, orders=vec![1.0], unit=None))]
    fn campbell(
        &self,
        py: Python<'_>,
        input: &str,
        values: &hints::ArrayLike<'_>,
        orders: Vec<f64>,
        unit: Option<&str>,
    ) -> PyResult<Answer> {
        let (input, values) = self.values(py, input, values, unit)?;
        all_finite(py, "orders", &orders)?;
        self.ask_stoppably(py, |study| study.campbell(input, &values, &orders)).map(Answer::new)
    }

    /// Events along an input between two values, SI or texts with units, at each of the values of a design variable: a critical
    /// speed map over the stiffness of bearings, limits of stability over what cross-couples.
    #[pyo3(signature = (input, low, high, over, values, orders=vec![1.0]))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn event_map(
        &self,
        py: Python<'_>,
        input: &str,
        low: &hints::Value<'_>,
        high: &hints::Value<'_>,
        over: &str,
        values: Vec<hints::Value<'_>>,
        orders: Vec<f64>,
    ) -> PyResult<Answer> {
        let (input, low, high) = self.range(py, input, low, high)?;
        let (index, unit) = List::Design.find(py, self.inner.description(), over)?;
        let values: Vec<f64> = values.iter().map(|value| number(value, &unit, over)).collect::<PyResult<_>>()?;
        all_finite(py, "orders", &orders)?;
        let over = DesignVariable::new(index);
        self.ask_stoppably(py, |study| study.event_map(input, low, high, &orders, over, &values)).map(Answer::new)
    }

    /// Values of an input between two, SI or texts with units, at which a frequency equals `order` times the input and
    /// `offset` (rad/s) more, and how tolerances move them.
    #[pyo3(signature = (input, low, high, order=1.0, offset=0.0))]
    fn crossings(
        &self,
        py: Python<'_>,
        input: &str,
        low: &hints::Value<'_>,
        high: &hints::Value<'_>,
        order: f64,
        offset: f64,
    ) -> PyResult<Answer> {
        let (input, low, high) = self.range(py, input, low, high)?;
        let line = Line { ratio: order, offset };
        let answer = self.ask(py, |study| study.crossing_tolerances(input, low, high, line))?;
        Ok(Answer::new(answer))
    }
}
