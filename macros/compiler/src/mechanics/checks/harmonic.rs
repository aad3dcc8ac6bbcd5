//! An excitation must be harmonic: as the running coordinates turn, its forces and its part of the outputs must not
//! change, or turn as a vector does, by a quarter of a period for a quarter of a turn.

use std::ops::Range;

use proc_macro2::Ident;

use crate::algebra::{ExprId, Graph, SymbolId};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::CoordinateId;
use crate::mechanics::equations::{Response, outputs};
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, at_rest, by_symbol, columns, vanish};
use crate::model::mechanism::{Excitation, ExcitationLaw, Frame, JointStep, StepMotion};

use super::beams::is_on_spinning;

/// The coordinates that turn an unbalance, each with its direction, by excitation; empty for other excitations.
pub(crate) type Turning = Vec<Vec<(CoordinateId, f64)>>;

const FLOQUET: &str = "what is periodic in the angle of a drive, other than an unbalance, makes the equations of vibration periodic in time; that needs the theory of Floquet, which is not supported";

/// Rejects excitations that are not harmonic, and outputs of which the vibration is not.
pub(crate) fn require_harmonic(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    responses: &[Response],
) -> Result<Turning, Diagnostics> {
    let mut mistakes = Diagnostics::new();
    if responses.is_empty() {
        return Ok(Turning::new());
    }
    let mut turning = Turning::new();
    for (excitation, response) in context.mechanism.excitations.iter().zip(responses) {
        turning.push(match &excitation.law {
            ExcitationLaw::Unbalance { .. } => turned(g, context, excitation, response, &mut mistakes),
            _ => {
                unturned(g, context, excitation, response, &mut mistakes);
                Vec::new()
            }
        });
    }
    steady_outputs(g, context, kinematics, &mut mistakes);
    mistakes.into_result(turning)
}

/// The running coordinates that keep turning, with their places.
fn running(context: &Context) -> Vec<(usize, CoordinateId)> {
    let runs = |id: CoordinateId| context.mechanism.coordinates[id.index()].motion.runs();
    context.topology.running().enumerate().filter(|(_, id)| runs(*id)).collect()
}

/// With `a` and `b` the derivatives along both directions across the axis, every running coordinate must have
/// `a' = s b`, `b' = -s a` with `s` one, minus one or zero.
fn turned(
    g: &mut Graph,
    context: &Context,
    excitation: &Excitation,
    response: &Response,
    mistakes: &mut Diagnostics,
) -> Vec<(CoordinateId, f64)> {
    let n = context.symbols.q.ids.len();
    let mut turning = Vec::new();
    for (index, id) in running(context) {
        let drive = &context.mechanism.coordinates[id.index()].name;
        let symbol = context.symbols.running.ids[index];
        let signs = [0.0, 1.0, -1.0];
        // forces that vanish turn in every direction: then the outputs say which
        let find = |g: &mut Graph, end: usize| {
            let mut signs = signs.into_iter();
            signs.find(|&s| turns(g, context, response, (symbol, s), 0..end))
        };
        let both = find(g, n + context.mechanism.outputs.len());
        let direction = both.or_else(|| find(g, n));
        let Some(s) = direction else {
            let name = &excitation.name;
            mistakes.error_with_help(
                name.span(),
                format!("the forces of `{name}` are not harmonic in the angle `{drive}`"),
                FLOQUET,
            );
            return Vec::new();
        };
        for (k, output) in context.mechanism.outputs.iter().enumerate() {
            let row = n + k..n + k + 1;
            if both.is_none() && !turns(g, context, response, (symbol, s), row) {
                turns_itself(&output.name, drive, mistakes);
            }
        }
        if s != 0.0 {
            turning.push((id, s));
        }
    }
    if turning.is_empty() {
        let name = &excitation.name;
        let forces = response.by.iter().flat_map(|change| &change[..n]);
        let forces: Vec<ExprId> = forces.copied().collect();
        let acts = vanish(g, context, &forces).into_iter().any(|zero| !zero);
        let (problem, help) = match (is_turned(context, excitation), acts) {
            (false, _) if is_on_spinning_beam(context, excitation) => (
                "shakes nothing: the frames along a beam that is `spinning` do not turn with its material",
                "put it on a disk that turns: `joint seat: revolute(x) from shaft at 0.5 length to disk, driven at` the same speed",
            ),
            (false, _) => (
                "shakes nothing: no drive turns its body",
                "an unbalance is on a body that a driven or coasting coordinate turns; an eccentric body that does not turn is a `body` with its `center`",
            ),
            (true, true) => (
                "does not turn relative to what it shakes: it is a constant load, not an excitation",
                "something before the drive must be free to move",
            ),
            (true, false) => (
                "shakes nothing: nothing that can move feels it, and no output",
                "an eccentricity or an amount shakes what can move or tilt across the axis, a tilt what can tilt; that of a sphere has no effect",
            ),
        };
        mistakes.error_with_help(name.span(), format!("`{name}` {problem}"), help);
    }
    turning
}

