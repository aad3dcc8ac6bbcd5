//! Storage for the numbers of a list or matrix: a few inline, many on the heap.

use core::ops::{Deref, DerefMut};

/// Dereferences to a slice.
#[derive(Clone)]
pub(super) enum Buffer<T, const FEW: usize> {
    /// The count, and an array of which entries beyond the count are never read. It is copied whole: a copy of known
    /// size takes a few instructions.
    Few(usize, [T; FEW]),
    Many(Vec<T>),
}

impl<T: Copy + Default, const FEW: usize> Buffer<T, FEW> {
    /// `count` copies of `value`.
    #[inline]
    pub(super) fn filled(count: usize, value: T) -> Self {
        if count <= FEW { Self::Few(count, [value; FEW]) } else { Self::Many(vec![value; count]) }
    }

    #[inline]
    pub(super) fn from_slice(values: &[T]) -> Self {
        if values.len() <= FEW {
            let mut few = [T::default(); FEW];
            for (slot, value) in few.iter_mut().zip(values) {
                *slot = *value;
            }
            Self::Few(values.len(), few)
        } else {
            Self::Many(values.to_vec())
        }
    }

    /// `value(k)` at position `k`.
    #[inline]
    pub(super) fn from_fn(count: usize, mut value: impl FnMut(usize) -> T) -> Self {
        if count <= FEW {
            let mut few = [T::default(); FEW];
            for (k, slot) in few.iter_mut().enumerate().take(count) {
                *slot = value(k);
            }
            Self::Few(count, few)
        } else {
            Self::Many((0..count).map(value).collect())
        }
    }

    /// Resizes to `count`, to be overwritten; the contents are unspecified.
    #[inline(always)]
    pub(super) fn make_room(&mut self, count: usize) -> &mut [T] {
        match self {
            Self::Few(length, _) if count <= FEW => *length = count,
            Self::Many(many) if many.len() == count => {}
            _ => self.renew(count),
        }
        &mut self[..count]
    }

    #[cold]
    #[inline(never)]
    fn renew(&mut self, count: usize) {
        match self {
            Self::Many(many) => many.resize(count, T::default()),
            Self::Few(..) => *self = Self::filled(count, T::default()),
        }
    }
}

/// Whether the iterator certainly yields no more than `most` values.
#[inline(always)]
fn at_most(values: &impl Iterator, most: usize) -> bool {
    matches!(values.size_hint(), (_, Some(count)) if count <= most)
}

/// Writes values to the first positions, and returns their number.
#[inline(always)]
fn fill<T>(places: &mut [T], values: impl Iterator<Item = T>) -> usize {
    let most = values.size_hint().1.unwrap_or(usize::MAX);
    let most = most.min(places.len());
    let mut written = 0;
    for (slot, value) in places[..most].iter_mut().zip(values) {
        *slot = value;
        written += 1;
    }
    written
}

impl<T: Copy + Default, const FEW: usize> FromIterator<T> for Buffer<T, FEW> {
    #[inline]
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let values = values.into_iter();
        if at_most(&values, FEW) {
            let mut few = [T::default(); FEW];
            let count = fill(&mut few, values);
            return Self::Few(count, few);
        }
        let values: Vec<T> = values.collect();
        if values.len() <= FEW { Self::from_slice(&values) } else { Self::Many(values) }
    }
}

impl<T, const FEW: usize> From<Vec<T>> for Buffer<T, FEW> {
    #[inline]
    fn from(values: Vec<T>) -> Self {
        Self::Many(values)
    }
}

impl<T: Copy, const FEW: usize> From<Buffer<T, FEW>> for Vec<T> {
    fn from(buffer: Buffer<T, FEW>) -> Self {
        match buffer {
            Buffer::Few(..) => buffer.to_vec(),
            Buffer::Many(many) => many,
        }
    }
}

impl<T: Copy + Default, const FEW: usize> Default for Buffer<T, FEW> {
    #[inline]
    fn default() -> Self {
        Self::filled(0, T::default())
    }
}

impl<T, const FEW: usize> Deref for Buffer<T, FEW> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match self {
            Self::Few(count, few) => &few[..*count],
            Self::Many(many) => many,
        }
    }
}

impl<T, const FEW: usize> DerefMut for Buffer<T, FEW> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        match self {
            Self::Few(count, few) => &mut few[..*count],
            Self::Many(many) => many,
        }
    }
}
