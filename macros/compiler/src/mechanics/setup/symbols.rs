//! The symbols in which the equations are written.

use crate::algebra::{ExprId, Graph, Stage, SymbolId};
use crate::base::ids::CoordinateId;
use crate::model::mechanism::Mechanism;
use crate::topology::Topology;

/// A list of symbols with their expressions, one per entry of an array.
#[derive(Clone, Debug, Default)]
pub(crate) struct SymbolList {
    /// Ids, for differentiation and substitution.
    pub(crate) ids: Vec<SymbolId>,
    /// The corresponding expressions.
    pub(crate) values: Vec<ExprId>,
}

impl SymbolList {
    fn new(g: &mut Graph, stage: Stage, names: impl IntoIterator<Item = String>) -> Self {
        let (ids, values) = names.into_iter().map(|name| g.symbol(name, stage)).unzip();
        Self { ids, values }
    }

    /// Pairs each symbol with a value: a direction or a replacement.
    pub(crate) fn with<'a>(&'a self, values: &'a [ExprId]) -> impl Iterator<Item = (SymbolId, ExprId)> + 'a {
        self.ids.iter().copied().zip(values.iter().copied())
    }
}

/// The vectors of the bilinear form `left^T (Mhat acceleration + Chat velocity + Khat position)`.
#[derive(Clone, Debug)]
pub(crate) struct Pencil {
    pub(crate) left: SymbolList,
    pub(crate) acceleration: SymbolList,
    pub(crate) velocity: SymbolList,
    pub(crate) position: SymbolList,
}

impl Pencil {
    fn new(g: &mut Graph, coordinates: &[String]) -> Self {
        let mut list = |vector: &str| {
            let names = coordinates.iter().map(|name| format!("{vector}_{name}"));
            SymbolList::new(g, Stage::Rate, names)
        };
        Self {
            left: list("left"),
            acceleration: list("acceleration"),
            velocity: list("velocity"),
            position: list("position"),
        }
    }
}

/// Every symbol of a mechanism's equations.
#[derive(Clone, Debug)]
pub(crate) struct Symbols {
    /// The unknowns: free coordinates, speeds of coasting ones, reactions of constraints.
    pub(crate) q: SymbolList,
    /// Rates of the unknowns.
    pub(crate) velocity: SymbolList,
    /// Second derivatives of the unknowns.
    pub(crate) acceleration: SymbolList,
    /// Running coordinates, driven and coasting; they occur only while the steady state is being checked.
    pub(crate) running: SymbolList,
    /// Inputs.
    pub(crate) u: SymbolList,
    /// Design variables.
    pub(crate) b: SymbolList,
    /// A mode.
    pub(crate) phi: SymbolList,
    /// Eigenvalue of the mode (one entry).
    pub(crate) lambda: SymbolList,
    /// Weights on the residual.
    pub(crate) w: SymbolList,
    /// Vectors around the linearised matrices.
    pub(crate) pencil: Pencil,
    /// Real and imaginary part of a vibration.
    pub(crate) real: SymbolList,
    pub(crate) imaginary: SymbolList,
}

impl Symbols {
    /// The symbols without reactions of constraints.
    pub(crate) fn new(g: &mut Graph, mechanism: &Mechanism, topology: &Topology) -> Self {
        let coordinate = |id: CoordinateId| mechanism.coordinates[id.index()].name.to_string();
        let free: Vec<String> = topology
            .free
            .iter()
            .copied()
            .map(coordinate)
            .chain(topology.coasting.iter().map(|&id| format!("speed_{}", coordinate(id))))
            .collect();
        let running: Vec<String> = topology.running().map(coordinate).collect();
        let inputs: Vec<String> = mechanism.inputs.iter().map(|x| x.name.to_string()).collect();
        let design: Vec<String> = mechanism.design.iter().map(|x| x.name.to_string()).collect();
        let one = |name: &str| vec![name.to_owned()];
        let named = |prefix: &str, names: &[String]| -> Vec<String> {
            names.iter().map(|name| format!("{prefix}{name}")).collect()
        };
        Self {
            b: SymbolList::new(g, Stage::Design, design.clone()),
            u: SymbolList::new(g, Stage::Input, inputs.clone()),
            q: SymbolList::new(g, Stage::Configuration, free.clone()),
            running: SymbolList::new(g, Stage::Configuration, running),
            velocity: SymbolList::new(g, Stage::Rate, named("rate_", &free)),
            acceleration: SymbolList::new(g, Stage::Rate, named("acceleration_", &free)),
            phi: SymbolList::new(g, Stage::Rate, named("phi_", &free)),
            lambda: SymbolList::new(g, Stage::Rate, one("lambda")),
            w: SymbolList::new(g, Stage::Rate, named("w_", &free)),
            pencil: Pencil::new(g, &free),
            real: SymbolList::new(g, Stage::Rate, named("real_", &free)),
            imaginary: SymbolList::new(g, Stage::Rate, named("imaginary_", &free)),
        }
    }

    /// Gives the blades of `equal` rings the mean of their design variables.
    pub(crate) fn share_design(&mut self, g: &mut Graph, mechanism: &Mechanism, equal: &[bool]) {
        let rings = mechanism.rings.iter().zip(equal).filter(|(_, equal)| **equal);
        for ids in rings.flat_map(|(ring, _)| &ring.design) {
            let sum = g.sum(ids.iter().map(|id| self.b.values[id.index()]).collect::<Vec<_>>());
            let mean = g.scale(1.0 / ids.len() as f64, sum);
            for id in ids {
                self.b.values[id.index()] = mean;
            }
        }
    }

    /// Adds the reactions of constraints to the unknowns.
    pub(crate) fn with_reactions(mut self, g: &mut Graph, reactions: &[String]) -> Self {
        let mut extend = |list: &mut SymbolList, stage: Stage, prefix: &str| {
            let names = reactions.iter().map(|name| format!("{prefix}{name}"));
            let more = SymbolList::new(g, stage, names);
            list.ids.extend(more.ids);
            list.values.extend(more.values);
        };
        extend(&mut self.q, Stage::Configuration, "reaction_");
        extend(&mut self.velocity, Stage::Rate, "rate_");
        extend(&mut self.acceleration, Stage::Rate, "acceleration_");
        extend(&mut self.phi, Stage::Rate, "phi_");
        extend(&mut self.w, Stage::Rate, "w_");
        extend(&mut self.real, Stage::Rate, "real_");
        extend(&mut self.imaginary, Stage::Rate, "imaginary_");
        extend(&mut self.pencil.left, Stage::Rate, "left_");
        extend(&mut self.pencil.acceleration, Stage::Rate, "acceleration_");
        extend(&mut self.pencil.velocity, Stage::Rate, "velocity_");
        extend(&mut self.pencil.position, Stage::Rate, "position_");
        self
    }
}
