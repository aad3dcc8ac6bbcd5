//! The vibration of one output.

use super::curvature::second_derivatives;
use super::measure::Measure;
use super::response::ForcedResponse;
use crate::kernels::CurvatureKernels;
use crate::second_order::SecondDerivatives;
use crate::sensitivity::Slopes;
use crate::{Any, Description, Equilibrium, Error, Excitation, Output, Text, Unit};

/// The vibration of an output under all excitations that have one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vibration {
    /// The output.
    pub output: Output,
    /// One of the excitations.
    pub excitation: Excitation,
    /// What is measured.
    pub measure: Measure,
}

impl Vibration {
    /// The output as a displacement.
    #[must_use]
    pub fn new<M>(output: Output<M>, excitation: Excitation<M>) -> Self {
        Self { output: output.any(), excitation: excitation.any(), measure: Measure::Displacement }
    }

    /// Every output under every harmonic, as a displacement.
    #[must_use]
    pub fn all(of: &Description) -> Vec<Self> {
        let harmonics = of.excitations.iter().enumerate();
        let firsts = harmonics.filter(|(k, info)| info.with == *k);
        let each = |(k, _)| {
            let outputs = (0..of.outputs.len()).map(Output::<Any>::new);
            outputs.map(move |output| Self::new(output, Excitation::new(k)))
        };
        firsts.flat_map(each).collect()
    }

    /// The output as a velocity or an acceleration.
    #[must_use]
    pub fn measure(self, measure: Measure) -> Self {
        Self { measure, ..self }
    }

    /// The amplitude in a response.
    pub(crate) fn of(&self, response: &ForcedResponse) -> Option<f64> {
        let harmonic = self.place(&response.description)?;
        let amplitude = response.harmonics.get(harmonic)?.amplitude(self.output, self.measure)?;
        Some(amplitude.norm()).filter(|value| value.is_finite())
    }

    /// The amplitude with its total first and second derivatives; `None` where it has none.
    #[expect(clippy::type_complexity, reason = "a value and its derivatives")]
    #[doc(hidden)]
    pub fn quadratic(
        &self,
        mechanism: &dyn CurvatureKernels,
        at: &Equilibrium,
    ) -> Result<Option<((f64, Slopes<f64>), SecondDerivatives<f64>)>, Error> {
        let all = second_derivatives(mechanism, at)?;
        let model = || {
            let (harmonic, output) = (self.place(&at.description)?, self.output);
            let value = self.of(&all.first.response)?;
            let first = all.first.modulus(harmonic, output, self.measure)?;
            let second = all.modulus(harmonic, output, self.measure)?;
            Some(((value, first), second))
        };
        Ok(model())
    }

    /// Refuses handles of another mechanism.
    pub(crate) fn check(&self, of: &Description) -> Result<(), Error> {
        check_output(self.output, of)?;
        let (index, count) = (self.excitation.index(), of.excitations.len());
        match index < count {
            true => Ok(()),
            false => Err(Error::UnknownHandle { kind: "excitation", index, mechanism: of.name.clone(), count }),
        }
    }

    /// The position of its harmonic.
    pub(crate) fn place(&self, of: &Description) -> Option<usize> {
        let with = of.excitations.get(self.excitation.index())?.with;
        let firsts = of.excitations.iter().enumerate().take(with + 1);
        firsts.filter(|(k, info)| info.with == *k).count().checked_sub(1)
    }

    pub(crate) fn name(&self, of: &Description) -> String {
        let output = of.outputs.get(self.output.index());
        let output = output.map_or("?", |info| &*info.name);
        let with = of.excitations.get(self.excitation.index()).map(|info| info.with);
        let members = of.excitations.iter().filter(|info| Some(info.with) == with);
        let names: Vec<&str> = members.map(|info| &*info.name).collect();
        let measure = match self.measure {
            Measure::Displacement => "",
            Measure::Velocity => "rate of ",
            Measure::Acceleration => "acceleration of ",
        };
        format!("{measure}{output} under {}", names.join(", "))
    }

    pub(crate) fn unit(&self, of: &Description) -> Option<Unit> {
        let unit = &of.outputs.get(self.output.index())?.unit;
        // Velocities of what moves by lengths are in mm/s or inches a second, as the standards state them.
        let (per, length) = match self.measure {
            Measure::Displacement => return Some(unit.clone()),
            Measure::Velocity => ("/s", ("mm", 1e-3)),
            Measure::Acceleration => ("/s^2", ("m", 1.0)),
        };
        let length = match &*unit.symbol {
            "m" | "dm" | "cm" | "mm" | "um" | "nm" => Some(length),
            "inch" | "mil" => Some(("inch", 0.0254)),
            _ => None,
        };
        if let Some((symbol, scale)) = length {
            return Some(Unit { symbol: Text::from(format!("{symbol}{per}")), scale });
        }
        let symbol = match &*unit.symbol {
            "" => format!("1{per}"),
            symbol => format!("{symbol}{per}"),
        };
        Some(Unit { symbol: Text::from(symbol), scale: unit.scale })
    }
}

pub(crate) fn check_output(output: Output, description: &Description) -> Result<(), Error> {
    let (index, count) = (output.index(), description.outputs.len());
    if index < count {
        return Ok(());
    }
    Err(Error::UnknownHandle { kind: "output", index, mechanism: description.name.clone(), count })
}
