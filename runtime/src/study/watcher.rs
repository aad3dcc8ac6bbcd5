//! The observer of a study's long computations.

use core::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::Watch;

/// A [`Watch`] owned by a study.
#[derive(Clone, Default)]
pub(super) struct Watcher {
    pub(super) progress: Option<Arc<dyn Fn(usize) + Send + Sync>>,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

impl Watcher {
    pub(super) fn watch(&self) -> Watch<'_> {
        let progress = self.progress.as_deref();
        Watch::default()
            .progress(progress.map(|progress| progress as &(dyn Fn(usize) + Sync)))
            .stop(self.stop.as_deref())
    }
}

/// The observer does not affect equality of studies.
impl PartialEq for Watcher {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Watcher {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.watch().fmt(f)
    }
}
