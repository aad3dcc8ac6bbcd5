#![doc = include_str!("../README.md")]

mod description;
mod given;
mod kernels;
mod mechanism;
mod mistakes;
mod picture;
mod registers;
mod schedule;
mod tape;

pub use description::description;
pub use given::{design_tolerance, tolerance, value};
pub use mechanism::Interpreted;
pub use mistakes::{Mistake, Mistakes, ReadError, RefineError};
