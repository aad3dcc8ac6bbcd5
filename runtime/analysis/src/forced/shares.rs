//! Derivatives of what each excitation contributes.

use super::response::{Harmonic, Solved, Vibration};
use super::sensitivities::{ForcedSensitivities, first_derivatives};
use crate::kernels::Kernels;
use crate::{Equilibrium, Error};

/// The share of each excitation and its total derivatives by every input and design variable: as
/// [`sensitivities`](super::sensitivities), with a harmonic for every excitation alone, in the order of their
/// declaration.
///
/// # Errors
/// As [`sensitivities`](super::sensitivities).
pub fn share_sensitivities(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<ForcedSensitivities, Error> {
    let mut solved = Solved::new(mechanism, at)?;
    let mut each: Vec<Vibration> = solved.vibrations.iter().flat_map(alone).collect();
    each.sort_by_key(|x| x.harmonic.shares[0].excitation);
    solved.vibrations = each;
    Ok(ForcedSensitivities { harmonics: first_derivatives(&solved)?, response: solved.response() })
}

/// The vibrations that the excitations of a harmonic cause by themselves.
fn alone(of: &Vibration) -> impl Iterator<Item = Vibration> {
    let shares = of.harmonic.shares.iter();
    shares.map(|share| Vibration {
        harmonic: Harmonic {
            frequency: of.harmonic.frequency,
            outputs: share.outputs.clone(),
            unknowns: share.unknowns.clone(),
            shares: vec![share.clone()],
        },
        stiffness: of.stiffness.clone(),
        seen: of.seen.clone(),
    })
}
