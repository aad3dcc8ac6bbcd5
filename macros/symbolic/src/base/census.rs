//! Counts the special cases that a derivation takes: special code that no test mechanism reaches is untested.

#[cfg(feature = "census")]
use std::{cell::RefCell, collections::BTreeMap};

#[cfg(feature = "census")]
thread_local! {
    static TAKEN: RefCell<BTreeMap<String, u64>> = const { RefCell::new(BTreeMap::new()) };
}

/// Records that a special case was taken; does nothing without the feature `census`.
#[doc(hidden)]
#[inline(always)]
pub fn taken(_case: impl FnOnce() -> String) {
    #[cfg(feature = "census")]
    TAKEN.with_borrow_mut(|counts| *counts.entry(_case()).or_default() += 1);
}

/// How often each special case was taken on this thread since the last call.
#[cfg(feature = "census")]
pub fn take() -> BTreeMap<String, u64> {
    TAKEN.take()
}
