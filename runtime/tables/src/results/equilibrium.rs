use eigentol::Equilibrium;
use eigentol::equilibrium::{Assembly, Equilibria};

use super::Tables;
use super::names::{operating_point, unknowns, word};
use crate::Table;

/// One row for each state: unknowns, stability.
pub(super) fn states(name: &str, states: &[Equilibrium]) -> Vec<Table> {
    let Some(one) = states.first() else {
        return Vec::new();
    };
    let d = &one.description;
    let mut table = Table::new(name);
    let coordinates = states.iter().map(|state| Some(&state.coordinates[..]));
    unknowns(&mut table, d, coordinates);
    table.texts("stability", states.iter().map(stability));
    let residual = states.iter().map(|state| state.relative_residual);
    table.numbers("relative residual", "", residual);
    operating_point(&mut table, d, &one.inputs, None);
    vec![table]
}

pub(super) fn stability(state: &Equilibrium) -> Option<String> {
    match state.constraints.singular {
        true => word("not decided in a singular configuration"),
        false => Some(state.stability.to_string()),
    }
}

/// `equilibrium`: one row, a column for each unknown.
impl Tables for Equilibrium {
    fn tables(&self) -> Vec<Table> {
        states("equilibrium", std::slice::from_ref(self))
    }
}

/// `equilibria`: a row for each.
impl Tables for Equilibria {
    fn tables(&self) -> Vec<Table> {
        states("equilibria", self)
    }
}

/// `assembly`: one row, a column for each unknown.
impl Tables for Assembly {
    fn tables(&self) -> Vec<Table> {
        let d = &self.description;
        let mut table = Table::new("assembly");
        unknowns(&mut table, d, [Some(&self.coordinates[..])].into_iter());
        table.numbers("margin to dead centre", "", [self.margin]);
        table.flags("singular", [self.singular || self.constraints.singular]);
        operating_point(&mut table, d, &self.inputs, None);
        vec![table]
    }
}
