//! Worker threads that are kept for the next run: starting them costs as much as a small run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::Error;

/// Number of matrix elements (coordinates by coordinates and design variables) up to which the stack of any thread is
/// large enough.
const SMALL: usize = 256;
/// Stack size for a sample, and its growth per matrix element: about a hundred copies of every matrix and gradient.
/// Unused memory is not allocated.
const STACK: usize = 16 << 20;
const STACK_PER_ELEMENT: usize = 4 << 10;

/// Stack for samples of a mechanism of `n` unknowns and `p` design variables; `None` if that of any thread is large
/// enough.
const fn stack(n: usize, p: usize) -> Option<usize> {
    let elements = n * (n + p);
    if elements <= SMALL || cfg!(target_family = "wasm") { None } else { Some(STACK + STACK_PER_ELEMENT * elements) }
}

/// Pools by number of threads and by stack size, if that is not the default.
type Pools = BTreeMap<(usize, Option<usize>), Arc<ThreadPool>>;

/// Maximum number of threads of a run, unless the machine has more: beyond the processors they only cost time.
pub(super) const MOST: usize = 256;

static POOLS: Mutex<Pools> = Mutex::new(BTreeMap::new());

/// The pool with this number of threads, each with this stack or the default one; 0 means as many as the machine has,
/// and larger requests are limited to [`MOST`]. It is started on first use, then stays idle between runs until the
/// program ends.
fn of(threads: usize, stack: Option<usize>) -> Result<Arc<ThreadPool>, Error> {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = threads.min(MOST.max(processors));
    // Nothing that can panic modifies the map, so a poisoned one is still valid.
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pool) = pools.get(&(threads, stack)) {
        return Ok(Arc::clone(pool));
    }
    let mut builder = ThreadPoolBuilder::new().num_threads(threads);
    if let Some(size) = stack {
        builder = builder.stack_size(size);
    }
    let pool = builder.build().map_err(|error| Error::Threads(error.to_string()))?;
    let pool = Arc::new(pool);
    pools.insert((threads, stack), Arc::clone(&pool));
    Ok(pool)
}

/// Runs the given number of work items on a mechanism of `n` unknowns and `p` design variables, each thread with its
/// own workspace, and returns the results in order. 0 threads means as many as the machine has.
pub fn run<R, T: Send>(
    threads: usize,
    (n, p): (usize, usize),
    pieces: usize,
    room: impl Fn() -> R + Sync + Send,
    work: impl Fn(&mut R, usize) -> T + Sync + Send,
) -> Result<Vec<T>, Error> {
    match (threads, stack(n, p)) {
        (1, _) => {
            let mut room = room();
            Ok((0..pieces).map(|index| work(&mut room, index)).collect())
        }
        (0, None) => Ok((0..pieces).into_par_iter().map_init(room, work).collect()),
        (threads, size) => {
            Ok(of(threads, size)?.install(|| (0..pieces).into_par_iter().map_init(room, work).collect()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_processors_are_capped() -> Result<(), Error> {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let (many, more) = (of(1_000_000, None)?, of(usize::MAX, None)?);
        assert!(Arc::ptr_eq(&many, &more));
        assert_eq!(many.current_num_threads(), processors.max(256));
        Ok(())
    }

    #[test]
    fn pools_are_reused_by_size() -> Result<(), Error> {
        let (two, again, three) = (of(2, None)?, of(2, None)?, of(3, None)?);
        assert!(Arc::ptr_eq(&two, &again) && !Arc::ptr_eq(&two, &three));
        assert!(!Arc::ptr_eq(&two, &of(2, Some(1 << 22))?));
        assert_eq!((two.current_num_threads(), three.current_num_threads()), (2, 3));
        Ok(())
    }
}
