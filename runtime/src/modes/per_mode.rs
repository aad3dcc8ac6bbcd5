//! A list with one entry for each mode, on the stack.

use core::ops::{Deref, DerefMut};

/// One entry for each mode. `N` coordinates have from `N` modes (each a conjugate pair of eigenvalues) to `2 N` (each
/// eigenvalue real, a motion of its own). Reads as a slice.
#[derive(Clone, Copy)]
pub struct PerMode<T, const N: usize> {
    /// Entries from `count` on are copies without meaning.
    entries: [[T; 2]; N],
    count: usize,
}

impl<T: Copy, const N: usize> PerMode<T, N> {
    /// The first `count` of the values of `entry`, at least one and at most `2 N`; none when `N` is zero.
    pub(crate) fn from_fn(count: usize, mut entry: impl FnMut(usize) -> T) -> Self {
        if N == 0 {
            let entries = core::array::from_fn(|_| unreachable!("no coordinate, no mode"));
            return Self { entries, count: 0 };
        }
        let count = count.clamp(1, 2 * N);
        let mut entries = [[entry(0); 2]; N];
        for (r, place) in entries.as_flattened_mut()[..count]
            .iter_mut()
            .enumerate()
            .skip(1)
        {
            *place = entry(r);
        }
        Self { entries, count }
    }

    /// A list of equal length made from each entry.
    pub fn map<R: Copy>(&self, mut entry: impl FnMut(&T) -> R) -> PerMode<R, N> {
        PerMode::from_fn(self.count, |r| entry(&self.entries.as_flattened()[r]))
    }
}

impl<T, const N: usize> Deref for PerMode<T, N> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.entries.as_flattened()[..self.count]
    }
}

impl<T, const N: usize> DerefMut for PerMode<T, N> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries.as_flattened_mut()[..self.count]
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
