//! Rings of blades that a drive turns on a support which is not symmetric about its axis.

use crate::algebra::Graph;
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, CoordinateId};
use crate::base::names::{LINK, written};
use crate::mechanics::motion::{Kinematics, turning};
use crate::mechanics::setup::{Context, Multiblade};
use crate::model::mechanism::{Frame, Motion, Ring};

/// The unknowns of all rings that a drive turns, at any angle of the drives and where these are zero; `None` if there is
/// no such ring.
pub(crate) fn multiblade(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
) -> Result<Option<[Multiblade; 2]>, Diagnostics> {
    let mut mistakes = Diagnostics::new();
    let [mut turned, mut still] = [Multiblade::default(), Multiblade::default()];
    for ring in &context.mechanism.rings {
        let Some((drive, sign)) = hub(context, ring).and_then(|hub| driven(g, context, kinematics, ring, hub)) else {
            continue;
        };
        let coordinate = &context.mechanism.coordinates[drive.index()];
        let Motion::Driven(speed) = &coordinate.motion else { continue };
        if ring.members == 2 {
            let message = format!(
                "two blades on a support that is not symmetric: the coefficients are periodic in `{}` (Floquet), whatever the coordinates",
                coordinate.name
            );
            let help = "three or more equal blades may stand on this support, and two on one that is symmetric about the axis";
            mistakes.error_with_help(&ring.name, message, help);
            continue;
        }
        unequal(context, ring, &mut mistakes);
        let speed = context.values.scalar(g, speed);
        let speed = g.scale(sign, speed);
        let running = context.topology.running().position(|id| id == drive);
        let symbol = running.map_or_else(|| g.zero(), |k| context.symbols.running.values[k]);
        let [angle, zero] = [g.scale(sign, symbol), g.zero()];
        let of = (context.topology, context.symbols);
        turned.add(g, of, ring, [angle, speed]);
        still.add(g, of, ring, [zero, speed]);
    }
    mistakes.into_result((!turned.is_empty()).then_some([turned, still]))
}

/// The body that carries a ring.
fn hub(context: &Context, ring: &Ring) -> Option<BodyId> {
    let members = ring.coordinates.iter().map(|(_, ids)| context.mechanism.coordinates[ids[0].index()].joint);
    let members: Vec<_> = members.collect();
    let first = context.topology.branches.iter().find(|branch| members.contains(&branch.joint))?;
    let own = |body: BodyId| {
        let name = context.mechanism.bodies[body.index()].name.to_string();
        let words: Vec<&str> = name.split(LINK).collect();
        (1..words.len()).any(|k| words[..k].join(&LINK.to_string()) == ring.name.to_string())
    };
    let mut frame = first.parent;
    while let Frame::Body(body) = frame
        && own(body)
    {
        frame = context.topology.branches.iter().find(|branch| branch.body == body)?.parent;
    }
    match frame {
        Frame::Body(body) => Some(body),
        Frame::Ground => None,
    }
}

/// The drive about the axis of a ring, and whether it turns in the sense of the ring.
fn driven(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    ring: &Ring,
    hub: BodyId,
) -> Option<(CoordinateId, f64)> {
    let (drive, axis) = turning(g, context, kinematics, hub)?;
    let about = context.values.vector(g, &ring.about);
    let along = axis.dot(g, about);
    let along = context.nominal(g, along);
    ((along.abs() - 1.0).abs() < 1e-9).then_some((drive, along.signum()))
}

/// Refuses blades that are different.
fn unequal(context: &Context, ring: &Ring, mistakes: &mut Diagnostics) {
    for ids in &ring.design {
        let nominal = |k: usize| context.mechanism.design[ids[k].index()].nominal;
        if let Some(other) = (1..ids.len()).find(|&k| nominal(k) != nominal(0)) {
            let name = |k: usize| written(&context.mechanism.design[ids[k].index()].name.to_string()).into_owned();
            let message = format!(
                "`{}` and `{}` differ: unequal blades on a support that is not symmetric make the coefficients periodic (Floquet)",
                name(0),
                name(other)
            );
            mistakes.error_with_help(&ring.name, message, "give them the same value; each may keep a tolerance of its own");
        }
    }
}
