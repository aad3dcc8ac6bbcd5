//! Rings of blades that a drive turns on a support which is not symmetric about its axis.

use std::f64::consts::TAU;

use crate::algebra::{ExprId, Graph, SymbolId, substitute};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, CoordinateId};
use crate::base::names::{LINK, written};
use crate::mechanics::equations::{Equations, Residual, outputs};
use crate::mechanics::linear::Jacobians;
use crate::mechanics::motion::{Kinematics, turning};
use crate::mechanics::setup::{Context, ForceSelection, Multiblade, at_rest, by_symbol, vanish};
use crate::model::mechanism::{Frame, Motion, Ring};

/// The drive of a ring, its angle and its speed in the sense of the ring.
pub(crate) type Drive = Option<(CoordinateId, [ExprId; 2])>;

/// The drive about the axis of each ring, and its speed in the sense of the ring.
pub(crate) fn drives(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<Drive> {
    let rings = context.mechanism.rings.iter();
    rings
        .map(|ring| {
            let hub = hub(context, ring)?;
            let (drive, sign) = driven(g, context, kinematics, ring, hub)?;
            let Motion::Driven(speed) = &context.mechanism.coordinates[drive.index()].motion else { return None };
            let speed = context.values.scalar(g, speed);
            let running = context.topology.running().position(|id| id == drive)?;
            let angle = context.symbols.running.values[running];
            Some((drive, [angle, speed].map(|value| g.scale(sign, value))))
        })
        .collect()
}

/// The unknowns of all rings that a drive turns, at any angle of the drives and where these are zero; empty if there is no
/// such ring.
pub(crate) fn multiblade(g: &mut Graph, context: &Context, drives: &[Drive]) -> Result<[Multiblade; 2], Diagnostics> {
    let mut mistakes = Diagnostics::new();
    let [mut turned, mut still] = [Multiblade::default(), Multiblade::default()];
    for (ring, drive) in context.mechanism.rings.iter().zip(drives) {
        let Some((drive, [angle, speed])) = *drive else { continue };
        let coordinate = &context.mechanism.coordinates[drive.index()];
        if ring.members == 2 {
            let message = format!(
                "two blades on a support that is not symmetric: the coefficients are periodic in `{}` (Floquet), whatever the coordinates",
                coordinate.name
            );
            let help =
                "three or more equal blades may stand on this support, and two on one that is symmetric about the axis";
            mistakes.error_with_help(&ring.name, message, help);
            continue;
        }
        unequal(context, ring, &mut mistakes);
        let zero = g.zero();
        let of = (context.topology, context.symbols);
        turned.add(g, of, ring, [angle, speed]);
        still.add(g, of, ring, [zero, speed]);
    }
    mistakes.into_result([turned, still])
}

/// The body that carries a ring.
fn hub(context: &Context, ring: &Ring) -> Option<BodyId> {
    let members = ring.coordinates.iter().map(|(_, ids)| context.mechanism.coordinates[ids[0].index()].joint);
    let members: Vec<_> = members.collect();
    let first = context.topology.branches.iter().find(|branch| members.contains(&branch.joint))?;
    let own = |body: BodyId| {
        let name = context.mechanism.bodies[body.index()].name.to_string();
        let words: Vec<&str> = name.split(LINK).collect();
        (1..words.len()).any(|k| ring.name == words[..k].join(&LINK.to_string()))
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
            mistakes.error_with_help(
                &ring.name,
                message,
                "give them the same value; each may keep a tolerance of its own",
            );
        }
    }
}

