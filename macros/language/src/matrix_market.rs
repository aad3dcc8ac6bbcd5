//! Square real matrices in Matrix Market files, as text: the exchange format of NIST
//! (<https://math.nist.gov/MatrixMarket/formats.html>).

use std::cmp::Ordering;
use std::fmt::Write as _;

/// Most rows of a matrix.
pub const MOST_ROWS: usize = 4096;

/// A square real matrix: both halves of a symmetric one, zero-based, in the order of rows and columns, each entry once.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Rows, and columns.
    pub rows: usize,
    /// Row, column, value.
    pub entries: Vec<(usize, usize, f64)>,
}

/// What is wrong in a file, and where: line and column count from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Line.
    pub line: usize,
    /// Column of the first character.
    pub column: usize,
    /// The problem.
    pub message: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Symmetry {
    General,
    Symmetric,
    Skew,
}

/// A word of a line.
#[derive(Clone, Copy)]
struct Word<'t> {
    line: usize,
    column: usize,
    text: &'t str,
}

impl Word<'_> {
    fn mistake(&self, message: String) -> Mistake {
        Mistake { line: self.line, column: self.column, message }
    }

    fn count(&self, meaning: &str) -> Result<usize, Mistake> {
        let count = self.text.parse();
        count.map_err(|_| self.mistake(format!("the {meaning} must be a whole number, not `{}`", shortened(self.text))))
    }

    /// A row or a column, from 0.
    fn index(&self, meaning: &str, rows: usize) -> Result<usize, Mistake> {
        let index = self.count(meaning)?;
        let inside = index.checked_sub(1).filter(|index| *index < rows);
        inside.ok_or_else(|| self.mistake(format!("there is no {meaning} {index}: they count from 1 to {rows}")))
    }

    fn number(&self) -> Result<f64, Mistake> {
        let text = self.text.replace(['d', 'D'], "e");
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(self.mistake(format!("`{}` is not finite", shortened(self.text)))),
            Err(_) => Err(self.mistake(format!("`{}` is not a number", shortened(self.text)))),
        }
    }
}

/// The start of a text that may be long.
fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Reads a matrix.
///
/// ```
/// use eigentol_language::matrix_market::read;
///
/// let stiffness = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 5\n2 1 -3\n2 2 3\n";
/// assert_eq!(read(stiffness).unwrap().entries, [(0, 0, 5.0), (0, 1, -3.0), (1, 0, -3.0), (1, 1, 3.0)]);
/// assert_eq!(read(&stiffness[..60]).unwrap_err().message, "the file ends after 1 of 3 entries");
/// ```
///
/// # Errors
/// If the text is no Matrix Market file, or its matrix is not real, square and of at most 4096 rows.
pub fn read(text: &str) -> Result<Matrix, Mistake> {
    let first = text.lines().next().unwrap_or_default();
    let (is_array, symmetry) = header(first)?;
    let end = end(text);
    let mut lines = (text.lines().enumerate().skip(1))
        .filter(|(_, line)| !line.trim_start().starts_with('%') && !line.trim().is_empty())
        .map(|(k, line)| words(k + 1, line));
    let sizes = lines.next().ok_or_else(|| Mistake { message: "the file ends before its sizes".to_owned(), ..end })?;
    let (rows, expected) = order(&sizes, is_array)?;
    let expected = expected.unwrap_or_else(|| stored(rows, symmetry));
    let mut all = Entries { rows, symmetry, expected, count: 0, entries: Vec::new() };
    if is_array {
        let below = |column| match symmetry {
            Symmetry::General => 0,
            Symmetry::Symmetric => column,
            Symmetry::Skew => column + 1,
        };
        let mut places = (0..rows).flat_map(|column| (below(column)..rows).map(move |row| (row, column)));
        for word in lines.flatten() {
            let place = places.next().ok_or_else(|| all.too_many(word))?;
            all.push(place, word.number()?);
        }
    } else {
        for line in lines {
            let [row, column, value] = line[..] else {
                let shape = "an entry is a line with its row, its column and its value";
                return Err(line[0].mistake(format!("{shape}: this one has {} words", line.len())));
            };
            if all.count == all.expected {
                return Err(all.too_many(row));
            }
            let place = (row.index("row", rows)?, column.index("column", rows)?);
            all.allow(place, row)?;
            all.push(place, value.number()?);
        }
    }
    if all.count < all.expected {
        return Err(Mistake {
            message: format!("the file ends after {} of {} entries", all.count, all.expected),
            ..end
        });
    }
    Ok(Matrix { rows, entries: summed(all.entries)? })
}

