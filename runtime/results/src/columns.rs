//! The columns of a table, each written once: as data, and in the text if it belongs there.

use eigentol_contract::{Description, Unit};

use crate::grid::Grid;
use crate::numbers::{converted, heading, or_dash};
use crate::table::{Column, Table, Values};

/// A table under construction: its rows are known, and each column says what it takes from a row.
///
/// A column is data in SI or declared units; what it is called and how it looks in the text follows from a further call.
///
/// ```
/// use eigentol_results::columns::Columns;
/// use eigentol_results::numbers::rough;
///
/// let mut table = Columns::new("modes", &[(1, 2.5), (2, 7.0)]);
/// table.whole("mode", &|row| Some(row.0)).shown();
/// table.number("frequency", "rad/s", &|row| Some(row.1)).digits(rough);
/// table.number("square", "rad^2/s^2", &|row| Some(row.1 * row.1));
/// let (data, text) = table.finish();
/// assert_eq!(data.columns.len(), 3);
/// assert_eq!(text.to_string(), "  mode  frequency [rad/s]\n  1                 2.500\n  2                 7.000\n");
/// ```
pub struct Columns<'a, R> {
    rows: &'a [R],
    /// The rows of the text.
    shown: Vec<usize>,
    table: Table,
    text: Vec<(String, Vec<String>)>,
}

impl<'a, R> Columns<'a, R> {
    /// A table of this name with these rows and no columns yet.
    pub fn new(name: &str, rows: &'a [R]) -> Self {
        Self { rows, shown: (0..rows.len()).collect(), table: Table::new(name), text: Vec::new() }
    }

    /// Only these rows belong in the text. To be called before the first column.
    pub fn show_rows(&mut self, rows: Vec<usize>) {
        self.shown = rows;
    }

    /// A column of numbers; what is not finite counts as missing.
    pub fn number(&mut self, name: &str, unit: &str, of: &dyn Fn(&R) -> Option<f64>) -> Added<'_> {
        self.table.numbers(name, unit, self.rows.iter().map(of));
        self.added()
    }

    /// A column of numbers that are converted from SI to a declared unit.
    pub fn measured(&mut self, name: &str, unit: &Unit, of: &dyn Fn(&R) -> Option<f64>) -> Added<'_> {
        let values = self.rows.iter().map(|row| Some(converted(of(row)?, unit)));
        self.table.numbers(name, &unit.symbol, values);
        self.added()
    }

    /// A column of whole numbers.
    pub fn whole(&mut self, name: &str, of: &dyn Fn(&R) -> Option<usize>) -> Added<'_> {
        self.table.whole(name, self.rows.iter().map(of));
        self.added()
    }

    /// A column of words.
    pub fn words(&mut self, name: &str, of: &dyn Fn(&R) -> Option<String>) -> Added<'_> {
        self.table.texts(name, self.rows.iter().map(of));
        self.added()
    }

    /// A column of yes and no.
    pub fn flag(&mut self, name: &str, of: &dyn Fn(&R) -> Option<bool>) -> Added<'_> {
        self.table.flags(name, self.rows.iter().map(of));
        self.added()
    }

    /// A column of the text alone.
    pub fn cells(&mut self, heading: &str, of: &dyn Fn(&R) -> String) {
        self.text.push((heading.to_owned(), self.shown.iter().map(|&row| of(&self.rows[row])).collect()));
    }

    /// A column of the text alone: frequencies, rad/s, in the unit of answers.
    pub fn frequencies(
        &mut self,
        name: &str,
        d: &Description,
        form: fn(f64) -> String,
        of: &dyn Fn(&R) -> Option<f64>,
    ) {
        let unit = &d.frequency;
        self.cells(&heading(name, unit), &|row| or_dash(of(row).map(|omega| converted(omega, unit)), form));
    }

    /// One column of data for each design variable: its value in a row that has a design.
    pub fn design(&mut self, d: &Description, of: &dyn Fn(&R) -> Option<&[f64]>) {
        for (k, info) in d.design.iter().enumerate() {
            self.measured(&info.name, &info.unit, &|row| of(row)?.get(k).copied());
        }
    }

    /// One column of data for each unknown: its value in a row that has a state.
    pub fn unknowns(&mut self, d: &Description, of: &dyn Fn(&R) -> Option<&[f64]>) {
        for (i, info) in d.coordinates.iter().enumerate() {
            self.measured(&info.name, &info.unit, &|row| of(row)?.get(i).copied());
        }
    }

    /// One column of data for the share of each design variable in a variance.
    pub fn shares(&mut self, d: &Description, of: &dyn Fn(&R) -> Option<&[f64]>) {
        for (k, info) in d.design.iter().enumerate() {
            let name = format!("variance share of {}", info.name);
            self.number(&name, "", &|row| of(row)?.get(k).copied());
        }
    }

    /// The data and the text; the text is empty if no column belongs in it.
    pub fn finish(self) -> (Table, Grid) {
        let mut grid = Grid::new(self.text.iter().map(|(heading, _)| heading.clone()).collect());
        for row in 0..self.shown.len() {
            grid.row(self.text.iter().map(|(_, cells)| cells[row].clone()).collect());
        }
        (self.table, grid)
    }

    fn added(&mut self) -> Added<'_> {
        Added { column: self.table.columns.last(), shown: &self.shown, text: &mut self.text }
    }
}

/// The column that was added last, which may belong in the text too.
pub struct Added<'c> {
    column: Option<&'c Column>,
    shown: &'c [usize],
    text: &'c mut Vec<(String, Vec<String>)>,
}

impl Added<'_> {
    /// It belongs in the text as it is: whole numbers, words, yes and no.
    pub fn shown(self) -> Self {
        self.digits(crate::numbers::number)
    }

    /// It belongs in the text, numbers with this many digits: [`number`](crate::numbers::number),
    /// [`rough`](crate::numbers::rough), [`short`](crate::numbers::short), [`percent`](crate::numbers::percent).
    pub fn digits(self, form: fn(f64) -> String) -> Self {
        if let Some(column) = self.column {
            let cells = self.shown.iter().map(|&row| column.values.shown(row, form)).collect();
            self.text.push((column.heading(), cells));
        }
        self
    }

    /// It belongs in the text, SI numbers in this unit with this many digits.
    pub fn digits_in(self, unit: &Unit, form: fn(f64) -> String) -> Self {
        if let Some(column) = self.column
            && let Values::Numbers(values) = &column.values
        {
            let cell = |&row: &usize| or_dash(values[row].map(|value| converted(value, unit)), form);
            self.text.push((heading(&column.name, unit), self.shown.iter().map(cell).collect()));
        }
        self
    }

    /// What the text calls it instead.
    pub fn headed(self, heading: &str) {
        if let Some((title, _)) = self.text.last_mut() {
            heading.clone_into(title);
        }
    }
}

impl Values {
    /// One entry as text; `-` if it is missing.
    fn shown(&self, row: usize, form: fn(f64) -> String) -> String {
        let text = match self {
            Self::Numbers(values) => values[row].map(form),
            Self::Whole(values) => values[row].map(|value| value.to_string()),
            Self::Texts(values) => values[row].clone(),
            Self::Flags(values) => values[row].map(|yes| if yes { "yes" } else { "no" }.to_owned()),
        };
        text.unwrap_or_else(|| "-".to_owned())
    }
}
