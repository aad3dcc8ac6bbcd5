//! Forced vibration about an equilibrium, and its derivatives.

use eigentol::forced::{self, Harmonic, Measure, Orbit, RandomPhases, Share, Turning};
use eigentol::response::{Response, Vibration};
use eigentol::second_order::SecondDerivatives;
use eigentol::sensitivity::Slopes;
use eigentol::{Any, Complex, Description, Error, Excitation, Matrix, Output, Vector};
use numpy::{Element, PyArrayMethods};
use pyo3::prelude::*;

use super::{attributes, result};
use crate::arrays::{Array1, Array2, Array3, Array4, NONE, optional, optional_rows, rows, vector};
use crate::errors::raise;
use crate::response::measure;
use crate::values::number;
use crate::{hints, names};

result! {
    /// The steady vibration under the declared excitations, `Re(y e^{i w t})`. Amplitudes are complex, SI: the modulus is
    /// from 0 to peak, half of peak to peak; a positive phase leads, and NaN stands for an output that has a value but no
    /// derivative, like the length of a vector that is zero. `h` is the number of harmonics, `o` of outputs, `n` of
    /// unknowns, `e` of excitations.
    ForcedResponse(forced::ForcedResponse)
}

/// The complex amplitudes of all outputs of a harmonic, NaN for one that has none.
pub(super) fn amplitudes(of: &Harmonic, measure: Measure) -> impl Iterator<Item = Complex> + use<'_> {
    let each = of.outputs.iter();
    each.map(move |y| y.map_or(NONE, |y| measure.of(of.frequency, y)))
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
        let each = self.0.harmonics.iter();
        Ok(each.filter_map(|item| item.orbit(x, y)).collect())
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
            let all = harmonic.outputs.iter().enumerate().map(number);
            all.collect::<Result<Vec<f64>, _>>()
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
        let all = self.orbits(py, [x, y])?;
        Ok(optional(py, all.iter().map(Orbit::direction)))
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
        let below = |harmonic: &Harmonic| {
            let sum = harmonic.unknown_phases(wanted, vibration.measure)?;
            Ok(sum.probability_below(limit))
        };
        let all: Result<Vec<f64>, _> = self.0.harmonics.iter().map(below).collect();
        Ok(vector(py, all.map_err(|error| raise(py, error))?))
    }
}

/// Number of inputs and of design variables.
fn counts(of: &Description) -> (usize, usize) {
    (of.inputs.len(), of.design.len())
}

/// Derivatives of something about each output of each harmonic, by inputs and by design variables.
type FirstOf<'py, T> = (Array3<'py, T>, Array3<'py, T>);
type First<'py> = (Array3<'py>, Array3<'py>);
type FirstComplex<'py> = (Array3<'py, Complex>, Array3<'py, Complex>);

/// Second derivatives by two inputs, by an input and a design variable, by two design variables, of something about each
/// output of each harmonic.
type SecondOf<'py, T> = (Array4<'py, T>, Array4<'py, T>, Array4<'py, T>);
type Second<'py> = (Array4<'py>, Array4<'py>, Array4<'py>);
type SecondComplex<'py> = (Array4<'py, Complex>, Array4<'py, Complex>, Array4<'py, Complex>);

/// A row of numbers for each output, `none` where an output has none.
pub(super) fn filled<T: Copy>(all: impl IntoIterator<Item = Option<Vec<T>>>, (columns, none): (usize, T)) -> Vec<T> {
    let row = |x: Option<Vec<T>>| x.unwrap_or_else(|| vec![none; columns]);
    all.into_iter().flat_map(row).collect()
}

/// Places of all outputs of all harmonics.
fn places(harmonics: usize, outputs: usize) -> impl Iterator<Item = (usize, Output)> {
    let of = move |harmonic| (0..outputs).map(move |output| (harmonic, Output::new(output)));
    (0..harmonics).flat_map(of)
}

result! {
    /// The steady vibration with its total first derivatives, per SI unit: equilibrium and frequencies follow the
    /// variables. `h` is the number of harmonics, `o` of outputs; NaN stands where an output has no derivative, because it
    /// depends on a place that nothing determines, or sees an undamped mode in resonance that nothing drives.
    ForcedSensitivities(forced::ForcedSensitivities)
}

