//! Units of the machine itself, so that what is free does not depend on those of the declaration.

use crate::algebra::{Graph, evaluate};
use crate::base::ids::CoordinateId;
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::{Context, RandomState};

/// Powers of two, in which nothing is rounded: the typical length, the largest elastic energy of such motions, and by
/// unknown a motion or a share of the reaction that does this work.
pub(super) struct Units {
    pub(super) length: f64,
    pub(super) energy: f64,
    pub(super) unknowns: Vec<f64>,
}

impl Units {
    pub(super) fn new(g: &Graph, context: &Context, jacobians: &Jacobians) -> Self {
        let mut units = Self { length: power_of_two(context.mechanism.length), energy: 1.0, unknowns: Vec::new() };
        let topology = context.topology;
        let moving = topology.free.iter().chain(&topology.coasting);
        let motion = |id: &CoordinateId| context.mechanism.coordinates[id.index()].quantity.either(1.0, units.length);
        units.unknowns = moving.map(motion).collect();
        let state = RandomState { design: 1, motion: 1 };
        let (free, ids) = (topology.free.len(), &context.symbols.q.ids);
        let roots: Vec<_> = jacobians.stiffness[..free].iter().flat_map(|column| &column[..free]).copied().collect();
        let stiffness = evaluate(g, &roots, |symbol| {
            let place = ids.iter().position(|id| *id == symbol);
            let unit = place.map_or(1.0, |k| units.unknowns.get(k).copied().unwrap_or(0.0));
            unit * state.value(context, symbol)
        });
        let work =
            |(k, stiffness): (usize, &f64)| stiffness.abs() * units.unknowns[k / free] * units.unknowns[k % free];
        units.energy = power_of_two(stiffness.iter().enumerate().map(work).fold(0.0, f64::max));
        let reaction = |unit: &str| match unit {
            "N" => REACTION * units.energy / units.length,
            _ => REACTION * units.energy,
        };
        let reactions = context.rows.iter().map(|row| reaction(&row.unit));
        let reactions: Vec<f64> = reactions.collect();
        units.unknowns.extend(reactions);
        units
    }
}

/// Share of the elastic forces that a reaction is, small enough for its curvature to hide none of them.
const REACTION: f64 = 1.0 / 64.0;

fn power_of_two(size: f64) -> f64 {
    if size.is_normal() { size.log2().round().exp2() } else { 1.0 }
}
