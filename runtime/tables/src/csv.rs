//! Tables as CSV files (RFC 4180): a heading line of `name [unit]`, then one line per row; comma-separated, quoted
//! where necessary.
//!
//! Numbers are written with enough digits to restore them exactly. Missing values are empty cells; yes/no values are
//! `true` and `false`. The last columns repeat the operating point in every row, so files of several points can be
//! concatenated and read by programs that do not understand comments.

use std::io::{Read, Write};

use crate::check::check;
use crate::{Column, Error, Table, Values};

/// Writes rows to a single file as they arrive.
///
/// ```
/// use eigentol_tables::Table;
/// use eigentol_tables::csv::Writer;
///
/// let mut table = Table::new("samples");
/// table.numbers("length", "mm", [12.5, 0.1]);
/// table.numbers("frequency", "rad/s", [Some(4.25), None]);
/// let mut writer = Writer::new(Vec::new());
/// writer.write(&table)?;
/// writer.write(&table)?;
/// let file = String::from_utf8(writer.finish()?).expect("text");
/// assert_eq!(file, "length [mm],frequency [rad/s]\n12.5,4.25\n0.1,\n12.5,4.25\n0.1,\n");
/// # Ok::<(), eigentol_tables::Error>(())
/// ```
pub struct Writer<W: Write> {
    file: csv::Writer<W>,
    headings: Option<Vec<String>>,
}

impl<W: Write> Writer<W> {
    /// Creates a writer; nothing is written yet.
    pub fn new(file: W) -> Self {
        let file = csv::Writer::from_writer(file);
        Self { file, headings: None }
    }

    /// Writes the rows of a table, preceded by the headings if it is the first.
    ///
    /// # Errors
    /// [`Error::Write`]; [`Error::OtherColumns`] if the headings differ from the previous rows; [`Error::Lengths`].
    pub fn write(&mut self, table: &Table) -> Result<(), Error> {
        check(table)?;
        let headings: Vec<String> = table.columns.iter().map(Column::heading).collect();
        match &self.headings {
            Some(written) if *written == headings => {}
            Some(written) => {
                return Err(Error::OtherColumns { found: headings.join(", "), expected: written.join(", ") });
            }
            None => {
                self.file.write_record(&headings).map_err(writing)?;
                self.headings = Some(headings);
            }
        }
        for row in 0..table.rows() {
            let cells = table.columns.iter().map(|column| cell(&column.values, row));
            self.file.write_record(cells).map_err(writing)?;
        }
        self.file.flush().map_err(Error::Write)
    }

    /// Flushes buffered rows and returns the file.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn finish(self) -> Result<W, Error> {
        self.file.into_inner().map_err(|failed| Error::Write(failed.into_error()))
    }
}

/// Writes a table.
///
/// # Errors
/// [`Error::Write`], [`Error::Lengths`].
pub fn write(table: &Table, file: impl Write) -> Result<(), Error> {
    let mut writer = Writer::new(file);
    writer.write(table)?;
    writer.finish().map(drop)
}

/// Returns a table as text.
///
/// # Errors
/// [`Error::Lengths`].
pub fn to_string(table: &Table) -> Result<String, Error> {
    let mut text = Vec::new();
    write(table, &mut text)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// Reads a table back, inferring the kind of each column.
///
/// A column holds whole numbers, numbers or yes/no values if all its non-empty cells parse as such, and words
/// otherwise; a column of empty cells holds numbers.
///
/// # Errors
/// [`Error::Read`]; [`Error::Malformed`] with the number of a line that has a different cell count from the headings,
/// or that has no line end, like the last line of a truncated file. Truncation between two lines cannot be detected in
/// CSV.
pub fn read(name: &str, mut file: impl Read) -> Result<Table, Error> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(Error::Read)?;
    let lines = bytes.iter().filter(|&&byte| byte == b'\n').count() as u64;
    if bytes.last().is_some_and(|&last| last != b'\n') {
        return Err(Error::Malformed {
            line: lines + 1,
            reason: "the line has no end: the file is cut off".to_owned(),
        });
    }
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(&bytes[..]);
    let mut headings = Vec::new();
    let mut cells: Vec<Vec<String>> = Vec::new();
    for (k, record) in reader.records().enumerate() {
        let record = record.map_err(reading)?;
        if k == 0 {
            headings = record.iter().map(read_heading).collect();
            cells = vec![Vec::new(); headings.len()];
            continue;
        }
        if record.len() != headings.len() {
            return Err(Error::Malformed {
                line: record.position().map_or(0, csv::Position::line),
                reason: format!(
                    "{} cells where there are {} headings: the file is cut off or damaged",
                    record.len(),
                    headings.len()
                ),
            });
        }
        for (column, cell) in cells.iter_mut().zip(&record) {
            column.push(cell.to_owned());
        }
    }
    if headings.is_empty() {
        return Err(Error::Malformed { line: 1, reason: "there are no headings: the file is empty".to_owned() });
    }
    let columns = headings.into_iter().zip(cells).map(|((name, unit), cells)| {
        let values = values(cells);
        Column { name, unit, values }
    });
    Ok(Table { name: name.to_owned(), columns: columns.collect() })
}

fn cell(values: &Values, row: usize) -> String {
    match values {
        // Debug prints the shortest digits that restore the number, with an exponent where that is shorter.
        Values::Numbers(numbers) => numbers[row].map_or_else(String::new, |value| format!("{value:?}")),
        Values::Whole(whole) => whole[row].map_or_else(String::new, |value| value.to_string()),
        Values::Texts(texts) => texts[row].clone().unwrap_or_default(),
        Values::Flags(flags) => flags[row].map_or_else(String::new, |value| value.to_string()),
    }
}

/// Converts the cells to values of one kind.
fn values(cells: Vec<String>) -> Values {
    fn all<T>(cells: &[String], read: impl Fn(&str) -> Option<T>) -> Option<Vec<Option<T>>> {
        let one = |cell: &String| if cell.is_empty() { Some(None) } else { read(cell).map(Some) };
        cells.iter().map(one).collect()
    }
    let finite = |cell: &str| cell.parse().ok().filter(|value: &f64| value.is_finite());
    if cells.iter().all(String::is_empty) {
        return Values::Numbers(vec![None; cells.len()]);
    }
    if let Some(integers) = all(&cells, |cell| cell.parse().ok()) {
        return Values::Whole(integers);
    }
    if let Some(numbers) = all(&cells, finite) {
        return Values::Numbers(numbers);
    }
    if let Some(flags) = all(&cells, |cell| cell.parse().ok()) {
        return Values::Flags(flags);
    }
    let word = |cell: String| Some(cell).filter(|cell| !cell.is_empty());
    Values::Texts(cells.into_iter().map(word).collect())
}

fn writing(error: csv::Error) -> Error {
    Error::Write(match error.into_kind() {
        // Keep the kind of the I/O error: the reader of a pipe may have gone.
        csv::ErrorKind::Io(source) => source,
        other => std::io::Error::other(format!("{other:?}")),
    })
}

fn reading(error: csv::Error) -> Error {
    let line = error.position().map_or(0, csv::Position::line);
    let reason = error.to_string();
    match error.into_kind() {
        csv::ErrorKind::Io(error) => Error::Read(error),
        _ => Error::Malformed { line, reason },
    }
}

/// Name and unit of a [heading](Column::heading).
pub(crate) fn read_heading(heading: &str) -> (String, String) {
    let unit = heading.strip_suffix(']').and_then(|x| x.rsplit_once(" ["));
    let (name, unit) = unit.unwrap_or((heading, ""));
    (name.to_owned(), unit.to_owned())
}
