//! The response to all excitations at one equilibrium.

use std::rc::Rc;

use super::dynamic_stiffness::DynamicStiffness;
use super::forces::{Forces, Seen};
use super::measure::Measure;
use crate::algebra::{Matrix, Vector, largest, product_complex};
use crate::constraints::{Structure, Tangent};
use crate::kernels::Kernels;
use crate::modes::modes;
use crate::sensitivity::{check_state, outside_domain};
use crate::shafts::ShaftSlopes;
use crate::{Complex, Description, Equilibrium, Error, Excitation, Output, Shared};

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
    /// Amplitude of each output, in its unit (SI); `None` if it has a value but no derivative, like the length of a
    /// vector that is zero: it does not vibrate with this frequency.
    pub outputs: Vec<Option<Complex>>,
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
    /// Amplitude of each output, in its unit (SI); `None` as for all excitations together.
    pub outputs: Vec<Option<Complex>>,
    /// Amplitude of each unknown, SI.
    pub unknowns: Vector<Complex>,
}

impl Share {
    /// The sign of the declared frequency.
    pub(super) fn turn(&self) -> f64 {
        if self.reversed { -1.0 } else { 1.0 }
    }
}

impl ForcedResponse {
    /// The harmonic of an excitation; `None` for one of another mechanism.
    #[must_use]
    pub fn harmonic<M>(&self, excitation: Excitation<M>) -> Option<&Harmonic> {
        let drives = |share: &Share| share.excitation == excitation.index();
        self.harmonics.iter().find(|harmonic| harmonic.shares.iter().any(drives))
    }
}

