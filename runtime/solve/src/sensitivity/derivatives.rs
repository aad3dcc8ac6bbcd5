//! Derivatives of quantities by all variables, as text and data.

use eigentol_results::columns::Columns;
use eigentol_results::grid::{Grid, cells};
use eigentol_results::numbers::{converted, heading, of_mode, per, rough};
use eigentol_results::relevance::{BELOW, largest, names, relevant, unless_rounding};
use eigentol_results::{Findings, Table};

use crate::{Description, Text, Unit};

/// A variable: an input or a design variable.
pub struct Variable<'a> {
    pub name: &'a Text,
    pub unit: &'a Unit,
    /// SI.
    pub value: f64,
}

/// All variables, inputs first.
pub fn variables<'a>(d: &'a Description, inputs: &[f64]) -> Vec<Variable<'a>> {
    let of_inputs = d.inputs.iter().zip(inputs);
    let of_inputs = of_inputs.map(|(info, &value)| Variable { name: &info.name, unit: &info.unit, value });
    let of_design = d.design.iter().map(|info| Variable { name: &info.name, unit: &info.unit, value: info.nominal });
    of_inputs.chain(of_design).collect()
}

/// A quantity and its derivatives.
pub struct Derived {
    pub name: String,
    pub unit: Unit,
    /// It belongs to a mode without derivatives of its own.
    pub clustered: bool,
    /// By each variable, SI; empty if there are none.
    pub slopes: Vec<f64>,
}

impl Derived {
    /// The derivative by variable `j` per SI unit, in the unit of the quantity.
    fn slope(&self, j: usize) -> Option<f64> {
        Some(converted(*self.slopes.get(j)?, &self.unit))
    }

    /// The derivative by variable `j` times its value, or times one if that is zero.
    fn effect(&self, j: usize, variable: &Variable<'_>) -> Option<f64> {
        let size = variable.value.abs();
        Some(self.slope(j)? * if size > 0.0 { size } else { 1.0 })
    }

    fn heading(&self) -> String {
        heading(&self.name, &self.unit)
    }
}

/// A column of the text: a quantity and the largest effect of a variable on it.
struct Shown<'a> {
    of: &'a Derived,
    most: f64,
}

impl<'a> Shown<'a> {
    fn new(of: &'a Derived, variables: &[Variable<'_>]) -> Self {
        let most = largest(variables.iter().enumerate().filter_map(|(j, variable)| of.effect(j, variable)));
        Self { of, most }
    }

    fn depends(&self) -> bool {
        unless_rounding(self.most, 0.0) != 0.0 || self.of.clustered
    }

    /// Whether the variable has one of the large effects. If its value is zero this cannot be judged.
    fn matters(&self, j: usize, variable: &Variable<'_>) -> bool {
        let effect = self.of.effect(j, variable);
        self.of.clustered
            || effect.is_some_and(|effect| {
                if variable.value == 0.0 {
                    unless_rounding(effect, self.most) != 0.0
                } else {
                    relevant(effect, self.most)
                }
            })
    }

    /// The derivative per declared unit of the variable.
    fn cell(&self, j: usize, variable: &Variable<'_>) -> String {
        let effect = self.of.effect(j, variable);
        let rounded = effect.map(|effect| unless_rounding(effect, self.most));
        let slope = self.of.slope(j).map(|slope| slope * variable.unit.scale);
        let slope = if rounded == Some(0.0) { rounded } else { slope };
        of_mode(slope, self.of.clustered, rough)
    }
}

/// Adds a text with one row for each variable that matters to any quantity, in its declared unit, and one column for
/// each quantity that depends on any.
pub fn say(said: &mut Findings, variables: &[Variable<'_>], all: &[Derived]) {
    let columns = all.iter().map(|of| Shown::new(of, variables));
    let (columns, still): (Vec<Shown<'_>>, Vec<Shown<'_>>) = columns.partition(Shown::depends);
    let (rows, left): (Vec<_>, Vec<_>) = (variables.iter().enumerate())
        .partition(|(j, variable)| columns.iter().any(|column| column.matters(*j, variable)));
    let mut head = cells(["derivative by"]);
    head.extend(columns.iter().map(|column| column.of.heading()));
    let mut grid = Grid::new(head);
    for (j, variable) in rows {
        let mut row = vec![per(variable.name, variable.unit)];
        row.extend(columns.iter().map(|column| column.cell(j, variable)));
        grid.row(row);
    }
    said.text(grid);
    let exists = |of: &Derived| variables.is_empty() || !of.slopes.is_empty();
    for (what, exist) in [("All derivatives zero", true), ("No derivative", false)] {
        let selected = still.iter().filter(|column| exists(column.of) == exist);
        let texts: Vec<String> = selected.map(|column| column.of.heading()).collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        if !texts.is_empty() {
            said.note(format!("{what}: {}.", names(&texts, "columns")));
        }
    }
    if !left.is_empty() && !columns.is_empty() {
        let left: Vec<&str> = left.iter().map(|(_, variable)| &**variable.name).collect();
        let names = names(&left, "variables");
        said.note(format!("Left out, relative effect {BELOW} of the strongest: {names}."));
    }
}

/// The data: a row for each quantity, which `what` says, and variable; the derivative in `unit` of the quantity per
/// `per` of the variable.
pub fn data(name: &str, what: &str, variables: &[Variable<'_>], all: &[Derived]) -> Table {
    let rows: Vec<_> = all.iter().flat_map(|of| variables.iter().enumerate().map(move |x| (of, x))).collect();
    let mut table = Columns::new(name, &rows);
    table.words(what, &|row| Some(row.0.name.clone()));
    table.words("unit", &|row| Some(row.0.unit.symbol.to_string()));
    table.words("by", &|row| Some(row.1.1.name.to_string()));
    table.words("per", &|row| Some(row.1.1.unit.symbol.to_string()));
    table.number("derivative", "", &|(of, (j, variable))| {
        let slope = of.slopes.get(*j)? * variable.unit.scale;
        Some(converted(slope, &of.unit))
    });
    table.finish().0
}
