#![doc = include_str!("../README.md")]

mod check;
pub mod csv;
mod error;
pub mod json;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod part;

pub use eigentol_results::{Answer, Column, Subject, Table, Values};
pub use error::Error;
