#![doc = include_str!("../README.md")]

mod description;
mod given;
mod kernels;
mod mechanism;
mod mistakes;
mod names;
mod picture;
mod registers;
mod schedule;
mod tape;
mod units;
mod wanted;

pub use description::description;
pub use given::{design_tolerance, tolerance, tolerate, value};
pub use mechanism::Interpreted;
pub use mistakes::{Mistake, Mistakes, ReadError, RefineError, UnitError};
pub use names::meant;
pub use wanted::{
    FORMS, WantedError, excitation, multiple, output, range, requirement, requirements, response, vibration,
    with_unit_of,
};