/// Whether the body of an unbalance is a section of a beam that spins.
fn is_on_spinning_beam(context: &Context, excitation: &Excitation) -> bool {
    let law = &excitation.law;
    matches!(law, ExcitationLaw::Unbalance { body, .. } if is_on_spinning(context.mechanism, *body))
}

/// Whether a running coordinate turns the body of an unbalance.
fn is_turned(context: &Context, excitation: &Excitation) -> bool {
    let ExcitationLaw::Unbalance { body, .. } = excitation.law else {
        return false;
    };
    let mechanism = context.mechanism;
    let turns = |step: &JointStep| {
        let coordinate = &mechanism.coordinates[step.coordinate.index()];
        step.motion != StepMotion::Slide && coordinate.motion.runs()
    };
    let mut frame = Frame::Body(body);
    while let Frame::Body(body) = frame {
        let mut branches = context.topology.branches.iter();
        let Some(branch) = branches.find(|branch| branch.body == body) else {
            return false;
        };
        if mechanism.joints[branch.joint.index()].steps.iter().any(turns) {
            return true;
        }
        frame = branch.parent;
    }
    false
}

/// Whether these derivatives turn with a running coordinate in a direction.
fn turns(
    g: &mut Graph,
    context: &Context,
    response: &Response,
    (symbol, s): (SymbolId, f64),
    range: Range<usize>,
) -> bool {
    let (Some(along), Some(across)) = (response.by.first(), response.by.get(1)) else {
        return s == 0.0;
    };
    let (along, across) = (&along[range.clone()], &across[range]);
    let [along_rate, across_rate] = [along, across].map(|values| by_symbol(g, values, symbol));
    let mut rest = Vec::new();
    for i in 0..along.len() {
        let (expected, opposite) = (g.scale(s, across[i]), g.scale(-s, along[i]));
        rest.push(g.sub(along_rate[i], expected));
        rest.push(g.sub(across_rate[i], opposite));
    }
    vanish(g, context, &rest).into_iter().all(|zero| zero)
}

fn turns_itself(output: &Ident, drive: &Ident, mistakes: &mut Diagnostics) {
    mistakes.error_with_help(
        output.span(),
        format!("output `{output}` turns with `{drive}`, so its vibration is not harmonic"),
        "take it in axes that do not turn: a position in space, a reaction on the side before the drive",
    );
}

fn unturned(
    g: &mut Graph,
    context: &Context,
    excitation: &Excitation,
    response: &Response,
    mistakes: &mut Diagnostics,
) {
    for (index, id) in running(context) {
        let symbol = context.symbols.running.ids[index];
        let all = response.by.concat();
        let change = by_symbol(g, &all, symbol);
        if vanish(g, context, &change).into_iter().any(|zero| !zero) {
            let drive = &context.mechanism.coordinates[id.index()].name;
            mistakes.error_with_help(
                excitation.name.span(),
                format!(
                    "the forces of `{}` depend on the angle `{drive}`, so they have more than one frequency",
                    excitation.name
                ),
                "let it act on the axis of the drive, or before the drive",
            );
        }
    }
}

/// The derivatives of outputs by rates must not depend on the running coordinates; those by positions do not, since no
/// output does.
fn steady_outputs(g: &mut Graph, context: &Context, kinematics: &Kinematics, mistakes: &mut Diagnostics) {
    let symbols = context.symbols;
    let values = outputs(g, context, &symbols.running.values, kinematics);
    let by_velocity = columns(g, &values, &symbols.velocity);
    let by_acceleration = columns(g, &values, &symbols.acceleration);
    for (index, id) in running(context) {
        for (k, output) in context.mechanism.outputs.iter().enumerate() {
            let rates: Vec<ExprId> = by_velocity.iter().chain(&by_acceleration).map(|column| column[k]).collect();
            let rates = at_rest(g, symbols, &rates);
            let change = by_symbol(g, &rates, symbols.running.ids[index]);
            if vanish(g, context, &change).into_iter().any(|zero| !zero) {
                let drive = &context.mechanism.coordinates[id.index()].name;
                turns_itself(&output.name, drive, mistakes);
            }
        }
    }
}
