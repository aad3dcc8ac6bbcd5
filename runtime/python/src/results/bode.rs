//! Forced vibration along an input.

use eigentol::bode::BodePoint;
use eigentol::forced::{ForcedSensitivities as Sensitivities, Measure};
use eigentol::propagation::{QUANTILES, ResponseSpread, VibrationCheck};
use eigentol::sensitivity::Slopes;
use eigentol::{Complex, Output, Vector};
use numpy::{Element, PyArrayMethods};
use pyo3::prelude::*;

use super::forced::{amplitudes, filled};
use super::{ForcedSensitivities, attributes, result};
use crate::arrays::{Array1, Array2, Array3, Array4, NONE, or_nan, rows, vector};
use crate::response::measure;
use crate::spreads::Propagation;
use crate::{hints, names};

result! {
    /// Forced vibration along an input. `k` is the number of values, `h` of harmonics, `o` of outputs, `v` of the
    /// vibrations that have bands. Amplitudes are complex, SI: the modulus is from 0 to peak, half of peak to peak; a
    /// positive phase leads. NaN stands where a value has no vibration.
    Bode(eigentol::bode::Bode)
}

impl Bode {
    /// Numbers of harmonics and outputs.
    fn counts(&self) -> [usize; 2] {
        let of = &self.0.description;
        [names::harmonics(of).len(), of.outputs.len()]
    }

    /// Numbers that belong to each value, `count` of them.
    fn each<'a, T: Copy>(&'a self, (count, none): (usize, T), of: impl Fn(&'a Sensitivities) -> Vec<T>) -> Vec<T> {
        let points = self.0.points.iter();
        let all = points.map(|point| point.vibration.as_ref().ok().map(&of));
        filled(all, (count, none))
    }

    fn measured<'py>(&self, py: Python<'py>, measure: Measure) -> PyResult<Array3<'py, Complex>> {
        let [harmonics, outputs] = self.counts();
        let all = self.each((harmonics * outputs, NONE), |item| {
            let harmonics = item.response.harmonics.iter();
            harmonics.flat_map(|harmonic| amplitudes(harmonic, measure)).collect()
        });
        vector(py, all).reshape([self.0.points.len(), harmonics, outputs])
    }

    /// Derivatives of something about each output of each harmonic.
    fn slopes<'py, T: Element + Copy + Default>(
        &self,
        py: Python<'py>,
        (columns, none): (usize, T),
        of: impl Fn(&Sensitivities, usize, Output) -> Option<Slopes<T>>,
        part: fn(&Slopes<T>) -> &Vector<T>,
    ) -> PyResult<Array4<'py, T>> {
        let [harmonics, outputs] = self.counts();
        let all = self.each((harmonics * outputs * columns, none), |item| {
            let places = (0..harmonics).flat_map(|h| (0..outputs).map(move |o| (h, o)));
            let each = places.map(|(h, o)| {
                let found = of(item, h, Output::new(o));
                found.map(|x| part(&x).to_vec())
            });
            filled(each, (columns, none))
        });
        vector(py, all).reshape([self.0.points.len(), harmonics, outputs, columns])
    }

    /// Derivatives by inputs and by design variables.
    fn both<'py, T: Element + Copy + Default>(
        &self,
        py: Python<'py>,
        none: T,
        of: impl Fn(&Sensitivities, usize, Output) -> Option<Slopes<T>>,
    ) -> PyResult<AlongOf<'py, T>> {
        let (inputs, design) = (self.0.description.inputs.len(), self.0.description.design.len());
        Ok((
            self.slopes(py, (inputs, none), &of, |x| &x.by_input)?,
            self.slopes(py, (design, none), &of, |x| &x.by_design)?,
        ))
    }

    /// A number of each band at each value.
    fn bands<'py>(&self, py: Python<'py>, of: impl Fn(&BodePoint, usize) -> Option<f64>) -> PyResult<Array2<'py>> {
        let count = self.0.banded.len();
        let row = |item| (0..count).map(|band| or_nan(of(item, band))).collect();
        rows(py, count, self.0.points.iter().map(row))
    }
}

/// Derivatives of something about each output of each harmonic at each value, by inputs and by design variables.
type AlongOf<'py, T> = (Array4<'py, T>, Array4<'py, T>);
type Along<'py> = (Array4<'py>, Array4<'py>);

fn spread(of: &BodePoint, band: usize) -> Option<&ResponseSpread> {
    of.bands.as_ref()?.spread.spreads.get(band)?.as_ref()
}

fn check(of: &BodePoint, band: usize) -> Option<&VibrationCheck> {
    of.bands.as_ref()?.checks.get(band)?.as_ref()
}

