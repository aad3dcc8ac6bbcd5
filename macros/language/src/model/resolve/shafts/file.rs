//! A table of sections in a file of comma-separated values: a row for each section, its cells as they stand in a declaration.
//! The first row may give units, as in `length [mm], outer [mm], inner [mm], material`, to cells that are plain numbers.

use super::super::resolver::Resolver;
use crate::syntax::ast::{Value, ValueKind};
use crate::syntax::parse::value_of;

/// Most mistakes that are reported of one table: a file of another kind has nothing else.
const MOST_MISTAKES: usize = 3;

impl Resolver<'_> {
    /// The rows of a table, each as its cells.
    pub(super) fn sections_in_file(&mut self, at: &Value, name: &str) -> Option<Vec<Value>> {
        let text = self.text_of_file(at, name)?;
        let sign =
            text.lines().next().unwrap_or_default().chars().find(|sign| [';', '\t'].contains(sign)).unwrap_or(',');
        let is_row = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
        let mut rows = Vec::new();
        let mut units: Option<Vec<Option<String>>> = None;
        let mut mistakes = Vec::new();
        for (k, line) in text.lines().enumerate().filter(|(_, line)| is_row(line)) {
            let cells = cells(line, sign);
            if rows.is_empty() && units.is_none() && cells[0].to_ascii_lowercase().starts_with("length") {
                units = Some(cells.iter().map(|cell| unit(cell)).collect());
                continue;
            }
            if let Some(expected) = units.as_ref().map(Vec::len).filter(|expected| *expected != cells.len()) {
                mistakes.push(format!("line {} has {} cells, the first row {expected}", k + 1, cells.len()));
                continue;
            }
            let mut row = Vec::new();
            for (column, cell) in cells.iter().enumerate().filter(|(_, cell)| !cell.is_empty()) {
                let unit = units.as_ref().and_then(|units| units[column].as_ref());
                let is_bare = cell.parse::<f64>().is_ok_and(|number| number != 0.0);
                let written = match unit {
                    Some(unit) if is_bare => format!("{cell} {unit}"),
                    None if is_bare => {
                        mistakes.push(format!("line {}, column {}: `{cell}` has no unit", k + 1, column + 1));
                        continue;
                    }
                    _ => cell.clone(),
                };
                match value_of(&written, at.extent) {
                    Some(value) => row.push(value),
                    None => mistakes.push(format!("line {}, column {}: `{written}` is no value", k + 1, column + 1)),
                }
            }
            rows.push(Value::new(ValueKind::Vector(row, None), at.extent));
        }
        if rows.is_empty() && mistakes.is_empty() {
            mistakes.push("there is no section".to_owned());
        }
        for mistake in mistakes.iter().take(MOST_MISTAKES) {
            let help = "a row is a section as in `sections: [[120 mm, 40 mm, 20 mm, steel]]`, the first row may be `length [mm], outer [mm], inner [mm], material`";
            self.diagnostics.error_with_help(at.extent, format!("{name}, {mistake}"), help);
        }
        mistakes.is_empty().then_some(rows)
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
