//! Tables as Parquet files, for large sample sets and long sweeps: each table written becomes one row group, so only
//! one needs to be in memory.
//!
//! Columns use the CSV headings, `name [unit]`, and may hold missing values; numbers are `DOUBLE`, whole numbers
//! `INT64`, words UTF-8, yes/no values `BOOLEAN`. Nothing is compressed. The metadata keys `eigentol` and `table` hold
//! the format version and the table name. A file is complete only once [`Writer::finish`] has returned; a truncated
//! file cannot be read.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, get_typed_column_reader};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::check::check;
use crate::csv::read_heading;
use crate::json::VERSION;
use crate::{Column, Error, Table, Values};

/// Metadata key of the format version.
const FORMAT: &str = "eigentol";
/// Metadata key of the table name.
const TABLE: &str = "table";

/// Writes rows to a single file as they arrive.
///
/// ```
/// use eigentol_tables::{Table, parquet};
///
/// let mut file = Vec::new();
/// let mut writer = parquet::Writer::new(&mut file);
/// for part in 0..3 {
///     let mut rows = Table::new("samples");
///     rows.numbers("frequency", "rad/s", [4.0 + f64::from(part), f64::NAN]);
///     writer.write(&rows)?;
/// }
/// writer.finish()?;
/// let table = parquet::read(&file[..])?;
/// assert_eq!((table.name.as_str(), table.rows()), ("samples", 6));
/// # Ok::<(), eigentol_tables::Error>(())
/// ```
pub struct Writer<W: Write + Send> {
    state: State<W>,
}

enum State<W: Write + Send> {
    Empty(W),
    Begun { file: Box<SerializedFileWriter<W>>, columns: Vec<(String, Physical)> },
    Failed,
}

impl<W: Write + Send> Writer<W> {
    /// Creates a writer; nothing is written yet.
    pub fn new(file: W) -> Self {
        let state = State::Empty(file);
        Self { state }
    }

    /// Writes the rows of a table as one row group.
    ///
    /// # Errors
    /// [`Error::Write`], after which nothing more can be written; [`Error::OtherColumns`] if headings or kinds differ
    /// from the previous rows; [`Error::Lengths`].
    pub fn write(&mut self, table: &Table) -> Result<(), Error> {
        check(table)?;
        let schema: Vec<(String, Physical)> =
            (table.columns.iter()).map(|column| (column.heading(), physical(&column.values))).collect();
        match std::mem::replace(&mut self.state, State::Failed) {
            State::Failed => Err(Error::Write(io::Error::other("writing failed before"))),
            State::Empty(file) => {
                let file = begin(file, table).map_err(writing)?;
                self.group(Box::new(file), schema, table)
            }
            State::Begun { file, columns } if columns == schema => self.group(file, schema, table),
            State::Begun { file, columns } => {
                let error = Error::OtherColumns { found: listed(&schema), expected: listed(&columns) };
                self.state = State::Begun { file, columns };
                Err(error)
            }
        }
    }

    fn group(
        &mut self,
        mut file: Box<SerializedFileWriter<W>>,
        columns: Vec<(String, Physical)>,
        table: &Table,
    ) -> Result<(), Error> {
        group(&mut file, table).map_err(writing)?;
        self.state = State::Begun { file, columns };
        Ok(())
    }

    /// Writes the footer, without which the file cannot be read. If no table was written, the file stays empty.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn finish(self) -> Result<(), Error> {
        match self.state {
            State::Empty(mut file) => file.flush().map_err(Error::Write),
            State::Begun { file, .. } => file.close().map(drop).map_err(writing),
            State::Failed => Err(Error::Write(io::Error::other("writing failed before"))),
        }
    }
}

/// Writes a table.
///
/// # Errors
/// [`Error::Write`], [`Error::Lengths`].
pub fn write(table: &Table, file: impl Write + Send) -> Result<(), Error> {
    let mut writer = Writer::new(file);
    writer.write(table)?;
    writer.finish()
}

fn physical(values: &Values) -> Physical {
    match values {
        Values::Numbers(_) => Physical::DOUBLE,
        Values::Whole(_) => Physical::INT64,
        Values::Texts(_) => Physical::BYTE_ARRAY,
        Values::Flags(_) => Physical::BOOLEAN,
    }
}

fn listed(columns: &[(String, Physical)]) -> String {
    columns.iter().map(|(name, kind)| format!("{name} ({kind})")).collect::<Vec<_>>().join(", ")
}

fn begin<W: Write + Send>(file: W, table: &Table) -> Result<SerializedFileWriter<W>, ParquetError> {
    let fields = table.columns.iter().map(|column| {
        let kind = physical(&column.values);
        let word = (kind == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        Type::primitive_type_builder(&column.heading(), kind)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(word)
            .build()
            .map(Arc::new)
    });
    let fields = fields.collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("table").with_fields(fields).build()?;
    let said = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let keys = vec![said(FORMAT, VERSION.to_string()), said(TABLE, table.name.clone())];
    let properties =
        WriterProperties::builder().set_dictionary_enabled(false).set_key_value_metadata(Some(keys)).build();
    SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))
}

