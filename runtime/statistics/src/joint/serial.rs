//! Deserialisation with validation.

use super::{Dependence, Joint};
use crate::Distribution;

/// [`Joint`] as read, before validation.
#[derive(serde::Deserialize)]
#[serde(expecting = "a joint distribution")]
pub(super) struct Unchecked {
    variables: Vec<Distribution>,
    dependence: Option<Dependence>,
}

impl TryFrom<Unchecked> for Joint {
    type Error = &'static str;

    fn try_from(read: Unchecked) -> Result<Self, &'static str> {
        let size = read.variables.len().pow(2);
        let fits = |dependence: &Dependence| dependence.correlation.len() == size && dependence.factor.len() == size;
        if !read.dependence.as_ref().is_none_or(fits) {
            return Err("there is not one correlation for each pair of variables");
        }
        Ok(Self { variables: read.variables, dependence: read.dependence })
    }
}
