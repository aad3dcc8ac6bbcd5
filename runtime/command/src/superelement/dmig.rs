//! Matrices of `DMIG` entries, as Nastran punches them (Quick Reference Guide, `DMIG`).

use eigentol_compiler::matrix_market::{Mistake, Word, lines};

use super::fortran::field;
use super::matrix::{Entry, Matrix, Named, Rows, Wanted, completed};

fn is_entry(line: &Word<'_>) -> bool {
    let start = line.text.get(..5).map(str::to_ascii_uppercase);
    start.is_some_and(|start| ["DMIG ", "DMIG*"].contains(&&*start))
}

pub(super) fn is_it(text: &str) -> bool {
    lines(text).any(|line| is_entry(&line))
}

pub(super) fn read(text: &str, wanted: Wanted<'_>) -> Result<Matrix, Mistake> {
    let mut entries: Vec<Vec<Word<'_>>> = Vec::new();
    let mut is_open = false;
    for line in lines(text).filter(|line| !line.text.trim().is_empty() && !line.text.starts_with('$')) {
        if is_entry(&line) {
            entries.push(Vec::new());
            is_open = true;
        } else if !line.text.starts_with([' ', '*', '+']) {
            is_open = false;
        }
        let (count, width) = if line.text.chars().take(8).any(|c| c == '*') { (4, 16) } else { (8, 8) };
        if let Some(entry) = entries.last_mut().filter(|_| is_open) {
            entry.extend((0..count).map(|k| field(line, 8 + k * width, width)));
        }
    }
    let mut all: Vec<Listed<'_>> = Vec::new();
    for entry in entries {
        let [name, node, third, fourth, ref rest @ ..] = entry[..] else { continue };
        let known = all.iter_mut().find(|listed| listed.name.text.eq_ignore_ascii_case(name.text));
        match known {
            Some(listed) if node.text != "0" => listed.column(node, third, rest)?,
            None if node.text == "0" => {
                all.push(Listed { name, form: third, kind: fourth, rows: Rows::default(), entries: Vec::new() });
            }
            _ => return Err(name.mistake(format!("`{}` must have one header, before its columns", name.shown()))),
        }
    }
    wanted.among(all.into_iter().map(Listed::named).collect())
}

/// A matrix while its entries are read.
struct Listed<'t> {
    name: Word<'t>,
    form: Word<'t>,
    kind: Word<'t>,
    rows: Rows,
    entries: Vec<Entry>,
}

impl Listed<'_> {
    /// The entries of a column: node, direction, real part, imaginary part.
    fn column(&mut self, node: Word<'_>, toward: Word<'_>, rest: &[Word<'_>]) -> Result<(), Mistake> {
        let column = self.rows.row(node, toward)?;
        for four in rest.chunks(4) {
            let [node, toward, value, ..] = *four else { continue };
            if [node, toward, value].iter().any(|word| !word.text.is_empty()) {
                self.entries.push((self.rows.row(node, toward)?, column, value.number()?));
            }
        }
        Ok(())
    }

    fn named(self) -> Named {
        let matrix = match (self.form.text, self.kind.text) {
            ("1", "1" | "2") => Ok(self.rows.matrix(self.entries)),
            ("6", "1" | "2") => Ok(self.rows.matrix(completed(self.entries))),
            ("1" | "6", _) => Err(self.kind.mistake("the matrix must be real: of type 1 or 2")),
            _ => Err(self.form.mistake("the matrix must be square: of form 1, or 6 if it is symmetric")),
        };
        (self.name.text.to_owned(), matrix)
    }
}
