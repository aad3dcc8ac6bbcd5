#![doc = include_str!("../README.md")]

mod check;
pub mod csv;
mod error;
pub mod json;
#[cfg_attr(not(feature = "parquet"), path = "no_parquet.rs")]
pub mod parquet;
pub mod part;

pub use eigentol_results::{Answer, Column, Subject, Table, Values};
pub use error::Error;

/// Whether this build writes Parquet files: the feature `parquet`.
pub const PARQUET: bool = cfg!(feature = "parquet");