impl ForcedSensitivities {
    fn both<'py, T: Element + Copy + Default>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(usize, Output) -> Option<Slopes<T>>,
    ) -> PyResult<FirstOf<'py, T>> {
        let description = &self.0.response.description;
        let (inputs, design) = counts(description);
        let (harmonics, outputs) = (self.0.harmonics.len(), description.outputs.len());
        let part = |columns: usize, part: fn(&Slopes<T>) -> &Vector<T>| {
            let all = places(harmonics, outputs);
            let all = all.map(|(harmonic, output)| Some(part(&of(harmonic, output)?).to_vec()));
            vector(py, filled(all, (columns, none))).reshape([harmonics, outputs, columns])
        };
        Ok((part(inputs, |x| &x.by_input)?, part(design, |x| &x.by_design)?))
    }

    fn as_declared<'py>(&self, py: Python<'py>) -> PyResult<FirstComplex<'py>> {
        let measure = Measure::Displacement;
        self.both(py, NONE, |harmonic, output| self.0.complex(harmonic, output, measure))
    }
}

impl ForcedSensitivities {
    fn orbit_squares<'py>(
        &self,
        py: Python<'py>,
        [x, y]: [&str; 2],
        (count, part): (usize, fn(&Slopes<f64>) -> &Vector),
    ) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let response = ForcedResponse(self.0.response.clone());
        let (x, y) = (response.output(py, x)?, response.output(py, y)?);
        let harmonics = 0..self.0.harmonics.len();
        let both: Vec<_> = harmonics.map(|k| self.0.orbit_squares(k, x, y)).collect();
        let of = |which: usize| {
            let each = both.iter().map(|x| Some(part(&x.as_ref()?[which]).to_vec()));
            optional_rows(py, count, each)
        };
        Ok((of(0)?, of(1)?))
    }
}

attributes! {
    ForcedSensitivities(self, py) {
        /// The vibration.
        response: ForcedResponse = ForcedResponse(self.0.response.clone());
        /// Derivatives of the complex amplitudes of the outputs by inputs, shape (h, o, inputs).
        by_input: PyResult<Array3<'py, Complex>> = Ok(self.as_declared(py)?.0);
        /// Derivatives of the complex amplitudes of the outputs by design variables, shape (h, o, design).
        by_design: PyResult<Array3<'py, Complex>> = Ok(self.as_declared(py)?.1);
        /// Derivatives of the frequencies by inputs, rad/s per SI unit, shape (h, inputs).
        frequency_by_input: PyResult<Array2<'py>> = {
            let all = self.0.harmonics.iter().map(|harmonic| harmonic.frequency.by_input.to_vec());
            rows(py, self.0.response.description.inputs.len(), all)
        };
        /// Derivatives of the frequencies by design variables, rad/s per SI unit, shape (h, design).
        frequency_by_design: PyResult<Array2<'py>> = {
            let all = self.0.harmonics.iter().map(|harmonic| harmonic.frequency.by_design.to_vec());
            rows(py, self.0.response.description.design.len(), all)
        };
    }
}

attributes! {
    ForcedSensitivities(self, py, measure: hints::Measure = "displacement") {
        /// Derivatives of the complex amplitudes of the outputs, as "displacement", "velocity" or "acceleration", by
        /// inputs, shape (h, o, inputs), and by design variables, shape (h, o, design), SI.
        complex: FirstComplex<'py> = {
            let wanted = self::measure(py, measure)?;
            self.both(py, NONE, |harmonic, output| self.0.complex(harmonic, output, wanted))
        };
        /// Derivatives of the moduli `|y|`, by inputs, shape (h, o, inputs), and by design variables, shape (h, o,
        /// design), SI; NaN also where the modulus is zero.
        modulus: First<'py> = {
            let wanted = self::measure(py, measure)?;
            self.both(py, f64::NAN, |harmonic, output| self.0.modulus(harmonic, output, wanted))
        };
        /// Derivatives of the phases, rad, by inputs, shape (h, o, inputs), and by design variables, shape (h, o,
        /// design), per SI unit; NaN also where the modulus is zero.
        phase: First<'py> = {
            let wanted = self::measure(py, measure)?;
            self.both(py, f64::NAN, |harmonic, output| self.0.phase(harmonic, output, wanted))
        };
    }
}

#[pymethods]
impl ForcedSensitivities {
    /// Derivatives of `|f|^2` and of `|b|^2`, the squares of `response.orbit_parts(x, y)`, by inputs, shape (h, inputs)
    /// each, SI.
    fn orbit_squares_by_input<'py>(&self, py: Python<'py>, x: &str, y: &str) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let count = self.0.response.description.inputs.len();
        self.orbit_squares(py, [x, y], (count, |x| &x.by_input))
    }

    /// The same by design variables, shape (h, design) each.
    fn orbit_squares_by_design<'py>(&self, py: Python<'py>, x: &str, y: &str) -> PyResult<(Array2<'py>, Array2<'py>)> {
        let count = self.0.response.description.design.len();
        self.orbit_squares(py, [x, y], (count, |x| &x.by_design))
    }
}

result! {
    /// The steady vibration with its total first and second derivatives, per SI unit. `h` is the number of harmonics, `o`
    /// of outputs; NaN stands where an output has no derivative.
    ForcedCurvature(forced::ForcedCurvature)
}

