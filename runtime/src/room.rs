//! Room for large mechanisms: their matrices and, without optimisation, their kernels need more stack than a thread has.

use std::panic::resume_unwind;
use std::thread::{Builder, scope};

use crate::Error;

/// Up to this many matrix elements of coordinates by coordinates and design variables the stack of any thread will do.
const SMALL: usize = 256;
/// Stack of any question, and what it grows by with an element: some hundred copies of every matrix and gradient. Memory that is
/// not used is not taken.
const STACK: usize = 16 << 20;
const STACK_PER_ELEMENT: usize = 4 << 10;

/// Stack for questions about a mechanism of `n` unknowns and `p` design variables; `None` where that of any thread will do.
pub(crate) const fn stack(n: usize, p: usize) -> Option<usize> {
    let elements = n * (n + p);
    if elements <= SMALL || cfg!(target_family = "wasm") {
        None
    } else {
        Some(STACK + STACK_PER_ELEMENT * elements)
    }
}

/// Answers a question on a stack of this size.
pub(crate) fn with_stack<T: Send>(
    size: usize,
    question: impl FnOnce() -> Result<T, Error> + Send,
) -> Result<T, Error> {
    let answer = scope(|scope| {
        let boxed = || question().map(Box::new);
        let worker = Builder::new()
            .stack_size(size)
            .spawn_scoped(scope, boxed)
            .map_err(|error| Error::Threads(error.to_string()))?;
        worker.join().unwrap_or_else(|panic| resume_unwind(panic))
    });
    answer.map(|answer| *answer)
}
