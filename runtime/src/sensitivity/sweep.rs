//! Derivatives along an input.

use super::Sensitivities;
use crate::equilibrium::{Following, SweepPoint, Tracker, check_input, follow};
use crate::{Error, Input, Mechanism};

/// Solves equilibrium, modes and their total derivatives at each of `values` of one input, and shows them to `each` in order:
/// the fastest way to derivatives along an input, because neighbouring values are solved side by side and nothing is kept.
///
/// Arguments as for [`sweep`](crate::equilibrium::sweep), which keeps its points and looks for critical states between
/// them; states and modes are the same. Derivatives are those of [`sensitivities`](super::sensitivities), or its error.
///
/// # Errors
/// [`Error::UnknownHandle`] for an input that the mechanism does not have.
pub fn sensitivity_sweep<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    (u, b): (&[f64; U], &[f64; P]),
    start: &[f64; N],
    following: impl Into<Following>,
    (input, values): (Input, &[f64]),
    mut each: impl FnMut(&SweepPoint<N, U, P>, &Result<Sensitivities<N, U, P>, Error>),
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    check_input::<U>(input, M::DESCRIPTION.name)?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following.into(), input);
    follow::<true, M, N, U, P, O>(&mut tracker, values, |station| {
        if let Some(slopes) = &station.slopes {
            each(&station.point, slopes);
        }
    });
    Ok(())
}
