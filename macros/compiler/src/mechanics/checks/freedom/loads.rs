//! Loads along free directions. Where the work along a direction is the same everywhere and not zero, nothing balances it.

use crate::algebra::{Disturbed, ExprId, Graph};
use crate::base::diagnostics::{Diagnostic, listed};
use crate::base::ids::ForceId;
use crate::base::span::Extent;
use crate::mechanics::equations::Residual;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, ForceSelection, RandomState, Selection, at_rest};
use crate::model::mechanism::Force;

use super::count::{at_random, rank, rates};
use super::state::{Friction, Linearised, System};
use super::symmetry::{Combinations, conserved, powers};
use super::words::{Direction, FEW, exact, independent, readable};

/// Relative difference of work that is the same.
const SAME: f64 = 1e-3;

/// The directions along which the loads of a design do not balance: those along which they do the same work everywhere.
/// Loads that follow a free motion do not; then the mechanism rests nowhere if it cannot be brought to rest.
pub(super) fn unbalanced(system: &System, design: u64, symmetries: &Combinations, friction: Friction) -> Vec<Vec<f64>> {
    let Some(state) = at_random(system, design, friction) else {
        return Vec::new();
    };
    let conserved = conserved(system, design, friction);
    let loaded = |combinations: &Combinations, places: &[Linearised]| {
        let mut directions = readable(system, combinations, state.operations);
        let along: Vec<_> = directions.iter().map(|direction| exact(direction)).collect();
        let power = |state: &Linearised| powers(state, &along, &state.residual, system.fields.free);
        let here = power(&state);
        let elsewhere: Vec<_> = places.iter().map(power).collect();
        let mut k = 0..;
        directions.retain(|_| {
            let k = k.next().unwrap_or(0);
            let there = |powers: &Vec<Disturbed>| powers[k].value() / here[k].value() - 1.0;
            !here[k].is_rounding(state.operations) && elsewhere.iter().all(|powers| there(powers).abs() < SAME)
        });
        independent(system, &state, directions)
    };
    // What rounding let pass changes from place to place.
    let others = (141..144).filter_map(|motion| system.at(RandomState { design, motion }, friction));
    let others: Vec<_> = others.collect();
    let everywhere = loaded(&conserved, &others);
    let dimension = |of: &Combinations| rank(&rates(system, &state, of), state.operations);
    let rolls = system.first_of_velocities() < system.size();
    if !everywhere.is_empty() || rolls || dimension(&conserved) >= dimension(symmetries) {
        return everywhere;
    }
    match system.equilibria(design).next() {
        Some(_) => Vec::new(),
        None => loaded(symmetries, &[]),
    }
}

/// A cause of load.
pub(super) enum Cause<'a> {
    Force(&'a Force),
    Gravity,
    Inertia,
}

impl Cause<'_> {
    fn text(&self) -> String {
        match self {
            Self::Force(force) => format!("`{}`", force.name),
            Self::Gravity => "gravity".to_owned(),
            Self::Inertia => "the motion of the drives".to_owned(),
        }
    }
}

/// Every cause of load, with its part of the equations at rest.
pub(super) fn causes<'a>(
    g: &mut Graph,
    context: &Context<'a>,
    kinematics: &Kinematics,
) -> Vec<(Cause<'a>, Vec<ExprId>)> {
    let none = ForceSelection { inertia: Selection::None, forces: Selection::None, gravity: false, constraints: false };
    let gravity = ForceSelection { gravity: true, ..none };
    let mut causes = vec![(Cause::Gravity, gravity), (Cause::Inertia, ForceSelection::INERTIA)];
    for (index, force) in context.mechanism.forces.iter().enumerate() {
        let forces = Selection::One(ForceId::new(index));
        causes.push((Cause::Force(force), ForceSelection { forces, ..none }));
    }
    let running = vec![g.zero(); context.symbols.running.ids.len()];
    let part = |(cause, selection): (Cause<'a>, ForceSelection)| {
        let part = Residual::new(g, context, &running, kinematics, selection).total(g, context);
        (cause, at_rest(g, context.symbols, &part))
    };
    causes.into_iter().map(part).collect()
}

/// The mistakes of loads along directions that nothing holds: one for all directions of the same loads.
pub(super) fn mistakes(
    system: &System,
    design: u64,
    directions: Vec<(Vec<f64>, Direction)>,
    causes: &[(Cause, Vec<ExprId>)],
) -> Vec<Diagnostic> {
    let mut groups: Vec<(Vec<usize>, Vec<Direction>)> = Vec::new();
    for (along, direction) in directions {
        let loads = acting(system, design, &along, causes);
        match groups.iter_mut().find(|(others, _)| *others == loads) {
            Some((_, directions)) => directions.push(direction),
            None => groups.push((loads, vec![direction])),
        }
    }
    let group = |(loads, directions): (Vec<usize>, Vec<Direction>)| {
        let loads: Vec<&Cause> = loads.into_iter().map(|k| &causes[k].0).collect();
        mistake(&loads, &directions)
    };
    groups.into_iter().map(group).collect()
}

/// The causes that do work along a direction.
fn acting(system: &System, design: u64, along: &[f64], causes: &[(Cause, Vec<ExprId>)]) -> Vec<usize> {
    (0..causes.len()).filter(|k| works(system, design, along, &causes[*k].1)).collect()
}

/// Whether a part of the equations does work along a direction.
pub(super) fn works(system: &System, design: u64, along: &[f64], part: &[ExprId]) -> bool {
    let state = RandomState { design, motion: 1 };
    let along = vec![exact(along)];
    let Some(linearised) = system.at(state, Friction::None) else {
        return false;
    };
    let (part, operations) = system.values(part, state);
    let power = powers(&linearised, &along, &part, system.fields.free);
    power.iter().any(|power| !power.is_rounding(operations))
}

fn mistake(loads: &[&Cause], directions: &[Direction]) -> Diagnostic {
    let span = loads.iter().find_map(|load| match load {
        Cause::Force(force) => Some(Extent::from(force.name.span())),
        Cause::Gravity | Cause::Inertia => None,
    });
    let names: Vec<String> = match loads {
        [] => vec!["a load".to_owned()],
        [first, others @ ..] if others.len() >= FEW => {
            vec![first.text(), format!("{} other loads", others.len())]
        }
        loads => loads.iter().map(|load| load.text()).collect(),
    };
    let along: Vec<String> = directions.iter().map(|direction| direction.text.clone()).collect();
    let verb = if names.len() == 1 { "acts" } else { "act" };
    let message = format!("{} {verb} along {}, which nothing holds", listed(&names), listed(&along));
    let balance = match names.len() {
        1 => "drive it, or let it coast against a drag",
        _ => "drive it, let it coast against a drag, or make one load a function of the others",
    };
    Diagnostic::new(span.unwrap_or(directions[0].span), message).with_help(format!("hold it by a spring, {balance}"))
}
