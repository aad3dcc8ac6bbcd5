//! Forced vibration about an equilibrium, and its derivatives.

use eigentol::forced::{self, Harmonic, Measure, Orbit, RandomPhases, Share, Turning};
use eigentol::response::{Response, Vibration};
use eigentol::{Any, Complex, Error, Excitation, Output};
use pyo3::prelude::*;

use super::{Described, attributes, result};
use crate::arrays::{Array1, Array2, NONE, optional, rows, vector};
use crate::errors::raise;
use crate::response::measure;
use crate::values::number;
use crate::{hints, names};

result! {
    /// The steady vibration under the declared excitations, `Re(y e^{i w t})`. Amplitudes are complex, SI: the modulus is
    /// from 0 to peak, half of peak to peak; a positive phase leads, and NaN stands for an output that has a value but no
    /// derivative, like the length of a vector that is zero. `h` is the number of harmonics, `o` of outputs, `n` of
    /// unknowns, `e` of excitations.
    ForcedResponse(forced::ForcedResponse), crate::results::typed
}

/// The complex amplitudes of all outputs of a harmonic, NaN for one that has none.
fn amplitudes(of: &Harmonic, measure: Measure) -> impl Iterator<Item = Complex> + use<'_> {
    of.outputs.iter().map(move |y| y.map_or(NONE, |y| measure.of(of.frequency, y)))
}

fn or_none(outputs: &[Option<Complex>]) -> Vec<Complex> {
    outputs.iter().map(|y| y.unwrap_or(NONE)).collect()
}

impl ForcedResponse {
    /// What each excitation contributes, in the order of their declaration.
    fn contributions(&self) -> Vec<&Share> {
        let mut all: Vec<&Share> = (self.0.harmonics.iter()).flat_map(|harmonic| &harmonic.shares).collect();
        all.sort_by_key(|x| x.excitation);
        all
    }
}

attributes! {
    ForcedResponse(self, py) {
        /// Frequencies of the harmonics, rad/s, positive, shape (h,).
        frequencies: Array1<'py> = vector(py, self.0.harmonics.iter().map(|harmonic| harmonic.frequency));
        /// Names of the excitations that act together in each harmonic.
        harmonics: Vec<Vec<&str>> = {
            let all = names::excitations(&self.0.description);
            let of = |harmonic: &Harmonic| harmonic.shares.iter().map(|share| all[share.excitation]).collect();
            self.0.harmonics.iter().map(of).collect()
        };
        /// Amplitudes of the outputs, complex, SI, shape (h, o).
        outputs: PyResult<Array2<'py, Complex>> = {
            let all = self.0.harmonics.iter().map(|harmonic| or_none(&harmonic.outputs));
            rows(py, self.0.description.outputs.len(), all)
        };
        /// Amplitudes of the unknowns, complex, SI, shape (h, n): displacements of coordinates, speeds, reactions.
        unknowns: PyResult<Array2<'py, Complex>> = {
            let all = self.0.harmonics.iter().map(|harmonic| harmonic.unknowns.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// Names of the excitations: the rows of `shares`.
        excitations: Vec<&str> = names::excitations(&self.0.description);
        /// What each excitation contributes to the outputs, complex, SI, shape (e, o).
        shares: PyResult<Array2<'py, Complex>> = {
            let all = self.contributions().into_iter().map(|contribution| or_none(&contribution.outputs));
            rows(py, self.0.description.outputs.len(), all)
        };
        /// What each excitation contributes to the unknowns, complex, SI, shape (e, n).
        unknown_shares: PyResult<Array2<'py, Complex>> = {
            let all = self.contributions().into_iter().map(|contribution| contribution.unknowns.to_vec());
            rows(py, self.0.description.coordinates.len(), all)
        };
        /// Whether the declared frequency of each excitation is negative, shape (e,).
        reversed: Array1<'py, bool> =
            vector(py, self.contributions().into_iter().map(|contribution| contribution.reversed));
    }
}

attributes! {
    ForcedResponse(self, py, measure: hints::Measure = "displacement") {
        /// Amplitudes of the outputs, complex, shape (h, o): as "displacement" they are `outputs`, SI; as "velocity" per
        /// second, as "acceleration" per second squared.
        amplitudes: Array2<'py, Complex> = {
            let wanted = self::measure(py, measure)?;
            let all = self.0.harmonics.iter().map(|harmonic| amplitudes(harmonic, wanted).collect());
            rows(py, self.0.description.outputs.len(), all)
        };
    }
}

impl ForcedResponse {
    fn output(&self, py: Python<'_>, name: &str) -> PyResult<Output> {
        let of = &self.0.description;
        let index = of.outputs.iter().position(|output| output.name == *name);
        index.map(Output::new).ok_or_else(|| {
            let error = Error::UnknownName {
                kind: "output",
                name: name.to_owned(),
                mechanism: of.name.clone(),
                known: of.outputs.iter().map(|output| output.name.clone()).collect(),
            };
            raise(py, error)
        })
    }

    fn orbits(&self, py: Python<'_>, [x, y]: [&str; 2]) -> PyResult<Vec<Orbit>> {
        let (x, y) = (self.output(py, x)?, self.output(py, y)?);
        Ok(self.0.harmonics.iter().filter_map(|item| item.orbit(x, y)).collect())
    }

