//! Files of every form: written, read back, cut off, of another version, on a disk that is full.

mod common;
mod csv;
mod json;
#[cfg(feature = "parquet")]
mod parquet;
