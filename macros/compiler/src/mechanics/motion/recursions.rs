//! The motion of a mechanism in two forms: in the common frame, and in the form needed for inertia and weight.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::setup::{Context, CoordinateMotion, ForceSelection, Layout, Selection};
use crate::model::mechanism::Motion;

use super::kinematics::{Bending, Kinematics};
use super::strain::{headings, headings_in_unknowns};

/// Motion of every frame with the running coordinates at zero.
pub(crate) fn in_common_frame_at_zero(g: &mut Graph, context: &Context) -> Kinematics {
    let zero = g.zero();
    in_common_frame(g, context, &vec![zero; context.symbols.running.ids.len()])
}

/// Motion of every frame with the running coordinates at `running`.
pub(crate) fn in_common_frame(g: &mut Graph, context: &Context, running: &[ExprId]) -> Kinematics {
    let symbols = context.symbols;
    let motions = motions(g, context, running, |k| CoordinateMotion {
        position: symbols.q.values[k],
        velocity: symbols.velocity.values[k],
        acceleration: symbols.acceleration.values[k],
    });
    let beams = (0..context.mechanism.beams.len()).map(BeamId::new);
    let turns = beams
        .map(|id| {
            let turns = context.sections.by_unknowns(g, symbols, id);
            (turns, headings_in_unknowns(g, context, id))
        })
        .collect();
    let layout = Layout::common(context.mechanism.bodies.len());
    let still = Vector3::zero(g);
    Kinematics::new(g, context.mechanism, context.topology, context.values, (motions, turns), &layout, still)
}

/// Motion of every body in the form needed for inertia and weight: in the layout of runs, with the ground accelerated
/// against gravity.
pub(crate) fn for_inertia(
    g: &mut Graph,
    context: &Context,
    running: &[ExprId],
    selection: ForceSelection,
) -> Kinematics {
    let mut motions = motions(g, context, running, |k| context.runs.motion(k));
    let beams = (0..context.mechanism.beams.len()).map(BeamId::new);
    let moves = selection.inertia != Selection::None;
    let mut turns: Vec<Bending> = beams
        .map(|id| {
            let turns = context.sections.by_themselves(g, id);
            (turns, headings(g, context, id, moves))
        })
        .collect();
    let zero = g.zero();
    if !moves {
        let still = |motion: CoordinateMotion| CoordinateMotion {
            position: motion.position,
            velocity: zero,
            acceleration: zero,
        };
        motions = motions.into_iter().map(still).collect();
        for (turns, _) in &mut turns {
            *turns = turns.map(still);
        }
    }
    let ground =
        if selection.gravity { context.values.vector(g, &context.mechanism.gravity).neg(g) } else { Vector3::zero(g) };
    let layout = &context.runs.layout;
    Kinematics::new(g, context.mechanism, context.topology, context.values, (motions, turns), layout, ground)
}

/// [`for_inertia`] of everything at rest that moves freely: only what is driven runs on.
pub(crate) fn for_inertia_at_rest(g: &mut Graph, context: &Context) -> Kinematics {
    let zero = g.zero();
    let still = |motion: CoordinateMotion| CoordinateMotion { velocity: zero, acceleration: zero, ..motion };
    let running = vec![zero; context.symbols.running.ids.len()];
    let motions = motions(g, context, &running, |k| still(context.runs.motion(k)));
    let beams = (0..context.mechanism.beams.len()).map(BeamId::new);
    let turns = beams.map(|id| (context.sections.by_themselves(g, id).map(still), headings(g, context, id, false)));
    let turns = turns.collect();
    let ground = context.values.vector(g, &context.mechanism.gravity).neg(g);
    let layout = &context.runs.layout;
    Kinematics::new(g, context.mechanism, context.topology, context.values, (motions, turns), layout, ground)
}

/// The motion of all coordinates by coordinate id; `free` gives the motion of the free ones.
fn motions(
    g: &mut Graph,
    context: &Context,
    running: &[ExprId],
    free: impl Fn(usize) -> CoordinateMotion,
) -> Vec<CoordinateMotion> {
    let zero = g.zero();
    let still = CoordinateMotion { position: zero, velocity: zero, acceleration: zero };
    let mut coordinates = vec![still; context.mechanism.coordinates.len()];
    for (k, id) in context.topology.free.iter().enumerate() {
        coordinates[id.index()] = free(k);
    }
    for (k, id) in context.topology.driven.iter().enumerate() {
        let coordinate = &context.mechanism.coordinates[id.index()];
        if let Motion::Driven(speed) = &coordinate.motion {
            let velocity = context.values.scalar(g, speed);
            g.set_name(velocity, || format!("speed_{}", coordinate.name));
            coordinates[id.index()] = CoordinateMotion { position: running[k], velocity, acceleration: zero };
        }
    }
    for (id, shaken) in &context.excited.shaken {
        let coordinate = &mut coordinates[id.index()];
        coordinate.position = g.add(coordinate.position, shaken.position);
        coordinate.velocity = g.add(coordinate.velocity, shaken.velocity);
        coordinate.acceleration = shaken.acceleration;
    }
    let (free, driven) = (context.moving().0, context.topology.driven.len());
    for (k, id) in context.topology.coasting.iter().enumerate() {
        coordinates[id.index()] = CoordinateMotion {
            position: running[driven + k],
            velocity: context.symbols.q.values[free + k],
            acceleration: context.symbols.velocity.values[free + k],
        };
    }
    coordinates
}
