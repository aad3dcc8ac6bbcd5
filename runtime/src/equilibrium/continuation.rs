//! Sweeps of one input: each point starts from the equilibrium before it, and modes keep their identity.

use super::{Policy, Problem, equilibrium};
use crate::modes::{match_modes, modes};
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
    /// The modes there, in the order of the modes at the first point that has any: position `j` is one motion along
    /// the whole sweep, not the `j`-th frequency.
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
#[allow(clippy::too_many_arguments)]
pub fn sweep<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    policy: Policy,
    input: Input,
    values: &[f64],
) -> Result<Vec<SweepPoint<N, U, P>>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    check_input::<U>(input, M::DESCRIPTION.name)?;
    let description = Problem::unchecked(mechanism, u, b).description();
    let mut points = Vec::with_capacity(values.len());
    let mut from = *start;
    let mut reference: Option<Modes<N>> = None;
    for &value in values {
        let mut inputs = *u;
        inputs[input.0] = value;
        let solved = equilibrium(mechanism, &inputs, b, &from, policy);
        let found = match &solved {
            Ok(state) => modes(state).map(|found| follow(&mut reference, found, state)),
            Err(error) => Err(error.clone()),
        };
        if let Ok(state) = &solved {
            from = state.coordinates;
        }
        points.push(SweepPoint {
            input,
            value,
            equilibrium: solved,
            modes: found,
            description,
        });
    }
    Ok(points)
}

/// Reorders `found` to continue `reference`, which becomes the result.
pub(super) fn follow<const N: usize, const U: usize, const P: usize>(
    reference: &mut Option<Modes<N>>,
    found: Modes<N>,
    state: &Equilibrium<N, U, P>,
) -> Modes<N> {
    let ordered = match reference {
        Some(before) => found.reordered(&match_modes(before, &found, &state.linear.mass)),
        None => found,
    };
    *reference = Some(ordered);
    ordered
}

pub(super) fn check_input<const U: usize>(
    input: Input,
    mechanism: &'static str,
) -> Result<(), Error> {
    if input.0 < U {
        Ok(())
    } else {
        Err(Error::UnknownHandle {
            kind: "input",
            index: input.0,
            mechanism,
            count: U,
        })
    }
}
