//! All kernels needed to analyse tolerances: derivatives to second order, and samples side by side.

use super::{BatchKernels, CurvatureKernels};

/// A table that provides both.
pub trait SummaryKernels: CurvatureKernels + BatchKernels {}

impl<K: CurvatureKernels + BatchKernels + ?Sized> SummaryKernels for K {}
