//! Every kernel that tells what tolerances do: derivatives to second order, and samples side by side.

use super::{BatchKernels, CurvatureKernels};

/// A table that is both of these.
pub trait SummaryKernels: CurvatureKernels + BatchKernels {}

impl<K: CurvatureKernels + BatchKernels + ?Sized> SummaryKernels for K {}
