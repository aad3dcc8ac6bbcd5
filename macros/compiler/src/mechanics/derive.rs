//! Derives all functions of a mechanism, step by step.

use crate::algebra::{ExprId, Function, Graph};
use crate::base::diagnostics::{Diagnostics, listed};
use crate::base::ids::CoordinateId;
use crate::base::names::joined;
use crate::model::mechanism::{Mechanism, Motion, Ring};
use crate::topology::Topology;
use crate::topology::build::build;

use super::checks::{
    Drive, Unsteady, drives, free_directions, is_steady, multiblade, notes_on_beams, notes_on_planes, poses,
    properties, remaining_orders, require_determinate_motion, require_harmonic, require_steady_state, require_symmetry,
    requirements,
};
use super::equations::{Equations, excited};
use super::functions::{FreeDirections, Functions, Limits, Properties, RingPlaces, Role, SpanPlaces, Unknown};
use super::kernels::{Excitations, forced, held_values, kernels, picture, pose_margin, spans, violation, whirl};
use super::linear::{Jacobians, Linear};
use super::loads::constraint_rows;
use super::motion::{Kinematics, in_common_frame, in_common_frame_at_zero};
use super::setup::{Context, Excited, Harmonics, Multiblade, Runs, Sections, Symbols, Values};

/// Derives every function of a mechanism. Fails if no steady state exists, if no coordinate affects a constraint, and,
/// unless only the kernels are wanted, if a motion moves no mass or nothing balances a load: errors that only the
/// equations reveal. Coasting coordinates that can only stand still become free ones.
pub fn derive(mechanism: &mut Mechanism, topology: &mut Topology, limits: Limits) -> Result<Functions, Diagnostics> {
    let mut standing = Vec::new();
    let mut functions = loop {
        match derived(mechanism, topology, limits) {
            Ok(functions) => break functions,
            Err(Unsteady::Mistakes(mistakes)) => return Err(mistakes),
            Err(Unsteady::Turning(_)) => unreachable!("the last attempt says what is wrong"),
            Err(Unsteady::Standing(more)) => {
                let mut refused = Diagnostics::new();
                for id in more {
                    if let Some(steady) = mechanism.steady.iter().find(|x| x.coordinate == id) {
                        refused.error_with_help(
                            &steady.name,
                            format!("`{}` can only stand still: slip depends on it", steady.name),
                            "a steady speed belongs to a coordinate that keeps running",
                        );
                    }
                    let coordinate = &mut mechanism.coordinates[id.index()];
                    coordinate.motion = Motion::Free;
                    standing.push(format!("`{}`", coordinate.name));
                }
                refused.into_result(())?;
                *topology = build(mechanism)?;
            }
        }
    };
    functions.free.notes.extend(notes_on_beams(mechanism));
    if !standing.is_empty() {
        functions.free.notes.push(format!(
            "slip depends on {}: no coasting, only standing still, so free like other coordinates",
            listed(&standing)
        ));
    }
    Ok(functions)
}

/// What the unknowns of equal blades are.
#[derive(Clone, Copy, PartialEq)]
enum Blades {
    /// The coordinates of each.
    Apart,
    /// Multiblade coordinates.
    Together,
    /// Multiblade coordinates and their harmonics.
    Periodic,
    /// The coordinates of each, and what is wrong with them.
    Refused,
}

fn derived(mechanism: &Mechanism, topology: &Topology, limits: Limits) -> Result<Functions, Unsteady> {
    let derived = |blades: Blades, equal: &[bool]| {
        in_context(&mut Graph::new(), mechanism, topology, equal, |g, context| functions(g, context, limits, blades))
    };
    if !mechanism.rings.is_empty() {
        let mut turned = Vec::new();
        for blades in [Blades::Apart, Blades::Together, Blades::Periodic] {
            match derived(blades, &turned) {
                Err(Unsteady::Turning(rings)) => turned = rings,
                other => return other,
            }
        }
    }
    derived(Blades::Refused, &[])
}

