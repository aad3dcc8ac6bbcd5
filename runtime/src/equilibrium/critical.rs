//! Values of an input where something happens on a branch of equilibria: stiffness vanishes (critical speed), or a
//! frequency meets a multiple of the input (resonance).

use super::branch::{BranchEnd, Continuation, Curve, SpecialKind, SpecialPoint, Station};
use super::continuation::{check_input, follow};
use super::root::{Bracket, refine};
use super::{Policy, equilibrium};
use crate::modes::modes;
use crate::{Equilibrium, Error, Input, Mechanism, Modes};

/// Where to look: `steps` equal steps of one input from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The input that varies.
    pub input: Input,
    /// Where the search starts, SI.
    pub low: f64,
    /// Where it ends, SI.
    pub high: f64,
    /// Number of steps; two events within one step are not told apart.
    pub steps: usize,
}

/// A state where `Khat` is singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalState<const N: usize, const U: usize, const P: usize> {
    /// The input that was varied.
    pub input: Input,
    /// Its critical value, SI.
    pub value: f64,
    /// What happens to the branch there.
    pub kind: SpecialKind,
    /// The equilibrium there, on the branch that is stable below; its critical mode counts as neutral.
    pub equilibrium: Equilibrium<N, U, P>,
    /// Critical vector: `Khat v = 0`, `v^T Mhat v = 1`, largest component positive; one of them when degenerate.
    pub v: [f64; N],
    /// Left critical vector: `Khat^T w = 0`, `w^T Mhat v = 1`; equal to `v` for a symmetric `Khat`.
    pub w: [f64; N],
}

/// A state where `omega_j = ratio * input`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<const N: usize, const U: usize, const P: usize> {
    /// The input that was varied.
    pub input: Input,
    /// Its value at the crossing, SI.
    pub value: f64,
    /// `k` in `omega_j = k u`.
    pub ratio: f64,
    /// Position of the mode in `modes`.
    pub mode: usize,
    /// The equilibrium there.
    pub equilibrium: Equilibrium<N, U, P>,
    /// The modes there, in the order they have at the start of the range.
    pub modes: Modes<N>,
}

/// Least and greatest step of the continuation, whatever the number of steps that is asked for.
const FINEST_STEP: f64 = 1e-4;
const COARSEST_STEP: f64 = 0.05;
/// Most points of the continuation.
const MOST_POINTS: usize = 50_000;

type State<const N: usize, const U: usize, const P: usize> = (Equilibrium<N, U, P>, Modes<N>);

/// Finds the first value of an input at which the branch that is stable at `range.low` loses its stiffness: a limit
/// point or a branch point, located to rounding.
///
/// The branch itself is followed, by continuation with steps of at most the `steps`-th part of the range, also where a
/// neighbouring one is the stable one. A branch that runs to infinity is not critical. A non-symmetric `Khat` is critical
/// where its determinant changes sign.
///
/// # Errors
/// [`Error::NotInRange`] when the branch keeps its stiffness; where it cannot be followed so far, the reason;
/// otherwise as [`equilibrium`].
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
    check_range::<U>(&range, M::DESCRIPTION.name)?;
    let settings = Continuation {
        max_step: (1.0 / range.steps as f64).clamp(FINEST_STEP, COARSEST_STEP),
        max_points: MOST_POINTS,
        ..Continuation::new(range.input, range.low, range.high)
    };
    settings.check::<U>(M::DESCRIPTION.name)?;
    let curve = Curve {
        mechanism,
        inputs: u,
        design: b,
        settings: &settings,
    };
    let inputs = curve.inputs_at(range.low);
    let state = equilibrium(mechanism, &inputs, b, start, Policy::Stable)?;
    let mut found = None;
    let end = match curve.begin(state) {
        Ok(station) => {
            let stop = |special: &SpecialPoint<N, U, P>, before: &Station<N, U, P>| {
                if before.stiff() {
                    found = Some(*special);
                }
                found.is_some()
            };
            curve.walk(&station, &station.place, stop).end
        }
        Err(trouble) => curve.broken_off(trouble, &state),
    };
    match (found, end) {
        (Some(special), _) => Ok(CriticalState {
            input: range.input,
            value: special.value,
            kind: special.kind,
            equilibrium: special.equilibrium,
            v: special.v,
            w: special.w,
        }),
        (None, BranchEnd::Domain(error) | BranchEnd::Lost(error)) => Err(error),
        (None, _) => Err(not_in_range(
            "critical value",
            M::DESCRIPTION.inputs,
            &range,
        )),
    }
}

/// Finds every value of an input in a range at which a frequency equals `ratio` times the input, on the branch that
/// `policy` follows; modes keep their identity along the range. Points without an equilibrium or without modes are
/// passed over.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`], and those of the first point.
pub fn crossings<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    policy: Policy,
    range: Range,
    ratio: f64,
) -> Result<Vec<Crossing<N, U, P>>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    check_range::<U>(&range, M::DESCRIPTION.name)?;
    let solve = |value: f64,
                 from: &[f64; N],
                 reference: &mut Option<Modes<N>>|
     -> Result<State<N, U, P>, Error> {
        let mut inputs = *u;
        inputs[range.input.0] = value;
        let state = equilibrium(mechanism, &inputs, b, from, policy)?;
        let found = modes(&state)?;
        let found = follow(reference, found, &state);
        Ok((state, found))
    };
    let excess = |state: &State<N, U, P>, mode: usize| {
        let omega = state.1.modes[mode].frequency()?;
        Some(omega - ratio * state.0.inputs[range.input.0])
    };
    let mut reference = None;
    let mut last = solve(range.low, start, &mut reference)?;
    let mut found = Vec::new();
    for value in steps(&range) {
        let Ok(next) = solve(value, &last.0.coordinates, &mut reference) else {
            continue;
        };
        for mode in 0..N {
            let (Some(at_low), Some(at_high)) = (excess(&last, mode), excess(&next, mode)) else {
                continue;
            };
            if (at_low > 0.0) == (at_high > 0.0) {
                continue;
            }
            let bracket = Bracket {
                low: last.0.inputs[range.input.0],
                high: value,
                at_low,
                at_high,
            };
            let from = last.0.coordinates;
            let evaluate = |trial: f64| solve(trial, &from, &mut Some(last.1)).ok();
            let root = refine(bracket, |trial| excess(&evaluate(trial)?, mode));
            if let Some((state, modes)) = evaluate(root) {
                found.push(Crossing {
                    input: range.input,
                    value: root,
                    ratio,
                    mode,
                    equilibrium: state,
                    modes,
                });
            }
        }
        last = next;
    }
    Ok(found)
}

fn steps(range: &Range) -> impl Iterator<Item = f64> + use<> {
    let (low, high, count) = (range.low, range.high, range.steps);
    (1..=count).map(move |step| low + (high - low) * step as f64 / count as f64)
}

fn check_range<const U: usize>(range: &Range, mechanism: &'static str) -> Result<(), Error> {
    check_input::<U>(range.input, mechanism)?;
    let refused = if !(range.low.is_finite() && range.high.is_finite()) {
        "its ends must be finite"
    } else if range.low == range.high {
        "its ends must differ"
    } else if range.steps == 0 {
        "it needs at least one step"
    } else {
        return Ok(());
    };
    Err(Error::Setting {
        setting: "range",
        reason: refused.to_owned(),
    })
}

fn not_in_range(what: &'static str, inputs: &[crate::InputInfo], range: &Range) -> Error {
    Error::NotInRange {
        what,
        input: inputs.get(range.input.0).map_or("?", |info| info.name),
        low: range.low,
        high: range.high,
    }
}
