//! Derives all functions of a mechanism, step by step.

use crate::algebra::{ExprId, Function, Graph};
use crate::base::diagnostics::{Diagnostics, listed};
use crate::base::ids::CoordinateId;
use crate::model::mechanism::{Mechanism, Motion, Ring};
use crate::topology::Topology;
use crate::topology::build::build;

use super::checks::{
    Unsteady, free_directions, drives, multiblade, notes_on_beams, notes_on_planes, poses, properties, require_determinate_motion,
    require_harmonic, require_steady_state, require_symmetry, requirements,
};
use super::equations::{Equations, excited};
use super::functions::{Functions, Limits, RingPlaces, Role, Unknown};
use super::kernels::{Excitations, forced, held_values, kernels, picture, pose_margin, violation, whirl};
use super::linear::{Jacobians, Linear};
use super::loads::constraint_rows;
use super::motion::{in_common_frame, in_common_frame_at_zero};
use super::setup::{Context, Excited, Multiblade, Runs, Sections, Symbols, Values};

/// Derives every function of a mechanism. Fails if no steady state exists, if no coordinate affects a constraint, and,
/// unless only the kernels are wanted, if a motion moves no mass or nothing balances a load: errors that only the
/// equations reveal. Coasting coordinates that can only stand still become free ones.
pub fn derive(mechanism: &mut Mechanism, topology: &mut Topology, limits: Limits) -> Result<Functions, Diagnostics> {
    let mut standing = Vec::new();
    let mut functions = loop {
        match derived(mechanism, topology, limits) {
            Ok(functions) => break functions,
            Err(Unsteady::Mistakes(mistakes)) => return Err(mistakes),
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

fn derived(mechanism: &Mechanism, topology: &Topology, limits: Limits) -> Result<Functions, Unsteady> {
    let derived = |equal: bool| {
        in_context(&mut Graph::new(), mechanism, topology, equal, |g, context| functions(g, context, limits, equal))
    };
    match derived(false) {
        Err(Unsteady::Mistakes(_)) if !mechanism.rings.is_empty() => derived(true),
        other => other,
    }
}

/// Passes the symbols, values and coordinates in which the equations of a mechanism are derived to `work`. If blades are
/// `equal`, the mean of its design variables belongs to each.
fn in_context<R>(
    g: &mut Graph,
    mechanism: &Mechanism,
    topology: &Topology,
    equal: bool,
    work: impl FnOnce(&mut Graph, &Context) -> R,
) -> R {
    let mut symbols = Symbols::new(g, mechanism, topology);
    if equal {
        symbols.share_design(g, mechanism);
    }
    let separate = Multiblade::default();
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
        excited: &at_peace,
    };
    work(g, &context)
}

/// Asserts that mass, damping and stiffness from walks over the bodies are those by differentiation, and counts the entries
/// that are not zero; `None` if the walks do not apply.
#[cfg(test)]
pub(crate) fn compared_at_rest(mechanism: &Mechanism, topology: &Topology) -> Option<[usize; 3]> {
    in_context(&mut Graph::new(), mechanism, topology, false, |g, context| {
        let at_zero = in_common_frame_at_zero(g, context);
        let equations = Equations::new(g, context, at_zero);
        super::linear::compared(g, context, &equations)
    })
}

fn functions(g: &mut Graph, context: &Context, limits: Limits, equal: bool) -> Result<Functions, Unsteady> {
    let (mechanism, symbols) = (context.mechanism, context.symbols);
    let running = in_common_frame(g, context, &symbols.running.values);
    let drives = drives(g, context, &running);
    let [at_angle, still] = if equal { multiblade(g, context, &drives)? } else { Default::default() };
    let at_angle = &Context { multiblade: &at_angle, ..*context };
    let context = &Context { multiblade: &still, ..*context };
    require_steady_state(g, at_angle, &running)?;
    let at_zero = in_common_frame_at_zero(g, context);
    let responses = excited(g, at_angle, &at_zero);
    let turning = require_harmonic(g, at_angle, &running, &responses)?;
    let equations = Equations::new(g, context, at_zero);
    let at_zero = &equations.kinematics;
    let jacobians = Jacobians::new(g, context, &equations);
    let undetermined = require_determinate_motion(g, context, &jacobians)?;
    require_symmetry(g, context, &equations, &jacobians)?;
    let mut free = free_directions(g, context, &equations, &jacobians)?;
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
    let speeds: Vec<ExprId> = drives.iter().map(|drive| drive.map_or_else(|| g.zero(), |(_, [_, speed])| speed)).collect();
    functions.extend(held_values(g, context, &speeds));
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
        properties,
        undetermined,
        free,
        held,
        rings,
        excitations: excitations.facts,
    })
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
    let coasting = topology.coasting.iter().map(|&id| of(id, "/s", Role::Speed));
    let reactions = context.rows.iter().map(|row| Unknown {
        name: row.label.clone(),
        unit: row.unit.clone(),
        role: if row.of_velocities { Role::VelocityReaction } else { Role::PositionReaction },
    });
    free.chain(coasting).chain(reactions).collect()
}
