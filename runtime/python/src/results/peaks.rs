//! Peaks of a forced vibration along an input.

use eigentol::peaks::{Moving, Peak};
use pyo3::prelude::*;

use super::{attributes, result};
use crate::arrays::{Array1, Array2, optional, or_nan, rows, vector};
use crate::values::number;
use crate::{errors, hints};

result! {
    /// The peaks of a vibration along an input, in the order in which the range passes them. `k` is their number. Values
    /// are SI; heights are from 0 to peak.
    Peaks(eigentol::peaks::Peaks)
}

/// Something about a peak that moves with the design.
type Of = fn(&Peak) -> Option<&Moving>;

const PLACE: Of = |peak| Some(&peak.place);
const FREQUENCY: Of = |peak| Some(&peak.frequency);
const HEIGHT: Of = |peak| Some(&peak.height);
const BEFORE: Of = |peak| peak.half_power[0].place();
const AFTER: Of = |peak| peak.half_power[1].place();
const AMPLIFICATION: Of = |peak| peak.amplification.as_ref();

impl Peaks {
    fn each<'py>(&self, py: Python<'py>, of: impl Fn(&Peak) -> Option<f64>) -> Array1<'py> {
        vector(py, self.0.peaks.iter().map(|peak| or_nan(of(peak))))
    }

    fn values<'py>(&self, py: Python<'py>, of: Of) -> Array1<'py> {
        self.each(py, |peak| Some(of(peak)?.value))
    }

    fn sigmas<'py>(&self, py: Python<'py>, of: Of) -> Array1<'py> {
        self.each(py, |peak| Some(of(peak)?.spread.as_ref()?.sigma))
    }

    fn slopes<'py>(&self, py: Python<'py>, of: Of) -> PyResult<Array2<'py>> {
        let count = self.0.description.design.len();
        let row = |peak: &Peak| match of(peak) {
            Some(derivatives) => derivatives.by_design.to_vec(),
            None => vec![f64::NAN; count],
        };
        rows(py, count, self.0.peaks.iter().map(row))
    }
}

attributes! {
    Peaks(self, py) {
        /// Values of the input at the peaks, SI, shape (k,).
        places: Array1<'py> = self.values(py, PLACE);
        /// Their standard deviations to first order, SI, shape (k,).
        place_sigmas: Array1<'py> = self.sigmas(py, PLACE);
        /// Their total derivatives by design variables, shape (k, design), per SI unit.
        places_by_design: PyResult<Array2<'py>> = self.slopes(py, PLACE);
        /// Whether the equilibrium at each peak is stable and no mode grows; elsewhere no machine stays in the vibration.
        stable: Array1<'py, bool> = vector(py, self.0.peaks.iter().map(|peak| peak.stable));
        /// Frequencies at the peaks, rad/s, shape (k,).
        frequencies: Array1<'py> = self.values(py, FREQUENCY);
        /// Their standard deviations to first order, rad/s, shape (k,).
        frequency_sigmas: Array1<'py> = self.sigmas(py, FREQUENCY);
        /// Their total derivatives by design variables, shape (k, design), rad/s per SI unit.
        frequencies_by_design: PyResult<Array2<'py>> = self.slopes(py, FREQUENCY);
        /// Moduli at the peaks, SI, shape (k,).
        heights: Array1<'py> = self.values(py, HEIGHT);
        /// Their standard deviations to first order, SI, shape (k,).
        height_sigmas: Array1<'py> = self.sigmas(py, HEIGHT);
        /// Their total derivatives by design variables, shape (k, design), per SI unit.
        heights_by_design: PyResult<Array2<'py>> = self.slopes(py, HEIGHT);
        /// Phases at the peaks, rad, shape (k,).
        phases: Array1<'py> = self.each(py, |peak| Some(peak.phase));
        /// Values of the input before the peaks at which the power is half, SI, shape (k,); NaN where there is none.
        half_power_before: Array1<'py> = self.values(py, BEFORE);
        /// Values of the input after the peaks at which the power is half, SI, shape (k,); NaN where there is none.
        half_power_after: Array1<'py> = self.values(py, AFTER);
        /// Standard deviations of the half-power points before and after the peaks to first order, SI, shape (k,) each.
        half_power_sigmas: (Array1<'py>, Array1<'py>) = (self.sigmas(py, BEFORE), self.sigmas(py, AFTER));
        /// Total derivatives of the half-power points before and after the peaks by design variables, shape (k, design)
        /// each, per SI unit.
        half_power_by_design: PyResult<(Array2<'py>, Array2<'py>)> =
            Ok((self.slopes(py, BEFORE)?, self.slopes(py, AFTER)?));
        /// Amplification factors, shape (k,); NaN where there is none.
        amplifications: Array1<'py> = self.values(py, AMPLIFICATION);
        /// Their standard deviations to first order, shape (k,).
        amplification_sigmas: Array1<'py> = self.sigmas(py, AMPLIFICATION);
        /// Their total derivatives by design variables, shape (k, design), per SI unit.
        amplifications_by_design: PyResult<Array2<'py>> = self.slopes(py, AMPLIFICATION);
    }
}

#[pymethods]
impl Peaks {
    /// How far the peaks keep from a range of operation of the input, in the manner of API 617. Values are SI or texts
    /// with units.
    fn separation(&self, py: Python<'_>, low: &hints::Value<'_>, high: &hints::Value<'_>) -> PyResult<Separation> {
        let input = &self.0.description.inputs[self.0.range.input.index()];
        let end = |value| number(value, &input.unit, &input.name);
        let operating = [end(low)?, end(high)?];
        if operating[0] > operating[1] {
            let message = "the range of operation starts above its end".to_owned();
            return Err(errors::invalid(py, message));
        }
        Ok(Separation(self.0.clone().separation(operating)))
    }
}

result! {
    /// The distances of peaks from a range of operation, in the manner of API 617. `k` is the number of peaks.
    Separation(eigentol::peaks::Separation)
}

impl Separation {
    fn actual(&self) -> impl Iterator<Item = &Moving> {
        self.0.margins.iter().map(|margin| &margin.actual)
    }
}

attributes! {
    Separation(self, py) {
        /// The peaks.
        peaks: Peaks = Peaks(self.0.peaks.clone());
        /// Lowest and highest value of the input in operation, SI.
        operating: (f64, f64) = self.0.operating.into();
        /// Distances of the peaks from the nearest end of the range, relative to that end, shape (k,); zero within the
        /// range.
        margins: Array1<'py> = vector(py, self.actual().map(|x| x.value));
        /// Their standard deviations to first order, shape (k,).
        margin_sigmas: Array1<'py> = {
            optional(py, self.actual().map(|x| Some(x.spread.as_ref()?.sigma)))
        };
        /// Their total derivatives by design variables, shape (k, design), per SI unit.
        margins_by_design: PyResult<Array2<'py>> = {
            let count = self.0.peaks.description.design.len();
            rows(py, count, self.actual().map(|row| row.by_design.to_vec()))
        };
        /// The margins that the amplification factors ask for, shape (k,); zero for a peak that is damped away, NaN
        /// without an amplification factor.
        required: Array1<'py> = optional(py, self.0.margins.iter().map(|margin| margin.required));
        /// Whether each peak keeps away far enough; None if what is required is not known.
        sufficient: Vec<Option<bool>> = {
            self.0.margins.iter().map(|margin| margin.sufficient()).collect()
        };
    }
}
