//! Directions in which nothing determines where a mechanism stands: motions that leave its equations as they are.
//!
//! The equations are a covector field `g` over the free coordinates. A vector field `zeta` leaves them as they are if its
//! Lie derivative of `g` vanishes everywhere. Wherever the forces balance, `K zeta = 0` then: an equilibrium may be moved
//! along the field, and the mechanism has a mode of frequency zero. That is no mistake unless a load acts along the
//! direction. The candidates are few ([`fields`]), and the proof is by evaluation at random places and designs.

mod count;
mod fields;
mod loads;
mod state;
mod symmetry;
mod words;

use crate::algebra::Graph;
use crate::base::diagnostics::Diagnostics;
use crate::mechanics::equations::Equations;
use crate::mechanics::functions::FreeDirections;
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::Context;

use count::count;
use fields::Fields;
use state::System;

/// Random designs that must agree.
const DESIGNS: u64 = 3;

/// Finds the free directions. Fails if loads act along one of them, unless only the kernels are wanted.
pub(crate) fn free_directions(
    g: &mut Graph,
    context: &Context,
    equations: &Equations,
    jacobians: &Jacobians,
) -> Result<FreeDirections, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let fields = Fields::new(g, context);
    let system = System::new(g, context, equations, jacobians, &fields);
    let mut directions = None;
    for design in 1..=DESIGNS {
        let own = count(&system, design).map_or(0, |count| count.directions);
        directions = Some(directions.map_or(own, |least: usize| least.min(own)));
        if directions == Some(0) {
            break;
        }
    }
    let directions = directions.unwrap_or(0);
    let mut found = FreeDirections {
        count: directions,
        notes: Vec::new(),
    };
    diagnostics.into_result(found)
}
