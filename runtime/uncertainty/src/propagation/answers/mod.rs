//! Spreads, influence and worst cases of responses, as text and tables.

mod influence;
mod spreads;
mod worst_case;

use eigentol_results::Columns;
use eigentol_results::numbers::{converted, heading, number, short};

use crate::propagation::Estimated;
use crate::response::Response;
use crate::{Description, Unit};

/// What is known of a response.
struct Row<T> {
    name: String,
    unit: Unit,
    result: T,
}

impl<T> Row<T> {
    fn new(response: &Response, d: &Description, content: T) -> Self {
        Self { name: response.name(d), unit: response.unit(d), result: content }
    }

    /// A row for each response.
    fn each(responses: &[Response], d: &Description, all: impl IntoIterator<Item = T>) -> Vec<Self> {
        responses.iter().zip(all).map(|(of, x)| Self::new(of, d, x)).collect()
    }

    /// A value in the unit of the response.
    fn in_unit(&self, value: f64) -> f64 {
        converted(value, &self.unit)
    }

    /// Name and unit.
    fn label(&self) -> String {
        heading(&self.name, &self.unit)
    }
}

/// The columns of data `response` and `unit`.
fn names_and_units<T>(table: &mut Columns<'_, Row<T>>) {
    table.words("response", &|row| Some(row.name.clone()));
    table.words("unit", &|row| Some(row.unit.symbol.to_string()));
}

/// The columns `response` and `unit`, which are one in the text.
fn responses<T>(table: &mut Columns<'_, Row<T>>) {
    names_and_units(table);
    table.cells("response", &Row::label);
}

/// The columns of an estimate in the unit of the response, and of its error.
fn estimates<T>(table: &mut Columns<'_, Row<T>>, name: &str, of: &dyn Fn(&T) -> Option<Estimated>) {
    table.number(name, "", &|row| Some(row.in_unit(of(&row.result)?.value))).digits(number);
    errors(table, name, of);
}

/// The column of the errors of an estimate in the unit of the response.
fn errors<T>(table: &mut Columns<'_, Row<T>>, name: &str, of: &dyn Fn(&T) -> Option<Estimated>) {
    let error = table.number(&format!("error of {name}"), "", &|row| Some(row.in_unit(of(&row.result)?.error?)));
    error.digits(short).headed("error");
}
