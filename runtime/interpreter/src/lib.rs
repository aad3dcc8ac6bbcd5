#![doc = include_str!("../README.md")]

mod declared;
mod description;
mod given;
mod kernels;
mod mechanism;
mod mistakes;
mod names;
mod picture;
mod registers;
mod schedule;
mod settings;
mod tape;
mod units;
mod wanted;

pub use declared::{declared_tolerances, rewritten};
pub use description::description;
pub use given::{declaration, design_tolerance, tolerance, tolerate, value};
pub use mechanism::Interpreted;
pub use mistakes::{Mistake, Mistakes, ReadError, RefineError, UnitError};
pub use names::meant;
pub use settings::{Setting, coordinate, design, parameter, read, with_setting};
pub use wanted::{
    FORMS, WantedError, design_range, excitation, multiple, orders, output, range, requirement, requirements, response,
    vibration, with_unit_of,
};
