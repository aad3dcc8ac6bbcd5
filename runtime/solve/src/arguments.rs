//! Checks of arguments common to all questions.

use crate::algebra::all_finite;
use crate::{Description, Error, Input, Text};

/// Refuses a list with the wrong number of values.
pub fn check_count(kind: &'static str, values: &[f64], count: usize) -> Result<(), Error> {
    if values.len() == count {
        return Ok(());
    }
    Err(Error::WrongLength { kind, found: values.len(), expected: count })
}

/// Refuses the first value that is not finite, reporting its name.
#[inline]
pub(crate) fn check_finite<'n>(
    kind: &'static str,
    name: impl Fn(usize) -> &'n Text,
    values: &[f64],
) -> Result<(), Error> {
    if all_finite(values) {
        return Ok(());
    }
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(Error::NotFinite { kind, name: name(index).clone(), value: values[index] }),
    }
}

/// Refuses the handle of an input that the mechanism does not have.
pub fn check_input(input: Input, description: &Description) -> Result<(), Error> {
    let (index, count) = (input.index(), description.inputs.len());
    if index < count {
        return Ok(());
    }
    Err(Error::UnknownHandle { kind: "input", index, mechanism: description.name.clone(), count })
}
