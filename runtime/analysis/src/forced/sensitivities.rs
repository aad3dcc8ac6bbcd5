//! Total first derivatives of forced vibrations.

use super::adjoint::{OutputAdjoint, Weights, gradients};
use super::measure::Measure;
use super::response::{ForcedResponse, Harmonic, Solved, Vibration};
use crate::algebra::{Matrix, Vector, add_to};
use crate::kernels::{Gradient, Kernels};
use crate::sensitivity::{EquilibriumShift, Slopes, depends, equilibrium_shift, outside_domain};
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
    /// Of the complex amplitude of each output, SI; `None` if it has a value but no derivative, because it depends on a
    /// place that nothing determines, or sees an undamped mode that is in resonance but not driven.
    pub outputs: Vec<Option<Slopes<Complex>>>,
}

impl HarmonicSensitivity {
    fn finite(&self) -> bool {
        let mut all = self.outputs.iter().flatten().flat_map(Slopes::iter);
        self.frequency.iter().all(|own| own.is_finite()) && all.all(|own| own.is_finite())
    }
}

impl ForcedSensitivities {
    /// Derivatives of the complex amplitude of an output of a harmonic, as a displacement, velocity or acceleration;
    /// `None` if it has none.
    #[must_use]
    pub fn complex(
        &self,
        harmonic: usize,
        output: Output,
        measure: Measure,
    ) -> Option<Slopes<Complex>> {
        let (of, own) = self.pair(harmonic)?;
        let slopes = own.outputs.get(output.index())?.as_ref()?;
        let value = (of.frequency, *of.outputs.get(output.index())?);
        let both = own.frequency.zip(slopes);
        Some(both.map(|(dw, dy)| measure.slope(value, dw, dy)))
    }

    /// Derivatives of the modulus `|y|`; `None` also where it is zero.
    #[must_use]
    pub fn modulus(
        &self,
        harmonic: usize,
        output: Output,
        measure: Measure,
    ) -> Option<Slopes<f64>> {
        let y = self.value(harmonic, output, measure)?;
        let slopes = self.complex(harmonic, output, measure)?;
        Some(slopes.map(|dy| modulus_slope(y, dy)))
    }

    /// Derivatives of the phase, rad; `None` also where the modulus is zero.
    #[must_use]
    pub fn phase(&self, harmonic: usize, output: Output, measure: Measure) -> Option<Slopes<f64>> {
        let y = self.value(harmonic, output, measure)?;
        let slopes = self.complex(harmonic, output, measure)?;
        Some(slopes.map(|dy| (dy / y).im))
    }

    /// The complex amplitude, unless it is zero.
    pub(super) fn value(
        &self,
        harmonic: usize,
        output: Output,
        measure: Measure,
    ) -> Option<Complex> {
        let (of, _) = self.pair(harmonic)?;
        let own = of.amplitude(output, measure)?;
        (own != Complex::ZERO).then_some(own)
    }

    pub(super) fn pair(&self, harmonic: usize) -> Option<(&Harmonic, &HarmonicSensitivity)> {
        let of = self.response.harmonics.get(harmonic)?;
        Some((of, self.harmonics.get(harmonic)?))
    }
}

/// Derivative of `|y|`.
pub(super) fn modulus_slope(y: Complex, dy: Complex) -> f64 {
    y.norm() * (dy / y).re
}

/// The forced response and its total derivatives by every input and design variable.
///
/// # Errors
/// Those of [`response`](super::response), [`Error::CriticalState`] if `Khat` is singular, and those of
/// [`equilibrium_shift`].
pub fn sensitivities(
    mechanism: &dyn Kernels,
    at: &Equilibrium,
) -> Result<ForcedSensitivities, Error> {
    let solved = Solved::new(mechanism, at)?;
    Ok(ForcedSensitivities {
        harmonics: first_derivatives(&solved)?,
        response: solved.response(),
    })
}

pub(super) fn first_derivatives(solved: &Solved<'_>) -> Result<Vec<HarmonicSensitivity>, Error> {
    let (mechanism, at) = (solved.mechanism, solved.at);
    let shift = Shift::new(&equilibrium_shift(mechanism, at)?);
    let (n, outputs) = (at.coordinates.len(), mechanism.sizes().outputs);
    let mut harmonics = Vec::new();
    for vibration in &solved.vibrations {
        let adjoints = OutputAdjoint::each(solved, vibration, 0..outputs);
        let finite: Vec<&OutputAdjoint<'_>> = adjoints.iter().flatten().collect();
        let mut total = gradients(solved, vibration, &finite);
        let mut places = 0..finite.len();
        let of_output = |own: &Option<OutputAdjoint<'_>>| {
            own.as_ref()?;
            let place = places.next()?;
            let [re, im] = total.each_mut().map(|rows| &mut rows[place]);
            if depends(at, &re[..n]) || depends(at, &im[..n]) {
                return None;
            }
            let both = shift.total(re).zip(&shift.total(im));
            Some(both.map(|(re, im)| -Complex::new(re, im)))
        };
        let own = HarmonicSensitivity {
            outputs: adjoints.iter().map(of_output).collect(),
            frequency: shift.total(&mut frequency_gradient(solved, vibration)),
        };
        if !own.finite() {
            return Err(outside_domain(at));
        }
        harmonics.push(own);
    }
    Ok(harmonics)
}

/// The gradient of a frequency by unknowns, inputs and design variables.
fn frequency_gradient(solved: &Solved<'_>, vibration: &Vibration) -> Vector {
    let sizes = solved.mechanism.sizes();
    let mut found = Gradient::zeros(sizes);
    let weights = Weights::of_frequency(sizes, vibration);
    weights.gradient_into(solved.mechanism, solved.at, &mut found);
    let by_unknown = found.coordinates.iter().chain(&found.inputs);
    by_unknown.chain(&found.design).copied().collect()
}

/// The shift of the equilibrium by inputs, then design variables.
struct Shift {
    inputs: usize,
    rows: Matrix,
}

impl Shift {
    fn new(shift: &EquilibriumShift) -> Self {
        let (inputs, by_design) = (shift.by_input.column_count(), &shift.by_design);
        let count = inputs + by_design.column_count();
        Self {
            inputs,
            rows: Matrix::from_fn(by_design.row_count(), count, |i, k| match k < inputs {
                true => shift.by_input[i][k],
                false => by_design[i][k - inputs],
            }),
        }
    }

    /// The total derivatives from a gradient by unknowns, inputs and design variables, which is overwritten.
    fn total(&self, gradient: &mut [f64]) -> Slopes<f64> {
        let (by_unknown, own) = gradient.split_at_mut(self.rows.row_count());
        for (rate, shift) in by_unknown.iter().zip(self.rows.iter()) {
            add_to(own, *rate, shift);
        }
        Slopes {
            by_input: own[..self.inputs].into(),
            by_design: own[self.inputs..].into(),
        }
    }
}