/// Passes the symbols, values and coordinates in which the equations of a mechanism are derived to `work`. Blades of the
/// rings that are `equal` have the mean of their design variables.
fn in_context<R>(
    g: &mut Graph,
    mechanism: &Mechanism,
    topology: &Topology,
    equal: &[bool],
    work: impl FnOnce(&mut Graph, &Context) -> R,
) -> R {
    let mut symbols = Symbols::new(g, mechanism, topology);
    symbols.share_design(g, mechanism, equal);
    let (separate, steady) = (Multiblade::default(), Harmonics::default());
    let values = Values::new(g, mechanism, &symbols);
    let runs = Runs::new(g, mechanism, topology, &values, &symbols);
    let sections = Sections::new(g, mechanism, topology);
    let at_peace = Excited::default();
    let unconstrained = Context {
        mechanism,
        topology,
        symbols: &symbols,
        values: &values,
        runs: &runs,
        sections: &sections,
        rows: &[],
        multiblade: &separate,
        harmonics: &steady,
        excited: &at_peace,
    };
    let rows = constraint_rows(g, &unconstrained);
    let labels: Vec<String> = rows.iter().map(|row| row.label.replace('.', "_")).collect();
    let symbols = symbols.clone().with_reactions(g, &labels);
    let runs = runs.with_reactions(&symbols).with_sections(&sections);
    let values = Values::new(g, mechanism, &symbols);
    let context = Context {
        mechanism,
        topology,
        symbols: &symbols,
        values: &values,
        runs: &runs,
        sections: &sections,
        rows: &rows,
        multiblade: &separate,
        harmonics: &steady,
        excited: &at_peace,
    };
    work(g, &context)
}

/// Asserts that mass, damping and stiffness from walks over the bodies are those by differentiation, and counts the entries
/// that are not zero; `None` if the walks do not apply.
#[cfg(test)]
pub(crate) fn compared_at_rest(mechanism: &Mechanism, topology: &Topology) -> Option<[usize; 3]> {
    in_context(&mut Graph::new(), mechanism, topology, &[], |g, context| {
        let at_zero = in_common_frame_at_zero(g, context);
        let running = vec![g.zero(); context.symbols.running.ids.len()];
        let equations = Equations::new(g, context, (&running, &at_zero), context);
        super::linear::compared(g, context, &equations)
    })
}

