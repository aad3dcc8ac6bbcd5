//! Storage for the numbers of a list or matrix: a few inline, many on the heap.

use core::ops::{Deref, DerefMut};

/// A count that its type limits to the length of an array: slices of so many entries need no check.
pub(super) trait Count: Copy {
    /// A count, or the limit if that is lower.
    fn limited(count: usize) -> Self;
    fn get(self) -> usize;
}

macro_rules! count {
    ($name:ident: $($number:literal $variant:ident,)* $most:ident) => {
        #[derive(Clone, Copy)]
        #[repr(usize)]
        pub(super) enum $name { $($variant,)* $most }

        impl Count for $name {
            #[inline(always)]
            fn limited(count: usize) -> Self {
                match count {
                    $($number => Self::$variant,)*
                    _ => Self::$most,
                }
            }

            #[inline(always)]
            fn get(self) -> usize {
                self as usize
            }
        }
    };
}

count!(UpTo8: 0 N0, 1 N1, 2 N2, 3 N3, 4 N4, 5 N5, 6 N6, 7 N7, N8);
count!(UpTo16: 0 N0, 1 N1, 2 N2, 3 N3, 4 N4, 5 N5, 6 N6, 7 N7, 8 N8, 9 N9, 10 N10, 11 N11, 12 N12, 13 N13, 14 N14, 15 N15, N16);

/// Dereferences to a slice.
#[derive(Clone)]
pub(super) enum Buffer<T, C, const FEW: usize> {
    /// The count, and an array of which entries beyond the count are never read. It is copied whole: a copy of known
    /// size takes a few instructions.
    Few(C, [T; FEW]),
    Many(Vec<T>),
}

impl<T: Copy + Default, C: Count, const FEW: usize> Buffer<T, C, FEW> {
    /// `count` copies of `value`.
    #[inline]
    pub(super) fn filled(count: usize, value: T) -> Self {
        if count <= FEW { Self::Few(C::limited(count), [value; FEW]) } else { Self::Many(vec![value; count]) }
    }

    #[inline]
    pub(super) fn from_slice(values: &[T]) -> Self {
        if values.len() <= FEW {
            let mut few = [T::default(); FEW];
            for (slot, value) in few.iter_mut().zip(values) {
                *slot = *value;
            }
            Self::Few(C::limited(values.len()), few)
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
            Self::Few(C::limited(count), few)
        } else {
            Self::Many((0..count).map(value).collect())
        }
    }

    /// Resizes to `count`, to be overwritten; the contents are unspecified.
    #[inline(always)]
    pub(super) fn make_room(&mut self, count: usize) -> &mut [T] {
        match self {
            Self::Few(length, _) if count <= FEW => *length = C::limited(count),
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

impl<T: Copy + Default, C: Count, const FEW: usize> FromIterator<T> for Buffer<T, C, FEW> {
    #[inline]
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let values = values.into_iter();
        if at_most(&values, FEW) {
            let mut few = [T::default(); FEW];
            let count = fill(&mut few, values);
            return Self::Few(C::limited(count), few);
        }
        let values: Vec<T> = values.collect();
        if values.len() <= FEW { Self::from_slice(&values) } else { Self::Many(values) }
    }
}

impl<T, C, const FEW: usize> From<Vec<T>> for Buffer<T, C, FEW> {
    #[inline]
    fn from(values: Vec<T>) -> Self {
        Self::Many(values)
    }
}

impl<T: Copy, C: Count, const FEW: usize> From<Buffer<T, C, FEW>> for Vec<T> {
    fn from(buffer: Buffer<T, C, FEW>) -> Self {
        match buffer {
            Buffer::Few(..) => buffer.to_vec(),
            Buffer::Many(many) => many,
        }
    }
}

impl<T: Copy + Default, C: Count, const FEW: usize> Default for Buffer<T, C, FEW> {
    #[inline]
    fn default() -> Self {
        Self::filled(0, T::default())
    }
}

impl<T, C: Count, const FEW: usize> Deref for Buffer<T, C, FEW> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match self {
            Self::Few(count, few) => &few[..count.get()],
            Self::Many(many) => many,
        }
    }
}

impl<T, C: Count, const FEW: usize> DerefMut for Buffer<T, C, FEW> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        match self {
            Self::Few(count, few) => &mut few[..count.get()],
            Self::Many(many) => many,
        }
    }
}
