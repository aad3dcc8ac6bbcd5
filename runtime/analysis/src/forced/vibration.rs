//! The vibration of one output.

use super::curvature::{ForcedCurvature, second_derivatives};
use super::extent::{Extent, Part, each};
use super::measure::Measure;
use super::response::ForcedResponse;
use super::sensitivities::ForcedSensitivities;
use crate::kernels::CurvatureKernels;
use crate::second_order::SecondDerivatives;
use crate::sensitivity::Slopes;
use crate::{Any, Complex, Description, Equilibrium, Error, Excitation, Output, Text, Unit};

/// The vibration of an output under all excitations that have one frequency, or of what is made of several of these.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vibration {
    /// The output.
    pub output: Output,
    /// One of the excitations.
    pub excitation: Excitation,
    /// What is measured.
    pub measure: Measure,
    /// What of it counts.
    #[cfg_attr(feature = "serde", serde(default))]
    pub extent: Extent,
}

impl Vibration {
    /// The output as a displacement.
    #[must_use]
    pub fn new<M>(output: Output<M>, excitation: Excitation<M>) -> Self {
        let (measure, extent) = (Measure::Displacement, Extent::Amplitude);
        Self { output: output.any(), excitation: excitation.any(), measure, extent }
    }

    /// Every output under every harmonic, as a displacement.
    #[must_use]
    pub fn all(of: &Description) -> Vec<Self> {
        let each =
            |k| (0..of.outputs.len()).map(Output::<Any>::new).map(move |output| Self::new(output, Excitation::new(k)));
        Self::firsts(of).flat_map(each).collect()
    }