fn functions(g: &mut Graph, context: &Context, limits: Limits, blades: Blades) -> Result<Functions, Unsteady> {
    let (mechanism, symbols) = (context.mechanism, context.symbols);
    let running = in_common_frame(g, context, &symbols.running.values);
    let drives = drives(g, context, &running);
    let mut of_blades = match blades {
        Blades::Apart | Blades::Refused => Default::default(),
        Blades::Together | Blades::Periodic => multiblade(g, context, &drives)?,
    };
    of_blades.iter_mut().for_each(|coordinates| coordinates.bent = blades == Blades::Periodic);
    let [at_angle, still] = &of_blades;
    let at_angle = &Context { multiblade: at_angle, ..*context };
    let harmonics = match blades {
        Blades::Refused => {
            require_steady_state(g, at_angle, &running)?;
            (symbols.clone(), Harmonics::default())
        }
        Blades::Apart | Blades::Together if is_steady(g, at_angle, &running) => (symbols.clone(), Harmonics::default()),
        Blades::Apart | Blades::Together => {
            return Err(Unsteady::Turning(drives.iter().map(Option::is_some).collect()));
        }
        Blades::Periodic => harmonics(g, at_angle, &running, &drives)?,
    };
    let (symbols, harmonics) = (&harmonics.0, &harmonics.1);
    let context = &Context { multiblade: still, symbols, harmonics, ..*context };
    let at_zero = in_common_frame_at_zero(g, context);
    let responses = excited(g, at_angle, &at_zero);
    let turning = require_harmonic(g, at_angle, &running, &responses)?;
    let responses = responses.into_iter().map(|response| response.along_means(g, context)).collect::<Vec<_>>();
    let zeros = vec![g.zero(); symbols.running.ids.len()];
    let equations = if harmonics.is_empty() {
        Equations::new(g, context, (&zeros, &at_zero), context)
    } else {
        Equations::new(g, at_angle, (&symbols.running.values, &running), context)
    };
    let at_zero = &at_zero;
    let jacobians = Jacobians::new(g, context, &equations);
    let undetermined = require_determinate_motion(g, context, &jacobians)?;
    require_symmetry(g, context, &equations, &jacobians)?;
    let mut free = match harmonics.is_empty() {
        true => free_directions(g, context, (&equations, at_zero), &jacobians)?,
        false => FreeDirections { notes: vec![periodic(harmonics)], ..FreeDirections::default() },
    };
    free.notes.extend(notes_on_planes(g, context, &running));
    let properties = properties(g, context, &jacobians);
    let linear = Linear::new(g, &jacobians, properties, context);
    let excitations = Excitations::new(g, context, &responses, &turning);
    let mut functions = kernels(g, symbols, &equations, &linear, limits);
    functions.extend(forced(g, context, &equations, &excitations));
    let (function, picture) = picture(g, context, at_zero);
    let of_positions = whirl(g, context, at_zero).into_iter().chain([function]);
    functions.extend(of_positions.map(|function| in_unknowns(g, context, function)));
    let requirements = requirements(g, mechanism, context.values);
    functions.push(violation(&requirements, symbols));
    let poses = poses(g, context, at_zero);
    let margin = pose_margin(&poses, symbols);
    functions.push(in_unknowns(g, context, margin));
    let speeds: Vec<ExprId> =
        drives.iter().map(|drive| drive.map_or_else(|| g.zero(), |(_, [_, speed])| speed)).collect();
    functions.extend(held_values(g, context, &speeds));
    functions.extend(spans(g, context));
    let unknowns = unknowns(context);
    let held = held(mechanism, &unknowns);
    let rings = rings(context);
    Ok(Functions {
        unknowns,
        graph: std::mem::take(g),
        functions,
        requirements,
        poses,
        picture,
        properties: if mechanism.spans().next().is_none() { properties } else { Properties::GENERAL },
        undetermined,
        free,
        held,
        rings,
        spans: places_of_spans(context),
        harmonics: harmonics.orders.clone(),
        excitations: excitations.facts,
    })
}

/// The unknowns where equal blades leave a periodic part in the equations.
fn harmonics(
    g: &mut Graph,
    context: &Context,
    running: &Kinematics,
    drives: &[Drive],
) -> Result<(Symbols, Harmonics), Unsteady> {
    let Some((orders, place)) = remaining_orders(g, context, running, drives) else {
        return Err(Unsteady::Turning(Vec::new()));
    };
    let symbols = context.symbols;
    let unknowns = symbols.clone().with_harmonics(g, &orders);
    let id = context.topology.running().nth(place);
    let speed = id.map_or_else(|| g.zero(), |id| running.coordinates[id.index()].velocity);
    let angles: Vec<_> = symbols.running.ids.iter().enumerate().map(|(k, &id)| (id, k == place)).collect();
    let harmonics = Harmonics::new(g, orders, (symbols, &unknowns), (&angles, speed));
    Ok((unknowns, harmonics))
}

fn periodic(harmonics: &Harmonics) -> String {
    let orders: Vec<String> = harmonics.orders.iter().map(ToString::to_string).collect();
    format!(
        "the coefficients keep a part that is periodic, of order {}: steady motion and modes have harmonics (Hill's method with these)",
        listed(&orders)
    )
}

/// A function of the coordinates as one of the unknowns.
fn in_unknowns(g: &mut Graph, context: &Context, mut function: Function) -> Function {
    for result in &mut function.results {
        result.values = context.multiblade.in_unknowns(g, &result.values);
    }
    function
}

