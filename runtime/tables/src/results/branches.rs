use eigentol::branches::{Branch, Branches, SpecialPoint};

use super::Tables;
use super::equilibrium::stability;
use super::names::{operating_point, unknowns, varied};
use crate::Table;

/// A row for each equilibrium of a branch, with the branch number, counted from 1.
///
/// Branches can be written one after the other: all have the same columns.
#[must_use]
pub fn branch_table(number: usize, branch: &Branch) -> Table {
    rows_of(number, std::slice::from_ref(branch), branch)
}

/// The rows of several branches, numbered from `first`; `one` is any branch of the same mechanism.
fn rows_of(first: usize, branches: &[Branch], one: &Branch) -> Table {
    let d = &one.description;
    let rows = || {
        let each = branches.iter().enumerate();
        each.flat_map(|(k, branch)| branch.points.iter().map(move |point| (k, point)))
    };
    let mut table = Table::new("branches");
    table.whole("branch", rows().map(|(k, _)| k + first));
    varied(&mut table, d, one.input, rows().map(|(_, own)| own.value));
    let states: Vec<_> = rows()
        .map(|(_, own)| Some(&own.equilibrium.coordinates[..]))
        .collect();
    unknowns(&mut table, d, states.into_iter());
    table.texts(
        "stability",
        rows().map(|(_, own)| stability(&own.equilibrium)),
    );
    let inputs = one.points.first().map(|own| &own.equilibrium.inputs[..]);
    operating_point(&mut table, d, inputs.unwrap_or_default(), Some(one.input));
    table
}

/// `branches`: the [`branch_table`] of all branches; `special points`: a row for each fold and fork.
fn tables_of(branches: &[Branch]) -> Vec<Table> {
    let Some(one) = branches.first() else {
        return Vec::new();
    };
    let d = &one.description;
    let inputs = one.points.first().map(|own| &own.equilibrium.inputs[..]);
    let table = rows_of(1, branches, one);
    let special: Vec<(usize, &SpecialPoint)> = (branches.iter().enumerate())
        .flat_map(|(k, branch)| branch.special.iter().map(move |own| (k, own)))
        .collect();
    let mut tables = vec![table];
    if !special.is_empty() {
        let each = special.iter();
        let mut table = Table::new("special points");
        table.whole("branch", each.clone().map(|(k, _)| k + 1));
        table.texts(
            "kind",
            each.clone().map(|(_, own)| Some(own.kind.to_string())),
        );
        varied(
            &mut table,
            d,
            one.input,
            each.clone().map(|(_, own)| own.value),
        );
        unknowns(
            &mut table,
            d,
            each.map(|(_, own)| Some(&own.equilibrium.coordinates[..])),
        );
        operating_point(&mut table, d, inputs.unwrap_or_default(), Some(one.input));
        tables.push(table);
    }
    tables
}

/// `branches` and, if any, `special points`.
impl Tables for Branches {
    fn tables(&self) -> Vec<Table> {
        tables_of(&self.branches)
    }
}

/// Written as a list of one.
impl Tables for Branch {
    fn tables(&self) -> Vec<Table> {
        tables_of(std::slice::from_ref(self))
    }
}