impl ForcedCurvature {
    fn three<'py, T: Element + Copy + Default>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(usize, Output) -> Option<SecondDerivatives<T>>,
    ) -> PyResult<SecondOf<'py, T>> {
        let description = &self.0.first.response.description;
        let (inputs, design) = counts(description);
        let (harmonics, outputs) = (self.0.harmonics.len(), description.outputs.len());
        let part = |rows: usize, columns: usize, part: fn(&SecondDerivatives<T>) -> &Matrix<T>| {
            let all = places(harmonics, outputs)
                .map(|(harmonic, output)| Some(part(&of(harmonic, output)?).as_flattened().to_vec()));
            let shape = [harmonics, outputs, rows, columns];
            vector(py, filled(all, (rows * columns, none))).reshape(shape)
        };
        Ok((
            part(inputs, inputs, |x| &x.by_input)?,
            part(inputs, design, |x| &x.by_input_and_design)?,
            part(design, design, |x| &x.by_design)?,
        ))
    }

    fn as_declared<'py>(&self, py: Python<'py>) -> PyResult<SecondComplex<'py>> {
        let measure = Measure::Displacement;
        self.three(py, NONE, |harmonic, output| self.0.complex(harmonic, output, measure))
    }

    /// Second derivatives of the frequencies.
    fn of_frequencies<'py>(
        &self,
        py: Python<'py>,
        of: fn(&SecondDerivatives<f64>) -> &Matrix,
        [rows, columns]: [usize; 2],
    ) -> PyResult<Array3<'py>> {
        let all = self.0.harmonics.iter().map(|harmonic| of(&harmonic.frequency));
        let all = all.flat_map(|x| x.as_flattened().iter().copied());
        vector(py, all).reshape([self.0.harmonics.len(), rows, columns])
    }

    fn counts(&self) -> (usize, usize) {
        counts(&self.0.first.response.description)
    }
}

attributes! {
    ForcedCurvature(self, py) {
        /// The vibration and its first derivatives.
        first: ForcedSensitivities = ForcedSensitivities(self.0.first.clone());
        /// Second derivatives of the complex amplitudes by design variables, shape (h, o, design, design).
        hessian: PyResult<Array4<'py, Complex>> = Ok(self.as_declared(py)?.2);
        /// Second derivatives of the complex amplitudes by inputs, shape (h, o, inputs, inputs).
        by_input: PyResult<Array4<'py, Complex>> = Ok(self.as_declared(py)?.0);
        /// Second derivatives of the complex amplitudes by an input and a design variable, shape (h, o, inputs, design).
        by_input_and_design: PyResult<Array4<'py, Complex>> = Ok(self.as_declared(py)?.1);
        /// Second derivatives of the frequencies by design variables, rad/s per SI units, shape (h, design, design).
        frequency_hessian: PyResult<Array3<'py>> = {
            let design = self.counts().1;
            self.of_frequencies(py, |of_frequency| &of_frequency.by_design, [design, design])
        };
        /// Second derivatives of the frequencies by inputs, shape (h, inputs, inputs).
        frequency_by_input: PyResult<Array3<'py>> = {
            let inputs = self.counts().0;
            self.of_frequencies(py, |of_frequency| &of_frequency.by_input, [inputs, inputs])
        };
        /// Second derivatives of the frequencies by an input and a design variable, shape (h, inputs, design).
        frequency_by_input_and_design: PyResult<Array3<'py>> = {
            let (inputs, design) = self.counts();
            self.of_frequencies(py, |of_frequency| &of_frequency.by_input_and_design, [inputs, design])
        };
    }
}

attributes! {
    ForcedCurvature(self, py, measure: hints::Measure = "displacement") {
        /// Second derivatives of the complex amplitudes of the outputs, as "displacement", "velocity" or "acceleration",
        /// SI: by inputs, shape (h, o, inputs, inputs), by an input and a design variable, shape (h, o, inputs, design),
        /// and by design variables, shape (h, o, design, design).
        complex: SecondComplex<'py> = {
            let wanted = self::measure(py, measure)?;
            self.three(py, NONE, |harmonic, output| self.0.complex(harmonic, output, wanted))
        };
        /// The same of the moduli `|y|`; NaN also where the modulus is zero.
        modulus: Second<'py> = {
            let wanted = self::measure(py, measure)?;
            self.three(py, f64::NAN, |harmonic, output| self.0.modulus(harmonic, output, wanted))
        };
        /// The same of the phases, rad; NaN also where the modulus is zero.
        phase: Second<'py> = {
            let wanted = self::measure(py, measure)?;
            self.three(py, f64::NAN, |harmonic, output| self.0.phase(harmonic, output, wanted))
        };
    }
}
