//! Assembled matrices in the exchange format of Harwell and Boeing, which ANSYS writes with `HBMAT` (Duff, Grimes and Lewis, Users'
//! Guide for the Harwell-Boeing Sparse Matrix Collection, 1992).

use eigentol_compiler::matrix_market::{Mistake, Word, end, lines};

use super::fortran::{Layout, field};
use super::matrix::{Matrix, completed};

pub(super) fn is_it(text: &str) -> bool {
    let kind = text.lines().nth(2).and_then(|line| line.get(..3)).map(str::to_ascii_uppercase);
    kind.is_some_and(|kind| kind.chars().zip(["RCP", "SUHZR", "AE"]).all(|(letter, known)| known.contains(letter)))
}

pub(super) fn read(text: &str) -> Result<Matrix, Mistake> {
    let mut rest = lines(text).skip(1);
    let head: Vec<Word<'_>> = rest.by_ref().take(3).collect();
    let [cards, sizes, formats] = head[..] else { return Err(end(text, "the file ends within its header")) };
    // A further line describes right-hand sides.
    if cards.words().get(4).is_some_and(|count| count.text != "0") {
        rest.next();
    }
    let [kind, rows, columns, count, ..] = sizes.words()[..] else {
        return Err(sizes.mistake("the line has the type of the matrix, its rows, columns and entries"));
    };
    let is_symmetric = kind.text.eq_ignore_ascii_case("RSA");
    if !is_symmetric && !kind.text.eq_ignore_ascii_case("RUA") {
        return Err(kind.mistake("the matrix must be of type RSA or RUA: real and assembled"));
    }
    let order = rows.order(columns.whole("number of columns")?)?;
    let expected: usize = count.whole("number of entries")?;
    let [pointers, indices, values] =
        [(0, 16), (16, 16), (32, 20)].map(|(from, width)| Layout::of(field(formats, from, width)));
    let pointers = pointers?.fields(text, &mut rest, order.saturating_add(1))?;
    let indices = indices?.fields(text, &mut rest, expected)?;
    let values = values?.fields(text, &mut rest, expected)?;
    let mut entries = Vec::new();
    for (column, ends) in pointers.windows(2).enumerate() {
        let [from, to] = [0, 1].map(|k: usize| ends[k].index("entry", indices.len() + 1));
        let (from, to) = (from?, to?);
        if from != entries.len() || to < from {
            return Err(ends[0].mistake("a column begins where the one before it ends"));
        }
        for at in from..to {
            entries.push((indices[at].index("row", order)?, column, values[at].number()?));
        }
    }
    if entries.len() != expected {
        return Err(
            count.mistake(format!("the header says {expected} entries, and the columns have {}", entries.len()))
        );
    }
    Ok(Matrix { order, labels: None, entries: if is_symmetric { completed(entries) } else { entries } })
}
