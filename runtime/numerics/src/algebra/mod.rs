//! Linear algebra on matrices whose size is known at run time: products, and one factorisation of each kind.
//!
//! Sums are formed in the order of the indices, so that results have the same bits on every machine.
//!
//! # Sizes are known at run time
//!
//! Vectors up to 8 entries and matrices up to 16 are stored inline, larger ones on the heap, so states of large
//! mechanisms do not fill a stack. Rows are rows everywhere: `matrix[i][j]` is the derivative of residual `i`; sums are
//! formed in the order of the indices. Results are written in their final place, because numbers just written are slow
//! to copy. Partial derivatives of the matrices are one block (`kernels/partial_matrices.rs`). Inner loops take the
//! size as an argument of inlined functions, and `for_size` calls them with small sizes as constants; where processor
//! vectors make size matter more (`batched`), `for_size!` compiles them with arrays of that size.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

mod buffer;
mod cholesky;
mod lu;
mod matrix;
#[cfg(feature = "nalgebra")]
mod nalgebra;
#[cfg(feature = "serde")]
mod serial;
mod vector;

pub use matrix::Matrix;
pub use vector::Vector;

pub use cholesky::{Cholesky, factor_rows, solve_rows};
pub use lu::{Field, Lu};
pub use matrix::{
    all_finite_matrix, asymmetry, form, is_symmetric, largest_element, product_complex, times, times_columns,
    times_complex,
};
pub use vector::{Values, add_scaled, add_to, all_finite, dot, dot_complex, greater, largest, unless_finite};

/// Calls `work` with the size, as a constant if it is small, so that code inlined into `work` is compiled for that
/// size: without loop counters and bounds checks.
#[inline(always)]
pub fn for_size<R>(n: usize, work: impl FnOnce(usize) -> R) -> R {
    match n {
        1 => work(1),
        2 => work(2),
        3 => work(3),
        4 => work(4),
        n => work(n),
    }
}
