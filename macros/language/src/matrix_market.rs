//! Square real matrices in Matrix Market files, as text: the exchange format of NIST
//! (<https://math.nist.gov/MatrixMarket/formats.html>).

use std::collections::HashMap;
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

/// A line or a part of it, with its place.
#[derive(Clone, Copy, Debug)]
pub struct Word<'t> {
    /// Line, from 1.
    pub line: usize,
    /// Column of the first character, from 1.
    pub column: usize,
    /// The text.
    pub text: &'t str,
}

/// The lines of a text.
pub fn lines(text: &str) -> impl Iterator<Item = Word<'_>> {
    text.lines().enumerate().map(|(k, text)| Word { line: k + 1, column: 1, text })
}

/// A mistake after the last line that has something.
pub fn end(text: &str, message: impl Into<String>) -> Mistake {
    let last = lines(text.trim_end()).last().unwrap_or(Word { line: 1, column: 1, text: "" });
    last.at(last.text.len(), "").mistake(message)
}

impl<'t> Word<'t> {
    /// A part of this one that begins at a byte of it.
    pub fn at(self, from: usize, text: &'t str) -> Self {
        let before = self.text.get(..from).map_or(from, |before| before.chars().count());
        Self { column: self.column + before, text, ..self }
    }

    /// What stands between spaces and commas.
    pub fn words(self) -> Vec<Self> {
        let parts = self.text.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty());
        parts.map(|part| self.at(part.as_ptr() as usize - self.text.as_ptr() as usize, part)).collect()
    }

    /// A mistake here.
    pub fn mistake(self, message: impl Into<String>) -> Mistake {
        Mistake { line: self.line, column: self.column, message: message.into() }
    }

    /// As much of the text as a message can have.
    pub fn shown(self) -> String {
        self.text.chars().take(40).collect()
    }

    /// A whole number.
    ///
    /// # Errors
    /// If it is none, or too large or negative for its type.
    pub fn whole<N: std::str::FromStr>(self, meaning: &str) -> Result<N, Mistake> {
        self.text
            .parse()
            .map_err(|_| self.mistake(format!("the {meaning} must be a whole number, not `{}`", self.shown())))
    }

    /// A row or a column, from 0.
    ///
    /// # Errors
    /// If the matrix has none of this number.
    pub fn index(self, meaning: &str, rows: usize) -> Result<usize, Mistake> {
        let index: usize = self.whole(meaning)?;
        let inside = index.checked_sub(1).filter(|index| *index < rows);
        inside.ok_or_else(|| self.mistake(format!("there is no {meaning} {index}: they count from 1 to {rows}")))
    }

    /// The number of rows of a matrix with as many columns.
    ///
    /// # Errors
    /// If the matrix is not square, or too large.
    pub fn order(self, columns: usize) -> Result<usize, Mistake> {
        let rows = self.whole("number of rows")?;
        if rows != columns {
            return Err(self.mistake(format!("the matrix must be square: it has {rows} rows and {columns} columns")));
        }
        let allowed = (1..=MOST_ROWS).contains(&rows).then_some(rows);
        allowed.ok_or_else(|| self.mistake(format!("a matrix has from 1 to {MOST_ROWS} rows, not {rows}")))
    }

    /// A number as C or Fortran writes it: `1.5e-3`, `1.5D-3`, `1.5-3`.
    ///
    /// # Errors
    /// If it is none, or not finite.
    pub fn number(self) -> Result<f64, Mistake> {
        let mut text = self.text.replace(['d', 'D', 'E'], "e");
        let sign = text.rfind(['+', '-']).filter(|sign| *sign > 0 && !text.contains('e'));
        sign.into_iter().for_each(|sign| text.insert(sign, 'e'));
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(self.mistake(format!("`{}` is not finite", self.shown()))),
            Err(_) => Err(self.mistake(format!("`{}` is not a number", self.shown()))),
        }
    }
}

/// The words of the first line, in small letters.
const HEADER: [&[&str]; 5] = [
    &["%%matrixmarket"],
    &["matrix"],
    &["coordinate", "array"],
    &["real", "integer", "double"],
    &["general", "symmetric", "skew-symmetric"],
];

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
    let ends = |message: String| end(text, message);
    let mut lines = lines(text);
    let first = lines.next().map(Word::words).unwrap_or_default();
    let mut header = [""; 5];
    for (k, known) in HEADER.into_iter().enumerate() {
        let word = first.get(k).copied().unwrap_or(Word { line: 1, column: 1, text: "" });
        let found = known.iter().find(|known| word.text.eq_ignore_ascii_case(known));
        let list = known.join("` or `");
        header[k] = found.ok_or_else(|| {
            let message = format!("word {} of a Matrix Market file is `{list}` here, not `{}`", k + 1, word.shown());
            word.mistake(message)
        })?;
    }
    let is_array = header[2] == "array";
    // The sign of the other half.
    let sign = match header[4] {
        "general" => 0.0,
        "symmetric" => 1.0,
        _ => -1.0,
    };
    let lines = lines.filter(|line| !line.text.trim_start().starts_with('%')).map(Word::words);
    let mut lines = lines.filter(|line| !line.is_empty());
    let sizes = lines.next().ok_or_else(|| ends("the file ends before its sizes".to_owned()))?;
    let (rows, columns, expected) = match sizes[..] {
        [rows, columns] if is_array => (rows, columns, None),
        [rows, columns, entries] if !is_array => (rows, columns, Some(entries.whole("number of entries")?)),
        _ => return Err(sizes[0].mistake("the sizes are rows and columns, and the entries of a coordinate file")),
    };
    let rows = rows.order(columns.whole("number of columns")?)?;
    let from = |column: usize| if sign == 0.0 { 0 } else { column + usize::from(sign < 0.0) };
    let mut places = (0..rows).flat_map(|column| (from(column)..rows).map(move |row| (row, column)));
    let expected = expected.unwrap_or_else(|| (0..rows).map(|column| rows - from(column)).sum());
    let (mut count, mut entries) = (0_usize, Vec::new());
    let mut listed = HashMap::new();
    for line in lines {
        for words in line.chunks(if is_array { 1 } else { line.len() }) {
            if count == expected {
                return Err(words[0].mistake(format!("the file goes on after all {expected} entries")));
            }
            let (row, column, value) = match *words {
                [value] if is_array => {
                    let (row, column) = places.next().unwrap_or_default();
                    (row, column, value)
                }
                [row, column, value] => (row.index("row", rows)?, column.index("column", rows)?, value),
                _ => return Err(words[0].mistake("an entry is a line with its row, its column and its value")),
            };
            if row < from(column) {
                let message =
                    format!("a {} matrix lists only its lower half: swap row and column, or say general", header[4]);
                return Err(words[0].mistake(message));
            }
            let before = if is_array { None } else { listed.insert((row, column), words[0].line) };
            if let Some(line) = before {
                let message = format!("row {}, column {} has an entry in line {line} already", row + 1, column + 1);
                return Err(words[0].mistake(message));
            }
            let value = value.number()?;
            entries.push((row, column, value));
            if sign != 0.0 && row != column {
                entries.push((column, row, sign * value));
            }
            count += 1;
        }
    }
    if count < expected {
        return Err(ends(format!("the file ends after {count} of {expected} entries")));
    }
    entries.sort_by_key(|(row, column, _)| (*row, *column));
    Ok(Matrix { rows, entries })
}

