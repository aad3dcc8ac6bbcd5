//! Total first derivatives of forced vibrations.

use super::adjoint::{OutputAdjoint, Weights, gradients, results};
use super::extent::Extent;
use super::measure::Measure;
use super::response::{ForcedResponse, Harmonic, Solved};
use crate::algebra::{Matrix, Vector, add_to};
use crate::kernels::Kernels;
use crate::scalar::Real as _;
use crate::sensitivity::{EquilibriumShift, Slopes, amplitude_depends, equilibrium_shift};
use crate::{Complex, Equilibrium, Error, Output};

/// A forced response and its total first derivatives: equilibrium and frequency follow the variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForcedSensitivities {
    /// The response.
    pub response: ForcedResponse,
    /// One entry for each of its harmonics.
    pub harmonics: Vec<HarmonicSensitivity>,
}

/// Total first derivatives of one harmonic.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HarmonicSensitivity {
    /// Of the frequency, rad/s per SI unit.
    pub frequency: Slopes<f64>,
    /// Of the complex amplitude of each output, SI; `None` if it has no amplitude, or one without derivative, because it
    /// depends on a place that nothing determines, or sees an undamped mode that is in resonance but not driven. Where only the
    /// phase depends on a place, as under an unbalance on what turns freely, it is that of the place as it is.
    pub outputs: Vec<Option<Slopes<Complex>>>,
}

impl HarmonicSensitivity {
    fn finite(&self) -> bool {
        let mut all = self.outputs.iter().flatten().flat_map(Slopes::iter);
        self.frequency.iter().all(|x| x.is_finite()) && all.all(|x| x.is_finite())
    }
}

impl ForcedSensitivities {
    /// Derivatives of the complex amplitude of an output of a harmonic, as a displacement, velocity or acceleration;
    /// `None` if it has none.
    #[must_use]
    pub fn complex(&self, harmonic: usize, output: Output, measure: Measure) -> Option<Slopes<Complex>> {
        let (of, sensitivity) = self.pair(harmonic)?;
        let slopes = sensitivity.outputs.get(output.index())?.as_ref()?;
        let value = (of.frequency, (*of.outputs.get(output.index())?)?);
        Some(sensitivity.frequency.zip(slopes).map(|(dw, dy)| measure.slope(value, dw, dy)))
    }

    /// Derivatives of the modulus `|y|`; `None` also where it is zero.
    #[must_use]
    pub fn modulus(&self, harmonic: usize, output: Output, measure: Measure) -> Option<Slopes<f64>> {
        let y = self.value(harmonic, output, measure)?;
        Some(self.complex(harmonic, output, measure)?.map(|dy| Extent::Amplitude.slope(&[y], &[dy])))
    }

    /// Derivatives of the phase, rad; `None` also where the modulus is zero.
    #[must_use]
    pub fn phase(&self, harmonic: usize, output: Output, measure: Measure) -> Option<Slopes<f64>> {
        let y = self.value(harmonic, output, measure)?;
        Some(self.complex(harmonic, output, measure)?.map(|dy| (dy / y).im))
    }

    /// The complex amplitude, unless it is zero.
    pub(super) fn value(&self, harmonic: usize, output: Output, measure: Measure) -> Option<Complex> {
        let (of, _) = self.pair(harmonic)?;
        let amplitude = of.amplitude(output, measure)?;
        (amplitude != Complex::ZERO).then_some(amplitude)
    }

    pub(super) fn pair(&self, harmonic: usize) -> Option<(&Harmonic, &HarmonicSensitivity)> {
        let of = self.response.harmonics.get(harmonic)?;
        Some((of, self.harmonics.get(harmonic)?))
    }
}

/// The forced response and its total derivatives by every input and design variable.
///
/// # Errors
/// Those of [`response`](super::response), [`Error::CriticalState`] if `Khat` is singular, and those of
/// [`equilibrium_shift`].
pub fn sensitivities(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<ForcedSensitivities, Error> {
    let solved = Solved::new(mechanism, at)?;
    Ok(ForcedSensitivities { harmonics: first_derivatives(&solved)?, response: solved.response() })
}

pub(super) fn first_derivatives(solved: &Solved<'_>) -> Result<Vec<HarmonicSensitivity>, Error> {
    let (mechanism, at) = (solved.mechanism, solved.at);
    let shift = equilibrium_shift(mechanism, at)?;
    let outputs = mechanism.sizes().outputs;
    let mut harmonics = Vec::new();
    for vibration in &solved.vibrations {
        let adjoints = OutputAdjoint::each(solved, vibration, 0..outputs);
        let finite: Vec<&OutputAdjoint<'_>> = adjoints.iter().flatten().collect();
        let mut rows = gradients(solved, vibration, &finite);
        let placed = |(k, own): (usize, &&OutputAdjoint<'_>)| {
            let y = vibration.harmonic.outputs[own.output].unwrap_or_default();
            amplitude_depends(at, y, |j| Complex::new(rows[0][k][j], rows[1][k][j]))
        };
        let placed: Vec<bool> = finite.iter().enumerate().map(placed).collect();
        rows.iter_mut().for_each(|rows| add_shift(rows, &shift));
        let [re, im] = &rows;
        let mut places = 0..finite.len();
        let of_output = |output_adjoint: &Option<OutputAdjoint<'_>>| {
            output_adjoint.as_ref()?;
            let k = places.next()?;
            (!placed[k]).then(|| slopes(at, |j| -Complex::new(re[k][j], im[k][j])))
        };
        let outputs = adjoints.iter().map(of_output).collect();
        let mut row = Matrix::zeros(1, re.column_count());
        Weights::of_frequency(mechanism.sizes(), vibration).gradient_into(mechanism, at, results(at, &mut row[0]));
        add_shift(&mut row, &shift);
        let harmonic_sensitivity = HarmonicSensitivity { outputs, frequency: slopes(at, |j| row[0][j]) };
        if !harmonic_sensitivity.finite() {
            return Err(solved.not_finite());
        }
        harmonics.push(harmonic_sensitivity);
    }
    Ok(harmonics)
}

/// Adds the effect of the shift of the equilibrium to gradients by unknowns, inputs and design variables, one row each.
fn add_shift(gradients: &mut Matrix, shift: &EquilibriumShift) {
    let (by_input, by_design) = (&shift.by_input, &shift.by_design);
    f64::run(
        #[inline(always)]
        || {
            for row in gradients.iter_mut() {
                let (by_unknown, rest) = row.split_at_mut(by_design.row_count());
                let (inputs, design) = rest.split_at_mut(by_input.column_count());
                let shifts = by_input.iter().zip(by_design.iter());
                for (rate, (by_input, by_design)) in by_unknown.iter().zip(shifts) {
                    add_to(inputs, *rate, by_input);
                    add_to(design, *rate, by_design);
                }
            }
        },
    );
}

/// Derivatives by inputs and design variables, which stand after those by unknowns.
fn slopes<T: Copy + Default>(at: &Equilibrium, total: impl Fn(usize) -> T) -> Slopes<T> {
    let first = at.coordinates.len();
    let design = first + at.inputs.len();
    Slopes {
        by_input: Vector::from_fn(at.inputs.len(), |k| total(first + k)),
        by_design: Vector::from_fn(at.design.len(), |k| total(design + k)),
    }
}