attributes! {
    Bode(self, py) {
        /// Values of the input, SI, shape (k,).
        values: Array1<'py> = vector(py, self.0.points.iter().map(|point| point.value));
        /// Whether the equilibrium at each value is stable and no mode grows; elsewhere no machine stays in the vibration.
        stable: Array1<'py, bool> = vector(py, self.0.points.iter().map(|point| point.stable));
        /// Names of the excitations that act together in each harmonic.
        harmonics: Vec<Vec<&str>> = names::harmonics(&self.0.description);
        /// Frequencies of the harmonics, rad/s, shape (k, h).
        frequencies: PyResult<Array2<'py>> = {
            let count = self.counts()[0];
            let all = self.each((count, f64::NAN), |point| {
                point.response.harmonics.iter().map(|harmonic| harmonic.frequency).collect()
            });
            vector(py, all).reshape([self.0.points.len(), count])
        };
        /// Amplitudes of the outputs, complex, SI, shape (k, h, o).
        outputs: PyResult<Array3<'py, Complex>> = self.measured(py, Measure::Displacement);
        /// Total derivatives of the complex amplitudes by inputs, the varied one included, shape (k, h, o, inputs), per
        /// SI unit.
        by_input: PyResult<Array4<'py, Complex>> = {
            let of = |slopes: &Sensitivities, h, o| slopes.complex(h, o, Measure::Displacement);
            Ok(self.both(py, NONE, of)?.0)
        };
        /// Total derivatives of the complex amplitudes by design variables, shape (k, h, o, design), per SI unit.
        by_design: PyResult<Array4<'py, Complex>> = {
            let of = |slopes: &Sensitivities, h, o| slopes.complex(h, o, Measure::Displacement);
            Ok(self.both(py, NONE, of)?.1)
        };
        /// The vibration with its derivatives at each value, or None.
        vibrations: Vec<Option<ForcedSensitivities>> =
            self.0.points.iter()
                .map(|point| point.vibration.clone().ok().map(ForcedSensitivities)).collect();
        /// Why there is no vibration at each value: a text, or None where there is one.
        failures: Vec<Option<String>> =
            self.0.points.iter()
                .map(|point| point.vibration.as_ref().err().map(ToString::to_string)).collect();
        /// Names of the vibrations that have bands.
        banded: Vec<String> = {
            let each = self.0.banded.iter().copied().map(eigentol::response::Response::Vibration);
            each.map(|response| response.name(&self.0.description)).collect()
        };
        /// The spreads of these amplitudes at each value, or None.
        spreads: Vec<Option<Propagation>> = {
            let spread = |point: &BodePoint| point.bands.as_ref().map(|bands| bands.spread.clone());
            self.0.points.iter().map(|point| spread(point).map(Propagation)).collect()
        };
        /// Means of the banded amplitudes, SI, shape (k, v).
        mean: PyResult<Array2<'py>> =
            self.bands(py, |point, band| Some(spread(point, band)?.mean.value));
        /// Their standard deviations, SI, shape (k, v).
        sigma: PyResult<Array2<'py>> =
            self.bands(py, |point, band| Some(spread(point, band)?.sigma?.value));
        /// Their quantiles, SI, shape (k, v, 7), for the probabilities of -3, -2 ... 3 standard deviations of a normal
        /// variable.
        quantiles: PyResult<Array3<'py>> = {
            let count = self.0.banded.len();
            let each = |point, band, index: usize| {
                Some(spread(point, band)?.quantiles.get(index)?.value)
            };
            let points = self.0.points.iter();
            let all = points.flat_map(|point| {
                (0..count).flat_map(move |band| {
                    (0..QUANTILES.len()).map(move |index| or_nan(each(point, band, index)))
                })
            });
            vector(py, all).reshape([self.0.points.len(), count, QUANTILES.len()])
        };
        /// Probabilities of the quantiles, shape (7,).
        probabilities: Array1<'py> = vector(py, QUANTILES);
        /// Numbers of designs solved anew that have the vibration, shape (k, v); NaN where none was asked for.
        checked: PyResult<Array2<'py>> =
            self.bands(py, |point, band| Some(check(point, band)?.samples as f64));
        /// Relative errors of the standard deviations that these show, shape (k, v).
        sigma_errors: PyResult<Array2<'py>> = self.bands(py, |point, band| Some(check(point, band)?.sigma));
        /// Relative errors of the values below which 99 % of the designs lie, shape (k, v).
        upper_errors: PyResult<Array2<'py>> = self.bands(py, |point, band| Some(check(point, band)?.upper));
        /// Number of values that were not reached.
        unreached: usize = self.0.unreached;
    }
}

attributes! {
    Bode(self, py, measure: hints::Measure = "displacement") {
        /// Amplitudes of the outputs, complex, shape (k, h, o): as "displacement" they are `outputs`, SI; as "velocity"
        /// per second, as "acceleration" per second squared.
        amplitudes: Array3<'py, Complex> = {
            let wanted = self::measure(py, measure)?;
            self.measured(py, wanted)
        };
        /// Derivatives of the moduli `|y|`, by inputs, shape (k, h, o, inputs), and by design variables, shape (k, h, o,
        /// design), SI; NaN also where the modulus is zero.
        modulus: Along<'py> = {
            let wanted = self::measure(py, measure)?;
            self.both(py, f64::NAN, |point, h, o| point.modulus(h, o, wanted))
        };
        /// Derivatives of the phases, rad, by inputs, shape (k, h, o, inputs), and by design variables, shape (k, h, o,
        /// design), per SI unit; NaN also where the modulus is zero.
        phase: Along<'py> = {
            let wanted = self::measure(py, measure)?;
            self.both(py, f64::NAN, |point, h, o| point.phase(h, o, wanted))
        };
    }
}