    /// The first excitation of each harmonic.
    pub(crate) fn firsts(of: &Description) -> impl Iterator<Item = usize> + '_ {
        of.excitations.iter().enumerate().filter(|(k, info)| info.with == *k).map(|(k, _)| k)
    }

    /// The output as a velocity or an acceleration.
    #[must_use]
    pub fn measure(self, measure: Measure) -> Self {
        Self { measure, ..self }
    }

    /// A semi-axis of an orbit, or what all excitations do together.
    #[must_use]
    pub fn extent(self, extent: Extent) -> Self {
        Self { extent, ..self }
    }

    /// What its extent is made of; `None` for handles of another mechanism.
    pub(crate) fn parts(&self, of: &Description) -> Option<Vec<Part>> {
        let one = |harmonic| Part { harmonic, terms: vec![(self.output, Complex::new(1.0, 0.0))] };
        Some(match self.extent {
            Extent::Amplitude => vec![one(self.place(of)?)],
            Extent::Major(other) | Extent::Minor(other) => {
                let harmonic = self.place(of)?;
                let circle = |turn| Part {
                    harmonic,
                    terms: vec![(self.output, Complex::new(0.5, 0.0)), (other, Complex::new(0.0, turn))],
                };
                vec![circle(0.5), circle(-0.5)]
            }
            Extent::Sum | Extent::Rms => (0..Self::firsts(of).count()).map(one).collect(),
        })
    }

    /// Its value in a response, SI; `None` where it has none.
    #[must_use]
    pub fn of(&self, response: &ForcedResponse) -> Option<f64> {
        self.value(&response.description, |harmonic, output| {
            response.harmonics.get(harmonic)?.amplitude(output, self.measure)
        })
    }

    /// The phase of an amplitude, rad; `None` for what is made of several.
    #[must_use]
    pub fn phase(&self, response: &ForcedResponse) -> Option<f64> {
        self.extent.phase(&self.amplitudes(response)?)
    }

    /// Its value, from the measured amplitudes of an output of a harmonic.
    #[doc(hidden)]
    pub fn value(&self, d: &Description, of: impl Fn(usize, Output) -> Option<Complex>) -> Option<f64> {
        let part = |part: Part| part.of(|output| of(part.harmonic, output));
        let parts: Option<Vec<Complex>> = self.parts(d)?.into_iter().map(part).collect();
        Some(self.extent.value(&parts?)).filter(|value| value.is_finite())
    }

    /// The harmonics that it contains.
    #[doc(hidden)]
    #[must_use]
    pub fn harmonics(&self, d: &Description) -> Vec<usize> {
        self.parts(d).into_iter().flatten().map(|part| part.harmonic).collect()
    }

    /// The complex amplitudes of its parts.
    fn amplitudes(&self, response: &ForcedResponse) -> Option<Vec<Complex>> {
        let part = |part: Part| {
            let harmonic = response.harmonics.get(part.harmonic)?;
            part.of(|output| harmonic.amplitude(output, self.measure))
        };
        self.parts(&response.description)?.into_iter().map(part).collect()
    }

    /// Its total derivatives; `None` where it has none.
    #[must_use]
    pub fn slopes(&self, all: &ForcedSensitivities) -> Option<Slopes<f64>> {
        let y = self.amplitudes(&all.response)?;
        let slopes = each(&self.first(all)?, |dy| self.extent.slope(&y, dy));
        let finite = slopes.iter().all(f64::is_finite);
        finite.then_some(slopes)
    }

    /// The derivatives of its parts.
    fn first(&self, all: &ForcedSensitivities) -> Option<Vec<Slopes<Complex>>> {
        let part = |part: Part| {
            let terms = part.terms.iter().map(|(output, _)| all.complex(part.harmonic, *output, self.measure));
            let sum = |dy: &[Complex]| part.terms.iter().zip(dy).map(|((_, factor), dy)| factor * dy).sum();
            Some(each(&terms.collect::<Option<Vec<_>>>()?, sum))
        };
        self.parts(&all.response.description)?.into_iter().map(part).collect()
    }

    /// Its value with its total first and second derivatives; `None` where it has none.
    #[expect(clippy::type_complexity, reason = "a value and its derivatives")]
    #[doc(hidden)]
    pub fn quadratic(
        &self,
        mechanism: &dyn CurvatureKernels,
        at: &Equilibrium,
    ) -> Result<Option<((f64, Slopes<f64>), SecondDerivatives<f64>)>, Error> {
        let all = second_derivatives(mechanism, at)?;
        let model = || {
            let value = self.of(&all.first.response)?;
            let first = self.slopes(&all.first)?;
            let second = self.curvature(&all)?;
            Some(((value, first), second))
        };
        Ok(model())
    }

    fn curvature(&self, all: &ForcedCurvature) -> Option<SecondDerivatives<f64>> {
        let (y, first) = (self.amplitudes(&all.first.response)?, self.first(&all.first)?);
        let terms: Vec<_> = (self.parts(&all.first.response.description)?.iter().enumerate())
            .flat_map(|(k, part)| part.terms.iter().map(move |(output, factor)| (part.harmonic, *output, (k, *factor))))
            .collect();
        let second = terms.iter().map(|(harmonic, output, _)| all.complex(*harmonic, *output, self.measure));
        let second: Vec<_> = second.collect::<Option<_>>()?;
        Some(SecondDerivatives::each(&second, &first, |a, b, each| {
            let mut ab = vec![Complex::ZERO; y.len()];
            terms.iter().zip(each).for_each(|((.., (k, factor)), own)| ab[*k] += factor * own);
            self.extent.curvature(&y, [a, b], &ab)
        }))
    }

    /// Refuses handles of another mechanism.
    pub(crate) fn check(&self, of: &Description) -> Result<(), Error> {
        check_output(self.output, of)?;
        if let Extent::Major(other) | Extent::Minor(other) = self.extent {
            check_output(other, of)?;
        }
        let (index, count) = (self.excitation.index(), of.excitations.len());
        if index < count {
            Ok(())
        } else {
            Err(Error::UnknownHandle { kind: "excitation", index, mechanism: of.name.clone(), count })
        }
    }

    /// The position of its harmonic.
    pub(crate) fn place(&self, of: &Description) -> Option<usize> {
        let with = of.excitations.get(self.excitation.index())?.with;
        of.excitations.iter().enumerate().take(with + 1).filter(|(k, info)| info.with == *k).count().checked_sub(1)
    }

    pub(crate) fn name(&self, of: &Description) -> String {
        let named = |output: Output| of.outputs.get(output.index()).map_or("?", |info| &*info.name);
        let output = named(self.output);
        let output = match self.extent {
            Extent::Amplitude => output.to_owned(),
            Extent::Major(other) => format!("major({output}, {})", named(other)),
            Extent::Minor(other) => format!("minor({output}, {})", named(other)),
            Extent::Sum => format!("sum of {output}"),
            Extent::Rms => format!("rms of {output}"),
        };
        let with = of.excitations.get(self.excitation.index()).map(|info| info.with);
        let all = matches!(self.extent, Extent::Sum | Extent::Rms);
        let members = of.excitations.iter().filter(|info| all || Some(info.with) == with);
        let names: Vec<&str> = members.map(|info| &*info.name).collect();
        let measure = match self.measure {
            Measure::Displacement => "",
            Measure::OfLimit { .. } => return format!("{output} under {} over its limit", names.join(", ")),
            Measure::Velocity => "velocity of ",
            Measure::Acceleration => "acceleration of ",
        };
        format!("{measure}{output} under {}", names.join(", "))
    }

    pub(crate) fn unit(&self, of: &Description) -> Option<Unit> {
        let unit = &of.outputs.get(self.output.index())?.unit;
        // Velocities of what moves by lengths are in mm/s or inches a second, as the standards state them.
        let (per, length) = match self.measure {
            Measure::Displacement => return Some(unit.clone()),
            Measure::OfLimit { .. } => return Some(Unit::si("")),
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
