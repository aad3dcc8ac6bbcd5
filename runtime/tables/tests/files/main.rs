//! Files of every format: written, read back, truncated, of another version, and on a full disk.

mod common;
mod csv;
mod json;
#[cfg(feature = "parquet")]
mod parquet;
