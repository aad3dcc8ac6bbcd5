//! Checks of arguments.

use super::LARGEST;
use crate::Error;

pub(super) fn check_below(setting: &'static str, index: usize, count: usize) -> Result<(), Error> {
    if index < count {
        return Ok(());
    }
    let reason = format!("there is no {index}, they count from 0 to below {count}");
    Err(Error::setting(setting, reason))
}

/// Rejects NaN and values above [`LARGEST`] in magnitude.
pub(super) fn check_number(setting: &'static str, value: f64) -> Result<(), Error> {
    if value.abs() <= LARGEST {
        return Ok(());
    }
    let reason = format!("{value} is not a number of at most {LARGEST:e} in magnitude");
    Err(Error::setting(setting, reason))
}
