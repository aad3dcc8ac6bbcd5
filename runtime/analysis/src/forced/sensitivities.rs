//! Total first derivatives of forced vibrations.

use super::adjoint::{OutputAdjoint, Weights};
use super::measure::Measure;
use super::response::{ForcedResponse, Harmonic, Solved};
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
    first_derivatives(&Solved::new(mechanism, at)?)
}

pub(super) fn first_derivatives(solved: &Solved<'_>) -> Result<ForcedSensitivities, Error> {
    let (mechanism, at) = (solved.mechanism, solved.at);
    let shift = equilibrium_shift(mechanism, at)?;
    let outputs = mechanism.sizes().outputs;
    let mut room = Gradient::zeros(mechanism.sizes());
    let mut harmonics = Vec::new();
    for vibration in &solved.vibrations {
        let of_frequency = Weights::of_frequency(mechanism.sizes(), vibration);
        of_frequency.gradient_into(mechanism, at, &mut room);
        let frequency = total(&room, &shift);
        let of_output = |o: usize| {
            let [re, im] = OutputAdjoint::new(solved, vibration, o)?.gradient();
            let placed = [&re, &im];
            if placed.iter().any(|own| depends(at, &own.coordinates)) {
                return None;
            }
            let both = total(&re, &shift).zip(&total(&im, &shift));
            Some(both.map(|(re, im)| -Complex::new(re, im)))
        };
        let own = HarmonicSensitivity {
            frequency,
            outputs: (0..outputs).map(of_output).collect(),
        };
        if !own.finite() {
            return Err(outside_domain(at));
        }
        harmonics.push(own);
    }
    Ok(ForcedSensitivities {
        response: solved.response(),
        harmonics,
    })
}

/// The derivatives of a gradient's scalar with the shift of the equilibrium.
fn total(partial: &Gradient, shift: &EquilibriumShift) -> Slopes<f64> {
    let with = |own: &Vector, shift: &Matrix| {
        let mut sum = own.clone();
        for (rate, shift) in partial.coordinates.iter().zip(shift.iter()) {
            add_to(&mut sum, *rate, shift);
        }
        sum
    };
    Slopes {
        by_input: with(&partial.inputs, &shift.by_input),
        by_design: with(&partial.design, &shift.by_design),
    }
}
