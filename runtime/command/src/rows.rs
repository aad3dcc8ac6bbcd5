//! Rows written as they are computed, so that memory does not grow with their number and Ctrl-C loses no finished work.

use std::time::{Duration, Instant};

use eigentol_tables::{Error, Table, csv, parquet};

use crate::answer::Form;
use crate::destination::{Begun, Destination, Unfinished};
use crate::failure::Failure;
use crate::interrupt;

/// Items per block of rows: small for CSV, which is read while it grows; large for Parquet, where each block is a row
/// group.
const CSV_BLOCK: usize = 256;
const PARQUET_BLOCK: usize = 4096;
/// How long a CSV row may wait for others.
const PATIENCE: Duration = Duration::from_millis(200);

/// The rows of one table, made from items of one type.
pub(crate) struct Rows<'a, T> {
    place: &'a Destination,
    file: File,
    // Declared after the file, so that leftovers are removed once it is closed.
    target: Unfinished,
    make: Make<'a, T>,
    waiting: Vec<T>,
    begun: bool,
    written: Instant,
}

/// Makes the rows of some items.
pub(crate) type Make<'a, T> = Box<dyn Fn(&[T]) -> Table + 'a>;

enum File {
    Csv(Box<csv::Writer<Begun>>),
    Parquet(parquet::Writer<Begun>),
}

impl<'a, T> Rows<'a, T> {
    pub(crate) fn begin(destination: &'a Destination, form: Form, make: Make<'a, T>) -> Result<Self, Failure> {
        let (target, begun) = destination.begin()?;
        Ok(Self {
            place: destination,
            target,
            file: match form {
                Form::Parquet => File::Parquet(parquet::Writer::new(begun)),
                _ => File::Csv(Box::new(csv::Writer::new(begun))),
            },
            make,
            waiting: Vec::new(),
            begun: false,
            written: Instant::now(),
        })
    }

    /// Adds the rows of one item.
    pub(crate) fn add(&mut self, one: T) -> Result<(), Failure> {
        self.waiting.push(one);
        let full = match self.file {
            File::Csv(_) => self.waiting.len() >= CSV_BLOCK || self.written.elapsed() >= PATIENCE,
            File::Parquet(_) => self.waiting.len() >= PARQUET_BLOCK,
        };
        if full { self.write() } else { Ok(()) }
    }

    /// Writes the remaining rows and moves the file into place. Without rows, a file has only headings.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        interrupt::answer();
        self.write()?;
        let destination = self.place;
        let complete = match self.file {
            File::Csv(file) => file.finish().map(drop),
            File::Parquet(file) => file.finish(),
        };
        complete.map_err(|error| failure(destination, error))?;
        (self.target.move_into_place()).map_err(|source| destination.failure(source))
    }

    /// Writes the waiting rows, if any.
    pub(crate) fn write(&mut self) -> Result<(), Failure> {
        if self.waiting.is_empty() && self.begun {
            return Ok(());
        }
        self.begun = true;
        let table = (self.make)(&self.waiting);
        let written = match &mut self.file {
            File::Csv(file) => file.write(&table),
            File::Parquet(file) => file.write(&table),
        };
        if self.place.path().is_none() {
            interrupt::prints();
        }
        self.waiting.clear();
        self.written = Instant::now();
        written.map_err(|error| failure(self.place, error))
    }
}

fn failure(destination: &Destination, error: Error) -> Failure {
    match error {
        Error::Write(source) => destination.failure(source),
        error => error.into(),
    }
}
