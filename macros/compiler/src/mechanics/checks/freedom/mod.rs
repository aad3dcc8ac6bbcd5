//! Directions in which nothing determines where a mechanism stands: motions that leave its equations as they are.
//!
//! The equations are a covector field `g` over the free coordinates. A vector field `zeta` leaves them as they are if its
//! Lie derivative of `g` vanishes everywhere. Wherever the forces balance, `K zeta = 0` then: an equilibrium may be moved
//! along the field, and the mechanism has a mode of frequency zero. That is no mistake unless a load acts along the
//! direction. The candidates are few ([`fields`]), and the proof is by evaluation at random places and designs.
//!
//! What ties bodies to each other leaves their motion as a whole exactly as it is. These few combinations are tested by
//! themselves first, so that nothing but rounding of single terms is left in them, however different the stiffnesses are.
//! Other combinations come from elimination, where rounding grows from piece to piece: what it leaves in doubt counts as
//! held. A load is refused only where the mechanism does not rest, and where it does the same work at other places too.

mod count;
mod fields;
mod loads;
mod state;
mod symmetry;
mod units;
mod words;

use crate::algebra::Graph;
use crate::base::diagnostics::{Diagnostics, listed};
use crate::mechanics::equations::Equations;
use crate::mechanics::functions::FreeDirections;
use crate::mechanics::linear::Jacobians;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, columns};

use count::{Proof, at_random, count};
use fields::Fields;
use loads::{causes, mistakes, unbalanced, works};
use state::{Friction, System};
use units::Units;
use words::{described, note};

/// The nominal design.
const NOMINAL: u64 = 0;

/// Random designs that must agree.
const DESIGNS: u64 = 3;

/// Finds the free directions. Fails if loads act along one of them, unless only the kernels are wanted.
pub(crate) fn free_directions(
    g: &mut Graph,
    context: &Context,
    (equations, kinematics): (&Equations, &Kinematics),
    jacobians: &Jacobians,
) -> Result<FreeDirections, Diagnostics> {
    let units = Units::new(g, context, jacobians);
    let fields = Fields::new(g, context, kinematics, units);
    let system = System::new(g, context, equations, jacobians, &fields);
    // Without anything that a design could change, one says all.
    let alike = context.symbols.b.ids.is_empty() && context.symbols.u.ids.is_empty();
    let mut free = FreeDirections { count: usize::MAX, notes: Vec::new(), unbalanced: None };
    let mut first = None;
    for design in (1..=if alike { 1 } else { DESIGNS }).rev() {
        first = count(&system, design);
        let directions = first.as_ref().map_or(0, |count| count.directions);
        free.count = free.count.min(directions);
        if free.count == 0 {
            free.notes.extend(first.and_then(|count| count.hidden()));
            return Ok(free);
        }
    }
    let rests = first.as_ref().is_some_and(|count| count.rests);
    let nominal = if alike { first } else { count(&system, NOMINAL) };
    let state = at_random(&system, NOMINAL, Friction::Any);
    let (Some(nominal), Some(state)) = (nominal, state) else {
        return Ok(free);
    };
    if nominal.directions == free.count {
        free.notes.push(note(&system, &nominal, &state));
    }
    free.notes.extend(nominal.hidden());
    let (symmetries, friction) = match nominal.proof {
        Proof::AtZero(_) => (Vec::new(), Friction::Any),
        Proof::Symmetries(symmetries, friction) => (symmetries, friction),
    };
    let loaded = if nominal.rests { Vec::new() } else { unbalanced(&system, NOMINAL, &symmetries, friction) };
    if loaded.is_empty() {
        let elsewhere = if rests { Vec::new() } else { unbalanced(&system, 1, &symmetries, friction) };
        let text = |along: &Vec<f64>| described(context, &fields, along).text;
        let texts: Vec<String> = elsewhere.iter().map(text).collect();
        if !texts.is_empty() {
            free.unbalanced = Some(format!(
                "the loads along {} balance at the nominal design only; there is no equilibrium beside it",
                listed(&texts)
            ));
        }
        return Ok(free);
    }
    if context.mechanism.kernels_only {
        return Ok(free);
    }
    let of_inputs = columns(g, &equations.rest, &context.symbols.u);
    let causes = causes(g, context, kinematics);
    let system = System::new(g, context, equations, jacobians, &fields);
    let (chosen, loaded): (Vec<_>, Vec<_>) =
        loaded.into_iter().partition(|along| of_inputs.iter().any(|part| works(&system, NOMINAL, along, part)));
    if !chosen.is_empty() {
        let text = |along: &Vec<f64>| described(context, &fields, along).text;
        let texts: Vec<String> = chosen.iter().map(text).collect();
        free.unbalanced = Some(format!(
            "the loads along {} balance for some values of the inputs only; there is no equilibrium for others",
            listed(&texts)
        ));
    }
    let named = |along: Vec<f64>| {
        let direction = described(context, &fields, &along);
        (along, direction)
    };
    let directions = loaded.into_iter().map(named).collect();
    let mut diagnostics = Diagnostics::new();
    for mistake in mistakes(&system, NOMINAL, directions, &causes) {
        diagnostics.push(mistake);
    }
    diagnostics.into_result(free)
}
