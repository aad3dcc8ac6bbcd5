//! Parameters that may have a tolerance.

use crate::Any;
use crate::{DesignVariable, Input};

/// A design variable or an input, either of which may have a tolerance. Converts from the handle of either.
#[derive(Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = ""))]
pub enum Parameter<M = Any> {
    /// A design variable.
    Design(DesignVariable<M>),
    /// An input.
    Input(Input<M>),
}

impl<M> Clone for Parameter<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Parameter<M> {}

impl<M> Parameter<M> {
    /// The parameter without the type of its mechanism.
    #[must_use]
    pub fn any(self) -> Parameter {
        match self {
            Self::Design(variable) => Parameter::Design(variable.any()),
            Self::Input(input) => Parameter::Input(input.any()),
        }
    }
}

impl<M> From<DesignVariable<M>> for Parameter<M> {
    fn from(variable: DesignVariable<M>) -> Self {
        Self::Design(variable)
    }
}

impl<M> From<Input<M>> for Parameter<M> {
    fn from(input: Input<M>) -> Self {
        Self::Input(input)
    }
}