/// Entries as they arrive.
struct Entries {
    rows: usize,
    symmetry: Symmetry,
    expected: usize,
    count: usize,
    entries: Vec<(usize, usize, f64)>,
}

impl Entries {
    fn push(&mut self, (row, column): (usize, usize), value: f64) {
        self.count += 1;
        self.entries.push((row, column, value));
        match self.symmetry {
            Symmetry::Symmetric if row != column => self.entries.push((column, row, value)),
            Symmetry::Skew => self.entries.push((column, row, -value)),
            _ => {}
        }
    }

    /// A symmetric matrix lists one half: a file with both would count everything twice.
    fn allow(&self, (row, column): (usize, usize), word: Word<'_>) -> Result<(), Mistake> {
        match self.symmetry {
            Symmetry::Symmetric if row < column => Err(word.mistake(
                "a symmetric matrix lists only what is on and below its diagonal: swap row and column, or call it general"
                    .to_owned(),
            )),
            Symmetry::Skew if row <= column => {
                Err(word.mistake("a skew-symmetric matrix lists only what is below its diagonal".to_owned()))
            }
            _ => Ok(()),
        }
    }

    fn too_many(&self, word: Word<'_>) -> Mistake {
        let Self { rows, expected, .. } = self;
        word.mistake(format!("the file goes on after all {expected} entries of a matrix of order {rows}"))
    }
}

