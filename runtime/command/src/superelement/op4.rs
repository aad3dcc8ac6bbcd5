//! Matrices in ASCII files of `OUTPUT4` of Nastran: dense columns, or strings of entries that are not zero (DMAP Programmer's Guide,
//! `OUTPUT4`).

use eigentol_compiler::matrix_market::{Mistake, Word, end, lines};

use super::fortran::{Layout, field};
use super::matrix::{Entry, Matrix, Named, Wanted};

/// The row of a string is packed with its length.
const PACKED: u32 = 65_536;

pub(super) fn is_it(text: &str) -> bool {
    let is_header =
        |line: Word<'_>| (0..4).all(|k| field(line, 8 * k, 8).whole::<i64>("").is_ok()) && layout(line).is_ok();
    lines(text).next().is_some_and(is_header)
}

fn layout(header: Word<'_>) -> Result<Layout, Mistake> {
    let format = field(header, 40, 40);
    Layout::of(if format.text.is_empty() { Word { text: "5E16.9", ..format } } else { format })
}

pub(super) fn read(text: &str, wanted: Wanted<'_>) -> Result<Matrix, Mistake> {
    let mut rest = lines(text);
    let mut all = Vec::new();
    while let Some(header) = rest.by_ref().find(|line| !line.text.trim().is_empty()) {
        all.push(matrix(text, header, &mut rest)?);
    }
    wanted.among(all)
}

/// The next matrix, or why it is of no use; a mistake if what follows it cannot be found.
fn matrix<'t>(text: &'t str, header: Word<'t>, rest: &mut impl Iterator<Item = Word<'t>>) -> Result<Named, Mistake> {
    let [columns, rows, form, kind, name] = [0, 8, 16, 24, 32].map(|from| field(header, from, 8));
    let layout = layout(header)?;
    let width: usize = columns.whole("number of columns")?;
    let order = match (form.text, kind.text) {
        ("1" | "2" | "6", "1" | "2") => Word { text: rows.text.trim_start_matches('-'), ..rows }.order(width),
        ("1" | "2" | "6", _) => Err(kind.mistake("the matrix must be real: of type 1 or 2")),
        _ => Err(form.mistake("the matrix must be square: of form 1, or 6 if it is symmetric")),
    };
    let ends = || end(text, format!("the file ends within the matrix `{}`", name.text));
    // Of double precision, a number takes two words of a string.
    let words = if ["2", "4"].contains(&kind.text) { 2 } else { 1 };
    let mut entries: Vec<Entry> = Vec::new();
    loop {
        let line = rest.next().ok_or_else(ends)?;
        let [column, row, count] = line.words()[..] else {
            return Err(line.mistake("a column begins with its number, its first row and its length"));
        };
        let (column, mut left): (usize, usize) = (column.whole("column")?, count.whole("length of a column")?);
        let dense: u32 = row.whole("first row of a column")?;
        // The column after the last one closes the matrix.
        let is_last = column > width;
        while left > 0 {
            let (row, count, taken) = if dense > 0 {
                (dense, left, left)
            } else {
                let line = rest.next().ok_or_else(ends)?;
                let (length, row, extra): (u32, u32, usize) = match line.words()[..] {
                    [length, row] => (length.whole("length of a string")?, row.whole("row of a string")?, 2),
                    [packed] => {
                        let packed: u32 = packed.whole("row and length of a string")?;
                        (packed / PACKED, packed % PACKED, 1)
                    }
                    _ => return Err(line.mistake("a string begins with its length and its row")),
                };
                let fitting = (length as usize).checked_sub(1).filter(|length| length + extra <= left);
                let length = fitting.ok_or_else(|| line.mistake("the string is longer than its column"))?;
                (row, length / words, length + extra)
            };
            left -= taken;
            for (number, row) in layout.fields(text, rest, count)?.into_iter().zip(row as usize..) {
                if let (Ok(order), false) = (&order, is_last) {
                    let place = row.checked_sub(1).filter(|row| row < order).zip(column.checked_sub(1));
                    let (row, column) = place.ok_or_else(|| number.mistake("this entry is outside the matrix"))?;
                    entries.push((row, column, number.number()?));
                }
            }
        }
        if is_last {
            return Ok((name.text.to_owned(), order.map(|order| Matrix { order, labels: None, entries })));
        }
    }
}
