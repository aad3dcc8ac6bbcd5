#![doc = include_str!("../README.md")]

pub mod csv;
mod error;
mod results;
mod table;

pub use error::Error;
pub use results::{Tables, samples_table, tables};
pub use table::{Column, Table, Values};