/// Refuses instances that are not equal around their axis: where all stand alike, each must feel what the first does, and
/// each pair what a pair at the same distance does.
pub(crate) fn require_symmetry(
    g: &mut Graph,
    context: &Context,
    equations: &Equations,
    jacobians: &Jacobians,
) -> Result<(), Diagnostics> {
    let mut mistakes = Diagnostics::new();
    let (symbols, free) = (context.symbols, &context.topology.free);
    if !context.multiblade.is_empty() {
        return Ok(());
    }
    for ring in &context.mechanism.rings {
        let place = |id: &CoordinateId| free.iter().position(|own| own == id);
        let slots: Vec<Vec<usize>> =
            ring.coordinates.iter().filter_map(|(_, ids)| ids.iter().map(place).collect()).collect();
        let zero = g.zero();
        let mut alike: Vec<(SymbolId, ExprId)> = symbols.q.ids[..free.len()].iter().map(|id| (*id, zero)).collect();
        for slots in &slots {
            slots.iter().for_each(|&k| alike[k].1 = symbols.q.values[slots[0]]);
        }
        // What loops in each instance hold with is not compared.
        alike.extend(symbols.q.ids[context.moving().1..].iter().map(|id| (*id, zero)));
        for ids in &ring.design {
            let first = symbols.b.values[ids[0].index()];
            alike.extend(ids.iter().map(|id| (symbols.b.ids[id.index()], first)));
        }
        let n = ring.members;
        let mut differences: Vec<(usize, usize, ExprId)> = Vec::new();
        for (c, of) in slots.iter().enumerate() {
            for k in 1..n {
                let rows = [of[0], of[k]];
                differences.push((c, k, g.sub(equations.rest[rows[1]], equations.rest[rows[0]])));
                for (other, matrix) in slots.iter().flat_map(|other| {
                    [&jacobians.mass, &jacobians.damping, &jacobians.stiffness].map(|matrix| (other, matrix))
                }) {
                    for step in 0..n {
                        let entries = [matrix[other[step]][rows[0]], matrix[other[(k + step) % n]][rows[1]]];
                        differences.push((c, k, g.sub(entries[1], entries[0])));
                    }
                }
            }
        }
        let roots: Vec<ExprId> = differences.iter().map(|(.., root)| *root).collect();
        let roots = substitute(g, &roots, &alike);
        let equal = vanish(g, context, &roots);
        let Some(different) = equal.iter().position(|equal| !equal) else { continue };
        let (c, k, _) = differences[different];
        let name = |k: usize| {
            let id = ring.coordinates.iter().filter(|(_, ids)| ids.iter().all(|id| place(id).is_some())).nth(c);
            let name = id.map(|(_, ids)| context.mechanism.coordinates[ids[k].index()].name.to_string());
            written(&name.unwrap_or_default()).into_owned()
        };
        let message = format!(
            "`{}` is not equal around its axis: `{}` feels other forces than `{}`",
            ring.name,
            name(k),
            name(0)
        );
        let help = "what acts on one must act on each, turned about the axis; without `cyclic`, all may be different";
        mistakes.error_with_help(&ring.name, message, help);
    }
    mistakes.into_result(())
}

/// The harmonics that remain where a ring stands across a force: `None` if the equations do more than that when the drive
/// turns on by one blade, counted from the next.
pub(crate) fn remaining_orders(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    drives: &[Drive],
) -> Option<(Vec<usize>, usize)> {
    let (symbols, topology) = (context.symbols, context.topology);
    let mut rings =
        context.mechanism.rings.iter().zip(drives).filter_map(|(ring, drive)| Some((ring.members, (*drive)?.0)));
    let (blades, drive) = rings.next()?;
    let simple = topology.coasting.is_empty() && context.rows.is_empty();
    if !simple || rings.any(|other| other != (blades, drive)) {
        return None;
    }
    let running = &symbols.running;
    let place = topology.running().position(|id| id == drive)?;
    let residual = Residual::new(g, context, &running.values, kinematics, ForceSelection::ALL).total(g, context);
    let outputs = outputs(g, context, &running.values, kinematics);
    let roots = [residual, at_rest(g, symbols, &outputs)].concat();
    let step = g.constant(TAU / blades as f64);
    let next = g.add(running.values[place], step);
    let mut replaced = vec![(running.ids[place], next)];
    for k in context.multiblade.alternating() {
        for list in [&symbols.q, &symbols.velocity, &symbols.acceleration] {
            replaced.push((list.ids[k], g.neg(list.values[k])));
        }
    }
    let mut turned = substitute(g, &roots, &replaced);
    for k in context.multiblade.alternating() {
        turned[k] = g.neg(turned[k]);
    }
    let mut rest: Vec<ExprId> = roots.iter().zip(&turned).map(|(&one, &other)| g.sub(one, other)).collect();
    for (_, symbol) in running.ids.iter().enumerate().filter(|(k, _)| *k != place) {
        rest.extend(by_symbol(g, &roots, *symbol));
    }
    let orders = if blades.is_multiple_of(2) { vec![blades / 2, blades] } else { vec![blades] };
    vanish(g, context, &rest).into_iter().all(|zero| zero).then_some((orders, place))
}
