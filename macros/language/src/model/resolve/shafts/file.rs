//! A table of sections in a file of comma-separated values: a row for each section, its cells as they stand in a declaration.
//! The first row may give units, as in `length [mm], outer [mm], inner [mm], material`, to cells that are plain numbers.

use super::super::resolver::Resolver;
use super::Cell;
use crate::base::dimension::Dimension;
use crate::syntax::ast::Value;
use crate::syntax::parse::value_of;

/// Most mistakes that are reported of one table: a file of another kind has nothing else.
const MOST_MISTAKES: usize = 3;

/// Words of titles: of sizes that follow the length and are no diameters, of outer and of inner ones.
const NONE: [&str; 5] = ["length", "radius", "radii", "wall", "thickness"];
const OUTER: [&str; 3] = ["outer", "outside", "od"];
const INNER: [&str; 4] = ["inner", "inside", "bore", "id"];

/// Whether a title is that of another column than the one after the title before it.
fn is_out_of_order(before: &str, title: &str) -> bool {
    let says = |title: &str, known: &[&str]| {
        title.split(|c: char| !c.is_alphanumeric()).any(|word| known.iter().any(|own| word.eq_ignore_ascii_case(own)))
    };
    let is_first = says(before, &["length", "material"]);
    says(title, &NONE)
        || says(title, &OUTER) && says(before, &OUTER)
        || says(title, &INNER) && (is_first || says(before, &INNER))
}

impl Resolver<'_> {
    /// The rows of a table, each as its cells.
    pub(super) fn sections_in_file(&mut self, at: &Value, name: &str) -> Option<Vec<Vec<Cell>>> {
        let text = self.text_of_file(at, name)?;
        let sign =
            text.lines().next().unwrap_or_default().chars().find(|sign| [';', '\t'].contains(sign)).unwrap_or(',');
        let mut rows = Vec::new();
        let mut units: Option<Vec<Option<String>>> = None;
        let mut mistakes = Vec::new();
        for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with('#')) {
            let cells = cells(line, sign);
            if cells.iter().all(String::is_empty) {
                continue;
            }
            let place = |column: usize| format!("{name}, line {}, column {}: ", k + 1, column + 1);
            if rows.is_empty() && units.is_none() && cells[0].to_ascii_lowercase().starts_with("length") {
                units = Some(self.units_of_titles(at, &cells, &place)?);
                continue;
            }
            if let Some(expected) = units.as_ref().map(Vec::len).filter(|expected| *expected != cells.len()) {
                mistakes.push(format!("{name}, line {} has {} cells, the first row {expected}", k + 1, cells.len()));
                continue;
            }
            let mut row = Vec::new();
            for (column, cell) in cells.iter().enumerate() {
                if cell.is_empty() {
                    let is_size = |next: &String| next.starts_with(|letter: char| letter.is_ascii_digit());
                    if column < 2 || cells.get(column + 1).is_some_and(is_size) {
                        mistakes.push(place(column) + "there is no size");
                    }
                    continue;
                }
                let unit = units.as_ref().and_then(|units| units[column].as_ref());
                let is_bare = cell.parse::<f64>().is_ok_and(|number| number != 0.0);
                let written = match unit {
                    Some(unit) if is_bare => format!("{cell} {unit}"),
                    None if is_bare => {
                        mistakes.push(format!("{}`{cell}` has no unit", place(column)));
                        continue;
                    }
                    _ => cell.clone(),
                };
                match value_of(&written, at.extent) {
                    Some(value) => row.push(Cell { value, place: place(column) }),
                    None => mistakes.push(format!("{}`{written}` is no value", place(column))),
                }
            }
            rows.push(row);
        }
        if rows.is_empty() && mistakes.is_empty() {
            mistakes.push(format!("{name}, there is no section"));
        }
        for mistake in mistakes.iter().take(MOST_MISTAKES) {
            let help = "a row is a section as in `sections: [[120 mm, 40 mm, 20 mm, steel]]`, the first row may be `length [mm], outer [mm], inner [mm], material`";
            self.diagnostics.error_with_help(at.extent, mistake, help);
        }
        mistakes.is_empty().then_some(rows)
    }

    /// The units in the first row, whose titles must not be those of another order.
    fn units_of_titles(
        &mut self,
        at: &Value,
        titles: &[String],
        place: &dyn Fn(usize) -> String,
    ) -> Option<Vec<Option<String>>> {
        let units: Vec<Option<String>> = titles.iter().map(|title| unit(title)).collect();
        if let Some(k) = (1..titles.len()).find(|k| is_out_of_order(&titles[k - 1], &titles[*k])) {
            let message = format!("{}`{}` is not what this column is read as", place(k), titles[k]);
            let help = "the order is length, outer diameter, inner diameter, material; layers around have the last three again";
            self.diagnostics.error_with_help(at.extent, message, help);
            return None;
        }
        for (k, unit) in units.iter().enumerate() {
            let one = unit.as_ref().and_then(|unit| value_of(&format!("1 {unit}"), at.extent));
            if let Some(value) = one {
                let cell = Cell { value, place: place(k) };
                self.in_cell(&cell, |this, value| this.scalar_of(value, Dimension::LENGTH, "the unit of this column"))?;
            }
        }
        Some(units)
    }
}

/// The cells of a line; those in quotes may have the sign that separates them.
fn cells(line: &str, sign: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    for letter in line.chars() {
        match (letter, cells.last_mut()) {
            ('"', _) => is_quoted = !is_quoted,
            (letter, _) if letter == sign && !is_quoted => cells.push(String::new()),
            (letter, Some(cell)) => cell.push(letter),
            (_, None) => {}
        }
    }
    cells.iter().map(|cell| cell.trim().to_owned()).collect()
}

/// The unit in the brackets of a title.
fn unit(title: &str) -> Option<String> {
    let (_, rest) = title.split_once(['[', '('])?;
    rest.split_once([']', ')']).map(|(unit, _)| unit.trim().to_owned())
}
