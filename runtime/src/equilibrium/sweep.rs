//! Sweeps of one input: each point starts from the equilibrium before it, and modes keep their identity.

use super::range::check_input;
use super::track::{Following, Tracker};
use crate::{Description, Equilibrium, Error, Input, Mechanism, Modes};

/// One point of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPoint<const N: usize, const U: usize, const P: usize> {
    /// The swept input.
    pub input: Input,
    /// Its value, SI.
    pub value: f64,
    /// The equilibrium, or why there is none.
    pub equilibrium: Result<Equilibrium<N, U, P>, Error>,
    /// The modes there: modes with one label are one motion along the whole sweep.
    pub modes: Result<Modes<N>, Error>,
    /// The mechanism it belongs to.
    pub description: &'static Description,
}

/// Solves equilibrium and modes at each of `values` of one input; the others keep their value in `u`.
///
/// The first point starts at `start`, each later one at the last equilibrium found. A point that fails carries its
/// error and the sweep goes on.
///
/// # Errors
/// [`Error::UnknownHandle`] for an input that the mechanism does not have.
pub fn sweep<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    following: impl Into<Following>,
    input: Input,
    values: &[f64],
) -> Result<Vec<SweepPoint<N, U, P>>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    check_input::<U>(input, M::DESCRIPTION.name)?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following.into(), input);
    let points = values.iter().map(|&value| {
        let (equilibrium, modes) = match tracker.advance(value) {
            Ok((state, modes)) => (Ok(state), modes),
            Err(error) => (Err(error.clone()), Err(error)),
        };
        SweepPoint {
            input,
            value,
            equilibrium,
            modes,
            description: const { &M::DESCRIPTION },
        }
    });
    Ok(points.collect())
}
