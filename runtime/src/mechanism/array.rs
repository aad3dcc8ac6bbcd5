//! Arrays whose length a mechanism knows and its users need not name.

/// A plain array `[T; N]`; nothing else implements it.
pub trait Array<T>: Copy + AsRef<[T]> + AsMut<[T]> + sealed::Sealed {
    /// Number of entries.
    const LEN: usize;

    /// An array with `value(k)` in place `k`.
    fn from_fn(value: impl FnMut(usize) -> T) -> Self;

    /// The same value everywhere.
    fn filled(value: T) -> Self;

    /// A slice of this length as an array.
    ///
    /// # Panics
    /// When the slice has another length.
    fn view(slice: &[T]) -> &Self;
}

impl<T: Copy, const N: usize> Array<T> for [T; N] {
    const LEN: usize = N;

    #[inline(always)]
    fn from_fn(value: impl FnMut(usize) -> T) -> Self {
        core::array::from_fn(value)
    }

    #[inline(always)]
    fn filled(value: T) -> Self {
        [value; N]
    }

    #[inline(always)]
    fn view(slice: &[T]) -> &Self {
        match slice.try_into() {
            Ok(array) => array,
            Err(_) => wrong_length(slice.len(), N),
        }
    }
}

#[cold]
fn wrong_length(found: usize, expected: usize) -> ! {
    panic!("{found} values where the mechanism has {expected}")
}

mod sealed {
    /// What keeps other types out.
    pub trait Sealed {}
    impl<T, const N: usize> Sealed for [T; N] {}
}
