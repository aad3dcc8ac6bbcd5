//! Small symmetric matrices, one in each lane of the processor's vectors.

pub(crate) mod algebra;
pub(crate) mod closed;
