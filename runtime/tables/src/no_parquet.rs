//! In place of Parquet files, an error that says how to get them.

use std::io::Write;
use std::marker::PhantomData;

use crate::{Error, Table};

/// Writes nothing.
#[derive(Debug)]
pub struct Writer<W>(PhantomData<W>);

impl<W: Write + Send> Writer<W> {
    /// Creates a writer.
    pub fn new(_: W) -> Self {
        Self(PhantomData)
    }

    /// Fails.
    ///
    /// # Errors
    /// [`Error::NoParquet`].
    pub fn write(&mut self, _: &Table) -> Result<(), Error> {
        Err(Error::NoParquet)
    }

    /// Fails.
    ///
    /// # Errors
    /// [`Error::NoParquet`].
    pub fn finish(self) -> Result<(), Error> {
        Err(Error::NoParquet)
    }
}

/// Fails.
///
/// # Errors
/// [`Error::NoParquet`].
pub fn write(_: &Table, _: impl Write + Send) -> Result<(), Error> {
    Err(Error::NoParquet)
}
