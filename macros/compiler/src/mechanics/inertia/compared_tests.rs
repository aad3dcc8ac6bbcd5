//! A check for tests: compares the walks over the bodies with derivatives of the equations.

use crate::algebra::{Evaluator, ExprId, Graph};
use crate::mechanics::setup::{
    Context, Excited, ForceSelection, Harmonics, Multiblade, Runs, Sections, Symbols, Values, columns, probe, vanish,
};
use crate::model::mechanism::Mechanism;
use crate::topology::Topology;

use super::newton_euler::inertial_at;
use super::variation::variation;

/// Asserts that every entry equals the derivative of its equation, and counts the nonzero derivatives by positions and
/// velocities; `None` if the walks do not apply. Where there are runs, the equations are written in them.
pub(crate) fn compared(mechanism: &Mechanism, topology: &Topology) -> Option<usize> {
    let g = &mut Graph::new();
    let symbols = Symbols::new(g, mechanism, topology);
    let values = Values::new(g, mechanism, &symbols);
    let runs = Runs::new(g, mechanism, topology, &values, &symbols);
    let context = Context {
        mechanism,
        topology,
        symbols: &symbols,
        values: &values,
        runs: &runs,
        sections: &Sections::default(),
        rows: &[],
        multiblade: &Multiblade::default(),
        harmonics: &Harmonics::default(),
        excited: &Excited::default(),
    };
    let running = vec![g.zero(); symbols.running.ids.len()];
    let loads = inertial_at(g, &context, &running, ForceSelection::ALL);
    let variation = variation(g, &context, &running)?;
    let along: Vec<ExprId> = topology.free.iter().map(|id| loads.along[id.index()]).collect();
    let along = runs.forces(g, &along);
    let along = context.in_unknowns(g, &along);
    let mut exact = columns(g, &along, &symbols.q).concat();
    exact.extend(columns(g, &along, &symbols.velocity).concat());
    let by_acceleration = columns(g, &along, &symbols.acceleration).concat();
    let blocks = [variation.by_position, variation.by_velocity, variation.mass].map(|matrix| matrix.concat());
    let entries = blocks.concat();
    let differences: Vec<ExprId> =
        exact.iter().chain(&by_acceleration).zip(&entries).map(|(&one, &other)| g.sub(one, other)).collect();
    let evaluator = Evaluator::new(g, &differences);
    assert!(probe(&evaluator, &context).next().is_some());
    let equal = vanish(g, &context, &differences);
    assert!(equal.iter().all(|equal| *equal), "{equal:?}");
    Some(vanish(g, &context, &exact).into_iter().filter(|zero| !zero).count())
}
