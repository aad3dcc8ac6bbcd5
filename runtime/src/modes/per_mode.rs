//! A list with one entry for each mode, on the stack.

use core::ops::{Deref, DerefMut};

/// One entry for each mode. `N` free coordinates have from `N` modes (each a conjugate pair of eigenvalues) to `2 N` (each
/// eigenvalue real, a motion of its own); where constraints hold some of `N` unknowns there are fewer, or none. Reads as
/// a slice.
#[derive(Clone, Copy)]
pub struct PerMode<T, const N: usize> {
    /// Entries from `count` on are copies without meaning; `None` without modes.
    entries: Option<[[T; 2]; N]>,
    count: usize,
}

impl<T: Copy, const N: usize> PerMode<T, N> {
    /// Without entries, but with room for them: `blank` stands in their places.
    #[inline]
    pub(crate) const fn blank(blank: T) -> Self {
        Self {
            entries: Some([[blank; 2]; N]),
            count: 0,
        }
    }

    /// Makes room for `count` entries, at most `2 N`: places to be written over.
    #[inline]
    pub(crate) fn places(&mut self, count: usize) -> &mut [T] {
        self.count = count.min(2 * N);
        self
    }

    /// The first `count` of the values of `entry`, at most `2 N`.
    #[inline]
    pub(crate) fn from_fn(count: usize, mut entry: impl FnMut(usize) -> T) -> Self {
        let count = count.min(2 * N);
        if count == 0 {
            return Self {
                entries: None,
                count,
            };
        }
        let mut list = Self::blank(entry(0));
        for (r, place) in list.places(count).iter_mut().enumerate().skip(1) {
            *place = entry(r);
        }
        list
    }

    /// A list of equal length made from each entry.
    pub fn map<R: Copy>(&self, mut entry: impl FnMut(&T) -> R) -> PerMode<R, N> {
        PerMode::from_fn(self.count, |r| entry(&self[r]))
    }
}

impl<T, const N: usize> Deref for PerMode<T, N> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        match &self.entries {
            Some(entries) => &entries.as_flattened()[..self.count],
            None => &[],
        }
    }
}

impl<T, const N: usize> DerefMut for PerMode<T, N> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        match &mut self.entries {
            Some(entries) => &mut entries.as_flattened_mut()[..self.count],
            None => &mut [],
        }
    }
}

impl<T: PartialEq, const N: usize> PartialEq for PerMode<T, N> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: core::fmt::Debug, const N: usize> core::fmt::Debug for PerMode<T, N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        (**self).fmt(f)
    }
}

impl<'a, T, const N: usize> IntoIterator for &'a PerMode<T, N> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
