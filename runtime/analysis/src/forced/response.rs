//! The response to all excitations at one equilibrium.

use std::rc::Rc;

use super::dynamic_stiffness::DynamicStiffness;
use super::forces::{Forces, Seen};
use super::measure::Measure;
use crate::algebra::{Vector, dot_complex};
use crate::kernels::Kernels;
use crate::modes::modes;
use crate::sensitivity::check_state;
use crate::{Complex, Description, Equilibrium, Error, Output, Shared};

/// The steady vibration under all excitations: of each output and unknown, `Re(y e^{i w t})`, by harmonic.
///
/// Amplitudes are complex: the modulus is from 0 to peak, half of peak to peak; a positive phase leads.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForcedResponse {
    /// One entry for each frequency, in the order of the excitations.
    pub harmonics: Vec<Harmonic>,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// The vibration with one frequency: all excitations that share it in every design act together.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Harmonic {
    /// `w`, rad/s; positive.
    pub frequency: f64,
    /// Amplitude of each output, in its unit (SI).
    pub outputs: Vector<Complex>,
    /// Amplitude of each unknown: displacements of coordinates, speeds, reactions of constraints, SI.
    pub unknowns: Vector<Complex>,
    /// What each excitation contributes to both.
    pub shares: Vec<Share>,
}

/// What one excitation contributes to a vibration.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Share {
    /// Its position in [`Description::excitations`].
    pub excitation: usize,
    /// Its frequency is declared against the positive direction: `-w`.
    pub reversed: bool,
    /// Amplitude of each output, in its unit (SI).
    pub outputs: Vector<Complex>,
    /// Amplitude of each unknown, SI.
    pub unknowns: Vector<Complex>,
}

impl Share {
    /// The sign of the declared frequency.
    pub(super) fn turn(&self) -> f64 {
        if self.reversed { -1.0 } else { 1.0 }
    }
}

impl Harmonic {
    /// The complex amplitude of an output as a displacement, velocity or acceleration; `None` for an output of another
    /// mechanism.
    #[must_use]
    pub fn amplitude(&self, output: Output, measure: Measure) -> Option<Complex> {
        let y = self.outputs.get(output.index())?;
        Some(measure.of(self.frequency, *y))
    }

    /// `s = i w`.
    pub(super) fn s(&self) -> Complex {
        Complex::new(0.0, self.frequency)
    }
}

/// The vibration forced by all excitations about an equilibrium.
///
/// # Errors
/// [`Error::NoExcitation`], [`Error::NoFrequency`] for an excitation that stands still, [`Error::Resonance`] if an
/// excitation drives a mode without damping at its natural frequency, [`Error::OutsideDomain`] if a force is not finite,
/// [`Error::SingularConfiguration`].
pub fn response(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<ForcedResponse, Error> {
    Ok(Solved::new(mechanism, at)?.response())
}

/// The response with all that its derivatives need.
pub(super) struct Solved<'a> {
    pub(super) mechanism: &'a dyn Kernels,
    pub(super) at: &'a Equilibrium,
    pub(super) seen: Seen,
    pub(super) vibrations: Vec<Vibration>,
}

/// A harmonic and the factors of its dynamic stiffness.
pub(super) struct Vibration {
    pub(super) harmonic: Harmonic,
    pub(super) stiffness: Rc<DynamicStiffness>,
}

impl<'a> Solved<'a> {
    pub(super) fn new(mechanism: &'a dyn Kernels, at: &'a Equilibrium) -> Result<Self, Error> {
        check_state(mechanism, at)?;
        at.regular()?;
        let infos = &at.description.excitations;
        if infos.is_empty() {
            return Err(Error::NoExcitation {
                mechanism: at.description.name.clone(),
            });
        }
        let forces = Forces::of(mechanism, at);
        if !forces.finite() {
            return Err(Error::OutsideDomain {
                mechanism: at.description.name.clone(),
                what: "the force of an excitation",
                coordinates: at.coordinates.to_vec(),
            });
        }
        let seen = Seen::of(mechanism, at);
        let mut vibrations: Vec<Vibration> = Vec::new();
        for first in (0..infos.len()).filter(|&k| infos[k].with == k) {
            let frequency = forces.frequency(first).abs();
            if frequency == 0.0 {
                return Err(Error::NoFrequency {
                    excitation: infos[first].name.clone(),
                });
            }
            let same = |own: &&Vibration| own.harmonic.frequency == frequency;
            let stiffness = match vibrations.iter().find(same) {
                Some(own) => own.stiffness.clone(),
                None => {
                    let found = DynamicStiffness::new(&at.linear, Complex::new(0.0, frequency));
                    Rc::new(found.ok_or_else(|| resonance(at, first, frequency))?)
                }
            };
            let members = (first..infos.len()).filter(|&k| infos[k].with == first);
            let shares = members.map(|k| share(at, (&forces, &seen), (k, frequency), &stiffness));
            let shares: Vec<Share> = shares.collect::<Result<_, _>>()?;
            let harmonic = superposed(mechanism, frequency, shares);
            vibrations.push(Vibration {
                harmonic,
                stiffness,
            });
        }
        Ok(Self {
            mechanism,
            at,
            seen,
            vibrations,
        })
    }

    pub(super) fn response(&self) -> ForcedResponse {
        let each = self.vibrations.iter();
        ForcedResponse {
            harmonics: each.map(|own| own.harmonic.clone()).collect(),
            inputs: self.at.inputs.clone(),
            description: self.at.description.clone(),
        }
    }
}

/// The response to one excitation.
fn share(
    at: &Equilibrium,
    (forces, seen): (&Forces, &Seen),
    (excitation, frequency): (usize, f64),
    stiffness: &DynamicStiffness,
) -> Result<Share, Error> {
    let reversed = forces.frequency(excitation) < 0.0;
    let turn = if reversed { -1.0 } else { 1.0 };
    let unknowns = stiffness.solve(&forces.force(excitation, turn));
    let unknowns = unknowns.ok_or_else(|| resonance(at, excitation, frequency))?;
    let mut outputs = forces.direct(excitation, turn);
    for (o, y) in outputs.iter_mut().enumerate() {
        *y += dot_complex(&seen.row(o, Complex::new(0.0, frequency)), &unknowns);
    }
    Ok(Share {
        excitation,
        reversed,
        outputs,
        unknowns,
    })
}

fn superposed(mechanism: &dyn Kernels, frequency: f64, shares: Vec<Share>) -> Harmonic {
    let sizes = mechanism.sizes();
    let mut outputs = Vector::zeros(sizes.outputs);
    let mut unknowns = Vector::zeros(sizes.coordinates);
    for share in &shares {
        add(&mut outputs, &share.outputs);
        add(&mut unknowns, &share.unknowns);
    }
    Harmonic {
        frequency,
        outputs,
        unknowns,
        shares,
    }
}

fn add(sum: &mut [Complex], values: &[Complex]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// Relative distance within which a natural frequency is that of a resonance.
const NEAR: f64 = 1e-6;

/// The error of a resonance, with the mode at this frequency if there is one.
pub(crate) fn resonance(at: &Equilibrium, excitation: usize, frequency: f64) -> Error {
    let mode = modes(at).ok().and_then(|modes| {
        let own = modes.frequencies().into_iter().enumerate();
        let away = own.filter_map(|(mode, own)| Some((mode, (own? - frequency).abs())));
        let nearest = away.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (nearest.1 <= NEAR * frequency).then_some(nearest.0)
    });
    Error::Resonance {
        excitation: at.description.excitations[excitation].name.clone(),
        frequency,
        mode,
    }
}
