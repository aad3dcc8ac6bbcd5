//! How vectors of modes are normalised.

use crate::algebra::{Matrix, times_complex};
use crate::constraints::Structure;
use crate::{Complex, Description};

/// How the vectors of a mode are normalised.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub enum Normalisation {
    /// `x^H Mhat x = 1`, with the leading component real and positive.
    Mass,
    /// The leading component is one: with speeds or constraints on velocities a mode may move no mass that `Mhat`
    /// contains.
    Largest,
}

/// Number of first components among which the leading (largest) one is sought, for either vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct Leading {
    #[doc(hidden)]
    pub right: usize,
    #[doc(hidden)]
    pub left: usize,
}

impl Normalisation {
    /// The normalisation for the modes of a mechanism. The leading component belongs to a coordinate or a speed. For
    /// left vectors with speeds or constraints on velocities it may belong to any unknown, because such a vector may
    /// consist of reactions only.
    #[doc(hidden)]
    pub fn of(description: &Description) -> (Self, Leading) {
        let structure = Structure::of(description);
        let motions = if structure.open() { usize::MAX } else { structure.motions() };
        if structure.holonomic() {
            let leading = Leading { right: motions, left: motions };
            (Self::Mass, leading)
        } else {
            let leading = Leading { right: motions, left: description.coordinates.len() };
            (Self::Largest, leading)
        }
    }
}

/// Normalises a vector of an open mechanism: `x^H Mhat x = 1`, its largest component real and positive.
pub(super) fn normalise_by_mass(x: &mut [Complex], mass: &Matrix) -> bool {
    let all = x.len();
    normalise(x, mass, Normalisation::Mass, all)
}

/// Normalises a vector; the first `leading` components fix the phase.
pub(super) fn normalise(x: &mut [Complex], mass: &Matrix, size: Normalisation, leading: usize) -> bool {
    let lead = lead(&x[..leading.min(x.len())]);
    let Some(most) = x.get(lead).copied().filter(|value| value.norm() > 0.0) else {
        return false;
    };
    let factor = match size {
        Normalisation::Largest => most.inv(),
        Normalisation::Mass => {
            let weighted = times_complex(mass, x);
            let square: f64 = x.iter().zip(&weighted).map(|(x, w)| (x.conj() * w).re).sum();
            most.conj() / (most.norm() * square.sqrt())
        }
    };
    for value in x.iter_mut() {
        *value *= factor;
    }
    x[lead].im = 0.0;
    x.iter().all(|value| value.is_finite())
}

/// Position of the component that fixes the phase of a vector: the largest one, with a margin that keeps the choice
/// stable when two are equal up to rounding.
pub fn lead(x: &[Complex]) -> usize {
    let mut lead = 0;
    for (i, value) in x.iter().enumerate().skip(1) {
        if value.norm() > x[lead].norm() * (1.0 + 1e-9) {
            lead = i;
        }
    }
    lead
}
