#![doc = include_str!("../README.md")]

mod answer;
pub mod csv;
mod error;
pub mod json;
#[cfg(feature = "parquet")]
pub mod parquet;
mod results;
mod table;

pub use answer::{Answer, Subject};
pub use error::Error;
pub use results::{
    Tables, branch_table, campbell_table, numbered_samples_table, samples_table, sweep_table,
    tables,
};
pub use table::{Column, Table, Values};