impl Harmonic {
    /// The complex amplitude of an output as a displacement, velocity or acceleration; `None` for an output that has no
    /// derivative, and for one of another mechanism.
    #[must_use]
    pub fn amplitude(&self, output: Output, measure: Measure) -> Option<Complex> {
        let y = (*self.outputs.get(output.index())?)?;
        Some(measure.of(self.frequency, y))
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
/// excitation drives a mode without damping at its natural frequency, [`Error::Unphysical`] if a force is not finite,
/// [`Error::SingularConfiguration`], [`Error::ClosesHereOnly`] if redundant constraints contradict each other while they
/// are shaken.
pub fn response(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<ForcedResponse, Error> {
    Ok(Solved::new(mechanism, at)?.response())
}

/// The response with all that its derivatives need.
pub(super) struct Solved<'a> {
    pub(super) mechanism: &'a dyn Kernels,
    pub(super) at: &'a Equilibrium,
    pub(super) seen: Seen,
    /// Whether each output has a derivative.
    pub(super) smooth: Vec<bool>,
    pub(super) vibrations: Vec<Vibration>,
    pub(super) shafts: Option<Box<ShaftSlopes>>,
}

/// A harmonic and the factors of its dynamic stiffness.
pub(super) struct Vibration {
    pub(super) harmonic: Harmonic,
    pub(super) stiffness: Rc<DynamicStiffness>,
    /// How the outputs see the vibration, one row each; zeros for one without derivative.
    pub(super) seen: Matrix<Complex>,
}

impl<'a> Solved<'a> {
    pub(super) fn new(mechanism: &'a dyn Kernels, at: &'a Equilibrium) -> Result<Self, Error> {
        check_state(mechanism, at)?;
        at.regular()?;
        let infos = &at.description.excitations;
        if infos.is_empty() {
            return Err(Error::NoExcitation { mechanism: at.description.name.clone() });
        }
        let forces = Forces::of(mechanism, at);
        for (k, info) in infos.iter().enumerate() {
            let frequency = forces.frequency(k).abs();
            // At zero, the amplitude that belongs to a velocity is infinite too.
            if frequency == 0.0 {
                return Err(Error::NoFrequency { excitation: info.name.clone() });
            }
            if let Some(value) = forces.infinite(k) {
                return Err(Error::Unphysical {
                    quantity: format!("the force of `{}` at {frequency} rad/s", info.name).into(),
                    requirement: "finite".into(),
                    value,
                });
            }
        }
        closes(at, &forces)?;
        let mut seen = Seen::of(mechanism, at);
        let smooth = seen.without_rough(&forces);
        let shafts = ShaftSlopes::of(mechanism, at)?;
        let mut vibrations: Vec<Vibration> = Vec::new();
        for first in (0..infos.len()).filter(|&k| infos[k].with == k) {
            let frequency = forces.frequency(first).abs();
            let same = |vibration: &&Vibration| vibration.harmonic.frequency == frequency;
            let stiffness = match vibrations.iter().find(same) {
                Some(vibration) => vibration.stiffness.clone(),
                None => {
                    let dynamic_stiffness = DynamicStiffness::new(
                        &at.linear,
                        shafts.as_ref().map(|own| &own.shafts),
                        Complex::new(0.0, frequency),
                    );
                    Rc::new(dynamic_stiffness.ok_or_else(|| resonance(at, first, frequency))?)
                }
            };
            let members = (first..infos.len()).filter(|&k| infos[k].with == first);
            let rows = seen.rows(Complex::new(0.0, frequency));
            let shares = shares(at, &forces, members.collect(), (&stiffness, &rows, &smooth));
            let shares = shares.map_err(|driven| resonance(at, driven, frequency))?;
            vibrations.push(Vibration { harmonic: superposed(mechanism, frequency, shares), stiffness, seen: rows });
        }
        Ok(Self { mechanism, at, seen, smooth, vibrations, shafts })
    }

    /// Why derivatives are not finite: an output that has none by the value of the state is in the way of all.
    pub(super) fn not_finite(&self) -> Error {
        let mut outputs = self.at.description.outputs.iter().zip(&self.smooth);
        match outputs.find(|(_, smooth)| !**smooth) {
            Some((info, _)) => Error::NotSmooth { output: info.name.clone() },
            None => outside_domain(self.at),
        }
    }

    pub(super) fn response(self) -> ForcedResponse {
        let each = self.vibrations.into_iter();
        ForcedResponse {
            harmonics: each.map(|x| x.harmonic).collect(),
            inputs: self.at.inputs.clone(),
            description: self.at.description.clone(),
        }
    }
}

/// Share of a gap that redundant constraints may disagree by: rounding.
const ROUNDING: f64 = 1e-9;
/// Share of a null vector below which a constraint takes no part in it.
const TAKES_PART: f64 = 1e-10;

/// Checks that redundant constraints agree while they are shaken: with `n` a left null vector of the constraints on
/// positions and velocities, the gaps that an excitation opens cancel, those of positions as velocities.
fn closes(at: &Equilibrium, forces: &Forces) -> Result<(), Error> {
    if at.constraints.redundant == 0 {
        return Ok(());
    }
    let structure = Structure::of(&at.description);
    let tangent = Tangent::new(&at.linear, structure);
    for n in (0..tangent.redundant()).map(|k| tangent.null_left(k)) {
        for (excitation, info) in at.description.excitations.iter().enumerate() {
            let s = Complex::new(0.0, forces.frequency(excitation));
            let gaps = forces.force(excitation, 1.0);
            let opened =
                |i: usize| if structure.position_rows().contains(&i) { s * n[i] * gaps[i] } else { n[i] * gaps[i] };
            let rows = (structure.motions()..n.len()).filter(|i| n[*i].abs() > TAKES_PART * largest(&n));
            let all: Complex = rows.clone().map(opened).sum();
            let size = rows.clone().map(|i| opened(i).norm()).sum::<f64>();
            if all.norm() > ROUNDING * size {
                let most = |a: &usize, b: &usize| opened(*a).norm().total_cmp(&opened(*b).norm());
                let constraint = rows.max_by(most).unwrap_or_default();
                return Err(Error::ClosesHereOnly {
                    constraint: at.description.unknown_name(constraint),
                    variable: info.name.clone(),
                });
            }
        }
    }
    Ok(())
}

/// The responses to excitations of one frequency; an error is an excitation in resonance.
fn shares(
    at: &Equilibrium,
    forces: &Forces,
    members: Vec<usize>,
    (stiffness, seen, smooth): (&DynamicStiffness, &Matrix<Complex>, &[bool]),
) -> Result<Vec<Share>, usize> {
    let turn = |excitation: usize| if forces.frequency(excitation) < 0.0 { -1.0 } else { 1.0 };
    let each = members.iter().map(|&member| forces.force(member, turn(member)));
    let each: Vec<Vector<Complex>> = each.collect();
    if let Some(driven) = each.iter().position(|force| stiffness.driven_by(force)) {
        return Err(members[driven]);
    }
    let forced = Matrix::from_fn(at.coordinates.len(), each.len(), |i, k| each[k][i]);
    let unknowns = stiffness.solve(&forced);
    let seen = product_complex(seen, &unknowns);
    let share = |(k, excitation): (usize, usize)| {
        let mut outputs = forces.direct(excitation, turn(excitation));
        add(&mut outputs, &seen.column(k));
        let outputs = outputs.iter().zip(smooth);
        Share {
            excitation,
            reversed: turn(excitation) < 0.0,
            outputs: outputs.map(|(y, smooth)| smooth.then_some(*y)).collect(),
            unknowns: unknowns.column(k),
        }
    };
    Ok(members.into_iter().enumerate().map(share).collect())
}

fn superposed(mechanism: &dyn Kernels, frequency: f64, shares: Vec<Share>) -> Harmonic {
    let sizes = mechanism.sizes();
    let mut outputs = vec![Some(Complex::ZERO); sizes.outputs];
    let mut unknowns = Vector::zeros(sizes.coordinates);
    for share in &shares {
        for (sum, y) in outputs.iter_mut().zip(&share.outputs) {
            *sum = sum.zip(*y).map(|(sum, y)| sum + y);
        }
        add(&mut unknowns, &share.unknowns);
    }
    Harmonic { frequency, outputs, unknowns, shares }
}

pub(super) fn add(sum: &mut [Complex], values: &[Complex]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// Relative distance within which a natural frequency is that of a resonance.
const NEAR: f64 = 1e-6;

/// The error of a resonance, with the mode at this frequency if there is one.
pub(crate) fn resonance(at: &Equilibrium, excitation: usize, frequency: f64) -> Error {
    let mode = modes(at).ok().and_then(|modes| {
        let frequencies = modes.frequencies().into_iter().enumerate();
        let away = frequencies.filter_map(|(mode, x)| Some((mode, (x? - frequency).abs())));
        let nearest = away.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (nearest.1 <= NEAR * frequency).then_some(nearest.0)
    });
    Error::Resonance { excitation: at.description.excitations[excitation].name.clone(), frequency, mode }
}