/// Digits in which a change of units leaves no trace.
pub const ALL_DIGITS: usize = 14;

/// The most significant digits of an entry, up to these.
pub fn digits(entries: &[(usize, usize, f64)]) -> usize {
    let of = |value: f64| {
        let text = format!("{value:.*e}", ALL_DIGITS - 1);
        let mantissa = text.split('e').next().unwrap_or_default().trim_end_matches('0');
        mantissa.matches(|letter: char| letter.is_ascii_digit()).count()
    };
    let mut most = 0;
    for (_, _, value) in entries {
        most = of(*value).max(most);
        if most == ALL_DIGITS {
            break;
        }
    }
    most
}

/// How far a number of the matrix may be rounded, as a part of it: one of few digits has one less where a sign takes a place.
/// Numbers of fewer than four are those that somebody has chosen.
pub fn rounding(entries: &[(usize, usize, f64)]) -> f64 {
    match digits(entries) {
        digits @ 4..=8 => 5.0 * 0.1_f64.powi(digits as i32 - 1),
        _ => 0.0,
    }
}

/// Writes a matrix so that reading it gives the same numbers, as `symmetric` if it is so exactly.
pub fn write(matrix: &Matrix) -> String {
    let Matrix { rows, entries } = matrix;
    let other = |place: (usize, usize)| {
        let found = entries.binary_search_by_key(&place, |(row, column, _)| (*row, *column));
        found.map_or(0.0, |at| entries[at].2)
    };
    let symmetric = entries.iter().all(|(row, column, value)| other((*column, *row)) == *value);
    let kind = if symmetric { "symmetric" } else { "general" };
    let listed: Vec<_> = entries.iter().filter(|(row, column, _)| !symmetric || row >= column).collect();
    let mut text = format!("%%MatrixMarket matrix coordinate real {kind}\n{rows} {rows} {}\n", listed.len());
    for (row, column, value) in listed {
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
            "%%matrixmarket MATRIX Coordinate Real Symmetric\r\n% by hand\r\n\r\n2 2 3\r\n 2 2  2.5\r\n1 1 4.0D0\r\n%\n2 1 -1",
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
            (String::new(), (1, 1), "word 1 of a Matrix Market file is `%%matrixmarket` here, not ``"),
            ("# a".to_owned(), (1, 1), "not `#`"),
            (coordinate.replace("matrix ", "vector "), (1, 16), "`matrix` here, not `vector`"),
            (coordinate.replace("real", "complex"), (1, 34), "`real` or `integer` or `double` here, not `complex`"),
            (coordinate.replace("real", "pattern"), (1, 34), "not `pattern`"),
            (coordinate.replace("general", "hermitian"), (1, 39), "not `hermitian`"),
            (coordinate.replace(" general", ""), (1, 1), "`general` or `symmetric` or `skew-symmetric` here, not ``"),
            (format!("{coordinate}% only"), (2, 7), "the file ends before its sizes"),
            (format!("{coordinate}2 2\n"), (2, 1), "the sizes are rows and columns, and the entries"),
            (format!("{coordinate}2 3 1\n"), (2, 1), "must be square: it has 2 rows and 3 columns"),
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
            (format!("{coordinate}2 2 1\n1 1 5,3\n"), (3, 1), "an entry is a line with its row"),
            (format!("{coordinate}2 2 1\n1 1\n"), (3, 1), "an entry is a line with its row"),
            (format!("{symmetric}2 2 1\n1 2 1\n"), (3, 1), "lists only its lower half"),
            (format!("{coordinate}2 2 2\n2 1 1\n2 1 1\n"), (4, 1), "row 2, column 1 has an entry in line 3 already"),
            (format!("{symmetric}1 1 2\n1 1 1\n%\n1 1 1\n"), (5, 1), "row 1, column 1 has an entry in line 3 already"),
        ] {
            let mistake = read(&text).unwrap_err();
            assert!(mistake.message.contains(message), "{text}: {}", mistake.message);
            assert_eq!((mistake.line, mistake.column), place, "{text}");
        }
    }
}
