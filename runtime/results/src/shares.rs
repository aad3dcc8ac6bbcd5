//! Shares of design variables in variances, as columns of a table.

use crate::columns::Columns;
use crate::findings::Findings;
use crate::numbers::percent;
use crate::relevance::{BELOW, COLUMNS, RELEVANT, names, unless_rounding};
use eigentol_contract::Description;

/// At most this many variables are named, and no more than make up this fraction of the variance.
const NAMED: usize = 4;
const MOST: f64 = 0.9;

/// Columns of shares for several quantities: one column for each variable that matters to any of them, or a single one
/// that names the largest.
pub struct Shares<'a> {
    description: &'a Description,
    columns: Vec<usize>,
    below: Vec<&'a str>,
}

impl<'a> Shares<'a> {
    /// Columns for quantities with these shares.
    pub fn of<'b>(description: &'a Description, quantities: impl Iterator<Item = &'b [f64]> + Clone) -> Self {
        let mut columns = Vec::new();
        let mut below = Vec::new();
        for (k, info) in description.design.iter().enumerate() {
            let shares = quantities.clone().filter_map(|shares| shares.get(k));
            if shares.clone().any(|share| share.abs() >= RELEVANT) {
                columns.push(k);
            } else if shares.clone().any(|share| *share != 0.0) {
                below.push(&*info.name);
            }
        }
        Self { description, columns, below }
    }

    fn side_by_side(&self) -> bool {
        self.columns.len() <= COLUMNS
    }

    /// Adds the columns to a text; `of` gives the shares of a row, if it has any.
    pub fn columns<R>(&self, table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> Option<&[f64]>) {
        if !self.side_by_side() {
            table.cells("variance mostly from", &|row| {
                of(row).map_or_else(|| "-".to_owned(), |shares| mostly(self.description, shares))
            });
            return;
        }
        for &k in &self.columns {
            let heading = format!("share of {}", self.description.design[k].name);
            table.cells(&heading, &|row| of(row).map_or_else(|| "-".to_owned(), |shares| share(shares[k])));
        }
    }

    /// Lists the variables that vary and have no column.
    pub fn rest(&self, said: &mut Findings) {
        if !self.below.is_empty() && self.side_by_side() {
            let names = names(&self.below, "variables");
            said.note(format!("Left out, {BELOW} of every variance: {names}"));
        }
    }
}

/// A share in a column in which another share matters.
fn share(value: f64) -> String {
    let value = unless_rounding(value, 1.0);
    if value == 0.0 || value.abs() >= RELEVANT { percent(value) } else { "<0.1 %".to_owned() }
}

/// The largest shares by name: `modulus 52.3 %, diameter 23.2 %`.
pub fn mostly(description: &Description, shares: &[f64]) -> String {
    let mut order: Vec<usize> = (0..description.design.len().min(shares.len())).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    let mut sum = 0.0;
    let mut named = Vec::new();
    for k in order.into_iter().take(NAMED) {
        if sum >= MOST || shares[k] < RELEVANT {
            break;
        }
        sum += shares[k];
        let name = &description.design[k].name;
        named.push(format!("{name} {}", percent(shares[k])));
    }
    if named.is_empty() {
        return "-".to_owned();
    }
    named.join(", ")
}
