//! Worker threads, kept for the next run: starting them costs as much as a small run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::Error;

static POOLS: Mutex<BTreeMap<usize, Arc<ThreadPool>>> = Mutex::new(BTreeMap::new());

/// Most threads of a run, unless the machine has more: beyond the processors they only cost.
const MOST: usize = 256;

/// The pool of this many threads, of [`MOST`] where more are asked for; started when first asked for, then idle between runs until
/// the program ends.
pub(super) fn of(threads: usize) -> Result<Arc<ThreadPool>, Error> {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = threads.min(MOST.max(processors));
    // Nothing that can panic changes the map, so a poisoned one is as good as any.
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pool) = pools.get(&threads) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Error::Threads(error.to_string()))?;
    let pool = Arc::new(pool);
    pools.insert(threads, Arc::clone(&pool));
    Ok(pool)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_processors_are_capped() -> Result<(), Error> {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let (many, more) = (of(1_000_000)?, of(usize::MAX)?);
        assert!(Arc::ptr_eq(&many, &more));
        assert_eq!(many.current_num_threads(), processors.max(256));
        Ok(())
    }

    #[test]
    fn pools_are_reused_by_size() -> Result<(), Error> {
        let (two, again, three) = (of(2)?, of(2)?, of(3)?);
        assert!(Arc::ptr_eq(&two, &again) && !Arc::ptr_eq(&two, &three));
        assert_eq!(
            (two.current_num_threads(), three.current_num_threads()),
            (2, 3)
        );
        Ok(())
    }
}
