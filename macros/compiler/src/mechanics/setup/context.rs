//! The data that every step of the derivation reads.

use crate::algebra::{ExprId, Graph, evaluate, substitute};
use crate::base::ids::CoordinateId;
use crate::model::mechanism::Mechanism;
use crate::topology::Topology;

use super::excited::Excited;
use super::harmonics::Harmonics;
use super::multiblade::Multiblade;
use super::rows::{Row, Source};
use super::runs::Runs;
use super::sections::Sections;
use super::symbols::Symbols;
use super::values::Values;

/// The data that every step of the derivation reads.
pub(crate) struct Context<'a> {
    pub(crate) mechanism: &'a Mechanism,
    pub(crate) topology: &'a Topology,
    pub(crate) symbols: &'a Symbols,
    pub(crate) values: &'a Values<'a>,
    /// The coordinates in which inertia and weight are derived.
    pub(crate) runs: &'a Runs,
    /// The sections of beams.
    pub(crate) sections: &'a Sections,
    /// The equations of constraints.
    pub(crate) rows: &'a [Row],
    /// The coordinates of blades that the unknowns stand for.
    pub(crate) multiblade: &'a Multiblade,
    /// The harmonics of steady motion.
    pub(crate) harmonics: &'a Harmonics,
    /// What excitations add.
    pub(crate) excited: &'a Excited,
}

impl Context<'_> {
    /// Number of free coordinates, and number of coordinates with an equation of motion: free and coasting.
    pub(crate) fn moving(&self) -> (usize, usize) {
        let free = self.topology.free.len();
        (free, free + self.topology.coasting.len())
    }

    /// The index of an equation; `None` if it always holds, whatever the mechanism does.
    pub(crate) fn row(&self, source: Source, component: usize) -> Option<usize> {
        self.rows.iter().position(|row: &Row| row.source == source && row.component == component)
    }

    /// The multiplier of a constraint equation.
    pub(crate) fn multiplier(&self, row: usize) -> ExprId {
        self.symbols.q.values[self.moving().1 + row]
    }

    /// Value of an expression of inputs and design variables at the nominal design. Inputs have no nominal values and
    /// are set to one.
    pub(crate) fn nominal(&self, g: &Graph, value: ExprId) -> f64 {
        let value = evaluate(g, &[value], |symbol| {
            let mut nominal = self.symbols.b.ids.iter().zip(&self.mechanism.design).filter(|(id, _)| **id == symbol);
            nominal.next().map_or(1.0, |(_, variable)| variable.nominal)
        });
        value[0]
    }

    /// For each unknown, the position of its joint in the order from the ground to the leaves; reactions come last.
    pub(crate) fn outward_order(&self) -> Vec<usize> {
        let branch_index = |id: &CoordinateId| {
            let joint = self.mechanism.coordinates[id.index()].joint;
            self.topology.branches.iter().position(|branch| branch.joint == joint).unwrap_or(0)
        };
        let reactions = self.rows.iter().map(|_| usize::MAX);
        let mut order: Vec<usize> =
            self.topology.free.iter().chain(&self.topology.coasting).map(branch_index).chain(reactions).collect();
        let coordinates = order.clone();
        order.extend(coordinates.iter().cycle().take(self.symbols.q.ids.len() - coordinates.len()));
        order
    }

    /// Replaces each absolute angle by its sum of joint angles, and each section's rotation by its sum of coordinates.
    pub(crate) fn in_unknowns(&self, g: &mut Graph, roots: &[ExprId]) -> Vec<ExprId> {
        let mut sums = self.runs.sums(g, self.symbols);
        sums.extend(self.sections.sums(g, self.symbols));
        substitute(g, roots, &sums)
    }
}