    /// A number of each output of each harmonic, if the phases of the excitations are unknown.
    fn of_unknown_phases<'py>(
        &self,
        py: Python<'py>,
        measure: &str,
        of: impl Fn(&RandomPhases) -> Result<f64, Error>,
    ) -> PyResult<Array2<'py>> {
        let measure = self::measure(py, measure)?;
        let outputs = self.0.description.outputs.len();
        let each = |harmonic: &Harmonic| {
            let number = |(k, y): (usize, &Option<Complex>)| match y {
                Some(_) => of(&harmonic.unknown_phases(Output::new(k), measure)?),
                None => Ok(f64::NAN),
            };
            harmonic.outputs.iter().enumerate().map(number).collect::<Result<Vec<f64>, _>>()
        };
        let all: Result<Vec<_>, _> = self.0.harmonics.iter().map(each).collect();
        rows(py, outputs, all.map_err(|error| raise(py, error))?)
    }
}

#[pymethods]
impl ForcedResponse {
    /// The orbit of two outputs, which should be perpendicular displacements: `x + i y = f e^{i w t} + conj(b) e^{-i w t}`.
    /// The forward parts `f`, which circle from `x` to `y`, and the backward parts `b`, complex, SI, shape (h,) each.
    fn orbit_parts<'py>(
        &self,
        py: Python<'py>,
        x: &str,
        y: &str,
    ) -> PyResult<(Array1<'py, Complex>, Array1<'py, Complex>)> {
        let all = self.orbits(py, [x, y])?;
        let part = |of: fn(&Orbit) -> Complex| vector(py, all.iter().map(of));
        Ok((part(|x| x.forward), part(|x| x.backward)))
    }

    /// Half of the longest and half of the shortest diameters of the orbits of two outputs, SI, shape (h,) each.
    fn orbit_semi_axes<'py>(&self, py: Python<'py>, x: &str, y: &str) -> PyResult<(Array1<'py>, Array1<'py>)> {
        let all = self.orbits(py, [x, y])?;
        let axis = |k: usize| vector(py, all.iter().map(|x| x.semi_axes()[k]));
        Ok((axis(0), axis(1)))
    }

    /// Angles of the longest diameters of the orbits of two outputs from `x`, rad, shape (h,); NaN for a circle.
    fn orbit_directions<'py>(&self, py: Python<'py>, x: &str, y: &str) -> PyResult<Array1<'py>> {
        Ok(optional(py, self.orbits(py, [x, y])?.iter().map(Orbit::direction)))
    }

    /// How the orbits of two outputs are passed in each harmonic: "forward", from `x` to `y`, "backward", or None on a
    /// straight line.
    fn orbit_turnings(&self, py: Python<'_>, x: &str, y: &str) -> PyResult<Vec<Option<&'static str>>> {
        let word = |orbit: &Orbit| match orbit.turning()? {
            Turning::Forward => Some("forward"),
            Turning::Backward => Some("backward"),
        };
        Ok(self.orbits(py, [x, y])?.iter().map(word).collect())
    }

    /// Amplitudes of the outputs that are not exceeded with a probability if only the amounts of the excitations are
    /// known, and their phases, such as the angles of unbalances, are independent and uniform over the turn: shape (h, o).
    /// 0 gives the least possible, 1 the greatest.
    #[pyo3(signature = (probability, measure="displacement"))]
    fn unknown_phases_quantile<'py>(
        &self,
        py: Python<'py>,
        probability: f64,
        measure: &hints::Measure,
    ) -> PyResult<Array2<'py>> {
        self.of_unknown_phases(py, measure, |x| Ok(x.quantile(probability)?))
    }

    /// Roots of the mean squares of the amplitudes of the outputs under unknown phases, shape (h, o).
    #[pyo3(signature = (measure="displacement"))]
    fn unknown_phases_root_mean_square<'py>(&self, py: Python<'py>, measure: &hints::Measure) -> PyResult<Array2<'py>> {
        self.of_unknown_phases(py, measure, |x| Ok(x.root_mean_square()))
    }

    /// Probabilities that the amplitude of an output stays below a limit, SI or a text with a unit, under unknown phases,
    /// shape (h,).
    #[pyo3(signature = (output, limit, measure="displacement"))]
    fn unknown_phases_probability<'py>(
        &self,
        py: Python<'py>,
        output: &str,
        limit: &hints::Value<'_>,
        measure: &hints::Measure,
    ) -> PyResult<Array1<'py>> {
        let wanted = self.output(py, output)?;
        let vibration = Vibration::new(wanted, Excitation::<Any>::new(0));
        let vibration = vibration.measure(self::measure(py, measure)?);
        let unit = Response::Vibration(vibration).unit(&self.0.description);
        let limit = number(limit, &unit, output)?;
        let below =
            |harmonic: &Harmonic| Ok(harmonic.unknown_phases(wanted, vibration.measure)?.probability_below(limit));
        let all: Result<Vec<f64>, _> = self.0.harmonics.iter().map(below).collect();
        Ok(vector(py, all.map_err(|error| raise(py, error))?))
    }
}
