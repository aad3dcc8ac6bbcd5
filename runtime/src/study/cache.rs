//! Results that a study keeps for its next question.

use core::ops::Deref;
use std::sync::Arc;

/// Results that are computed when first needed. Clones of a study share them until a setting changes them.
#[derive(Clone, Debug, Default)]
pub(super) struct Cache<T>(Arc<T>);

impl<T: Default> Cache<T> {
    /// Forgets the results, here but not in clones.
    pub(super) fn clear(&mut self) {
        match Arc::get_mut(&mut self.0) {
            Some(inner) => *inner = T::default(),
            None => *self = Self::default(),
        }
    }
}

impl<T> Deref for Cache<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

/// The results follow from the settings, so they do not affect equality of studies.
impl<T> PartialEq for Cache<T> {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}
