//! Values of an input where stiffness vanishes on a branch of equilibria: critical speeds.

use super::range::Range;
use super::root::{Bracket, refine};
use super::{Policy, equilibrium};
use crate::modes::undamped_modes;
use crate::{Equilibrium, Error, Input, Mechanism, Modes};

/// A state where the lowest `lambda` is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalState<const N: usize, const U: usize, const P: usize> {
    /// The input that was varied.
    pub input: Input,
    /// Its critical value, SI.
    pub value: f64,
    /// The equilibrium there, on the branch that is stable below.
    pub equilibrium: Equilibrium<N, U, P>,
    /// The modes there, ascending: the first is the critical one.
    pub modes: Modes<N>,
}

type State<const N: usize, const U: usize, const P: usize> = (Equilibrium<N, U, P>, Modes<N>);

/// Finds the first value of an input at which the branch that is stable at `range.low` loses its stiffness.
///
/// The branch itself is followed, also where a neighbouring one is the stable one, so that the answer at a
/// bifurcation is the bifurcation. At a limit point, where the branch ends, the value is good to about 1e-9.
///
/// # Errors
/// [`Error::NotInRange`] when the branch keeps its stiffness; otherwise as [`equilibrium`] and [`modes`].
pub fn critical_state<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    range: Range,
) -> Result<CriticalState<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    range.check::<U>(M::DESCRIPTION.name)?;
    let solve = |value: f64, from: &[f64; N], policy: Policy| -> Result<State<N, U, P>, Error> {
        let mut inputs = *u;
        inputs[range.input.0] = value;
        let state = equilibrium(mechanism, &inputs, b, from, policy)?;
        let found = undamped_modes(&state)?;
        Ok((state, found))
    };
    let lowest = |state: &State<N, U, P>| state.1.modes.first().map_or(0.0, |mode| mode.lambda);
    let mut last = solve(range.low, start, Policy::Stable)?;
    let mut last_value = range.low;
    for value in range.steps() {
        let next = solve(value, &last.0.coordinates, Policy::Nearest);
        let at_next = match &next {
            Ok(state) => lowest(state),
            Err(Error::NoEquilibrium { .. }) => -lowest(&last),
            Err(error) => return Err(error.clone()),
        };
        if lowest(&last) >= 0.0 && at_next < 0.0 {
            let bracket = Bracket {
                low: last_value,
                high: value,
                at_low: lowest(&last),
                at_high: at_next,
            };
            let mut from = last.0.coordinates;
            let critical = refine(bracket, |trial| {
                let state = solve(trial, &from, Policy::Nearest).ok()?;
                if lowest(&state) > 0.0 {
                    from = state.0.coordinates;
                }
                Some((lowest(&state), None))
            });
            let (state, found) = solve(critical, &from, Policy::Nearest).unwrap_or(last);
            let value = state.inputs[range.input.0];
            return Ok(CriticalState {
                input: range.input,
                value,
                equilibrium: state,
                modes: found,
            });
        }
        last = next?;
        last_value = value;
    }
    Err(not_in_range(
        "critical value",
        M::DESCRIPTION.inputs,
        &range,
    ))
}

fn not_in_range(what: &'static str, inputs: &[crate::InputInfo], range: &Range) -> Error {
    Error::NotInRange {
        what,
        input: inputs.get(range.input.0).map_or("?", |info| info.name),
        low: range.low,
        high: range.high,
    }
}