fn header(first: &str) -> Result<(bool, Symmetry), Mistake> {
    let words = words(1, first);
    let expected = |k: usize, known: &str| {
        let (found, column) = match words.get(k) {
            Some(word) => (format!("not `{}`", shortened(word.text)), word.column),
            None => ("which is missing".to_owned(), first.chars().count() + 1),
        };
        Mistake { line: 1, column, message: format!("word {} of a Matrix Market file is {known}, {found}", k + 1) }
    };
    let word = |k: usize| words.get(k).map(|word: &Word<'_>| word.text.to_ascii_lowercase()).unwrap_or_default();
    if word(0) != "%%matrixmarket" {
        return Err(expected(0, "`%%MatrixMarket`"));
    }
    if word(1) != "matrix" {
        return Err(expected(1, "`matrix`"));
    }
    let is_array = match &*word(2) {
        "coordinate" => false,
        "array" => true,
        _ => return Err(expected(2, "`coordinate` or `array`")),
    };
    if !matches!(&*word(3), "real" | "double" | "integer") {
        return Err(expected(3, "here `real` or `integer`"));
    }
    let symmetry = match &*word(4) {
        "general" => Symmetry::General,
        "symmetric" => Symmetry::Symmetric,
        "skew-symmetric" => Symmetry::Skew,
        _ => return Err(expected(4, "here `general`, `symmetric` or `skew-symmetric`")),
    };
    Ok((is_array, symmetry))
}

/// Rows, and entries where the sizes say it.
fn order(sizes: &[Word<'_>], is_array: bool) -> Result<(usize, Option<usize>), Mistake> {
    let (rows, columns, entries) = match *sizes {
        [rows, columns] if is_array => (rows, columns, None),
        [rows, columns, entries] if !is_array => (rows, columns, Some(entries)),
        _ => {
            let expected = if is_array { "rows and columns" } else { "rows, columns and entries" };
            return Err(sizes[0].mistake(format!("the sizes are the numbers of {expected}")));
        }
    };
    let [count, across] = [rows.count("number of rows")?, columns.count("number of columns")?];
    if count != across {
        return Err(rows.mistake(format!("the matrix must be square: this one has {count} rows and {across} columns")));
    }
    if count == 0 || count > MOST_ROWS {
        return Err(rows.mistake(format!("a matrix has from 1 to {MOST_ROWS} rows, not {count}")));
    }
    Ok((count, entries.map(|entries| entries.count("number of entries")).transpose()?))
}

/// Entries of an array.
fn stored(rows: usize, symmetry: Symmetry) -> usize {
    match symmetry {
        Symmetry::General => rows * rows,
        Symmetry::Symmetric => rows * (rows + 1) / 2,
        Symmetry::Skew => rows * (rows - 1) / 2,
    }
}

fn words(line: usize, text: &str) -> Vec<Word<'_>> {
    let mut all = Vec::new();
    let (mut start, mut column) = (None, 0);
    for (at, letter) in text.char_indices().chain([(text.len(), ' ')]) {
        column += 1;
        match (start, letter.is_whitespace()) {
            (None, false) => start = Some((at, column)),
            (Some((from, column)), true) => {
                all.push(Word { line, column, text: &text[from..at] });
                start = None;
            }
            _ => {}
        }
    }
    all
}

/// The place after the last line that has something.
fn end(text: &str) -> Mistake {
    let text = text.trim_end();
    let last = text.lines().last().unwrap_or_default();
    Mistake { line: text.lines().count().max(1), column: last.chars().count() + 1, message: String::new() }
}

/// Entries in order, those at the same place summed.
fn summed(mut entries: Vec<(usize, usize, f64)>) -> Result<Vec<(usize, usize, f64)>, Mistake> {
    entries.sort_by_key(|(row, column, _)| (*row, *column));
    entries.dedup_by(|next, first| {
        let same = (next.0, next.1) == (first.0, first.1);
        if same {
            first.2 += next.2;
        }
        same
    });
    match entries.iter().find(|(_, _, value)| !value.is_finite()) {
        Some((row, column, _)) => {
            let message = format!("the entries in row {} and column {} have no finite sum", row + 1, column + 1);
            Err(Mistake { line: 1, column: 1, message })
        }
        None => Ok(entries),
    }
}

/// Writes a matrix so that reading it gives the same numbers, as `symmetric` if it is so exactly.
pub fn write(matrix: &Matrix) -> String {
    let Matrix { rows, entries } = matrix;
    let other = |row: usize, column: usize| {
        let found = entries.binary_search_by(|(r, c, _)| match r.cmp(&row) {
            Ordering::Equal => c.cmp(&column),
            unequal => unequal,
        });
        found.map_or(0.0, |at| entries[at].2)
    };
    let symmetric = entries.iter().all(|(row, column, value)| other(*column, *row) == *value);
    let listed = || entries.iter().filter(|(row, column, _)| !symmetric || row >= column);
    let kind = if symmetric { "symmetric" } else { "general" };
    let mut text = format!("%%MatrixMarket matrix coordinate real {kind}\n{rows} {rows} {}\n", listed().count());
    for (row, column, value) in listed() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{} {} {value:e}", row + 1, column + 1);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Matrix, read, write};

    fn entries(text: &str) -> Vec<(usize, usize, f64)> {
        read(text).unwrap().entries
    }

    #[test]
    fn every_kind_of_file_is_read() {
        let plain = [(0, 0, 4.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.5)];
        for text in [
            "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 4\n1 2 -1\n2 1 -1\n2 2 2.5\n",
            "%%matrixmarket MATRIX Coordinate Real Symmetric\r\n% by hand\r\n\r\n2 2 4\r\n 2 2  2.5\r\n1 1 3.0D0\r\n%\n2 1 -1\n1 1 1",
            "%%MatrixMarket matrix array real general\n2 2\n4\n-1\n-1\n2.5\n",
            "%%MatrixMarket matrix array real symmetric\n%\n2 2\n4 -1\n+25e-1\n",
        ] {
            assert_eq!(entries(text), plain, "{text}");
        }
        let skew = [(0, 1, -7.0), (1, 0, 7.0)];
        for text in [
            "%%MatrixMarket matrix coordinate integer skew-symmetric\n2 2 1\n2 1 7\n",
            "%%MatrixMarket matrix array integer skew-symmetric\n2 2\n7\n",
        ] {
            assert_eq!(entries(text), skew, "{text}");
        }
    }

    #[test]
    fn what_is_written_is_read_again() {
        let entries = vec![(0, 0, 1.0 / 3.0), (0, 1, -1e-300), (1, 0, -1e-300), (1, 1, f64::MAX)];
        let symmetric = Matrix { rows: 2, entries };
        let text = write(&symmetric);
        assert!(text.starts_with("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 3.333"), "{text}");
        assert_eq!(read(&text), Ok(symmetric.clone()));
        let mut general = symmetric;
        general.entries[2].2 = 1e-300;
        assert!(write(&general).contains("general\n2 2 4\n"));
        assert_eq!(read(&write(&general)), Ok(general.clone()));
        general.entries.truncate(2);
        assert_eq!(read(&write(&general)), Ok(general));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let coordinate = "%%MatrixMarket matrix coordinate real general\n";
        let symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
        let array = "%%MatrixMarket matrix array real general\n";
        for (text, place, message) in [
            (String::new(), (1, 1), "word 1 of a Matrix Market file is `%%MatrixMarket`, which is missing"),
            ("# a".to_owned(), (1, 1), "word 1 of a Matrix Market file is `%%MatrixMarket`, not `#`"),
            (coordinate.replace("matrix ", "vector "), (1, 16), "`matrix`, not `vector`"),
            (coordinate.replace("real", "complex"), (1, 34), "`real` or `integer`, not `complex`"),
            (coordinate.replace("real", "pattern"), (1, 34), "`real` or `integer`, not `pattern`"),
            (coordinate.replace("general", "hermitian"), (1, 39), "not `hermitian`"),
            (coordinate.replace(" general", ""), (1, 38), "`skew-symmetric`, which is missing"),
            (format!("{coordinate}% only"), (2, 7), "the file ends before its sizes"),
            (format!("{coordinate}2 2\n"), (2, 1), "the numbers of rows, columns and entries"),
            (format!("{coordinate}2 3 1\n"), (2, 1), "must be square: this one has 2 rows and 3 columns"),
            (format!("{coordinate}5000 5000 1\n"), (2, 1), "from 1 to 4096 rows, not 5000"),
            (format!("{array}4000 4000\n1\n"), (3, 2), "the file ends after 1 of 16000000 entries"),
            (format!("{coordinate}2 2 -1\n"), (2, 5), "must be a whole number, not `-1`"),
            (format!("{coordinate}2 2 3\n\n1 1 1\n"), (4, 6), "the file ends after 1 of 3 entries"),
            (format!("{coordinate}2 2 1\n1 1 1\n 1 2 1\n"), (4, 2), "goes on after all 1 entries"),
            (format!("{array}1 1\n1 2\n"), (3, 3), "goes on after all 1 entries"),
            (format!("{coordinate}2 2 1\n1 3 1\n"), (3, 3), "there is no column 3: they count from 1 to 2"),
            (format!("{coordinate}2 2 1\n0 1 1\n"), (3, 1), "there is no row 0"),
            (format!("{coordinate}2 2 1\n1 1 1e999\n"), (3, 5), "`1e999` is not finite"),
            (format!("{coordinate}2 2 1\n1 1 nan\n"), (3, 5), "`nan` is not finite"),
            (format!("{coordinate}2 2 1\n1 1 5,3\n"), (3, 5), "`5,3` is not a number"),
            (format!("{coordinate}2 2 1\n1 1\n"), (3, 1), "this one has 2 words"),
            (format!("{symmetric}2 2 1\n1 2 1\n"), (3, 1), "on and below its diagonal"),
            (format!("{coordinate}1 1 2\n1 1 1e308\n1 1 1e308\n"), (1, 1), "have no finite sum"),
        ] {
            let mistake = read(&text).unwrap_err();
            assert!(mistake.message.contains(message), "{text}: {}", mistake.message);
            assert_eq!((mistake.line, mistake.column), place, "{text}");
        }
    }
}
