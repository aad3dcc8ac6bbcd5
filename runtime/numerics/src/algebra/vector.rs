//! Lists of numbers whose length is known at run time; short ones do not need the heap.

use core::ops::{Deref, DerefMut, Index, IndexMut, Range};
use core::slice::SliceIndex;
use core::{fmt, slice};

use super::buffer::{Buffer, UpTo8};
use crate::Complex;

/// Number of entries stored in the vector itself.
const FEW: usize = 8;

/// A list of numbers that dereferences to a slice. Converts to and from nalgebra as a [`Matrix`](crate::Matrix) does.
#[derive(Clone)]
pub struct Vector<T = f64> {
    entries: Buffer<T, UpTo8, FEW>,
}

impl<T: Copy + Default> Default for Vector<T> {
    #[inline]
    fn default() -> Self {
        Self { entries: Buffer::default() }
    }
}

impl<T: Copy + Default> Vector<T> {
    /// `n` zeros.
    #[must_use]
    #[inline]
    pub fn zeros(n: usize) -> Self {
        Self { entries: Buffer::filled(n, T::default()) }
    }
}

impl<T: Copy + Default> Vector<T> {
    /// `value(k)` at position `k`.
    #[inline]
    pub fn from_fn(n: usize, value: impl FnMut(usize) -> T) -> Self {
        Self { entries: Buffer::from_fn(n, value) }
    }
}

impl<T: Copy + Default> Vector<T> {
    /// Applies `f` to every entry.
    #[inline]
    pub fn map<R: Copy + Default>(&self, f: impl FnMut(T) -> R) -> Vector<R> {
        self.entries.iter().copied().map(f).collect()
    }

    /// `n` copies of `value`.
    #[inline]
    pub fn filled(n: usize, value: T) -> Self {
        Self { entries: Buffer::filled(n, value) }
    }
}

impl<T: Copy + Default> Vector<T> {
    /// Resizes to `n` in the same storage, to be overwritten; the contents are unspecified.
    #[inline(always)]
    pub fn make_room(&mut self, n: usize) -> &mut [T] {
        self.entries.make_room(n)
    }

    /// Overwrites the entries with `f` of other numbers, in the same storage.
    #[inline(always)]
    pub fn set<S>(&mut self, from: &[S], f: impl Fn(&S) -> T) {
        for (to, from) in self.make_room(from.len()).iter_mut().zip(from) {
            *to = f(from);
        }
    }

    /// Overwrites the entries with other values, in the same storage.
    #[inline]
    pub fn assign(&mut self, values: impl ExactSizeIterator<Item = T>) {
        for (slot, value) in self.make_room(values.len()).iter_mut().zip(values) {
            *slot = value;
        }
    }
}

impl<T> Deref for Vector<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.entries
    }
}

impl<T> DerefMut for Vector<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }
}

impl<T, I: SliceIndex<[T]>> Index<I> for Vector<T> {
    type Output = I::Output;

    #[inline(always)]
    fn index(&self, index: I) -> &I::Output {
        &self.entries[index]
    }
}

impl<T, I: SliceIndex<[T]>> IndexMut<I> for Vector<T> {
    #[inline(always)]
    fn index_mut(&mut self, index: I) -> &mut I::Output {
        &mut self.entries[index]
    }
}

impl<T: Copy + Default> FromIterator<T> for Vector<T> {
    #[inline]
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        Self { entries: values.into_iter().collect() }
    }
}

impl<T: Copy + Default> From<&[T]> for Vector<T> {
    #[inline]
    fn from(values: &[T]) -> Self {
        Self { entries: Buffer::from_slice(values) }
    }
}

impl<T: Copy + Default, const N: usize> From<[T; N]> for Vector<T> {
    #[inline]
    fn from(values: [T; N]) -> Self {
        Self::from(&values[..])
    }
}

impl<T> From<Vec<T>> for Vector<T> {
    #[inline]
    fn from(entries: Vec<T>) -> Self {
        Self { entries: entries.into() }
    }
}

impl<T: Copy> From<Vector<T>> for Vec<T> {
    #[inline]
    fn from(vector: Vector<T>) -> Self {
        vector.entries.into()
    }
}

impl<T: Copy> IntoIterator for Vector<T> {
    type Item = T;
    type IntoIter = IntoIter<T>;

    #[inline]
    fn into_iter(self) -> IntoIter<T> {
        IntoIter { left: 0..self.len(), vector: self }
    }
}

/// Iterator over the numbers of a vector.
#[derive(Clone, Debug)]
pub struct IntoIter<T> {
    vector: Vector<T>,
    left: Range<usize>,
}

impl<T: Copy> Iterator for IntoIter<T> {
    type Item = T;

    #[inline]
    fn next(&mut self) -> Option<T> {
        self.left.next().map(|k| self.vector[k])
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.left.size_hint()
    }
}

impl<T: Copy> ExactSizeIterator for IntoIter<T> {}

impl<'a, T> IntoIterator for &'a Vector<T> {
    type Item = &'a T;
    type IntoIter = slice::Iter<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter()
    }
}

impl<'a, T> IntoIterator for &'a mut Vector<T> {
    type Item = &'a mut T;
    type IntoIter = slice::IterMut<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter_mut()
    }
}

impl<T: fmt::Debug> fmt::Debug for Vector<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

impl<T: PartialEq, R: AsRef<[T]> + ?Sized> PartialEq<R> for Vector<T> {
    fn eq(&self, other: &R) -> bool {
        *self.entries == *other.as_ref()
    }
}

impl<T> AsRef<[T]> for Vector<T> {
    fn as_ref(&self) -> &[T] {
        &self.entries
    }
}

/// Extension methods for slices of numbers.
pub trait Values<T> {
    /// Applies `f` to every entry.
    fn map<R: Copy + Default>(&self, f: impl FnMut(T) -> R) -> Vector<R>;
}

impl<T: Copy> Values<T> for [T] {
    #[inline]
    fn map<R: Copy + Default>(&self, f: impl FnMut(T) -> R) -> Vector<R> {
        self.iter().copied().map(f).collect()
    }
}

/// `x^T y`.
#[inline]
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    // The neutral element of addition, so that the first addition costs nothing.
    x.iter().zip(y).fold(-0.0, |sum, (x, y)| sum + x * y)
}

/// `x^T y`, without conjugation.
pub fn dot_complex(x: &[Complex], y: &[Complex]) -> Complex {
    x.iter().zip(y).fold(Complex::default(), |sum, (x, y)| sum + x * y)
}

/// `a + factor * b`.
#[inline]
pub fn add_scaled(a: &[f64], factor: f64, b: &[f64]) -> Vector {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}

/// Adds `factor * b` to `a`.
#[inline]
pub fn add_to(a: &mut [f64], factor: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += factor * b;
    }
}

/// Largest absolute value.
#[inline]
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most, value| greater(most, value.abs()))
}

/// The larger of two numbers, or the first one if the second is NaN; one instruction, unlike [`f64::max`].
#[inline]
pub fn greater(most: f64, value: f64) -> f64 {
    if value > most { value } else { most }
}

/// Whether no value is NaN or infinite, without a branch per value.
#[inline]
pub fn all_finite(x: &[f64]) -> bool {
    x.iter().fold(0.0, |sum, value| sum + unless_finite(*value)) == 0.0
}

/// Zero if the value is finite, NaN otherwise.
#[inline]
pub fn unless_finite(value: f64) -> f64 {
    0.0 * value
}

impl<T: Copy + Default> eigentol_contract::Zeros for Vector<T> {
    #[inline]
    fn zeros(n: usize) -> Self {
        Self::zeros(n)
    }
}
