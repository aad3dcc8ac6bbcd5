//! Worker threads, kept for the next run: starting them costs as much as a small run.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::Error;

static POOLS: Mutex<BTreeMap<usize, Arc<ThreadPool>>> = Mutex::new(BTreeMap::new());

/// The pool of this many threads; started when first asked for, then idle between runs until the program ends.
pub(super) fn of(threads: usize) -> Result<Arc<ThreadPool>, Error> {
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