fn group<W: Write + Send>(file: &mut SerializedFileWriter<W>, table: &Table) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    for column in &table.columns {
        let Some(mut writer) = group.next_column()? else {
            break;
        };
        match (writer.untyped(), &column.values) {
            (ColumnWriter::DoubleColumnWriter(writer), Values::Numbers(all)) => {
                let (levels, values) = present(all, |value| *value);
                writer.write_batch(&values, Some(&levels), None)?;
            }
            (ColumnWriter::Int64ColumnWriter(writer), Values::Whole(all)) => {
                let (levels, values) = present(all, |value| *value);
                writer.write_batch(&values, Some(&levels), None)?;
            }
            (ColumnWriter::ByteArrayColumnWriter(writer), Values::Texts(all)) => {
                let (levels, values) = present(all, |text| ByteArray::from(text.as_str()));
                writer.write_batch(&values, Some(&levels), None)?;
            }
            (ColumnWriter::BoolColumnWriter(writer), Values::Flags(all)) => {
                let (levels, values) = present(all, |value| *value);
                writer.write_batch(&values, Some(&levels), None)?;
            }
            _ => return Err(ParquetError::General("a column of another kind".to_owned())),
        }
        writer.close()?;
    }
    group.close()?;
    Ok(())
}

/// Definition levels (1 where an entry is present) and the values present.
fn present<T, R>(all: &[Option<T>], value: impl Fn(&T) -> R) -> (Vec<i16>, Vec<R>) {
    let levels = all.iter().map(|x| i16::from(x.is_some())).collect();
    (levels, all.iter().flatten().map(value).collect())
}

/// Reads all rows of a file, including files from other programs if tables support their column types.
///
/// # Errors
/// [`Error::Read`]; [`Error::Content`] for a file that is truncated, damaged or not Parquet, and for unsupported column
/// types; [`Error::Version`].
pub fn read(mut file: impl Read) -> Result<Table, Error> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(Error::Read)?;
    let reader = SerializedFileReader::new(Bytes::from(bytes)).map_err(content)?;
    let metadata = reader.metadata().file_metadata();
    let keys = metadata.key_value_metadata().into_iter().flatten();
    let keys: BTreeMap<&str, &str> = keys.filter_map(|key| Some((key.key.as_str(), key.value.as_deref()?))).collect();
    if let Some(version) = keys.get(FORMAT).filter(|key| **key != VERSION.to_string()) {
        return Err(Error::Version {
            found: (*version).to_owned(),
            by: metadata.created_by().unwrap_or("an unknown program").to_owned(),
            expected: VERSION,
        });
    }
    let mut columns = Vec::new();
    for field in metadata.schema_descr().columns() {
        let values = match (field.max_rep_level(), field.max_def_level(), field.physical_type()) {
            (0, 0 | 1, Physical::DOUBLE) => Values::Numbers(Vec::new()),
            (0, 0 | 1, Physical::INT64) => Values::Whole(Vec::new()),
            (0, 0 | 1, Physical::BYTE_ARRAY) => Values::Texts(Vec::new()),
            (0, 0 | 1, Physical::BOOLEAN) => Values::Flags(Vec::new()),
            (.., kind) => {
                return Err(Error::Content(format!(
                    "column `{}` is of the kind {kind}, or a list, which tables do not have",
                    field.name()
                )));
            }
        };
        let (name, unit) = read_heading(field.name());
        columns.push(Column { name, unit, values });
    }
    for k in 0..reader.num_row_groups() {
        let group = reader.get_row_group(k).map_err(content)?;
        for (j, column) in columns.iter_mut().enumerate() {
            append(&*group, j, &mut column.values)?;
        }
    }
    let table = Table { name: (*keys.get(TABLE).unwrap_or(&"")).to_owned(), columns };
    check(&table)?;
    Ok(table)
}

fn append(group: &dyn RowGroupReader, column: usize, to: &mut Values) -> Result<(), Error> {
    let reader = group.get_column_reader(column).map_err(content)?;
    let rows = usize::try_from(group.metadata().num_rows())
        .map_err(|_| Error::Content("a negative number of rows".to_owned()))?;
    match to {
        Values::Numbers(all) => all.extend(entries::<DoubleType>(reader, rows)?),
        Values::Whole(all) => all.extend(entries::<Int64Type>(reader, rows)?),
        Values::Flags(all) => all.extend(entries::<BoolType>(reader, rows)?),
        Values::Texts(all) => {
            for entry in entries::<ByteArrayType>(reader, rows)? {
                all.push(entry.map(|entry| entry.as_utf8().map(str::to_owned)).transpose().map_err(content)?);
            }
        }
    }
    Ok(())
}

fn entries<T: DataType>(reader: ColumnReader, rows: usize) -> Result<Vec<Option<T::T>>, Error> {
    let mut reader = get_typed_column_reader::<T>(reader);
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let mut read = 0;
    while read < rows {
        let (records, ..) = reader.read_records(rows - read, Some(&mut levels), None, &mut values).map_err(content)?;
        if records == 0 {
            break;
        }
        read += records;
    }
    // A required column has no definition levels.
    if levels.is_empty() {
        levels = vec![1; values.len()];
    }
    let mut values = values.into_iter();
    Ok(levels.into_iter().map(|level| if level == 1 { values.next() } else { None }).collect())
}

fn writing(error: ParquetError) -> Error {
    Error::Write(match error {
        ParquetError::External(source) => match source.downcast::<io::Error>() {
            Ok(io_error) => *io_error,
            Err(source) => io::Error::other(source),
        },
        error => io::Error::other(error),
    })
}

fn content(error: ParquetError) -> Error {
    Error::Content(error.to_string())
}
