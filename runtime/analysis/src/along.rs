//! What the results along an input have in common: the varied input, the unknowns that move, critical vectors.

use eigentol_results::numbers::{as_written, counted, heading, in_unit, number, rough, with_unit};
use eigentol_results::relevance::{largest, names, of_its_kind, unless_rounding};
use eigentol_results::{Answer, Columns, Findings, Listed, Subject};

use crate::{Description, Equilibrium, Input, Role};

/// The name of an input.
pub fn name_of(d: &Description, input: Input) -> &str {
    let info = d.inputs.get(input.index());
    info.map_or("?", |info| &*info.name)
}

/// `speed [rpm]`.
pub(crate) fn heading_of(d: &Description, input: Input) -> String {
    let info = d.inputs.get(input.index());
    info.map_or_else(String::new, |info| heading(&info.name, &info.unit))
}

/// A value of the input (SI) in its declared unit.
pub(crate) fn value_of(d: &Description, input: Input, value: f64) -> String {
    let info = d.inputs.get(input.index());
    info.map_or_else(|| number(value), |info| in_unit(value, &info.unit))
}

/// `speed = 3000 rpm`.
pub fn place(d: &Description, input: Input, value: f64) -> String {
    let value_text = value_of(d, input, value);
    let value_text = match d.inputs.get(input.index()) {
        Some(info) => with_unit(value_text, &info.unit),
        None => value_text,
    };
    format!("{} = {value_text}", name_of(d, input))
}

/// The state where something happens; `what` says so with the place.
pub(crate) fn happening(at: &Equilibrium, input: Input, value: f64, what: impl FnOnce(String) -> String) -> Findings {
    let d = &at.description;
    let mut said = Subject::along(d, &at.inputs, input).titled(what(place(d, input, value)));
    said.quote(at.findings());
    said
}

/// The varied input as a column, as the user wrote it.
pub fn varied<R>(
    table: &mut Columns<'_, R>,
    d: &Description,
    input: Input,
    form: fn(f64) -> String,
    of: &dyn Fn(&R) -> f64,
) {
    if let Some(info) = d.inputs.get(input.index()) {
        let written = |row: &R| Some(as_written(of(row), &info.unit));
        table.number(&info.name, &info.unit.symbol, &written).digits(form);
    }
}

/// Says that a computation along an input was stopped.
pub fn not_reached(said: &mut Findings, unreached: usize) {
    if unreached > 0 {
        said.note(format!("Not complete: {unreached} of the values were not reached."));
    }
}

/// What several say together: their number and their table.
pub(crate) fn together<T: Listed, R>(all: &[T], table: Option<Columns<'_, R>>, one: &str) -> Findings {
    let of = all.first().and_then(Listed::subject);
    let (Some(of), Some(table)) = (of, table) else {
        return Findings::titled(format!("no {one}s"));
    };
    let mut said = of.titled(counted(all.len(), one));
    said.columns(table);
    said
}

/// The unknowns that are nonzero somewhere, which the text shows.
pub(crate) struct Moving<'a> {
    description: &'a Description,
    columns: Vec<usize>,
    still: Vec<&'a str>,
}

impl<'a> Moving<'a> {
    /// Those of the unknowns with these roles.
    pub(crate) fn of<'b>(
        d: &'a Description,
        states: impl Iterator<Item = &'b Equilibrium> + Clone,
        roles: &[Role],
    ) -> Self {
        let asked = d.coordinates.iter().enumerate().filter(|(_, info)| roles.contains(&info.role));
        let moves = |i: &usize| {
            let mut states = states.clone();
            states.any(|state| of_its_kind(d, &state.coordinates, *i) != 0.0)
        };
        let (columns, still): (Vec<usize>, Vec<usize>) = asked.map(|(i, _)| i).partition(moves);
        let known = states.clone().next().is_some();
        let still = still.into_iter().filter(|_| known);
        Self { description: d, columns, still: still.map(|i| &*d.coordinates[i].name).collect() }
    }

    /// A column of the text for each.
    pub(crate) fn columns<R>(&self, table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> Option<&Equilibrium>) {
        for &i in &self.columns {
            table.cells(&self.heading(i), &|row| self.cell(of(row), i));
        }
    }

    /// Two columns of the text for each: where a row begins and where it ends.
    pub(crate) fn columns_from_to<R>(&self, table: &mut Columns<'_, R>, of: &dyn Fn(&R) -> [&Equilibrium; 2]) {
        for &i in &self.columns {
            table.cells(&self.heading(i), &|row| self.cell(Some(of(row)[0]), i));
            table.cells("to", &|row| self.cell(Some(of(row)[1]), i));
        }
    }

    /// Names the others.
    pub(crate) fn rest(&self, said: &mut Findings) {
        if !self.still.is_empty() {
            let still = names(&self.still, "coordinates");
            said.note(format!("Zero all along: {still}."));
        }
    }

    fn heading(&self, i: usize) -> String {
        let info = &self.description.coordinates[i];
        heading(&info.name, &info.unit)
    }

    fn cell(&self, state: Option<&Equilibrium>, i: usize) -> String {
        let d = self.description;
        state.map_or_else(
            || "-".to_owned(),
            |state| {
                let value = of_its_kind(d, &state.coordinates, i);
                in_unit(value, &d.coordinates[i].unit)
            },
        )
    }
}

/// The unknowns of a critical vector, each with its own entries.
pub(crate) fn critical_vectors(said: &mut Findings, d: &Description, v: &[f64], w: &[f64]) {
    let most = [v, w].map(|vector| largest(vector.iter().copied()));
    let entries = d.coordinates.iter().zip(v.iter().zip(w));
    let (rows, zero): (Vec<_>, Vec<_>) = entries
        .map(|(info, (&v, &w))| {
            let entry = [unless_rounding(v, most[0]), unless_rounding(w, most[1])];
            (&*info.name, entry)
        })
        .partition(|(_, entry)| *entry != [0.0, 0.0]);
    let mut table = Columns::new("critical vectors", &rows);
    table.cells("coordinate", &|(name, _)| (*name).to_owned());
    table.cells("critical mode v", &|(_, entry)| rough(entry[0]));
    table.cells("left vector w", &|(_, entry)| rough(entry[1]));
    said.text(table.finish().1);
    if !zero.is_empty() {
        let (zero, all) = (zero.len(), d.coordinates.len());
        said.note(format!("Zero: the other {zero} of {all}."));
    }
}