/// The positions of the unknowns with a steady value.
fn held(mechanism: &Mechanism, unknowns: &[Unknown]) -> Vec<usize> {
    let index_of = |id: CoordinateId| {
        let is = |role: Role| matches!(role, Role::Position(own) | Role::Speed(own) if own == id);
        let index = unknowns.iter().position(|unknown| is(unknown.role));
        index.expect("what has a steady value is not driven, and its joint is not cut")
    };
    let steady = mechanism.steady.iter();
    steady.map(|steady| index_of(steady.coordinate)).collect()
}

/// Where the ends of spans of shafts are among the unknowns.
fn places_of_spans(context: &Context) -> Vec<SpanPlaces> {
    let free = &context.topology.free;
    let place = |&(id, factor): &(CoordinateId, f64)| {
        let place = free.iter().position(|own| *own == id).expect("motions of stations are neither driven nor cut");
        (place, factor)
    };
    let spans = context.mechanism.spans().map(|span| SpanPlaces {
        line: span.line,
        elements: span.elements.clone(),
        ends: span.ends.each_ref().map(|end| end.iter().map(place).collect()),
    });
    spans.collect()
}

/// Where the rings are among the unknowns and the design variables.
fn rings(context: &Context) -> Vec<RingPlaces> {
    let places = |ring: &Ring| {
        let free = &context.topology.free;
        let coordinates = ring.coordinates.iter().filter_map(|(_, ids)| {
            ids.iter().map(|id| free.iter().position(|own| own == id)).collect::<Option<Vec<usize>>>()
        });
        let coordinates: Vec<usize> = coordinates.flatten().collect();
        RingPlaces {
            name: ring.name.to_string(),
            members: ring.members,
            patterns: coordinates.iter().any(|k| context.multiblade.name(*k).is_some()),
            coordinates,
            design: ring.design.iter().flatten().map(|id| id.index()).collect(),
        }
    };
    context.mechanism.rings.iter().map(places).collect()
}

/// The meaning of each entry of `q`.
fn unknowns(context: &Context) -> Vec<Unknown> {
    let (mechanism, topology) = (context.mechanism, context.topology);
    let of = |id: CoordinateId, per_second: &str, role: fn(CoordinateId) -> Role| {
        let coordinate = &mechanism.coordinates[id.index()];
        Unknown {
            name: coordinate.name.to_string(),
            unit: if mechanism.strains(id) {
                "1".to_owned()
            } else {
                format!("{}{per_second}", coordinate.quantity.unit())
            },
            role: role(id),
        }
    };
    let free = topology.free.iter().enumerate().map(|(k, &id)| {
        let unknown = of(id, "", Role::Position);
        let name = context.multiblade.name(k).map_or(unknown.name, str::to_owned);
        Unknown { name, ..unknown }
    });
    let free: Vec<_> = free.collect();
    let coasting = topology.coasting.iter().map(|&id| of(id, "/s", Role::Speed));
    let coasting: Vec<_> = coasting.collect();
    let harmonics = (free.len()..context.symbols.q.ids.len() - coasting.len() - context.rows.len()).filter_map(|k| {
        let (coordinate, order, sine) = Harmonics::of_unknown(&context.harmonics.orders, free.len(), k)?;
        let of = &free[coordinate];
        let name = joined(&of.name, if sine { "sine" } else { "cosine" });
        let name = joined(&name, &order.to_string());
        let id = topology.free[coordinate];
        Some(Unknown { name, unit: of.unit.clone(), role: Role::Harmonic(id) })
    });
    let harmonics: Vec<_> = harmonics.collect();
    let reactions = context.rows.iter().map(|row| Unknown {
        name: row.label.clone(),
        unit: row.unit.clone(),
        role: if row.of_velocities { Role::VelocityReaction } else { Role::PositionReaction },
    });
    free.into_iter().chain(harmonics).chain(coasting).chain(reactions).collect()
}
